"""The two tables of double Q-learning after updates of the one or the other along a run."""

from collections.abc import Mapping
from typing import Literal, Self

from pydantic import Field, model_validator

from rldrill.problems.asking_back import BackRun, back_asked, draw_back, draw_rates, draw_rows
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Named, Steps, check_ends
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import in_open
from rldrill.problems.runs import CUT_OFF, action_values_table, draw_action_run, run_situation
from rldrill.problems.settings import draw_setting

TITLE = "Double Q-learning"
SOURCE = "Sutton & Barto 2018, section 6.7"
REVISION = 9
DISTRACTORS = (
    "values.*",  # both tables have the values of other pairs, too
    "second.*",
    "trajectory.actions.*",  # the last action is Sarsa's business
)


class Given(BackRun):
    """A run, two tables of action values before it, α and γ, and which table every transition updates."""

    second: Named[Named[Exact]] = Field(description="The second table of action values before the run.")
    updates: Steps[Literal[1, 2]] = Field(description="For every transition the table that it updates, 1 or 2.")

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
    """One transition; then two, one for each table; then one back from its outcome, or three and more.

    One table has its turns before the other: then each table's updates belong to the part that asks for it.
    """
    if level == 3 and rng.chance(Fraction(2, 3)):
        return _back(rng)
    visits = {1: ("ab",), 2: ("aba", "abc", "abb", "ab."), 3: ("abac.", "abcb", "abab")}[level]
    alpha, gamma, unit = draw_rates(rng)
    trajectory, values = draw_action_run(rng, rng.choice(visits), 2 if level == 1 else 3, last=False, same=level == 3)
    rows = draw_rows(rng, tuple(values), tuple(next(iter(values.values()))), unit)
    first, steps = rng.choice((1, 2)), len(trajectory.rewards)
    turns = 1 + rng.below(max(1, steps - 1))
    given = Given(
        trajectory=trajectory,
        values=rows,
        second={state: _other_row(rng, row, unit) for state, row in rows.items()},
        updates=(first,) * turns + (3 - first,) * (steps - turns),
        alpha=alpha,
        gamma=gamma,
    )
    return given if _moves(given) else draw(level, rng)


def _moves(given: Given) -> bool:
    """Whether every transition changes a value, and with the tables exchanged its target takes another one."""
    tables = [{state: dict(row) for state, row in table.items()} for table in (given.values, given.second)]
    run = given.trajectory
    for number, state, action, after, reward in zip(
        given.updates, run.states, run.actions, run.states[1:], run.rewards, strict=False
    ):
        mine, other = tables[number - 1], tables[2 - number]
        ahead = Fraction(0)
        if after not in given.terminal:
            ahead = other[after][_best(mine[after])]
            if ahead in (max(mine[after].values()), mine[after][_best(other[after])]):
                return False
        gap = reward + Fraction(given.gamma) * ahead - mine[state][action]
        if gap == 0:
            return False
        mine[state][action] += Fraction(given.alpha) * gap
    return True


def _back(rng: Draws) -> Given:
    """A value of one table from which α or γ follows."""
    seen: list[dict[str, Fraction]] = []

    def worth(row: Mapping[str, Fraction], _: str) -> Fraction:
        seen.append(_other_row(rng, row, 4))
        return seen[-1][_best(row)]

    found = draw_back(rng, draw_setting(rng), 3, worth, rng.choice(("alpha", "gamma")))
    mine, entered = found.pop("values"), found["trajectory"].states[-1]
    other = {state: seen[-1] if state == entered else _other_row(rng, row, 4) for state, row in mine.items()}
    table = rng.choice((1, 2))
    tables = (mine, other) if table == 1 else (other, mine)
    return Given(values=tables[0], second=tables[1], updates=(table,), **found)


def _other_row(rng: Draws, row: Mapping[str, Fraction], unit: int) -> dict[str, Fraction]:
    """New values for the same actions, with another one as the best; of the row's best action they say neither what the
    row says of it, nor what it says of their own best one.
    """
    best = _best(row)
    other = draw_rows(rng, ("here",), tuple(row), unit)["here"]
    instead = rng.choice([action for action in row if action != best])
    if _best(other) == best:
        other |= {best: other[instead], instead: other[best]}
    return other if other[best] not in (row[best], row[_best(other)]) else _other_row(rng, row, unit)


def _best(row: Mapping[str, Fraction]) -> str:
    return max(row, key=row.__getitem__)


_TIES = " Among equally good actions, the one that stands first in the table is selected."


def _ties(given: Given) -> bool:
    """Whether several actions are best where one is selected, or may be: as far as it can be told."""
    tables = [{state: dict(row) for state, row in table.items()} for table in (given.values, given.second)]
    moved: set[tuple[int, str]] = set()
    for number, (state, action, entered, reward, _) in zip(given.updates, given.moves, strict=True):
        mine, other = tables[number - 1], tables[2 - number]
        ahead = Fraction(0)
        if entered not in given.terminal:
            row = mine[entered]
            best = _best(row)
            if (number, entered) in moved or [*row.values()].count(row[best]) > 1:
                return True
            ahead = other[entered][best]
        if isinstance(given.alpha, Parameter) or isinstance(given.gamma, Parameter):
            moved.add((number, state))  # to what, is not known
        else:
            gap = reward + Fraction(given.gamma) * ahead - mine[state][action]
            mine[state][action] += Fraction(given.alpha) * gap
    return False


def _in_order(given: Given) -> dict[str, dict[str, Fraction]]:
    """The second table with its actions in the order of the first: of tied ones the first counts in both."""
    return {state: {action: given.second[state][action] for action in row} for state, row in given.values.items()}


def question(given: Given) -> Question:
    """The run and both tables before it; the updated pairs of each table are a part."""
    steps = len(given.updates)
    turns = (
        f"A coin has chosen $Q_{given.updates[0]}$ for this transition."
        if steps == 1
        else "A coin has chosen the table for each transition: "
        + ", ".join(f"$Q_{table}$ at $t = {time}$" for time, table in enumerate(given.updates))
        + "."
    )
    blocks = (
        *run_situation(
            given,
            action_values_table(given.values, "Q_1(s, a)"),
            action_values_table(_in_order(given), "Q_2(s, a)"),
        ),
        Paragraph(
            f"Double Q-learning updates one table after every transition, with the values that are current then. "
            f"{turns}{_TIES if _ties(given) else ''}"
        ),
    )
    if given.outcome:
        last = given.updates[-1]
        mine = given.second if last == 2 else given.values
        return Question(blocks, (back_asked(given, given.outcome, mine, f"Q_{last}"),))
    parts = []
    for table in given.asked:
        pairs = given.updated_in(table)
        asked = (
            f'$Q_{table}("{pairs[0][0]}", "{pairs[0][1]}")$'
            if len(pairs) == 1
            else f"the value in $Q_{table}$ of every pair that was updated there"
        )
        parts.append(Part(f"After the run, what is {asked}{in_open(given)}?", Values(f"Q_{table}", pairs)))
    return Question(blocks, tuple(parts))
