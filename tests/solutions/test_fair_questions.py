"""What an examiner holds against questions and workings, over many draws: one test for each kind."""

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from itertools import accumulate

import pytest

import rldrill
from rldrill.problems.parts import Choice, Policy, YesNo
from rldrill.problems.temporal_difference.monte_carlo import OfStates
from rldrill.solutions.drawing import draw
from rldrill.solutions.effort import points
from rldrill.solutions.solution import Solution
from rldrill.solutions.work import Note


def drawn(name: str, level: int, count: int = 30) -> Iterator[Solution]:
    return (draw(name, level, seed) for seed in range(count))


def notes(solution: Solution) -> str:
    return " ".join(line.text for line in solution.work.lines if isinstance(line, Note))


def of_two(kind: object) -> bool:
    """Whether a coin decides it."""
    match kind:
        case YesNo():
            return True
        case Choice():
            return len(kind.options) == 2
        case Policy():
            return len(kind.actions) == 1 and len(next(iter(kind.actions.values()))) == 2
    return False


@pytest.mark.parametrize("level", [2, 3])
@pytest.mark.parametrize("name", ["return", "value-iteration", "bandit", "markov-property", "policy-iteration"])
def test_what_a_coin_decides_earns_one_point(name: str, level: int) -> None:
    for solution in drawn(name, level):
        earned = points(solution)
        assert all(earned[part.label] == 1 for part in solution.problem.parts if of_two(part.kind))


def test_where_the_history_matters_is_asked_once() -> None:
    for level in (1, 2, 3):
        for solution in drawn("markov-property", level):
            kinds = [type(part.kind) for part in solution.problem.parts]
            assert kinds.count(YesNo) + kinds.count(Choice) == 1


def test_sweeps_are_counted_without_logarithms() -> None:
    for level in (2, 3):
        for solution in drawn("contraction", level):
            *_, sweeps = solution.answers.values()
            assert 4 <= sweeps <= 6
            assert "Logarithms" not in notes(solution)


def test_no_two_states_are_worth_the_same_where_one_might_be_taken_for_the_other() -> None:
    for name, level in (("lambda-return", 2), ("td-lambda-forward", 2), ("td-lambda-backward", 2), ("td-zero", 2)):
        for solution in drawn(name, level):
            values = [*solution.problem.given.values.values()]
            assert len(set(values)) == len(values)


def test_a_visit_that_makes_no_update_is_explained() -> None:
    skipped = 0
    for solution in drawn("monte-carlo", 2, 40):
        given = solution.problem.given
        assert isinstance(given, OfStates)
        for time in set(range(len(given.occasions))) - {*given.counted}:
            assert f"$t = {time}$ makes no update: the first visit to {given.occasions[time]}" in notes(solution)
            skipped += 1
    assert skipped


def test_an_expected_return_adds_up_five_episodes_at_most() -> None:
    for level in (1, 2, 3):
        for solution in drawn("expected-return", level):
            assert len(list(solution.problem.given.episodes())) <= 5


def test_a_long_sum_is_worked_out_term_by_term() -> None:
    # R₀ = 3 + 1/2·6 + 1/4·7 + 1/8·(−3) = 3 + 3 + 7/4 − 3/8.
    given = {"rewards": [3, 6, 7, -3], "gamma": "1/2", "time": 0}
    told = str(rldrill.read({"family": "return", "given": given}).working())
    assert "3 + 3 + 7/4 − 3/8" in told


def test_rows_of_one_table_have_their_actions_in_one_order() -> None:
    for solution in drawn("importance-sampling", 2):
        orders = {tuple(row) for row in solution.problem.given.target.values()}
        assert len(orders) == 1


def test_improvement_ends_in_the_policy_that_it_gives() -> None:
    for solution in drawn("policy-iteration", 1):
        best = solution.answers["b"]
        told = " and ".join(f"{actions[0]} in {state}" for state, actions in best.items())
        assert f"So $π_{{1}}$ is {told}." in notes(solution)


def test_exchanging_the_tables_of_double_q_learning_shows_in_every_draw() -> None:
    for level in (1, 2, 3):
        for solution in drawn("double-q-learning", level):
            assert "roles-exchanged" in {mistake.name for mistake, _ in solution.mistakes}


def test_every_link_turns() -> None:
    for level in (1, 2, 3):
        for solution in drawn("jacobian", level):
            assert all(accumulate(solution.problem.given.rates or ()))


def test_the_best_way_at_once_is_one_way() -> None:
    for level in (1, 2, 3):
        for solution in drawn("principle-of-optimality", level):
            rewards: dict[str, list[Fraction]] = {}
            for edge in solution.problem.given.edges:
                rewards.setdefault(edge.state, []).append(edge.reward)
            assert all(row.count(max(row)) == 1 for row in rewards.values())


def _indexed(solution: Solution) -> list[object]:
    constants = solution.problem.given.constants.items()
    return [(name.partition("_")[0], value) for name, value in constants]


def _steps(solution: Solution) -> list[object]:
    given = solution.problem.given
    found = [solution.answers["b"]] if given.after is not None else []
    return [given.alpha, *([given.beta] if given.beta is not None else found)]


def _costs(solution: Solution) -> list[object]:
    given = solution.problem.given
    return [given.Q[0], given.Q_T or "the same at all times"]


#: The numbers of a problem of which none may be another one.
DIFFERENT: dict[tuple[str, int], Callable[[Solution], Sequence[object]]] = {
    ("lqr-gain", 1): lambda solution: [solution.problem.given.R[0][0], -solution.problem.given.P[0][0]],
    ("lqr-backward", 3): _costs,
    ("linearise", 2): _indexed,
    ("linearise-affine", 2): _indexed,
    ("q-learning", 3): lambda solution: [max(row.values()) for row in solution.problem.given.values.values()],
    ("reinforce", 2): lambda solution: solution.answers["a"],
    ("maml-step", 3): _steps,
    ("actor-critic", 1): lambda solution: [solution.problem.given.beta, 1],
    ("policy-action-value", 3): lambda solution: [*solution.answers["a"].values(), 0],
}


@pytest.mark.parametrize(("name", "level"), DIFFERENT)
def test_numbers_whose_mix_up_would_not_show_are_not_the_same(name: str, level: int) -> None:
    for solution in drawn(name, level):
        numbers = [*map(str, DIFFERENT[name, level](solution))]
        assert len(set(numbers)) == len(numbers)


@pytest.mark.parametrize("level", [1, 2])
def test_what_is_asked_tells_two_slips_apart(level: int) -> None:
    for seed in range(25):
        sarsa = draw("sarsa", level, seed).problem.given
        run = sarsa.trajectory
        for state, action in zip(run.states[1:], run.actions[1:], strict=False):
            row = sarsa.values[state]
            assert -row[action] != max(row.values())  # a lost sign, and Q-learning's maximum
        assert draw("rbf", level, seed).problem.given.sigma != 2  # 2σ and σ²
        tasks = draw("maml-step", level, seed).problem.given.tasks
        assert {task.curvature for task in tasks} != {2}  # c left out, and the 2 of the power
