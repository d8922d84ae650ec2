"""Grading: every part of a problem is judged, later ones also with the person's own answers to earlier ones."""

from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

from msgspec import Struct

from rldrill.solutions.answers.judging import Outcome, Verdict, judge
from rldrill.solutions.effort import points
from rldrill.solutions.solution import Solution


class GradedPart(Struct, frozen=True):
    """One part of a submission.

    Args:
        part: the label of the part.
        typed: what was typed.
        verdict: the judgement; None where nothing was typed.
        of: the points that a right answer earns.
    """

    part: str
    typed: str
    verdict: Verdict | None
    of: int

    @property
    def outcome(self) -> Outcome | None:
        """What the answer is; None where nothing was typed."""
        return None if self.verdict is None else self.verdict.outcome

    @property
    def points(self) -> Fraction:
        """The points earned."""
        return Fraction(0) if self.verdict is None else self.of * self.verdict.credit

    @property
    def accepted(self) -> bool:
        """Whether the part is right, or follows rightly from an earlier answer."""
        return self.verdict is not None and self.verdict.accepted


class Graded(Struct, frozen=True):
    """A submission to one problem, all parts in their order; ``graded["b"]`` is one of them."""

    parts: tuple[GradedPart, ...]

    @property
    def points(self) -> Fraction:
        """The points earned."""
        return sum((part.points for part in self.parts), Fraction(0))

    @property
    def of(self) -> int:
        """The points that a right submission earns."""
        return sum(part.of for part in self.parts)

    @property
    def accepted(self) -> bool:
        """Whether every part is right."""
        return all(part.accepted for part in self.parts)

    def __getitem__(self, label: str) -> GradedPart:
        return {part.part: part for part in self.parts}[label]

    def __iter__(self) -> Iterator[GradedPart]:
        return iter(self.parts)

    def __len__(self) -> int:
        return len(self.parts)

    def __contains__(self, label: object) -> bool:
        return any(part.part == label for part in self.parts)


def grade(solution: Solution, texts: Mapping[str, str], worth: Mapping[str, int] | None = None) -> Graded:
    """Judge the texts that were typed for the parts with these labels; blank ones are missing.

    Args:
        solution: the solution.
        texts: what was typed.
        worth: the points of every part, where they do not follow the minutes.
    """
    graded: list[GradedPart] = []
    earlier: dict[str, Any] = {}
    worth = worth or points(solution)
    for part in solution.problem.parts:
        text = texts.get(part.label, "")
        verdict = judge(solution, part.label, text, earlier) if text.strip() else None
        if verdict is not None and verdict.value is not None:
            earlier[part.label] = verdict.value
        graded.append(GradedPart(part.label, text, verdict, worth[part.label]))
    return Graded(tuple(graded))
