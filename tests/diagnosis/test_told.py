"""What is told of several causes that give an answer, and of the only one that does; all worked out by hand."""

from typing import Any

import pytest

import rldrill
from rldrill.solutions.diagnosis.causes import Cause
from rldrill.solutions.diagnosis.saying import saying


def said(family: str, given: dict[str, Any], typed: str, part: str = "a", earlier: dict[str, str] | None = None) -> str:
    return rldrill.read({"family": family, "given": given}).diagnose(typed, part, earlier or {}).sentence


#: H₁ = 2 + 6 = 8, L₁ = 6·2/8 = 3/2, P₁ = −1 − 6·2·(2 − 3/2) = −7.
LINE = {"A": [[2]], "B": [[1]], "Q": [[1]], "R": [[2]], "Q_T": [[6]], "start": [-3], "horizon": 2}
#: BᵀPA = (−4, −6), so G₀ = (−4/3, −2) and H₀ = ρ + 2; (4 − 2)/(ρ + 2) = 2/3 for ρ = 1.
PRICED = {
    "gamma": "1/3",
    "A": [[2, 1], [0, 1]],
    "B": [[1], [1]],
    "R": [["rho"]],
    "P": [[-2, 0], [0, -4]],
    "start": [3, -1],
    "action": "-2/3",
}
#: V(medium) = 1/2·(5 + 4/5·15) + 1/2·(3 + 4/5·35) = 24.
BACKUP = {
    "dynamics": {"transitions": [["medium", "search", "low", 1, 5], ["medium", "recharge", "high", 1, 3]]},
    "values": {"high": 35, "low": 15},
    "gamma": "4/5",
    "policy": {"medium": {"search": "1/2", "recharge": "1/2"}},
}
#: Q = 1/2·(0 + 4) + 1/2·(−4 + 3) = 3/2.
ACTION = {
    "dynamics": {"transitions": [["medium", "search", "low", "1/2", 0], ["medium", "search", "critical", "1/2", -4]]},
    "values": {"low": 8, "critical": 6},
    "gamma": "1/2",
}
#: R₀ = −2 + 3/4·8 = 4 and R₀⁽¹⁾ = −2 + 3/4·4 = 1, so R₀^λ = (1 − λ) + 4λ; R₁^λ = 8.
FORWARD = {
    "trajectory": {"states": ["rim", "floor", "lander"], "rewards": [-2, 8], "terminal": ["lander"]},
    "values": {"rim": -4, "floor": 4},
    "alpha": "1/2",
    "gamma": "3/4",
    "lam": "lambda",
    "asked": [0, 1],
}
#: V₁ = (10, 6, 4); V₂(cool) = max{10 + 3, 8 + 5}, V₂(warm) = max{2 + 2, 6 + 5}, V₂(hot) = max{4, −2 + 3}.
CAR = {
    "mdp": {
        "transitions": [
            ["cool", "fast", "warm", 1, 10],
            ["cool", "slow", "cool", 1, 8],
            ["warm", "fast", "hot", 1, 2],
            ["warm", "slow", "cool", 1, 6],
            ["hot", "fast", "overheated", 1, 4],
            ["hot", "slow", "warm", 1, -2],
        ],
        "terminal": ["overheated"],
    },
    "sweeps": 2,
    "gamma": "1/2",
}


def test_a_right_answer_before_leaves_the_only_cause() -> None:
    # Without L: P₁ = −1 − 6·2·(2 − 1) = −13; with −Q_T in the place of Q_T the gain would be another one.
    assert said("lqr-backward", LINE, "-13", "b", {"a": "3/2"}) == "It looks as if the factor Lₜ is missing every time."


def test_one_sign_in_two_steps_is_told_once_beside_what_else_there_is() -> None:
    # (4 + 2)/(ρ + 2) = 2/3 for ρ = 7, with 2 for −2 in G₀, which turns its sign in L₀, too; without γ in G₀ it is
    # (12 − 6)/(ρ + 2) = 2/3.
    assert said("lqr-gain", PRICED, "7") == (
        "It looks as if the result has the wrong sign: 2 for −2 in G₀, or γ is missing in G₀."
    )


def test_the_only_other_state_of_a_table_is_told() -> None:
    # 1/2·(5 + 4/5·35) + 1/2·(3 + 4/5·35) = 32
    assert said("bellman-backup", BACKUP, "32") == (
        "It looks as if V^π(high) = 35 is put in for V^π(low) = 15 in V^π(medium)."
    )


def test_the_only_other_state_is_told_though_the_number_is_far_from_the_key() -> None:
    # With γ = 1/2 it is 1/2·(5 + 15/2) + 1/2·(3 − 5) = 21/4, and with −10 for 15 it is 1/2·(5 − 5) + 1/2·(3 − 5) = −1.
    given = BACKUP | {"values": {"high": -10, "low": 15}, "gamma": "1/2"}
    assert "V^π(high) = −10 is put in for V^π(low) = 15" in said("bellman-backup", given, "-1")


def test_a_factor_left_out_everywhere_is_told_of_a_small_number() -> None:
    # 0 + 4 − 4 + 3 = 3
    assert said("action-value", ACTION, "3").startswith("It looks as if the factor Pₛₛ′ᵃ is missing in Q^π")


def test_what_is_likelier_is_not_told_as_something_else() -> None:
    # Without γ, R₀ = −2 + 8 = 6 and R₀^λ = (1 − λ) + 6λ.
    assert said("td-lambda-forward", FORWARD, "1 + 5λ, 8").startswith(
        "It looks as if the factor γⁱ is missing every time"
    )


def test_the_likeliest_is_told_beside_lines_of_tables() -> None:
    # 10 + 1/2·10 = 15, with V₁(cool) for V₁(warm), or with the best reward and the best next value.
    told = said("value-iteration", CAR, "cool: 15, warm: 11, hot: 4")
    assert "Vₖ(cool) = 10 is put in for Vₖ(warm) = 6 in the second step for V₂(cool)" in told
    assert "Reward and next value belong to one action" in told


def test_who_went_on_from_a_right_answer_is_not_told_otherwise() -> None:
    # 12 = 4 + γ·8/(1 − γ) for γ = 1/2, R₁ = 8/(1 − 1/2) = 16; and 4 + 8/(1 − 1/2) = 20.
    given = {"known": 12, "first": [4], "repeated": [8], "gamma": "gamma"}
    assert "does not seem to go on" not in said("return-infinite", given, "20", "b", {"a": "1/2"})


def test_what_was_right_before_was_not_done_every_time() -> None:
    # The step of (d) has μ·w in two components; with one sign lost it is 11, 16 for 21, 6. In (a) it was right.
    exercise = rldrill.load("apprenticeship/3/20064")
    earlier = {"a": "2/5", "b": "15, 12", "c": "2, -10"}
    assert exercise.diagnose("11, 16", "d", earlier).sentence.endswith("(that of i = 2) in (d).")


def test_only_the_own_value_is_old() -> None:
    # hall ← 10 + 1/2·(7 − 1 − 10) = 8, bend ← −2 + 1/2·(5 + 4 + 2) = 7/2, hall ← 8 + 1/2·(−3 + 7/4 − 8) = 27/8; from
    # 10 on, as at the start, 10 + 1/2·(−3 + 7/4 − 10) = 35/8.
    given = {
        "trajectory": {"states": ["hall", "bend", "hall", "bend"], "rewards": [7, 5, -3]},
        "values": {"hall": 10, "bend": -2},
        "alpha": "1/2",
        "gamma": "1/2",
    }
    told = said("td-zero", given, "hall: 35/8, bend: 7/2")
    assert "a value that has been updated since is put in as it was at the start in the third update (t = 2)" in told


def test_the_traces_of_an_earlier_time_are_told() -> None:
    # γλ = 1/2: 1, then 1/2 and 1, then 1/4 + 1 and 1/2.
    given = {"states": ["medium", "high", "medium"], "gamma": "3/4", "lam": "2/3", "asked": [2]}
    assert said("eligibility-trace", given, "medium: 1/2, high: 1") == (
        "It looks as if you gave what there is at t = 1, one time too early."
    )


def test_a_factor_forgotten_at_one_time_is_told() -> None:
    # δ₀ = 2 + 12 − 4 = 10 and (rock, drift) ← 4 + 10/4 = 13/2; δ₁ = 1 + 8 − 12 = −3, so 13/2 − 3/2 = 5 and 12 − 3 = 9
    # without α.
    given = {
        "trajectory": {"states": ["rock", "bay", "reef"], "actions": ["drift", "drift", "sail"], "rewards": [2, 1]},
        "values": {
            "reef": {"sail": 8, "drift": -4, "row": 12},
            "bay": {"sail": 4, "drift": 12, "row": -4},
            "rock": {"sail": -4, "drift": 4, "row": 12},
        },
        "alpha": "1/4",
        "gamma": 1,
        "lam": "1/2",
    }
    told = said("sarsa-lambda", given, "5, 9", "b", {"a": "1/2, 1"})
    assert told.startswith("It looks as if α is missing in every update at t = 1")


def test_a_score_with_the_features_of_another_action_is_looked_at() -> None:
    # θ = (ln 3, ln 3), so π(walk|gate) = 3/4: (0, 0) − 3/4·(0, 1) = (0, −3/4), and with f(gate, walk) (0, 1/4).
    given = {
        "trajectory": {
            "states": ["middle", "gate", "shore"],
            "actions": ["walk", "back"],
            "rewards": [-1, 8],
            "terminal": ["shore"],
        },
        "features": {
            "middle": {"walk": [1, 0], "back": [0, 0]},
            "gate": {"walk": [0, 1], "back": [0, 0]},
        },
        "theta": ["ln 3", "ln 3"],
        "gamma": "1/2",
        "baseline": {"middle": 1, "gate": 2},
        "alpha": "1/4",
    }
    search = rldrill.read({"family": "reinforce-baseline", "given": given}).diagnosing.search({})
    lines = [
        str(cause.became)
        for application in search.applications
        for cause in search.alternatives(application)
        if cause.kind == "another-line" and application.formula.key == "score-function"
    ]
    assert "Vector(entries=(0, 1/4))" in lines


@pytest.mark.parametrize(
    ("typed", "says"),
    [
        ("13", "13, which fits ‖s − c₃‖ = 3, but not ‖s − c₂‖ = 5"),
        ("-3", "−3, which fits ‖s − c₂‖ = 5, but not ‖s − c₃‖ = 3"),
    ],
)
def test_one_of_two_places_is_told(typed: str, says: str) -> None:
    # 25/72 = 5²/(2·6²) and 1/8 = 3²/(2·6²): s is 5 from 2 and 3 from 10, so it is 7; 13 is 3 from 10, −3 is 5 from 2.
    given = {"centres": [[9], [2], [10]], "sigma": 6, "logarithms": {"2": "-25/72", "3": "-1/8"}}
    assert says in said("rbf", given, typed)


def test_a_policy_that_follows_from_a_given_misread_before_is_told() -> None:
    # With 2 for −2 at (hot, slow) V₁ stays (10, 6, 4), for 2 < 4, and V₂(hot) = 2 + 1/2·6 = 5; then 2 + 1/2·11 > 4, and
    # slow is greedy in hot.
    told = said("value-iteration", CAR, "cool: fast, warm: slow, hot: slow", "b", {"a": "cool: 13, warm: 11, hot: 5"})
    assert told == "It looks as if a minus is lost in reading the sixth row of the transitions."


#: V(rim) = 1/2·(7 + 16) + 1/2·(9 + 8) = 20, V(slope) = 1/2·(−4 + 24) + 0 = 10, V(floor) = 30.
ROVER = {
    "mdp": {
        "transitions": [
            ["rim", "drive", "rim", "1/2", 7],
            ["rim", "drive", "slope", "1/2", 9],
            ["rim", "climb", "rim", 1, 6],
            ["slope", "drive", "floor", "1/2", -4],
            ["slope", "drive", "lander", "1/2", 0],
            ["slope", "climb", "rim", 1, -8],
            ["floor", "drive", "lander", 1, 30],
            ["floor", "climb", "slope", 1, 23],
        ],
        "terminal": ["lander"],
    },
    "policy": {"rim": {"drive": 1}, "slope": {"drive": 1}, "floor": {"drive": 1}},
    "gamma": "4/5",
}


def test_what_leaves_every_choice_open_is_not_told() -> None:
    # (climb, drive, climb) is greedy; without R everything is worth 0, without the bracket 1.
    told = said("policy-improvement", ROVER, "drive, climb, drive", "b", {"a": "20, 10, 30"})
    assert "is missing every time" not in told


def test_nobody_takes_1_minus_what_is_no_share() -> None:
    # 12/(2/5) = 30 for 12/(3/5): π(drive|rim) = 1 leaves nothing.
    assert "1 − π" not in said("policy-improvement", ROVER, "30, 10, 30")


@pytest.mark.parametrize(
    ("typed", "says"),
    [
        ("3/16", "there is one sweep too many"),  # 12/4³ for 12/4²
        ("27/4", "γ is taken for 1 minus itself"),  # 12·(3/4)²
    ],
)
def test_the_givens_have_the_names_of_the_question(typed: str, says: str) -> None:
    given = {"start": {"start": 0, "edge": 0}, "optimum": {"start": 12, "edge": -2}, "gamma": "1/4", "sweeps": 2}
    assert says in said("contraction", given, typed, "b")


def test_a_return_is_told_with_its_episode() -> None:
    # Both returns are −2 and −4; the second without its first reward is −2: 1/2·(−6p − 2·3/4·(1 − p)) = −3/4 − 9p/4.
    half = {"roll": "1/3", "creep": "2/3"}
    given = {
        "episodes": [
            {"states": ["bend", "charger"], "actions": ["roll"], "rewards": [-2], "terminal": ["charger"]},
            {
                "states": ["bend", "ramp", "charger"],
                "actions": ["creep", "creep"],
                "rewards": [-2, -2],
                "terminal": ["charger"],
            },
        ],
        "target": {"bend": {"roll": "p", "creep": "1-p"}, "ramp": {"roll": "2/3", "creep": "1/3"}},
        "behaviour": {"bend": half, "ramp": half},
        "gamma": 1,
    }
    assert "in R₀ (episode 2)" in said("importance-sampling", given, "-3/4 - 9*p/4", "b")


@pytest.mark.parametrize(
    ("kind", "what", "words"),
    [
        ("as-above", "rewards of the third of the episodes", "are taken over from the one before"),
        ("as-above", "second of the actions", "the second of the actions is taken over from the one before"),
        ("one-too-many", "steps of the second of the diagrams", "there is one step too many in the second of the"),
        ("one-too-few", "sweeps", "there is one sweep too few"),
        ("one-too-few", "k of small", "k of small is taken one too small"),
    ],
)
def test_givens_misread_are_told_in_english(kind: str, what: str, words: str) -> None:
    assert words in "".join(map(str, saying(Cause(kind, 1.0, what=what), ())))
