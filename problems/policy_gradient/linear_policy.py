"""The greedy policy of action values that are linear in features."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact
from rldrill.problems.family import Givens, Question
from rldrill.problems.features import ActionFeatures, action_features_table, check_action_features, weights
from rldrill.problems.parts import Part, Policy, Values
from rldrill.problems.settings import draw_setting

TITLE = "Linear policy"
SOURCE = "Sutton & Barto 2018, section 10.1"
REVISION = 1


class Given(Givens):
    """The weights θ, and the features of every action in some states."""

    theta: tuple[Exact, ...] = Field(min_length=1, max_length=20, description="The weights.")
    features: ActionFeatures = Field(min_length=1, description="For every state the features of its actions.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_action_features(self.features, len(self.theta))
        return self


def draw(level: int, rng: Draws) -> Given:
    """One state with two actions; then two states with three; then three features and fractions."""
    setting = draw_setting(rng)
    states = setting.states[:1] if level == 1 else rng.sample(setting.states, level)
    actions = setting.actions[: 2 if level == 1 else 3]
    size = 3 if level == 3 else 2
    theta = tuple(
        rng.fraction("1/2", "-1/2", "3/2", "-1", "2", "1/4") if level == 3 else rng.nonzero(-3, 4) for _ in range(size)
    )
    high = {1: 4, 2: 4, 3: 5}[level]
    features = {
        state: {action: tuple(rng.whole(-1, high) for _ in range(size)) for action in actions} for state in states
    }
    return Given(theta=theta, features=features)


def question(given: Given) -> Question:
    """Weights and features; first the values of all actions, then the policy."""
    pairs = tuple((state, action) for state, row in given.features.items() for action in row)
    blocks = (
        Paragraph("An agent estimates action values as $Q̂(s, a) = θ^⊤ f(s, a)$, with these features:"),
        action_features_table(given.features),
        Paragraph(f"The weights are ${weights(given.theta)}$. Its policy $π(s)$ is greedy in $Q̂$."),
    )
    return Question(
        blocks,
        (
            Part("What is $Q̂(s, a)$ of every action?", Values("Q̂", pairs), zero=True),
            Part(
                "Which action does the policy take in each state?"
                if len(given.features) > 1
                else "Which action does the policy take?",
                Policy({state: tuple(row) for state, row in given.features.items()}),
            ),
        ),
    )
