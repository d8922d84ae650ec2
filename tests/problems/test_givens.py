"""Givens from outside: whatever is wrong with them is one sentence that names the field."""

from typing import Any

import pytest

from rldrill.problems.catalogue import families, family
from rldrill.problems.errors import FileError
from rldrill.solutions.drawing import draw

MDP = {
    "transitions": [["a", "go", "b", "1/2", 1], ["a", "go", "end", 0.5, 2], ["b", "go", "a", 1, 3]],
    "terminal": ["end"],
}
VALUE_ITERATION: dict[str, Any] = {"mdp": MDP, "gamma": "9/10", "sweeps": 2}


def changed(**fields: object) -> dict[str, Any]:
    return VALUE_ITERATION | fields


def mdp(*transitions: list[object], terminal: tuple[str, ...] = ("end",)) -> dict[str, Any]:
    return changed(mdp={"transitions": list(transitions), "terminal": list(terminal)})


@pytest.mark.parametrize(
    ("given", "fragment"),
    [
        (changed(gamma="x"), "given.gamma: 'x' is not a number"),
        (changed(gamma="11/10"), "given.gamma: 11/10 is not between 0 and 1"),
        (changed(gamma=float("nan")), "given.gamma"),
        (changed(sweeps=0), "given.sweeps"),
        (changed(sweeps=10**9), "given.sweeps"),
        (changed(extra=1), "given.extra: is not a field"),
        ({"mdp": MDP, "gamma": 1}, "given.sweeps: is missing"),
        (changed(start={"a": 1}), "value of 'b' is missing"),
        (changed(start={"a": 1, "b": 2, "c": 3}), "given for 'c'"),
        (mdp(["a", "go", "end", "1/2", 1]), "sum to 1/2, not to 1"),
        (mdp(["a", "go", "end", "3/2", 1]), "not between 0 and 1"),
        (mdp(["a", "go", "b", 1, 1]), "'b' is reached but has no action"),
        (mdp(["a", "go", "end", 1, 1], ["end", "go", "a", 1, 1]), "'end' is terminal"),
        (mdp(["a", "go", "end", "1/2", 1], ["a", "go", "end", "1/2", 1]), "given twice"),
        (mdp(["a", "go", "end", 1]), "given.mdp.transitions"),
        (mdp(["a", "go", "$x$", 1, 1]), "given.mdp.transitions"),
        (mdp(["a", "go", "x\ny", 1, 1]), "given.mdp.transitions"),
        (mdp(["a" * 200, "go", "end", 1, 1]), "given.mdp.transitions"),
        (mdp(), "given.mdp.transitions"),
        ("nothing", "given"),
        (None, "given"),
    ],
)
def test_wrong_givens(given: Any, fragment: str) -> None:
    with pytest.raises(FileError) as error:
        family("value-iteration").read(given)
    assert fragment in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("gamma", ["9/10", 0.9, "0.9", " 0.90 "])
def test_a_number_reads_the_same_however_it_is_written(gamma: object) -> None:
    assert family("value-iteration").read(changed(gamma=gamma)) == family("value-iteration").read(VALUE_ITERATION)


@pytest.mark.parametrize("name", families())
def test_givens_survive_being_written_and_read(name: str) -> None:
    for level in family(name).levels:
        problem = draw(name, level, 5).problem
        assert problem.family.read(problem.data()["given"]) == problem.given
