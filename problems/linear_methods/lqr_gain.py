"""The LQR gain at one time from the value matrix of the next."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Equation, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, dot, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.linear_quadratic import Conventional, quadratic, single_gain
from rldrill.problems.mathematics import mathematics
from rldrill.problems.matrices import (
    MatrixField,
    NumberRows,
    OpenMatrixField,
    check_shape,
    check_sign,
    check_symmetric,
    is_positive,
    tabular,
)
from rldrill.problems.parts import Matrix, Number, Part
from rldrill.problems.phrases import in_open

TITLE = "LQR gain"
SOURCE = "Bertsekas 2017, section 3.1"
REVISION = 5


class Given(Conventional):
    """A (n×n), B (n×m), R (m×m) and P of the next time (n×n), each a list of rows.

    P is the value's matrix, negative; or in a convention of costs the cost-to-go's, positive. With ``start`` the action
    of a state is asked for, too; with ``action``, which is that action, the price of the action is left open in R and
    found from it.
    """

    FOUND_BY = "action"

    A: MatrixField = Field(description="How the state moves by itself, n×n.")
    B: MatrixField = Field(description="How the action moves the state, n×m.")
    R: OpenMatrixField = Field(description="The cost of actions, m×m.")
    P: MatrixField = Field(description="The matrix of the value at the next time, n×n.")
    N: MatrixField | None = Field(
        default=None, description="The cross term: the cost has 2 sᵀNa, too; none if left out.", examples=[[["1/2"]]]
    )

    start: tuple[Exact, ...] | None = Field(
        max_length=6, default=None, description="A state whose best action is asked for, too.", examples=[[1, -2]]
    )
    action: Exact | None = Field(
        default=None,
        description="The best action in the start, from which the price rho that R leaves open is found.",
        examples=["-3/2"],
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        n, m = len(self.A), len(self.B[0])
        for name, matrix, rows, columns in (
            ("A", self.A, n, n), ("B", self.B, n, m), ("R", self.R, m, m), ("P", self.P, n, n),
            *((("N", self.N, n, m),) if self.N else ()),
        ):  # fmt: skip
            check_shape(name, matrix, rows, columns, f"with A {n}×{n} and {m} inputs ")
        if self.start is not None and len(self.start) != n:
            raise ValueError(f"start has {len(self.start)} entries, but the state {n}; give as many")
        if self.left_open and m > 1:
            raise ValueError("R: a price can only be left open where there is one action")
        if self.action is not None and (self.start is None or not self.left_open):
            raise ValueError("action: it goes with a start, and with a price that R leaves open, such as rho")
        check_symmetric("P", self.P)
        check_sign("P", self.P, costs=self.notation.costs)
        if self.left_open:
            return self
        check_symmetric("R", self.R)
        prices = [[entry for entry in line if isinstance(entry, Fraction)] for line in self.R]
        inputs = tuple(zip(*self.B, strict=True))
        factor = self.gamma if self.notation.costs else -self.gamma
        curved = tuple(
            tuple(
                prices[i][j] + factor * dot(first, (dot(line, then) for line in self.P))
                for j, then in enumerate(inputs)
            )
            for i, first in enumerate(inputs)
        )
        if not is_positive(curved):
            what = f"R {'+' if factor > 0 else '−'} {'' if self.gamma == 1 else 'γ'}Bᵀ{self.notation.value}B"
            raise ValueError(f"{what} is not positive definite, so no action is the best; change R, B or P")
        return self


def draw(level: int, rng: Draws) -> Given:
    """Scalars; then two states and one action, with a discount or a state; then the price left open, or two actions."""
    if level == 1:
        b, p = rng.whole(1, 2), -rng.whole(1, 4)
        a, *others = rng.shuffled([number for number in map(Fraction, (1, 2, 3, 4)) if number != b])
        r = next(number for number in others if number != -p)  # or one could be taken for the other
        return Given(A=((a,),), B=((b,),), R=((r,),), P=((p,),))
    kind = rng.choice(("plain", "start", "discount", "both") if level == 2 else ("open", "found", "found", "two"))
    inputs = 2 if kind == "two" else 1
    A = rng.choice(_SYSTEMS)
    columns = rng.sample(_INPUTS, inputs)
    B = tuple(tuple(Fraction(column[line]) for column in columns) for line in range(2))
    R = tuple(tuple(rng.whole(1, 3) if i == j else Fraction(0) for j in range(inputs)) for i in range(inputs))
    corner = rng.whole(0, 1)
    first, second = -rng.whole(2, 4), -rng.whole(2, 4)
    if any(b * first + c * corner == 0 or b * corner + c * second == 0 for b, c in columns):
        corner = Fraction(0)  # a row of A would play no part
    P = ((first, corner), (corner, second))
    discounted = kind in ("discount", "both") or (kind in ("open", "found") and rng.chance(Fraction(1, 3)))
    gamma = rng.fraction("1/2", "1/3", "2/3") if discounted else Fraction(1)
    start = tuple(rng.nonzero(-2, 3) for _ in range(2)) if kind in ("start", "both", "found") else None
    if inputs == 1 and not all(single_gain(A, B, Fraction(1), P)):
        return draw(level, rng)  # an entry of the start would play no part
    if kind == "found" and start is not None:
        price = rng.whole(1, 3)
        action = -dot(single_gain(A, B, price / gamma, P), start)
        return Given(A=A, B=B, R=((_OPEN,),), P=P, gamma=gamma, start=start, action=action)
    return Given(A=A, B=B, R=((_OPEN,),) if kind == "open" else R, P=P, gamma=gamma, start=start)


_OPEN = Parameter("rho")
#: Systems and inputs in which every entry of the value's matrix counts.
_SYSTEMS: tuple[NumberRows, ...] = tuple(
    tuple(tuple(map(Fraction, line)) for line in rows)
    for rows in (
        ((1, 1), (0, 1)), ((0, 1), (1, 1)), ((1, 1), (-1, 1)), ((1, 0), (1, 1)), ((2, 1), (0, 1)), ((0, 1), (-1, 2)),
        ((1, -1), (1, 0)), ((2, 1), (1, 1)), ((1, 2), (1, 1)),
    )
)  # fmt: skip
_INPUTS = ((1, 1), (2, 1), (1, 2), (1, -1))


def _open(given: Given) -> str:
    return " The price $ρ > 0$ of the action is left open." if given.left_open and given.action is None else ""


def _aside(given: Given) -> str:
    """What is said of matrices that are numbers, and of the one that plays no part."""
    costs = "The state's own cost, with $Q_t$, is not needed here. "
    return costs + ("States and actions are numbers. " if len(given.A) == len(given.B[0]) == 1 else "")


def question(given: Given) -> Question:
    """The four matrices; the gain is asked for."""
    x, u, L, P, in_costs = given.notation
    named = (
        ("A_0", given.A), ("B_0", given.B), ("R_0", given.R), *((("N_0", given.N),) if given.N else ()),
        (f"{P}_1", given.P),
    )  # fmt: skip
    cost = quadratic(given.notation, "_t", crossed=given.N is not None)
    earns = f"costs ${cost}$" if in_costs else f"earns the reward $r({x}_t, {u}_t) = −({cost})$"
    value = f"${x}^⊤ {P}_{{t+1}} {x}$" if in_costs else f"$V_{{t+1}}({x}) = {x}^⊤ {P}_{{t+1}} {x}$"
    what = "The cost-to-go" if in_costs else "The value"
    discount = "" if given.gamma == 1 else f" It is discounted by $γ = {shown(given.gamma)}$."
    blocks = (
        Paragraph(
            f"A linear system ${x}_{{t+1}} = A_t {x}_t + B_t {u}_t$ {earns}. "
            f"{_aside(given)}{what} from the next time on is {value}.{discount}{_open(given)} At $t = 0$:"
        ),
        *(Equation(mathematics(name), (tabular(lines),), ("=",), linear=True) for name, lines in named),
    )
    m, n = len(given.B[0]), len(given.A)
    opened = in_open(given)
    gain = Part(f"What is the gain ${L}_0$ of the optimal action ${u}_0 = −{L}_0 {x}_0${opened}?", Matrix(m, n))
    if given.start is None:
        return Question(blocks, (gain,))
    here = f"${x}_0 = ({', '.join(map(shown, given.start))})^⊤$" if n > 1 else f"${x}_0 = {shown(given.start[0])}$"
    if given.action is not None:
        told = (
            f"The price $ρ$ of the action is unknown. The optimal action in {here} is ${u}_0 = {shown(given.action)}$."
        )
        return Question(blocks, (Part(f"{told} What is $ρ$?", Number()), gain))
    action = Part(f"What is the optimal action ${u}_0$ in {here}{in_open(given)}?", Matrix(m, 1), zero=True)
    return Question(blocks, (gain, action))
