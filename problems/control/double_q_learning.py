"""The two tables of double Q-learning after updates of the one or the other along a run."""

from fractions import Fraction
from typing import Literal, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact
from rldrill.problems.family import Question
from rldrill.problems.models import Name, check_ends
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import in_open
from rldrill.problems.runs import CUT_OFF, ActionRun, action_values_table, draw_action_run, draw_row, run_situation

TITLE = "Double Q-learning"
SOURCE = "Sutton & Barto 2018, section 6.7"
REVISION = 1


class Given(ActionRun):
    """A run, two tables of action values before it, α and γ, and which table every transition updates."""

    second: dict[Name, dict[Name, Exact]] = Field(description="The second table of action values before the run.")
    updates: tuple[Literal[1, 2], ...] = Field(description="For every transition the table that it updates, 1 or 2.")

    @model_validator(mode="after")
    def _two_tables(self) -> Self:
        if len(self.updates) != len(self.trajectory.rewards):
            raise ValueError(f"updates: {len(self.trajectory.rewards)} transitions need as many, not "
                             f"{len(self.updates)}")  # fmt: skip
        if {state: set(row) for state, row in self.second.items()} != {s: set(row) for s, row in self.values.items()}:
            raise ValueError("second: both tables need the same states and actions")
        check_ends(self.second, self.trajectory.terminal, "second: the action value", CUT_OFF)
        return self

    @property
    def asked(self) -> tuple[int, ...]:
        """The tables that are updated, the one that is finished first in front."""
        return tuple(sorted(set(self.updates), key=self.updates[::-1].index, reverse=True))

    def updated_in(self, table: int) -> tuple[tuple[str, str], ...]:
        """The pairs that are updated in the table of that number, in the order of their first visit."""
        run = self.trajectory
        visits = zip(self.updates, run.states, run.actions, strict=False)
        return tuple(dict.fromkeys((state, action) for number, state, action in visits if number == table))


def draw(level: int, rng: Draws) -> Given:
    """One transition; then two, one for each table; then four over three states to the end."""
    visits = {1: "ab", 2: "aba", 3: "abac."}[level]
    trajectory, values = draw_action_run(rng, visits, 2 if level == 1 else 3, last=False, same=level == 3)
    first = rng.choice((1, 2))
    turns = {1: (first,), 2: (first, 3 - first), 3: (first, 3 - first, 3 - first, first)}[level]
    return Given(
        trajectory=trajectory,
        values=values,
        second={state: _other_row(rng, row) for state, row in values.items()},
        updates=turns,
        alpha=Fraction(1, 2) if level == 1 else rng.fraction("1/2", "1/4", "1/5"),
        gamma=rng.fraction("1/2", "4/5") if level == 1 else rng.fraction("1/2", "4/5", "9/10"),
    )


def _other_row(rng: Draws, row: dict[str, Fraction]) -> dict[str, Fraction]:
    """New values for the same actions, with another action as the best one."""
    best = max(row, key=row.__getitem__)
    other = draw_row(rng, tuple(row))
    top = max(other, key=other.__getitem__)
    instead = rng.choice([action for action in row if action != best])
    return other if top != best else other | {best: other[instead], instead: other[best]}


def question(given: Given) -> Question:
    """The run and both tables before it; the updated pairs of each table are a part."""
    steps = len(given.updates)
    turns = (
        f"A coin says that the transition updates $Q_{given.updates[0]}$."
        if steps == 1
        else "A coin says which table each transition updates: "
        + ", ".join(f"$Q_{table}$ at $t = {time}$" for time, table in enumerate(given.updates))
        + "."
    )
    blocks = (
        *run_situation(
            given,
            action_values_table(given.values, "Q_1(s, a)"),
            action_values_table(given.second, "Q_2(s, a)"),
        ),
        Paragraph(
            f"Double Q-learning updates one table after every transition, with the values that are current then. "
            f"{turns} Of equally good actions the one that stands first in the table is selected."
        ),
    )
    parts = []
    for table in given.asked:
        pairs = given.updated_in(table)
        asked = (
            f'$Q_{table}("{pairs[0][0]}", "{pairs[0][1]}")$'
            if len(pairs) == 1
            else f"the value in $Q_{table}$ of every pair that is updated there"
        )
        parts.append(Part(f"What is {asked} after the run{in_open(given)}?", Values(f"Q_{table}", pairs)))
    return Question(blocks, tuple(parts))
