"""Slips in solving an equation with one unknown, worked out by hand."""

from flint import fmpq

from rldrill.solutions.diagnosis.replay import Equated
from rldrill.solutions.diagnosis.unknowns import missolved
from rldrill.solutions.rational import generator

W = generator("w")


def test_both_sides_with_a_number_and_the_unknown() -> None:
    # 4 − w = 2 + 2w, so w = 2/3. Both numbers on the right: −3w = 2 + 4. On the left: 4 + 2 = 3w. Both unknowns on the
    # left: −w + 2w = 2 − 4. On the right: 4 − 2 = 2w − w. And −3w = −2 multiplied by −3.
    found = list(missolved(Equated("w", 4 - W, 2 + 2 * W, fmpq(2, 3))))
    assert found == [
        ("number-moved", -2), ("number-moved", 2), ("unknown-moved", -2), ("unknown-moved", 2), ("multiplied", 6),
    ]  # fmt: skip


def test_a_side_without_the_unknown() -> None:
    # 7 = 2 + 1/2·w, so w = 10. With 7 + 2 on the left: w = 18. And 1/2·w = 5 multiplied by 1/2; from the left to the
    # right that is −1/2·w = −5.
    found = list(missolved(Equated("w", fmpq(7), 2 + W / 2, fmpq(10))))
    assert found == [("number-moved", 18), ("multiplied", fmpq(5, 2))]


def test_no_straight_line_is_left_alone() -> None:
    assert list(missolved(Equated("w", 1 / W, fmpq(2), fmpq(1, 2)))) == []
