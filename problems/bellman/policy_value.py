"""The exact value of every state of a small MDP under a policy."""

from typing import Any, Self

from pydantic import ConfigDict, Field, model_validator

from rldrill.problems.document import Paragraph, joined
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Parameter
from rldrill.problems.family import Question
from rldrill.problems.models import (
    Model,
    ModelAndPolicy,
    Process,
    Transition,
    model_blocks,
    never_left,
    policy_blocks,
)
from rldrill.problems.parts import Number, Part, Values
from rldrill.problems.phrases import discount, in_open
from rldrill.problems.settings import Shape, draw_model, draw_setting

TITLE = "Value of a policy"
SOURCE = "Sutton & Barto 2018, sections 3.5 and 4.1"
REVISION = 1


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
    average: bool = Field(
        default=False,
        exclude_if=lambda average: not average,
        description="Whether the average reward per step is asked for, not values; then gamma is left out, or 1.",
    )

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
    """Two states and one action in each; then two actions; then γ or a transition probability left open."""
    setting = draw_setting(rng)
    if level == 3:
        return _left_open(rng)
    shape = Shape(states=2, actions=level, branches=2, denominators=(2,), reward=4 + 2 * level)
    mdp = draw_model(rng, setting, shape)
    while level == 2 and not _coupled(mdp):
        mdp = draw_model(rng, setting, shape)
    policy = {
        state: dict(zip(actions, rng.split(len(actions), (2, 4)) if len(actions) > 1 else (1,), strict=True))
        for state, actions in mdp.actions.items()
    }
    return Given(mdp=mdp, policy=policy, gamma=rng.fraction("1/2", "2/3", "4/5"))


def _coupled(mdp: Model) -> bool:
    """Whether each of two states can be reached from the other, so that the equations must be solved together."""
    first, second = mdp.states
    moves = {(row.state, row.next) for row in mdp.transitions}
    return (first, second) in moves and (second, first) in moves


def _left_open(rng: Draws) -> Given:
    setting = draw_setting(rng)
    first, second = setting.states[:2]
    action = setting.actions[0]
    p, rest = Parameter("p"), Parameter("1-p")
    in_gamma = rng.chance(rng.fraction("1/2"))
    half = rng.fraction("1/2", "1/4", "3/4")
    stay, leave = (half, 1 - half) if in_gamma else (p, rest)
    rows = (
        Transition(first, action, first, stay, rng.nonzero(-3, 6)),
        Transition(first, action, second, leave, rng.nonzero(-3, 6)),
        Transition(second, action, first, rng.fraction("1/2"), rng.nonzero(-3, 6)),
        Transition(second, action, setting.terminal, rng.fraction("1/2"), rng.nonzero(-3, 6)),
    )
    return Given(
        mdp=Model(story=setting.story, transitions=rows, terminal=(setting.terminal,)),
        gamma=Parameter("gamma") if in_gamma else rng.fraction("1/2", "4/5"),
    )


def question(given: Given) -> Question:
    """The model and the policy; a value is asked for every state."""
    if given.average:
        return _in_the_long_run(given)
    values = "V^π" if given.mdp.chooses else "V"
    return Question(
        (*model_blocks(given.mdp), *policy_blocks(given), Paragraph(discount(given.gamma))),
        (Part(f"What is ${values}(s)$ for every state{in_open(given)}?", Values(values, given.mdp.states)),),
    )


def _in_the_long_run(given: Given) -> Question:
    reward = "$r(π)$, the average reward per step" if given.mdp.chooses else "the average reward per step"
    return Question(
        (*model_blocks(given.mdp), *policy_blocks(given), Paragraph("It goes on for ever. Nothing is discounted.")),
        (
            Part(
                f"What is $d(s)$, the share of all steps that begin in $s$ in the long run, for every state"
                f"{in_open(given)}?",
                Values("d", given.mdp.states),
            ),
            Part(f"What is {reward} in the long run{in_open(given)}?", Number()),
        ),
    )
