"""Drilling one mistake: problems in which it gives a wrong answer, of the skills at which somebody made it."""

import difflib
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache

from msgspec import Struct

from rldrill.exam.selection import MAX_DRAWN
from rldrill.exercise import Exercise, draw
from rldrill.history.attempts import Attempt
from rldrill.history.memory import Skill
from rldrill.problems.catalogue import chosen, selection
from rldrill.problems.draws import Draws
from rldrill.problems.errors import UsageError
from rldrill.quiz.mistakes import called
from rldrill.quiz.planning import skills
from rldrill.solutions.diagnosis import weights
from rldrill.solutions.diagnosis.clock import Clock
from rldrill.solutions.sheet import formulas
from rldrill.solutions.solution import solver

#: What the diagnosis finds in any family, beside the mistakes that families list.
_IN_STEPS = frozenset().union(weights.IDEAS, weights.VALUES, weights.INSIDE)
_KINDS = _IN_STEPS.union(weights.PROCEDURE, weights.ANSWERS)
#: So many problems of a skill are drawn in search of one in which the mistake can be made; then it is given up.
_TRIES = 8
#: So many seconds at most are spent on what can be done wrongly in a part, where the mistake is none that is listed; it
#: is looked at what has been found every so often.
_SEARCH, _STEP = 2.0, 0.1


class Drill(Struct, frozen=True):
    """One mistake to be drilled.

    Args:
        name: its name in the history.
        skills: where it is asked for, in this order, round and round.
        made: how often it was made there.
    """

    name: str
    skills: tuple[Skill, ...]
    made: int

    def says(self) -> str:
        """One line: what is drilled, and what the problems have to do with it."""
        times = {0: "not made so far", 1: "made once so far"}.get(self.made, f"made {self.made} times so far")
        return f"Only “{called(self.name)}”, {times}: in every problem it would give a wrong answer."

    def exercises(self, seed: int) -> Iterator[Exercise]:
        """Problems in which the mistake gives a wrong answer, without end.

        Raises:
            UsageError: there are none.
        """
        numbers, left, found = Draws(f"mistake {self.name} {seed}"), list(self.skills), False
        while left:
            for skill in tuple(left):
                drawn = (draw(skill.family, skill.level, numbers.below(MAX_DRAWN)) for _ in range(_TRIES))
                exercise = next((each for each in drawn if _can_be_made(self.name, each)), None)
                if exercise is None:
                    left.remove(skill)
                else:
                    found = True
                    yield exercise
        if not found:
            raise UsageError(
                f"No problem was found in which “{called(self.name)}” gives a wrong answer; drill another."
            )


def drill(text: str, attempts: Sequence[Attempt], names: Sequence[str] = (), level: int | None = None) -> Drill:
    """The drill of a mistake: of the skills at which it was made, the most often first; else of all that know it.

    Args:
        text: its name in the history, or what it is called.
        attempts: the history.
        names: topics and families; all, if none.
        level: the level; all, if none.

    Raises:
        UsageError: there is no such mistake, or none of these.
    """
    listed, wanted = _listed(), chosen(tuple(names))
    everywhere = _KINDS | _stated().difference(*listed.values())  # no family lists these
    name = _named(text, everywhere.union(*listed.values()))
    own = {each.family for each in attempts if name in each.misconceptions}
    knowing = {family for family in wanted if name in everywhere or name in listed[family] or family in own}
    known = [skill for skill in skills(knowing) if level in (None, skill.level)]
    known.sort(key=lambda skill: name not in listed[skill.family])
    if not known:
        others = [family for family, mistakes in listed.items() if name in mistakes][:4]
        at = "" if level is None else f" of level {level}"
        cure = f"drill it in {', '.join(others)}" if others else "leave the level out"
        raise UsageError(f"“{called(name)}” is no mistake of these problems{at}; {cure}.")
    made = Counter(Skill(each.family, each.level or 0) for each in attempts if name in each.misconceptions)
    most = sorted((skill for skill in known if skill in made), key=lambda skill: -made[skill])
    return Drill(name, tuple(most or known), sum(made[skill] for skill in known))


@cache
def _listed() -> Mapping[str, frozenset[str]]:
    """For every family the names of its mistakes."""
    return {
        family.name: frozenset(mistake.name for mistake in solver(family).misconceptions) for family in selection(())
    }


def _stated() -> frozenset[str]:
    """The names of the mistakes that are stated beside formulas, whether a family lists them or not."""
    return frozenset(mistake.name for formula in formulas().values() for mistake in formula.misread)


def _named(text: str, names: Iterable[str]) -> str:
    """The mistake of that name, or called so."""
    wanted = _plain(text)
    known = {_plain(spelling): name for name in sorted(names) for spelling in (called(name), name)}
    if wanted in known:
        return known[wanted]
    near = [known[each] for each in difflib.get_close_matches(wanted, known, n=3, cutoff=0.5)]
    meant = f" Did you mean {' or '.join(dict.fromkeys(near))}?" if near else ""
    raise UsageError(f"There is no mistake called {text[:40]!r}.{meant} 'rldrill stats' has the names of yours.")


def _plain(text: str) -> str:
    return "-".join(text.lower().replace("“", "").replace("”", "").replace("-", " ").replace("_", " ").split())


def _can_be_made(name: str, exercise: Exercise) -> bool:
    """Whether a mistake gives a wrong answer here; what a family lists does wherever it applies, by how it draws."""
    solution = exercise.solution
    if any(mistake.name == name for mistake, _ in solution.mistakes):
        return True
    stated = exercise.diagnosing.search({}).stated()  # beside a formula that is read here, though not in the list
    made = (each.answers for each in stated if each.cause.mistake and each.cause.mistake.name == name)
    if any(map(solution.tells_apart, made)):
        return True
    return name in _KINDS and any(_spoils(name, exercise, part.label) for part in exercise.parts)


def _spoils(kind: str, exercise: Exercise, label: str) -> bool:
    outcomes = exercise.diagnosing.outcomes(label, {})
    clock, finished = Clock(_SEARCH), False
    while not finished and not clock.over:
        finished = outcomes.grow(Clock(_STEP))
        causes = (outcome.cause for outcome in outcomes.single.every if outcome.cause.kind == kind)
        # Any number can be written down wrongly; what is made in a step has a formula or an application.
        if any(kind not in _IN_STEPS or cause.edit is not None or cause.application is not None for cause in causes):
            return True
    return False
