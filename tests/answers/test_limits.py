"""What is read of a size, and what is one larger and refused: both sides of every limit that a person may meet."""

import pytest
from flint import fmpq

from rldrill.problems.grammar import read
from rldrill.problems.latex import typed
from rldrill.solutions.answers.text import Unreadable, read_matrix, read_number, read_table, read_vector

#: The largest that is read, the smallest that is not, and what is said of it.
LIMITS = {
    "digits": ("1" * 2000, "1" * 2001, "2000 digits are the most"),
    "digits behind the point": ("0." + "1" * 39, "0." + "1" * 40, "40 digits are the most"),
    "digits of a fraction": ("1 1/" + "3" * 40, "1 1/" + "3" * 41, "40 digits are the most"),
    "power of ten": ("1e1000", "1e1001", "1000 is the largest"),
    "negative power of ten": ("1e-1000", "1e-1001", "1000 is the largest"),
    "brackets": ("(" * 40 + "1" + ")" * 40, "(" * 41 + "1" + ")" * 41, "nests deeper than 40 brackets"),
    "braces": ("\\boxed{" * 40 + "1" + "}" * 40, "\\boxed{" * 41 + "1" + "}" * 41, "deeper than 40 brackets"),
    "signs before a number": ("- " * 40 + "1", "- " * 41 + "1", "Too many signs"),
    "operations": ("+".join("1" * 301), "+".join("1" * 302), "more than 300 operations"),
    "forms of one number": ("=".join("1" * 8), "=".join("1" * 9), "given too often"),
    "characters": ("1" + " " * 1999, "1" + " " * 2000, "longer than 2000 characters"),
    "repeated digits": ("0.(" + "3" * 79 + ")", "0.(" + "3" * 80 + ")", "too long for a number"),
    "exponent": ("2^1000", "2^1001", "1000 is the largest"),
    "negative exponent": ("2^-1000", "2^-1001", "1000 is the largest"),
    "exponent of a root": ("(√2)^64", "(√2)^65", "64 is the largest"),
    "exponent of e": ("e^100", "e^101", "with e, 100 is the largest"),
    "negative exponent of e": ("e^-100", "e^-101", "with e, 100 is the largest"),
    "exponent of e with a parameter, at a half": ("e^(200γ)", "e^(201γ)", "with e, 100 is the largest"),
    "root": ("2^(1/12)", "2^(1/13)", "fractions down to 1/12"),
    "number under a root": ("sqrt(10^40)", "sqrt(10^40 + 1)", "at most 40 digits"),
    "number under a root of a fraction": ("sqrt(1/10^40)", "sqrt(1/(10^40 + 1))", "at most 40 digits"),
    "angle": ("sin(1000)", "sin(1001)", "angles up to 1000"),
    "negative angle": ("cos(-1000)", "cos(-1001)", "angles up to 1000"),
    "arguments of max": (f"max({', '.join('1' * 20)})", f"max({', '.join('1' * 21)})", "this goes on after it"),
    "arguments of min": (f"min({'; '.join('1' * 20)})", f"min({'; '.join('1' * 21)})", "this goes on after it"),
    **{
        f"arguments of {name}": (f"{name}(1)", f"{name}(1; 1)", "this goes on after it")
        for name in ("sqrt", "exp", "ln", "log", "sin", "cos", "tan", "abs")
    },
    "digits beside a root": (f"√2·{'1' * 1200}", f"√2·{'1' * 1205}", "grows too large"),  # 2^4000 has 1205 digits
    "degree": ("(1 + γ)^24", "(1 + γ)^25", "grows too large"),
    "degree of a product": ("(1 + γ)^12 (2 + γ)^12", "(1 + γ)^12 (2 + γ)^13", "grows too large"),
    "degree under a function": ("exp(γ^4)", "exp(γ^5)", "grows too large"),
    "functions in one another": ("√(1+√(1+√(1+√2)))", "√(1+√(1+√(1+√(1+√2))))", "too deep in one another"),
    "functions of a parameter": ("exp(exp(γ))", "exp(exp(exp(γ)))", "too deep in one another"),
}  # fmt: skip


@pytest.mark.parametrize("limit", LIMITS)
def test_the_largest_is_read_and_the_next_refused(limit: str) -> None:
    largest, larger, complaint = LIMITS[limit]
    longest = 2000 if limit == "characters" else 5000
    read_number(largest, ["gamma"], longest)
    with pytest.raises(Unreadable) as refused:
        read_number(larger, ["gamma"], longest)
    assert complaint in refused.value.message


def test_sixty_signs_are_shown_back_and_no_more() -> None:
    sixty = "1000" + " + 1" * 14
    assert read_number(sixty).echo == sixty
    assert read_number(f"{sixty}0").echo == f"{sixty[:-1]}…"


def test_so_many_entries_and_keys_are_read() -> None:
    assert len(read_vector(", ".join("1" * 200))) == 200
    with pytest.raises(Unreadable, match="More than 200 numbers"):
        read_vector(", ".join("1" * 201))
    assert len(read_vector(", ".join("1" * 300), 300)) == 300  # so many as are asked for
    with pytest.raises(Unreadable, match="More than 300 numbers"):
        read_vector(", ".join("1" * 301), 300)
    states = [f"s{index}" for index in range(200)]
    assert len(read_table(", ".join(f"{state}: 1" for state in states), states)) == 200
    with pytest.raises(Unreadable, match="More than 201 keys"):
        read_table(", ".join(f"{state}: 1" for state in [*states, "t", "u"]), states)
    many = [f"s{index}" for index in range(300)]
    assert len(read_table(", ".join(f"{state}: 1" for state in many), many, (), (), 5000)) == 300


def test_a_quotient_of_long_whole_numbers_is_read() -> None:
    above, below = "7" * 60, "3" * 60
    assert read_number(f"{above}/{below}").value == fmpq(7, 3)
    assert read_number(f"-{above} = -{above}/1").value == -int(above)
    with pytest.raises(Unreadable, match="divides by zero"):
        read_number(f"{above}/{'0' * 41}")


@pytest.mark.parametrize(
    "term", ["√4", "sqrt(4)", "(2)", "2^1", "2^(1)", "\\boxed{2}", "ln e", "max(1, 2)", "-(-2)", "∛8"]
)
def test_what_stands_side_by_side_is_not_nested(term: str) -> None:
    assert read(typed(" + ".join([term] * 45), 2000))


def test_a_matrix_of_closed_forms_is_read_as_its_rows_are() -> None:
    entry = "-3*sin(2)/4 - cos(2)/2"
    matrix = read_matrix(f"[{entry} {entry} {entry}; {entry} {entry} {entry}; {entry} {entry} {entry}]", (3, 3))
    assert len({cell.value for row in matrix for cell in row if cell is not None}) == 1
