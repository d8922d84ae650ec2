"""Optimal values of a model, exactly: Howard's policy iteration over the rationals."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache
from itertools import chain
from typing import NoReturn

from flint import fmpq, fmpq_mat
from msgspec import Struct, field

from rldrill.problems.document import joined
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Model
from rldrill.problems.recurrence import Ways, end_components, loop_through, predecessors, ranks
from rldrill.solutions.endless import Loop, no_value
from rldrill.solutions.exact import ONE, ZERO, NoSolution, exact
from rldrill.solutions.numerics import np
from rldrill.solutions.work import Work

#: The effort that the sweeps may take by which it is found out whether value iteration comes to the optimal values.
_SWEPT_OUTCOMES = 2_000_000
#: Up to so many states policy iteration is exact from the first; the rounds that floating point takes before it at
#: most, and what counts as better there.
_FEW, _ROUNDS, _CLEARLY = 40, 60, 1e-9
#: The name of the way that a state has beside its actions: to go round for ever in a loop that pays nothing.
_STAY = ""
#: When sweeps have settled, and how far from the values they must be then.
_SETTLED, _UNLIKE = 1e-13, 1e-6

ONLY_GREEDY = (
    "The policy is greedy for its own values, but with $γ = 1$ that is not enough: to go round for ever in a loop that "
    "pays nothing is worth $0$, and that is better here. So the policy is not optimal."
)


class Optimum(Struct, frozen=True):
    """Optimal values, and in every state all actions that are best; where several are, they are tied exactly.

    Attributes:
        values: the optimal values.
        best: the best actions; without discount the first of them make an optimal policy.
        putting_off: without discount, the actions that are worth as much as the best by the optimality equation, but
            that no optimal policy takes each time: they only go round.
        unlike_sweeps: without discount, a state in which value iteration that begins with 0 comes to something else,
            and that number, rounded.
    """

    values: Mapping[str, fmpq]
    best: Mapping[str, tuple[str, ...]]
    putting_off: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    unlike_sweeps: tuple[str, str] | None = None

    @property
    def policy(self) -> dict[str, str]:
        """An optimal policy: of tied actions the first."""
        return {state: actions[0] for state, actions in self.best.items()}

    def among(self, greedy: Mapping[str, tuple[str, ...]]) -> dict[str, tuple[str, ...]]:
        """Of greedy actions those that are best: those that only put off the end are left out."""
        return {
            state: tuple(action for action in actions if action not in self.putting_off.get(state, ())) or actions
            for state, actions in greedy.items()
        }

    def tell(self, work: Work) -> None:
        """Say in the working which greedy actions are not best."""
        if self.putting_off:
            told = joined([f"{' or '.join(actions)} in {state}" for state, actions in self.putting_off.items()])
            work.say(
                f"Taken each time, these only go round and never earn what the others do; they are not best: {told}."
            )


class _Choice(Struct, frozen=True):
    """One action of a state: the reward to be expected, and where it leads, terminal states left out."""

    action: str
    reward: fmpq
    onward: tuple[tuple[int, fmpq], ...]
    ends: bool

    @property
    def targets(self) -> tuple[int, ...]:
        return tuple(after for after, _ in self.onward)

    def worth(self, values: Sequence[fmpq], gamma: fmpq) -> fmpq:
        return self.reward + gamma * sum((chance * values[after] for after, chance in self.onward), ZERO)


_Table = Sequence[Sequence[_Choice]]


@lru_cache(maxsize=8)  # the solution of a problem asks for it, and so does every mistake
def optimum(mdp: Model, gamma: Fraction) -> Optimum:
    """The optimal values of a model, by policy iteration.

    A thousand states take seconds: every policy is evaluated by one exact system of equations.

    Without discount they are the greatest expected totals of all policies, those among them that never end: a loop
    that pays nothing is worth 0, one that costs is worth −∞ (Puterman 1994, chapter 7).

    Args:
        mdp: the model; no parameter may be left open in it.
        gamma: the discount, 0 to 1.

    Raises:
        NoSolution: the discount is 1, and in some state the greatest total is infinite or does not exist.
    """
    table = _choices(mdp)
    if gamma == 1:
        return _undiscounted(mdp, table)
    first = [max(range(len(choices)), key=lambda index: choices[index].reward) for choices in table]
    _, values, worth = _improved(table, first, exact(gamma))
    return Optimum(
        dict(zip(mdp.states, values, strict=True)),
        {
            state: tuple(table[place][index].action for index in _greatest(row))
            for place, (state, row) in enumerate(zip(mdp.states, worth, strict=True))
        },
    )


def is_optimal(mdp: Model, gamma: Fraction, values: Mapping[str, object]) -> bool:
    """Whether the values of a policy that is greedy for them are optimal: without discount that need not be."""
    return gamma != 1 or all(values[state] == best for state, best in optimum(mdp, gamma).values.items())


def _choices(mdp: Model) -> list[list[_Choice]]:
    place = {state: index for index, state in enumerate(mdp.states)}
    table: list[list[_Choice]] = [[] for _ in mdp.states]
    for (state, action), rows in mdp.outcomes.items():
        outcomes = [(row.next, exact(row.probability), exact(row.reward)) for row in rows if row.probability != 0]
        reward = sum((chance * earned for _, chance, earned in outcomes), ZERO)
        onward = tuple((place[after], chance) for after, chance, _ in outcomes if after in place)
        table[place[state]].append(_Choice(action, reward, onward, ends=len(onward) < len(outcomes)))
    return table


def _greatest(row: Sequence[fmpq]) -> list[int]:
    top = max(row)
    return [index for index, value in enumerate(row) if value == top]


def _improved(
    table: _Table, chosen: Sequence[int], gamma: fmpq, states: Sequence[str] = ()
) -> tuple[list[int], list[fmpq], list[list[fmpq]]]:
    """Policy iteration from a policy on, to the last: it, its values, and what every action is worth then.

    With ``states`` there is no discount: a policy that never ends is refused, by their names.
    """
    chosen = _near_best(table, chosen, gamma)
    while True:
        if states:
            _demand_end(states, table, chosen)
        values = _evaluated(table, chosen, gamma)
        worth = [[choice.worth(values, gamma) for choice in choices] for choices in table]
        # An action is kept while none is better: so the iteration ends.
        better = [
            index if index in (best := _greatest(row)) else best[0] for index, row in zip(chosen, worth, strict=True)
        ]
        if better == chosen:
            return chosen, values, worth
        chosen = better


def _near_best(table: _Table, first: Sequence[int], gamma: fmpq) -> list[int]:
    """A policy to begin with that leaves little to improve: found in floating point where there are many states.

    It is only a guess. Without discount it must end, as the first one does, or the first one is taken.
    """
    size = len(table)
    if size <= _FEW:
        return list(first)
    pay = [np.array([_float(choice.reward) for choice in choices]) for choices in table]
    onward = [np.zeros((len(choices), size)) for choices in table]
    for state, choices in enumerate(table):
        for index, choice in enumerate(choices):
            for after, chance in choice.onward:
                onward[state][index, after] = _float(gamma * chance)
    chosen = list(first)
    for _ in range(_ROUNDS):
        chain = np.eye(size) - np.array([onward[state][index] for state, index in enumerate(chosen)])
        try:
            values = np.linalg.solve(chain, [pay[state][index] for state, index in enumerate(chosen)])
        except np.linalg.LinAlgError:
            return list(first)
        worth = [pay[state] + onward[state] @ values for state in range(size)]
        better = [
            int(row.argmax()) if row.max() > row[index] + _CLEARLY * (1 + abs(row[index])) else index
            for row, index in zip(worth, chosen, strict=True)
        ]
        if better == chosen:
            break
        chosen = better
    return chosen if gamma != 1 or not end_components(_of(table, chosen)) else list(first)


def _of(table: _Table, chosen: Sequence[int]) -> dict[int, list[tuple[int, tuple[int, ...]]]]:
    """Where a policy leads from the states in which it cannot end."""
    return {s: [(index, table[s][index].targets)] for s, index in enumerate(chosen) if not table[s][index].ends}


def _evaluated(table: _Table, chosen: Iterable[int], gamma: fmpq) -> list[fmpq]:
    """The values of a deterministic policy."""
    size = len(table)
    left = fmpq_mat(size, size)
    right = fmpq_mat(size, 1)
    for state, index in enumerate(chosen):
        choice = table[state][index]
        left[state, state] = ONE
        for after, chance in choice.onward:
            left[state, after] -= gamma * chance
        right[state, 0] = choice.reward
    return left.solve(right).entries()


def _demand_end(states: Sequence[str], table: _Table, chosen: Sequence[int]) -> None:
    """Demand that a policy ends: an improvement that gives up the end goes round where a step earns more than 0."""
    for component in end_components(_of(table, chosen)):
        loop = _loop(states, table, {state: labels[0] for state, labels in component.items()})
        raise NoSolution(no_value(loop, "an episode can go on for ever with", "let the loop pay nothing"))


def _undiscounted(mdp: Model, table: _Table) -> Optimum:
    """The greatest expected totals.

    Every state of a loop that pays nothing gets one way more, to stay in it for ever; then policies that end are
    enough, and policy iteration from one of them leads to the best.
    """
    states = mdp.states
    idle = end_components(_ways(table, lambda _, choice: choice.reward == 0))
    finishing = _finishing(table, set(chain.from_iterable(idle)))
    stuck = [state for state in range(len(table)) if state not in finishing]
    stay = _Choice(_STAY, ZERO, (), ends=True)
    resting = {*chain.from_iterable(idle), *stuck}
    longer = [[*choices, stay] if state in resting else list(choices) for state, choices in enumerate(table)]
    first = [_nearer(choices, finishing, finishing.get(state)) for state, choices in enumerate(longer)]
    chosen, values, worth = _improved(longer, first, ONE, states)
    best = [_greatest(row[: len(choices)]) for row, choices in zip(worth, table, strict=True)]
    tight = _ways(table, lambda state, choice: choice.worth(values, ONE) == values[state])
    if stuck:
        _refuse_stuck(states, table, tight, stuck, best)
    around = end_components(tight)
    for component in around:
        _demand_settled(states, table, component, values)
    for component in idle:
        if any(longer[state][chosen[state]] is stay for state in component):
            for state, inside in component.items():
                chosen[state] = inside[0]
    useful = list(best)
    still = [component for component in idle if values[next(iter(component))] == 0]
    finishing_ways = _finishing_ways(table, best, still)
    for state in chain.from_iterable(around):
        if len(best[state]) > 1:
            useful[state] = sorted(finishing_ways(state), key=lambda index: index != chosen[state])
    return Optimum(
        dict(zip(states, values, strict=True)),
        {name: tuple(table[place][index].action for index in useful[place]) for place, name in enumerate(states)},
        {
            name: tuple(table[place][index].action for index in best[place] if index not in useful[place])
            for place, name in enumerate(states)
            if len(useful[place]) < len(best[place])
        },
        _unlike_sweeps(states, table, values) if idle else None,
    )


def _ways(table: _Table, kept: Callable[[int, _Choice], bool]) -> dict[int, list[tuple[int, tuple[int, ...]]]]:
    """Where the actions lead that are kept, without those that may end the episode."""
    return {
        state: [(index, c.targets) for index, c in enumerate(choices) if not c.ends and kept(state, c)]
        for state, choices in enumerate(table)
    }


def _finishing(table: _Table, loops: Iterable[int]) -> dict[int, int]:
    """How far it is to an end, or where none can be reached to a loop that pays nothing; such a loop comes later."""
    every = {state: [(index, c.targets) for index, c in enumerate(choices)] for state, choices in enumerate(table)}
    before = predecessors(every)
    near = ranks(before, [state for state, choices in enumerate(table) if any(choice.ends for choice in choices)])
    return {state: len(table) + rank for state, rank in ranks(before, loops).items()} | near


def _nearer(choices: Sequence[_Choice], rank: Mapping[int, int], own: int | None) -> int:
    """An action that may lead nearer to an end, or may end the episode."""
    for index, choice in enumerate(choices):
        if own is not None and any(rank.get(after, own) < own for after in choice.targets):
            return index
    return next(index for index, choice in enumerate(choices) if choice.ends)


def _refuse_stuck(
    states: Sequence[str],
    table: _Table,
    tight: Ways[int, int],
    stuck: Sequence[int],
    best: Sequence[Sequence[int]],
) -> NoReturn:
    """Say of states from which neither an end nor a loop that pays nothing can be reached what they are worth.

    Raises:
        NoSolution: always.
    """
    cure = "give it a way to an end, let the loop pay nothing"
    for component in end_components({state: tight[state] for state in stuck}):
        if loop := _paying_loop(states, table, component):
            raise NoSolution(no_value(loop, "no end can be reached, only for ever", cure))
    best_ways = {state: [(best[state][0], table[state][best[state][0]].targets)] for state in stuck}
    loop = _loop(states, table, {state: labels[0] for state, labels in end_components(best_ways)[0].items()})
    raise NoSolution(no_value(loop, "no end can be reached, and the best that can be done for ever is", cure))


def _demand_settled(
    states: Sequence[str], table: _Table, component: Mapping[int, Sequence[int]], values: Sequence[fmpq]
) -> None:
    """Demand that nobody can put off a loss for ever, by what is earned and paid back again and again."""
    if any(values[state] < 0 for state in component) and (loop := _paying_loop(states, table, component)):
        cure = "give one of these actions another reward"
        raise NoSolution(no_value(loop, "instead of taking a loss an episode can go on for ever with", cure))


def _paying_loop(states: Sequence[str], table: _Table, component: Mapping[int, Sequence[int]]) -> Loop | None:
    """A loop of a component in which something is earned or paid, if there is one."""
    ways = {state: [(index, table[state][index].targets) for index in labels] for state, labels in component.items()}
    for state, row in ways.items():
        for way in row:
            if table[state][way[0]].reward != 0:
                return _loop(states, table, loop_through({**ways, state: [way]}, state))
    return None


def _loop(states: Sequence[str], table: _Table, chosen: Mapping[int, int]) -> Loop:
    picked = {state: table[state][index] for state, index in chosen.items()}
    return Loop(
        {states[state]: (choice.action,) for state, choice in picked.items()},
        {states[state]: choice.reward for state, choice in picked.items()},
        {states[state]: {states[after]: chance for after, chance in c.onward} for state, c in picked.items()},
    )


def _finishing_ways(
    table: _Table, best: Sequence[Sequence[int]], still: Sequence[Mapping[int, Sequence[int]]]
) -> Callable[[int], list[int]]:
    """What tells of a state those best actions that an optimal policy can take each time: it still ends, or rests.

    Args:
        table: the actions.
        best: of every state the actions that are worth most.
        still: the loops that pay nothing where no more can be had than nothing.
    """
    ways = {state: [(index, table[state][index].targets) for index in row] for state, row in enumerate(best)}
    before = predecessors(ways)
    ends = [state for state, row in enumerate(best) if any(table[state][index].ends for index in row)]

    def finishing(state: int) -> list[int]:
        rests = [component for component in still if state not in component]
        here = next((component for component in still if state in component), {})
        if here:
            kept = {s: [(i, table[s][i].targets) for i in row] for s, row in here.items() if s != state}
            rests += end_components(kept)
        # The state itself leads nowhere here: nothing comes to the end by way of it.
        reached = ranks({**before, state: []}, [*ends, *chain.from_iterable(rests)])
        return [
            index
            for index in best[state]
            if table[state][index].ends
            or index in here.get(state, ())
            or any(after in reached and after != state for after in table[state][index].targets)
        ]

    return finishing


def _unlike_sweeps(states: Sequence[str], table: _Table, values: Sequence[fmpq]) -> tuple[str, str] | None:
    """Where value iteration from 0 settles at something else, and at what; it can where rewards have both signs."""
    rewards = [choice.reward for choices in table for choice in choices]
    if min(rewards) >= 0 or max(rewards) <= 0:
        return None
    rows = [[(_float(c.reward), [(after, _float(p)) for after, p in c.onward]) for c in choices] for choices in table]
    swept, outcomes = [0.0] * len(rows), sum(1 + len(choice.onward) for choices in table for choice in choices)
    for _ in range(_SWEPT_OUTCOMES // outcomes):
        before, swept = swept, [max(r + sum(p * swept[after] for after, p in to) for r, to in row) for row in rows]
        if max(abs(new - old) for new, old in zip(swept, before, strict=True)) < _SETTLED:
            break
    else:
        return None  # they do not settle in time, so nothing is said
    for name, sweep, value in zip(states, swept, values, strict=True):
        if abs(sweep - _float(value)) > _UNLIKE * (1 + abs(sweep)):
            return name, f"{sweep:.4g}".replace("-", "−")
    return None


def _float(value: fmpq) -> float:
    return int(value.p) / int(value.q)
