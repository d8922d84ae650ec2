"""Right sides that go on without a relation belong to the left side above them, in whatever they are written."""

from collections.abc import Callable

import pytest

from rldrill.problems.document import Equation
from rldrill.problems.mathematics import EMPTY, variable
from rldrill.render.html import Html, LatexHtml
from rldrill.render.latex import latex_block
from rldrill.render.markdown import markdown_block
from rldrill.render.terminal import plain
from rldrill.render.typst import block

_SIDES = (variable("a"), variable("b"))
_WRITINGS: dict[str, Callable[[Equation], str]] = {
    "HTML": Html().equation,
    "HTML with LaTeX": LatexHtml().equation,
    "LaTeX": latex_block,
    "Markdown": markdown_block,
    "terminal": lambda equation: plain([equation]),
    "Typst": block,
}


@pytest.mark.parametrize("writing", _WRITINGS)
def test_a_side_without_a_relation_goes_on_with_the_equation(writing: str) -> None:
    write = _WRITINGS[writing]
    assert "Q" in write(Equation(variable("Q"), _SIDES, ("=", "")))
    assert "=" not in write(Equation(EMPTY, _SIDES, ("", ""))).replace('="', "")


def test_an_equation_is_bare_where_no_side_has_a_relation() -> None:
    bare = [signs for signs in (("", ""), ("=", ""), ("", "="), ("=", "=")) if Equation(EMPTY, _SIDES, signs).is_bare]
    assert bare == [("", "")]
