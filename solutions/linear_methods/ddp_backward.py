"""Derivatives of reward and dynamics, the quadratic Q by the chain rule, and its maximum."""

from collections.abc import Callable, Mapping
from typing import Any

from rldrill.problems.linear_methods.ddp_backward import Given
from rldrill.solutions import dynamics, matrices
from rldrill.solutions.exact import ZERO, NoSolution, Value, exact, sign
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.formula.nodes.leaves import put_in_name
from rldrill.solutions.matrices import AnyMatrix
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.linear_methods import (
    DDP,
    DDP_A,
    DDP_AA,
    DDP_AS,
    DDP_K,
    DDP_S,
    DDP_SS,
    INPUT_JACOBIAN,
    K_WITH_PLUS,
    SECOND_DERIVATIVE,
    STATE_JACOBIAN,
    DDP_k,
    ilqr,
    partial,
    partial_part,
    reward_second,
    second,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """The quadratic Q, then k and K, if it has a maximum."""
    Q = _expanded(given, work)
    if not _is_negative(Q["Q_aa"]):
        raise NoSolution("Q has no greatest value in a, since Q_aa is not negative")
    _maximum(work, Q)


def _maximum(work: Work, Q: Mapping[str, AnyMatrix]) -> None:
    work.recall(DDP)
    work.answer(work.step(DDP_k, **Q))
    work.answer(work.step(DDP_K, **Q))


def _expanded(given: Given, work: Work) -> dict[str, AnyMatrix]:
    """First derivatives, then second derivatives: of the reward, of the dynamics, and from them of Q."""
    names, actions = given.states, tuple(given.action)
    known: dict[str, Any] = {
        "V_s": matrices.column(map(exact, given.gradient)),
        "V_ss": matrices.given(given.hessian),
        "Vi": {index: exact(entry) for index, entry in enumerate(given.gradient, 1)},
    }
    values = dynamics.known(given)
    texts: dict[int | str, str] = dict(enumerate(given.dynamics.values(), 1))
    if len(texts) == 1:
        texts = {"f": texts[1]}  # no index where there is one component
    Q = {}
    work.say(
        "$f_s$ and $f_a$ are the matrices $A$ and $B$ of the linearisation; $r$ is differentiated in the same way."
    )
    for code, by, formula, gradient in (
        ("s", names, STATE_JACOBIAN, DDP_S), ("a", actions, INPUT_JACOBIAN, DDP_A),
    ):  # fmt: skip
        known[f"r_{code}"] = matrices.column(_first(work, formula, values, given.reward, "r", name) for name in by)
        known[f"f_{code}"] = matrices.matrix(
            [_first(work, formula, values, text, index, name) for name in by] for index, text in texts.items()
        )
        Q[f"Q_{code}"] = work.answer(work.step(gradient, **known))
    work.say(
        "In second derivatives $ξ$ stands for state and action together: $ξ_j$ and $ξ_k$ are any two of its entries. "
        "Those that are zero are not written down."
    )
    known["components"] = tuple(range(1, len(texts) + 1)) if given.second_order else ()
    if not given.second_order:
        work.say("iLQR leaves out the sums with the second derivatives of $f$.")
    for code, formula, rows, columns in (
        ("ss", DDP_SS, names, names),
        ("as", DDP_AS, actions, names),
        ("aa", DDP_AA, actions, actions),
    ):
        known[f"r_{code}"] = _second(work, values, given.reward, "r", rows, columns)
        known[f"fi{code}"] = {
            number: _second(work, values, text, index, rows, columns)
            for number, (index, text) in enumerate(texts.items(), 1)
            if given.second_order
        }
        Q[f"Q_{code}"] = work.answer(work.step(formula, right=None if given.second_order else ilqr(formula), **known))
    return Q


@dynamics.at_operating_point()
def _first(work: Work, formula: Any, values: Mapping[str, Value], text: str, of: int | str, name: str) -> Value:
    right = dynamics.chained(text, name, ())
    into = partial_part if isinstance(of, str) else partial
    return ZERO if right == 0 else work.step(formula, into=into, right=right, i=of, j=name, **values)


@dynamics.at_operating_point()
def _second(
    work: Work, values: Mapping[str, Value], text: str, of: int | str, rows: tuple[str, ...], columns: tuple[str, ...]
) -> AnyMatrix:
    """A Hessian; every second derivative is worked out once."""
    found: dict[frozenset[str], Value] = {}
    for first in rows:
        for then in columns:
            right = dynamics.second(text, first, then)
            if frozenset((first, then)) not in found:
                indices = {"i": of, "j": first, "g": then}
                found[frozenset((first, then))] = ZERO
                if right != 0:
                    formula = reward_second() if of == "r" else SECOND_DERIVATIVE
                    into = _second_of(of) if isinstance(of, str) else second
                    value = work.step(formula, into=into, right=right, **{**values, **indices})
                    found[frozenset((first, then))] = value
    return matrices.matrix([found[frozenset((first, then))] for then in columns] for first in rows)


def _second_of(of: str) -> Callable[..., Any]:
    """The second derivatives of something that has a name, by the last two of their indices."""
    return lambda *by: second(put_in_name(of), *by[-2:])


def _is_negative(matrix: AnyMatrix) -> bool:
    """Whether a symmetric matrix is negative definite: all pivots of its elimination are negative."""
    rows = matrix.tolist()
    for k, pivot in enumerate(rows):
        if sign(pivot[k]) >= 0:
            return False
        for line in rows[k + 1 :]:
            factor = line[k] / pivot[k]
            line[k:] = [entry - factor * above for entry, above in zip(line[k:], pivot[k:], strict=True)]
    return True


def other_method(given: Given, work: Work) -> None:
    """DDP for iLQR, iLQR for DDP; whatever Q is then, the formulas give a k and a K."""
    _maximum(work, _expanded(given.model_copy(update={"second_order": not given.second_order}), work))


ILQR_FOR_DDP = slip(
    "ilqr-for-ddp",
    "DDP keeps the second derivatives of the dynamics: V′ₛ · fₛₛ and the like belong to Q's; only iLQR drops them.",
    when=lambda given: given.second_order,
)(other_method)
DDP_FOR_ILQR = slip(
    "ddp-for-ilqr",
    "iLQR takes the dynamics as linear: their second derivatives, which DDP adds, are left out.",
    when=lambda given: not given.second_order,
)(other_method)
MISCONCEPTIONS = (ILQR_FOR_DDP, DDP_FOR_ILQR, K_WITH_PLUS)


def oracle(given: Given) -> Answers:
    """Q as a function: its gradient by complex steps, its Hessian by differences of gradients."""
    values = dynamics.numbers(given)
    names = (*given.states, *given.action)
    n = len(given.states)
    after = _next(given, values)
    home = np.real(after(values))
    slope = np.array([at(entry) for entry in given.gradient])
    curve = np.array([[at(entry) for entry in line] for line in given.hessian])

    def worth(point: Mapping[str, complex]) -> list[complex]:
        moved = np.array(after(point)) - home
        (reward,) = dynamics.numeric((("r", given.reward),), (), point)
        return [reward + slope @ moved + moved @ curve @ moved / 2]

    def gradient(point: Mapping[str, complex]) -> Array:
        return dynamics.complex_step(worth, point, names)[0]

    hessian = np.array([_difference(gradient, values, name) for name in names])
    g, aa = gradient(values), hessian[n:, n:]
    return (
        g[:n], g[n:], hessian[:n, :n], hessian[n:, :n], aa,
        -np.linalg.solve(aa, g[n:]), -np.linalg.solve(aa, hessian[n:, :n]),
    )  # fmt: skip


def _next(given: Given, values: Mapping[str, complex]) -> Callable[[Mapping[str, complex]], list[complex]]:
    """The next state; for iLQR by the tangent plane at the operating point."""
    names = (*given.states, *given.action)
    texts = dynamics.texts(given.dynamics)

    def curved(point: Mapping[str, complex]) -> list[complex]:
        return dynamics.numeric(texts, (), point)

    home, slope = np.array(curved(values)), dynamics.complex_step(curved, values, names)

    def flat(point: Mapping[str, complex]) -> list[complex]:
        return list(home + slope @ np.array([point[name] - values[name] for name in names]))

    return curved if given.second_order else flat


def _difference(function: Callable[[Mapping[str, complex]], Array], values: Mapping[str, complex], name: str) -> Array:
    """The derivative of a function by one letter, from four points beside it."""
    h = 2.0**-9
    there = {step: function({**values, name: values[name] + step * h}) for step in (-2, -1, 1, 2)}
    return (there[-2] - 8 * there[-1] + 8 * there[1] - there[2]) / (12 * h)
