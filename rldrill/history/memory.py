"""What somebody remembers of every skill, worked out from the log by FSRS."""

from collections.abc import Iterable, Iterator, Mapping
from datetime import datetime, timedelta

from fsrs import Card, Rating, Scheduler
from msgspec import Struct

from rldrill.history.attempts import Attempt

#: What is new or went wrong is asked again on the next day: a problem takes minutes, and so soon after its working a
#: right answer shows little (``benchmarks/students.py`` measures what it brings on the day of an exam).
_NEXT_DAY = (timedelta(hours=12),)
_SCHEDULER = Scheduler(learning_steps=_NEXT_DAY, relearning_steps=_NEXT_DAY, enable_fuzzing=False)


class Skill(Struct, frozen=True, order=True):
    """What is remembered or forgotten: a family at a level, whatever the numbers."""

    family: str
    level: int

    def __str__(self) -> str:
        return f"{self.family}, level {self.level}"


class Memory(Struct, frozen=True):
    """How well a skill is remembered.

    Args:
        card: FSRS's account of it; nothing changes it.
        ratings: how every review went.
        last: when the last one was.
    """

    card: Card
    ratings: tuple[Rating, ...]
    last: datetime

    @property
    def due(self) -> datetime:
        """When it is to be asked again."""
        return self.card.due

    @property
    def lapses(self) -> int:
        """How many times in a row it went wrong now."""
        wrong = 0
        while wrong < len(self.ratings) and self.ratings[-1 - wrong] is Rating.Again:
            wrong += 1
        return wrong

    @property
    def mastered(self) -> bool:
        """Whether it went well the last time, without help."""
        return self.ratings[-1] in (Rating.Good, Rating.Easy)

    def recall(self, now: datetime) -> float:
        """How probable it is that it would be right now, 0 to 1."""
        return 0.0 if self.lapses else _SCHEDULER.get_card_retrievability(self.card, now)


def rated(sitting: Iterable[Attempt]) -> Rating | None:
    """How one problem went: wrong, given up or seen before is Again, a hint or a second try Hard, right Good.

    None where it was left in the middle and all was right so far.
    """
    ends = {}
    helped = False
    for attempt in sorted(sitting, key=lambda attempt: attempt.retries):  # a clock may have been set back meanwhile
        ends[attempt.part] = attempt
        helped = helped or bool(attempt.hints or attempt.retries)
    if not all(end.right for end in ends.values()):
        return Rating.Again
    if helped:
        return Rating.Hard
    complete = all(len(ends) == end.parts for end in ends.values())
    return Rating.Good if complete else None


def remembered(attempts: Iterable[Attempt], before: Mapping[Skill, Memory] | None = None) -> dict[Skill, Memory]:
    """What is remembered after these attempts, each problem a review at the time of its last attempt."""
    memories = dict(before or {})
    for skill, when, rating in sorted(_reviews(attempts), key=lambda review: review[1]):
        old = memories.get(skill)
        card, _ = _SCHEDULER.review_card(old.card if old else Card(card_id=0, due=when), rating, when)
        memories[skill] = Memory(card, (*(old.ratings if old else ()), rating), when)
    return memories


def _reviews(attempts: Iterable[Attempt]) -> Iterator[tuple[Skill, datetime, Rating]]:
    sittings: dict[tuple[str, Skill], list[Attempt]] = {}
    for attempt in sorted(attempts, key=lambda attempt: attempt.time):
        if attempt.level is not None:
            sittings.setdefault((attempt.sitting, Skill(attempt.family, attempt.level)), []).append(attempt)
    for (_, skill), sitting in sittings.items():
        if (rating := rated(sitting)) is not None:
            yield skill, sitting[-1].time, rating
