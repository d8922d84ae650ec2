"""One Bellman backup: the value of a state under a policy, or the number that makes the value what it is."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, Scalar, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import (
    Dynamics,
    Lookahead,
    PolicyField,
    Transition,
    check_policy,
    draw_letter,
    outcomes_blocks,
    policy_table,
    values_table,
)
from rldrill.problems.parts import Number, Part
from rldrill.problems.phrases import discount, in_open, unknown
from rldrill.problems.settings import Shape, draw_outcomes, draw_setting, draw_targets
from rldrill.problems.valued import discounted, draw_averaging, draw_paying, draw_values, tells_apart

TITLE = "Bellman backup"
SOURCE = "Sutton & Barto 2018, section 3.5"
REVISION = 7


class Given(Lookahead):
    """What the actions of one state do, the policy there, the values of the next states and the discount.

    Where the values hold the state itself, they are current ones, and the next is asked for; with ``find`` they are
    the policy's.
    """

    policy: PolicyField = Field(description="The policy in that state.")

    @model_validator(mode="after")
    def _policy_fits(self) -> Self:
        check_policy(self.policy, self.dynamics)
        if self.find and self.state not in self.values:
            raise ValueError(f"values: to find what is left open, the value of {self.state!r} is needed, too")
        return self

    @property
    def current(self) -> bool:
        """Whether the values are those of an earlier sweep, not the policy's."""
        return self.state in self.values and not self.find


def draw(level: int, rng: Draws) -> Given:
    """Two actions with one outcome each; then more of both, or current values; then a number to be found."""
    if level == 3:
        return _to_find(rng)
    setting = draw_setting(rng)
    state = rng.choice(setting.states[1:3])
    current = level == 2 and rng.chance(Fraction(1, 2))
    gamma = rng.fraction("1/2", "4/5")
    shape = Shape(states=4, actions=2, branches=level, reward=8, denominators=(2,))
    actions = setting.actions[: 2 if level == 1 else 2 + rng.below(2)]
    values = draw_values(rng, setting.states, gamma)
    rows: list[Transition] = []
    while not (rows and tells_apart(rows, values, gamma) and (not current or any(row.next == state for row in rows))):
        rows = [
            row
            for action in actions
            for targets in [
                draw_targets(rng, setting, setting.states, (state, action), shape, None if current else state)
            ]
            for row in draw_outcomes(rng, state, action, targets, shape)
        ]
    # Of two actions neither is as probable as the other: which has which probability would not show.
    chances = rng.shuffled((Fraction(1, 4), Fraction(3, 4))) if len(actions) == 2 else rng.split(3, (4,))
    return Given(
        dynamics=Dynamics(transitions=tuple(rows)),
        policy={state: dict(zip(actions, chances, strict=True))},
        values={name: values[name] for name in setting.states if any(row.next == name for row in rows)},
        gamma=gamma,
    )


def _to_find(rng: Draws) -> Given:
    """The value of the state comes first; then a number is left open that can be found from it."""
    setting = draw_setting(rng)
    state = rng.choice(setting.states[1:3])
    gamma = rng.fraction("1/2", "2/3", "4/5")
    shape = Shape(states=4, actions=2, branches=2, denominators=(4,))
    actions = setting.actions[: 2 + rng.below(2)]
    values = draw_values(rng, setting.states, gamma)
    chances, worths = draw_averaging(rng, len(actions), (4,), values[state])
    worths = worths or [values[state] + number for number in range(len(actions))]
    ahead = discounted(values, gamma)
    rows = [
        row
        for action, worth in zip(actions, worths, strict=True)
        for row in draw_paying(rng, setting, setting.states, (state, action), worth, ahead, shape)
    ]
    policy: PolicyField = {state: dict(zip(actions, chances, strict=True))}
    left: Scalar = gamma
    if len(actions) == 2 and rng.chance(Fraction(1, 2)):
        policy = {state: dict(zip(actions, (Parameter("p"), Parameter("1-p")), strict=True))}
    else:
        rows, left, _ = draw_letter(rng, rows, gamma, ("x", "p", "gamma"))
    return Given(
        dynamics=Dynamics(transitions=tuple(rows)),
        policy=policy,
        values={n: values[n] for n in setting.states if n == state or any(row.next == n for row in rows)},
        gamma=left,
        find=True,
    )


def question(given: Given) -> Question:
    """The model of one state, the policy and the values; one number is asked for."""
    state = given.state
    if given.find:
        (letter,) = given.unknown
        sign = shown(Parameter(letter))
        told = "The values under the policy are known."
        rate = "" if letter == "gamma" else f" {discount(given.gamma)}"
        told += f"{rate} {unknown(letter)}"
        part = Part(f"What is ${sign}$?", Number())
    else:
        told = (
            "Policy evaluation starts from these values $V_0$."
            if given.current
            else "The values of the next states under the policy are known."
        )
        told += f" {discount(given.gamma)}"
        of, after = ("V_1", ", the value after one Bellman backup") if given.current else ("V^π", "")
        part = Part(f'What is ${of}("{state}")${after}{in_open(given)}?', Number())
    blocks = (
        *outcomes_blocks(given.dynamics),
        Paragraph("The policy $π$ takes them with these probabilities:"),
        policy_table(given.policy),
        Paragraph(told),
        values_table(given.values, "V_0" if given.current else "V^π"),
    )
    return Question(blocks, (part,))
