"""The action probabilities of a softmax policy that is linear in features."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact
from rldrill.problems.family import Givens, Question
from rldrill.problems.features import FeatureVector, check_features, features_table, weights
from rldrill.problems.models import Name
from rldrill.problems.parts import Part, Values
from rldrill.problems.settings import draw_setting

TITLE = "Softmax policy"
SOURCE = "Sutton & Barto 2018, section 13.1"
REVISION = 1


class Given(Givens):
    """The weights θ, and in one state the features of every action."""

    theta: tuple[Exact, ...] = Field(min_length=1, max_length=20, description="The weights.")
    features: dict[Name, FeatureVector] = Field(min_length=2, description="The features of every action.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_features(self.features, len(self.theta))
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
    blocks = (
        Paragraph("In state $s$ the actions have these features:"),
        features_table(given.features),
        Paragraph(
            f"The weights are ${weights(given.theta)}$. The policy is softmax in the preferences "
            "$h(s, a) = θ^⊤ f(s, a)$."
        ),
    )
    return Question(
        blocks,
        (
            Part("What is the preference $h(s, a)$ of every action?", Values("h", actions), zero=True),
            Part(
                "With which probability $π(a|s)$ is every action taken?",
                Values("π", actions),
                points=2,
            ),
        ),
    )
