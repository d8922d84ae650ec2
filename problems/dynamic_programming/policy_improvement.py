"""The greedy policy for the values of a policy, and whether that policy was optimal already."""

from typing import Literal, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Probability
from rldrill.problems.family import Givens, Question, flag
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Model, Named, PolicyField, check_policy, check_state_values, model_blocks
from rldrill.problems.parts import Part, Policy, Values, YesNo
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Shape, draw_setting
from rldrill.problems.valued import (
    UNITS,
    check_policy_values,
    deterministic,
    draw_valued,
    known_or_asked,
    policy_blocks,
    worth,
)

TITLE = "Policy improvement"
SOURCE = "Sutton & Barto 2018, section 4.2"
REVISION = 5


class Given(Givens):
    """A model, a policy, the discount, and the policy's values; without them, they are asked for first."""

    mdp: Model = Field(description="The Markov decision process.")
    policy: PolicyField = Field(description="The policy that is improved.")
    values: Named[Exact] | None = Field(
        default=None, description="The policy's values; without them they are asked for first."
    )
    gamma: Probability = Field(description="The discount.")
    action_values: bool = flag("Whether the values of all actions are asked for, too.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_policy(self.policy, self.mdp)
        if self.values is not None:
            check_state_values(self.values, self.mdp)
            if not self.parameters():
                check_policy_values(self.values, self.policy, self.mdp, self.gamma)
        return self


def draw(level: int, rng: Draws) -> Given:
    """Two states whose moves are certain; then moves that are not; then the values are asked for, too."""
    gamma = rng.choice(tuple(UNITS)[: max(level, 2)])
    states = 2 if level == 1 else 2 + rng.below(2)
    shape = Shape(states=states, actions=3 if states == 2 else 2, branches=min(level, 2), denominators=(2,))
    others = (-4, -1) if rng.chance(Fraction(1, 2) if level == 2 else Fraction(2, 5)) else (-4, 4)
    forked: Literal["own", "others"] = "own" if level == 3 else "others"
    setting = draw_setting(rng)
    mdp, policy, values, _ = draw_valued(rng, setting, shape, gamma, others, forked=forked)
    while level == 1 and not _varied(mdp, policy, values, gamma):
        mdp, policy, values, _ = draw_valued(rng, setting, shape, gamma, others, forked=forked)
    return Given(
        mdp=mdp,
        policy=deterministic(policy),
        values=None if level == 3 else values,
        gamma=gamma,
        action_values=level == 2,
    )


def _varied(mdp: Model, policy: dict[str, str], values: dict[str, Fraction], gamma: Fraction) -> bool:
    """Whether not every state has the same greedy action, and the policy goes on somewhere, so that γ matters."""
    goes_on = any(row.next in values for row in mdp.transitions if policy[row.state] == row.action)
    return goes_on and len({_greedy(mdp, state, values, gamma) for state in mdp.states}) > 1


def _greedy(mdp: Model, state: str, values: dict[str, Fraction], gamma: Fraction) -> str:
    return max(mdp.actions[state], key=lambda action: worth(mdp, (state, action), values, gamma))


def question(given: Given) -> Question:
    """The model and the policy, with its values or asking for them."""
    states = given.mdp.states
    known, asked = known_or_asked(given.values, states)
    blocks = (
        *model_blocks(given.mdp),
        *policy_blocks(given.policy, given.mdp),
        Paragraph(discount(given.gamma)),
        *known,
    )
    if given.action_values:
        asked = [*asked, Part("What is $Q^π(s, a)$ for every state and action?", Values("Q^π", given.mdp.pairs))]
    parts = (
        *asked,
        Part("Which action $π'(s)$ is greedy for $V^π$ in every state?", Policy(given.mdp.actions, "π'")),
        Part("Is $π$ an optimal policy?", YesNo()),
    )
    return Question(blocks, tuple(parts))
