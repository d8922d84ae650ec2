"""The values of some states of a run after TD(λ) updates in the forward view."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, joined
from rldrill.problems.draws import Draws
from rldrill.problems.exact import OpenShare, Parameter
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import values_table
from rldrill.problems.parts import Number, Numbers, Part, Values
from rldrill.problems.phrases import in_open, trace_parameter
from rldrill.problems.runs import (
    ShortRun,
    ValueRun,
    cut_off,
    draw_whole,
    readable,
    run_situation,
    sought_parts,
    told_apart,
)
from rldrill.problems.settings import draw_visits

TITLE = "TD(λ), forward view"
SOURCE = "Sutton & Barto 2018, section 12.1"
REVISION = 4


class Given(ValueRun):
    """A run, the values before it, α, γ and λ, and the times whose states are updated.

    A run that is cut off, in a state that is not terminal, goes on with the value of that state. Where ``known`` is the
    value after the update of the state whose time is asked for first, what is left open is asked for.
    """

    trajectory: ShortRun = Field(description="The episode, or a run that is cut off.")
    lam: OpenShare = Field(description="How much later returns count.")
    asked: tuple[int, ...] = Field(min_length=1, max_length=100, description="The times whose states are updated.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        end = len(self.trajectory.rewards)
        for time in self.asked:
            if not 0 <= time < end:
                raise ValueError(
                    f"asked: there is no state to update at time {time} in a run that ends at {end}; "
                    "choose an earlier time"
                )
        if len(set(self.updated)) < len(self.updated):
            raise ValueError("asked: a state is updated twice; ask for one time of each state only")
        return self

    @property
    def updated(self) -> tuple[str, ...]:
        """The states that are updated, in the order in which they are asked for."""
        return tuple(self.trajectory.states[time] for time in self.asked)


def draw(level: int, rng: Draws) -> Given:
    """The first state of two; then the first two of three, or of a run that is cut off; then a letter."""
    if level == 1:
        return _run(rng, (0,), "ab.")
    longer = "abc.", "abcd", "ab.", "abc"
    if level == 2:
        return _run(rng, rng.choice(((0, 1), (1, 0))), *longer)
    kind = rng.below(3)
    if kind == 0:
        return _run(rng, (0, 1), *longer).model_copy(update={"lam": Parameter("lambda")})
    asked = (0,) if kind == 1 else (0, 1)  # nothing follows from λ for the last state of a run
    run = _run(rng, asked, "ab.", "abc")
    update: dict[str, object] = {"known": _learned(run)}
    update |= (
        {"lam": Parameter("lambda")}
        if kind == 1
        else {"values": run.values | {run.trajectory.states[1]: Parameter("x")}}
    )
    return run.model_copy(update=update)


def _run(rng: Draws, asked: tuple[int, ...], *visits: str) -> Given:
    """A run with whole returns whose first update depends on all that is given, and gives a readable number."""
    setting, states = draw_visits(rng, *visits)
    run = _whole(rng, states, setting.terminal, asked)
    while not (told_apart(run.trajectory, _numbers(run)) and _matters(run)):
        run = _whole(rng, states, setting.terminal, asked)
    return run


def _matters(run: Given) -> bool:
    value, average = _learned(run), _learned(run.model_copy(update={"alpha": Fraction(1)}))
    rates = {run.alpha, run.gamma, run.lam}  # different ones, so that none can be taken for another
    return (
        len(rates) == 3
        and readable((value, average))
        and all(value != _learned(run.model_copy(update={name: Fraction(0)})) for name in ("gamma", "lam"))
    )


def _whole(rng: Draws, states: tuple[str, ...], end: str, asked: tuple[int, ...]) -> Given:
    gamma = rng.fraction("1/2", "4/5", "3/4")
    run, values = draw_whole(rng, states, end, gamma)
    alpha, lam = rng.fraction("1/2", "1/4"), rng.fraction("1/2", "1/4", "3/4")
    return Given(trajectory=run, values=values, alpha=alpha, gamma=gamma, lam=lam, asked=asked)


def _numbers(run: Given) -> dict[str, Fraction]:
    """The values of a run in which nothing is left open."""
    return {state: Fraction(value) for state, value in run.values.items()}


def _learned(run: Given) -> Fraction:
    """The value of the first state of a run in which nothing is left open."""
    lam, V = Fraction(run.lam), _numbers(run)
    worth = V.get(run.trajectory.states[-1], Fraction(0))
    for move in reversed(run.moves):
        worth = move.reward + Fraction(run.gamma) * ((1 - lam) * V.get(move.next, Fraction(0)) + lam * worth)
    old = V[run.trajectory.states[0]]
    return old + Fraction(run.alpha) * (worth - old)


def question(given: Given) -> Question:
    """The λ-returns first, then the updated values."""
    blocks = (
        *run_situation(given, values_table(given.values), more=trace_parameter(given.lam)),
        Paragraph(
            "TD(λ) learns in the forward view: all λ-returns are computed with the values before the first update, "
            "and the updates are made at the end."
        ),
        *cut_off(given.trajectory),
    )
    if given.known is not None:
        return Question(blocks, sought_parts(given))
    tail = in_open(given)
    entries = tuple(f"R_{{{time}}}^{{(λ)}}" for time in given.asked)
    if len(entries) == 1:
        returns = Part(f"What is the λ-return ${entries[0]}${tail}?", Number())
        asked = f'$V("{given.updated[0]}")$'
    else:
        returns = Part(
            f"What are the λ-returns ${', '.join(entries)}$, in this order{in_open(given)}?",
            Numbers(entries),
        )
        asked = f"the values of the states visited at times {joined([f'${time}$' for time in given.asked])}"
    verb = "is" if len(entries) == 1 else "are"
    values = Part(f"What {verb} {asked} after the update{tail}?", Values("V", given.updated))
    return Question(blocks, (returns, values))
