"""What a working says before its lines, and the lines that earn the marks. All numbers are worked out by hand."""

from typing import Any

import pytest

import rldrill
from rldrill.problems.catalogue import families, family
from rldrill.solutions.work import Equality, Note, Result, Step


def written(name: str, given: dict[str, Any], part: str | None = None) -> list[str]:
    """The lines of a working, each without the spaces and the sign that it begins with."""
    exercise = rldrill.read({"family": name, "given": given})
    working = exercise.working() if part is None else exercise.working(part)
    return [" ".join(line.split()).removeprefix("= ") for line in str(working).splitlines() if line.strip()]


def in_order(lines: list[str], *wanted: str) -> bool:
    """Whether these lines stand there one behind the other."""
    return any(lines[start : start + len(wanted)] == list(wanted) for start in range(len(lines)))


RUN = {"states": ["rim", "floor", "floor", "cave"], "rewards": [-1, 9, 7], "actions": []}
PRICED = {"A": [[1, 0], [1, 1]], "B": [[1], [1]], "R": [["rho"]], "P": [[-3, 0], [0, -4]], "gamma": "1/2"}


@pytest.mark.parametrize(
    ("name", "given", "told"),
    [
        (
            "n-step-return",  # −1 + γ·(−4) = −4
            {"trajectory": RUN, "values": {"rim": 4, "floor": -4, "cave": -4}, "gamma": "gamma",
             "asked": [[0, 1], [1, 2]], "known": -4},
            ("R₀⁽¹⁾ must be −4:", "−1 − 4γ = −4", "4γ = 3", "γ = 3/4"),
        ),
        (
            "lqr-gain",  # the gain is [7 4]/(7 + 2ρ), the action −(14 + 12)/(7 + 2ρ)
            {**PRICED, "start": [2, 3], "action": -2},
            ("a₀ must be −2:", "−26/(7 + 2ρ) = −2", "−13 = −7 − 2ρ"),
        ),
        (
            "return",  # x + 1/2 + 9/4 + x/8
            {"rewards": ["x", 1, 9, "x"], "gamma": "1/2", "known": "67/8"},
            ("R₀ must be 67/8:", "11/4 + 9/8·x = 67/8", "9/8·x = 45/8", "x = 5"),
        ),
        (
            "forward-kinematics",  # w cos(120°) + 4 cos(0°)
            {"lengths": ["w", 4], "angles": ["2*pi/3", "-2*pi/3"], "x": "3/2"},
            ("x must be 3/2:", "4 − 1/2·w = 3/2", "1/2·w = 5/2", "w = 5"),
        ),
    ],
)  # fmt: skip
def test_it_is_said_what_must_be_what(name: str, given: dict[str, Any], told: tuple[str, ...]) -> None:
    assert in_order(written(name, given), *told)


#: Where an equation begins right below a step: the step itself ends in what is set equal, or it is a definition.
BELOW_A_STEP = {"ppo-clip", "linearise", "lqr-infinite"}


@pytest.mark.parametrize("name", sorted({*families()} - BELOW_A_STEP))
def test_no_equation_stands_there_unannounced(name: str) -> None:
    for level in family(name).levels:
        for seed in range(6):
            exercise = rldrill.draw(name, level, seed)
            for part in exercise.parts:
                before: Any = None
                for line in exercise.solution.lines_of(part.label):
                    if isinstance(line, Equality):
                        assert not isinstance(before, Step | Result), f"{exercise.id} {part.label}"
                    before = line


def test_the_outer_step_of_maml_is_multiplied_out_task_by_task() -> None:
    # θ′₁ = 1 − 2α(1 + 1), θ′₂ = 1 − α(1 − 4); the gradient is (1 − 2α)·2·(2 − 4α) + (1 − α)(−3 + 3α).
    given = {"theta": 1, "tasks": [[2, -1], [1, 4]], "alpha": "alpha", "beta": "1/2"}
    assert written("maml-step", given, "b")[-6:] == [
        "θ ← 1 − 1/2·((1 − α·2)·2·(1 − 4α − (−1)) + (1 − α·1)·1·(1 + 3α − 4))",
        "1 − 1/2·((1 − 2α)·2·(2 − 4α) + (1 − α)·(−3 + 3α))",
        "1 − 1/2·(4 − 16α + 16α² − 3 + 6α − 3α²)",
        "1 − 1/2·(1 − 10α + 13α²)",
        "1 − 1/2 + 5α − 13/2·α²",
        "1/2 + 5α − 13/2·α²",
    ]
    # From θ = 0 with β = 1 neither is written: θ′₁ = 6α and θ′₂ = −α.
    given = {"theta": 0, "tasks": [[3, 2], [1, -1]], "alpha": "alpha", "beta": 1}
    assert "−((1 − 3α)·3·(−2 + 6α) + (1 − α)·(1 − α))" in written("maml-step", given, "b")


def test_the_determinant_of_two_joints_is_that_of_the_matrix_that_was_found() -> None:
    # Folded back: x = (3 − 1)·cos, y = (3 − 1)·sin at 90°.
    given = {"lengths": [3, 1], "angles": ["pi/2", "pi"], "rates": [-1, 2]}
    assert written("jacobian", given, "c")[-3:] == [
        "det J = −2·0 − 1·0", "0", "det J = 0: the configuration is singular.",
    ]  # fmt: skip
    # At a right angle, l₁ = 2 along x and l₂ = 1 along y: J = (−1, −1; 2, 0).
    given = {"lengths": [2, 1], "angles": ["0", "pi/2"], "rates": [1, 1]}
    assert written("jacobian", given, "c")[-2:] == ["2", "det J ≠ 0: the configuration is not singular."]


def test_the_bound_from_the_first_change_is_derived() -> None:
    given = {"start": {"a": 0, "b": 0}, "first": {"a": 1, "b": 2}, "gamma": "1/2", "sweeps": 2, "accuracy": 1}
    (said,) = (line.said for line in rldrill.read({"family": "contraction", "given": given}).solution.lines_of("b")
               if isinstance(line, Note))  # fmt: skip
    assert isinstance(said, str)
    assert said.startswith("By the triangle inequality $‖V_0 − V^*‖_∞ ≤ ‖V_0 − V_1‖_∞ + ‖V_1 − V^*‖_∞$")


def test_what_cannot_be_worth_so_much_is_said_before_the_equation() -> None:
    # After one sweep driving from the slope is worth −2 + 2/3·6 = 2, climbing −2 + 2/3·y.
    mdp = {"transitions": [
        ["rim", "drive", "slope", 1, -6], ["rim", "climb", "rim", 1, "x"],
        ["slope", "drive", "floor", 1, -2], ["slope", "climb", "rim", 1, -2],
        ["floor", "drive", "lander", 1, 4], ["floor", "climb", "slope", 1, -4],
    ], "terminal": ["lander"]}  # fmt: skip
    given = {"mdp": mdp, "gamma": "2/3", "start": {"rim": 12, "slope": 15, "floor": 21}, "outcome": {"slope": 10}}
    lines = written("value-iteration", given, "a")
    said = "Drive is worth less than V₂(slope) = 10, so climb must be worth that:"
    assert in_order(lines, said, "−2 + 2/3·y = 10", "2/3·y = 12", "y = 18")
    assert lines[-1] == "y = 18"


def test_a_derivative_that_is_zero_here_is_not_one_of_the_others() -> None:
    # At the wanted speed the reward's slope is −2·2·(2 − 2) = 0, written down; there is no other state.
    given = {
        "dynamics": {"v": "v + τ*(u - c*v^2)"}, "reward": "-(q*(v - w)^2 + p*u^2)",
        "constants": {"τ": "1/2", "c": 1, "q": 2, "p": 2, "w": 2}, "state": {"v": 2}, "action": {"u": 2},
        "gradient": [2], "hessian": [[-1]],
    }  # fmt: skip
    assert not [line for line in written("ddp-backward", given) if "other derivatives" in line]


def test_sums_in_exponents_are_taken_apart_before_they_are_used() -> None:
    features = {"fast": [1, 0, 0], "slow": [0, 0, 1], "brake": [0, 2, 1]}
    lines = written("softmax-policy", {"theta": ["ln 2", "ln 2", "ln 3"], "features": features}, "b")
    assert lines[0] == "Since exp(ln b) = b, exp(2 ln 2 + ln 3) = 2²·3 = 12."
    lines = written("softmax-policy", {"theta": ["ln 2", "ln x"], "features": {"a": [1, 1], "b": [0, 2]}}, "b")
    assert lines[0] == "Since exp(ln b) = b, exp(ln 2 + ln x) = 2x and exp(2 ln x) = x²."
    lines = written("softmax-policy", {"theta": ["ln 2"], "features": {"a": [1], "b": [0]}}, "b")
    assert not lines[0].startswith("Since")


def test_a_greedy_action_follows_from_the_weight_of_equal_values() -> None:
    # In x: 7w + 6 against 2w, equal at −6/5; in y: 9 against 3w, equal at 3; at 3 both are greedy in y.
    features = {"x": {"sail": [7, -2], "drift": [2, 0]}, "y": {"sail": [0, -3], "drift": [3, 0]}}
    given = {"theta": ["w", -3], "features": features}
    text = " ".join(written("linear-policy", given | {"at": "5/2"}, "b"))
    assert "In x, w = 5/2 is above −6/5, where sail is greedy: as w grows, it gains on drift. In y," in text
    assert text.endswith("w = 5/2 is below 3, where sail is greedy: as w grows, drift gains on it.")
    text = " ".join(written("linear-policy", given | {"at": 3}, "b"))
    assert text.endswith("In y, w = 3, where both actions have the same value: both are greedy.")


def test_probabilities_in_terms_of_an_exploration_rate_are_not_found_again_when_it_is() -> None:
    # Two actions, a the better one: 1 − ε/2 and ε/2. V = 4·(1 − ε/2) + 0 = 3 at ε = 1/2.
    given = {"state": "s", "values": {"a": 4, "b": 0}, "epsilon": "epsilon", "state_value": 3}
    lines = written("epsilon-greedy", given, "b")
    assert in_order(lines, "π(a|s) = 1 − 1/2·ε", "1 − 1/2·1/2", "1 − 1/4", "3/4", "π(b|s) = 1/2·ε", "1/2·1/2", "1/4")
    assert "greedy action" not in " ".join(lines)


def test_sums_of_rewards_are_written_down() -> None:
    given = {"rewards": [-2, 8, -3], "others": [-3, -4, 5, 6], "gamma": "2/3"}
    said = " ".join(written("return", given, "b"))
    assert "R₀ = −2 + 8 − 3 = 3 and R′₀ = −3 − 4 + 5 + 6 = 4: that of the second episode is larger." in said


def test_the_mean_under_an_open_exploration_rate_is_multiplied_out() -> None:
    # Of 5, 15 and −5 with ε/3, 1 − 2ε/3 and ε/3.
    given = {
        "trajectory": {"states": ["warm", "cool"], "actions": ["slow", "fast"], "rewards": [2]},
        "values": {"cool": {"fast": 5, "slow": 15, "brake": -5}, "warm": {"fast": 10, "slow": 15, "brake": 13}},
        "alpha": "1/2", "gamma": "4/5", "epsilon": "epsilon",
    }  # fmt: skip
    first = "1/3·ε·5 + (1 − 2/3·ε)·15 + 1/3·ε·(−5) = 5/3·ε + 15 − 10ε − 5/3·ε"
    assert in_order(written("expected-sarsa", given), first, "15 − 10ε")


def test_one_planned_update_has_no_number_and_the_model_learns_after_the_real_one() -> None:
    given = {
        "trajectory": {"states": ["cool", "warm"], "actions": ["fast"], "rewards": [-2]},
        "values": {"cool": {"fast": 12, "slow": 4}, "warm": {"fast": 8, "slow": 4}},
        "alpha": "1/2", "gamma": "1/4", "model": [["warm", "slow", -2, "cool"]], "planned": [["warm", "slow"]],
    }  # fmt: skip
    text = " ".join(written("dyna-q", given))
    assert text.index("12 + 1/2·") < text.index("The model now holds what has followed, r̂(sₜ, aₜ) ← rₜ₊₁")
    assert "Planned update, of the pair (warm, slow);" in text
    text = " ".join(written("dyna-q", given | {"planned": [["warm", "slow"], ["cool", "fast"]]}))
    assert "Planned update 2, of the pair (cool, fast);" in text


@pytest.mark.parametrize(
    ("row", "said"),
    [
        ({"x": 5, "y": 4}, "in b, x has the greater value, 5"),
        ({"x": 5, "y": 4, "z": 1}, "in b, x has the greatest value, 5"),
        ({"x": 5, "y": 5}, "in b, x and y have the same value, 5"),
        ({"x": 5, "y": 5, "z": 1}, "in b, x and y have the same greatest value, 5"),
    ],
)
def test_of_two_values_that_are_equal_none_is_the_greater(row: dict[str, int], said: str) -> None:
    given = {
        "trajectory": {"states": ["a", "b"], "actions": ["x"], "rewards": [1]},
        "values": {"a": dict.fromkeys(row, 0), "b": row}, "alpha": "1/2", "gamma": "1/2",
        "model": [["a", "y", 2, "b"]], "planned": [["a", "y"]],
    }  # fmt: skip
    text = " ".join(written("dyna-q", given))
    assert f"Real update at t = 0, of the pair (a, x); {said}:" in text
    assert f"next state b, and {said}:" in text


def test_a_link_that_neither_turns_nor_twists_shifts_alone() -> None:
    # p₁ = (3, 4, 5) − (1, 0, 2), and back from (2, 4, 3) the same sum.
    links = [{"theta": 0, "d": 2, "a": 1, "alpha": 0}]
    for asked, point, answer in (("back", [3, 4, 5], (2, 4, 3)), ("point", [2, 4, 3], (3, 4, 5))):
        exercise = rldrill.read(
            {"family": "denavit-hartenberg", "given": {"links": links, "asked": asked, "point": point}}
        )
        assert exercise.solve() == {"a": answer}
        assert "Link 1 neither turns nor twists: R₁ is the identity, and o₁ = (1, 0, 2)ᵀ." in str(exercise.working())
        assert "cos" not in str(exercise.working())
        assert [part.points for part in exercise.parts] == [1]
