"""The rule for judging a number: exact, or right to three significant digits; compared in exact arithmetic."""

import hashlib
from collections.abc import Iterator
from contextlib import suppress
from functools import lru_cache, partial
from math import gcd, lcm

from flint import fmpq

from rldrill.problems.exact import SHARES
from rldrill.solutions.answers.coefficients import coefficients
from rldrill.solutions.closed_forms import Point
from rldrill.solutions.exact import (
    Value,
    absolute,
    clear_sign,
    difference,
    is_closed,
    is_rational,
    is_zero,
    magnitude,
    parameters,
    sign,
    simplest,
    to_sympy,
    value_where,
)
from rldrill.solutions.exponentials import vanishes
from rldrill.solutions.value import NotReal

#: The rule in words, printed beside every question.
RULE = "an exact value, or a decimal that is right to 3 significant digits"
DIGITS = 3
_AT_ZERO = fmpq(1, 2000)
_CLOSE = fmpq(1, 50)
#: From here on the tolerance at zero, too, is less than a 150th.
_NOT_SMALL = fmpq(1, 2)
_POINTS = 6
_LONGEST = 10**4  # digits
_FEW_BITS, _MANY_BITS = 64, 1024


def tolerance(value: Value) -> fmpq:
    """Half a unit of the third significant digit of a real value; 0.0005 for 0.

    Raises:
        NotReal: it has more digits before or behind the point than anybody writes.
    """
    return _tolerance(value) if is_rational(value) else _remembered(value)


def _tolerance(value: Value) -> fmpq:
    if is_zero(value):
        return _AT_ZERO
    exponent = magnitude(value) - DIGITS + 1
    if abs(exponent) > _LONGEST:
        raise NotReal("the value has too many digits to be told from others")
    return fmpq(10) ** exponent / 2


_remembered = lru_cache(maxsize=4096)(_tolerance)


def within(value: Value, key: Value, bound: fmpq) -> bool:
    """Whether |value − key| ≤ bound, the bound included."""
    if is_closed(value) or is_closed(key):
        with suppress(NotReal):
            size = abs(difference(value, key))
            if size < bound or size > bound:
                return bool(size < bound)
    exactly = value - key
    return _is_not_below_zero(bound - exactly) and _is_not_below_zero(bound + exactly)


def _is_not_below_zero(number: Value) -> bool:
    """Whether a number is zero or more; what a thousand bits do not tell from zero is taken for it.

    Raises:
        NotReal: it is no real number.
    """
    if is_rational(number):
        return bool(number >= 0)
    for bits in (_FEW_BITS, _MANY_BITS):
        if (found := clear_sign(number, None, bits)) is None:
            raise NotReal(f"{number} is no real number")
        if found:
            return found > 0
    return True


def is_right(value: Value, key: Value, *, rounded: bool = True) -> bool:
    """Whether a value is the key, exactly or to three significant digits.

    Args:
        value: what was answered.
        key: the exact answer.
        rounded: whether the answer was typed with decimals. An expression in a parameter that was not
            must be equivalent; other numbers are held against the tolerance either way.
    """
    if value == key:
        return True
    if not parameters(key) and not parameters(value):
        return within(value, key, tolerance(key))
    if equivalent(value, key):
        return True
    return rounded and _is_rounded(value, key)


def is_close(value: Value, key: Value) -> bool:
    """Whether a value is within 2 % of the key."""
    if parameters(key) or parameters(value) or is_zero(key):
        return False
    return within(value, key, absolute(key) * _CLOSE)


def last_digit(number: fmpq) -> fmpq | None:
    """The unit of the last digit of a decimal or whole number, a tenth of 1.5; None where no decimal ends so."""
    below, places = int(number.q), []
    for prime in (2, 5):
        times = 0
        while below % prime == 0:
            below, times = below // prime, times + 1
        places.append(times)
    return fmpq(1, 10 ** max(places)) if below == 1 else None


def is_short(value: Value, key: Value) -> bool:
    """Whether a value is the key, rounded or cut off where its own digits end, which are fewer than three."""
    if not is_rational(value) or (unit := last_digit(value)) is None or abs(value) >= 100 * unit:
        return False
    return sign(unit - absolute(key - value)) > 0


def apart(key: Value, other: Value) -> bool:
    """Whether a marker can tell two answers from each other, even rounded to three digits."""
    if key == other:
        return False
    if is_rational(key) and is_rational(other):
        if 150 * abs(key - other) > abs(key) + abs(other) > _NOT_SMALL:
            return True  # a tolerance is at most a 200th of what it is for
    elif parameters(key) or parameters(other):
        return not equivalent(key, other)
    return not within(other, key, tolerance(key) + tolerance(other))


def equivalent(value: Value, key: Value) -> bool:
    """Whether two expressions are the same function of the parameter: points first, then a proof.

    What the proof cannot decide (logarithms of the parameter) is the same if both are real at every point, and no
    point tells them apart in a thousand bits.
    """
    gap = simplest(value - key)
    if not is_closed(gap):
        return bool(gap == 0)
    try:
        if any(clear_sign(gap, point, _FEW_BITS) for point in points(value)):
            return False
        proved = vanishes(gap)
        if proved is None:
            return all(clear_sign(gap, point, _MANY_BITS) == 0 for point in points(value))
        return proved
    except NotReal:
        return False


def points(value: Value) -> Iterator[Point]:
    """Where an answer is compared with the key: each letter within its own range, and depending on the answer itself.

    So no answer can be made to agree at these points alone.
    """
    typed = str(to_sympy(value))
    for number in range(_POINTS):
        yield partial(_point, f"{number} {typed}")


def _point(key: str, letter: str) -> fmpq:
    digest = hashlib.sha256(f"{letter} {key}".encode()).digest()
    share = fmpq(1 + int.from_bytes(digest[:2], "big"), 65538)
    return share if letter in SHARES else share / (1 - share)


def _is_rounded(value: Value, key: Value) -> bool:
    """Whether an expression is the key with its numbers rounded: each of them, where both are quotients of polynomials.

    At a point a sum may need more digits than its terms have, and a term may be too small to count.
    """
    letters = sorted(parameters(value) | parameters(key))
    ours, theirs = coefficients(value, letters), coefficients(key, letters)
    if ours is None or theirs is None:
        return all(_right_at(value, key, point) for point in points(value))
    if ours.keys() != theirs.keys():
        return False
    below = [place for place in theirs if place.below]
    scales, fractions = {one: {fmpq(1)} for one in below}, list(filter(is_rational, theirs.values()))
    if len(below) > 1 and len(fractions) == len(theirs):  # a quotient is written in whole numbers
        written = fmpq(lcm(*(int(number.q) for number in fractions)))
        written /= gcd(*(int((number * written).p) for number in fractions))
        scales = {one: {fmpq(1), theirs[one] * written} for one in below}
    return any(  # whichever number below the line is taken to be as it is
        all(
            within(ours[each] / ours[one] * scale, here := theirs[each] / theirs[one] * scale, tolerance(here))
            for each in theirs
        )
        for one in below
        for scale in scales[one]
    )


def _right_at(value: Value, key: Value, at: Point) -> bool:
    try:
        here = value_where(key, at)
        return within(value_where(value, at), here, tolerance(here))
    except NotReal:
        return False
