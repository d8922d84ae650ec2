"""Both targets along a run, each method with its own copy of the table; or the step size from one, then the others."""

from collections.abc import Callable, Sequence
from typing import Any

from rldrill.problems.control.sarsa_versus_q_learning import (
    METHODS,
    Given,
    Other,
    comes_back,
    first_that_reads_again,
    method,
)
from rldrill.problems.document import joined
from rldrill.problems.exact import needed, shown
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.solutions import knowns
from rldrill.solutions.exact import Value, exact, told
from rldrill.solutions.formula.formula import Formula, slip
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.control import (
    Q_LEARNING_TARGET,
    Q_LEARNING_TARGET_FORGOT_GAMMA,
    SARSA_TARGET,
    SARSA_TARGET_FORGOT_GAMMA,
    TOWARDS_TARGET,
)
from rldrill.solutions.work import Step, Work

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


def _asks_for_targets(given: Given) -> bool:
    return given.known is None


def _states_the_step_size(given: Given) -> bool:
    return _asks_for_targets(given) and comes_back(given.trajectory)


def _asks_back(given: Given) -> bool:
    return given.known is not None


def _of_policies(given: Given) -> bool:
    return given.instead is None and given.word in ("on-policy", "off-policy")


def solve(given: Given, work: Work) -> None:
    """The targets of the one method, or the step size from one of them; the targets of the other; then the word."""
    _compare(given, work)


def _targets(given: Given, work: Work, formula: Formula) -> tuple[Value, ...]:
    return tuple(target for _, target in _along(given, work, formula))


def _along(
    given: Given, work: Work, formula: Formula, alpha: Value | None = None, steps: int | None = None
) -> list[tuple[dict[str, Any], Value]]:
    """What is known at every transition, and the target; of the table is moved what a later target may read.

    Args:
        given: the run.
        work: where the steps are written.
        formula: the target of the method.
        alpha: the step size, where the run leaves it open.
        steps: after how many transitions it is enough, if not after all.
    """
    known = knowns.action_run(given) | ({} if alpha is None else {"alpha": alpha})
    run = given.trajectory
    moves = [*zip(run.states[:-2], run.actions, strict=False)][: steps and steps - 1]
    read = [time for time, (state, _) in enumerate(moves) if state in run.states[time + 2 :]]
    if moves and (read or steps is None):
        work.say(_updates_needed(read, every=steps is None))
    found = [(known, work.step(formula, t=0, **known))]
    for time, pair in enumerate(moves):
        if time in read:
            known = known | {"Q": known["Q"] | {pair: _moved(work, time, *found[-1])}}
        found.append((known, work.step(formula, t=time + 1, **known)))
    return found


def _updates_needed(times: Sequence[int], *, every: bool) -> str:
    """Which updates are written: those of states that are entered later on, in every target or in those needed here."""
    if not times:
        return "No state that is updated is entered later on, so all targets read the table as it was before the run."
    at = joined([f"$t = {time}$" for time in times])
    which = f"update at {at} is" if len(times) == 1 else f"updates at {at} are"
    targets = "target" if every else "target that is needed here"
    return f"Only the {which} written: no {targets} reads what any other update changes."


def _moved(work: Work, time: int, known: dict[str, Any], target: Value) -> Value:
    return work.step(TOWARDS_TARGET, t=time, y={time: target}, **known)


def _compare(
    given: Given,
    work: Work,
    letter: str | None = None,
    formulas: tuple[Formula, ...] = (SARSA_TARGET, Q_LEARNING_TARGET),
    numbers: Callable[[Given, Work, Formula], tuple[Value, ...]] = _targets,
) -> None:
    """The numbers that the formula of each method leads to; then the letter, where it is not the right one."""
    sarsa, q_learning = formulas
    alpha = None
    if given.known is None:
        for formula in formulas:
            found = numbers(given, work, formula)
            work.answer(found[0] if len(found) == 1 else found)
    else:
        alpha = _step_size(given, work, sarsa)
        work.answer(tuple(target for _, target in _along(given, work, q_learning, alpha)))
    _name(given, work, alpha, letter)


def _name(given: Given, work: Work, alpha: Value | None, letter: str | None = None) -> None:
    """The last answer: by the word, or by what the targets would be with the other value."""
    if given.instead is None:
        work.say(_WHY[given.word])
        work.answer(letter or _LETTERS[given.word])
        return
    other = given.model_copy(update={"values": given.changed})
    changes = [_change(given, other, work, formula, alpha) for formula in (SARSA_TARGET, Q_LEARNING_TARGET)]
    letter = method(sarsa=changes[0], q_learning=changes[1])
    work.say(f"So the answer is: {METHODS[letter]}.")
    work.answer(letter)


def _change(given: Given, other: Given, work: Work, formula: Formula, alpha: Value | None) -> bool:
    """Whether a target of a method changes with the other value; the first that does is told."""
    name, why = (
        ("Sarsa", "none of them takes the value of this action")
        if formula is SARSA_TARGET
        else ("Q-learning", f"in none of them is this value {_greater(given, needed(given.instead))}")
    )
    steps = []
    for run in (given, other):
        spare = Work()
        _along(run, spare, formula, alpha)
        steps.append([line for line in spare.lines if isinstance(line, Step)])
    moved: list[Step] = []
    for old, new in zip(*steps, strict=True):
        if old.value == new.value:
            continue
        if new.formula is formula:
            work.say(f"{name}'s target $y_{{{new.known['t']}}}$ would not be ${told(old.value)}$, but")
            work.lines += [*moved, new]
            return True
        moved.append(new)
    work.say(f"{name}'s targets would stay the same: {why}.")
    return False


def _greater(given: Given, other: Other) -> str:
    """What a value is not, neither as it is nor as it might be, if the greatest in its state stays what it is."""
    row = given.values[other.state]
    most = max((value for action, value in row.items() if action != other.action), default=None)
    return "greater than all others" if most in (row[other.action], other.value) else "the greatest"


def _step_size(given: Given, work: Work, formula: Formula) -> Value:
    """The step size, from the first target that reads a value that it has moved."""
    time = first_that_reads_again(given.trajectory) or 0
    *_, (_, target) = _along(given, work, formula, steps=time + 1)
    work.say(f"$y_{{{time}}}$ is known to be ${shown(needed(given.known))}$:")
    alpha: Value = work.answer(work.equate("alpha", target, exact(needed(given.known))))
    return alpha


@slip(
    "targets-swapped",
    "It is the other way round: Sarsa's target has the value of the action taken, Q-learning's the greatest value.",
    when=_asks_for_targets,
)
def targets_swapped(given: Given, work: Work) -> None:
    """The targets of the other method."""
    _compare(given, work, formulas=(Q_LEARNING_TARGET, SARSA_TARGET))


def _updates(given: Given, work: Work, formula: Formula) -> tuple[Value, ...]:
    return tuple(_moved(work, time, *found) for time, found in enumerate(_along(given, work, formula)))


@slip(
    "update-for-target",
    "The target is what the old value is moved towards; α and the old value come in only when it is moved.",
    when=_states_the_step_size,
)
def update_for_target(given: Given, work: Work) -> None:
    """The values that were moved towards the targets."""
    _compare(given, work, numbers=_updates)


def _errors(given: Given, work: Work, formula: Formula) -> tuple[Value, ...]:
    run = given.trajectory
    pairs = zip(run.states, run.actions, strict=False)
    return tuple(
        target - known["Q"][pair] for pair, (known, target) in zip(pairs, _along(given, work, formula), strict=False)
    )


@slip(
    "td-error-for-target",
    "That is the TD error: the target is what stands before the old value is subtracted from it.",
    when=_asks_for_targets,
)
def error_for_target(given: Given, work: Work) -> None:
    """How far the values are from the targets."""
    _compare(given, work, numbers=_errors)


@slip(
    "one-table-for-both",
    "Each method has a copy of the table of its own: Q-learning goes on from the values that it has moved itself.",
    when=_states_the_step_size,
)
def one_table(given: Given, work: Work) -> None:
    """Q-learning's targets are read from the table that Sarsa moves."""
    sarsa = _along(given, work, SARSA_TARGET)
    work.answer(tuple(target for _, target in sarsa))
    times = enumerate(known for known, _ in sarsa)
    work.answer(tuple(work.step(Q_LEARNING_TARGET, t=time, **known) for time, known in times))
    _name(given, work, None)


@slip(
    "old-table-of-q-learning",
    "Q-learning moves its table after every transition, and its later targets read the values that it has moved.",
    when=_asks_back,
)
def old_table(given: Given, work: Work) -> None:
    """Q-learning's targets are all read from the table before the run."""
    alpha = _step_size(given, work, SARSA_TARGET)
    known = knowns.action_run(given)
    times = range(len(given.trajectory.rewards))
    work.answer(tuple(work.step(Q_LEARNING_TARGET, t=time, **known) for time in times))
    _name(given, work, alpha)


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
    error_for_target.where_it_shows(),
    one_table.where_it_shows(),
    old_table,
    SARSA_TARGET_FORGOT_GAMMA,
    Q_LEARNING_TARGET_FORGOT_GAMMA,
    policy_swapped,
    said_both,
    said_neither,
)


def oracle(given: Given) -> Answers:
    """Each method as a policy of the next action; the step size from two trials, for the target is linear in it."""
    if given.known is None:
        letter = _by_oracle(given)
        return [_tried(given, greedy=False), _tried(given, greedy=True), letter]
    place = first_that_reads_again(given.trajectory) or 0
    low, high = (_tried(_with(given, fraction_of(trial)), greedy=False)[place] for trial in ("1/4", "3/4"))
    alpha = 1 / 4 + (at(given.known) - low) / (high - low) / 2
    solved = _with(given, Fraction(alpha).limit_denominator(10**6))
    return [alpha, _tried(solved, greedy=True), _by_oracle(solved)]


def _by_oracle(given: Given) -> str:
    """The letter of the word; or that of the methods whose targets move with the other value."""
    if given.instead is None:
        letters = {"on": "A", "off": "B", "model-free": "C", "boot": "C"}
        return next((letter for word, letter in letters.items() if given.word.startswith(word)), "D")
    other = given.model_copy(update={"values": given.changed})
    moved = [not np.allclose(_tried(given, greedy=way), _tried(other, greedy=way)) for way in (False, True)]
    return {(True, False): "A", (False, True): "B", (True, True): "C", (False, False): "D"}[moved[0], moved[1]]


def _with(given: Given, alpha: Fraction) -> Given:
    return given.model_copy(update={"alpha": alpha, "known": None})


def _tried(given: Given, *, greedy: bool) -> Array:
    """The targets with the next action that was taken, or with the one at the top of the sorted row."""
    run = given.trajectory
    rows = {state: {action: at(value) for action, value in row.items()} for state, row in given.values.items()}
    targets = np.array([at(reward) for reward in run.rewards])
    for time, (state, after) in enumerate(zip(run.states, run.states[1:], strict=False)):
        if after not in run.terminal:
            chosen = sorted(rows[after], key=rows[after].__getitem__)[-1] if greedy else run.actions[time + 1]
            targets[time] += at(given.gamma) * rows[after][chosen]
        old = rows[state][run.actions[time]]
        rows[state][run.actions[time]] = (1 - at(given.alpha)) * old + at(given.alpha) * targets[time]
    return targets
