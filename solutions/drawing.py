"""Drawing a problem that is a good exam question, with its solution."""

from collections import Counter
from collections.abc import Iterator
from contextlib import nullcontext

from pydantic import ValidationError

from rldrill.problems.catalogue import OWN
from rldrill.problems.catalogue import family as family_of
from rldrill.problems.complaints import sentence
from rldrill.problems.draws import Draws
from rldrill.problems.errors import BrokenFamily, UsageError
from rldrill.problems.family import Family, Givens, Problem, trusted
from rldrill.problems.identity import MAX_SEED, Identity, split_id
from rldrill.solutions.exact import NoSolution, digits, is_zero, parameters
from rldrill.solutions.formula.elimination import largest
from rldrill.solutions.solution import Solution, solve
from rldrill.solutions.work import Elimination

ATTEMPTS = 2000
#: The most digits, above and below the line together, that an answer may have at each level.
MOST_DIGITS = {1: 4, 2: 7, 3: 9}

#: The largest whole number that a linear system is solved with at each level: denominators are cleared there.
MOST_ELIMINATED = {1: 300, 2: 300}


def draw(family: Family | str, level: int = 1, seed: int = 0) -> Solution:
    """Draw a problem and solve it; the same arguments give the same problem, to the letter.

    Raises:
        BrokenFamily: its draws are refused, by its own givens or as questions.
        UsageError: there is no such family or level, or the seed is out of range.
    """
    if isinstance(family, str):
        family = family_of(family)
    if level not in family.levels:
        raise UsageError(f"{family.name} has no level {level}; it has {', '.join(map(str, family.levels))}.")
    if not 0 <= seed < MAX_SEED:
        raise UsageError(f"The seed is out of range; take a whole number from 0 to {MAX_SEED - 1}.")
    identity = Identity(family.name, level, seed, family.revision)
    why: Counter[str] = Counter()
    for attempt in range(ATTEMPTS):
        given = _drawn(family, level, Draws(f"{identity}#{attempt}"))
        try:
            solution = solve(Problem(family, given, identity), attempt + 1)
        except NoSolution as error:
            why[str(error)] += 1
            continue
        flaw = next(flaws(solution), None)
        if flaw is None:
            return solution
        why[flaw] += 1
    reasons = "; ".join(f"{count} × {reason}" for reason, count in why.most_common(3))
    raise BrokenFamily(
        f"{identity}: none of {ATTEMPTS} draws is a good question ({reasons}); draw otherwise, or say with 'when=' for "
        "which givens a mistake can be made."
    )


def _drawn(family: Family, level: int, rng: Draws) -> Givens:
    try:
        with trusted() if family.package == OWN else nullcontext():  # the tests read our own draws as files are read
            return family.draw(level, rng)
    except ValidationError as error:
        said = sentence(error, family.schema(), family=family.name, tagged=False)
        raise BrokenFamily(
            f"{family.name}: 'draw' makes givens of level {level} that 'Given' refuses: {said}"
        ) from None


def by_id(text: str) -> Solution:
    """The problem with that ID, and its solution.

    Raises:
        UsageError: it is not an ID, or of a family or revision that does not exist.
    """
    name, level, seed, revision = split_id(text)
    family = family_of(name)
    if revision is not None and revision != family.revision:
        raise UsageError(
            f"{text} is of revision {revision}, but {name} is at revision {family.revision} in this release "
            "and draws other problems; install the release that printed it."
        )
    return draw(family, level, seed)


def flaws(solution: Solution) -> Iterator[str]:
    """What keeps a problem from being a good exam question, cheapest check first."""
    level = solution.problem.level or max(MOST_DIGITS)
    for part in solution.problem.parts:
        cells = solution.cells[part.label]
        numbers = [content for content in cells.values() if not isinstance(content, tuple)]
        if any(digits(number) > MOST_DIGITS[level] for number in numbers):
            yield f"({part.label}) has more digits than a person can handle"
        if numbers and solution.problem.parameters and not any(map(parameters, numbers)):
            yield f"({part.label}) does not depend on what is left open"
        if numbers and not part.zero and all(map(is_zero, numbers)):
            yield f"({part.label}) is zero"
        if not part.ties and any(isinstance(content, tuple) and len(content) > 1 for content in cells.values()):
            yield f"({part.label}) has tied best actions"
    if level in MOST_ELIMINATED and _eliminated(solution) > MOST_ELIMINATED[level]:
        yield "a linear system is solved with numbers that are too large"
    for misconception in solution.applicable:
        if solution.hides(misconception):
            yield f"{misconception.name} gives the right answer"


def _eliminated(solution: Solution) -> int:
    """The largest whole number, above a line or below it, with which linear systems are solved."""
    return max((largest(line.equations) for line in solution.lines if isinstance(line, Elimination)), default=0)
