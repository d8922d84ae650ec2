"""Models with values that fit them: drawn from whole values, and checked where somebody brings both."""

from collections.abc import Mapping
from fractions import Fraction
from itertools import chain
from typing import NamedTuple

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.models import Dynamics, Model, Policy, Transition, never_left, policy_table, values_table
from rldrill.problems.parts import Part, Values
from rldrill.problems.settings import Setting, Shape

#: Discounts, and the number whose multiples are still whole when they are discounted.
UNITS = {Fraction(1, 2): 2, Fraction(2, 3): 3, Fraction(4, 5): 5, Fraction(9, 10): 10}
_ATTEMPTS = 40
_LARGEST_REWARD = 12
#: Books print optimal values to two or three digits.
_ROUNDING = Fraction(1, 100)


class Valued(NamedTuple):
    """A model, a policy of it, and the policy's values."""

    mdp: Model
    policy: dict[str, str]
    values: dict[str, Fraction]


def draw_valued(rng: Draws, setting: Setting, shape: Shape, gamma: Fraction, others: tuple[int, int]) -> Valued:
    """Draw a model in which a policy has whole values.

    The values come first; the rewards follow from them, and so are whole, too.

    Args:
        rng: the draws.
        setting: the world.
        shape: how large the model is; its ``reward`` is not used.
        gamma: one of ``UNITS``.
        others: by how much the actions that the policy does not take are better, at least and at most (never 0).
    """
    states = setting.states[: shape.states]
    times = rng.shuffled([number for number in range(-1, max(16 // UNITS[gamma], len(states)) + 2) if number])
    values = {state: Fraction(UNITS[gamma] * number) for state, number in zip(states, times, strict=False)}
    surplus = [number for number in range(others[0], others[1] + 1) if number]
    ahead = values | {setting.terminal: Fraction(0)}
    actions = setting.actions[: shape.actions]
    policy, rows = {}, []
    for state in states:
        policy[state] = rng.choice(actions)
        better = iter(rng.shuffled(surplus))
        targets = rng.shuffled(tuple(ahead))  # each action leads somewhere else, as far as there are enough states
        for index, action in enumerate(actions):
            worth = values[state] + (0 if action == policy[state] else next(better))
            towards = targets[index % len(targets)]
            rows += _draw_worth(rng, (state, action), worth, towards, ahead, gamma, shape)
    return Valued(Model(story=setting.story, transitions=tuple(rows), terminal=(setting.terminal,)), policy, values)


def _draw_worth(
    rng: Draws,
    pair: tuple[str, str],
    worth: Fraction,
    towards: str,
    values: Mapping[str, Fraction],
    gamma: Fraction,
    shape: Shape,
) -> list[Transition]:
    """The transitions of one action, with whole rewards that make it worth what is wanted."""
    for _ in range(_ATTEMPTS):
        chosen = {towards, *rng.sample(tuple(values), rng.below(shape.branches))}
        targets = tuple(target for target in values if target in chosen)
        chances = (Fraction(1),) if len(targets) == 1 else rng.split(len(targets), shape.denominators)
        ahead = sum(chance * values[target] for chance, target in zip(chances, targets, strict=True))
        mean = worth - gamma * ahead
        rewards = [mean + difference for difference in _spread(rng, chances)]
        if mean.denominator == 1 and max(map(abs, rewards)) <= _LARGEST_REWARD:
            return [
                Transition(*pair, target, chance, reward)
                for target, chance, reward in zip(targets, chances, rewards, strict=True)
            ]
        towards = rng.choice(tuple(values))
    return [Transition(*pair, tuple(values)[-1], Fraction(1), worth)]  # the end: nothing comes after it


def _spread(rng: Draws, chances: tuple[Fraction, ...]) -> list[Fraction]:
    """Whole differences between the rewards of one action that are 0 on average."""
    if len(chances) == 1:
        return [Fraction(0)]
    first, second, *rest = chances
    ratio = second / first
    times = rng.whole(-2, 2)
    return [times * ratio.numerator, -times * Fraction(ratio.denominator), *(Fraction(0) for _ in rest)]


def worth(model: Dynamics, pair: tuple[str, str], values: Mapping[str, Fraction], gamma: Fraction) -> Fraction:
    """What an action earns on average, with these values after it; nothing may be left open."""
    return sum(
        (Fraction(row.probability) * (Fraction(row.reward) + gamma * values.get(row.next, 0))
         for row in model.outcomes[pair]), Fraction(0),
    )  # fmt: skip


def check_policy_values(values: Mapping[str, Fraction], policy: Policy, model: Model, gamma: Fraction) -> None:
    """Demand that values are those of the policy: one step of it must give them back.

    Without discount that does not settle the values of states in which the policy goes round for ever: they are
    expected totals, 0 where no step there earns anything (Puterman 1994, section 7.1).

    Raises:
        ValueError: a state has another value.
    """
    for state, row in policy.items():
        total = sum(Fraction(chance) * worth(model, (state, action), values, gamma) for action, chance in row.items())
        if total != values[state]:
            raise ValueError(f"values: {state!r} is given as {values[state]}, but one step of the policy gives {total}")
    for state in chain.from_iterable(never_left(model, policy) if gamma == 1 else ()):
        nothing = dict.fromkeys(values, Fraction(0))
        pay = sum(Fraction(p) * worth(model, (state, action), nothing, gamma) for action, p in policy[state].items())
        if pay != 0:
            raise ValueError(
                f"values: with γ = 1 {state!r} has no value, for the policy comes back to it for ever and earns {pay} "
                "on average there each time; let that step pay nothing, or take gamma below 1"
            )
        if values[state] != 0:
            raise ValueError(
                f"values: {state!r} is given as {values[state]}, but its value under the policy is 0: with γ = 1 it is "
                "the sum of all rewards, and the policy goes round there for ever and earns nothing; give 0"
            )


def check_optimal_values(values: Mapping[str, Fraction], model: Dynamics, gamma: Fraction) -> None:
    """Demand that values are the optimal ones, as far as rounding may hide it: the best action gives them back.

    Raises:
        ValueError: a state has another value.
    """
    for state, actions in model.actions.items():
        best = max(worth(model, (state, action), values, gamma) for action in actions)
        if abs(best - values[state]) > _ROUNDING * max(Fraction(1), abs(best)):
            raise ValueError(f"values: {state!r} is given as {values[state]}, but its best action is worth {best}")


def deterministic(policy: Mapping[str, str]) -> dict[str, dict[str, Fraction]]:
    """A policy of one action for each state, as probabilities."""
    return {state: {action: Fraction(1)} for state, action in policy.items()}


def choices_table(policy: Mapping[str, str], of: str = "π") -> Table:
    """A policy of one action for each state, one column for every state."""
    return Table(header=("$s$", *policy), rows=((f"${of}(s)$", *policy.values()),))


def policy_blocks(policy: Policy) -> tuple[Block, ...]:
    """A policy as a question gives it: by its actions, or by its probabilities where it mixes them."""
    certain = {state: action for state, row in policy.items() for action, chance in row.items() if chance == 1}
    table = choices_table(certain) if len(certain) == len(policy) else policy_table(policy)
    return (Paragraph("The policy $π$ is:"), table)


def known_or_asked(values: Mapping[str, Fraction] | None, states: tuple[str, ...]) -> tuple[list[Block], list[Part]]:
    """The values of π as a question gives them, or the part that asks for them first."""
    if values is None:
        ask = "What is $V^π(s)$, the value of every state under $π$?"
        return [], [Part(ask, Values("V^π", states))]
    return [Paragraph("The values under $π$ are known:"), values_table(values, "V^π")], []
