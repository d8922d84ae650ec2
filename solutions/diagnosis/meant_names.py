"""What the names in somebody's working stand for: the steps, what is given, and what is noted beside them."""

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

from sympy import Expr

from rldrill.problems.exact import PARAMETERS
from rldrill.problems.mathematics import mathematics, signs
from rldrill.problems.notations import in_notation
from rldrill.solutions.diagnosis.alternatives import plain
from rldrill.solutions.diagnosis.replay import Application
from rldrill.solutions.diagnosis.search import Search
from rldrill.solutions.diagnosis.written_names import (
    letters,
    names,
    names_of,
    of_another_index,
    plain_name,
    readings,
    spelled,
)
from rldrill.solutions.exact import is_rational
from rldrill.solutions.work import Equality, Result


class Names:
    """The names of a working, however they are written."""

    def __init__(self, search: Search) -> None:
        self._search = search

    def given(self, label: str) -> Sequence[Any]:
        """What is known under a name before a step, r₁ or V(cave)."""
        return self._givens.get(spelled(label), ())

    def scalar(self, label: str) -> Sequence[Any]:
        """What a letter of the formulas is worth."""
        return self._scalars.get(spelled(label), ())

    def noted(self, label: str) -> Sequence[Any]:
        """What the working gives a name beside its steps."""
        return self._noted.get(plain_name(label), ())

    def among(self, order: Sequence[int], label: str) -> list[int]:
        """Those of the steps, in their order, whose quantity has that name."""
        if not label:
            return []
        for name in readings(label):
            if steps := [each for each in order if name and name in self.written[each]]:
                return steps
        letter = spelled(label)
        if steps := [each for each in order if letter in self.letters[each]]:
            return steps
        other = of_another_index(label)
        return [each for each in order if other in self.written[each]]

    def is_of_another(self, label: str) -> bool:
        """Whether a step has that name, but for another state."""
        head, sign, _ = plain_name(label).partition("(")
        return bool(sign) and any(head in written for written in self.written.values())

    @cached_property
    def written(self) -> Mapping[int, set[str]]:
        """The names under which somebody may write each step."""
        return {each.number: names(each.step) for each in self._search.applications}

    @cached_property
    def letters(self) -> Mapping[int, set[str]]:
        """The letters of each step, without index and argument."""
        return {each.number: letters(each.step) for each in self._search.applications}

    @cached_property
    def runs(self) -> Sequence[Sequence[int]]:
        """The numbers of the steps one after the other by the same formula, each of another quantity: a vector."""
        runs: list[list[Application]] = []
        for each in self._search.applications:
            run = runs[-1] if runs else []
            if run and each.formula is run[0].formula and all(each.step.left != one.step.left for one in run):
                run.append(each)
            else:
                runs.append([each])
        return [[each.number for each in run] for run in runs if len(run) > 1 and all(plain(one.value) for one in run)]

    @cached_property
    def _givens(self) -> Mapping[str, Sequence[Any]]:
        tables = {id(table): (code, table) for each in self._search.applications for code, table in each.known.items()}
        found: dict[str, list[Any]] = {}
        for code, table in tables.values():
            for key, value in table.items() if isinstance(table, Mapping) else ():
                keys = list(map(str, key if isinstance(key, tuple) else (key,)))
                for name in (f"{code}({','.join(keys)})", *([_indexed(code, key)] if isinstance(key, int) else [])):
                    found.setdefault(spelled(name), []).extend([value] if plain(value) else [])
        return found

    @cached_property
    def _scalars(self) -> Mapping[str, Sequence[Any]]:
        found: dict[str, list[Any]] = {}
        for each in self._search.applications:
            for code, value in each.known.items():
                if code in PARAMETERS and is_rational(value):
                    found.setdefault(PARAMETERS[code], []).append(value)
        return found

    @cached_property
    def _noted(self) -> Mapping[str, Sequence[Any]]:
        """What the working gives a name beside its steps: the entries of a solution, what an equation comes to."""
        found: dict[str, list[Any]] = {}
        for line in self._search.work.lines:
            for left, value in _given_by(line):
                for name in names_of(left):
                    found.setdefault(name, []).append(value)
        return found


def _indexed(code: str, index: int) -> str:
    """A letter with its index in the notation in use: r₁, which Sutton and Barto write R₁."""
    return "".join(signs(in_notation(mathematics(f"{code}_{{{index}}}"))))


def _given_by(line: Any) -> Iterator[tuple[Expr, Any]]:
    """The names and numbers of a line of the working that is no step."""
    if isinstance(line, Result):
        yield from ((left, value) for left, value in zip(line.lefts, line.values, strict=True) if plain(value))
    elif isinstance(line, Equality) and isinstance(line.left, Expr):
        yield from ((line.left, value) for value in line.rights if plain(value) and not isinstance(value, Expr))
