"""What the log says of somebody's progress: what is mastered, what is due, what goes wrong, day by day."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from datetime import date, datetime, timedelta
from statistics import median
from typing import Any

from msgspec import Struct
from msgspec.structs import asdict

from rldrill.history.attempts import Attempt
from rldrill.history.memory import Memory, Skill, remembered

DAY = timedelta(days=1)
#: So many days ahead are told what is due.
AHEAD = 7
#: So many mistakes are told.
_MISTAKES = 8


class Share(Struct, frozen=True):
    """How a topic or a family goes.

    Args:
        name: its name.
        mastery: how much of its skills would be right now, 0 to 1; a skill that was never asked counts 0.
        seen: how many of its skills were asked, of ``of``.
        answers: how many answers were given.
        right: how many of the parts were right at the first try and without a hint, of ``parts``.
        seconds: the median time of an answer; None without answers.
    """

    name: str
    mastery: float
    seen: int
    of: int
    answers: int
    right: int
    parts: int
    seconds: float | None


class Day(Struct, frozen=True):
    """The answers of one day, in the local time of the log's reader."""

    day: date
    answers: int
    right: int
    parts: int
    seconds: float


class Mistake(Struct, frozen=True):
    """A mistake that was made, in which family, and how often."""

    name: str
    family: str
    times: int


class Progress(Struct, frozen=True):
    """All of it.

    Args:
        shares: how every topic goes, or every family.
        days: the days with answers, the oldest first.
        due: how many skills are due now, and how many more on each of the next days.
        mistakes: the mistakes made most.
        streak: how many days in a row had answers, up to today or yesterday.
    """

    shares: tuple[Share, ...]
    days: tuple[Day, ...]
    due: tuple[int, ...]
    mistakes: tuple[Mistake, ...]
    streak: int

    @property
    def answers(self) -> int:
        """How many answers there are."""
        return sum(day.answers for day in self.days)

    def to_json(self) -> dict[str, Any]:
        """The progress as JSON has it."""
        return {
            "format": 1,
            "answers": self.answers,
            "streak": self.streak,
            "shares": [asdict(each) | {"mastery": round(each.mastery, 4)} for each in self.shares],
            "days": [asdict(each) | {"day": each.day.isoformat()} for each in self.days],
            "due": list(self.due),
            "mistakes": list(map(asdict, self.mistakes)),
        }


def progress(attempts: Sequence[Attempt], groups: Mapping[str, Sequence[Skill]], now: datetime) -> Progress:
    """Work out the progress from the log.

    Args:
        attempts: the log; only attempts at skills of the groups count.
        groups: the skills by what they are shown under: a topic or a family.
        now: the time, in the zone in which days are told.
    """
    memories = remembered(attempts)
    families = {skill.family for skills in groups.values() for skill in skills}
    counted = [attempt for attempt in attempts if attempt.family in families]
    known = {skill for skills in groups.values() for skill in skills}
    return Progress(
        shares=tuple(_share(name, skills, counted, memories, now) for name, skills in groups.items()),
        days=tuple(_days(counted, now)),
        due=_due({skill: memory for skill, memory in memories.items() if skill in known}, now),
        mistakes=tuple(_mistakes(counted)),
        streak=_streak({_day(attempt, now) for attempt in counted}, now.date()),
    )


def _share(
    name: str, skills: Sequence[Skill], attempts: Iterable[Attempt], memories: Mapping[Skill, Memory], now: datetime
) -> Share:
    families = {skill.family for skill in skills}
    own = [attempt for attempt in attempts if attempt.family in families]
    recalls = [memories[skill].recall(now) if skill in memories else 0.0 for skill in skills]
    return Share(
        name=name,
        mastery=sum(recalls) / len(recalls),
        seen=sum(skill in memories for skill in skills),
        of=len(skills),
        answers=len(own),
        right=sum(attempt.first_time for attempt in own),
        parts=_parts(own),
        seconds=median(attempt.seconds for attempt in own) if own else None,
    )


def _days(attempts: Iterable[Attempt], now: datetime) -> Iterable[Day]:
    by_day: dict[date, list[Attempt]] = {}
    for attempt in attempts:
        by_day.setdefault(_day(attempt, now), []).append(attempt)
    for day, own in sorted(by_day.items()):
        right = sum(attempt.first_time for attempt in own)
        yield Day(day, len(own), right, _parts(own), median(attempt.seconds for attempt in own))


def _due(memories: Mapping[Skill, Memory], now: datetime) -> tuple[int, ...]:
    ahead = Counter(
        max(0, (memory.due.astimezone(now.tzinfo).date() - now.date()).days) for memory in memories.values()
    )
    return tuple(ahead[days] for days in range(AHEAD + 1))


def _mistakes(attempts: Iterable[Attempt]) -> Iterable[Mistake]:
    made = Counter((attempt.misconceptions[0], attempt.family) for attempt in attempts if attempt.misconceptions)
    for (name, family), times in made.most_common(_MISTAKES):
        yield Mistake(name, family, times)


def _streak(days: set[date], today: date) -> int:
    last = today if today in days else today - DAY
    length = 0
    while last - length * DAY in days:
        length += 1
    return length


def _parts(attempts: Iterable[Attempt]) -> int:
    return len({(attempt.sitting, attempt.part) for attempt in attempts})


def _day(attempt: Attempt, now: datetime) -> date:
    return attempt.time.astimezone(now.tzinfo).date()
