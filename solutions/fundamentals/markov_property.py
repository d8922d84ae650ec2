"""Conditional probabilities from the table, compared history by history."""

from rldrill.problems.document import joined
from rldrill.problems.fractions import Fraction
from rldrill.problems.fundamentals.markov_property import Given, Seen, where
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, NoSolution, Value, exact, is_rational, sign, told
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.fundamentals import (
    COLUMN_FOR_ROW,
    HISTORY_LEFT_OUT,
    JOINT_FOR_CONDITIONAL,
    MARKOV_PROPERTY,
    RELATIVE_FREQUENCY,
    of_joint,
)
from rldrill.solutions.work import Work

_COUNT = "N(s_{t-1}, s_t, s_{t+1})$ is the count"
#: Probabilities by the state before, the present state and the next one.
Chances = dict[tuple[str, str, str], Value]


def solve(given: Given, work: Work) -> None:
    """A count that is missing; the probability asked for after every history; of the others what is needed then."""
    what = "Pr(s_{t-1}, s_t, s_{t+1})$ is the joint probability" if given.probabilities else _COUNT
    work.say(f"${what} of three successive states in the table.")
    whole = _completed(given, work)
    asked = _asked(whole, work)
    work.say("A decision process has the Markov property if, with its actions and rewards,")
    work.recall(MARKOV_PROPERTY)
    work.say("Here only the states are considered, so it implies: $Pr(s_{t+1} | s_{t-1}, s_t) = Pr(s_{t+1} | s_t)$.")
    if found := _matters(whole, asked):
        _compare(whole, work, found, asked, found)
        rest = tuple(now for now in whole.present if now not in found)
        matters = found
        if where(given) and rest:
            chances = asked | _others(whole, work, rest)
            matters = tuple(now for now in whole.present if now in {*found, *_matters(whole, chances)})
            _compare(whole, work, rest, chances, matters)
    else:
        chances = asked | _others(whole, work, whole.present)
        matters = _matters(whole, chances)
        _compare(whole, work, whole.present, chances, matters)
    _conclude(given, work, matters)


def _completed(given: Given, work: Work) -> Given:
    """The table with the count that is asked for: its share must be that after another history."""
    hidden = given.missing
    if hidden is None:
        return given
    other = next(h for h in given.histories if h[1] == hidden.now and h[0] != hidden.before)
    share = _probability(given, work, hidden[:2], hidden.next)
    wanted = _probability(given, work, other, hidden.next)
    work.say("Both must be the same:")
    found = work.equate(str(hidden.weight), share, wanted)
    if work.misconception is None and is_rational(found) and not given.probabilities and (found < 0 or found.q != 1):
        raise NoSolution(f"the missing count would have to be {told(found)}, and counts are whole numbers")
    count = work.answer(found)  # somebody's own need not be a whole number
    if not is_rational(count):
        raise NoSolution("the missing count must be a number")
    rows = [row._replace(weight=Fraction(int(count.p), int(count.q))) if row == hidden else row for row in given.table]
    return given.model_copy(update={"table": tuple(rows)})


def _chances(given: Given, work: Work) -> Chances:
    return _asked(given, work) | _others(given, work, given.present)


def _others(given: Given, work: Work, present: tuple[str, ...]) -> Chances:
    """The probabilities of the other next states in these present states, but for the last: it has the rest to 1."""
    others = [after for after in given.outcomes if after != given.asked][:-1]
    histories = [history for history in given.histories if history[1] in present]
    return {(*h, after): _probability(given, work, h, after) for h in histories for after in others}


def _asked(given: Given, work: Work) -> Chances:
    asked = work.answer({history: _probability(given, work, history, given.asked) for history in given.histories})
    return {(*history, given.asked): chance for history, chance in asked.items()}


def _probability(given: Given, work: Work, history: tuple[str, str], after: str) -> Value:
    S = dict(enumerate((*history, after)))
    formula = of_joint(RELATIVE_FREQUENCY) if given.probabilities else RELATIVE_FREQUENCY
    return work.step(formula, S=S, N=_counts(given), states=_states(given), t=1)


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
    """Whether the table is consistent, or where it is not."""
    if where(given):
        work.say(f"The distribution of $s_{{t+1}}$ depends on $s_{{t-1}}$ {_in_words(matters)}.")
    work.say(f"So the table is {'not ' if matters else ''}consistent with the Markov property.")
    work.answer(_verdict(given, matters))


def _states(given: Given) -> tuple[str, ...]:
    """All states, the next ones first, in the order of the table."""
    return tuple(dict.fromkeys((*given.outcomes, *(state for row in given.table for state in row[:2]))))


def _verdict(given: Given, matters: tuple[str, ...]) -> bool | str:
    """Whether it is Markov; or the letter of the option that says where it is not."""
    letters = {text: letter for letter, text in where(given).items()}
    if not letters:
        return not matters
    *_, none, several = letters
    return letters[none if not matters else several if len(matters) > 1 else matters[0]]


def _in_words(matters: tuple[str, ...]) -> str:
    return f"for $s_t$ = {joined(list(matters))}" if matters else "for no $s_t$"


def _compare(given: Given, work: Work, present: tuple[str, ...], chances: Chances, matters: tuple[str, ...]) -> None:
    """Say of each of these present states which two probabilities differ, or that none do."""
    for now in present:
        if now in matters:
            _contrast(given, work, now, chances)
        else:
            first = next(history for history in given.histories if history[1] == now)
            same = [
                f"{after} with probability ${chances[(*first, after)]}$"
                for after in given.outcomes
                if (*first, after) in chances
            ]
            work.say(f"For $s_t$ = {now} the next state is {joined(same)} after every history.")


def _contrast(given: Given, work: Work, now: str, chances: Chances) -> None:
    """Say which two probabilities differ."""
    for after in given.outcomes:
        values = [(h[0], chances[(*h, after)]) for h in given.histories if h[1] == now and (*h, after) in chances]
        for before, value in values[1:]:
            if sign(value - values[0][1]):
                work.say(
                    f"For $s_t$ = {now} the next state is {after} with probability ${values[0][1]}$ if "
                    f"$s_{{t-1}}$ = {values[0][0]}, but with ${value}$ if $s_{{t-1}}$ = {before}: not Markov."
                )
                return


def _hidden(given: Given) -> bool:
    given = _completed(given, Work())
    return _matters(given, _chances(given, Work())) != _matters(given, _asked(given, Work()))


def _totals(given: Given) -> Chances:
    seen = _counts(given)
    return {(*h, ""): sum((seen[(*h, after)] for after in given.outcomes), ZERO) for h in given.histories}


def _uneven(given: Given) -> bool:
    whole = _completed(given, Work())
    right, totals = (_matters(whole, chances) for chances in (_chances(whole, Work()), _totals(whole)))
    return _verdict(given, totals) != _verdict(given, right)


@slip(
    "one-next-state",
    "The probabilities of all next states must be independent of the history, not only that of the one asked for.",
    when=_hidden,
)
def one_next_state(given: Given, work: Work) -> None:
    """Only the next state that was asked for is compared."""
    whole = _completed(given, work)
    _conclude(given, work, _matters(whole, _asked(whole, work)))


@slip(
    "another-next-state",
    "Above the line stands what the table has for the next state that is asked for, not for another one.",
)
def another_next_state(given: Given, work: Work) -> None:
    """The first column that is not the one asked for."""
    other = next(after for after in given.outcomes if after != given.asked)
    solve(given.model_copy(update={"asked": other}), work)


@slip(
    "totals-compared",
    "Histories need not be equally frequent: compare what follows them, each by its own total.",
    when=_uneven,
)
def totals_compared(given: Given, work: Work) -> None:
    """How often each history occurs is compared."""
    whole = _completed(given, work)
    _asked(whole, work)
    _conclude(given, work, _matters(whole, _totals(whole)))


MISCONCEPTIONS = (
    JOINT_FOR_CONDITIONAL,
    HISTORY_LEFT_OUT,
    COLUMN_FOR_ROW.where_it_shows(),
    one_next_state,
    totals_compared,
    another_next_state.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """An array of the counts; it is Markov in a state where the histories' rows are proportional: of rank one."""
    if given.missing is not None:
        return _proportional(given, given.missing)
    share, broken = _of_rank_one(given)
    options = [*where(given)]
    if not options:
        return [share, not broken]
    place = -2 if not broken else -1 if len(broken) > 1 else given.present.index(broken[0])
    return [share, options[place]]


def _of_rank_one(given: Given) -> tuple[list[float], list[str]]:
    """The probabilities after every history, and the present states whose rows are not proportional."""
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
    return share, broken


def _proportional(given: Given, hidden: Seen) -> Answers:
    """The missing count by the rule of three, and the answers for the table with it."""
    rows = {row[:3]: row.weight for row in given.table if row != hidden}
    other = next(h for h in given.histories if h[1] == hidden.now and h[0] != hidden.before)
    rest, its_rest = (
        sum(at(weight) for key, weight in rows.items() if key[:2] == history and key[2] != hidden.next)
        for history in (hidden[:2], other)
    )
    count = at(rows.get((*other, hidden.next), Fraction(0))) * rest / its_rest
    number = Fraction(count).limit_denominator(10**6)
    table = tuple(row._replace(weight=number) if row == hidden else row for row in given.table)
    share, broken = _of_rank_one(given.model_copy(update={"table": table}))
    return [count, share, not broken]
