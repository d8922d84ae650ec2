"""A table of what followed short histories: the probabilities given the history, and whether the process is Markov."""

from collections import Counter
from itertools import product
from typing import NamedTuple, Self

from msgspec import Struct
from pydantic import Field, ValidationInfo, field_validator, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Open, Parameter, shown
from rldrill.problems.family import AskedFor, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Name
from rldrill.problems.parts import Choice, Number, Part, Values, YesNo
from rldrill.problems.readings import distribution, note_of

TITLE = "Markov property"
SOURCE = "Sutton & Barto 2018, section 3.1"
REVISION = 5


class Seen(NamedTuple):
    """How often three states came one after the other, or with what probability they do."""

    before: Name
    now: Name
    next: Name
    weight: Open


class Given(AskedFor):
    """The table, and the next state whose probabilities are asked for.

    The weights are counts, or joint probabilities if they sum to 1; what is not in the table was never seen. A count
    left open is asked for, so that its present state is consistent with the Markov property.
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
        numbers = {number: row.weight for number, row in enumerate(table) if isinstance(row.weight, Fraction)}
        if len(numbers) < len(table):
            return table
        weights = distribution(numbers, note_of(info))
        return tuple(row._replace(weight=weights[number]) for number, row in enumerate(table))

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_one_letter(self)
        for row in self.table:
            if isinstance(row.weight, Fraction) and row.weight < 0:
                raise ValueError(f"table: the weight of {', '.join(row[:3])} is below 0; give 0 or more")
        (doubled, count), *_ = Counter(row[:3] for row in self.table).most_common(1)
        if count > 1:
            raise ValueError(f"table: {', '.join(doubled)} is given twice; give it once")
        if not self.probabilities and any(weight.denominator != 1 for weight in self.numbers):
            raise ValueError("table: the weights are neither whole counts nor probabilities that sum to 1")
        for history in self.histories:
            if all(row.weight == 0 for row in self.table if row[:2] == history):
                raise ValueError(f"table: the history {', '.join(history)} never occurs; leave its rows out")
        if self.asked not in self.outcomes:
            raise ValueError(f"asked: {self.asked!r} is not a next state of the table; name one that is")
        return self

    @property
    def missing(self) -> Seen | None:
        """The row whose count is asked for."""
        return next((row for row in self.table if isinstance(row.weight, Parameter)), None)

    @property
    def numbers(self) -> tuple[Fraction, ...]:
        """The weights that are known."""
        return tuple(row.weight for row in self.table if isinstance(row.weight, Fraction))

    @property
    def probabilities(self) -> bool:
        """Whether the weights are joint probabilities, not counts."""
        return self.missing is None and sum(self.numbers) == 1

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


def check_one_letter(given: Given) -> None:
    """Demand that at most one count is left open, and that there is a history to find it from.

    Raises:
        ValueError: there are more, or the present state has no other history.
    """
    hidden = [row for row in given.table if isinstance(row.weight, Parameter)]
    if len(hidden) > 1:
        raise ValueError(f"table: the weights of {len(hidden)} rows are left open; leave one open at most")
    if hidden and not _other_history(given, hidden[0]):
        raise ValueError(f"table: {hidden[0].now!r} has one history only, so nothing says what is left open")


def _other_history(given: Given, hidden: Seen) -> bool:
    return any(now == hidden.now and before != hidden.before for before, now in given.histories)


class _Story(Struct, frozen=True):
    told: str
    states: tuple[str, ...]


#: Processes in which any state may follow any other.
_STORIES = (
    _Story("The weather of every day is noted.", ("sunny", "cloudy", "rainy", "foggy")),
    _Story("A cleaning robot goes from room to room.", ("kitchen", "hall", "study", "bath")),
    _Story("A delivery van drives from town to town.", ("north", "east", "south", "west")),
    _Story("A tutoring program sets one kind of exercise after the other.", ("words", "grammar", "sounds", "reading")),
    _Story("A melody is played note by note.", ("do", "re", "mi", "fa")),
    _Story("A service robot is given one job after the other.", ("fetch", "carry", "clean", "guide")),
)


#: All probabilities in fifths of so many next states.
_FIFTHS = {
    count: [
        tuple(Fraction(share, 5) for share in shares)
        for shares in product(range(1, 5), repeat=count)
        if sum(shares) == 5
    ]
    for count in (2, 3)
}


def draw(level: int, rng: Draws) -> Given:
    """Two histories with two next states; then four or six; then joint probabilities, or a count to be found."""
    story = rng.choice(_STORIES)
    finding = level == 3 and rng.chance(Fraction(1, 2))
    shapes = {1: ((2, 1, 2),), 2: ((2, 2, 2), (3, 2, 2), (2, 2, 3)), 3: ((2, 2, 3), (3, 2, 2))}
    count = (2 + rng.below(2), 2, 2) if finding else rng.choice(shapes[level])
    befores, nows, nexts = (rng.sample(story.states, number) for number in count)
    while set(befores) & set(nows) and not set(nows) <= set(nexts):  # or a history would have probability 0
        befores, nows, nexts = (rng.sample(story.states, number) for number in count)
    histories = tuple(product(befores, nows))
    if level == 3 and not finding:  # probabilities over 100, every history a multiple of 5/100
        totals = dict(zip(histories, rng.split(len(histories), (20,)), strict=True))
    else:
        totals = dict(zip(histories, (5 * count for count in rng.distinct(len(histories), 1, 8)), strict=True))
    matters = _where_it_matters(rng, nows, at_most=1 if finding else len(nows))
    rows = rng.shuffled(_FIFTHS[len(nexts)])
    chances = dict(zip(nows, rows, strict=False))  # the present state matters
    given_history = {history: chances[history[1]] for history in histories}
    for now in matters:
        given_history[rng.choice(befores), now] = rng.choice(rows[len(nows) :])
    table = tuple(
        Seen(*history, after, chance * totals[history])
        for history in histories
        for after, chance in zip(nexts, given_history[history], strict=True)
    )
    if finding:
        place = rng.choice([place for place, row in enumerate(table) if row.now not in matters])
        table = (*table[:place], table[place]._replace(weight=Parameter("x")), *table[place + 1 :])
    return Given(table=table, asked=rng.choice(nexts), story=story.told)


def _where_it_matters(rng: Draws, nows: tuple[str, ...], at_most: int) -> tuple[str, ...]:
    """The present states in which the history matters: none, one or all; of one at most, none in half."""
    if at_most == 1:
        return () if rng.chance(Fraction(1, 2)) else (rng.choice(nows),)
    return rng.choice(((), *((now,) for now in nows), nows))


def question(given: Given) -> Question:
    """The table with a line for every history; probabilities, the verdict, and the state at which it breaks."""
    weight = {row[:3]: row.weight for row in given.table}
    counts = "how often three successive states $s_{t-1}, s_t, s_{t+1}$ were observed"
    told = "the joint probability of three successive states $s_{t-1}, s_t, s_{t+1}$" if given.probabilities else counts
    frequencies = "Other histories are left out. Take the relative frequencies as the probabilities of the process."
    rest = "" if given.probabilities else f" {frequencies}"
    hidden = given.missing
    lost = " One of the counts, $x$, is not known." if hidden else ""
    blocks = (
        *([Paragraph(given.story)] if given.story else []),
        Paragraph(f"This table gives {told}.{rest}{lost}"),
        Table(
            header=("$s_{t-1}$", "$s_t$", *(f'$s_{{t+1}} = "{after}"$' for after in given.outcomes)),
            rows=tuple(
                (*history, *(f"${shown(weight.get((*history, after), Fraction(0)))}$" for after in given.outcomes))
                for history in given.histories
            ),
        ),
    )
    ask = f'What is $Pr(s_{{t+1}} = "{given.asked}" | s_{{t-1}}, s_t)$ for every history $s_{{t-1}}, s_t$ of the table?'
    consistent = "Is this table consistent with the Markov property?"
    parts = []
    if hidden:
        wanted = f'What must $x$ be so that the distribution of $s_{{t+1}}$ after $s_t = "{hidden.now}"$'
        parts.append(Part(f"{wanted} does not depend on $s_{{t-1}}$?", Number(), zero=True))
        ask, consistent = (
            f"With this $x$: {ask[0].lower()}{ask[1:]}",
            "Is the whole table then consistent with the Markov property?",
        )
    parts.append(Part(ask, Values(f'Pr("{given.asked}"|·)', given.histories)))
    if options := where(given):
        told = "The Markov property asks that the distribution of $s_{t+1}$ depend on $s_t$ alone."
        parts.append(Part(f"{told} For which present state $s_t$ does it also depend on $s_{{t-1}}$?", Choice(options)))
    else:
        parts.append(Part(consistent, YesNo()))
    return Question(blocks, tuple(parts))


_PAIR = 2


def where(given: Given) -> dict[str, str]:
    """The options of the last part: each present state, none, several; no options where there is one state only."""
    if given.missing or not 1 < len(given.present) <= 20:
        return {}
    several = "for both" if len(given.present) == _PAIR else "for more than one of them"
    texts = (*given.present, "for none of them", several)
    return dict(zip("ABCDEFGHIJKLMNOPQRSTUVWXYZ", texts, strict=False))
