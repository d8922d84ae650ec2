"""What people bring and no family draws: ways to give and to ask, each with its answers as they are worked by hand."""

from fractions import Fraction
from typing import Any

import pytest

import rldrill

#: A sensor by hypothesis: dry is 1/5·3/5 = 3/25 for water and 4/5·4/5 = 16/25 for rock, 19/25 together.
SENSOR = {
    "prior": {"water": "1/5", "rock": "4/5"},
    "likelihood": {"water": {"dry": "3/5", "wet": "2/5"}, "rock": {"dry": "4/5", "wet": "1/5"}},
    "measurements": ["dry"],
}
#: A return that is sought: 6 + 1/4·(x − 6) = 17/4, so x − 6 = −7.
SOUGHT = {"known": "17/4", "values": {"medium": 6}, "alpha": "1/4", "visits": [["medium", "x"]]}
#: With a second return of 2: 3/4·(9/2 + x/4) + 1/2 = 31/8 + 3x/16 = 17/4, so 3x/16 = 3/8.
SOUGHT_FIRST = {**SOUGHT, "visits": [["medium", "x"], ["medium", 2]]}
#: f₁ = (x² + y)x at (1, 2): ∂f₁/∂x = 3x² + y = 5, ∂f₁/∂y = x = 1; f₂ = u.
CUBIC = {
    "dynamics": {"x": "D*x", "y": "u"}, "where": {"D": "x^2 + y"}, "state": {"x": 1, "y": 2}, "action": {"u": 0},
}  # fmt: skip
#: Returns 4 + 7/2, 5 + 2 and 4; first 5 + 1/5·5/2 = 11/2, then 11/2 − 1/5·3/2; 6 + 1/5·1.
PAIRS = {
    "trajectory": {
        "states": ["a", "b", "a", "end"], "actions": ["l", "r", "l"], "rewards": [4, 5, 4], "terminal": ["end"],
    },
    "values": {"a": {"l": 5}, "b": {"r": 6}}, "alpha": "1/5", "gamma": "1/2", "visits": "every",
}  # fmt: skip
#: One sample, and how small ε must be is asked: ρ = 1/4 : 1/2, and min(2, 4·(1 − ε)) is the unclipped 2 for ε ≤ 1/2.
SAMPLE = {
    "samples": [{
        "state": "rock", "action": "drift", "old": "1/2", "preferences": {"sail": "ln 3", "drift": 0}, "advantage": 4,
    }],
}  # fmt: skip


def tie(reward: int) -> dict[str, Any]:
    """Staying earns that, going on nothing and 1 a step later: V₁ is 1 far on, and both are worth as much if γ·1 is."""
    rows = [["start", "stay", "end", 1, reward], ["start", "go", "far", 1, 0], ["far", "go", "end", 1, 1]]
    return {"mdp": {"transitions": rows}, "sweeps": 1, "gamma": "gamma", "tie": "start"}


BROUGHT: dict[str, tuple[str, dict[str, Any], dict[str, Any]]] = {
    # sick 1/10·9/10 = 9/100, healthy 9/10·1/5 = 18/100: one to two; by readings, those under 'sick' would sum to 11/10
    "a sensor by hypothesis whose readings have the names of the hypotheses": (
        "bayes-rule",
        {
            "prior": {"sick": "1/10", "healthy": "9/10"},
            "measurements": ["sick"],
            "likelihood": {"sick": {"sick": "9/10", "healthy": "1/10"}, "healthy": {"sick": "1/5", "healthy": "4/5"}},
        },
        {"a": {"sick": Fraction(1, 3), "healthy": Fraction(2, 3)}},
    ),
    # the same by readings
    "a sensor by readings that have the names of the hypotheses": (
        "bayes-rule",
        {
            "prior": {"sick": "1/10", "healthy": "9/10"},
            "measurements": ["sick"],
            "likelihood": {"sick": {"sick": "9/10", "healthy": "1/5"}, "healthy": {"sick": "1/10", "healthy": "4/5"}},
        },
        {"a": {"sick": Fraction(1, 3), "healthy": Fraction(2, 3)}},
    ),
    "a sensor by hypothesis": ("bayes-rule", SENSOR, {"a": {"water": Fraction(3, 19), "rock": Fraction(16, 19)}}),
    # B stays there: 2/(1 − 1/2) = 4; A leads to B for sure: 1 + 4/2 = 3
    "what is certain is written as a name": (
        "feature-expectations-policy",
        {
            "start": "A",
            "policy": {"A": "go", "B": "go"},
            "motion": {"go": {"A": "B", "B": "B"}},
            "features": {"A": [1], "B": [2]},
            "gamma": "1/2",
        },
        {"a": {"A": Fraction(3), "B": Fraction(4)}, "b": Fraction(3)},
    ),
    "the only return is sought": ("sample-average", SOUGHT, {"a": Fraction(-1)}),
    "the first return is sought": ("sample-average", SOUGHT_FIRST, {"a": Fraction(2)}),
    "a name in the dynamics": (
        "linearise",
        CUBIC,
        {"a": ((Fraction(5), Fraction(1)), (Fraction(0), Fraction(0))), "b": ((Fraction(0),), (Fraction(1),))},
    ),
    "a name in affine dynamics": (  # C = F − A_Δ s̄ = 1 + 3/10 − (3/2 + 1/5)
        "linearise-affine",
        {**CUBIC, "step": "1/10"},
        {
            "a": ((Fraction(-2, 5),), (Fraction(0),)),
            "b": (
                (Fraction(3, 2), Fraction(1, 10), Fraction(-2, 5)),
                (Fraction(0), Fraction(1), Fraction(0)),
                (Fraction(0), Fraction(0), Fraction(1)),
            ),
            "c": ((Fraction(0),), (Fraction(1, 10),), (Fraction(0),)),
        },
    ),
    "pairs are visited": (
        "monte-carlo",
        PAIRS,
        {
            "a": (Fraction(15, 2), Fraction(7), Fraction(4)),
            "b": {"a": {"l": Fraction(26, 5)}, "b": {"r": Fraction(31, 5)}},
        },
    ),
    "a tie without a discount": (
        "value-iteration",
        tie(1),
        {"a": {"start": Fraction(1), "far": Fraction(1)}, "b": Fraction(1), "c": "A"},
    ),
    "one sample without a range": ("ppo-clip", SAMPLE, {"a": Fraction(1, 2), "b": Fraction(0), "c": Fraction(2)}),
    # (1 − x)·9 + x·(9 + 8)/2 = 9 − x/2 = 35/4
    "a rate by a letter of one's own": (
        "epsilon-greedy",
        {"state": "s", "values": {"l": 9, "r": 8}, "epsilon": "x", "valued": False, "state_value": "35/4"},
        {"a": Fraction(1, 2), "b": {"l": Fraction(3, 4), "r": Fraction(1, 4)}},
    ),
}


@pytest.mark.parametrize("brought", BROUGHT)
def test_what_is_brought_has_the_answers_worked_by_hand(brought: str) -> None:
    family, given, answers = BROUGHT[brought]
    assert rldrill.read({"family": family, "given": given}).answers() == answers


def test_the_printed_key_is_read_however_long_the_numbers_under_its_roots_are() -> None:
    given = {"expert": ["3.14159", "6.28318"], "first": ["0.123", "5.17"], "policies": [["8.271828", "1.61803"]]}
    exercise = rldrill.read({"family": "apprenticeship", "given": given | {"tolerance": "0.0001"}})
    graded = exercise.grade(exercise.answers())
    assert graded.points == graded.of


@pytest.mark.parametrize(
    ("family", "given", "says"),
    [
        ("linearise", {"dynamics": {"x": "tan(y)", "y": "u"}, "state": {"x": 0, "y": "pi/2"}, "action": {"u": 0}},
         "do not exist at the operating point"),
        ("lqr-infinite", {"A": [[1]], "B": [[0]], "Q": [[9]], "R": [[0]]}, "some action costs nothing"),
        ("lqr-infinite", {"A": [["1/2"]], "B": [[1]], "Q": [[0]], "R": [[0]]}, "some action costs nothing"),
        ("lqr-infinite", {"A": [[1, 1], [0, 1]], "B": [[0], [0]], "Q": [[1, 0], [0, 1]], "R": [[0]]},
         "some action costs nothing"),
        ("lqr-infinite", {"A": [[2, 1], [0, 3]], "B": [[0], [0]], "Q": [[1, 0], [0, 1]], "R": [[1]]},
         "no action keeps the system from running away"),
        # x/(x + 1) = 1/3 for x = 1/2
        ("markov-property",
         {"table": [["a", "n", "p", 1], ["a", "n", "q", 2], ["b", "n", "p", "x"], ["b", "n", "q", 1]], "asked": "p"},
         "the missing count would have to be 1/2, and counts are whole numbers"),
        ("value-iteration", tie(2), "with no discount from 0 to 1 are both actions in 'start' greedy"),
        ("value-iteration", tie(0), "both actions in 'start' are greedy with γ = 0, and no discount is smaller"),
    ],
)  # fmt: skip
def test_what_has_no_answer_is_refused_with_the_reason(family: str, given: dict[str, Any], says: str) -> None:
    with pytest.raises(rldrill.UserError, match=says):
        rldrill.read({"family": family, "given": given})
