"""Identities of Bayesian methods, and one sentence for what does not fit."""

from typing import Any

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

import rldrill
from rldrill.problems.errors import FileError
from rldrill.solutions.drawing import draw

quick = settings(deadline=None, max_examples=25)
seeds = st.integers(0, 10_000)


def solved(family: str, **given_: Any) -> Any:
    return rldrill.read({"family": family, "given": given_}).solve()


@pytest.mark.parametrize("name", ["bayes-predict", "bayes-filter"])
@given(seed=seeds, level=st.integers(1, 3))
@quick
def test_beliefs_sum_to_one(name: str, seed: int, level: int) -> None:
    for belief in draw(name, level, seed).answers.values():
        assert sum(belief.values()) == 1


@given(seeds)
@quick
def test_the_filter_over_a_run_is_the_joint_distribution_conditioned(seed: int) -> None:
    given_ = draw("bayes-filter", 3, seed).problem.given
    paths = {(state,): chance for state, chance in given_.belief.items()}
    for event in given_.run:
        paths = {
            (*path, after): chance
            * given_.motion[event.action][path[-1]].get(after, 0)
            * given_.likelihood[event.measurement][after]
            for path, chance in paths.items()
            for after in given_.belief
        }
    total = sum(paths.values())
    last = draw("bayes-filter", 3, seed).answers["c"]
    for state in given_.belief:
        share = sum(chance for path, chance in paths.items() if path[-1] == state) / total
        assert last[state] == fmpq(share.numerator, share.denominator)


@given(seeds)
@quick
def test_the_order_of_independent_measurements_does_not_matter(seed: int) -> None:
    given_ = draw("bayes-filter", 3, seed).problem.data()["given"]
    readings = [{"measurement": event["measurement"]} for event in given_["run"]]
    forth, back = (solved("bayes-filter", **given_ | {"run": run}) for run in (readings, readings[::-1]))
    assert forth["c"] == back["c"]


@given(seeds)
@quick
def test_a_filter_that_only_moves_predicts_and_one_that_only_measures_is_bayes_rule(seed: int) -> None:
    given_ = draw("bayes-filter", 3, seed).problem.data()["given"]
    moved = solved("bayes-filter", **given_ | {"run": [{"action": event["action"]} for event in given_["run"]]})
    actions = [event["action"] for event in given_["run"]]
    assert moved == solved("bayes-predict", belief=given_["belief"], motion=given_["motion"], actions=actions)
    readings = [event["measurement"] for event in given_["run"]]
    read = solved("bayes-filter", **given_ | {"run": [{"measurement": reading} for reading in readings]})
    assert read == solved("bayes-rule", prior=given_["belief"], likelihood=given_["likelihood"], measurements=readings)


MOTION = {"push": {"open": {"open": 1}, "closed": {"open": "4/5", "closed": "1/5"}}}
PREDICT: dict[str, Any] = {"belief": {"open": "1/2", "closed": "1/2"}, "motion": MOTION, "actions": ["push"]}
FILTER: dict[str, Any] = {"belief": PREDICT["belief"], "motion": MOTION, "run": [{"action": "push"}]}


@pytest.mark.parametrize(
    ("name", "given_", "fragment"),
    [
        ("bayes-predict", PREDICT | {"belief": {"open": 1, "closed": "1/2"}}, "belief: the probabilities sum to 3/2"),
        ("bayes-predict", PREDICT | {"actions": ["pull"]}, "an action is given for 'pull'"),
        ("bayes-predict", PREDICT | {"motion": {"push": {"open": {"open": 1}}}}, "'push' of 'closed' is missing"),
        (
            "bayes-predict",
            PREDICT | {"motion": {"push": MOTION["push"] | {"open": {"ajar": 1}}}},
            "motion of 'push' in 'open' is given for 'ajar'",
        ),
        (
            "bayes-predict",
            PREDICT | {"motion": {"push": MOTION["push"] | {"open": {"open": "p", "closed": "1/2"}}}},
            "motion of 'push' in 'open': the probabilities sum to 1/2 and what is left open",
        ),
        ("bayes-filter", FILTER | {"run": [{}]}, "neither an action nor a measurement"),
        ("bayes-filter", FILTER | {"run": [{"measurement": "light"}]}, "a measurement is given for 'light'"),
        ("bayes-filter", FILTER | {"likelihood": {"light": {"open": 1}}}, "'light' of 'closed' is missing"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_one_sentence(name: str, given_: dict[str, Any], fragment: str) -> None:
    with pytest.raises(FileError) as error:
        solved(name, **given_)
    assert fragment in str(error.value)
    assert "\n" not in str(error.value)


def test_a_reading_that_cannot_happen_is_one_sentence() -> None:
    blind = {"belief": {"open": 1, "closed": 0}, "likelihood": {"light": {"open": 0, "closed": 1}}}
    with pytest.raises(FileError, match="no answer"):
        solved("bayes-filter", **blind, run=[{"measurement": "light"}])
