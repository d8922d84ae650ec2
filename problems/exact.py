"""Exact numbers as people write them in problem files: ``9/10``, ``0.9``, ``-2``, or a parameter's name."""

import re
from collections.abc import Iterable
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from typing import Annotated, Any

from pydantic import BeforeValidator, PlainSerializer, WithJsonSchema

_DIGITS = 40  # longer numbers are slips of the keyboard, or mischief
_NUMBER = re.compile(rf"\s*([+-]?\d{{1,{_DIGITS}}})\s*/\s*(\d{{1,{_DIGITS}}})\s*")
_LOGARITHM = re.compile(r"\s*ln\s*\(?\s*(\d{1,3}|[^\W\d_]+)\s*\)?\s*")
_MINUS = str.maketrans({"−": "-", "–": "-"})


class Parameter(str):
    """A number left open, such as ``gamma`` or its complement ``1-p``: answers are expressions in it."""

    __slots__ = ()

    @property
    def symbol(self) -> str:
        """The name of the parameter itself, without ``1-``."""
        return self.removeprefix("1-")

    @property
    def complement(self) -> bool:
        """Whether this is one minus the parameter."""
        return self.startswith("1-")


#: The parameters that a problem may leave open, by the names used in files, and how they are written.
PARAMETERS = {
    "gamma": "γ",
    "alpha": "α",
    "lambda": "λ",
    "epsilon": "ε",
    "rho": "ρ",
    "sigma": "σ",
    "theta": "θ",
    "beta": "β",
    "p": "p",
    "q": "q",
    "w": "w",
    "x": "x",
}

Scalar = Fraction | Parameter


class Logarithm(str):
    """The natural logarithm of a whole number or of a parameter left open: ``ln 2``, ``ln x``.

    As the weight of a softmax policy it makes e^h a number without e.
    """

    __slots__ = ()

    @property
    def of(self) -> Scalar:
        """What it is the logarithm of."""
        return read_scalar(self.removeprefix("ln "))


Weight = Scalar | Logarithm


def read_fraction(value: object) -> Fraction:
    """Read an exact number.

    Raises:
        ValueError: it is not a number, is not finite, or has more than forty digits.
    """
    if isinstance(value, bool):
        raise ValueError(f"{value} is not a number")
    if isinstance(value, Fraction):
        return value
    if isinstance(value, int):
        return Fraction(value)
    # A float's shortest decimal is what its writer typed; its binary value is not.
    text = repr(value) if isinstance(value, float) else value
    if not isinstance(text, str):
        raise ValueError(f"{value!r} is not a number")
    text = text.translate(_MINUS).strip()
    if quotient := _NUMBER.fullmatch(text):
        denominator = int(quotient[2])
        if denominator == 0:
            raise ValueError(f"{text!r} divides by zero")
        return Fraction(int(quotient[1]), denominator)
    try:
        number = Decimal(text)
    except InvalidOperation:
        raise ValueError(f"{text[:40]!r} is not a number; write it as 3, 0.75 or 3/4") from None
    if not number.is_finite() or abs(number.adjusted()) > _DIGITS or len(number.as_tuple().digits) > _DIGITS:
        raise ValueError(f"{text[:40]!r} is not a finite number of at most {_DIGITS} digits")
    return Fraction(number)


def read_scalar(value: object) -> Scalar:
    """Read an exact number, or a parameter left open: ``gamma`` or ``γ``, and ``1-gamma``."""
    if isinstance(value, str):
        name = value.translate(_MINUS).replace(" ", "")
        prefix = "1-" if name.startswith("1-") else ""
        for parameter, glyph in PARAMETERS.items():
            if name.removeprefix("1-") in (parameter, glyph):
                return Parameter(prefix + parameter)
    return read_fraction(value)


def read_weight(value: object) -> Weight:
    """Read an exact number, a parameter left open, or the logarithm of a whole number or parameter: ``ln 2``."""
    if isinstance(value, str) and (found := _LOGARITHM.fullmatch(value)):
        of = read_scalar(found[1])
        if isinstance(of, Fraction) and of < 2:
            raise ValueError(f"{value.strip()!r} must be the logarithm of a whole number above 1")
        return Logarithm(f"ln {of}")
    return read_scalar(value)


def write(value: Weight) -> str:
    """Write an exact number as problem files have it: ``3``, ``-1/2``, ``gamma``."""
    return str(value)


def dot(first: Iterable[Fraction], second: Iterable[Fraction]) -> Fraction:
    """The sum of the products of two rows of numbers."""
    return sum((a * b for a, b in zip(first, second, strict=True)), Fraction(0))


def shown(value: Weight | int) -> str:
    """Write an exact number as mathematics, for use between ``$`` signs."""
    if isinstance(value, Logarithm):
        return f"ln {shown(value.of)}"
    if isinstance(value, Parameter):
        return ("1 − " if value.complement else "") + PARAMETERS[value.symbol]
    return str(value).replace("-", "−")


def _probability(value: Scalar) -> Scalar:
    if isinstance(value, Fraction) and not 0 <= value <= 1:
        raise ValueError(f"{value} is not between 0 and 1")
    return value


def _rate(value: Scalar) -> Scalar:
    if isinstance(value, Fraction) and not 0 < value <= 1:
        raise ValueError(f"{value} is not above 0 and at most 1")
    return value


_serialised = PlainSerializer(write, return_type=str)
_schema = WithJsonSchema({"type": ["string", "number"], "description": "an exact number: 3, 0.75 or '3/4'"})


def _field(read: Any, *checks: Any) -> Any:
    def validate(value: object) -> Any:
        result = read(value)
        for check in checks:
            result = check(result)
        return result

    return BeforeValidator(validate)


#: An exact number in a problem's givens.
Exact = Annotated[Fraction, _field(read_fraction), _serialised, _schema]
#: An exact number, or a parameter left open.
Open = Annotated[Fraction | Parameter, _field(read_scalar), _serialised, _schema]
#: A probability, 0 to 1.
Probability = Annotated[Fraction, _field(read_fraction, _probability), _serialised, _schema]
OpenProbability = Annotated[Fraction | Parameter, _field(read_scalar, _probability), _serialised, _schema]
#: A discount γ, 0 to 1, or left open.
Discount = OpenProbability
#: A weight of a policy, whose exponential may be a whole number: ``ln 2``.
WeightField = Annotated[
    Fraction | Parameter | Logarithm,
    _field(read_weight),
    _serialised,
    WithJsonSchema({"type": ["string", "number"], "description": "an exact number, or the logarithm of one: 'ln 2'"}),
]
#: A step size α, above 0 and at most 1, or left open.
StepSize = Annotated[Fraction | Parameter, _field(read_scalar, _rate), _serialised, _schema]
