"""Models with values that fit them: drawn from whole values, and checked where somebody brings both."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import chain
from operator import add, mul
from typing import Literal, NamedTuple

from msgspec.structs import replace

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, Scalar, no_complement
from rldrill.problems.fractions import Fraction, plain
from rldrill.problems.models import (
    PARTLY_LISTED,
    Dynamics,
    Model,
    Policy,
    Transition,
    lists_all,
    never_left,
    policy_table,
    values_table,
)
from rldrill.problems.parts import Part, Values
from rldrill.problems.settings import Setting, Shape, draw_shares, draw_targets

#: Discounts, and the number whose multiples are still whole when they are discounted.
UNITS = {Fraction(1, 2): 2, Fraction(2, 3): 3, Fraction(4, 5): 5, Fraction(9, 10): 10}
_ATTEMPTS = 20
_LARGEST_REWARD = 12
#: Books print optimal values to two or three digits.
ROUNDING = Fraction(1, 100)


class Valued(NamedTuple):
    """A model, a policy of it, the policy's values, and what every action is worth with these values after it."""

    mdp: Model
    policy: dict[str, str]
    values: dict[str, Fraction]
    worths: dict[tuple[str, str], Fraction]


class Mixed(NamedTuple):
    """A model, the probabilities with which a policy chooses in it, and the policy's values."""

    mdp: Model
    policy: dict[str, dict[str, Scalar]]
    values: dict[str, Fraction]


def draw_valued(
    rng: Draws,
    setting: Setting,
    shape: Shape,
    gamma: Fraction,
    others: tuple[int, int],
    *,
    forked: Literal["all", "own", "others"] = "all",
) -> Valued:
    """Draw a model in which a policy has whole values.

    The values come first; the rewards follow from them, and so are whole, too.

    Args:
        rng: the draws.
        setting: the world.
        shape: how large the model is; its ``reward`` is not used.
        gamma: one of ``UNITS``.
        others: by how much the actions that the policy does not take are better, at least and at most (never 0).
        forked: which actions may have several outcomes: all, the policy's own, or only the others.
    """
    values = draw_values(rng, setting.states[: shape.states], gamma)
    surplus = [number for number in range(others[0], others[1] + 1) if number]
    policy, worths = {}, {}
    for state, value in values.items():
        policy[state] = rng.choice(setting.actions[: shape.actions])
        better = iter(rng.shuffled(surplus))
        for action in setting.actions[: shape.actions]:
            worths[state, action] = value + (0 if action == policy[state] else next(better))
    own = [(policy[state] == action) for state, action in worths]
    sure = [pair for pair, mine in zip(worths, own, strict=True) if forked == ("others" if mine else "own")]
    return Valued(draw_worth(rng, setting, shape, gamma, values, worths, sure), policy, values, worths)


def draw_mixed(rng: Draws, setting: Setting, shape: Shape, gamma: Fraction) -> Mixed:
    """Draw a model in which a policy that mixes its actions, by halves or quarters, has whole values.

    Args:
        rng: the draws.
        setting: the world.
        shape: how large the model is; its ``reward`` is not used.
        gamma: one of ``UNITS``.
    """
    values = draw_values(rng, setting.states[: shape.states], gamma)
    policy: dict[str, dict[str, Scalar]] = {}
    worths: dict[tuple[str, str], Fraction] = {}
    for state, value in values.items():
        actions = setting.actions[: shape.actions]
        numbers = None
        while numbers is None:  # else actions would be worth the same, and their probabilities would not matter
            one = (Fraction(1),), [value]
            chances, numbers = draw_averaging(rng, len(actions), (2, 4), value) if len(actions) > 1 else one
        policy[state] = dict(zip(actions, chances, strict=True))
        worths |= {(state, action): number for action, number in zip(actions, numbers, strict=True)}
    return Mixed(draw_worth(rng, setting, shape, gamma, values, worths), policy, values)


def draw_values(rng: Draws, states: tuple[str, ...], gamma: Fraction) -> dict[str, Fraction]:
    """Different values, not far from each other, that are whole when they are discounted, too, and never 0."""
    lowest = rng.whole(-2, 3)
    times = [number for number in (lowest + step for step in range(len(states) + 3)) if number]
    return {state: UNITS[gamma] * number for state, number in zip(states, rng.shuffled(times), strict=False)}


def tells_apart(rows: Iterable[Transition], values: Mapping[str, Fraction], gamma: Fraction) -> bool:
    """Whether the actions of a state are worth different numbers, and so are the outcomes of each."""
    ahead = {state: gamma * value for state, value in values.items()}
    outcomes: dict[tuple[str, str], list[Fraction]] = {}
    worths: dict[tuple[str, str], Fraction] = {}
    for state, action, after, chance, reward in rows:
        worth, pair = Fraction(reward) + ahead.get(after, 0), (state, action)
        outcomes.setdefault(pair, []).append(worth)
        worths[pair] = worths.get(pair, 0) + Fraction(chance) * worth
    return all(len({*row}) == len(row) for row in (*outcomes.values(), worths.values()))


def draw_worth(
    rng: Draws,
    setting: Setting,
    shape: Shape,
    gamma: Fraction,
    values: Mapping[str, Fraction],
    worths: Mapping[tuple[str, str], Fraction],
    sure: Sequence[tuple[str, str]] = (),
) -> Model:
    """A model of a world in which the actions are worth so much, if the states are worth what the values say.

    Those that are called sure have one outcome each.
    """
    ends = (setting.terminal,)
    places = (*setting.states[: shape.states], *ends)
    certain, ahead = replace(shape, branches=1), discounted(values, gamma)
    rows = [
        row
        for pair, worth in worths.items()
        for row in draw_paying(rng, setting, places, pair, worth, ahead, certain if pair in sure else shape)
    ]
    return Model(story=setting.told(ends), transitions=tuple(rows), terminal=ends)


def draw_paying(
    rng: Draws,
    setting: Setting,
    places: tuple[str, ...],
    pair: tuple[str, str],
    worth: Fraction,
    ahead: Mapping[str, int | Fraction],
    shape: Shape,
    barred: str | None = None,
) -> list[Transition]:
    """The transitions of one action, with whole rewards that make it worth what is wanted with what is ahead.

    No two of its outcomes are worth the same, so that their probabilities matter; none is the place that is barred.
    """
    wanted = plain(worth)
    for _ in range(_ATTEMPTS):
        targets = draw_targets(rng, setting, places, pair, shape, barred)
        shares, whole = draw_shares(rng, targets, shape)
        later = [ahead.get(target, 0) for target in targets]
        rewards = averaging(rng, shares, wanted * whole - sum(map(mul, shares, later)))
        if rewards is None or max(map(abs, rewards)) > _LARGEST_REWARD:
            continue
        if len({*map(add, rewards, later)}) == len(targets):
            return [
                Transition(*pair, target, Fraction(share, whole), Fraction(reward))
                for target, share, reward in zip(targets, shares, rewards, strict=True)
            ]
    target = next(place for place in setting.reached(places, *pair) if place != barred)
    return [Transition(*pair, target, Fraction(1), worth - ahead.get(target, 0))]


def discounted(values: Mapping[str, Fraction], gamma: Fraction) -> dict[str, int | Fraction]:
    """What the states are worth a step before they are reached."""
    return {state: plain(gamma * value) for state, value in values.items()}


def draw_averaging(
    rng: Draws, count: int, denominators: Sequence[int], mean: Fraction
) -> tuple[tuple[Fraction, ...], list[Fraction] | None]:
    """Probabilities, and different whole numbers with that mean, if some are found."""
    shares, whole = rng.shares(count, denominators)
    numbers = averaging(rng, shares, plain(mean) * whole)
    found = None if numbers is None else [*map(Fraction, numbers)]
    return tuple([Fraction(share, whole) for share in shares]), found


def averaging(rng: Draws, shares: tuple[int, ...], total: int | Fraction) -> list[int] | None:
    """Different whole numbers that make up a total, each taken as often as its share says, as far as some are found."""
    first, *others = shares
    if not others:
        return None if total % first else [int(total // first)]
    near = total // sum(shares) - 4
    for _ in range(_ATTEMPTS):
        rest = [near + rng.below(9) for _ in others]
        number, left = divmod(total - sum(map(mul, others, rest)), first)
        if not left and len({number, *rest}) == len(shares):
            return [number, *rest]
    return None


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
            raise ValueError(
                f"values: {state!r} is given as {values[state]}, but one step of the policy gives {total}; "
                "correct one of them"
            )
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
        if abs(best - values[state]) > ROUNDING * max(Fraction(1), abs(best)):
            raise ValueError(
                f"values: {state!r} is given as {values[state]}, but its best action is worth {best}; correct it"
            )


def open_reward(model: Model) -> Transition:
    """The one transition whose reward is left open; nothing else may be.

    Raises:
        ValueError: it is not exactly one reward that is left open, or it is one minus a letter.
    """
    rows = [row for row in model.transitions if isinstance(row.reward, Parameter)]
    if len(rows) != 1 or any(isinstance(row.probability, Parameter) for row in model.transitions):
        raise ValueError("mdp: leave exactly one number open, a reward, such as x; it is asked for")
    no_complement(rows[0].reward)
    return rows[0]


class RewardSought:
    """Givens whose model leaves one reward open, which is asked for."""

    mdp: Model

    def parameters(self) -> tuple[str, ...]:
        """No answer is an expression in what is left open: it is asked for."""
        return ()

    @property
    def row(self) -> Transition:
        """The transition whose reward is left open."""
        return open_reward(self.mdp)


def opened(model: Model, row: Transition) -> Model:
    """The model with x for the reward of one transition."""
    rows = tuple(row._replace(reward=Parameter("x")) if each is row else each for each in model.transitions)
    return Model(story=model.story, transitions=rows, terminal=model.terminal)


def with_reward(model: Model, reward: Fraction) -> Model:
    """The model with a number for the reward that is left open."""
    rows = tuple(row._replace(reward=reward) if isinstance(row.reward, Parameter) else row for row in model.transitions)
    return Model(story=model.story, transitions=rows, terminal=model.terminal)


def policy_values(model: Model, policy: Mapping[str, Mapping[str, Fraction]], gamma: Fraction) -> dict[str, Fraction]:
    """The values of a policy by elimination; γ is below 1, and nothing is left open."""
    lines = {}
    for state in model.states:
        line = [Fraction(other == state) for other in (*model.states, None)]
        for action, chance in policy[state].items():
            line[-1] += chance * worth(model, (state, action), {}, gamma)
            for row in model.outcomes[state, action]:
                if row.next in policy:
                    line[model.states.index(row.next)] -= gamma * chance * Fraction(row.probability)
        lines[state] = line
    for place, state in enumerate(model.states):  # the diagonal is never 0, for γ is below 1
        lines[state] = [number / lines[state][place] for number in lines[state]]
        for other in model.states:
            if other != state:
                factor = lines[other][place]
                lines[other] = [a - factor * b for a, b in zip(lines[other], lines[state], strict=True)]
    return {state: line[-1] for state, line in lines.items()}


def deterministic(policy: Mapping[str, str]) -> dict[str, dict[str, Fraction]]:
    """A policy of one action for each state, as probabilities."""
    return {state: {action: Fraction(1)} for state, action in policy.items()}


def choices_table(policy: Mapping[str, str], of: str = "π") -> Table:
    """A policy of one action for each state, one column for every state."""
    return Table(header=("$s$", *policy), rows=((f"${of}(s)$", *policy.values()),))


def policy_blocks(policy: Policy, mdp: Dynamics) -> tuple[Block, ...]:
    """A policy as a question gives it: by its actions, or by its probabilities where it mixes them."""
    certain = {state: action for state, row in policy.items() for action, chance in row.items() if chance == 1}
    if len(certain) == len(policy):
        return (Paragraph("The policy $π$ is:"), choices_table(certain))
    told = "The policy $π$ is:" if lists_all(policy, mdp) else PARTLY_LISTED
    return (Paragraph(told), policy_table(policy))


def known_or_asked(values: Mapping[str, Fraction] | None, states: tuple[str, ...]) -> tuple[list[Block], list[Part]]:
    """The values of π as a question gives them, or the part that asks for them first."""
    if values is None:
        ask = "What is $V^π(s)$, the value of every state under $π$?"
        return [], [Part(ask, Values("V^π", states))]
    return [Paragraph("The values under $π$ are known:"), values_table(values, "V^π")], []
