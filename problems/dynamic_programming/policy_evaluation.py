"""Values after some sweeps of iterative policy evaluation, synchronous or in place."""

from pydantic import Field

from rldrill.problems.document import Block, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, dot
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import (
    Model,
    ModelAndPolicy,
    PolicyField,
    Process,
    Transition,
    model_blocks,
    open_chance,
    policy_blocks,
)
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import discount, in_open
from rldrill.problems.settings import Setting, Shape, draw_outcomes, draw_setting, draw_targets
from rldrill.problems.sweeps import SYNCHRONOUS, Sweeps, begin, counted, in_place
from rldrill.problems.transition_tables import ALONE
from rldrill.problems.valued import draw_values, tells_apart, worth

TITLE = "Iterative policy evaluation"
SOURCE = "Sutton & Barto 2018, section 4.1"
REVISION = 9


class Given(ModelAndPolicy, Sweeps):
    """A model, a policy (without one, every action is equally probable), the discount, and the kind of sweeps.

    A Markov reward process has no actions: then the rows of its transitions are state, next state, probability, reward.
    """

    mdp: Process
    in_place: bool = Field(
        default=False, description="Whether a sweep uses values as soon as they are new, state by state."
    )


def draw(level: int, rng: Draws) -> Given:
    """One synchronous sweep from given values; then three states in place, or two sweeps; then γ or π left open.

    Rewards are even, and values to start from multiples of what the discount makes whole: so the numbers stay small.
    """
    setting = draw_setting(rng)
    started = level == 1 or (level == 2 and rng.chance(Fraction(1, 2)))
    states = 2 if level == 1 else 3 if started else 2 + rng.below(2)
    alone = level > 1 and rng.chance(Fraction(1, 3))
    gamma = rng.fraction("1/2", "4/5") if started else Fraction(1, 2)
    in_place = (level == 2 and started) or (level == 3 and states == 2 and rng.chance(Fraction(1, 2)))
    sure = level == 1 or (not alone and (states == 3 or (in_place and not started)))
    shape = Shape(states=states, actions=2, branches=1 if sure else 2, denominators=(2,))
    start = draw_values(rng, setting.states[:states], gamma)
    places = (*setting.states[:states], setting.terminal)
    actions = (ALONE,) if alone else setting.actions[:2]
    rows: list[Transition] = []
    while not rows or (started and not _used(rows, setting.states[:states], in_place=in_place)):
        rows = []
        for state in setting.states[:states]:
            found = _even(rng, setting, places, state, actions, shape)
            while not tells_apart(found, start if started else {}, gamma):
                found = _even(rng, setting, places, state, actions, shape)
            rows += found
    mdp = Model(story=setting.told((setting.terminal,)), transitions=tuple(rows), terminal=(setting.terminal,))
    open_gamma = level == 3 and (alone or rng.chance(Fraction(1, 2)))
    policy: PolicyField | None = None
    if not alone:
        policy = {
            state: dict(zip(actions, rng.split(2, (2, 4) if started else (2,)), strict=True))
            for state, actions in mdp.actions.items()
        }
        if level == 3 and not open_gamma:
            chosen = rng.choice(mdp.states)
            policy[chosen] = dict(zip(policy[chosen], (Parameter("p"), Parameter("1-p")), strict=True))
    given = Given(
        mdp=mdp,
        policy=policy,
        gamma=Parameter("gamma") if open_gamma else gamma,
        sweeps=1 if started else 2,
        start=start if started else None,
        in_place=in_place,
    )
    return given if level == 3 or _readable(given, gamma, 2 if level == 1 else 100) else draw(level, rng)


def _readable(given: Given, gamma: Fraction, below: int) -> bool:
    """Whether chances, sweeps and, in place, every new value matter, and the numbers are small below the line, too."""
    values = dict(given.start or dict.fromkeys(given.mdp.states, Fraction(0)))
    for _ in range(given.sweeps):
        before, values = values, _swept(given, values, gamma)
        if not values or (given.in_place and any(values[state] == before[state] for state in values)):
            return False
    small = all(value.denominator <= below and abs(value.numerator) <= 300 for value in values.values())
    return small and _swept(given, values, gamma) not in ({}, values)


def _swept(given: Given, before: dict[str, Fraction], gamma: Fraction) -> dict[str, Fraction]:
    """The values after one sweep more; none, if there is a probability that does not matter in it."""
    values = dict(before)
    for state, row in given.chances.items():
        ahead = values if given.in_place else before
        if not tells_apart([each for each in given.mdp.transitions if each.state == state], ahead, gamma):
            return {}
        worths = [worth(given.mdp, (state, action), ahead, gamma) for action in row]
        values[state] = dot([Fraction(chance) for chance in row.values()], worths)
    return values


def _used(rows: list[Transition], states: tuple[str, ...], *, in_place: bool) -> bool:
    """Whether each value to start from is used in the first sweep; in place, by a state that is not updated later."""
    return all(
        any(row.next == state and (not in_place or row.state in states[: index + 1]) for row in rows)
        for index, state in enumerate(states)
    )


def _even(
    rng: Draws, setting: Setting, places: tuple[str, ...], state: str, actions: tuple[str, ...], shape: Shape
) -> list[Transition]:
    return [
        row._replace(reward=2 * Fraction(row.reward))
        for action in actions
        for row in draw_outcomes(rng, state, action, draw_targets(rng, setting, places, (state, action), shape), shape)
    ]


def question(given: Given) -> Question:
    """The model, the policy and the kind of sweep; the values after the last sweep are asked for."""
    k = given.sweeps
    sweeps = in_place(given.mdp.states) if given.in_place else SYNCHRONOUS
    blocks: tuple[Block, ...] = (
        *model_blocks(given.mdp),
        *policy_blocks(given),
        *begin(given, "Policy evaluation"),
        Paragraph(f"{discount(given.gamma)}{open_chance(given)} {sweeps}"),
    )
    ask = f"What is $V_{{{k}}}(s)$, the value of every state after {counted(k)}{in_open(given)}?"
    return Question(blocks, (Part(ask, Values(f"V_{{{k}}}", given.mdp.states)),))
