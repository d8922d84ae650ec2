"""The values after several visits by the sample average, or by a constant step size where the returns drift."""

from collections.abc import Sequence
from operator import ne
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Open, Parameter, StepSize, needed, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Name, Named, check_keys, values_table
from rldrill.problems.parts import Number, Numbers, Part, Values
from rldrill.problems.phrases import check_one_open, in_open, step_size
from rldrill.problems.reversible import Reversible, letter_asked, unknown
from rldrill.problems.settings import draw_setting, in_order

TITLE = "Sample average"
SOURCE = "Sutton & Barto 2018, sections 2.4 and 2.5"
REVISION = 6


class Given(Reversible):
    """The values so far, how often each state was visited, and further visits: pairs of a state and its return.

    With a step size ``alpha`` all visits are to one state, and the counts play no part. Where ``known`` is the value of
    the first visited state after all visits, what is left open is asked for.
    """

    values: Named[Exact] = Field(min_length=1, description="The value of every state so far.")
    counts: Named[int] = Field(
        default_factory=dict, description="How often each state was visited so far; without a step size it is needed."
    )
    visits: tuple[tuple[Name, Open], ...] = Field(
        min_length=1, max_length=300, description="The visits after that, each as [state, return]."
    )
    alpha: StepSize | None = Field(default=None, description="The step size; without it the values stay averages.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        known = tuple(self.values)
        check_keys(dict.fromkeys(state for state, _ in self.visits), known, "a return", needed=())
        if self.alpha is None:
            check_keys(self.counts, known, "counts: the number of visits", needed=known)
            if negative := [state for state, count in self.counts.items() if not 0 <= count <= 10**6]:
                raise ValueError(
                    f"counts: {negative[0]!r} cannot have been visited {self.counts[negative[0]]} times; give 0 or more"
                )
        elif self.counts:
            raise ValueError("counts: a constant step size does not depend on them; give either counts or alpha")
        elif len(self.values) > 1:
            raise ValueError("values: with a constant step size give the value of the one state that is visited")
        check_one_open(self)
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
    """One visit; then three or four visits of two states; then a step size left open, or a letter to be found."""
    setting = draw_setting(rng)
    a, b = rng.shuffled(setting.states)[:2]
    if level == 1:
        return _averaged(rng, (a,))
    tours = (a, a, b), (a, b, a), (b, a, b, a), (a, a, b, a), (b, a, a, b), (a, b, b, a)
    if level == 2 and rng.chance(Fraction(2, 3)):
        return _averaged(rng, rng.choice(tours))
    count = 2 + rng.below(3)
    returns = [rng.nonzero(-4, 9) for _ in range(count)]
    if level == 2:
        alpha = rng.fraction("1/2", "1/3") if count < 4 else Fraction(1, 2)
        value = _before(rng, returns, [alpha] * count)
        return Given(values={a: value}, visits=tuple((a, each) for each in returns), alpha=alpha)
    kind = rng.below(3)
    if kind == 0:
        few = returns[:3]  # with a fourth the powers of α are no pleasure
        value = _before(rng, few, [Fraction(0)] * len(few))
        return Given(values={a: value}, visits=tuple((a, each) for each in few), alpha=Parameter("alpha"))
    hidden = rng.below(count)
    visits = tuple((a, each if index != hidden else Parameter("x")) for index, each in enumerate(returns))
    before = 1 + rng.below(5)
    shares = [Fraction(1, 2)] * count if kind == 1 else _of_an_average(before, count)
    value = _before(rng, returns, shares)
    known = _along(value, returns, shares)[-1]
    if kind == 1:
        return Given(values={a: value}, visits=visits, alpha=shares[0], known=known)
    return Given(values={a: value}, counts={a: before}, visits=visits, known=known)


def _averaged(rng: Draws, states: tuple[str, ...]) -> Given:
    visits = tuple((state, rng.nonzero(-6, 12)) for state in states)
    values: dict[str, Fraction] = {}
    counts: dict[str, int] = {}
    for state in in_order(states):
        returns = [each for visited, each in visits if visited == state]
        counts[state] = (2 if len(states) == 1 else 1) + rng.below(4)
        shares = _of_an_average(counts[state], len(returns))
        values[state] = _before(rng, returns, shares, others=tuple(values.values()))
    return Given(values=values, counts=counts, visits=visits)


def _of_an_average(before: int, count: int) -> list[Fraction]:
    """How far each of so many further returns moves an average of those before."""
    return [Fraction(1, before + number) for number in range(1, count + 1)]


def _along(value: Fraction, returns: Sequence[Fraction], shares: Sequence[Fraction]) -> list[Fraction]:
    """The value before every return, which moves it that share of the way, and after the last."""
    values = [value]
    for each, share in zip(returns, shares, strict=True):
        values.append(values[-1] + share * (each - values[-1]))
    return values


def _before(
    rng: Draws, returns: Sequence[Fraction], shares: Sequence[Fraction], others: Sequence[Fraction] = ()
) -> Fraction:
    """A value so far that every return moves, and all of them together, and that no other state has."""

    def fits(value: int) -> bool:
        moved = all(map(ne, returns, _along(Fraction(value), returns, shares)))
        return moved and len(returns) * value != sum(returns) and value not in others

    return rng.fitting(-4, 10, fits)


def question(given: Given) -> Question:
    """The values so far, the further visits, and the step size that is used."""
    if given.alpha is None:
        blocks: tuple[Block, ...] = (
            Paragraph(
                "Every-visit Monte Carlo estimates $V(s)$ by the average of the returns after all $n(s)$ visits."
            ),
            Paragraph("The estimates so far are:"),
            _averages(given),
            *_visits(given, "averaged in"),
        )
        if given.known is not None:
            return Question((*blocks, _told(given)), (letter_asked(given),))
        return Question(blocks, (Part(_values_asked(given), Values("V", given.visited)),))
    state, count = given.visited[0], len(given.visits)
    blocks = (
        Paragraph(
            "The environment changes over time, so Monte Carlo uses a constant step size. The estimate so far is:"
        ),
        values_table(given.values),
        *_visits(given, "used for one update"),
        Paragraph(unknown(given, step_size(given.alpha))),
    )
    if given.known is not None:
        return Question((*blocks, _told(given)), (letter_asked(given),))
    tail = in_open(given)
    entries = tuple(f"w_{{{index + 1}}}" for index in range(count))
    after = f'$V("{state}")$ after {"all these updates" if count > 1 else "the update"}'
    value = f"What is {after}{tail}?"
    if count == 1:
        weights = Part(f"With what weight $w_1$ does the return enter {after}{tail}?", Number())
    else:
        between = ", …, " if count > 2 else ", "
        ask = f"With what weights $w_1{between}w_{{{count}}}$ do the returns of the visits $1{between}{count}$ enter"
        weights = Part(f"{ask} {after}{in_open(given)}?", Numbers(entries))
    return Question(blocks, (weights, Part(value, Number())))


def _told(given: Given) -> Paragraph:
    letter = "The return $x$ is not known. " if given.letter == "x" else ""
    return Paragraph(f'{letter}In the end $V("{given.visited[0]}") = {shown(needed(given.known))}$.')


def _values_asked(given: Given) -> str:
    state, *others = given.visited
    asked = "the value of every visited state" if others else f'$V("{state}")$'
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
        return (Paragraph(f"Then {state} is visited, and the return after this visit is ${shown(value)}$."),)
    return (
        Paragraph(f"Then these visits follow. The return after each of them is {used}, in this order."),
        Table(
            header=("visit", *(f"${index + 1}$" for index in range(len(given.visits)))),
            rows=(
                ("state", *(state for state, _ in given.visits)),
                ("return", *(f"${shown(value)}$" for _, value in given.visits)),
            ),
        ),
    )
