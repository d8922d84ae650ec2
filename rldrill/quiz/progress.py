"""How progress looks: bars, a calendar, and the mistakes with the command that drills them."""

from collections.abc import Iterator, Mapping, Sequence
from datetime import date
from typing import Any

from msgspec import Struct
from rich.console import Console, ConsoleOptions, Group, RenderableType, RenderResult
from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text

from rldrill.history.progress import DAY, Day, Mistake, Progress
from rldrill.problems.document import counted
from rldrill.quiz.mistakes import called
from rldrill.render.terminal import words

#: How wide a picture of it is, in columns.
WIDTH = 92
_BAR = 20
#: In fewer columns there are lines instead of columns.
_NARROW = 50
#: So many weeks are on the calendar, and so many of the last days have a line of their own.
_WEEKS, _LINES = 12, 7
_SHADES, _ASCII = "·░▒▓█", ".-+x#"
#: From so many answers on a day is as dark as it gets.
_FULL = 20
#: So many of the mistakes have a command that drills them.
_DRILLS = 3


def shown(progress: Progress) -> RenderableType:
    """The whole of it, for a terminal of any width."""
    if not progress.answers:
        return words("There are no answers yet: 'rldrill quiz' asks the first questions.")
    return Group(*(item for section in _sections(progress) for item in (*section, Text(""))))


def _sections(progress: Progress) -> Iterator[tuple[RenderableType, ...]]:
    parts, right = (sum(getattr(day, name) for day in progress.days) for name in ("parts", "right"))
    yield (
        words(
            f"{counted(progress.answers, 'answer')} on {counted(len(progress.days), 'day')}; "
            f"{round(100 * right / parts)} % of the questions right at the first try"
            + (f"; {progress.streak} days in a row." if progress.streak > 1 else ".")
        ),
    )
    yield _headed("What you would get right today"), _shares(progress)
    yield _headed("Due"), words(_due(progress.due))
    yield (
        _headed("Day by day"),
        _days(progress.days[-_LINES:]),
        Text(""),
        _Calendar({day.day: day.answers for day in progress.days}),
    )
    if progress.mistakes:
        yield _headed("Your mistakes"), *_mistakes(progress.mistakes)


def _headed(text: str) -> RenderableType:
    return words((text, "bold"))


class _Rows(Struct, frozen=True):
    """Texts in columns, flush right in some of them, and shares as bars; in a narrow window a line for each row."""

    rows: tuple[tuple[str | float, ...], ...]
    right: frozenset[int]

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        if options.max_width < _NARROW:
            yield from (words(", ".join(cell for cell in row if isinstance(cell, str) and cell)) for row in self.rows)
            return
        table = Table.grid(padding=(0, 2))
        for place, cell in enumerate(self.rows[0] if self.rows else ()):
            # Where there is little room, the bars become shorter, and nothing else.
            is_bar = isinstance(cell, float)
            justify: Any = "right" if place in self.right else "left"
            table.add_column(justify=justify, no_wrap=not is_bar, max_width=_BAR if is_bar else None)
        for row in self.rows:
            table.add_row(*(words(cell) if isinstance(cell, str) else _bar(cell) for cell in row))
        yield table


def _bar(share: float) -> ProgressBar:
    return ProgressBar(total=1.0, completed=share, complete_style="green", finished_style="green")


def _shares(progress: Progress) -> _Rows:
    return _Rows(
        tuple(
            (each.name, float(each.mastery), f"{round(100 * each.mastery)} %", f"{each.seen}/{each.of} seen",
             "" if each.seconds is None else _time(each.seconds))
            for each in progress.shares
        ),
        frozenset((2, 3, 4)),
    )  # fmt: skip


def _days(days: Sequence[Day]) -> _Rows:
    written = "%a %d %b" if len({day.day.year for day in days}) == 1 else "%a %d %b %Y"
    return _Rows(
        tuple(
            (f"{day.day:{written}}", day.right / day.parts, f"{round(100 * day.right / day.parts)} %",
             counted(day.answers, "answer"), f"half within {_time(day.seconds)}")
            for day in days
        ),
        frozenset((2, 3, 4)),
    )  # fmt: skip


class _Calendar(Struct, frozen=True):
    """A line for each day of the week, a column for each week; the more answers, the darker."""

    answers: Mapping[date, int]

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        shades = _SHADES if options.encoding.startswith("utf") else _ASCII
        last = max(self.answers)
        monday = last - last.weekday() * DAY - 7 * (_WEEKS - 1) * DAY
        for weekday in range(7):
            days = (monday + (weekday + 7 * week) * DAY for week in range(_WEEKS))
            cells = (_shade(shades, self.answers.get(day, 0)) if day <= last else " " for day in days)
            yield Text(f"{monday + weekday * DAY:%a}  {' '.join(cells)}")


def _shade(shades: str, answers: int) -> str:
    return shades[0 if not answers else min(len(shades) - 1, 1 + answers * (len(shades) - 2) // _FULL)]


def _mistakes(mistakes: tuple[Mistake, ...]) -> Iterator[RenderableType]:
    yield _Rows(tuple((f"{each.times} ×", called(each.name), each.family) for each in mistakes), frozenset((0,)))
    yield words(("To drill one of them alone:", "dim"))
    for name in dict.fromkeys(each.name for each in mistakes[:_DRILLS]):
        yield Text(f"  rldrill quiz --mistake {name}", no_wrap=True)


def _due(due: tuple[int, ...]) -> str:
    now, tomorrow, *later = due
    if not any(due):
        return "Nothing in the next days; new problems wait."
    return f"{now} now, {tomorrow} more tomorrow, {sum(later)} more in the days after, up to a week."


def _time(seconds: float) -> str:
    return f"{round(seconds)} s" if seconds < 90 else f"{round(seconds / 60)} min"
