"""Three weeks before an exam, simulated: what a student knows on the day, drilled by the plan and at random.

    python benchmarks/students.py [SEEDS]

The student is not the scheduler's model of one. A skill (a family at a level) is unknown, or known with a stability in
days; a known one is remembered with the probability exp(−days/stability). Who does not know it guesses; who has seen
the working of what went wrong has learned it with the kind's probability, a third of that where the level below is not
remembered. Remembering makes a skill stabler, the more so the nearer it was to being forgotten; a skill that was
forgotten and is seen again keeps some of its stability. Problems take the minutes of their level, wrong ones a third
more. The outcome is the expected share of right answers on the day: in an exam that asks every skill alike, and in one
that mixes the levels as a quiz without a history does, which drilling at random does, too.
"""

import random
import statistics
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta
from math import exp

from rldrill.exam.expected import minutes
from rldrill.exam.selection import MIXED
from rldrill.history.attempts import Attempt
from rldrill.history.memory import Skill
from rldrill.problems.catalogue import topics
from rldrill.quiz.planning import Plan, skills

START = datetime(2026, 11, 27, 17, tzinfo=UTC)
DAYS = 21
GUESS, SLIP = 0.1, 0.05
#: What the exam asks: everything, or the families of three topics.
EVERYTHING = skills()
THREE_TOPICS = skills(
    family for topic in ("fundamentals", "bellman", "temporal_difference") for family in topics()[topic]
)
DAY = timedelta(days=1)


@dataclass(frozen=True)
class Kind:
    """How fast somebody learns, and forgets."""

    name: str
    learns: float
    stability: float
    gain: float


KINDS = (Kind("quick", 0.8, 5, 2.5), Kind("average", 0.6, 3, 2), Kind("forgetful", 0.5, 1.5, 1.5))


@dataclass
class Student:
    """What somebody knows: the stability of every skill that was learned, and when it was last seen."""

    kind: Kind
    rng: random.Random
    stability: dict[Skill, float] = field(default_factory=dict)
    seen: dict[Skill, datetime] = field(default_factory=dict)

    def remembers(self, skill: Skill, now: datetime) -> float:
        """The probability that it is remembered."""
        if skill not in self.stability:
            return 0.0
        return exp(-((now - self.seen[skill]) / DAY) / self.stability[skill])

    def answers(self, skill: Skill, now: datetime) -> bool:
        """Whether the answer is right; afterwards the working has been seen."""
        recall = self.remembers(skill, now)
        remembered = self.rng.random() < recall
        if remembered:
            self.stability[skill] *= 1 + self.kind.gain * (1 - recall) + 0.1
        elif skill in self.stability:
            self.stability[skill] = max(self.kind.stability, 0.6 * self.stability[skill])
        else:
            below = Skill(skill.family, skill.level - 1)
            ready = skill.level == 1 or self.rng.random() < self.remembers(below, now)
            if self.rng.random() < self.kind.learns * (1 if ready else 1 / 3):
                self.stability[skill] = self.kind.stability
        if skill in self.stability:
            self.seen[skill] = now
        return self.rng.random() < (1 - SLIP if remembered else GUESS)

    def score(self, weights: Mapping[Skill, int], day: datetime) -> float:
        """The expected share of right answers in an exam that asks skills in these proportions."""
        right = sum(
            weight * (GUESS + (1 - SLIP - GUESS) * self.remembers(skill, day)) for skill, weight in weights.items()
        )
        return right / sum(weights.values())


def took(skill: Skill, *, right: bool) -> float:
    """The minutes for a problem."""
    return minutes()[skill.family][skill.level - 1] * (1 if right else 4 / 3)


Next = Callable[[list[Attempt], datetime], Skill]
#: From the log, the time and chance to what chooses on one day.
Chooser = Callable[[list[Attempt], datetime, random.Random], Next]


def drilled(kind: Kind, seed: int, order: Sequence[Skill], budget: float, chooser: Chooser) -> tuple[float, float]:
    """The scores of a student who drills so many minutes a day: every skill alike, and levels mixed."""
    rng = random.Random(f"{kind.name} {seed}")
    student, log = Student(kind, rng), list[Attempt]()
    for day in range(DAYS):
        now, spent = START + day * DAY, 0.0
        following = chooser(log, now, rng)
        today: list[Attempt] = []
        while spent < budget:
            skill = following(today, now)
            right = student.answers(skill, now)
            spent += took(skill, right=right)
            now = START + day * DAY + timedelta(minutes=spent)
            name = f"{day}-{len(today)}"
            outcome, credit = ("right", 1.0) if right else ("wrong", 0.0)
            today.append(
                Attempt(name, now, name, skill.family, skill.level, 0, 1, "a", 1, "", outcome, (), 0, 0, 60.0, credit)
            )
        log += today
    alike, mixed = dict.fromkeys(order, 1), {skill: MIXED.count(skill.level) for skill in order}
    return student.score(alike, START + DAYS * DAY), student.score(mixed, START + DAYS * DAY)


def by_plan(order: Sequence[Skill], budget: float) -> Chooser:
    """What 'rldrill quiz --exam-date' does."""

    def chooser(log: list[Attempt], now: datetime, _: random.Random) -> Next:
        plan = Plan(order, log, max(1, round(budget / 4)), now, (START + DAYS * DAY).date())

        def following(today: list[Attempt], at: datetime) -> Skill:
            plan.learn(today)
            return plan.next(at)

        return following

    return chooser


def at_random(order: Sequence[Skill], _: float) -> Chooser:
    """Any family at any level, levels mixed as in a quiz without a history."""
    families = sorted({skill.family for skill in order})

    def chooser(_log: list[Attempt], _now: datetime, rng: random.Random) -> Next:
        def following(_today: list[Attempt], _at: datetime) -> Skill:
            family = rng.choice(families)
            return Skill(family, min(rng.choice(MIXED), len(minutes()[family])))

        return following

    return chooser


def main() -> None:
    """Print the table."""
    seeds = int(sys.argv[1]) if sys.argv[1:] else 20
    print(f"{'exam':12} {'levels':6} {'student':10} {'min/day':>7}  {'by plan':>14}  {'at random':>14}  better in")
    for asked, order in (("everything", EVERYTHING), ("three topics", THREE_TOPICS)):
        for budget in (30, 60):
            for kind in KINDS:
                scores = [
                    [drilled(kind, seed, order, budget, way(order, budget)) for seed in range(seeds)]
                    for way in (by_plan, at_random)
                ]
                for measure, levels in enumerate(("alike", "mixed")):
                    plan, chance = ([score[measure] for score in each] for each in scores)
                    better = sum(one > other for one, other in zip(plan, chance, strict=True))
                    told = [f"{statistics.mean(each):6.1%} ± {statistics.stdev(each):4.1%}" for each in (plan, chance)]
                    case = f"{asked:12} {levels:6} {kind.name:10} {budget:7}"
                    print(f"{case}  {told[0]:>14}  {told[1]:>14}  {better} of {seeds}")


if __name__ == "__main__":
    main()
