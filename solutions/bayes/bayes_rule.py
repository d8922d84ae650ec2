"""Bayes' rule once for every measurement; each posterior is the next prior."""

from typing import Any

import numpy as np

from rldrill.problems.bayes.bayes_rule import Given
from rldrill.solutions import knowns
from rldrill.solutions.beliefs import before_and_after
from rldrill.solutions.exact import Value
from rldrill.solutions.formula.nodes.sets import LONG
from rldrill.solutions.oracle import Answers, at
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
        work.recall(BAYES_TWO_STATES)
    for reading in given.measurements:
        known: dict[str, Any] = {
            "z": reading,
            "p": belief,
            "likelihood": likelihood,
            "hypotheses": hypotheses,
        }
        after = _posterior(work, known)
        work.picture(*before_and_after(belief, after))
        belief = work.answer(after)


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
    joint = np.array([at(chance) for chance in given.prior.values()])
    answers = []
    for reading in given.measurements:
        joint = joint * [at(given.likelihood[reading][hypothesis]) for hypothesis in given.prior]
        answers.append(joint / joint.sum())
    return answers
