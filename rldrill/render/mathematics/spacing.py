"""Where words in mathematics need a space, which no writer of mathematics leaves by itself."""

from rldrill.problems.mathematics import Accent, Fence, Fraction, Glyph, Math, Script


def needs_space(before: Math, item: Math) -> bool:
    """Whether a word stands beside a letter, a number or another word."""
    return (_is_word(before) and (_is_name(item) or isinstance(item, Fraction | Accent))) or (
        _is_word(item) and (_is_name(before) or isinstance(before, Fence))
    )


def _is_word(math: Math) -> bool:
    return isinstance(math, Glyph) and math.style == "word"


def _is_name(math: Math) -> bool:
    head = math.body if isinstance(math, Script) else math
    return isinstance(head, Glyph) and head.style in ("variable", "word", "number")
