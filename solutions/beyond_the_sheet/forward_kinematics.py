"""The angle of every link, then the links added as vectors."""

from typing import Any

from rldrill.problems.beyond_the_sheet.forward_kinematics import Given
from rldrill.problems.exact import shown
from rldrill.problems.fractions import Fraction
from rldrill.solutions import arms
from rldrill.solutions.dynamics import angle, radians
from rldrill.solutions.exact import exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.knowns import settled
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.beyond_the_sheet import ABSOLUTE_ANGLES, FORWARD_X, FORWARD_Y, LINK_ANGLE, poses
from rldrill.solutions.slips import right_answers
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """A link's angle is its orientation; the sums go on from all of them."""
    arm = arms.known(given)
    if given.x is not None:
        arm["phi"] = arms.link_angles(work, arm)
        reach = work.step(FORWARD_X, **arm)
        work.say(f"$x$ must be ${shown(given.x)}$:")
        length = work.answer(work.equate("w", reach, exact(given.x), positive=True))
        arm["length"] = settled(arm["length"], length)
        work.answer(work.step(FORWARD_Y, **arm))
        return
    base = given.base
    if base is not None:
        arm |= {"phi": {0: angle(base.phi)}, "x0": exact(base.x), "y0": exact(base.y)}
    forms = (LINK_ANGLE, FORWARD_X, FORWARD_Y) if base is None and not given.frames else poses(moved=base is not None)
    angles: dict[int, Any] = {}
    for link in given.asked:
        angles |= {index: work.step(forms[0], i=index, **arm) for index in range(len(angles) + 1, link + 1)}
        angles[link] = work.answer(angles[link])
        known = arm | {"phi": angles, "n": link}
        work.answer((work.step(forms[1], **known), work.step(forms[2], **known)))


@slip(
    "sine-for-cosine",
    "With angles from the x axis, the cosines give x and the sines give y: they were exchanged.",
    when=lambda given: given.x is None,
)
def exchanged(given: Given, work: Work) -> None:
    """y for x, and x for y."""
    answers = iter(right_answers(solve, given, work))
    for heading, (x, y) in zip(answers, answers, strict=True):
        work.answer(heading)
        work.answer((y, x))


@slip(
    "lengths-exchanged",
    "A link's length and its angle belong together: l₁ goes with φ₁, and l₂ with φ₂.",
    when=lambda given: len(given.lengths) == 2,
)
def lengths_exchanged(given: Given, work: Work) -> None:
    """The length of either link for that of the other."""
    solve(given.model_copy(update={"lengths": given.lengths[::-1]}), work)


MISCONCEPTIONS = (ABSOLUTE_ANGLES, exchanged, lengths_exchanged.where_it_shows())


def oracle(given: Given) -> Answers:
    """Rotations of the complex plane, from the last link inwards."""
    base, angles = given.base, arms.joint_angles(given)
    if given.x is not None:
        # Without the link of the unknown length, and with 1 in its place: in between x and y are linear in it.
        short, long = (
            arms.end_point(
                given.model_copy(update={"lengths": tuple(w if length == "w" else length for length in given.lengths)}),
                angles,
            )
            for w in (Fraction(0), Fraction(1))
        )
        length = (at(given.x) - short[0]) / (long[0] - short[0])
        return [length, short[1] + length * (long[1] - short[1])]
    origin = complex(at(base.x), at(base.y)) if base else 0j
    turned = radians(base.phi) if base else 0.0
    answers: list[Any] = []
    for link in given.asked:
        shorter = given.model_copy(update={"lengths": given.lengths[:link]})
        x, y, heading = arms.end_point(shorter, angles[:link])
        end = origin + complex(x, y) * np.exp(1j * turned)
        answers += [heading + turned, (end.real, end.imag)]
    return answers
