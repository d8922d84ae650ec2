"""The values of all states after TD(λ) updates in the backward view, along a run of transitions."""

from itertools import pairwise

from pydantic import Field

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import OpenShare, Parameter
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.models import values_table
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import in_open, trace_parameter
from rldrill.problems.runs import (
    Replacing,
    ShortRun,
    Trajectory,
    ValueRun,
    draw_reward,
    draw_values,
    readable,
    run_situation,
    sought_parts,
    told_apart,
    values_asked,
)
from rldrill.problems.settings import draw_visits, in_order

TITLE = "TD(λ), backward view"
SOURCE = "Sutton & Barto 2018, section 12.2"
REVISION = 5


class Given(ValueRun):
    """A run, the values before it, α, γ and λ.

    Where ``known`` is the value of the first state after the run, what is left open is asked for.
    """

    trajectory: ShortRun = Field(description="What the agent did.")
    lam: OpenShare = Field(description="The decay of the traces, besides the discount.")
    replacing: Replacing = False


def draw(level: int, rng: Draws) -> Given:
    """Two transitions; then two or three that come back to a state; then a letter left open, or to be found."""
    if level == 1:
        return _run(rng, "ab.")
    if level == 2:
        run = _run(rng, "abac", "aba.", "aab.", "abb.", "abc.")
        replacing = run.model_copy(update={"replacing": len(run.visited) == 2 and rng.chance(Fraction(1, 3))})
        return replacing if _discounts(replacing) else run
    kind = rng.below(4)
    if kind == 0:
        run = _run(rng, "aba.", "abc.", "aabc")
        return run.model_copy(update={"lam": Parameter("lambda")})
    if kind == 2:  # λ decides what a state gets that comes again; the last one to be new gets the same for any λ
        run = _run(rng, "aab", "aa.")
        return run.model_copy(update={"lam": Parameter("lambda"), "known": _learned(run)[run.trajectory.states[0]]})
    run = _run(rng, "abc", "ab.")
    if kind == 1:
        return run.model_copy(update={"gamma": Parameter("gamma")})
    return run.model_copy(update={"alpha": Parameter("alpha"), "known": _learned(run)[run.trajectory.states[0]]})


def _run(rng: Draws, *visits: str) -> Given:
    """A run with one of these orders of visits, whose values stay readable, and depend on γ from the first state on."""
    setting, states = draw_visits(rng, *visits)
    while True:
        run = _rewarded(rng, states, setting.terminal)
        before = {state: Fraction(value) for state, value in run.values.items()}
        if told_apart(run.trajectory, before) and readable(_learned(run).values()) and _discounts(run):
            return run


def _discounts(run: Given) -> bool:
    """Whether the value of the first state would be another one without discount."""
    first = run.trajectory.states[0]
    return _learned(run)[first] != _learned(run.model_copy(update={"gamma": Fraction(1)}))[first]


def _rewarded(rng: Draws, states: tuple[str, ...], end: str) -> Given:
    """A run whose first update gives whole values."""
    terminal = tuple(state for state in states if state == end)
    gamma, lam = rng.choice(_DECAYS)
    alpha = rng.fraction("1/4") if Fraction(1, 2) in (gamma, lam) else rng.fraction("1/2", "1/2", "1/4")
    left = in_order(states)
    values = draw_values(rng, left, gamma)
    V, e = values | dict.fromkeys(terminal, Fraction(0)), dict.fromkeys(left, Fraction(0))
    rewards: list[Fraction] = []
    for number, (state, after) in enumerate(pairwise(states)):
        e = {s: gamma * lam * trace + (s == state) for s, trace in e.items()}
        unit = gamma.denominator if number == 0 else 1 if number < len(states) - 2 else None
        rewards.append(draw_reward(rng, V[state], gamma * V[after], alpha, unit))
        error = rewards[-1] + gamma * V[after] - V[state]
        V |= {s: V[s] + alpha * trace * error for s, trace in e.items()}
    run = Trajectory(states=states, rewards=tuple(rewards), terminal=terminal)
    return Given(trajectory=run, values=values, alpha=alpha, gamma=gamma, lam=lam)


def _learned(run: Given) -> dict[str, Fraction]:
    """The values after a run in which nothing is left open."""
    V = {state: Fraction(value) for state, value in run.values.items()} | dict.fromkeys(run.terminal, Fraction(0))
    e = dict.fromkeys(run.visited, Fraction(0))
    gamma = Fraction(run.gamma)
    for state, after, reward in run.moves:
        e = {s: gamma * Fraction(run.lam) * trace + (s == state) for s, trace in e.items()}
        if run.replacing:
            e[state] = Fraction(1)
        error = reward + gamma * V[after] - V[state]
        V |= {s: V[s] + Fraction(run.alpha) * trace * error for s, trace in e.items()}
    return V


#: γ and λ, by whose product traces decay.
_DECAYS = tuple(
    (fraction_of(g), fraction_of(lam))
    for g, lam in (("1/2", "2/3"), ("3/4", "2/3"), ("4/5", "1/2"), ("1/2", "1"), ("1/2", "4/5"))
)


def question(given: Given) -> Question:
    """The run, the values before it, and the order of the updates; all updated states are asked for, or a letter."""
    traces = "replacing traces (a visit sets the trace to $1$)" if given.replacing else "accumulating traces"
    blocks = (
        *run_situation(given, values_table(given.values), more=trace_parameter(given.lam)),
        Paragraph(
            f"TD(λ) learns during the run, in the backward view with {traces}, which are all $0$ before it. After "
            "every transition first the traces of all states are updated, and then their values, with the TD error "
            "of the values before this transition."
        ),
    )
    if given.known is not None:
        return Question(blocks, sought_parts(given))
    ask = f"What is {values_asked(given)} after the run{in_open(given)}?"
    return Question(blocks, (Part(ask, Values("V", given.visited)),))
