"""Numbers that programs wrote, read as the simple fractions that they round: 0.3333333333333333 is 1/3."""

import re
from collections.abc import Callable, Mapping, Sequence
from decimal import Decimal, InvalidOperation
from math import isqrt
from typing import Any, TypeVar, cast

from pydantic import ValidationInfo

from rldrill.problems.fractions import Fraction

Key = TypeVar("Key")
Number = TypeVar("Number")
#: What is told whenever something is read otherwise than it is written.
Note = Callable[[str], None]

_DECIMAL = re.compile(r"\s*[+−-]?(\d*\.\d+)(?:[eE][+−-]?\d+)?\s*")
#: So many digits nobody types: a program wrote them, and the last ones are its rounding.
_PROGRAM = 15
_ROUNDING = Fraction(1, 10**15)
_DENOMINATOR = 1000
#: By how much the probabilities of a set may miss 1, all together, and still be those of a program.
_MISSED = Fraction(1, 10**9)
_FINEST = (10, 100, _DENOMINATOR)


def note_of(info: ValidationInfo) -> Note:
    """Where to tell what is read otherwise than it is written; nowhere, unless somebody listens."""
    return cast(Note, info.context) if info.context is not None else lambda _: None


def meant(written: object, value: Fraction, note: Note) -> Fraction:
    """The simple fraction that a program rounded to sixteen digits; any other number as it is.

    Args:
        written: the number as it stands in the file.
        value: what it is, to the digit.
        note: told when another number is read.
    """
    text = str(written)
    decimal = _DECIMAL.fullmatch(text) if isinstance(written, str | float) else None
    if not decimal or len(decimal[1].replace(".", "").lstrip("0")) < _PROGRAM:
        return value
    rounding = _ROUNDING * max(abs(value), Fraction(1))
    # Where so many fractions are as near that one of them may be so by chance, nothing is read into the number.
    near = value.limit_denominator(max(1, min(_DENOMINATOR, isqrt(int(Fraction(1, 10**6) / rounding)))))
    if near == value or abs(near - value) > rounding:
        return value
    note(f"read {text.strip()} as {near}")
    return near


def distribution(chances: Mapping[Key, Number], note: Note) -> dict[Key, Number]:
    """Probabilities that sum to 1 but for a program's rounding, as the simplest fractions that sum to 1 exactly.

    Where there are none, the largest probability is what the others leave. Sets that miss 1 by more, or leave a
    parameter open, stay as they are.
    """
    written = {key: chance for key, chance in chances.items() if isinstance(chance, Fraction)}
    total = sum(written.values(), Fraction(0))
    if len(written) < len(chances) or total == 1 or abs(total - 1) > _MISSED:
        return dict(chances)
    read = _simplest(written, 1 - total) or _rest(written, 1 - total)
    for key, chance in read.items():
        if chance != written[key]:
            note(f"read {told(written[key])} as {told(chance)}")
    return cast(dict[Key, Number], read)


def _simplest(chances: Mapping[Key, Fraction], missing: Fraction) -> dict[Key, Fraction] | None:
    rounding = max(4 * abs(missing), _ROUNDING)  # of one number: those of several may cancel each other
    for finest in _FINEST:
        read = {key: chance.limit_denominator(finest) for key, chance in chances.items()}
        if sum(read.values()) == 1 and all(abs(read[key] - chance) <= rounding for key, chance in chances.items()):
            return read
    return None


def _rest(chances: Mapping[Key, Fraction], missing: Fraction) -> dict[Key, Fraction]:
    largest = max(chances, key=lambda key: chances[key])
    return {**chances, largest: chances[largest] + missing}


def told(number: Fraction) -> str:
    """A number for a sentence: a fraction where that is short, else a decimal."""
    if number.denominator <= _DENOMINATOR:
        return str(number)
    return f"{Decimal(number.numerator) / number.denominator:.28g}"


def several(written: Any) -> Sequence[Any]:
    """A list as it is, and anything else as a list of one entry."""
    return written if isinstance(written, list | tuple) else [written]


def is_zero(written: object) -> bool:
    """Whether this is a number that is 0; what is none is refused where it is read."""
    try:
        return Decimal(str(written)) == 0
    except InvalidOperation:
        return False
