"""Prediction and Bayes' rule in turn: the action first, then the measurement after it."""

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from rldrill.problems.bayes.bayes_filter import Event, Given
from rldrill.solutions import knowns
from rldrill.solutions.beliefs import before_and_after
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.oracle import Answers, at, motion_array
from rldrill.solutions.sheet.bayes import BAYES, PREDICT
from rldrill.solutions.work import Work

Move: TypeAlias = Callable[[Work, Event, dict[str, Any], dict[str, Any]], dict[str, Any]]


def solve(given: Given, work: Work) -> None:
    """The belief after every step of the run."""
    _filter(given, work, (_moved, _weighed))


def _filter(given: Given, work: Work, moves: tuple[Move, ...], *, afresh: bool = False) -> None:
    """Make these moves in every step; ``afresh`` begins each step with the first belief again."""
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
        before = belief = start if afresh else belief
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


@slip(
    "order-swapped",
    "The measurement comes after the action: predict first, then weigh the predicted belief with the likelihood.",
    when=lambda given: any(event.action and event.measurement for event in given.run),
)
def order_swapped(given: Given, work: Work) -> None:
    """The measurement of every step before its action."""
    _filter(given, work, (_weighed, _moved))


@slip(
    "prior-again",
    "Every step goes on from the belief of the step before it, not from the first belief.",
    when=lambda given: len(given.run) > 1,
)
def prior_again(given: Given, work: Work) -> None:
    """Every step from the first belief."""
    _filter(given, work, (_moved, _weighed), afresh=True)


MISCONCEPTIONS = (order_swapped, prior_again)


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
