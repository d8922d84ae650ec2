"""The eligibility traces of all states along a run, accumulating or replacing."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, OpenProbability, Parameter
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Name
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import check_one_open, discount, in_open, trace_parameter
from rldrill.problems.runs import Replacing
from rldrill.problems.settings import draw_setting

TITLE = "Eligibility traces"
SOURCE = "Sutton & Barto 2018, section 12.2"
REVISION = 1


class Given(Givens):
    """The states visited at times 0, 1, …, γ and λ, and the times at which the traces are asked for."""

    states: tuple[Name, ...] = Field(
        min_length=1, max_length=301, description="The states visited at the times 0, 1, and so on."
    )
    gamma: Discount
    lam: OpenProbability = Field(description="The decay of the traces, besides the discount.")
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


def draw(level: int, rng: Draws) -> Given:
    """Two visits and a return; then five visits of three states; then with λ left open."""
    setting = draw_setting(rng)
    first, second, third = rng.shuffled(setting.states)[:3]
    tours = ((first, second, first, third, first), (first, second, first, third, second),
             (first, first, second, third, first), (first, second, third, second, first))  # fmt: skip
    return Given(
        states=(first, second, first) if level == 1 else rng.choice(tours),
        gamma=rng.fraction("1/2", "4/5"),
        lam=Parameter("lambda") if level == 3 else rng.fraction("1/2", "1/4"),
        asked=(2,) if level == 1 else (2, 4),
    )


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
        Paragraph(f"{discount(given.gamma)} {trace_parameter(given.lam)}"),
        Paragraph(
            f"Each state has {kind}. All traces are $0$ before the first visit, "
            "and all are updated at every time, from $t = 0$ on."
        ),
    )
    every = "all states" if len(given.visited) > 1 else "the state"
    parts = tuple(
        Part(
            f"What are the traces $e(s)$ of {every} after the update at $t = {time}${in_open(given)}?",
            Values("e", given.visited),
        )
        for index, time in enumerate(given.asked)
    )
    return Question(blocks, parts)
