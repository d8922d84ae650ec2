"""One Bellman backup: the value of a state under a policy, from given values of the next states."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter
from rldrill.problems.family import Question
from rldrill.problems.models import (
    Dynamics,
    Lookahead,
    PolicyField,
    check_policy,
    policy_table,
    transitions_table,
    values_table,
)
from rldrill.problems.parts import Number, Part
from rldrill.problems.phrases import discount, in_open
from rldrill.problems.settings import Shape, draw_outcomes, draw_setting

TITLE = "Bellman backup"
SOURCE = "Sutton & Barto 2018, section 3.5"
REVISION = 1


class Given(Lookahead):
    """What the actions of one state do, the policy there, the values of the next states and the discount."""

    policy: PolicyField = Field(description="The policy in that state.")

    @model_validator(mode="after")
    def _policy_fits(self) -> Self:
        check_policy(self.policy, self.dynamics)
        return self


def draw(level: int, rng: Draws) -> Given:
    """Two actions with one outcome each; then with two; then with three, and the policy left open."""
    setting = draw_setting(rng)
    state = setting.states[0]
    everything = setting.states[:3]
    actions = setting.actions[:2]
    shape = Shape(states=3, actions=2, branches=level, denominators=(2, 4, 5))
    rows = [
        row for action in actions for row in draw_outcomes(rng, state, action, rng.sample(everything, level), shape)
    ]
    reached = [name for name in everything if any(row.next == name for row in rows)]
    chances = (Parameter("p"), Parameter("1-p")) if level == 3 else rng.split(2, (2, 4, 5))
    return Given(
        dynamics=Dynamics(transitions=tuple(rows)),
        policy={state: dict(zip(actions, chances, strict=True))},
        values={name: rng.nonzero(-4, 10) for name in reached},
        gamma=rng.fraction("1/2", "4/5", "9/10"),
    )


def question(given: Given) -> Question:
    """The model of one state, the policy and the values; one number is asked for."""
    blocks = (
        Paragraph(f"In state {given.state} the actions do this:"),
        transitions_table(given.dynamics),
        Paragraph("The policy takes them with these probabilities:"),
        policy_table(given.policy),
        Paragraph(f"The values of the next states under the policy are known. {discount(given.gamma)}"),
        values_table(given.values, "V^π"),
    )
    return Question(blocks, (Part(f'What is $V^π("{given.state}")${in_open(given)}?', Number()),))
