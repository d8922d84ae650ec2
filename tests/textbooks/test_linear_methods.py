"""Published or hand-checkable numbers of linear methods."""

from typing import Any

import pytest
import sympy
from flint import fmpq
from sympy import Rational, sqrt

import rldrill
from asking import rounded, solved
from rldrill.problems.errors import FileError
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
    # With Q = 0 and |A| > 1, S = A²S − A²B²S²/(R + B²S) has the solution (A² − 1)R/B², and the closed loop is 1/A.
    # A = 2, B = R = 1: S = 3, L = 3·2/(1 + 3) = 3/2, A − L = 1/2.
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


def test_the_system_of_scipys_manual_in_decimals() -> None:
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


DOUBLE_INTEGRATOR = {"A": [[1, 1], [0, 1]], "B": [[0], [1]]}


def test_deadbeat_control_by_hand() -> None:
    # Nothing is paid for the action and the position alone costs: from (p, v) the position of time 1 is p + v whatever
    # one does, and a = −p − 2v makes that of time 2 zero, and the velocity after it. So the costs are
    # p² + (p + v)², and the closed loop is nilpotent.
    answers = solved("lqr-infinite", **DOUBLE_INTEGRATOR, Q=[[1, 0], [0, 0]], R=0)
    assert_is(answers["a"], [[-2, -1], [-1, -1]])
    assert_is(answers["b"], [[1, 2]])
    assert_is(answers["c"] * answers["c"], [[0, 0], [0, 0]])
    # Over two steps, with the velocity paid for at the end: L₁ = (0 1) stops it, which leaves S₁ = (2 1; 1 1).
    finite = solved("lqr-backward", **DOUBLE_INTEGRATOR, Q=[[1, 0], [0, 0]], R=0, Q_T=[[1, 0], [0, 1]], start=[4, 0],
                    horizon=2)  # fmt: skip
    assert_is(finite["a"], [[0, 1]])
    assert_is(finite["b"], [[-2, -1], [-1, -1]])
    assert_is(finite["c"], [[1, 2]])
    assert_is(finite["e"], [[-4]])


def test_deadbeat_control_of_a_number_by_hand() -> None:
    # S = Q + A²S − A²S = Q; L = A/B; A − BL = 0.
    answers = solved("lqr-infinite", A=2, B=4, Q=3, R=0)
    assert [answers[label][0, 0] for label in "abc"] == [-3, fmpq(1, 2), 0]


def test_a_discount_by_hand() -> None:
    # A = B = Q = R = 1, γ = 1/2: γS² − (γ + γ − 1)S − 1 = 0, so S = √2 and L = (S/2)/(1 + S/2) = √2 − 1.
    for convention, sign_of in (("value", -1), ("cost-to-go", 1), ("xuKP", 1)):
        answers = solved("lqr-infinite", A=1, B=1, Q=1, R=1, gamma="1/2", convention=convention)
        assert_is(answers["a"], [[sign_of * sqrt(2)]])
        assert_is(answers["b"], [[sqrt(2) - 1]])
        assert_is(answers["c"], [[2 - sqrt(2)]])


def test_a_cross_term_by_hand() -> None:
    # A = B = Q = R = 1, N = 1/2: S² − (1 − 2·1/2)S − (1 − 1/4) = 0, so S = √3/2;
    # L = (S + N)/(1 + S) = (√3 + 1)/(2 + √3) = √3 − 1.
    answers = solved("lqr-infinite", A=1, B=1, Q=1, R=1, N="1/2")
    assert_is(answers["a"], [[-sqrt(3) / 2]])
    assert_is(answers["b"], [[sqrt(3) - 1]])


def test_a_cross_term_in_a_larger_system_is_another_feedback() -> None:
    # (a + s₂)² + s₁² = a² + 2 a s₂ + s₂² + s₁²: with u = a + s₂ it is the system A − B(0 1) = (1 1; 0 0) with Q = (1 0;
    # 0 0), R = 1, so both have the same S, and the gains differ by (0 1).
    crossed = solved("lqr-infinite", **DOUBLE_INTEGRATOR, Q=[[1, 0], [0, 1]], R=1, N=[[0], [1]])
    other = solved("lqr-infinite", A=[[1, 1], [0, 0]], B=[[0], [1]], Q=[[1, 0], [0, 0]], R=1)
    assert written(crossed["a"]) == written(other["a"])
    difference = [float(a - b) for a, b in zip(written(crossed["b"])[0], written(other["b"])[0], strict=True)]
    assert difference == pytest.approx([0, 1], abs=1e-11)


def test_a_discount_a_cross_term_and_a_final_cost_over_one_step_by_hand() -> None:
    # S₁ = 3, γ = 1/2, N = 1/2: K₀ = (3/2 + 1/2)/(1 + 3/2) = 4/5; P₀ = 1 + 3/2 − (3/2 + 1/2)·4/5 = 9/10; u₀ = −4/5·5.
    given = {"A": 1, "B": 1, "R": 1, "gamma": "1/2", "N": "1/2"}
    run = {"Q": 1, "Q_T": 3, "start": [5], "horizon": 1}
    for convention, P in (("value", fmpq(-9, 10)), ("cost-to-go", fmpq(9, 10)), ("xuKP", fmpq(9, 10))):
        answers = solved("lqr-backward", **given, **run, convention=convention)
        assert [answers[label][0, 0] for label in "abc"] == [fmpq(4, 5), P, -4]
        gain = solved("lqr-gain", **given, P=-3 if convention == "value" else 3, convention=convention)
        assert gain["a"][0, 0] == fmpq(4, 5)
    # With a = −4/5 s from 5: −(25 + 5·(−4) + 16) = −21, then s = 1, which costs 3, half.
    rollout = solved("lqr-reward", **given, **run, L="4/5")
    assert rollout == {"a": -21, "b": -21 - fmpq(3, 2)}
    assert rollout["b"] == fmpq(-9, 10) * 25


def test_the_letters_of_the_convention_stand_in_question_and_working() -> None:
    given = {"A": 1, "B": 1, "Q": 1, "R": 1, "start": [5], "horizon": 1, "convention": "xuKP"}
    exercise = rldrill.read({"family": "lqr-backward", "given": given})
    assert "uₜ = −Kₜxₜ" in str(exercise.question())
    assert "costs xₜᵀQₜxₜ + uₜᵀRₜuₜ" in str(exercise.question())
    assert "K₀ = (1 + 1·1·1)⁻¹" in str(exercise.working())
    assert "S" not in str(exercise.working())


def test_a_long_horizon_gives_quotients_of_fibonacci_numbers() -> None:
    # As by hand above, S is F₂₍ₖ₊₁₎/F₂ₖ₊₁ after k steps: after 20 of them 267914296/165580141. The first 12 times are
    # asked for.
    answers = solved("lqr-backward", A=1, B=1, Q=1, R=1, start=[1], horizon=20)
    assert len(answers) == 25
    assert answers["x"][0, 0] == fmpq(-267914296, 165580141)


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


def decimals(matrix: Any, count: int) -> list[list[str]]:
    return [[rounded(entry, count) for entry in line] for line in matrix.tolist()]


@pytest.mark.parametrize(
    ("A", "B", "Q", "R", "count", "gain"),
    [
        # Altair Compose, the manual of dlqr, example.
        ([[9, "0.2"], [0, 8]], [[0], [1]], [[2, 1], [1, 2]], 1, 4, [["394.6100", "16.7676"]]),
        # ControlSystems.jl, test of lqr for a discrete double integrator, h = 0.1.
        ([[1, "0.1"], [0, 1]], [[0], [1]], [[1, 0], [0, 1]], 1, 10, [["0.5890881714", "0.7118839435"]]),
        # GNU Octave's control package, test of dare: q = cᵀc with c = (1 −1).
        ([["0.4", "1.7"], ["0.9", "3.8"]], [["0.8"], ["2.1"]], [[1, -1], [-1, 1]], 3, 4, [["0.4092", "1.7283"]]),
    ],
)  # fmt: skip
def test_the_gains_of_manuals(A: Any, B: Any, Q: Any, R: Any, count: int, gain: Any) -> None:
    assert decimals(solved("lqr-infinite", A=A, B=B, Q=Q, R=R)["b"], count) == gain


DARE = {"A": [["0.4", "1.7"], ["0.9", "3.8"]], "B": [["0.8"], ["2.1"]], "R": 3}
COST_TO_GO = [["1.5354", "1.2623"], ["1.2623", "10.5596"]]


def test_the_riccati_equation_of_octaves_manual() -> None:
    # GNU Octave's control package, test of dare, as above: the solution to four decimals. Put in as the value of the
    # next time, it gives the printed gain again, also as one step of differential dynamic programming; half a unit of
    # its last place moves the gain by less than 0.0002.
    P = solved("lqr-infinite", **DARE, Q=[[1, -1], [-1, 1]])["a"]
    assert decimals(-P, 4) == COST_TO_GO
    as_rewards = [[f"-{entry}" for entry in row] for row in COST_TO_GO]
    gain = solved("lqr-gain", **DARE, P=as_rewards)["a"]
    step = solved(
        "ddp-backward",
        dynamics={"x": "0.4*x + 1.7*y + 0.8*u", "y": "0.9*x + 3.8*y + 2.1*u"}, reward="-(x - y)^2 - 3*u^2",
        state={"x": 0, "y": 0}, action={"u": 0}, gradient=[0, 0],
        hessian=[[str(2 * Rational(entry)) for entry in row] for row in as_rewards],
    )["g"]  # fmt: skip
    for matrix, sign in ((gain, 1), (step, -1)):
        found = [sign * float(rounded(entry, 9)) for entry in matrix.tolist()[0]]
        assert found == pytest.approx([0.4092, 1.7283], abs=2e-4)


def test_the_cruise_control_of_astrom_and_murray() -> None:
    # Åström & Murray 2008, section 5.4, cruise control: m = 1600, fourth gear (α = 12), T_m = 190, ω_m = 420, β = 0.4,
    # C_r = 0.01, ρ = 1.3, C_d = 0.32, A = 2.4, g = 9.8. At v = 20 the throttle is 0.1687, and the linearisation is
    # −0.0101 for the speed and 1.32 for the throttle.
    answers = solved(
        "linearise",
        dynamics={"v": "(alpha*u*T_m*(1 - beta*(alpha*v/w_m - 1)^2) - m*g*C_r - rho*C_d*A*v^2/2)/m"},
        constants={"alpha": 12, "T_m": 190, "beta": "0.4", "w_m": 420, "m": 1600, "g": "9.8", "C_r": "0.01",
                   "rho": "1.3", "C_d": "0.32", "A": "2.4"},
        state={"v": 20}, action={"u": "0.1687"},
    )  # fmt: skip
    assert decimals(answers["a"], 4) == [["-0.0101"]]
    assert decimals(answers["b"], 2) == [["1.32"]]


def test_the_inverted_pendulum_of_the_control_tutorials() -> None:
    # Control Tutorials for MATLAB and Simulink, "Inverted Pendulum: System Modeling": M = 0.5, m = 0.2, b = 0.1, l =
    # 0.3, I = 0.006, g = 9.8; (M + m)ẍ + bẋ + mlθ̈ cos θ − mlθ̇² sin θ = F and (I + ml²)θ̈ + mgl sin θ = −mlẍ cos θ,
    # solved here for ẍ and θ̈. At θ = π the printed matrices.
    answers = solved(
        "linearise",
        dynamics={
            "x": "v", "v": "(J*N + (m*l)^2*g*sin(theta)*cos(theta))/D",
            "theta": "w", "w": "-(m*l*cos(theta)*N + (M + m)*m*g*l*sin(theta))/D",
        },
        where={
            "J": "I_0 + m*l^2", "N": "F - b*v + m*l*w^2*sin(theta)", "D": "(M + m)*(I_0 + m*l^2) - (m*l*cos(theta))^2",
        },
        constants={"M": "0.5", "m": "0.2", "b": "0.1", "l": "0.3", "I_0": "0.006", "g": "9.8"},
        state={"x": 0, "v": 0, "theta": "pi", "w": 0}, action={"F": 0},
    )  # fmt: skip
    assert decimals(answers["a"], 4) == [
        ["0.0000", "1.0000", "0.0000", "0.0000"],
        ["0.0000", "-0.1818", "2.6727", "0.0000"],
        ["0.0000", "0.0000", "0.0000", "1.0000"],
        ["0.0000", "-0.4545", "31.1818", "0.0000"],
    ]
    assert decimals(answers["b"], 4) == [["0.0000"], ["1.8182"], ["0.0000"], ["4.5455"]]


HELD = {"discretisation": "zero-order hold"}


def test_the_zero_order_hold_of_the_double_integrator() -> None:
    # Åström & Wittenmark 1997, example 2.2: with the step h it is (1 h; 0 1) and (h²/2; h).
    answers = solved(
        "linearise", dynamics={"x": "v", "v": "u"}, state={"x": 0, "v": 0}, action={"u": 0}, step="1/10", **HELD
    )
    assert_is(answers["a"], [[1, Rational(1, 10)], [0, 1]])
    assert_is(answers["b"], [[Rational(1, 200)], [Rational(1, 10)]])


def test_the_zero_order_hold_of_three_integrators_by_hand() -> None:
    # The snap u moves the acceleration by h u, the velocity by h²/2 u, the position by h³/6 u; h = 6: 6, 18, 36.
    answers = solved(
        "linearise", dynamics={"x": "v", "v": "a", "a": "u"}, state={"x": 0, "v": 0, "a": 0}, action={"u": 0}, step=6,
        **HELD,
    )  # fmt: skip
    assert_is(answers["a"], [[1, 6, 18], [0, 1, 6], [0, 0, 1]])
    assert_is(answers["b"], [[36], [18], [6]])


def test_the_zero_order_hold_of_a_number() -> None:
    # Åström & Wittenmark 1997, example 2.1: dx/dt = αx + βu becomes e^(αh) and (e^(αh) − 1) β/α.
    system = {"dynamics": {"x": "3*u - 2*x"}, "state": {"x": 5}, "action": {"u": 1}, "step": "1/2"}
    answers = solved("linearise", **system, **HELD)
    assert_is(answers["a"], [[sympy.exp(-1)]])
    assert_is(answers["b"], [[Rational(3, 2) * (1 - sympy.exp(-1))]])
    # A linear system is its own linearisation, so nothing is left over.
    assert_is(solved("linearise-affine", **system, **HELD)["a"], [[0]])


def test_the_constant_term_of_a_zero_order_hold_by_hand() -> None:
    # dv/dt = w², dx/dt = v at v = 2, w = 1, with h = 2: near w = 1 dv/dt is 2w − 1, so the −1 adds −h to v, −h²/2 to x.
    answers = solved(
        "linearise-affine", dynamics={"x": "v", "v": "w^2"}, state={"x": 3, "v": 2}, action={"w": 1}, step=2, **HELD
    )
    assert_is(answers["a"], [[-2], [-2]])
    assert_is(answers["c"], [[4], [4], [0]])


def test_the_sampled_inverted_pendulum_of_michigan() -> None:
    # Control Tutorials for MATLAB and Simulink, inverted pendulum, digital control: M = 0.5, m = 0.2, b = 0.1,
    # l = 0.3, I = 0.006, g = 9.8, p = I (M + m) + M m l² = 0.0132; c2d with 0.01 s prints four digits.
    answers = solved(
        "linearise",
        dynamics={
            "x": "v", "v": "(-(I + m*l^2)*b*v + m^2*g*l^2*phi + (I + m*l^2)*u)/p",
            "phi": "omega", "omega": "(-m*l*b*v + m*g*l*(M + m)*phi + m*l*u)/p",
        },
        constants={"M": "0.5", "m": "0.2", "b": "0.1", "l": "0.3", "I": "0.006", "g": "9.8", "p": "0.0132"},
        state={"x": 0, "v": 0, "phi": 0, "omega": 0}, action={"u": 0}, step="0.01", **HELD,
    )  # fmt: skip
    printed = [
        [1, 0.009991, 0.0001336, 4.453e-07], [0, 0.9982, 0.02672, 0.0001336],
        [0, -2.272e-05, 1.002, 0.01001], [0, -0.004544, 0.3119, 1.002],
    ]  # fmt: skip
    for line, numbers in zip(written(answers["a"]), printed, strict=True):
        assert [float(entry) for entry in line] == pytest.approx(numbers, rel=6e-4)
    column = [float(entry) for (entry,) in written(answers["b"])]
    assert column == pytest.approx([9.086e-05, 0.01817, 0.0002272, 0.04544], rel=6e-4)


def test_a_hold_needs_a_step() -> None:
    with pytest.raises(FileError, match="step is missing"):
        solved("linearise", dynamics={"x": "u"}, state={"x": 0}, action={"u": 0}, **HELD)
