"""Value matrices and gains of a finite horizon, backwards in time, and the first action."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, dot, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.linear_quadratic import (
    Conventional,
    LinearQuadratic,
    by_time,
    costs,
    draw_system,
    single_gain,
    situation,
    value_before,
)
from rldrill.problems.matrices import NumberRows
from rldrill.problems.parts import LETTERS, Matrix, Number, Part
from rldrill.problems.phrases import in_open

TITLE = "LQR over a finite horizon"
SOURCE = "Bertsekas 2017, section 3.1"
REVISION = 6


class Given(LinearQuadratic, Conventional):
    """A system; what is asked for are P and L of all times before the horizon, and the first action.

    With ``action``, which is the first, the horizon is 1, and the price that R leaves open is found from it.
    """

    FOUND_BY = "action"

    action: Exact | None = Field(
        default=None, description="The best first action, from which the price rho that R leaves open is found."
    )

    @model_validator(mode="after")
    def _one_step(self) -> Self:
        if self.action is not None and (self.horizon > 1 or self.actions > 1 or not self.left_open):
            raise ValueError(
                "action: it goes with the horizon 1, one action, and a price that R leaves open, such as rho"
            )
        return self

    @property
    def asked(self) -> range:
        """The times whose matrices are asked for, the last first: as many of the first as there are letters for."""
        return range(min(self.horizon, (LETTERS - 1) // 2) - 1, -1, -1)


#: The largest whole number in gains and value matrices, by level.
_MOST = {1: 30, 2: 80, 3: 150}


def draw(level: int, rng: Draws) -> Given:
    """One step back; then two, a discount, a final cost or two states; then the price open or found, or two of both."""
    kinds = {
        1: ("plain",),
        2: ("twice", "discount", "end", "states"),
        3: ("open", "found", "found", "two states twice"),
    }
    kind = rng.choice(kinds[level])
    states = 2 if level == 3 or kind == "states" else 1
    discounted = kind == "discount" or (kind in ("open", "found") and rng.chance(Fraction(1, 2)))
    gamma = rng.fraction("1/2", "2/3", "3/4") if discounted else Fraction(1)
    horizon = 2 if kind in ("twice", "two states twice", "end", "discount") else 1
    while True:
        system = draw_system(rng, states, rng.whole(1, 4))
        if kind == "end" or (discounted and states == 1):
            system["Q_T"] = ((rng.whole(4, 8),),)
        elif discounted:  # as the matrices of all times stand there, they are not the same one
            system["Q_T"] = tuple(line[::-1] for line in system["Q"][0][::-1])
        start = tuple(rng.nonzero(-3, 4) for _ in range(states))
        given = Given(**system, start=start, horizon=horizon, gamma=gamma)
        gains, values = _backwards(given)
        numbers = [
            *(entry for gain in gains for entry in gain),
            *(entry for P in values for line in P for entry in line),
        ]
        if all(gains[-1]) and max(max(abs(entry.numerator), entry.denominator) for entry in numbers) <= _MOST[level]:
            break
    if kind not in ("open", "found"):
        return given
    found = {"action": -dot(gains[-1], start)} if kind == "found" else {}
    if found.get("action") == 0:
        return draw(level, rng)
    return given.model_copy(update={"R": (((Parameter("rho"),),),), **found})


def _backwards(given: Given) -> tuple[list[tuple[Fraction, ...]], list[NumberRows]]:
    """Gains and value matrices, the last first."""
    (A,), (B,) = given.A, given.B
    P: NumberRows = tuple(tuple(-entry for entry in line) for line in by_time(given.state_costs, given.horizon))
    gains, values = [], []
    for time in range(given.horizon - 1, -1, -1):
        gains.append(single_gain(A, B, given.price / given.gamma, P))
        P = value_before(A, B, by_time(given.state_costs, time), P, gains[-1], given.gamma)
        values.append(P)
    return gains, values


def question(given: Given) -> Question:
    """Gain and value matrix of every time, the last first; then the action."""
    n, m = len(given.start), given.actions
    x, u, L, P, in_costs = given.notation
    matrix = "coefficient" if n == 1 else "matrix"
    wanted = []
    for time in given.asked:
        action = f"{u}_{{{time}}} = −{L}_{{{time}}} {x}_{{{time}}}"
        value = f"{x}^⊤ {P}_{{{time}}} {x}" if in_costs else f"V_{{{time}}}({x}) = {x}^⊤ {P}_{{{time}}} {x}"
        wanted += [
            (f"What is the gain ${L}_{{{time}}}$ of the best action ${action}$", Matrix(m, n)),
            (f"What is the {matrix} ${P}_{{{time}}}$ of the {'cost-to-go' if in_costs else 'value'} ${value}$",
             Matrix(n, n)),
        ]  # fmt: skip
    wanted.append((f"What is the best first action ${u}_0 = −{L}_0 {x}_0$", Matrix(m, 1)))
    blocks = _plain(given) if given.plain and not in_costs else _costs(given)
    if len(given.asked) < given.horizon:
        first = f"Only the first {len(given.asked)} of the {given.horizon} times are asked for"
        blocks = (*blocks, Paragraph(f"{first}; the recursion begins at the horizon all the same."))
    parts = [Part(f"{ask}{in_open(given)}?", kind, zero=n > 1) for ask, kind in wanted]
    if given.action is not None:
        told = f"The best first action is ${u}_0 = {shown(given.action)}$. What is the price $ρ$ of the action?"
        parts = [Part(told, Number()), *parts[:2]]
    return Question(blocks, tuple(parts))


def _plain(given: Given) -> tuple[Block, ...]:
    last = given.horizon
    return (
        *situation(given),
        Paragraph(
            f"The rewards at the times $0$ to $T = {last}$ are added, without a discount, and the sum is to be as "
            f"large as possible. $V_t(s) = s^⊤ P_t s$ is the largest sum from time $t$ on, so $P_t$ is "
            f"{_signed(given, 'negative')}. At the last time, $T$, the best action is $0$."
        ),
    )


def _costs(given: Given) -> tuple[Block, ...]:
    x, u, L, P, in_costs = given.notation
    what, wanted, most, value, sign = (
        ("costs", "small", "smallest", f"{x}^⊤ {P}_t {x}", "positive")
        if in_costs
        else ("rewards", "large", "largest", f"V_t({x}) = {x}^⊤ {P}_t {x}", "negative")
    )
    from_there = "" if given.gamma == 1 else ", discounted to time $t$"
    return (
        *costs(given, given.notation),
        Paragraph(
            f"The sum of all {what} is to be as {wanted} as possible. ${value}$ is the {most} sum from time $t$ "
            f"on{from_there}, so ${P}_t$ is {_signed(given, sign)}; the best action is ${u}_t = −{L}_t {x}_t$."
        ),
    )


def _signed(given: Given, sign: str) -> str:
    if len(given.start) == given.actions == 1:
        return f"not {'positive' if sign == 'negative' else 'negative'}"
    return f"{sign} semidefinite"
