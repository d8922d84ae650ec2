"""What keeps a problem from being a good exam question, each said of the part."""

from typing import Any

import pytest

from rldrill.problems.catalogue import family
from rldrill.problems.family import Problem
from rldrill.problems.identity import Identity
from rldrill.solutions.drawing import flaws
from rldrill.solutions.solution import solve


def found(name: str, given: dict[str, Any], level: int | None = None) -> list[str]:
    known = family(name)
    identity = None if level is None else Identity(name, level, 0, known.revision)
    return [flaw for flaw in flaws(solve(Problem(known, known.read(given), identity))) if flaw.startswith("(")]


def returned(*rewards: object, gamma: object = "1/2", time: int = 0) -> dict[str, Any]:
    return {"rewards": list(rewards), "gamma": gamma, "time": time}


TIE = {
    "mdp": {
        "transitions": [["a", "x", "end", 1, 4], ["a", "y", "end", 1, 4], ["b", "x", "end", 1, 1]],
        "terminal": ["end"],
    },
    "gamma": "1/2",
}


@pytest.mark.parametrize(
    ("name", "given", "said"),
    [
        ("return", returned(1, 2), []),
        ("return", returned(1, -2), ["(a) is zero"]),  # 1 − 1/2·2
        ("return", returned(3, 1, -2, time=1), ["(a) is zero"]),
        ("return", returned(1, 4, gamma="gamma", time=1), ["(a) does not depend on what is left open"]),
        ("return", returned(1, 4, gamma="gamma"), []),
        ("optimal-value", TIE, ["(b) has tied best actions"]),
        # A TD error of zero is as good as any other, an estimate of zero is not.
        ("advantage", {"run": {"trajectory": {"states": ["a", "b"], "rewards": [1]}, "values": {"a": 2, "b": 2},
                               "lam": "1/2"}, "gamma": "1/2"}, ["(b) is zero"]),
    ],
)  # fmt: skip
def test_what_is_no_good_question(name: str, given: dict[str, Any], said: list[str]) -> None:
    assert found(name, given) == said


@pytest.mark.parametrize(
    ("level", "most", "more"),
    [(1, "12/13", "12/137"), (2, "1234/567", "1234/5677"), (3, "12346/6789", "12346/67891"), (None, "12346/6789", "")],
)
def test_numbers_have_so_many_digits_and_no_more(level: int | None, most: str, more: str) -> None:
    assert found("return", returned(most), level) == []
    if more:
        assert found("return", returned(more), level) == ["(a) has more digits than a person can handle"]
