"""Which max-margin constraints hold for given weights, and the smallest slack with which all do."""

from string import digits
from typing import Annotated, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Open, Parameter, dot, shown
from rldrill.problems.family import AskedFor, Givens, Question
from rldrill.problems.feature_vectors import check_lengths
from rldrill.problems.features import MOST_FEATURES, FeatureVector
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Name
from rldrill.problems.names import once, read_name
from rldrill.problems.parts import Number, Numbers, Part, Values

TITLE = "Max-margin constraints"
SOURCE = "Ratliff, Bagnell & Zinkevich 2006"
REVISION = 8
#: Constraints that hold without slack hold with any, and some need more.
DISTRACTORS = ("slack",)

EXPERT = "expert"
_LOW = str.maketrans(digits, "₀₁₂₃₄₅₆₇₈₉")


class Rival(Givens):
    """Another policy: its feature expectations, and by how much the expert must be better."""

    mu: FeatureVector = Field(description="Its feature expectations.")
    margin: Exact = Field(description="By how much the expert must be better.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.margin < 0:
            raise ValueError(f"margin is {self.margin}, but a margin is not negative; give 0 or more")
        return self


class Given(AskedFor):
    """The weights of the reward, the expert's feature expectations, and the other policies."""

    w: tuple[Open, ...] = Field(
        max_length=MOST_FEATURES,
        description="The weights of the reward; one may be left open, and is asked for.",
        examples=[["x", 2]],
    )
    expert: FeatureVector = Field(description="The expert's feature expectations.")
    policies: Annotated[dict[Name, Rival], Field(min_length=1, max_length=20), once(read_name)] = Field(
        description="The other policies by their names."
    )
    slack: Exact = Field(
        default=Fraction(0),
        ge=0,
        description="The slack with which it is asked how many constraints hold; 0 if left out.",
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if EXPERT in self.policies:
            raise ValueError(f"policies: {EXPERT!r} is the name of the expert's own policy; rename it")
        check_lengths({"w": self.w, EXPERT: self.expert} | {name: rival.mu for name, rival in self.policies.items()})
        if len(self.left_open) > 1 or len([weight for weight in self.w if isinstance(weight, Parameter)]) > 1:
            raise ValueError("w: leave one weight open at most")
        if self.asked_for:
            place = self.w.index(self.asked_for)
            for name, rival in self.policies.items():
                if rival.mu[place] >= self.expert[place]:
                    raise ValueError(
                        f"policies: {name!r} must have less of the feature whose weight is left open than the expert, "
                        "or its constraint does not hold from some weight on"
                    )
        return self

    @property
    def asked_for(self) -> Parameter | None:
        """The weight that is left open."""
        return next((weight for weight in self.w if isinstance(weight, Parameter)), None)

    @property
    def missing(self) -> dict[str, Fraction]:
        """By how much every constraint is violated without slack; negative where it holds."""
        weights = [weight for weight in self.w if isinstance(weight, Fraction)]
        worth = dot(weights, self.expert)
        return {name: dot(weights, rival.mu) + rival.margin - worth for name, rival in self.policies.items()}


def draw(level: int, rng: Draws) -> Given:
    """Two policies and two features; two or three of each; the weight from which on all constraints hold."""
    size, count = (2, 2) if level == 1 else (rng.choice((2, 3)), rng.choice((2, 3)))
    holding = rng.chance(Fraction(1, 4))
    while True:
        w = tuple(rng.nonzero(-2, 3) for _ in range(size))
        expert = tuple(rng.whole(1, 6) for _ in range(size))
        policies = {
            f"π{str(number).translate(_LOW)}": Rival(
                mu=tuple(rng.whole(0, 6) for _ in range(size)), margin=rng.whole(1, 6)
            )
            for number in range(1, count + 1)
        }
        if len({expert, *(rival.mu for rival in policies.values())}) <= count:
            continue  # no weights tell two of them apart
        given = Given(w=w, expert=expert, policies=policies)
        missing = given.missing.values()
        if level == 3:
            opened = _opened(rng, given)
            if opened:
                return opened
            continue
        slack = rng.whole(1, 4)
        told_apart = 0 not in missing and slack not in missing and len(set(missing)) == count
        helps = max(missing) < 0 if holding else any(0 < violation < slack for violation in missing)
        if told_apart and helps:
            return given.model_copy(update={"slack": slack})


def _opened(rng: Draws, given: Given) -> Given | None:
    """The same with one weight left open, if each constraint holds from another readable weight on."""
    place = rng.below(len(given.w))
    if any(rival.mu[place] >= given.expert[place] for rival in given.policies.values()):
        return None
    drawn = [weight for weight in given.w if isinstance(weight, Fraction)][place]
    least = {
        drawn + Fraction(missing, given.expert[place] - given.policies[name].mu[place])
        for name, missing in given.missing.items()
    }
    weighed = all(
        any(rival.mu[index] != value for rival in given.policies.values()) for index, value in enumerate(given.expert)
    )
    if not weighed or 0 in least or len(least) < len(given.policies) or any(value.denominator > 4 for value in least):
        return None
    w = tuple(Parameter("x") if index == place else weight for index, weight in enumerate(given.w))
    return given.model_copy(update={"w": w})


def question(given: Given) -> Question:
    """The vectors and margins; values, then how many constraints hold, then the slack."""
    components = range(1, len(given.w) + 1)
    weights = ", ".join(f"w_{{{index}}} = {shown(weight)}" for index, weight in zip(components, given.w, strict=True))
    opened = f", where ${shown(given.asked_for)}$ is left open" if given.asked_for else ""
    rows = (
        ("$π_E$", *(f"${shown(value)}$" for value in given.expert), "–"),
        *(
            (name, *(f"${shown(value)}$" for value in rival.mu), f"${shown(rival.margin)}$")
            for name, rival in given.policies.items()
        ),
    )
    blocks = (
        Paragraph(
            "With the reward $w^⊤ φ(s)$, in which $φ(s)$ are the features of a state, the expert's policy $π_E$ must "
            "be better than these other policies, with a margin $m$. $μ(π)$ are the feature expectations of a policy:"
        ),
        Table(
            header=("$π$", *(f"$μ_{{{index}}}(π)$" for index in components), "$m(π_E, π)$"),
            rows=rows,
        ),
        Paragraph(
            f"The weights are ${weights}${opened}. The constraints are $w^⊤ μ(π_E) ≥ w^⊤ μ(π) + m(π_E, π) − ξ$, "
            "one for every other policy $π$, with the same slack $ξ ≥ 0$ in all of them."
        ),
    )
    if given.asked_for:
        letter = shown(given.asked_for)
        equal = (
            f"For which ${letter} = {letter}(π)$ are both sides of the constraint of the policy $π$ equal if $ξ = 0$?"
        )
        return Question(
            blocks,
            (
                Part(equal, Values(letter, tuple(given.policies)), zero=True),
                Part(
                    f"What is the smallest ${letter}$ with which all constraints hold if $ξ = 0$?", Number(), zero=True
                ),
            ),
        )
    return Question(
        blocks,
        (
            Part(
                "What is the value $w^⊤ μ(π)$ of each policy, the expert's first?",
                Numbers(tuple(f"w^⊤ μ({name})" for name in ("π_E", *(f'"{name}"' for name in given.policies)))),
                zero=True,
            ),
            Part(f"How many of the constraints hold with $ξ = {shown(given.slack)}$?", Number(), zero=True),
            Part("What is the smallest $ξ ≥ 0$ with which all constraints hold?", Number(), zero=True),
        ),
    )
