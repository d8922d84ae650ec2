"""The Jacobian column by column; the velocity from it; the determinant where it is square."""

from collections.abc import Mapping
from typing import Any

from rldrill.problems.beyond_the_sheet.jacobian import Given
from rldrill.solutions import arms, matrices
from rldrill.solutions.exact import ONE, ZERO, NoSolution, Value, exact, is_zero, tidy
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.matrices import AnyMatrix
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.beyond_the_sheet import (
    ABSOLUTE_ANGLES,
    DETERMINANT,
    END_POINT_VELOCITY,
    FIRST_RATE,
    JACOBIAN_X,
    JACOBIAN_Y,
    JOINT_RATES,
    MINUSES_FORGOTTEN,
    SECOND_RATE,
    SINGULAR,
    TRANSPOSE_FOR_INVERSE,
)
from rldrill.solutions.slips import right_answers
from rldrill.solutions.work import Work

#: Why the determinant of three links is that of the first two.
_REDUCED = (
    "Subtracting column $2$ from column $1$, and column $3$ from column $2$, does not change $det J$. Column $1$ is "
    "then the vector of link $1$ turned by $90°$, and column $2$ that of link $2$, both with $0$ below, so by the last "
    "row $det J$ is the determinant of these two vectors; the angle from the one to the other is $θ_2$:"
)


def solve(given: Given, work: Work) -> None:
    """The Jacobian, then the velocity or the rates; whether it is singular."""
    arm = arms.known(given)
    arm["phi"] = arms.link_angles(work, arm)
    ends = dict.fromkeys(arm["length"], arm["n"])
    _answer(given, work, arm, ends)


def _answer(given: Given, work: Work, arm: dict[str, Any], ends: Mapping[int, int]) -> None:
    """All parts, from the angles of the links and the last link that each joint moves."""
    rows = [
        [work.step(formula, j=joint, **arm | {"n": last}) for joint, last in ends.items()]
        for formula in (JACOBIAN_X, JACOBIAN_Y)
    ]
    if given.orientation:
        work.say("Every joint turns the last link by its own angle, so the row of $φ$ holds ones.")
        rows.append([ONE for _ in ends])
    J = work.answer(matrices.matrix(rows))
    if given.velocity is not None:
        _rates(work, J, *map(exact, given.velocity))
        return
    _velocity(given, work, J)
    if given.square:
        if given.orientation:
            work.say(_REDUCED)
        det = work.step(SINGULAR, **arm) if given.orientation else work.step(DETERMINANT, **_by_rows(J))
        singular = is_zero(det)
        work.say(f"$det J {'=' if singular else '≠'} 0$: the configuration is {'' if singular else 'not '}singular.")
        work.answer(singular)


def _rates(work: Work, J: AnyMatrix, x: Value, y: Value) -> None:
    """The two equations of the velocity, solved with the determinant."""
    work.recall(JOINT_RATES)
    work.say("The two equations are solved by Cramer's rule, with the determinant of $J$:")
    known: dict[str, Any] = _by_rows(J) | {"vx": x, "vy": y}
    known["detJ"] = work.step(DETERMINANT, **known)
    if is_zero(known["detJ"]):
        raise NoSolution("the configuration is singular, so that no or many angular velocities do this")
    work.answer((work.step(FIRST_RATE, **known), work.step(SECOND_RATE, **known)))


def _by_rows(J: AnyMatrix) -> dict[str, Any]:
    """The entries of a Jacobian with two rows, by the joint."""
    along_x, along_y = (dict(enumerate(row, 1)) for row in J.tolist())
    return {"Jx": along_x, "Jy": along_y}


def _velocity(given: Given, work: Work, J: AnyMatrix) -> None:
    velocity = work.step(END_POINT_VELOCITY, Jac=J, rates=matrices.column(map(exact, given.rates or ())))
    work.answer(tuple(velocity.entries()))


@slip(
    "transposed-jacobian",
    "J has a row for every coordinate of the end and a column for every joint; its transpose maps forces to torques.",
    when=lambda given: given.square and given.velocity is None,
)
def transposed(given: Given, work: Work) -> None:
    """Rows for columns."""
    J, _, singular = right_answers(solve, given, work)
    _velocity(given, work, work.answer(J.transpose()))
    work.answer(singular)


@slip(
    "absolute-angles-differentiated",
    "Angles count from the link before, so joint 1 turns the links behind it, too: θ₁ is in the angles of all of them.",
    when=lambda given: not given.orientation,
)
def absolute_differentiated(given: Given, work: Work) -> None:
    """Each joint's own angle against the base, and its own link alone that it moves."""
    arm = arms.known(given)
    _answer(given, work, arm | {"phi": arm["thetaj"]}, {joint: joint for joint in arm["length"]})


@slip(
    "absolute-rates",
    "Each angular velocity is relative to the link before: a link turns with the sum of all up to its own.",
    when=lambda given: given.velocity is None and len(given.lengths) == 2,
)
def absolute_rates(given: Given, work: Work) -> None:
    """Every joint turns its own link alone, though J is right."""
    J, velocity, *rest = right_answers(solve, given, work)
    rows, rates = work.answer(J).tolist(), list(map(exact, given.rates or ()))
    carried = [sum((rate * entry for rate, entry in zip(rates, row[1:], strict=False)), ZERO) for row in rows]
    work.answer(tuple(tidy(entry - more) for entry, more in zip(velocity, carried, strict=True)))
    for singular in rest:
        work.answer(singular)


MISCONCEPTIONS = (
    transposed,
    ABSOLUTE_ANGLES,
    absolute_differentiated.where_it_shows(),
    absolute_rates.where_it_shows(),
    TRANSPOSE_FOR_INVERSE.where_it_shows(),
    MINUSES_FORGOTTEN.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """Differences of end points, and the singular values of what comes out."""
    angles, h = arms.joint_angles(given), 2.0**-10
    unit = np.eye(len(angles)) * h

    def slope(turn: np.ndarray) -> np.ndarray:
        there = {step: arms.end_point(given, angles + step * turn) for step in (-3, -2, -1, 1, 2, 3)}
        return (45 * (there[1] - there[-1]) - 9 * (there[2] - there[-2]) + there[3] - there[-3]) / (60 * h)

    J = np.array([slope(turn) for turn in unit]).T[: len(given.rows)]
    if given.velocity is not None:
        return [J, np.linalg.solve(J, [at(entry) for entry in given.velocity])]
    answers: list[Any] = [J, J @ np.array([at(rate) for rate in given.rates or ()])]
    if given.square:
        answers.append(bool(np.linalg.svd(J, compute_uv=False)[-1] < 1e-9))
    return answers
