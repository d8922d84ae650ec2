"""What to ask next: what is about to be forgotten, and something new, topics mixed, levels as they are earned."""

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from datetime import date, datetime, time
from fractions import Fraction
from itertools import takewhile

from rldrill.exam.expected import minutes
from rldrill.history.attempts import Attempt
from rldrill.history.memory import Memory, Skill, remembered
from rldrill.history.progress import DAY
from rldrill.problems.catalogue import headers, topics
from rldrill.problems.document import counted
from rldrill.problems.errors import UsageError
from rldrill.quiz.mistakes import called

#: A level comes as many topics later as this than the one below.
_TOPICS_A_LEVEL = 3
#: Within so many topics new skills are mixed, and among so many due ones.
_MIXED_TOPICS, _MIXED_DUE = 1, 3
#: At least one problem in so many is new, while anything is.
_NEW_ONE_IN = 5
#: In so many days before the exam everything is seen once more.
_LAST_DAYS = 7


def skills(families: Iterable[str] | None = None) -> tuple[Skill, ...]:
    """The skills of these families, or of all, in the order in which they are learned.

    Topic by topic as on the sheet, the quickest families first, the higher levels some topics later. How long the
    families of another package take is not known: they come last in their topic.
    """
    wanted = None if families is None else set(families)
    keyed = [
        ((number + _TOPICS_A_LEVEL * (level - 1), number, _quickest(family), family), Skill(family, level))
        for number, names in enumerate(topics().values())
        for family in names
        if wanted is None or family in wanted
        for level in _levels(family)
    ]
    return tuple(skill for _, skill in sorted(keyed))


def _quickest(family: str) -> float:
    return minutes()[family][0] if family in minutes() else math.inf


def _levels(family: str) -> Iterable[int]:
    return range(1, len(minutes()[family]) + 1) if family in minutes() else headers((family,))[0].levels


class Plan:
    """Chooses one skill after the other.

    Args:
        order: the skills, in the order in which they are learned.
        attempts: the history.
        number: about how many problems there will be today.
        now: the time, in the zone in which days are told.
        exam: the day of the exam, if there is one.

    Raises:
        UsageError: the exam is over.
    """

    def __init__(
        self,
        order: Sequence[Skill],
        attempts: Sequence[Attempt],
        number: int,
        now: datetime,
        exam: date | None = None,
    ) -> None:
        if exam is not None and exam <= now.date():
            raise UsageError(f"The exam of {exam} is not ahead; --exam-date takes a day that is.")
        self._order = tuple(order)
        self._place = {skill: place for place, skill in enumerate(order)}
        self._topic = {family: topic for topic, names in topics().items() for family in names}
        self._before = remembered(attempts)
        self.memories: Mapping[Skill, Memory] = self._before
        self._attempts = attempts
        self._exam = None if exam is None else datetime.combine(exam, time(), now.tzinfo)
        self._asked: list[Skill] = []
        self._new = 0
        self._number = number
        self._begin = now
        self._share = Fraction(self._new_today(now), number)

    def learn(self, attempts: Sequence[Attempt]) -> None:
        """Take into account what was answered since the plan was made."""
        self.memories = remembered(attempts, self._before)

    def due_at(self, skill: Skill) -> datetime:
        """When a skill is to be asked again: when FSRS says so, but in any case once more before the exam."""
        memory = self.memories[skill]
        if self._exam is None:
            return memory.due
        left = (self._exam - memory.last) // DAY
        days = max(1, min(_LAST_DAYS, left // 2))
        latest = self._exam - DAY * (1 + self._place[skill] % days)
        if memory.last < latest:
            return min(memory.due, latest)
        return min(memory.due, memory.last + DAY) if len(memory.ratings) == 1 else memory.due

    def due(self, now: datetime) -> list[Skill]:
        """What is due, the least remembered first; before what went wrong twice comes the level below."""
        late = [skill for skill in self._order if skill in self.memories and self.due_at(skill) <= now]
        late.sort(key=lambda skill: self.memories[skill].recall(now))
        return list(dict.fromkeys(map(self._within_reach, late)))

    def again(self, skill: Skill, now: datetime) -> str:
        """When a skill that was answered is asked again: tomorrow, in 4 days."""
        days = math.ceil((self.due_at(skill) - now) / DAY)
        return f"in {days} days" if days > 1 else "tomorrow"

    def _within_reach(self, skill: Skill) -> Skill:
        memory, below = self.memories.get(skill), Skill(skill.family, skill.level - 1)
        if memory is None or memory.lapses < 2 or below not in self._place:
            return skill
        easier = self.memories.get(below)
        return skill if easier is not None and easier.last > memory.last else self._within_reach(below)

    def new(self) -> list[Skill]:
        """What was never asked and may be: level 1, and what is above a level that went well."""
        return [
            skill
            for skill in self._order
            if skill not in self.memories and (skill.level == 1 or self._is_mastered(skill.family, skill.level - 1))
        ]

    def _is_mastered(self, family: str, level: int) -> bool:
        below = Skill(family, level)
        # Where only higher levels are asked for, nothing is below.
        return below not in self._place or (below in self.memories and self.memories[below].mastered)

    def _new_today(self, now: datetime) -> int:
        rest = self._number - len(self.due(now))
        wanted = max(rest, self._number // _NEW_ONE_IN)
        if self._exam is not None:
            unseen = sum(skill not in self.memories for skill in self._order)
            days = max(1, (self._exam - now) // DAY - _LAST_DAYS)
            wanted = max(wanted, min(math.ceil(unseen / days), self._number // 2))
        return wanted

    def next(self, now: datetime) -> Skill:
        """The skill to ask now."""
        due = [skill for skill in self.due(now) if skill not in self._asked[-1:]]
        new = [skill for skill in self.new() if skill not in self._asked]
        if new and (not due or self._new < math.floor(self._share * (len(self._asked) + 1))):
            chosen = self._mixed(self._near(new))
            self._new += 1
        elif due:
            chosen = self._mixed(due[:_MIXED_DUE])
        else:
            chosen = self._least_remembered(now)
        self._asked.append(chosen)
        return chosen

    def _near(self, new: Sequence[Skill]) -> list[Skill]:
        """Of new skills those that stand together in the order."""
        limit = self._wave(new[0]) + _MIXED_TOPICS
        return list(takewhile(lambda skill: self._wave(skill) <= limit, new))

    def _wave(self, skill: Skill) -> int:
        return list(topics()).index(self._topic[skill.family]) + _TOPICS_A_LEVEL * (skill.level - 1)

    def _mixed(self, candidates: Sequence[Skill]) -> Skill:
        """The first that is of another topic than the last one asked."""
        last = self._topic[self._asked[-1].family] if self._asked else None
        return next((skill for skill in candidates if self._topic[skill.family] != last), candidates[0])

    def _least_remembered(self, now: datetime) -> Skill:
        """What there is to do when nothing is due and nothing is new."""
        known = [skill for skill in self._order if skill in self.memories and skill not in self._asked[-1:]]
        return min(known, key=lambda skill: self.memories[skill].recall(now), default=self._order[0])

    def says(self, *, kept: bool = True) -> str:
        """One line: how much is due and new, and why the first problem is asked; ``kept`` is what will be answered."""
        now = self._begin
        ahead = "" if self._exam is None else f"; {counted((self._exam.date() - now.date()).days, 'day')} to the exam"
        if not self._attempts:
            several = len({self._topic[skill.family] for skill in self._order}) > 1
            of_topics = " of the first topics" if several else ""
            asked = f"{self._number} problems, easy ones{of_topics} before others{ahead}."
            if self._number == 1:
                asked = f"an easy problem{ahead}."
            if not kept:
                return f"What you answered before is not known: {asked}"
            return f"Your first quiz: {asked} What you answer is kept, and decides what comes next."
        due, first = len(self.due(now)), self._peek(now)
        fresh = min(len(self.new()), round(self._share * self._number))
        counts = f"{min(due, self._number - fresh)} due, {fresh} new" if due else f"nothing due, {fresh} new"
        if due > self._number - fresh:
            counts += f" (of {due} that are due)"
        return f"{counts}{ahead}; first {first}, {self._why(first, now)}."

    def _peek(self, now: datetime) -> Skill:
        asked, new = list(self._asked), self._new
        first = self.next(now)
        self._asked, self._new = asked, new
        return first

    def _why(self, skill: Skill, now: datetime) -> str:
        memory = self.memories.get(skill)
        mistakes = Counter(
            name
            for attempt in self._attempts
            if attempt.family == skill.family and now - attempt.time < 30 * DAY
            for name in attempt.misconceptions[:1]
        )
        if memory is None:
            above = skill.level == 1 or Skill(skill.family, skill.level - 1) not in self.memories
            return "which is new" if above else "because the level below went well"
        if mistakes:
            name, times = mistakes.most_common(1)[0]
            return f"because of “{called(name)}”, {_times(times)}"
        if memory.lapses:
            return "because it went wrong the last time"
        days = (now - memory.last) // DAY
        return f"because you saw it {_days(days)}"


def _times(number: int) -> str:
    return {1: "once", 2: "twice"}.get(number, f"{number} times")


def _days(number: int) -> str:
    return {0: "earlier today", 1: "a day ago"}.get(number, f"{number} days ago")
