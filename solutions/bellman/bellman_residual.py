"""The residual of every state from the given values; they are right where all residuals are 0: that gives a reward."""

from collections.abc import Mapping
from typing import Any

from msgspec.structs import replace

from rldrill.problems.bellman.bellman_residual import Claimed, Given, Sought
from rldrill.problems.document import begun, joined
from rldrill.problems.exact import shown
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Model
from rldrill.problems.valued import with_reward, worth
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, NoSolution, Value, equals, exact, is_zero
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.formula.notation import MaxOver
from rldrill.solutions.numerics import np
from rldrill.solutions.optimality import optimum
from rldrill.solutions.oracle import Answers, at, lookahead, optimal_values, root, swept, tensors
from rldrill.solutions.policy_values import evaluated
from rldrill.solutions.reward_processes import fitting
from rldrill.solutions.sheet.bellman import (
    ACTIONS_ALIKE,
    BELLMAN_OPTIMALITY_RESIDUAL,
    BELLMAN_RESIDUAL,
    BELLMAN_V,
    FORGOT_GAMMA,
    MAX_FOR_MEAN,
    Q_FORGOT_GAMMA,
    Q_STAR_FROM_V,
    RESIDUAL_MEAN,
    RESIDUAL_SIGN,
)
from rldrill.solutions.slips import right_answers
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """One backup of every state, compared with what the values say; or the reward that makes them agree."""
    if isinstance(given, Sought):
        _of_reward(given, work)
    else:
        _of_claim(given, work)


def _of_claim(given: Claimed, work: Work) -> None:
    """All residuals, and what they say of the values."""
    residuals = _residuals(given, work)
    if not given.verdict:
        return
    wrong = [state for state, residual in residuals.items() if not is_zero(residual)]
    if wrong:
        work.say(f"The equation does not hold in {joined(wrong)}, where $δ ≠ 0$, so $V$ is not the value function.")
    elif given.gamma != 1:
        work.say(f"All residuals are $0$, and {_only(optimal=given.optimal)}: so this is it.")
    else:
        true = _totals(given)
        wrong = [state for state in given.mdp.states if true[state] != exact(given.values[state])]
        work.say(
            "The equations hold in every state. With $γ = 1$ other numbers may solve them, too, so the values are held "
            f"against the expected totals: they {f'differ in {joined(wrong)}' if wrong else 'are the same'}."
        )
    work.answer(not wrong)


def _only(*, optimal: bool) -> str:
    return f"with $γ < 1$ only one function solves the Bellman {'optimality ' if optimal else ''}equations"


def _of_reward(given: Sought, work: Work) -> None:
    """The reward with which the equation holds where it is earned, too; the residuals with a number for it."""
    _demand_sense(given)
    mdp, row, letter = given.mdp, given.row, str(given.row.reward)
    gamma, V = exact(given.gamma), knowns.state_values(given.values, given.mdp.terminal)
    known = knowns.model(mdp) | {"gamma": gamma, "V": V}
    others = [state for state in mdp.states if state != row.state]
    residuals = {state: work.step(BELLMAN_OPTIMALITY_RESIDUAL, s=state, **known) for state in others}
    holds = f"Whatever ${letter}$ is, the equation holds in {joined(others)}. " if others else ""
    work.say(f"{holds}In {row.state} the actions are worth:")
    worths = {a: work.step(Q_STAR_FROM_V, s=row.state, a=a, **known) for a in mdp.actions[row.state]}
    less = [action for action in worths if action != row.action]
    of_state = f'$V("{row.state}")$'
    beaten = f"{begun(joined(less))} {'is' if len(less) == 1 else 'are'} worth less than {of_state}"
    work.say(f"{beaten}, so {row.action} must reach it:")
    if work.misreads(BELLMAN_OPTIMALITY_RESIDUAL):
        of_one = work.reading(BELLMAN_OPTIMALITY_RESIDUAL).has(MaxOver)  # the action is to be the best one
        alone = {"actions": {row.state: (row.action,)}} if of_one else {}
        misread = work.value(BELLMAN_OPTIMALITY_RESIDUAL, s=row.state, **known | alone)
        reward = work.equate(letter, misread, ZERO)
    else:
        reward = work.equate(letter, worths[row.action], V[row.state])
    work.say(f"With ${letter} {equals(reward)}$ all residuals are $0$, and {_only(optimal=True)}: so $V = V^*$.")
    work.answer(reward)
    work.say(f"With ${letter} = {shown(given.reward)}$ only the residual of {row.state} changes:")
    residuals[row.state] = _residual_with_reward(given, work, mdp)
    work.answer({state: residuals[state] for state in mdp.states})


def _residual_with_reward(given: Sought, work: Work, mdp: Model) -> Value:
    """The residual in the state of the open reward, with the number for it."""
    known = knowns.model(with_reward(mdp, given.reward)) | {"gamma": exact(given.gamma)}
    values = knowns.state_values(given.values, mdp.terminal)
    return work.step(BELLMAN_OPTIMALITY_RESIDUAL, s=given.row.state, V=values, **known)


def _demand_sense(given: Sought) -> None:
    """Demand that the equations hold but for the reward that is asked for, and that it follows from them.

    Raises:
        NoSolution: it is not so.
    """
    mdp, row, gamma = given.mdp, given.row, Fraction(given.gamma)
    values = {state: Fraction(value) for state, value in given.values.items()}
    for state in mdp.states:
        best = max(worth(mdp, (state, a), values, gamma) for a in mdp.actions[state] if (state, a) != row[:2])
        if state != row.state and best != values[state]:
            raise NoSolution(f"values: with no reward are they optimal, for {state!r} is worth {best} by the others")
        if state == row.state and best >= values[state]:
            raise NoSolution(f"values: the reward does not follow, for another action in {state!r} is worth as much")


def _totals(given: Claimed) -> Mapping[str, Value]:
    """The true values without discount."""
    if given.optimal:
        return optimum(given.mdp, Fraction(1)).values
    known = knowns.model_and_policy(given.mdp, given.chances, given.gamma)
    return evaluated(Work(), BELLMAN_V, given.mdp, known)


def _residuals(given: Claimed, work: Work) -> dict[str, Value]:
    formula, letters = fitting(BELLMAN_OPTIMALITY_RESIDUAL if given.optimal else BELLMAN_RESIDUAL, given.mdp)
    known = knowns.model_and_policy(given.mdp, given.chances, given.gamma) | letters
    values = knowns.state_values(given.values, given.mdp.terminal)
    residuals = {state: work.step(formula, s=state, V=values, **known) for state in given.mdp.states}
    answered: dict[str, Value] = work.answer(residuals)
    return answered


def _policy_mixes(given: Given) -> bool:
    return isinstance(given, Claimed) and any(
        chance not in (0, 1) for row in given.chances.values() for chance in row.values()
    )


def _wrong(given: Given) -> bool:
    return isinstance(given, Sought) or any(_residuals(given, Work()).values())


def _wrong_in_part(given: Given) -> bool:
    if isinstance(given, Sought) or not given.verdict:
        return False
    return _wrong(given) and not all(_residuals(given, Work()).values())


def _another_is_best(given: Given) -> bool:
    if isinstance(given, Claimed):
        return False
    closed, values = with_reward(given.mdp, given.reward), {s: Fraction(value) for s, value in given.values.items()}
    state, action = given.row[:2]
    worths = {a: worth(closed, (state, a), values, Fraction(given.gamma)) for a in given.mdp.actions[state]}
    return worths[action] < max(worths.values())


@slip(
    "one-state-enough",
    "The values are right only if the residual is 0 in every state.",
    when=_wrong_in_part,
)
def one_state(given: Claimed, work: Work) -> None:
    """Right as soon as one equation holds."""
    work.answer(any(map(is_zero, _residuals(given, work).values())))


@slip(
    "action-kept",
    "With another reward another action may be best: the maximum is taken over all actions again.",
    when=_another_is_best,
)
def action_kept(given: Sought, work: Work) -> None:
    """The residual with the action whose reward has become too small."""
    reward, residuals = right_answers(solve, given, work)
    work.answer(reward)
    mdp, row = given.mdp, given.row
    taken = [each for each in mdp.transitions if each.state != row.state or each.action == row.action]
    alone = Model(transitions=tuple(taken), terminal=mdp.terminal)
    work.answer(residuals | {row.state: _residual_with_reward(given, work, alone)})


MISCONCEPTIONS = (
    replace(RESIDUAL_SIGN, when=_wrong),
    replace(MAX_FOR_MEAN, when=_policy_mixes),
    ACTIONS_ALIKE.where_it_shows(),
    RESIDUAL_MEAN,
    FORGOT_GAMMA,
    Q_FORGOT_GAMMA.where_it_shows(),
    one_state,
    action_kept,
)


def oracle(given: Given) -> Answers:
    """One sweep on arrays; for the verdict, the true values by sweeps until nothing changes."""
    return _claim_tried(given) if isinstance(given, Claimed) else _reward_tried(given)


def _reward_tried(given: Sought) -> Answers:
    """The reward from two trials, for the action's worth is linear in it; one sweep on arrays with the number."""
    mdp, gamma = given.mdp, at(given.gamma)
    states, n = mdp.every_state, len(mdp.states)
    names = mdp.every_action
    place = states.index(given.row.state), names.index(given.row.action)
    V = np.array([at(given.values.get(state, 0)) for state in states])
    reward = root(lambda x: float(lookahead(*tensors(mdp, x), V, gamma)[place] - V[place[0]]))
    return reward, lookahead(*tensors(mdp, at(given.reward)), V, gamma)[:n].max(axis=1) - V[:n]


def _claim_tried(given: Claimed) -> Answers:
    """The residuals, and the verdict."""
    mdp = given.mdp
    states, n = mdp.every_state, len(mdp.states)
    P, R = tensors(mdp)
    V = np.array([at(given.values.get(state, 0)) for state in states])
    if not given.optimal:
        true, _ = swept(given)
        names = mdp.every_action
        worth = lookahead(P, R, V, at(given.gamma))
        after = np.array([
            sum(at(chance) * worth[i, names.index(action)] for action, chance in given.chances[state].items())
            for i, state in enumerate(mdp.states)
        ])  # fmt: skip
    else:
        true = optimal_values(P, R, at(given.gamma), n)
        after = lookahead(P, R, V, at(given.gamma))[:n].max(axis=1)
    answers: list[Any] = [after - V[:n]]
    return [*answers, bool(np.allclose(V[:n], true[:n], atol=1e-9))] if given.verdict else answers
