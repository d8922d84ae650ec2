"""What may be written for a value by a slip of arithmetic, the whole list, worked out by hand and in its order."""

from typing import Any

import pytest
import sympy
from flint import fmpq

from rldrill.solutions.diagnosis.alternatives import _crosswise
from rldrill.solutions.diagnosis.arithmetic import slips
from rldrill.solutions.matrices import matrix
from rldrill.solutions.rational import generator
from rldrill.solutions.vector import Vector

P = generator("p")


def q(text: str) -> fmpq:
    top, _, bottom = text.partition("/")
    return fmpq(int(top), int(bottom or 1))


@pytest.mark.parametrize(
    ("value", "written"),
    [
        # 12/5 = 2.4: with its digits exchanged 21/5, and 4.2 of the decimal, which is the same.
        ("12/5", "sign -12/5, tenfold 24, tenfold 6/25, one-off 17/5, one-off 7/5, numerator 13/5, numerator 11/5, "
         "denominator 2, denominator 3, inverse 5/12, digits 21/5, digits 21/5, doubled 24/5, halved 6/5"),
        # 1/16 = 0.0625: 0.0265 and 0.0652.
        ("1/16", "sign -1/16, tenfold 5/8, tenfold 1/160, one-off 17/16, one-off -15/16, numerator 1/8, "
         "denominator 1/17, denominator 1/15, inverse 16, digits 265/10000, digits 652/10000, doubled 1/8, "
         "halved 1/32"),
        # The decimal of 1/32 has five places, that of 1/3 never ends: nobody exchanges their digits, and where it never
        # ends no decimal point slips.
        ("1/32", "sign -1/32, tenfold 5/16, tenfold 1/320, one-off 33/32, one-off -31/32, numerator 1/16, "
         "denominator 1/33, denominator 1/31, inverse 32, doubled 1/16, halved 1/64"),
        ("-2/3", "sign 2/3, one-off 1/3, one-off -5/3, numerator -1/3, numerator -1, "
         "denominator -1/2, denominator -1, inverse -3/2, doubled -4/3, halved -1/3"),
        # Below a line there stands no 1 that one could come to from 2; −2.5 becomes −5.2.
        ("-5/2", "sign 5/2, tenfold -25, tenfold -1/4, one-off -3/2, one-off -7/2, numerator -2, numerator -3, "
         "denominator -5/3, inverse -2/5, digits -52/10, doubled -5, halved -5/4"),
        # A whole number has no line, and no digit stands before it: 120 becomes 210 and 102, but 100 never 010.
        ("120", "sign -120, tenfold 1200, tenfold 12, one-off 121, one-off 119, inverse 1/120, digits 210, digits 102, "
         "doubled 240, halved 60"),
        ("100", "sign -100, tenfold 1000, tenfold 10, one-off 101, one-off 99, inverse 1/100, doubled 200, halved 50"),
        ("-13", "sign 13, tenfold -130, tenfold -13/10, one-off -12, one-off -14, inverse -1/13, digits -31, "
         "doubled -26, halved -13/2"),
        # Upside down 1 is 1.
        ("-1", "sign 1, tenfold -10, tenfold -1/10, one-off 0, one-off -2, doubled -2, halved -1/2"),
        ("0", "one-off 1, one-off -1"),
    ],
)  # fmt: skip
def test_slips_in_a_number(value: str, written: str) -> None:
    listed = [(kind, q(number)) for each in written.split(", ") for kind, number in [each.split(" ")]]
    assert list(slips(q(value))) == listed


def test_digits_are_exchanged_in_numbers_of_seven_digits_and_in_no_longer_ones() -> None:
    exchanged = [int(other.p) for kind, other in slips(fmpq(1234567)) if kind == "digits"]
    assert exchanged == [2134567, 1324567, 1243567, 1235467, 1234657, 1234576]
    assert not any(kind == "digits" for kind, _ in slips(fmpq(12345678)))


def test_slips_in_one_term_of_what_has_an_open_parameter() -> None:
    assert list(slips(2 + 5 * P)) == [
        ("sign", -2 - 5 * P),
        ("tenfold", 20 + 50 * P),
        ("tenfold", fmpq(1, 5) + fmpq(1, 2) * P),
        ("one-off", 3 + 5 * P),
        ("one-off", 1 + 5 * P),
        ("doubled", 4 + 10 * P),
        ("halved", 1 + fmpq(5, 2) * P),
        ("lost-term", 5 * P),
        ("term-sign", -2 + 5 * P),
        ("term-tenfold", fmpq(1, 5) + 5 * P),
        ("lost-term", fmpq(2)),
        ("term-sign", 2 - 5 * P),
        ("term-tenfold", 2 + fmpq(1, 2) * P),
    ]


def test_what_has_one_term_loses_none() -> None:
    kinds = [kind for kind, _ in slips(5 * P * P)]
    assert kinds == ["sign", "tenfold", "tenfold", "one-off", "one-off", "doubled", "halved"]
    # Of 2 + 5p², the middle term is not there, so that it is neither lost nor has it another sign.
    terms = [other for kind, other in slips(2 + 5 * P * P) if kind == "lost-term"]
    assert terms == [5 * P * P, fmpq(2)]


#: The slips in 2, without its inverse, which nobody makes in an entry.
IN_TWO = [("sign", -2), ("tenfold", 20), ("tenfold", fmpq(1, 5)), ("one-off", 3), ("one-off", 1), ("doubled", 4),
          ("halved", 1)]  # fmt: skip


@pytest.mark.parametrize("entries", [[0, 2], [2]])
def test_slips_in_a_list_are_those_in_its_entries_and_all_signs(entries: list[int]) -> None:
    listed = [("one-off", [1, 2]), ("one-off", [-1, 2])] if len(entries) == 2 else []
    listed += [(kind, [*entries[:-1], other]) for kind, other in IN_TWO]
    assert [(kind, list(other)) for kind, other in slips(Vector(map(fmpq, entries)))] == [
        *listed,
        ("sign", [-entry for entry in entries]),
    ]


def test_slips_in_a_matrix_are_those_in_its_entries_and_all_signs() -> None:
    found = [(kind, other.tolist()) for kind, other in slips(matrix([[fmpq(0)], [fmpq(2)]]))]
    listed: list[tuple[str, Any]] = [("one-off", [[1], [2]]), ("one-off", [[-1], [2]])]
    listed += [(kind, [[0], [other]]) for kind, other in IN_TWO]
    assert found == [*listed, ("sign", [[0], [-2]])]
    assert [kind for kind, _ in slips(matrix([[fmpq(2)]]))] == [kind for kind, _ in IN_TWO]
    assert [other[0, 1] for kind, other in slips(matrix([[fmpq(0), fmpq(2)]])) if kind == "doubled"] == [4]


def test_the_sign_of_what_is_beside_the_diagonal_of_a_symmetric_matrix_is_lost() -> None:
    symmetric, other = (
        [[fmpq(each) for each in row] for row in rows] for rows in ([[1, -2], [-2, 3]], [[1, 2], [4, 3]])
    )
    assert ("sign", [[1, 2], [2, 3]]) in [(kind, found.tolist()) for kind, found in slips(matrix(symmetric))]
    assert [[1, -2], [-4, 3]] not in [found.tolist() for _, found in slips(matrix(other))]


@pytest.mark.parametrize(
    ("one", "two", "wrong"),
    [("1/2", "1/3", "2/5"), ("3/4", "5/6", "4/5"), ("1/2", "3/2", None), ("1/2", "3", None), ("2", "1/3", None)],
)
def test_fractions_are_added_crosswise_where_that_is_more_work_than_the_right_way(
    one: str, two: str, wrong: str | None
) -> None:
    left, right = sympy.symbols("x y")
    assert _crosswise(left + right, {"x": q(one), "y": q(two)}) == (wrong and q(wrong))
