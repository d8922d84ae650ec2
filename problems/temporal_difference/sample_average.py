"""The values after several visits by the sample average, or by a constant step size where the returns drift."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, StepSize, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Name, check_keys, values_table
from rldrill.problems.parts import Number, Numbers, Part, Values
from rldrill.problems.phrases import in_open, step_size
from rldrill.problems.settings import draw_setting

TITLE = "Sample average"
SOURCE = "Sutton & Barto 2018, sections 2.4 and 2.5"
REVISION = 1


class Given(Givens):
    """The values so far, how often each state was visited, and further visits: pairs of a state and its return.

    With a step size ``alpha`` all visits are to one state, and the counts play no part.
    """

    values: dict[Name, Exact] = Field(min_length=1, description="The value of every state so far.")
    counts: dict[Name, int] = Field(
        default_factory=dict, description="How often each state was visited so far; without a step size it is needed."
    )
    visits: tuple[tuple[Name, Exact], ...] = Field(
        min_length=1, max_length=300, description="The visits after that, each as [state, return]."
    )
    alpha: StepSize | None = Field(default=None, description="The step size; without it the values stay averages.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        known = tuple(self.values)
        check_keys(dict.fromkeys(state for state, _ in self.visits), known, "a return", needed=())
        if self.alpha is None:
            check_keys(self.counts, known, "the number of visits", needed=known)
            if negative := [state for state, count in self.counts.items() if not 0 <= count <= 10**6]:
                raise ValueError(f"counts: {negative[0]!r} cannot have been visited {self.counts[negative[0]]} times")
        elif self.counts:
            raise ValueError("counts: a constant step size does not depend on them; give either counts or alpha")
        elif len(self.values) > 1:
            raise ValueError("values: with a constant step size give the value of the one state that is visited")
        return self

    @property
    def visited(self) -> tuple[str, ...]:
        """The states that are visited now, in the order of their first visit."""
        return tuple(dict.fromkeys(state for state, _ in self.visits))

    @property
    def visited_before(self) -> bool:
        """Whether every state that is visited now was visited before, so that one less than n(s) is not 0."""
        return all(self.counts.get(state, 0) for state in self.visited)


def draw(level: int, rng: Draws) -> Given:
    """One visit; then four visits of two states; then four with a constant step size left open."""
    setting = draw_setting(rng)
    first, second = rng.shuffled(setting.states)[:2]
    if level == 3:
        return Given(
            values={first: rng.nonzero(-4, 8)},
            visits=tuple((first, rng.nonzero(-4, 9)) for _ in range(4)),
            alpha=Parameter("alpha"),
        )
    named = (first,) if level == 1 else (first, second)
    states = (first,) if level == 1 else rng.shuffled((first, first, second, first, second))
    return Given(
        values={state: rng.nonzero(-4, 10) for state in named},
        counts={state: 2 + rng.below(4) if level == 1 else 1 + rng.below(3) for state in named},
        visits=tuple((state, rng.nonzero(-6, 12)) for state in states),
    )


def question(given: Given) -> Question:
    """The values so far, the further visits, and the step size that is used."""
    if given.alpha is None:
        return Question(
            (
                Paragraph("Every-visit Monte Carlo averages the returns after all visits to a state. So far it has:"),
                _averages(given),
                *_visits(given, "averaged in"),
            ),
            (Part(_values_asked(given), Values("V", given.visited)),),
        )
    state, count = given.visited[0], len(given.visits)
    blocks = (
        Paragraph("The world drifts, so Monte Carlo uses a constant step size. So far it has:"),
        values_table(given.values),
        *_visits(given, "used for one update"),
        Paragraph(step_size(given.alpha)),
    )
    tail = in_open(given)
    entries = tuple(f"w_{{{index + 1}}}" for index in range(count))
    after = f'$V("{state}")$ after {"all these updates" if count > 1 else "the update"}'
    value = f"What is {after}{tail}?"
    if count == 1:
        weights = Part(f"With which weight $w_1$ does the return enter {after}{tail}?", Number())
    else:
        ask = f"With which weights $w_1, …, w_{{{count}}}$ do the returns of the visits $1, …, {count}$ enter"
        weights = Part(f"{ask} {after}{tail}?", Numbers(entries))
    return Question(blocks, (weights, Part(value, Number())))


def _values_asked(given: Given) -> str:
    state, *others = given.visited
    asked = "the value of every state that was visited" if others else f'$V("{state}")$'
    return f"What is {asked} afterwards?"


def _averages(given: Given) -> Table:
    return Table(
        header=("$s$", *given.values),
        rows=(
            ("$V(s)$", *(f"${shown(value)}$" for value in given.values.values())),
            ("$n(s)$", *(f"${given.counts[state]}$" for state in given.values)),
        ),
    )


def _visits(given: Given, used: str) -> tuple[Block, ...]:
    if len(given.visits) == 1:
        ((state, value),) = given.visits
        return (Paragraph(f"Now {state} is visited, and the return after this visit is ${shown(value)}$."),)
    return (
        Paragraph(f"Then these visits follow. The return after each is {used}, in this order."),
        Table(
            header=("visit", *(f"${index + 1}$" for index in range(len(given.visits)))),
            rows=(
                ("state", *(state for state, _ in given.visits)),
                ("return", *(f"${shown(value)}$" for _, value in given.visits)),
            ),
        ),
    )
