"""Derivatives of reward and dynamics, the quadratic Q by the chain rule, and its maximum."""

from collections.abc import Callable, Mapping
from typing import Any

from rldrill.problems.linear_methods.ddp_backward import Given
from rldrill.solutions import dynamics, matrices
from rldrill.solutions.exact import ZERO, NoSolution, Value, exact, sign
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.formula.nodes.leaves import put_in_name
from rldrill.solutions.linearisation import written_or_zero
from rldrill.solutions.matrices import AnyMatrix
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.linear_methods import (
    DDP,
    DDP_GREATEST,
    INPUT_JACOBIAN,
    K_WITH_PLUS,
    OLD_ACTION_FORGOTTEN,
    SECOND_DERIVATIVE,
    STATE_JACOBIAN,
    Expansion,
    derivative_of,
    expansion,
    ilqr,
    partial,
    partial_part,
    reward_second,
    second,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """The quadratic Q, then k and K, if it has a maximum."""
    Q = _expanded(given, work, _second)
    if not _is_negative(Q["Q_aa"]):
        raise NoSolution("Q has no greatest value in a, since Q_aa is not negative")
    _maximum(given, work, Q)


def _maximum(given: Given, work: Work, Q: Mapping[str, AnyMatrix]) -> None:
    formulas, of = _formulas(given), "Q_{a a}"
    negative = f"${of} < 0$" if len(given.action) == 1 else f"${of}$ is negative definite"
    work.say(f"{negative}: where the derivative with respect to the action is $0$, $Q$ is greatest.")
    work.recall(DDP_GREATEST)
    work.say("Solved for $a$, with $k$ for what does not depend on $s$ and $K$ for what stands at $s − s̄$:")
    work.recall(DDP)
    k = work.answer(_applied(given, work, formulas.change, Q))
    K = work.answer(_applied(given, work, formulas.gain, Q))
    if given.reached is not None:
        s, s_bar = (
            matrices.column(dynamics.angle(state[name]) for name in given.states)
            for state in (given.reached, given.state)
        )
        a_bar = matrices.column(dynamics.angle(value) for value in given.action.values())
        work.answer(_applied(given, work, DDP, {"abar": a_bar, "kd": k, "Kd": K, "sv": s, "sbar": s_bar}))


def _is_scalar(given: Given) -> bool:
    return len(given.state) == len(given.action) == 1


def _formulas(given: Given) -> Expansion:
    return expansion(scalar=_is_scalar(given), second_order=given.second_order)


def _applied(given: Given, work: Work, formula: Formula, known: Mapping[str, Any], right: Any = None) -> AnyMatrix:
    """A formula of matrices; those of one state and one action are numbers."""
    if not _is_scalar(given):
        return work.step(formula, right=right, **known)
    numbers = {code: value[0, 0] if matrices.is_matrix(value) else value for code, value in known.items()}
    return matrices.matrix([[work.step(formula, **numbers)]])


def _expanded(given: Given, work: Work, curved: Callable[..., AnyMatrix]) -> dict[str, AnyMatrix]:
    """First derivatives, then second derivatives: of the reward, by ``curved``, of the dynamics, and from them of Q."""
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
    scalar, formulas = _is_scalar(given), _formulas(given)
    if not scalar:
        work.say("$f_s$ and $f_a$ are the matrices $A$ and $B$ of the linearisation.")
    for code, by, formula, gradient in (
        ("s", names, STATE_JACOBIAN, formulas.s), ("a", actions, INPUT_JACOBIAN, formulas.a),
    ):  # fmt: skip
        of_r, of_f = derivative_of("r", code), derivative_of("f", code) if scalar else formula
        of_reward = [_first(work, of_r, values, given.reward, "r", name) for name in by]
        of_state = [[_first(work, of_f, values, text, index, name) for name in by] for index, text in texts.items()]
        if any(entry is None for row in (of_reward, *of_state) for entry in row):
            work.say("The other derivatives are zero.")
        known[f"r_{code}"] = matrices.column(map(written_or_zero, of_reward))
        known[f"f_{code}"] = matrices.matrix(map(written_or_zero, row) for row in of_state)
        Q[f"Q_{code}"] = work.answer(_applied(given, work, gradient, known))
    if not scalar:
        work.say(
            "In second derivatives $ξ$ stands for state and action together: $ξ_j$ and $ξ_k$ are any two of its "
            "entries."
        )
    work.say(
        f"Second derivatives of {'$r$ and $f$' if given.second_order else '$r$'} that are not written down are $0$."
    )
    known["components"] = tuple(range(1, len(texts) + 1)) if given.second_order else ()
    if not given.second_order:
        work.say(f"iLQR leaves out the {'products' if scalar else 'sums'} with the second derivatives of $f$.")
    for code, formula, rows, columns in (
        ("ss", formulas.ss, names, names),
        ("as", formulas.mixed, actions, names),
        ("aa", formulas.aa, actions, actions),
    ):
        of_r, of_f = (derivative_of(head, code) for head in "rf") if scalar else (reward_second(), SECOND_DERIVATIVE)
        known[f"r_{code}"] = curved(work, of_r, values, given.reward, "r", rows, columns)
        known[f"fi{code}"] = {
            number: _second(work, of_f, values, text, index, rows, columns)
            for number, (index, text) in enumerate(texts.items(), 1)
            if given.second_order
        }
        known |= {f"f_{code}": bent for bent in known[f"fi{code}"].values() if scalar}
        right = None if given.second_order or scalar else ilqr(formula)
        Q[f"Q_{code}"] = work.answer(_applied(given, work, formula, known, right))
    return Q


@dynamics.at_operating_point()
def _first(work: Work, formula: Any, values: Mapping[str, Value], text: str, of: int | str, name: str) -> Value | None:
    """A first derivative, if there is anything to write down."""
    right = dynamics.chained(text, name, ())
    into = partial_part if isinstance(of, str) else partial
    return None if right == 0 else work.step(formula, into=into, right=right, i=of, j=name, **values)


@dynamics.at_operating_point()
def _second(
    work: Work,
    formula: Formula,
    values: Mapping[str, Value],
    text: str,
    of: int | str,
    rows: tuple[str, ...],
    columns: tuple[str, ...],
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
    other = given.model_copy(update={"second_order": not given.second_order})
    _maximum(given, work, _expanded(other, work, _second))


ILQR_FOR_DDP = slip(
    "ilqr-for-ddp",
    "DDP keeps the second derivatives of the dynamics: V′ₛ · fₛₛ and the like belong to those of Q; "
    "only iLQR drops them.",
    when=lambda given: given.second_order,
)(other_method)
DDP_FOR_ILQR = slip(
    "ddp-for-ilqr",
    "iLQR takes the dynamics as linear: their second derivatives, which DDP adds, are left out.",
    when=lambda given: not given.second_order,
)(other_method)


@slip(
    "two-of-a-square-lost",
    "The second derivative of c x² is 2c: differentiating the square brings the 2 down, and it stays.",
)
def two_lost(given: Given, work: Work) -> None:
    """The reward's second derivatives without the 2 of its squares: of those that are the same everywhere."""
    moving = {dynamics.symbol(name) for name in (*given.states, *given.action)}

    def of_square(first: str, then: str) -> bool:
        return first == then and not dynamics.second(given.reward, first, then).free_symbols & moving

    def curved(*arguments: Any) -> AnyMatrix:
        *_, rows, columns = arguments
        return matrices.matrix(
            [entry / 2 if of_square(first, then) else entry for then, entry in zip(columns, line, strict=True)]
            for first, line in zip(rows, _second(*arguments).tolist(), strict=True)
        )

    _maximum(given, work, _expanded(given, work, curved))


MISCONCEPTIONS = (
    ILQR_FOR_DDP,
    DDP_FOR_ILQR,
    K_WITH_PLUS,
    OLD_ACTION_FORGOTTEN.where_it_shows(),
    two_lost.where_it_shows(),
)


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
    k, K = -np.linalg.solve(aa, g[n:]), -np.linalg.solve(aa, hessian[n:, :n])
    answers = (g[:n], g[n:], hessian[:n, :n], hessian[n:, :n], aa, k, K)
    if given.reached is None:
        return answers
    aside = [dynamics.radians(given.reached[name]) - values[name].real for name in given.states]
    return (*answers, [values[name].real for name in given.action] + k + K @ aside)


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
