"""The five lines of the Kalman filter, step by step, in matrices; on a line they are 1×1."""

from collections.abc import Callable
from typing import Any, TypeAlias

from rldrill.problems.bayes.kalman_filter import Given
from rldrill.problems.exact import Parameter
from rldrill.problems.fractions import Fraction
from rldrill.solutions.exact import Value, exact, to_sympy, told
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.found import put_in_found
from rldrill.solutions.matrices import given as given_matrix
from rldrill.solutions.matrices import identity, matrix
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bayes import (
    GAIN_BEFORE_THE_MOTION,
    GAIN_ON_PREDICTION,
    KALMAN_COVARIANCE,
    KALMAN_GAIN,
    KALMAN_MEAN,
    KALMAN_MOVE_COVARIANCE,
    KALMAN_MOVE_MEAN,
    NOISES_EXCHANGED,
    PROCESS_NOISE_FORGOTTEN,
    SHARE_TAKEN,
    VARIANCES_FOR_INVERSES,
    without_command,
)
from rldrill.solutions.work import Work

#: Mean and covariance.
Gaussian: TypeAlias = tuple[Any, Any]


def solve(given: Given, work: Work) -> None:
    """Every step: the belief moved, then weighed with the measurement."""
    _filter(given, work, lambda _moved, weighed: weighed)


def _filter(given: Given, work: Work, onward: Callable[[Gaussian, Gaussian], Gaussian]) -> None:
    """The steps, each from what goes ``onward`` of the belief as it was moved and as it was weighed before it."""
    mean, covariance = given_matrix(given.mean), given_matrix(given.covariance)
    models: dict[str, Any] = {
        "Ai": given_matrix(given.A), "Bi": given_matrix(given.B), "Ci": given_matrix(given.C),
        "Ri": given_matrix(given.process), "Qi": given_matrix(given.sensor),
    }  # fmt: skip
    one = identity(len(given.mean))
    if given.on_a_line:
        ones = "A = B = C" if given.driven else "A = C"
        work.say(f"The position itself is moved and measured, so in the formulas ${ones} = 1$.")
    if given.variance is not None:
        _noise(given, work, models, exact(given.variance))
        return
    for time, event in enumerate(given.steps, 1):
        answer = work.answer if time in given.asked else _unasked
        known: dict[str, Any] = models | {"t": time, "identity": one}
        known |= {
            "mean": {time - 1: mean},
            "covariance": {time - 1: covariance},
            "moved": {time: given_matrix(given.command(event))},
        }
        mean = work.step(KALMAN_MOVE_MEAN if given.driven else without_command(), **known)
        if not given.on_a_line:
            mean = answer(mean)
        covariance = work.step(KALMAN_MOVE_COVARIANCE, **known)
        if not given.on_a_line:
            covariance = answer(covariance)
        else:
            mean, covariance = _answered(answer, mean, covariance)
        if event.z is not None:
            known |= {"mean_bar": {time: mean}, "covariance_bar": {time: covariance}}
            known["read"] = {time: given_matrix(event.z)}
            mean, covariance = onward((mean, covariance), _measured(given, work, answer, known))


def _noise(given: Given, work: Work, models: dict[str, Any], variance: Value) -> None:
    """The variance of a noise from that after the measurement, then the mean."""
    known: dict[str, Any] = models | {"t": 1, "identity": identity(1)}
    known |= {"mean": {0: given_matrix(given.mean)}, "covariance": {0: given_matrix(given.covariance)}}
    (event,) = given.steps
    known |= {"moved": {1: given_matrix(given.command(event))}, "read": {1: given_matrix(event.z or ())}}

    known["covariance_bar"] = {1: work.step(KALMAN_MOVE_COVARIANCE, **known)}
    known["Kt"] = {1: work.step(KALMAN_GAIN, **known)}
    after = work.step(KALMAN_COVARIANCE, **known)[0, 0]
    work.say(f"This must be ${told(variance)}$:")
    found = work.answer(work.equate("w", after, variance, positive=True))
    known["mean_bar"] = {1: work.step(KALMAN_MOVE_MEAN if given.driven else without_command(), **known)}
    work.say(f"With $w = {to_sympy(found)}$ the gain is:")
    known["Kt"] = {1: matrix([[put_in_found(work, KALMAN_GAIN, "w", known["Kt"][1][0, 0], found, t=1)]])}
    work.answer(work.step(KALMAN_MEAN, **known)[0, 0])


#: What to go on with after an answer.
Answering = Callable[[Any], Any]


def _unasked(value: Any) -> Any:
    """What comes out of a step that is not asked for."""
    return value


def _measured(given: Given, work: Work, answer: Answering, known: dict[str, Any]) -> Gaussian:
    gain = work.step(KALMAN_GAIN, **known)
    if given.on_a_line:
        known = known | {"Kt": {known["t"]: gain}}
        mean, covariance = work.step(KALMAN_MEAN, **known), work.step(KALMAN_COVARIANCE, **known)
        return _answered(answer, mean, covariance)
    known = known | {"Kt": {known["t"]: answer(gain)}}
    mean = answer(work.step(KALMAN_MEAN, **known))
    return mean, answer(work.step(KALMAN_COVARIANCE, **known))


def _answered(answer: Answering, mean: Any, covariance: Any) -> Gaussian:
    """Mean and variance on a line as one answer, and as matrices to go on with."""
    first, second = answer((mean[0, 0], covariance[0, 0]))
    return matrix([[first]]), matrix([[second]])


@slip(
    "measurement-forgotten-after",
    "Every step goes on from the belief after the measurement before it, not from the prediction.",
    when=lambda given: given.variance is None and any(event.z is not None for event in given.steps[:-1]),
)
def unweighed(given: Given, work: Work) -> None:
    """Every step from what the motion before has left."""
    _filter(given, work, lambda moved, _weighed: moved)


MISCONCEPTIONS = (
    GAIN_ON_PREDICTION,
    VARIANCES_FOR_INVERSES,
    PROCESS_NOISE_FORGOTTEN,
    NOISES_EXCHANGED.where_it_shows(),
    GAIN_BEFORE_THE_MOTION.where_it_shows(),
    SHARE_TAKEN.where_it_shows(),
    unweighed.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """All states and readings as one Gaussian in the first state and all noises; then conditioned at once."""
    if given.variance is not None:
        # 1/Σ₁ = 1/(Σ₀ + R) + 1/Q
        start, after = at(given.covariance[0][0]), at(given.variance)
        if isinstance(given.sensor[0][0], Parameter):
            w = 1 / (1 / after - 1 / (start + at(given.process[0][0])))
            return [w, oracle(_filled(given, "sensor", w))[1][0]]
        w = 1 / (1 / after - 1 / at(given.sensor[0][0])) - start
        return [w, oracle(_filled(given, "process", w))[1][0]]
    answers: list[Any] = []
    A, B, C, R, Q = (_array(rows) for rows in (given.A, given.B, given.C, given.process, given.sensor))
    if not given.driven:
        B = np.zeros((len(A), len(given.B[0])))
    n, m, count = len(A), len(C), len(given.steps)
    spread = np.zeros((n + count * (n + m),) * 2)
    spread[:n, :n] = _array(given.covariance)
    mean, state = _array(given.mean)[:, 0], np.eye(n, len(spread))
    seen = _Readings(np.zeros((0, len(spread))), np.zeros(0))
    for step, event in enumerate(given.steps):
        motion = n + step * (n + m)
        sensor = motion + n
        spread[motion:sensor, motion:sensor], spread[sensor : sensor + m, sensor : sensor + m] = R, Q
        state, mean = A @ state, A @ mean + B @ _array(given.command(event))[:, 0]
        state[:, motion:sensor] += np.eye(n)
        asked = step + 1 in given.asked
        if asked:
            answers += _asked(given, *seen.posterior(state, mean, spread))
        if event.z is None:
            continue
        reading = C @ state
        reading[:, sensor : sensor + m] += np.eye(m)
        before = seen
        seen = before.with_more(reading, _array(event.z)[:, 0] - C @ mean)
        if not asked:
            continue
        if not given.on_a_line:
            here = seen.posterior(state, mean, spread)[0]
            shifted = (before.with_more(reading, _array(event.z)[:, 0] - C @ mean + unit) for unit in np.eye(m))
            answers.append(np.stack([s.posterior(state, mean, spread)[0] - here for s in shifted], axis=1))
        answers += _asked(given, *seen.posterior(state, mean, spread))
    return answers


def _filled(given: Given, noise: str, w: float) -> Given:
    return given.model_copy(update={noise: ((Fraction(w),),), "variance": None})


class _Readings:
    """What was read: each reading's dependence on the first state and the noises, and its surprise."""

    def __init__(self, rows: Array, surprises: Array) -> None:
        self.rows, self.surprises = rows, surprises

    def with_more(self, rows: Array, surprises: Array) -> "_Readings":
        return _Readings(np.vstack([self.rows, rows]), np.append(self.surprises, surprises))

    def posterior(self, state: Array, mean: Array, spread: Array) -> tuple[Array, Array]:
        """Mean and covariance of a state given all that was read."""
        joint = spread @ self.rows.T
        weights = (
            np.linalg.solve(self.rows @ joint, (state @ joint).T).T if len(self.rows) else np.zeros((len(mean), 0))
        )
        return mean + weights @ self.surprises, state @ spread @ state.T - weights @ (state @ joint).T


def _asked(given: Given, mean: Array, spread: Array) -> list[Any]:
    """A belief as its parts ask for it."""
    return [[mean[0], spread[0, 0]]] if given.on_a_line else [mean, spread]


def _array(rows: Any) -> Array:
    return np.array([[at(entry) for entry in line] for line in rows])
