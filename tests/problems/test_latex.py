"""LaTeX that is not complete, or may be read in two ways: what is said, and the column of what it is about."""

import pytest

from rldrill.problems.latex import typed
from rldrill.problems.spelling import Unreadable
from rldrill.solutions.answers.text import read_number

#: The text, what it is about (to the end of the text), and what is said.
REFUSED = [
    (r"1 + 2\frac13", r"\frac13", "It may be 2 + 1/3 or 2*1/3; write the one that is meant."),
    (r"3 \frac{1}{2}", r"\frac{1}{2}", "It may be 3 + 1/2 or 3*1/2; write the one that is meant."),
    (r"1 + \frac{1}{2", r"{2", "The bracket '{' is not closed; close it."),
    (r"1 + \sqrt{2", r"{2", "The bracket '{' is not closed; close it."),
    (r"1 + \sqrt[3", r"[3", "The bracket '[' is not closed; close it."),
    (r"1 + \var", r"\var", "The command '\\var' is not understood; write it in plain signs."),
    (r"1 + \foo", r"\foo", "The command '\\foo' is not understood; write it in plain signs."),
    (r"\frac{1}{2} + @", "@", "'@' is not understood here"),
    (r"\frac12@", "@", "'@' is not understood here"),
    (r"\sqrt[3]{8} + @", "@", "'@' is not understood here"),
    (r"2\gamma + @", "@", "'@' is not understood here"),
    (r"$2\gamma$ + @", "@", "'@' is not understood here"),
    (r"\left( 2 \right) + @", "@", "'@' is not understood here"),
    (r"0.\overline{3} + @", "@", "'@' is not understood here"),
    (r"\frac{a}{2}", "a}{2}", "'a' is not something this answer may contain"),
    (r"\frac{2}{a}", "a}", "'a' is not something this answer may contain"),
]


@pytest.mark.parametrize(("text", "about", "said"), REFUSED)
def test_what_is_refused_and_its_column(text: str, about: str, said: str) -> None:
    with pytest.raises(Unreadable) as refused:
        read_number(text, ["gamma"])
    assert said in refused.value.message
    assert refused.value.position == len(text) - len(about)


@pytest.mark.parametrize("text", [r"1 + \frac", r"1 + \sqrt", r"\frac{1}", r"\frac{1}{}", r"\boxed", r"\sqrt[3]"])
def test_a_command_that_is_applied_to_nothing_is_refused(text: str) -> None:
    with pytest.raises(Unreadable, match="is applied to nothing; complete it") as refused:
        typed(text, 100)
    # The last sign before the place where something is missing.
    assert refused.value.position == len(text.removesuffix("{}")) - 1


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        (r"\frac12", "((1)/(2))"),
        (r"\frac 1 2", "((1)/(2))"),
        (r"\dfrac{a}{b}", "((a)/(b))"),
        (r"(3)\frac12", "(3)((1)/(2))"),
        (r"3.5\frac12", "3.5((1)/(2))"),
        (r"x2\frac12", "x2((1)/(2))"),
        (r"3\frac{a}{2}", "3((a)/(2))"),
        (r"\sqrt2", "sqrt(2)"),
        (r"\sqrt[3]{8}", "((8)^(1/3))"),
        (r"2\sqrt3", "2sqrt(3)"),
        (r"a\sqrt3", "a sqrt(3)"),
        (r"2\gamma", "2γ"),
        (r"\varepsilon\lambda\Lambda", "ελΛ"),
        (r"a\cdot b \times c", "a* b * c"),
        (r"a\max b", "a max b"),
        (r"\mathrm{ab}c", "abc"),
        (r"\bigl(\frac12\bigr)", "(((1)/(2)))"),
        (r"\overline{12}", "1\u03052\u0305"),
        (r"\dot{1}2", "1\u03072"),
        (r"25\%", "25%"),
        (r"$x$", "x"),
        (r"5$", "5$"),
        (r"a \\ b", r"a \\ b"),
    ],
)
def test_a_command_in_plain_signs(text: str, plain: str) -> None:
    assert typed(text, 100).text == plain
