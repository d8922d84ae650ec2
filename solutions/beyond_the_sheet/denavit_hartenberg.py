"""One transform for each link, then their product from the base outwards."""

from typing import Any

from rldrill.problems.beyond_the_sheet.denavit_hartenberg import Given, Link
from rldrill.problems.exact import shown
from rldrill.solutions import matrices
from rldrill.solutions.dynamics import angle, radians
from rldrill.solutions.exact import exact
from rldrill.solutions.formula.formula import Misconception, slip
from rldrill.solutions.matrices import AnyMatrix
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.beyond_the_sheet import (
    BACK_POINT,
    CHAIN,
    CRAIGS,
    FORWARD_POINT,
    LINK_ORIGIN,
    LINK_TRANSFORM,
    NOT_INVERTED,
    WRONG_ORDER,
    rotations,
    shifts,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """The product goes on from the transforms as they were answered."""
    known: dict[str, Any] = {
        "th": {index: angle(link.theta) for index, link in enumerate(given.links, 1)},
        "al": {index: angle(link.alpha) for index, link in enumerate(given.links, 1)},
        "d": {index: exact(link.d) for index, link in enumerate(given.links, 1)},
        "alink": {index: exact(link.a) for index, link in enumerate(given.links, 1)},
    }
    if given.point is not None:
        _through(given, work, known, matrices.column(map(exact, given.point)))
        return
    if given.asked == "pose":
        _pose(work, known)
        return
    transforms = [work.answer(work.step(LINK_TRANSFORM, i=index, **known)) for index in known["th"]]
    if given.base is None:
        total, rest, first = transforms[0], transforms[1:], 2
    else:
        total, rest, first = matrices.given(given.base), transforms, 1
    for index, transform in enumerate(rest, first):
        total = work.step(CHAIN, before=total, after=transform, i=index, label=f"i = {index}")
        if index in given.posed:
            total = work.answer(total)


def _pose(work: Work, known: dict[str, Any]) -> None:
    """The rotation of the last frame, then its origin, seen from frame to frame inwards."""
    first, *others = known["th"]
    work.say(_PARTS)
    of_link, of_chain = rotations()
    turns = {link: work.step(of_link, i=link, **known) for link in known["th"]}
    total = turns[first]
    if others:
        work.say("The product begins with $R = R_1$:")
    for link in others:
        total = work.step(of_chain, Rtotal=total, rotation=turns, i=link, label=f"i = {link}")
    work.answer(total)
    origins = {link: work.step(LINK_ORIGIN, i=link, **known) for link in known["th"]}
    *before, last = known["th"]
    seen = origins[last]
    if before:
        work.say(
            f"In the frame of link ${last - 1}$ the last origin is $p_{last - 1} = o_{last}$; in the frames before it:"
        )
    for link in reversed(before):
        seen = work.step(FORWARD_POINT, i=link, point={link: seen}, rotation=turns, origin=origins)
    work.answer(tuple(seen.entries()))


_PARTS = (
    "$R_i$ is the rotation in $T_i$, its upper left corner, and $o_i$ the origin, the first three entries of its last "
    "column."
)


def _through(given: Given, work: Work, known: dict[str, Any], point: AnyMatrix) -> None:
    """A point from frame to frame, inwards or outwards; each transform is worked out where it is needed."""
    outwards = given.asked == "back"
    links = tuple(known["th"])
    work.say(_PARTS)
    if outwards:
        work.say("From $p_{i−1} = R_i p_i + o_i$ follows $p_i = R_i^{−1} (p_{i−1} − o_i)$, and $R_i^{−1} = R_i^⊤$.")
    for link in links if outwards else links[::-1]:
        here = link - 1 if outwards else link
        own = given.links[link - 1]
        if own.theta.number == own.alpha.number == 0:
            work.say(
                f"Link ${link}$ neither turns nor twists: $R_{link}$ is the identity, and "
                f"$o_{link} = ({shown(own.a)}, 0, {shown(own.d)})^⊤$."
            )
            shift = matrices.column(map(exact, (own.a, 0, own.d)))
            moved = work.step(shifts()[outwards], i=link, point={here: point}, origin={link: shift})
        else:
            turn, shift = (work.step(part, i=link, **known) for part in (rotations()[0], LINK_ORIGIN))
            formula = BACK_POINT if outwards else FORWARD_POINT
            moved = work.step(formula, i=link, point={here: point}, rotation={link: turn}, origin={link: shift})
        point = matrices.column(work.answer(tuple(moved.entries())))


def _exchanged(given: Given, one: str, other: str) -> Given:
    """The links with the two parameters of each of them exchanged."""
    links = (link.model_copy(update={one: getattr(link, other), other: getattr(link, one)}) for link in given.links)
    return given.model_copy(update={"links": tuple(links)})


@slip("offset-for-length", "d shifts along z, a along the new x: the two lengths were exchanged.")
def lengths_exchanged(given: Given, work: Work) -> None:
    """The columns of d and a exchanged."""
    solve(_exchanged(given, "d", "a"), work)


@slip("twist-for-angle", "θ turns about z, α about the new x: the two angles were exchanged.")
def angles_exchanged(given: Given, work: Work) -> None:
    """The columns of θ and α exchanged."""
    solve(_exchanged(given, "theta", "alpha"), work)


MISCONCEPTIONS: tuple[Misconception, ...] = (
    CRAIGS,
    WRONG_ORDER,
    NOT_INVERTED,
    lengths_exchanged.where_it_shows(),
    angles_exchanged.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """Four elementary motions for each link, one after the other."""
    transforms = [_moved(link) for link in given.links]
    if given.point is not None:
        return _seen(given, transforms, np.array([*map(at, given.point), 1.0]))
    base = np.eye(4) if given.base is None else np.array([[at(entry) for entry in row] for row in given.base])
    poses = [np.linalg.multi_dot([base, np.eye(4), *transforms[:link]]) for link in given.posed]
    if given.asked == "pose":
        pose = poses[-1] if poses else transforms[0]
        return [pose[:3, :3], pose[:3, 3]]
    return [*transforms, *poses]


def _seen(given: Given, transforms: list[Array], point: Array) -> list[Any]:
    """The point in the world of the base, then in the frames."""
    poses = [np.linalg.multi_dot([np.eye(4), np.eye(4), *transforms[:link]]) for link in range(len(transforms) + 1)]
    if given.asked == "back":
        return [np.linalg.solve(pose, point)[:3] for pose in poses[1:]]
    seen = poses[-1] @ point
    return [np.linalg.solve(pose, seen)[:3] for pose in poses[-2::-1]]


def _moved(link: Link) -> Array:
    about_z, about_x = _turn(radians(link.theta), 0, 1), _turn(radians(link.alpha), 1, 2)
    return about_z @ _shift(2, at(link.d)) @ _shift(0, at(link.a)) @ about_x


def _turn(by: float, first: int, second: int) -> Array:
    result: Array = np.eye(4)
    result[[first, second], [first, second]] = np.cos(by)
    result[second, first] = np.sin(by)
    result[first, second] = -np.sin(by)
    return result


def _shift(axis: int, by: float) -> Array:
    result: Array = np.eye(4)
    result[axis, 3] = by
    return result
