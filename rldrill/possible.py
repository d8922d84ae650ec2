"""Which wrong answers are told in a list: none that the statement itself rules out, for nobody hands them in."""

import re
from collections.abc import Iterator, Mapping
from operator import le, lt
from typing import Any

from rldrill.problems.document import Paragraph
from rldrill.problems.mathematics import Glyph, Math, Row
from rldrill.problems.parts import Part
from rldrill.solutions.exact import ONE, Value, parameters, sign
from rldrill.solutions.solution import Solution

#: What a statement says of a letter: 0 < p < 1.
_BOUNDS = re.compile(r"0 ([<≤]) (\w) ([<≤]) 1\b")
_PROBABILITIES = frozenset({Glyph("p", "variable"), Glyph("π", "variable"), Glyph("Pr", "word")})
_SIGNS = {"<": lt, "≤": le}


def is_possible(solution: Solution, label: str, answers: Mapping[str, Any]) -> bool:
    """Whether somebody can hand in an answer to a part: the statement leaves room for it, and for those before it."""
    parts = solution.problem.parts
    last = next(place for place, part in enumerate(parts) if part.label == label)
    return all(_has_room(solution, part, answers[part.label]) for part in parts[: last + 1] if part.label in answers)


def _has_room(solution: Solution, part: Part, value: Any) -> bool:
    """No probability is negative, and a letter has no value that it cannot have, or that the statement denies."""
    kind = solution.kinds[part.label]
    cells = [cell for cell in kind.cells(value).values() if not isinstance(cell, str | tuple | bool)]
    numbers, lines = [cell for cell in cells if not parameters(cell)], kind.lines(value)
    if len(lines) == len(cells) and any(_is_probability(left) for left, _ in lines):
        # What is not divided by its sum may exceed 1.
        return all(sign(number) >= 0 for number in numbers)
    letter = solution.sought.get(part.label)
    return letter is None or all(
        solution.can_be(letter, number) and all(_within(number, *bounds) for bounds in _bounds(solution, letter.sign))
        for number in numbers
    )


def _bounds(solution: Solution, letter: str) -> Iterator[tuple[str, str]]:
    """The signs between 0 and a letter, and between it and 1, in what the statement says of it."""
    question = solution.problem.question
    told = (block.text for block in question.blocks if isinstance(block, Paragraph))
    for text in (*told, *(part.ask for part in question.parts)):
        yield from ((low, high) for low, named, high in _BOUNDS.findall(text) if named == letter)


def _within(number: Value, low: str, high: str) -> bool:
    return _SIGNS[low](0, sign(number)) and _SIGNS[high](sign(number - ONE), 0)


def _is_probability(left: Math | None) -> bool:
    return isinstance(left, Row) and left.items[0] in _PROBABILITIES
