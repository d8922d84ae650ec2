"""How formulas and steps are written: literal lines, as the sheet prints them."""

from pathlib import Path
from unicodedata import normalize

import pytest
import sympy
from flint import fmpq, fmpq_mat
from sympy import evaluate, factorial, log, sqrt

from rldrill.problems.document import Equation
from rldrill.problems.mathematics import Fraction, Glyph, mathematics, row
from rldrill.render.mathematics.latex import latex
from rldrill.render.mathematics.stacked import stacked
from rldrill.render.mathematics.unicode import unicode
from rldrill.render.unicode import unicode_text
from rldrill.solutions.answers.text import read_number
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.formula.notation import Counting, IntegralOver, S, SampleMean, T, n, t
from rldrill.solutions.formula.putting_in import put_in, reduced
from rldrill.solutions.formula.typesetting import typeset, typeset_value
from rldrill.solutions.knowns import Sparse
from rldrill.solutions.matrices import matrix
from rldrill.solutions.rational import generator
from rldrill.solutions.sheet import formulas
from rldrill.solutions.sheet.bayes import BIC, KALMAN_GAIN, KALMAN_MOVE_COVARIANCE, Thetas, heads, theta
from rldrill.solutions.sheet.bellman import BELLMAN_OPTIMALITY_Q, BELLMAN_V
from rldrill.solutions.sheet.beyond_the_sheet import JOINT_RATES
from rldrill.solutions.sheet.control import EPSILON_GREEDY, IMPORTANCE_RATIO, UCB
from rldrill.solutions.sheet.dynamic_programming import MAX_NORM, POLICY_IMPROVEMENT_THEOREM
from rldrill.solutions.sheet.fundamentals import RELATIVE_FREQUENCY, RETURN
from rldrill.solutions.sheet.linear_methods import LQR_PRODUCT
from rldrill.solutions.sheet.temporal_difference import SAMPLE_AVERAGE, TD_ZERO, of_a_visit
from rldrill.solutions.work import Step, Work

LINES = Path(__file__).parent / "lines"
#: Every formula as a book prints it, in one file for each section: the key, a colon, the line.
UNICODE = dict(
    line.split(": ", 1) for file in sorted(LINES.glob("*.txt")) for line in file.read_text("utf-8").splitlines() if line
)


@pytest.mark.parametrize("key", UNICODE)
def test_formulas_are_written_as_the_sheet_prints_them(key: str) -> None:
    written = unicode_text(formulas()[key].equation())
    assert normalize("NFD", " ".join(written.split())) == normalize("NFD", UNICODE[key])


def test_every_formula_of_the_sheet_is_here() -> None:
    assert set(UNICODE) == set(formulas())


def test_a_formula_in_latex() -> None:
    assert latex(typeset(TD_ZERO.right)).replace(" ", "") == (
        r"V(s_{t})+\alpha(r_{t+1}+\gammaV(s_{t+1})-V(s_{t}))"  # nothing in the brackets is tall
    )


def test_the_step_of_the_design_document() -> None:
    known = {
        "S": {0: "cool", 1: "warm"}, "V": {"cool": fmpq(2), "warm": fmpq(4)}, "r": {1: fmpq(-1)},
        "t": 0, "alpha": fmpq(1, 2), "gamma": fmpq(9, 10),
    }  # fmt: skip
    assert unicode(typeset(put_in(TD_ZERO.right, known))) == "2 + 1/2·(−1 + 9/10·4 − 2)"


def test_factorials_expectations_integrals_and_roots_are_written() -> None:
    with evaluate(False):
        quotient = factorial(heads) * factorial(heads + 1) / factorial(3)
        assert unicode(typeset(quotient)) == "(n₁!(n₁ + 1)!)/(3!)"
        assert unicode(typeset(SampleMean(S(t), n, Counting(1, T)))).strip() == "𝔼[sₜ]"
        assert unicode(typeset(IntegralOver(theta**2, theta, Thetas))).strip() == "∫ θ²dθ"
        assert unicode(typeset(sqrt(heads + 1))) == "√(n₁ + 1)"


def test_a_negative_logarithm_that_is_put_in_has_brackets() -> None:
    known = {"M": "x", "log_likelihood": -log(4), "free": fmpq(1), "n": fmpq(8)}
    assert unicode(typeset(put_in(BIC.right, known))) == "−2·(−ln 4) + 1·ln 8"


def test_a_1_that_multiplies_a_matrix_keeps_its_place_when_put_in_and_is_then_left_out() -> None:
    one, two = fmpq_mat(1, 1, [1]), fmpq_mat(1, 1, [2])
    known = {"t": 1, "Ai": one, "covariance": {0: two}, "Ri": one}
    written = put_in(KALMAN_MOVE_COVARIANCE.right, known)
    assert unicode(typeset(written)) == "1·2·1 + 1"
    assert unicode(typeset(reduced(written))) == "2 + 1"


def test_a_term_of_zeros_is_left_out_of_the_second_line_be_it_a_number_or_a_matrix() -> None:
    one, two, zero = (fmpq_mat(1, 1, [number]) for number in (1, 2, 0))
    square, zeros = fmpq_mat(2, 2, [1, 0, 2, 1]), fmpq_mat(2, 2, [0] * 4)
    lines = []
    for turn, spread, noise in ((one, two, zero), (square, square, zeros), (zero, two, one)):
        known = {"t": 1, "Ai": turn, "covariance": {0: spread}, "Ri": noise}
        lines.append(unicode(typeset(reduced(put_in(KALMAN_MOVE_COVARIANCE.right, known)))))
    # (1 0; 2 1)(1 0; 2 1) = (1 0; 4 1), and that times (1 2; 0 1) is (1 2; 4 9).
    assert lines == ["2", "[1  2 ; 4  9]", "1"]


def test_zeros_that_are_given_keep_their_places_and_what_is_not_there_leaves_none() -> None:
    known = {
        "s": "cool", "gamma": fmpq(1, 2), "actions": {"cool": ("slow", "fast")},
        "successors": {("cool", "slow"): ("cool",), ("cool", "fast"): ("warm",)},
        "pi": {("slow", "cool"): fmpq(1), ("fast", "cool"): fmpq(0)},
        "P": {("cool", "slow", "cool"): fmpq(1), ("cool", "fast", "warm"): fmpq(1)},
        "R": {("cool", "slow", "cool"): fmpq(3), ("cool", "fast", "warm"): fmpq(5)},
    }  # fmt: skip
    slow = "1·1·(3 + 1/2·V^π(cool))"
    assert unicode(typeset(put_in(BELLMAN_V.right, known))) == f"{slow} + 0·1·(5 + 1/2·V^π(warm))"
    never = known | {"pi": Sparse({("slow", "cool"): fmpq(1)})}
    assert unicode(typeset(put_in(BELLMAN_V.right, never))) == slow
    assert unicode(typeset(reduced(put_in(BELLMAN_V.right, known)))) == "3 + 1/2·V^π(cool)"


def test_a_formula_with_two_cases() -> None:
    # The step has the case that holds, without the other one.
    known = {"s": "cool", "epsilon": fmpq(1, 5), "actions": {"cool": ("slow", "fast")}, "best": {"cool": "fast"}}
    steps = [unicode(typeset(put_in(EPSILON_GREEDY.right, known | {"a": action}))) for action in ("fast", "slow")]
    assert steps == ["1 − 1/5 + (1/5)/2", "(1/5)/2"]
    assert [EPSILON_GREEDY.value(known | {"a": action}) for action in ("fast", "slow")] == [fmpq(9, 10), fmpq(1, 10)]
    assert latex(typeset(EPSILON_GREEDY.right)).startswith(r"\left\{ \begin{matrix}")
    assert latex(typeset(EPSILON_GREEDY.right)).endswith(r"\end{matrix} \right.")
    assert stacked(typeset(EPSILON_GREEDY.right)) == (
        "⎧1 − ε + ε/|A(s)|  if a = a*(s)",
        "⎩        ε/|A(s)|     otherwise",
    )


def test_a_product_over_a_run() -> None:
    known = {
        "T": 2, "S": {0: "cool", 1: "warm"}, "A": {0: "fast", 1: "slow"},
        "pi": {("fast", "cool"): fmpq(3, 4), ("slow", "warm"): fmpq(1, 4)},
        "behaviour": {("fast", "cool"): fmpq(1, 2), ("slow", "warm"): fmpq(1, 3)},
    }  # fmt: skip
    assert unicode(typeset(put_in(IMPORTANCE_RATIO.right, known))) == "(3/4·1/4)/(1/2·1/3)"
    assert IMPORTANCE_RATIO.value(known) == fmpq(9, 8)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (fmpq(-3, 4), "−3/4"),
        (fmpq(7), "7"),
        # With more than a million below the line, a decimal of up to 14 places is easier to read, where there is one.
        (fmpq(1, 10**6), "1/1000000"),
        (fmpq(1, 2 * 10**6), "0.0000005"),
        (fmpq(-12345678, 10**7), "−1.2345678"),
        (fmpq(1, 10**14), "0.00000000000001"),
        (fmpq(1, 10**15), "1/1000000000000000"),
        (fmpq(1, 3 * 10**6), "1/3000000"),
        (2 - 3 * generator("gamma") + generator("gamma") ** 2 * fmpq(1, 2), "2 − 3γ + 1/2·γ²"),
        ((3 * generator("p") - 9) / (generator("p") - 1), "(9 − 3p)/(1 − p)"),
        (1 / (1 - generator("gamma")), "1/(1 − γ)"),
    ],
)
def test_values_are_written_as_by_hand(value: object, text: str) -> None:
    assert unicode(typeset_value(value)) == text


@pytest.mark.parametrize(
    ("source", "text"),
    [
        ("V(s_{t+1}) = 3/4", "V(sₜ₊₁) = 3/4"),
        ("P_{s s'}^a", "Pₛₛ′ᵃ"),
        ('V^π("smoking hot")', "V^π(smoking hot)"),
        ("a_t = −L_t s_t", "aₜ = −Lₜsₜ"),
        ("R_{0}^{(2)}", "R₀⁽²⁾"),
        ("f(\u0101) + s\u0303_t", "f(a\u0304) + s\u0303ₜ"),
        ("V^*(s)", "V*(s)"),
        ("2 * 3", "2·3"),
    ],
)
def test_the_notation_of_questions(source: str, text: str) -> None:
    assert unicode(mathematics(source)) == text


def test_of_two_things_above_a_slash_a_differential_stands_without_brackets() -> None:
    d, x, y = (Glyph(letter, "variable") for letter in "dxy")
    assert unicode(Fraction(row(d, y), row(d, x))) == "dy/dx"
    assert unicode(Fraction(row(x, y), row(y, d))) == "xy/(yd)"


def test_mathematics_left_open_is_refused() -> None:
    with pytest.raises(ValueError, match="missing"):
        mathematics("V_{t+1")


def test_signs_of_an_equation_stand_between_its_sides() -> None:
    equation = Equation(mathematics("x"), (mathematics("1"), mathematics("2")), ("←", "="))
    assert unicode_text(equation) == "x ← 1 = 2"


def test_a_maximum_over_one_action_and_a_negative_number_alone_stand_bare() -> None:
    work = Work()
    known = {"gamma": fmpq(1, 2), "actions": {"warm": ("slow",)}, "Q": {("warm", "slow"): fmpq(-4)}}
    model = {"successors": {("cool", "fast"): ("warm",)}, "P": {("cool", "fast", "warm"): fmpq(1)}}
    rewards = {("cool", "fast", "warm"): fmpq(3)}
    work.step(BELLMAN_OPTIMALITY_Q, s="cool", a="fast", R=rewards, **model, **known)
    work.step(MAX_NORM, states=("cool",), V0={"cool": fmpq(1)}, V={"cool": fmpq(4)})
    fails = {"s": "cool", "V": {"cool": fmpq(-2)}, "pi1": {"cool": "fast"}}
    work.step(POLICY_IMPROVEMENT_THEOREM, sign="<", **fails)
    lines = [" ".join(unicode_text(line.equation()).split()) for line in work.lines if isinstance(line, Step)]
    assert lines == [
        "Q*(cool, fast) = 1·(3 + 1/2·(−4)) = 3 + 1/2·(−4) = 1",
        "‖V₀ − V*‖_∞ = |1 − 4| = 3",
        "Q^π(cool, fast) < −2",
    ]


#: As a lecturer writes them: the constant first, one line of fraction, no minus in front of what stands above a line.
WRITTEN = {
    "sqrt(2)": "√2", "-sqrt(2)": "−√2", "sqrt(2)/2": "√2/2", "-sqrt(3)/2": "−√3/2", "3sqrt(2)": "3√2",
    "-3sqrt(2)": "−3√2", "(1 + sqrt(5))/2": "(1 + √5)/2", "(1 - sqrt(5))/2": "(1 − √5)/2",
    "-(1 + sqrt(5))/2": "−(1 + √5)/2", "1 + sqrt(2)": "1 + √2", "-1 - sqrt(2)": "−1 − √2",
    "sqrt(2) + sqrt(3)": "√2 + √3", "sqrt(2) - sqrt(3)": "√2 − √3", "3sqrt(2)/4": "3√2/4",
    "2 - 3sqrt(2)/4": "(8 − 3√2)/4", "sqrt(1 + sqrt(2))": "√(1 + √2)", "2^(1/3)": "2^(1/3)",
    "e": "e", "e^2": "e²", "-e^2": "−e²", "e^(-2)": "e⁻²", "2e": "2·e", "2 - e": "2 − e", "exp(-3/4)": "exp(−3/4)",
    "2exp(-1/8)": "2·exp(−1/8)", "1/(1 + e)": "1/(1 + e)", "e/(1 + e)": "e/(1 + e)", "ln 3": "ln 3", "-ln 3": "−ln 3",
    "sqrt(ln(8)/2)": "√((ln 8)/2)", "3sqrt(ln(7)/12)": "√(3·ln 7)/2", "2sqrt(ln(8)/2)": "√(2·ln 8)",
    "2 ln 3": "2·ln 3", "ln(3)/2": "1/2·ln 3", "pi": "π", "2pi": "2π", "pi/2": "π/2", "-pi/6": "−π/6",
    "cos(2)/2": "1/2·cos(2)", "γ": "γ", "-γ": "−γ", "2γ": "2γ", "γ/2": "1/2·γ", "γ^2/4": "1/4·γ²", "1 - γ": "1 − γ",
    "-1 - γ": "−1 − γ", "1 + 2γ + 3γ^2": "1 + 2γ + 3γ²", "3γ/4 - 1/2": "−1/2 + 3/4·γ", "1/γ": "1/γ", "-1/γ": "−1/γ",
    "3/(2γ)": "3/(2γ)", "1/(1 - γ)": "1/(1 − γ)", "-1/(1 - γ)": "−1/(1 − γ)", "γ/(1 - γ)": "γ/(1 − γ)",
    "2/(1 - γ)^2": "2/(1 − 2γ + γ²)", "(1 + γ)/(1 - γ)": "(1 + γ)/(1 − γ)", "(1/2 + γ)/(1 - γ)": "(1 + 2γ)/(2 − 2γ)",
    "(γ - 3)/(γ - 1)": "(3 − γ)/(1 − γ)", "sqrt(γ)": "√γ", "ln γ": "ln γ", "sqrt(2) γ": "γ·√2",
}  # fmt: skip


@pytest.mark.parametrize("text", WRITTEN)
def test_a_number_of_every_form_is_written_so_and_read_back(text: str) -> None:
    value = read_number(text, ["gamma"]).value
    written = unicode(typeset_value(value))
    assert written == WRITTEN[text]
    assert read_number(written, ["gamma"]).value == value


def test_the_letters_of_a_product_that_are_the_same_are_one_power() -> None:
    # The trace of a state that comes again: ½λ · ¼λ² = ⅛λ³.
    letter = generator("lambda")
    trace = put_in(sympy.Symbol("x") * sympy.Symbol("y"), {"x": fmpq(1, 2) * letter, "y": fmpq(1, 4) * letter**2})
    assert unicode(typeset(reduced(trace))) == "1/8·λ³"


def written(formula: Formula, **known: object) -> str:
    work = Work()
    work.step(formula, **known)
    (step,) = work.lines
    assert isinstance(step, Step)
    return " ".join(unicode_text(step.equation()).split())


def test_the_inverse_of_a_2_by_2_matrix_is_worked_out() -> None:
    # −6·6 − 0·6 = −36; the diagonal is exchanged, the other two entries are negated.
    J, v = fmpq_mat(2, 2, [-6, 0, 6, 6]), fmpq_mat(2, 1, [-18, 6])
    assert written(JOINT_RATES, Jac=J, velocity=v) == (
        "ω = [−6 0 ; 6 6]⁻¹[−18 ; 6] = −1/36[6 0 ; −6 −6][−18 ; 6] = −1/36[6·(−18) ; −6·(−18) + (−6)·6] = [3 ; −2]"
    )


def test_a_product_of_matrices_is_worked_out_two_at_a_time_and_entry_by_entry() -> None:
    # B'P = (−2, −6), then (−2 − 6, −6); a state of 2 and 1 is worth −3·4 − 1.
    B, P, A = fmpq_mat(2, 1, [1, 2]), fmpq_mat(2, 2, [-2, 0, 0, -3]), fmpq_mat(2, 2, [1, 0, 1, 1])
    assert written(LQR_PRODUCT, Bt={0: B}, Pt={1: P}, At={0: A}, t=0) == (
        "G₀ = [1 ; 2]ᵀ[−2 0 ; 0 −3][1 0 ; 1 1] = [−2 −6][1 0 ; 1 1] = [−2·1 + (−6)·1 −6·1] = [−8 −6]"
    )


def test_a_sum_that_leads_a_product_keeps_its_brackets() -> None:
    w, one = matrix([[7 + generator("w")]]), matrix([[fmpq(1)]])
    known = {"t": 1, "covariance_bar": {1: w}, "Ci": one, "Qi": matrix([[fmpq(6)]])}
    assert written(KALMAN_GAIN, **known) == "K₁ = (7 + w)·1·(1·(7 + w)·1 + 6)⁻¹ = (7 + w)·(13 + w)⁻¹ = (7 + w)/(13 + w)"


def test_the_bound_of_an_arm_keeps_its_logarithm_under_the_root() -> None:
    known = {"a": "red", "t": 8, "Q": {"red": fmpq(5)}, "c": fmpq(1)}
    assert written(UCB, N={"red": fmpq(4)}, **known) == "U(red) = 5 + 1·√((ln 8)/4) = 5 + √((ln 8)/4) = 5 + √(ln 8)/2"
    assert written(UCB, N={"red": fmpq(2)}, **known) == "U(red) = 5 + 1·√((ln 8)/2) = 5 + √((ln 8)/2)"


def test_a_factor_of_minus_1_goes_with_the_factors_of_1() -> None:
    known = {"t": 0, "r": {1: fmpq(6), 2: fmpq(-1), 3: fmpq(4)}, "T": 3, "gamma": fmpq(1, 2)}
    assert written(RETURN, **known) == "R₀ = (1/2)⁰·6 + (1/2)¹·(−1) + (1/2)²·4 = 6 − 1/2 + (1/2)²·4 = 13/2"


def test_a_line_that_only_changes_the_order_is_not_written() -> None:
    # 3/(3 + x) and 3/(x + 3) would be two lines that say the same.
    counts = {("a", "a", "a"): fmpq(3), ("a", "a", "b"): generator("x")}
    known = {"S": {0: "a", 1: "a", 2: "b"}, "t": 1, "N": counts, "states": ("b", "a")}
    assert written(RELATIVE_FREQUENCY, **known) == "Pr(b|a, a) = x/(x + 3)"


def test_a_number_in_brackets_is_parted_from_a_letter() -> None:
    trace = put_in(sympy.Symbol("y") * sympy.Symbol("z"), {"y": fmpq(-1), "z": generator("lambda")})
    assert unicode(typeset(2 + trace)) == "2 + (−1)·λ"


def test_a_quotient_of_a_negative_number_is_subtracted() -> None:
    known = {"s": "a", "count": {"a": fmpq(4)}, "observed": fmpq(-5), "V": {"a": fmpq(10)}}
    assert written(of_a_visit(SAMPLE_AVERAGE), **known) == "V(a) ← 10 + (−5 − 10)/4 = 10 − 15/4 = 25/4"
    discounted = {"t": 0, "r": {1: fmpq(4), 2: fmpq(-1)}, "T": 2, "gamma": fmpq(1)}
    assert written(RETURN, **discounted) == "R₀ = 1⁰·4 + 1¹·(−1) = 4 − 1 = 3"
