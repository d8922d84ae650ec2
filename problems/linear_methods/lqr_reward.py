"""The rewards of a short rollout of a linear system under a linear feedback."""

from fractions import Fraction
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Equation, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, dot
from rldrill.problems.family import Question
from rldrill.problems.linear_quadratic import NOTATIONS, LinearQuadratic, costs, draw_system, situation
from rldrill.problems.mathematics import mathematics
from rldrill.problems.matrices import MatricesField, check_shape, tabular
from rldrill.problems.parts import Number, Part
from rldrill.problems.phrases import in_open

TITLE = "LQR reward"
SOURCE = "Bertsekas 2017, section 3.1"
REVISION = 2

Line = tuple[Fraction, ...]
Rows = tuple[Line, ...]
#: States stay this close to 0.
_FAR = 6


class Given(LinearQuadratic):
    """A system, and the gain L (or one for every time 0 to horizon) of the actions a = −L s.

    With a discount, a cross term or a final cost of its own there is no action at the horizon any more.
    """

    L: MatricesField = Field(
        description="The gain of the actions a = −L s, the same at all times or one for each from 0 to the horizon."
    )

    @model_validator(mode="after")
    def _gains_fit(self) -> Self:
        count = self.horizon + self.plain
        if len(self.L) not in (1, count):
            raise ValueError(f"L holds {len(self.L)} matrices; give one, or {count} for the times from 0")
        for gain in self.L:
            check_shape("L", gain, self.actions, len(self.start), f"with {len(self.start)} states ")
        return self


def draw(level: int, rng: Draws) -> Given:
    """Numbers and two times; then two states; then three times, perhaps with the price of the action open."""
    states = 1 if level == 1 else 2
    price = Parameter("rho") if level == 3 and rng.chance(rng.fraction("1/2")) else rng.whole(1, 3)
    system = draw_system(rng, states, price)
    gain = (tuple(rng.whole(0, 2) if states > 1 else rng.fraction("1/2", "1", "2") for _ in range(states)),)
    start = tuple(rng.nonzero(-2, 3) for _ in range(states))
    horizon = 1 if level < 3 else 2
    if _farthest(system["A"], system["B"], gain[0], start, horizon) > _FAR:
        return draw(level, rng)
    return Given(**system, L=gain, start=start, horizon=horizon)


def _farthest(A: Rows, B: Rows, gain: Line, state: Line, horizon: int) -> Fraction:
    """The greatest entry of a state on the way, with one action."""
    greatest = max(map(abs, state))
    for _ in range(horizon):
        action = -dot(gain, state)
        state = tuple(dot(line, state) + entry * action for line, (entry,) in zip(A, B, strict=True))
        greatest = max(greatest, *map(abs, state))
    return greatest


def question(given: Given) -> Question:
    """The first reward, then the total."""
    gains = (
        Equation(mathematics(f"L_{'t' if len(given.L) == 1 else time}"), (tabular(gain),), ("=",))
        for time, gain in enumerate(given.L)
    )
    last = given.horizon
    sum_ = " + ".join(f"r(s_{time}, a_{time})" for time in range(last + 1)) if last < 3 else (
        f"r(s_0, a_0) + … + r(s_{{{last}}}, a_{{{last}}})"
    )  # fmt: skip
    told = "The actions are $a_t = −L_t s_t$ at every one of these times"
    blocks: tuple[Block, ...] = (*situation(given), Paragraph(f"{told}, the last included:"))
    total = f"What is the total reward $J = {sum_}$"
    if not given.plain:
        blocks = (*costs(given, NOTATIONS["value"]), Paragraph(f"{told} before $T$:"))
        total = f"What is the total $J$ of all rewards{'' if given.gamma == 1 else ', discounted'}"
    return Question(
        (*blocks, *gains),
        (
            Part(f"What is the first reward $r(s_0, a_0)${in_open(given)}?", Number()),
            Part(f"{total}{in_open(given)}?", Number()),
        ),
    )
