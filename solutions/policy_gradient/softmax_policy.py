"""Preferences, then their softmax; the probabilities stay closed forms in e."""

from collections.abc import Callable, Mapping
from functools import reduce
from operator import mul
from typing import Any

import sympy

from rldrill.problems.document import Equation
from rldrill.problems.exact import Logarithm
from rldrill.problems.features import FeatureVector
from rldrill.problems.fractions import Fraction
from rldrill.problems.policy_gradient.softmax_policy import Given, Odds
from rldrill.solutions.exact import ONE, ZERO, Value, exact, parameters, simplest, tidy, to_sympy
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.formula.nodes.leaves import leaf
from rldrill.solutions.formula.typesetting import typeset
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.rational import generator
from rldrill.solutions.sheet.policy_gradient import (
    ENTROPY,
    NOT_NORMALISED,
    PREFERENCE,
    SOFTMAX_ODDS,
    SOFTMAX_POLICY,
    WITHOUT_EXP,
)
from rldrill.solutions.sheet.policy_gradient import theta as theta_of
from rldrill.solutions.softmax import action_features, by_number, chances
from rldrill.solutions.work import Equality, Step, Work


def solve(given: Given, work: Work) -> None:
    """The preference of every action, then every probability."""
    actions = tuple(given.features)
    known = by_number([exact(weight) for weight in given.theta]) | action_features({"s": given.features})
    known |= {"s": "s", "choices": actions}
    if given.odds is not None:
        _from_odds(given, given.odds, work, known)
        return
    preferences = work.answer({action: work.step(PREFERENCE, a=action, **known) for action in actions})
    known["H"] = {("s", action): preferences[action] for action in actions}
    found = work.answer({action: work.step(SOFTMAX_POLICY, a=action, **known) for action in actions})
    if given.entropy:
        known["pi"] = {(action, "s"): found[action] for action in actions}
        entropy = work.step(ENTROPY, **known)
        if work.lines and isinstance(last := work.lines[-1], Step) and _of_fractions(last):
            work.lines[-1] = _TakenApart(*last)
        work.answer(entropy)


#: Longer numbers nobody takes apart into primes.
_FACTORED = 10**6


def _of_fractions(step: Step) -> bool:
    """Whether all probabilities are fractions that somebody takes apart into primes."""
    chances = map(to_sympy, step.known["pi"].values())
    return all(chance.is_Rational and chance.q < _FACTORED for chance in chances)


class _TakenApart(Step):
    """An entropy: the logarithm of every fraction in those of primes, then multiplied out, action by action."""

    def _written(self) -> Equation:
        plain = super()._written()
        apart, products = [], []
        for chance in self.known["pi"].values():
            number = to_sympy(chance)
            apart.append(sympy.Mul(number, leaf(tidy(sympy.log(number))), evaluate=False))
            powers = sorted(sympy.factorrat(number).items())
            products += [sympy.Mul(-number * power, sympy.log(prime), evaluate=False) for prime, power in powers]
        lines = sympy.Mul(-1, sympy.Add(*apart, evaluate=False), evaluate=False), sympy.Add(*products, evaluate=False)
        rights = (plain.rights[0], *map(typeset, lines), plain.rights[-1])
        return Equation(plain.left, rights, ("=",) * len(rights))


def _from_odds(given: Given, odds: Odds, work: Work, known: Mapping[str, Any]) -> None:
    """The quotient of two probabilities has no sum in it, and is linear in x; then everything with this x."""
    pair = odds.action, odds.other
    bound = {**known, "H": {("s", action): work.step(PREFERENCE, a=action, **known) for action in pair}}
    quotient = work.step(SOFTMAX_ODDS, a=odds.action, a1=odds.other, **bound)
    x = work.answer(work.equate("x", quotient, exact(odds.times)))
    theta = [
        sympy.expand_log(to_sympy(exact(weight)).subs(to_sympy(generator("x")), to_sympy(x)), factor=True)
        for weight in given.theta
    ]
    for index, (weight, value) in enumerate(zip(given.theta, theta, strict=True), 1):
        if isinstance(weight, Logarithm) and weight.of == "x":
            work.lines.append(Equality(theta_of(index), (sympy.log(leaf(x), evaluate=False), tidy(value))))
    found = chances(work, {**known, **by_number(theta)}, "s", tuple(given.features))
    work.answer({action: found[action, "s"] for action in given.features})


def _from_exponentials(given: Given, work: Work, exponential: Callable[[list[Value]], Value]) -> None:
    """The right preferences, and the probabilities from the exponential that is made of those of its terms."""
    known = by_number([exact(weight) for weight in given.theta]) | action_features({"s": given.features})
    work.answer({action: work.step(PREFERENCE, s="s", a=action, **known) for action in given.features})
    weights = {action: exponential(_of_terms(given, row)) for action, row in given.features.items()}
    total = sum(weights.values(), ZERO)
    found = work.answer({action: _number(weight / total) for action, weight in weights.items()})
    if given.entropy:
        known["pi"] = {(action, "s"): chance for action, chance in found.items()}
        work.answer(work.step(ENTROPY, s="s", choices=tuple(found), **known))


def _of_terms(given: Given, row: FeatureVector) -> list[Value]:
    """e to the power of every term of a preference that is not 0: k for ln k."""
    logarithms = (weight.of for weight in given.theta if isinstance(weight, Logarithm))
    return [exact(number) ** int(value) for number, value in zip(logarithms, row, strict=True) if value != 0]


def _number(share: Value) -> Value:
    """A share as a number, where no letter is left in it."""
    return share if parameters(share) else simplest(to_sympy(share))


def _of_logarithms(given: Given) -> bool:
    """Whether every exponential is a number or a power of a letter."""
    whole = all(Fraction(value).denominator == 1 for row in given.features.values() for value in row)
    return whole and given.odds is None and all(isinstance(weight, Logarithm) for weight in given.theta)


def _has_sums(given: Given) -> bool:
    """Whether some preference is a sum of several terms."""
    return _of_logarithms(given) and any(sum(value != 0 for value in row) > 1 for row in given.features.values())


def _has_zeros(given: Given) -> bool:
    """Whether some action has no features, so that its preference is 0."""
    return _of_logarithms(given) and any(not any(row) for row in given.features.values())


@slip("exponentials-added", "e to the power of a sum is a product: exp(x + y) = exp(x) exp(y).", when=_has_sums)
def added(given: Given, work: Work) -> None:
    """The exponentials of the terms of a preference added up."""
    _from_exponentials(given, work, lambda terms: sum(terms, ZERO) if terms else ONE)


@slip(
    "nothing-for-zero",
    "exp(0) = 1: an action with the preference 0 has its share of the probability, too.",
    when=_has_zeros,
)
def nothing(given: Given, work: Work) -> None:
    """No probability for the actions whose preference is 0."""
    _from_exponentials(given, work, lambda terms: reduce(mul, terms) if terms else ZERO)


MISCONCEPTIONS = (NOT_NORMALISED, WITHOUT_EXP, added.where_it_shows(), nothing.where_it_shows())


def oracle(given: Given) -> Answers:
    """A matrix product, then numpy's logarithm of a sum of exponentials; x from two points of a straight line."""
    features = np.array([[at(value) for value in row] for row in given.features.values()])
    theta = np.array([at(weight) for weight in given.theta])
    x: list[float] = []
    if given.odds is not None:
        unknown = np.array([isinstance(weight, Logarithm) and weight.of == "x" for weight in given.theta])
        rows = [list(given.features).index(action) for action in given.odds[:2]]
        lead = features[rows[0]] - features[rows[1]]
        # In logarithms: ln times = (what is known) + lead·ln x.
        logarithm = (np.log(at(given.odds.times)) - lead @ np.where(unknown, 0.0, theta)) / lead[unknown][0]
        theta = np.where(unknown, logarithm, theta)
        x.append(float(np.exp(logarithm)))
    preferences = features @ theta
    logarithms = preferences - np.logaddexp.reduce(preferences)
    likely = np.exp(logarithms)
    if x:
        return (*x, likely)
    return (preferences, likely, *([float(-likely @ logarithms)] if given.entropy else []))
