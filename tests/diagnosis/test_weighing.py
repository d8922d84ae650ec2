"""What speaks for chance, of an answer worked out by hand."""

from math import log

import pytest
from flint import fmpq

import rldrill
from rldrill.solutions.answers.judging import part_of, read_answer
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.diagnosis.clock import Clock
from rldrill.solutions.diagnosis.outcomes import Outcomes
from rldrill.solutions.diagnosis.search import Search
from rldrill.solutions.diagnosis.typed import Typed
from rldrill.solutions.diagnosis.weighing import Weighing

# V(cave) = 8, V(floor) = 10, α = 1/4, γ = 1/2: cave ← 8 + 1/4·(7 + 1/2·10 − 8) = 9, floor ← 10 + 1/4·(−3 + 1/2·6 − 10)
RUN = {
    "family": "td-zero",
    "given": {
        "trajectory": {"states": ["cave", "floor", "rim"], "rewards": [7, -3]},
        "values": {"cave": 8, "floor": 10, "rim": 6},
        "alpha": "1/4",
        "gamma": "1/2",
    },
}


def weighed(answer: str) -> Weighing:
    solution = rldrill.read(RUN).solution
    part = part_of(solution, "a")
    typed = Typed(part, read_answer(solution, part, answer), answer_kind(part.kind).cells(solution.answers["a"]))
    outcomes = Outcomes(Search(solution, {}), part, typed.key)
    outcomes.grow(Clock())
    return Weighing(outcomes, typed, outcomes.giving(typed))


def test_what_is_seen_of_several_wrong_numbers_is_a_mean() -> None:
    seen = weighed("cave: -9, floor: 15").chance  # 9 and 15/2 are right: one sign turned, the other number doubled
    assert (seen["several wrong"], seen["some right"], seen["share wrong"]) == (1, 0, 1)
    assert seen["other sign"] == 1 / 2
    assert seen["way from the key"] == pytest.approx(log(2) / 2)
    assert (seen["fits the key"], seen["far from the key"]) == (1, 0)


def test_one_wrong_number_among_right_ones() -> None:
    seen = weighed("cave: 90, floor: 15/2").chance
    assert (seen["one of several wrong"], seen["some right"], seen["share wrong"]) == (1, 1, 1 / 2)
    assert seen["way from the key"] == pytest.approx(log(10))
    assert seen["far from the key"] == pytest.approx(log(10) - 1)
    assert seen["small"] == 0


def test_two_slips_at_once_are_no_likelier_than_one_of_them() -> None:
    solution = rldrill.read(RUN).solution
    outcomes = Outcomes(Search(solution, {}), part_of(solution, "a"), {"cave": fmpq(9), "floor": fmpq(15, 2)})
    outcomes.grow(Clock())
    outcomes.grow_pairs(Clock())
    pairs = outcomes.double.every
    assert pairs
    for pair in pairs:
        assert pair.cause.then is not None
        assert 0 < pair.cause.weight <= pair.cause.then.weight
