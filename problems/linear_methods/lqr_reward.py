"""The rewards of a short rollout of a linear system under a linear feedback."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Equation, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, dot, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.linear_quadratic import NOTATIONS, LinearQuadratic, by_time, costs, draw_system, one_or, situation
from rldrill.problems.mathematics import mathematics
from rldrill.problems.matrices import MatricesField, check_shape, diagonal, tabular
from rldrill.problems.parts import Number, Part
from rldrill.problems.phrases import in_open

TITLE = "LQR reward"
SOURCE = "Bertsekas 2017, section 3.1"
REVISION = 6

Line = tuple[Fraction, ...]


class Given(LinearQuadratic):
    """A system, and the gain L (or one for every time 0 to horizon) of the actions a = −L s.

    With a discount, a cross term or a final cost of its own there is no action at the horizon any more. With ``total``,
    the sum of all rewards, the price of the action is left open in R and found from it.
    """

    FOUND_BY = "total"

    L: MatricesField = Field(
        description="The gain of the actions a = −L s, the same at all times or one for each from 0 to the horizon."
    )

    total: Exact | None = Field(
        default=None, description="The sum of all rewards, from which the price rho that R leaves open is found."
    )

    @model_validator(mode="after")
    def _gains_fit(self) -> Self:
        if self.total is not None and not self.left_open:
            raise ValueError("total: it goes with a price that R leaves open, such as rho")
        count = self.horizon + self.plain
        if len(self.L) not in (1, count):
            raise ValueError(f"L holds {len(self.L)} matrices; {one_or(count)}")
        for gain in self.L:
            check_shape("L", gain, self.actions, len(self.start), f"with {len(self.start)} states ")
        return self


def draw(level: int, rng: Draws) -> Given:
    """Numbers and two times; then two states, a discount, a final cost or two gains; then the price open, or found."""
    kind = rng.choice({1: ("plain",), 2: ("plain", "gains", "discount", "end"), 3: ("open", "found", "found")}[level])
    states = 1 if level == 1 else 2
    horizon = 1 + rng.below(2) if level == 3 else 1
    gamma = rng.fraction("1/2", "1/3", "2/3") if kind == "discount" else Fraction(1)
    while True:
        price = rng.whole(1, 3) if level < 3 else rng.whole(2, 7)
        system = draw_system(rng, states, price)
        if kind == "end":
            system["Q_T"] = diagonal(rng.whole(3, 5), rng.whole(2, 4))
        gains = tuple((_gain(rng, states),) for _ in range(horizon + 1 if kind == "gains" else 1))
        start = tuple(rng.nonzero(-2, 3) for _ in range(states))
        given = Given(**system, gamma=gamma, L=gains, start=start, horizon=horizon)
        rewards = _rewards(given)
        if (
            len(set(rewards)) == len(rewards) > 0
            and -sum(rewards) <= _MOST[level]
            and max(map(_size, (*rewards, sum(rewards, Fraction(0))))) <= _MOST[level]
            and (kind != "end" or _counts(given))
        ):
            break
    if level < 3:
        return given
    left_open = {"R": (((Parameter("rho"),),),)}
    return given.model_copy(update=left_open | ({"total": sum(rewards)} if kind == "found" else {}))


#: The largest reward of a level.
_MOST = {1: 40, 2: 55, 3: 200}


def _gain(rng: Draws, states: int) -> Line:
    return tuple(
        rng.nonzero(-1, 2) if states > 1 else rng.fraction("1/2", "-1/2", "2", "-2", "3/2") for _ in range(states)
    )


def _size(number: Fraction) -> int:
    return max(abs(number.numerator), number.denominator)


def _counts(given: Given) -> bool:
    """Whether the total would be another one if the end came a time later, so that the last time matters."""
    later = _rewards(given.model_copy(update={"horizon": given.horizon + 1}))
    return bool(later) and sum(later) != sum(_rewards(given))


def _rewards(given: Given) -> list[Fraction]:
    """The rewards of all times, discounted; none, if a state or action on the way is zero, or the state after it."""
    rewards, state, (A,), (B,) = [], given.start, given.A, given.B
    for time in range(given.horizon + 1):
        ended = time == given.horizon and not given.plain
        action = -dot(by_time(given.L, 0 if ended else time)[0], state) * (not ended)
        if not all(state) or not (action or ended):
            return []
        Q = by_time(given.state_costs, time)
        cost = dot(state, (dot(line, state) for line in Q)) + action**2 * given.price
        rewards.append(-cost * given.gamma**time)
        state = tuple(dot(line, state) + entry * action for line, (entry,) in zip(A, B, strict=True))
    return rewards if any(state) else []


def question(given: Given) -> Question:
    """The first reward, then the total."""
    gains = (
        Equation(mathematics(f"L_{'t' if len(given.L) == 1 else time}"), (tabular(gain),), ("=",), linear=True)
        for time, gain in enumerate(given.L)
    )
    last = given.horizon
    sum_ = " + ".join(f"r(s_{time}, a_{time})" for time in range(last + 1)) if last < 3 else (
        f"r(s_0, a_0) + … + r(s_{{{last}}}, a_{{{last}}})"
    )  # fmt: skip
    told = f"The actions are $a_t = −L_t s_t$ at all these times, also at the last, $T = {last}$:"
    blocks: tuple[Block, ...] = (*situation(given), Paragraph(told))
    total, all_ = f"What is the total reward $J = {sum_}$", f"The total reward is $J = {sum_} ="
    if not given.plain:
        blocks = (*costs(given, NOTATIONS["value"]), Paragraph("Before $T$ the action is $a_t = −L_t s_t$:"))
        discounted = "" if given.gamma == 1 else ", discounted"
        total = f"What is the total $J$ of all rewards{discounted}"
        all_ = f"The total of all rewards{discounted}{',' * bool(discounted)} is $J ="
    if given.total is not None:
        found = f"{all_} {shown(given.total)}$. What is the price $ρ$ of the action?"
        first = Part("What is the first reward $r(s_0, a_0)$ then?", Number())
        return Question((*blocks, *gains), (Part(found, Number()), first))
    return Question(
        (*blocks, *gains),
        (
            Part(f"What is the first reward $r(s_0, a_0)${in_open(given)}?", Number()),
            Part(f"{total}{in_open(given)}?", Number()),
        ),
    )
