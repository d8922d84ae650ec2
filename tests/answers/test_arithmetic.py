"""Functions, powers and roots in typed numbers: what they are worth, and where they have no value."""

import math

import pytest
from flint import fmpq

from rldrill.solutions.answers.text import Unreadable, read_number
from rldrill.solutions.exact import to_sympy

#: By hand: a size below one and above, on either side of zero, and zero itself.
EXACT = {
    "abs(1/2)": "1/2", "abs(-1/2)": "1/2", "abs(3/2)": "3/2", "abs(-3/2)": "3/2", "abs(0)": "0", "abs(-1)": "1",
    "max(1/2, 1/3)": "1/2", "max(1/3, 1/2)": "1/2", "min(1/2, 1/3)": "1/3", "min(1/3, 1/2)": "1/3",
    "max(-1/2, -1/3)": "-1/3", "min(-1/2, -1/3)": "-1/2", "max(0, 1/2)": "1/2", "min(0, -1/2)": "-1/2",
    "max(0, -1/2, 1/4)": "1/4", "min(1, 3/2, 1/4)": "1/4", "max(1/2, 1/2)": "1/2", "max(-3, 2)": "2",
    "max(1,2)": "2", "max(1;2)": "2", "min(3;2;4)": "2",
    "sqrt(0)": "0", "sqrt(1)": "1", "sqrt(1/4)": "1/2", "8^(1/3)": "2", "8^(2/3)": "4", "8^(-1/3)": "1/2",
    "(1/4)^(3/2)": "1/8", "4^(-1/2)": "1/2", "1^0": "1", "5^0": "1", "5^1": "5", "5^-1": "1/5", "(1/2)^-2": "4",
    "(-1/2)^3": "-1/8", "0^2": "0", "ln(1)": "0", "exp(0)": "1", "ln(e^(1/2))": "1/2", "ln(sqrt(e))": "1/2",
    "ln(e^2)": "2", "ln(1/e)": "-1", "sqrt(e^2)/e": "1", "(e^4)^(1/4)/e": "1", "(e^2)^3/e^6": "1", "e^2 e^(-2)": "1",
    "sqrt(2) sqrt(2)": "2", "sqrt(2) sqrt(8)": "4", "sqrt(8)/sqrt(2)": "2",
    "sin(0)": "0", "cos(0)": "1", "sin(pi/2)": "1", "cos(pi)": "-1", "cos(pi/3)": "1/2", "sin(-pi/6)": "-1/2",
    "tan(pi/4)": "1", "tan(3pi/4)": "-1", "sin(pi/4)^2": "1/2", "pi/pi": "1", "sqrt(γ)^2/γ": "1", "exp(γ)/exp(γ)": "1",
    "exp(γ)exp(-γ)": "1", "ln(exp(γ))/γ": "1", "50%": "1/2", "200%": "2", "-50%": "-1/2",
}  # fmt: skip


@pytest.mark.parametrize("text", EXACT)
def test_a_rational_number_in_another_form(text: str) -> None:
    assert read_number(text, ["gamma"]).value == fmpq(*map(int, EXACT[text].split("/")))


#: By Python's own functions.
DECIMALS = {
    "ln(1/2)": math.log(1 / 2), "ln(1/1000)": math.log(1 / 1000), "ln(3/2)": math.log(3 / 2), "ln(100)": math.log(100),
    "exp(1/2)": math.exp(1 / 2), "exp(-1/2)": math.exp(-1 / 2), "exp(-100)": math.exp(-100), "e^50": math.exp(50),
    "e^(1/2)": math.exp(1 / 2), "sqrt(1/2)": math.sqrt(1 / 2), "sqrt(3/2)": math.sqrt(3 / 2), "2^(1/3)": 2 ** (1 / 3),
    "(1/2)^(1/3)": 2 ** (-1 / 3), "2^(-5/2)": 2**-2.5, "7^(11/12)": 7 ** (11 / 12), "sin(1)": math.sin(1),
    "cos(-1)": math.cos(1), "tan(1/2)": math.tan(1 / 2), "sin(1000)": math.sin(1000),
    "tan(pi/12)": math.tan(math.pi / 12),
    "cos(pi/5)": math.cos(math.pi / 5), "sin(pi/24)": math.sin(math.pi / 24), "sqrt(√2 - 1)": math.sqrt(2**0.5 - 1),
    "sqrt(1 + √2)": math.sqrt(1 + 2**0.5), "abs(√2 - 2)": 2 - 2**0.5, "abs(√2 - 1)": 2**0.5 - 1,
    "max(√2, 3/2)": 1.5, "max(√2, 7/5)": 2**0.5, "min(√2, 3/2)": 2**0.5, "min(e, 3, pi)": math.e,
    "ln(√2)": math.log(2) / 2, "ln(1 + √2)": math.log(1 + 2**0.5), "1/(1 + exp(-2))": 1 / (1 + math.exp(-2)),
    "exp(√2)": math.exp(2**0.5), "exp(exp(exp(1)))": math.exp(math.exp(math.e)), "pi^2": math.pi**2, "√(√2)": 2**0.25,
    "(1 + √2)(1 - √2)": -1,
}  # fmt: skip


@pytest.mark.parametrize("text", DECIMALS)
def test_a_number_that_is_not_rational(text: str) -> None:
    assert float(to_sympy(read_number(text).value).evalf(20)) == pytest.approx(DECIMALS[text], rel=1e-12)


NO_VALUE = {
    "sqrt(-1/2)": "A root of a negative number is not a real number.",
    "(-8)^(1/3)": "A root of a negative number is not a real number.",
    "sqrt(1 - √2)": "A root of a negative number is not a real number.",
    "(1 + √2)^(1/3)": "Only square roots are read of such a number; write a decimal.",
    "ln(0)": "Only a number above zero has a logarithm.",
    "ln(-1/2)": "Only a number above zero has a logarithm.",
    "ln(√2 - 3/2)": "Only a number above zero has a logarithm.",
    "1/(1 - 1)": "It divides by zero.",
    "0^-2": "It divides by zero.",
    "1/(γ - γ)": "It divides by zero.",
    "2^√2": "Only e is raised to such an exponent; write a whole number or a fraction there.",
    "sin(γ)": "sin is read of numbers only; write the answer without it.",
    "abs(γ)": "abs, max and min are read of numbers that differ clearly; write out which it is.",
    "max(1; 2,5)": "2,5 has a decimal comma; write 2.5.",
    "max(γ, 1)": "abs, max and min are read of numbers that differ clearly; write out which it is.",
    "abs((1 + √2)^2 - 3 - 2√2 + 10^-40 - 10^-40)": "abs, max and min are read of numbers that differ clearly",
    "tan(pi/2)": "not a real number",
}


@pytest.mark.parametrize("text", NO_VALUE)
def test_what_has_no_value_says_why(text: str) -> None:
    with pytest.raises(Unreadable) as refused:
        read_number(text, ["gamma"])
    assert NO_VALUE[text] in refused.value.message


def test_the_column_is_that_of_the_operation() -> None:
    for text, column in {"1 + sqrt(-2)": 4, "2 * 3^1001": 5, "1 + 1/0": 5, "(1 - 1)^-1": 7}.items():
        with pytest.raises(Unreadable) as refused:
            read_number(text)
        assert refused.value.position == column, text
