"""What is read from typed answers, what is refused and how, and that neither takes long."""

from fractions import Fraction

import pytest
import sympy
from flint import fmpq
from hypothesis import example, given, settings
from hypothesis import strategies as st

from numbers_drawn import small
from promptness import at_once
from rldrill.solutions.answers.text import (
    Reading,
    Unreadable,
    read_choice,
    read_matrix,
    read_number,
    read_table,
    read_vector,
    read_words,
    read_yes_no,
)
from rldrill.solutions.rational import RationalFunction, generator

GAMMA = generator("gamma")
gamma = sympy.Symbol("gamma", positive=True)
sqrt, exp, log, pi, E, Rational = sympy.sqrt, sympy.exp, sympy.log, sympy.pi, sympy.E, sympy.Rational
PAIRS = [("cool", "fast"), ("cool", "slow"), ("warm", "slow")]


def rational(value: int | str | Fraction) -> fmpq:
    fraction = Fraction(value)
    return fmpq(fraction.numerator, fraction.denominator)


def values(readings) -> list:
    return [reading.value for reading in readings]


def refusal(read, *arguments) -> Unreadable:
    with pytest.raises(Unreadable) as caught:
        read(*arguments)
    assert caught.value.message == str(caught.value)
    return caught.value


def complaint(read, text) -> Unreadable | None:
    try:
        read(text)
    except Unreadable as unreadable:
        return unreadable
    return None


RATIONALS = {
    "3": "3",
    "-3": "-3",
    "+3": "3",
    ".5": "1/2",
    "3.": "3",
    "3.5.": "7/2",
    "0.1": "1/10",
    "1e-3": "1/1000",
    "2.5E2": "250",
    "3/4": "3/4",
    " 3 / 4 ": "3/4",
    "1 3/4": "7/4",
    "-1 3/4": "-7/4",
    "2 + 1 3/4": "15/4",
    "½": "1/2",
    "1½": "3/2",
    "¾²": "9/16",
    "1/½": "2",
    "75%": "3/4",
    "12.5 %": "1/8",
    "−3": "-3",
    "–3": "-3",
    "2×3": "6",
    "2·3": "6",
    "3÷4": "3/4",
    "３/４": "3/4",
    "2²": "4",
    "2⁻¹": "1/2",
    "2^3^2": "512",
    "2**-2": "1/4",
    "-2^2": "-4",
    "(-2)^2": "4",
    "2*-3": "-6",
    "1/2/2": "1/4",
    "1-2-3": "-4",
    "2(1 + 2)(3)": "18",
    "8^(1/3)": "2",
    "4^0.5": "2",
    "sqrt(9/4)": "3/2",
    "√9": "3",
    "sqrt(2)^2": "2",
    "ln(e)": "1",
    "exp(0)": "1",
    "sin(pi/6)": "1/2",
    "cos π": "-1",
    "abs(-3)": "3",
    "max(1, 2, 3/2)": "2",
    "min(2, sqrt(2), 1)": "1",
    "x = 3": "3",
    "V(s) = 3": "3",
    "R_0=3": "3",
    "V_{k+1}(s) = 3": "3",
    "Q*(s, a) = 3": "3",
    "L = -1/2": "-1/2",
}

IRRATIONALS = {
    "sqrt(2)": sqrt(2),
    "sqrt 2": sqrt(2),
    "√2": sqrt(2),
    "√2/2": sqrt(2) / 2,
    "sqrt2": sqrt(2),
    "sqrt2/2": sqrt(2) / 2,
    "ln3": log(3),
    "ln12 - 2ln2": log(12) - 2 * log(2),
    "Log2": log(2),
    "ln3.5": log(Rational(7, 2)),
    "πln2": pi * log(2),
    "2 sqrt(3)": 2 * sqrt(3),
    "2^(-1/2)": sqrt(2) / 2,
    "(1+sqrt(5))/2": (1 + sqrt(5)) / 2,
    "e": E,
    "e^2": exp(2),
    "e²": exp(2),
    "exp(-1/8)": exp(-sympy.Rational(1, 8)),
    "e^(-1/8)": exp(-sympy.Rational(1, 8)),
    "1/(1+exp(-2))": 1 / (1 + exp(-2)),
    "ln 2": log(2),
    "3 ln(2)": 3 * log(2),
    "log(2)": log(2),
    "pi": pi,
    "2π": 2 * pi,
    "½π": pi / 2,
    "√½": sqrt(2) / 2,
    "2^½": sqrt(2),
}

IN_GAMMA = {
    "gamma": GAMMA,
    "γ": GAMMA,
    "Gamma": GAMMA,
    "γ²": GAMMA**2,
    "2γ": 2 * GAMMA,
    "γγ": GAMMA**2,
    "2(1+gamma)": 2 + 2 * GAMMA,
    "gamma(1-gamma)": GAMMA - GAMMA**2,
    "(1/2)γ": GAMMA / 2,
    "2γ/3": 2 * GAMMA / 3,
    "1/(1 - 0.9γ)": 1 / (1 - GAMMA * 9 / 10),
    "(1-γ²)/(1-γ)": 1 + GAMMA,
    "γ^-1": 1 / GAMMA,
    "sqrt(γ)^2": GAMMA,
    "sqrt(4γ²)": 2 * GAMMA,
}


@pytest.mark.parametrize("text", RATIONALS)
def test_rational_numbers_stay_rational(text):
    value = read_number(text).value
    assert isinstance(value, fmpq)
    assert value == rational(RATIONALS[text])


@pytest.mark.parametrize("text", IRRATIONALS)
def test_irrational_numbers_stay_exact(text):
    value = read_number(text).value
    assert isinstance(value, sympy.Expr)
    assert sympy.simplify(value - IRRATIONALS[text]) == 0


@pytest.mark.parametrize("text", IN_GAMMA)
def test_expressions_in_a_parameter_are_rational_functions_of_it(text):
    value = read_number(text, ["gamma"]).value
    assert isinstance(value, RationalFunction)
    assert value == IN_GAMMA[text]


def test_a_parameter_that_cancels_leaves_a_rational_number():
    for text in ("γ - γ + 1/2", "γ/(2γ)", "(1+γ)/(2+2γ)"):
        value = read_number(text, ["gamma"]).value
        assert isinstance(value, fmpq)
        assert value == fmpq(1, 2)


def test_a_parameter_may_stand_beside_irrational_numbers_and_other_parameters():
    assert read_number("e^(-γ)", ["gamma"]).value == exp(-gamma)
    assert read_number("sqrt(2)γ", ["gamma"]).value == sqrt(2) * gamma
    alpha = sympy.Symbol("alpha", positive=True)
    assert read_number("α γ + 1", ["gamma", "alpha"]).value == alpha * gamma + 1


@pytest.mark.parametrize(
    ("text", "echo", "decimal"),
    [
        ("3/4", "3/4", False),
        (".5", "0.5", True),
        ("3.", "3", True),
        ("1E3", "1e3", True),
        ("75%", "75%", True),
        ("1+2γ", "1 + 2*gamma", False),
        ("exp(−1/8)", "exp(-1/8)", False),
        ("1 3/4", "7/4", False),
        ("√2", "sqrt(2)", False),
        ("e⁻²", "e^(-2)", False),
        ("((1+γ))/(2(3))", "(1 + gamma)/(2*3)", False),
    ],
)
def test_a_reading_shows_how_it_was_read(text, echo, decimal):
    reading = read_number(text, ["gamma"])
    assert (reading.echo, reading.decimal) == (echo, decimal)


def test_a_long_echo_is_cut():
    echo = read_number("+".join(["1/7"] * 50)).echo
    assert len(echo) == 60
    assert echo.endswith("…")


REFUSED = {
    "": "Nothing was typed.",
    " \n ": "Nothing was typed.",
    "x =": "Nothing was typed.",
    "foo": "'foo' is not something this answer may contain",
    "beta": "it may contain gamma.",
    "α": "it may contain gamma.",
    "__import__('os')": "'os' is not something this answer may contain",
    "3,5": "3,5 has a decimal comma; write 3.5.",
    "-0,500": "0,500 has a decimal comma; write 0.500.",
    "exp(0,5)": "0,5 has a decimal comma; write 0.5.",
    "1,000": "'1,000' may be '1.000' or '1000'; write the one that is meant.",
    "1,000,000.5": "write '1000000.5'",
    "1, 2": "One number is needed",
    "1; 2": "One number is needed",
    "nan": "'nan' is not a number",
    "-inf": "'inf' is not a number",
    "Infinity": "'Infinity' is not a number",
    "∞": "'∞' is not a number",
    "1/0": "divides by zero",
    "0^-1": "divides by zero",
    "1/(γ-γ)": "divides by zero",
    "1/(sqrt(2)sqrt(3)-sqrt(6))": "divides by zero",
    "1/((1+√2)^2-3-2sqrt(2))": "cannot be told from zero",
    "1/2γ": "two ways; write brackets",
    "1/2 sqrt(3)": "two ways; write brackets",
    "1/2(3)": "two ways; write brackets",
    "e^2γ": "two ways; write brackets",
    "ln 2/3": "two ways; put it in brackets",
    "ln2/3": "two ways; put it in brackets",
    "log2(8)": "log is the natural logarithm here; write ln(…)/ln(2)",
    "√2^2": "two ways; put it in brackets",
    "2/1 3/4": "two ways here; put brackets",
    "1 3/4γ": "two ways here; put brackets",
    "1 7/4": "must be below one",
    "1 2": "'1 2' are two numbers",
    "γ 2": "'2' follows without a sign",
    "5 % 3": "'3' follows without a sign",
    "exp -1": "Put what exp is taken of in brackets",
    "sin^-1(1)": "Put what sin is taken of in brackets",
    "ln^2(2)": "Put what ln is taken of in brackets",
    "1 +": "A number is missing after '+'",
    "* 3": "A number is missing before '*'",
    "(1 + 2": "close the bracket",
    "1 + 2)": "was not opened",
    "()": "A number is missing before ')'",
    "1 = 2": "It says '1' and '2', which differ; write one number.",
    "x = 1/2 = 0.6": "It says '1/2' and '0.6', which differ; write one number.",
    "sqrt(-2)": "root of a negative number",
    "ln(0)": "above zero has a logarithm",
    "log(1 - e)": "above zero has a logarithm",
    "tan(pi/2)": "not a real number",
    "2^γ": "Only e is raised",
    "2^1001": "1000 is the largest",
    "9**9**9": "1000 is the largest",
    "e^101": "100 is the largest",
    "exp(10^30 ln 2)": "100 is the largest",
    "2^(1/13)": "whole numbers or fractions down to",
    f"sqrt({41 * '1'})": "at most 40 digits",
    "." + "1" * 41: "40 digits are the most",
    "1e1001": "1000 is the largest",
    "3\u200b": "invisible character (U+200B)",
    "\u202e3": "invisible character (U+202E)",
    "3\x00": "invisible character (U+0000)",
    "3" * 2001: "longer than 2000 characters",
    "(" * 41 + "1" + ")" * 41: "nests deeper",
}


@pytest.mark.parametrize("text", REFUSED)
def test_what_is_no_number_is_refused_with_a_sentence(text):
    assert REFUSED[text] in refusal(read_number, text, ["gamma"]).message


@pytest.mark.parametrize(
    ("text", "position"),
    [("1 + foo", 4), ("  1 + foo", 6), ("½ + foo", 4), ("3\u200b", 1), ("x = 1 + @", 8), ("", None)],
)
def test_a_refusal_names_the_column(text, position):
    assert refusal(read_number, text).position == position


VECTORS = [
    "1, -2",
    "[1 -2]",
    "(1; -2)",
    "[1, -2]",
    "1; -2",
    "(1, -2)^T",
    "[1 -2]'",
    "⟨1, −2⟩",
    "1\n-2",
    "x = (1, -2)",
    "[[1], [-2]]",
    "[[1, -2]]",
    "[2/2 2-4]",
    "[ 1 , -2 ]",
    "(1, -2)ᵀ",
    "1,\n-2",
    "{1, -2}",
    "1, -2.",
    "1/2 (2, -4)",
    "0.5*[2 -4]",
    "-1 [-1, 2]",
    "\\frac12 [2, -4]",
    "v = (1/3)*(3; -6)",
]


@pytest.mark.parametrize("text", VECTORS)
def test_vectors(text):
    assert values(read_vector(text, 2)) == [1, -2]


def test_entries_of_vectors_may_be_expressions():
    assert values(read_vector("[1/2, sqrt(2)]", 2)) == [fmpq(1, 2), sqrt(2)]
    assert values(read_vector("[1 - 2 3]")) == [-1, 3]
    assert values(read_vector("[sqrt 4 3]")) == [2, 3]
    assert values(read_vector("[2γ (1+γ)]", 2, ["gamma"])) == [2 * GAMMA, 1 + GAMMA]
    assert values(read_vector("1 3/4, 2")) == [fmpq(7, 4), 2]
    assert values(read_vector("[1 3/4]")) == [1, fmpq(3, 4)]
    assert values(read_vector("(1+γ)(1-γ), 2", 2, ["gamma"])) == [1 - GAMMA**2, 2]
    assert values(read_vector("[3]", 1)) == values(read_vector("3", 1)) == [3]


@pytest.mark.parametrize(
    ("text", "length", "fragment"),
    [
        ("1, 2", 3, "2 numbers were read, 3 are needed."),
        ("[1]", 2, "1 number was read, 2 are needed."),
        ("3,5", 1, "3,5 has a decimal comma; write 3.5."),
        ("1,000", 1, "'1,000' may be '1.000' or '1000'; write the one that is meant."),
        ("1,5; 2,5", 2, "1,5 has a decimal comma; write 1.5."),
        ("-1 -0,5", 2, "0,5 has a decimal comma; write 0.5."),
        ("x = -1 -0,5", 2, "0,5 has a decimal comma; write 0.5."),
        ("1, 2; 3", 3, "Commas and semicolons are mixed"),
        ("1, foo", 2, "entry 2: 'foo' is not"),
        ("1, , foo", 3, "entry 3: 'foo' is not"),
        (", ,", 2, "entry 1: Nothing was typed."),
        ("[1, 2", 2, "The bracket '[' is not closed"),
        ("[]", 2, "Nothing was typed."),
    ],
)
def test_vectors_refused(text, length, fragment):
    assert fragment in refusal(read_vector, text, length).message


@pytest.mark.parametrize(
    "text", ["(4, 7)/18", "[4 7] / 18", "1/18 (4, 7)", "(1/18)(4; 7)", "1/18 * [4 7]", "(8, 14)/(2*18)", "(4, 7)/√324"]
)
def test_a_factor_or_a_divisor_counts_for_every_entry(text: str) -> None:
    ninths = [fmpq(2, 9), fmpq(7, 18)]
    assert [entry.value for entry in read_vector(text, 2)] == ninths
    assert [reading.value for reading in read_table(text, ("a", "b")).values()] == ninths


def test_the_divisor_of_a_matrix() -> None:
    rows = read_matrix("[22 -12; 3 -14]/34", (2, 2))
    assert [[entry.value for entry in row] for row in rows] == [
        [fmpq(11, 17), fmpq(-6, 17)],
        [fmpq(3, 34), fmpq(-7, 17)],
    ]


@pytest.mark.parametrize("text", ["(4, 7)/18/2", "2 (4, 7)/18", "(4, 7)/2 3"])
def test_what_is_divided_by_more_than_one_thing_is_not_read(text: str) -> None:
    with pytest.raises(Unreadable):
        read_vector(text, 2)
    with pytest.raises(Unreadable):
        read_table(text, ("a", "b"))


def test_each_entry_may_be_divided() -> None:
    assert [entry.value for entry in read_vector("(1 + 2)/3, (4 + 5)/3", 2)] == [1, 3]


@pytest.mark.parametrize("text", ["k <= 4", "k >= 4", "x != 4", "R => 4", "error ≤ 4", "≥ 4", "V(s) =< 4"])
def test_a_bound_is_no_value(text: str) -> None:
    with pytest.raises(Unreadable, match="is no equal sign; write the value alone"):
        read_number(text)
    with pytest.raises(Unreadable):
        read_vector(f"{text}, 5", 2)
    with pytest.raises(Unreadable):
        read_matrix(text.replace("4", "[4 5]"), (1, 2))


def test_lambda_may_be_typed_as_files_have_it() -> None:
    assert read_number("1 + 2 lam", ("lambda",)).value == read_number("1 + 2λ", ("lambda",)).value
    assert read_number("1 + 2 eps", ("epsilon",)).value == read_number("1 + 2ε", ("epsilon",)).value


@pytest.mark.parametrize("text", ["1 + 2e", "1 - e^2", "2/3*e"])
def test_e_is_not_taken_for_the_number_where_it_may_be_epsilon(text: str) -> None:
    with pytest.raises(Unreadable, match="'e' may be ε or the number e; write epsilon"):
        read_number(text, ("epsilon",))
    assert read_number(text, ("gamma",)).value


@pytest.mark.parametrize("text", ["-[2 4]/8", "-1/8 [2 4]", "-[1/4 1/2]", "-(0.25, 0.5)", "[-2 -4]/8"])
def test_a_sign_before_a_bracket_counts_for_every_entry(text: str) -> None:
    assert [entry.value for entry in read_vector(text, 2)] == [fmpq(-1, 4), fmpq(-1, 2)]
    assert [entry.value for entry in read_matrix(text, (1, 2))[0]] == [fmpq(-1, 4), fmpq(-1, 2)]


MOMENTS = {"names": ("μ_1", "Σ_1"), "called": ("mean", "variance")}


@pytest.mark.parametrize(
    "text",
    [
        "μ = 5, σ² = 3",
        "sigma^2 = 3; mu = 5",
        "var 3, mean 5",
        "Σ=3 μ=5",
        "σ_1^2 = 3, μ_1 = 5",
        "mu = 5, sigma2 = 3",
        "μ = 5, σ2 = 3",
        "mean: 5, sigma_2: 3",
    ],
)
def test_the_square_of_a_deviation_is_a_variance(text: str) -> None:
    assert [entry.value for entry in read_vector(text, 2, **MOMENTS)] == [5, 3]


@pytest.mark.parametrize("text", ["mean 5, σ = 3", "μ = 5, sigma = 3", "σ = 3, mean = 5", "5, σ = 3", "N(5, σ=3)"])
def test_a_deviation_is_no_variance(text: str) -> None:
    with pytest.raises(Unreadable, match="is a standard deviation; give the variance"):
        read_vector(text, 2, **MOMENTS)


@pytest.mark.parametrize(
    "text", ["N(5, 3)", "𝒩(5, 3)", "\\mathcal{N}(5, 3)", "N(μ=5, σ²=3)", "x ~ N(5, 3)", "bel = N(5; 3)"]
)
def test_a_normal_distribution_tells_mean_and_variance(text: str) -> None:
    assert [entry.value for entry in read_vector(text, 2, **MOMENTS)] == [5, 3]


@pytest.mark.parametrize(
    "text",
    ["R0(1) = 5, R0(2) = 3", "R₀⁽²⁾ = 3, R₀⁽¹⁾ = 5", "R_0^(1) = 5; R_0^{(2)} = 3", "R0(1) = 5, R0 = 3", "<5, 3>"],
)
def test_the_return_of_all_steps_may_be_counted_like_the_others(text: str) -> None:
    assert [entry.value for entry in read_vector(text, 2, names=("R_0^(1)", "R_0"))] == [5, 3]


def test_a_line_has_a_slope_and_an_intercept() -> None:
    told = {"names": ("θ̂_1", "θ̂_0"), "called": ("slope", "intercept")}
    for text in ("intercept 3, slope 2", "slope = 2, intercept = 3", "θ_0 = 3, θ_1 = 2"):
        assert [entry.value for entry in read_vector(text, 2, **told)] == [2, 3]


@pytest.mark.parametrize("text", ["1 + 2 gamma", "[1 + 2 (gamma)]", "1 - 2 √2"])
def test_a_space_in_a_product_is_not_taken_for_one_between_entries(text):
    assert (
        "may be a product or two entries; write * or a comma there." in refusal(read_vector, text, 2, ["gamma"]).message
    )


def test_spaces_part_entries_that_are_no_factors():
    for text in ("1 + 2γ 2", "[1 + 2γ  γ]", "2 γ"):
        assert len(read_vector(text, 2, ["gamma"])) == 2


def test_too_few_numbers_of_a_vector_are_told_which_are_needed():
    assert refusal(read_vector, "1", 2, (), ["x", "y"]).message == "1 number was read, 2 are needed: x, y."
    assert refusal(read_vector, "1, 2, 3", 2, (), ["x", "y"]).message == "3 numbers were read, 2 are needed: x, y."
    assert refusal(read_vector, "1, -, 3", 2, (), ["x", "y"]).message == "3 numbers were read, 2 are needed: x, y."
    assert refusal(read_vector, "1, 2", 1, (), ["x"]).message.startswith("One number is needed here, and this goes on")


@pytest.mark.parametrize(
    "text", ["the answer is 1/3", "1/3 (approx. 0.333)", "1/3 (= 0.333)", "R_0: 1/3", "[1/3]", "1/3,"]
)
def test_a_vector_of_one_entry_is_read_as_a_number(text):
    assert values(read_vector(text, 1, (), ["R_0"])) == [fmpq(1, 3)]


MATRICES = [
    "[[1,2],[3,4]]",
    "[1 2; 3 4]",
    "1 2; 3 4",
    "[1, 2; 3, 4]",
    "((1,2),(3,4))",
    "1 2\n3 4",
    "1, 2\n3, 4",
    "K = [1 2\n3 4]",
    "[[1 2]\n [3 4]]",
    "[1 2] [3 4]",
    "[1, 2], [3, 4]",
    "{{1,2},{3,4}}",
    "[[1,3],[2,4]]^T",
    "[1 3; 2 4]'",
    "1, 2;\n3, 4;",
    "1/2 [2 4; 6 8]",
    "K = 2*[[1/2, 1], [3/2, 2]]",
    "1/2 [2 6; 4 8]^T",
    r"\frac{1}{2}\begin{pmatrix}2 & 4\\6 & 8\end{pmatrix}",
]


@pytest.mark.parametrize("text", MATRICES)
def test_matrices(text):
    assert [values(row) for row in read_matrix(text, (2, 2))] == [[1, 2], [3, 4]]
    assert [values(row) for row in read_matrix(text)] == [[1, 2], [3, 4]]


@pytest.mark.parametrize("text", ["1, 2", "1 2", "[1 2]", "[1; 2]", "1\n2", "[(1), (2)]", "1/3 [3 6]"])
def test_a_single_row_or_column_may_be_typed_as_a_vector(text):
    assert [values(row) for row in read_matrix(text, (1, 2))] == [[1, 2]]
    assert [values(row) for row in read_matrix(text, (2, 1))] == [[1], [2]]


@pytest.mark.parametrize("text", ["7/4", "1 3/4", "[7/4]", "[[7/4]]", "L = 7/4"])
def test_a_single_entry_may_be_typed_as_a_number(text):
    assert [values(row) for row in read_matrix(text, (1, 1))] == [[fmpq(7, 4)]]


@pytest.mark.parametrize(
    ("text", "shape", "fragment"),
    [
        ("[1 2 3; 4 5 6]", (2, 2), "A 2×3 matrix was read, 2×2 is needed: 2 rows of 2 numbers, parted by semicolons."),
        ("[[1, 2]]", (2, 1), "A 1×2 matrix was read, 2×1 is needed: 2 rows of 1 number, parted by semicolons."),
        ("[[1, 2]]", (1, 1), "A 1×2 matrix was read, one number is needed."),
        ("[1 2; 3]", (2, 2), "Row 2 has length 1, row 1 has 2"),
        ("[1, 2; 3, x]", (2, 2), "row 2, entry 2: 'x' is not"),
        ("[[1, 2], [3, 1/0]]", (2, 2), "row 2, entry 2: It divides by zero."),
        ("1,5; 2,5", (2, 1), "Decimals are written with a point"),
    ],
)
def test_matrices_refused(text, shape, fragment):
    assert fragment in refusal(read_matrix, text, shape).message


@pytest.mark.parametrize("text", ["1 2/3; 1 1/3", "[1 2/3; 1 1/3]", "1 2/3\n1 1/3", "1 2/3, 1 1/3"])
def test_mixed_numbers_below_each_other(text):
    assert [values(row) for row in read_matrix(text, (2, 1))] == [[fmpq(5, 3)], [fmpq(4, 3)]]
    assert {key: cell.value for key, cell in read_table(text, ["a", "b"]).items()} == {"a": fmpq(5, 3), "b": fmpq(4, 3)}


@pytest.mark.parametrize(
    "text", ["Q1 = 5, Q2 = 6", "arm 1: 5, arm 2: 6", "#2: 6; #1: 5", "s_1: 5\ns_2: 6", "a1 5 a2 6"]
)
def test_numbers_as_names_may_have_a_letter_or_word_before_them(text):
    assert {key: int(cell.value) for key, cell in read_table(text, ["1", "2"]).items()} == {"1": 5, "2": 6}
    assert refusal(read_table, text, ["x", "y"])


@pytest.mark.parametrize("text", ["arm 2", "Arm 2", "a2", "a_2", "#2", "2"])
def test_an_action_that_is_a_number_may_have_a_letter_or_word_before_it(text):
    assert read_words(text, ["next"], {"next": ("1", "2")}) == {"next": ("2",)}
    assert "is not one of 1, 3" in refusal(read_words, text, ["next"], {"next": ("1", "3")}).message


def test_a_factor_with_brackets_and_letters_counts_for_every_entry() -> None:
    rho = generator("rho")
    for text in ("3/(3+2ρ) [1 -1]", "3/(3+2ρ) * [1, -1]", "L = 3/(3+2ρ)[1 -1]"):
        assert read_matrix(text, (1, 2), ["rho"])[0][0].value == 3 / (3 + 2 * rho)
        assert [entry.value for entry in read_matrix(text, (1, 2), ["rho"])[0]] == [
            3 / (3 + 2 * rho),
            -3 / (3 + 2 * rho),
        ]


@pytest.mark.parametrize("text", ["[1 -1]", "[2 +1/3]", "[4 -√2]"])
def test_several_entries_in_brackets_are_no_difference(text: str) -> None:
    assert "holds several entries; one number is needed here" in refusal(read_number, text).message


@pytest.mark.parametrize("text", ["[1, ?; 3, 4]", "[[1, …], [3, 4]]", "1 ?\n3 4", "1/2 [2 -; 6 8]"])
def test_entries_of_a_matrix_may_be_left_out(text):
    assert [[cell and cell.value for cell in row] for row in read_matrix(text, (2, 2))] == [[1, None], [3, 4]]


def test_of_a_matrix_something_must_be_given():
    assert refusal(read_matrix, "[?, ?; ?, ?]", (2, 2)).message.startswith("row 1, entry 1: '?' is not understood")


TABLES = [
    "cool: 3.5, warm: 2.5",
    "cool=3.5; warm=2.5",
    "cool: 3.5\nwarm: 2.5",
    "V(cool) = 3.5, V(warm) = 2.5",
    "warm: 5/2, cool: 7/2",
    "V(cool): 3.5; V(warm): 2.5",
    "V_cool = 3.5, V_{warm} = 2.5",
    "{cool}: 3.5, {warm}: 2.5",
    "3.5, 2.5",
    "[3.5 2.5]",
    "{cool: 3.5, warm: 2.5}",
    "{'cool': 3.5, \"warm\": 2.5}",
    "COOL: 3.5, Warm: 2.5",
    "cool → 3.5, warm -> 2.5",
    "V = 3.5, 2.5",
    "V = (3.5, 2.5)",
]


@pytest.mark.parametrize("text", TABLES)
def test_tables(text):
    table = read_table(text, ["cool", "warm"])
    assert list(table) == ["cool", "warm"]
    assert values(table.values()) == [fmpq(7, 2), fmpq(5, 2)]


PAIRED = [
    "(cool, fast): 1, (cool, slow): 2, (warm, slow): 3",
    "Q(cool,fast)=1; Q(cool,slow)=2; Q(warm,slow)=3",
    "1, 2, 3",
    "cool fast: 1, cool slow: 2, warm slow: 3",
    "cool/fast: 1, cool/slow: 2, warm/slow: 3",
    "cool, fast: 1, cool, slow: 2, warm, slow: 3",
    "{('cool', 'fast'): 1, ('cool', 'slow'): 2, ('warm', 'slow'): 3}",
]


NESTED = [
    "cool: fast 1, slow -2; warm: slow 3/4",
    "cool: fast: 1, slow: -2, warm: slow: 3/4",
    "cool (fast 1, slow -2), warm (slow 3/4)",
    "cool: fast = 1, slow = -2; warm: slow = 0.75",
    "cool → fast → 1, slow → -2; warm → slow → 3/4",
    "fast: cool 1; slow: cool −2, warm 3/4",
    "warm: slow 3/4; cool: slow -2, fast 1/2 + 1/2 = 1",
    "cool: fast 1; slow -2\nwarm: slow 3/4",
]


@pytest.mark.parametrize("text", NESTED)
def test_pairs_may_stand_under_one_of_their_halves(text: str) -> None:
    assert {pair: reading.value for pair, reading in read_table(text, PAIRS).items()} == {
        ("cool", "fast"): 1, ("cool", "slow"): -2, ("warm", "slow"): fmpq(3, 4)
    }  # fmt: skip


@pytest.mark.parametrize("text", ["cool: fast 1, slow - 2; warm: slow 3/4", "cool: fast 1,5, slow 2; warm: slow 3"])
def test_what_may_be_read_otherwise_does_not_stand_under_its_half(text: str) -> None:
    assert refusal(read_table, text, PAIRS).message


@pytest.mark.parametrize(
    "text",
    ["cool = warm = 3", "V(cool) = V(warm) = 3", "cool = warm = 6/2 = 3", "cool=3 and warm=3", "cool: 3 & warm: 3"],
)
def test_keys_of_one_value_may_share_it(text: str) -> None:
    assert {key: reading.value for key, reading in read_table(text, ["cool", "warm"]).items()} == {"cool": 3, "warm": 3}


@pytest.mark.parametrize("text", PAIRED)
def test_tables_over_pairs(text):
    assert {key: reading.value for key, reading in read_table(text, PAIRS).items()} == dict(
        zip(PAIRS, [1, 2, 3], strict=True)
    )


@pytest.mark.parametrize(
    ("text", "keys"),
    [
        ("s₁: 1, s_2: 2, S3: 3", ["s1", "s2", "s_3"]),
        ("s: 1, s': 2, s′′: 3", ["s", "s'", "s''"]),
        ("a: 2, A: 1, b: 3", ["A", "a", "b"]),
        ("e.g. x-y: 1, very  cool: 2, 3: 3", ["e.g. x-y", "very cool", "3"]),
    ],
)
def test_names_of_keys(text, keys):
    assert values(read_table(text, keys).values()) == [1, 2, 3]


@pytest.mark.parametrize(
    ("text", "keys"),
    [
        ("p(west|wall) = 1, p(east | wall) = 2", ["west", "east"]),
        ("p(D|west) = 1, ln p(D|east) = 2", ["west", "east"]),
        ("h(s, bet) = 1, h(s_0,double) = 2", ["bet", "double"]),
        ("pi(bet|s) = 1, π(double|s) = 2", ["bet", "double"]),
        ("V^(π₀)(cool) = 1, V^π(warm) = 2", ["cool", "warm"]),
        ("Q̂(cool) = 1, Q̂_warm = 2", ["cool", "warm"]),
        ("pi1: 1, pi_2: 2", ["π₁", "π₂"]),
        ("pi(1): 1, μ(pi_2): 2", ["π₁", "π₂"]),
        ("ln3: 1, ln2: 2", ["ln3", "ln2"]),
        ("fast: 1, A(slow): 2", [("cool", "fast"), ("cool", "slow")]),
        ("A(s, fast) = 1, π(slow|s) = 2", [("cool", "fast"), ("cool", "slow")]),
        ("cool: 1, Q(warm): 2", [("cool", "fast"), ("warm", "fast")]),
        ("cool 1, warm 2", [("cool", "fast"), ("warm", "slow")]),
        ("warm: 2, (cool, fast): 1", [("cool", "fast"), ("warm", "slow")]),
    ],
)
def test_keys_as_they_are_printed(text, keys):
    table = read_table(text, keys)
    assert list(table) == keys
    assert values(table.values()) == [1, 2]


@pytest.mark.parametrize(
    ("text", "keys", "fragment"),
    [
        ("p(north|wall): 1, west: 2", ["west", "east"], "'p(north|wall)' is not a key here; the keys are west, east."),
        ("p(west|east): 1, west: 2", ["west", "east"], "'p(west|east)' may be any of west, east"),
        ("V(west, fast): 1, east: 2", ["west", "east"], "'V(west, fast)' is not a key here"),
        ("pi3: 1, pi2: 2", ["π₁", "π₂"], "'pi3' is not a key here"),
        ("A(warm, fast): 1, slow: 2", [("cool", "fast"), ("cool", "slow")], "'A(warm, fast)' is not a key here"),
        ("fast: 1, slow: 2, warm slow: 3", PAIRS, "'fast' is not a key here"),
    ],
)
def test_keys_that_are_not_meant(text, keys, fragment):
    assert fragment in refusal(read_table, text, keys).message


@pytest.mark.parametrize(
    "text",
    [
        "cool = warm = 1",
        "V2(cool) = V1(warm) = 1, V2(warm) = 1",
        "V2(cool) = R(cool) = 1, warm = 1",
        "V(cool) = V(cool) = 1, V(warm) = 1",
        "V(warm) = 1, V(cool) = V(warm) = 1",
    ],
)
def test_a_key_before_a_value_shares_it_unless_it_has_one_of_its_own(text: str) -> None:
    assert values(read_table(text, ["cool", "warm"]).values()) == [1, 1]


@pytest.mark.parametrize(
    ("text", "fragment"),
    [
        ("cool: 1, cool: 2", "cool is given twice"),
        ("cool: 1, hot: 2", "'hot' is not a key here; the keys are cool, warm."),
        ("cool 1, hot 2", "'hot' is not a key here; the keys are cool, warm."),
        ("hot 1, warm 2", "'hot' is not a key here; the keys are cool, warm."),
        ("cool: 3,5, warm: 2,5", "may have a decimal comma; write '3.5'."),
        ("cool: 1 hot: 2", "holds two keys; put a comma between them"),
        ("cool: foo, warm: 2", "cool: 'foo' is not"),
        ("cool: , warm: -", "cool: Nothing was typed."),
        ("1, 2, 3", "3 numbers were read, 2 are needed: cool, warm."),
        ("cool, warm: 3", "'cool' is not understood; write it as cool:"),
        ("a=" * 900, "More than 200 keys were typed"),
    ],
)
def test_tables_refused(text, fragment):
    assert fragment in refusal(read_table, text, ["cool", "warm"]).message


@pytest.mark.parametrize(
    "text", ["a: 1, c: 3", "a: 1, b: , c: 3", "a: 1, b: ?, c: 3", "a 1, c 3", "1, , 3", "[1, -, 3]", "V = (1, ?, 3)"]
)
def test_what_is_left_out_of_a_table_is_not_read(text: str) -> None:
    assert {key: reading.value for key, reading in read_table(text, ["a", "b", "c"]).items()} == {"a": 1, "c": 3}


@pytest.mark.parametrize("text", ["R_0 = 1, R_2 = 3", "1, , 3", "1; ?; 3"])
def test_what_is_left_out_of_a_vector_is_none(text: str) -> None:
    read = read_vector(text, 3, names=("R₀", "R₁", "R₂"))
    assert [reading and reading.value for reading in read] == [1, None, 3]


def test_a_key_that_may_be_two_is_refused():
    assert "'AB' may be any of aB, Ab" in refusal(read_table, "AB: 1, ab: 2", ["aB", "Ab"]).message


ACTIONS = {"cool": ["slow", "fast"], "warm": ["slow", "fast"]}


@pytest.mark.parametrize(
    "text",
    [
        "cool: fast, warm: slow",
        "warm = slow; cool = FAST",
        "π(cool) = fast\nπ(warm) = slow.",
        "fast, slow",
        "fast slow",
        "(fast, slow)",
        "cool -> fast, warm → slow",
        "pi = fast, slow",
        "{'cool': 'fast', 'warm': 'slow'}",
    ],
)
def test_policies(text):
    assert read_words(text, ["cool", "warm"], ACTIONS) == {"cool": ("fast",), "warm": ("slow",)}


@pytest.mark.parametrize("text", ["both, slow", "cool: either, warm: slow", "Both; slow"])
def test_both_of_two_actions_are_a_tie(text: str) -> None:
    two = {"cool": ("slow", "fast"), "warm": ("slow", "fast")}
    assert read_words(text, ["cool", "warm"], two) == {"cool": ("slow", "fast"), "warm": ("slow",)}
    three = {"cool": ("slow", "fast", "stop"), "warm": ("slow", "fast")}
    assert "is not one of slow, fast, stop" in refusal(read_words, text, ["cool", "warm"], three).message
    named = {"cool": ("both", "fast"), "warm": ("slow", "fast")}
    assert read_words("both, slow", ["cool", "warm"], named) == {"cool": ("both",), "warm": ("slow",)}


@pytest.mark.parametrize("text", ["any, slow", "cool: all, warm: slow"])
def test_all_actions_are_a_tie(text: str) -> None:
    actions = {"cool": ("slow", "fast", "stop"), "warm": ("slow", "fast")}
    assert read_words(text, ["cool", "warm"], actions) == {"cool": ("slow", "fast", "stop"), "warm": ("slow",)}


@pytest.mark.parametrize("text", ["cool: fast", "cool: fast, warm: ", "fast, -"])
def test_what_is_left_out_of_a_policy_is_not_read(text: str) -> None:
    assert read_words(text, ["cool", "warm"], ACTIONS) == {"cool": ("fast",)}


@pytest.mark.parametrize(
    ("text", "fragment"),
    [
        ("cool: run, warm: slow", "cool: 'run' is not one of slow, fast"),
        ("fast", "1 word was read, 2 are needed: cool, warm."),
        ("hot: fast, warm: slow", "'hot' is not a key here"),
    ],
)
def test_policies_refused(text, fragment):
    assert fragment in refusal(read_words, text, ["cool", "warm"], ACTIONS).message


@pytest.mark.parametrize(
    ("text", "letter"),
    [
        ("b", "b"),
        ("(b)", "b"),
        ("B.", "b"),
        ("b)", "b"),
        ("q-learn", "b"),
        ("SARSA", "a"),
        ("Expected Sarsa", "d"),
        ("exp", "d"),
        ("Q(λ)", "c"),
        ("EXPECTED", "d"),
        ("learning", "b"),
    ],
)
def test_choices(text, letter):
    options = {"a": "Sarsa", "b": "Q-learning", "c": "$Q(λ)$", "d": "Expected Sarsa"}
    assert read_choice(text, options) == letter


@pytest.mark.parametrize(("text", "letter"), [("10", "B"), ("2", "C"), ("n > 1", "A")])
def test_a_number_is_no_word_of_a_choice_but_may_begin_one(text, letter):
    assert read_choice(text, {"A": "n-step TD, with $n > 1$", "B": "10 sweeps", "C": "2 sweeps"}) == letter


def test_a_number_inside_a_choice_does_not_name_it():
    fault = refusal(read_choice, "1", {"A": "TD(0)", "B": "n-step TD, with $n > 1$"})
    assert fault.message == "'1' is not one of the options; type a letter from A to B."


def test_choices_refused():
    options = {"a": "Sarsa with zeal", "b": "Q-learning with zeal", "c": "Q(λ)"}
    assert "'Q' fits more than one option; type a letter from a to c." in refusal(read_choice, "Q", options).message
    assert "'z' is not one of the options" in refusal(read_choice, "z", options).message
    assert "'zeal' fits more than one option" in refusal(read_choice, "zeal", options).message
    assert "'Sar-' is not one of the options" in refusal(read_choice, "Sar-", options).message
    assert "fits more than one" in refusal(read_choice, "a", {"a": "b", "b": "a"}).message
    assert read_choice("(A)", {"A": "b", "B": "a"}) == "A"


def test_yes_and_no():
    assert all(map(read_yes_no, ["yes", "Y", "True", "ja.", " YES! ", "oui", "sí", "sim", "yep"]))
    assert not any(map(read_yes_no, ["no", "N", "false", "Nein", "nope", "non", "não"]))
    assert "'maybe' is neither yes nor no" in refusal(read_yes_no, "maybe").message


@pytest.mark.parametrize(
    "why", [", det J = 1", " (det = 1)", ": it is regular.", " because det J = 1", " – since 1 ≠ 0"]
)
def test_yes_or_no_may_have_its_reason(why: str) -> None:
    assert read_yes_no(f"yes{why}")
    assert not read_yes_no(f"No{why}")


@pytest.mark.parametrize(
    "text", ["yes, no", "y, n", "yes (n)", "no, yes it is", "yes (or no)", "yes and no", "no idea", "y/n", "not, as"]
)
def test_what_is_no_plain_yes_or_no(text: str) -> None:
    assert "is neither yes nor no; type one of them." in refusal(read_yes_no, text).message


def test_a_reason_may_stand_behind_any_answer() -> None:
    options = {"A": "large", "B": "small"}
    for why in (
        " because B is worse",
        ", since 11 < 18",
        " weil B größer ist",
        ", lower BIC",
        " (lower BIC)",
        ": 11 < 18",
    ):
        assert read_choice(f"A{why}", options) == "A"
    assert read_choice('["A"]', options) == read_choice("large because 11 < 18", options) == "A"
    assert read_number("2.5 because γ = 1/2").value == fmpq(5, 2)
    assert read_yes_no("yes, since no action is better")
    words = read_words("cool: fast (12 > 9), warm: slow because 6 > 1", ["cool", "warm"], ACTIONS)
    assert words == {"cool": ("fast",), "warm": ("slow",)}
    assert read_words("cool: fast and warm: slow", ["cool", "warm"], ACTIONS) == words
    assert read_words("fast, since 5 > 4", ["cool"], {"cool": ("fast", "slow")}) == {"cool": ("fast",)}


@pytest.mark.parametrize("text", ["A, B", "A or B", "A, not B", "A (B)"])
def test_two_letters_are_no_option_and_its_reason(text: str) -> None:
    assert "is not one of the options" in refusal(read_choice, text, {"A": "large", "B": "small"}).message


def test_odds_are_a_quotient() -> None:
    assert read_number("2:15").value == read_number("1 : 7.5").value == fmpq(2, 15)


@pytest.mark.parametrize("typed", ["0: 4.5", "1: 4.5", "1:4.5", "2: 9/2", "1: 4"])
def test_what_may_be_the_number_of_a_question_is_no_odds(typed: str) -> None:
    with pytest.raises(Unreadable):
        read_number(typed)


READERS = [
    lambda text: read_number(text, ["gamma"]),
    lambda text: read_vector(text, 2, ["gamma"]),
    lambda text: read_vector(text, 2, ["gamma"], ["μ", "Σ"]),
    lambda text: read_matrix(text, (2, 2), ["gamma"]),
    lambda text: read_matrix(text, None, ["gamma"]),
    lambda text: read_table(text, ["cool", "warm"], ["gamma"]),
    lambda text: read_table(text, PAIRS, ["gamma"]),
    lambda text: read_words(text, ["cool", "warm"], ACTIONS),
    lambda text: read_choice(text, {"a": "Sarsa", "b": "Q-learning"}),
    read_yes_no,
]

HOSTILE = [
    "9" * 10**6,
    "(" * 10**5,
    "(" * 1999,
    "[" * 1999,
    "[(" * 999,
    "9**9**9**9",
    "9^9^9^9^9",
    "1e999999999",
    "e^e^e^e^e^e",
    "2^" * 900 + "2",
    "sqrt(" * 30 + "2" + ")" * 30,
    "sqrt(1+" * 30 + "2" + ")" * 30,
    "exp(-" * 39 + "1" + ")" * 39,
    "√" * 1999,
    "-" * 1999,
    "- " * 999 + "1",
    "(1+gamma)^64^64",
    "((gamma+1)^64)^64",
    "((1+sqrt(2))^64)^64",
    "(sqrt(γ)(1+γ)^12)^64",
    "exp(100)^64",
    "exp(exp(exp(exp(1))))",
    "__import__('os').system('true')",
    "().__class__.__bases__",
    "lambda: 0",
    "x = " * 500,
    "x(" * 900,
    "x(a)" * 490,
    "a b " * 490,
    "{" * 999 + "}" * 999,
    "1%" + "%" * 1990,
    "1" + "²" * 1990,
    "2²" * 990,
    "1+" * 990 + "1",
    "γ+" * 990 + "1",
    "γ*" * 990 + "1",
    "[" + "γ " * 990 + "]",
    "[" + "√2," * 600 + "1]",
    "+".join(f"sqrt({n})" for n in range(2, 220)),
    "*".join(f"sqrt({10**11 + n})" for n in range(2, 100)),
    "+".join(f"1/({n}+γ)" for n in range(2, 220)),
    "*".join(f"(1+exp(1/{n}))" for n in range(2, 120)),
    "((γ+1)^12/(γ+2)^12)+" * 90 + "1",
    "exp(ln(10)*10^30)",
    "(γ+1/9999999999)^24",
    "999999999989^(63/12)",
    "sin(10^40)",
    "tan(pi/240)",
    "exp(2 sin((tan(10)-7)^64))",
    "exp((1+√2)^2-3-2*√2)",
    "1;" * 990,
    "a:1," * 490,
    "\n" * 1990 + "1",
    "1\n" * 990,
]


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_hostile_texts_take_no_time(text):
    read_number("sqrt(2) + exp(γ) + sin(1)", ["gamma"])
    for read in READERS:
        complaint(read, "a: 1, 2")  # what is imported for it is there now
        with at_once():
            unreadable = complaint(read, text)
        assert unreadable is None or len(unreadable.message) < 300


@given(st.text(max_size=60))
def test_no_text_raises_anything_else(text):
    for read in READERS:
        if unreadable := complaint(read, text):
            assert unreadable.message.isprintable()
            assert unreadable.position is None or 0 <= unreadable.position <= len(text)


PIECES = [
    "1",
    "0",
    "2.5",
    "γ",
    "e",
    "pi",
    "sqrt",
    "exp",
    "ln",
    "max",
    "(",
    ")",
    "[",
    "]",
    "+",
    "-",
    "*",
    "/",
    "^",
    "%",
    "²",
    ",",
    ";",
    " ",
    "\n",
    ":",
    "=",
    "cool",
    "warm",
    "fast",
    "'",
    "√",
    "½",
]


@given(st.lists(st.sampled_from(PIECES), max_size=25).map("".join))
@example("1\n,")
def test_no_jumble_of_known_pieces_raises_anything_else(text):
    for read in READERS:
        if unreadable := complaint(read, text):
            assert unreadable.message.isprintable()


def written(number: Fraction) -> list[str]:
    """Some ways in which a person writes a rational number."""
    sign, size = ("-" if number < 0 else ""), abs(number)
    ways = [str(number), str(number).replace("-", "−"), f" {number.numerator} / {number.denominator} "]
    ways += [f"({number})", f"({number * 100})%"]
    if size > 1 and size.denominator > 1:
        ways.append(f"{sign}{size // 1} {size % 1}")
    scaled, places = size, 0
    while scaled.denominator > 1 and places < 12:
        scaled, places = scaled * 10, places + 1
    if scaled.denominator == 1:
        ways.append(f"{sign}{scaled}e-{places}")
        digits = str(scaled).rjust(places + 1, "0")
        ways.append(f"{sign}{digits[: len(digits) - places]}.{digits[len(digits) - places :]}")
    return ways


@given(
    st.fractions(max_denominator=10**6).filter(lambda number: abs(number) < 10**9).map(Fraction)
    | st.decimals(min_value=-1000, max_value=1000, places=4).map(Fraction)
)
def test_every_rational_is_read_however_it_is_written(number):
    for text in written(number):
        value = read_number(text).value
        assert isinstance(value, fmpq)
        assert value == rational(number), text


def combined(parts: st.SearchStrategy) -> st.SearchStrategy:
    return st.one_of(
        st.tuples(st.sampled_from("+-*/"), parts, parts),
        st.tuples(st.just("neg"), parts),
        st.tuples(st.just("^"), parts, st.integers(-2, 3)),
    )


TREES = st.recursive(small(0, 20, 12), combined, max_leaves=10)


def computed(tree) -> Fraction:
    """The tree's value, by Python's own fractions."""
    if isinstance(tree, Fraction):
        return tree
    operator, left, *right = tree
    value = computed(left)
    if operator == "neg":
        return -value
    if operator == "^":
        return value ** right[0]
    other = computed(right[0])
    return {"+": value.__add__, "-": value.__sub__, "*": value.__mul__, "/": value.__truediv__}[operator](other)


def typed(tree, above: int = 0) -> str:
    """The tree as text with the fewest brackets; ``above`` is how strongly its surroundings bind."""
    if isinstance(tree, Fraction):
        text, rank = str(tree), 4 if tree.denominator == 1 else 2
    elif tree[0] == "neg":
        text, rank = f"-{typed(tree[1], 2)}", 0
    elif tree[0] == "^":
        text, rank = f"{typed(tree[1], 4)}^{tree[2]}", 3
    else:
        rank = 1 if tree[0] in "+-" else 2
        text = f"{typed(tree[1], rank)} {tree[0]} {typed(tree[2], rank + 1)}"
    return text if rank >= above else f"({text})"


@settings(max_examples=300)
@given(TREES)
def test_expressions_read_back_to_the_same_value(tree):
    text = typed(tree)
    try:
        value = computed(tree)
    except ZeroDivisionError:
        assert "divides by zero" in refusal(read_number, text).message
        return
    if len(str(value)) > 300:
        return
    reading = read_number(text)
    assert reading.value == rational(value)
    if not reading.echo.endswith("…"):
        assert read_number(reading.echo).value == reading.value


def test_a_reading_cannot_be_changed():
    reading = read_number("1")
    assert isinstance(reading, Reading)
    with pytest.raises(AttributeError):
        reading.value = 2


@pytest.mark.parametrize("text", ["≈0.25", "$1/4$", "[1/4]", "x = 1/4", "~ 25%"])
def test_what_people_put_around_a_number(text):
    assert read_number(text).value == fmpq(1, 4)


@pytest.mark.parametrize("text", ["R_0 = 2; R_1 = 0; R_2 = 4", "2 0 4", "R = 2, 0, 4", "R = [2 0 4]"])
def test_what_people_put_around_a_vector(text):
    assert [reading.value for reading in read_vector(text, 3)] == [2, 0, 4]


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("mu: 1, Sigma: 2", ["μ_{1}", "Σ_{1}"]),
        ("Sigma_1 = 2; mu_1 = 1", ["μ_{1}", "Σ_{1}"]),
        ("μ̄₁ = 1, Σ̄₁ = 2", ["μ̄_{1}", "Σ̄_{1}"]),
        ("y: 2, x: 1", ["x", "y"]),
        ("∂J/∂θ₁ = 1, dJ/dtheta_2 = 2", ["∂J/∂θ_{1}", "∂J/∂θ_{2}"]),
        ("mean: 1, variance: 2", ["μ", "Σ"]),
        ("theta: 1, theta: 2", ["θ_{1}", "θ_{2}"]),
    ],
)
def test_entries_of_vectors_by_name(text, names):
    assert values(read_vector(text, 2, (), names)) == [1, 2]


@pytest.mark.parametrize(
    "text",
    [
        "mean 1, variance 2",
        "mean 1 variance 2",
        "Variance 2 mean 1",
        "Variance = 2, Mean = 1",
        "v: 2, m: 1",
        "Sigma: 2, mean: 1",
        "variance 2; mu = 1",
    ],
)
def test_entries_of_vectors_by_what_they_are_called(text):
    assert values(read_vector(text, 2, (), ["μ_{1}", "Σ_{1}"], called=("mean", "variance"))) == [1, 2]


@pytest.mark.parametrize("text", ["a = 1, b = 2", "G_2 = 1, G_10 = 2", "m: 1; M: 2", "b = 1, b = 2"])
def test_names_that_are_not_known_count_in_their_own_order(text):
    assert values(read_vector(text, 2, (), ["x", "y"])) == [1, 2]


@pytest.mark.parametrize("text", ["b = 2, a = 1", "variance = 2, mean = 1", "G_10: 2, G_2: 1"])
def test_names_that_are_not_known_may_mean_another_order(text):
    assert "is not asked for here" in refusal(read_vector, text, 2, (), ["x", "y"]).message


def test_one_named_entry_of_several_leaves_out_the_others():
    assert [reading and reading.value for reading in read_vector("y = 2", 2, (), ["x", "y"])] == [None, 2]
    assert "1 number was read, 2 are needed" in refusal(read_vector, "R = 2", 2, (), ["x", "y"]).message
    for text in ("variance 2", "Variance: 2", "var = 2"):
        alone = read_vector(text, 2, (), ["μ", "Σ"], called=("mean", "variance"))
        assert [reading and reading.value for reading in alone] == [None, 2]


def test_an_entry_that_is_given_twice_is_refused():
    assert "Entry 1 is given twice" in refusal(read_vector, "x: 1, x: 2", 2, (), ["x", "y"]).message


@pytest.mark.parametrize("text", ["x [1 2]", "1/2, [1 2]", "sqrt [1 2]"])
def test_only_a_number_multiplies_a_bracket(text):
    assert refusal(read_vector, text, 2)


@pytest.mark.parametrize("text", ["R_0: .25", "answer: 1/4", "The answer is 1/4", "V(s): 0.25", "p(s|a): 25%"])
def test_what_is_said_before_a_number_is_left_out(text):
    assert read_number(text).value == fmpq(1, 4)


@pytest.mark.parametrize("text", ["1:4:2", "2 V: 1/4", "a: b: 1/4"])
def test_a_colon_elsewhere_is_not_understood(text):
    assert "':'" in refusal(read_number, text).message


@pytest.mark.parametrize("text", ["sin^2(30°)", "sin²(30°)", r"\sin^{2}(30°)", "1 - cos^2(30°)"])
def test_a_power_of_a_function_of_angles(text):
    assert read_number(text).value == fmpq(1, 4)


def test_two_forms_of_different_shapes_are_not_equal():
    assert "are not equal" in refusal(read_matrix, "1,=1,1").message


def test_a_number_stands_in_the_brackets_of_a_list_or_of_a_matrix_and_in_no_more() -> None:
    assert [read_number(text).value for text in ("7/4", "[7/4]", "[[7/4]]")] == [fmpq(7, 4)] * 3
    with pytest.raises(Unreadable, match="use round brackets"):
        read_number("[[[7/4]]]")


@pytest.mark.parametrize("typed", ["C, small", "C, or small", "C (small)", "C; all alike", "C - small", "none (small)"])
def test_two_options_at_once_are_no_answer(typed: str) -> None:
    options = {"A": "small", "B": "all alike", "C": "none"}
    with pytest.raises(Unreadable):
        read_choice(typed, options)


def test_a_reason_may_speak_of_the_other_options() -> None:
    options = {"A": "small", "B": "large", "C": "none"}
    for typed in ("C, small and large do the same", "C, none", "none (they are too small)", "C (none)"):
        assert read_choice(typed, options) == "C"


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("53/8 γ", "(53/8)*γ"), ("4 + 15/4 γ", "4 + (15/4)*γ"), ("-1/2 γ^2", "-(1/2)*γ^2"),
        ("3 - 1/2 γ + 1", "4 - γ/2"), ("(1/2 gamma)", "γ/2"), ("1/8 γ/2", "γ/16"),
    ],
)  # fmt: skip
def test_a_letter_a_blank_behind_a_fraction_is_its_factor(text: str, same: str) -> None:
    assert read_number(text, ["gamma"]).value == read_number(same, ["gamma"]).value


@pytest.mark.parametrize(
    "text", ["1/2γ", "1 / 2 γ", "1/2\\gamma", "$1/2 \\gamma$", "γ/8 γ", "2*3/4 γ", "1/2/3 γ", "1/2 (1+γ)", "1.5/2.5 γ"]
)
def test_a_factor_below_or_beside_a_line_stays_ambiguous(text: str) -> None:
    assert "two ways" in refusal(read_number, text, ["gamma"]).message
