"""Identities between the linear methods: LQR, its horizon, its linearisation, DDP."""

from collections import Counter, defaultdict
from fractions import Fraction
from functools import partial
from itertools import product
from json import dumps, loads
from typing import Any
from unicodedata import normalize

import numpy as np
import pytest
import sympy
from flint import fmpq, fmpq_mat
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import rldrill
from asking import solved
from numbers_drawn import small
from rldrill.problems.catalogue import family
from rldrill.problems.errors import FileError
from rldrill.problems.expressions import parsed, worked_out
from rldrill.problems.linear_quadratic import NOTATIONS, Notation
from rldrill.problems.robots import robots
from rldrill.render.unicode import unicode_text
from rldrill.solutions import dynamics, matrices, surds
from rldrill.solutions.drawing import draw
from rldrill.solutions.exact import sign, simplest, to_sympy
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.formula.formula import Misconception
from rldrill.solutions.formula.notation import gamma
from rldrill.solutions.linear_methods.ddp_backward import _is_negative
from rldrill.solutions.sheet.linear_methods import (
    LOOP_WITHOUT_R,
    LOOP_WITHOUT_R_IN_COSTS,
    OTHER_ROOT,
    POSITIVE_S,
    Modes,
    quadratic,
    scalar_system,
)
from rldrill.solutions.work import Equality, Note, Step

whole = st.integers(-3, 3)
positive = st.integers(1, 4)
seeds = st.integers(0, 10_000)


def entries(matrix: Any) -> list[Any]:
    return [to_sympy(entry) for line in matrix.tolist() for entry in line]


@given(whole, positive, positive, positive, st.integers(1, 3))
@settings(deadline=None, max_examples=25)
def test_the_value_is_the_total_reward_of_the_best_actions(a: int, b: int, q: int, r: int, horizon: int) -> None:
    system = {"A": a, "B": b, "Q": q, "R": r, "start": [2], "horizon": horizon}
    backward = solved("lqr-backward", **system)
    labels = "abcdefgh"
    gains = [[[str(backward[labels[2 * k]][0, 0])]] for k in reversed(range(horizon))]
    rollout = solved("lqr-reward", **system, L=[*gains, [[0]]])
    assert rollout["b"] == 4 * backward[labels[2 * horizon - 1]][0, 0]  # V(2) = 2 P 2


@given(whole, positive, positive, positive, st.integers(-9, 9))
@settings(deadline=None, max_examples=25)
def test_no_other_gain_earns_more(a: int, b: int, q: int, r: int, other: int) -> None:
    system = {"A": a, "B": b, "Q": q, "R": r, "start": [1], "horizon": 1}
    best = solved("lqr-backward", **system)["b"][0, 0]
    assert solved("lqr-reward", **system, L=[[[f"{other}/3"]], [[0]]])["b"] <= best


def test_matrices_that_change_with_time_are_solved_like_constant_ones() -> None:
    A, B, Q, R = [[1, 1], [0, 1]], [[0], [1]], [[1, 0], [0, 2]], [[3]]
    constant = solved("lqr-backward", A=A, B=B, Q=Q, R=R, start=[1, 2], horizon=2)
    varying = solved("lqr-backward", A=[A, A], B=[B, B], Q=[Q, Q, Q], R=[R, R, R], start=[1, 2], horizon=2)
    assert {label: entries(value) for label, value in constant.items()} == {
        label: entries(value) for label, value in varying.items()
    }


def test_a_system_that_changes_with_time_by_hand() -> None:
    # S₂ = 3. At t = 1: A = 2, B = 1, R = 1: L₁ = 3·2/(1 + 3) = 3/2, S₁ = 1 + 12 − 6·3/2 = 4.
    # At t = 0: A = 1, B = 2, R = 4: L₀ = 2·4·1/(4 + 16) = 2/5, S₀ = 5 + 4 − 4·2·2/5 = 29/5, a₀ = −2/5·10 = −4.
    answers = solved("lqr-backward", A=[1, 2], B=[2, 1], Q=[5, 1, 3], R=[4, 1, 1], start=[10], horizon=2)
    expected = {"a": fmpq(3, 2), "b": -4, "c": fmpq(2, 5), "d": fmpq(-29, 5), "e": -4}
    assert {label: value[0, 0] for label, value in answers.items()} == expected


@given(seeds, st.integers(1, 3))
@settings(deadline=None, max_examples=25)
def test_the_stationary_value_solves_its_equation_and_is_stable(seed: int, level: int) -> None:
    solution = draw("lqr-infinite", level, seed)
    given_ = solution.problem.data()["given"]
    if "closed_loop" in given_:  # the price that was found, put in its place
        loop, found = given_.pop("closed_loop"), solution.answers
        filled = loads(dumps(given_).replace('"rho"', f'"{found["b"]}"'))
        answers = solved("lqr-infinite", **filled)
        assert [answers[label][0, 0] for label in "ac"] == [found["a"], fmpq(*map(int, loop.split("/")))]
        return
    A, B, Q = (matrices.given(getattr(solution.problem.given, name)) for name in "ABQ")
    gamma = fmpq(*Fraction(given_.get("gamma", 1)).as_integer_ratio())
    N = matrices.given(solution.problem.given.N) if "N" in given_ else B * 0
    P, L, closed = (solution.answers[label] for label in "abc")
    right = -Q + A.transpose() * P * A * gamma - (A.transpose() * P * B * gamma - N) * L
    assert all(sympy.simplify(entry) == 0 for entry in entries(right - P))
    assert all(sign(P[i, i]) < 0 for i in range(P.nrows()))
    modes = np.linalg.eigvals(np.array(entries(closed), dtype=float).reshape(closed.nrows(), -1))
    assert float(gamma) ** 0.5 * max(abs(modes)) < 1


def test_the_price_of_a_closed_loop_by_hand() -> None:
    # 2 − 2L = 1/3 gives L = 5/6; 4P/(4P − 1) = 5/6 gives P = −5/4; −q + 4P − 4P·5/6 = −q − 5/6 = −5/4 gives q = 5/12.
    system: dict[str, Any] = {"A": 2, "B": 2, "closed_loop": "1/3"}
    assert list(solved("lqr-infinite", **system, Q="rho", R=1).values()) == [fmpq(-5, 4), fmpq(5, 12)]
    assert list(solved("lqr-infinite", **system, Q=5, R="rho").values()) == [-15, 12]


def test_the_price_of_an_action_by_hand() -> None:
    # P = diag(−3, −2), B = (1, 1): L = (3, 2)/(5 + ρ), so a = −(3 + 4)/(5 + ρ) = −1 for ρ = 2.
    answers = solved(
        "lqr-gain", A=[[1, 0], [0, 1]], B=[[1], [1]], R="rho", P=[[-3, 0], [0, -2]], start=[1, 2], action=-1
    )
    assert answers["a"] == 2
    assert entries(answers["b"]) == [fmpq(3, 7), fmpq(2, 7)]


def test_a_long_horizon_comes_to_the_infinite_one() -> None:
    system = {"A": 2, "B": 1, "Q": 1, "R": 1}
    limit = solved("lqr-infinite", **system)["a"][0, 0]
    finite = solved("lqr-backward", **system, start=[1], horizon=12)["x"][0, 0]
    assert abs(float(limit) - float(to_sympy(finite))) < 1e-8


@given(st.lists(whole, min_size=9, max_size=9), st.lists(whole, min_size=3, max_size=3))
@settings(deadline=None, max_examples=15)
def test_larger_systems_solve_their_equation_to_twelve_decimals(a: list[int], b: list[int]) -> None:
    A = [[str(sympy.Rational(entry, 4)) for entry in a[3 * i : 3 * i + 3]] for i in range(3)]
    Q = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    try:
        answers = solved("lqr-infinite", A=A, B=[[entry] for entry in b], Q=Q, R=2)
    except FileError:  # it cannot be held: no action reaches what runs away
        return
    P, L = (np.array(entries(answers[label]), dtype=float).reshape(-1, 3) for label in "ab")
    A_, B_ = np.array(a, dtype=float).reshape(3, 3) / 4, np.array(b, dtype=float).reshape(3, 1)
    left_over = -np.eye(3) + A_.T @ P @ A_ - A_.T @ P @ B_ @ L - P
    assert np.abs(left_over).max() < 1e-8 * max(1, np.abs(P).max())


@pytest.mark.parametrize(("A", "Q"), [([[2, 0], [0, 1]], [[1, 0], [0, 1]])])
def test_a_system_that_cannot_be_held_is_refused(A: Any, Q: Any) -> None:
    with pytest.raises(FileError, match="no action"):
        solved("lqr-infinite", A=A, B=[[0], [1]], Q=Q, R=[[1]])


@pytest.mark.parametrize("A", [[[1, 0], [0, 1]], [[2, 1], [1, 2]]])
def test_no_letter_is_left_open_but_the_price_that_is_found(A: Any) -> None:
    """No answer could hold it, for what is left open is asked for there."""
    unit = [[1, 0], [0, 1]]
    with pytest.raises(FileError, match="a price may be left open only with a closed_loop"):
        solved("lqr-infinite", A=A, B=unit, Q=[["x", 0], [0, 1]], R=unit)


POINT = {
    "dynamics": {"x": "a*x + b*u"},
    "constants": {"a": 3, "b": "1/2"},
    "state": {"x": 2},
    "action": {"u": 5},
}


def test_linear_dynamics_are_their_own_linearisation() -> None:
    answers = solved("linearise", **POINT)
    assert entries(answers["a"]) == [3]
    assert entries(answers["b"]) == [sympy.Rational(1, 2)]
    assert entries(solved("linearise-affine", **POINT, step=1)["a"]) == [0]  # C vanishes


@given(seeds)
@settings(deadline=None, max_examples=15)
def test_the_affine_model_is_right_at_the_operating_point(seed: int) -> None:
    data = draw("linearise-affine", 2, seed).problem.data()["given"]
    data = {name: value for name, value in data.items() if name not in ("entries", "moved")}
    given_ = family("linearise-affine").read(data)
    answers = solved("linearise-affine", **data)
    A, B = answers["b"], answers["c"]
    state = matrices.column([*(dynamics.angle(given_.state[name]) for name in given_.states), 1])
    action = matrices.column(dynamics.angle(value) for value in given_.action.values())
    after = A * state + B * action
    values = dynamics.numbers(given_)
    rates = dynamics.numeric(dynamics.texts(given_.dynamics), dynamics.texts(given_.where), values)
    for index, (name, rate) in enumerate(zip(given_.states, rates, strict=True)):
        expected = (values[name] + float(given_.step) * rate).real
        assert abs(float(to_sympy(after[index, 0])) - expected) < 1e-9
    assert after[len(rates), 0] == 1


@given(whole, positive, positive, positive, positive)
@settings(deadline=None, max_examples=20)
def test_ddp_of_a_linear_system_is_lqr(a: int, b: int, q: int, r: int, p: int) -> None:
    ddp = solved(
        "ddp-backward",
        dynamics={"x": "c*x + d*u"}, reward="-(q*x^2 + p*u^2)", constants={"c": a, "d": b, "q": q, "p": r},
        state={"x": 0}, action={"u": 0}, gradient=[0], hessian=-2 * p,
    )  # fmt: skip
    gain = solved("lqr-gain", A=[[a]], B=[[b]], R=[[r]], P=[[-p]])["a"][0, 0]
    assert ddp["g"][0, 0] == -gain
    assert ddp["f"][0, 0] == 0


def test_ddp_and_ilqr_differ_by_the_curvature_alone() -> None:
    problem = {
        "dynamics": {"x": "x + u^2"}, "reward": "-u^2", "state": {"x": 1}, "action": {"u": 1},
        "gradient": [-3], "hessian": -1,
    }  # fmt: skip
    ddp, ilqr = (solved("ddp-backward", **problem, second_order=kept) for kept in (True, False))
    assert ddp["e"][0, 0] - ilqr["e"][0, 0] == -6  # V′ times the second derivative of u²
    assert all(entries(ddp[label]) == entries(ilqr[label]) for label in "abcd")


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"dynamics": {"x": "a*x + w*u"}}, "'w', which has no value"),
        ({"dynamics": {"x": "__import__('os')"}}, "not understood"),
        ({"dynamics": {"x": "x.real"}}, "not understood"),
        ({"dynamics": {"x": "x**99"}}, "whole number from 1 to 4"),
        ({"dynamics": {"x": "x" + "+x" * 400}}, "longer than"),
        ({"dynamics": {"x": "(" * 280}}, "nests deeper than 40 brackets"),
        ({"state": {"y": 1}}, "same letters"),
        ({"state": {"x": "pi/0"}}, "divides by zero"),
        ({"action": {"x": 1}}, "two things"),
        ({"constants": {"ab": 1}}, "not a letter"),
        ({"step": 0}, "not above 0"),
    ],
)
def test_systems_that_do_not_fit_are_one_sentence(changed: dict[str, Any], message: str) -> None:
    with pytest.raises(FileError) as error:
        solved("linearise", **(POINT | changed))
    assert message in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"R": -1}, "R must be positive semidefinite"),
        ({"Q": -1}, "Q must be positive semidefinite"),
        ({"B": [[1], [2]]}, "B is 2×1"),
        ({"A": [[[1]], [[1]], [[1]]]}, "A holds 3 matrices"),
        ({"A": [1, 1, 1]}, "A holds 3 matrices"),
        ({"A": [[1], 1]}, "a matrix is a list of rows"),
        ({"A": "one"}, "given.A"),
        ({"horizon": 0}, "given.horizon"),
        ({"horizon": 10**9}, "given.horizon: 1000000000 is too large"),
        (
            {"A": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "horizon": 13},
            "horizon is 13; with 3 states and 1 action, 12 is the most",
        ),
        ({"N": 2}, "with the cross term the matrix of all costs"),
        ({"N": [[1, 0]]}, "N is 1×2"),
        ({"Q": [1, 1, 1], "Q_T": 2}, "Q_T is given twice"),
        ({"gamma": 0}, "given.gamma"),
        ({"convention": "x"}, "given.convention: 'x' is not possible here; write 'value', 'cost-to-go' or 'xuKP'"),
        ({"Q": 0, "R": 0}, "at time 1 the matrix that is to be inverted for the gain is singular"),
    ],
)
def test_systems_with_wrong_weights_are_one_sentence(changed: dict[str, Any], message: str) -> None:
    system: dict[str, Any] = {"A": 1, "B": 1, "Q": 1, "R": 1, "start": [1], "horizon": 2}
    with pytest.raises(FileError, match=message):
        solved("lqr-backward", **(system | changed))


def test_systems_that_nothing_acts_on() -> None:
    # P = −1 + P/4, so P = −4/3; and the same as one half of a larger system.
    answers = solved("lqr-infinite", A="1/2", B=0, Q=1, R=1)
    assert [answers[label][0, 0] for label in "abc"] == [fmpq(-4, 3), 0, fmpq(1, 2)]
    halves = solved("lqr-infinite", A=[["1/2", 0], [0, 2]], B=[[0, 0], [0, 1]], Q=[[1, 0], [0, 0]], R=[[1, 0], [0, 1]])
    assert entries(halves["a"]) == [sympy.Rational(-4, 3), 0, 0, -3]


@pytest.mark.parametrize(
    ("system", "message"),
    [
        ({"A": 2, "B": 0, "Q": 1}, "no action has an effect on a part of the state that does not go to 0"),
        ({"A": 1, "B": 1, "Q": 0}, "as cheap as one likes"),
    ],
)
def test_systems_that_cannot_be_brought_to_rest(system: dict[str, Any], message: str) -> None:
    with pytest.raises(FileError, match=message):
        solved("lqr-infinite", **system, R=1)


def test_a_gain_needs_an_action_that_is_the_best() -> None:
    with pytest.raises(FileError, match="R − BᵀPB is not positive definite, so no action is the best"):
        solved("lqr-gain", A=[[1, 0], [0, 1]], B=[[1], [0]], R=4, P=[[8, 0], [0, -1]])  # more action earns ever more


@pytest.mark.parametrize(
    ("convention", "P", "says"),
    [
        ("value", [[1]], "P is the matrix of a value here, which is negative; give −P, or convention = 'cost-to-go'"),
        ("value", [[1, 0], [0, 0]], "P is the matrix of a value here, which is negative"),
        ("xuKP", [[-1]], "P is the matrix of a cost here, which is positive; give −P, or convention = 'value'"),
    ],
)
def test_a_value_matrix_of_the_other_sign_is_refused(convention: str, P: Any, says: str) -> None:
    size = range(len(P))
    A = [[int(i == j) for j in size] for i in size]
    with pytest.raises(FileError, match=says):
        solved("lqr-gain", convention=convention, A=A, B=[[1] for _ in size], R=4, P=P)  # R ∓ BᵀPB is positive


def test_a_value_matrix_of_zeros_has_no_sign() -> None:
    for convention in ("value", "cost-to-go"):
        assert solved("lqr-gain", convention=convention, A=1, B=1, R=4, P=0)["a"][0, 0] == 0


@pytest.mark.parametrize(
    ("problem", "part", "typed", "name"),
    [
        ("lqr-infinite/1/11", "a", lambda answers: -answers["a"][0, 0], "cost-to-go-given"),
        ("lqr-backward/2/1", "b", lambda answers: -answers["b"][0, 0], "cost-to-go-given"),
        ("jacobian/1/11", "a", lambda answers: answers["a"].transpose().tolist(), "transposed-jacobian"),
    ],
)
def test_the_commonest_slips_are_recognised(problem: str, part: str, typed: Any, name: str) -> None:
    exercise = rldrill.load(problem)
    wrong = str(typed(exercise.solve()))
    verdict = exercise.check(wrong, part)
    assert name in [misconception.name for misconception in verdict.misconceptions], (wrong, verdict)


def test_letters_of_a_system_may_be_those_of_formulas() -> None:
    # A circuit of a coil, a resistor and a capacitor, with the field's own letters, and others that formulas have.
    circuit = {
        "dynamics": {"i": "(u - R*i - g*j)/L", "j": "i"},
        "constants": {"R": 6, "L": 2, "g": 3},
        "state": {"i": 1, "j": 2},
        "action": {"u": 0},
    }
    answers = solved("linearise", **circuit)
    assert entries(answers["a"]) == [-3, fmpq(-3, 2), 1, 0]
    assert entries(answers["b"]) == [fmpq(1, 2), 0]
    written = unicode_text(rldrill.read({"family": "linearise", "given": circuit}).working("a")[3])
    assert written.startswith("∂f₁/∂i = −R/L = ")
    plan = {"dynamics": {"g": "g + i*u^2"}, "constants": {"i": 1}, "state": {"g": 1}, "action": {"u": 1},
            "reward": "-(g^2 + 2*u^2)", "gradient": [-1], "hessian": [[-2]], "second_order": True}  # fmt: skip
    # Q_s = −2 + 1·(−1), Q_a = −4 + 2·(−1), Q_aa = −4 + 2·(−2)·2 + (−1)·2.
    answers = solved("ddp-backward", **plan)
    assert [entries(answers[label]) for label in "abe"] == [[-3], [-6], [-14]]


def test_every_robot_reads_and_names_its_source() -> None:
    for robot in robots():
        assert robot.source
        for text in (*robot.dynamics.values(), *robot.where.values(), *([robot.reward] if robot.reward else [])):
            parsed(text)


def test_angles_survive_being_written() -> None:
    problem = rldrill.draw("linearise", 2, 3).problem
    assert problem.family.read(loads(dumps(problem.data()["given"]))) == problem.given


def test_dynamics_may_be_written_as_in_a_book() -> None:
    # ∂(dω/dt)/∂θ = −(g/l) cos π = 5, ∂(dω/dt)/∂ω = −b/(m l²) = −1/8, and u acts by 1/(m l²) = 1/4.
    pendulum = {"constants": {"g": 10, "l": 2, "m": 1, "b": "½"}, "state": {"θ": "pi", "ω": 0}, "action": {"u": 0}}
    for text in ("(u - b*ω - m*g*l*sin(θ))/(m*l^2)", "(u − b ω − m g l sin θ)/(m l²)", "(u-b·ω)/(m l**2) - g/l*sin(θ)"):
        answers = solved("linearise", dynamics={"θ": "ω", "ω": text}, **pendulum)
        assert entries(answers["a"]) == [0, 1, 5, fmpq(-1, 8)]
        assert entries(answers["b"]) == [0, fmpq(1, 4)]


def test_an_expression_is_never_executed() -> None:
    with pytest.raises(ValueError, match="column 1: '\\[' is not read inside a number"):
        parsed("[x for x in y]")
    with pytest.raises(ValueError, match="column 8: ':' is not understood"):
        parsed("(lambda: x)()")
    assert worked_out("2*x^2 - x/4", {"x": 4}, {}, float) == 31


terms = st.tuples(st.sampled_from([1, 2, 3, 5, 6]), small(-4, 4, 6))


@given(st.lists(terms, min_size=1, max_size=3), st.lists(terms, min_size=1, max_size=3))
@settings(deadline=None, max_examples=60)
def test_sums_of_roots_calculate_as_sympys_do(first: Any, second: Any) -> None:
    a, b = (sum((sympy.Rational(c) * sympy.sqrt(n) for n, c in part), sympy.Integer(0)) for part in (first, second))
    x, y = surds.read(simplest(a)), surds.read(simplest(b))
    assert x is not None
    assert y is not None
    assert sympy.expand(to_sympy(surds.write(surds.multiply(x, y))) - a * b) == 0
    assert sympy.expand(to_sympy(surds.write(surds.add(x, y))) - a - b) == 0
    if y:
        inverse = surds.inverse(y)
        assert inverse is not None
        assert surds.multiply(y, inverse) == surds.read(simplest(1))


@pytest.mark.parametrize(
    ("more", "mistake", "gain"),
    [
        # γ = 1/2, A = B = Q = 1, R = 2, P₁ = −1: L₀ = (−1/2)/(−1/2 − 2) = 1/5; without R it is 1.
        ({"gamma": "1/2"}, "forgot-r", 1),
        # S₁ = 1: L₀ = 1/(2 + 1) = 1/3; without R it is 1, without the last cost 0.
        ({"convention": "cost-to-go"}, "forgot-r-in-costs", 1),
        ({"convention": "xuKP"}, "no-terminal-cost", 0),
        # With N = 1: L₀ = (−1 − 1)/(−1 − 2) = 2/3; without R it is 2.
        ({"N": [[1]]}, "forgot-r", 2),
    ],
)
def test_misreadings_are_recognised_in_every_form_of_lqr(more: dict[str, Any], mistake: str, gain: int) -> None:
    given_ = {"A": 1, "B": 1, "Q": 2 if "N" in more else 1, "R": 2, "start": [1], "horizon": 1, **more}
    given_ |= {"Q_T": 1} if "N" in more else {}
    exercise = rldrill.read({"family": "lqr-backward", "given": given_})
    assert mistake in [made.name for made in exercise.check(str(gain), "a").misconceptions]


def test_a_long_horizon_says_how_many_times_are_asked_for() -> None:
    given_ = {"A": 1, "B": 1, "Q": 1, "R": 1, "start": [1], "horizon": 20}
    page = str(rldrill.read({"family": "lqr-backward", "given": given_}).question())
    assert "Only the first 12 of the 20 times are asked for; the recursion begins at the horizon" in page
    assert "Only the first" not in str(
        rldrill.read({"family": "lqr-backward", "given": given_ | {"horizon": 12}}).question()
    )


def test_entries_and_a_deviation_by_hand() -> None:
    # x' = x y + u: by x it is y = 3, by y it is x = 2, by u 1; y' = u². A δs + B δa = (3·1 + 2·2 + 1·(1/2), 2·4·(1/2)).
    system = {"dynamics": {"x": "x*y + u", "y": "u^2"}, "state": {"x": 2, "y": 3}, "action": {"u": 4}}
    answers = solved("linearise", **system, entries={"A": [[1, 2], [1, 1]], "B": [[2, 1]]}, deviation=[1, 2, "1/2"])
    assert answers == {"a": (2, 3), "b": 8, "c": (fmpq(15, 2), 4)}
    with pytest.raises(FileError, match="B has 2 rows and 1 columns"):
        solved("linearise", **system, entries={"B": [[1, 2]]})


@given(st.lists(st.integers(-6, 2), min_size=6, max_size=6), st.integers(1, 3))
def test_a_matrix_is_negative_definite_where_all_its_eigenvalues_are_negative(six: list[int], size: int) -> None:
    a, b, c, d, e, f = six
    full = np.array([[a, b, c], [b, d, e], [c, e, f]])[:size, :size]
    eigenvalues = np.linalg.eigvalsh(full)
    assume(min(abs(eigenvalues)) > 1e-9)
    assert _is_negative(matrices.matrix([[fmpq(int(entry)) for entry in line] for line in full])) == bool(
        max(eigenvalues) < 0
    )


def test_a_matrix_with_an_eigenvalue_of_zero_is_not_negative_definite() -> None:
    for rows in ([[0]], [[-1, 0], [0, 0]], [[0, 0], [0, -1]], [[-1, 1], [1, -1]]):
        assert not _is_negative(matrices.matrix([[fmpq(entry) for entry in line] for line in rows]))


def test_the_price_of_a_rollout_by_hand() -> None:
    # a₀ = −2, so r₀ = −(1 + 4ρ), and s₁ = 3 − 2 = 1, so r₁ = r₀: −2 − 8ρ = −18 for ρ = 2.
    answers = solved("lqr-reward", A=3, B=1, Q=1, R="rho", L=2, start=[1], horizon=1, total=-18)
    assert answers == {"a": 2, "b": -9}


def test_the_price_of_a_first_action_by_hand() -> None:
    # P₁ = −2; a₀ = −3·2/(2 + ρ) = −3/2 for ρ = 2; L₀ = 3/2 (from the state 1), and P₀ = −2 − 2·9 + 2·3·3/2 = −11.
    answers = solved("lqr-backward", A=3, B=1, Q=2, R="rho", start=[1], horizon=1, action="-3/2")
    assert [answers["a"], answers["b"][0, 0], answers["c"][0, 0]] == [2, fmpq(3, 2), -11]


def test_the_scalar_riccati_equation_is_solved_with_its_numbers() -> None:
    """The root of a value is the negative one."""
    exercise = rldrill.read({"family": "lqr-infinite", "given": {"A": [[1]], "B": [[1]], "Q": [[2]], "R": [[4]]}})
    working = str(exercise.working("a"))
    # −2 + P − P²/(P − 4), times P − 4: P² − 4P = −2P + 8 + P² − 4P − P², so P² + 2P − 8 = 0, whose roots are −4 and 2.
    assert "P = −2 + 1²·P − (1·P·1)²/(1²·P − 4)" in working
    assert "1²·P² + 2P − 2·4 = 0" in working
    assert "P² + 2P − 8 = 0" in working
    assert exercise.solve()["a"][0, 0] == -4
    assert exercise.parts[0].points >= 3


def test_where_there_is_one_state_f_has_no_index() -> None:
    for name in ("linearise", "linearise-affine", "ddp-backward"):
        for seed in range(8):
            exercise = rldrill.draw(name, 1 if name != "ddp-backward" else 2, seed)
            if len(exercise.problem.given.state) == 1:  # type: ignore[attr-defined]
                working = str(exercise.working())
                assert "f₁" not in working
                assert "f_f" not in working


def test_the_first_line_has_a_place_for_every_second_derivative() -> None:
    """Two components of f, one of them flat: both terms stand in Q_ss, Q_as and Q_aa, and leave with the next line."""
    for seed in range(30):
        exercise = rldrill.draw("ddp-backward", 3, seed)
        if exercise.problem.given.second_order:  # type: ignore[attr-defined]
            for label in "cde":
                *_, step = exercise.solution.lines_of(label)
                assert isinstance(step, Step)
                assert len(step.put_in.args) == 4, exercise.id
            return
    raise AssertionError


def test_matrices_that_are_not_asked_for_are_worked_out_where_they_are_needed() -> None:
    for seed in range(40):
        exercise = rldrill.draw("linearise", 3, seed)
        given_: Any = exercise.problem.given
        if not given_.entries.A:
            assert "A_Δ" not in str(exercise.working("a"))
            assert "A_Δ" in str(exercise.working("b"))
            return
    raise AssertionError


@pytest.mark.parametrize("name", ["lqr-gain", "lqr-backward", "lqr-reward"])
def test_what_was_worked_out_with_a_price_is_not_worked_out_again(name: str) -> None:
    """The price that was found is put into the gain or the reward in which it was left open."""
    for seed in range(40):
        exercise = rldrill.draw(name, 3, seed)
        if "price" in exercise.parts[0].ask:
            assert not any(isinstance(line, Step) for line in exercise.solution.lines_of("b"))
            assert exercise.parts[1].points == 1
            return
    raise AssertionError


@pytest.mark.parametrize("options", [{}, {"gamma": "1/2"}, {"N": [["1/4"]]}, {"N": [["1/4"]], "convention": "xuKP"}])
def test_the_riccati_equation_is_cleared_of_its_denominator_line_by_line(options: dict[str, Any]) -> None:
    exercise = rldrill.read({"family": "lqr-infinite", "given": {"A": 2, "B": 1, "Q": 3, "R": 2, **options}})
    cleared = [line for line in exercise.solution.lines_of("a") if isinstance(line, Equality)][:3]
    first, *others = (sympy.expand(to_sympy(line.left) - to_sympy(line.rights[0])) for line in cleared)
    assert len(others) == 2
    assert all(sympy.expand(first - other) == 0 for other in others)


@pytest.mark.parametrize("modes", Modes)
def test_both_roots_and_the_misread_gain_are_the_same_in_the_letters_of_a_mode(modes: Modes) -> None:
    # B = 2, Q = 2, R = 1/2, β = 3: 4P² + 3P − 1 = 0 has the roots (−3 ± √(9 + 16))/8, −1 and 1/4.
    # With A = 3 and P = −1 for the cost-to-go the gain is −(4 − 1/2)⁻¹·2·(−1)·3 = 12/7, with S = 1 it is 6/(1/2 + 4).
    system = scalar_system(NOTATIONS["value"], discounted=False, crossed=False, modes=modes)
    numbers = {"A": 3, "B": 2, "Q": 2, "R": sympy.Rational(1, 2), "beta": 3}
    put_in = {getattr(system.letters, name): number for name, number in numbers.items()}
    worth = system.letters.value
    other, with_cost = system.root.misread[OTHER_ROOT], system.gain.misread[POSITIVE_S]
    assert [root.subs(put_in) for root in (system.root.right, other)] == [-1, sympy.Rational(1, 4)]
    assert sympy.expand(system.quadratic.subs(put_in)) == 4 * worth**2 + 3 * worth - 1
    at_the_root = {**put_in, worth: -1}
    assert with_cost.subs(at_the_root) == sympy.Rational(12, 7)
    assert system.gain.right.subs(at_the_root) == sympy.Rational(6, 1) / (4 + sympy.Rational(1, 2))


@pytest.mark.parametrize("modes", Modes)
@pytest.mark.parametrize("notation", [*NOTATIONS.values()], ids=[*NOTATIONS])
@pytest.mark.parametrize(("discounted", "crossed"), [*product((False, True), repeat=2)])
def test_the_root_solves_the_quadratic_and_the_riccati_equation(
    notation: Notation, modes: Modes, discounted: bool, crossed: bool
) -> None:
    system = scalar_system(notation, discounted=discounted, crossed=crossed, modes=modes)
    letters, third = system.letters, sympy.Rational(1, 3)
    numbers = {letters.A: 3, letters.B: 2, letters.Q: 2, letters.R: third, letters.N: third / 2, gamma: third * 2}
    numbers[letters.beta] = system.beta.right.subs(numbers)
    root = system.root.right.subs(numbers)
    numbers[letters.value] = root
    assert (root > 0) is sympy.S(notation.costs)
    assert abs(system.quadratic.subs(numbers).evalf(30)) < 1e-25
    assert abs((system.equation.right.subs(numbers) - root).evalf(30)) < 1e-25
    gain = system.gain.right.subs(numbers).evalf(30)
    assert abs(3 - 2 * gain) * (sympy.sqrt(numbers[gamma]) if discounted else 1) < 1, "the closed loop is not stable"


@pytest.mark.parametrize(("notation", "mistake", "after", "found"), [
    ("value", LOOP_WITHOUT_R, -2, -6), ("cost-to-go", LOOP_WITHOUT_R_IN_COSTS, 2, 6),
])  # fmt: skip
def test_who_forgets_what_the_action_costs_adds_the_loop_alone(
    notation: str, mistake: Misconception, after: int, found: int
) -> None:
    # A = 3, B = 2, L = 1: the loop is 3 − 2 = 1. With Q = 5 and γ = 1/2 it is 5 + 1/2·1·2·1 = 6, R = 7 left out.
    formula = quadratic(NOTATIONS[notation], discounted=True, crossed=False).riccati
    numbers = {"At": 3, "Bt": 2, "Qt": 5, "Rt": 7, "Lt": 1, formula.left.code: after}
    known = {code: defaultdict(partial(fmpq_mat, 1, 1, [number])) for code, number in numbers.items()}
    assert value_of(formula.misread[mistake], {**known, "t": 0, "gamma": fmpq(1, 2)}) == fmpq_mat([[found]])


@pytest.mark.parametrize("notation", [*NOTATIONS.values()], ids=[*NOTATIONS])
@pytest.mark.parametrize(("discounted", "crossed"), [*product((False, True), repeat=2)])
def test_brackets_are_multiplied_out_term_by_term(notation: Notation, discounted: bool, crossed: bool) -> None:
    factors, terms, _ = scalar_system(notation, discounted=discounted, crossed=crossed).cleared
    for product_, sum_ in zip(factors, terms, strict=True):
        assert _terms(sum_) == _terms(product_)


def _terms(expression: sympy.Expr) -> Counter[sympy.Expr]:
    """What each summand comes to by itself: nothing of one is taken off another."""
    summands = sympy.Add.make_args(expression)
    return Counter(term for summand in summands for term in sympy.Add.make_args(sympy.expand(summand)))


def test_the_modes_have_letters_of_their_own_and_come_from_the_matrices() -> None:
    # Q (1, 1) = (6, 6) and Q (1, −1) = (2, −2): Q̂ = diag(6, 2); A swaps the entries: Â = diag(1, −1).
    system = {"A": [[0, 1], [1, 0]], "B": [[1, 0], [0, 1]], "Q": [[4, 2], [2, 4]], "R": [[12, 0], [0, 12]]}
    exercise = rldrill.read({"family": "lqr-infinite", "given": system})
    text = normalize("NFC", "\n".join(unicode_text(block) for block in exercise.working()))
    assert "QT = [4  2 ; 2  4][1  1 ; 1  −1] = [6  2 ; 6  −2] = [1  1 ; 1  −1][6  0 ; 0  2] = TQ\u0302" in text
    assert normalize("NFC", "Mode 1, the sum: Â₁ = 1, B̂₁ = 1, Q̂₁ = 6, R̂₁ = 12.") in text
    assert text.count("P = ") == 3  # its equation, and the way back: nothing else is called P


@given(seeds)
@settings(deadline=None, max_examples=20)
def test_that_the_discounted_state_goes_to_0_is_checked(seed: int) -> None:
    solution = draw("lqr-infinite", 2, seed)
    said = " ".join(line.text for line in solution.lines_of("c") if isinstance(line, Note))
    assert "as it must" in said
    assert ("below $1$" in said) == (solution.problem.given.gamma != 1)


@given(seeds)
@settings(deadline=None, max_examples=15)
def test_of_an_arm_at_rest_only_the_derivatives_that_count_are_worked_out(seed: int) -> None:
    exercise = rldrill.draw("linearise", 3, seed)
    assume("D" in exercise.solution.problem.given.where and "θ_2" in exercise.solution.problem.given.state)
    text = "\n".join(unicode_text(block) for block in exercise.working())
    assert "What multiplies ∂M₁/∂θ₂, ∂M₃/∂θ₂ and ∂D/∂θ₂ is 0 at the operating point, since" in text
    assert "n₁ = 0 and n₂ = 0:" in text
    assert "∂D/∂θ₂ =" not in text
    assert "∂n₁/∂θ₂ = m₂l₁l₂ cos(θ₂)(2ω₁ω₂ + ω₂²)" in text  # in the order of n₁ itself


def test_a_derivative_keeps_its_denominator_until_the_numbers_are_in() -> None:
    given_ = {
        "dynamics": {"θ": "ω", "ω": "(u - m*g*l*sin(θ))/(m*l^2)"}, "constants": {"g": 10, "l": 2, "m": 3},
        "state": {"θ": "pi", "ω": 0}, "action": {"u": 0},
    }  # fmt: skip
    text = str(rldrill.read({"family": "linearise", "given": given_}).working("a"))
    assert "∂f₂/∂θ = −(mgl cos(θ))/(ml²)" in text


def test_a_denominator_that_holds_the_letter_is_differentiated_too() -> None:
    given_ = {"dynamics": {"x": "u/(1 + x)"}, "constants": {}, "state": {"x": 1}, "action": {"u": 2}}
    text = str(rldrill.read({"family": "linearise", "given": given_}).working("a"))
    assert "∂f/∂x = −u/(1 + x)²" in text
    assert "A = −1/2" in text


@given(seeds, st.integers(1, 2))
@settings(deadline=None, max_examples=15)
def test_one_state_and_one_action_need_no_matrices(seed: int, level: int) -> None:
    exercise = rldrill.draw("ddp-backward", level, seed)
    text = "\n".join(unicode_text(block) for block in exercise.working())
    assert not [sign for sign in "ᵀΣξᵢⱼ⁻" if sign in text]
    assert "Qₐₐ < 0" in text


def test_entries_of_the_step_are_asked_for_before_the_constant_and_then_the_new_column() -> None:
    for level in (2, 3):
        for seed in range(6):
            exercise = rldrill.draw("linearise-affine", level, seed)
            *steps, constant, column = exercise.parts
            assert steps
            if steps[-1].ask == "What is $F(s̄, ā)$?":
                steps.pop()
            assert all("A_Δ" in part.ask or "B_Δ" in part.ask for part in steps)
            assert constant.points <= 6, exercise.id
            assert (constant.ask, column.ask[:14]) == ("What is $C$?", "What is column")
            answers = exercise.solve()
            size = answers[constant.label].nrows()
            assert entries(answers[column.label]) == [*entries(answers[constant.label]), 1]
            assert entries(answers[column.label])[size] == 1
            text = " ".join(str(exercise.question()).split())
            assert "B̃ is B_Δ with a row of zeros below it" in text
            assert "s̃ is the state with the constant 1 below it" in text


def test_a_price_that_is_found_is_put_into_the_reward() -> None:
    for seed in range(25):
        exercise = rldrill.draw("lqr-reward", 3, seed)
        if exercise.problem.given.total is not None:  # type: ignore[attr-defined]
            *_, line = exercise.solution.lines_of("b")
            assert isinstance(line, Equality)
            assert unicode_text(line.equation()).count("=") == 2, exercise.id


def test_matrices_with_a_letter_are_added_entry_by_entry() -> None:
    # A = [0 1; −1 2], B = [0; 2], P₁ = −I: AᵀP₁A = [−1 2; 2 −5] and AᵀP₁B L₀ = [−4 8; 8 −16]/(4 + ρ).
    exercise = rldrill.read({"family": "lqr-backward", "given": {
        "A": [[0, 1], [-1, 2]], "B": [[0], [2]], "Q": [[1, 0], [0, 1]], "R": [["rho"]], "start": [-1, 4],
        "horizon": 1,
    }})  # fmt: skip
    text = " ".join(str(exercise.working("b")).split())
    assert "−1 − 1 + 4/(4 + ρ)" in text
    assert "−1 − 5 + 16/(4 + ρ)" in text


def test_the_action_in_a_state_beside_the_operating_point() -> None:
    # f = v + u, r = −(v² + u²), V′ₛ = −3, V′ₛₛ = −2 at s̄ = ā = 1: Qₐ = −2 − 3 = −5, Qₐₐ = −2 − 2 = −4, Qₐₛ = −2, so
    # k = −5/4 and K = −1/2; for s = 2 the action is 1 − 5/4 − 1/2·(2 − 1) = −3/4.
    answers = solved(
        "ddp-backward", dynamics={"v": "v + u"}, state={"v": 1}, action={"u": 1}, reward="-(v^2 + u^2)", gradient=[-3],
        hessian=-2, reached={"v": 2},
    )  # fmt: skip
    assert answers["h"][0, 0] == fmpq(-3, 4)
