"""Linear systems of problems as formulas need them."""

from collections.abc import Callable, Mapping
from typing import Any

from rldrill.problems.fractions import Fraction
from rldrill.problems.linear_quadratic import LinearQuadratic, by_time
from rldrill.problems.matrices import Rows
from rldrill.solutions import matrices
from rldrill.solutions.exact import ZERO, Value, exact, to_sympy
from rldrill.solutions.formula.finding import with_number
from rldrill.solutions.formula.formula import Misconception, slip
from rldrill.solutions.formula.putting_in import indexed
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import at
from rldrill.solutions.rational import with_found
from rldrill.solutions.sheet.linear_methods import Quadratic
from rldrill.solutions.slips import right_answers
from rldrill.solutions.work import Equality, Work


def known(given: LinearQuadratic) -> dict[str, Any]:
    """The matrices of all times by the formulas' letters."""
    last = given.horizon
    by_name = {
        "A": (given.A, last), "B": (given.B, last), "Q": (given.state_costs, last + 1), "R": (given.R, last + 1),
        "N": (given.N or (), last if given.N else 0),
    }  # fmt: skip
    converted: dict[Rows, Any] = {}
    result: dict[str, Any] = {"gamma": exact(given.gamma)}
    for name, (series, end) in by_name.items():
        result[f"{name}t"] = {
            time: converted.setdefault(by_time(series, time), matrices.given(by_time(series, time)))
            for time in range(end)
        }
    return result


def gain(work: Work, lqr: Quadratic, **known: Any) -> Any:
    """The gain of a time; of matrices the one that is inverted and the one behind it come first."""
    t = known["t"]
    if known["Bt"][t].nrows() == known["Bt"][t].ncols() == 1 or work.misreads(lqr.gain):
        return work.step(lqr.gain, **known)
    work.recall(lqr.gain)
    work.reading(lqr.gain)
    H, G = work.step(lqr.bracket, **known), work.step(lqr.product, **known)
    return work.step(lqr.solved, Ht={t: H}, Gt={t: G}, **known)


def with_price(work: Work, lqr: Quadratic, gain: matrices.AnyMatrix, price: Value) -> matrices.AnyMatrix:
    """The gain of the time 0 with the price put in that was found."""
    work.say(f"With $ρ = {to_sympy(price)}$ the gain is:")
    priced = matrices.matrix([with_found(entry, price) for entry in line] for line in gain.tolist())
    put_in = with_number(gain.tolist(), "rho", price)
    work.lines.append(Equality(indexed(lqr.gain.left, {"t": 0}), (put_in, priced)))
    return priced


def start(given: LinearQuadratic) -> matrices.AnyMatrix:
    """The first state, a column."""
    return matrices.column(map(exact, given.start))


def number(value: Any) -> Value:
    """A 1×1 matrix as a number; 0, where nothing stands in its place."""
    return value[0, 0] if matrices.is_matrix(value) else ZERO + value


def cost_to_go(solve: Callable[[Any, Work], None], values: Callable[[Any], slice]) -> Misconception:
    """The mistake of giving the matrix of the cost-to-go, made in those answers of a solver that are a value's."""

    @slip(
        "cost-to-go-given",
        "That is S of the cost-to-go sᵀSs; the value is sᵀPs with P = −S.",
        when=lambda given: given.convention == "value",
    )
    def in_costs(given: Any, work: Work) -> None:
        answers = right_answers(solve, given, work)
        which = values(given)
        answers[which] = [-P for P in answers[which]]
        for answer in answers:
            work.answer(answer)

    return in_costs


def array(rows: Rows) -> Array:
    """A given matrix in floating point."""
    return np.array([[at(entry) for entry in line] for line in rows], dtype=float)


def arrays(given: LinearQuadratic, time: int) -> Mapping[str, Array]:
    """The matrices of one time in floating point; A, B and N of the last time are those of the time before."""
    zero = ((Fraction(0),) * given.actions,) * len(given.start)
    by_name = {"A": given.A, "B": given.B, "Q": given.state_costs, "R": given.R, "N": given.N or (zero,)}
    return {name: array(by_time(series, min(time, len(series) - 1))) for name, series in by_name.items()}
