"""Which max-margin constraints hold for given weights, and the smallest slack with which all do."""

from string import digits
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, dot, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.feature_vectors import check_lengths
from rldrill.problems.models import Name
from rldrill.problems.parts import Number, Part, Values

TITLE = "Max-margin constraints"
SOURCE = "Ratliff, Bagnell & Zinkevich 2006"
REVISION = 2

EXPERT = "expert"
_LOW = str.maketrans(digits, "₀₁₂₃₄₅₆₇₈₉")


class Rival(Givens):
    """Another policy: its feature expectations, and by how much the expert must be better."""

    mu: tuple[Exact, ...] = Field(description="Its feature expectations.")
    margin: Exact = Field(description="By how much the expert must be better.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.margin < 0:
            raise ValueError(f"margin is {self.margin}, but a margin is not negative")
        return self


class Given(Givens):
    """The weights of the reward, the expert's feature expectations, and the other policies."""

    w: tuple[Exact, ...] = Field(description="The weights of the reward.")
    expert: tuple[Exact, ...] = Field(description="The expert's feature expectations.")
    policies: dict[Name, Rival] = Field(min_length=1, max_length=20, description="The other policies by their names.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if EXPERT in self.policies:
            raise ValueError(f"policies: {EXPERT!r} is the name of the expert's own policy")
        check_lengths(
            {"w": self.w, EXPERT: self.expert} | {name: rival.mu for name, rival in self.policies.items()}, "features"
        )
        return self


def draw(level: int, rng: Draws) -> Given:
    """Two policies and two features; three policies; four policies and three features."""
    size = 3 if level == 3 else 2
    w = tuple(rng.nonzero(-2, 3) for _ in range(size))
    expert = tuple(rng.whole(1, 6) for _ in range(size))
    policies = {}
    for number in range(1, level + 2):
        mu = tuple(rng.whole(0, 6) for _ in range(size))
        policies[f"π{str(number).translate(_LOW)}"] = Rival(mu=mu, margin=rng.whole(1, 6))
    worth = dot(w, expert)
    needed = [dot(w, rival.mu) + rival.margin for rival in policies.values()]
    if worth in needed or worth < min(needed):  # a tie, or no constraint holds
        return draw(level, rng)
    return Given(w=w, expert=expert, policies=policies)


def question(given: Given) -> Question:
    """The vectors and margins; values, then how many constraints hold, then the slack."""
    components = range(1, len(given.w) + 1)
    weights = ", ".join(f"w_{{{index}}} = {shown(weight)}" for index, weight in zip(components, given.w, strict=True))
    rows = (
        ("$π_E$ (expert)", *(f"${shown(value)}$" for value in given.expert), "–"),
        *(
            (name, *(f"${shown(value)}$" for value in rival.mu), f"${shown(rival.margin)}$")
            for name, rival in given.policies.items()
        ),
    )
    blocks = (
        Paragraph("For the reward $w^⊤ φ(s)$ an expert's policy $π_E$ is to be better than all these others:"),
        Table(
            header=("$π$", *(f"$μ_{{{index}}}(π)$" for index in components), "$m(π_E, π)$"),
            rows=rows,
        ),
        Paragraph(
            f"The weights are ${weights}$. The constraints are $w^⊤ μ(π_E) ≥ w^⊤ μ(π) + m(π_E, π) − ξ$, "
            "one for every other policy $π$, with the same slack $ξ ≥ 0$ in all of them."
        ),
    )
    return Question(
        blocks,
        (
            Part("What is $w^⊤ μ(π)$ of every policy?", Values("w^⊤ μ", (EXPERT, *given.policies)), zero=True),
            Part("How many of the constraints hold with $ξ = 0$?", Number(), zero=True),
            Part("What is the smallest $ξ ≥ 0$ with which all of them hold?", Number(), 2, zero=True),
        ),
    )
