"""The end point and the orientation of a planar arm."""

from rldrill.problems.arms import PlanarArm, draw_angles, situation
from rldrill.problems.draws import Draws
from rldrill.problems.family import Question
from rldrill.problems.parts import Number, Numbers, Part

TITLE = "Forward kinematics"
SOURCE = "Siciliano et al. 2009, section 2.9.1"
REVISION = 1


class Given(PlanarArm):
    """An arm; what is asked for is where its end is, and how it points."""


def draw(level: int, rng: Draws) -> Given:
    """Two links at right angles; then at angles with short sines; then three links."""
    count = 3 if level == 3 else 2
    lengths = tuple(rng.whole(1, 4) if level < 3 else rng.fraction("1", "2", "3", "4", "1/2") for _ in range(count))
    return Given(lengths=lengths, angles=draw_angles(rng, level, count))


def question(given: Given) -> Question:
    """Orientation, then position."""
    return Question(
        situation(given),
        (
            Part("What is the angle $φ$ of the last link against the $x$ axis, in radians?", Number(), zero=True),
            Part("Where is the end point $(x, y)$ of the last link?", Numbers(("x", "y")), points=2),
        ),
    )
