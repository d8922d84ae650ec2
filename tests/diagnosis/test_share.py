"""What share of wrong answers is diagnosed rightly, on a small sample; ``measure.py`` measures all families."""

import importlib.util
import sys
from collections import Counter
from pathlib import Path

import pytest

from rldrill.solutions.drawing import draw

_HERE = Path(__file__).parent
FAMILIES = ("td-zero", "sarsa", "return", "bayes-rule", "q-learning", "expected-sarsa", "sample-average")
SEED = 73


@pytest.fixture(scope="module")
def measure():
    sys.path.insert(0, str(_HERE))
    try:
        spec = importlib.util.spec_from_file_location("measure", _HERE / "measure.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module
    finally:
        sys.path.remove(str(_HERE))


@pytest.fixture(scope="module")
def counted(measure) -> tuple[Counter[str], Counter[bool]]:
    verdicts: Counter[str] = Counter()
    accused: Counter[bool] = Counter()
    for name in FAMILIES:
        measured = measure.Measured(draw(name, 2, SEED), None)
        for error in measure.erroneous(measured.solution, SEED)[::3]:
            if said := measured.causes(error.part, error.text):
                verdicts[measured.verdict(error, said[0])] += 1
        accused.update(measure.random_verdicts(measured, show=False))
    return verdicts, accused


def test_most_wrong_answers_are_diagnosed_rightly(counted) -> None:
    verdicts, _ = counted
    assert verdicts.total() > 40
    assert verdicts["right"] >= 0.8 * verdicts.total()
    assert verdicts["wrong"] <= 0.03 * verdicts.total()


def test_numbers_from_nowhere_are_hardly_ever_accused(counted) -> None:
    _, accused = counted
    assert accused.total() > 20
    assert accused[True] <= 0.05 * accused.total()
