"""The optimal policy for given optimal action values, some of which may have to be found first."""

from functools import cached_property
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, Probability, no_complement, shown
from rldrill.problems.family import AskedFor, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Dynamics, Named, Names, Transition, transitions_table
from rldrill.problems.parts import Number, Part, Policy, Values
from rldrill.problems.phrases import discount, terminal_note, unknown
from rldrill.problems.settings import Shape, draw_outcomes, draw_setting
from rldrill.problems.valued import UNITS, tells_apart
from rldrill.problems.valued import worth as worth_of

TITLE = "Optimal policy given Q"
SOURCE = "Sutton & Barto 2018, section 3.6"
REVISION = 7


class Given(AskedFor):
    """The optimal action values, what the actions do whose values are missing, the discount, and where it ends.

    Where a missing value's reward is left open, it is asked from which reward on the action is best.
    """

    values: Named[Named[Exact]] = Field(min_length=1, description="For every state the optimal values of its actions.")
    missing: Dynamics | None = Field(default=None, description="What the actions do whose values are missing.")
    gamma: Probability | None = Field(default=None, description="The discount; needed if values are missing.")
    terminal: Names = Field(default=(), description="The states in which an episode ends.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.missing is None:
            self._check_rows()
            return self
        if self.gamma is None:
            raise ValueError("gamma: the discount is needed to find the missing values; add it")
        open_rows = [row[:2] for row in self.missing.transitions if isinstance(row.reward, Parameter)]
        if self.left_open and (len(open_rows) != 1 or open_rows[0] != self.gaps[-1]):
            raise ValueError("missing: only one reward of the last action there can be left open")
        for row in self.missing.transitions:
            no_complement(row.reward)
        for state, action in self.missing.pairs:
            if state not in self.values:
                raise ValueError(f"values: {state!r} does not occur; give it there, if need be as an empty table")
            if action in self.values[state]:
                raise ValueError(f"missing: {action!r} in {state!r} has a value already; take one of them out")
        if self.left_open and len(self.values[open_rows[0][0]]) == 0:
            raise ValueError("values: another action of the state is needed, to compare what is left open with")
        self._check_rows()
        for row in self.missing.transitions:
            if row.next not in self.values and row.next not in self.terminal:
                raise ValueError(
                    f"missing: {row.next!r} is reached but has no values; give them or list it as terminal"
                )
            if row.next in self.missing.states:
                raise ValueError(f"missing: {row.next!r} is reached but has a missing value itself; give it there")
        return self

    def _check_rows(self) -> None:
        for state in self.values:
            if not self.actions[state]:
                raise ValueError(f"values: no action of {state!r} is given; add one")
            if state in self.terminal:
                raise ValueError(f"values: {state!r} is terminal, so no action can be taken there; take them out")

    @property
    def tied(self) -> tuple[str, str] | None:
        """The state and action whose reward is left open."""
        return self.gaps[-1] if self.left_open else None

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
    """All values are known; then some are missing; then a reward decides which action is best."""
    setting = draw_setting(rng)
    gamma = rng.fraction("1/2", "2/3", "4/5")
    states = setting.states[: 2 + rng.below(2) + (level > 1)]
    values = {state: dict(zip(setting.actions, _row(rng, gamma), strict=True)) for state in states}
    while level == 1 and len({max(row, key=lambda action: row[action]) for row in values.values()}) == 1:
        values = {state: dict(zip(setting.actions, _row(rng, gamma), strict=True)) for state in states}
    if level == 1:
        return Given(values=values)
    holed = rng.sample(states, 1 if len(states) == 3 else 2)
    counts = (1,) * len(holed) if level == 3 else (2,) if len(holed) == 1 else (1, 1 + rng.below(2))
    places = (*setting.states, setting.terminal)[: len(states) + 1]
    places = (*states, setting.terminal) if setting.terminal in places or rng.chance(Fraction(1, 2)) else states
    told = {s: [a for a in setting.actions if {*setting.reached(places, s, a)} - {*holed}] for s in holed}
    if any(len(told[state]) < count for state, count in zip(holed, counts, strict=True)):
        return draw(level, rng)
    gaps = [(s, a) for s, count in zip(holed, counts, strict=True) for a in rng.sample(told[s], count)]
    worth = {s: max(row.values()) for s, row in values.items()}
    rows: list[Transition] = []
    for gap in gaps:
        targets = tuple(place for place in setting.reached(places, *gap) if place not in holed)
        weighed = level == 3 and gap == gaps[-1]
        if weighed and targets == (setting.terminal,):
            return draw(level, rng)
        shape = Shape(states=0, actions=0, branches=2, reward=8, denominators=(2, 4))
        found = draw_outcomes(rng, *gap, targets[:2], shape)
        rival = max(values[gap[0]][action] for action in setting.actions if (gap[0], action) not in gaps)
        while (
            not tells_apart(found, worth, gamma)
            or any(Fraction(row.reward) + gamma * worth.get(row.next, Fraction(0)) == rival for row in found)
            or (weighed and [row.next for row in found] == [setting.terminal])  # the threshold would be read off
        ):
            found = draw_outcomes(rng, *gap, targets[:2], shape)
        rows += found
    if level == 2:
        missing = Dynamics(transitions=tuple(rows))
        found_values = {gap: worth_of(missing, gap, worth, gamma) for gap in gaps}
        best = {max(row, key=lambda a: found_values.get((s, a), row[a])) for s, row in values.items()}
        if len(best) == 1:  # one word for every state
            return draw(level, rng)
    if level == 3:
        last = [index for index, row in enumerate(rows) if (row.state, row.action) == gaps[-1]]
        rows[last[0]] = rows[last[0]]._replace(reward=Parameter("x"))
    return Given(
        values={state: {a: q for a, q in row.items() if (state, a) not in gaps} for state, row in values.items()},
        missing=Dynamics(transitions=tuple(rows)),
        gamma=gamma,
        terminal=(setting.terminal,) if any(row.next == setting.terminal for row in rows) else (),
    )


def _row(rng: Draws, gamma: Fraction) -> tuple[Fraction, ...]:
    """Different action values; the greatest is whole when it is discounted, too."""
    best = UNITS[gamma] * rng.whole(1, 12 // UNITS[gamma])
    below = rng.distinct(2, int(best) - 7, int(best) - 1)
    return rng.shuffled((best, *below))


def question(given: Given) -> Question:
    """The table of action values; what is missing in it is asked for first."""
    best = Part("Which action $π^*(s)$ is optimal in every state?", Policy(given.actions, "π^*"))
    known: list[Block] = [Paragraph("The optimal action values are:"), _table(given)]
    if given.missing is None or given.gamma is None:
        return Question(tuple(known), (best,))
    tied = f" {unknown('x')}" if given.tied else ""
    blocks = (
        *known,
        Paragraph("Where a question mark stands, the action has these outcomes:"),
        transitions_table(given.missing),
        *terminal_note(given.terminal),
        Paragraph(f"{discount(given.gamma)}{tied}"),
    )
    parts = []
    if asked := given.gaps[: -1 if given.tied else None]:
        value = "values" if len(asked) > 1 else "value"
        which = f'$Q^*("{asked[0][0]}", "{asked[0][1]}")$' if len(asked) == 1 else f"the missing {value} $Q^*(s, a)$"
        parts.append(Part(f"What {'is' if len(asked) == 1 else 'are'} {which}?", Values("Q^*", asked)))
    if given.tied:
        state, action = given.tied
        letter = shown(Parameter(given.left_open[0]))
        parts.append(Part(f"What is the smallest ${letter}$ with which {action} is optimal in {state}?", Number()))
        if others := {s: actions for s, actions in given.actions.items() if s != state}:
            parts.append(Part("Which action $π^*(s)$ is optimal in every other state?", Policy(others, "π^*")))
        return Question(blocks, tuple(parts))
    return Question(blocks, (*parts, best))


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
