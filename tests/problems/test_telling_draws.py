"""What is drawn tells whether somebody has understood: the point of a question cannot be missed by accident."""

import math
import re
from collections import Counter
from fractions import Fraction
from itertools import combinations, groupby
from typing import Any

import pytest
import sympy

import rldrill
from rldrill.solutions.drawing import draw
from tests.problems.test_promises import drawn, worth


def q_learning_targets(given: Any, alpha: Fraction, *, moved: bool) -> list[Fraction]:
    rows = {state: {a: Fraction(value) for a, value in row.items()} for state, row in given.values.items()}
    run, found = given.trajectory, []
    for time, reward in enumerate(run.rewards):
        after = run.states[time + 1]
        found.append(reward + given.gamma * (0 if after in run.terminal else max(rows[after].values())))
        if moved:
            old = rows[run.states[time]][run.actions[time]]
            rows[run.states[time]][run.actions[time]] = old + alpha * (found[-1] - old)
    return found


def test_the_table_that_q_learning_has_moved_is_read_again() -> None:
    for given in drawn("sarsa-versus-q-learning", (2,)):
        assert q_learning_targets(given, given.alpha, moved=True) != q_learning_targets(given, given.alpha, moved=False)


def test_a_step_size_is_asked_for_from_a_target_that_hangs_on_it() -> None:
    for given in drawn("sarsa-versus-q-learning", (3,)):
        pairs = [*zip(given.trajectory.states, given.trajectory.actions, strict=False)]
        assert any(pair in pairs[: time - 1] for time, pair in enumerate(pairs) if time > 1)
        assert given.known != 0
    sizes = Counter(draw("sarsa-versus-q-learning", 3, seed).answers["a"] for seed in range(40))
    assert max(sizes.values()) < 20  # no step size is a good guess


def test_up_to_which_reward_a_policy_is_optimal_hangs_on_what_follows() -> None:
    for given in drawn("policy-iteration", (3,)):
        row = given.row
        after: list[dict[str, Fraction]] = []
        for action in (row.action, given.start[row.state]):
            after.append({each.next: each.probability for each in given.mdp.outcomes[row.state, action]})
        assert after[0] != after[1]


def test_the_reward_that_is_sought_is_not_one_of_the_table() -> None:
    for seed in range(25):
        solution = draw("policy-iteration", 3, seed)
        given: Any = solution.problem.given
        assert solution.answers["b"] not in {row.reward for row in given.mdp.transitions if row is not given.row}


def test_a_reward_with_which_values_are_optimal_is_worked_out() -> None:
    falls = 0
    for given in drawn("bellman-residual", (3,)):
        row, values = given.row, {state: Fraction(value) for state, value in given.values.items()}
        rows = given.mdp.outcomes[row.state, row.action]
        ahead = sum(each.probability * given.gamma * values.get(each.next, 0) for each in rows)
        rest = sum(each.probability * each.reward for each in rows if each is not row)
        right = (values[row.state] - ahead - rest) / row.probability
        assert ahead != 0  # else γ and V of the next states would not matter
        assert right not in {each.reward for each in given.mdp.transitions if each is not row}
        falls += given.reward < right
    assert 15 < falls < 60  # both: where it is best all the more, and where another action takes its place


@pytest.mark.parametrize(
    "family",
    ["expected-sarsa", "policy-value", "policy-action-value", "policy-iteration", "batch-td-and-mc", "value-iteration",
     "feature-expectations-policy"],
)  # fmt: skip
def test_no_working_of_the_first_levels_has_a_number_above_300(family: str) -> None:
    for level in (1, 2):
        for seed in range(8):
            text = str(rldrill.draw(family, level, 900 + seed).working())
            assert max(map(int, re.findall(r"\d+", text)), default=0) <= 300, (family, level, seed)


def test_q_learning_reads_a_greatest_value_that_has_changed() -> None:
    for given in drawn("q-learning", (2,)):
        if given.outcome is None:
            moved, kept = (q_learning_targets(given, given.alpha, moved=moved) for moved in (True, False))
            assert moved != kept


def test_sweeps_in_place_change_every_value() -> None:
    for given in drawn("policy-evaluation", (2,)):
        if given.in_place and given.sweeps == 1 and given.policy is not None:
            values = dict(given.start)
            for state, row in given.policy.items():
                values[state] = sum(
                    chance * move.probability * (move.reward + given.gamma * values.get(move.next, 0))
                    for action, chance in row.items()
                    for move in given.mdp.outcomes[state, action]
                )
                assert values[state] != given.start[state]


def test_no_state_of_an_open_problem_is_worth_nothing() -> None:
    for seed in range(40):
        assert all(draw("policy-value", 3, seed).answers["a"].values()), seed


def test_every_error_of_an_advantage_counts() -> None:
    for given in drawn("advantage", (3,)):
        run = given.run
        worth = [run.values.get(state, Fraction(0)) for state in run.trajectory.states]
        for time, reward in enumerate(run.trajectory.rewards):
            assert reward + given.gamma * worth[time + 1] != worth[time]


@pytest.mark.parametrize("level", [1, 2])
def test_whether_a_policy_is_optimal_is_not_always_answered_alike(level: int) -> None:
    verdicts = Counter([*draw("policy-iteration", level, seed).answers.values()][-1] for seed in range(40))
    assert min(verdicts[True], verdicts[False]) > 5


def test_each_table_of_double_q_learning_has_its_turns_in_one_go() -> None:
    for given in drawn("double-q-learning", (1, 2, 3)):
        assert len(list(groupby(given.updates))) == len(set(given.updates))


def test_no_action_is_left_out_of_the_average_of_an_epsilon_greedy_policy() -> None:
    for given in drawn("epsilon-greedy", (2, 3)):
        assert all(given.values.values())
    for given in drawn("epsilon-greedy", (3,)):
        assert len(given.values) > 2
        assert given.state_value is not None


def test_a_softmax_weight_is_not_the_number_that_is_printed() -> None:
    searched = 0
    for seed in range(60):
        solution = draw("softmax-policy", 3, seed)
        given: Any = solution.problem.given
        if given.odds is not None:
            searched += 1
            assert solution.answers["a"] not in (given.odds.times, 1 / given.odds.times), seed
    assert searched > 5


def test_second_derivatives_count_from_level_2_on() -> None:
    assert not any(given.second_order for given in drawn("ddp-backward", (1,)))
    second = list(drawn("ddp-backward", (2,)))
    assert all(given.second_order for given in second)
    assert 0 < sum(given.reached is not None for given in second) < len(second)


def test_no_tank_runs_dry_in_a_step_and_no_state_is_forgotten() -> None:
    tanks = 0
    for given in drawn("linearise-affine", (1, 2)):
        letters = {name: float(value) for name, value in given.constants.items()}
        letters |= {name: float(value.number) for name, value in {**given.state, **given.action}.items()}
        for name, rate in given.dynamics.items():
            if "sqrt" in rate:
                tanks += 1
                assert letters[name] + float(given.step) * worth(rate, letters) > 0, given
                # A hole lets the height fall at c √h / S, so one step keeps 1 − Δt c/(2 S √h) of a deviation of it.
                hole, area = (f"{letter}_{name[2:]}" if "_" in name else letter for letter in "cS")
                loss = letters[hole] / (2 * letters[area] * math.sqrt(letters[name]))
                assert 1 - float(given.step) * loss > 0.5, given
    assert tanks > 20


def test_current_values_are_spoken_of_where_a_row_that_has_changed_is_read_again() -> None:
    told: Counter[bool] = Counter()
    for level in (1, 2, 3):
        for seed in range(25):
            given: Any = draw("expected-sarsa", level, seed).problem.given
            states = given.trajectory.states
            again = any(after in states[:time] for time, after in enumerate(states[1:]))
            if hasattr(given, "epsilon"):
                text = " ".join(str(rldrill.draw("expected-sarsa", level, seed).question()).split())
                assert ("values that are current at each update" in text) == again
                told[again] += 1
    assert min(told[True], told[False]) > 3


def test_features_of_a_linear_policy_tell_actions_and_weights_apart() -> None:
    for given in drawn("linear-policy", (1, 2)):
        for rows in given.features.values():
            for one, other in combinations(rows.values(), 2):
                assert sympy.Matrix([one, other]).rank() == 2, given
        columns = [*zip(*(row for rows in given.features.values() for row in rows.values()), strict=True)]
        assert len(set(columns)) == len(columns)


def test_no_two_samples_of_ppo_are_the_same_case() -> None:
    for given in drawn("ppo-clip", (2,)):
        cases = []
        for sample in given.samples:
            ratio = sample.new / sample.old
            inside = 1 - given.epsilon <= ratio <= 1 + given.epsilon
            cases.append((inside, not inside and ratio > 1, not inside and sample.advantage > 0))
        assert len(set(cases)) == len(cases), given


@pytest.mark.parametrize("family", ["reinforce", "reinforce-baseline"])
def test_no_weight_of_a_policy_gradient_stays_as_it_is(family: str) -> None:
    for level in (1, 2, 3):
        for seed in range(25):
            assert all(str(entry) != "0" for entry in draw(family, level, seed).answers["b"]), (level, seed)


def test_the_target_that_is_known_is_sarsas_alone() -> None:
    letters: Counter[str] = Counter()
    for seed in range(60):
        solution = draw("sarsa-versus-q-learning", 3, seed)
        given: Any = solution.problem.given
        pairs = [*zip(given.trajectory.states, given.trajectory.actions, strict=False)]
        again = next(time for time in range(1, len(pairs)) if pairs[time + 1] in pairs[:time])
        assert solution.answers["b"][again] != given.known
        letters[solution.answers["c"]] += 1
    assert min(letters[letter] for letter in "ABCD") > 4


def test_every_return_moves_the_average_that_it_is_averaged_into() -> None:
    for given in drawn("sample-average", (1, 2)):
        values, counts = dict(given.values), dict(given.counts)
        assert len(set(values.values())) == len(values)  # or nobody sees which state a value was taken from
        for state, each in given.visits:
            assert each != values[state]
            counts[state] = counts.get(state, 0) + 1
            values[state] += (each - values[state]) * (given.alpha or Fraction(1, counts[state]))


def test_models_have_at_most_half_as_many_parameters_as_data() -> None:
    for seed in range(60):
        for level in (1, 3):
            solution = draw("bic", level, seed)
            given: Any = solution.problem.given
            if given.fitted is not None:
                data = solution.answers["a"] if given.border else given.n
                assert 2 * max(model.k for model in given.fitted.values()) <= data


def test_no_best_action_of_a_scalar_system_brings_the_state_to_0_at_once() -> None:
    for seed in range(60):
        assert draw("lqr-infinite", 2, seed).answers["c"] != 0


def test_from_which_reward_an_action_is_optimal_is_not_the_value_of_another() -> None:
    # Where the action ends the episode for sure, the reward is all that it is worth.
    for given in drawn("optimal-policy-from-q", (3,)):
        assert given.tied is not None
        assert [row.next for row in given.missing.outcomes[given.tied]] not in [[end] for end in given.terminal]


def test_no_two_actions_of_a_softmax_policy_are_as_probable_where_x_plays_a_part() -> None:
    for seed in range(60):
        solution = draw("softmax-policy", 3, seed)
        given: Any = solution.problem.given
        if not given.entropy:
            chances = solution.answers["b"].values()
            assert len({*map(str, chances)}) == len(chances), seed


def test_no_state_is_on_the_edge_of_a_tent_and_many_are_beyond_one() -> None:
    # On the edge 1 − d/b is 0 by itself, so that nobody sees who forgets the maximum with 0.
    for level in (1, 2, 3):
        workings = [str(rldrill.draw("piecewise-linear-rbf", level, seed).working()) for seed in range(30)]
        assert not any("max(0, 0)" in working for working in workings)
        assert sum("max(0, −" in working for working in workings) > 3
