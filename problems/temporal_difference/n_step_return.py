"""The n-step return along a trajectory."""

from typing import Self

from msgspec.structs import replace
from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discounts, Open, Parameter, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Named, values_table
from rldrill.problems.parts import Number, Part
from rldrill.problems.phrases import check_one_open, discount, in_open
from rldrill.problems.reversible import Reversible, letter_asked, unknown
from rldrill.problems.runs import Trajectory, check_values, draw_whole, per_step, seen
from rldrill.problems.settings import draw_visits

TITLE = "n-step return"
SOURCE = "Sutton & Barto 2018, section 7.1"
REVISION = 4
#: The run and the table of values are given whole: how far the return reaches into them is the question. Beyond the end
#: of an episode it does not matter how many steps are asked for, which is a question, too.
DISTRACTORS = ("values.*", "trajectory.rewards.*", "asked.*")

#: Steps that one asks for, beyond the end of the episode too.
_LONGEST = 1000


class Given(Reversible):
    """A trajectory, the current values, the discount, and which returns are asked: pairs of time and n.

    Instead of one discount there may be a list with one for every step. Where ``known`` is the first of the returns,
    what is left open is asked for, and then the others.
    """

    trajectory: Trajectory = Field(description="What the agent did.")
    values: Named[Open] = Field(description="The current value of every state.")
    gamma: Discounts
    asked: tuple[tuple[int, int], ...] = Field(
        min_length=1, max_length=26, description="Which returns are asked for, each as [time, n]."
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_values(self.values, self.trajectory.states, self.trajectory.terminal)
        per_step(self.gamma, len(self.trajectory.rewards))
        check_one_open(self)
        last = len(self.trajectory.rewards)
        for time, steps in self.asked:
            if not 0 <= time < last or not 1 <= steps <= _LONGEST:
                raise ValueError(
                    f"asked: the time {time} must be from 0 to {last - 1}, since the run ends at {last}, and the "
                    f"number of steps {steps} from 1 to {_LONGEST}"
                )
            if time + steps > last and not self.trajectory.ends:
                raise ValueError(
                    f"asked: from time {time}, {steps} steps do not fit into a run that is cut off at {last}; list "
                    f"{self.trajectory.states[-1]!r} as terminal if the episode ends there"
                )
        return self


#: Orders of visits to the end, and those of runs that are cut off.
_WHOLE = "abc.", "aba.", "abb."
_CUT_OFF = "abcd", "abac", "abbc"


def draw(level: int, rng: Draws) -> Given:
    """Two steps; then two returns, perhaps beyond the end; then a value or γ is to be found first."""
    gamma = rng.fraction("1/2", "4/5", "3/4")
    if level == 1:
        return _given(rng, Fraction(1, 2), ((0, 2),), "abac", "abcd")
    if level == 3:
        return _asked_back(rng, gamma)
    visits = _WHOLE if (whole := rng.chance(Fraction(1, 2))) else _CUT_OFF
    asked = rng.choice((((0, 2), (1, 2)), ((0, 1), (0, 3)), ((1, 1), (0, 3)), ((0, 2), (0, 3))))
    if whole and rng.chance(Fraction(1, 2)):
        asked = ((0, 2), (1, 4))
    return _given(rng, gamma, asked, *visits)


def _asked_back(rng: Draws, gamma: Fraction) -> Given:
    """γ, or the value of a state, from one return; then another return in which it stands."""
    if rng.chance(Fraction(1, 2)):
        visits = _WHOLE if rng.chance(Fraction(1, 2)) else _CUT_OFF
        given = _given(rng, gamma, ((0, 1), rng.choice(((0, 2), (0, 3), (1, 2)))), *visits)
        letter: dict[str, object] = {"gamma": Parameter("gamma")}
    else:
        twice = "acbc"
        tour, *asked = rng.choice((
            ("abcd", (0, 2), (1, 1)), (twice, (0, 1), (0, 3)), (twice, (0, 1), (1, 2)), (twice, (0, 3), (0, 1)),
        ))  # fmt: skip
        given = _given(rng, gamma, tuple(asked), tour)
        letter = {"values": given.values | {given.trajectory.states[tour.index("c")]: Parameter("x")}}
    return given.model_copy(update={**letter, "known": _worth(given, gamma, *given.asked[0])})


def _worth(given: Given, gamma: Fraction, time: int, steps: int) -> Fraction:
    """The return from a time, where neither the end of the run nor a letter is in the way."""
    run = given.trajectory
    ahead = (*map(Fraction, run.rewards[time : time + steps]), Fraction(given.values[run.states[time + steps]]))
    return sum((gamma**late * reward for late, reward in enumerate(ahead)), Fraction(0))


def _given(rng: Draws, gamma: Fraction, asked: tuple[tuple[int, int], ...], *visits: str) -> Given:
    setting, states = draw_visits(rng, *visits)
    run, values = draw_whole(rng, states, setting.terminal, gamma)
    return Given(trajectory=run, values=values, gamma=gamma, asked=asked)


def question(given: Given) -> Question:
    """The run over time; each return is a part."""
    letter = "The value $x$ is left open." if "x" in given.letters else ""
    blocks = (
        *seen(given.trajectory),
        Paragraph(unknown(given, f"These are the current values. {discount(given.gamma)} {letter}").strip()),
        values_table(given.values),
    )
    parts = [
        Part(f"What is the {n}-step return $R_{{{t}}}^{{({n})}}$ from time ${t}${in_open(given)}?", Number())
        for t, n in given.asked
    ]
    if given.known is not None:
        (t, n), *_ = given.asked
        letter_part = letter_asked(given)
        told = f"The {n}-step return from time ${t}$ is $R_{{{t}}}^{{({n})}} = {shown(given.known)}$."
        parts[0] = replace(letter_part, ask=f"{told} {letter_part.ask}")
    return Question(blocks, tuple(parts))
