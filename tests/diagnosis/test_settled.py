"""Nobody who had an earlier part right is told of a mistake that would have spoilt it."""

from fractions import Fraction
from pathlib import Path

import pytest

import rldrill
from rldrill.grading.verification import verify
from rldrill.solutions.answers.judging import Outcome

# δ = 1 + 1·2 − 10 = −7. The trace of (rim, drive) is 1·1/2·1 = 1/2, and Q = 8 + 1/4·(−7)·1/2 = 57/8. Whoever lets it
# decay by γ alone has the trace 1 and 8 − 7/4 = 25/4; so has whoever has the right trace and leaves it out.
TRACES = {
    "family": "sarsa-lambda",
    "given": {
        "trajectory": {"states": ["floor", "rim"], "actions": ["climb", "climb"], "rewards": [1]},
        "values": {"rim": {"drive": 8, "climb": 2}, "floor": {"drive": 2, "climb": 10}},
        "alpha": "1/4",
        "gamma": 1,
        "lam": "1/2",
        "traces": {"rim": {"drive": 1, "climb": 0}, "floor": {"drive": 0, "climb": 0}},
    },
}
WRONG = "33/4, 25/4"
DECAY = "Traces decay by the product γλ"

# R₀ = 3 + 5 = 8 and R₁ = 5; V(cave) ← 4 + 1/2·(8 − 4) = 6, then 6 + 1/2·(5 − 6) = 11/2. With 7 for R₀ it is 21/4.
RETURNS = {
    "family": "monte-carlo",
    "given": {
        "trajectory": {"states": ["cave", "cave", "end"], "rewards": [3, 5], "terminal": ["end"]},
        "values": {"cave": 4},
        "alpha": "1/2",
        "gamma": 1,
        "visits": "every",
    },
}


def test_a_typical_mistake_is_denied_by_an_earlier_right_answer() -> None:
    exercise = rldrill.read(TRACES)
    assert exercise.check(WRONG, "b").says.startswith(DECAY)
    assert exercise.grade({"a": "1, 1", "b": WRONG})["b"].outcome is Outcome.FOLLOW_THROUGH
    verdict = exercise.grade({"a": "1, 1/2", "b": WRONG})["b"].verdict
    assert verdict is not None
    assert (verdict.outcome, verdict.misconceptions) == (Outcome.WRONG, ())
    assert "the factor e(s, a) is missing" in exercise.diagnose(WRONG, "b", {"a": "1, 1/2"}).sentence


def test_so_it_is_in_a_file_of_answers(tmp_path: Path) -> None:
    exercise = rldrill.draw("sarsa-lambda", 1, 3135325)  # these very numbers
    for earlier, says in (("1, 1/2", "the factor e(s, a) is missing"), ("1, 2", DECAY)):
        path = tmp_path / "answers.toml"
        path.write_text(f'[answers."{exercise.id}"]\na = "{earlier}"\nb = "{WRONG}"\n')
        _, judged = verify([path]).parts
        assert says in judged.judged.reason


def test_a_slip_in_an_earlier_part_is_denied_by_its_right_answer() -> None:
    exercise = rldrill.read(RETURNS)
    slip = "9 for 8 in R₀"  # V(cave) ← 4 + 1/2·(9 − 4) = 13/2, then 13/2 + 1/2·(5 − 13/2) = 23/4
    assert slip in exercise.diagnose("23/4", "b").sentence
    assert slip not in exercise.diagnose("23/4", "b", {"a": "8, 5"}).sentence


MEASURED = {
    "likelihood": {
        "x": {"sound": "3/4", "worn": "1/4"},
        "y": {"sound": "1/8", "worn": "1/2"},
        "z": {"sound": "1/8", "worn": "1/4"},
    },
    "measurements": ["x", "y"],
}


def test_the_order_of_measurements_is_denied_by_the_belief_after_the_first() -> None:
    # After x 3 to 1, after y 3/4·1/8 to 1/4·1/2, so 3/7; with x once more it is 9 to 1, as with "x, y" read as "y, x"
    # by somebody who goes on from 3 to 1.
    given = {"prior": {"sound": "1/2", "worn": "1/2"}, **MEASURED}
    exercise = rldrill.read({"family": "bayes-rule", "given": given})
    said = exercise.diagnose("9/10, 1/10", "b", {"a": "3/4, 1/4"}).sentence
    assert "the second of the measurements is taken over from the one before" in said
    assert "order" not in said


#: μ̄ = 2 − 2 = 0, Σ̄ = 7 + 5 = 12, K = 12/18, μ = 2/3·7 = 14/3, Σ = 1/3·12 = 4.
ONE_STEP = {
    "family": "kalman-filter",
    "given": {
        "mean": [[2]],
        "covariance": [[7]],
        "process": [[5]],
        "sensor": [[6]],
        "steps": [{"u": [[-2]], "z": [[7]]}],
    },
}


def test_who_does_not_go_on_from_a_right_answer_is_told_so_and_what_gives_the_number() -> None:
    # With Σ₀ in the place of Σ̄: K = 7/13, μ = 7/13·7 = 49/13 and Σ = 6/13·7 = 42/13.
    exercise = rldrill.read(ONE_STEP)
    noise = "Every motion adds the variance of its own noise to the belief."
    assert exercise.check("49/13, 42/13", "b").says == noise
    diagnosis = exercise.diagnose("49/13, 42/13", "b", {"a": "0, 12"})
    assert diagnosis.sentence == f"This does not seem to go on from your answer to (a), which is right. {noise}"
    assert diagnosis.mistake is not None


#: The best of all paths is rim, slope, floor, lander: 1 + 4 − 1 = 4; through cave rim, slope, cave: 1 + 6 − 4 = 3.
WAYS = {
    "family": "principle-of-optimality",
    "given": {
        "edges": [
            ["rim", "slope", 1], ["rim", "floor", 3], ["rim", "cave", 6], ["slope", "floor", 4], ["slope", "cave", 6],
            ["floor", "cave", 2], ["floor", "lander", -1], ["cave", "lander", -4],
        ],
        "start": "rim",
        "goal": "lander",
        "through": "cave",
    },
}  # fmt: skip


def test_a_mistake_that_fits_no_wrong_answer_before_is_not_told_as_typical() -> None:
    # With the rewards of rim → floor and rim → cave exchanged V*(rim) = 6 − 1 = 5, and 6 + 2 − 4 = 4 through cave.
    exercise = rldrill.read(WAYS)
    before = "5, 3, -1, -4"
    assert exercise.check("4", "c").says.startswith("That is the best path of all")
    assert exercise.grade({"a": "4, 3, -1, -4", "c": "4"})["c"].outcome is Outcome.MISCONCEPTION
    assert exercise.grade({"a": before, "c": "4"})["c"].outcome is Outcome.WRONG
    said = exercise.diagnose("4", "c", {"a": before}).sentence
    assert said == "It looks as if two entries are exchanged: reward of the second and the third of the edges."


def test_no_mistake_is_to_blame_where_nothing_follows_from_an_answer_before() -> None:
    # x = 2·20/5 = 8. From x = 1/2, which is no number of times, 1/2 : 5/2 = 1/5 follows all the same.
    rows = [["study", "kitchen", "hall", 5], ["study", "kitchen", "study", 20], ["study", "hall", "hall", 18],
            ["study", "hall", "study", 12], ["bath", "kitchen", "hall", 2], ["bath", "kitchen", "study", "x"],
            ["bath", "hall", "hall", 24], ["bath", "hall", "study", 16]]  # fmt: skip
    exercise = rldrill.read({"family": "markov-property", "given": {"table": rows, "asked": "study"}})
    graded = exercise.grade({"a": "1/2", "b": "4/5, 2/5, 1/5, 2/5"})
    assert graded["b"].outcome is not Outcome.MISCONCEPTION


def test_who_goes_on_from_the_prior_is_told_of_no_table() -> None:
    # After x 3/16 to 3/16; with y alone 1/4·1/8 to 3/4·1/2 and so 1/13.
    given = {"prior": {"sound": "1/4", "worn": "3/4"}, **MEASURED}
    exercise = rldrill.read({"family": "bayes-rule", "given": given})
    said = exercise.diagnose("1/13, 12/13", "b", {"a": "1/2, 1/2"}).sentence
    assert said.startswith("It looks as if every step goes on from what there was at the start")


def test_what_gives_the_wrong_answer_before_as_well_is_told_again() -> None:
    # floor ← −4 + 1/4·(9 + 3/4·x + 4), then rim from there, then floor ← 3/4·floor + 2, which is 2: floor was 0, x = 4.
    # With 9 + 3/4·x − 4 in the first bracket x = 44/3, and rim ← 44/3 + 1/4·(6 + 0 − 44/3) = 25/2.
    run = {"states": ["floor", "rim", "floor", "end"], "rewards": [9, 6, 8], "terminal": ["end"]}
    given = {"known": 2, "trajectory": run, "values": {"rim": "x", "floor": -4}, "alpha": "1/4", "gamma": "3/4"}
    exercise = rldrill.read({"family": "td-zero", "given": given})
    assert not exercise.diagnose("25/2", "b").explains
    assert exercise.diagnose("25/2", "b", {"a": "44/3"}).sentence == (
        "It looks as if V(sₜ) has the wrong sign in the first update (t = 0)."
    )


# 1/2·q : 1/4·(1 − q) = 2 : 1, so q = 1/2; then 2/3·1/4 : 1/3·3/4 = 2 : 3. From the first belief it is 1/8 : 3/8.
FOUND = {
    "family": "bayes-rule",
    "given": {
        "prior": {"h": "q", "k": "1-q"},
        "likelihood": {"z": {"h": "1/2", "k": "1/4"}, "w": {"h": "1/4", "k": "3/4"}},
        "measurements": ["z", "w"],
        "outcome": {"state": "h", "probability": "4/5"},
    },
}


def test_what_was_there_at_the_start_has_the_number_that_was_found() -> None:
    exercise = rldrill.read(FOUND)
    assert exercise.answers() == {"a": Fraction(2, 3), "b": {"h": Fraction(4, 7), "k": Fraction(3, 7)}}
    assert exercise.diagnose("2/5, 3/5", "b", {"a": "2/3"}).kind == "stale"


@pytest.mark.parametrize(
    "name", ["bayes-predict", "bayes-rule", "eligibility-trace", "linear-value", "return-infinite"]
)
def test_what_is_listed_can_be_typed(name: str) -> None:
    """No wrong answer holds a letter that was to be found."""
    for seed in (1, 2, 3):
        exercise = rldrill.draw(name, 3, seed)
        for part in exercise.parts:
            for wrong in exercise.diagnosing.wrong_answers(part.label, 40):
                assert exercise.check(wrong.answer, part.label).outcome is not Outcome.UNREADABLE, wrong.answer
