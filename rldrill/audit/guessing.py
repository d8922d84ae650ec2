"""What somebody earns who knows nothing and answers the same thing every time."""

from collections import defaultdict
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

from rldrill.problems.parts import Choice, Matrix, Part, Policy, YesNo
from rldrill.solutions.answers.judging import credit
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.answers.rule import is_right
from rldrill.solutions.effort import points
from rldrill.solutions.exact import exact, is_rational
from rldrill.solutions.solution import Solution


class Guesses:
    """The points that each way of guessing earns in each part, over many draws of a family and level."""

    def __init__(self) -> None:
        self._earned: dict[str, dict[str, Fraction]] = defaultdict(lambda: defaultdict(Fraction))
        self._possible = 0

    def add(self, solution: Solution) -> None:
        """Guess at one problem."""
        worth = points(solution)
        self._possible += sum(worth.values())
        for part in solution.problem.parts:
            for way, share in _tried(solution, part):
                self._earned[part.label][way] += share * worth[part.label]

    @property
    def share(self) -> float:
        """The share of all points that the best constant answer to every part earns."""
        best = sum((max(ways.values()) for ways in self._earned.values()), Fraction(0))
        return float(best / self._possible) if self._possible else 0.0

    @property
    def best(self) -> dict[str, str]:
        """The best constant answer to each part."""
        return {label: max(ways, key=lambda way: ways[way]) for label, ways in self._earned.items()}


def _tried(solution: Solution, part: Part) -> Iterator[tuple[str, Fraction]]:
    """Every way of guessing that fits the part, with the share of its points that it earns."""
    key = answer_kind(part.kind).cells(solution.answers[part.label])
    for way, cells in _ways(part, key, solution.problem.data()["given"]):
        wrong = [name for name, content in key.items() if not _agrees(cells.get(name), content)]
        yield way, Fraction(1) if not wrong else credit(part.kind, len(key), len(wrong))


def _ways(part: Part, key: Mapping[str, Any], given: Any) -> Iterator[tuple[str, Mapping[str, Any]]]:
    match part.kind:
        case YesNo():
            yield from (("yes", dict.fromkeys(key, "yes")), ("no", dict.fromkeys(key, "no")))
        case Choice(options):
            yield from ((f"option {letter}", dict.fromkeys(key, letter)) for letter in options)
        case Policy(actions):
            for place in range(max(map(len, actions.values()))):
                yield (
                    f"action {place + 1} everywhere",
                    {name: possible[min(place, len(possible) - 1)] for name, possible in actions.items()},
                )
        case _:
            yield from ((text, dict.fromkeys(key, exact(Fraction(text)))) for text in ("0", "1", "1/2"))
            if isinstance(part.kind, Matrix):
                columns = part.kind.columns
                places = enumerate(key)
                yield "identity", {n: exact(Fraction(i // columns == i % columns)) for i, n in places}
            yield from (("as printed", table) for table in _tables(given, set(key)))


def _tables(data: Any, keys: set[str]) -> Iterator[dict[str, Any]]:
    """The printed tables that have a number for every key."""
    if isinstance(data, dict):
        if keys and keys <= data.keys() and all(isinstance(data[key], str) for key in keys):
            try:
                yield {key: exact(Fraction(data[key])) for key in keys}
            except ValueError:
                return  # a table of names
        for inner in data.values():
            yield from _tables(inner, keys)


def _agrees(guess: Any, content: Any) -> bool:
    if isinstance(content, tuple):
        return guess in content
    if isinstance(content, str):
        return bool(guess == content)
    return guess is not None and is_rational(content) and is_right(guess, content)
