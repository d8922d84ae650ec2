"""Which problems are drawn, and that what is drawn is what is given or computed."""

from collections.abc import Iterator
from fractions import Fraction
from itertools import product

import pytest
from flint import fmpq

from rldrill.exercise import draw, read
from rldrill.problems.document import Beside, Document
from rldrill.problems.errors import FileError
from rldrill.problems.pictures import Arm, Bars, Bumps, Pendulum, Picture


def pictures(document: Document) -> Iterator[Picture]:
    for block in document:
        if isinstance(block, Picture):
            yield block
        elif isinstance(block, Beside):
            yield from pictures(block.blocks)


@pytest.mark.parametrize(
    ("family", "level"), [*product(["jacobian"], [1, 2, 3]), *product(["forward-kinematics"], [1, 2])]
)
def test_an_arm_is_drawn_with_its_lengths_and_angles(family: str, level: int) -> None:
    exercise = draw(family, level, seed=3)
    (arm,) = pictures(exercise.question())
    given = exercise.problem.given
    assert isinstance(arm, Arm)
    assert arm.lengths == tuple(map(float, given.lengths))  # type: ignore[attr-defined]
    degrees = [angle.number * 180 for angle in given.angles]  # type: ignore[attr-defined]
    assert arm.angles == pytest.approx([float(angle) for angle in degrees])


def test_the_features_on_a_line_are_drawn_over_it() -> None:
    given = {"position": [1], "centres": [[0], [3]], "sigma": "1/2"}
    assert list(pictures(read({"family": "rbf", "given": given}).question())) == [Bumps((0, 3), 0.5, "gaussian", 1)]
    tents = {"position": [1], "centres": [[0], [3]], "width": 2}
    found = read({"family": "piecewise-linear-rbf", "given": tents}).question()
    assert list(pictures(found)) == [Bumps((0, 3), 2, "tent", 1)]
    in_the_plane = {"position": [1, 2], "centres": [[0, 0], [3, 1]], "width": 2}
    assert not list(pictures(read({"family": "piecewise-linear-rbf", "given": in_the_plane}).question()))


PENDULUM = {
    "dynamics": {"θ": "ω", "ω": "u - sin(θ)"},
    "state": {"θ": "pi/6", "ω": 0},
    "action": {"u": 0},
    "picture": "pendulum",
}


def test_a_robot_is_drawn_at_its_operating_point() -> None:
    assert list(pictures(read({"family": "linearise", "given": PENDULUM}).question())) == [Pendulum(30)]
    standing = PENDULUM | {"state": {"θ": "pi", "ω": 0}, "picture": "cart-pole"}
    assert list(pictures(read({"family": "linearise", "given": standing}).question())) == [Pendulum(180, cart=True)]


def test_a_picture_needs_the_letters_that_it_shows() -> None:
    with pytest.raises(FileError, match="picture: there is no l_1, which the picture of 'arm' shows"):
        read({"family": "linearise", "given": PENDULUM | {"picture": "arm"}})


@pytest.mark.parametrize("family", ["bayes-rule", "bayes-predict", "bayes-filter"])
def test_beliefs_before_and_after_are_drawn_in_the_working(family: str) -> None:
    exercise = draw(family, 2, seed=1)
    given = exercise.problem.given
    before = dict(given.prior if family == "bayes-rule" else given.belief)  # type: ignore[attr-defined]
    drawn = [block for block in exercise.working() if isinstance(block, Bars)]
    assert len(drawn) == len(exercise.parts)
    for part, bars in zip(exercise.parts, drawn, strict=True):
        after = exercise.solve()[part.label]
        assert bars.names == tuple(before)
        assert bars.series == ("before", "after")
        assert bars.shares[0] == pytest.approx([float(Fraction(str(chance))) for chance in before.values()])
        assert bars.shares[1] == pytest.approx([float(Fraction(str(chance))) for chance in after.values()])
        before = after


def test_a_belief_with_an_open_probability_has_no_bars() -> None:
    drawn = (draw("bayes-predict", 3, seed) for seed in range(50))
    exercise = next(each for each in drawn if each.problem.parameters)
    assert not all(isinstance(chance, fmpq) for chance in exercise.solve()["a"].values())
    assert not [block for block in exercise.working() if isinstance(block, Bars)]
