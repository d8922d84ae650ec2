"""What the lecture names without formulas: kinematics of arms, and meta-learning."""

from collections.abc import Callable
from functools import cache

from msgspec.structs import replace
from sympy import Add, Expr, Pow, Rational, cos, evaluate, sin

from rldrill.problems.mathematics import Fence, Fraction, Math, Script, listed, own, row, variable, word
from rldrill.solutions.formula.formula import Formula, Misconception, Place
from rldrill.solutions.formula.notation import (
    Blocks,
    Counting,
    SumOver,
    Transposed,
    alpha,
    i,
    letter,
    n,
    quantity,
    subscripted,
)


def _jacobian_entry(head: str) -> Callable[[Math], Math]:
    return lambda column: Script(variable("J"), listed((variable(head), column)))


j = letter("j")
theta = quantity("thetaj", subscripted("θ"))
phi = quantity("phi", subscripted("φ"))
length = quantity("length", subscripted("l"))
x_of, y_of = quantity("xof", subscripted("x")), quantity("yof", subscripted("y"))
x0, y0 = (letter(f"{axis}0", Script(variable(axis), variable("B"))) for axis in "xy")
x, y, heading = letter("xe", "x"), letter("ye", "y"), letter("headinge", "φ")
Jx, Jy = quantity("Jx", _jacobian_entry("x")), quantity("Jy", _jacobian_entry("y"))
Jacobian = letter("Jac", "J", matrix=True)
rates, velocity = letter("rates", "ω", matrix=True), letter("velocity", "v", matrix=True)
determinant = letter("detJ", row(word("det"), variable("J")))
rate = quantity("rate", subscripted("ω"))
vx, vy = (letter(f"v{axis}", Script(variable("v"), variable(axis))) for axis in "xy")

with evaluate(False):
    ABSOLUTE_ANGLES = Misconception(
        "absolute-for-relative-angles",
        "A joint's angle counts from the link before: the angles of all joints up to the link are added.",
    )
    ABSOLUTE_IN_A_FRAME = Misconception("absolute-angles-in-a-frame", ABSOLUTE_ANGLES.says)
    LINK_ANGLE = Formula(
        "link-angle",
        phi(i),
        SumOver(theta(j), j, Counting(1, i)),
        title="Angle of a link against the base",
        source="Siciliano et al. 2009, section 2.9.1",
        hint="Each joint turns everything behind it, so the angles of all joints before the link add up.",
        place=Place.BEYOND,
        misread={
            ABSOLUTE_ANGLES: theta(i),
        },
    )
    FORWARD_X = Formula(
        "forward-kinematics-x",
        x,
        SumOver(length(i) * cos(phi(i)), i, Counting(1, n)),
        title="End point of a planar arm, x",
        source="Siciliano et al. 2009, section 2.9.1",
        hint="Add the links as vectors; along x each contributes its length times the cosine of its angle.",
        place=Place.BEYOND,
    )
    FORWARD_Y = Formula(
        "forward-kinematics-y",
        y,
        SumOver(length(i) * sin(phi(i)), i, Counting(1, n)),
        title="End point of a planar arm, y",
        source="Siciliano et al. 2009, section 2.9.1",
        hint="Add the links as vectors; along y each contributes its length times the sine of its angle.",
        place=Place.BEYOND,
    )
    OWN_LINK_ALONE = Misconception(
        "own-link-alone", "A joint moves every link from its own on to the end, not its own link alone."
    )
    JACOBIAN_X = Formula(
        "jacobian-x",
        Jx(j),
        -SumOver(length(i) * sin(phi(i)), i, Counting(j, n)),
        title="Jacobian of a planar arm, row of x",
        source="Siciliano et al. 2009, section 3.2.1",
        hint="Joint j moves the links from j on; differentiate their part of x with respect to its angle.",
        place=Place.BEYOND,
        misread={
            OWN_LINK_ALONE: -length(j) * sin(phi(j)),
        },
    )
    JACOBIAN_Y = Formula(
        "jacobian-y",
        Jy(j),
        SumOver(length(i) * cos(phi(i)), i, Counting(j, n)),
        title="Jacobian of a planar arm, row of y",
        source="Siciliano et al. 2009, section 3.2.1",
        hint="Joint j moves the links from j on; differentiate their part of y with respect to its angle.",
        place=Place.BEYOND,
        misread={
            OWN_LINK_ALONE: length(j) * cos(phi(j)),
        },
    )
    END_POINT_VELOCITY = Formula(
        "jacobian",
        velocity,
        Jacobian * rates,
        title="Velocity of the end point",
        source="Siciliano et al. 2009, section 3.1",
        hint="Each joint contributes its column of J times its angular velocity.",
        place=Place.BEYOND,
    )
    JOINT_RATES = Formula(
        "jacobian-inverse",
        rates,
        Pow(Jacobian, -1) * velocity,
        title="Velocities of the joints for a velocity of the end",
        source="Siciliano et al. 2009, section 3.5",
        hint="Solve v = J ω for ω; two equations, or the inverse of J.",
        place=Place.BEYOND,
    )
    DETERMINANT = Formula(
        "jacobian-determinant-by-entries",
        determinant,
        Jx(1) * Jy(2) - Jx(2) * Jy(1),
        title="Determinant of a Jacobian with two rows and columns",
        source="Siciliano et al. 2009, section 3.3",
        hint="The product of the diagonal, minus that of the other two entries.",
        place=Place.WORKING,
    )
    TRANSPOSE_FOR_INVERSE = Misconception(
        "transpose-for-inverse",
        "The rates solve v = J ω, which takes the inverse of J; its transpose maps forces to torques.",
    )
    MINUSES_FORGOTTEN = Misconception(
        "minuses-of-the-inverse-forgotten",
        "In the inverse of a matrix of two rows those of the diagonal change places, and the other two entries get a "
        "minus sign.",
    )
    FIRST_RATE = Formula(
        "jacobian-inverse-1",
        rate(1),
        (Jy(2) * vx - Jx(2) * vy) / determinant,
        title="Velocity of the first of two joints",
        source="Siciliano et al. 2009, section 3.5",
        hint="By Cramer's rule: in the determinant above the line v takes the place of the first column of J.",
        place=Place.WORKING,
        misread={
            TRANSPOSE_FOR_INVERSE: Jx(1) * vx + Jy(1) * vy,
            MINUSES_FORGOTTEN: (Jy(2) * vx + Jx(2) * vy) / determinant,
        },
    )
    SECOND_RATE = Formula(
        "jacobian-inverse-2",
        rate(2),
        (Jx(1) * vy - Jy(1) * vx) / determinant,
        title="Velocity of the second of two joints",
        source="Siciliano et al. 2009, section 3.5",
        hint="By Cramer's rule: in the determinant above the line v takes the place of the second column of J.",
        place=Place.WORKING,
        misread={
            TRANSPOSE_FOR_INVERSE: Jx(2) * vx + Jy(2) * vy,
            MINUSES_FORGOTTEN: (Jx(1) * vy + Jy(1) * vx) / determinant,
        },
    )
    SINGULAR = Formula(
        "jacobian-determinant",
        determinant,
        length(1) * length(2) * sin(theta(2)),
        title="Determinant of the Jacobian of a planar arm",
        source="Siciliano et al. 2009, section 3.3",
        hint="It vanishes where the arm is stretched out or folded back.",
        note="The same for three links, where the orientation is the third row.",
        place=Place.BEYOND,
    )


@cache
def poses(*, moved: bool) -> tuple[Formula, Formula, Formula]:
    """The angle and the end of any link, perhaps on a base that is moved and turned."""
    with evaluate(False):
        turned = (phi(0),) if moved else ()
        right, absolute = Add(*turned, SumOver(theta(j), j, Counting(1, i))), Add(*turned, theta(i))
        return (
            replace(LINK_ANGLE, right=right, misread={ABSOLUTE_IN_A_FRAME: absolute}),
            _end(FORWARD_X, x_of(n), (x0,) if moved else (), cos),
            _end(FORWARD_Y, y_of(n), (y0,) if moved else (), sin),
        )


def _end(formula: Formula, left: Expr, start: tuple[Expr, ...], turn: Callable[[Expr], Expr]) -> Formula:
    return replace(formula, left=left, right=Add(*start, SumOver(length(i) * turn(phi(i)), i, Counting(1, n))))


# Denavit and Hartenberg ------------------------------------------------------------------------------
T_i = quantity("Ti", lambda below: Script(variable("T"), below), matrix=True)
T_total = letter("Ttotal", "T", matrix=True)
th, d, al = quantity("th", subscripted("θ")), quantity("d", subscripted("d")), quantity("al", subscripted("α"))
a_link = quantity("alink", subscripted(own("a")))
rotation = quantity("rotation", subscripted("R"), matrix=True)
origin, point = quantity("origin", subscripted("o"), matrix=True), quantity("point", subscripted("p"), matrix=True)
before, after = letter("before", "T", matrix=True), letter("after", Script(variable("T"), variable("i")), matrix=True)
R_total = letter("Rtotal", "R", matrix=True)

with evaluate(False):
    CRAIGS = Misconception(
        "modified-convention",
        "Here the turn by θ comes first and the turn by α last; the other order is Craig's modified convention.",
    )
    ALPHA_TURNED_BACK = Misconception(
        "alpha-turned-back",
        "Turning by α about x takes y to (0, cos α, sin α): the signs of sin α were exchanged, which turns it back.",
    )
    LINK_TRANSFORM = Formula(
        "denavit-hartenberg",
        T_i(i),
        Blocks(
            4,
            cos(th(i)), -sin(th(i)) * cos(al(i)), sin(th(i)) * sin(al(i)), a_link(i) * cos(th(i)),
            sin(th(i)), cos(th(i)) * cos(al(i)), -cos(th(i)) * sin(al(i)), a_link(i) * sin(th(i)),
            0, sin(al(i)), cos(al(i)), d(i),
            0, 0, 0, 1,
        ),
        title="Denavit-Hartenberg transform of a link",
        source="Siciliano et al. 2009, section 2.8.2",
        hint="Turn by θ about z and shift by d along it, then shift by a along the new x and turn by α about it.",
        place=Place.BEYOND,
    misread={CRAIGS: Blocks(
            4,
            cos(th(i)), -sin(th(i)), 0, a_link(i),
            sin(th(i)) * cos(al(i)), cos(th(i)) * cos(al(i)), -sin(al(i)), -sin(al(i)) * d(i),
            sin(th(i)) * sin(al(i)), cos(th(i)) * sin(al(i)), cos(al(i)), cos(al(i)) * d(i),
            0, 0, 0, 1,
        ),
        ALPHA_TURNED_BACK: Blocks(
            4,
            cos(th(i)), -sin(th(i)) * cos(al(i)), -sin(th(i)) * sin(al(i)), a_link(i) * cos(th(i)),
            sin(th(i)), cos(th(i)) * cos(al(i)), cos(th(i)) * sin(al(i)), a_link(i) * sin(th(i)),
            0, -sin(al(i)), cos(al(i)), d(i),
            0, 0, 0, 1,
        ),},)  # fmt: skip
    WRONG_ORDER = Misconception(
        "wrong-order",
        "Each link's transform is given in the frame of the link before, so it is multiplied from the right.",
    )
    CHAIN = Formula(
        "link-product",
        T_total,
        before * after,
        title="Transforms of a chain of links",
        source="Siciliano et al. 2009, section 2.8.1",
        hint="From the base outwards, each new link is multiplied from the right.",
        sign="←",
        place=Place.WORKING,
        misread={
            WRONG_ORDER: after * before,
        },
    )
    LINK_ORIGIN = Formula(
        "link-origin",
        origin(i),
        Blocks(3, a_link(i) * cos(th(i)), a_link(i) * sin(th(i)), d(i)),
        title="Origin of a link's frame",
        source="Siciliano et al. 2009, section 2.8.2",
        hint="Shift by d along z, and by a along the x that has been turned by θ.",
        place=Place.WORKING,
        misread={CRAIGS: Blocks(3, a_link(i), -sin(al(i)) * d(i), cos(al(i)) * d(i))},
    )
    ORIGIN_TURNED = Misconception(
        "origin-turned", "The origin is given in the frame before: it is added after the rotation, and not turned."
    )
    FORWARD_POINT = Formula(
        "frame-point",
        point(i - 1),
        rotation(i) * point(i) + origin(i),
        title="A point in the frame before",
        source="Siciliano et al. 2009, section 2.7",
        hint="Turn it by the rotation of the link's transform, then add the transform's last column.",
        note="$T_i$ has the rotation $R_i$ and the origin $o_i$.",
        place=Place.WORKING,
        misread={
            ORIGIN_TURNED: rotation(i) * (point(i) + origin(i)),
        },
    )
    NOT_INVERTED = Misconception(
        "not-inverted",
        "Outwards the transform is inverted: first the origin is subtracted, then the transpose undoes the rotation.",
    )
    BACK_POINT = Formula(
        "frame-point-back",
        point(i),
        Transposed(rotation(i)) * (point(i - 1) - origin(i)),
        title="A point in the next frame",
        source="Siciliano et al. 2009, section 2.7",
        hint="Subtract the origin, then undo the rotation: its inverse is its transpose.",
        place=Place.WORKING,
        misread={
            NOT_INVERTED: rotation(i) * point(i - 1) + origin(i),
        },
    )


@cache
def rotations() -> tuple[Formula, Formula]:
    """The rotation in a link's transform, and the product of those of several links."""
    with evaluate(False):
        right = Blocks(3, *_corner(LINK_TRANSFORM.right))
        misread = {mistake: Blocks(3, *_corner(each)) for mistake, each in LINK_TRANSFORM.misread.items()}
        return (
            replace(LINK_TRANSFORM, left=rotation(i), right=right, misread=misread),
            replace(CHAIN, left=R_total, right=R_total * rotation(i), misread={WRONG_ORDER: rotation(i) * R_total}),
        )


@cache
def shifts() -> tuple[Formula, Formula]:
    """A point in the frame before and in the next one, where the rotation between them is the identity."""
    with evaluate(False):
        return (
            replace(FORWARD_POINT, right=point(i) + origin(i), misread={}),
            replace(BACK_POINT, right=point(i - 1) - origin(i), misread={NOT_INVERTED: point(i - 1) + origin(i)}),
        )


def _corner(transform: Expr) -> tuple[Expr, ...]:
    """The entries of the first three rows and columns of a transform."""
    _, *entries = transform.args
    return (*entries[:3], *entries[4:7], *entries[8:11])


# Meta-learning ---------------------------------------------------------------------------------------
def _adapted(index: Math) -> Math:
    return Script(variable("θ′"), index)


def _slope(of: Math) -> Math:
    return Fraction(row(variable("d"), of), row(variable("d"), variable("θ")))


def _loss(argument: Math, index: Math) -> Math:
    return row(Script(variable("∇"), variable("θ")), Script(own("L"), index), Fence(argument))


theta0, beta = letter("theta0", "θ"), letter("beta", "β")
adapted = quantity("adapted", _adapted)
adapted_slope = quantity("adaptedSlope", lambda index: _slope(_adapted(index)))
curvature, optimum = quantity("curvature", subscripted("c")), quantity("optimum", subscripted("m"))
loss_gradient = quantity("lossGradient", lambda index: _loss(_adapted(index), index))
inner_gradient = quantity("innerGradient", lambda index: _loss(variable("θ"), index))
outer_gradient = letter("outerGradient", _slope(variable("J")))
Tasks = letter("tasks", "N")

with evaluate(False):
    HALF_KEPT = Misconception(
        "half-kept", "The derivative of c/2·(θ − m)² is c(θ − m): the 2 of the power and the 1/2 cancel."
    )
    MAML_INNER = Formula(
        "maml-inner",
        adapted(i),
        theta0 - alpha * curvature(i) * (theta0 - optimum(i)),
        title="MAML: adaptation to one task",
        source="Finn, Abbeel & Levine 2017, section 2.2",
        hint="One gradient step on the task's own loss, from the shared θ.",
        also=(theta0 - alpha * inner_gradient(i),),
        note="For losses $!L_i(θ) = c_i/2 (θ − m_i)^2$.",
        place=Place.BEYOND,
        misread={
            HALF_KEPT: theta0 - Rational(1, 2) * alpha * curvature(i) * (theta0 - optimum(i)),
        },
    )
    MAML_DERIVATIVE = Formula(
        "maml-derivative",
        adapted_slope(i),
        1 - alpha * curvature(i),
        title="MAML: how the adapted parameter depends on the shared one",
        source="Finn, Abbeel & Levine 2017, section 2.2",
        hint="Differentiate θ′ = θ − αc(θ − m) with respect to θ.",
        place=Place.WORKING,
        misread={
            HALF_KEPT: 1 - Rational(1, 2) * alpha * curvature(i),
        },
    )
    MAML_GRADIENT = Formula(
        "maml-gradient",
        outer_gradient,
        SumOver(curvature(i) * (adapted(i) - optimum(i)) * adapted_slope(i), i, Tasks),
        title="MAML: gradient of the outer loss",
        source="Finn, Abbeel & Levine 2017, eq. 1",
        hint="The chain rule: the derivative of every adapted parameter, times that of its loss.",
        place=Place.WORKING,
        misread={
            HALF_KEPT: SumOver(Rational(1, 2) * curvature(i) * (adapted(i) - optimum(i)) * adapted_slope(i), i, Tasks),
        },
    )
    MAML_FIRST_ORDER = Formula(
        "maml-first-order",
        theta0,
        theta0 - beta * SumOver(curvature(i) * (adapted(i) - optimum(i)), i, Tasks),
        title="First-order MAML: step of the shared parameter",
        source="Finn, Abbeel & Levine 2017, section 5.2",
        hint="The gradient of every loss at the adapted parameter, as if this did not depend on θ.",
        sign="←",
        place=Place.WORKING,
        misread={
            HALF_KEPT: theta0 - beta * SumOver(Rational(1, 2) * curvature(i) * (adapted(i) - optimum(i)), i, Tasks),
        },
    )
    FIRST_ORDER = Misconception(
        "first-order",
        "The full gradient goes through the adaptation: dθ′ᵢ/dθ = 1 − αcᵢ; leaving it out is first-order MAML.",
    )
    NOT_ADAPTED = Misconception(
        "gradient-before-adaptation", "The outer loss is that of the adapted parameters θ′, not that of θ itself."
    )
    FROM_ADAPTED = Misconception(
        "outer-step-from-adapted",
        "The outer step starts from θ itself; the adapted θ′ serves only to work out the gradient.",
        when=lambda given: len(given.tasks) == 1 and given.theta is not None,
    )
    MAML_OUTER = Formula(
        "maml-step",
        theta0,
        theta0 - beta * SumOver((1 - alpha * curvature(i)) * curvature(i) * (adapted(i) - optimum(i)), i, Tasks),
        title="MAML: step of the shared parameter",
        source="Finn, Abbeel & Levine 2017, eq. 1",
        hint="The adapted θ′ depends on θ: the chain rule gives the factor 1 − αc.",
        sign="←",
        also=(theta0 - beta * SumOver(loss_gradient(i), i, Tasks),),
        place=Place.BEYOND,
        misread={
            FIRST_ORDER: theta0 - beta * SumOver(curvature(i) * (adapted(i) - optimum(i)), i, Tasks),
            NOT_ADAPTED: theta0 - beta * SumOver(curvature(i) * (theta0 - optimum(i)), i, Tasks),
            HALF_KEPT: theta0
            - beta
            * SumOver(
                (1 - Rational(1, 2) * alpha * curvature(i)) * Rational(1, 2) * curvature(i) * (adapted(i) - optimum(i)),
                i,
                Tasks,
            ),
            FROM_ADAPTED: adapted(1)
            - beta * SumOver((1 - alpha * curvature(i)) * curvature(i) * (adapted(i) - optimum(i)), i, Tasks),
        },
    )
