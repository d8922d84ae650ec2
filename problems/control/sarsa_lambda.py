"""The eligibility traces and the action values after updates of Sarsa(λ), or of Watkins's Q(λ), along a run."""

from fractions import Fraction
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, OpenProbability, Parameter, shown
from rldrill.problems.family import Question
from rldrill.problems.models import Name, check_keys
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import in_open
from rldrill.problems.runs import ActionRun, Replacing, action_values_table, draw_action_run, run_situation

TITLE = "Sarsa(λ)"
SOURCE = "Sutton & Barto 2018, section 12.7; 1998, section 7.5"
REVISION = 1

_CUT = (
    "The TD error takes the greatest action value of the next state. Where an action is taken that is not greedy, all "
    "traces are set to $0$ before its own visit counts; whether it is greedy is told by the values with which the TD "
    "error of the transition before it was worked out."
)


class Given(ActionRun):
    """A run with all its actions, the action values before it, α, γ and λ; traces from before it, if there are any."""

    lam: OpenProbability = Field(description="The decay of the traces, besides the discount.")
    traces: dict[Name, dict[Name, Exact]] | None = Field(
        default=None, description="The traces before the run; all 0 without them."
    )
    replacing: Replacing = False
    watkins: bool = Field(
        default=False,
        exclude_if=lambda watkins: not watkins,
        description="Whether Watkins's Q(λ) learns instead of Sarsa(λ).",
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
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


def draw(level: int, rng: Draws) -> Given:
    """One transition with a trace from before; then three that come back to a pair; then the same with λ left open."""
    visits = {1: "ab", 2: "abab", 3: "abac."}[level]
    trajectory, values = draw_action_run(rng, visits, 2 if level == 1 else 3, same=level > 1)
    traces = None
    if level == 1:
        traced = trajectory.states[1], rng.choice(tuple(values[trajectory.states[1]]))
        traces = {
            state: {action: Fraction((state, action) == traced) for action in row} for state, row in values.items()
        }
    return Given(
        trajectory=trajectory,
        values=values,
        alpha=Fraction(1, 2),
        gamma=Fraction(1) if level == 3 else rng.fraction("1/2", "1"),
        lam=Parameter("lambda") if level == 3 else Fraction(1, 2),
        traces=traces,
    )


def question(given: Given) -> Question:
    """The run, the table and the traces before it; then traces and values of all pairs that have a trace."""
    decay = "is left open" if isinstance(given.lam, Parameter) else f"is $λ = {shown(given.lam)}$"
    begin = (
        (Paragraph("The eligibility traces before the run are these:"), action_values_table(given.traces, "e(s, a)"))
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
    return Question(
        blocks,
        (
            Part(f"What is the trace of these pairs after the run{in_open(given)}?", Values("e", given.eligible)),
            Part(
                f"What is the action value of these pairs after the run{in_open(given)}?",
                Values("Q", given.eligible),
            ),
        ),
    )
