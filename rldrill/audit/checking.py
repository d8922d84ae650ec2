"""Holding every exact answer against an independent solver, and every draw against what it promises."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from msgspec import Struct, field

from rldrill.audit.figures import Figures
from rldrill.exam.manifest import read_exam
from rldrill.exam.selection import MAX_DRAWN
from rldrill.problems.catalogue import selection
from rldrill.problems.draws import Draws
from rldrill.problems.family import Family
from rldrill.problems.parts import Part, Policy
from rldrill.solutions.answers.judging import Outcome, judge
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.drawing import draw
from rldrill.solutions.exact import enclosure, exact
from rldrill.solutions.oracle import OPEN
from rldrill.solutions.solution import Solution, solver

#: How far an exact answer may be from the floating-point one, in units of the larger of 1 and the answer.
TOLERANCE = 1e-8


class Finding(Struct):
    """What the audit found in one family at one level.

    Args:
        drawn: how many problems were drawn.
        disagreements: IDs and parts where the two solvers differ, with both answers.
        refused: IDs and parts where the exact answer, typed, was not judged right.
        impossible: IDs of problems that state what cannot be true together.
        ties: how many problems have tied best actions where the question assumes one.
        made: how many misconceptions were tried.
        recognised: how many of them, typed as answers, were recognised.
        unrecognised: IDs and names of those that were not.
        figures: what the problems are like as questions.
    """

    family: Family
    level: int
    drawn: int = 0
    disagreements: list[str] = field(default_factory=list)
    refused: list[str] = field(default_factory=list)
    ties: int = 0
    impossible: list[str] = field(default_factory=list)
    made: int = 0
    recognised: int = 0
    unrecognised: list[str] = field(default_factory=list)
    seen: set[str] = field(default_factory=set)
    figures: Figures = field(default_factory=Figures)

    @property
    def clean(self) -> bool:
        """Whether nothing is wrong."""
        return not (self.disagreements or self.refused or self.ties or self.unrecognised or self.impossible)

    @property
    def complaints(self) -> list[str]:
        """What an examiner would object to."""
        return [f"{self.family.name}/{self.level}: {said}" for said in self.figures.complaints(self.level)]

    @property
    def never(self) -> tuple[str, ...]:
        """The family's misconceptions that applied to no problem of this level."""
        return tuple(m.name for m in solver(self.family).misconceptions if m.name not in self.seen)

    def data(self) -> dict[str, Any]:
        """The finding as JSON has it."""
        return {
            "family": self.family.name, "level": self.level, "drawn": self.drawn,
            "disagreements": self.disagreements, "refused": self.refused, "ties": self.ties,
            "misconceptions": {"made": self.made, "recognised": self.recognised,
                               "unrecognised": self.unrecognised, "never_applicable": list(self.never)},
            "impossible": self.impossible, "question": self.figures.data(), "complaints": self.complaints,
        }  # fmt: skip


def audit(
    names: Sequence[str], number: int, seed: int, progress: Callable[[], None] = lambda: None
) -> Iterator[Finding]:
    """Draw problems of every family and level, and check each.

    Args:
        names: topics and families; all, if empty.
        number: problems per family and level.
        seed: which problems.
        progress: called after every problem.
    """
    for family in selection(tuple(names)):
        for level in family.levels:
            seeds = Draws(f"audit {seed} {family.name} {level}")
            finding = Finding(family, level)
            for _ in range(number):
                examine(draw(family, level, seeds.below(MAX_DRAWN)), finding)
                progress()
            yield finding


def audit_exam(path: str | Path) -> Iterator[Finding]:
    """Check every problem of a saved exam, made again from the givens that its manifest holds.

    Args:
        path: the manifest.

    Raises:
        FileError: the manifest cannot be read, or a problem in it cannot be made.
    """
    findings: dict[tuple[str, int], Finding] = {}
    for make in read_exam(path)[1]:
        version = make()
        for number, exercise in enumerate(version.exercises, 1):
            problem = exercise.problem
            key = (problem.family.name, problem.level or 0)
            finding = findings.setdefault(key, Finding(problem.family, problem.level or 0))
            examine(exercise.solution, finding, f"version {version.code}, problem {number}")
    yield from findings.values()


def examine(solution: Solution, finding: Finding, called: str = "") -> None:
    """Check one problem, and add what is found; ``called`` is its name where it is not the ID."""
    finding.drawn += 1
    problem = solution.problem
    expected = solver(problem.family).oracle(problem.given)
    for part, other in zip(problem.parts, expected, strict=True):
        answer = solution.answers[part.label]
        where = f"{called or problem.identity} ({part.label})"
        if not agrees(part, answer, other):
            finding.disagreements.append(f"{where}: exact {answer}, independent {other}")
        if isinstance(part.kind, Policy) and not part.ties:
            finding.ties += any(len(best) > 1 for best in other.values())
        if judge(solution, part.label, answer_kind(part.kind).write(answer)).outcome is not Outcome.RIGHT:
            finding.refused.append(where)
    if not solver(problem.family).possible(problem.given):
        finding.impossible.append(called or str(problem.identity))
    finding.figures.add(solution)
    for misconception, answers in solution.mistakes:
        finding.made += 1
        finding.seen.add(misconception.name)
        if any(_recognised(solution, part, misconception.name, answers) for part in problem.parts):
            finding.recognised += 1
        else:
            finding.unrecognised.append(f"{called or problem.identity}: {misconception.name}")


def agrees(part: Part, answer: Any, expected: Any) -> bool:
    """Whether an exact answer and an independent one are the same."""
    cells = answer_kind(part.kind).cells(answer)
    if isinstance(part.kind, Policy):
        return {state: set(best) for state, best in cells.items()} == expected
    if any(isinstance(content, tuple) for content in cells.values()):
        return bool(answer == expected)
    numbers = np.array([as_float(content) for content in cells.values()])
    return bool(np.allclose(numbers, np.asarray(expected, dtype=float).ravel(), rtol=TOLERANCE, atol=TOLERANCE))


def as_float(value: Any) -> float:
    """An exact number in floating point; an open parameter takes the oracle's value."""
    return float(enclosure(value, lambda _: exact(OPEN)).mid())


def _recognised(solution: Solution, part: Part, name: str, answers: Mapping[str, Any]) -> bool:
    verdict = judge(solution, part.label, answer_kind(part.kind).write(answers[part.label]))
    return any(misconception.name == name for misconception in verdict.misconceptions)
