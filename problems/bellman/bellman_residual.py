"""Given values held against the Bellman equations: the residual of every state, and whether the values are right."""

from fractions import Fraction
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact
from rldrill.problems.family import Question
from rldrill.problems.models import (
    Model,
    ModelAndPolicy,
    Name,
    Transition,
    check_state_values,
    model_blocks,
    policy_blocks,
    values_table,
)
from rldrill.problems.parts import Part, Values, YesNo
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Shape, draw_model, draw_setting

TITLE = "Bellman residual"
SOURCE = "Sutton & Barto 2018, sections 3.5, 3.6 and 11.4"
REVISION = 1


class Given(ModelAndPolicy):
    """A model, a policy and the discount, and values that are claimed for it: the policy's, or the optimal ones."""

    values: dict[Name, Exact] = Field(description="The value that is claimed for every state.")
    optimal: bool = Field(
        default=False, description="Whether they are claimed to be the optimal values, not the policy's."
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.parameters():
            raise ValueError(f"{self.parameters()[0]} is left open, so it cannot be told whether the values are right")
        if self.optimal and self.policy is not None:
            raise ValueError("policy: optimal values belong to no given policy; leave it out")
        check_state_values(self.values, self.mdp)
        return self


def draw(level: int, rng: Draws) -> Given:
    """One action in each of two states; then two, for a policy or the optimum; then the optimum of three states.

    The values come first, and rewards are chosen so that they are right; then mostly one value is changed.
    """
    setting = draw_setting(rng)
    shape = Shape(states=3 if level == 3 else 2, actions=min(level, 2), branches=2, denominators=(2,))
    mdp = draw_model(rng, setting, shape)
    optimal = level == 3 or (level == 2 and rng.chance(Fraction(1, 2)))
    gamma = rng.fraction("1/2", "1/3", "2/3", "4/5") if level < 3 else rng.fraction("1/2", "4/5")
    unit = gamma.denominator  # so that γ times a value is whole
    counts = rng.distinct(len(mdp.states), 1, max(len(mdp.states) + 1, 12 // unit))
    values = {state: unit * count for state, count in zip(mdp.states, counts, strict=True)}
    chances = {
        state: dict(zip(actions, rng.split(len(actions), (2, 4)) if len(actions) > 1 else (Fraction(1),), strict=True))
        for state, actions in mdp.actions.items()
    }
    rows: list[Transition] = []
    for state in mdp.states:
        worth = _worth(rng, values[state], chances[state], optimal=optimal)
        for action in mdp.actions[state]:
            rows += _paying(rng, mdp.outcomes[state, action], worth[action], values, gamma)
    if rng.chance(Fraction(2, 3)):
        wrong = rng.choice(mdp.states)
        values[wrong] += unit * rng.nonzero(-1, 1)
    return Given(
        mdp=Model(story=setting.story, transitions=tuple(rows), terminal=mdp.terminal),
        policy=None if optimal else chances,
        gamma=gamma,
        values=values,
        optimal=optimal,
    )


def _worth(rng: Draws, value: Fraction, chances: dict[str, Fraction], *, optimal: bool) -> dict[str, Fraction]:
    """What each action is worth, if the state is worth that much: the best action, or the mean, is."""
    actions = rng.shuffled(tuple(chances))
    if len(actions) == 1:
        return {actions[0]: value}
    first, second = actions
    if optimal:
        return {first: value, second: value - rng.whole(1, 4)}
    whole = chances[first].denominator  # so that what is added and taken away is whole
    return {first: value + whole * chances[second], second: value - whole * chances[first]}


def _paying(
    rng: Draws, rows: tuple[Transition, ...], worth: Fraction, values: dict[str, Fraction], gamma: Fraction
) -> list[Transition]:
    """The outcomes of an action with rewards that make it worth that much."""
    spread = rng.whole(0, 2)
    signs = (0,) if len(rows) == 1 else (1, -1)
    return [
        row._replace(reward=worth - gamma * values.get(row.next, Fraction(0)) + sign * spread)
        for row, sign in zip(rows, signs, strict=True)
    ]


def question(given: Given) -> Question:
    """The model and the claimed values; their residuals, then the verdict."""
    of = "V^*" if given.optimal else "V^π"
    policy: tuple[Block, ...] = () if given.optimal else policy_blocks(given)
    equation = "Bellman optimality equation" if given.optimal else "Bellman equation"
    blocks = (
        *model_blocks(given.mdp),
        *policy,
        Paragraph(f"{discount(given.gamma)} Somebody claims that ${of}$ is this $V$:"),
        values_table(given.values),
        Paragraph(
            f"The residual $δ(s)$ is the right side of the {equation} for $s$, worked out with this $V$, minus $V(s)$."
        ),
    )
    return Question(
        blocks,
        (
            Part("What is the residual $δ(s)$ of every state?", Values("δ", given.mdp.states), zero=True),
            Part(f"Is $V$ equal to ${of}$?", YesNo()),
        ),
    )
