"""Somebody's own working, held against the right one."""

from collections import Counter
from fractions import Fraction

import pytest

import rldrill
from promptness import at_once
from rldrill.problems.notations import used
from rldrill.solutions.diagnosis.written_line import apart, numbers_typed

# As in test_diagnosing.py: cave ← 10, floor ← 5, cave ← 17/4.
RUN = {
    "family": "td-zero",
    "given": {
        "trajectory": {"states": ["cave", "floor", "cave", "rim"], "rewards": [8, -3, -4]},
        "values": {"cave": 8, "floor": 8, "rim": 5},
        "alpha": "1/2",
        "gamma": "1/2",
    },
}


@pytest.fixture(scope="module")
def run() -> rldrill.Exercise:
    return rldrill.read(RUN)


@pytest.mark.parametrize(
    "lines",
    [
        ["V(cave) = 8 + 1/2*(8 + 1/2*8 - 8) = 10", "V(floor) = 5", "V(cave) = 17/4"],
        ["10", "5", "4.25"],
        ["V(cave) = 17/4"],
        ["t = 0: V(cave) ← 8 + 1/2*(8 + 1/2*8 - 8) = 10", "k=1: V(floor) ← -3 + 8 = 5", "(8 + 1)/2 - 1/4 = 17/4"],
        ["(1) V(cave) = 10", "[2] 5", "(c) 17/4"],
        ["V(cave): 8 → 10", "8 ⇒ 8 - 3 = 5", "V(cave) = 10 → 17/4"],
        ["δ = 4", "V(cave) ← 8 + 1/2*4 = 10", "δ = -6", "V(floor) = 8 - 3 = 5"],
    ],
)
def test_a_right_working_is_right_however_it_is_written(run: rldrill.Exercise, lines: list[str]) -> None:
    followed = run.follow(lines)
    assert followed.first is None
    assert {line.standing for line in followed.lines} == {"right"}


def test_the_first_line_that_departs_is_named_and_the_rest_follows(run: rldrill.Exercise) -> None:
    # first update without γ: 8 + 1/2·(8 + 8 − 8) = 12; then rightly 8 + 1/2·(−3 + 6 − 8) = 11/2
    # and 12 + 1/2·(−4 + 11/4·0 …): the third goes to rim: 12 + 1/2·(−4 + 5/2 − 12) = 21/4
    followed = run.follow(["V(cave) = 8 + 1/2*(8 + 8 - 8) = 12", "V(floor) = 11/2", "V(cave) = 21/4"])
    assert followed.first == 0
    assert [line.standing for line in followed.lines] == ["departs", "follows", "follows"]
    assert "γ is missing in the first update (t = 0)" in followed.sentence
    assert followed.lines[0].step == 0


#: The second update without γ, 8 + 1/2·(−3 + 10 − 8), the first one without it, 8 + 1/2·(8 + 8 − 8), and anything.
@pytest.mark.parametrize("value", ["7.5", "12", "123/7"])
def test_a_line_without_a_name_is_held_against_the_steps_that_are_left(run: rldrill.Exercise, value: str) -> None:
    followed = run.follow(["10", value])
    assert [line.step for line in followed.lines] == [0, 1]


@pytest.mark.parametrize(
    "line",
    [
        "-2 + 13 = 10",
        "−2 + 13 = 10",
        "(1 + 10) = 10",
        "√4 + 9 = 10",
        ".5 + 11/2 = 10",
        "e^0 + 11 = 10",
        "[1] -2 + 13 = 10",
        "(2) 11 - 0 = 10",
        "t = 0: sqrt(4) + 9 = 10",
    ],
)
def test_a_line_that_begins_with_a_sign_is_worked_out_too(run: rldrill.Exercise, line: str) -> None:
    assert [told.standing for told in run.follow([line]).lines] == ["miscalculated"]


def test_a_slip_of_arithmetic_is_told_from_a_wrong_formula(run: rldrill.Exercise) -> None:
    followed = run.follow(["V(cave) = 10", "V(floor) = 8 + 1/2*(-6) = 4"])
    assert [line.standing for line in followed.lines] == ["right", "miscalculated"]
    assert "is not 4: a slip of arithmetic in the second update (t = 1)" in followed.sentence


def test_words_are_passed_over(run: rldrill.Exercise) -> None:
    followed = run.follow("first the cave\nV(cave) = 10")
    assert [line.standing for line in followed.lines] == ["unread", "right"]


@pytest.mark.parametrize(
    ("line", "said"),
    [  # the right line is 8 + 1/2*(8 + 1/2*8 - 8) = 10
        ("8 + 1/2*(8 + 1/2*7 - 8)", "7 is put in for V(sₜ₊₁), which is 8"),
        ("8 + 1/2*(9 + 1/2*8 - 8) = 21/2", "9 is put in for rₜ₊₁, which is 8"),
        ("8 + 1/3*(8 + 1/2*8 - 8)", "1/3 is put in for α, which is 1/2"),
        ("8 + 1/2*(8 + 1/2*8)", "V(sₜ) is missing"),
        ("8 + 1/2*(8 + 8 - 8)", "γ is missing"),
    ],
)
def test_the_numbers_in_a_line_tell_how_its_value_was_found(run: rldrill.Exercise, line: str, said: str) -> None:
    assert f"{said} in the first update" in run.follow([f"V(cave) = {line}"]).sentence


def test_an_equation_is_read_with_the_values_that_solve_the_system() -> None:
    # V(warm) = 1 + 1/2·V(cool) and V(cool) = 4 + 1/2·V(warm): 4 and 6.
    rows = [["cool", "go", "warm", 1, 4], ["warm", "go", "cool", 1, 1]]
    exercise = rldrill.read({"family": "policy-value", "given": {"mdp": {"transitions": rows}, "gamma": "1/2"}})
    followed = exercise.follow(["V(cool) = 4 + 1/2*2 = 5"])
    assert "2 is put in for V^π(warm), which is 4 in the equation of V^π(cool)" in followed.sentence
    assert exercise.follow(["V(cool) = 4 + 4"]).sentence.count("γ is missing") == 1


# H = BᵀPB − R = −2 − 16 − 3 = −21; BᵀP = (−2, −8), so G = BᵀPA = (−10, −12); L = H⁻¹G = (10/21, 12/21);
# a = −Ls = −(30 + 36)/21 = −22/7
GAIN = {
    "family": "lqr-gain",
    "given": {
        "A": [["1", "2"], ["1", "1"]],
        "B": [["1"], ["2"]],
        "R": [["3"]],
        "P": [["-2", "0"], ["0", "-4"]],
        "start": ["3", "3"],
    },
}


def test_a_line_may_hold_a_matrix() -> None:
    followed = rldrill.read(GAIN).follow(["H_0 = -21", "G_0 = [-10, -12]", "L_0 = [10/21 12/21]", "a_0 = -22/7"])
    assert [line.standing for line in followed.lines] == ["right"] * 4
    assert [line.step for line in followed.lines] == [0, 1, 2, 3]


def test_what_follows_from_a_wrong_matrix_is_told() -> None:
    # with the gain (10/21, −12/21) the action is −(30 − 36)/21 = 2/7
    followed = rldrill.read(GAIN).follow(["G_0 = [-10 -12]", "L_0 = [10/21 -4/7]", "a_0 = 2/7"])
    assert [line.standing for line in followed.lines] == ["right", "departs", "follows"]
    assert followed.lines[1].step == 2
    assert followed.lines[1].kind == "sign"


@pytest.mark.parametrize(
    ("line", "numbers"),
    [
        ("8 + 1/2*(8 + 1/2*8 - 8)", {8: 4, Fraction(1, 2): 2}),
        ("0 + 1*(3 - 2) - 2", {3: 1, 2: 2}),  # a person leaves zeros and ones out, so they tell nothing
        ("-4/3 - 4", {Fraction(4, 3): 1, 4: 1}),
        ("17/4", None), ("-6", None), ("8 + ", None),
    ],
)  # fmt: skip
def test_a_line_is_known_by_its_numbers(line: str, numbers: dict[Fraction, int] | None) -> None:
    assert numbers_typed(line) == (None if numbers is None else Counter(numbers))


# s₁ = (1 + 1, −1 + 1 + 1) = (2, 1) with a₀ = 1; r(s₀, a₀) = −(3 + 2 + 1) = −6, and at the end −(3·4 + 2·1) = −14.
ROLLOUT = {
    "family": "lqr-reward",
    "given": {
        "A": [[1, 1], [-1, 1]], "B": [[0], [1]], "Q": [[3, 0], [0, 2]], "R": [[1]], "start": [1, 1], "horizon": 1,
        "L": [[0, -1]], "gamma": "1/3",
    },
}  # fmt: skip


@pytest.mark.parametrize("line", ["s_1 = 2, 1", "s1 = (2, 1)", "s1 = [2; 1]", "r1 = -14", "r(s1) = -14", "r0 = -6"])
def test_a_vector_needs_no_brackets_and_a_reward_may_be_called_by_its_time(line: str) -> None:
    (told,) = rldrill.read(ROLLOUT).follow([line]).lines
    assert told.standing == "right"


@pytest.mark.parametrize(("line", "where"), [("r1 = -5", "r(s₁)"), ("r0 = -5", "r(s₀, a₀)")])
def test_a_wrong_reward_is_held_against_that_of_its_time(line: str, where: str) -> None:
    followed = rldrill.read(ROLLOUT).follow([line])
    assert followed.lines[0].standing == "departs"
    assert where in followed.sentence


def test_lines_are_as_far_apart_as_numbers_stand_in_one_alone() -> None:
    one, other = (Counter(map(Fraction, numbers)) for numbers in (("1/2", "3"), ("1/2", "4", "4")))
    assert apart(one, other) == 3  # the 3, and 4 twice
    assert apart(one, one) == 0


@pytest.mark.parametrize(("line", "standing"), [("-5/7", "departs"), ("√4 + 8", "right"), ("(8 + 12)/2", "right")])
def test_a_line_that_begins_with_a_sign_is_no_name(run: rldrill.Exercise, line: str, standing: str) -> None:
    (told,) = run.follow([line]).lines  # what is right is 10
    assert told.standing == standing


SOUGHT = {
    "family": "td-zero",
    "given": {
        "trajectory": {"states": ["cave", "rim"], "rewards": [8]},
        "values": {"cave": 8, "rim": 4},
        "alpha": "1/2",
        "gamma": "gamma",
        "known": 9,
    },
}


# 8 + 1/2·(8 + 4γ − 8) = 8 + 2γ = 9, so 2γ = 1 and γ = 1/2.
@pytest.mark.parametrize(
    "line",
    [
        "V(cave) = 8 + 1/2*(8 + 4γ - 8) = 8 + 2γ",
        "8 + 2γ",
        "8 + 2γ = 9",
        "9 = 8 + gamma*2",
        "2γ = 9 - 8 = 1",
        "γ = 1/2",
        "gamma: 0.5",
        "= 1/2",
        "1/2",
        "so V(cave) = 8 + 2*1/2 = 9",
        "V(cave) = 9, γ = 1/2",
        "(1 - γ)*2 = 1",
    ],
)
def test_the_letter_that_is_sought_may_stand_in_a_right_working(line: str) -> None:
    (told,) = rldrill.read(SOUGHT).follow([line]).lines
    assert (told.standing, told.sentence) == ("right", "")


@pytest.mark.parametrize("line", ["γ = 1/4", "8 + 2γ = 10", "V(cave) = 8 + 4γ = 9"])
def test_an_equation_that_the_letter_does_not_solve_goes_wrong(line: str) -> None:
    (told,) = rldrill.read(SOUGHT).follow([line]).lines
    assert (told.standing, told.sentence) == ("departs", "Here the working goes wrong.")


def test_of_a_wrong_line_with_a_letter_nothing_is_said_of_the_next_ones() -> None:
    # without V(cave) in the brackets: 8 + 1/2·(8 + 4γ) = 12 + 2γ, from which γ would be −3/2
    lines = ["V(cave) = 8 + 1/2*(8 + 4γ) = 12 + 2γ", "12 + 2γ = 9", "γ = -3/2"]
    assert [line.standing for line in rldrill.read(SOUGHT).follow(lines).lines] == ["departs", "unread", "unread"]


@pytest.mark.parametrize(
    "line",
    [
        "V(rim) = 5",  # given
        "V(cave) = 8",  # before the first update
        "so r_1 = 8",
        "V(cave) = 10, V(floor) = 5 and V(cave) = 17/4",
        "V^pi(floor) = 5",
        "V'(cave) = 10",
    ],
)
def test_what_is_given_or_found_is_right_under_its_name(run: rldrill.Exercise, line: str) -> None:
    (told,) = run.follow([line]).lines
    assert told.standing == "right"


@pytest.mark.parametrize(
    "line",
    [
        "n = 1",
        "A = B = C = 1",
        "(e)",
        "(E).",
        "The episode ends at T = 3.",
        "x = 5",  # a name of one's own, though the second update gives 5
        "⎡1/2  3⎤",
        "c(3 - 1) = 7",
    ],
)
def test_what_is_no_step_is_not_held_against_one(run: rldrill.Exercise, line: str) -> None:
    (told,) = run.follow([line]).lines
    assert told.standing == "unread"


def test_a_line_that_begins_with_an_equals_sign_or_a_plus_goes_on_with_the_one_before(run: rldrill.Exercise) -> None:
    lines = ["V(cave) = 8 + 1/2*8", "+ 1/2*(1/2*8 - 8)", "= 12 - 2", "= 10", "V(floor) = 8 + 1/2*(-3 + 5 - 8)", "= 4"]
    told = run.follow(lines).lines
    assert [line.standing for line in told] == ["right", "right", "right", "right", "right", "miscalculated"]
    assert [line.text for line in told] == lines


# Before the measurement 1·1/2 + 1/3·1/2 = 2/3 for dry: whoever forgets the second term has 1/2.
@pytest.mark.parametrize("name", ["p̄(dry)", "p(dry)", "p_bar(dry)", "p1(dry)"])
def test_a_sign_above_a_letter_may_be_left_out_or_spelled(name: str) -> None:
    motion = {"go": {"dry": {"dry": 1}, "wet": {"dry": "1/3", "wet": "2/3"}}}
    given = {"belief": {"dry": "1/2", "wet": "1/2"}, "motion": motion, "actions": ["go"]}
    exercise = rldrill.read({"family": "bayes-predict", "given": given})
    lines = [exercise.follow([f"{name} = {value}"]).lines[0].standing for value in ("2/3", "1/2 + 1/3*1/2", "2/7")]
    assert lines == ["right", "right", "departs"]


def test_of_two_equations_on_a_line_the_wrong_one_is_told(run: rldrill.Exercise) -> None:
    (told,) = run.follow(["V(cave) = 10, V(floor) = 9"]).lines
    assert (told.standing, told.step) == ("departs", 1)


#: R₀ = 3 + 1/2·4 + 1/4·(−8) = 3 + 2 − 2 = 3.
LONG_SUM = rldrill.read({"family": "return", "given": {"gamma": "1/2", "rewards": [3, 4, -8], "time": 0}})


@pytest.mark.parametrize("lines", [
    ["R0 = 3 + 1/2*4", "- 1/4*8", "= 3"], ["R0 = 3", "+ 1/2*4", "− 1/4*8", "= 3"], ["R0 = 3 + 1/2*4 +", "1/4*(-8) = 3"],
    ["- R0 = 3 + 1/2*4 + 1/4*(-8)", "- R0 = 3 + 2 - 2", "- R0 = 3"],
    ["+ R0 = 3 + 2 - 2", "+ 3 + 2 - 2 = 3"],
])  # fmt: skip
def test_a_sum_goes_on_in_the_next_line_and_a_list_has_items(lines: list[str]) -> None:
    assert [line.standing for line in LONG_SUM.follow(lines).lines] == ["right"] * len(lines)


def test_a_sum_that_goes_on_wrongly_is_found_there() -> None:
    standings = [line.standing for line in LONG_SUM.follow(["R0 = 3 + 1/2*4", "- 1/4*8", "= 4"]).lines]
    assert standings == ["right", "right", "miscalculated"]


@pytest.mark.parametrize("lines", [["R0 = 1", *["+ 1"] * 2000], ["R0 = 1", *["= 1"] * 200], ["x" * 100_000]])
def test_what_is_pasted_without_end_takes_no_time(lines: list[str]) -> None:
    exercise = rldrill.load("return/1/430")
    exercise.follow(["1"])  # what is compared with is made once
    with at_once():
        assert len(exercise.follow(lines).lines) == len(lines)


def test_a_line_is_handed_back_as_it_was_typed() -> None:
    with used("control"):
        told = rldrill.load("linearise/1/5").follow(["A_21 = $-10$", " ", "$5$"])
    assert [line.text for line in told.lines] == ["A_21 = $-10$", "$5$"]


#: V(a) ← 1/3·7 = 7/3, then V(b) ← 1/3·(1 + 7/3) = 10/9; with 2.3 for the first the second is 1.1.
THIRDS = {
    "family": "td-zero",
    "given": {
        "trajectory": {"states": ["a", "b", "a"], "rewards": [7, 1]},
        "values": {"a": 0, "b": 0},
        "alpha": "1/3",
        "gamma": 1,
    },
}


@pytest.mark.parametrize(
    ("lines", "standings"),
    [
        (["V(a) = 2.33", "V(b) = 1.11"], ["right", "right"]),
        (["V(a) = 2.3", "V(b) = 1/3*(1 + 2.3) = 1.10"], ["short", "follows"]),
        (["V(a) = 7/3 = 2.3", "V(b) = 10/9"], ["short", "follows"]),
        (["V(a) = 2.4"], ["departs"]),
        (["V(a) = 2.2"], ["departs"]),
    ],
)
def test_a_value_with_too_few_digits_is_told_so(lines: list[str], standings: list[str]) -> None:
    followed = rldrill.read(THIRDS).follow(lines)
    assert [line.standing for line in followed.lines] == standings
    assert ("too few digits" in followed.sentence) == ("short" in standings)


# p(z) = 3/5·1/2 + 1/5·1/2 = 2/5 and the belief (3/10, 1/10)/(2/5) = (3/4, 1/4); then the motion gives 3/4 + 4/5·1/4
# = 19/20 and 1/20, p(z) = 3/5·19/20 + 1/5·1/20 = 29/50, and 57/58.
DOOR = {
    "family": "bayes-filter",
    "given": {
        "belief": {"open": "1/2", "closed": "1/2"},
        "run": [{"measurement": "seen open"}, {"action": "push", "measurement": "seen open"}],
        "likelihood": {"seen open": {"open": "3/5", "closed": "1/5"}},
        "motion": {"push": {"open": {"open": 1}, "closed": {"open": "4/5", "closed": "1/5"}}},
    },
}


@pytest.mark.parametrize(
    ("line", "standing"),
    [
        ("p(z) = .6*.5 + .2*.5 = .4", "right"), ("p(z) = .6*.5 + .2*.5 = .5", "miscalculated"),
        ("p(z) = 0.5", "departs"), ("p(seen open) = 2/5", "right"), ("p(z2) = 29/50", "right"),
        ("p(closed|z) = 1/4", "right"),
        ("p(closed|z) = .5", "departs"), ("bel(open) = 2.5*.3 = .75", "right"), ("bel(closed) = 1/4", "right"),
        ("bel(closed)=2.5*.2=.5", "departs"), ("bel_bar(open) = 0.95", "right"), ("bel(seen) = 1/2", "unread"),
    ],
)  # fmt: skip
def test_the_names_of_probabilistic_robotics_are_read(line: str, standing: str) -> None:
    (told,) = rldrill.read(DOOR).follow([line]).lines
    assert told.standing == standing


def test_what_was_not_judged_is_not_said_to_be_right(run: rldrill.Exercise) -> None:
    assert run.follow(["V(cave) = 10", "x = 7"]).sentence == "The rest is right; one line was not judged."
    assert run.follow(["V(cave) = 10", "x = 7", "y = 5"]).sentence == "The rest is right; 2 lines were not judged."
    assert run.follow(["V(cave) = 10"]).sentence == "All of this is right as far as it goes."


# x = cos φ₁ + cos φ₂ and y = sin φ₁ + sin φ₂ with φ₁ = 0, φ₂ = π/2: J = (−1, −1; 1, 0).
ELBOW = {"family": "jacobian", "given": {"lengths": [1, 1], "angles": ["0", "π/2"], "rates": [1, 2]}}


@pytest.mark.parametrize(
    ("line", "standing"),
    [("J11 = -1", "right"), ("J_11 = -1", "right"), ("J12 = 1", "departs"), ("J21 = 1", "right"), ("J22 = 0", "right")],
)
def test_the_entries_of_a_matrix_that_is_asked_for_have_names(line: str, standing: str) -> None:
    (told,) = rldrill.read(ELBOW).follow([line]).lines
    assert told.standing == standing


# Ahead p(rain) = 0.7·1/2 + 0.3·1/2 = 1/2; with the umbrella 0.9·1/2 to 0.2·1/2, 9/11 to 2/11; ahead again
# 0.7·9/11 + 0.3·2/11 = 69/110 = 0.62727…, and 0.9·69/110 = 0.564545….
UMBRELLA = {
    "family": "bayes-filter",
    "given": {
        "belief": {"rain": "1/2", "dry": "1/2"},
        "run": [{"measurement": "umbrella", "action": "day"}, {"action": "day", "measurement": "umbrella"}],
        "motion": {"day": {"rain": {"rain": 0.7, "dry": 0.3}, "dry": {"rain": 0.3, "dry": 0.7}}},
        "likelihood": {"umbrella": {"rain": 0.9, "dry": 0.2}},
    },
}


@pytest.mark.parametrize(
    ("line", "standing"),
    [("0.9*0.627 = 0.565", "right"), ("0.9*0.627 = 0.575", "miscalculated"), ("0.9*0.627 = 0.58", "miscalculated")],
)
def test_a_calculator_may_keep_more_digits_than_are_written(line: str, standing: str) -> None:
    (told,) = rldrill.read(UMBRELLA).follow([line]).lines
    assert told.standing == standing


def test_what_is_not_divided_by_its_sum_yet_is_not_wrong() -> None:
    # d = (9, 4, 1)/14: with d(rainy) = 1 the others are 4 and 9.
    steps = [["sunny", "sunny", 0.8, 0], ["sunny", "cloudy", 0.2, 0], ["cloudy", "sunny", 0.4, 0],
             ["cloudy", "cloudy", 0.4, 0], ["cloudy", "rainy", 0.2, 0], ["rainy", "sunny", 0.2, 0],
             ["rainy", "cloudy", 0.6, 0], ["rainy", "rainy", 0.2, 0]]  # fmt: skip
    given = {"gamma": 1, "average": True, "mdp": {"transitions": steps}}
    followed = rldrill.read({"family": "policy-value", "given": given}).follow(["d(rainy) = 1", "d(rainy) = 1/14"])
    assert [line.standing for line in followed.lines] == ["unread", "right"]
