"""The letters of formulas, and how each is written."""

import sympy

from rldrill.problems.mathematics import Math, variable

GLYPHS: dict[sympy.Symbol, Math] = {}


def letter(code: str, glyph: str | Math | None = None, *, matrix: bool = False) -> sympy.Symbol:
    """A letter of a formula: ``code`` names it when values are put in, ``glyph`` is how it is written.

    Raises:
        ValueError: the code is that of another letter, which is written otherwise.
    """
    symbol = sympy.Symbol(code, commutative=not matrix)
    written = variable(glyph or code) if glyph is None or isinstance(glyph, str) else glyph
    if GLYPHS.setdefault(symbol, written) != written:
        raise ValueError(f"{code!r} is written in two ways: {GLYPHS[symbol]} and {written}")
    return symbol
