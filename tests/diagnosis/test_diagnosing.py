"""Wrong answers, worked out by hand, and what is said of them."""

import pytest
from flint import fmpq

import rldrill
from rldrill.solutions.answers.judging import Outcome
from rldrill.solutions.answers.text import read_number
from rldrill.solutions.diagnosis.search import Search
from rldrill.solutions.diagnosis.typed import may_mean
from rldrill.solutions.sheet.bellman import Q_REWARD_UNWEIGHTED
from rldrill.solutions.sheet.control import SHARED_AMONG_OTHERS

# V(cave) = 8, V(floor) = 10, V(rim) = 6, α = 1/4, γ = 1/2:
# t = 0: cave  ← 8 + 1/4·(7 + 1/2·10 − 8) = 9
# t = 1: floor ← 10 + 1/4·(−3 + 1/2·9 − 10) = 63/8
# t = 2: cave  ← 9 + 1/4·(−4 + 1/2·6 − 9) = 13/2
RUN = {
    "family": "td-zero",
    "given": {
        "trajectory": {"states": ["cave", "floor", "cave", "rim"], "rewards": [7, -3, -4]},
        "values": {"cave": 8, "floor": 10, "rim": 6},
        "alpha": "1/4",
        "gamma": "1/2",
    },
}


@pytest.fixture(scope="module")
def run() -> rldrill.Exercise:
    return rldrill.read(RUN)


@pytest.mark.parametrize(
    ("typed", "kind", "sentence"),
    [
        # 10 + 1/4·(−3 + 9 − 10) = 9
        ("cave: 13/2, floor: 9", "factor-left-out", "It looks as if γ is missing in the second update (t = 1)"),
        # 9 + 1/4·(4 + 1/2·6 − 9) = 17/2
        ("cave: 17/2, floor: 63/8", "sign", "rₜ₊₁ has the wrong sign in the third update (t = 2)"),
        # the second update is left out: floor stays at 10
        ("cave: 13/2, floor: 10", None, "in the second update (t = 1)"),
        ("cave: 63/8, floor: 13/2", "exchanged-cells", "the answers for cave and floor are exchanged"),
        # with cave = 8 as at the start: 10 + 1/4·(−3 + 1/2·8 − 10) = 31/4
        ("cave: 13/2, floor: 31/4", "stale", "as it was at the start in the second update (t = 1)"),
        # 9 + 1/4·(−4 + 1/2·6 + 9) = 11
        ("cave: 11, floor: 63/8", "sign", "V(sₜ) has the wrong sign in the third update (t = 2)"),
    ],
)
def test_a_slip_is_named_with_its_place(run: rldrill.Exercise, typed: str, kind: str | None, sentence: str) -> None:
    diagnosis = run.diagnose(typed)
    assert sentence in diagnosis.sentence
    assert kind is None or diagnosis.kind == kind
    assert diagnosis.explains


def test_the_place_is_a_step_of_the_working(run: rldrill.Exercise) -> None:
    place = run.diagnose("cave: 13/2, floor: 9").place
    assert (place.formula, place.step) == ("td-zero", 1)
    assert run.data()["steps"][place.step]["value"] == "63/8"


def test_a_listed_mistake_comes_first(run: rldrill.Exercise) -> None:
    # without γ: 8 + 1/4·(7 + 10 − 8) = 41/4; 10 + 1/4·(−3 + 41/4 − 10) = 149/16; 41/4 + 1/4·(−4 + 6 − 41/4) = 131/16
    diagnosis = run.diagnose("cave: 131/16, floor: 149/16")
    assert diagnosis.kind == "listed"
    assert diagnosis.sentence == run.check("cave: 131/16, floor: 149/16").says


#: ε = 3/5 and three actions worth −5, 15 and 10 in either next state: V = (3/5)·15 + (1/5)·(−5 + 10) = 10.
EXPECTED = {
    "family": "expected-sarsa",
    "given": {
        "trajectory": {"states": ["warm", "smoking", "hot"], "actions": ["fast", "slow", "fast"], "rewards": [7, 4]},
        "values": {
            "warm": {"fast": 10, "slow": 15, "brake": -5},
            "smoking": {"fast": -5, "slow": 15, "brake": 10},
            "hot": {"fast": -5, "slow": 15, "brake": 10},
        },
        "alpha": "1/2",
        "gamma": "2/5",
        "epsilon": "3/5",
    },
}


def test_a_mistake_stated_beside_a_formula_is_known_wherever_that_is_read() -> None:
    # Exploring among the two others: V = (2/5)·15 + (3/10)·(−5 + 10) = 15/2, and so
    # 10 + 1/2·(7 + 2/5·15/2 − 10) = 10 and 15 + 1/2·(4 + 2/5·15/2 − 15) = 11. Expected Sarsa does not list it.
    diagnosis = rldrill.read(EXPECTED).diagnose("10, 11")
    assert diagnosis.kind == "listed"
    assert diagnosis.sentence == SHARED_AMONG_OTHERS.says
    assert not diagnosis.alternatives


CAR = {
    "family": "policy-improvement",
    "given": {
        "mdp": {
            "transitions": [
                ["cool", "fast", "warm", "1/2", 7],
                ["cool", "fast", "hot", "1/2", 9],
                ["cool", "slow", "cool", 1, 7],
                ["warm", "slow", "cool", 1, -1],
                ["hot", "fast", "overheated", 1, 10],
                ["hot", "slow", "warm", "1/2", 7],
                ["hot", "slow", "hot", "1/2", 1],
            ],
            "terminal": ["overheated"],
        },
        "policy": {"cool": "slow", "warm": "slow", "hot": "fast"},
        "values": {"cool": 14, "warm": 6, "hot": 10},  # 7 + 1/2·14, −1 + 1/2·14, 10
        "gamma": "1/2",
        "action_values": True,
    },
}


@pytest.mark.parametrize(
    ("typed", "where"),
    [
        # Rewards not weighted: (cool, fast) 7 + 9 + 1/2·(1/2·6 + 1/2·10) = 20, (hot, slow) 7 + 1 + 1/2·(3 + 5) = 12.
        ("(cool, fast): 20, (cool, slow): 14, (warm, slow): 6, (hot, fast): 10, (hot, slow): 12", ""),
        # Only the first time; rightly (hot, slow) is 1/2·(7 + 1/2·6) + 1/2·(1 + 1/2·10) = 8.
        (
            "(cool, fast): 20, (cool, slow): 14, (warm, slow): 6, (hot, fast): 10, (hot, slow): 8",
            " It seems to have gone wrong in Q^π(cool, fast).",
        ),
    ],
)
def test_a_stated_mistake_is_known_made_everywhere_and_made_once(typed: str, where: str) -> None:
    assert rldrill.read(CAR).diagnose(typed).sentence == Q_REWARD_UNWEIGHTED.says + where


SWEEPS = {
    "family": "policy-evaluation",
    "given": {
        "mdp": {"transitions": [["a", "go", "b", 1, 1], ["b", "go", "a", 1, 3]], "terminal": []},
        "policy": {"a": "go", "b": "go"},
        "gamma": "1/4",
        "start": {"a": 4, "b": 8},
        "sweeps": 2,
    },
}


def test_the_same_row_misread_in_every_sweep_is_told_once() -> None:
    # Without γ in a alone: V₁(a) = 1 + 8 = 9, V₁(b) = 3 + 1/4·4 = 4, V₂(a) = 1 + 4 = 5, V₂(b) = 3 + 1/4·9 = 21/4.
    said = rldrill.read(SWEEPS).diagnose("5, 21/4").sentence
    assert said == "It looks as if γ is missing every time in Vₖ₊₁(a)."


def test_what_was_right_before_may_be_wrong_here_alone() -> None:
    # ε = 1/2 by 2/3 = 1 − ε + ε/3; then 1/2·4 + 1/4·(−2 + 3) = 9/4: exploration among the two other actions.
    exercise = rldrill.load("epsilon-greedy/2/894006")
    for earlier in ({}, {"a": "1/2"}):
        assert exercise.diagnose("9/4", "b", earlier).sentence.startswith("Exploring picks among all |A| actions")


def test_the_prior_for_the_posterior_is_told() -> None:
    said = rldrill.load("bayes-rule/2/408328").diagnose("4/5, 1/5").sentence  # p(sound) = 4/5, p(cracked) = 1/5
    assert said.startswith("It looks as if you gave p(h), as it was before, not what comes of it")


def test_another_line_of_a_table_is_named() -> None:
    # Q(cool, slow) = 5 + 1/2·V(cool) = 7 with V(cool) = 4; with V(warm) = 2 it is 6.
    rows = [
        ["cool", "fast", "warm", 1, 3], ["cool", "slow", "cool", 1, 5], ["warm", "fast", "overheated", 1, 2],
        ["warm", "slow", "cool", 1, -4],
    ]  # fmt: skip
    mdp = {"transitions": rows, "terminal": ["overheated"]}
    given = {"mdp": mdp, "policy": {"cool": "fast", "warm": "fast"}, "gamma": "1/2"}
    exercise = rldrill.read({"family": "policy-action-value", "given": given})
    said = exercise.diagnose("4, 6, 2, -2", "b").sentence
    assert said.startswith("It looks as if V^π(warm) = 2 is put in for V^π(cool) = 4 in Q^π(cool, slow)")


def test_equations_that_are_applied_instead_of_solved_are_told() -> None:
    # Right are μ(A) = 8 + 1/2·μ(A) = 16 and μ(B) = 2 + 1/8·16 = 4. From 0 on, each with what has been found already:
    # μ(A) = 8, then 8 + 1/2·8 = 12 and μ(B) = 2 + 1/8·12 = 7/2.
    said = rldrill.load("feature-expectations-policy/1/965959").diagnose("12, 7/2").sentence
    assert said.startswith("It looks as if the equations are gone through twice, from 0 on, instead of solved")


@pytest.mark.parametrize(
    ("typed", "says"),
    [
        ("5/7, 1; 3/7, 1", "the signs beside the diagonal are not turned in the inverse of"),  # (4 1; 1 2)/7·S
        ("1/7, -1/7; 3/7, 11/7", "the numbers on the diagonal are not exchanged in the inverse of"),  # (2 −1; −1 4)/7·S
        ("3, 1; 1, 5", "is not divided by the determinant"),  # (4 −1; −1 2)·S
    ],
)
def test_a_step_forgotten_in_inverting_a_matrix_is_told(typed: str, says: str) -> None:
    # S = (1 1; 1 3), H = R + S = (2 1; 1 4), its inverse (4 −1; −1 2)/7, and L = H⁻¹S = (3 1; 1 5)/7.
    identity = [[1, 0], [0, 1]]
    system = {"A": identity, "B": identity, "R": identity, "P": [[-1, -1], [-1, -3]]}
    said = rldrill.read({"family": "lqr-gain", "given": system}).diagnose(typed, part="a").sentence
    assert says in said


def test_no_slip_makes_a_share_larger_than_1() -> None:
    # (2/3)/(1/3) is 8/5 to 4/5, as if 3/5 were 8/5; but it is 3/5·4/5 to 2/5·3/5, with 1 − p(z|h).
    said = rldrill.load("bayes-rule/2/381857").diagnose("2/3, 1/3", "b").sentence
    assert said.startswith("What was measured counts, with its own likelihood; 1 minus it")
    assert "8/5" not in said


def test_two_edits_that_give_the_same_are_both_told() -> None:
    # b ← 18/7 + 1/4·(5 + 3/2 − 18/7) = 199/56; a ← 8 + 1/4·(9/7 + 1/2·18/7 − 8) has 9/7 twice: without one, 177/28.
    given = {
        "trajectory": {"states": ["a", "b", "c"], "rewards": ["9/7", 5]},
        "values": {"a": 8, "b": "18/7", "c": 3},
        "alpha": "1/4",
        "gamma": "1/2",
    }
    said = rldrill.read({"family": "td-zero", "given": given}).diagnose("177/28, 199/56").sentence
    update = "in the first update (t = 0)"
    assert said == f"It looks as if rₜ₊₁ is missing {update}, or γV(sₜ₊₁) is missing {update}."


def test_a_list_of_the_givens_is_called_what_is_in_it() -> None:
    # R₁ = (3 + 5/2 + 11/4)/(1 − 1/8) = 66/7; the other way round (11 + 5/2 + 3/4)/(7/8) = 114/7.
    given = {"first": [1], "repeated": [3, 5, 11], "gamma": "1/2"}
    said = rldrill.read({"family": "return-infinite", "given": given}).diagnose("114/7", "a").sentence
    assert said.startswith("It looks as if the repeated rewards are taken in the opposite order")


def test_a_matrix_in_the_place_of_another_is_told() -> None:
    # Σ̄ = 3·2·3 + 4 = 22. With A = 3 for Q = 12 in the gain K = 22/(22 + 3) = 22/25.
    line = {"mean": 9, "covariance": 2, "A": 3, "C": 1, "process": 4, "sensor": 12, "steps": [{"u": 5, "z": 11}]}
    diagnosis = rldrill.read({"family": "kalman-filter", "given": line}).diagnose("22/25", part="c")
    assert diagnosis.sentence == "It looks as if 3 is put in for Q, which is 12 in K₁."


def test_what_was_found_on_the_way_is_told_from_the_answer() -> None:
    # Dark: 1/3·(1/2, 3/4, 1/4), normalised (1/3, 1/2, 1/6). After "descend": 1/3·1/4 = 1/12 in rim,
    # 1/3·3/4 + 1/2·1/4 = 3/8 in ledge, 1/2·3/4 + 1/6 = 13/24 in floor; the second measurement is still to come.
    crater = {
        "belief": {"rim": "1/3", "ledge": "1/3", "floor": "1/3"},
        "motion": {
            "descend": {
                "rim": {"rim": "1/4", "ledge": "3/4"},
                "ledge": {"ledge": "1/4", "floor": "3/4"},
                "floor": {"floor": 1},
            }
        },
        "likelihood": {"dark": {"rim": "1/2", "ledge": "3/4", "floor": "1/4"}},
        "run": [{"measurement": "dark"}, {"action": "descend", "measurement": "dark"}],
    }
    diagnosis = rldrill.read({"family": "bayes-filter", "given": crater}).diagnose("1/12, 3/8, 13/24", part="b")
    assert diagnosis.sentence == "It looks as if you gave p̄(rim), …, which are not what is asked for."


@pytest.mark.parametrize(
    ("typed", "value", "may"),
    [
        ("11", fmpq(551, 50), False),  # 11.02
        ("11.0", fmpq(551, 50), True),
        ("7/3", fmpq(7001, 3000), False),
        ("139", fmpq(1391, 10), True),
        ("11", fmpq(11), True),
        ("sqrt(2)", fmpq(141, 100), False),
    ],
)
def test_short_fractions_and_whole_numbers_are_not_rounded(typed: str, value: fmpq, may: bool) -> None:
    assert may_mean(read_number(typed), value) is may


def test_a_diagnosis_is_short_at_a_prompt(run: rldrill.Exercise) -> None:
    diagnosis = run.diagnose("cave: 13/2, floor: 9")
    assert repr(diagnosis) == f"<Diagnosis factor-left-out: {diagnosis.sentence}>"


def test_a_number_from_nowhere_is_not_explained(run: rldrill.Exercise) -> None:
    diagnosis = run.diagnose("cave: 9.77, floor: 3.19")
    assert (diagnosis.kind, diagnosis.explains) == ("unexplained", False)


def test_right_and_unreadable_answers_are_not_explained(run: rldrill.Exercise) -> None:
    assert run.diagnose("cave: 13/2, floor: 63/8").kind == "right"
    assert run.diagnose("cave: 1 +, floor: 5").kind == "unreadable"


def test_what_is_explained_is_said_in_data(run: rldrill.Exercise) -> None:
    data = run.diagnose("cave: 13/2, floor: 9").to_json()
    assert data["place"] == {"formula": "td-zero", "step": 1}
    assert data["kind"] == "factor-left-out"
    assert 0 < data["confidence"] <= 1


def test_close_hides_no_wrong_idea() -> None:
    exercise = rldrill.read(
        {
            "family": "td-zero",
            "given": {
                "trajectory": {"states": ["a", "b"], "rewards": [15]},
                "values": {"a": 100, "b": 110},
                "alpha": "1/10",
                "gamma": "9/10",
            },
        }
    )
    # 100 + 1/10·(15 + 9/10·110 − 100) = 101.4; without the update it is 100, within 2 % of that
    verdict = exercise.check("a: 100")
    assert verdict.outcome is not Outcome.CLOSE
    assert "the old value 100 is kept in the update" in verdict.says
    assert exercise.check("a: 100.7").outcome is Outcome.CLOSE


@pytest.mark.parametrize(("states", "others"), [(3, 9 + 2), (4, 1)])
def test_a_value_of_nine_numbers_is_taken_apart_and_a_larger_one_is_not(states: int, others: int) -> None:
    # Each number one more, and two values more that check whether all of it is a straight line.
    identity = [[int(i == j) for j in range(states)] for i in range(states)]
    system = {"A": identity, "B": [[1]] * states, "Q": identity, "R": 1, "start": [1] * states, "horizon": 1}
    search = Search(rldrill.read({"family": "lqr-backward", "given": system}).solution)
    (large,) = (each for each in search.applications if each.formula.key == "lqr-riccati")
    responses = search.responses(large)
    assert len(responses) == others
    assert (responses[0][0] is None) is (states > 3)


def test_a_list_in_the_opposite_order_is_named() -> None:
    # R₃ = 8, R₂ = 2 + 4 = 6, R₁ = 4 + 3 = 7, R₀ = 1/2 + 7/2 = 4
    exercise = rldrill.read({"family": "return", "given": {"gamma": "1/2", "rewards": ["1/2", 4, 2, 8]}})
    diagnosis = exercise.diagnose("8, 6, 7, 4")
    assert diagnosis.kind == "answer-reversed"
    assert diagnosis.sentence == "It looks as if the answers are given in the opposite order."


def test_of_three_the_opposite_order_is_an_exchange_of_two() -> None:
    # R₂ = 8, R₁ = 2 + 4 = 6, R₀ = 1/2 + 3 = 7/2
    exercise = rldrill.read({"family": "return", "given": {"gamma": "1/2", "rewards": ["1/2", 2, 8]}})
    diagnosis = exercise.diagnose("8, 6, 7/2")
    assert diagnosis.kind == "exchanged-cells"
    assert "opposite" not in diagnosis.sentence


def test_nobody_goes_on_with_a_share_that_is_negative_or_more_than_1() -> None:
    given = {"prior": {"rain": "1/4", "sun": "3/4"}, "likelihood": {"wet": {"rain": "4/5", "sun": "2/5"}}}
    exercise = rldrill.read({"family": "bayes-rule", "given": given | {"measurements": ["wet", "wet"]}})
    search = Search(exercise.solution)
    causes = [cause for application in search.applications for cause in search.alternatives(application)]
    slipped = [cause.became for cause in causes if cause.kind not in ("tenfold", "digits")]
    assert len(slipped) > 50
    assert all(0 <= share <= 1 for share in slipped)
    assert any(cause.became > 1 for cause in causes)  # 2/5 with its point one place further


def test_the_answer_to_a_part_before_is_named() -> None:
    # N(0, 1) moved by 2 ± 1 is N(2, 2); with the gain 1/2 the reading 4 makes it N(3, 1), and 1 ± 1 more N(4, 2).
    steps = [{"u": [2], "z": [4]}, {"u": [1]}]
    given = {"mean": [0], "covariance": [[1]], "process": [[1]], "sensor": [[2]], "steps": steps}
    exercise = rldrill.read({"family": "kalman-filter", "given": given})
    assert exercise.diagnose("2, 2", "b").sentence == "It looks as if you gave the answer to (a)."
    assert exercise.diagnose("3, 1", "c").sentence.startswith("It looks as if you gave the answer to (b)")
    assert exercise.diagnose("3, 1", "a").kind != "another-part"  # which comes later


def test_another_value_of_what_is_asked_for_is_not_called_something_else() -> None:
    # s is 2 or −8 by φ₂, at the distance 5 from −3, and 2 or 14 by φ₄, at the distance 6 from 8.
    given = {"centres": [[1], [-3], [-1], [8]], "sigma": 6, "logarithms": {"2": "-25/72", "4": "-1/2"}}
    exercise = rldrill.read({"family": "rbf", "given": given})
    assert "gave s" not in exercise.diagnose("-8", "a").sentence


@pytest.mark.parametrize(("typed", "named"), [("7/2, 8, 6", False), ("6, 8, 7/2", True), ("8, 7/2, 6", True)])
def test_right_numbers_in_another_order_are_told_as_that(typed: str, named: bool) -> None:
    # R₂ = 8, R₁ = 2 + 4 = 6, R₀ = 1/2 + 3 = 7/2, asked for in the order R₀, R₁, R₂
    exercise = rldrill.read({"family": "return", "given": {"gamma": "1/2", "rewards": ["1/2", 2, 8]}})
    diagnosis = exercise.diagnose(typed)
    assert (diagnosis.kind == "answer-rearranged") is named
    assert ("these are the right numbers, in the wrong order" in diagnosis.sentence) is named


def test_a_mistake_that_cannot_be_made_is_not_told() -> None:
    # γ = 1: the ratio is (1/2)/(1/4) · (1/2)/(1/4) = 4, the return 3 + 5 = 8. Without r₁ it is 5, and so it is with γ·i
    # for γⁱ; but nobody multiplies by i where there is no discount.
    half, quarter = {"on": "1/2", "off": "1/2"}, {"on": "1/4", "off": "3/4"}
    episode = {"states": ["a", "b", "end"], "actions": ["on", "on"], "rewards": [3, 5], "terminal": ["end"]}
    given = {
        "target": {"a": half, "b": half},
        "behaviour": {"a": quarter, "b": quarter},
        "gamma": 1,
        "episodes": [episode],
    }
    exercise = rldrill.read({"family": "importance-sampling", "given": given})
    assert exercise.check("32", "b").outcome is Outcome.RIGHT
    assert "not the product γ·i" not in exercise.diagnose("20", "b").sentence


def test_a_sentence_begins_with_the_letter_that_it_is_about(run: rldrill.Exercise) -> None:
    # α multiplies the target only, in the second update: 10 + 1/4·(−3 + 1/2·9) − 10 = 3/8
    assert run.diagnose("cave: 13/2, floor: 3/8").sentence.startswith("α multiplies the whole TD error")
