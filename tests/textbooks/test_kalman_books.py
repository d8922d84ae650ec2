"""Kalman filters of books, courses and tutorials, to the digits they print."""

from fractions import Fraction
from typing import Any

import pytest
from flint import fmpq

import rldrill
from asking import rounded, solved
from rldrill.problems.errors import FileError

ONE_METRE = {"A": [[1, 1], [0, 1]], "C": [[1, 0]]}


def filtered(readings: list[Any], **given: Any) -> list[tuple[Any, Any]]:
    """All beliefs of a filter in one dimension without commands."""
    return list(solved("kalman-filter", steps=[{"z": z} for z in readings], **given).values())


def flat(matrix: Any) -> list[Any]:
    return [entry for row in matrix.tolist() for entry in row]


def test_fusing_two_measurements_by_hand() -> None:
    # A belief of mean 10 and variance 8 that does not move, and a reading of 13 of variance 4: the weights are the
    # inverse variances 1/8 and 1/4, so (10 + 2·13)/3 = 12, with variance 8/3.
    step = {"u": 0, "z": 13}
    answers = solved("kalman-filter", mean=10, covariance=8, process=0, sensor=4, steps=[step])
    assert answers == {"a": (fmpq(10), fmpq(8)), "b": (fmpq(12), fmpq(8, 3))}


def test_the_random_walk_of_russell_and_norvig() -> None:
    # Russell & Norvig 2010, section 15.4.2: μ0 = 0, σ0 = 1.5, σx = 2, σz = 1, first reading 2.5.
    # Their update in one dimension gives ((σ0² + σx²) z + σz² μ0)/(σ0² + σx² + σz²) = (25/4 · 5/2)/(29/4) = 125/58 and
    # the variance (25/4 · 1)/(29/4) = 25/29.
    step = {"u": 0, "z": "2.5"}
    answers = solved("kalman-filter", mean=0, covariance="2.25", process=4, sensor=1, steps=[step])
    assert answers["b"] == (fmpq(125, 58), fmpq(25, 29))


def test_update_and_predict_of_thruns_course() -> None:
    # Thrun, Artificial Intelligence for Robotics (Udacity CS373), lesson 2: update(10, 8, 13, 2) is [12.4, 1.6] and
    # predict(10, 4, 12, 4) is [22, 8].
    answers = solved("kalman-filter", mean=10, covariance=8, process=0, sensor=2, steps=[{"u": 0, "z": 13}])
    assert answers["b"] == (fmpq(124, 10), fmpq(16, 10))
    assert solved("kalman-filter", mean=10, covariance=4, process=4, sensor=1, steps=[{"u": 12}])["a"] == (22, 8)


def test_five_readings_of_thruns_course() -> None:
    # Lesson 2 again: readings 5, 6, 7, 9, 10 of variance 4, moves 1, 1, 2, 1, 1 of variance 2, from N(0, 10000). The
    # course updates first; so the first motion here only brings the variance from 9998 to 10000.
    steps = [{"u": u, "z": z} for u, z in ((0, 5), (1, 6), (1, 7), (2, 9), (1, 10))]
    beliefs = list(solved("kalman-filter", mean=0, covariance=9998, process=2, sensor=4, steps=steps).values())
    printed = [
        ("4.998001", "3.998401"), ("5.998001", "5.998401"),
        ("5.999200", "2.399744"), ("6.999200", "4.399744"),
        ("6.999619", "2.095180"), ("8.999619", "4.095180"),
        ("8.999812", "2.023515"), ("9.999812", "4.023515"),
        ("9.999906", "2.005862"),
    ]  # fmt: skip
    assert [(rounded(mean, 6), rounded(variance, 6)) for mean, variance in beliefs[1:]] == printed


def test_a_velocity_that_is_not_measured_in_thruns_course() -> None:
    # Lesson 2, the last programming quiz: position and velocity, P = 1000 I, readings 1, 2, 3 of variance 1, no process
    # noise; printed after a last prediction. The course updates first: A P Aᵀ = 1000 I needs P = 1000 (2 −1; −1 1).
    beliefs = solved(
        "kalman-filter", **ONE_METRE, B=[[0], [0]],
        mean=[[0], [0]], covariance=[[2000, -1000], [-1000, 1000]], process=[[0, 0], [0, 0]], sensor=1,
        steps=[{"u": 0, "z": 1}, {"u": 0, "z": 2}, {"u": 0, "z": 3}, {"u": 0}],
    )  # fmt: skip
    assert [rounded(value, 10) for value in flat(beliefs["p"])] == ["3.9996664448", "0.9999998336"]
    printed = ["2.3318904241", "0.9991676100", "0.9991676100", "0.4995005826"]
    assert [rounded(value, 10) for value in flat(beliefs["q"])] == printed


def test_the_height_of_a_building() -> None:
    # Becker, kalmanfilter.net, example 5: from 60 ± 15 m, an altimeter of ± 5 m; the first gain is 0.9, which gives
    # 49.69 and 22.5; after ten readings the height is 49.57.
    readings = ["48.54", "47.11", "55.01", "55.15", "49.89", "40.85", "46.72", "50.05", "51.27", "49.95"]
    beliefs = filtered(readings, mean=60, covariance=225, process=0, sensor=25)
    mean, variance = beliefs[1]
    assert (rounded(mean, 2), rounded(variance, 1)) == ("49.69", "22.5")
    assert rounded(beliefs[-1][0], 2) == "49.57"


def test_the_temperature_of_a_liquid() -> None:
    # Becker, kalmanfilter.net, example 6: from 10 ± 100 °C, q = 0.0001, r = 0.01; 10000.0001 is predicted first, and
    # after ten readings the estimate is 49.988 with the variance 0.0013.
    readings = ["49.95", "49.967", "50.1", "50.106", "49.992", "49.819", "49.933", "50.007", "50.023", "49.99"]
    beliefs = filtered(readings, mean=10, covariance=10000, process="0.0001", sensor="0.01")
    assert rounded(beliefs[0][1], 4) == "10000.0001"
    assert (rounded(beliefs[-1][0], 3), rounded(beliefs[-1][1], 4)) == ("49.988", "0.0013")


def test_the_altitude_of_a_rocket() -> None:
    # Becker, kalmanfilter.net, example 10: Δt = 0.25 s, an altimeter of ± 20 m, an accelerometer of ± 0.1 m/s² as input
    # (with gravity taken off: 9.8, 29.92, 30.22). Printed after every prediction and after the first update.
    t, noise = Fraction(1, 4), Fraction(1, 100)
    beliefs = solved(
        "kalman-filter", A=[[1, t], [0, 1]], B=[[t**2 / 2], [t]], C=[[1, 0]],
        process=[[noise * t**4 / 4, noise * t**3 / 2], [noise * t**3 / 2, noise * t**2]], sensor=400,
        mean=[[0], [0]], covariance=[[500, 0], [0, 500]],
        steps=[{"u": "9.8", "z": "-32.4"}, {"u": "29.92", "z": "-11.1"}, {"u": "30.22"}],
    )  # fmt: skip
    printed = {
        "ab": [0.3, 2.45, 531.25, 125, 125, 500], "de": [-18.35, -1.94, 228.2, 53.7, 53.7, 483.2],
        "fg": [-17.9, 5.54, 285.2, 174.5, 174.5, 483.2], "kl": [-12.3, 14.8, 244.9, 211.6, 211.6, 438.8],
    }  # fmt: skip
    for mean_and_covariance, numbers in printed.items():
        found = [float(rounded(value, 6)) for label in mean_and_covariance for value in flat(beliefs[label])]
        assert found == pytest.approx(numbers, abs=0.051)  # one decimal, rounded or cut


def test_fifty_readings_of_one_voltage_by_hand() -> None:
    # Without noise of the motion the inverse variances add up: from N(0, 1), after 50 readings of 3 with variance 2,
    # 1/Σ = 1 + 50/2 = 26, and μ = (0·1 + 25·3)/26. Of the 100 beliefs, those from step 38 on are asked for.
    beliefs = filtered([3] * 50, mean=0, covariance=1, process=0, sensor=2)
    assert len(beliefs) == 26
    assert beliefs[-1] == (fmpq(75, 26), fmpq(1, 26))
    assert beliefs[0] == (fmpq(3 * 37, 2) / (1 + fmpq(37, 2)), 1 / (1 + fmpq(37, 2)))


def test_a_state_without_commands_needs_neither_b_nor_u() -> None:
    # Constant velocity, everything 1: μ̄ = A (1 1)ᵀ = (2 1)ᵀ, Σ̄ = A Aᵀ + I = (3 1; 1 2), K = (3 1)ᵀ/4,
    # μ = (2 1)ᵀ + K (4 − 2) = (7/2 3/2)ᵀ.
    unit = [[1, 0], [0, 1]]
    exercise = rldrill.read({"family": "kalman-filter", "given": {
        **ONE_METRE, "mean": [[1], [1]], "covariance": unit, "process": unit, "sensor": 1, "steps": [{"z": 4}],
    }})  # fmt: skip
    answers = exercise.solve()
    assert flat(answers["a"]) == [2, 1]
    assert flat(answers["d"]) == [fmpq(7, 2), fmpq(3, 2)]
    assert "u" not in str(exercise.question()).split("xₜ = ", 1)[1].split(",", 1)[0]


def test_a_run_that_is_too_long_says_how_many_steps_are_possible() -> None:
    steps = [{"z": 1}] * 26
    with pytest.raises(FileError, match="with 2 components of the state, 25 are the most"):
        solved("kalman-filter", **ONE_METRE, mean=[[1], [1]], covariance=[[1, 0], [0, 1]], process=[[0, 0], [0, 0]],
               sensor=1, steps=steps)  # fmt: skip


def test_the_variance_of_a_noise_by_hand() -> None:
    # 4 + 2 = 6 before the measurement, 2 after it: 1/2 = 1/6 + 1/Q gives Q = 3. K = 6/9 = 2/3; 1 + 2/3·(4 − 1) = 3.
    step = {"mean": 0, "covariance": 4, "steps": [{"u": 1, "z": 4}], "variance": 2}
    assert solved("kalman-filter", **step, process=2, sensor="w") == {"a": 3, "b": 3}
    assert solved("kalman-filter", **step, process="w", sensor=3) == {"a": 2, "b": 3}
