"""Apprenticeship learning by projection: projected points, the weights of the next reward, and what is left."""

from collections.abc import Sequence
from math import gcd, isqrt
from typing import Annotated, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, dot, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.feature_vectors import check_lengths
from rldrill.problems.features import FeatureVector
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Name
from rldrill.problems.names import once, read_name
from rldrill.problems.parts import Choice, Number, Numbers, Part, YesNo, label

TITLE = "Apprenticeship learning"
SOURCE = "Abbeel & Ng 2004, section 3.1"
REVISION = 8

Mu = tuple[Fraction, ...]


class Given(Givens):
    """The expert's feature expectations, those of the first policy, and those of the policies after it."""

    expert: FeatureVector = Field(description="The expert's feature expectations.")
    first: FeatureVector = Field(description="The feature expectations of the first policy.")
    policies: tuple[FeatureVector, ...] = Field(
        min_length=1, max_length=8, description="The feature expectations of the policies after it, in their order."
    )

    tolerance: Exact | None = Field(
        default=None, gt=0, description="The distance at which the algorithm stops; asks whether it does."
    )
    candidates: Annotated[dict[Name, FeatureVector], Field(min_length=2, max_length=8), once(read_name)] | None = Field(
        default=None,
        description="Policies of which the best for the last weights comes next; asks for it, and projects.",
    )
    projected: bool = Field(
        default=True,
        exclude_if=lambda projected: projected,
        description="Whether it is projected onto the line to the candidate that comes next, too.",
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        later = {f"policy {number}": mu for number, mu in enumerate(self.policies, 1)}
        check_lengths({"expert": self.expert, "first": self.first} | later | (self.candidates or {}))
        point = self.first
        for number, mu in enumerate(self.policies, 1):
            if mu == point:
                raise ValueError(
                    f"policies[{number}]: this is where the projection stands before it, so there is no line through "
                    "both; change it"
                )
            along, far = _shares(point, mu, self.expert)
            point = tuple(here + along / far * (there - here) for here, there in zip(point, mu, strict=True))
        return self


#: The denominator and the numerator of the share of the way that a projection goes.
_SHARES = ((2, 1), (3, 1), (3, 2), (4, 1), (4, 3), (5, 2), (5, 3))


def draw(level: int, rng: Draws) -> Given:
    """One projection; of three features, whether it stops then, or which policy is next; then that one's projection."""
    if level == 3:
        return _two_steps(rng)
    kind = "plain" if level == 1 else rng.choice(("three", "stops", "three stops", "next"))
    size = 3 if "three" in kind else 2
    way, (whole, share) = _direction(rng, size), rng.choice(_SHARES)
    rest = _across(rng, way)
    far = dot(rest, rest)
    if not 0 < far <= share * (whole - share) * dot(way, way):  # the policy would be worse than the expert
        return draw(level, rng)
    if max(share, whole - share) ** 2 * dot(way, way) + far > _FARTHEST:
        return draw(level, rng)
    aim = _sum(_scaled(share, way), rest)
    if 0 in aim:  # the expert has as much of a feature as the first policy, and its gap is 0
        return draw(level, rng)
    points = [(Fraction(0),) * size, _scaled(whole, way), aim]
    if kind == "next":
        return _next(rng, points, rest)
    first, policy, expert = _placed(rng, points)
    given = Given(expert=expert, first=first, policies=(policy,))
    return given.model_copy(update={"tolerance": _limit(rng, far)}) if "stops" in kind else given


def _next(rng: Draws, points: Sequence[Mu], weights: Mu) -> Given:
    """Three policies to choose from, of which the weights after the projection tell the best."""
    while True:
        candidates = [tuple(rng.whole(int(x) - 4, int(x) + 4) for x in points[-1]) for _ in range(3)]
        if len({dot(weights, candidate) for candidate in candidates}) == len(candidates):
            break
    first, policy, expert, *placed = _placed(rng, [*points, *candidates])
    named = dict(zip("ABC", placed, strict=True))
    return Given(expert=expert, first=first, policies=(policy,), candidates=named, projected=False)


#: The largest square of a distance from the expert.
_FARTHEST = 100


def _limit(rng: Draws, far: Fraction) -> Fraction:
    """A number at or above the root of a square, or one below it, as often the one as the other."""
    root = isqrt(int(far))
    if rng.chance(Fraction(1, 2)):
        return Fraction(root if root * root == far else root + 1)
    below = root - 1 if root * root == far else root
    return Fraction(below) if below else Fraction(1, 2)


def _two_steps(rng: Draws) -> Given:
    """Two projections in the plane; the second policy is the best of some for the weights after the first."""
    second, (whole, share) = _direction(rng, 2), rng.choice(_SHARES)
    turn = rng.nonzero(-2, 2)
    weights = _sum(_scaled(share, second), _scaled(turn, (-second[1], second[0])))
    common = gcd(*map(int, weights))
    way = (weights[1] / (common or 1), -weights[0] / (common or 1))
    whole_1, share_1 = rng.choice(_SHARES)
    if turn**2 > share * (whole - share) or 0 in weights or common**2 > share_1 * (whole_1 - share_1):
        return _two_steps(rng)
    foot = _scaled(share_1, way)
    best = _sum(foot, _scaled(whole, second))
    others = [tuple(rng.whole(int(x) - 4, int(x) + 4) for x in best) for _ in range(2)]
    if any(dot(weights, other) >= dot(weights, best) for other in others) or len({best, *others}) <= len(others):
        return _two_steps(rng)
    points = [(Fraction(0),) * 2, _scaled(whole_1, way), _sum(foot, weights)]
    if rng.chance(Fraction(2, 3)):
        first, policy, expert, *candidates = _placed(rng, [*points, *rng.shuffled([best, *others])])
        given = Given(
            expert=expert, first=first, policies=(policy,), candidates=dict(zip("ABC", candidates, strict=True))
        )
    else:
        first, policy, expert, following = _placed(rng, [*points, best])
        given = Given(expert=expert, first=first, policies=(policy, following))
    left = turn**2 * dot(second, second)
    return given.model_copy(update={"tolerance": _limit(rng, left)}) if rng.chance(Fraction(1, 2)) else given


def _placed(rng: Draws, points: Sequence[Mu]) -> list[Mu]:
    """Points moved to where no component is negative."""
    lows = [min(column) - rng.whole(0, 2) for column in zip(*points, strict=True)]
    return [tuple(value - low for value, low in zip(point, lows, strict=True)) for point in points]


def _direction(rng: Draws, size: int) -> Mu:
    return tuple(rng.nonzero(-2, 2) for _ in range(size))


def _across(rng: Draws, way: Mu) -> Mu:
    """A whole vector at right angles to a way."""
    if len(way) == 2:
        return _scaled(rng.nonzero(-2, 2), (-way[1], way[0]))
    while True:
        one, two = rng.whole(-2, 2), rng.whole(-2, 2)
        last = -(one * way[0] + two * way[1]) / way[2]
        if last.denominator == 1 and (one or two):
            return one, two, last


def _scaled(by: Fraction | int, vector: Mu) -> Mu:
    return tuple(by * value for value in vector)


def _sum(first: Mu, second: Mu) -> Mu:
    return tuple(one + two for one, two in zip(first, second, strict=True))


def _shares(point: Mu, mu: Mu, expert: Mu) -> tuple[Fraction, Fraction]:
    """The way to a policy times the way to the expert, and times itself; their quotient is where to project to."""
    way = [there - here for here, there in zip(point, mu, strict=True)]
    goal = [there - here for here, there in zip(point, expert, strict=True)]
    along = dot(way, goal)
    return along, dot(way, way)


def question(given: Given) -> Question:
    """The vectors; how far to go, then projection and weights policy by policy, then the distance left."""
    count, size = len(given.policies), len(given.expert)
    named = (("μ(π_E)", given.expert), *((f"μ(π_{{{n}}})", mu) for n, mu in enumerate((given.first, *given.policies))))
    blocks = (
        Paragraph(
            "Apprenticeship learning looks for a policy with the expert's feature expectations $μ(π_E)$. These are "
            "known:"
        ),
        Table(
            header=("", *(f"component ${index}$" for index in range(1, size + 1))),
            rows=tuple((f"${name}$", *(f"${shown(value)}$" for value in mu)) for name, mu in named),
        ),
        Paragraph(
            "The projection method keeps a point $μ̄$, at first $μ(π_0)$. After each new policy $π_k$ it moves to the "
            "orthogonal projection of $μ(π_E)$ onto the line through $μ̄$ and $μ(π_k)$; the weights of the next reward "
            "are then $w = μ(π_E) − μ̄$."
        ),
    )
    point = Numbers(tuple(f"μ̄_{{{index}}}" for index in range(1, size + 1)))
    weights = Numbers(tuple(f"w_{{{index}}}" for index in range(1, size + 1)))
    share = "What share $c$ of the way from $μ̄$ to $μ(π_1)$ does its first step go?"
    parts = [] if given.candidates else [Part(share, Number())]
    for number in range(1, count + 1):
        parts.append(Part(f"What is ${_written(point, 'μ̄')}$ after $π_{number}$?", point))
        parts.append(Part(f"What are the weights ${_written(weights, 'w')}$ then?", weights, zero=True))
    if given.candidates:
        options = {name: f"$μ(π) = ({', '.join(map(shown, mu))})$" for name, mu in given.candidates.items()}
        best = f"the one of these with the greatest $w^⊤ μ(π)$ for the weights of ({label(len(parts) - 1)})"
        parts.append(Part(f"The next policy $π_{count + 1}$ is {best}. Which one?", Choice(options)))
    last = count
    if given.candidates and given.projected:
        last += 1
        parts.append(Part(f"What is ${_written(point, 'μ̄')}$ after $π_{last}$?", point))
    parts.append(Part(f"What is the remaining distance $‖w‖$ to the expert after $π_{last}$?", Number()))
    if given.tolerance is not None:
        parts.append(Part(f"The method stops when $‖w‖ ≤ {shown(given.tolerance)}$. Does it stop now?", YesNo()))
    return Question(blocks, tuple(parts))


def _written(entries: Numbers, letter: str) -> str:
    """A vector with the names of its components."""
    return f"{letter} = ({', '.join(entries.entries)})"
