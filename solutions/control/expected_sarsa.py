"""Expected Sarsa along a run: the policy in the next state, then the update, with the values then current."""

from sympy import Add, Mul

from rldrill.problems.control.expected_sarsa import EpsilonGreedy, FixedPolicy, Given
from rldrill.solutions import knowns
from rldrill.solutions.asking_back import answer_along, oracle_along
from rldrill.solutions.exact import ONE, ZERO, Value, exact, parameters, to_sympy
from rldrill.solutions.greedy import best_actions, epsilon_greedy
from rldrill.solutions.multiplied_out import side_by_side
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.control import (
    EXPECTED_FORGOT_GAMMA,
    EXPECTED_SARSA,
    MAX_FOR_EXPECTATION,
    SAMPLE_FOR_EXPECTATION,
    UNWEIGHTED_EXPECTATION,
)
from rldrill.solutions.work import Equality, Work

MISCONCEPTIONS = (MAX_FOR_EXPECTATION, SAMPLE_FOR_EXPECTATION, UNWEIGHTED_EXPECTATION, EXPECTED_FORGOT_GAMMA)


def solve(given: Given, work: Work) -> None:
    """One update for every transition."""
    run = given.trajectory
    known = knowns.action_run(given)
    written: dict[tuple[str, tuple[str, ...]], dict[str, Value]] = {}
    for time, pair in enumerate(zip(run.states[:-1], run.actions, strict=False)):
        after = run.states[time + 1]
        values = {action: known["Q"][after, action] for action in known["actions"][after]}
        chances = _policy(given, work, time, values, written)
        known["pi"] = {(action, after): chance for action, chance in chances.items()}
        if after not in run.terminal:
            _tell_mean(work, after, chances, values)
        known["Q"] = known["Q"] | {pair: work.step(EXPECTED_SARSA, t=time, **known)}
    answer_along(given, work, known["Q"], given.updated)


def _tell_mean(work: Work, state: str, chances: dict[str, Value], values: dict[str, Value]) -> None:
    """What the next state is worth on average: the innermost bracket of the update, worked out before it."""
    terms = [Mul(to_sympy(chances[action]), to_sympy(values[action]), evaluate=False) for action in values]
    if len(terms) > 1:
        work.say(f"Under the policy the action values in {state} have this mean:")
        mean = sum((chances[action] * values[action] for action in values), ZERO)
        products = (chances[action] * values[action] for action in values)
        apart = (side_by_side(products),) if parameters(mean) else ()
        work.lines.append(Equality(Add(*terms, evaluate=False), (*apart, mean)))


def _policy(
    given: Given,
    work: Work,
    time: int,
    values: dict[str, Value],
    written: dict[tuple[str, tuple[str, ...]], dict[str, Value]],
) -> dict[str, Value]:
    """The probabilities of the actions of the state that is entered; where the same are written, not once more."""
    run = given.trajectory
    state = run.states[time + 1]
    if state in run.terminal:
        return dict.fromkeys(values, ONE)
    match given:
        case FixedPolicy():
            return {action: exact(given.policy[state].get(action, 0)) for action in values}
        case EpsilonGreedy():
            here = (state, best_actions(values))
            if here not in written:
                label = f"t = {time}" if len(run.rewards) > 1 else None
                written[here] = epsilon_greedy(work, state, values, exact(given.epsilon), label)
            return written[here]


def oracle(given: Given) -> Answers:
    """The values after the run; or where one is known, the parameter that leads there."""
    return oracle_along(given, _learned, given.updated)


def _learned(given: Given) -> Answers:
    """The expectation as a mixture of the best value and the plain mean, or by the policy as a vector."""
    run = given.trajectory
    Q = {state: np.array([at(value) for value in row.values()]) for state, row in given.values.items()}
    place = {state: list(row).index for state, row in given.values.items()}
    for time, (state, after) in enumerate(zip(run.states, run.states[1:], strict=False)):
        ahead = 0.0 if after in run.terminal else _expected(given, after, Q[after])
        cell = place[state](run.actions[time])
        Q[state][cell] += at(given.alpha) * (at(run.rewards[time]) + at(given.gamma) * ahead - Q[state][cell])
    return ([Q[state][place[state](action)] for state, action in given.updated],)


def _expected(given: Given, state: str, Q: Array) -> float:
    match given:
        case FixedPolicy():
            return float(np.dot([at(given.policy[state].get(action, 0)) for action in given.values[state]], Q))
        case EpsilonGreedy():
            return float((1 - at(given.epsilon)) * Q.max() + at(given.epsilon) * Q.mean())
