"""Published or hand-checkable numbers of kinematics and of MAML."""

from typing import Any

import pytest
import sympy
from flint import fmpq
from sympy import Rational, pi, sqrt

from asking import rounded, solved
from rldrill.problems.errors import FileError
from rldrill.solutions.exact import to_sympy


def assert_is(matrix: Any, expected: list[list[Any]]) -> None:
    found = [[to_sympy(entry) for entry in line] for line in matrix.tolist()]
    assert [len(line) for line in found] == [len(line) for line in expected]
    for line, wanted in zip(found, expected, strict=True):
        assert all(sympy.simplify(a - b) == 0 for a, b in zip(line, wanted, strict=True)), (found, expected)


def test_the_planar_arm_of_siciliano() -> None:
    # Siciliano et al. 2009, section 2.9.1: x = l₁c₁ + l₂c₁₂, y = l₁s₁ + l₂s₁₂; l = (2, 1), θ = (π/6, π/3):
    # c₁ = √3/2, s₁ = 1/2, c₁₂ = 0, s₁₂ = 1.
    answers = solved("forward-kinematics", lengths=[2, 1], angles=["pi/6", "pi/3"])
    assert answers["a"] == pi / 2
    assert answers["b"] == (sqrt(3), 2)


def test_the_jacobian_of_craig_and_siciliano() -> None:
    # Craig 2005, section 5.7, and Siciliano et al. 2009, section 3.2.1, for two links:
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
    # Finn, Abbeel & Levine 2017, eq. 1, for L = ½ (θ − 4)² and α = β = 1/2, θ = 0: θ′ = 0 − ½·(−4) = 2;
    # the gradient of ½ (θ′ − 4)² by θ is (1 − ½)·(2 − 4) = −1; θ becomes 1/2.
    answers = solved("maml-step", theta=0, tasks=[[1, 4]], alpha="1/2", beta="1/2")
    assert answers == {"a": fmpq(2), "b": fmpq(1, 2)}


def test_the_planar_arm_of_corke() -> None:
    # Corke, Robotics, Vision and Control, the two-joint arm with a1 = a2 = 1: fkine at 30 and 40 degrees is x = 1.208,
    # y = 1.44, at 70 degrees.
    answers = solved("forward-kinematics", lengths=[1, 1], angles=["pi/6", "2*pi/9"])
    assert rounded(answers["a"] * 180 / pi, 0) == "70"
    assert (rounded(answers["b"][0], 3), rounded(answers["b"][1], 2)) == ("1.208", "1.44")


@pytest.mark.parametrize(
    ("elbow", "printed"),
    # Lynch & Park 2017, introduction to chapter 5: the 2R arm with L1 = L2 = 1 at θ = (0, π/4) and (0, 3π/4).
    [("pi/4", [["-0.71", "-0.71"], ["1.71", "0.71"]]), ("3*pi/4", [["-0.71", "-0.71"], ["0.29", "-0.71"]])],
)
def test_the_jacobian_of_modern_robotics(elbow: str, printed: list[list[str]]) -> None:
    jacobian = solved("jacobian", lengths=[1, 1], angles=[0, elbow], rates=[1, 1])["a"]
    assert [[rounded(entry, 2) for entry in row] for row in jacobian.tolist()] == printed


# Link by link: d, a and α.
PUMA = [
    (0, 0, "pi/2"), (0, "0.4318", 0), ("0.15005", "0.0203", "-pi/2"),
    ("0.4318", 0, "pi/2"), (0, 0, "-pi/2"), (0, 0, 0),
]  # fmt: skip
UR5 = [
    ("0.089", 0, "pi/2"), (0, "-0.425", 0), (0, "-0.392", 0),
    ("0.109", 0, "pi/2"), ("0.095", 0, "-pi/2"), ("0.082", 0, 0),
]  # fmt: skip


@pytest.mark.parametrize(
    ("arm", "angles", "printed"),
    [
        # Corke, Robotics, Vision and Control, section on the forward kinematics of the Puma 560: fkine(qz) and
        # fkine(qn).
        (PUMA, [0] * 6, [[1, 0, 0, 0.4521], [0, 1, 0, -0.15], [0, 0, 1, 0.4318], [0, 0, 0, 1]]),
        (PUMA, [0, "pi/4", "pi", 0, "pi/4", 0],
         [[0, 0, 1, 0.5963], [0, 1, 0, -0.15], [-1, 0, 0, -0.0144], [0, 0, 0, 1]]),
        # Lynch & Park 2017, example 4.5: the UR5 at θ2 = -π/2 and θ5 = π/2; the book has its base turned by π, so θ1 =
        # π.
        (UR5, ["pi", "-pi/2", 0, 0, "pi/2", 0],
         [[0, -1, 0, 0.095], [1, 0, 0, 0.109], [0, 0, 1, 0.988], [0, 0, 0, 1]]),
    ],
)  # fmt: skip
def test_six_links(arm: Any, angles: Any, printed: Any) -> None:
    links = [{"theta": theta, "d": d, "a": a, "alpha": alpha} for theta, (d, a, alpha) in zip(angles, arm, strict=True)]
    *_, product = solved("denavit-hartenberg", links=links).values()
    for row, wanted in zip(product.tolist(), printed, strict=True):
        assert [float(rounded(entry, 9)) for entry in row] == pytest.approx(wanted, abs=6e-5)


def test_maml_on_a_parabola_in_jaxs_documentation() -> None:
    # The notebook on MAML in JAX's documentation: g(x) = x² at x = 2 has the gradient 4; after a step of 1 it is at −2;
    # the gradient of the objective g(x − g′(x)) = x² is 4 again, and x less this is −2. So c = 2, m = 0 and α = β = 1.
    assert solved("maml-step", theta=2, tasks=[[2, 0]], alpha=1, beta=1) == {"a": -2, "b": -2}


def test_the_elbow_of_the_planar_arm_and_a_base_that_is_turned() -> None:
    # The arm of Siciliano above: its first link ends at (2 cos π/6, 2 sin π/6) = (√3, 1). On a base at (1, −1), turned
    # by π/2, that becomes (1 − 1, −1 + √3), and the end (√3, 2) becomes (1 − 2, −1 + √3).
    arm: dict[str, Any] = {"lengths": [2, 1], "angles": ["pi/6", "pi/3"], "frames": True}
    answers = solved("forward-kinematics", **arm)
    assert answers == {"a": pi / 6, "b": (sqrt(3), 1), "c": pi / 2, "d": (sqrt(3), 2)}
    moved = solved("forward-kinematics", **arm, base={"x": 1, "y": -1, "phi": "pi/2"})
    assert (moved["a"], moved["c"]) == (2 * pi / 3, pi)
    ends = [to_sympy(entry) for label in "bd" for entry in moved[label]]
    assert all(sympy.simplify(a - b) == 0 for a, b in zip(ends, [0, sqrt(3) - 1, -1, sqrt(3) - 1], strict=True))


def test_an_arm_of_one_link() -> None:
    assert solved("forward-kinematics", lengths=[2], angles=["pi/2"]) == {"a": pi / 2, "b": (0, 2)}
    answers = solved("jacobian", lengths=[2], angles=["pi/2"], rates=[3])
    assert_is(answers["a"], [[-2], [0]])
    assert answers["b"] == (-6, 0)


BASE = [[0, -1, 0, 5], [1, 0, 0, 6], [0, 0, 1, 7], [0, 0, 0, 1]]


def test_the_frames_of_two_links_on_a_base_by_hand() -> None:
    # Both links turn by π/2 and go 1 along their own x: from the origin to (0, 1), then to (−1, 1), turned by π. The
    # base takes (x, y) to (5 − y, 6 + x) and turns by another π/2.
    link = {"theta": "pi/2", "d": 0, "a": 1, "alpha": 0}
    answers = solved("denavit-hartenberg", links=[link, link], base=BASE, frames=True)
    assert_is(answers["a"], [[0, -1, 0, 0], [1, 0, 0, 1], [0, 0, 1, 0], [0, 0, 0, 1]])
    assert_is(answers["c"], [[-1, 0, 0, 4], [0, -1, 0, 6], [0, 0, 1, 7], [0, 0, 0, 1]])
    assert_is(answers["d"], [[0, 1, 0, 4], [-1, 0, 0, 5], [0, 0, 1, 7], [0, 0, 0, 1]])
    last = solved("denavit-hartenberg", links=[link, link], base=BASE)
    assert last["c"] == answers["d"]


@pytest.mark.parametrize(
    ("base", "message"),
    [
        ([[1]], "base is 1×1, but it must be 4×4"),
        ([*BASE[:3], [0, 0, 1, 1]], "the last row of a transform is 0, 0, 0, 1"),
        ([[2, 0, 0, 0], *BASE[1:]], "its 3×3 corner must be a rotation"),
        ([[0, 1, 0, 0], *BASE[1:]], "its 3×3 corner must be a rotation"),  # a reflection
    ],
)
def test_bases_that_are_no_transforms(base: Any, message: str) -> None:
    link = {"theta": "pi/2", "d": 0, "a": 1, "alpha": 0}
    with pytest.raises(FileError, match=message):
        solved("denavit-hartenberg", links=[link], base=base)


def test_a_point_through_a_link_and_back_by_hand() -> None:
    # θ = π/2, d = 1, a = 2, α = π/2: x′ = (0, 1, 0), y′ = (0, 0, 1), z′ = (1, 0, 0), origin (0, 2, 1). The point
    # (1, 2, 3) is (0, 2, 1) + 1·(0, 1, 0) + 2·(0, 0, 1) + 3·(1, 0, 0) = (3, 3, 3).
    link = {"theta": "pi/2", "d": 1, "a": 2, "alpha": "pi/2"}
    assert solved("denavit-hartenberg", links=[link], asked="point", point=[1, 2, 3])["a"] == (3, 3, 3)
    assert solved("denavit-hartenberg", links=[link], asked="back", point=[3, 3, 3])["a"] == (1, 2, 3)
    pose = solved("denavit-hartenberg", links=[link], asked="pose")
    assert pose["a"].tolist() == [[0, 0, 1], [1, 0, 0], [0, 1, 0]]
    assert pose["b"] == (0, 2, 1)


def test_the_velocities_of_joints_by_hand() -> None:
    # θ = (0, π/2), l = (2, 1): the end (2, 1), so J = (−1, −1; 2, 0). v = (1, 4): ω₁ = 2, −2 − ω₂ = 1, so ω₂ = −3.
    arm = {"lengths": [2, 1], "angles": [0, "pi/2"]}
    assert solved("jacobian", **arm, velocity=[1, 4])["b"] == (2, -3)
    with pytest.raises(FileError, match="the configuration is singular"):
        solved("jacobian", lengths=[2, 1], angles=[0, 0], velocity=[1, 4])


def test_the_length_of_a_link_by_hand() -> None:
    # Angles 60° and 60° + 60° = 120°: x = 3/2 − w/2 = 1/2 gives w = 2; y = 3·√3/2 + 2·√3/2.
    answers = solved("forward-kinematics", lengths=[3, "w"], angles=["pi/3", "pi/3"], x="1/2")
    assert answers["a"] == 2
    assert sympy.simplify(answers["b"] - 5 * sympy.sqrt(3) / 2) == 0
