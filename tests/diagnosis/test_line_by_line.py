"""Lines as students write them: each right one is right, or passed over, and each wrong result is found."""

import pytest
from flint import fmpq
from sympy import log

import rldrill
from rldrill.solutions.diagnosis.on_the_way import places
from rldrill.solutions.formula.notation import Greatest, gamma

# cave: 8 + 1/2·(8 + 1/2·8 − 8) = 10, by the target 8 + 4 = 12 and the error 12 − 8 = 4.
UPDATE = rldrill.read(
    {
        "family": "td-zero",
        "given": {
            "trajectory": {"states": ["cave", "rim"], "rewards": [8]},
            "values": {"cave": 8, "rim": 8},
            "alpha": "1/2",
            "gamma": "1/2",
        },
    }
)
# V(cool) = 4 + 1/2·V(warm) and V(warm) = 1 + 1/2·V(cool), so V(cool) = 6 and V(warm) = 4.
SYSTEM = rldrill.read(
    {
        "family": "policy-value",
        "given": {
            "mdp": {"transitions": [["cool", "go", "warm", 1, 4], ["warm", "go", "cool", 1, 1]]},
            "gamma": "1/2",
        },
    }
)
# Before the measurement 2 − 2 = 0 and 7 + 5 = 12; K = 12/(12 + 6) = 2/3; then 0 + 2/3·7 = 14/3 and (1 − 2/3)·12 = 4.
FILTER = rldrill.read(
    {
        "family": "kalman-filter",
        "given": {
            "mean": [["2"]], "covariance": [["7"]], "A": [["1"]], "C": [["1"]], "process": [["5"]], "sensor": [["6"]],
            "steps": [{"u": [["-2"]], "z": [["7"]]}],
        },
    }
)  # fmt: skip
# R₀ = 7 − 3 = 4 and R′₀ = 8 + 3/2 − 9/16·8 = 5.
EPISODES = rldrill.read(
    {"family": "return", "given": {"rewards": ["7", "-4"], "others": ["8", "2", "-8"], "gamma": "3/4"}}
)
# ln n = 2(ln 64 − ln 4)/2 = 4 ln 2, so n = 16.
BORDER = rldrill.read(
    {
        "family": "bic",
        "given": {
            "fitted": {"small": {"likelihood": "1/64", "k": 1}, "large": {"likelihood": "1/4", "k": 3}},
            "border": "more",
        },
    }
)
# (1, 4) + 1/2·(1, 4) + 1/4·(2, 0) = (2, 6) and (1, 4) + 1/2·(2, 0) + 1/4·(1, 4) = (9/4, 5): the mean is (17/8, 11/2).
FEATURES = rldrill.read(
    {
        "family": "feature-expectations",
        "given": {
            "features": {"high": ["1", "4"], "medium": ["2", "0"]},
            "trajectories": [["high", "high", "medium"], ["high", "medium", "high"]],
            "gamma": "1/2",
        },
    }
)
# h(search) = 3 ln 2, and e to that is 8; so π(search) = 8/9.
SOFTMAX = rldrill.read(
    {
        "family": "softmax-policy",
        "given": {
            "theta": ["ln 2", "ln 2", "ln 2"],
            "features": {"search": ["1", "1", "1"], "recharge": ["0", "0", "0"]},
        },
    }
)
# e(middle) = 1/2·1 = 1/2 at the visit to start; δ = −3 + 4 − 10 = −9, so Q(middle) = 4 + 1/4·(−9)·1/2 = 23/8.
TRACES = rldrill.read(
    {
        "family": "sarsa-lambda",
        "given": {
            "trajectory": {
                "states": ["start", "middle"],
                "actions": ["walk", "walk"],
                "rewards": ["-3"],
                "terminal": [],
            },
            "values": {"start": {"walk": "10", "back": "8"}, "middle": {"walk": "4", "back": "6"}},
            "alpha": "1/4",
            "gamma": "1",
            "lam": "1/2",
            "traces": {"start": {"walk": "0", "back": "0"}, "middle": {"walk": "1", "back": "0"}},
        },
    }
)


def standings(exercise: rldrill.Exercise, *lines: str) -> list[str]:
    return [line.standing for line in exercise.follow(list(lines)).lines]


@pytest.mark.parametrize(
    "line",
    [
        "1/2*8 = 4", "8 + 1/2*8 = 12", "8 + 4 = 12", "12 - 8 = 4", "1/2*4 = 2", "8 + 2 = 10", "target = 8 + 4 = 12",
        "V(cave) <- 8 + 2 = 10", "δ = 4", "the answer is 10",
    ],
)  # fmt: skip
def test_what_is_worked_out_on_the_way_is_right(line: str) -> None:
    assert standings(UPDATE, line) == ["right"]


@pytest.mark.parametrize("line", ["3*7 = 21", "8 - 1/2 = 15/2", "W(cave) = 10", "E = 12", "V(hall) = 8 + 2 = 10"])
def test_what_is_true_and_no_step_is_passed_over(line: str) -> None:
    assert standings(UPDATE, line) == ["unread"]


@pytest.mark.parametrize(("line", "standing"), [("δ = 4", "right"), ("δ = 5", "departs"), ("R = 5", "unread")])
def test_the_letter_of_an_error_is_known(line: str, standing: str) -> None:
    assert standings(UPDATE, line) == [standing]


#: Without γ: 8 + 1/2·(8 + 8 − 8) = 12, which is the target, too: the numbers tell them apart.
def test_a_step_with_one_thing_changed_is_found_without_a_name() -> None:
    followed = UPDATE.follow(["8 + 1/2*(8 + 8 - 8) = 12"])
    assert [line.standing for line in followed.lines] == ["departs"]
    assert "γ is missing" in followed.sentence


def test_a_number_that_is_worked_out_no_further_is_a_bare_one() -> None:
    # h(search) = ln 2 + ln 2 + ln 2
    assert standings(SOFTMAX, "3 ln 2") == ["right"]
    assert standings(SOFTMAX, "4 ln 2") == ["departs"]


def test_the_answer_is_right_behind_a_number_that_nothing_explains() -> None:
    assert standings(UPDATE, "999/7", "10") == ["departs", "right"]


@pytest.mark.parametrize(
    ("line", "standing"),
    [
        ("V(warm) = 1 + 1/2 V(cool)", "right"),
        ("V(cool) = 4 + 0.5 V(warm)", "right"),
        ("V^π(cool) = 4 + 1/2(1 + 1/2·V^π(cool))", "right"),
        ("2 V(warm) = 8", "right"),
        ("3/4 V(cool) = 9/2", "right"),
        ("V(cool) - V(warm) = 2", "right"),
        ("2 V(warm) = 4", "departs"),  # 2·4 is 8
        ("V(cool) - 2 = 6", "departs"),  # 6 − 2 is 4
        ("V(cool) = 4 + V(warm)", "departs"),  # 4 + 4 is 8
        ("V(cool) + c = 6", "unread"),
        ("y V(cool) = 6", "unread"),
    ],
)
def test_an_equation_in_names_is_right_where_the_solution_makes_its_sides_equal(line: str, standing: str) -> None:
    assert standings(SYSTEM, line) == [standing]


def test_what_follows_in_a_system_follows_from_what_was_found() -> None:
    # with V(cool) = 8, which is wrong, V(warm) = 1 + 1/2·8 = 5
    assert standings(SYSTEM, "V(cool) = 4 + 4 = 8", "V(warm) = 1 + 1/2*8 = 5") == ["departs", "follows"]


def test_of_a_wrong_equation_in_names_nothing_is_said_of_the_next_lines() -> None:
    assert standings(SYSTEM, "V(cool) = 4 + V(warm)", "V(warm) = 6", "V(cool) = 10") == ["departs", "unread", "unread"]


@pytest.mark.parametrize("name", ["R'0", "R0'", "R'_0", "R_0'", "R′₀", "R’0"])
def test_a_stroke_may_be_typed(name: str) -> None:
    # −17/2 is 8 + 3/2 − 9/4·8, with only 3 squared
    assert standings(EPISODES, "R0 = 4", f"{name} = 5", f"{name} = -17/2") == ["right", "right", "departs"]


def test_a_letter_without_its_index_is_a_name() -> None:
    right = ["μ̄ = 0", "Σ̄ = 7 + 5 = 12", "K = 12/18 = 2/3", "μ = 14/3", "Σ = (1 - 2/3)*12 = 4"]
    assert standings(FILTER, *right) == ["right"] * 5
    followed = FILTER.follow([*right[:2], "K = 7/13", "μ = 49/13", "Σ = 6/13*12 = 72/13"])  # 7 put in for 12
    assert [line.standing for line in followed.lines] == ["right", "right", "departs", "follows", "follows"]
    assert "The gain weighs the belief after the motion" in followed.sentence


def test_the_condition_of_a_probability_may_be_left_out() -> None:
    assert standings(SOFTMAX, "π(search) = 8/9") == ["right"]
    assert standings(SOFTMAX, "π(search) = 6/7") == ["departs"]


@pytest.mark.parametrize("line", ["e^(3 ln 2) = 6", "exp(3 ln 2) = 6", "ln 8 = 3"])
def test_a_function_of_numbers_is_a_number(line: str) -> None:
    assert standings(SOFTMAX, line) == ["miscalculated"]


@pytest.mark.parametrize("line", ["n = 4", "ln n = 2 ln 2", "8 ln 2 = 3 ln n"])
def test_a_wrong_value_of_the_letter_that_is_asked_for_is_told(line: str) -> None:
    assert standings(BORDER, line) == ["departs"]


@pytest.mark.parametrize("line", ["n = 16", "ln n = 4 ln 2", "8 ln 2 = 2 ln n"])
def test_the_letter_that_is_asked_for_may_stand_in_an_equation(line: str) -> None:
    assert standings(BORDER, line) == ["right"]


@pytest.mark.parametrize("line", ["μ = (2.125, 5.5)", "2.125, 5.5", "(17/8, 11/2)", "μ(π) = (17/8, 5.5)"])
def test_an_answer_may_be_a_vector(line: str) -> None:
    assert standings(FEATURES, line) == ["right"]


def test_a_wrong_vector_under_the_name_that_is_asked_for_is_told() -> None:
    assert standings(FEATURES, "μ = (2, 5.5)") == ["departs"]


def test_the_old_value_of_what_is_updated_next_is_held_against_the_update() -> None:
    # λ forgotten: 1·1 = 1, the old value; from there 4 − 9/4 = 7/4 follows
    lines = ["e(start,walk) = 1", "e(middle,walk) = 1", "Q(middle,walk) = 4 - 9/4 = 7/4"]
    followed = TRACES.follow(lines)
    assert [line.standing for line in followed.lines] == ["right", "departs", "follows"]
    assert "λ is missing in e(middle, walk)" in followed.sentence


@pytest.mark.parametrize("family", rldrill.families()[::9])
def test_no_line_of_the_working_itself_goes_wrong(family: str) -> None:
    exercise = rldrill.draw(family, level=2, seed=19)
    followed = exercise.follow(str(exercise.working()).splitlines())
    assert [line for line in followed.lines if line.standing not in ("right", "unread")] == []


@pytest.mark.parametrize("family", ["return-infinite", "value-iteration", "max-margin", "lqr-reward"])
def test_nothing_is_said_twice(family: str) -> None:
    exercise = rldrill.draw(family, level=1, seed=1)
    for part in exercise.parts:
        for wrong in exercise.diagnosing.wrong_answers(part.label, 6):
            said = exercise.follow([wrong.answer]).sentence.rstrip(".").partition("it looks as if ")[2].split(", or ")
            assert len(said) == len(set(said))


def test_of_what_is_not_real_there_is_no_greatest_and_the_rest_is_on_the_way() -> None:
    # With a γ of −1/2 of one's own ln γ is iπ − ln 2.
    found = [str(place.worth) for place in places(Greatest(log(gamma), gamma), {"gamma": fmpq(-1, 2)})]
    assert "-log(2) + I*pi" in found
    assert not any("Max" in worth for worth in found)
