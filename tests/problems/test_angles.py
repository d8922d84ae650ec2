"""Angles: multiples of π and plain numbers, in degrees for pictures."""

import pytest
from pydantic import ValidationError

import rldrill
from rldrill.problems.angles import Angle, AngleField, JointField, degrees, read_angle
from rldrill.problems.errors import FileError
from rldrill.problems.expressions import turning
from rldrill.problems.family import Givens
from rldrill.problems.fractions import Fraction


class Arm(Givens):
    joint: JointField = Angle(Fraction(0))
    x: AngleField = Angle(Fraction(0))


@pytest.mark.parametrize(
    ("angle", "wanted"),
    [
        (Angle(Fraction(1, 2), of_pi=True), 90.0),
        (Angle(Fraction(-1, 6), of_pi=True), -30.0),
        (Angle(Fraction(1), of_pi=False), 57.29577951308232),  # 180/π
        (Angle(Fraction(0), of_pi=False), 0.0),
    ],
)
def test_degrees(angle: Angle, wanted: float) -> None:
    assert degrees(angle) == pytest.approx(wanted, rel=1e-12)


@pytest.mark.parametrize(
    ("typed", "angle"),
    [
        ("30°", Angle(Fraction(1, 6), of_pi=True)),
        ("-45 deg", Angle(Fraction(-1, 4), of_pi=True)),
        ("22.5 degrees", Angle(Fraction(1, 8), of_pi=True)),  # 22.5/180
        ("90deg", Angle(Fraction(1, 2), of_pi=True)),
        ("0°", Angle(Fraction(0))),
    ],
)
def test_angles_in_degrees(typed: str, angle: Angle) -> None:
    assert read_angle(typed) == angle


@pytest.mark.parametrize("typed", ["°", "x°", "30°°", "deg", "30 grad"])
def test_no_angles(typed: str) -> None:
    with pytest.raises(ValueError, match="is not an angle; write it as "):
        read_angle(typed)


@pytest.mark.parametrize("typed", [45, "-90", 6.3])
def test_degrees_are_not_taken_for_radians_of_a_joint(typed: object) -> None:
    with pytest.raises(ValidationError, match=f"{Fraction(str(typed))} radians are more than a full turn; write degr"):
        Arm.model_validate({"joint": typed})


@pytest.mark.parametrize("typed", [6.28, "-2*pi", "5*pi"])  # a full turn is 6.2832
def test_angles_of_a_joint(typed: object) -> None:
    assert Arm.model_validate({"joint": typed}).joint == read_angle(typed)


def test_other_coordinates_may_be_large() -> None:
    assert Arm.model_validate({"x": 10}).x == Angle(Fraction(10))


@pytest.mark.parametrize(
    ("rate", "angle"), [("-g*sin(θ)", "θ"), ("-g sin(θ)/l", "θ"), ("cos(θ + φ)", "φ"), ("u*tan(θ)^2", "θ")]
)
def test_what_sines_are_taken_of_is_an_angle(rate: str, angle: str) -> None:
    assert angle in turning(rate)


@pytest.mark.parametrize("rate", ["sin(x/10)", "θ + sin(2)", "sin(3 x)", "u*x"])
def test_what_is_scaled_first_is_none(rate: str) -> None:
    assert turning(rate) == ()


def test_degrees_are_not_taken_for_radians_of_a_pendulum() -> None:
    given = {"dynamics": {"θ": "ω", "ω": "u - 10*sin(θ)"}, "action": {"u": 20}, "state": {"θ": 180, "ω": 30}}
    with pytest.raises(FileError, match="state: of θ, 180 radians are more than a full turn; write degrees as '180°'"):
        rldrill.read({"family": "linearise", "given": given})
    given["state"] = {"θ": "180°", "ω": 30}  # −10 cos π = 10
    assert rldrill.read({"family": "linearise", "given": given}).answers()["a"] == ((0, 1), (10, 0))
