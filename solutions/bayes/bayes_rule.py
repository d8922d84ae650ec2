"""Bayes' rule once for every measurement; each posterior is the next prior."""

from typing import Any

from rldrill.problems.bayes.bayes_rule import Given
from rldrill.problems.exact import Parameter, shown
from rldrill.solutions import knowns
from rldrill.solutions.beliefs import before_and_after, number, root, stated
from rldrill.solutions.exact import Value, equals, exact
from rldrill.solutions.formula.nodes.sets import LONG
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import OPEN, Answers, at
from rldrill.solutions.sheet.bayes import (
    BASE_RATE_IGNORED,
    BAYES,
    BAYES_BY_READING,
    BAYES_TWO_STATES,
    LIKELIHOOD_FOR_POSTERIOR,
    NOT_NORMALISED,
    SUM_OF_JOINT,
    p,
)
from rldrill.solutions.work import Work

MISCONCEPTIONS = (NOT_NORMALISED, BASE_RATE_IGNORED, LIKELIHOOD_FOR_POSTERIOR)


def solve(given: Given, work: Work) -> None:
    """The posterior of every hypothesis, measurement by measurement."""
    likelihood = knowns.likelihood(given.likelihood)
    hypotheses = tuple(given.prior)
    belief = knowns.values(given.prior)
    if len(hypotheses) == 2:
        work.recall(BAYES)
        work.say("For two hypotheses, $h_1$ and $h_2$, this is:")
        work.recall(BAYES_TWO_STATES)
    readings = list(enumerate(given.measurements, 1))
    labels = {place: f'"measurement" {place}' if len(readings) > 1 else None for place, _ in readings}
    if given.outcome is not None:
        state, letter = given.outcome.state, given.left_open[0]
        known: dict[str, Any] = {"z": given.measurements[0], "hypotheses": hypotheses, "label": labels[1]}
        after = work.step(BAYES, h=state, p=belief, likelihood=likelihood, **known)
        work.say(f"This must be ${shown(given.outcome.probability)}$:")
        found = work.answer(work.equate(letter, after, exact(given.outcome.probability), share=True))
        belief, likelihood = knowns.settled(belief, found), knowns.settled(likelihood, found)
        if len(readings) > 1:
            belief = _first(given, work, letter, {**known, "p": belief, "likelihood": likelihood})
        readings = readings[1:]
    for place, reading in readings:
        if place > 1:
            work.say(f"For the next measurement, {reading}, $p(h)$ is the belief that was found:")
        now = {"z": reading, "p": belief, "likelihood": likelihood, "hypotheses": hypotheses, "label": labels[place]}
        posterior = _posterior(work, now)
        work.picture(before_and_after, belief, posterior)
        belief = work.answer(posterior)


def _first(given: Given, work: Work, letter: str, known: dict[str, Any]) -> dict[str, Value]:
    """The belief after the first measurement; of two hypotheses it is known with the one probability."""
    hypotheses, outcome = known["hypotheses"], given.outcome
    if len(hypotheses) != 2 or outcome is None or outcome.state not in hypotheses:
        work.say(f"With this ${shown(Parameter(letter))}$ the first measurement gives:")
        return _posterior(work, known)
    belief = stated(outcome, hypotheses)
    (other,) = (name for name in hypotheses if name != outcome.state)
    work.say(
        f'After the first measurement $p("{outcome.state}") {equals(belief[outcome.state])}$, '
        f'so $p("{other}") {equals(belief[other])}$.'
    )
    return work.either(belief, lambda: _posterior(work, known))


def _posterior(work: Work, known: dict[str, Any]) -> dict[str, Value]:
    """Hypothesis by hypothesis; where there are many, what stands below the line is worked out once."""
    hypotheses, z = known["hypotheses"], known["z"]
    if len(hypotheses) <= LONG or z in hypotheses or work.misreads(BAYES):
        return {h: work.step(BAYES, h=h, **known) for h in hypotheses}
    work.reading(BAYES)  # it is read, though written with p(z) here: so its misreadings can be made
    below = work.step(BAYES, into=lambda _, z: p(z), right=SUM_OF_JOINT, **known)
    known = known | {"p": known["p"] | {z: below}}
    return {h: work.step(BAYES, right=BAYES_BY_READING, h=h, **known) for h in hypotheses}


def oracle(given: Given) -> Answers:
    """The joint probability of hypothesis and all readings so far, one column normalised."""
    if given.outcome is None:
        return _posteriors(given, float(OPEN))
    place, share = list(given.prior).index(given.outcome.state), at(given.outcome.probability)
    q = root(lambda q: _posteriors(given, q)[0][place] - share)
    return [q, *_posteriors(given, q)[1:]]


def _posteriors(given: Given, q: float) -> list[Array]:
    joint = np.array([number(chance, q) for chance in given.prior.values()])
    answers = []
    for reading in given.measurements:
        joint = joint * [number(given.likelihood[reading][hypothesis], q) for hypothesis in given.prior]
        answers.append(joint / joint.sum())
    return answers
