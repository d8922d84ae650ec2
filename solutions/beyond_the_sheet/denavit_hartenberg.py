"""One transform for each link, then their product from the base outwards."""

from typing import Any

import numpy as np

from rldrill.problems.beyond_the_sheet.denavit_hartenberg import Given, Link
from rldrill.solutions import matrices
from rldrill.solutions.dynamics import angle, radians
from rldrill.solutions.exact import exact
from rldrill.solutions.formula.formula import Misconception
from rldrill.solutions.oracle import Answers, Array, at
from rldrill.solutions.sheet.beyond_the_sheet import CHAIN, CRAIGS, LINK_TRANSFORM, WRONG_ORDER
from rldrill.solutions.work import Work

MISCONCEPTIONS: tuple[Misconception, ...] = (CRAIGS, WRONG_ORDER)


def solve(given: Given, work: Work) -> None:
    """The product goes on from the transforms as they were answered."""
    known: dict[str, Any] = {
        "th": {index: angle(link.theta) for index, link in enumerate(given.links, 1)},
        "al": {index: angle(link.alpha) for index, link in enumerate(given.links, 1)},
        "d": {index: exact(link.d) for index, link in enumerate(given.links, 1)},
        "alink": {index: exact(link.a) for index, link in enumerate(given.links, 1)},
    }
    transforms = [work.answer(work.step(LINK_TRANSFORM, i=index, **known)) for index in known["th"]]
    if given.base is None:
        total, rest, first = transforms[0], transforms[1:], 2
    else:
        total, rest, first = matrices.given(given.base), transforms, 1
    for index, transform in enumerate(rest, first):
        total = work.step(CHAIN, before=total, after=transform, i=index)
        if index in given.posed:
            total = work.answer(total)


def oracle(given: Given) -> Answers:
    """Four elementary motions for each link, one after the other."""
    transforms = [_moved(link) for link in given.links]
    base = np.eye(4) if given.base is None else np.array([[at(entry) for entry in row] for row in given.base])
    poses = [np.linalg.multi_dot([base, np.eye(4), *transforms[:link]]) for link in given.posed]
    return [*transforms, *poses]


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
