"""Conditional probabilities from the table, compared history by history."""

from typing import Any

import numpy as np

from rldrill.problems.document import joined
from rldrill.problems.fundamentals.markov_property import Given, where
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, Value, exact, sign
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.fundamentals import (
    HISTORY_LEFT_OUT,
    JOINT_FOR_CONDITIONAL,
    MARKOV_PROPERTY,
    RELATIVE_FREQUENCY,
)
from rldrill.solutions.work import Work

#: Probabilities by the state before, the present state and the next one.
Chances = dict[tuple[str, str, str], Value]


def solve(given: Given, work: Work) -> None:
    """The probability asked for after every history, then the other next states, then the comparison."""
    chances = _chances(given, work)
    work.recall(MARKOV_PROPERTY)
    matters = _matters(given, chances)
    for now in given.present:
        _compare(given, work, now, chances, differs=now in matters)
    _conclude(given, work, matters)


def _chances(given: Given, work: Work) -> Chances:
    asked = _asked(given, work)
    others = [after for after in given.outcomes if after != given.asked]
    if len(others) == 1:  # the rest to 1
        return asked
    return asked | {(*h, after): _probability(given, work, h, after) for h in given.histories for after in others}


def _asked(given: Given, work: Work) -> Chances:
    asked = work.answer({history: _probability(given, work, history, given.asked) for history in given.histories})
    return {(*history, given.asked): chance for history, chance in asked.items()}


def _probability(given: Given, work: Work, history: tuple[str, str], after: str) -> Value:
    S = dict(enumerate((*history, after)))
    return work.step(RELATIVE_FREQUENCY, S=S, N=_counts(given), states=_states(given), t=1)


def _matters(given: Given, chances: Chances) -> tuple[str, ...]:
    """The present states in which some probability of the next state depends on the state before."""

    def differ(now: str, after: str) -> bool:
        first, *rest = (chances[(*history, after)] for history in given.histories if history[1] == now)
        return any(sign(first - other) for other in rest)

    states = {now: {after for _, known, after in chances if known == now} for now in given.present}
    return tuple(now for now, nexts in states.items() if any(differ(now, after) for after in nexts))


def _counts(given: Given) -> dict[tuple[str, str, str], Value]:
    return knowns.Sparse({row[:3]: exact(row.weight) for row in given.table})


def _conclude(given: Given, work: Work, matters: tuple[str, ...]) -> None:
    verdict = _verdict(given, matters)
    work.answer(verdict[0])
    if len(verdict) > 1:
        work.say(f"What $s_{{t-1}}$ was matters {_in_words(matters)}.")
        work.answer(verdict[1])


def _states(given: Given) -> tuple[str, ...]:
    return tuple(dict.fromkeys(state for row in given.table for state in row[:3]))


def _verdict(given: Given, matters: tuple[str, ...]) -> tuple[Any, ...]:
    """Whether it is Markov, and the letter of the option that says where it is not."""
    letters = {text: letter for letter, text in where(given).items()}
    if not letters:
        return (not matters,)
    *_, none, several = letters
    return not matters, letters[none if not matters else several if len(matters) > 1 else matters[0]]


def _in_words(matters: tuple[str, ...]) -> str:
    return f"in {joined(list(matters))}" if matters else "in no state"


def _compare(given: Given, work: Work, now: str, chances: Chances, *, differs: bool) -> None:
    """Say which two probabilities differ, or that none do."""
    if not differs:
        work.say(f"In {now}, what comes next has the same probabilities after every history.")
        return
    for after in given.outcomes:
        values = [(h[0], chances[(*h, after)]) for h in given.histories if h[1] == now and (*h, after) in chances]
        for before, value in values[1:]:
            if sign(value - values[0][1]):
                work.say(
                    f"In {now}, the next state is {after} with probability ${values[0][1]}$ if {values[0][0]} came "
                    f"before, but with ${value}$ if {before} did: the history matters, so this is not Markov."
                )
                return


def _hidden(given: Given) -> bool:
    return _matters(given, _chances(given, Work())) != _matters(given, _asked(given, Work()))


def _totals(given: Given) -> Chances:
    seen = _counts(given)
    return {(*h, ""): sum((seen[(*h, after)] for after in given.outcomes), ZERO) for h in given.histories}


def _uneven(given: Given) -> bool:
    right, totals = (_matters(given, chances) for chances in (_chances(given, Work()), _totals(given)))
    return _verdict(given, totals) != _verdict(given, right)


@slip(
    "one-next-state",
    "The probabilities of all next states must be independent of the history, not only that of the one asked for.",
    when=_hidden,
)
def one_next_state(given: Given, work: Work) -> None:
    """Only the next state that was asked for is compared."""
    _conclude(given, work, _matters(given, _asked(given, work)))


@slip(
    "totals-compared",
    "Histories need not be equally frequent: compare what follows them, each by its own total.",
    when=_uneven,
)
def totals_compared(given: Given, work: Work) -> None:
    """How often each history occurs is compared."""
    _asked(given, work)
    _conclude(given, work, _matters(given, _totals(given)))


MISCONCEPTIONS = (JOINT_FOR_CONDITIONAL, HISTORY_LEFT_OUT, one_next_state, totals_compared)


def oracle(given: Given) -> Answers:
    """An array of the counts; it is Markov in a state where the histories' rows are proportional: of rank one."""
    befores, nexts = tuple(dict.fromkeys(b for b, _ in given.histories)), given.outcomes
    counts = np.zeros((len(befores), len(given.present), len(nexts)))
    for row in given.table:
        counts[befores.index(row.before), given.present.index(row.now), nexts.index(row.next)] = at(row.weight)
    asked = counts[:, :, nexts.index(given.asked)]
    share = [
        asked[befores.index(before), given.present.index(now)]
        / counts[befores.index(before), given.present.index(now)].sum()
        for before, now in given.histories
    ]
    broken = [now for j, now in enumerate(given.present) if np.linalg.matrix_rank(counts[:, j], tol=1e-9) > 1]
    answers: list[Any] = [share, not broken]
    options = list(where(given).items())
    if options:
        place = -2 if not broken else -1 if len(broken) > 1 else given.present.index(broken[0])
        answers.append(options[place][0])
    return answers
