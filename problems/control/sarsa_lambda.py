"""The eligibility traces and the action values after updates of Sarsa(λ), or of Watkins's Q(λ), along a run."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.asking_back import BackRun, Outcome, back_asked, draw_rows
from rldrill.problems.document import Paragraph, joined
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, OpenShare, Parameter, shown
from rldrill.problems.family import Question, flag
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.models import Named, check_keys
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import in_open, not_known
from rldrill.problems.runs import Replacing, ShortRun, action_values_table, draw_action_run, readable, run_situation

TITLE = "Sarsa(λ)"
SOURCE = "Sutton & Barto 2018, section 12.7; 1998, section 7.5"
REVISION = 8
DISTRACTORS = ("values.*",)  # a table has the values of other pairs, too

_CUT = (
    "The TD error takes the greatest action value of the next state. Where an action is taken that is not greedy, all "
    "traces are set to $0$ before its own visit counts; whether it is greedy is told by the values with which the TD "
    "error of the transition before it was worked out."
)


class Given(BackRun):
    """A run with all its actions, the action values before it, α, γ and λ; traces from before it, if there are any."""

    trajectory: ShortRun = Field(description="What the agent did.")
    lam: OpenShare = Field(description="The decay of the traces, besides the discount.")
    traces: Named[Named[Exact]] | None = Field(
        default=None, description="The traces before the run; all 0 without them."
    )
    replacing: Replacing = False
    watkins: bool = flag("Whether Watkins's Q(λ) learns instead of Sarsa(λ).")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.watkins and self.outcome is not None:
            raise ValueError("outcome: with watkins no letter is found from it; leave one of them out")
        if not self.watkins:
            self.demand_last_action("Sarsa(λ)")
        elif self.parameters():
            raise ValueError(f"{self.parameters()[0]} is left open, so no action can be called greedy; give a number")
        for state, row in (self.traces or {}).items():
            check_keys({state: row}, tuple(self.values), "the trace", needed=())
            check_keys(row, tuple(self.values[state]), f"the trace in {state!r}", needed=())
        return self

    @property
    def eligible(self) -> tuple[tuple[str, str], ...]:
        """The pairs that have a trace after the run: those visited, and those that had one before."""
        before = [(state, action) for state, row in (self.traces or {}).items() for action in row if row[action]]
        return tuple(dict.fromkeys((*self.updated, *before)))

    @property
    def moved(self) -> tuple[tuple[str, str], ...]:
        """The same: every pair with a trace learns."""
        return self.eligible


#: α, γ and λ whose product is a simple number; different ones, or an exchange of two would go unnoticed.
_RATES = (("1/4", "1", "1/2"), ("1/2", "3/4", "2/3"))


def draw(level: int, rng: Draws) -> Given:
    """One transition with a trace from before; then two, also back to a pair; then λ left open, or asked back for."""
    if level == 3 and rng.chance(Fraction(2, 3)):
        return _back(rng)
    replacing = level == 2 and rng.chance(Fraction(1, 4))
    again = ("aba.", "abab", "abac")  # the first pair's trace decays, and is visited again
    visits = {1: ("ab",), 2: ("ab.", "aba", "aab", "aa.", "abb", "abc"), 3: (*again, "aab")}[level]
    shape = rng.choice(again[::2] if replacing else visits)
    trajectory, values = draw_action_run(rng, shape, 2 if level == 1 else 3, same=level > 1)
    comes_back = len(set(shape)) < len(shape)
    alpha, gamma, lam = map(fraction_of, rng.choice(_RATES[: 2 if level == 2 and not comes_back else 1]))
    traces = None
    if level == 1:
        traced = trajectory.states[1], rng.choice(tuple(values[trajectory.states[1]]))
        traces = {
            state: {action: Fraction((state, action) == traced) for action in row} for state, row in values.items()
        }
    given = Given(
        trajectory=trajectory,
        values=draw_rows(rng, tuple(values), tuple(next(iter(values.values()))), 4 if level == 2 else 2),
        alpha=Fraction(1, 2) if level == 3 else alpha,
        gamma=gamma,
        lam=Parameter("lambda") if level == 3 else lam,
        traces=traces,
        replacing=replacing,
    )
    return given if level != 2 or readable(_learned(given).values()) else draw(level, rng)


def _learned(given: Given) -> dict[tuple[str, str], Fraction]:
    """The values after a run of Sarsa(λ) in which nothing is left open, and before which no pair has a trace."""
    run, gamma = given.trajectory, Fraction(given.gamma)
    pairs = tuple(zip(run.states, run.actions, strict=False))
    Q = {(state, action): value for state, row in given.values.items() for action, value in row.items()}
    e = dict.fromkeys(Q, Fraction(0))
    for here, after, reward in zip(pairs, (*pairs[1:], None), run.rewards, strict=False):
        e = {pair: gamma * Fraction(given.lam) * trace for pair, trace in e.items()}
        e[here] = Fraction(1) if given.replacing else e[here] + 1
        error = reward + gamma * (Q[after] if after else Fraction(0)) - Q[here]
        Q = {pair: value + Fraction(given.alpha) * e[pair] * error for pair, value in Q.items()}
    return Q


def _back(rng: Draws) -> Given:
    """Two transitions, and the value of the first pair after them, from which λ follows."""
    run, table = draw_action_run(rng, rng.choice(("abc", "ab.", "aba", "abb")), 3)
    rows = draw_rows(rng, tuple(table), tuple(next(iter(table.values()))), 2)
    first, second = zip(run.states[:2], run.actions[:2], strict=True)
    old, middle = rows[first[0]][first[1]], rows[second[0]][second[1]]
    alpha, lam = rng.fraction("1/2", "1/4"), rng.fraction("1/2", "1/4", "3/4", "2/5", "4/5")
    gamma = rng.fraction("1", *(["1/2"] if alpha != Fraction(1, 2) else []))
    moved = old + alpha * (run.rewards[0] + gamma * middle - old)
    last = run.states[2]
    ahead = Fraction(0) if last in run.terminal else rows[last][run.actions[2]]
    if (last, *run.actions[2:]) == first:
        ahead = moved
    error = run.rewards[1] + gamma * ahead - middle
    end = moved + alpha * error * gamma * lam
    if ahead == 0 and middle + error * lam == 0:
        return _back(rng)  # whatever γ multiplies would be 0
    if error == 0 or end.denominator > 10 or end == old:
        return _back(rng)
    outcome = Outcome(*first, end)
    return Given(trajectory=run, values=rows, alpha=alpha, gamma=gamma, lam=Parameter("lambda"), outcome=outcome)


def question(given: Given) -> Question:
    """The run, the table and the traces before it; then traces and values of all pairs that have a trace."""
    decay = "$λ$ is left open" if isinstance(given.lam, Parameter) else f"is $λ = {shown(given.lam)}$"
    decay = not_known(decay) if given.asks_back else decay
    begin = (
        (Paragraph("Before the run the eligibility traces are:"), action_values_table(given.traces, "e(s, a)"))
        if given.traces
        else (Paragraph("Before the run all eligibility traces are $0$."),)
    )
    kind = "replacing traces (a visit sets the trace to $1$)" if given.replacing else "accumulating traces"
    method = "Watkins's Q(λ)" if given.watkins else "Sarsa(λ)"
    blocks = (
        *run_situation(given, action_values_table(given.values)),
        *begin,
        Paragraph(
            f"The trace parameter {decay}. {method} with {kind} updates after every transition: first "
            "all traces, then all action values, with a TD error $δ_t$ from the values before this update."
        ),
        *((Paragraph(_CUT),) if given.watkins else ()),
    )
    if given.outcome:
        return Question(blocks, (back_asked(given, given.outcome, given.values),))
    pairs = joined([f"({state}, {action})" for state, action in given.eligible])
    every = f"the pair {pairs}" if len(given.eligible) == 1 else f"each of the pairs {pairs}"
    return Question(
        blocks,
        (
            Part(f"What is the trace $e(s, a)$ of {every} after the run{in_open(given)}?", Values("e", given.eligible)),
            Part(f"What is $Q(s, a)$ of {every} after the run{in_open(given)}?", Values("Q", given.eligible)),
        ),
    )
