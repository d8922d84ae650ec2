"""The values of actions in one state under a policy, from given values of the states."""

from collections.abc import Set
from typing import Self

from pydantic import model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, shown
from rldrill.problems.family import Question, flag
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Dynamics, Lookahead, Transition, draw_letter, outcomes_blocks, values_table
from rldrill.problems.parts import Number, Part, Values
from rldrill.problems.phrases import discount, in_open, unknown
from rldrill.problems.settings import Setting, Shape, draw_outcomes, draw_setting, draw_targets
from rldrill.problems.valued import discounted, draw_averaging, draw_paying, draw_values, tells_apart, worth

TITLE = "Action values from state values"
SOURCE = "Sutton & Barto 2018, section 3.5"
REVISION = 6


class Given(Lookahead):
    """What the actions of one state do, the values of the states under the policy, and the discount.

    With ``find`` the number left open is asked for with which both actions are worth the same.
    """

    chance: bool = flag("Whether it is also asked how probable the policy makes the first of two actions.")

    @model_validator(mode="after")
    def _two_actions(self) -> Self:
        for name, wanted in (("find", self.find), ("chance", self.chance)):
            if wanted and len(self.dynamics.pairs) != 2:
                raise ValueError(f"{name}: that is asked of two actions; give the transitions of two")
        if self.chance and (self.find or self.unknown or self.state not in self.values):
            raise ValueError(f"chance: it follows from the value of {self.state!r}; give it, and leave nothing open")
        return self

    def own_letters(self) -> Set[str]:
        """Besides those left open the letter p of what is asked for."""
        return super().own_letters() | ({"p"} if self.chance else set())


def draw(level: int, rng: Draws) -> Given:
    """One action with two outcomes; then several, or also the policy's choice; then what makes two actions equal."""
    setting = draw_setting(rng)
    state = setting.states[1]
    gamma = rng.fraction("1/2", "4/5") if level < 3 else rng.fraction("1/2", "2/3", "4/5")
    values = draw_values(rng, setting.states, gamma)
    if level == 3:
        rows = _equal(rng, setting, state, values, gamma)
        opened, left, _ = draw_letter(rng, rows, gamma, ("x", "x", "p", "gamma"))
        if any(old.probability == Fraction(1, 2) != new.probability for old, new in zip(rows, opened, strict=True)):
            return draw(level, rng)  # a half would be guessed
        chances = [row for row in opened if isinstance(row.probability, Parameter)]
        if any(Fraction(row.reward) + gamma * values.get(row.next, Fraction(0)) == 0 for row in chances):
            return draw(level, rng)  # a branch that is worth nothing would not be missed
        return Given(dynamics=Dynamics(transitions=tuple(opened)), values=_named(values, rows), gamma=left, find=True)
    if level == 2 and rng.chance(Fraction(1, 2)) and (worths := draw_averaging(rng, 2, (4, 5), values[state])[1]):
        shape, ahead = Shape(states=4, actions=2, branches=2), discounted(values, gamma)
        rows = [
            row
            for action, number in zip(setting.actions, worths, strict=False)
            for row in draw_paying(rng, setting, setting.states, (state, action), number, ahead, shape)
        ]
        return Given(
            dynamics=Dynamics(transitions=tuple(rows)),
            values=_named(values, rows, state),
            gamma=gamma,
            chance=True,
        )
    shape = Shape(
        states=4, actions=2, branches=level + 1, reward=6 + 2 * level, denominators=(2,) if level == 1 else (4, 5)
    )
    actions = setting.actions[: 1 if level == 1 else 2 + rng.below(2)]
    rows = []
    while len(rows) <= len(actions) or not tells_apart(rows, values, gamma):
        rows = [row for action in actions for row in _random(rng, setting, (state, action), shape)]
    return Given(dynamics=Dynamics(transitions=tuple(rows)), values=_named(values, rows), gamma=gamma)


def _random(rng: Draws, setting: Setting, pair: tuple[str, str], shape: Shape) -> list[Transition]:
    targets = draw_targets(rng, setting, setting.states, pair, shape, barred=pair[0])
    return draw_outcomes(rng, *pair, targets, shape)


def _equal(rng: Draws, setting: Setting, state: str, values: dict[str, Fraction], gamma: Fraction) -> list[Transition]:
    """Two actions that are worth the same, one of them with two outcomes."""
    shape = Shape(states=4, actions=2, branches=2, reward=8, denominators=(4,))
    while True:
        first, second = rng.sample(setting.actions, 2)
        rows = _random(rng, setting, (state, first), shape)
        if not tells_apart(rows, values, gamma):
            continue
        number = worth(Dynamics(transitions=tuple(rows)), (state, first), values, gamma)
        ahead = discounted(values, gamma)
        rows += draw_paying(rng, setting, setting.states, (state, second), number, ahead, shape, barred=state)
        net: dict[str, Fraction] = {}
        for row in rows:
            sign = 1 if row.action == first else -1
            net[row.next] = net.get(row.next, Fraction(0)) + sign * Fraction(row.probability)
        whole = all(row.reward.denominator == 1 for row in rows if isinstance(row.reward, Fraction))
        if len(rows) > 2 and all(net.values()) and whole:
            return rows


def _named(values: dict[str, Fraction], rows: list[Transition], own: str = "") -> dict[str, Fraction]:
    return {name: value for name, value in values.items() if name == own or any(row.next == name for row in rows)}


def question(given: Given) -> Question:
    """The model of one state and the values; the values of its actions are asked for, or what makes them equal."""
    pairs, state = given.dynamics.pairs, given.state
    what = f" {unknown(given.unknown[0])}" if given.find else ""
    rate = "" if given.find and given.unknown == ("gamma",) else f" {discount(given.gamma)}"
    blocks = (
        *outcomes_blocks(given.dynamics),
        Paragraph(f"The values of the states under a policy $π$ are known.{rate}{what}"),
        values_table(given.values, "V^π"),
    )
    if given.find:
        equal = " = ".join(f'Q^π("{state}", "{action}")' for _, action in pairs)
        return Question(blocks, (Part(f"For which ${shown(Parameter(given.unknown[0]))}$ is ${equal}$?", Number()),))
    one = f'What is $Q^π("{pairs[0][0]}", "{pairs[0][1]}")${in_open(given)}?'
    every = f'What is $Q^π("{state}", a)$ for every action $a${in_open(given)}?'
    parts = [Part(one if len(pairs) == 1 else every, Values("Q^π", pairs))]
    if given.chance:
        ask = f'With what probability $p = π("{pairs[0][1]}"|"{state}")$ does the policy choose {pairs[0][1]}?'
        parts.append(Part(ask, Number()))
    return Question(blocks, tuple(parts))
