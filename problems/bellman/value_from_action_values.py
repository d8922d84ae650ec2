"""The value of states from given action values: under a policy, and the optimal one."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Name, PolicyField, check_chances, check_keys, policy_table
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import in_open
from rldrill.problems.runs import action_values_table
from rldrill.problems.settings import draw_setting

TITLE = "State values from action values"
SOURCE = "Sutton & Barto 2018, sections 3.5 and 3.6"
REVISION = 1


class Given(Givens):
    """The action values of some states, and a policy for them."""

    values: dict[Name, dict[Name, Exact]] = Field(
        min_length=1, description="For every state the values of its actions."
    )
    policy: PolicyField = Field(description="The policy in these states.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        known = tuple(self.values)
        check_keys(self.policy, known, "the policy", needed=known)
        for state, row in self.values.items():
            if not row:
                raise ValueError(f"values: the action values of {state!r} are missing")
            check_chances(self.policy[state], state, tuple(row))
        return self


def draw(level: int, rng: Draws) -> Given:
    """One state with two actions; then two with three; then four whose policy has a probability left open."""
    setting = draw_setting(rng)
    states = setting.states[: (1, 2, 4)[level - 1]]
    actions = setting.actions[: 3 if level == 2 else 2]
    values = {state: dict(zip(actions, rng.distinct(len(actions), -6, 12), strict=True)) for state in states}
    policy: PolicyField
    if level == 3:
        ways = ((Parameter("p"), Parameter("1-p")), (Parameter("1-p"), Parameter("p")))
        policy = {state: dict(zip(actions, rng.choice(ways), strict=True)) for state in states}
    else:
        policy = {state: dict(zip(actions, rng.split(len(actions), (4, 5, 10)), strict=True)) for state in states}
    return Given(values=values, policy=policy)


def question(given: Given) -> Question:
    """The action values and the policy; the values under it, and the optimal ones unless something is left open."""
    states = tuple(given.values)
    every = f"for {states[0]}" if len(states) == 1 else "for every state"
    blocks = (
        Paragraph("An agent has a table of action values:"),
        action_values_table(given.values),
        Paragraph("Its policy is:"),
        policy_table(given.policy),
    )
    parts = [
        Part(
            f"The table holds $Q^π$, the action values of this policy. What is $V^π(s)$ {every}{in_open(given)}?",
            Values("V^π", states),
        )
    ]
    if not given.parameters():
        ask = f"Suppose instead that the table holds $Q^*$, the optimal action values. What is $V^*(s)$ {every}?"
        parts.append(Part(ask, Values("V^*", states)))
    return Question(blocks, tuple(parts))
