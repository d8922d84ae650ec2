"""The exact value of every state of a small MDP under a policy."""

from typing import Any, Self

from pydantic import ConfigDict, Field, model_validator

from rldrill.problems.document import Paragraph, joined
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Parameter
from rldrill.problems.family import Question, flag
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import (
    Model,
    ModelAndPolicy,
    PolicyField,
    Process,
    Transition,
    model_blocks,
    never_left,
    open_chance,
    policy_blocks,
)
from rldrill.problems.parts import Number, Part, Values
from rldrill.problems.phrases import discount, in_open
from rldrill.problems.settings import Setting, Shape, draw_outcomes, draw_roaming, draw_setting
from rldrill.problems.transition_tables import ALONE
from rldrill.problems.valued import draw_mixed, draw_values, draw_worth

TITLE = "Value of a policy"
SOURCE = "Sutton & Barto 2018, sections 3.5 and 4.1"
REVISION = 6


class Given(ModelAndPolicy):
    """A model, a policy and the discount; without a policy every action is equally probable.

    A Markov reward process has no actions: then the rows of its transitions are state, next state, probability, reward.
    """

    # The average reward needs no discount, values do.
    model_config = ConfigDict(
        json_schema_extra={
            "required": ["mdp"],
            "if": {"properties": {"average": {"const": True}}, "required": ["average"]},
            "then": {},
            "else": {"required": ["gamma"]},
        }
    )

    mdp: Process
    gamma: Discount = Field(description="The discount; left out where the average reward is asked for.")
    average: bool = flag("Whether the average reward per step is asked for, not values; then gamma is left out, or 1.")

    @model_validator(mode="before")
    @classmethod
    def _undiscounted(cls, data: Any) -> Any:
        return {"gamma": 1, **data} if isinstance(data, dict) and data.get("average") is True else data

    @model_validator(mode="after")
    def _goes_on(self) -> Self:
        if self.average and self.mdp.terminal:
            raise ValueError(
                f"average: there is no long run, because {self.mdp.terminal[0]!r} is terminal; give it an action that "
                "goes on (to a start), or leave out average"
            )
        if self.average and self.gamma != 1:
            raise ValueError(
                "average: all steps count alike, so γ plays no part; leave out gamma, or give 1, or leave out average"
            )
        if self.average and len(classes := never_left(self.mdp, self.chances)) > 1:
            first, second, *_ = (f"{joined([*states[:4]])}{' and others' * (len(states) > 4)}" for states in classes)
            raise ValueError(
                f"average: it depends on the first state, for whoever comes to {first} stays there for ever, and so "
                f"does whoever comes to {second}; rldrill asks for it only where it is the same from every state: "
                "write a problem for each of them, without the states of the other, or let the one lead to the other"
            )
        return self


def draw(level: int, rng: Draws) -> Given:
    """A reward process of two states; then a policy, three states or the long run; then a number left open."""
    setting = draw_setting(rng)
    if level == 3:
        return _left_open(rng)
    gamma = rng.fraction("1/2", "2/3") if level == 1 else rng.fraction("1/2", "2/3", "4/5")
    form = "process" if level == 1 else rng.choice(("policy", "policy", "process", "average"))
    if form == "average":
        return _recurrent(rng, draw_roaming(rng))
    if form == "policy":
        shape = Shape(states=2, actions=2, branches=2, denominators=(2,))
        mdp, policy, _ = draw_mixed(rng, setting, shape, gamma)
        return Given(mdp=mdp, policy=policy, gamma=gamma)
    shape = Shape(states=level + 1, actions=1, branches=2, denominators=(2,) if level == 1 else (2, 4))
    values = draw_values(rng, setting.states[: shape.states], gamma)
    worths = {(state, ALONE): value for state, value in values.items()}
    return Given(mdp=draw_worth(rng, setting, shape, gamma, values, worths), gamma=gamma)


def _recurrent(rng: Draws, setting: Setting) -> Given:
    """A reward process that goes on for ever between two states or three."""
    states = setting.states[: 2 + rng.below(2)]
    rows: list[Transition] = []
    for index, state in enumerate(states):
        onward = states[(index + 1) % len(states)]
        targets = tuple(dict.fromkeys((state, onward) if rng.chance(Fraction(3, 4)) else (onward,)))
        rows += draw_outcomes(rng, state, ALONE, targets, Shape(len(states), 1, 2, reward=8, denominators=(2, 4, 5)))
    return Given(mdp=Model(story=setting.told(()), transitions=tuple(rows)), gamma=Fraction(1), average=True)


def _left_open(rng: Draws) -> Given:
    """Two states; left open is the discount, a probability of the process, or one of the policy."""
    letter = rng.choice(("gamma", "process", "policy"))
    setting = draw_setting(rng) if letter == "policy" else draw_roaming(rng)
    first, second = setting.states[:2]
    policy: PolicyField = {}
    p = (Parameter("p"), Parameter("1-p"))
    half = rng.fraction("1/2", "1/4", "3/4")
    rewards = rng.distinct(4, -3, 6)
    ways = [(second, setting.terminal), (first, second)]
    after = rng.choice(ways if letter == "policy" else [*ways, (first, setting.terminal)])
    even, gamma = Fraction(1, 2), rng.fraction("1/2", "2/3")
    if after == (second, setting.terminal):
        worth = (rewards[2] + rewards[3]) / (2 - gamma)
        if rewards[2] + gamma * worth == rewards[3] or not worth:  # their probabilities, or γ and what leads there,
            return _left_open(rng)  # would not matter
    if letter == "policy":
        onward, back = setting.actions[:2]
        name = back if first in after else onward
        policy = {first: {onward: p[0], back: p[1]}, second: {name: Fraction(1)}}
        rows = [
            Transition(first, onward, second, Fraction(1), rewards[0]),
            Transition(first, back, first, Fraction(1), rewards[1]),
        ]
    else:
        stay, leave = (half, 1 - half) if letter == "gamma" else p
        name = ALONE
        rows = [Transition(first, name, first, stay, rewards[0]), Transition(first, name, second, leave, rewards[1])]
    rows += [Transition(second, name, target, even, rewards[2 + i]) for i, target in enumerate(after)]
    ends = (setting.terminal,) if setting.terminal in after else ()
    return Given(
        mdp=Model(
            story=setting.told(ends),
            transitions=tuple(rows),
            terminal=ends,
        ),
        policy=policy or None,
        gamma=Parameter("gamma") if letter == "gamma" else gamma,
    )


def question(given: Given) -> Question:
    """The model and the policy; a value is asked for every state."""
    if given.average:
        return _in_the_long_run(given)
    values = "V^π" if given.mdp.chooses else "V"
    return Question(
        (*model_blocks(given.mdp), *policy_blocks(given), Paragraph(f"{discount(given.gamma)}{open_chance(given)}")),
        (Part(f"What is ${values}(s)$ for every state{in_open(given)}?", Values(values, given.mdp.states)),),
    )


def _in_the_long_run(given: Given) -> Question:
    reward = f"${'r(π)' if given.mdp.chooses else 'r̄'}$, the average reward per step"
    return Question(
        (
            *model_blocks(given.mdp),
            *policy_blocks(given),
            Paragraph(f"The process never ends, and nothing is discounted.{open_chance(given)}"),
        ),
        (
            Part(
                f"What is $d(s)$, the long-run fraction of the steps that begin in $s$, for every state"
                f"{in_open(given)}?",
                Values("d", given.mdp.states),
            ),
            Part(f"What is {reward} in the long run{in_open(given)}?", Number()),
        ),
    )
