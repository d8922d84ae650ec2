"""Section 11 of the sheet: function approximation.

The values and updates that are linear in these features are not printed there.
"""

from functools import cache
from typing import Any

from msgspec.structs import replace
from sympy import Abs, Integer, Rational, evaluate, exp

from rldrill.problems.mathematics import Accent, Fence, Math, Script, listed, operator, row, variable, word
from rldrill.solutions.formula.formula import Formula, Misconception, Place
from rldrill.solutions.formula.notation import (
    A,
    ArgMaxOver,
    Choices,
    Features,
    Greatest,
    S,
    SumOver,
    Transposed,
    a,
    alpha,
    called,
    gamma,
    i,
    letter,
    pi,
    quantity,
    r,
    s,
    subscripted,
    t,
)
from rldrill.solutions.sheet.policy_gradient import Qhat, delta, f, f_vector, theta, theta_vector


def _feature(index: Math, *arguments: Math) -> Math:
    return row(Script(variable("φ"), index), Fence(listed(arguments)))


def _distance(index: Math) -> Math:
    return Fence(row(variable("s"), operator("−"), Script(variable("c"), index)), "‖", "‖")


Zero = Integer(0)
sigma = letter("sigma", "σ")
width = letter("width", "b")
j = letter("j")
Dimensions = letter("dimensions", "D")
position = quantity("position", subscripted("s"))
centre = quantity("centre", lambda index, axis: Script(variable("c"), row(index, axis)))
place = letter("place", "s")
centre_at = quantity("centre_at", subscripted("c"))
distance = quantity("distance", _distance)
phi = quantity("phi", _feature)
log_phi = quantity("log_phi", lambda index, *arguments: row(word("ln"), _feature(index, *arguments)))
phi_vector = quantity("phi_vector", called("φ"), matrix=True)
Vhat = quantity("Vhat", called(Accent(variable("V"), "hat")))


def _distances(given: Any) -> set[Any]:
    """The squares of the distances from the state to the centres; none where the state is not given."""
    if given.position is None:
        return set()
    pairs = ((given.position, point) for point in given.centres)
    return {sum((x - y) ** 2 for x, y in zip(state, point, strict=True)) for state, point in pairs}


def _goes_on(given: Any) -> bool:
    """Whether some step leads to a state that is not terminal."""
    return any(state not in given.trajectory.terminal for state in given.trajectory.states[1:])


with evaluate(False):
    CITY_BLOCK = Misconception(
        "sum-of-differences",
        "The Euclidean distance is the root of the sum of squares, not the sum of the differences.",
    )
    DISTANCE = Formula(
        "distance-to-centre",
        distance(i),
        SumOver((position(j) - centre(i, j)) ** 2, j, Dimensions) ** Rational(1, 2),
        title="Distance from a centre",
        source="Euclidean norm",
        hint="Subtract coordinate by coordinate, square, add, and take the root.",
        place=Place.WORKING,
        misread={
            CITY_BLOCK: SumOver(Abs(position(j) - centre(i, j)), j, Dimensions),
        },
    )
    DISTANCE_ON_A_LINE = Formula(
        "distance-on-a-line",
        distance(i),
        Abs(place - centre_at(i)),
        title="Distance from a centre on a line",
        source="Euclidean norm of one number",
        hint="Subtract, and drop the sign.",
        place=Place.WORKING,
    )
    HALF_FORGOTTEN = Misconception(
        "half-forgotten",
        "The squared distance is divided by 2σ², not by σ².",
    )
    SIGMA_NOT_SQUARED = Misconception(
        "sigma-not-squared",
        "The squared distance is divided by 2σ²: the width σ is squared, too.",
        when=lambda given: given.sigma != 1,
    )
    NORM_NOT_SQUARED = Misconception(
        "norm-not-squared",
        "It is the square of the distance that stands in the exponent.",
        when=lambda given: given.position is None or not _distances(given) <= {0, 1},
    )
    RBF = Formula(
        "rbf",
        phi(i, s),
        exp(-(1 / (2 * sigma**2)) * distance(i) ** 2),
        title="Radial basis function",
        source="Sutton & Barto 2018, section 9.5.5",
        hint="The squared distance from the centre, divided by 2σ², goes into the exponent with a minus sign.",
        note="The sheet writes $φ_i(s, a)$, but only $s$ counts; for several actions the features are stacked, one "
        "block for each action.",
        misread={
            HALF_FORGOTTEN: exp(-(1 / sigma**2) * distance(i) ** 2),
            SIGMA_NOT_SQUARED: exp(-(1 / (2 * sigma)) * distance(i) ** 2),
            NORM_NOT_SQUARED: exp(-(1 / (2 * sigma**2)) * distance(i)),
        },
    )
    DISTANCE_FROM_RBF = Formula(
        "distance-from-rbf",
        distance(i),
        sigma * (-2 * log_phi(i, s)) ** Rational(1, 2),
        title="Distance at which a radial basis function has a value",
        source="The radial basis function, solved for the distance",
        hint="Take the logarithm of both sides, and solve for the distance.",
        place=Place.WORKING,
    )
    WIDTH_FROM_RBF = Formula(
        "width-from-rbf",
        sigma,
        distance(i) / (-2 * log_phi(i, s)) ** Rational(1, 2),
        title="Width for which a radial basis function has a value",
        source="The radial basis function, solved for σ",
        hint="Take the logarithm of both sides, and solve for σ.",
        place=Place.WORKING,
        misread={
            HALF_FORGOTTEN: distance(i) / (-log_phi(i, s)) ** Rational(1, 2),
            SIGMA_NOT_SQUARED: distance(i) ** 2 / (-2 * log_phi(i, s)),
            NORM_NOT_SQUARED: (distance(i) / (-2 * log_phi(i, s))) ** Rational(1, 2),
        },
    )
    NOT_CLAMPED = Misconception(
        "not-clamped-at-0",
        "Beyond the distance b from its centre a feature is 0, not negative.",
        when=lambda given: (
            None in (given.width, given.position) or any(square > given.width**2 for square in _distances(given))
        ),
    )
    WIDTH_FORGOTTEN = Misconception(
        "width-forgotten",
        "The distance is divided by the width b before it is subtracted from 1.",
        when=lambda given: (
            given.width not in (1, None) and any(0 < square < max(given.width, 1) ** 2 for square in _distances(given))
        ),
    )
    TENT_SQUARED = Misconception(
        "tent-squared", "The feature falls in a straight line: the distance itself counts, not its square."
    )
    WIDTH_AND_CLAMP_FORGOTTEN = Misconception(
        "width-forgotten-and-negative", WIDTH_FORGOTTEN.says, WIDTH_FORGOTTEN.when
    )
    WIDTH_DOUBLED = Misconception(
        "width-doubled", "The feature falls from 1 to 0 within the distance b from its centre, not within 2b."
    )
    WIDTH_HALVED = Misconception(
        "width-halved", "The feature reaches 0 at the distance b from its centre, not at b/2 already."
    )
    PIECEWISE_LINEAR_RBF = Formula(
        "piecewise-linear-rbf",
        phi(i, s),
        Greatest(Zero, 1 - distance(i) / width),
        title="Piecewise linear RBF",
        source="Lecture sheet; triangular kernel",
        hint="From 1 at the centre it falls in a straight line to 0 at the distance b, and stays there.",
        misread={
            NOT_CLAMPED: 1 - distance(i) / width,
            WIDTH_FORGOTTEN: Greatest(Zero, 1 - distance(i)),
            WIDTH_AND_CLAMP_FORGOTTEN: 1 - distance(i),
            TENT_SQUARED: Greatest(Zero, 1 - (distance(i) / width) ** 2),
            WIDTH_DOUBLED: Greatest(Zero, 1 - distance(i) / (2 * width)),
            WIDTH_HALVED: Greatest(Zero, 1 - 2 * distance(i) / width),
        },
    )
    TENT_INSIDE = Formula(
        "piecewise-linear-rbf-inside",
        phi(i, s),
        1 - distance(i) / width,
        title="Piecewise linear RBF, inside its width",
        source="Lecture sheet; triangular kernel",
        hint="Nearer than b to its centre the feature is a straight line in the state.",
        place=Place.WORKING,
    )
    DISTANCE_FROM_TENT = Formula(
        "distance-from-tent",
        distance(i),
        width * (1 - phi(i, s)),
        title="Distance at which a piecewise linear basis function has a value",
        source="The triangular kernel, solved for the distance",
        hint="Where the feature is above 0 it is 1 − ‖s − cᵢ‖/b: solve for the distance.",
        place=Place.WORKING,
    )
    WIDTH_FROM_TENT = Formula(
        "width-from-tent",
        width,
        distance(i) / (1 - phi(i, s)),
        title="Width for which a piecewise linear basis function has a value",
        source="The triangular kernel, solved for b",
        hint="Where the feature is above 0 it is 1 − ‖s − cᵢ‖/b: solve for b.",
        place=Place.WORKING,
    )

    LINEAR_VALUE = Formula(
        "linear-value",
        Qhat(s, a),
        SumOver(theta(i) * f(i, s, a), i, Features),
        title="Action value, linear in features",
        source="Sutton & Barto 2018, eq. 10.3",
        hint="Multiply each weight by its feature and add; the features of other actions' blocks are 0.",
        also=(Transposed(theta_vector) * f_vector(s, a),),
        place=Place.BEYOND,
    )
    GREEDY_LINEAR = Formula(
        "greedy-linear",
        pi(s),
        ArgMaxOver(Qhat(s, a), a, Choices),
        title="Greedy action for a linear value",
        source="Sutton & Barto 2018, section 10.1",
        hint="Take the action with the greatest estimated value.",
        place=Place.WORKING,
    )
    LINEAR_STATE_VALUE = Formula(
        "linear-state-value",
        Vhat(s),
        SumOver(theta(i) * phi(i, s), i, Features),
        title="State value, linear in features",
        source="Sutton & Barto 2018, eq. 9.8",
        hint="Multiply each weight by its feature, and add.",
        also=(Transposed(theta_vector) * phi_vector(s),),
        place=Place.BEYOND,
    )
    TD_ERROR_APPROXIMATE = Formula(
        "td-error-approximate",
        delta(t),
        r(t + 1) + gamma * Vhat(S(t + 1)) - Vhat(S(t)),
        title="TD error with approximate values",
        source="Sutton & Barto 2018, section 9.3",
        hint="Reward plus the discounted estimate for the next state, minus the estimate for this one.",
        place=Place.WORKING,
    )
    THROUGH_THE_TARGET = Misconception(
        "gradient-through-the-target",
        "The target counts as a constant: only the estimate for the state that is left is differentiated.",
        when=_goes_on,
    )
    FEATURES_OF_NEXT = Misconception(
        "features-of-the-next-state",
        "The weights move along the features of the state that is left, not of the next one.",
    )
    SEMI_GRADIENT_TD = Formula(
        "semi-gradient-td",
        theta_vector,
        theta_vector + alpha * delta(t) * phi_vector(S(t)),
        title="Semi-gradient TD(0)",
        source="Sutton & Barto 2018, eq. 9.9",
        hint="Move the weights along the features of the state that is left, by α times the TD error.",
        sign="←",
        also=(theta_vector + alpha * (r(t + 1) + gamma * Vhat(S(t + 1)) - Vhat(S(t))) * phi_vector(S(t)),),
        note="The target is treated as a constant, although it depends on $θ$, too.",
        place=Place.BEYOND,
        hidden=True,
        misread={
            THROUGH_THE_TARGET: theta_vector + alpha * delta(t) * (phi_vector(S(t)) - gamma * phi_vector(S(t + 1))),
            FEATURES_OF_NEXT: theta_vector + alpha * delta(t) * phi_vector(S(t + 1)),
        },
    )
    SARSA_ERROR_APPROXIMATE = Formula(
        "sarsa-error-approximate",
        delta(t),
        r(t + 1) + gamma * Qhat(S(t + 1), A(t + 1)) - Qhat(S(t), A(t)),
        title="TD error with approximate action values",
        source="Sutton & Barto 2018, section 10.1",
        hint="Reward plus the discounted estimate for the next pair, minus the estimate for this one.",
        place=Place.WORKING,
    )
    SARSA_THROUGH_THE_TARGET = Misconception(
        "sarsa-gradient-through-the-target",
        "The target counts as a constant: only the estimate for the pair that is left is differentiated.",
        when=_goes_on,
    )
    SARSA_FEATURES_OF_NEXT = Misconception(
        "features-of-the-next-pair",
        "The weights move along the features of the pair that is left, not of the next one.",
    )
    SEMI_GRADIENT_SARSA = Formula(
        "semi-gradient-sarsa",
        theta_vector,
        theta_vector + alpha * delta(t) * f_vector(S(t), A(t)),
        title="Semi-gradient Sarsa",
        source="Sutton & Barto 2018, eq. 10.2",
        hint="Move the weights along the features of the pair of state and action that is left.",
        sign="←",
        place=Place.BEYOND,
        misread={
            SARSA_THROUGH_THE_TARGET: theta_vector
            + alpha * delta(t) * (f_vector(S(t), A(t)) - gamma * f_vector(S(t + 1), A(t + 1))),
            SARSA_FEATURES_OF_NEXT: theta_vector + alpha * delta(t) * f_vector(S(t + 1), A(t + 1)),
        },
    )


@cache
def logarithm_of_rbf() -> Formula:
    """The radial basis function with the logarithm taken on both sides, as a step on the way to what is sought."""
    with evaluate(False):
        return replace(DISTANCE_FROM_RBF, left=log_phi(i, s), right=-(1 / (2 * sigma**2)) * distance(i) ** 2)


@cache
def beside_a_centre() -> tuple[Formula, Formula]:
    """The two places on a line that are at a distance from a centre: on the left of it, and on the right."""
    with evaluate(False):
        left, right = centre_at(i) - distance(i), centre_at(i) + distance(i)
        return replace(DISTANCE_ON_A_LINE, left=place, right=left), replace(DISTANCE_ON_A_LINE, left=place, right=right)
