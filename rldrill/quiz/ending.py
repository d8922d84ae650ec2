"""The end of a quiz: points and time, the mistakes by name, the weakest skill, and what to do tomorrow."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

from rich.console import RenderableType
from rich.text import Text

from rldrill.quiz.session import Session, State
from rldrill.render.terminal import words

#: So many mistakes are told.
_FEW = 3


def ending(session: Session, seconds: float) -> Iterator[RenderableType]:
    """The lines at the end of a quiz in which something was answered."""
    parts = session.parts
    right = sum(part.state is State.DONE for part in parts)
    first = sum(part.first_time for part in parts)
    yield (Text(f"{right} of {len(parts)} parts right, {first} of them at the first try.", style="bold"))
    earned, possible = sum(part.points for part in parts), sum(part.part.points for part in parts)
    yield (Text(f"{float(earned):.3g} of {possible} points in {_time(seconds)}."))
    for says, times in mistakes(session).most_common(_FEW):
        yield (words((f"  ✗ {'' if times == 1 else f'{times} times: '}", "red"), says))
    if (weak := weakest(session)) is not None:
        yield (words("Weakest: ", (weak.title, "bold"), f". Five more of these: {weak.command}"))
    yield (words("Tomorrow: ", (session.again, "bold")))


@dataclass(frozen=True, slots=True)
class Weak:
    """The skill that went worst, and the command that drills it."""

    title: str
    command: str
    family: str
    level: int | None


def mistakes(session: Session) -> Counter[str]:
    """The mistakes that were made, and how often."""
    return Counter(mistake.says for part in session.parts for made in part.made for mistake in made)


def weakest(session: Session) -> Weak | None:
    """Of the problems that were begun the one that earned the smallest share of its points; None if all went well."""
    shares = [
        (sum(part.points for part in record.parts) / sum(part.part.points for part in record.parts), record.exercise)
        for record in session.records
        if record.begun
    ]
    share, exercise = min(shares, key=lambda pair: pair[0])
    if share == 1:
        return None
    family, level = exercise.problem.family, exercise.problem.level
    at, option = (f", level {level}", f" --level {level}") if level else ("", "")
    return Weak(f"{family.title}{at}", f"rldrill quiz {family.name}{option} -n 5", family.name, level)


def _time(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"
