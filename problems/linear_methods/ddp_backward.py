"""One backward step of differential dynamic programming: the quadratic Q, and the change of the action."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Beside, Equation, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact
from rldrill.problems.expressions import Expression, letters
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.mathematics import mathematics
from rldrill.problems.matrices import MatrixField, check_shape, check_symmetric, tabular
from rldrill.problems.parts import Matrix, Part
from rldrill.problems.robots import System, draw_system, plan

TITLE = "Backward step of DDP"
SOURCE = "Tassa, Erez & Todorov 2012"
REVISION = 3


class Given(System):
    """A system of which the dynamics give the next state, its reward, and the value of the next state.

    ``gradient`` and ``hessian`` are the next value's at the next state. With ``second_order`` the second
    derivatives of the dynamics count (DDP), without they do not (iLQR).
    """

    reward: Expression = Field(description="The reward, in the letters of the state and the action.")
    gradient: tuple[Exact, ...] = Field(
        min_length=1, max_length=6, description="The gradient of the next value at the next state."
    )
    hessian: MatrixField = Field(description="The Hessian of the next value at the next state.")
    second_order: bool = Field(
        default=True, description="Whether the second derivatives of the dynamics count (DDP) or not (iLQR)."
    )

    @model_validator(mode="after")
    def _next(self) -> Self:
        if self.step is not None or self.where:
            raise ValueError("the dynamics give the next state itself here; leave out 'step' and 'where'")
        known = {*self.state, *self.action, *self.constants}
        if unknown := [name for name in letters(self.reward) if name not in known]:
            raise ValueError(f"the reward holds {unknown[0]!r}, which has no value")
        n = len(self.state)
        if len(self.gradient) != n:
            raise ValueError(f"gradient has {len(self.gradient)} entries, but the state {n}")
        check_shape("hessian", self.hessian, n, n, f"with {n} states ")
        check_symmetric("hessian", self.hessian)
        return self


def draw(level: int, rng: Draws) -> Given:
    """iLQR with numbers; then DDP or iLQR of what is more curved; then with two states."""
    system = draw_system(rng, "ddp", level)
    n = len(system["state"])
    steepest = 3 if level < 3 else 5
    hessian = tuple(tuple(-rng.whole(1, steepest) if i == j else Fraction(0) for j in range(n)) for i in range(n))
    gradient = tuple(rng.nonzero(-steepest, steepest) for _ in range(n))
    return Given(**system, gradient=gradient, hessian=hessian, second_order=level > 1 and rng.chance(Fraction(3, 4)))


def question(given: Given) -> Question:
    """The system and the next value; all derivatives of Q, then k and K."""
    n, m = len(given.state), len(given.action)
    kept = (
        "in a step of DDP: the second derivatives of $f$ count"
        if given.second_order
        else "in a step of iLQR: the second derivatives of $f$ are left out"
    )
    gradient, hessian = ("derivative", "second derivative") if n == 1 else ("gradient", "Hessian")
    first, then = ("derivative", "second derivative") if n == m == 1 else ("gradient", "matrix")
    wanted = (
        ("Q_s", first, n, 1), ("Q_a", first, m, 1), ("Q_{s s}", then, n, n), ("Q_{a s}", then, m, n),
        ("Q_{a a}", then, m, m), ("k", "constant change of the action", m, 1), ("K", "gain", m, n),
    )  # fmt: skip
    known = f"At $f(s̄, ā)$ the value $V′$ of the next state has this {gradient} and this {hessian}:"
    return Question(
        (
            *plan(given, given.reward, known),
            Beside(
                (
                    Equation(mathematics("V′_s"), (tabular(tuple((entry,) for entry in given.gradient)),), ("=",)),
                    Equation(mathematics("V′_{s s}"), (tabular(given.hessian),), ("=",)),
                )
            ),
            Paragraph(
                f"$Q(s, a) = r(s, a) + V′(f(s, a))$ is expanded to second order around the operating point, {kept}. "
                "The best action is then $a = ā + k + K (s − s̄)$."
            ),
        ),
        tuple(
            Part(f"What is the {what} ${head}$?", Matrix(rows, columns), zero=True)
            for head, what, rows, columns in wanted
        ),
    )
