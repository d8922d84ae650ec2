"""The score function of a softmax policy: the gradient of the logarithm of an action's probability."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Logarithm, Parameter, WeightField, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.features import FeatureVector, check_features, features_table, weight_names, weights
from rldrill.problems.models import Name, OpenDistributionField, check_keys, check_sum
from rldrill.problems.parts import Numbers, Part, Values
from rldrill.problems.phrases import in_open
from rldrill.problems.settings import draw_setting
from rldrill.problems.softmax import draw_log_policy

TITLE = "Score function"
SOURCE = "Sutton & Barto 2018, eq. 13.9"
REVISION = 1


class Given(Givens):
    """The features of every action in one state, the weights θ or the policy's probabilities, and an action.

    Without ``action`` the scores of all actions are asked for.
    """

    features: dict[Name, FeatureVector] = Field(min_length=2, description="The features of every action.")
    theta: tuple[WeightField, ...] | None = Field(default=None, description="The weights; instead of policy.")
    policy: OpenDistributionField | None = Field(
        default=None, description="The probability of every action; instead of theta."
    )
    action: Name | None = Field(default=None, description="The action whose score is asked for; without it, all.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        actions = tuple(self.features)
        if (self.theta is None) == (self.policy is None):
            raise ValueError("give either the weights theta or the policy's probabilities")
        check_features(self.features, len(self.theta or self.features[actions[0]]))
        if self.policy is not None:
            check_keys(self.policy, actions, "the probability", needed=actions)
            check_sum(self.policy.values(), "policy: the probabilities")
        if self.action is not None and self.action not in actions:
            raise ValueError(f"action: {self.action!r} has no features")
        return self

    @property
    def asked(self) -> tuple[str, ...]:
        """The actions whose scores are asked for."""
        return tuple(self.features) if self.action is None else (self.action,)


def draw(level: int, rng: Draws) -> Given:
    """Probabilities given; then from weights that are logarithms; then with one weight ln x, x left open."""
    setting = draw_setting(rng)
    actions = setting.actions[: 2 if level == 1 else 3]
    if level == 1:
        features = {action: tuple(rng.whole(0, 3) for _ in range(2)) for action in actions}
        chances = rng.split(2, (2, 4, 5))
        return Given(features=features, policy=dict(zip(actions, chances, strict=True)), action=rng.choice(actions))
    theta, rows = draw_log_policy(rng, ("s",), actions)
    if level == 3:
        theta = (Logarithm("ln x"), theta[1])
    return Given(features=rows["s"], theta=theta, action=rng.choice(actions))


def question(given: Given) -> Question:
    """Features with weights or probabilities; from weights the probabilities are asked for first."""
    size = len(next(iter(given.features.values())))
    blocks: tuple[Block, ...] = (
        Paragraph(
            "An agent's policy is softmax in the preferences $h(s, a) = θ^⊤ f(s, a)$. In state $s$ the actions have "
            "these features:"
        ),
        features_table(given.features),
    )
    ask = f"What is the score $∇_θ log π(a|s)$ of {{}}{in_open(given)}?"
    wanted = [ask.format(f"the action {action}") for action in given.asked]
    names = tuple(f"∂/∂{name}" for name in weight_names(range(size)))
    if given.policy is not None:
        blocks += (
            Paragraph("With its present weights the policy takes them with these probabilities:"),
            Table(
                header=("$a$", *given.policy),
                rows=(("$π(a|s)$", *(f"${shown(chance)}$" for chance in given.policy.values())),),
            ),
        )
        probabilities: tuple[Part, ...] = ()
    else:
        left_open = "".join(f" The number ${shown(Parameter(name))} > 0$ is left open." for name in given.parameters())
        blocks += (Paragraph(f"The weights are ${weights(given.theta or ())}$.{left_open}"),)
        probabilities = (
            Part(
                f"With which probability $π(a|s)$ is every action taken{in_open(given)}?",
                Values("π", tuple(given.features)),
            ),
        )
    parts = [*probabilities]
    for text in wanted:
        parts.append(Part(text, Numbers(names)))
    return Question(blocks, tuple(parts))
