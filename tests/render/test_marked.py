"""What differs in a formula that was misread is marked, in every form that mathematics is written in."""

import pytest

from rldrill.problems.document import Equation
from rldrill.problems.mathematics import Fence, Glyph, Marked, Math, Row, Script, mathematics, row
from rldrill.render.differences import marked
from rldrill.render.mathematics.latex import latex
from rldrill.render.mathematics.mathml import mathml
from rldrill.render.mathematics.typst import typst
from rldrill.render.mathematics.unicode import unicode
from rldrill.solutions.sheet.temporal_difference import TD_ZERO


def found(wrong: str, right: str) -> list[str]:
    """What is marked in a misread formula, in its order."""
    equations = (Equation(mathematics("V"), (mathematics(side),), ("=",)) for side in (wrong, right))
    return list(map(unicode, _marked(marked(*equations).rights[0])))


def _marked(math: Math) -> list[Math]:
    match math:
        case Marked(body):
            return [body]
        case Row(items):
            return [each for item in items for each in _marked(item)]
        case Script(body, below, above):
            return [each for part in (body, below, above) if part is not None for each in _marked(part)]
        case Fence(body):
            return _marked(body)
        case _:
            return []


@pytest.mark.parametrize(
    ("wrong", "right", "differs"),
    [
        ("r + V(s)", "r + γ V(s)", ["V(s)"]),  # γ is missing from it
        ("r_t + γ V", "r_{t+1} + γ V", ["t"]),
        ("V + α r", "V - α r", ["+"]),
        ("r + γ V - V", "r + γ V", ["V"]),  # a term too many; its sign stays as it is
        ("r + V", "r", ["V"]),
        ("r", "r + γ V", ["r"]),
        ("V + α (r - V)", "V + α (r + γ V - V)", ["r"]),
        ("x", "(a + b) / 2", ["x"]),
        ("c a + b", "x", ["ca + b"]),  # nothing of it is right, and it begins with no sign
        ("-r", "r", ["−"]),  # a sign that is too many is all there is to mark
        ("a + b", "a + b", []),
    ],
)
def test_what_differs_is_marked(wrong: str, right: str, differs: list[str]) -> None:
    assert found(wrong, right) == differs


def test_what_is_marked_reads_as_before() -> None:
    """For the terminal and for those who listen."""
    (mistake, misread), *_ = TD_ZERO.misread.items()
    plain = TD_ZERO.equation(misread).rights[0]
    both = marked(TD_ZERO.equation(misread), TD_ZERO.equation(TD_ZERO.right)).rights[0]
    assert both != plain, mistake
    assert unicode(both) == unicode(plain)


def test_every_writer_underlines_and_colours() -> None:
    both = row(Glyph("r", "variable"), Glyph("+", "operator"), Marked(Glyph("V", "variable")))
    assert latex(both) == r"r + {\color{red}{\underline{V}}}"
    assert '<mrow class="marked"><mi>V</mi></mrow>' in mathml(both)
    assert typst(both) == r"r \+ marked(V)"


@pytest.mark.parametrize(("sign", "kind"), [(Glyph("+", "operator"), "binary"), (Glyph("≤", "relation"), "relation")])
def test_a_sign_alone_is_not_underlined_for_that_would_make_another_sign_of_it(sign: Glyph, kind: str) -> None:
    assert typst(Marked(sign)) == f'class("{kind}", grounded({typst(sign)}))'
    assert latex(Marked(sign)) == rf"{{\color{{red}}{{\boxed{{{latex(sign)}}}}}}}"
    assert f'<mrow class="marked sign"><mo>{sign.text}</mo></mrow>' in mathml(Marked(sign))
