"""The n-step return along a trajectory."""

from dataclasses import replace
from typing import Self

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
from rldrill.problems.settings import draw_setting

TITLE = "n-step return"
SOURCE = "Sutton & Barto 2018, section 7.1"
REVISION = 2
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
        check_values(self.values, self.trajectory)
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


def draw(level: int, rng: Draws) -> Given:
    """Two steps; then two returns, perhaps beyond the end; then γ left open, or a value or γ to be found."""
    setting = draw_setting(rng)
    a, b, c, d = rng.shuffled(setting.states)
    end, gamma = setting.terminal, rng.fraction("1/2", "4/5", "3/4")
    if level == 1:
        return _given(rng, (a, b, rng.choice((a, c)), d), end, Fraction(1, 2), ((0, 2),))
    whole = rng.chance(Fraction(1, 2))
    states = (*rng.choice(((a, b, c), (a, b, a), (a, b, b))), end if whole else d)
    asked = rng.choice((((0, 2), (1, 2)), ((0, 1), (0, 3)), ((1, 1), (0, 3)), ((0, 2), (0, 3))))
    if whole and rng.chance(Fraction(1, 2)):
        asked = ((0, 2), (1, 4))
    if level == 2:
        return _given(rng, states, end, gamma, asked)
    kind = rng.below(3)
    if kind == 0:
        return _given(rng, (a, b, c, d), end, gamma, (*asked[:1], (1, 2))).model_copy(
            update={"gamma": Parameter("gamma")}
        )
    if kind == 1:  # γ from a one-step return, then a longer one
        given = _given(rng, states, end, gamma, ((0, 1), (0, 3)))
        known = given.trajectory.rewards[0] + gamma * Fraction(given.values[b])
        return given.model_copy(update={"gamma": Parameter("gamma"), "known": known})
    given = _given(rng, (a, b, c, d), end, gamma, ((0, 2), rng.choice(((1, 1), (1, 2)))))
    first, second, _ = given.trajectory.rewards
    known = first + gamma * second + gamma**2 * Fraction(given.values[c])
    return given.model_copy(update={"values": given.values | {c: Parameter("x")}, "known": known})


def _given(rng: Draws, states: tuple[str, ...], end: str, gamma: Fraction, asked: tuple[tuple[int, int], ...]) -> Given:
    run, values = draw_whole(rng, states, end, gamma)
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
