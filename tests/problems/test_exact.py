"""Exact numbers in files: every way to write one reads as the same fraction."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rldrill.problems.exact import (
    Logarithm,
    Parameter,
    Root,
    read_fraction,
    read_scalar,
    read_weight,
    read_width,
    shown,
)
from rldrill.problems.fractions import Fraction, fraction_of


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ("9/10", Fraction(9, 10)), (0.9, Fraction(9, 10)), ("0.9", Fraction(9, 10)), (" 9 / 10 ", Fraction(9, 10)),
        ("1e-3", Fraction(1, 1000)), (3, Fraction(3)), ("−1/2", Fraction(-1, 2)), (0.1, Fraction(1, 10)), ("-0", 0),
        ("1/2/3", Fraction(1, 6)), ("2^-3", Fraction(1, 8)), ("1 3/4", Fraction(7, 4)), ("75%", Fraction(3, 4)),
        ("½", Fraction(1, 2)), ("1e40", 10**40), ("-2²", -4), ("(1 + 2)*3", 9),
    ],
)  # fmt: skip
def test_numbers(written: object, value: Fraction) -> None:
    assert read_fraction(written) == value


@pytest.mark.parametrize(
    "written",
    [
        "", "1/0", "0^-1", "abc", "nan", "inf", float("nan"), True, None, [], "9" * 41, "1e99999", "1_000", "0x10",
        "sqrt(2)", "2^γ", "9^9^9", "1^(1/2)", "(" * 10**6, "10^20*10^21", "1/0.5/0", "gamma",
    ],
)  # fmt: skip
def test_what_is_not_a_number_is_refused(written: object) -> None:
    with pytest.raises(ValueError, match=r"number|zero"):
        read_fraction(written)


@given(st.fractions(max_denominator=10**6, min_value=-(10**9), max_value=10**9))
def test_a_fraction_survives_being_written(value: Fraction) -> None:
    assert read_fraction(str(value)) == value


@pytest.mark.parametrize(
    ("written", "name", "text"),
    [("gamma", "gamma", "γ"), ("γ", "gamma", "γ"), ("1 - p", "p", "1 − p"), ("1−γ", "gamma", "1 − γ")],
)
def test_parameters(written: str, name: str, text: str) -> None:
    parameter = read_scalar(written)
    assert isinstance(parameter, Parameter)
    assert (parameter.symbol, shown(parameter)) == (name, text)


@pytest.mark.parametrize("written", ["2-p", "1+p", "p-1", "2p", "ab", "1-ab"])
def test_what_is_no_parameter(written: str) -> None:
    with pytest.raises(ValueError, match="is not a number"):
        read_scalar(written)


@pytest.mark.parametrize("written", ["ln 999", "ln(999)", "ln999", " LN 999 "])
def test_logarithms(written: str) -> None:
    assert read_weight(written) == Logarithm("ln 999")


@pytest.mark.parametrize("written", ["ln 1", "ln 1000", "ln(-2)", "ln(1/2)", "ln(2 + 1)", "ln 0"])
def test_what_is_no_logarithm_of_a_weight(written: str) -> None:
    with pytest.raises(ValueError, match="must be the logarithm of a whole number above 1 and below 1000"):
        read_weight(written)


@pytest.mark.parametrize(
    ("text", "square"),
    [
        ("sqrt(2)/3", "2/9"),
        ("2/sqrt(2)", "2"),
        ("sqrt(3)/sqrt(2)", "3/2"),
        ("3*sqrt(2)", "18"),
        ("sqrt(2)*sqrt(3)", "6"),
    ],
)
def test_products_and_quotients_of_roots_are_one_root(text: str, square: str) -> None:
    assert read_width(text) == Root(f"sqrt({square})")


def test_a_root_that_comes_out_is_a_number() -> None:
    assert [read_width(text) for text in ("sqrt(8)/sqrt(2)", "sqrt(2)*sqrt(8)", "sqrt(9/4)")] == [2, 4, Fraction(3, 2)]


@pytest.mark.parametrize(("text", "number"), [("7", 7), ("-7", -7), ("7/2", Fraction(7, 2)), ("0.5", Fraction(1, 2))])
def test_a_text_is_read_and_the_zero_byte_stays_one(text: str, number: Fraction) -> None:
    assert fraction_of(text) == number
    assert bytes([0])[0] == 0


@pytest.mark.parametrize("text", ["", "x", "²", "½", " ", "1/2/3"])
def test_a_text_that_is_no_number_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"."):
        fraction_of(text)


@pytest.mark.parametrize("letter", ["r", "a", "r2", "g"])
def test_who_leaves_another_letter_open_is_told_which_there_are(letter: str) -> None:
    with pytest.raises(ValueError, match=r"letter that may be left open; these are gamma, .* w and x$"):
        read_scalar(letter)
