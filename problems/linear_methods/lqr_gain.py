"""The LQR gain at one time from the value matrix of the next."""

from fractions import Fraction
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Equation, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import dot, shown
from rldrill.problems.family import Question
from rldrill.problems.linear_quadratic import Conventional, quadratic
from rldrill.problems.mathematics import mathematics
from rldrill.problems.matrices import MatrixField, check_shape, check_symmetric, is_positive, tabular
from rldrill.problems.parts import Matrix as MatrixKind
from rldrill.problems.parts import Part

TITLE = "LQR gain"
SOURCE = "Bertsekas 2017, section 3.1"
REVISION = 1


class Given(Conventional):
    """A (n×n), B (n×m), R (m×m) and P of the next time (n×n), each a list of rows.

    P is the value's matrix, negative; or in a convention of costs the cost-to-go's, positive.
    """

    A: MatrixField = Field(description="How the state moves by itself, n×n.")
    B: MatrixField = Field(description="How the action moves the state, n×m.")
    R: MatrixField = Field(description="The cost of actions, m×m.")
    P: MatrixField = Field(description="The matrix of the value at the next time, n×n.")
    N: MatrixField | None = Field(
        default=None, description="The cross term: the cost has 2 sᵀNa, too; none if left out.", examples=[[["1/2"]]]
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        n, m = len(self.A), len(self.B[0])
        for name, matrix, rows, columns in (
            ("A", self.A, n, n), ("B", self.B, n, m), ("R", self.R, m, m), ("P", self.P, n, n),
            *((("N", self.N, n, m),) if self.N else ()),
        ):  # fmt: skip
            check_shape(name, matrix, rows, columns, f"with A {n}×{n} and {m} inputs ")
        for name, matrix in (("R", self.R), ("P", self.P)):
            check_symmetric(name, matrix)
        inputs = tuple(zip(*self.B, strict=True))
        factor = self.gamma if self.notation.costs else -self.gamma
        curved = tuple(
            tuple(
                self.R[i][j] + factor * dot(first, (dot(line, then) for line in self.P))
                for j, then in enumerate(inputs)
            )
            for i, first in enumerate(inputs)
        )
        if not is_positive(curved):
            what = f"R {'+' if factor > 0 else '−'} {'' if self.gamma == 1 else 'γ'}Bᵀ{self.notation.value}B"
            raise ValueError(f"{what} is not positive definite, so no action is the best; change R, B or P")
        return self


def draw(level: int, rng: Draws) -> Given:
    """Scalars; then two states and one input; then two states and two inputs."""
    if level == 1:
        a, b, r, p = rng.whole(1, 4), rng.whole(1, 3), rng.whole(1, 4), -rng.whole(1, 5)
        return Given(A=((a,),), B=((b,),), R=((r,),), P=((p,),))
    inputs = level - 1
    A = tuple(tuple(rng.whole(-1, 2) for _ in range(2)) for _ in range(2))
    # An input without effect would make no question: no column of B is zero.
    columns = tuple(rng.choice(((1, 0), (0, 1), (1, 1), (2, 1))) for _ in range(inputs))
    B = tuple(tuple(Fraction(column[line]) for column in columns) for line in range(2))
    R = tuple(tuple(rng.whole(1, 3) if i == j else Fraction(0) for j in range(inputs)) for i in range(inputs))
    corner = rng.whole(0, 1)
    P = ((-rng.whole(2, 4), corner), (corner, -rng.whole(2, 4)))
    return Given(A=A, B=B, R=R, P=P)


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
    discount = "" if given.gamma == 1 else f" It counts $γ$ times, with the discount $γ = {shown(given.gamma)}$."
    blocks = (
        Paragraph(
            f"A linear system ${x}_{{t+1}} = A_t {x}_t + B_t {u}_t$ {earns}. {what} from the next time on is "
            f"{value}.{discount} At $t = 0$:"
        ),
        *(Equation(mathematics(name), (tabular(lines),), ("=",)) for name, lines in named),
    )
    rows, columns = len(given.B[0]), len(given.A)
    ask = f"What is the gain ${L}_0$ of the optimal action ${u}_0 = −{L}_0 {x}_0$?"
    return Question(blocks, (Part(ask, MatrixKind(rows, columns)),))
