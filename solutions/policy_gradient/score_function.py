"""The probabilities, where weights are given; then each action's features minus the expected ones."""

from collections.abc import Mapping
from typing import Any

from rldrill.problems.policy_gradient.score_function import Component, Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import Value, exact, to_sympy, value_at
from rldrill.solutions.formula.nodes.leaves import put_in_name
from rldrill.solutions.formula.notation import pi
from rldrill.solutions.formula.putting_in import put_in
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.policy_gradient import (
    EXPECTED_ADDED,
    FEATURES_ALIKE,
    FEATURES_ALONE,
    LOG_FORGOTTEN,
    OTHER_SUBTRACTED,
)
from rldrill.solutions.softmax import (
    Chances,
    action_features,
    by_number,
    chances,
    exponentials_added,
    log_gradient,
    score,
)
from rldrill.solutions.work import Equality, Work


def solve(given: Given, work: Work, policy: Chances = chances) -> None:
    """One state, written s."""
    actions = tuple(given.features)
    known = action_features({"s": given.features})
    probabilities: Mapping[str, Value]
    if given.component is not None:
        probabilities = _from_component(given, given.component, work, known)
    elif given.theta is None:
        probabilities = knowns.values(given.policy or {})
    else:
        known |= by_number([exact(weight) for weight in given.theta])
        worked_out = policy(work, known, "s", actions)
        probabilities = work.answer({action: worked_out[action, "s"] for action in actions})
    known["pi"] = {(action, "s"): chance for action, chance in probabilities.items()}
    for action in given.asked:
        work.answer(tuple(score(work, known, "s", action, actions)))


def _from_component(given: Given, component: Component, work: Work, known: Mapping[str, Any]) -> Mapping[str, Value]:
    """The score with p in it: the component that is known is linear in p."""
    opened = {(action, "s"): chance for action, chance in knowns.values(given.policy or {}).items()}
    entries = tuple(score(work, {**known, "pi": opened}, "s", given.action or "", tuple(given.features)))
    work.say(f"The component that belongs to $θ_{{{component.number}}}$ is known:")
    p = work.answer(work.equate("p", entries[component.number - 1], exact(component.value), share=True))
    found = {action: value_at(chance, p) for (action, _), chance in opened.items()}
    for action, chance in found.items():
        in_letters = to_sympy(opened[action, "s"])
        sides = (in_letters, put_in(in_letters, {"p": p}), chance)
        work.lines.append(Equality(pi(put_in_name(action), put_in_name("s")), sides))
    return found


MISCONCEPTIONS = (
    FEATURES_ALONE,
    EXPECTED_ADDED,
    LOG_FORGOTTEN.where_it_shows(),
    FEATURES_ALIKE.where_it_shows(),
    OTHER_SUBTRACTED.where_it_shows(),
    exponentials_added(solve),
)


def oracle(given: Given) -> Answers:
    """The logarithm of the probability, differentiated by a complex step.

    Where only probabilities are given, the logarithms are differentiated at preferences that give them.
    """
    features = np.array([[at(value) for value in row] for row in given.features.values()])
    answers: list[Any] = []
    if given.theta is None:
        chance = np.array([at(number) for number in (given.policy or {}).values()])
        if given.component is not None:
            here = list(given.features).index(given.action or "")
            lead = (features[here] - features[1 - here])[given.component.number - 1]
            own = 1 - at(given.component.value) / lead
            first = tuple((given.policy or {}).values())[here]
            answers.append(own if first == "p" else 1 - own)
            chance = np.array([own, 1 - own] if here == 0 else [1 - own, own])
        with np.errstate(divide="ignore"):
            present = np.log(chance)
        theta = np.zeros(features.shape[1])
    else:
        theta = np.array([at(weight) for weight in given.theta])
        present = np.zeros(len(features))
        preferences = features @ theta
        answers.append(np.exp(preferences - np.logaddexp.reduce(preferences)))
    for action in given.asked:
        answers.append(log_gradient(theta, given.features, action, present))
    return answers
