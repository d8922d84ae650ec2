"""What no writer does by itself: where words need a space, which brackets grow, and where no line may end."""

import re
from collections.abc import Iterator

from rldrill.problems.mathematics import Accent, Big, Fence, Fraction, Glyph, Math, Row, Script, Tabular

#: What is not parted behind its hyphen: Q-learning, n-step.
_LETTER_AND_WORD = re.compile(r"(?<![\w-])([^\W\d_]-[^\W\d_]+)(?![\w-])")


def parted(text: str) -> Iterator[tuple[str, bool]]:
    """A text in pieces, and of each whether no line may end in it."""
    for number, piece in enumerate(_LETTER_AND_WORD.split(text)):
        if piece:
            yield piece, number % 2 == 1


def needs_space(before: Math, item: Math) -> bool:
    """Whether a word stands beside a letter, a number or another word."""
    return (is_word(before) and (_is_name(item) or isinstance(item, Fraction | Accent))) or (
        is_word(item) and (_is_name(before) or isinstance(before, Fence))
    )


def is_tall(math: Math) -> bool:
    """Whether brackets around it are larger than those of a letter."""
    match math:
        case Fraction() | Tabular() | Big():
            return True
        case Row(items):
            return any(map(is_tall, items))
        case Glyph():
            return False
        case _:
            return is_tall(math.body)


def opens(before: Math) -> bool:
    """Whether a sign behind this belongs to what follows, as in = −5."""
    return isinstance(before, Big) or (
        isinstance(before, Glyph) and before.style in ("relation", "operator", "punctuation")
    )


def is_word(math: Math) -> bool:
    """Whether something is a word or a name, set upright."""
    return isinstance(math, Glyph) and math.style == "word"


def _is_name(math: Math) -> bool:
    head = math.body if isinstance(math, Script) else math
    return isinstance(head, Glyph) and head.style in ("variable", "word", "number")
