"""The angle of every link, then the links added as vectors."""

from rldrill.problems.beyond_the_sheet.forward_kinematics import Given
from rldrill.solutions import arms
from rldrill.solutions.formula.formula import fork
from rldrill.solutions.oracle import Answers
from rldrill.solutions.sheet.beyond_the_sheet import ABSOLUTE_ANGLES, FORWARD_X, FORWARD_Y
from rldrill.solutions.work import Work

EXCHANGED = fork(
    "sine-for-cosine",
    "With angles from the x axis, the cosines give x and the sines give y: they were exchanged.",
)
MISCONCEPTIONS = (ABSOLUTE_ANGLES, EXCHANGED)


def solve(given: Given, work: Work) -> None:
    """The last link's angle is the orientation; the sums go on from all of them."""
    arm = arms.known(given)
    angles = arms.link_angles(work, arm)
    last = len(angles)
    arm["phi"] = angles | {last: work.answer(angles[last])}
    x, y = work.step(FORWARD_X, **arm), work.step(FORWARD_Y, **arm)
    work.answer((y, x) if work.makes(EXCHANGED) else (x, y))


def oracle(given: Given) -> Answers:
    """Rotations of the complex plane, from the last link inwards."""
    end = arms.end_point(given, arms.joint_angles(given))
    return (end[2], end[:2])
