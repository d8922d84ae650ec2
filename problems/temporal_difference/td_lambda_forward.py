"""The values of some states of a run after TD(λ) updates in the forward view."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, joined
from rldrill.problems.draws import Draws
from rldrill.problems.exact import OpenProbability, Parameter
from rldrill.problems.family import Question
from rldrill.problems.models import values_table
from rldrill.problems.parts import Number, Numbers, Part, Values
from rldrill.problems.phrases import in_open, trace_parameter
from rldrill.problems.runs import ShortRun, ValueRun, cut_off, draw_episode, run_situation
from rldrill.problems.settings import draw_setting

TITLE = "TD(λ), forward view"
SOURCE = "Sutton & Barto 2018, section 12.1"
REVISION = 1


class Given(ValueRun):
    """A run, the values before it, α, γ and λ, and the times whose states are updated.

    A run that is cut off, in a state that is not terminal, goes on with the value of that state.
    """

    trajectory: ShortRun = Field(description="The episode, or a run that is cut off.")
    lam: OpenProbability = Field(description="How much later returns count.")
    asked: tuple[int, ...] = Field(min_length=1, description="The times whose states are updated.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        end = len(self.trajectory.rewards)
        for time in self.asked:
            if not 0 <= time < end:
                raise ValueError(f"asked: there is no state to update at time {time} in a run that ends at {end}")
        if len(set(self.updated)) < len(self.updated):
            raise ValueError("asked: a state is updated twice; ask for one time of each state only")
        return self

    @property
    def updated(self) -> tuple[str, ...]:
        """The states that are updated, in the order in which they are asked for."""
        return tuple(self.trajectory.states[time] for time in self.asked)


def draw(level: int, rng: Draws) -> Given:
    """The first state of two; then the first two of three; then all three, with λ left open."""
    setting = draw_setting(rng)
    states = rng.shuffled(setting.states)[: 2 if level == 1 else 3]
    return Given(
        trajectory=draw_episode(rng, states, setting.terminal),
        values={state: rng.nonzero(-4, 10) for state in setting.states if state in states},
        alpha=rng.fraction("1/2", "1/4") if level == 1 else rng.fraction("1/2", "1/4", "1/10"),
        gamma=rng.fraction("1/2", "4/5"),
        lam=Parameter("lambda") if level == 3 else rng.fraction("1/2", "1/4"),
        asked=tuple(range(level)),
    )


def question(given: Given) -> Question:
    """The λ-returns first, then the updated values."""
    blocks = (
        *run_situation(given, values_table(given.values), more=trace_parameter(given.lam)),
        Paragraph(
            "TD(λ) learns in the forward view: the λ-returns are computed with the values before the run, "
            "and the updates are made after the run."
        ),
        *cut_off(given.trajectory),
    )
    tail = in_open(given)
    entries = tuple(f"R_{{{time}}}^{{(λ)}}" for time in given.asked)
    if len(entries) == 1:
        returns = Part(f"What is the λ-return ${entries[0]}${tail}?", Number())
        asked = f'$V("{given.updated[0]}")$'
    else:
        returns = Part(f"What are the λ-returns ${', '.join(entries)}$, in this order{tail}?", Numbers(entries))
        asked = f"the values of the states visited at times {joined([f'${time}$' for time in given.asked])}"
    verb = "is" if len(entries) == 1 else "are"
    values = Part(f"What {verb} {asked} after the update{tail}?", Values("V", given.updated))
    return Question(blocks, (returns, values))
