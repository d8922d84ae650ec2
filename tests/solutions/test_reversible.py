"""Questions the other way round: the letter that is found makes what comes out what is known."""

from fractions import Fraction
from typing import Any

import pytest
from flint import fmpq

import rldrill
from asking import solved
from rldrill.problems.errors import FileError
from rldrill.problems.exact import Parameter, shown
from rldrill.problems.family import Problem
from rldrill.solutions.answers.judging import Outcome
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.drawing import draw
from rldrill.solutions.exact import NoSolution
from rldrill.solutions.reversible import with_letter
from rldrill.solutions.solution import solve

RUN = {"states": ["a", "b", "end"], "rewards": [2, 8], "terminal": ["end"]}


def test_a_step_size_from_one_value_gives_the_other() -> None:
    # V(a) ← 0 + α(2 + 1/2·4 − 0) = 4α = 1, so α = 1/4; then V(b) ← 4 + 1/4·(8 − 4) = 5.
    known = {"trajectory": RUN, "values": {"a": 0, "b": 4}, "gamma": "1/2", "alpha": "alpha", "known": 1}
    assert solved("td-zero", **known) == {"a": fmpq(1, 4), "b": {"b": 5}}


def test_a_start_value_from_the_value_after_the_run() -> None:
    # V(a) ← 0 + 1/2·(2 + 1/2·x − 0) = 1 + x/4 = 2, so x = 4; then V(b) ← 4 + 1/2·(8 − 4) = 6.
    known = {"trajectory": RUN, "values": {"a": 0, "b": "x"}, "gamma": "1/2", "alpha": "1/2", "known": 2}
    assert solved("td-zero", **known) == {"a": 4, "b": {"b": 6}}


def test_lambda_from_the_lambda_return() -> None:
    # R₀⁽¹⁾ = 2 + 1/2·4 = 4 and R₀ = 2 + 1/2·8 = 6, so (1 − λ)·4 + λ·6 = 4 + 2λ = 5 and λ = 1/2.
    known = {"trajectory": RUN, "values": {"a": 0, "b": 4}, "gamma": "1/2", "lam": "lambda", "known": 5}
    assert solved("lambda-return", **known) == {"a": fmpq(1, 2)}


def test_a_discount_from_a_return_without_an_end() -> None:
    # 3 + γ·2/(1 − γ) = 5 where 2γ = 2(1 − γ): γ = 1/2; then R₁ = 2/(1 − 1/2) = 4.
    assert solved("return-infinite", first=[3], repeated=[2], gamma="gamma", known=5) == {"a": fmpq(1, 2), "b": 4}


def test_a_reward_from_a_return_without_an_end() -> None:
    # 2 + 2/3·(−3) + 4/9·y = 16/3, so R₂ = y = 12; then (8 + 2/3·x)/(1 − 4/9) = 12, 8 + 2/3·x = 20/3, x = −2.
    known = {"first": [2, -3], "repeated": [8, "x"], "gamma": "2/3", "known": "16/3"}
    assert solved("return-infinite", **known) == {"a": 12, "b": -2}
    # R₁ = 2/(1 − 1/2) = 4; then x + 1/2·4 = 5.
    assert solved("return-infinite", first=["x"], repeated=[2], gamma="1/2", known=5) == {"a": 4, "b": 3}


def test_two_episodes_are_equally_good_at_one_discount() -> None:
    # 4 + 2γ = 2 + 6γ at γ = 1/2; beyond it the larger later reward counts more: the second.
    assert solved("return", rewards=[4, 2], others=[2, 6], gamma="gamma") == {"a": fmpq(1, 2), "b": "B"}


def test_a_missing_count_is_in_proportion() -> None:
    # After (a, b): 6 of 10. After (c, b): x of x + 2, so x = 3. In d it is 1 of 2 after a, but 1 of 3 after c.
    table = [["a", "b", "p", 6], ["a", "b", "q", 4], ["c", "b", "p", "x"], ["c", "b", "q", 2],
             ["a", "d", "p", 1], ["a", "d", "q", 1], ["c", "d", "p", 1], ["c", "d", "q", 2]]  # fmt: skip
    answers = solved("markov-property", table=table, asked="p")
    assert answers["a"] == 3
    assert answers["b"]["c", "b"] == fmpq(3, 5)
    assert answers["c"] is False
    # With somebody's own x = 1/2 it is 1/2 of 5/2, so 1/5 after (c, b).
    exercise = rldrill.read({"family": "markov-property", "given": {"table": table, "asked": "p"}})
    graded = exercise.grade({"a": "1/2", "b": "3/5, 1/5, 1/2, 1/3"})
    assert graded.parts[1].outcome is Outcome.FOLLOW_THROUGH


REVERSIBLE = (
    "return", "return-infinite", "expected-return", "td-zero", "monte-carlo", "n-step-return", "lambda-return",
    "td-lambda-forward", "td-lambda-backward", "eligibility-trace", "sample-average", "backup-diagram-value",
)  # fmt: skip


@pytest.mark.parametrize("family", REVERSIBLE)
def test_what_is_found_gives_what_is_known(family: str) -> None:
    found = 0
    for seed in range(40):
        solution = draw(family, 3, seed)
        given: Any = solution.problem.given
        if getattr(given, "known", None) is None:
            continue
        asked = f"What is ${shown(Parameter(given.letter))}$?"
        letter = solution.answers[next(part.label for part in solution.problem.parts if part.ask.endswith(asked))]
        forward = solve(Problem(solution.problem.family, with_letter(given, Fraction(int(letter.p), int(letter.q)))))
        numbers = [
            number
            for part in forward.problem.parts
            for number in answer_kind(part.kind).cells(forward.answers[part.label]).values()
        ]
        assert fmpq(*given.known.as_integer_ratio()) in numbers, solution.problem.identity
        found += 1
    assert found


@pytest.mark.parametrize(
    ("family", "given"),
    [
        ("return", {"rewards": [1, 2], "gamma": "1/2", "known": 2}),
        ("td-zero", {"trajectory": RUN, "values": {"a": 0, "b": 4}, "gamma": 1, "alpha": "1/2", "known": 2}),
        ("eligibility-trace", {"states": ["a"], "gamma": "1/2", "lam": "1/2", "asked": [0], "known": 1}),
    ],
)
def test_what_is_known_needs_a_letter_to_be_found(family: str, given: dict[str, Any]) -> None:
    with pytest.raises(FileError, match="known: leave exactly one parameter open"):
        solved(family, **given)


@pytest.mark.parametrize("name", ["monte-carlo", "td-zero", "td-lambda-forward", "td-lambda-backward", "return"])
def test_what_is_asked_after_the_letter_depends_on_it(name: str) -> None:
    drawn = [draw(name, 3, seed).problem for seed in range(8)]
    for problem in drawn:
        known = getattr(problem.given, "known", None)
        if known is None or len(problem.parts) == 1:
            continue
        right = solve(problem).answers
        other = problem.given.model_copy(update={"known": known + Fraction(1, 7)})
        try:
            changed = solve(Problem(problem.family, other)).answers
        except NoSolution:
            continue
        assert [label for label in right if changed[label] == right[label]] == [], problem.identity
