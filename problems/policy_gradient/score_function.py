"""The score function of a softmax policy, the gradient of log π; or the policy from a component of it."""

from collections.abc import Iterator
from typing import NamedTuple, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Document, Paragraph, Table, joined
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Logarithm, Parameter, WeightField, dot, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.features import (
    MOST_ACTIONS,
    OneStateFeatures,
    check_features,
    features_table,
    weights,
)
from rldrill.problems.models import Name, OpenDistributionField, check_keys, check_sum
from rldrill.problems.parts import Number, Numbers, Part, Values
from rldrill.problems.phrases import in_open
from rldrill.problems.settings import draw_setting
from rldrill.problems.softmax import draw_log_policy, told_apart

TITLE = "Score function"
SOURCE = "Sutton & Barto 2018, eq. 13.9"
REVISION = 4


class Component(NamedTuple):
    """The component of a score that belongs to the weight of this number."""

    number: int
    value: Exact


class Given(Givens):
    """The features of every action in one state, the weights θ or the policy's probabilities, and an action.

    Without ``action`` the scores of all actions are asked for. With a ``component`` of its score that is known the
    policy takes one of two actions with the probability p, and p is asked for.
    """

    FOUND_BY = "component"

    features: OneStateFeatures = Field(min_length=2, description="The features of every action.")
    theta: tuple[WeightField, ...] | None = Field(
        default=None, max_length=MOST_ACTIONS, description="The weights; instead of policy."
    )
    policy: OpenDistributionField | None = Field(
        default=None, description="The probability of every action; instead of theta."
    )
    action: Name | None = Field(default=None, description="The action whose score is asked for; without it, all.")
    component: Component | None = Field(
        default=None, description="A component of the action's score, from which p is to be found."
    )

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
            raise ValueError(f"action: {self.action!r} has no features; add them")
        if self.component is not None:
            self._check_component(self.component)
        return self

    def _check_component(self, component: Component) -> None:
        if self.action is None or self.left_open != ("p",) or len(self.features) != 2:
            raise ValueError("component: give its action, one of two with the probabilities p and 1-p")
        if component.number not in range(1, len(self.features[self.action]) + 1):
            raise ValueError(f"component: there is no weight of the number {component.number}")

    @property
    def asked(self) -> tuple[str, ...]:
        """The actions whose scores are asked for."""
        if self.component is not None:
            return tuple(action for action in self.features if action != self.action)
        return tuple(self.features) if self.action is None else (self.action,)


def draw(level: int, rng: Draws) -> Given:
    """Two probabilities; then three, or weights that are logarithms; then one weight ln x, or p from a score."""
    actions = draw_setting(rng).actions
    if level == 1:
        return _of_probabilities(rng, actions[:2], 2)
    if level == 2:
        if rng.choice((True, False)):
            return _of_probabilities(rng, actions[:3], rng.choice((2, 3)))
        return _of_logarithms(rng, actions)
    if rng.choice((True, False)):
        given = _of_logarithms(rng, actions)
        return given.model_copy(update={"theta": (*(given.theta or ())[:-1], Logarithm("ln x"))})
    return _sought(rng, rng.shuffled(actions)[:2])


def _of_logarithms(rng: Draws, actions: tuple[str, ...]) -> Given:
    """The score of one action, no two components the same whatever the probabilities are."""
    count, size = rng.choice(((3, 2), (2, 2), (3, 3)))
    while True:
        theta, rows = draw_log_policy(rng, ("s",), actions[:count], size)
        if told_apart(rows):
            return Given(features=rows["s"], theta=theta, action=rng.choice(actions[:count]))


def _of_probabilities(rng: Draws, actions: tuple[str, ...], size: int) -> Given:
    """The score of one action, every component not 0 and no two the same."""
    chances = rng.split(len(actions), (3, 4, 5) if len(actions) == 2 else (5, 6, 8))
    while True:
        features = {action: tuple(rng.whole(0, 3) for _ in range(size)) for action in actions}
        action = rng.choice(actions)
        expected = [dot(chances, column) for column in zip(*features.values(), strict=True)]
        score = {own - mean for own, mean in zip(features[action], expected, strict=True)}
        if len(score) == size and 0 not in score:
            return Given(features=features, policy=dict(zip(actions, chances, strict=True)), action=action)


def _sought(rng: Draws, actions: tuple[str, ...]) -> Given:
    """First p, then the component that follows from it."""
    first, second = actions
    size = rng.choice((2, 3))
    lead = rng.shuffled((-4, -3, -2, -1, 1, 2, 3, 4))[:size]
    base = tuple(rng.whole(-1, 3) for _ in range(size))
    features = {first: tuple(low + more for low, more in zip(base, lead, strict=True)), second: base}
    p = rng.fraction("1/3", "2/3", "1/4", "3/4", "1/5", "2/5", "3/5", "4/5", "3/8", "5/8", "3/10", "7/10")
    action, number = rng.choice(actions), 1 + rng.below(size)
    value = (1 - p) * lead[number - 1] if action == first else -p * lead[number - 1]
    policy = {first: Parameter("p"), second: Parameter("1-p")}
    return Given(features=features, policy=policy, action=action, component=Component(number, value))


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
    if given.component is not None:
        return Question((*blocks, *_known(given, given.component)), tuple(_parts_for_p(given)))
    ask = f"What is the score $g = ∇_θ log π(a|s)$ of {{}}{in_open(given)}?"
    if given.policy is not None:
        blocks += (
            Paragraph("With the present weights the policy takes them with these probabilities:"),
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
                f"What is the probability $π(a|s)$ of every action{in_open(given)}?",
                Values("π(·|s)", tuple(given.features)),
            ),
        )
    names = _entries(size)
    scores = [Part(ask.format(f"the action {action}"), Numbers(names)) for action in given.asked]
    return Question(blocks, (*probabilities, *scores))


def _entries(size: int) -> tuple[str, ...]:
    """What the entries of a score are called."""
    return tuple(f"g_{{{index}}}" for index in range(1, size + 1))


def _known(given: Given, component: Component) -> Document:
    policy = given.policy or {}
    chances = joined([f"{action} with the probability ${shown(chance)}$" for action, chance in policy.items()])
    slope = f'∂/∂θ_{{{component.number}}} log π("{given.action}"|s) = {shown(component.value)}'
    return (Paragraph(f"With the present weights the policy takes {chances}, and ${slope}$."),)


def _parts_for_p(given: Given) -> Iterator[Part]:
    yield Part("What is $p$?", Number())
    (other,) = given.asked
    names = _entries(len(given.features[other]))
    yield Part(f"What is the score $g = ∇_θ log π(a|s)$ of the action {other}?", Numbers(names))
