"""The prediction once for every action; each belief is the one that the next action starts from."""

from typing import Any

from rldrill.problems.bayes.bayes_predict import Given
from rldrill.solutions import knowns
from rldrill.solutions.beliefs import before_and_after
from rldrill.solutions.oracle import Answers, at, motion_array
from rldrill.solutions.sheet.bayes import MOTION_AS_LIKELIHOOD, MOTION_TRANSPOSED, PREDICT
from rldrill.solutions.work import Work

MISCONCEPTIONS = (MOTION_TRANSPOSED, MOTION_AS_LIKELIHOOD)


def solve(given: Given, work: Work) -> None:
    """The belief in every state, action by action."""
    states = tuple(given.belief)
    belief = knowns.values(given.belief)
    motion = knowns.motion(given.motion)
    for action in given.actions:
        known: dict[str, Any] = {"a": action, "p": belief, "motion": motion, "states": states}
        after = {state: work.step(PREDICT, s1=state, **known) for state in states}
        work.picture(*before_and_after(belief, after))
        belief = work.answer(after)


def oracle(given: Given) -> Answers:
    """All ways to go, one by one: the probability of each path is added where it ends."""
    states = tuple(given.belief)
    paths: dict[tuple[str, ...], float] = {(state,): at(chance) for state, chance in given.belief.items()}
    answers = []
    for action in given.actions:
        array = motion_array(given.motion, action, states)
        paths = {
            (*path, after): chance * array[states.index(path[-1]), states.index(after)]
            for path, chance in paths.items()
            for after in states
            if array[states.index(path[-1]), states.index(after)]
        }
        answers.append([sum(c for path, c in paths.items() if path[-1] == state) for state in states])
    return answers
