"""A node says itself all that is to be known of it: one class, named nowhere else, has every reading."""

from collections.abc import Callable
from fractions import Fraction

import pytest
import sympy
from flint import fmpq, fmpq_mat
from hypothesis import given
from hypothesis import strategies as st
from sympy import Expr, Integer, Pow, S, evaluate

from numbers_drawn import small
from rldrill.problems.mathematics import Fence, Math, listed, row, word
from rldrill.render.unicode import unicode
from rldrill.solutions.effort import seconds_of
from rldrill.solutions.exact import NoSolution, to_sympy
from rldrill.solutions.formula.compiling import arg_max, compiled, needs, value_of
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.formula.node import Node, Typeset
from rldrill.solutions.formula.nodes.sets import MaxOf
from rldrill.solutions.formula.notation import (
    ArgMaxOver,
    Blocks,
    Cases,
    Clipped,
    Counting,
    Expected,
    Greatest,
    Indicator,
    Least,
    MaxOver,
    MeanOver,
    Member,
    ProductOver,
    Size,
    SumOver,
    Transposed,
    V,
    alpha,
    gamma,
    i,
    letter,
    n,
    s,
)
from rldrill.solutions.formula.putting_in import evaluated, put_in, reduced
from rldrill.solutions.formula.typesetting import typeset
from rldrill.solutions.work import Work

x, y = letter("x"), letter("y")
Places = letter("places", "F")
numbers = small(-9, 9, 12).map(lambda value: fmpq(value.numerator, value.denominator))


class Middle(Node):
    """The value in the middle of an odd number of values."""

    value = symbolic = staticmethod(lambda *values: sorted(values)[len(values) // 2])

    @property
    def operations(self) -> int:
        return len(self.args)

    def _typeset(self, typeset: Typeset) -> Math:
        return row(word("median"), Fence(listed(map(typeset, self.args))))

    def _reduced(self, worked_out: Callable[[Expr], Expr]) -> Expr:
        return Middle(*map(worked_out, self.args))


def test_a_new_node_is_one_class() -> None:
    with evaluate(False):
        formula = V(s) * Middle(V(s), Integer(3), 2 - y)
    known = {"s": "cool", "V": {"cool": fmpq(5)}, "y": fmpq(-2)}
    assert unicode(typeset(formula)) == "V(s) median(V(s), 3, 2 − y)"
    assert needs(formula) == ("V", "s", "y")
    assert value_of(formula, known) == 20
    step = put_in(formula, known)
    assert unicode(typeset(step)) == "5·median(5, 3, 2 − (−2))"
    assert unicode(typeset(reduced(step))) == "5·median(5, 3, 4)"
    assert evaluated(step) == evaluated(reduced(step)) == 20
    # A step (8 s); a product, a median of three, a sum and a factor −1 (3 s each); six digits (1.5 s).
    work = Work()
    work.step(Formula("own", x, formula, "Title", "Source", "Hint."), **known)
    assert seconds_of(work.lines) == 8 + (1 + 3 + 1 + 1) * 3 + 6 * Fraction(3, 2)


def test_a_node_that_does_not_say_how_it_is_written_or_computed_is_refused() -> None:
    class Unwritten(Node):
        pass

    with pytest.raises(TypeError, match="Unwritten has no typesetting"):
        typeset(Unwritten(x))
    with pytest.raises(TypeError, match="Unwritten has no value"):
        value_of(Unwritten(x), {"x": 1})


def test_a_compiled_formula_calls_what_its_nodes_name_and_nothing_else() -> None:
    plain = set(compiled(x + 1).__globals__)
    assert set(compiled(Middle(x, y, SumOver(x, i, Places))).__globals__) - plain == {"Middle", "SumOver"}
    with pytest.raises(TypeError, match="'open' is not a function"):
        compiled(sympy.Function("open")(x))


# What takes one of a few values ------------------------------------------------------------------------


@given(st.lists(numbers, min_size=1, max_size=5))
def test_the_greatest_and_the_least(values: list[fmpq]) -> None:
    letters = sympy.symbols(f"v:{len(values)}")
    known = {letter.name: value for letter, value in zip(letters, values, strict=True)}
    for node, expected in ((Greatest(*letters), max(values)), (Least(*letters), min(values))):
        assert value_of(node, known) == expected
        assert evaluated(put_in(node, known)) == to_sympy(expected)
        assert node.operations == len(values) - 1


@given(numbers, numbers, numbers)
def test_what_is_clipped_lies_between_its_bounds(value: fmpq, one: fmpq, other: fmpq) -> None:
    low, high = min(one, other), max(one, other)
    known = {"x": value, "y": low, "n": high}
    clipped = Clipped(x, y, n)
    assert value_of(clipped, known) == sorted([low, value, high])[1]
    assert evaluated(put_in(clipped, known)) == to_sympy(sorted([low, value, high])[1])
    assert clipped.operations == 2


@given(st.lists(numbers, min_size=3, max_size=3))
def test_a_reduced_step_is_worth_the_same(values: list[fmpq]) -> None:
    known = dict(zip(("x", "y", "n"), values, strict=True))
    with evaluate(False):
        inside = x + 2 * y - n
        formulas = [Greatest(inside, n), Least(n, inside), Clipped(inside, S.Zero, x * x), n * Least(inside, y) + 1]
        formulas += [x + MaxOver(V(i) + inside, i, Places), x * Pow(inside**2 + 1, -1)]
    known |= {"places": ("a", "b"), "V": {"a": fmpq(2), "b": fmpq(3)}}
    for formula in formulas:
        step = put_in(formula, known)
        assert evaluated(reduced(step)) == evaluated(step) == to_sympy(value_of(formula, known))


def test_the_values_are_worked_out_before_a_maximum_is_taken_and_within_a_sum_a_maximum_of_numbers_is_taken() -> None:
    known = {"places": (1, 2), "x": fmpq(10)}
    with evaluate(False):
        best, more, numbers = MaxOver(i + 1, i, Places), x + MaxOver(i + 1, i, Places), x + MaxOver(i, i, Places)
    assert unicode(typeset(put_in(best, known))) == "max{1 + 1; 2 + 1}"
    assert unicode(typeset(reduced(put_in(best, known)))) == "max{2; 3}"
    assert unicode(typeset(reduced(put_in(more, known)))) == "10 + max{2; 3}"
    assert unicode(typeset(reduced(put_in(numbers, known)))) == "10 + 2"
    assert put_in(best, known).operations == 1


def test_all_that_are_best_in_their_order() -> None:
    assert arg_max("abcd", [fmpq(1), fmpq(3), fmpq(2), fmpq(3)]) == ("b", "d")
    best = ArgMaxOver(V(i), i, Places)
    known = {"places": ("a", "b", "c"), "V": {"a": fmpq(-2), "b": fmpq(0), "c": fmpq(0)}}
    assert value_of(best, known) == ("b", "c")
    step = put_in(best, known)
    assert isinstance(step.body, MaxOf)
    assert unicode(typeset(step)) == unicode(typeset(reduced(step))) == "arg maxᵢ {−2; 0; 0}"


# What runs over a set ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("formula", "value", "step"),
    [
        (SumOver(i**2, i, Counting(S(2), n)), 2**2 + 3**2 + 4**2, "2² + 3² + 4²"),
        (ProductOver(i, i, Counting(S(1), n)), 2 * 3 * 4, "1·2·3·4"),
        (MeanOver(i, i, Counting(S(2), n)), 3, "(2 + 3 + 4)/3"),
        (MaxOver(-i, i, Counting(S(2), n)), -2, "max{−2; −3; −4}"),
        (SumOver(i, i, Counting(S(5), n)), 0, "0"),
        (ProductOver(i, i, Counting(S(5), n)), 1, "1"),
        (SumOver(i, i, Counting(S(3), n)) * SumOver(i, i, Counting(S(4), n)), 7 * 4, "(3 + 4)·4"),
        (MaxOver(i, i, Counting(S(4), n)), 4, "4"),
        (MaxOver(i, i, Counting(S(3), n)), 4, "max{3; 4}"),
        (Expected(SumOver(i, i, Counting(S(3), n))), 7, "3 + 4"),
    ],
)
def test_both_ends_are_counted(formula: Expr, value: int, step: str) -> None:
    assert value_of(formula, {"n": 4}) == value
    assert unicode(typeset(put_in(formula, {"n": 4}))) == step
    assert evaluated(put_in(formula, {"n": 4})) == value


def test_what_runs_needs_no_value_and_neither_does_a_limit_that_is_only_printed() -> None:
    assert needs(SumOver(i * x, i, Counting(S(1), n, y))) == ("n", "x")
    assert needs(SumOver(i, i, Counting(x, n, y))) == ("n", "x")
    assert needs(SumOver(SumOver(V(i), i, Places), i, Places)) == ("V", "places")


def test_the_limits_are_written_and_the_upper_one_may_be_written_otherwise() -> None:
    counted = Counting(S(0), n), Counting(S(0), n, alpha), Places
    signs = [typeset(SumOver(V(i), i, domain)).items[0] for domain in counted]
    limits = [[unicode(limit) for limit in (sign.below, sign.above) if limit] for sign in signs]
    assert limits == [["i = 0", "n"], ["i = 0", "α"], ["i"]]


def test_a_sum_has_brackets_around_a_sum() -> None:
    bodies = [typeset(SumOver(body, i, Places)).items[1] for body in (x + V(i), V(i))]
    assert [isinstance(body, Fence) for body in bodies] == [True, False]


def test_a_sum_has_brackets_unless_it_comes_last() -> None:
    sum_ = SumOver(V(i), i, Places)
    product = sympy.Mul(sum_, x, evaluate=False), sympy.Mul(x, sum_, evaluate=False)
    assert [isinstance(typeset(formula).items[0], Fence) for formula in product] == [True, False]


def test_the_size_of_a_set() -> None:
    assert value_of(Size(Places), {"places": ("a", "b", "c")}) == 3
    assert put_in(Size(Places), {"places": ("a", "b", "c")}) == 3
    assert unicode(typeset(Size(Places))) == "|F|"


# What depends on whether something holds -----------------------------------------------------------------


@pytest.mark.parametrize(
    ("things", "value"), [("aa", 1), ("ab", 0), ("aabb", 1), ("aabc", 0), ("abcc", 0), ("abab", 0), ("abba", 0)]
)
def test_an_indicator_compares_two_by_two(things: str, value: int) -> None:
    letters = sympy.symbols(f"v:{len(things)}")
    known = {letter.name: thing for letter, thing in zip(letters, things, strict=True)}
    assert value_of(Indicator(*letters), known) == value
    assert put_in(Indicator(*letters), known) == value


def test_only_the_case_that_holds_has_to_have_a_value() -> None:
    cases = Cases(Member(x, Places), 1 / y, alpha)
    assert value_of(cases, {"x": 1, "places": (2, 3), "y": fmpq(0), "alpha": fmpq(7)}) == 7
    assert value_of(cases, {"x": 2, "places": (2, 3), "y": fmpq(4), "alpha": fmpq(7)}) == fmpq(1, 4)
    assert put_in(cases, {"x": 1, "places": (2, 3), "alpha": fmpq(7)}) == 7
    with pytest.raises(NoSolution):
        value_of(cases, {"x": 2, "places": (2, 3), "y": fmpq(0), "alpha": fmpq(7)})


# Matrices ------------------------------------------------------------------------------------------------


def test_blocks_are_filled_up_with_zeros_and_ones() -> None:
    big, above = letter("big", matrix=True), letter("above", matrix=True)
    blocks = Blocks(2, big, above, 0, 1)
    known = {"big": fmpq_mat(2, 2, [1, 2, 3, 4]), "above": fmpq_mat(2, 1, [5, 6])}
    assert value_of(blocks, known) == fmpq_mat(3, 3, [1, 2, 5, 3, 4, 6, 0, 0, 1])
    assert evaluated(put_in(blocks, known)) == sympy.Matrix([[1, 2, 5], [3, 4, 6], [0, 0, 1]])


def test_the_transpose_swaps_rows_and_columns_and_leaves_a_number_alone() -> None:
    wide = letter("wide", matrix=True)
    known = {"wide": fmpq_mat(1, 2, [1, 2])}
    assert value_of(Transposed(wide), known) == fmpq_mat(2, 1, [1, 2])
    assert evaluated(put_in(Transposed(wide), known)) == sympy.Matrix([1, 2])
    assert unicode(typeset(put_in(Transposed(wide), {"wide": fmpq_mat(1, 1, [7])}))) == "7"
    with evaluate(False):
        assert unicode(typeset(Transposed(wide + wide))) == "(wide + wide)ᵀ"
    assert unicode(typeset(Transposed(wide))) == "wideᵀ"


def test_a_number_as_power_or_factor_keeps_its_brackets_and_dots() -> None:
    with evaluate(False):
        formula = gamma * x**2 * y
    known = {"gamma": fmpq(1, 2), "x": fmpq(-3), "y": fmpq(2, 3)}
    assert unicode(typeset(formula)) == "γx²y"
    assert unicode(typeset(put_in(formula, known))) == "1/2·(−3)²·2/3"
    assert unicode(typeset(put_in(x**2, {"x": fmpq(2, 3)}))) == "(2/3)²"


@pytest.mark.parametrize(
    ("count", "written"),
    [
        (24, " + ".join(map(str, range(1, 25)))),
        (25, "1 + 2 + 3 + … + 25"),
        (26, "1 + 2 + 3 + … + 26"),
    ],
)
def test_a_sum_of_more_than_24_terms_is_written_with_the_first_three_and_the_last(count: int, written: str) -> None:
    formula = SumOver(V(i), i, Counting(S(1), n))
    known = {"n": count, "V": {number: fmpq(number) for number in range(1, count + 1)}}
    assert unicode(typeset(put_in(formula, known))) == written
    assert value_of(formula, known) == count * (count + 1) // 2


def test_the_zeros_of_a_long_sum_are_not_written() -> None:
    places = tuple(map(str, range(40)))
    known = {"places": places, "V": {place: fmpq(int(place) % 20 == 3) for place in places}}
    assert unicode(typeset(put_in(SumOver(V(i), i, Places), known))) == "1 + 1"


@pytest.mark.parametrize(
    ("build", "put", "worked_out"),
    [
        (lambda: x * (x + y), "3·(3 + 13)", "3·16"),
        (lambda: x + (x + y) * y, "3 + (3 + 13)·13", "3 + 16·13"),
        (lambda: x * Pow(x + y, -1), "3/(3 + 13)", "3/16"),
        (lambda: Pow(x + y, -1), "1/(3 + 13)", "1/16"),
        (lambda: x * Pow(x + y, S.Half), "3√(3 + 13)", "3√16"),
        (lambda: 1 + Pow(x + y, S.Half), "1 + √(3 + 13)", "1 + √16"),
        (lambda: x + y, "3 + 13", "3 + 13"),
    ],
)
def test_inner_brackets_are_worked_out_between_putting_in_and_the_result(
    build: Callable[[], Expr], put: str, worked_out: str
) -> None:
    with evaluate(False):
        formula = build()
    step = put_in(formula, {"x": fmpq(3), "y": fmpq(13)})
    assert unicode(typeset(step)) == put
    assert unicode(typeset(reduced(step))) == worked_out
