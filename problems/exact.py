"""Exact numbers as people write them in problem files: ``9/10``, ``0.9``, ``-2``, or a parameter's name."""

from collections.abc import Iterable
from functools import lru_cache
from itertools import starmap
from math import isqrt, sqrt
from numbers import Rational
from operator import mul
from typing import Annotated, Any, TypeVar

from pydantic import BeforeValidator, Field, PlainSerializer, ValidationInfo, WithJsonSchema

from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.grammar import DIGITS, read
from rldrill.problems.latex import typed
from rldrill.problems.notation import Name, Node, Operation, nodes, whole, worked_out
from rldrill.problems.readings import meant, note_of
from rldrill.problems.spelling import Unreadable

T = TypeVar("T")

_ZERO = Fraction(0)
_LONGEST, _TOLD = 200, 40
_BITS = 4000  # of a power


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

#: The same in a sentence.
PARAMETERS_TOLD = f"{', '.join([*PARAMETERS][:-1])} and {[*PARAMETERS][-1]}"

#: Those of them that lie between 0 and 1.
SHARES = frozenset({"gamma", "alpha", "lambda", "epsilon", "p", "q"})
#: Those that are so in every problem; p and q may also be rewards.
ALWAYS_SHARES = SHARES - {"p", "q"}

#: The same by the names and by the letters.
_BY_NAME = {spelling: Parameter(name) for name, glyph in PARAMETERS.items() for spelling in (name, glyph)}

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


class Root(str):
    """The square root of a rational number: ``sqrt(3/2)``."""

    __slots__ = ()

    @property
    def of(self) -> Fraction:
        """What it is the root of."""
        return fraction_of(self.removeprefix("sqrt(").removesuffix(")"))

    def __float__(self) -> float:
        return sqrt(self.of)


Weight = Scalar | Logarithm | Root


def called(value: object) -> str:
    """A value of a file as sentences call it."""
    if isinstance(value, list | tuple):
        return "a list"
    if isinstance(value, dict):
        return "a table"
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return str(value).lower()
    text = repr(value) if isinstance(value, str) else str(value)
    return text if len(text) <= _TOLD else f"{text[: _TOLD - 1]}…"


def read_fraction(value: object) -> Fraction:
    """Read an exact number.

    Raises:
        ValueError: it is not a number, is not finite, or has more than forty digits.
    """
    if type(value) is Fraction:
        return value
    if isinstance(value, Rational) and not isinstance(value, bool):
        return Fraction(value)
    if isinstance(value, str | float):
        # A float's shortest decimal is what its writer typed; its binary value is not.
        return _fraction(value if isinstance(value, str) else repr(value))
    raise ValueError(f"{called(value)} is not a number; write it as 3, 0.75 or 3/4")


@lru_cache(maxsize=1024)
def _parsed(text: str) -> Node:
    try:
        return read(typed(text, _LONGEST))
    except Unreadable as fault:
        raise ValueError(f"{text[:40]!r} is not a number: {fault.message}") from None


@lru_cache(maxsize=1024)
def _fraction(text: str) -> Fraction:
    return _worth(_parsed(text), text)


def _worth(tree: Node, text: str) -> Fraction:
    def refuse(*_: object) -> Fraction:
        raise ValueError(f"{text[:40]!r} is not a number; write it as 3, 0.75 or 3/4")

    try:
        number = worked_out(tree, Fraction, refuse, refuse, _power)
    except ZeroDivisionError:
        raise ValueError(f"{text[:40]!r} divides by zero; write a number") from None
    if max(abs(number.numerator), number.denominator) > 10**DIGITS:
        raise ValueError(f"{text[:40]!r} has more than {DIGITS} digits; write a shorter number")
    return number


def _power(base: Fraction, exponent: int | None) -> Fraction:
    if exponent is None or (base.numerator.bit_length() + base.denominator.bit_length()) * abs(exponent) > _BITS:
        raise ValueError("an exponent in a number is a whole number, and not a large one; write the number out")
    return base**exponent


def read_scalar(value: object) -> Scalar:
    """Read an exact number, or a parameter left open: ``gamma`` or ``γ``, and ``1-gamma``."""
    if not isinstance(value, str):
        return read_fraction(value)
    match _parsed(value):
        case Name(name) if name in _BY_NAME:
            return _BY_NAME[name]
        case Operation("-", (one, Name(name))) if whole(one) == 1 and name in _BY_NAME:
            return Parameter(f"1-{_BY_NAME[name]}")
        case Name(name) if name.lower() not in ("nan", "inf"):
            raise ValueError(
                f"{value[:40]!r} is not a number such as 3, 0.75 or 3/4, and no letter that may be left open; these "
                f"are {PARAMETERS_TOLD}"
            )
    return _fraction(value)


def is_scalar(value: object) -> bool:
    """Whether something can be read as an exact number, or as a parameter left open."""
    try:
        read_scalar(value)
    except ValueError:
        return False
    return True


def read_weight(value: object) -> Weight:
    """Read an exact number, a parameter left open, or the logarithm of a whole number or parameter: ``ln 2``."""
    if isinstance(value, str):
        match _parsed(value):
            case Operation("ln", (Name(name),)) if name in _BY_NAME:
                return Logarithm(f"ln {_BY_NAME[name]}")
            case Operation("ln", (number,)):
                if (whole(number) or 0) not in range(2, 1000):
                    raise ValueError(f"{value[:40]!r} must be the logarithm of a whole number above 1 and below 1000")
                return Logarithm(f"ln {whole(number)}")
    return read_scalar(value)


def read_width(value: object) -> Scalar | Root:
    """Read an exact number, a parameter left open, or a square root such as ``sqrt(3/2)`` or ``2 sqrt(2)``."""
    if not isinstance(value, str) or not any(
        isinstance(node, Operation) and node.sign == "sqrt" for node in nodes(_parsed(value))
    ):
        return read_scalar(value)
    square = _square(_parsed(value), value)
    if square < 0:
        raise ValueError(f"{value[:40]!r} is the root of a negative number; write another")
    top, below = isqrt(square.numerator), isqrt(square.denominator)
    return Fraction(top, below) if Fraction(top, below) ** 2 == square else Root(f"sqrt({square})")


def _square(tree: Node, text: str) -> Fraction:
    """The square of a product or quotient of numbers and square roots."""
    match tree:
        case Operation("sqrt", (inner,)):
            return _worth(inner, text)
        case Operation("*", (first, second)):
            return _square(first, text) * _square(second, text)
        case Operation("/", (first, second)) if _square(second, text) != 0:
            return _square(first, text) / _square(second, text)
    return _worth(tree, text) ** 2


def write(value: Weight) -> str:
    """Write an exact number as problem files have it: ``3``, ``-1/2``, ``gamma``."""
    return str(value)


def dot(first: Iterable[Fraction], second: Iterable[Fraction]) -> Fraction:
    """The sum of the products of two rows of numbers."""
    return sum(starmap(mul, zip(first, second, strict=True)), _ZERO)


@lru_cache(maxsize=4096)  # the same numbers are shown again and again
def _spelled(number: Fraction) -> str:
    return str(number).replace("-", "−")


def needed(value: T | None) -> T:
    """What a problem has whose form asks for it, though others do without."""
    assert value is not None
    return value


def shown(value: Weight | int) -> str:
    """Write an exact number as mathematics, for use between ``$`` signs."""
    if type(value) is Fraction:
        return _spelled(value)
    if isinstance(value, Logarithm):
        return f"ln {shown(value.of)}"
    if isinstance(value, Root):
        return f"√{value.of}" if value.of.denominator == 1 else f"√({value.of})"
    if isinstance(value, Parameter):
        return ("1 − " if value.complement else "") + PARAMETERS[value.symbol]
    return str(value).replace("-", "−")


def no_complement(value: Scalar) -> Scalar:
    """The value; what is asked for by its letter is not left open as ``1-x``.

    Raises:
        ValueError: it is one minus a letter.
    """
    if isinstance(value, Parameter) and value.complement:
        raise ValueError(f"{str(value)!r} is one minus what is asked for; leave {value.symbol} open")
    return value


def _probability(value: Scalar) -> Scalar:
    if isinstance(value, Fraction) and not 0 <= value <= 1:
        raise ValueError(f"{value} is not between 0 and 1; give a number that is")
    return value


def _rate(value: Scalar) -> Scalar:
    no_complement(value)
    if isinstance(value, Fraction) and not 0 < value <= 1:
        raise ValueError(f"{value} is not above 0 and at most 1; give a number that is")
    return value


def _discounts(value: object, info: ValidationInfo) -> Scalar | tuple[Scalar, ...]:
    def one(gamma: object) -> Scalar:
        number = no_complement(read_scalar(gamma))
        return _probability(meant(gamma, number, note_of(info)) if isinstance(number, Fraction) else number)

    return tuple(map(one, value)) if isinstance(value, list | tuple) else one(value)


_serialised = PlainSerializer(write, return_type=str)


def _schema(title: str) -> WithJsonSchema:
    return WithJsonSchema({"type": ["string", "number"], "title": title, "description": "exact: 3, 0.75 or '3/4'"})


def _field(read: Any, *checks: Any) -> Any:
    def validate(value: object, info: ValidationInfo) -> Any:
        result = read(value)
        if isinstance(result, Fraction):
            result = meant(value, result, note_of(info))
        for check in checks:
            result = check(result)
        return result

    return BeforeValidator(validate)


_OR_OPEN = " or a parameter left open"

#: An exact number in a problem's givens.
Exact = Annotated[Fraction, _field(read_fraction), _serialised, _schema("a number")]
#: An exact number, or a parameter left open.
Open = Annotated[Fraction | Parameter, _field(read_scalar), _serialised, _schema(f"a number{_OR_OPEN}")]
#: A probability, 0 to 1.
Probability = Annotated[Fraction, _field(read_fraction, _probability), _serialised, _schema("a number from 0 to 1")]
OpenProbability = Annotated[
    Fraction | Parameter,
    _field(read_scalar, _probability),
    _serialised,
    _schema(f"a number from 0 to 1{_OR_OPEN}"),
]
#: A share such as λ or ε, 0 to 1, or left open: as it is, not what it leaves to 1.
OpenShare = Annotated[
    Fraction | Parameter,
    _field(read_scalar, _probability, no_complement),
    _serialised,
    _schema(f"a number from 0 to 1{_OR_OPEN}"),
]
#: A discount γ, 0 to 1, or left open.
Discount = Annotated[OpenShare, Field(description="The discount.", examples=["9/10"])]
#: A discount for the whole run, or a list with one for each of its steps.
Discounts = Annotated[
    Fraction | Parameter | tuple[Fraction | Parameter, ...],
    BeforeValidator(_discounts),
    PlainSerializer(lambda value: [*map(write, value)] if isinstance(value, tuple) else write(value)),
    WithJsonSchema(
        {"type": ["string", "number", "array"], "title": f"a number from 0 to 1{_OR_OPEN}, or a list of these"}
    ),
    Field(description="The discount, or a list with one for every step; the first for all after the first reward."),
]
#: A weight of a policy, whose exponential may be a whole number: ``ln 2``.
WeightField = Annotated[
    Fraction | Parameter | Logarithm,
    _field(read_weight),
    _serialised,
    _schema(f"a number, the logarithm of one such as 'ln 2'{_OR_OPEN.replace(' or', ', or')}"),
]
#: A step size α, above 0 and at most 1, or left open.
StepSize = Annotated[
    Fraction | Parameter,
    _field(read_scalar, _rate),
    _serialised,
    _schema(f"a number above 0 and at most 1{_OR_OPEN}"),
]
#: A width σ, whose square is what counts: ``sqrt(3/2)``.
WidthField = Annotated[
    Fraction | Parameter | Root,
    _field(read_width),
    _serialised,
    _schema(f"a number, a square root such as 'sqrt(3/2)'{_OR_OPEN.replace(' or', ', or')}"),
]
