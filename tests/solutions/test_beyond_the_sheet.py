"""Identities of kinematics and of meta-learning."""

from statistics import median
from typing import Any

import pytest
import sympy
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

import rldrill
from asking import solved
from rldrill.audit.figures import largest
from rldrill.problems.errors import FileError
from rldrill.solutions.drawing import draw
from rldrill.solutions.effort import points
from rldrill.solutions.exact import to_sympy

angles = st.sampled_from(["0", "pi/6", "pi/3", "pi/2", "2*pi/3", "-pi/2", "pi"])
lengths = st.integers(1, 4)


def same(one: Any, other: Any) -> bool:
    return bool(sympy.simplify(to_sympy(one) - to_sympy(other)) == 0)


@given(st.lists(angles, min_size=2, max_size=3), st.lists(lengths, min_size=3, max_size=3))
@settings(deadline=None, max_examples=20)
def test_denavit_and_hartenberg_agree_with_the_planar_arm(turns: list[str], long: list[int]) -> None:
    long = long[: len(turns)]
    x, y = solved("forward-kinematics", lengths=long, angles=turns)["b"]
    links = [{"theta": t, "d": 0, "a": a, "alpha": 0} for t, a in zip(turns, long, strict=True)]
    whole = solved("denavit-hartenberg", links=links)["abcd"[len(turns)]]
    assert same(whole[0, 3], x)
    assert same(whole[1, 3], y)


@given(st.integers(0, 10_000))
@settings(deadline=None, max_examples=15)
def test_a_transform_keeps_lengths_and_handedness(seed: int) -> None:
    links = draw("denavit-hartenberg", 3, seed).problem.data()["given"]["links"]
    for transform in solved("denavit-hartenberg", links=links).values():
        turn = sympy.Matrix(3, 3, lambda i, j: to_sympy(transform[i, j]))  # noqa: B023
        assert sympy.simplify(turn.T * turn) == sympy.eye(3)
        assert sympy.simplify(turn.det()) == 1


@given(angles, angles, lengths, lengths)
@settings(deadline=None, max_examples=20)
def test_two_links_are_singular_when_stretched_or_folded(one: str, two: str, first: int, second: int) -> None:
    answers = solved("jacobian", lengths=[first, second], angles=[one, two], rates=[1, 1])
    J = sympy.Matrix(2, 2, lambda i, j: to_sympy(answers["a"][i, j]))
    assert (sympy.simplify(J.det()) == 0) is answers["c"]
    assert answers["c"] is (two in ("0", "pi"))


def test_a_jacobian_that_is_not_square_is_not_asked_about() -> None:
    assert set(solved("jacobian", lengths=[1, 1, 1], angles=[0, 0, 0], rates=[1, 1, 1])) == {"a", "b"}


@given(st.integers(0, 10_000), st.fractions("1/10", 1, max_denominator=10))
@settings(deadline=None, max_examples=20)
def test_an_open_step_size_agrees_with_a_closed_one(seed: int, alpha: Any) -> None:
    given_ = draw("maml-step", 2, seed).problem.data()["given"]
    opened = solved("maml-step", **given_ | {"alpha": "alpha"})["b"]
    closed = solved("maml-step", **given_ | {"alpha": str(alpha)})["b"]
    here = to_sympy(opened).subs(sympy.Symbol("alpha", positive=True), sympy.Rational(alpha))
    assert sympy.simplify(here - to_sympy(closed)) == 0


def test_a_task_that_is_learnt_in_one_step_teaches_nothing() -> None:
    # α c = 1: the adapted parameter is the best one, whatever θ was.
    answers = solved("maml-step", theta=7, tasks=[[2, 3]], alpha="1/2", beta="1/10")
    assert answers == {"a": fmpq(3), "b": fmpq(7)}


@pytest.mark.parametrize(
    ("family", "given_", "message"),
    [
        ("forward-kinematics", {"lengths": [1, 0], "angles": [0, 0]}, "not above 0"),
        ("forward-kinematics", {"lengths": [1, 1], "angles": [0]}, "angles holds 1"),
        ("forward-kinematics", {"lengths": [1, 1], "angles": [0, "x"]}, "pi/6"),
        ("jacobian", {"lengths": [1, 1], "angles": [0, 0], "rates": [1]}, "rates holds 1"),
        ("denavit-hartenberg", {"links": []}, "given.links"),
        ("maml-step", {"theta": 0, "tasks": [[0, 1]], "alpha": "1/2", "beta": 1}, "curvature"),
        ("maml-step", {"theta": 0, "tasks": [[1, 1]], "alpha": "1/2", "beta": 0}, "beta"),
    ],
)
def test_wrong_givens_are_one_sentence(family: str, given_: dict[str, Any], message: str) -> None:
    with pytest.raises(FileError, match=message):
        solved(family, **given_)


def test_the_parameter_that_maml_leaves_alone_and_the_step_that_it_took() -> None:
    # α = 1/2, tasks (1, 0) and (3, 4): the slopes are 1/2 and −1/2; θ′ = θ/2 and 6 − θ/2; the gradient
    # θ/4 − 3/2·(2 − θ/2) = θ − 3 is zero at 3.
    tasks = [[1, 0], [3, 4]]
    assert solved("maml-step", tasks=tasks, alpha="1/2") == {"a": (fmpq(1, 2), fmpq(-1, 2)), "b": 3}
    # From θ = 2 the gradient is −1: θ becomes 2 + β, 9/4 for β = 1/4.
    answers = solved("maml-step", theta=2, tasks=tasks, alpha="1/2", after="9/4")
    assert answers == {"a": (1, 5), "b": fmpq(1, 4)}
    # First-order MAML adds 1·(1 − 0) and 3·(5 − 4) instead: 2 − 1/4·4 = 1.
    answers = solved("maml-step", theta=2, tasks=tasks, alpha="1/2", beta="1/4", first_order=True)
    assert (answers["b"], answers["c"]) == (fmpq(9, 4), 1)


def test_the_rotation_and_the_origin_of_a_pose_are_worked_out_in_parts_of_their_own() -> None:
    """Two links: two rotations and their product; two origins and the sum of one with the other turned."""
    for seed in range(20):
        solution = draw("denavit-hartenberg", 2, seed)
        if solution.problem.given.asked == "pose":  # type: ignore[attr-defined]
            rotation, origin = points(solution).values()
            assert 2 <= origin <= rotation <= 3 * origin


def test_the_numbers_of_a_maml_step_grow_with_the_level() -> None:
    first, second = (median(largest(draw("maml-step", level, seed)) for seed in range(120)) for level in (1, 2))
    assert first <= second


def test_a_figure_with_a_length_that_is_not_known_says_that_it_is_not_to_scale() -> None:
    for level in (1, 2, 3):
        for seed in range(20):
            exercise = rldrill.draw("forward-kinematics", level, seed)
            is_open = "w" in map(str, exercise.problem.given.lengths)  # type: ignore[attr-defined]
            text = " ".join(str(exercise.question()).split())
            assert ("not to scale" in text) == is_open


def test_the_outer_step_of_maml_says_which_derivative_it_takes() -> None:
    for level in (1, 2, 3):
        for seed in range(8):
            exercise = rldrill.draw("maml-step", level, seed)
            working = str(exercise.working())
            assert "∇_θLᵢ(θ)" in working
            assert working.count("dJ/dθ = Σᵢ") == 1, exercise.id


def test_the_velocities_of_two_joints_by_hand() -> None:
    # Angles 45° and 135°: J = √2/2·(−9, −3; 3, −3), det J = 1/2·(27 + 9) = 18; J·(3√2, −√2) = (−27 + 3, 9 + 3).
    answers = solved("jacobian", lengths=[6, 3], angles=["pi/4", "pi/2"], velocity=[-24, 12])
    assert same(answers["b"][0], 3 * sympy.sqrt(2))
    assert same(answers["b"][1], -sympy.sqrt(2))


def test_no_joint_velocities_are_found_where_the_arm_is_stretched_out() -> None:
    with pytest.raises(FileError, match="the configuration is singular"):
        solved("jacobian", lengths=[1, 2], angles=["pi/6", 0], velocity=[1, 1])


@pytest.mark.parametrize(
    ("base", "seen"), [(None, "base"), ([[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], "world")]
)
def test_poses_are_told_in_the_frame_of_the_world_where_the_base_has_a_place_in_it(base: Any, seen: str) -> None:
    link = {"theta": "pi/2", "d": 0, "a": 1, "alpha": 0}
    given = {"links": [link, link], "frames": True} | ({"base": base} if base else {})
    asked = rldrill.read({"family": "denavit-hartenberg", "given": given}).parts[-1].ask
    assert asked.endswith(f"of the frame of link $2$ to those of the {seen}?")
