"""Both targets along a run, each method with its own copy of the table."""

from collections.abc import Callable
from typing import Any

from rldrill.problems.control.sarsa_versus_q_learning import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import Value
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.control import (
    Q_LEARNING_TARGET,
    Q_LEARNING_TARGET_FORGOT_GAMMA,
    SARSA_TARGET,
    SARSA_TARGET_FORGOT_GAMMA,
    TOWARDS_TARGET,
)
from rldrill.solutions.work import Work

#: The letter of the method that is meant by a word.
_LETTERS = {
    "on-policy": "A", "off-policy": "B", "model-free": "C", "bootstrapping": "C", "model-based": "D",
    "a Monte Carlo method": "D",
}  # fmt: skip

_POLICY = (
    "Sarsa's targets use the actions that were taken, so it learns about the policy that acts: it is on-policy. "
    "Q-learning's use the best actions, so it learns about the greedy policy: it is off-policy."
)
_MODEL = (
    "Both learn from the transitions that were seen and know no probabilities: they are model-free, not model-based."
)
_ESTIMATES = (
    "Both targets have a current action value in them, so they learn after every transition: both bootstrap, and "
    "neither is a Monte Carlo method."
)
#: The conclusion for each word.
_WHY = {
    "on-policy": _POLICY, "off-policy": _POLICY, "model-free": _MODEL, "model-based": _MODEL,
    "bootstrapping": _ESTIMATES, "a Monte Carlo method": _ESTIMATES,
}  # fmt: skip


def _of_policies(given: Given) -> bool:
    return given.word in ("on-policy", "off-policy")


def solve(given: Given, work: Work) -> None:
    """The targets of the one method, then of the other; then the word."""
    _compare(given, work, _LETTERS[given.word])


def _targets(given: Given, work: Work, formula: Formula) -> tuple[Value, ...]:
    return tuple(target for _, target in _along(given, work, formula))


def _along(given: Given, work: Work, formula: Formula) -> list[tuple[dict[str, Any], Value]]:
    """What is known at every transition, and the target; of the table is moved what a later target may read."""
    known = knowns.action_run(given)
    run = given.trajectory
    found = [(known, work.step(formula, t=0, **known))]
    for time, pair in enumerate(zip(run.states[:-2], run.actions, strict=False)):
        if pair[0] in run.states[time + 2 :]:
            known = known | {"Q": known["Q"] | {pair: _moved(work, time, *found[-1])}}
        found.append((known, work.step(formula, t=time + 1, **known)))
    return found


def _moved(work: Work, time: int, known: dict[str, Any], target: Value) -> Value:
    return work.step(TOWARDS_TARGET, t=time, y={time: target}, **known)


def _compare(
    given: Given,
    work: Work,
    letter: str,
    formulas: tuple[Formula, ...] = (SARSA_TARGET, Q_LEARNING_TARGET),
    numbers: Callable[[Given, Work, Formula], tuple[Value, ...]] = _targets,
) -> None:
    """The numbers that the formula of each method leads to, and the letter of the method that the word means."""
    for formula in formulas:
        found = numbers(given, work, formula)
        work.answer(found[0] if len(found) == 1 else found)
    work.say(_WHY[given.word])
    work.answer(letter)


@slip(
    "targets-swapped",
    "It is the other way round: Sarsa's target has the value of the action taken, Q-learning's the greatest value.",
)
def targets_swapped(given: Given, work: Work) -> None:
    """The targets of the other method."""
    _compare(given, work, _LETTERS[given.word], formulas=(Q_LEARNING_TARGET, SARSA_TARGET))


def _updates(given: Given, work: Work, formula: Formula) -> tuple[Value, ...]:
    return tuple(_moved(work, time, *found) for time, found in enumerate(_along(given, work, formula)))


@slip(
    "update-for-target",
    "The target is what the old value is moved towards; α and the old value come in only when it is moved.",
)
def update_for_target(given: Given, work: Work) -> None:
    """The values that were moved towards the targets."""
    _compare(given, work, _LETTERS[given.word], numbers=_updates)


@slip(
    "on-and-off-policy-swapped",
    "Sarsa's target uses the action that its own policy takes (on-policy); Q-learning's uses the best action, "
    "whatever its policy does (off-policy).",
    when=_of_policies,
)
def policy_swapped(given: Given, work: Work) -> None:
    """The letter of the other method."""
    solve(given.model_copy(update={"word": "off-policy" if given.word == "on-policy" else "on-policy"}), work)


@slip(
    "both-alike",
    "They differ: Sarsa learns the values of the policy that acts, Q-learning those of the greedy policy.",
    when=_of_policies,
)
def said_both(given: Given, work: Work) -> None:
    """The letter that stands for both."""
    _compare(given, work, "C")


@slip(
    "neither",
    "Every method is the one or the other: Sarsa learns about the policy that acts, Q-learning about the greedy one.",
    when=_of_policies,
)
def said_neither(given: Given, work: Work) -> None:
    """The letter that stands for neither."""
    _compare(given, work, "D")


MISCONCEPTIONS = (
    targets_swapped,
    update_for_target,
    SARSA_TARGET_FORGOT_GAMMA,
    Q_LEARNING_TARGET_FORGOT_GAMMA,
    policy_swapped,
    said_both,
    said_neither,
)


def oracle(given: Given) -> Answers:
    """Each method as a policy of the next action: the one taken, or the one at the top of the sorted row."""
    answers: list[object] = []
    run = given.trajectory
    for greedy in (False, True):
        rows = {state: {action: at(value) for action, value in row.items()} for state, row in given.values.items()}
        targets = np.array([at(reward) for reward in run.rewards])
        for time, (state, after) in enumerate(zip(run.states, run.states[1:], strict=False)):
            if after not in run.terminal:
                chosen = sorted(rows[after], key=rows[after].__getitem__)[-1] if greedy else run.actions[time + 1]
                targets[time] += at(given.gamma) * rows[after][chosen]
            old = rows[state][run.actions[time]]
            rows[state][run.actions[time]] = (1 - at(given.alpha)) * old + at(given.alpha) * targets[time]
        answers.append(targets)
    letters = {"on": "A", "off": "B", "model-free": "C", "boot": "C"}
    return [*answers, next((letter for word, letter in letters.items() if given.word.startswith(word)), "D")]
