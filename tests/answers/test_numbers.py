"""One number, in all the forms in which people write it: read as what it is, or refused with its readings named."""

from fractions import Fraction

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from number_spellings import misread
from promptness import at_once
from rldrill.solutions.answers.numbers import plain
from rldrill.solutions.answers.text import Unreadable, read_number

READ = {
    # two forms of one number
    "0.25 (1/4)": ("1/4", "0.25 = 1/4"), "1/4 (0.25)": ("1/4", "1/4 = 0.25"), "0.25 (25%)": ("1/4", "0.25 = 25%"),
    "1/4 = 0.25": ("1/4", "1/4 = 0.25"), "1/4 ≈ 0.25": ("1/4", "1/4 = 0.25"), "9/41 (0.22)": ("9/41", "9/41 ≈ 0.22"),
    "9/41 ≈ 21.95%": ("9/41", "9/41 ≈ 21.95%"), "1/2 + 3/4 = 5/4 = 1.25": ("5/4", "1/2 + 3/4 = 5/4 = 1.25"),
    "0.25 (1/4).": ("1/4", "0.25 = 1/4"), "1/4, i.e. 0.25": ("1/4", "1/4 = 0.25"), "1/4 or 25%.": ("1/4", "1/4 = 25%"),
    "9/41 (approx. 0.2195)": ("9/41", "9/41 ≈ 0.2195"), "2/3 (or 0.67)": ("2/3", "2/3 ≈ 0.67"),
    "8/4 (2)": ("2", "8/4 = 2"), "1/4 + 1/4 (0.5)": ("1/2", "1/4 + 1/4 = 0.5"),
    # decimals that repeat
    "0.333...": ("1/3", "1/3"), "-0.(3)": ("-1/3", "-1/3"), "0.1666…": ("1/6", "1/6"), "0.999...": ("1", "1"),
    "0.33..": ("1/3", "1/3"), "0.1333...": ("2/15", "2/15"), "0.1212…": ("4/33", "4/33"), "2.66...": ("8/3", "8/3"),
    "0.0123123...": ("41/3330", "41/3330"), "0.11212...": ("37/330", "37/330"), ".(3)": ("1/3", "1/3"),
    r"0.\overline{18}": ("2/11", "2/11"), "1/3 = 0.333...": ("1/3", "1/3 = 1/3"),
    "0.3 repeating": ("1/3", "1/3"), "-1.66 (recurring)": ("-5/3", "-5/3"), "0.3 periodic": ("1/3", "1/3"),
    # signs as words
    "minus 1/4": ("-1/4", "-1/4"), "negative 0.25": ("-1/4", "-0.25"), "3 minus 1": ("2", "3 - 1"),
    "25 percent": ("1/4", "25%"), "25 per cent": ("1/4", "25%"),
    "33 1/3 %": ("1/3", "(100/3)%"), "33⅓%": ("1/3", "(100/3)%"),
    # signs of products, also the letter x
    "2.5 x 10^-1": ("1/4", "2.5*10^(-1)"), "2.5X0.1": ("1/4", "2.5*0.1"), "2.5•10⁻¹": ("1/4", "2.5*10^(-1)"),
    "2 ✕ 3": ("6", "2*3"), "(1/2) (1/3)": ("1/6", "1/2*(1/3)"), "1 + 0.9 (0.5)": ("29/20", "1 + 0.9*0.5"),
    "2.5*10 - 1": ("24", "2.5*10 - 1"), "2(3)": ("6", "2*3"),
    # fraction signs, percent
    "⅛/½": ("1/4", "1/8/(1/2)"), "¾²": ("9/16", "(3/4)^2"), "¾%": ("3/400", "(3/4)%"), "√¼": ("1/2", "sqrt(1/4)"),
    "1/(4%)": ("25", "1/(4%)"), "¹⁄₄": ("1/4", "1/4"),
    # LaTeX
    r"\frac{1}{4}": ("1/4", "1/4"), r"$\frac14$": ("1/4", "1/4"), r"2.5\cdot10^{-1}": ("1/4", "2.5*10^(-1)"),
    r"25\%": ("1/4", "25%"), r"\(\tfrac 1 4\)": ("1/4", "1/4"), "0{,}25": ("1/4", "0.25"),
    r"{1 \over 4}": ("1/4", "1/4"), r"{-1\over 2} + 1": ("1/2", "(-1)/2 + 1"),
    r"\sqrt[3]{\frac{8}{27}}": ("2/3", "(8/27)^(1/3)"),
    # what programs print
    "[[0.25]]": ("1/4", "0.25"), "**1/4**": ("1/4", "1/4"), "**0.25 = 1/4**": ("1/4", "0.25 = 1/4"),
    "np.float64(0.25)": ("1/4", "0.25"), "Fraction(1, 4)": ("1/4", "1/4"), "Decimal('0.25')": ("1/4", "0.25"),
    "Sqrt[4]": ("2", "sqrt(4)"), "math.sqrt(4)": ("2", "sqrt(4)"), "2**-2": ("1/4", "2^(-2)"),
    "2.5*^-1": ("1/4", "2.5e-1"),
    # what stands around a number
    "=6.8": ("34/5", "6.8"), "≈ 6.8": ("34/5", "6.8"), "approx. 6.8": ("34/5", "6.8"), '"6.8"': ("34/5", "6.8"),
    "ca. = 6.8": ("34/5", "6.8"), "approx.=6.8": ("34/5", "6.8"),
    "‘6.8’": ("34/5", "6.8"), "6.8.": ("34/5", "6.8"), "6.8 (approx)": ("34/5", "6.8"), "6.8 approx.": ("34/5", "6.8"),
    "6.8 (rounded)": ("34/5", "6.8"), "34/5 (exact)": ("34/5", "34/5"), "34/5 exactly": ("34/5", "34/5"),
    "exactly 6.8": ("34/5", "6.8"),
    # degrees, where an angle is taken
    "cos(60°)": ("1/2", "cos(60*(pi/180))"), "sin 30° + 1": ("3/2", "sin(30*(pi/180)) + 1"),
    "tan(30° + 15 deg)": ("1", "tan(30*(pi/180) + 15*(pi/180))"), r"\cos 60^\circ": ("1/2", "cos(60*(pi/180))"),
    # digits of other scripts
    "٠٫٢٥": ("1/4", "0.25"), "۱/۴": ("1/4", "1/4"), "१/४": ("1/4", "1/4"),
    "１／４": ("1/4", "1/4"), "٢٥٪": ("1/4", "25%"),
}  # fmt: skip


@pytest.mark.parametrize("text", READ)
def test_what_is_read_is_shown(text: str) -> None:
    reading = read_number(text)
    assert (str(reading.value), reading.echo) == READ[text]


REFUSED = {
    "2.5 e-1": "may be '2.5e-1' or '2.5*e - 1'",
    "2.5 E −1": "may be '2.5e-1' or '2.5*e - 1'",
    "½e-1.": "may be '½e-1.' or '½*e - 1.'",
    "50/2%": "may be (50/2)% or 50/(2%)",
    "0.25 (1/5)": "may be '0.25*(1/5)' or say '0.25' and '1/5'",
    "0.25(1/4)": "may be '0.25*(1/4)' or say '0.25' and '1/4'",
    "2 (2)": "may be '2*2' or say '2' and '2'",
    "1 + 2 (3)": "may be '1 + 2*3' or say '1 + 2' and '3'",
    "1/4 = 0.26": "'1/4' and '0.26', which differ",
    "1/4 (≈ 0.24)": "'1/4' and '0.24', which differ",
    "2/3 = 0.66": "'2/3' and '0.66', which differ",
    "1/4 =": "A number is missing after the last sign",
    "2.5×10−1": "may be '2.5*10^-1' or '2.5*10 - 1'",
    "2.5 x 10 -1": "may be '2.5*10^-1' or '2.5*10 - 1'",
    "1/(1 + e−2)": "'e-2' may be 'e^-2' or 'e - 2'",
    "e-1/8": "may be 'e^-1' or 'e - 1'",
    "1.5 (4/2).": "may be '1.5*(4/2)' or say '1.5' and '4/2'",
    "2.0*0.5*10-1/2": "may be '0.5*10^-1' or '0.5*10 - 1'",
    "1.(1)": "may be '10/9', its last digits repeated, or '1.*1'",
    "0.25...": "does not show which digits repeat; write '0.25', or a fraction",
    "0.3...": "does not show which digits repeat; write '0.3', or a fraction",
    "0.133...": "does not show which digits repeat; write '0.133', or a fraction",
    "0.12...": "does not show which digits repeat; write '0.12', or a fraction",
    ".5...": "does not show which digits repeat; write '0.5', or a fraction",
    "0·25": "may be '0.25' or 0 times '25'",
    "3{,}125": "may be '3.125' or '3125'",
    "1\u202f234": "may be '1234' or two numbers",
    "+-3": "may be '-3' or '±3'",
    "--3": "may be '3' or '-3'",
    "5 m": "write the number alone, without a unit",
    "5$": "'$' is a unit",
    "45°": "'°' is a unit",
    "cos(0)*45°": "'°' is a unit",
    "5 rad": "'rad' is not something this answer may contain; write the number alone, without a unit",
    "0.16 repeating": "does not show which digits repeat; write '0.16', or a fraction",
    "0.707 (√2/2)": "may be '0.707*(sqrt(2)/2)' or say '0.707' and 'sqrt(2)/2'",
    "-2.12 (-3√2/2)": "may be '-2.12*(-3*sqrt(2)/2)' or say '-2.12' and '-3*sqrt(2)/2'",
    # a word tells more than what comes of it
    "I think 2.5": "'think' is not something",
    "maybe 2.5": "'maybe' is not something",
    "1 over 3": "'over' is not something",
    "2.5 // slip": "'slip' is not something",
    "don't know": "'don' is not something",
    "log10(100)": "log is the natural logarithm here; write ln(…)/ln(10) for that to the base 10.",
    "log2(8)": "log is the natural logarithm here; write ln(…)/ln(2) for that to the base 2.",
    "e^-1/2": "may be ^(-1/2) or (…^-1)/2",
    "e^-9/8": "may be ^(-9/8) or (…^-9)/8",
    "1\\frac34": "may be 1 + 3/4 or 1*3/4",
    "0x10": "'x10' is not something",
    "2x": "'x' is not something",
    "1②": "'②' is not something",
}


@pytest.mark.parametrize("text", REFUSED)
def test_what_may_be_read_in_two_ways_is_refused_with_both(text: str) -> None:
    with pytest.raises(Unreadable) as refused:
        read_number(text)
    assert REFUSED[text] in refused.value.message


def test_a_power_may_have_lost_its_place() -> None:
    with pytest.raises(
        Unreadable, match=r"'2' follows without a sign; write \* before it if it is a factor, or \^ if it"
    ):
        read_number("1 + 3γ2", ["gamma"])


def test_x_is_a_parameter_where_the_problem_has_one() -> None:
    assert read_number("2x", ["x"]).echo == "2*x"
    with pytest.raises(Unreadable, match="follows without a sign"):
        read_number("2 x 3", ["x"])


def test_two_forms_of_an_expression() -> None:
    assert read_number("(1 - γ²)/(1 - γ) = 1 + γ", ["gamma"]).echo == "(1 - gamma^2)/(1 - gamma) = 1 + gamma"
    assert read_number("2 (√2/2)").echo == "2*(sqrt(2)/2)"
    assert read_number("sqrt(2)/2 (0.707)").echo == "sqrt(2)/2 ≈ 0.707"
    assert read_number("exp(-1) ≈ 0.368").echo == "exp(-1) ≈ 0.368"
    with pytest.raises(Unreadable, match="which differ"):
        read_number("γ = 1 - γ = γ + 1", ["gamma"])


def test_the_column_of_what_stands_behind_a_command() -> None:
    with pytest.raises(Unreadable, match="'@'") as refused:
        read_number(r"\frac{1}{2} + \sqrt{4} + @")
    assert refused.value.position == 25


def test_a_repeated_decimal_is_exact() -> None:
    assert read_number("0.(142857)").value == fmpq(1, 7)


def test_no_spelling_is_read_as_another_number() -> None:
    outcomes, wrong = misread(3000)
    assert not wrong
    assert sum(count for (_, outcome), count in outcomes.items() if outcome == "read") > 2000


HOSTILE = [
    "\\frac{" * 330, "\\sqrt{" * 280 + "2" + "}" * 280, "\\overline{" * 180, "\\" * 1999, "$" * 1999, "{" * 1999,
    "0." + "1" * 1990 + "...", "0." + "12" * 990 + "...", "0." + "3\u0305" * 990, "0.(" + "9" * 1000 + ")",
    "1 = " * 490 + "1",
    "(1/4) " * 300, "1 (" * 600 + ")" * 600, "1,234" * 390, "1'" * 990, "1{,}1" * 390, "¹⁄₄" * 600, "1٢" * 900,
    "1x" * 990,
    "2.5*10-1" * 240, "Fraction(" * 220, "∛" * 1999, "((1+√2)^64)^64 = 1", "exp(γ)^12 = (exp(γ)+1)^12 = " * 3 + "1",
    "(1+γ)^12/(2+γ)^12 = " * 7 + "1", "1 (0.1e-99)", "≈" * 1999, "approx " * 280,
]  # fmt: skip


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_hostile_spellings_take_no_time(text: str) -> None:
    read_number("exp(γ) + sqrt(2)", ["gamma"])
    with at_once(), pytest.raises(Unreadable) as refused:
        read_number(text, ["gamma"])
    assert len(refused.value.message) < 300
    assert refused.value.message.isprintable()


def test_a_first_power_above_a_line_is_shown_in_brackets() -> None:
    reading = read_number("(2^1) / 3")
    assert reading.echo == "(2^1)/3"
    assert read_number(reading.echo).value == reading.value


@pytest.mark.parametrize(("text", "echo"), [("eᵞ", "e^gamma"), ("3e⁻ᵞ", "3e^(-gamma)"), ("e²ᵞ", "e^(2*gamma)")])
def test_a_letter_above_the_line_is_an_exponent(text: str, echo: str) -> None:
    assert read_number(text, ("gamma",)).value == read_number(echo, ("gamma",)).value
    assert read_number(text, ("gamma",)).value != read_number("e*gamma", ("gamma",)).value


@given(st.from_regex(r"-?[0-9]{1,6}(\.[0-9]{1,6}|/[1-9][0-9]{0,5})?", fullmatch=True))
@settings(deadline=None, max_examples=300)
def test_plain_numbers_are_read_at_once_as_the_grammar_reads_them(text: str) -> None:
    at_once, with_brackets = plain(text), read_number(f"({text})")
    assert at_once is not None
    assert at_once.value == with_brackets.value == fmpq(*Fraction(text).as_integer_ratio())
    assert at_once.decimal == with_brackets.decimal
    assert at_once.echo == with_brackets.echo.strip("()") == text


@pytest.mark.parametrize("text", ["|3 - 4|", "|-3|", "|γ|"])
def test_bars_around_what_may_be_negative_are_refused_with_both_readings(text: str) -> None:
    with pytest.raises(Unreadable, match=r"may be the absolute value, or .* in a cell; write abs"):
        read_number(text, ["gamma"])


@pytest.mark.parametrize(("text", "value"), [("|3|", 3), ("|4 - 1|", 3), ("| -3 |", -3), ("abs(3 - 4)", 1)])
def test_bars_that_change_nothing_are_read(text: str, value: int) -> None:
    assert read_number(text).value == value


@pytest.mark.parametrize(
    ("text", "agree"),
    [
        ("1/3 = .33", True), ("1/3 = .34", False), ("1/3 ≈ 33%", True), ("1/3 ≈ 43%", False),
        # 1/123456789 = 8.10000007…·10⁻⁹
        ("1/123456789 ≈ 8.1e-9", True), ("1/123456789 ≈ 8.2e-9", False), ("1/123456789 ≈ 8.1·10⁻⁹", True),
        ("1/123456789 ≈ 8.2·10^(- 9)", False),
        ("1/123456789 ≈ 8.1·10^(- 9)", True), ("12345 ≈ 1.23·10⁴", True), ("12345 ≈ 1.24·10^4", False),
    ],
)  # fmt: skip
def test_a_decimal_beside_a_number_is_that_number_rounded(text: str, agree: bool) -> None:
    if agree:
        assert read_number(text).value == read_number(text.split()[0]).value
    else:
        with pytest.raises(Unreadable, match="differ"):
            read_number(text)
