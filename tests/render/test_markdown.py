"""Mathematics in Markdown is still itself when Markdown has been read, as GitHub does it: first that, then formulas."""

import re
from collections.abc import Iterator

import pytest
from markdown_it import MarkdownIt
from markdown_it.token import Token

import rldrill
from rldrill.problems.document import Equation, Paragraph, Table
from rldrill.problems.mathematics import Accent, Big, Fence, Row, Script, operator, row, variable, word
from rldrill.render.markdown import markdown

_READER = MarkdownIt("commonmark").enable("table")
_FORMULA = re.compile(r"(?<![\\$])\$(?!\$)(?:[^$\\]|\\.)+\$(?!\$)")


def inline(text: str) -> Iterator[Token]:
    return (token for token in _READER.parse(text) if token.type == "inline")


def read(token: Token) -> str:
    """What Markdown leaves of a line, as text."""
    return "".join(part.content if part.type.startswith("text") else "\n" for part in token.children or ())


@pytest.mark.parametrize("family", rldrill.families())
def test_markdown_takes_nothing_of_the_mathematics_for_its_own(family: str) -> None:
    for level in (1, 2, 3):
        exercise = rldrill.draw(family, level, 11)
        for token in inline(markdown((*exercise.question(), *exercise.working(), *exercise.hint()))):
            assert not [part for part in token.children or () if part.type in ("em_open", "link_open", "html_inline")]
            for formula in _FORMULA.findall(token.content):
                assert formula in read(token), "Markdown has changed it"


def test_stars_underscores_braces_and_bars_are_written_otherwise() -> None:
    hat = Script(Accent(variable("x"), "hat"), variable("t"))
    chosen = Script(variable("V"), above=operator("*"))
    values = Fence(row(variable("a"), operator("|"), variable("b")), "{", "}")
    text = markdown([Equation(hat, (Row((chosen, values)),), ("=",))])
    assert text == r"$${\hat{x}}_ {t} = V^{\ast } \lbrace  a \mid b \rbrace $$"


def test_a_bar_does_not_end_the_cell_of_a_table() -> None:
    absolute = Table(header=("$|x|$", "y"), rows=(("1", "2"),))
    (line, *_) = markdown([absolute]).splitlines()
    assert line.count("|") == 3


def test_github_knows_no_operatorname() -> None:
    greatest = Equation(variable("a"), (row(Big("arg max", variable("a")), Big("mean", word("all"))),), ("=",))
    text = markdown([greatest, Paragraph("It is done.")])
    assert r"\mathop{\text{arg max}}_ {a}" in text
    assert r"\mathop{\text{mean}}_ {\text{all}}" in text
    assert "operatorname" not in text
