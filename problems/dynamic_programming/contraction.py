"""How far value iteration can still be from V* after some sweeps, and how many sweeps an accuracy takes."""

from typing import Annotated, Self

from pydantic import AfterValidator, Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Probability, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.models import Name, Named, check_keys
from rldrill.problems.parts import Number, Part
from rldrill.problems.phrases import discount
from rldrill.problems.settings import draw_setting
from rldrill.problems.sweeps import counted

TITLE = "Contraction of value iteration"
SOURCE = "Puterman 1994, sections 6.2 and 6.3"
REVISION = 5


def _positive(value: Fraction) -> Fraction:
    if value <= 0:
        raise ValueError(f"{value} is not above 0; give one that is")
    return value


def _below_one(value: Fraction) -> Fraction:
    if value == 1:
        raise ValueError("with a discount of 1 value iteration is no contraction; choose a smaller one")
    return value


class Given(Givens):
    """The values to start from with V*, or with the values after one sweep; the discount; sweeps and accuracy."""

    start: Named[Exact] = Field(min_length=1, description="The values to start from.")
    optimum: Named[Exact] | None = Field(default=None, description="The optimal values; instead of first.")
    first: Named[Exact] | None = Field(default=None, description="The values after one sweep; instead of optimum.")
    gamma: Annotated[Probability, AfterValidator(_below_one)] = Field(description="The discount, below 1.")
    sweeps: int = Field(ge=1, le=1000, description="How many sweeps the bound is asked for.")
    accuracy: Annotated[Exact, AfterValidator(_positive)] | None = Field(
        default=None,
        description="How near to the optimal values is near enough, above 0; asks for the sweeps that it takes.",
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.optimum is None) == (self.first is None):
            raise ValueError("give either optimum, the values V*, or first, the values after one sweep")
        check_keys(self.other, tuple(self.start), "the value", needed=tuple(self.start))
        return self

    @property
    def other(self) -> dict[Name, Exact]:
        """What the starting values are compared with."""
        return self.optimum or self.first or {}


#: How near is near enough, at each level that asks for it.
_ACCURACIES = {2: ("1", "1/2", "1/10", "1/20"), 3: ("1", "2", "3", "4", "5", "6", "8", "10", "12", "15", "20")}
#: So many sweeps are found by multiplying, without logarithms.
_BY_HAND = range(4, 7)


def draw(level: int, rng: Draws) -> Given:
    """V* is known, one bound; then also how many sweeps are enough; then only the first sweep, and γ nearer to 1."""
    known = level < 3
    states = draw_setting(rng).states[: 2 if level == 1 else 2 + rng.below(level)]
    start = {state: Fraction(0) if level == 1 else rng.whole(-2, 6) for state in states}
    other = {state: value + rng.nonzero(-5, 12) for state, value in start.items()}
    # none is 1/2, which is 1 minus itself
    discounts = {1: ("1/3", "1/4", "1/5", "2/3"), 2: ("1/3", "1/4", "2/3"), 3: ("2/3", "3/4", "4/5")}[level]
    gamma = rng.fraction(*discounts)
    distance = max(abs(other[state] - value) for state, value in start.items()) / (1 if known else 1 - gamma)
    near = [each for each in _ACCURACIES.get(level, ()) if _sweeps(distance, gamma, fraction_of(each)) in _BY_HAND]
    if level > 1 and not near:
        return draw(level, rng)
    return Given(
        start=start,
        optimum=other if known else None,
        first=None if known else other,
        gamma=gamma,
        sweeps=2 + rng.below(2) * (level == 2),
        accuracy=rng.fraction(*near) if level > 1 else None,
    )


def _sweeps(distance: Fraction, gamma: Fraction, accuracy: Fraction) -> int:
    """How many sweeps bring a distance to at most the accuracy."""
    sweeps = 0
    while distance > accuracy:
        distance, sweeps = distance * gamma, sweeps + 1
    return sweeps


def question(given: Given) -> Question:
    """The two value functions; their distance, the bounds that follow, and the sweeps that are enough."""
    known = given.optimum is not None
    mark = "V^*" if known else "V_1"
    blocks: tuple[Block, ...] = (
        Paragraph(
            "Value iteration starts from $V_0$. The optimal values $V^*$ are known."
            if known
            else "Value iteration starts from $V_0$. One synchronous sweep gives $V_1$. "
            "The optimal values $V^*$ are not known."
        ),
        Table(
            header=("$s$", *given.start),
            rows=tuple(
                (f"${name}(s)$", *(f"${shown(values[state])}$" for state in given.start))
                for name, values in (("V_0", given.start), (mark, given.other))
            ),
        ),
        Paragraph(f"{discount(given.gamma)} Distances are measured in the maximum norm $‖·‖_∞$."),
    )
    parts = [Part(f"What is $‖{'V_0 − V^*' if known else 'V_1 − V_0'}‖_∞$?", Number())]
    if not known:
        parts.append(Part("What upper bound on $‖V_0 − V^*‖_∞$ does this change imply?", Number()))
    error = f"$‖V_{{{given.sweeps}}} − V^*‖_∞$, the error after {counted(given.sweeps)}"
    ask = f"What upper bound does the contraction property then give on {error}?"
    parts.append(Part(ask, Number()))
    if given.accuracy is not None:
        limit = f"$‖V_k − V^*‖_∞ ≤ {shown(given.accuracy)}$"
        ask = f"What is the smallest number of sweeps $k$ for which this bound guarantees {limit}?"
        parts.append(Part(ask, Number()))
    return Question(blocks, tuple(parts))
