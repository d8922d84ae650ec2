"""Identities that hold between solutions, and what happens where there is none."""

from typing import Any

import pytest
import sympy
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

import rldrill
from asking import solved
from numbers_drawn import small
from rldrill.audit.checking import audit
from rldrill.problems.catalogue import families, family
from rldrill.problems.errors import FileError
from rldrill.solutions.drawing import draw
from rldrill.solutions.exact import NoSolution, to_sympy
from rldrill.solutions.formula.putting_in import evaluated
from rldrill.solutions.matrices import is_matrix, matrix
from rldrill.solutions.sheet.linear_methods import LQR_GAIN
from rldrill.solutions.vector import Vector
from rldrill.solutions.work import Step, Work

numbers = small(-5, 5, 4).map(str)


@pytest.mark.parametrize("name", families())
def test_the_audit_finds_nothing(name: str) -> None:
    for finding in audit([name], number=2, seed=1):
        assert finding.clean, finding.data()
        assert finding.made > 0 or finding.level == 3  # a letter that is found may leave no mistake to make


@pytest.mark.parametrize("name", families())
def test_every_step_is_worth_what_it_says(name: str) -> None:
    # Steps are written when somebody looks at them: what was put in must not have changed since.
    for level in family(name).levels:
        for seed in range(2):
            for line in draw(name, level, seed).lines:
                if isinstance(line, Step) and line.value is not None and not isinstance(line.value, tuple):
                    assert same(line.value, evaluated(line.put_in)), line.equation()


def same(value: Any, written_out: Any) -> bool:
    if isinstance(value, Vector):
        written_out = written_out or sympy.zeros(len(value.entries), 1)
        return bool(sympy.simplify(value.matrix() - written_out).is_zero_matrix)
    if is_matrix(value):
        written = sympy.Matrix(value.nrows(), value.ncols(), [to_sympy(x) for x in value.entries()])
        return bool(sympy.simplify(written - written_out).is_zero_matrix)
    return bool(sympy.simplify(to_sympy(value) - written_out) == 0)


@given(st.lists(numbers, min_size=2, max_size=6), st.sampled_from(["0", "1/2", "1"]))
@settings(deadline=None, max_examples=30)
def test_the_n_step_return_over_a_whole_episode_is_the_return(rewards: list[str], gamma: str) -> None:
    states = [*"abcdef"[: len(rewards)], "end"]
    n_step = solved(
        "n-step-return",
        trajectory={"states": states, "rewards": rewards, "terminal": ["end"]},
        values=dict.fromkeys(states[:-1], "7"), gamma=gamma, asked=[[0, len(rewards)]],
    )["a"]  # fmt: skip
    assert n_step == solved("return", rewards=rewards, gamma=gamma, time=0)["a"]


@given(numbers, numbers, numbers, st.sampled_from(["1/2", "9/10"]))
@settings(deadline=None, max_examples=30)
def test_a_td_step_with_alpha_1_is_the_one_step_return(reward: str, here: str, there: str, gamma: str) -> None:
    run = {"states": ["a", "b"], "rewards": [reward]}
    values = {"a": here, "b": there}
    after = solved("td-zero", trajectory=run, values=values, alpha=1, gamma=gamma)["a"]["a"]
    assert after == solved("n-step-return", trajectory=run, values=values, gamma=gamma, asked=[[0, 1]])["a"]


@given(numbers, numbers, numbers, st.sampled_from(["1/2", "9/10"]))
@settings(deadline=None, max_examples=30)
def test_sarsa_is_q_learning_where_there_is_no_choice(reward: str, here: str, there: str, gamma: str) -> None:
    run = {"states": ["a", "b", "a"], "actions": ["go", "go", "go"], "rewards": [reward, "2"]}
    values = {"a": {"go": here}, "b": {"go": there}}
    given_ = {"trajectory": run, "values": values, "alpha": "1/4", "gamma": gamma}
    assert solved("sarsa", **given_) == solved("q-learning", **given_)


def test_sarsa_needs_the_last_action_unless_the_run_ends() -> None:
    run = {"states": ["a", "b"], "actions": ["x"], "rewards": [1]}
    values = {"a": {"x": 2}, "b": {"y": 3}}
    with pytest.raises(FileError, match="needs the action taken in 'b'"):
        solved("sarsa", trajectory=run, values=values, alpha=1, gamma=1)
    ended = run | {"terminal": ["b"]}
    assert solved("sarsa", trajectory=ended, values={"a": {"x": 2}}, alpha=1, gamma=1)["a"] == {("a", "x"): 1}


def test_a_mistake_that_cannot_be_made_is_not_looked_for() -> None:
    # The action taken in b does not exist in a, so nobody can have taken its value there.
    run = {"states": ["a", "b"], "actions": ["x", "y"], "rewards": [1]}
    values = {"a": {"x": 2}, "b": {"y": 3, "z": 5}}
    given_ = {"trajectory": run, "values": values, "alpha": "1/2", "gamma": "1/2"}
    exercise = rldrill.read({"family": "sarsa", "given": given_})
    assert "state-for-next-state" not in [m.name for m, _ in exercise.solution.mistakes]


@given(st.integers(0, 10_000))
@settings(deadline=None, max_examples=20)
def test_a_policys_values_solve_its_equations(seed: int) -> None:
    solution = draw("policy-value", 2, seed)
    given_ = solution.problem.given
    if given_.average:
        return  # values of another kind
    values = solution.answers["a"] | {"": fmpq(0)} | dict.fromkeys(given_.mdp.terminal, fmpq(0))
    for state, value in solution.answers["a"].items():
        total = sum(
            given_.chances[state].get(row.action, 0) * row.probability
            * (row.reward + given_.gamma * _fraction(values[row.next]))
            for row in given_.mdp.transitions if row.state == state
        )  # fmt: skip
        assert total == _fraction(value)


@given(st.integers(0, 10_000))
@settings(deadline=None, max_examples=20)
def test_posteriors_sum_to_one(seed: int) -> None:
    for belief in draw("bayes-rule", 3, seed).answers.values():
        assert not isinstance(belief, dict) or sum(belief.values()) == 1


def _fraction(value: Any) -> Any:
    from fractions import Fraction

    return Fraction(int(value.numerator), int(value.denominator))


def test_a_value_that_does_not_exist_is_one_sentence() -> None:
    forever = {"transitions": [["a", "stay", "a", 1, 1]]}
    with pytest.raises(FileError, match="no answer: with γ = 1 the value of a is \\+∞"):
        solved("policy-value", mdp=forever, gamma=1)


def test_a_formula_that_divides_by_zero_is_named() -> None:
    zero = matrix([[fmpq(0)]])
    with pytest.raises(NoSolution, match="in the formula “LQR gain” it would divide by zero"):
        Work().step(LQR_GAIN, t=0, At={0: zero}, Bt={0: zero}, Rt={0: zero}, Pt={1: zero})


def test_a_measurement_that_cannot_happen_is_one_sentence() -> None:
    with pytest.raises(FileError, match="'z' is impossible under the belief"):
        solved("bayes-rule", prior={"a": 1, "b": 0}, likelihood={"z": {"a": 0, "b": 1}}, measurements=["z"])


def test_a_hundred_states_are_solved_exactly() -> None:
    rows = []
    for index in range(100):
        right = str(index + 1) if index < 99 else "end"
        rows += [[str(index), "go", right, "1/2", 1], [str(index), "go", str(max(0, index - 1)), "1/2", 0]]
    values = solved("policy-value", gamma="9/10", mdp={"transitions": rows, "terminal": ["end"]})["a"]
    for index in range(1, 99):
        expected = fmpq(1, 2) * (1 + fmpq(9, 10) * (values[str(index + 1)] + values[str(index - 1)]))
        assert values[str(index)] == expected


def test_what_somebody_brings_takes_one_draw() -> None:
    assert rldrill.read({"family": "return", "given": {"rewards": [1], "gamma": 1}}).solution.attempts == 1
