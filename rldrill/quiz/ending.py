"""The end of a quiz: points and time, the mistakes by name, the weakest skill, and what to do tomorrow."""

from collections import Counter
from collections.abc import Iterator

from msgspec import Struct
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from rldrill.problems.document import counted
from rldrill.quiz.mistakes import called
from rldrill.quiz.session import Mistake, Session, State
from rldrill.render.terminal import words

#: So many mistakes are told.
_FEW = 3


def ending(session: Session, seconds: float, due: int | None = None) -> Iterator[RenderableType]:
    """The lines at the end of a quiz in which something was answered; ``due`` is how many skills are due tomorrow."""
    parts = session.parts
    right = sum(part.state is State.DONE for part in parts)
    first = sum(part.first_time for part in parts)
    tries = f", {first} of them at the first try" if right > 1 else ", at the first try" if first else ""
    yield (Text(f"{right} of {counted(len(parts), 'part')} right{tries}.", style="bold"))
    earned, possible = sum(part.points for part in parts), sum(part.part.points for part in parts)
    yield (Text(f"{float(earned):.3g} of {possible} points in {_time(seconds)}."))
    if session.drilled:
        yield words(_drilled(session))
    made = mistakes(session).most_common(_FEW)
    for mistake, times in made:
        yield (words((f"  ✗ {'' if times == 1 else f'{times} times: '}", "red"), mistake.says))
    commands = Table.grid(padding=(0, 2))
    commands.add_column(no_wrap=True)
    commands.add_column(overflow="fold")
    if (weak := weakest(session)) is not None:
        yield words("Weakest: ", (weak.title, "bold"), ".")
        if session.more is None:
            commands.add_row("Five more:", weak.command)
    if made:
        alone = "This mistake:" if len(made) == 1 else "The first mistake:"
        commands.add_row(alone, f"rldrill quiz --mistake {made[0][0].name}")
    tomorrow = f"Tomorrow, {due} due:" if due else "Tomorrow:"
    commands.add_row(tomorrow, Text(session.again, style="bold"))
    yield commands


class Weak(Struct, frozen=True):
    """The skill that went worst, and the command that drills it."""

    title: str
    command: str
    family: str
    level: int | None


def mistakes(session: Session) -> Counter[Mistake]:
    """The mistakes that were made, and how often."""
    return Counter(mistake for part in session.parts for made in part.made for mistake in made)


def _drilled(session: Session) -> str:
    """In how many problems the mistake was made that was drilled."""
    begun = [record for record in session.records if record.begun]
    made = sum(
        any(mistake.name == session.drilled for part in record.parts for each in part.made for mistake in each)
        for record in begun
    )
    return f"“{called(session.drilled)}”: made in {made or 'none'} of {counted(len(begun), 'problem')}."


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
