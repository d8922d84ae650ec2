"""Which givens do not matter: each is changed by itself, the problem solved again, and the answers compared."""

from collections.abc import Iterator
from fnmatch import fnmatchcase
from fractions import Fraction
from typing import Any

from rldrill.problems.errors import FileError
from rldrill.problems.family import Problem
from rldrill.solutions.exact import NoSolution
from rldrill.solutions.solution import Solution, solve

Place = tuple[str | int, ...]


def idle(solution: Solution) -> tuple[str, ...]:
    """The places of the givens that no answer depends on: numbers, rows, terminal states that nothing leads to.

    A number does not matter if none of many other numbers in its place, very large ones among them, changes an
    answer. Where a probability cannot be changed alone, another of the same list takes up the difference. What the
    family declares as a distractor is left out.
    """
    data = solution.problem.data()["given"]
    found = [*_idle_numbers(solution, data), *_idle_rows(solution, data), *_unmentioned_ends(data)]
    declared = solution.problem.family.distractors
    paths = (".".join(map(str, place)) for place in found)
    return tuple(dict.fromkeys(path for path in paths if not any(fnmatchcase(path, each) for each in declared)))


def _idle_numbers(solution: Solution, data: Any) -> Iterator[Place]:
    numbers = {place: number for place, leaf in _leaves(data) if (number := _number(leaf)) is not None}
    for place, number in numbers.items():
        changes = [{place: other} for other in _others(number)]
        differs = _any_differs(solution, data, changes)
        if differs is None:
            shifts = [
                {place: number + step, other: numbers[other] - step}
                for other in numbers
                if _beside(place, other)
                for step in (-number / 2, numbers[other] / 2)
                if step
            ]
            differs = _any_differs(solution, data, shifts)
        if differs is False:
            yield place


def _idle_rows(solution: Solution, data: Any) -> Iterator[Place]:
    for place, rows in _lists(data):
        for index, row in enumerate(rows if len(rows) > 1 else ()):
            if any(_number(leaf) is not None for _, leaf in _leaves(row)):
                continue  # its numbers are tried one by one
            without = _replaced(data, place, [*rows[:index], *rows[index + 1 :]])
            if _answers(solution.problem, without) == solution.answers:
                yield (*place, index)


def _unmentioned_ends(data: Any) -> Iterator[Place]:
    """The terminal states that stand nowhere else."""
    for place, rows in _lists(data):
        if place[-1] == "terminal":
            elsewhere = {leaf for other, leaf in _leaves(data) if other[: len(place)] != place}
            elsewhere |= {key for other, _ in _leaves(data) for key in other if isinstance(key, str)}
            yield from ((*place, index) for index, end in enumerate(rows) if end not in elsewhere)


def _any_differs(solution: Solution, data: Any, changes: list[dict[Place, Fraction]]) -> bool | None:
    """Whether one of the changes gives other answers; None where the family accepts none of them."""
    accepted = False
    for change in changes:
        changed = data
        for place, number in change.items():
            changed = _replaced(changed, place, str(number))
        answers = _answers(solution.problem, changed)
        if answers is None:
            continue
        accepted = True
        if answers != solution.answers:
            return True
    return False if accepted else None


def _answers(problem: Problem, data: Any) -> Any:
    """The answers for other givens; a text that says why where there are none; None where they are refused."""
    try:
        return solve(Problem(problem.family, problem.family.read(data))).answers
    except FileError:
        return None
    except NoSolution as error:
        return str(error)


def _beside(place: Place, other: Place) -> bool:
    """Whether two numbers stand in one list or table, or in one column of a list of rows."""
    if place == other or len(place) != len(other):
        return False
    return place[:-1] == other[:-1] or (place[-1] == other[-1] and place[:-2] == other[:-2])


def _others(number: Fraction) -> tuple[Fraction, ...]:
    far = (number + 1000, number - 1000)
    near = (number + 1, number - 1, number / 2, (number + 1) / 2, -number, number + Fraction(1, 7))
    return tuple(other for other in (*far, *near) if other != number)


def _number(leaf: object) -> Fraction | None:
    if isinstance(leaf, bool) or not isinstance(leaf, str | int):
        return None
    try:
        return Fraction(leaf)
    except ValueError:
        return None


def _leaves(data: Any, place: Place = ()) -> Iterator[tuple[Place, Any]]:
    if isinstance(data, dict | list):
        for key, inner in data.items() if isinstance(data, dict) else enumerate(data):
            yield from _leaves(inner, (*place, key))
    else:
        yield place, data


def _lists(data: Any, place: Place = ()) -> Iterator[tuple[Place, list[Any]]]:
    if isinstance(data, list):
        yield place, data
    if isinstance(data, dict | list):
        for key, inner in data.items() if isinstance(data, dict) else enumerate(data):
            yield from _lists(inner, (*place, key))


def _replaced(data: Any, place: Place, value: Any) -> Any:
    """The data with another value at one place."""
    if not place:
        return value
    first, *rest = place
    copy = data.copy()
    copy[first] = _replaced(data[first], tuple(rest), value)
    return copy
