"""The eligibility traces of all states along a run, accumulating or replacing."""

from typing import Self

from msgspec.structs import replace
from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, OpenShare, Parameter, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.models import Name
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import check_one_open, discount, in_open, trace_parameter
from rldrill.problems.reversible import Reversible, letter_asked, unknown
from rldrill.problems.runs import Replacing
from rldrill.problems.settings import draw_visits

TITLE = "Eligibility traces"
SOURCE = "Sutton & Barto 2018, section 12.2"
REVISION = 6


class Given(Reversible):
    """The states visited at times 0, 1, …, γ and λ, and the times at which the traces are asked for.

    Where ``known`` is the trace of the first state at the first of these times, what is left open is asked for, and
    then the traces at the other times.
    """

    states: tuple[Name, ...] = Field(
        min_length=1, max_length=301, description="The states visited at the times 0, 1, and so on."
    )
    gamma: Discount
    lam: OpenShare = Field(description="The decay of the traces, besides the discount.")
    asked: tuple[int, ...] = Field(
        min_length=1, max_length=26, description="The times at which the traces are asked for."
    )
    replacing: Replacing = False

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_one_open(self)
        if list(self.asked) != sorted(set(self.asked)):
            raise ValueError("asked: the times must rise from one to the next")
        for time in self.asked:
            if not 0 <= time < len(self.states):
                raise ValueError(f"asked: no state is visited at time {time}; the last time is {len(self.states) - 1}")
        return self

    @property
    def visited(self) -> tuple[str, ...]:
        """The states, in the order of their first visit."""
        return tuple(dict.fromkeys(self.states))


#: γ and λ; traces decay by their product, which is 1/2 or 1/3.
_DECAYS = tuple(
    (fraction_of(gamma), fraction_of(lam))
    for gamma, lam in (("1/2", "2/3"), ("2/3", "3/4"), ("3/4", "2/3"), ("2/3", "1/2"), ("4/5", "5/8"), ("5/6", "3/5"))
)


def draw(level: int, rng: Draws) -> Given:
    """Two visits and a return; then four or five visits; then traces that add up, with a letter open or to be found."""
    gamma, lam = rng.choice(_DECAYS)
    if level == 1:
        return Given(states=draw_visits(rng, "aba")[1], gamma=gamma, lam=lam, asked=(2,))
    _, states = draw_visits(rng, "abaca", "abacb", "aabca", "abcba", "abba", "abab", "aaba")
    last = len(states) - 1
    given = Given(
        states=states,
        gamma=gamma,
        lam=lam,
        asked=rng.choice(((last - 1, last), (last,))) if level == 2 else (last,),
        replacing=level == 2 and rng.chance(Fraction(1, 3)),
    )
    if level == 2:
        return given
    kind = rng.below(6)
    update: dict[str, object] = {"gamma": Parameter("gamma")} if kind % 2 else {"lam": Parameter("lambda")}
    if kind < 4:
        update = {"gamma": Fraction(1, 2), "lam": Fraction(1, 2)} | update
    else:
        update |= {"known": gamma * lam + (states[1] == states[0]), "asked": (1, last)}
    return given.model_copy(update=update)


def question(given: Given) -> Question:
    """The visits as a table over time; the traces at every time asked for are a part."""
    kind = (
        "a replacing eligibility trace, which a visit sets to $1$" if given.replacing
        else "an accumulating eligibility trace"
    )  # fmt: skip
    blocks = (
        Paragraph("An agent visits these states:"),
        Table(
            header=("$t$", *(f"${time}$" for time in range(len(given.states)))),
            rows=(("$s_t$", *given.states),),
        ),
        Paragraph(unknown(given, f"{discount(given.gamma)} {trace_parameter(given.lam)}")),
        Paragraph(
            f"Each state has {kind}. All traces are $0$ before the first visit, and all are updated at every time, "
            "from $t = 0$ on."
        ),
    )
    first = given.states[0]
    parts = [_traces(given, time) for time in given.asked]
    if given.known is not None:
        letter = letter_asked(given)
        told = (
            f'After the update at $t = {given.asked[0]}$ the trace of {first} is $e("{first}") = {shown(given.known)}$.'
        )
        parts[0] = replace(letter, ask=f"{told} {letter.ask}")
    return Question(blocks, tuple(parts))


def _traces(given: Given, time: int) -> Part:
    states = given.visited
    asked = "$e(s)$ of every state" if len(states) > 1 else f'$e("{states[0]}")$'
    ask = f"What is the trace {asked} after the update at $t = {time}${in_open(given)}?"
    return Part(ask, Values("e", states))
