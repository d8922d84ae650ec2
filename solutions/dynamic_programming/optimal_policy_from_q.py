"""The action with the greatest value; a missing value is a reward and the best value after it."""

from typing import Any

from msgspec.structs import replace

from rldrill.problems.dynamic_programming.optimal_policy_from_q import Given
from rldrill.problems.exact import Parameter, shown
from rldrill.problems.models import Dynamics
from rldrill.solutions import knowns
from rldrill.solutions.answers.kinds import text_of
from rldrill.solutions.exact import ZERO, Value, exact, largest
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.greedy import taken
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bellman import (
    BELLMAN_OPTIMALITY_Q,
    OPTIMAL_Q_BY_REWARD,
    OPTIMAL_Q_BY_VALUE,
    OPTIMAL_Q_MEAN_FOR_MAX,
)
from rldrill.solutions.sheet.dynamic_programming import (
    GREEDY_FROM_Q,
    SMALLEST_Q,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """What is missing first, then the best action of every state."""
    _solve(given, work, rank=0)


def _solve(given: Given, work: Work, rank: int) -> None:
    """A reward that is asked for makes its action as good as the one of the others with this rank, 0 for the best."""
    actions = given.actions | dict.fromkeys(given.terminal, (knowns.NO_ACTION,))
    Q = {(state, action): exact(value) for state, row in given.values.items() for action, value in row.items()}
    Q |= {(state, knowns.NO_ACTION): ZERO for state in given.terminal}
    found: dict[tuple[str, str], Value] = {}
    if given.missing and given.gamma is not None:
        known = knowns.model(given.missing) | {"actions": actions, "gamma": exact(given.gamma), "Q": Q}
        asked = given.gaps[: -1 if given.tied else None]
        if asked:
            found = work.answer({(s, a): work.step(BELLMAN_OPTIMALITY_Q, s=s, a=a, **known) for s, a in asked})
    Q = Q | found
    if given.tied:
        _tie(given, given.tied, work, known | {"Q": Q}, rank)
    others = [state for state in given.values if not given.tied or state != given.tied[0]]
    if others:
        best = {state: work.step(GREEDY_FROM_Q, s=state, Q=Q, actions=actions) for state in others}
        work.say(f"So these actions are optimal: {taken(best)}.")
        work.answer(best)


def _tie(given: Given, tied: tuple[str, str], work: Work, known: dict[str, Any], rank: int) -> None:
    """The reward with which an action is worth as much as the best of the others, or as one that is worse."""
    state, action = tied
    value = work.step(BELLMAN_OPTIMALITY_Q, s=state, a=action, **known)
    rivals = tuple(name for name in given.actions[state] if name != action)
    others = [known["Q"][state, name] for name in rivals]
    best = largest(others)
    for _ in range(rank):
        others.remove(best)
        best = largest(others)
    work.say(f"The best of the other actions in {state} is worth ${text_of(best)}$. Both are equal for:")
    (letter,) = given.left_open
    equal = work.equate(letter, value, best)
    work.say(f"What {action} is worth grows with ${shown(Parameter(letter))}$, so this is the smallest one.")
    work.answer(equal)


@slip(
    "held-against-the-second-best",
    "To be optimal the action must be worth as much as the best of the others, not only as much as the second best.",
    when=lambda given: given.tied and len(given.actions[given.tied[0]]) > 2,
)
def second_best(given: Given, work: Work) -> None:
    """Equated with the second best of the other actions."""
    _solve(given, work, rank=1)


MISCONCEPTIONS = (
    SMALLEST_Q,
    replace(OPTIMAL_Q_BY_VALUE, when=lambda given: given.tied is None),
    OPTIMAL_Q_BY_REWARD,
    OPTIMAL_Q_MEAN_FOR_MAX,
    second_best.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """Each missing value as an expectation over its outcomes; the best action by sorting."""
    table = {state: {action: at(value) for action, value in row.items()} for state, row in given.values.items()}
    worth = {state: max(row.values()) for state, row in table.items() if row} | dict.fromkeys(given.terminal, 0.0)
    answers: list[object] = []
    if given.missing and given.gamma is not None:
        found = _missing(given.missing, at(given.gamma), worth, 0.0)
        asked = given.gaps[: -1 if given.tied else None]
        for state, action in asked:
            table[state][action] = found[state, action]
        if asked:
            answers.append([found[pair] for pair in asked])
        if given.tied:
            one = _missing(given.missing, at(given.gamma), worth, 1.0)[given.tied]
            rival = max(table[given.tied[0]].values())
            answers.append((rival - found[given.tied]) / (one - found[given.tied]))
            del table[given.tied[0]]
    if table:
        answers.append({s: {a for a, q in row.items() if q > max(row.values()) - 1e-9} for s, row in table.items()})
    return answers


def _missing(missing: Dynamics, gamma: float, worth: dict[str, float], x: float) -> dict[tuple[str, str], float]:
    found = dict.fromkeys(missing.pairs, 0.0)
    for row in missing.transitions:
        found[row.state, row.action] += at(row.probability, x) * (at(row.reward, x) + gamma * worth[row.next])
    return found
