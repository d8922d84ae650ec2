"""The n-step return along a trajectory."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discounts, Exact, Parameter
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Name, values_table
from rldrill.problems.parts import Number, Part
from rldrill.problems.phrases import check_one_open, discount, in_open
from rldrill.problems.runs import Trajectory, check_values, per_step, seen
from rldrill.problems.settings import draw_setting

TITLE = "n-step return"
SOURCE = "Sutton & Barto 2018, section 7.1"
REVISION = 1

#: Steps that one asks for, beyond the end of the episode too.
_LONGEST = 1000


class Given(Givens):
    """A trajectory, the current values, the discount, and which returns are asked: pairs of time and n.

    Instead of one discount there may be a list with one for every step.
    """

    trajectory: Trajectory = Field(description="What the agent did.")
    values: dict[Name, Exact] = Field(description="The current value of every state.")
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
    """Two steps; then three steps and two; then an expression in γ."""
    setting = draw_setting(rng)
    length = {1: 4, 2: 5, 3: 5}[level]
    states = [rng.choice(setting.states[:3]) for _ in range(length)]
    named = [state for state in setting.states if state in states]
    asked = {1: ((0, 2),), 2: ((0, 3), (1, 2)), 3: ((0, 3), (1, 2))}[level]
    return Given(
        trajectory=Trajectory(states=tuple(states), rewards=tuple(rng.nonzero(-3, 8) for _ in states[1:])),
        values={state: rng.nonzero(-4, 10) for state in named},
        gamma=Parameter("gamma") if level == 3 else rng.fraction("1/2", "9/10", "4/5"),
        asked=asked,
    )


def question(given: Given) -> Question:
    """The run over time; each return is a part."""
    blocks = (
        *seen(given.trajectory),
        Paragraph(f"The current values are these. {discount(given.gamma)}"),
        values_table(given.values),
    )
    tail = in_open(given)
    parts = tuple(
        Part(
            f"What is the {n}-step return $R_{{{t}}}^{{({n})}}$ from time ${t}${tail}?",
            Number(),
        )
        for index, (t, n) in enumerate(given.asked)
    )
    return Question(blocks, parts)
