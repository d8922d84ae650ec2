"""What is written below and above the line: the index and primes that a name has of its own, and small print."""

import re

from rldrill.problems.mathematics import Fraction, Glyph, Math, Row

#: A letter or word with its own index and primes: ``s₁′``.
_NAME = re.compile(r"(.*?)([₀-₉]*)([′']*)", re.DOTALL)
_DIGITS = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")


def taken_apart(text: str, style: str) -> tuple[str, str, int]:
    """What a glyph says without its index, the digits of that, and how many primes it has; only names have either."""
    match = _NAME.fullmatch(text) if style in ("variable", "word") else None
    return (text, "", 0) if match is None else (match[1], match[2].translate(_DIGITS), len(match[3]))


def on_one_line(math: Math) -> Math:
    """Small print has no room for one number above another: ``3/2``."""
    if isinstance(math, Row):
        return Row(tuple(map(on_one_line, math.items)))
    if isinstance(math, Fraction) and isinstance(math.numerator, Glyph) and isinstance(math.denominator, Glyph):
        return Row((math.numerator, Glyph("/", "punctuation"), math.denominator))
    return math
