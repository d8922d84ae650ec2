"""The action probabilities of a softmax policy that is linear in features."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, WeightField, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.features import FeatureVector, check_features, features_table, weights
from rldrill.problems.models import Name
from rldrill.problems.parts import Number, Part, Values
from rldrill.problems.phrases import check_one_open, in_open
from rldrill.problems.settings import draw_setting

TITLE = "Softmax policy"
SOURCE = "Sutton & Barto 2018, section 13.1"
REVISION = 1


class Given(Givens):
    """The weights θ, and in one state the features of every action."""

    theta: tuple[WeightField, ...] = Field(min_length=1, max_length=20, description="The weights.")
    features: dict[Name, FeatureVector] = Field(min_length=2, description="The features of every action.")
    entropy: bool = Field(
        default=False, exclude_if=lambda entropy: not entropy, description="Whether the policy's entropy is asked for."
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_features(self.features, len(self.theta))
        check_one_open(self)
        return self


def draw(level: int, rng: Draws) -> Given:
    """Two actions; then three; then three with three features and fractions."""
    setting = draw_setting(rng)
    actions = setting.actions[: 2 if level == 1 else 3]
    size = 3 if level == 3 else 2
    theta = tuple(
        rng.fraction("1/2", "-1/2", "1", "3/2", "1/4") if level == 3 else rng.nonzero(-1, 2) for _ in range(size)
    )
    features = {action: tuple(rng.whole(0, 2) for _ in range(size)) for action in actions}
    return Given(theta=theta, features=features)


def question(given: Given) -> Question:
    """Weights and features; first the preferences, then the probabilities."""
    actions = tuple(given.features)
    opened = "".join(f" The number ${shown(Parameter(name))} > 0$ is left open." for name in given.parameters())
    blocks = (
        Paragraph("In state $s$ the actions have these features:"),
        features_table(given.features),
        Paragraph(
            f"The weights are ${weights(given.theta)}$. The policy is softmax in the preferences "
            f"$h(s, a) = θ^⊤ f(s, a)$.{opened}"
        ),
    )
    left_open = in_open(given)
    parts = [
        Part(f"What is the preference $h(s, a)$ of every action{left_open}?", Values("h", actions), zero=True),
        Part(f"With which probability $π(a|s)$ is every action taken{left_open}?", Values("π", actions)),
    ]
    if given.entropy:
        ask = "What is the entropy $H = −Σ_a π(a|s) ln π(a|s)$ of the policy in $s$, with natural logarithms"
        parts.append(Part(f"{ask}{left_open}?", Number()))
    return Question(blocks, tuple(parts))
