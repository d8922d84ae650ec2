"""The stationary value matrix, gain and closed loop of LQR over an infinite horizon."""

from fractions import Fraction
from functools import cache
from itertools import product
from math import isqrt
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Equation, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import shown
from rldrill.problems.family import Question
from rldrill.problems.linear_quadratic import Conventional, check_cross, quadratic
from rldrill.problems.mathematics import mathematics
from rldrill.problems.matrices import MatrixField, Rows, check_shape, check_weights, diagonal, tabular
from rldrill.problems.parts import Matrix, Part

TITLE = "LQR over an infinite horizon"
SOURCE = "Bertsekas 2017, section 3.1"
REVISION = 1
_LARGEST = 6
_LARGEST_ROOT = 40


class Given(Conventional):
    """A (n×n), B (n×m), Q (n×n) and R (m×m), the same at all times; n is at most 6.

    Closed forms are found for a scalar system and for one that falls apart into scalar ones; others are
    solved in rational arithmetic to twelve decimals.
    """

    A: MatrixField = Field(description="How the state moves by itself, n×n, n at most 6.")
    B: MatrixField = Field(description="How the action moves the state, n×m.")
    Q: MatrixField = Field(description="The cost of states, n×n.")
    R: MatrixField = Field(description="The cost of actions, m×m.")
    N: MatrixField | None = Field(
        default=None, description="The cross term: the cost has 2 sᵀNa, too; none if left out.", examples=[[["1/2"]]]
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        n, m = len(self.A), len(self.B[0]) if self.B else 0
        if not 1 <= n <= _LARGEST:
            raise ValueError(f"A has {n} rows; {_LARGEST} are the most")
        where = f"with A {n}×{n} and {m} actions "
        for name, matrix, rows, columns in (
            ("A", self.A, n, n), ("B", self.B, n, m), ("Q", self.Q, n, n), ("R", self.R, m, m),
            *((("N", self.N, n, m),) if self.N else ()),
        ):  # fmt: skip
            check_shape(name, matrix, rows, columns, where)
        check_weights("Q", self.Q, positive=False)
        check_weights("R", self.R, positive=False)
        if self.N:
            check_cross(self.Q, self.R, self.N)
        return self


def draw(level: int, rng: Draws) -> Given:
    """Numbers with a rational P; then with a root; then two equal robots that act on each other."""
    if level < 3:
        a, b, q, r = map(Fraction, rng.choice(_scalars(rational=level == 1)))
        return Given(A=((a,),), B=((b,),), Q=((q,),), R=((r,),))
    total, difference, b, q, r = map(Fraction, rng.choice(_pairs()))
    A = _circulant((total + difference) / 2, (total - difference) / 2)
    return Given(A=A, B=diagonal(b, b), Q=diagonal(q, q), R=diagonal(r, r))


@cache
def _scalars(*, rational: bool) -> tuple[tuple[int, int, int, int], ...]:
    """Whole numbers A, B, Q, R of scalar systems; with ``rational``, those in which the root comes out."""
    found = []
    for a, b, q, r in product((-3, -2, -1, 1, 2, 3), (1, 2), range(1, 9), range(1, 7)):
        under = _under_root(a, b, q, r)
        if under == 1 if rational else 1 < under < _LARGEST_ROOT:
            found.append((a, b, q, r))
    return tuple(found)


@cache
def _pairs() -> tuple[tuple[int, int, int, int, int], ...]:
    """How sum and difference of two coupled states are multiplied, then B, Q, R: one root at most stays."""
    found = []
    for (a, b, q, r), other in product(_scalars(rational=True), range(-3, 4)):
        if other and abs(other) != abs(a) and (other - a) % 2 == 0 and _under_root(other, b, q, r) < _LARGEST_ROOT / 2:
            found += [(a, other, b, q, r), (other, a, b, q, r)]
    return tuple(found)


def _under_root(a: int, b: int, q: int, r: int) -> int:
    return _squarefree((b**2 * q + (a**2 - 1) * r) ** 2 + 4 * b**2 * q * r)


def _squarefree(number: int) -> int:
    """What stays under the root."""
    for factor in range(isqrt(number), 1, -1):
        if number % factor**2 == 0:
            return number // factor**2
    return number


def _circulant(diagonal_: Fraction, beside: Fraction) -> Rows:
    """Two equal halves that act on each other alike."""
    return ((diagonal_, beside), (beside, diagonal_))


def question(given: Given) -> Question:
    """The matrices; P, the gain, and the closed loop."""
    n, m = len(given.A), len(given.B[0])
    x, u, L, P, in_costs = given.notation
    named = (("A", given.A), ("B", given.B), ("Q", given.Q), ("R", given.R), *((("N", given.N),) if given.N else ()))
    coupled = n == 2 and _circulant(given.A[0][0], given.A[0][1]) == given.A and given.A[0][1] != 0
    story = "Two equal robots act on each other alike: their system" if coupled else "A system"
    cost = quadratic(given.notation, crossed=given.N is not None)
    earns = f"costs ${cost}$" if in_costs else f"earns the reward $r({x}_t, {u}_t) = −({cost})$"
    discount = " or discount:" if given.gamma == 1 else (
        f"; what comes at time $t$ counts $γ^t$ times, with the discount $γ = {shown(given.gamma)}$:"
    )  # fmt: skip
    return Question(
        (
            Paragraph(
                f"{story} has the dynamics ${x}_{{t+1}} = A {x}_t + B {u}_t$ and {earns} at every time "
                f"$t = 0, 1, 2, …$ without end{discount}"
            ),
            *(Equation(mathematics(name), (tabular(matrix),), ("=",)) for name, matrix in named),
            Paragraph(_wanted(given)),
            *(
                (Paragraph("Sum and difference of the two states are two systems that do not act on each other."),)
                if coupled
                else ()
            ),
        ),
        (
            Part(f"What is ${P}$?", Matrix(n, n)),
            Part(f"What is the gain ${L}$?", Matrix(m, n)),
            Part(f"What is the matrix $A − B {L}$ of the closed loop?", Matrix(n, n), zero=True),
        ),
    )


def _wanted(given: Given) -> str:
    """What the matrix and the gain are those of."""
    x, u, L, P, in_costs = given.notation
    to_zero = "The state has to go to $0$" if given.gamma == 1 else (
        f"The discounted state $γ^{{t/2}} {x}_t$ has to go to $0$"
    )  # fmt: skip
    if in_costs:
        sum_ = f"the smallest sum of all costs from the state ${x}$ on is ${x}^⊤ {P} {x}$"
    else:
        sum_ = f"the largest sum of all rewards from the state ${x}$ on is $V({x}) = {x}^⊤ {P} {x}$"
    return f"{to_zero}. Of all ways to bring it there, {sum_}; the best action is ${u} = −{L} {x}$."
