"""Softmax policies as solvers need them: probabilities, scores, returns; and their gradient by other means."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import Any, TypeAlias

import sympy
from sympy import Expr

from rldrill.problems.document import joined
from rldrill.problems.features import ActionFeatures, FeatureVector
from rldrill.problems.softmax import SoftmaxRun
from rldrill.solutions import knowns
from rldrill.solutions.exact import ONE, ZERO, Value, exact, ordered, simplest, to_sympy
from rldrill.solutions.formula.formula import Misconception, slip
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import at
from rldrill.solutions.sheet.policy_gradient import PREFERENCE, RETURN_FROM_A_STEP, SCORE_FUNCTION, SOFTMAX_POLICY
from rldrill.solutions.vector import Vector
from rldrill.solutions.work import Note, Work


def by_number(theta: Sequence[Value]) -> dict[str, Any]:
    """Weights as formulas need them: one by one, counted from 1, and as a vector."""
    return {
        "theta": dict(enumerate(theta, 1)),
        "features": tuple(range(1, len(theta) + 1)),
        "theta_vector": Vector(theta),
        "ones": Vector((ONE,) * len(theta)),
    }


def action_features(features: ActionFeatures) -> dict[str, Any]:
    """Features as formulas need them: one by one, and as vectors."""
    every = {(state, action): row for state, actions in features.items() for action, row in actions.items()}
    return {
        "f": {(index, *pair): exact(value) for pair, row in every.items() for index, value in enumerate(row, 1)},
        "f_vector": {pair: Vector(map(exact, row)) for pair, row in every.items()},
    }


#: A product of more factors is not written down.
_LONGEST = 12


def tell_exponentials(work: Work, preferences: Iterable[Value]) -> None:
    """Say what e to the power of a sum of logarithms is, or of a multiple of one, where a preference is such."""
    if not work.is_read:
        return
    found = [told for H in dict.fromkeys(map(to_sympy, preferences)) if (told := _exponential(H))]
    if found and Note(said := f"Since $exp(ln b) = b$, {joined(found)}.") not in work.lines:
        work.say(said)


def _exponential(H: Expr) -> str:
    """e to the power of whole multiples of logarithms as a product; nothing for a single logarithm."""
    terms = [term.as_coeff_Mul() for term in sympy.Add.make_args(ordered(H))]
    plain = all(isinstance(log, sympy.log) and times.is_Integer and times > 0 for times, log in terms)
    if not plain or not all(log.args[0].is_Integer or log.args[0].is_Symbol for _, log in terms):
        return ""
    if len(terms) == 1 and terms[0][0] == 1:
        return ""
    exponent = " + ".join(f"{'' if times == 1 else times} ln {log.args[0]}" for times, log in terms)
    numbers = [(log.args[0], times) for times, log in terms if log.args[0].is_Integer]
    letters = "".join(f" {log.args[0]}{_power(times)}" for times, log in terms if log.args[0].is_Symbol)
    factors = "·".join(f"{base}{_power(times)}" for base, times in numbers)
    if sum(times for _, times in numbers) > _LONGEST:
        return ""
    product = str(sympy.prod(base**times for base, times in numbers)) if numbers else ""
    return f"$exp({exponent}) = {factors}{letters}{'' if product == factors else f' = {product}{letters}'}$"


def _power(times: Expr) -> str:
    return "" if times == 1 else f"^{times}"


#: The probability of every action in a state, by the action and the state, from what is known.
Chances: TypeAlias = Callable[[Work, Mapping[str, Any], str, Sequence[str]], dict[tuple[str, str], Value]]


def chances(work: Work, known: Mapping[str, Any], state: str, actions: Sequence[str]) -> dict[tuple[str, str], Value]:
    """Work out the probability of every action in a state, from the preferences."""
    return _shared_out(work, _preferred(work, known, state, actions))


def _preferred(work: Work, known: Mapping[str, Any], state: str, actions: Sequence[str]) -> dict[str, Any]:
    bound = {**known, "s": state, "choices": tuple(actions)}
    return bound | {"H": {(state, action): work.step(PREFERENCE, a=action, **bound) for action in actions}}


def _shared_out(work: Work, bound: Mapping[str, Any]) -> dict[tuple[str, str], Value]:
    tell_exponentials(work, bound["H"].values())
    return {(a, s): simplest(work.step(SOFTMAX_POLICY, a=a, **bound)) for s, a in bound["H"]}


def _chances_by_sums(
    work: Work, known: Mapping[str, Any], state: str, actions: Sequence[str]
) -> dict[tuple[str, str], Value]:
    """The same by somebody who adds up the exponentials of a preference's terms."""
    bound = _preferred(work, known, state, actions)
    return _shared_out(work, bound | {"H": {pair: _logarithm_of_the_sum(bound, pair) for pair in bound["H"]}})


def exponentials_added(solve: Callable[..., None]) -> Misconception:
    """The slip of a solver, told how it gets its policy, that adds the exponentials of a preference's terms up."""
    says = "e to the power of a sum is a product: exp(x + y) = exp(x) exp(y)."
    made = slip("exponentials-added", says, when=_has_sums)(partial(solve, policy=_chances_by_sums))
    return made.where_it_shows()


def _has_sums(given: Any) -> bool:
    """Whether some preference is a sum of several terms that are not 0."""
    rows = list(given.features.values())
    vectors = [vector for row in rows for vector in row.values()] if isinstance(rows[0], dict) else rows
    weights = given.theta or ()
    return any(sum(bool(w) and bool(x) for w, x in zip(weights, vector, strict=False)) > 1 for vector in vectors)


def _logarithm_of_the_sum(known: Mapping[str, Any], pair: tuple[str, str]) -> Value:
    """The preference whose exponential is the sum of the exponentials of its terms; 0 where it has none."""
    terms = [to_sympy(weight * known["f"][(index, *pair)]) for index, weight in known["theta"].items()]
    powers = [sympy.exp(term) for term in terms if term != 0]
    return simplest(sympy.log(sum(powers))) if powers else ZERO


def score(work: Work, known: Mapping[str, Any], state: str, action: str, actions: Sequence[str]) -> Vector:
    """Work out the gradient of log π(a|s); the probabilities are known."""
    vector: Vector = work.step(SCORE_FUNCTION, **{**known, "s": state, "a": action, "choices": tuple(actions)})
    return vector


def known_run(given: SoftmaxRun) -> dict[str, Any]:
    """A run with its policy, by the formulas' letters."""
    return (
        knowns.trajectory(given.trajectory)
        | by_number([exact(weight) for weight in given.theta])
        | action_features(given.features)
        | {"gamma": exact(given.gamma), "T": len(given.trajectory.rewards)}
    )


def returns(work: Work, known: Mapping[str, Any]) -> dict[int, Value]:
    """Work out the return from every step on, backwards in time."""
    G = {known["T"]: ZERO}
    for time in reversed(range(known["T"])):
        G = {time: work.step(RETURN_FROM_A_STEP, t=time, r=known["r"], gamma=known["gamma"], G=G), **G}
    return {time: G[time] for time in range(known["T"])}


def scores(work: Work, given: SoftmaxRun, known: Mapping[str, Any]) -> dict[str, Any]:
    """Work out the probabilities in every state that is left, and the score of every action taken there."""
    run = given.trajectory
    pi: dict[tuple[str, str], Value] = {}
    for state in dict.fromkeys(run.states[:-1]):
        pi |= chances(work, known, state, tuple(given.features[state]))
    bound = {**known, "pi": pi}
    taken = dict.fromkeys(zip(run.states, run.actions, strict=False))
    return {
        "pi": pi,
        "score": {
            (action, state): score(work, bound, state, action, tuple(given.features[state])) for state, action in taken
        },
    }


def log_gradient(theta: Array, rows: Mapping[str, FeatureVector], action: str, more: Array | float = 0.0) -> Array:
    """The gradient of the logarithm of a softmax probability, by a complex step: exact to the last digits.

    ``more`` is added to the preferences, whatever the weights are.
    """
    features = np.array([[at(value) for value in row] for row in rows.values()])
    index = tuple(rows).index(action)
    tiny = 1e-30
    shifted = features @ (theta[:, None] + 1j * tiny * np.eye(len(theta))) + np.reshape(more, (-1, 1))
    shifted -= shifted.real.max()
    logs = shifted[index] - np.log(np.exp(shifted).sum(axis=0))
    return np.asarray(logs.imag / tiny)


def discounted_returns(rewards: Sequence[float], gamma: float) -> Array:
    """The returns from all times: an upper triangle of powers of γ times the rewards."""
    steps = np.subtract.outer(np.arange(len(rewards)), np.arange(len(rewards))).T
    weights = np.where(steps >= 0, gamma ** np.maximum(steps, 0), 0.0)
    return np.asarray(weights @ np.array(rewards))


def episode_gradient(given: SoftmaxRun, weights: Array) -> Array:
    """The scores of all steps, weighted and added, in floating point."""
    run = given.trajectory
    theta = np.array([at(weight) for weight in given.theta])
    pairs = zip(run.states, run.actions, weights, strict=False)
    return np.asarray(sum(w * log_gradient(theta, given.features[s], a) for s, a, w in pairs))
