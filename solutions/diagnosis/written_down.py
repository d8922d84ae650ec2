"""What goes wrong between the working and the answer."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Any

from rldrill.problems.parts import Matrix, Number
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.answers.text import Reading
from rldrill.solutions.diagnosis import weights
from rldrill.solutions.diagnosis.alternatives import plain
from rldrill.solutions.diagnosis.arithmetic import slips
from rldrill.solutions.diagnosis.causes import Candidate, Cause
from rldrill.solutions.diagnosis.replay import Application
from rldrill.solutions.diagnosis.typed import Typed
from rldrill.solutions.exact import is_rational


def written_down(typed: Typed, applications: Sequence[Application]) -> Iterator[Candidate]:
    """What can go wrong between the working and the answer."""
    kind = answer_kind(typed.part.kind)
    key = dict(typed.key)
    if any(isinstance(value, tuple) for value in key.values()):
        return

    def made(name: str, cells: dict[str, Any], what: str = "", of: str = "") -> Iterator[Candidate]:
        cause = Cause(of or name, weights.ANSWERS[of or name], what=what)
        yield Candidate(cause, {typed.part.label: kind.value(cells)})

    if len(key) > 1:
        for one, two in combinations(typed.wrong, 2):
            what = f"{one} and {two}"
            yield from made("exchanged-cells", {**key, one: key[two], two: key[one]}, what)
        yield from made("all-signs", {name: -value for name, value in key.items()})
    for name, value in key.items():
        if typed.wrong == (name,) or len(key) == 1:
            for slip, other in slips(value):
                yield from made(slip, {**key, name: other}, name)
    if len(key) == 1:
        ((name, value),) = key.items()
        yield from made("one-minus", {name: 1 - value})
        yield from made("percent", {name: value * 100})
        for application in applications:
            if plain(application.value):
                for candidate in made("another-quantity", {name: application.value}):
                    yield replace(candidate, cause=replace(candidate.cause, application=application))
    shape = typed.part.kind
    if isinstance(shape, Matrix) and shape.rows == shape.columns > 1:
        cells = {
            f"row {row}, column {column}": key[f"row {column}, column {row}"]
            for row in range(1, shape.rows + 1)
            for column in range(1, shape.columns + 1)
        }
        yield from made("answer-transposed", cells)
    if not isinstance(shape, Number) and len(key) > 2:
        yield from _scaled(typed, key)


def _scaled(typed: Typed, key: Mapping[str, Any]) -> Iterator[Candidate]:
    """All entries by the same factor too large: not normalised."""
    ratios = {
        cell.value / key[name]
        for name, cell in typed.cells.items()
        if isinstance(cell, Reading) and key[name] != 0 and is_rational(cell.value) and is_rational(key[name])
    }
    if len(ratios) == 1 and all(value != 0 and is_rational(value) for value in key.values()):
        factor = next(iter(ratios))
        cells = {name: value * factor for name, value in key.items()}
        yield Candidate(
            Cause("answer-scaled", weights.ANSWERS["answer-scaled"], was=factor),
            {typed.part.label: answer_kind(typed.part.kind).value(cells)},
        )
