"""The Riccati equation by doubling, held against equations of one number that are solved by hand."""

import pytest
from flint import fmpq

from rldrill.solutions.exact import NoSolution
from rldrill.solutions.matrices import matrix
from rldrill.solutions.riccati import Regulator, stationary

ONE = fmpq(1)


def of_one(a: int, q: int | fmpq, r: int, gamma: fmpq = ONE) -> Regulator:
    """A system of one state and one action, B = 1."""
    A, B, Q, R, N = (matrix([[fmpq(entry)]]) for entry in (a, 1, q, r, 0))
    return Regulator(A, B, Q, R, N, gamma)


def test_a_discounted_system_that_is_stable_for_the_discount_alone() -> None:
    # γ = 1/4, S = 2: L = (2/4)/(1 + 2/4) = 1/3, so A − BL = 2/3; q = S − S/4 + (S/4)²/(1 + S/4) = 2 − 1/2 + 1/6 = 5/3.
    # γ(2/3)² = 1/9 is below 1, as it must be; (2/3)²/γ = 16/9 would not be.
    regulator = of_one(1, fmpq(5, 3), 1, fmpq(1, 4))
    S = stationary(regulator)
    assert abs(S[0, 0] - 2) < fmpq(1, 10**40)
    assert abs(regulator.gain(S)[0, 0] - fmpq(1, 3)) < fmpq(1, 10**40)
    assert abs(regulator.before(S)[0, 0] - 2) < fmpq(1, 10**40)


def test_a_state_that_costs_nothing_is_brought_to_rest_where_it_would_run_away() -> None:
    # S = 4S − 4S²/(1 + S) has the solutions 0 and 3; with S = 3, L = 2·3/4 = 3/2 and A − BL = 1/2, the mirror of 2.
    regulator = of_one(2, 0, 1)
    S = stationary(regulator)
    assert abs(S[0, 0] - 3) < fmpq(1, 10**40)
    assert abs(regulator.gain(S)[0, 0] - fmpq(3, 2)) < fmpq(1, 10**40)
    # discounted by 1/5 it may run away: γ·2² = 4/5 is below 1, and nothing is ever paid
    assert stationary(of_one(2, 0, 1, fmpq(1, 5)))[0, 0] == 0


def test_two_coupled_states_that_cost_nothing_are_brought_to_rest() -> None:
    # With S = ((3, −1), (−1, 1))/4: BᵀSB = 3, BᵀSA = (−1, −1), so L = (−1/4, −1/4); AᵀSA − (1, 1)ᵀ(1, 1)/4 is S again.
    # A − BL = ((1/2, −1/2), (2, −1)) has the characteristic polynomial x² + x/2 + 1/2: both |x|² are 1/2.
    A, B, Q, R, N = (
        matrix([list(map(fmpq, line)) for line in rows])
        for rows in ([[0, -1], [2, -1]], [[2], [0]], [[0, 0], [0, 0]], [[1]], [[0], [0]])
    )
    S = stationary(Regulator(A, B, Q, R, N, ONE))
    off = S * 4 - matrix([[fmpq(3), fmpq(-1)], [fmpq(-1), fmpq(1)]])
    assert max(map(abs, off.entries())) < fmpq(1, 10**40)


@pytest.mark.parametrize("system", [(1, 0, 1), (-1, 0, 1), (2, 0, 1, fmpq(1, 4))])
def test_a_state_that_costs_nothing_and_neither_grows_nor_falls_has_no_answer(system: tuple[int, int, int]) -> None:
    # a = ±1, and γ·2² = 1: any gain that brings it to rest can be undercut by a smaller one.
    with pytest.raises(NoSolution, match="the state does not come to rest: what it does costs nothing there"):
        stationary(of_one(*system))


def test_what_no_action_reaches_and_what_runs_away_at_a_price_are_told() -> None:
    blind = of_one(2, 0, 1)._replace(B=matrix([[fmpq(0)]]))
    with pytest.raises(NoSolution, match="no action reaches it"):
        stationary(blind)
    with pytest.raises(NoSolution, match="grows without end"):
        stationary(blind._replace(Q=matrix([[ONE]])))


def test_an_action_without_a_price_is_charged_what_it_leads_to() -> None:
    # R = 0: the best action brings the state to 0 at once, so S = q, and L = a.
    regulator = of_one(3, 2, 0)
    S = stationary(regulator)
    assert (S[0, 0], regulator.gain(S)[0, 0]) == (2, 3)


def test_a_cost_of_state_and_action_together_counts_in_the_gain_and_in_what_is_left() -> None:
    # q = 2, n = r = 1, S = 1: L = (1 + 1)/(1 + 1) = 1 brings the state to 0 at once; q + S − (S + n)L = 2 + 1 − 2 = 1.
    regulator = of_one(1, 2, 1)._replace(N=matrix([[fmpq(1)]]))
    S = stationary(regulator)
    assert abs(S[0, 0] - 1) < fmpq(1, 10**40)
    assert (regulator.gain(matrix([[ONE]]))[0, 0], regulator.before(matrix([[ONE]]))[0, 0]) == (1, 1)
