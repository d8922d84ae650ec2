"""The angle of every link, then the links added as vectors."""

from rldrill.problems.beyond_the_sheet.forward_kinematics import Given
from rldrill.solutions import arms
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.oracle import Answers
from rldrill.solutions.sheet.beyond_the_sheet import ABSOLUTE_ANGLES, FORWARD_X, FORWARD_Y
from rldrill.solutions.slips import right_answers
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """The last link's angle is the orientation; the sums go on from all of them."""
    arm = arms.known(given)
    angles = arms.link_angles(work, arm)
    last = len(angles)
    arm["phi"] = angles | {last: work.answer(angles[last])}
    work.answer((work.step(FORWARD_X, **arm), work.step(FORWARD_Y, **arm)))


@slip("sine-for-cosine", "With angles from the x axis, the cosines give x and the sines give y: they were exchanged.")
def exchanged(given: Given, work: Work) -> None:
    """y for x, and x for y."""
    heading, (x, y) = right_answers(solve, given, work)
    work.answer(heading)
    work.answer((y, x))


MISCONCEPTIONS = (ABSOLUTE_ANGLES, exchanged)


def oracle(given: Given) -> Answers:
    """Rotations of the complex plane, from the last link inwards."""
    end = arms.end_point(given, arms.joint_angles(given))
    return (end[2], end[:2])
