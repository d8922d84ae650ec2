"""Action values learned along a run: an update for every transition, with the values then current."""

from collections.abc import Mapping
from typing import Any

from flint import fmpq

from rldrill.problems.control import q_learning, sarsa
from rldrill.problems.document import begun, joined
from rldrill.solutions import knowns
from rldrill.solutions.asking_back import answer_along
from rldrill.solutions.exact import Value, told
from rldrill.solutions.formula.compiling import arg_max
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.sheet.control import Q_LEARNING
from rldrill.solutions.work import Work


def learn(given: q_learning.Given | sarsa.Given, work: Work, update: Formula, error: Formula) -> None:
    """Update pair after pair by a formula; answer with the TD errors too, by theirs, if they are asked for."""
    known = knowns.action_values(given)
    errors: list[Value] = []
    for seen in knowns.moves(given):
        if update is Q_LEARNING and (greatest := greatest_told(work, known, seen["S"][seen["t"] + 1])):
            work.say(f"{begun(greatest)}.")
        if given.td_errors:
            errors.append(work.step(error, **seen, **known))
        pair = seen["S"][seen["t"]], seen["A"][seen["t"]]
        known["Q"] = known["Q"] | {pair: work.step(update, **seen, **known)}
    if given.td_errors and not given.outcome:
        work.answer(tuple(errors) if len(errors) > 1 else errors[0])
        work.say("The updates above give these values.")
    answer_along(given, work, known["Q"], given.updated)


def greatest_told(work: Work, known: Mapping[str, Any], state: str) -> str:
    """Which action value Q-learning takes in a state; nothing where the episode ends there, or a letter is in one."""
    values = {action: known["Q"][state, action] for action in known["actions"][state]}
    if work.misconception is not None or len(values) == 1 or any(type(value) is not fmpq for value in values.values()):
        return ""
    best = arg_max(tuple(values), tuple(values.values()))
    greatest = "" if len(values) == len(best) else " greatest"
    has = f"have the same{greatest}" if len(best) > 1 else f"has the {'greater' if len(values) == 2 else 'greatest'}"
    return f"in {state}, {joined([*best])} {has} value, ${told(values[best[0]])}$"
