"""Every slip in a procedure gives the wrong answer that was worked out by hand for a small problem.

The tables beside this file hold them, one file for each topic: the family, the slip's name, what is given, how the
wrong answer was worked, and the answers themselves as one would type them.
"""

import tomllib
from pathlib import Path
from typing import Any

import pytest

from rldrill.problems.catalogue import families, family
from rldrill.problems.family import Problem
from rldrill.solutions.answers.judging import read_answer
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.answers.text import Reading
from rldrill.solutions.exact import is_zero
from rldrill.solutions.solution import Solution, solve, solver

TABLE = [
    entry
    for file in sorted(Path(__file__).parent.glob("*.toml"))
    for entry in tomllib.loads(file.read_text("utf-8"))["slip"]
]
SLIPS = {
    (name, mistake.name): mistake for name in families() for mistake in solver(family(name)).misconceptions
    if mistake.is_slip
}  # fmt: skip


def cells(solution: Solution, label: str, answer: Any) -> dict[str, Any]:
    part = next(part for part in solution.problem.parts if part.label == label)
    return answer_kind(part.kind).cells(answer)


@pytest.mark.parametrize("place", SLIPS, ids=" / ".join)
def test_every_slip_is_in_the_table(place: tuple[str, str]) -> None:
    worked = {(entry["family"], entry["name"]) for entry in TABLE}
    assert place in worked, f"work out by hand what this slip gives, in tests/slips/{family(place[0]).topic}.toml"


@pytest.mark.parametrize("entry", TABLE, ids=lambda entry: f"{entry['family']} / {entry['name']}")
def test_a_slip_gives_the_answer_worked_by_hand(entry: dict[str, Any]) -> None:
    place = entry["family"], entry["name"]
    assert place in SLIPS, "there is no such slip"
    assert len(entry["worked"]) > 20, "say how the wrong answer was worked"
    found = family(entry["family"])
    solution = solve(Problem(found, found.read(entry["given"])))
    assert SLIPS[place].applies(solution.problem.given)
    made = solution.answers_with(SLIPS[place])
    assert made is not None
    parts = {part.label: part for part in solution.problem.parts}
    for label, text in entry["answers"].items():
        read = read_answer(solution, parts[label], text)
        for name, content in cells(solution, label, made[label]).items():
            typed = read[name]
            if isinstance(typed, Reading):
                assert is_zero(typed.value - content), f"({label}) {name}: the slip gives {content}"
            else:
                words = {typed} if isinstance(typed, str) else set(typed)
                assert words == set(content), f"({label}) {name}: the slip gives {content}"
    assert any(
        cells(solution, label, made[label]) != cells(solution, label, solution.answers[label])
        for label in entry["answers"]
    ), "the right answer is no wrong one"
