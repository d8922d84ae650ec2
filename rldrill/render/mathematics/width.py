"""How wide mathematics is at most when it is set on one line, in widths of the type: a guess on the generous side."""

from collections.abc import Iterable

from rldrill.problems.mathematics import (
    Accent,
    Big,
    Fence,
    Fraction,
    Glyph,
    Marked,
    Math,
    Root,
    Row,
    Script,
    Tabular,
    relation,
)

#: Widths of signs, with the space around those that stand between others.
_DIGIT, _LETTER, _CAPITAL, _IN_WORDS, _DOT = 0.51, 0.68, 0.95, 0.62, 0.75
_RELATION, _OPERATOR, _PUNCTUATION, _BAR = 1.36, 1.25, 0.48, 0.86
_BIG, _AROUND, _LINE, _ROOT, _BRACKET, _BETWEEN = 1.5, 0.4, 0.3, 1.05, 0.85, 0.85
#: What stands above or below the line is smaller by this, and a little apart.
_SMALL, _APART = 0.72, 0.12


def width(math: Math) -> float:
    """The width of mathematics, in widths of the type."""
    match math:
        case Glyph(text, style):
            return _glyph(text, style)
        case Row(items):
            return sum(map(width, items))
        case Fraction(numerator, denominator):
            return max(width(numerator), width(denominator)) + _LINE
        case Script(body, below, above):
            return width(body) + _scripts(below, above)
        case Fence(body):
            return width(body) + 2 * _BRACKET
        case Big(sign, below, above):
            return max(_BIG, _IN_WORDS * len(sign), _scripts(below, above)) + _AROUND
        case Root(body):
            return width(body) + _ROOT
        case Accent(body) | Marked(body):
            return width(body)
        case Tabular(rows):
            columns = zip(*rows, strict=True)
            cells = [max(map(width, column)) for column in columns]
            return sum(cells) + _BETWEEN * max(0, len(cells) - 1) + 2 * _BRACKET


def width_of_line(left: Math, rights: Iterable[Math], signs: Iterable[str]) -> float:
    """The width of an equation with all its sides on one line."""
    return width(left) + sum(map(width, rights)) + sum(width(relation(sign)) for sign in signs if sign)


def _scripts(below: Math | None, above: Math | None) -> float:
    return max(0.0 if script is None else _SMALL * width(script) + _APART for script in (below, above))


def _glyph(text: str, style: str) -> float:
    if style == "relation":
        return _RELATION
    if style == "operator":
        return _DOT if text == "·" else _OPERATOR
    if style == "punctuation":
        return _BAR if text == "|" else _PUNCTUATION
    if style == "number":
        return _DIGIT * len(text)
    if style == "word":
        return _IN_WORDS * len(text) + _AROUND
    return sum(_CAPITAL if sign.isupper() else _LETTER for sign in text)
