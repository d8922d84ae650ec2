"""What draws over small models and graphs promise, so that the idea of each level cannot be missed by accident."""

from collections import Counter
from fractions import Fraction
from itertools import pairwise
from typing import Any

import pytest

from tests.problems.test_promises import drawn


def best_paths(given: Any) -> dict[str, tuple[Fraction, tuple[str, ...]]]:
    """The greatest return from every state and the states of that path, by going through all paths."""
    rewards = {edge[:2]: edge.reward for edge in given.edges}

    def paths(state: str) -> list[tuple[Fraction, tuple[str, ...]]]:
        if state == given.goal:
            return [(Fraction(0), (state,))]
        return [
            (rewards[state, after] + total, (state, *path))
            for after in given.onward[state]
            for total, path in paths(after)
        ]

    return {state: max(paths(state)) for state in given.onward}


@pytest.mark.parametrize(("level", "least"), [(1, 2), (2, 3), (3, 3)])
def test_an_optimal_path_has_tails_and_is_not_the_greedy_one(level: int, least: int) -> None:
    for given in drawn("principle-of-optimality", (level,)):
        _, path = best_paths(given)[given.start]
        assert len(path) - 1 >= least
        rewards = {edge[:2]: edge.reward for edge in given.edges}
        assert any(
            rewards[here, other] > rewards[here, after]
            for here, after in pairwise(path)
            for other in given.onward[here]
        )


def test_several_ways_lead_to_the_state_that_a_path_must_visit_beside_the_best_one() -> None:
    for given in drawn("principle-of-optimality", (3,)):
        _, path = best_paths(given)[given.start]
        assert given.through not in path

        def ways(state: str, given: Any = given) -> int:
            return state == given.through or sum(ways(after) for after in given.onward.get(state, ()))

        assert ways(given.start) > 1


def test_whether_two_present_states_matter_is_seen() -> None:
    for given in drawn("markov-property", (2, 3)):
        chances: dict[str, set[tuple[Fraction, ...]]] = {}
        for before, now in given.histories:
            weights = [row.weight for row in given.table if row[:2] == (before, now)]
            if not any(isinstance(weight, str) for weight in weights):
                chances.setdefault(now, set()).add(tuple(weight / sum(weights) for weight in weights))
        first, second = chances.values()
        assert len(first - second) + len(second - first) > 1


def test_sweeps_of_policy_evaluation_are_in_place_at_level_2_or_several() -> None:
    assert all(not given.in_place and given.sweeps == 1 for given in drawn("policy-evaluation", (1,)))
    assert all(given.in_place or given.sweeps == 2 for given in drawn("policy-evaluation", (2,)))


def test_the_inequality_of_the_improvement_theorem_fails_in_one_state_at_most() -> None:
    verdicts: Counter[bool] = Counter()
    for given in drawn("policy-improvement-theorem", (1, 2), 100):
        gaps = []
        for state, action in given.other.items():
            worth = sum(
                row.probability * (row.reward + given.gamma * given.values.get(row.next, 0))
                for row in given.mdp.outcomes[state, action]
            )
            gaps.append(worth - given.values[state])
        assert sum(gap < 0 for gap in gaps) <= 1
        verdicts[all(gap >= 0 for gap in gaps)] += 1
    assert 70 < verdicts[True] < 130


def test_the_reward_that_a_value_after_two_sweeps_shows_is_not_printed_elsewhere() -> None:
    sought = [given for given in drawn("value-iteration", (3,)) if hasattr(given, "outcome")]
    assert 30 < len(sought) < 50  # the others ask for a discount
    for given in sought:
        (state, value), row = next(iter(given.outcome.items())), given.row
        assert row.next not in given.mdp.terminal  # or γ and V₀ would play no part
        ways = [each for each in given.mdp.transitions if (each.state, each.next) == (state, row.state)]
        first = min((value - each.reward) / given.gamma for each in ways)  # all moves are certain
        reward = first - given.gamma * given.start[row.next]
        assert reward not in {each.reward for each in given.mdp.transitions if each is not row}


def test_traces_that_are_asked_for_in_a_letter_add_up() -> None:
    for given in drawn("eligibility-trace", (3,)):
        assert not given.replacing
        assert len(set(given.states)) < len(given.states)
