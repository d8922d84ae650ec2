"""Preferences, then their softmax; the probabilities stay closed forms in e."""

from collections.abc import Callable, Mapping
from typing import Any

import sympy
from sympy import Expr

from rldrill.problems.exact import Logarithm
from rldrill.problems.policy_gradient.softmax_policy import Given, Odds
from rldrill.solutions.exact import Value, exact, parameters, simplest, tidy, to_sympy
from rldrill.solutions.exponentials import rational_function
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.formula.nodes.leaves import leaf
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
from rldrill.solutions.work import Equality, Work


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
        work.answer(work.step(ENTROPY, **known))


def _from_odds(given: Given, odds: Odds, work: Work, known: Mapping[str, Any]) -> None:
    """The quotient of two probabilities has no sum in it, and is linear in x; then everything with this x."""
    pair = odds.action, odds.other
    bound = {**known, "H": {("s", action): work.step(PREFERENCE, a=action, **known) for action in pair}}
    quotient = work.step(SOFTMAX_ODDS, a=odds.action, a1=odds.other, **bound)
    x = work.answer(work.equate("x", rational_function(to_sympy(quotient)), exact(odds.times)))
    theta = [
        sympy.expand_log(to_sympy(exact(weight)).subs(to_sympy(generator("x")), to_sympy(x)), factor=True)
        for weight in given.theta
    ]
    for index, (weight, value) in enumerate(zip(given.theta, theta, strict=True), 1):
        if isinstance(weight, Logarithm) and weight.of == "x":
            work.lines.append(Equality(theta_of(index), (sympy.log(leaf(x), evaluate=False), tidy(value))))
    found = chances(work, {**known, **by_number(theta)}, "s", tuple(given.features))
    work.answer({action: found[action, "s"] for action in given.features})


def _from_exponentials(given: Given, work: Work, exponentials: Callable[[Mapping[str, Any], str], Expr]) -> None:
    """The right preferences, and the probabilities from what each action is said to be e to the power of."""
    known = by_number([exact(weight) for weight in given.theta]) | action_features({"s": given.features})
    preferences = work.answer({action: work.step(PREFERENCE, s="s", a=action, **known) for action in given.features})
    weights = {action: exponentials(known | {"H": preferences}, action) for action in given.features}
    total = sum(weights.values())
    found = work.answer({action: _share(weight, total) for action, weight in weights.items()})
    if given.entropy:
        known["pi"] = {(action, "s"): chance for action, chance in found.items()}
        work.answer(work.step(ENTROPY, s="s", choices=tuple(found), **known))


def _share(weight: Expr, total: Expr) -> Value:
    if not total.free_symbols:
        return simplest(weight / total)
    share = rational_function(weight / total)
    return share if parameters(share) else simplest(to_sympy(share))


def _terms(known: Mapping[str, Any], action: str) -> list[Expr]:
    """The terms of a preference that are not 0."""
    terms = (to_sympy(weight) * to_sympy(known["f"][index, "s", action]) for index, weight in known["theta"].items())
    return [term for term in terms if term != 0]


def _has_sums(given: Given) -> bool:
    """Whether some preference is a sum of several terms."""
    return given.odds is None and any(sum(value != 0 for value in row) > 1 for row in given.features.values())


def _has_zeros(given: Given) -> bool:
    """Whether some action has no features, so that its preference is 0."""
    return given.odds is None and any(not any(row) for row in given.features.values())


@slip("exponentials-added", "e to the power of a sum is a product: exp(x + y) = exp(x) exp(y).", when=_has_sums)
def added(given: Given, work: Work) -> None:
    """The exponentials of the terms of a preference added up."""
    _from_exponentials(
        given,
        work,
        lambda known, action: sum(map(sympy.exp, _terms(known, action))) if _terms(known, action) else sympy.S.One,
    )


@slip(
    "nothing-for-zero",
    "exp(0) = 1: an action with the preference 0 has its share of the probability, too.",
    when=_has_zeros,
)
def nothing(given: Given, work: Work) -> None:
    """No probability for the actions whose preference is 0."""
    _from_exponentials(
        given,
        work,
        lambda known, action: sympy.exp(to_sympy(known["H"][action])) if _terms(known, action) else sympy.S.Zero,
    )


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
