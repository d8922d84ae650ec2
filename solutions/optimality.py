"""Optimal values of a model, exactly: Howard's policy iteration over the rationals."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import fmpq, fmpq_mat

from rldrill.problems.models import Model
from rldrill.solutions.exact import ONE, ZERO, NoSolution, exact


@dataclass(frozen=True)
class Optimum:
    """Optimal values, and in every state all actions that are best; where several are, they are tied exactly."""

    values: Mapping[str, fmpq]
    best: Mapping[str, tuple[str, ...]]

    @property
    def policy(self) -> dict[str, str]:
        """An optimal policy: of tied actions the first."""
        return {state: actions[0] for state, actions in self.best.items()}


@dataclass(frozen=True)
class _Choice:
    """One action of a state: the reward to be expected, and where it leads, terminal states left out."""

    action: str
    reward: fmpq
    onward: tuple[tuple[int, fmpq], ...]
    ends: bool

    def worth(self, values: Sequence[fmpq], gamma: fmpq) -> fmpq:
        return self.reward + gamma * sum((chance * values[after] for after, chance in self.onward), ZERO)


def optimum(mdp: Model, gamma: Fraction) -> Optimum:
    """The optimal values of a model, by policy iteration.

    Some hundreds of states take seconds: every policy is evaluated by one exact system of equations.

    Args:
        mdp: the model; no parameter may be left open in it.
        gamma: the discount, 0 to 1. With 1, every episode must be able to end.

    Raises:
        NoSolution: the discount is 1 and an episode may go on for ever without loss, so that there are no
            optimal values, or they are not those of a policy that ends.
    """
    table = _choices(mdp)
    discount = exact(gamma)
    chosen = _first_policy(mdp.states, table, endless=gamma == 1)
    while True:
        values = _evaluated(table, chosen, discount)
        worth = [[choice.worth(values, discount) for choice in choices] for choices in table]
        best = [max(row) for row in worth]
        # An action is kept while none is better: so the iteration ends, and no episode loses its end.
        better = [
            index if row[index] == top else row.index(top) for index, row, top in zip(chosen, worth, best, strict=True)
        ]
        if better == chosen:
            break
        chosen = better
    ties = [
        [choice for choice, value in zip(choices, row, strict=True) if value == top]
        for choices, row, top in zip(table, worth, best, strict=True)
    ]
    if gamma == 1:
        _demand_ends(mdp.states, ties)
    return Optimum(
        dict(zip(mdp.states, values, strict=True)),
        {state: tuple(c.action for c in choices) for state, choices in zip(mdp.states, ties, strict=True)},
    )


def _choices(mdp: Model) -> list[list[_Choice]]:
    place = {state: index for index, state in enumerate(mdp.states)}
    table: list[list[_Choice]] = [[] for _ in mdp.states]
    for (state, action), rows in mdp.outcomes.items():
        outcomes = [(row.next, exact(row.probability), exact(row.reward)) for row in rows if row.probability != 0]
        reward = sum((chance * earned for _, chance, earned in outcomes), ZERO)
        onward = tuple((place[after], chance) for after, chance, _ in outcomes if after in place)
        table[place[state]].append(_Choice(action, reward, onward, ends=len(onward) < len(outcomes)))
    return table


def _first_policy(states: Sequence[str], table: Sequence[Sequence[_Choice]], *, endless: bool) -> list[int]:
    """The action with the greatest reward everywhere; without discount, one that leads nearer to an end."""
    if not endless:
        return [max(range(len(choices)), key=lambda index: choices[index].reward) for choices in table]
    chosen: dict[int, int] = {}
    while len(chosen) < len(table):
        nearer = {
            state: index
            for state, choices in enumerate(table)
            if state not in chosen
            for index, choice in reversed(list(enumerate(choices)))
            if choice.ends or any(after in chosen for after, _ in choice.onward)
        }
        if not nearer:
            stuck = next(name for state, name in enumerate(states) if state not in chosen)
            raise NoSolution(f"with γ = 1 every episode must be able to end, but from {stuck} none can")
        chosen |= nearer
    return [chosen[state] for state in range(len(table))]


def _evaluated(table: Sequence[Sequence[_Choice]], chosen: Iterable[int], gamma: fmpq) -> list[fmpq]:
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
    try:
        return left.solve(right).entries()
    except ZeroDivisionError:  # an improvement gave up the end of an episode: what it goes round earns more than 0
        raise NoSolution("with γ = 1 an episode can earn more and more without an end") from None


def _demand_ends(states: Sequence[str], ties: Sequence[Sequence[_Choice]]) -> None:
    """Demand that no episode can go on for ever with best actions alone."""
    inside = set(range(len(ties)))
    while inside:
        leaving = {
            state
            for state in inside
            if all(choice.ends or any(after not in inside for after, _ in choice.onward) for choice in ties[state])
        }
        if not leaving:
            raise NoSolution(
                f"with γ = 1 an episode can go on for ever without loss, from {states[min(inside)]} for example"
            )
        inside -= leaving
