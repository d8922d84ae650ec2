"""Which exercises a quiz asks: the problems named, draws from what is selected, or what is planned."""

from collections.abc import Callable, Iterator, Sequence
from datetime import datetime
from itertools import chain, islice

from rldrill.exam.selection import sequence
from rldrill.exercise import Exercise, draw, load
from rldrill.problems.catalogue import selection
from rldrill.problems.identity import names_a_problem
from rldrill.quiz.planning import Plan
from rldrill.quiz.recording import Recorder


def questions(
    names: Sequence[str], number: int, level: int | None, seed: Callable[[], int]
) -> tuple[Iterator[Exercise], int]:
    """The exercises of a quiz, drawn one by one as they are asked for, and how many there will be.

    Raises:
        UsageError: a name is neither a topic, a family, an ID nor a file.
    """
    named = [name for name in names if names_a_problem(name)]
    if named and len(named) == len(names):
        return iter([load(name) for name in named]), len(named)
    rest = [name for name in names if name not in named]
    selection(tuple(rest))  # a wrong name is told before a seed is announced
    drawn = (draw(family.name, wanted, own) for family, wanted, own in sequence(rest, level, seed()))
    first = [load(name) for name in named]
    return chain(first, islice(drawn, max(0, number - len(first)))), max(number, len(first))


def planned(plan: Plan, recorder: Recorder, now: Callable[[], datetime], seed: Callable[[], int]) -> Iterator[Exercise]:
    """What the plan asks, each a fresh variant, chosen when the one before is answered; without end."""
    while True:
        plan.learn(recorder.attempts)
        skill = plan.next(now())
        yield draw(skill.family, skill.level, seed())


def timed(exercises: Iterator[Exercise], minutes: float, recorder: Recorder) -> Iterator[Exercise]:
    """The exercises that are begun within so many minutes."""
    while recorder.elapsed < 60 * minutes and (exercise := next(exercises, None)) is not None:
        yield exercise
