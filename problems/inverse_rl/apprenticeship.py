"""Apprenticeship learning by projection: distances, projected points and the weights of the next reward."""

from fractions import Fraction
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, dot, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.feature_vectors import check_lengths
from rldrill.problems.parts import Number, Numbers, Part

TITLE = "Apprenticeship learning"
SOURCE = "Abbeel & Ng 2004, section 3.1"
REVISION = 2

Mu = tuple[Fraction, ...]


class Given(Givens):
    """The expert's feature expectations, those of the first policy, and those of the policies after it."""

    expert: tuple[Exact, ...] = Field(description="The expert's feature expectations.")
    first: tuple[Exact, ...] = Field(description="The feature expectations of the first policy.")
    policies: tuple[tuple[Exact, ...], ...] = Field(
        min_length=1, max_length=8, description="The feature expectations of the policies after it, in their order."
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        later = {f"policy {number}": mu for number, mu in enumerate(self.policies, 1)}
        check_lengths({"expert": self.expert, "first": self.first} | later, "features")
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


def draw(level: int, rng: Draws) -> Given:
    """One projection of two features; one of three; two of two features."""
    size = 3 if level == 2 else 2
    expert, first = _vector(rng, size), _vector(rng, size)
    point, policies = first, []
    for _ in range(2 if level == 3 else 1):
        found = _beyond(rng, point, expert, 5 if level == 3 else 100)
        if found is None:
            return draw(level, rng)
        mu, share = found
        policies.append(mu)
        point = tuple(here + share * (there - here) for here, there in zip(point, mu, strict=True))
    return Given(expert=expert, first=first, policies=tuple(policies))


def _vector(rng: Draws, size: int) -> Mu:
    return tuple(rng.whole(0, 6) for _ in range(size))


def _shares(point: Mu, mu: Mu, expert: Mu) -> tuple[Fraction, Fraction]:
    """The way to a policy times the way to the expert, and times itself; their quotient is where to project to."""
    way = [there - here for here, there in zip(point, mu, strict=True)]
    goal = [there - here for here, there in zip(point, expert, strict=True)]
    along = dot(way, goal)
    return along, dot(way, way)


def _beyond(rng: Draws, point: Mu, expert: Mu, finest: int) -> tuple[Mu, Fraction] | None:
    """A policy as the algorithm finds it: at least as good as the expert for the weights, so not short of it.

    The projection then lies between the point and the policy; also returned is where, as a share of the way, whose
    denominator is at most ``finest``. None where no small policy will do.
    """
    for _ in range(16):
        mu = _vector(rng, len(point))
        along, far = _shares(point, mu, expert)
        _, goal = _shares(point, expert, expert)
        beside = along**2 < goal * far  # or the expert would be on the line, and be met
        if beside and goal <= along < far and (along / far).denominator <= finest:
            return mu, along / far
    return None


def question(given: Given) -> Question:
    """The vectors; a distance, then projection and weights policy by policy, then the distance left."""
    count, size = len(given.policies), len(given.expert)
    named = (("μ(π_E)", given.expert), *((f"μ(π_{{{n}}})", mu) for n, mu in enumerate((given.first, *given.policies))))
    blocks = (
        Paragraph("An apprentice wants the feature expectations of the expert's policy $π_E$. So far there are:"),
        Table(
            header=("", *(f"component ${index}$" for index in range(1, size + 1))),
            rows=tuple((f"${name}$", *(f"${shown(value)}$" for value in mu)) for name, mu in named),
        ),
        Paragraph(
            "The projection method keeps a point $μ̄$, at first $μ(π_0)$. After each new policy $π_i$ it moves to the "
            "orthogonal projection of $μ(π_E)$ onto the line through $μ̄$ and $μ(π_i)$; the weights of the next reward "
            "are then $w = μ(π_E) − μ̄$."
        ),
    )
    parts = [Part("What is the distance $‖μ(π_1) − μ(π_E)‖$ (Euclidean)?", Number())]
    for number in range(1, count + 1):
        point = Numbers(tuple(f"μ̄_{{{index}}}" for index in range(1, size + 1)))
        weights = Numbers(tuple(f"w_{{{index}}}" for index in range(1, size + 1)))
        parts.append(Part(f"Where is $μ̄$ after $π_{{{number}}}$?", point, 2))
        parts.append(Part("What are the weights $w$ then?", weights, zero=True))
    parts.append(Part(f"What is the distance $‖w‖$ that is left after $π_{{{count}}}$?", Number()))
    return Question(blocks, tuple(parts))
