"""The optimal policy for given optimal action values, some of which may have to be found first."""

from functools import cached_property
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Probability, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Dynamics, Name, transitions_table
from rldrill.problems.parts import Part, Policy, Values
from rldrill.problems.phrases import discount, terminal_note
from rldrill.problems.settings import Shape, draw_outcomes, draw_setting

TITLE = "Optimal policy given Q"
SOURCE = "Sutton & Barto 2018, section 3.6"
REVISION = 1


class Given(Givens):
    """The optimal action values, what the actions do whose values are missing, the discount, and where it ends."""

    values: dict[Name, dict[Name, Exact]] = Field(
        min_length=1, description="For every state the optimal values of its actions."
    )
    missing: Dynamics | None = Field(default=None, description="What the actions do whose values are missing.")
    gamma: Probability | None = Field(default=None, description="The discount; needed if values are missing.")
    terminal: tuple[Name, ...] = Field(default=(), description="The states in which an episode ends.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.missing is None:
            self._check_rows()
            return self
        if self.gamma is None:
            raise ValueError("gamma: the discount is needed to find the missing values")
        for state, action in self.missing.pairs:
            if state not in self.values:
                raise ValueError(f"values: {state!r} does not occur; give it there, if need be as an empty table")
            if action in self.values[state]:
                raise ValueError(f"missing: {action!r} in {state!r} has a value already")
        self._check_rows()
        for row in self.missing.transitions:
            if row.next not in self.values and row.next not in self.terminal:
                raise ValueError(
                    f"missing: {row.next!r} is reached but has no values; give them or list it as terminal"
                )
            if row.next in self.missing.states:
                raise ValueError(f"missing: {row.next!r} is reached but has a missing value itself")
        return self

    def _check_rows(self) -> None:
        for state in self.values:
            if not self.actions[state]:
                raise ValueError(f"values: no action of {state!r} is given")
            if state in self.terminal:
                raise ValueError(f"values: {state!r} is terminal, so no action can be taken there")

    @cached_property
    def actions(self) -> dict[str, tuple[str, ...]]:
        """The actions of every state, those with a missing value among them, in the order of the table."""
        fullest = sorted(self.values.values(), key=len, reverse=True)
        gaps = {*self.gaps}
        every = dict.fromkeys([action for row in fullest for action in row] + [action for _, action in self.gaps])
        return {
            state: tuple(action for action in every if action in row or (state, action) in gaps)
            for state, row in self.values.items()
        }

    @cached_property
    def gaps(self) -> tuple[tuple[str, str], ...]:
        """The pairs of state and action whose values are missing."""
        return self.missing.pairs if self.missing else ()


def draw(level: int, rng: Draws) -> Given:
    """All values are known; then two of one state are missing; then three of two states."""
    setting = draw_setting(rng)
    states = setting.states[: 4 if level == 3 else 3]
    values = {state: dict(zip(setting.actions, rng.distinct(3, -3, 12), strict=True)) for state in states}
    if level == 1:
        return Given(values=values)
    holed = rng.sample(states, level - 1)
    gaps = [(state, action) for state in holed for action in rng.sample(setting.actions, 2)][: 2 * level - 2]
    reached = [state for state in states if state not in holed] + [setting.terminal]
    shape = Shape(states=0, actions=0, branches=2, reward=8, denominators=(2, 4))
    rows = [row for gap in gaps for row in draw_outcomes(rng, *gap, rng.sample(reached, 2), shape)]
    return Given(
        values={state: {a: q for a, q in row.items() if (state, a) not in gaps} for state, row in values.items()},
        missing=Dynamics(transitions=tuple(rows)),
        gamma=rng.fraction("1/2", "4/5", "9/10"),
        terminal=(setting.terminal,),
    )


def question(given: Given) -> Question:
    """The table of action values; what is missing in it is asked for first."""
    best = Part("Which action does an optimal policy take in every state?", Policy(given.actions))
    known: list[Block] = [Paragraph("The optimal action values are:"), _table(given)]
    if given.missing is None or given.gamma is None:
        return Question(tuple(known), (best,))
    blocks = (
        *known,
        Paragraph("Where a question mark stands, the action does this:"),
        transitions_table(given.missing),
        *terminal_note(given.terminal),
        Paragraph(discount(given.gamma)),
    )
    ask = (
        "What are the missing values $Q^*(s, a)$?" if len(given.gaps) > 1 else "What is the missing value $Q^*(s, a)$?"
    )
    return Question(blocks, (Part(ask, Values("Q^*", given.gaps)), best))


def _table(given: Given) -> Table:
    every = tuple(
        dict.fromkeys(action for row in sorted(given.actions.values(), key=len, reverse=True) for action in row)
    )

    def cell(state: str, action: str) -> str:
        if action in given.values[state]:
            return f"${shown(given.values[state][action])}$"
        return "?" if (state, action) in given.gaps else "–"

    return Table(
        header=("$Q^*(s, a)$", *every),
        rows=tuple((state, *(cell(state, action) for action in every)) for state in given.values),
    )
