"""Angles as problem files have them, in radians: ``pi/6``, ``-2*pi/3``, or a plain number; or in degrees, ``30°``."""

import re
from math import pi
from typing import Annotated

from msgspec import Struct
from pydantic import AfterValidator, BeforeValidator, PlainSerializer, WithJsonSchema

from rldrill.problems.exact import called, read_fraction
from rldrill.problems.fractions import Fraction

_PI = re.compile(r"([+-]?)\s*(\d{0,6})\s*\*?\s*(?:pi|π)\s*(?:/\s*(\d{1,6}))?")
_DEGREES = re.compile(r"(.*\S)\s*(?:°|deg(?:rees?)?)")


class Angle(Struct, frozen=True, order=True):
    """A rational number of radians, or a rational multiple of π."""

    number: Fraction
    of_pi: bool = False

    def __str__(self) -> str:
        if not self.of_pi:
            return str(self.number)
        head = {1: "", -1: "-"}.get(self.number.numerator, f"{self.number.numerator}*")
        return f"{head}pi" + (f"/{self.number.denominator}" if self.number.denominator > 1 else "")


def read_angle(value: object) -> Angle:
    """Read an angle.

    Raises:
        ValueError: it is neither a number nor a multiple of π.
    """
    if isinstance(value, Angle):
        return value
    if isinstance(value, str) and (match := _PI.fullmatch(value.replace("−", "-").strip())):
        sign, times, below = match.groups()
        if below and int(below) == 0:
            raise ValueError(f"{value!r} divides by zero; write a number")
        factor = Fraction(int(times or 1), int(below or 1))
        return Angle(-factor if sign == "-" else factor, of_pi=bool(factor))
    try:
        if isinstance(value, str) and (turned := _DEGREES.fullmatch(value.strip())):
            factor = read_fraction(turned[1]) / 180
            return Angle(factor, of_pi=bool(factor))
        return Angle(read_fraction(value))
    except ValueError:
        raise ValueError(f"{called(value)} is not an angle; write it as 3/4, 0.75, pi/6 or 30°") from None


def turned(angle: Angle, place: str = "") -> Angle:
    """The angle of what turns: who gives more than a full turn as a plain number means degrees.

    Args:
        angle: the angle.
        place: how the complaint begins.

    Raises:
        ValueError: it is more than a full turn.
    """
    if not angle.of_pi and abs(angle.number) > 2 * pi:
        raise ValueError(f"{place}{angle} radians are more than a full turn; write degrees as '{angle}°'")
    return angle


def degrees(angle: Angle) -> float:
    """An angle in degrees, for pictures."""
    return float(angle.number * 180) if angle.of_pi else float(angle.number) * 180 / pi


def text(angle: Angle) -> str:
    """An angle for use between ``$`` signs."""
    number = angle.number
    if not angle.of_pi:
        return str(number).replace("-", "−")
    sign = "−" if number < 0 else ""
    times = "" if abs(number.numerator) == 1 else str(abs(number.numerator))
    # One fraction needs plain digits above; a factor of π stands before it.
    below = f"/{number.denominator}" if number.denominator > 1 else ""
    return f"{sign}{times}π{below}"


#: A number or a multiple of π, in a problem's givens.
AngleField = Annotated[
    Angle,
    BeforeValidator(read_angle),
    PlainSerializer(str, return_type=str),
    WithJsonSchema(
        {"type": ["string", "number"], "title": "an angle, a number or a multiple of pi such as 'pi/6', or '30°'"}
    ),
]
#: The angle of a joint or a link.
JointField = Annotated[AngleField, AfterValidator(lambda angle: turned(angle))]
