"""Going on from somebody's own answers, whatever they are."""

from fractions import Fraction
from typing import Any

import pytest
import sympy
from flint import fmpq

import rldrill
from rldrill.problems.catalogue import families
from rldrill.problems.parts import Matrix, Number, Numbers, Part, Values
from rldrill.solutions.answers.judging import Outcome, Verdict
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.value import Value

ODD = (
    fmpq(0), fmpq(1), fmpq(-7, 3), fmpq(10**9), sympy.sqrt(2), -1 / sympy.sqrt(3), sympy.log(2), sympy.E**2, sympy.pi,
)  # fmt: skip


def with_numbers(part: Part, answer: Any, odd: Value) -> Any:
    """An answer of the same shape in which every number is the odd one; what holds none stays."""
    kind = answer_kind(part.kind)
    if not isinstance(part.kind, Number | Numbers | Values | Matrix):
        return answer
    return kind.value(dict.fromkeys(kind.cells(answer), odd))


@pytest.mark.parametrize("level", [2, 3])
@pytest.mark.parametrize("name", families())
def test_any_number_may_be_gone_on_from(name: str, level: int) -> None:
    """Rightly or with a mistake, parts are answered as far as something follows; the diagnosis says no less."""
    exercise = rldrill.draw(name, level, 907)
    solution, labels = exercise.solution, list(exercise.solution.answers)
    wrong = Verdict(Outcome.WRONG, "Not right.")
    for odd in ODD:
        *before, last = solution.problem.parts
        earlier = {part.label: with_numbers(part, solution.answers[part.label], odd) for part in before}
        if not earlier:
            continue
        followed = solution.following(earlier)
        assert list(followed) == labels[: len(followed)]
        assert all(list(answers) == labels for _, answers in solution.mistaken(earlier))
        if len(followed) < len(labels):
            text = answer_kind(last.kind).write(solution.answers[last.label])
            assert exercise.diagnosing.diagnose(last.label, text, wrong, earlier, seconds=0).sentence


@pytest.mark.parametrize(
    ("given", "answers"),
    [
        # μ̂ = 6 and squares 1 + 1 + 4 = 6; with 7 for them σ̂² = 7/3, and s² = 7/2.
        ({"sample": {"values": [5, 5, 8]}}, {"a": "6", "b": "7/3", "c": "7/2"}),
        # S_xy = 2 + 3 = 5 and S_xx = 2; with 6 for S_xy θ₁ = 3, θ₀ = 2 − 3; with the prior 6/(2 + 1) and 2 − 2.
        (
            {"line": {"points": [[0, 0], [1, 1], [2, 5]], "prior": {"variance": 1, "noise": 1}}},
            {"a": "3, -1", "b": "2, 0"},
        ),
    ],
)
def test_a_sum_that_two_parts_share_costs_once(given: dict[str, Any], answers: dict[str, str]) -> None:
    graded = rldrill.read({"family": "model-fitting", "given": given}).grade(answers)
    assert graded[list(answers)[-1]].outcome is Outcome.FOLLOW_THROUGH


def test_a_discount_that_was_found_can_be_forgotten_afterwards() -> None:
    # 1 + 4γ = 3, so γ = 1/2, and μ₂ = 2 + 6/2 = 5; without γ the first equation says nothing, and μ₂ = 2 + 6 = 8.
    given = {"trajectories": [["a", "b"]], "features": {"a": [1, 2], "b": [4, 6]}, "gamma": "gamma", "estimate": 3}
    exercise = rldrill.read({"family": "feature-expectations", "given": given})
    assert exercise.answers() == {"a": Fraction(1, 2), "b": 5}
    for earlier in ({"a": "1/2"}, {}):
        assert exercise.diagnose("8", "b", earlier).sentence == "The features at time t count with γᵗ."


@pytest.mark.parametrize(
    ("family", "given", "own", "stated", "follows"),
    [
        # 3/4·q = 1/2, so q = 2/3. With 1/3: 1/2·1/3 from the belief that is known, 3/4·1/3·1/3 from the start.
        (
            "bayes-predict",
            {
                "belief": {"a": "3/4", "b": "1/4"},
                "motion": {"go": {"a": {"a": "q", "b": "1-q"}, "b": {"b": "1"}}},
                "actions": ["go", "go"],
                "outcome": {"state": "a", "probability": "1/2"},
            },
            "1/3",
            "a: 1/6, b: 5/6",
            "a: 1/12, b: 11/12",
        ),
        # q/(q + 1/4) = 2/3, so q = 1/2. With 3/4: 2/3·3/4 to 1/3·1/4 from the belief that is known; 9/16 to 1/16.
        (
            "bayes-rule",
            {
                "prior": {"h": "1/2", "k": "1/2"},
                "likelihood": {"z": {"h": "q", "k": "1/4"}},
                "measurements": ["z", "z"],
                "outcome": {"state": "h", "probability": "2/3"},
            },
            "3/4",
            "h: 6/7, k: 1/7",
            "h: 9/10, k: 1/10",
        ),
        (
            "bayes-filter",
            {
                "belief": {"h": "1/2", "k": "1/2"},
                "likelihood": {"z": {"h": "q", "k": "1/4"}},
                "motion": {},
                "run": [{"measurement": "z"}, {"measurement": "z"}],
                "outcome": {"state": "h", "probability": "2/3"},
            },
            "3/4",
            "h: 6/7, k: 1/7",
            "h: 9/10, k: 1/10",
        ),
        # 2 + γ·3/(1 − γ) = 5, so γ = 1/2. With 3/4: (5 − 2)/(3/4), and 3/(1 − 3/4).
        ("return-infinite", {"known": 5, "first": [2], "repeated": [3], "gamma": "gamma"}, "3/4", "4", "12"),
        # γλ = 1/4, so λ = 1/2. With 1: 1/4·1/2 from the trace that is known, 1/2·1/2 from the start; b: 1/2 + 1.
        (
            "eligibility-trace",
            {"known": "1/4", "states": ["a", "b", "b"], "gamma": "1/2", "lam": "lambda", "asked": [1, 2]},
            "1",
            "a: 1/8, b: 3/2",
            "a: 1/4, b: 3/2",
        ),
    ],
)
def test_with_an_own_letter_one_goes_on_from_what_is_stated_or_from_the_letter(
    family: str, given: dict[str, Any], own: str, stated: str, follows: str
) -> None:
    exercise = rldrill.read({"family": family, "given": given})
    for typed in (stated, follows):
        assert exercise.grade({"a": own, "b": typed})["b"].outcome is Outcome.FOLLOW_THROUGH
        assert not exercise.check(typed, "b").accepted
