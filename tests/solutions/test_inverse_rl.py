"""Identities of inverse reinforcement learning, and one sentence for what does not fit."""

from fractions import Fraction
from typing import Any

import pytest
import sympy
from flint import fmpq
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import rldrill
from asking import solved
from numbers_drawn import small
from rldrill.problems.errors import FileError
from rldrill.render.mathematics.unicode import unicode
from rldrill.solutions.drawing import draw
from rldrill.solutions.exact import sign, to_sympy
from rldrill.solutions.formula.common_denominator import in_one_fraction
from rldrill.solutions.formula.typesetting import typeset
from rldrill.solutions.rational import generator

quick = settings(deadline=None, max_examples=25)
seeds = st.integers(0, 10_000)
numbers = small(-3, 3, 3).map(str)


def exactly(number: Any) -> fmpq:
    return fmpq(number.numerator, number.denominator)


@given(numbers, st.sampled_from(["0", "1/3", "9/10"]), seeds)
@quick
def test_a_constant_feature_without_an_end_is_worth_a_geometric_series(value: str, gamma: str, seed: int) -> None:
    given_ = draw("feature-expectations-policy", 2, seed).problem.data()["given"]
    states = list(given_["features"])
    motion = {action: {state: {states[0]: "1/4", states[1]: "3/4"} for state in states} for action in given_["motion"]}
    features = {state: [value] for state in states}
    answers = solved(
        "feature-expectations-policy",
        **given_ | {"motion": motion, "features": features, "gamma": gamma, "terminal": []},
    )
    assert set(answers["a"].values()) == {exactly(Fraction(value) / (1 - Fraction(gamma)))}
    assert answers["b"] == answers["a"][states[0]]


@given(seeds)
@quick
def test_feature_expectations_are_linear_in_the_features_and_make_the_value(seed: int) -> None:
    given_ = draw("feature-expectations-policy", 2, seed).problem.data()["given"]
    phi = {state: [3 * number + 1, 2 - number] for number, state in enumerate(given_["features"])}
    given_ |= {"features": phi}
    answers = solved("feature-expectations-policy", **given_)
    # With the reward 2 φ₁ − 3 φ₂ for being in a state, V solves the Bellman equations that policy-value solves.
    rows = [
        [state, action, target, chance, str(2 * Fraction(phi[state][0]) - 3 * Fraction(phi[state][1]))]
        for action, start in given_["motion"].items()
        for state, targets in start.items()
        for target, chance in targets.items()
    ]
    values = solved(
        "policy-value", gamma=given_["gamma"], policy=given_["policy"],
        mdp={"transitions": rows, "terminal": given_["terminal"]},
    )["a"]  # fmt: skip
    for state in given_["features"]:
        assert values[state] == 2 * answers["a"][state] - 3 * answers["b"][state]


@given(seeds)
@quick
def test_with_gamma_0_only_the_first_states_count(seed: int) -> None:
    given_ = draw("feature-expectations", 2, seed).problem.data()["given"]
    estimate = solved("feature-expectations", **given_ | {"gamma": 0})["a"]
    firsts = [given_["features"][trajectory[0]] for trajectory in given_["trajectories"]]
    for index, value in enumerate(estimate):
        total = sum((Fraction(first[index]) for first in firsts), Fraction(0))
        assert value == exactly(total / len(firsts))


@given(seeds)
@quick
def test_with_a_weight_left_open_every_other_weight_still_counts(seed: int) -> None:
    given_ = draw("max-margin", 3, seed).problem.given
    for index, value in enumerate(given_.expert):
        assert any(rival.mu[index] != value for rival in given_.policies.values())


@given(seeds, st.sampled_from([1, 2]))
@quick
def test_all_constraints_hold_with_the_slack_and_one_is_tight(seed: int, level: int) -> None:
    solution = draw("max-margin", level, seed)
    given_, answers = solution.problem.given, solution.answers
    expert, *others = answers["a"]
    need = [worth + exactly(rival.margin) for worth, rival in zip(others, given_.policies.values(), strict=True)]
    left = expert + answers["c"]
    assert all(left >= right for right in need)
    assert answers["c"] == 0 or left in need
    assert answers["b"] == sum(expert + exactly(given_.slack) >= right for right in need)


@pytest.mark.parametrize("level", [1, 2])
def test_most_draws_need_a_slack_and_there_the_one_that_is_given_helps_a_constraint(level: int) -> None:
    needed = 0
    for seed in range(60):
        solution = draw("max-margin", level, seed)
        missing = solution.problem.given.missing.values()
        if max(missing) > 0:
            needed += 1
            assert any(0 < violation <= solution.problem.given.slack for violation in missing)
    assert 36 <= needed <= 54


@given(seeds, st.sampled_from([1, 2]))
@quick
def test_the_projected_point_lies_on_the_segment_and_is_the_nearest(seed: int, level: int) -> None:
    solution = draw("apprenticeship", level, seed)
    given_ = solution.problem.given
    # Where the next policy is chosen, the share is not asked for, and one letter comes between.
    answers = dict(zip("bcad" if given_.candidates else "abcd", solution.answers.values(), strict=False))
    start, mu = ([exactly(value) for value in vector] for vector in (given_.first, given_.policies[0]))
    shares = {(m - s) / (e - s) for m, s, e in zip(answers["b"], start, mu, strict=True) if e != s}
    assert len(shares) == 1
    assert 0 < shares.pop() <= 1
    # What is left is at right angles to the line, and no longer than before.
    assert sum(w * (e - s) for w, s, e in zip(answers["c"], start, mu, strict=True)) == 0
    expert = [exactly(value) for value in given_.expert]
    before = sum((e - s) ** 2 for e, s in zip(expert, start, strict=True))
    last = answers["d"]
    assert sign(before - last**2) >= 0


@given(st.lists(st.integers(-4, 4), min_size=6, max_size=6))
@quick
def test_projection_goes_to_the_expert_where_it_is_on_the_line(numbers_: list[int]) -> None:
    first, way = numbers_[:3], numbers_[3:]
    assume(any(way))
    expert = [value + step for value, step in zip(first, way, strict=True)]
    mu = [value + 2 * step for value, step in zip(first, way, strict=True)]
    answers = solved("apprenticeship", expert=expert, first=first, policies=[mu])
    assert answers["b"] == tuple(map(fmpq, expert))
    assert answers["c"] == (0, 0, 0)
    assert answers["d"] == 0


FEATURES: dict[str, Any] = {"features": {"a": [1], "b": [2]}, "trajectories": [["a", "b"]], "gamma": "1/2"}
POLICY: dict[str, Any] = {
    "motion": {"go": {"a": {"b": 1}, "b": {"end": 1}}}, "policy": {"a": "go", "b": "go"}, "gamma": "1/2",
    "features": {"a": [1], "b": [2]}, "start": {"a": 1}, "terminal": ["end"],
}  # fmt: skip
MARGIN: dict[str, Any] = {"w": [1, 2], "expert": [3, 4], "policies": {"x": {"mu": [1, 1], "margin": 1}}}
APPRENTICE: dict[str, Any] = {"expert": [1, 2], "first": [0, 0], "policies": [[1, 0]]}


@pytest.mark.parametrize(
    ("name", "given_", "fragment"),
    [
        ("feature-expectations", FEATURES | {"trajectories": [["a", "c"]]}, "'c' is visited, but its features are"),
        ("feature-expectations", FEATURES | {"trajectories": [[]]}, "one of them has no states"),
        ("feature-expectations", FEATURES | {"features": {"a": [1], "b": [1, 2]}}, "same number of components"),
        ("feature-expectations-policy", POLICY | {"start": {"a": "1/2"}}, "start: the probabilities sum to 1/2"),
        ("feature-expectations-policy", POLICY | {"start": {"end": 1}}, "start probability is given for 'end'"),
        ("feature-expectations-policy", POLICY | {"terminal": []}, "motion of 'go' in 'b' is given for 'end'"),
        ("feature-expectations-policy", POLICY | {"policy": {"a": "go"}}, "the policy of 'b' is missing"),
        ("feature-expectations-policy", POLICY | {"policy": {"a": "go", "b": "stop"}}, "given for 'stop'"),
        ("feature-expectations-policy", POLICY | {"terminal": ["end", "b"]}, "'b' is terminal, so no features count"),
        ("max-margin", MARGIN | {"w": [1]}, "'w' has 1"),
        ("max-margin", MARGIN | {"policies": {"expert": {"mu": [1, 1], "margin": 1}}}, "is the name of the expert's"),
        ("max-margin", MARGIN | {"policies": {"x": {"mu": [1, 1], "margin": -1}}}, "a margin is not negative"),
        ("max-margin", MARGIN | {"w": ["x", "x"]}, "leave one weight open at most"),
        ("apprenticeship", APPRENTICE | {"policies": [[1]]}, "'policy 1' has 1"),
        ("apprenticeship", APPRENTICE | {"policies": [[0, 0]]}, "no line through both"),
    ],
)
def test_what_does_not_fit_is_one_sentence(name: str, given_: dict[str, Any], fragment: str) -> None:
    with pytest.raises(FileError) as error:
        solved(name, **given_)
    assert fragment in str(error.value)
    assert "\n" not in str(error.value)


def test_feature_expectations_that_do_not_exist_are_one_sentence() -> None:
    with pytest.raises(FileError, match="no answer"):
        solved("feature-expectations-policy", **POLICY | {"motion": {"go": {"a": {"a": 1}, "b": {"a": 1}}}, "gamma": 1})


def test_an_open_discount_gives_a_rational_function() -> None:
    # One state that is never left: 1 + γ + γ² + … = 1/(1 − γ).
    forever = {"motion": {"go": {"a": {"a": 1}}}, "policy": {"a": "go"}, "features": {"a": [1]}, "start": {"a": 1}}
    answers = solved("feature-expectations-policy", **forever, gamma="gamma")
    assert answers["b"] == 1 / (1 - generator("gamma"))


@pytest.mark.parametrize(
    ("slack", "said"),
    [(0, "none of the 2 constraints holds"), (3, "1 of the 2 constraints holds"), (9, "both constraints hold")],
)
def test_how_many_constraints_hold_is_said_in_words(slack: int, said: str) -> None:
    # wᵀμ is 4 for the expert, 5 and 8 for the others: with margins of 1 the slacks needed are 2 and 5.
    rivals = {name: {"mu": [worth], "margin": 1} for name, worth in (("a", 5), ("b", 8))}
    given_ = {"w": [1], "expert": [4], "policies": rivals, "slack": slack}
    exercise = rldrill.read({"family": "max-margin", "given": given_})
    assert f"So {said}." in str(exercise.working("b"))


def test_a_weight_left_open_is_written_as_in_the_question() -> None:
    # 6w + 2 ≥ 5w + 2 + 1 from w = 1 on, 6w + 2 ≥ 3w + 1 + 2 from w = 1/3 on.
    rivals = {"one": {"mu": [5, 2], "margin": 1}, "two": {"mu": [3, 1], "margin": 2}}
    given_ = {"w": ["rho", 1], "expert": [6, 2], "policies": rivals, "slack": 4}
    told = " ".join(str(rldrill.read({"family": "max-margin", "given": given_}).working("b")).split())
    assert "a lower bound on ρ: ρ ≥ 1, ρ ≥ 1/3. All of them hold for ρ ≥ 1" in told
    assert "rho" not in told


@pytest.mark.parametrize("level", [1, 2, 3])
def test_every_trajectory_has_a_line_of_its_own(level: int) -> None:
    for seed in range(10):
        exercise = rldrill.draw("feature-expectations", level, seed)
        given_: Any = exercise.solution.problem.given
        text = str(exercise.working())
        for number, states in enumerate(given_.trajectories, 1):
            digits = str(number).translate(str.maketrans("123456789", "¹²³⁴⁵⁶⁷⁸⁹"))
            (line,) = {line for line in text.splitlines() if line.strip().startswith(f"μ₁⁽{digits}⁾ =")}
            assert line.count("·") == len(states)


def test_quotients_in_a_letter_are_brought_to_a_common_denominator() -> None:
    # 1/2 + 3/(2 − q) = (2 − q + 6)/(4 − 2q).
    q = generator("q")
    total = in_one_fraction(to_sympy(3 / (2 - q)) + sympy.Rational(1, 2))
    assert total is not None
    assert unicode(typeset(total)) == "(2 − q + 6)/(4 − 2q)"


def test_the_aim_of_apprenticeship_is_recalled_where_it_is_asked_whether_it_is_reached() -> None:
    for level in (1, 2, 3):
        for seed in range(15):
            exercise = rldrill.draw("apprenticeship", level, seed)
            *before, last = (str(exercise.working(part.label)) for part in exercise.parts)
            stops = exercise.problem.given.tolerance is not None  # type: ignore[attr-defined]
            assert ("μ(π) ≈ μ(π_E)" in last) == stops
            assert (": yes, it" in last or ": no, it" in last) == stops
            assert not any("≈ μ(π_E)" in each for each in before)


def test_the_equations_of_a_second_feature_are_said_to_be_those_of_the_first() -> None:
    seconds = 0
    for seed in range(10):
        exercise = rldrill.draw("feature-expectations-policy", 2, seed)
        several = len(exercise.parts) == 3
        told = [part.label for part in exercise.parts if "equations of (a)" in str(exercise.working(part.label))]
        assert told == (["b"] if several else [])
        seconds += several
    assert seconds > 2
