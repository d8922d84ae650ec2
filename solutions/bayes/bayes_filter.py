"""Prediction and Bayes' rule in turn: the action first, then the measurement after it."""

from typing import Any

import numpy as np

from rldrill.problems.bayes.bayes_filter import Event, Given
from rldrill.solutions import knowns
from rldrill.solutions.beliefs import before_and_after
from rldrill.solutions.formula.formula import fork
from rldrill.solutions.oracle import Answers, at, motion_array
from rldrill.solutions.sheet.bayes import BAYES, PREDICT
from rldrill.solutions.work import Work

ORDER_SWAPPED = fork(
    "order-swapped",
    "The measurement comes after the action: predict first, then weigh the predicted belief with the likelihood.",
    when=lambda given: any(event.action and event.measurement for event in given.run),
)
PRIOR_AGAIN = fork(
    "prior-again",
    "Every step goes on from the belief of the step before it, not from the first belief.",
    when=lambda given: len(given.run) > 1,
)
MISCONCEPTIONS = (ORDER_SWAPPED, PRIOR_AGAIN)


def solve(given: Given, work: Work) -> None:
    """The belief after every step of the run."""
    states = tuple(given.belief)
    start = knowns.values(given.belief)
    known = {
        "motion": knowns.motion(given.motion),
        "likelihood": knowns.likelihood(given.likelihood),
        "states": states,
        "hypotheses": states,
    }
    belief = start
    for event in given.run:
        if work.makes(PRIOR_AGAIN):
            belief = start
        before = belief
        moves = (_weighed, _moved) if work.makes(ORDER_SWAPPED) else (_moved, _weighed)
        for move in moves:
            belief = move(work, event, belief, known)
        work.picture(*before_and_after(before, belief))
        belief = work.answer(belief)


def _moved(work: Work, event: Event, belief: dict[str, Any], known: dict[str, Any]) -> dict[str, Any]:
    if event.action is None:
        return belief
    return {state: work.step(PREDICT, s1=state, a=event.action, p=belief, **known) for state in known["states"]}


def _weighed(work: Work, event: Event, belief: dict[str, Any], known: dict[str, Any]) -> dict[str, Any]:
    if event.measurement is None:
        return belief
    return {state: work.step(BAYES, h=state, z=event.measurement, p=belief, **known) for state in known["states"]}


def oracle(given: Given) -> Answers:
    """The joint distribution of all states ever, conditioned on all readings, summed to the last state."""
    states = tuple(given.belief)
    joint = np.array([at(chance) for chance in given.belief.values()])
    answers = []
    for event in given.run:
        if event.action is not None:
            joint = joint[..., None] * motion_array(given.motion, event.action, states)
        if event.measurement is not None:
            joint = joint * np.array([at(given.likelihood[event.measurement][state]) for state in states])
        last = joint.reshape(-1, len(states)).sum(axis=0)
        answers.append(last / last.sum())
    return answers
