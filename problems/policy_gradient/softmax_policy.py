"""The action probabilities of a softmax policy that is linear in features."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Name
from rldrill.problems.parts import Part
from rldrill.problems.parts import Table as TableKind
from rldrill.problems.settings import draw_setting

TITLE = "Softmax policy"
SOURCE = "Sutton & Barto 2018, section 13.1"
REVISION = 1


class Given(Givens):
    """The weights θ, and in one state the features of every action."""

    theta: tuple[Exact, ...] = Field(min_length=1, max_length=20)
    features: dict[Name, tuple[Exact, ...]] = Field(min_length=2)

    @model_validator(mode="after")
    def _fits(self) -> Self:
        for action, features in self.features.items():
            if len(features) != len(self.theta):
                raise ValueError(f"features: {action!r} has {len(features)} features, but theta {len(self.theta)}")
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
    weights = ", ".join(f"θ_{{{index}}} = {shown(weight)}" for index, weight in enumerate(given.theta, 1))
    columns = tuple(f"$f_{{{index}}}(s, a)$" for index in range(1, len(given.theta) + 1))
    blocks = (
        Paragraph("In state $s$ the actions have these features:"),
        Table(
            header=("$a$", *columns),
            rows=tuple((action, *(f"${shown(value)}$" for value in row)) for action, row in given.features.items()),
        ),
        Paragraph(f"The weights are ${weights}$. The policy is softmax in the preferences $h(s, a) = θ^⊤ f(s, a)$."),
    )
    return Question(
        blocks,
        (
            Part("a", "What is the preference $h(s, a)$ of every action?", TableKind("h", actions), zero=True),
            Part(
                "b",
                "With which probability $π(a|s)$ is every action taken?",
                TableKind("π", actions),
                points=2,
            ),
        ),
    )
