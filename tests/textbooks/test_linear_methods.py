"""Published or hand-checkable numbers of linear methods and of kinematics."""

from typing import Any

import pytest
import sympy
from flint import fmpq
from sympy import Rational, pi, sqrt

from asking import solved
from rldrill.solutions.exact import to_sympy


def written(matrix: Any) -> list[list[Any]]:
    return [[to_sympy(entry) for entry in line] for line in matrix.tolist()]


def assert_is(matrix: Any, expected: list[list[Any]]) -> None:
    found = written(matrix)
    assert [len(line) for line in found] == [len(line) for line in expected]
    for line, wanted in zip(found, expected, strict=True):
        assert all(sympy.simplify(a - b) == 0 for a, b in zip(line, wanted, strict=True)), (found, expected)


def test_the_golden_ratio_of_the_simplest_riccati_equation() -> None:
    # A = B = Q = R = 1: S = 1 + S − S²/(1 + S), so S² − S − 1 = 0 and S is the golden ratio.
    # L = S/(1 + S) = 1/S = S − 1, since S² = S + 1.
    golden = (1 + sqrt(5)) / 2
    answers = solved("lqr-infinite", A=1, B=1, Q=1, R=1)
    assert_is(answers["a"], [[-golden]])
    assert_is(answers["b"], [[golden - 1]])
    assert_is(answers["c"], [[2 - golden]])


def test_the_cheapest_control_of_an_unstable_system() -> None:
    # Bertsekas 2017, section 3.1: with Q = 0 and |A| > 1 the cost-to-go is (A² − 1)R/B², and the closed loop
    # is 1/A. A = 2, B = R = 1: S = 3, L = 3·2/(1 + 3) = 3/2, A − L = 1/2.
    answers = solved("lqr-infinite", A=2, B=1, Q=0, R=1)
    assert [answers[label][0, 0] for label in "abc"] == [-3, fmpq(3, 2), fmpq(1, 2)]


def test_the_scalar_riccati_recursion_by_hand() -> None:
    # A = B = Q = R = 1 over two steps: S₂ = 1, L₁ = 1/2, S₁ = 1 + 1 − 1/2 = 3/2, L₀ = (3/2)/(5/2) = 3/5,
    # S₀ = 1 + 3/2 − 3/2·3/5 = 8/5: quotients of Fibonacci numbers.
    answers = solved("lqr-backward", A=1, B=1, Q=1, R=1, start=[5], horizon=2)
    expected = [fmpq(1, 2), fmpq(-3, 2), fmpq(3, 5), fmpq(-8, 5), -3]
    assert [answers[label][0, 0] for label in "abcde"] == expected


def test_a_double_integrator_one_step_before_the_end() -> None:
    # Q = I, R = 1, S₁ = I: BᵀSB = 1, BᵀSA = (0 1), L = (0 1/2);
    # AᵀSA = (1 1; 1 2), AᵀSBL = (0 0; 0 1/2), S₀ = I + (1 1; 1 3/2) = (2 1; 1 5/2).
    system = {"A": [[1, 1], [0, 1]], "B": [[0], [1]], "Q": [[1, 0], [0, 1]], "R": 1}
    answers = solved("lqr-backward", **system, start=[0, 4], horizon=1)
    assert_is(answers["a"], [[0, Rational(1, 2)]])
    assert_is(answers["b"], [[-2, -1], [-1, -Rational(5, 2)]])
    assert_is(answers["c"], [[-2]])


def test_the_double_integrator_of_matlabs_and_scipys_manuals_in_decimals() -> None:
    # scipy.linalg.solve_discrete_are, example: a = (0 1; 0 −1), b = (1 0; 2 1), q = (−4 −4; −4 7) has an indefinite
    # q and is refused; the same a and b with q = I and r = I must solve the equation to twelve decimals.
    problem = {"A": [[0, 1], [0, -1]], "B": [[1, 0], [2, 1]], "R": [[1, 0], [0, 1]]}
    answers = solved("lqr-infinite", **problem, Q=[[1, 0], [0, 1]])
    P, L = sympy.Matrix(written(answers["a"])), sympy.Matrix(written(answers["b"]))
    A, B = sympy.Matrix(problem["A"]), sympy.Matrix(problem["B"])
    left_over = -sympy.eye(2) + A.T * P * A - A.T * P * B * L - P
    assert max(abs(entry) for entry in left_over) < Rational(1, 10**11)
    assert P[0, 0] == -1  # the first state has no effect on anything: it costs 1, once
    assert P[0, 1] == 0


PENDULUM = {
    "dynamics": {"theta": "omega", "omega": "(u - b*omega - m*g*l*sin(theta))/(m*l^2)"},
    "constants": {"g": 10, "l": 2, "m": 1, "b": "1/2"},
    "state": {"theta": "pi", "omega": 0},
    "action": {"u": 0},
}


@pytest.mark.parametrize(("theta", "slope"), [("pi", 5), ("0", -5), ("pi/3", -Rational(5, 2)), ("pi/2", 0)])
def test_the_pendulum_at_several_angles(theta: str, slope: Any) -> None:
    # Tedrake, Underactuated Robotics, chapter 2: A = (0 1; −(g/l) cos θ  −b/ml²), B = (0; 1/ml²).
    # g = 10, l = 2, m = 1, b = 1/2: g/l = 5, b/ml² = 1/8, 1/ml² = 1/4.
    answers = solved("linearise", **PENDULUM | {"state": {"theta": theta, "omega": 0}})
    assert_is(answers["a"], [[0, 1], [slope, -Rational(1, 8)]])
    assert_is(answers["b"], [[0], [Rational(1, 4)]])


def cart_pole(**constants: Any) -> dict[str, Any]:
    return {
        "dynamics": {
            "x": "v", "theta": "omega",
            "v": "(u + m_p*sin(theta)*(l*omega^2 + g*cos(theta)))/D",
            "omega": "-(u*cos(theta) + m_p*l*omega^2*cos(theta)*sin(theta) + (m_c + m_p)*g*sin(theta))/(l*D)",
        },
        "where": {"D": "m_c + m_p*sin(theta)^2"},
        "constants": constants,
        "state": {"x": 0, "theta": "pi", "v": 0, "omega": 0},
        "action": {"u": 0},
    }  # fmt: skip


def test_the_cart_pole_at_its_upright_equilibrium() -> None:
    # Tedrake, Underactuated Robotics, section 3.2: near θ = π with θ̃ = θ − π the accelerations are
    # ẍ = (u + m_p g θ̃)/m_c and θ̈ = (u + (m_c + m_p) g θ̃)/(l m_c).
    answers = solved("linearise", **cart_pole(m_c=2, m_p=1, l=3, g=10))
    assert_is(answers["a"], [[0, 0, 1, 0], [0, 0, 0, 1], [0, 5, 0, 0], [0, 5, 0, 0]])
    assert_is(answers["b"], [[0], [0], [Rational(1, 2)], [Rational(1, 6)]])


def test_the_euler_step_of_the_cart_pole() -> None:
    answers = solved("linearise", **cart_pole(m_c=2, m_p=1, l=3, g=10), step="1/10")
    tenth, half = Rational(1, 10), Rational(1, 2)
    assert_is(answers["a"], [[1, 0, tenth, 0], [0, 1, 0, tenth], [0, half, 1, 0], [0, half, 0, 1]])
    assert_is(answers["b"], [[0], [0], [Rational(1, 20)], [Rational(1, 60)]])


def test_the_unicycle_of_lavalle() -> None:
    # ẋ = v cos θ, ẏ = v sin θ, θ̇ = ω at θ = π/6 and v = 2: columns (−2 sin, 2 cos) = (−1, √3) and (√3/2, 1/2).
    answers = solved(
        "linearise",
        dynamics={"x": "v*cos(theta)", "y": "v*sin(theta)", "theta": "omega"},
        state={"x": 4, "y": 5, "theta": "pi/6"}, action={"v": 2, "omega": 1},
    )  # fmt: skip
    assert_is(answers["a"], [[0, 0, -1], [0, 0, sqrt(3)], [0, 0, 0]])
    assert_is(answers["b"], [[sqrt(3) / 2, 0], [Rational(1, 2), 0], [0, 1]])


def test_a_tank_at_its_equilibrium() -> None:
    # ḣ = (u − c√h)/A with c = 4, A = 2: at h = 4, u = 8 it stands still; ∂/∂h = −c/(2A√h) = −1/2, ∂/∂u = 1/2.
    # One Euler step with Δt = 1: A = 1/2, B = 1/2, C = 4 − 1/2·4 − 1/2·8 = −2.
    tank = {
        "dynamics": {"h": "(u - c*sqrt(h))/A"},
        "constants": {"c": 4, "A": 2},
        "state": {"h": 4},
        "action": {"u": 8},
    }
    answers = solved("linearise-affine", **tank, step=1)
    assert_is(answers["a"], [[-2]])
    assert_is(answers["b"], [[Rational(1, 2), -2], [0, 1]])
    assert_is(answers["c"], [[Rational(1, 2)], [0]])


def test_a_backward_step_of_ddp_by_hand() -> None:
    # f = x + u², r = −u², x = 1, u = 1, V′ₓ = −3, V′ₓₓ = −1: fₓ = 1, fᵤ = 2, fᵤᵤ = 2.
    # Qₓ = −3, Qᵤ = −2 + 2·(−3) = −8, Qₓₓ = −1, Qᵤₓ = 2·(−1) = −2, Qᵤᵤ = −2 + 4·(−1) + 2·(−3) = −12,
    # k = −8/12 = −2/3, K = −2/12 = −1/6.
    answers = solved(
        "ddp-backward",
        dynamics={"x": "x + u^2"}, reward="-u^2", state={"x": 1}, action={"u": 1}, gradient=[-3], hessian=-1,
    )  # fmt: skip
    expected = [-3, -8, -1, -2, -12, fmpq(-2, 3), fmpq(-1, 6)]
    assert [answers[label][0, 0] for label in "abcdefg"] == expected


def test_the_planar_arm_of_craig_and_siciliano() -> None:
    # Siciliano et al. 2009, section 2.9.1: x = l₁c₁ + l₂c₁₂, y = l₁s₁ + l₂s₁₂; l = (2, 1), θ = (π/6, π/3):
    # c₁ = √3/2, s₁ = 1/2, c₁₂ = 0, s₁₂ = 1.
    answers = solved("forward-kinematics", lengths=[2, 1], angles=["pi/6", "pi/3"])
    assert answers["a"] == pi / 2
    assert answers["b"] == (sqrt(3), 2)


def test_the_jacobian_of_craig_and_siciliano() -> None:
    # Craig 2005, eq. 5.67, and Siciliano et al. 2009, section 3.2.1, for two links:
    # J = (−l₁s₁ − l₂s₁₂  −l₂s₁₂; l₁c₁ + l₂c₁₂  l₂c₁₂), det J = l₁l₂ sin θ₂.
    answers = solved("jacobian", lengths=[2, 1], angles=["pi/6", "pi/3"], rates=[1, 2])
    assert_is(answers["a"], [[-2, -1], [sqrt(3), 0]])
    assert answers["b"] == (-4, sqrt(3))
    assert answers["c"] is False
    assert solved("jacobian", lengths=[2, 1], angles=["pi/6", 0], rates=[1, 2])["c"] is True


def test_the_first_link_of_the_anthropomorphic_arm() -> None:
    # Siciliano et al. 2009, table 2.4 and section 2.9.4: a = 0, α = π/2, d = 0:
    # A₁ = (c 0 s 0; s 0 −c 0; 0 1 0 0; 0 0 0 1).
    link = {"theta": "pi/3", "d": 0, "a": 0, "alpha": "pi/2"}
    c, s = Rational(1, 2), sqrt(3) / 2
    assert_is(
        solved("denavit-hartenberg", links=[link])["a"],
        [[c, 0, s, 0], [s, 0, -c, 0], [0, 1, 0, 0], [0, 0, 0, 1]],
    )


def test_a_step_of_maml_by_hand() -> None:
    # Finn et al. 2017, eq. 1, for L = ½ (θ − 4)² and α = β = 1/2, θ = 0: θ′ = 0 − ½·(−4) = 2;
    # the gradient of ½ (θ′ − 4)² by θ is (1 − ½)·(2 − 4) = −1; θ becomes 1/2.
    answers = solved("maml-step", theta=0, tasks=[[1, 4]], alpha="1/2", beta="1/2")
    assert answers == {"a": fmpq(2), "b": fmpq(1, 2)}
