"""A table of what followed short histories: the probabilities given the history, and whether the process is Markov."""

from collections import Counter
from fractions import Fraction
from itertools import product
from typing import NamedTuple, Self

from pydantic import Field, ValidationInfo, field_validator, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Name
from rldrill.problems.parts import Choice, Part, Values, YesNo
from rldrill.problems.readings import distribution, note_of
from rldrill.problems.settings import draw_setting

TITLE = "Markov property"
SOURCE = "Sutton & Barto 2018, section 3.1"
REVISION = 1


class Seen(NamedTuple):
    """How often three states came one after the other, or with what probability they do."""

    before: Name
    now: Name
    next: Name
    weight: Exact


class Given(Givens):
    """The table, and the next state whose probabilities are asked for.

    The weights are counts, or joint probabilities if they sum to 1; what is not in the table was never seen.
    """

    table: tuple[Seen, ...] = Field(
        min_length=1,
        max_length=500,
        description="How often, or with what probability, three states came one after the other.",
    )
    asked: Name = Field(description="The next state whose probabilities are asked for.")
    story: str = Field(
        default="", max_length=200, pattern=r"^[^$\\]*$", description="A sentence that is printed first."
    )

    @field_validator("table")
    @classmethod
    def _as_meant(cls, table: tuple[Seen, ...], info: ValidationInfo) -> tuple[Seen, ...]:
        weights = distribution({number: row.weight for number, row in enumerate(table)}, note_of(info))
        return tuple(row._replace(weight=weights[number]) for number, row in enumerate(table))

    @model_validator(mode="after")
    def _fits(self) -> Self:
        for row in self.table:
            if row.weight < 0:
                raise ValueError(f"table: the weight of {', '.join(row[:3])} is below 0")
        (doubled, count), *_ = Counter(row[:3] for row in self.table).most_common(1)
        if count > 1:
            raise ValueError(f"table: {', '.join(doubled)} is given twice; give it once")
        if not self.probabilities and any(row.weight.denominator != 1 for row in self.table):
            raise ValueError("table: the weights are neither whole counts nor probabilities that sum to 1")
        for history in self.histories:
            if not sum(row.weight for row in self.table if row[:2] == history):
                raise ValueError(f"table: the history {', '.join(history)} never occurs; leave its rows out")
        if self.asked not in self.outcomes:
            raise ValueError(f"asked: {self.asked!r} is not a next state of the table")
        return self

    @property
    def probabilities(self) -> bool:
        """Whether the weights are joint probabilities, not counts."""
        return sum(row.weight for row in self.table) == 1

    @property
    def histories(self) -> tuple[tuple[str, str], ...]:
        """The states before and now, in their order in the table."""
        return tuple(dict.fromkeys(row[:2] for row in self.table))

    @property
    def present(self) -> tuple[str, ...]:
        """The states that are the present one in some history."""
        return tuple(dict.fromkeys(now for _, now in self.histories))

    @property
    def outcomes(self) -> tuple[str, ...]:
        """The states that come next."""
        return tuple(dict.fromkeys(row.next for row in self.table))


def draw(level: int, rng: Draws) -> Given:
    """Two histories with two next states; then four; then six, as joint probabilities, with three."""
    setting = draw_setting(rng)
    befores, nows, nexts = (setting.states[:count] for count in ((2, 1, 2), (2, 2, 2), (3, 2, 3))[level - 1])
    histories = tuple(product(befores, nows))
    if level == 3:  # probabilities over 100, every history a multiple of 5/100
        totals = dict(zip(histories, rng.split(len(histories), (20,)), strict=True))
    else:
        totals = dict(zip(histories, (5 * count for count in rng.distinct(len(histories), 1, 8)), strict=True))
    chances = {now: rng.split(len(nexts), (5,)) for now in nows}
    given_history = {history: chances[history[1]] for history in histories}
    if broken := rng.choice((*nows, None)):
        given_history[rng.choice(befores), broken] = rng.split(len(nexts), (5,))
    table = tuple(
        Seen(*history, after, chance * totals[history])
        for history in histories
        for after, chance in zip(nexts, given_history[history], strict=True)
    )
    return Given(table=table, asked=rng.choice(nexts), story=setting.story)


def question(given: Given) -> Question:
    """The table with a line for every history; probabilities, the verdict, and the state at which it breaks."""
    weight = {row[:3]: row.weight for row in given.table}
    told = "the joint probability" if given.probabilities else "how often"
    of = "of three states in a row" if given.probabilities else "three states were seen in a row"
    rest = "" if given.probabilities else " Take the relative frequencies in it as the probabilities of the process."
    blocks = (
        Paragraph(f"{given.story} Only its states are looked at.".strip()),
        Paragraph(f"This table tells {told} {of}: $s_{{t-1}}$, $s_t$ and $s_{{t+1}}$.{rest}"),
        Table(
            header=("$s_{t-1}$", "$s_t$", *(f'$s_{{t+1}} = "{after}"$' for after in given.outcomes)),
            rows=tuple(
                (*history, *(f"${shown(weight.get((*history, after), Fraction(0)))}$" for after in given.outcomes))
                for history in given.histories
            ),
        ),
    )
    ask = f'What is $Pr(s_{{t+1}} = "{given.asked}" | s_{{t-1}}, s_t)$ for every history $s_{{t-1}}, s_t$ of the table?'
    parts = [
        Part(ask, Values("Pr", given.histories)),
        Part("Can the process of these states be Markov, going by this table?", YesNo()),
    ]
    if options := where(given):
        parts.append(Part("In which present state $s_t$ does it matter what $s_{t-1}$ was?", Choice(options)))
    return Question(blocks, tuple(parts))


def where(given: Given) -> dict[str, str]:
    """The options of the last part: each present state, none, several; no options where there is one state only."""
    if not 1 < len(given.present) <= 20:
        return {}
    texts = (*given.present, "in none of them", "in more than one of them")
    return dict(zip("ABCDEFGHIJKLMNOPQRSTUVWXYZ", texts, strict=False))
