"""One step of the other policy, held against the first policy's values in every state."""

from collections.abc import Mapping
from typing import Any

from msgspec.structs import replace

from rldrill.problems.document import joined
from rldrill.problems.dynamic_programming.policy_improvement_theorem import Given
from rldrill.problems.valued import deterministic
from rldrill.solutions import knowns
from rldrill.solutions.answers.kinds import text_of
from rldrill.solutions.endless import Loop
from rldrill.solutions.exact import NoSolution, Value, exact, sign
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at, chances, lookahead, policy_values, tensors
from rldrill.solutions.policy_values import Evaluation, endless, evaluated, of_states, one_sweep
from rldrill.solutions.sheet.bellman import BELLMAN_Q, BELLMAN_V, FORGOT_GAMMA, Q_FORGOT_GAMMA
from rldrill.solutions.sheet.dynamic_programming import POLICY_IMPROVEMENT_THEOREM, POLICY_ITERATION
from rldrill.solutions.work import Work


def solve(given: Given, work: Work, evaluation: Evaluation = evaluated) -> None:
    """What one step of the other policy is worth; the theorem applies if that is never a loss."""
    gaps = _gaps(given, work, evaluation)
    holds = -1 not in gaps
    loop = _trap(given) if holds else None
    applies = holds and loop is None
    if loop is not None:
        work.say(
            f"This holds in every state, but with $γ = 1$ that is not enough: $π'$ goes on for ever with {loop} and "
            "never earns what $V^π$ counts on, so the theorem says nothing about $π'$."
        )
    elif applies:
        work.say("The inequality holds in every state, so the theorem applies: $π'$ is at least as good as $π$.")
    else:
        failing = [state for state, gap in zip(given.mdp.states, gaps, strict=True) if gap < 0]
        work.say(
            f"The inequality fails in {joined(failing)}, so the theorem does not apply: it does not show that $π'$ is "
            "at least as good as $π$."
        )
    work.answer(applies)


def _trap(given: Given) -> Loop | None:
    """A loop in which the other policy, undiscounted, stays for ever although there is more to be had."""
    mdp, known = given.mdp, _known(given)
    loops = endless(mdp, known | {"pi": given.other})
    if not loops:
        return None
    values = _values(given, Work(), evaluated)
    lost = (loop for loop in loops if sign(loop.gain) <= 0)  # one that pays earns without bound
    return next((loop for loop in lost if any(sign(values[state]) > 0 for state in loop.actions)), None)


def _gaps(given: Given, work: Work, evaluation: Evaluation = evaluated) -> tuple[int, ...]:
    """Whether one step of the other policy is worth more (1), as much (0) or less (−1) in every state."""
    values = _values(given, work, evaluation)
    known = _known(given) | {"V": values}
    worth = {(state, a): work.step(BELLMAN_Q, s=state, a=a, **known) for state, a in given.pairs}
    return _compared(given, work, values, worth)


def _known(given: Given) -> dict[str, Any]:
    return knowns.model(given.mdp) | {"gamma": exact(given.gamma)}


def _values(given: Given, work: Work, evaluation: Evaluation) -> dict[str, Value]:
    if given.values is not None:
        return knowns.state_values(given.values, given.mdp.terminal)
    known = knowns.model_and_policy(given.mdp, deterministic(given.policy), given.gamma)
    values = evaluation(work, BELLMAN_V, given.mdp, known)
    return values | work.answer(of_states(given.mdp, values))


def _compared(given: Given, work: Work, values: Mapping[str, Value], worth: Any) -> tuple[int, ...]:
    worth = work.answer(worth)
    gaps = tuple(sign(worth[pair] - values[pair[0]]) for pair in given.pairs)
    work.say("The theorem asks for this in every state:")
    work.recall(POLICY_IMPROVEMENT_THEOREM)
    told = []
    for (state, action), gap in zip(given.pairs, gaps, strict=True):
        here = f"{text_of(worth[state, action])} {'<' if gap < 0 else '≥'} {text_of(values[state])}".replace("-", "−")
        told.append(f'$Q^π("{state}", "{action}") = {here} = V^π("{state}")$')
    work.say(f"Here {joined(told)}.")
    return gaps


@slip(
    "values-of-the-new-policy",
    "Q^π(s, π′(s)) takes π′ for one step only and goes on with π; the theorem does not need the values of π′.",
    when=lambda given: given.policy != given.other,
)
def new_values(given: Given, work: Work) -> None:
    """The other policy for ever, not for one step."""
    values = _values(given, work, evaluated)
    others = evaluated(work, POLICY_ITERATION, given.mdp, _known(given) | {"pi": given.other})
    worth = {(state, action): others[state] for state, action in given.pairs}
    work.answer(-1 not in _compared(given, work, values, worth))


def _better_here_worse_there(given: Given) -> bool:
    try:
        gaps = _gaps(given, Work())
    except NoSolution:
        return False
    return 1 in gaps and -1 in gaps


@slip(
    "one-state-enough",
    "The inequality must hold in every state; where it fails in one, the theorem says nothing.",
    when=_better_here_worse_there,
)
def one_state(given: Given, work: Work) -> None:
    """Better in one state, so better."""
    work.answer(1 in _gaps(given, work))


@slip(
    "action-of-the-first-policy",
    "Q^π(s, π′(s)) begins with the action of π′; with that of π it would be V^π(s) itself.",
    when=lambda given: given.policy != given.other,
)
def own_action(given: Given, work: Work) -> None:
    """The first policy's action in every state: its own values again."""
    values = _values(given, work, evaluated)
    _compared(given, work, values, {pair: values[pair[0]] for pair in given.pairs})
    work.answer(True)


MISCONCEPTIONS = (
    new_values,
    one_state,
    own_action.where_it_shows(),
    one_sweep(solve),
    Q_FORGOT_GAMMA.where_it_shows(),
    replace(FORGOT_GAMMA.where_it_shows(), when=lambda given: given.gamma != 1 and given.values is None),
)


def oracle(given: Given) -> Answers:
    """Both policies as one-hot rows: the second picks from the lookahead on the first one's values."""
    n = len(given.mdp.states)
    P, R = tensors(given.mdp)
    first, second = (chances(deterministic(pi), given.mdp) for pi in (given.policy, given.other))
    V = policy_values(P, R, first, at(given.gamma))
    worth = lookahead(P, R, V, at(given.gamma))[:n][second[:n] > 0]
    answers: list[Any] = [V[:n]] if given.values is None else []
    holds = bool(np.all(worth > V[:n] - 1e-9))
    if holds and given.gamma == 1:  # what the theorem shows must be so
        holds = bool(np.all(policy_values(P, R, second, 1.0) > V - 1e-9))
    answers += [worth, holds]
    return answers
