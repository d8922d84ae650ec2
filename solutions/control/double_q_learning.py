"""Double Q-learning along a run: one table selects the next action, the other one says what it is worth."""

from collections.abc import Callable, Sequence
from typing import Any

from rldrill.problems.control.double_q_learning import Given
from rldrill.solutions import knowns
from rldrill.solutions.asking_back import find, oracle_along
from rldrill.solutions.exact import NoSolution, exact, parameters, to_sympy
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.knowns import NO_ACTION
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.control import (
    DOUBLE_Q_ACTION,
    DOUBLE_Q_LEARNING,
    NOT_DISCOUNTED,
    OTHER_TABLE_SELECTS,
    ROLES_EXCHANGED,
    SAME_TABLE_EVALUATES,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """For every transition the action selected, then the update of the one table."""
    _learn(given, work, lambda turn: (turn,))


@slip(
    "both-tables-updated",
    "Each transition updates one table only, the one that the coin says; the other stays as it is.",
    when=lambda given: len(set(given.updates)) > 1 and bool(set(given.updated_in(1)) & set(given.updated_in(2))),
)
def both_updated(given: Given, work: Work) -> None:
    """For every transition the update of both tables, from the values before it."""
    _learn(given, work, lambda turn: (3 - turn, turn))


@slip(
    "next-action-taken",
    "The target takes the best action of the table that is updated; the action taken there would be Sarsa's.",
    when=lambda given: len(given.trajectory.actions) > 1,
)
def next_taken(given: Given, work: Work) -> None:
    """The action that the agent takes next, where that is known."""
    _learn(given, work, lambda turn: (turn,), selected=given.trajectory.actions[1:])


MISCONCEPTIONS = (
    SAME_TABLE_EVALUATES,
    OTHER_TABLE_SELECTS,
    ROLES_EXCHANGED.where_it_shows(),
    NOT_DISCOUNTED,
    both_updated,
    next_taken.where_it_shows(),
)


def _learn(given: Given, work: Work, updated: Callable[[int], tuple[int, ...]], selected: Sequence[str] = ()) -> None:
    """Every transition updates the tables that ``updated`` makes of the one that the coin says.

    The actions that are ``selected`` in the first next states take the place of those that the table selects.
    """
    run = given.trajectory
    known = knowns.action_run(given)
    work.say("$Q_i$ is the table that is updated, $Q_j$ the other one.")
    tables = {(1, *pair): value for pair, value in known["Q"].items()}
    tables |= {(2, *pair): value for pair, value in known["Q"].items()}  # what nobody gave: nothing after the end
    tables |= {(2, state, a): exact(value) for state, row in given.second.items() for a, value in row.items()}
    for time, (turn, *pair) in enumerate(zip(given.updates, run.states, run.actions, strict=False)):
        ended = run.states[time + 1] in run.terminal
        last = " and ends the episode, so nothing comes after its reward" if ended else ""
        work.say(f"The transition at $t = {time}$ updates $Q_{turn}${last}:")
        chosen = selected[time] if time < len(selected) else None
        tables = tables | {(table, *pair): _update(work, table, time, tables, known, chosen) for table in updated(turn)}
        if given.outcome and time == len(given.updates) - 1:
            if given.outcome[:2] not in given.updated_in(turn):
                where = f"({given.outcome.state}, {given.outcome.action})"
                raise NoSolution(f"outcome: Q_{turn}, the table of the last update, does not change at {where}")
            worth = {pair: tables[turn, *pair] for pair in given.updated}
            find(given, given.outcome, work, worth, given.values if turn == 1 else given.second, f"Q_{turn}")
            return
        later = {table for turn in given.updates[time + 1 :] for table in updated(turn)}
        for table in updated(turn):
            if table not in later and not given.outcome:
                answer = work.answer({pair: tables[table, *pair] for pair in given.updated_in(table)})
                tables = tables | {(table, *pair): value for pair, value in answer.items()}


def _update(
    work: Work, table: int, time: int, tables: dict[Any, Any], known: dict[str, Any], chosen: str | None
) -> Any:
    known = {**known, "i": table, "j": 3 - table, "t": time, "Qi": tables}
    best = chosen or NO_ACTION
    if chosen is None and known["actions"][known["S"][time + 1]] != (NO_ACTION,):
        best, *_ = work.step(DOUBLE_Q_ACTION, **known)
        after = known["S"][time + 1]
        worth = tables[3 - table, after, best]
        told = "" if parameters(worth) else f" = {to_sympy(worth)}"
        work.say(f'The target takes $Q_{3 - table}("{after}", "{best}"){told}$.')
    return work.step(DOUBLE_Q_LEARNING, selected={time + 1: best}, **known)


def oracle(given: Given) -> Answers:
    """The values after the run; or where one is known, the parameter that leads there."""
    return oracle_along(given, _learned, given.updated_in(given.updates[-1]))


def _learned(given: Given) -> Answers:
    """Both tables as one array with an axis for the table; the selection by the position of the greatest."""
    run = given.trajectory
    states = list(given.values)
    actions = [list(row) for row in given.values.values()]
    Q = np.full((2, len(states), max(map(len, actions))), -np.inf)
    for number, rows in enumerate((given.values, given.second)):
        for row, state in enumerate(states):
            for column, action in enumerate(actions[row]):
                Q[number, row, column] = at(rows[state][action])
    for time, table in enumerate(given.updates):
        mine, other = table - 1, 2 - table
        row = states.index(run.states[time])
        target = at(run.rewards[time])
        if (after := run.states[time + 1]) not in run.terminal:
            there = states.index(after)
            target += at(given.gamma) * Q[other, there, np.round(Q[mine, there], 10).argmax()]
        column = actions[row].index(run.actions[time])
        Q[mine, row, column] = np.interp(at(given.alpha), [0, 1], [Q[mine, row, column], target])
    return [
        [Q[table - 1, states.index(s), actions[states.index(s)].index(a)] for s, a in given.updated_in(table)]
        for table in given.asked
    ]
