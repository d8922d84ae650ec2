"""Both targets along a run, each method with its own copy of the table."""

import numpy as np

from rldrill.problems.control.sarsa_versus_q_learning import Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import Value
from rldrill.solutions.formula.formula import Formula, fork
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.control import (
    Q_LEARNING_TARGET,
    Q_LEARNING_TARGET_FORGOT_GAMMA,
    SARSA_TARGET,
    SARSA_TARGET_FORGOT_GAMMA,
    TOWARDS_TARGET,
)
from rldrill.solutions.work import Work

TARGETS_SWAPPED = fork(
    "targets-swapped",
    "It is the other way round: Sarsa's target has the value of the action taken, Q-learning's the greatest value.",
)
UPDATE_FOR_TARGET = fork(
    "update-for-target",
    "The target is what the old value is moved towards; α and the old value come in only when it is moved.",
)
POLICY_SWAPPED = fork(
    "on-and-off-policy-swapped",
    "Sarsa's target uses the action that its own policy takes (on-policy); Q-learning's uses the best action, "
    "whatever its policy does (off-policy).",
)
SAID_BOTH = fork(
    "both-alike",
    "They differ: Sarsa learns the values of the policy that acts, Q-learning those of the greedy policy.",
)
SAID_NEITHER = fork(
    "neither",
    "Every method is the one or the other: Sarsa learns about the policy that acts, Q-learning about the greedy one.",
)
MISCONCEPTIONS = (
    TARGETS_SWAPPED,
    UPDATE_FOR_TARGET,
    SARSA_TARGET_FORGOT_GAMMA,
    Q_LEARNING_TARGET_FORGOT_GAMMA,
    POLICY_SWAPPED,
    SAID_BOTH,
    SAID_NEITHER,
)


def solve(given: Given, work: Work) -> None:
    """The targets of the one method, then of the other; then the word."""
    sarsa, q_learning = SARSA_TARGET, Q_LEARNING_TARGET
    if work.makes(TARGETS_SWAPPED):
        sarsa, q_learning = q_learning, sarsa
    for formula in (sarsa, q_learning):
        targets = _targets(given, work, formula)
        work.answer(targets[0] if len(targets) == 1 else targets)
    right, wrong = ("A", "B") if given.word == "on-policy" else ("B", "A")
    said = {POLICY_SWAPPED: wrong, SAID_BOTH: "C", SAID_NEITHER: "D"}
    work.say(
        "Sarsa's targets use the actions that were taken, so it learns about the policy that acts: it is on-policy. "
        "Q-learning's use the best actions, so it learns about the greedy policy: it is off-policy."
    )
    work.answer(next((letter for mistake, letter in said.items() if work.makes(mistake)), right))


def _targets(given: Given, work: Work, formula: Formula) -> tuple[Value, ...]:
    """The target of every transition; the table is moved in between, but not after the last."""
    known = knowns.action_run(given)
    run = given.trajectory
    found = []
    for time, pair in enumerate(zip(run.states[:-1], run.actions, strict=False)):
        target = work.step(formula, t=time, **known)
        if work.makes(UPDATE_FOR_TARGET) or time + 1 < len(run.rewards):
            known["Q"] = known["Q"] | {pair: work.step(TOWARDS_TARGET, t=time, y={time: target}, **known)}
        found.append(known["Q"][pair] if work.makes(UPDATE_FOR_TARGET) else target)
    return tuple(found)


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
    return [*answers, "A" if given.word == "on-policy" else "B"]
