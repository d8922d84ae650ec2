"""What a family's draws promise: numbers with which roots and logarithms come out, worked out here by themselves."""

import math
from collections.abc import Iterator, Mapping
from fractions import Fraction
from math import isqrt
from typing import Any

import pytest

import rldrill
from rldrill.problems.catalogue import family
from rldrill.problems.control import sarsa_lambda
from rldrill.problems.draws import Draws
from rldrill.problems.expressions import worked_out
from rldrill.problems.family import Problem, trusted
from rldrill.problems.temporal_difference import td_lambda_backward, td_zero
from rldrill.solutions.solution import solve


def drawn(name: str, levels: tuple[int, ...], number: int = 60) -> Iterator[Any]:
    for level in levels:
        for key in range(number):
            with trusted():
                yield family(name).draw(level, Draws(f"promise {level} {key}"))


def is_square(number: Fraction) -> bool:
    return all(isqrt(whole) ** 2 == whole for whole in (number.numerator, number.denominator))


def test_the_scalar_riccati_equation_has_a_rational_root() -> None:
    for given in drawn("lqr-infinite", (1, 2)):
        assert all(
            given.A[i][j] == given.B[i][j] == 0 for i in range(len(given.A)) for j in range(len(given.A)) if i != j
        )
        for i in range(len(given.A)):
            a, b, q, r = (Fraction(matrix[i][i]) for matrix in (given.A, given.B, given.Q, given.R))
            n, gamma = Fraction(given.N[i][i] if given.N else 0), Fraction(given.gamma)
            beta = gamma * b**2 * q + (gamma * a**2 - 1) * r - 2 * gamma * a * b * n
            assert is_square(beta**2 + 4 * gamma * b**2 * (q * r - n**2))
            assert q * r > n**2


def test_two_coupled_systems_have_whole_numbers_and_roots_for_sum_and_difference() -> None:
    coupled = [given for given in drawn("lqr-infinite", (3,)) if len(given.A) == 2]
    assert len(coupled) > 5
    for given in coupled:
        for matrix in (given.A, given.B, given.Q, given.R):
            (one, two), (three, four) = matrix
            assert (one, two) == (four, three)
            assert Fraction(one).denominator == Fraction(two).denominator == 1
        for sign in (1, -1):
            a, b, q, r = (matrix[0][0] + sign * matrix[0][1] for matrix in (given.A, given.B, given.Q, given.R))
            assert is_square(Fraction((b**2 * q + (a**2 - 1) * r) ** 2 + 4 * b**2 * q * r))
        assert given.A[0][1] != 0


def test_tosses_have_logarithms_of_2_and_3_alone() -> None:
    tossed = [given.data.tosses for given in drawn("bic", (1, 2, 3)) if given.data]
    assert len(tossed) > 5
    for tosses in tossed:
        heads, tails = (sum(side) for side in zip(*tosses.values(), strict=True))
        for coin in (*tosses.values(), (heads, tails)):
            for number in (*coin, sum(coin)):
                assert 6**9 % number == 0, coin
            assert sum(coin) > 3
        if len(tosses) == 1:
            assert heads != tails  # or a fair coin fits best
        else:
            assert len({Fraction(*coin) for coin in tosses.values()}) == len(tosses)


def worth(text: str, letters: dict[str, float]) -> float:
    """An expression of a robot, read as Python reads it."""
    functions = {"sin": math.sin, "cos": math.cos, "sqrt": math.sqrt}
    return float(worked_out(text, letters, functions, float))


def test_the_next_value_rises_towards_what_is_wanted_and_the_state_matters() -> None:
    for given in drawn("ddp-backward", (1, 2)):
        ((name, dynamics),) = given.dynamics.items()
        letters = {letter: float(value) for letter, value in given.constants.items()}
        letters |= {letter: float(value.number) for letter, value in {**given.state, **given.action}.items()}
        target = 0.0 if "w - x" in dynamics else letters["w"]
        assert (target - worth(dynamics, letters)) * given.gradient[0] > 0, given
        above, below = (worth(dynamics, letters | {name: letters[name] + h}) for h in (1e-4, -1e-4))
        assert abs(above - below) / 2e-4 > 1e-3, given


def values_of_the_next_states(given: Any) -> list[Fraction]:
    """What the states of a backup diagram are worth that have branches, from the leaves upwards."""
    worth = {state: Fraction(value) for state, value in given.values.items()}
    below = {state: {a: Fraction(value) for a, value in row.items()} for state, row in given.action_values.items()}
    for state in given.inner:
        below[state] = {
            action: sum(
                Fraction(row.probability) * (Fraction(row.reward) + Fraction(given.gamma) * worth[row.next])
                for row in given.dynamics.outcomes[state, action]
            )
            for action in given.dynamics.actions[state]
        }
        worth[state] = mean_or_best(given, state, below[state])
    return [mean_or_best(given, state, row) for state, row in below.items()]


def mean_or_best(given: Any, state: str, row: dict[str, Fraction]) -> Fraction:
    if given.policy is None:
        return max(row.values())
    return sum((Fraction(given.policy[state][action]) * each for action, each in row.items()), Fraction(0))


def test_no_two_next_states_of_a_backup_diagram_are_worth_the_same() -> None:
    deep = [given for given in drawn("backup-diagram-value", (2, 3)) if given.known is None]
    several = [values for values in map(values_of_the_next_states, deep) if len(values) > 1]
    assert len(several) > 10
    for values in several:
        assert len(set(values)) == len(values)


def test_the_name_of_a_backup_diagram_can_be_told_from_its_legend() -> None:
    for level in (1, 2, 3):
        for seed in range(20):
            question = str(rldrill.draw("backup-diagram-name", level, seed).question())
            assert "A square is a terminal state" in question


def test_the_weights_of_a_softmax_policy_make_a_difference_in_every_state() -> None:
    for name, levels in (("reinforce", (2, 3)), ("reinforce-baseline", (2, 3)), ("actor-critic", (2,))):
        for given in drawn(name, levels, 40):
            bases = [int(str(weight).removeprefix("ln ")) if str(weight) != "0" else 1 for weight in given.theta]
            for rows in given.features.values():
                chances = [math.prod(base**x for base, x in zip(bases, row, strict=True)) for row in rows.values()]
                assert len(set(chances)) > 1, given


def test_the_weight_at_which_two_actions_are_worth_the_same_is_not_0() -> None:
    for given in drawn("linear-policy", (3,)):
        if given.at is None:
            continue
        place = [isinstance(weight, str) for weight in given.theta].index(True)
        known = [Fraction(0) if isinstance(weight, str) else Fraction(weight) for weight in given.theta]
        for row in given.features.values():
            first, second = ([Fraction(x) for x in features] for features in row.values())
            lead = sum(weight * (one - two) for weight, one, two in zip(known, first, second, strict=True))
            assert lead != 0, given
            assert first[place] != second[place]


def test_whoever_has_a_place_goes_left_or_right_or_stays() -> None:
    for given in drawn("linear-value", (2, 3)):
        if given.bumps is not None:
            assert set(given.actions) <= {"left", "right", "stay"}


@pytest.mark.parametrize("family_of", [sarsa_lambda, td_lambda_backward, td_zero])
def test_values_that_are_looked_at_when_drawing_are_those_that_are_found(family_of: Any) -> None:
    name, compared = family_of.__name__.rpartition(".")[2].replace("_", "-"), 0
    for given in drawn(name, (2,), 15):
        answers = solve(Problem(family(name), given)).answers
        found = list(answers.values())[-1]
        if given.parameters() or not isinstance(found, Mapping):
            continue
        learned = family_of._learned(given)
        assert {key: Fraction(str(value)) for key, value in found.items()} == {key: learned[key] for key in found}
        compared += 1
    assert compared > 5
