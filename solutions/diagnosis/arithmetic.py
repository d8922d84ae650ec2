"""Slips of arithmetic: the values that are written for a value by mistake."""

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Any

from flint import fmpq, fmpq_poly

from rldrill.solutions.exact import is_rational, is_zero
from rldrill.solutions.matrices import is_matrix, matrix
from rldrill.solutions.rational import RationalFunction, quotient
from rldrill.solutions.vector import Vector

Slip = tuple[str, Any]

#: In a number of more digits than this none are exchanged.
MOST_DIGITS = 7


def slips(value: Any) -> Iterator[Slip]:
    """What may be written for a value by a slip, the likeliest first."""
    if is_matrix(value):
        yield from _in_matrix(value)
    elif isinstance(value, Vector):
        yield from _in_vector(value)
    elif is_rational(value):
        yield from _of_rational(value)
    elif hasattr(value, "__neg__") and not is_zero(value):
        yield "sign", -value
        if isinstance(value, RationalFunction):  # nobody writes π/6 with a decimal point
            yield "tenfold", value * 10
            yield "tenfold", value / 10
        yield "one-off", value + 1
        yield "one-off", value - 1
        yield "doubled", value * 2
        yield "halved", value / 2
        if isinstance(value, RationalFunction):
            yield from _in_terms(value)


def _in_terms(value: RationalFunction) -> Iterator[Slip]:
    """Slips in one term of what has an open parameter."""
    coefficients = list(value.top.coeffs())
    if sum(each != 0 for each in coefficients) < 2:
        return
    for power, each in enumerate(coefficients):
        for kind, other in (("lost-term", fmpq(0)), ("term-sign", -each), ("term-tenfold", each / 10)):
            if each != 0:
                top = fmpq_poly([*coefficients[:power], other, *coefficients[power + 1 :]])
                yield kind, quotient(value.parameter, top, value.bottom)


def _of_rational(value: fmpq) -> Iterator[Slip]:
    top, bottom = int(value.p), int(value.q)
    if top == 0:
        yield "one-off", fmpq(1)
        yield "one-off", fmpq(-1)
        return
    yield "sign", -value
    if _ends(bottom):  # nobody writes 16/3 with a decimal point
        yield "tenfold", value * 10
        yield "tenfold", value / 10
    yield "one-off", value + 1
    yield "one-off", value - 1
    if bottom != 1:
        yield from (("numerator", fmpq(other, bottom)) for other in (top + 1, top - 1) if other)
        yield "denominator", fmpq(top, bottom + 1)
        if bottom > 2:
            yield "denominator", fmpq(top, bottom - 1)
    if abs(top) != bottom:
        yield "inverse", fmpq(bottom, top)
    for other in _digits_swapped(abs(top)):
        yield "digits", fmpq(other if top > 0 else -other, bottom)
    if bottom != 1 and (written := _decimal(value)) is not None:
        digits, scale = written
        for other in _digits_swapped(abs(digits)):
            yield "digits", fmpq(other if digits > 0 else -other, scale)
    yield "doubled", value * 2
    yield "halved", value / 2


def _digits_swapped(number: int) -> Iterator[int]:
    digits = str(number)
    if len(digits) > MOST_DIGITS:
        return
    for place in range(len(digits) - 1):
        if digits[place] != digits[place + 1] and (place or digits[1] != "0"):
            yield int(digits[:place] + digits[place + 1] + digits[place] + digits[place + 2 :])


def _ends(bottom: int) -> bool:
    """Whether the decimals of a fraction end."""
    for factor in (2, 5):
        while bottom % factor == 0:
            bottom //= factor
    return bottom == 1


def _decimal(value: fmpq) -> tuple[int, int] | None:
    """The digits of a short decimal and the power of ten below them."""
    for places in range(1, 5):
        if 10**places % int(value.q) == 0:
            return int(value.p) * (10**places // int(value.q)), 10**places
    return None


#: Slips that are likely enough to be made in an entry of a matrix.
_IN_ENTRIES = {"sign", "one-off", "tenfold", "numerator", "denominator", "digits", "doubled", "halved"}


def _in_matrix(value: Any) -> Iterator[Slip]:
    rows = value.tolist()
    for line, row in enumerate(rows):
        for column, entry in enumerate(row):
            for kind, other in slips(entry):
                if kind in _IN_ENTRIES:
                    changed = [list(each) for each in rows]
                    changed[line][column] = other
                    yield kind, matrix(changed)
    for line, column in beside_the_diagonal(rows):
        changed = [list(each) for each in rows]
        changed[line][column], changed[column][line] = -rows[line][column], -rows[column][line]
        yield "sign", matrix(changed)
    if len(rows) * len(rows[0]) > 1:
        yield "sign", -value


def beside_the_diagonal(rows: Sequence[Sequence[Any]]) -> Iterator[tuple[int, int]]:
    """The places above the diagonal of a square that hold the same as those across, and not 0."""
    for line, column in combinations(range(len(rows)), 2) if len(rows) == len(rows[0]) else ():
        if rows[line][column] == rows[column][line] and not is_zero(rows[line][column]):
            yield line, column


def _in_vector(value: Vector) -> Iterator[Slip]:
    entries = list(value)
    for place, entry in enumerate(entries):
        for kind, other in slips(entry):
            if kind in _IN_ENTRIES:
                yield kind, Vector([*entries[:place], other, *entries[place + 1 :]])
    yield "sign", -value
