"""One formula, two independent evaluations: the compiled one (flint) and that of the written-out step (sympy)."""

from collections.abc import Mapping
from typing import Any

import pytest
import sympy
from flint import fmpq, fmpq_mat
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import Expr

from numbers_drawn import small
from rldrill.solutions.exact import NoSolution, to_sympy
from rldrill.solutions.formula.compiling import needs, value_of
from rldrill.solutions.formula.notation import ArgMaxOver, Quantity
from rldrill.solutions.formula.putting_in import evaluated, put_in, reduced
from rldrill.solutions.matrices import is_matrix
from rldrill.solutions.sheet import formulas
from rldrill.solutions.vector import Vector

STATES = ("cool", "warm", "hot")
ACTIONS = ("slow", "fast")
numbers = small(-9, 9, 12)


class Anything(Mapping[Any, Any]):
    """A quantity that has a random value for whatever it is asked."""

    def __init__(self, draw: Any) -> None:
        self._draw = draw
        self._known: dict[Any, Any] = {}

    def __getitem__(self, key: Any) -> Any:
        if key not in self._known:
            self._known[key] = self._draw(key)
        return self._known[key]

    def __iter__(self) -> Any:
        return iter(self._known)

    def __len__(self) -> int:
        return len(self._known)


def known(data: st.DataObject, expression: Expr) -> dict[str, Any]:
    """Values for all letters and quantities of an expression."""

    def number(_: Any = None) -> fmpq:
        value = data.draw(numbers)
        return fmpq(value.numerator, value.denominator)

    def vector(_: Any = None) -> Vector:
        return Vector([number(), number()])

    def matrix(_: Any = None) -> fmpq_mat:
        return fmpq_mat(2, 2, [number() for _ in range(4)])

    fixed: dict[str, Any] = {
        "s": "cool", "a": "slow", "s1": "warm", "b": "fast", "j": 2, "h": "warm", "z": "door", "i": 1, "k": 3,
        "t": 1, "n": data.draw(st.integers(1, 4)), "T": data.draw(st.integers(2, 6)),
        "states": STATES, "choices": ACTIONS, "features": (1, 2), "hypotheses": STATES, "measurements": ("door",),
        "S": Anything(lambda t: STATES[t % 3]), "A": Anything(lambda t: ACTIONS[t % 2]),
        "actions": Anything(lambda _: ACTIONS), "successors": Anything(lambda _: STATES[:2]),
        "predecessors": Anything(lambda _: STATES[1:]),
        "visits": Anything(lambda _: (1, 2)),
        "best": Anything(lambda _: data.draw(st.sampled_from(ACTIONS))),
        "greedy": Anything(lambda _: data.draw(st.sampled_from([("slow",), ("fast",), ACTIONS]))),
        "At": Anything(matrix), "Bt": Anything(matrix), "Pt": Anything(matrix), "Rt": Anything(matrix),
    }  # fmt: skip
    fixed |= {"tau": 1, "episodes": (1, 2), "reward": 2, "run": 1}
    vectors = ("theta_vector", "gradient", "ones")
    fixed |= {"samples": (0, 1, 2), "dimensions": (1, 2), **{code: vector() for code in vectors}}
    fixed |= {code: Anything(vector) for code in ("f_vector", "phi_vector", "score")}
    fixed |= {"first": "cool", "second": "hot"}
    fixed |= {"M": "slow", "models": ACTIONS, "first_model": "slow", "second_model": "fast", "thetas": ACTIONS}
    fixed |= {"heads": 2, "tails": 3, "beta_a": 3, "beta_b": 1, "v": "x", "abscissa": "x", "ordinate": "y"}
    fixed |= {"coins": ("red", "blue"), "theta_of": {"red": fmpq(1, 4), "blue": fmpq(2, 3)}}
    fixed |= {name: number() for name in ("mu_hat", "sigma2", "prior_mean", "prior_variance", "slope", "free")}
    fixed |= {"component": 1, "trajectories": (1, 2), "last": {1: 2, 2: 1}, "policy": "slow", "policies": ACTIONS}
    fixed |= {"violated": ACTIONS, "worth_expert": number(), "xi": number(), "step_length": number()}
    names = ("mean", "mean_bar", "covariance", "covariance_bar", "moved", "read", "Kt")
    fixed |= {name: Anything(matrix) for name in names} | {"identity": fmpq_mat(2, 2, [1, 0, 0, 1])}
    fixed |= {"share": fmpq(1, 4), "log_likelihood": sympy.log(2)}
    fixed |= {"components": (1, 2), "tasks": (1, 2), "pi": Anything(lambda _: abs(number()) + 1)}
    return {
        code: fixed[code] if code in fixed else _value(expression, code, number, matrix) for code in needs(expression)
    }


def _value(expression: Expr, code: str, number: Any, matrix: Any) -> Any:
    """What a letter or a quantity may be worth: what does not commute is a matrix."""
    for node in sympy.preorder_traversal(expression):
        if isinstance(node, Quantity) and node.code == code:
            return Anything(number if node.is_commutative else matrix)
        if node.is_Symbol and node.name == code:
            return number() if node.is_commutative else matrix()
    raise KeyError(code)


READINGS = {key: formula.right for key, formula in formulas().items()} | {
    f"{key}: {misconception.name}": reads
    for key, formula in formulas().items()
    for misconception, reads in formula.misread.items()
}


@pytest.mark.parametrize("name", READINGS)
@given(data=st.data())
@settings(max_examples=5, deadline=None)
def test_the_compiled_value_is_the_value_of_the_step(name: str, data: st.DataObject) -> None:
    expression = READINGS[name]
    values = known(data, expression)
    try:
        value = value_of(expression, values)
    except NoSolution:  # a singular matrix, or a sum that is zero: nothing to compare
        return
    if isinstance(value, Expr) and value.has(sympy.zoo, sympy.nan):  # equal counts below a line
        return
    step = put_in(expression, values)
    if isinstance(expression, ArgMaxOver):
        worth = [evaluated(argument) for argument in step.body.args]
        best = tuple(a for a, w in zip(ACTIONS, worth, strict=True) if w == max(worth))
        assert value == best
        return
    assert_same(value, evaluated(step))
    assert_same(value, evaluated(reduced(step)))


def assert_same(value: Any, written_out: Any) -> None:
    if isinstance(value, Vector):  # where all is zero, nothing of it is written out
        assert value.matrix() == (written_out or sympy.zeros(2, 1))
        return
    if is_matrix(value):
        written = sympy.Matrix(value.nrows(), value.ncols(), [to_sympy(x) for x in value.entries()])
        # A matrix times a number that is 0 is written out as 0.
        assert written.is_zero_matrix if written_out == 0 else sympy.simplify(written - written_out).is_zero_matrix
    else:
        assert sympy.simplify(to_sympy(value) - written_out) == 0
