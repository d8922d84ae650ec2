"""The values of all states after TD(λ) updates in the backward view, along a run of transitions."""

from pydantic import Field

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import OpenProbability, Parameter
from rldrill.problems.family import Question
from rldrill.problems.models import values_table
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import in_open, trace_parameter
from rldrill.problems.runs import Replacing, Trajectory, ValueRun, run_situation, values_asked
from rldrill.problems.settings import draw_setting

TITLE = "TD(λ), backward view"
SOURCE = "Sutton & Barto 2018, section 12.2"
REVISION = 1


class Given(ValueRun):
    """A run, the values before it, α, γ and λ."""

    lam: OpenProbability = Field(description="The decay of the traces, besides the discount.")
    replacing: Replacing = False


def draw(level: int, rng: Draws) -> Given:
    """Two transitions; then three that come back to a state; then three with λ left open."""
    setting = draw_setting(rng)
    first, second, third = rng.shuffled(setting.states)[:3]
    states = {
        1: (first, second, setting.terminal),
        2: (first, second, first, rng.choice((third, setting.terminal))),
        3: (first, second, rng.choice((first, third)), setting.terminal),
    }[level]
    return Given(
        trajectory=Trajectory(
            states=states,
            rewards=tuple(rng.nonzero(-4, 8) for _ in states[1:]),
            terminal=tuple(state for state in states if state == setting.terminal),
        ),
        values={state: rng.nonzero(-4, 10) for state in setting.states if state in states},
        alpha=rng.fraction("1/2") if level > 1 else rng.fraction("1/2", "1/4"),
        gamma=rng.fraction("1/2", "1"),
        lam=Parameter("lambda") if level == 3 else rng.fraction("1/2", "1/4"),
    )


def question(given: Given) -> Question:
    """The run, the values before it, and the order of the updates; all visited states are asked for."""
    traces = "replacing traces (a visit sets the trace to $1$)" if given.replacing else "accumulating traces"
    return Question(
        (
            *run_situation(given, values_table(given.values), more=trace_parameter(given.lam)),
            Paragraph(
                f"TD(λ) learns during the run, in the backward view with {traces}, which are all $0$ before "
                "it. After every transition first the traces of all states are updated, and then their values, with "
                "the TD error of the values that are current before the transition."
            ),
        ),
        (Part(f"What is {values_asked(given)} after the run{in_open(given)}?", Values("V", given.visited)),),
    )
