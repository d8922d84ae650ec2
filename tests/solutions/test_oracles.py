"""The independent solvers at the edges, where drawn problems seldom are; worked out by hand."""

from typing import Any

import numpy as np
import pytest

from rldrill.problems.catalogue import family
from rldrill.problems.spelling import Unreadable
from rldrill.solutions.answers.arithmetic import Arithmetic
from rldrill.solutions.answers.numbers import number
from rldrill.solutions.answers.source import clean
from rldrill.solutions.solution import solver


def oracle(name: str, **given: Any) -> list[Any]:
    found = family(name)
    return list(solver(found).oracle(found.read(given)))


def test_without_a_future_only_the_next_reward_counts() -> None:
    tail, whole = oracle("return-infinite", gamma=0, first=[4], repeated=[3, 5])
    assert (tail, whole) == (3, 4)


def test_an_accuracy_that_is_just_reached_is_reached() -> None:
    # ‖V₀ − V*‖ = 8, and after k sweeps 8·(1/2)ᵏ: 1 after 3 sweeps, 4 after one.
    answers = oracle("contraction", start={"s": 0}, optimum={"s": 8}, gamma="1/2", sweeps=1, accuracy=1)
    assert np.allclose([float(answer) for answer in answers], [8, 4, 3])


@pytest.mark.parametrize("text", ["1/(sqrt(2)+sqrt(3)-sqrt(5+2*sqrt(6)))", "1/(exp(1)-exp(1))", "1/(ln(4)-2*ln(2))"])
def test_what_cannot_be_told_from_zero_is_not_divided_by(text: str) -> None:
    with pytest.raises(Unreadable, match="zero"):
        number(clean(text), (), Arithmetic())


def test_what_is_close_to_1_is_divided_by() -> None:
    assert number(clean("1/(sqrt(2)-0.4142)"), (), Arithmetic()).echo == "1/(sqrt(2) - 0.4142)"


def test_the_average_reward_where_two_states_take_turns() -> None:
    # No power of the chain is the limit here, but their mean is: half of the steps begin in each, (4 + 1)/2 on average.
    mdp = {"transitions": [["a", "b", 1, 4], ["b", "a", 1, 1]]}
    shares, reward = oracle("policy-value", mdp=mdp, average=True)
    assert [*shares, reward] == pytest.approx([0.5, 0.5, 2.5])


@pytest.mark.parametrize(
    ("criterion", "given", "criteria", "winner"),
    [
        # A model that is certain of the data has the log-likelihood 0, and pays for its parameters only.
        ("AIC", {"sure": {"log_likelihood": 0, "k": 3}, "poor": {"log_likelihood": -4, "k": 0}}, [6, 8], "A"),
        (
            "AIC",
            {"sure": {"likelihood": 1, "k": 3}, "poor": {"likelihood": "1/2", "k": 1}},
            [6, 2 + 2 * np.log(2)],
            "B",
        ),
    ],
)
def test_criteria_of_fitted_models(criterion: str, given: Any, criteria: list[float], winner: str) -> None:
    found, best = oracle("bic", criterion=criterion, fitted=given)
    assert found == pytest.approx(criteria)
    assert best == winner
