"""The prediction once for every action; each belief is the one that the next action starts from."""

from collections.abc import Mapping
from functools import partial
from typing import Any

from rldrill.problems.bayes.bayes_predict import Given
from rldrill.problems.exact import Parameter, shown
from rldrill.solutions import knowns
from rldrill.solutions.beliefs import before_and_after, number, root, stated
from rldrill.solutions.exact import equals, exact
from rldrill.solutions.found import put_in_found
from rldrill.solutions.oracle import OPEN, Answers, at
from rldrill.solutions.sheet.bayes import MOTION_AS_LIKELIHOOD, MOTION_TRANSPOSED, PREDICT
from rldrill.solutions.work import Work

MISCONCEPTIONS = (MOTION_TRANSPOSED, MOTION_AS_LIKELIHOOD)


def solve(given: Given, work: Work) -> None:
    """The belief in every state, action by action; where a probability is to be found, the first action gives it."""
    states = tuple(given.belief)
    belief = knowns.values(given.belief)
    motion = knowns.motion(given.motion)
    actions = given.actions
    if given.outcome is not None:
        *earlier, last = actions[: given.after]
        state, letter = given.outcome.state, given.left_open[0]
        q = shown(Parameter(letter))
        moved, before = belief, []
        for place, action in enumerate(earlier, 1):
            work.say(f"The action {action} gives:")
            moved = _moved(work, action, moved, motion, f'"step" {place}')
            before.append(moved)
        if earlier:
            work.say(f"The next action, {last}, gives:")
        label = f'"step" {given.after}' if len(actions) > 1 else None
        there = work.step(PREDICT, s1=state, a=last, p=moved, motion=motion, states=states, label=label)
        work.say(f'$p("{state}")$ must be ${shown(given.outcome.probability)}$:')
        found = work.answer(work.equate(letter, there, exact(given.outcome.probability), share=True))
        belief, motion = knowns.settled(belief, found), knowns.settled(motion, found)
        for then in before:
            work.say(f"With ${q} {equals(found)}$ this is:")
            belief = work.answer(
                {state: put_in_found(work, PREDICT, letter, there, found, s1=state) for state, there in then.items()}
            )
        if len(actions) > given.after:
            work.say(f"With this ${q}$ the {'first' if given.after == 1 else 'next'} action gives:")
            belief = _moved(work, last, belief, motion, label)
            if len(states) == 2:
                belief = work.either(belief, partial(stated, given.outcome, states))
            work.say(f"The next action, {actions[given.after]}, gives:")
    first = 0 if given.outcome is None else given.after
    for place, action in enumerate(actions[first:]):
        if place:
            work.say("In the next step $p(s)$ is the belief that was found:")
        after = _moved(work, action, belief, motion, f'"step" {first + place + 1}' if len(actions) > 1 else None)
        work.picture(before_and_after, belief, after)
        belief = work.answer(after)


def _moved(
    work: Work, action: str, belief: Mapping[str, Any], motion: Mapping[Any, Any], label: str | None = None
) -> dict[str, Any]:
    """The belief after an action, state by state."""
    known = {"a": action, "p": belief, "motion": motion, "states": tuple(belief)}
    return {state: work.step(PREDICT, s1=state, label=label, **known) for state in belief}


def oracle(given: Given) -> Answers:
    """All ways to go, one by one: the probability of each path is added where it ends."""
    if given.outcome is None:
        return _followed(given, float(OPEN))
    place, share = list(given.belief).index(given.outcome.state), at(given.outcome.probability)
    known = given.after - 1  # the belief that is known is no answer
    q = root(lambda q: _followed(given, q)[known][place] - share)
    beliefs = _followed(given, q)
    return [q, *beliefs[:known], *beliefs[known + 1 :]]


def _followed(given: Given, q: float) -> list[list[float]]:
    states = tuple(given.belief)
    paths: dict[tuple[str, ...], float] = {(state,): number(chance, q) for state, chance in given.belief.items()}
    answers = []
    for action in given.actions:
        paths = {
            (*path, after): chance * number(given.motion[action][path[-1]][after], q)
            for path, chance in paths.items()
            for after in given.motion[action][path[-1]]
        }
        answers.append([sum(c for path, c in paths.items() if path[-1] == state) for state in states])
    return answers
