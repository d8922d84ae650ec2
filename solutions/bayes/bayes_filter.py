"""Prediction and Bayes' rule in turn: the action first, then the measurement after it."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, TypeAlias

from rldrill.problems.bayes.bayes_filter import Event, Given
from rldrill.problems.exact import Parameter, shown
from rldrill.problems.fractions import Fraction
from rldrill.solutions import knowns
from rldrill.solutions.beliefs import before_and_after, number, root, stated
from rldrill.solutions.exact import equals, exact, told
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.bayes import (
    BELIEF_NOT_NORMALISED,
    CORRECTION,
    PREDICT,
    PREDICTION,
    PREDICTION_IGNORED,
    READING,
)
from rldrill.solutions.work import Note, Work

Belief: TypeAlias = dict[str, Any]
Move: TypeAlias = Callable[[Work, Event, Belief, dict[str, Any]], Belief]
#: What the next step begins with: by the step, the belief before it and after it, and what is known.
Onward: TypeAlias = Callable[[Work, Event, Belief, Belief, dict[str, Any]], Belief]


def solve(given: Given, work: Work) -> None:
    """The belief after every step of the run; before that, the probability that is unknown."""
    _filter(given, work, (_moved, _weighed))


def _after(_work: Work, _event: Event, _before: Belief, after: Belief, _known: dict[str, Any]) -> Belief:
    return after


def _filter(given: Given, work: Work, moves: tuple[Move, ...], onward: Onward = _after) -> None:
    """Make these moves in every step; each begins with the belief after the one before it."""
    states = tuple(given.belief)
    start = knowns.values(given.belief)
    known: dict[str, Any] = {
        "motion": knowns.motion(given.motion),
        "likelihood": knowns.likelihood(given.likelihood),
        "states": states,
    }
    settled: Belief = {}
    if given.outcome is not None:
        state, share = given.outcome.state, exact(given.outcome.probability)
        weighed = (state,) if moves[-1] is _weighed else states
        first = known | {"weighed": weighed} | ({"label": '"step" 1'} if len(given.run) > 1 else {})
        belief = _moves(given.run[0], work, moves, start, first)
        work.say(f'$p("{state}")$ must be ${told(share)}$:')
        value = work.answer(work.equate(given.left_open[0], belief[state], share, share=True))
        if len(states) == 2:
            (other,) = (name for name in states if name != state)
            settled = stated(given.outcome, states)
            work.say(
                f"After the first step $p({state}) {equals(share)}$, so that $p({other}) {equals(settled[other])}$."
            )
        else:
            work.say(f"With this ${shown(Parameter(given.left_open[0]))}$ the first step is:")
        start = knowns.settled(start, value)
        known |= {name: knowns.settled(known[name], value) for name in ("motion", "likelihood")}
    belief = start
    for step, event in enumerate(given.run, 1):
        asked = step > 1 or given.outcome is None
        if step > 1:
            work.say("In the next step $p$ is the belief that was found.")
        now = known | ({"label": f'"step" {step}'} if len(given.run) > 1 else {})
        moved = partial(_moves, event, work, moves, belief, now)
        after = settled if not asked else {}
        after = work.either(after, moved) if after else moved()
        if asked:
            work.picture(before_and_after, belief, after)
            after = work.answer(after)
        belief = onward(work, event, belief, after, now)
    if given.ahead is not None:
        work.say("In the next step $p$ is the belief that was found.")
        _told(work, given.ahead)
        if _moved in moves:
            belief = _moved(work, given.ahead, belief, known)
        if given.ahead.action is None:
            work.say("There is no action, so $p̄ = p$.")
        work.answer(work.step(READING, z=given.ahead.measurement, p_bar=belief, **known))


def _moves(event: Event, work: Work, moves: tuple[Move, ...], belief: Belief, known: dict[str, Any]) -> Belief:
    _told(work, event)
    for move in moves:
        belief = move(work, event, belief, known)
    return belief


def _told(work: Work, event: Event) -> None:
    """Say once what the letter with the bar stands for."""
    note = Note("$p̄$ is the belief after the action and before the measurement.")
    if event.measurement is not None and note not in work.lines:
        work.lines.append(note)


def _moved(work: Work, event: Event, belief: Belief, known: dict[str, Any]) -> Belief:
    if event.action is None:
        return belief
    formula = PREDICT if event.measurement is None else PREDICTION
    return {state: work.step(formula, s1=state, a=event.action, p=belief, **known) for state in known["states"]}


def _weighed(work: Work, event: Event, belief: Belief, known: dict[str, Any]) -> Belief:
    if event.measurement is None:
        return belief
    if event.action is None:
        work.say("There is no action, so $p̄ = p$.")
    weighed = known.get("weighed", known["states"])
    return {state: work.step(CORRECTION, s=state, z=event.measurement, p_bar=belief, **known) for state in weighed}


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
    "Every step goes on from the belief of the step before it, not from the initial belief.",
    when=lambda given: len(given.run) > 1 or given.ahead is not None,
)
def prior_again(given: Given, work: Work) -> None:
    """Every step from the first belief."""
    _filter(given, work, (_moved, _weighed), lambda _work, _event, before, _after, _known: before)


@slip(
    "measurement-forgotten-after",
    "Every step goes on from the belief after the measurement before it, not from the prediction.",
    when=lambda given: any(event.measurement for event in _before_others(given)),
)
def unweighed(given: Given, work: Work) -> None:
    """Every step from the prediction of the step before."""
    _filter(given, work, (_moved, _weighed), lambda work, event, before, _, known: _moved(work, event, before, known))


def _before_others(given: Given) -> Sequence[Event]:
    """The steps that another one follows."""
    return given.run if given.ahead is not None else given.run[:-1]


@slip(
    "motion-skipped",
    "An action moves the belief, too: first sum over the states that the robot may come from.",
)
def motion_skipped(given: Given, work: Work) -> None:
    """The measurement of every step alone, the step ahead among them."""
    _filter(given, work, (_weighed,))


MISCONCEPTIONS = (
    order_swapped,
    prior_again,
    unweighed.where_it_shows(),
    *(each.where_it_shows() for each in (motion_skipped, BELIEF_NOT_NORMALISED, PREDICTION_IGNORED)),
)


def oracle(given: Given) -> Answers:
    """The joint distribution of all states ever, conditioned on all readings, summed to the last state."""
    q = 0.0 if given.outcome is None else root(lambda q: _share(given, q))
    beliefs = _joint(given, given.run, q)
    answers = beliefs if given.outcome is None else [q, *beliefs[1:]]
    if given.ahead is not None:
        unmeasured = [*given.run, *([Event(action=given.ahead.action)] if given.ahead.action else [])]
        reading = given.likelihood[given.ahead.measurement or ""]
        answers.append(_joint(given, unmeasured, q)[-1] @ [number(reading[state], q) for state in given.belief])
    return answers


def _share(given: Given, q: float) -> float:
    """By how much the known probability after the first step is missed, if the unknown one is q."""
    assert given.outcome is not None
    first = _joint(given, given.run[:1], q)[0]
    return float(first[list(given.belief).index(given.outcome.state)] - at(given.outcome.probability))


def _joint(given: Given, run: Sequence[Event], q: float) -> list[Any]:
    states = tuple(given.belief)
    joint = np.array([number(chance, q) for chance in given.belief.values()])
    answers = []
    for event in run:
        if event.action is not None:
            rows = given.motion[event.action]
            joint = joint[..., None] * np.array(
                [[number(rows[s].get(t, Fraction(0)), q) for t in states] for s in states]
            )
        if event.measurement is not None:
            joint = joint * np.array([number(given.likelihood[event.measurement][state], q) for state in states])
        last = joint.reshape(-1, len(states)).sum(axis=0)
        answers.append(last / last.sum())
    return answers
