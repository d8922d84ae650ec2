"""Somebody's own working, held against the right one."""

import pytest

import rldrill

# As in test_diagnosing.py: cave ← 10, floor ← 5, cave ← 17/4.
RUN = {
    "family": "td-zero",
    "given": {
        "trajectory": {"states": ["cave", "floor", "cave", "rim"], "rewards": [8, -3, -4]},
        "values": {"cave": 8, "floor": 8, "rim": 5},
        "alpha": "1/2",
        "gamma": "1/2",
    },
}


@pytest.fixture(scope="module")
def run() -> rldrill.Exercise:
    return rldrill.read(RUN)


@pytest.mark.parametrize(
    "lines",
    [
        ["V(cave) = 8 + 1/2*(8 + 1/2*8 - 8) = 10", "V(floor) = 5", "V(cave) = 17/4"],
        ["10", "5", "4.25"],
        ["V(cave) = 17/4"],
        ["δ = 4", "V(cave) ← 8 + 1/2*4 = 10", "δ = -6", "V(floor) = 8 - 3 = 5"],
    ],
)
def test_a_right_working_is_right_however_it_is_written(run: rldrill.Exercise, lines: list[str]) -> None:
    followed = run.follow(lines)
    assert followed.first is None
    assert {line.standing for line in followed.lines} == {"right"}


def test_the_first_line_that_departs_is_named_and_the_rest_follows(run: rldrill.Exercise) -> None:
    # first update without γ: 8 + 1/2·(8 + 8 − 8) = 12; then rightly 8 + 1/2·(−3 + 6 − 8) = 11/2
    # and 12 + 1/2·(−4 + 11/4·0 …): the third goes to rim: 12 + 1/2·(−4 + 5/2 − 12) = 21/4
    followed = run.follow(["V(cave) = 8 + 1/2*(8 + 8 - 8) = 12", "V(floor) = 11/2", "V(cave) = 21/4"])
    assert followed.first == 0
    assert [line.standing for line in followed.lines] == ["departs", "follows", "follows"]
    assert "γ is missing in the first update (t = 0)" in followed.sentence
    assert followed.lines[0].step == 0


def test_a_slip_of_arithmetic_is_told_from_a_wrong_formula(run: rldrill.Exercise) -> None:
    followed = run.follow(["V(cave) = 10", "V(floor) = 8 + 1/2*(-6) = 4"])
    assert [line.standing for line in followed.lines] == ["right", "miscalculated"]
    assert "is not 4: a slip of arithmetic in the second update (t = 1)" in followed.sentence


def test_words_are_passed_over(run: rldrill.Exercise) -> None:
    followed = run.follow("first the cave\nV(cave) = 10")
    assert [line.standing for line in followed.lines] == ["unread", "right"]


# H = BᵀPB − R = −2 − 16 − 3 = −21; BᵀP = (−2, −8), so G = BᵀPA = (−10, −12); L = H⁻¹G = (10/21, 12/21);
# a = −Ls = −(30 + 36)/21 = −22/7
GAIN = {
    "family": "lqr-gain",
    "given": {
        "A": [["1", "2"], ["1", "1"]],
        "B": [["1"], ["2"]],
        "R": [["3"]],
        "P": [["-2", "0"], ["0", "-4"]],
        "start": ["3", "3"],
    },
}


def test_a_line_may_hold_a_matrix() -> None:
    followed = rldrill.read(GAIN).follow(["H_0 = -21", "G_0 = [-10, -12]", "L_0 = [10/21 12/21]", "a_0 = -22/7"])
    assert [line.standing for line in followed.lines] == ["right"] * 4
    assert [line.step for line in followed.lines] == [0, 1, 2, 3]


def test_what_follows_from_a_wrong_matrix_is_told() -> None:
    # with the gain (10/21, −12/21) the action is −(30 − 36)/21 = 2/7
    followed = rldrill.read(GAIN).follow(["G_0 = [-10 -12]", "L_0 = [10/21 -4/7]", "a_0 = 2/7"])
    assert [line.standing for line in followed.lines] == ["right", "departs", "follows"]
    assert followed.lines[1].step == 2
    assert followed.lines[1].kind == "sign"
