"""Edits of formulas: what somebody may write instead, found in the expression alone."""

import pytest
from sympy import Expr

from rldrill.render.mathematics.unicode import unicode
from rldrill.solutions.exact import exact
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.formula.edits import IN_ONE_TERM, SCALE, SHIFT, edits, probes
from rldrill.solutions.formula.notation import Quantity
from rldrill.solutions.formula.typesetting import typeset
from rldrill.solutions.sheet import formulas
from rldrill.solutions.sheet.bayes import BAYES, SQUARES
from rldrill.solutions.sheet.bellman import BELLMAN_OPTIMALITY_V, V_FROM_Q
from rldrill.solutions.sheet.beyond_the_sheet import LINK_ORIGIN
from rldrill.solutions.sheet.control import DOUBLE_Q_LEARNING
from rldrill.solutions.sheet.fundamentals import GEOMETRIC_SERIES
from rldrill.solutions.sheet.policy_gradient import SCORE_FUNCTION
from rldrill.solutions.sheet.temporal_difference import N_STEP_RETURN, TD_ZERO


def written(formula) -> dict[str, set[str]]:
    found: dict[str, set[str]] = {}
    for edit in edits(formula.right):
        found.setdefault(edit.kind, set()).add(unicode(typeset(edit.right)))
    return found


@pytest.mark.parametrize(
    ("kind", "line"),
    [
        ("factor-left-out", "V(sₜ) + rₜ₊₁ + γV(sₜ₊₁) − V(sₜ)"),
        ("factor-left-out", "V(sₜ) + α(rₜ₊₁ + V(sₜ₊₁) − V(sₜ))"),
        ("term-left-out", "α(rₜ₊₁ + γV(sₜ₊₁) − V(sₜ))"),
        ("term-left-out", "V(sₜ) + α(rₜ₊₁ + γV(sₜ₊₁))"),
        ("sign", "V(sₜ) − α(rₜ₊₁ + γV(sₜ₊₁) − V(sₜ))"),
        ("sign", "V(sₜ) + α(rₜ₊₁ + γV(sₜ₊₁) + V(sₜ))"),
        ("index", "V(sₜ) + α(rₜ + γV(sₜ₊₁) − V(sₜ))"),
        ("index", "V(sₜ) + α(rₜ₊₁ + γV(sₜ) − V(sₜ))"),
        ("complement", "V(sₜ) + (1 − α)·(rₜ₊₁ + γV(sₜ₊₁) − V(sₜ))"),
        ("bracket", "V(sₜ) + α(rₜ₊₁ + γV(sₜ₊₁)) − V(sₜ)"),
        ("exchanged", "V(sₜ) + γ(rₜ₊₁ + αV(sₜ₊₁) − V(sₜ))"),
        ("arguments-exchanged", "V(sₜ) + α(rₜ₊₁ + γV(sₜ) − V(sₜ₊₁))"),
        ("factor-moved", "V(sₜ) + α(γrₜ₊₁ + V(sₜ₊₁) − V(sₜ))"),
    ],
)
def test_an_update_is_edited_as_a_student_errs(kind: str, line: str) -> None:
    assert line in written(TD_ZERO)[kind]


def test_a_bracket_begins_too_early_behind_a_factor_and_never_behind_a_minus_alone() -> None:
    brackets = written(TD_ZERO)["bracket"]
    assert "V(sₜ) + α(−V(sₜ) + γ(rₜ₊₁ + V(sₜ₊₁)))" in brackets
    assert not any("−(" in line for line in brackets)


def test_a_discount_that_stands_at_the_wrong_term_stands_before_the_whole_sum_of_rewards() -> None:
    assert written(N_STEP_RETURN)["factor-moved"] == {"γ Σᵢ₌₀ⁿ⁻¹ γⁱrₜ₊₁₊ᵢ + V(sₜ₊ₙ)"}
    assert "factor-moved" not in written(SQUARES)  # a bracket is no term


def test_of_two_tables_the_other_one_is_read() -> None:
    assert written(DOUBLE_Q_LEARNING)["other-table"] == {
        "Qᵢ(sₜ, aₜ) + α(rₜ₊₁ + γQⱼ(sₜ₊₁, aₜ₊₁*) − Qⱼ(sₜ, aₜ))",
        "Qᵢ(sₜ, aₜ) + α(rₜ₊₁ + γQᵢ(sₜ₊₁, aₜ₊₁*) − Qᵢ(sₜ, aₜ))",
    }


def test_a_quotient_is_turned_upside_down() -> None:
    assert "1/((p(z|h) p(h))/(Σₕ′ p(z|h′) p(h′)))" in written(BAYES)["upside-down"]


def test_a_power_of_a_sum_is_taken_for_the_sum_of_the_powers() -> None:
    assert written(GEOMETRIC_SERIES)["power-of-sum"] == {"(Σᵢ₌₀ⁿ⁻¹ γⁱrₜ₊₁₊ᵢ)/(1 − γ)ⁿ"}
    assert written(SQUARES)["power-of-terms"] == {"Σᵢ₌₁ⁿ (xᵢ² − x̄²)"}


def test_the_sine_and_the_cosine_of_an_angle_are_exchanged() -> None:
    assert "[aᵢ sin(θᵢ) ; aᵢ cos(θᵢ) ; dᵢ]" in written(LINK_ORIGIN)["exchanged"]


def test_a_sum_begins_one_later_or_ends_one_earlier_or_later() -> None:
    sums = ("Σᵢ₌₀₊₁ⁿ⁻¹", "Σᵢ₌₀ⁿ⁻¹⁻¹", "Σᵢ₌₀ⁿ⁻¹⁺¹")  # of Σᵢ₌₀ⁿ⁻¹
    assert written(N_STEP_RETURN)["range"] == {f"{each} γⁱrₜ₊₁₊ᵢ + γⁿV(sₜ₊ₙ)" for each in sums}


def test_the_mean_stands_for_the_maximum() -> None:
    kinds = written(BELLMAN_OPTIMALITY_V)
    assert {"mean-for-max", "min-for-max", "sum-for-max"} <= set(kinds)


def test_one_hypothesis_is_left_out_of_the_evidence() -> None:
    # 1/2·1/4 / (1/2·1/4 + 1/2·3/4) = 1/4; without the second hypothesis 1, without the first 1/3.
    known = {
        "h": "a",
        "z": "on",
        "p": {"a": exact(1) / 2, "b": exact(1) / 2},
        "likelihood": {("on", "a"): exact(1) / 4, ("on", "b"): exact(3) / 4},
        "hypotheses": ("a", "b"),
    }
    assert value_of(BAYES.right, known) == exact(1) / 4
    left_out = next(edit for edit in edits(BAYES.right) if edit.kind == "summand-left-out")
    assert value_of(left_out.once, {**known, "at_1": "b"}) == 1
    assert value_of(left_out.once, {**known, "at_1": "a"}) == exact(1) / 3


def test_the_factor_of_one_term_multiplies_all() -> None:
    # 1/4·8 + 3/4·4 = 5; with the 1/4 before all of it 1/4·(8 + 3/4·4) = 11/4, with the 3/4 3/4·(1/4·8 + 4) = 9/2
    known = {
        "s": "x", "actions": {"x": ("a", "b")}, "pi": {("a", "x"): exact(1) / 4, ("b", "x"): exact(3) / 4},
        "Q": {("x", "a"): exact(8), ("x", "b"): exact(4)},
    }  # fmt: skip
    assert value_of(V_FROM_Q.right, known) == 5
    for_all = next(edit for edit in edits(V_FROM_Q.right) if edit.kind == "factor-for-all")
    assert value_of(for_all.once, {**known, "at_1": "a"}) == exact(11) / 4
    assert value_of(for_all.once, {**known, "at_1": "b"}) == exact(9) / 2


def test_what_stands_before_a_sum_is_applied_to_one_term_only() -> None:
    # f(s, a) − Σ π f = 5 − (1/4·8 + 3/4·4) = 0; with the minus before the first term alone 5 − 2 + 3 = 6
    known = {
        "s": "x", "a": "a", "choices": ("b", "c"), "pi": {("b", "x"): exact(1) / 4, ("c", "x"): exact(3) / 4},
        "f_vector": {("x", "a"): exact(5), ("x", "b"): exact(8), ("x", "c"): exact(4)},
    }  # fmt: skip
    one = next(edit for edit in edits(SCORE_FUNCTION.right) if edit.kind == "factor-for-one")
    assert value_of(one.once, {**known, "at_1": "b"}) == 6


def test_a_place_of_a_formula_takes_another_value() -> None:
    # 8 + 1/2·(4 + 1/2·6 − 8) = 15/2; with 2 for γV(s′) it is 8 + 1/2·(4 + 2 − 8) = 7.
    known = {
        "t": 0, "S": {0: "a", 1: "b"}, "r": {1: exact(4)}, "V": {"a": exact(8), "b": exact(6)},
        "alpha": exact(1) / 2, "gamma": exact(1) / 2,
    }  # fmt: skip
    assert value_of(TD_ZERO.right, known) == exact(15) / 2
    place = next(probe for probe in probes(TD_ZERO.right) if unicode(typeset(probe.part)) == "γV(sₜ₊₁)")
    assert value_of(place.right, {**known, SCALE.name: exact(0), SHIFT.name: exact(2)}) == 7


def test_an_index_is_counted_with_all_its_numbers() -> None:
    instead = {unicode(typeset(edit.instead)) for edit in edits(N_STEP_RETURN.right) if edit.kind == "index"}
    assert {"rₜ₊ᵢ", "rₜ₊ᵢ₊₂"} <= instead


@pytest.mark.parametrize("formula", formulas().values(), ids=lambda formula: formula.key)
def test_nothing_leads_from_a_state_to_itself(formula) -> None:
    for edit in edits(formula.right):
        if edit.kind == "twin" and edit.instead is not None:
            assert len(set(edit.instead.args)) == len(edit.instead.args)


@pytest.mark.parametrize("formula", formulas().values(), ids=lambda formula: formula.key)
def test_every_edit_of_every_formula_is_another_formula(formula) -> None:
    for edit in edits(formula.right):
        assert edit.kind in IN_ONE_TERM or edit.right != formula.right
        assert _arguments(edit.right) <= _arguments(formula.right)
        assert (edit.once is not None) == bool(edit.within)


def _arguments(expression: Expr) -> set[tuple[type[Quantity], int]]:
    """How many arguments each quantity has; an edit gives none more or fewer."""
    return {(type(part), len(part.args)) for part in expression.atoms(Quantity)}
