"""The stationary value matrix, gain and closed loop of LQR over an infinite horizon."""

from collections.abc import Iterator, Sequence
from functools import cache
from itertools import product
from math import isqrt
from typing import Any, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Equation, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, Scalar, shown
from rldrill.problems.family import AskedFor, Question
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.linear_quadratic import Conventional, check_cross, quadratic
from rldrill.problems.mathematics import mathematics
from rldrill.problems.matrices import (
    MatrixField,
    OpenMatrixField,
    Rows,
    check_shape,
    check_weights,
    diagonal,
    tabular,
)
from rldrill.problems.parts import Matrix, Number, Part

TITLE = "LQR over an infinite horizon"
SOURCE = "Bertsekas 2017, section 3.1"
REVISION = 9
_LARGEST = 6


class Given(AskedFor, Conventional):
    """A (n×n), B (n×m), Q (n×n) and R (m×m), the same at all times; n is at most 6.

    Closed forms are found for a scalar system and for one that falls apart into scalar ones; others are
    solved in rational arithmetic to twelve decimals. With ``closed_loop`` the system is scalar, and the price that Q or
    R leaves open is found for which the best actions lead to this closed loop.
    """

    A: MatrixField = Field(description="How the state moves by itself, n×n, n at most 6.")
    B: MatrixField = Field(description="How the action moves the state, n×m.")
    Q: OpenMatrixField = Field(description="The cost of states, n×n.")
    R: OpenMatrixField = Field(description="The cost of actions, m×m.")
    N: MatrixField | None = Field(
        default=None, description="The cross term: the cost has 2 sᵀNa, too; none if left out.", examples=[[["1/2"]]]
    )

    closed_loop: Exact | None = Field(
        default=None,
        description="A − BL of a scalar system, from which the price is found that Q or R leaves open as rho.",
        examples=["1/2"],
    )

    @property
    def unknown(self) -> str:
        """Which of Q and R is left open; neither, where that is empty."""
        return "".join(name for name, matrix in (("Q", self.Q), ("R", self.R)) if isinstance(matrix[0][0], Parameter))

    @model_validator(mode="after")
    def _fits(self) -> Self:
        n, m = len(self.A), len(self.B[0])
        if n > _LARGEST:
            raise ValueError(f"A has {n} rows; {_LARGEST} are the most")
        where = f"with A {n}×{n} and {m} actions "
        for name, matrix, rows, columns in (
            ("A", self.A, n, n), ("B", self.B, n, m), ("Q", self.Q, n, n), ("R", self.R, m, m),
            *((("N", self.N, n, m),) if self.N else ()),
        ):  # fmt: skip
            check_shape(name, matrix, rows, columns, where)
        check_weights("Q", self.Q, positive=False)
        check_weights("R", self.R, positive=False)
        open_ = [each for matrix in (self.Q, self.R) for line in matrix for each in line if isinstance(each, Parameter)]
        if self.closed_loop is None and open_:
            raise ValueError("Q and R: a price may be left open only with a closed_loop from which it is found")
        if self.closed_loop is not None:
            if open_ != [_OPEN] or n > 1 or m > 1 or self.N or not self.B[0][0]:
                raise ValueError("closed_loop: it goes with a scalar system without N, in which Q or R is rho, B not 0")
            if abs(self.closed_loop) >= 1 or not self.closed_loop:
                raise ValueError("closed_loop must be between -1 and 1, and not 0")
        if self.N:
            check_cross(self.Q, self.R, self.N)
        return self


_OPEN = Parameter("rho")


def draw(level: int, rng: Draws) -> Given:
    """A scalar system; a discount, a cross term or two states; two coupled robots, or a price to find.

    They are such that the root in P comes out.
    """
    if level == 1:
        return _scalar(*rng.choice(_scalars()))
    if level == 2:
        kind = rng.choice(("discount", "cross", "two"))
        if kind == "two":
            gamma = rng.fraction("1", "1/2", "3/4")
            systems = _scalars() if gamma == 1 else [each[:4] for each in _discounted() if each[4] == gamma]
            first, second = (rng.choice(systems) for _ in range(2))
            A, B, Q, R = (diagonal(*pair) for pair in zip(first, second, strict=True))
            return Given(A=A, B=B, Q=Q, R=R, gamma=gamma)
        a, b, q, r, added = rng.choice(_discounted() if kind == "discount" else _crossed())
        if kind == "discount":
            return _scalar(a, b, q, r, gamma=added)
        return _scalar(a, b, q, r, N=((added,),))
    if rng.chance(Fraction(1, 3)):
        (total, b, together, r), (difference, _, apart, _) = (map(Fraction, mode) for mode in rng.choice(_pairs()))
        return Given(A=_circulant(total, difference), B=diagonal(b, b), Q=_circulant(together, apart), R=diagonal(r, r))
    return _price(rng)


def _scalar(a: Scalar, b: Scalar, q: Scalar, r: Scalar, **more: Any) -> Given:
    return Given(A=((a,),), B=((b,),), Q=((q,),), R=((r,),), **more)


def _price(rng: Draws) -> Given:
    """A closed loop c that is best for a price of states or of actions: P = −L r/(γ b c), and q = P (γ a c − 1)."""
    while True:
        sign = rng.choice((1, -1))
        a, c = (sign * fraction_of(text) for text in rng.choice(_LOOPS))
        b = rng.choice([b for b in map(Fraction, (1, 2)) if b != a])
        gamma = rng.fraction("1", "1", "1/2", "2/3")
        r = rng.whole(1, 6)
        q = r * (a - c) * (1 - gamma * a * c) / (gamma * b**2 * c)
        if rng.chance(Fraction(1, 2)):
            value = abs(r * (a - c) / (gamma * b**2 * c))
            if max(q, value) <= _LARGEST_PRICE:
                return _scalar(a, b, _OPEN, r, gamma=gamma, closed_loop=c)
            continue
        if q.numerator * r < 100 and q.denominator * r < 50:
            return _scalar(a, b, Fraction(q.numerator), _OPEN, gamma=gamma, closed_loop=c)


#: The largest price that is found, and the largest number that P is on the way to it.
_LARGEST_PRICE = 100
#: Systems A that are to be brought to the closed loop beside them.
_LOOPS = (
    ("2", "1/4"), ("2", "1/3"), ("3", "1/4"), ("3", "1/5"), ("3/2", "1/2"), ("1", "1/2"), ("1", "1/3"), ("1", "1/4"),
    ("4", "1/5"), ("3/2", "1/3"), ("4", "1/6"), ("1", "2/3"),
)  # fmt: skip


def _numbers() -> Iterator[tuple[int, int, int, int]]:
    """Whole numbers A, B, Q and R; with A = B or Q = R nobody would see that they were mixed up."""
    return (
        (a, b, q, r)
        for a, b, q, r in product((-3, -2, -1, 1, 2, 3), (1, 2), range(1, 11), range(1, 9))
        if a != b and q != r
    )


@cache
def _scalars() -> tuple[tuple[Fraction, ...], ...]:
    """Whole numbers A, B, Q, R of scalar systems in which the root comes out."""
    return tuple(
        (Fraction(a), Fraction(b), Fraction(q), Fraction(r))
        for a, b, q, r in _numbers()
        if _is_square(Fraction((b**2 * q + (a**2 - 1) * r) ** 2 + 4 * b**2 * q * r))
    )


@cache
def _discounted() -> tuple[tuple[Fraction, ...], ...]:
    """Scalar systems with a discount in which the root comes out."""
    return tuple(
        (Fraction(a), Fraction(b), Fraction(q), Fraction(r), gamma)
        for a, b, q, r in _numbers()
        for gamma in (Fraction(1, 2), Fraction(1, 4), Fraction(3, 4), Fraction(2, 3))
        if _is_square((gamma * b**2 * q + (gamma * a**2 - 1) * r) ** 2 + 4 * gamma * b**2 * q * r)
    )


@cache
def _crossed() -> tuple[tuple[Fraction, ...], ...]:
    """Scalar systems with a cross term in which the root comes out.

    With RA = BN the best action brings every state to 0 at once, and Riccati's equation has nothing to solve.
    """
    return tuple(
        (Fraction(a), Fraction(b), Fraction(q), Fraction(r), Fraction(n))
        for a, b, q, r in _numbers()
        for n in (-3, -2, -1, 1, 2, 3)
        if q * r > n**2
        and r * a != b * n
        and _is_square(Fraction(b**2 * q + (a**2 - 1) * r - 2 * a * b * n) ** 2 + 4 * b**2 * (q * r - n**2))
    )


def _is_square(number: Fraction) -> bool:
    return all(isqrt(whole) ** 2 == whole for whole in (number.numerator, number.denominator))


@cache
def _pairs() -> tuple[tuple[tuple[int, ...], tuple[int, ...]], ...]:
    """A, B, Q and R of the sum and of the difference of two coupled states: systems in which the root comes out."""
    modes = [
        (a, b, q, r)
        for a, b, q, r in product((-3, -2, -1, 1, 2, 3), (1, 2), range(1, 31), range(1, 16))
        if _is_square(Fraction((b**2 * q + (a**2 - 1) * r) ** 2 + 4 * b**2 * q * r))
    ]
    return tuple(
        (first, second)
        for first, second in product(modes, modes)
        if first[1::2] == second[1::2]
        and first[0] != second[0]
        and (abs(first[0]), first[2]) != (abs(second[0]), second[2])
        and (first[0] - second[0]) % 2 == (first[2] - second[2]) % 2 == 0
    )


def _circulant(total: Fraction, difference: Fraction) -> Rows:
    """Two equal halves that act on each other alike, by what their sum and their difference are multiplied with."""
    diagonal_, beside = (total + difference) / 2, (total - difference) / 2
    return ((diagonal_, beside), (beside, diagonal_))


def _is_symmetric(matrix: Sequence[Sequence[Scalar]]) -> bool:
    """Whether two robots can be exchanged in a matrix: it has the form [a b; b a]."""
    return len(matrix) == 2 and matrix[0] == matrix[1][::-1]


def question(given: Given) -> Question:
    """The matrices; P, the gain, and the closed loop."""
    n = len(given.A)
    x, u, *_, in_costs = given.notation
    named = (("A", given.A), ("B", given.B), ("Q", given.Q), ("R", given.R), *((("N", given.N),) if given.N else ()))
    matrices = (given.A, given.B, given.Q, given.R, *((given.N,) if given.N else ()))
    coupled = n == 2 and given.A[0][1] != 0 and all(map(_is_symmetric, matrices))
    story = "Two identical robots that are coupled symmetrically form a system. It" if coupled else "A system"
    cost = quadratic(given.notation, crossed=given.N is not None)
    earns = f"costs ${cost}$" if in_costs else f"earns the reward $r({x}_t, {u}_t) = −({cost})$"
    discount = " or discount:" if given.gamma == 1 else (
        f"; the {'cost' if in_costs else 'reward'} at time $t$ is discounted by $γ^t$, with "
        f"$γ = {shown(given.gamma)}$:"
    )  # fmt: skip
    return Question(
        (
            Paragraph(
                f"{story} has the dynamics ${x}_{{t+1}} = A {x}_t + B {u}_t$ and {earns} at every time "
                f"$t = 0, 1, 2, …$ without end{discount}"
            ),
            *(Equation(mathematics(name), (tabular(matrix),), ("=",), linear=True) for name, matrix in named),
            Paragraph(_wanted(given)),
            *(
                (Paragraph("The sum and the difference of the two states are two systems that are not coupled."),)
                if coupled
                else ()
            ),
        ),
        tuple(_parts(given)),
    )


def _parts(given: Given) -> Iterator[Part]:
    n, m = len(given.A), len(given.B[0])
    _, _, L, P, _ = given.notation
    if given.closed_loop is not None:
        of = "states" if given.unknown == "Q" else "actions"
        loop = f"under the best actions the closed loop is $A − B {L} = {shown(given.closed_loop)}$"
        yield Part(f"The price $ρ$ is unknown, but {loop}. What is ${P}$?", Number())
        yield Part(f"What is the price $ρ$ of the {of}?", Number())
        return
    yield Part(f"What is ${P}$?", Matrix(n, n))
    yield Part(f"What is the gain ${L}$?", Matrix(m, n))
    what = "the closed loop" if n == 1 else "the matrix of the closed loop,"
    yield Part(f"What is {what} $A − B {L}$?", Matrix(n, n), zero=True)


def _wanted(given: Given) -> str:
    """What the matrix and the gain are those of."""
    x, u, L, P, in_costs = given.notation
    to_zero = "the state" if given.gamma == 1 else f"the discounted state $γ^{{t/2}} {x}_t$"
    if in_costs:
        sum_ = f"the smallest sum of all costs from the state ${x}$ on is ${x}^⊤ {P} {x}$"
    else:
        sum_ = f"the largest sum of all rewards from the state ${x}$ on is $V({x}) = {x}^⊤ {P} {x}$"
    numbers = "States and actions are numbers. " if len(given.A) == len(given.B[0]) == 1 else ""
    return (
        f"{numbers}Among all policies under which {to_zero} goes to $0$, {sum_}; the best action is ${u} = −{L} {x}$."
    )
