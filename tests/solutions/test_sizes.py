"""Large problems: what is solved in seconds, what is refused, and how long workings and numbers are shortened."""

from fractions import Fraction
from typing import Any

import pytest
from flint import fmpq

import rldrill
from asking import solved
from rldrill.problems.errors import FileError
from rldrill.render.mathematics.unicode import unicode
from rldrill.solutions.exact import decimal
from rldrill.solutions.formula.typesetting import typeset_answer, typeset_value
from rldrill.solutions.work import Step


def ring(size: int, **more: Any) -> dict[str, Any]:
    """From every state on to the next, or at once to the end, with the same probability, for 1."""
    rows = []
    for state in range(size):
        rows += [
            [f"s{state}", "go", f"s{(state + 1) % size}", "1/2", 1],
            [f"s{state}", "go", "end", "1/2", 1],
        ]
    return {"mdp": {"transitions": rows, "terminal": ["end"]}, "gamma": 1, **more}


def test_a_thousand_states() -> None:
    # Each step ends it with probability 1/2, so there are 2 steps on average, and each earns 1.
    assert set(solved("policy-value", **ring(1000))["a"].values()) == {2}


def test_more_states_are_refused_with_the_limit() -> None:
    with pytest.raises(FileError, match="there are 1025 states; at most 1024 can be solved exactly"):
        solved("policy-value", **ring(1025))


def test_sweeps_over_many_transitions_are_refused_with_the_number_that_is_possible() -> None:
    # 600 transitions: 500 sweeps are 300,000 outcomes.
    with pytest.raises(FileError, match="501 sweeps over 600 transitions take too long; at most 500 are"):
        solved("value-iteration", **ring(300, sweeps=501))


def test_long_workings_are_abridged_and_say_so() -> None:
    exercise = rldrill.read({"family": "policy-value", "given": ring(300)})
    assert sum(isinstance(line, Step) for line in exercise.solution.lines) == 300
    assert "… And so on: 200 more steps in the same way." in str(exercise.working())
    assert len(exercise.data()["steps"]) == 100
    swept = rldrill.read({"family": "value-iteration", "given": ring(2, sweeps=400)})
    text = str(swept.working())
    assert "Sweep 1:" in text
    assert "Sweep 200:" not in text
    assert "Sweep 400:" in text
    assert "more steps in the same way" in text


def hypotheses(count: int) -> dict[str, Any]:
    """Equally probable at first; the reading is twice as probable under the first of them as under the others."""
    names = [f"h{number}" for number in range(count)]
    likely = {name: "1/2" if name == "h0" else "1/4" for name in names}
    return {"prior": dict.fromkeys(names, f"1/{count}"), "likelihood": {"hit": likely}, "measurements": ["hit"]}


def with_miss(given: dict[str, Any]) -> dict[str, Any]:
    hit = given["likelihood"]["hit"]
    given["likelihood"]["miss"] = {name: str(1 - Fraction(chance)) for name, chance in hit.items()}
    return given


@pytest.mark.parametrize("count", [24, 25, 2000])
def test_many_hypotheses(count: int) -> None:
    # 2/(2 + n − 1) for the first, 1/(n + 1) for each other.
    exercise = rldrill.read({"family": "bayes-rule", "given": with_miss(hypotheses(count))})
    posterior = exercise.solve()["a"]
    assert posterior["h0"] == fmpq(2, count + 1)
    assert posterior["h1"] == fmpq(1, count + 1)
    assert len(str(exercise.working())) < 300 * count + 20_000


def test_a_long_sum_is_written_once_with_its_first_terms_and_its_last() -> None:
    exercise = rldrill.read({"family": "bayes-rule", "given": with_miss(hypotheses(40))})
    sums = [step["put_in"] for step in exercise.data()["steps"] if "…" in step["put_in"]]
    assert sums == []  # the rule itself divides by the value of the sum
    assert "1/2·1/40 + 1/4·1/40 + 1/4·1/40 + … + 1/4·1/40" in str(exercise.working())
    mistakes = {mistake.name: answers["a"] for mistake, answers in exercise.solution.mistakes}
    assert mistakes["not-normalised"]["h1"] == fmpq(1, 160)


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (fmpq(10**50, 3 * 10**50 + 1), "0.333333333333…"),
        (fmpq(-(22 * 10**50), 7 * 10**50 + 1), "−3.14285714285…"),
        (fmpq(10**50 + 1, 10**53), "0.00100000000000…"),
        (fmpq(2 * 10**60 + 1, 3), "6.66666666666…·10⁵⁹"),
        (fmpq(1, 3 * 10**60), "3.33333333333…·10⁻⁶¹"),
        (fmpq(10**39, 7), f"{10**39}/7"),
        (fmpq(10**40), f"{10**40}"),
        (fmpq(10**40 + 1), "1.00000000000…·10⁴⁰"),
    ],
)
def test_long_numbers_of_workings_are_cut_off(value: fmpq, shown: str) -> None:
    assert unicode(typeset_value(value)) == shown
    assert unicode(typeset_answer(value)) == str(value).replace("-", "−")


def test_long_numbers_are_stored_whole_and_cut_off_in_the_working_and_endless_ones_are_refused() -> None:
    third = [
        ["a", "x", "a", "1/3", 1],
        ["a", "x", "b", "2/3", 2],
        ["b", "x", "a", "3/7", -1],
        ["b", "x", "b", "4/7", 1],
    ]
    given = {"mdp": {"transitions": third}, "gamma": "997/1000", "sweeps": 250}
    exercise = rldrill.read({"family": "value-iteration", "given": given})
    exact = exercise.data()["parts"][0]["answer"]["exact"]["a"]
    assert len(exact) > 1000
    assert len(str(exercise.working())) < 100_000
    with pytest.raises(rldrill.UserError, match="numbers of more than 2000 digits, the most that are written; give"):
        rldrill.read({"family": "value-iteration", "given": given | {"sweeps": 1000}})
    assert decimal(fmpq(10) ** 400, 3) == "1.00e+400"


def test_long_polynomials_are_refused_with_the_limit() -> None:
    # R_t is 1 + γ + … + γ^(T − t − 1).
    assert "γ⁶²" in str(rldrill.read({"family": "return", "given": {"rewards": [1] * 64, "gamma": "gamma"}}).working())
    with pytest.raises(rldrill.UserError, match="polynomials of more than 64 terms, the most that are written"):
        rldrill.read({"family": "return", "given": {"rewards": [1] * 65, "gamma": "gamma"}})


def test_a_root_of_a_number_that_nobody_writes_is_refused_before_it_is_drawn() -> None:
    points = [[f"{10**39 + (7919 * row + 104729 * column) ** 6}" for column in range(20)] for row in range(10)]
    given = {"expert": points[0], "first": points[1], "policies": points[2:]}
    with pytest.raises(rldrill.UserError, match="numbers of more than 2000 digits"):
        rldrill.read({"family": "apprenticeship", "given": given})


def test_several_letters_are_bounded_too() -> None:
    """Every state goes on to one of two others with a chance of its own: each more multiplies what is written."""
    states = "abcdefgh"
    rows = [
        [state, action, states[(index + step) % 8], 1, index]
        for index, state in enumerate(states)
        for action, step in (("go", 1), ("run", 2))
    ]
    letters = ("p", "q", "x", "w", "rho", "beta", "alpha", "lambda")
    policy = {state: {"go": each, "run": f"1-{each}"} for state, each in zip(states, letters, strict=True)}
    given = {"mdp": {"transitions": rows}, "policy": policy, "gamma": "gamma"}
    with pytest.raises(rldrill.UserError, match="polynomials of more than 64 terms"):
        rldrill.read({"family": "policy-value", "given": given})
