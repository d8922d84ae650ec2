"""The residual of every state from the given values; they are right where all residuals are 0."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from rldrill.problems.bellman.bellman_residual import Given
from rldrill.problems.document import joined
from rldrill.problems.fractions import Fraction
from rldrill.solutions import knowns
from rldrill.solutions.exact import Value, exact, is_zero
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.numerics import np
from rldrill.solutions.optimality import optimum
from rldrill.solutions.oracle import Answers, at, lookahead, optimal_values, swept, tensors
from rldrill.solutions.policy_values import evaluated
from rldrill.solutions.reward_processes import fitting
from rldrill.solutions.sheet.bellman import (
    BELLMAN_OPTIMALITY_RESIDUAL,
    BELLMAN_RESIDUAL,
    BELLMAN_V,
    FORGOT_GAMMA,
    MAX_FOR_MEAN,
    RESIDUAL_MEAN,
    RESIDUAL_SIGN,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """One backup of every state, compared with what the values say."""
    residuals = _residuals(given, work)
    if not given.verdict:
        return
    wrong = [state for state, residual in residuals.items() if not is_zero(residual)]
    if wrong:
        work.say(f"The equation does not hold in {joined(wrong)}, where $δ ≠ 0$, so $V$ is another function.")
    elif given.gamma != 1:
        equations = f"Bellman {'optimality ' if given.optimal else ''}equations"
        work.say(f"All residuals are $0$, and with $γ < 1$ only one function solves the {equations}: so this is it.")
    else:
        true = _totals(given)
        wrong = [state for state in given.mdp.states if true[state] != exact(given.values[state])]
        work.say(
            "The equations hold in every state. With $γ = 1$ other numbers may solve them, too, so the values are held "
            f"against the expected totals: they {f'differ in {joined(wrong)}' if wrong else 'are the same'}."
        )
    work.answer(not wrong)


def _totals(given: Given) -> Mapping[str, Value]:
    """The true values without discount."""
    if given.optimal:
        return optimum(given.mdp, Fraction(1)).values
    known = knowns.model_and_policy(given.mdp, given.chances, given.gamma)
    return evaluated(Work(), BELLMAN_V, given.mdp, known)


def _residuals(given: Given, work: Work) -> dict[str, Value]:
    formula, letters = fitting(BELLMAN_OPTIMALITY_RESIDUAL if given.optimal else BELLMAN_RESIDUAL, given.mdp)
    known = knowns.model_and_policy(given.mdp, given.chances, given.gamma) | letters
    values = knowns.state_values(given.values, given.mdp.terminal)
    residuals = {state: work.step(formula, s=state, V=values, **known) for state in given.mdp.states}
    answered: dict[str, Value] = work.answer(residuals)
    return answered


def _policy_mixes(given: Given) -> bool:
    return any(chance not in (0, 1) for row in given.chances.values() for chance in row.values())


def _wrong(given: Given) -> bool:
    return any(_residuals(given, Work()).values())


def _wrong_in_part(given: Given) -> bool:
    return given.verdict and _wrong(given) and not all(_residuals(given, Work()).values())


@slip(
    "one-state-enough",
    "The values are right only if the residual is 0 in every state.",
    when=_wrong_in_part,
)
def one_state(given: Given, work: Work) -> None:
    """Right as soon as one equation holds."""
    work.answer(any(map(is_zero, _residuals(given, work).values())))


MISCONCEPTIONS = (
    replace(RESIDUAL_SIGN, when=_wrong),
    replace(MAX_FOR_MEAN, when=_policy_mixes),
    RESIDUAL_MEAN,
    FORGOT_GAMMA,
    one_state,
)


def oracle(given: Given) -> Answers:
    """One sweep on arrays; for the verdict, the true values by sweeps until nothing changes."""
    mdp = given.mdp
    states, n = (*mdp.states, *mdp.terminal), len(mdp.states)
    P, R = tensors(mdp, states)
    V = np.array([at(given.values.get(state, 0)) for state in states])
    if not given.optimal:
        true, _ = swept(given)
        names = tuple(dict.fromkeys(action for _, action in mdp.outcomes))
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
