"""Action values learned along a run: an update for every transition, with the values then current."""

from rldrill.problems.control import q_learning, sarsa
from rldrill.solutions import knowns
from rldrill.solutions.asking_back import answer_along
from rldrill.solutions.exact import Value
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.work import Work


def learn(given: q_learning.Given | sarsa.Given, work: Work, update: Formula, error: Formula) -> None:
    """Update pair after pair by a formula; answer with the TD errors too, by theirs, if they are asked for."""
    known = knowns.action_values(given)
    errors: list[Value] = []
    for seen in knowns.moves(given):
        if given.td_errors:
            errors.append(work.step(error, **seen, **known))
        pair = seen["S"][seen["t"]], seen["A"][seen["t"]]
        known["Q"] = known["Q"] | {pair: work.step(update, **seen, **known)}
    if given.td_errors and not given.outcome:
        work.answer(tuple(errors) if len(errors) > 1 else errors[0])
        work.say("The updates above give these values.")
    answer_along(given, work, known["Q"], given.updated)
