"""Every line of a working has the value of the line before: read by the grammar that reads answers, or by algebra."""

from collections.abc import Iterator
from functools import cache
from typing import Any

import pytest
import sympy
from flint import fmpq
from sympy import Expr

from rldrill.problems.catalogue import families, family
from rldrill.problems.exact import PARAMETERS
from rldrill.render.mathematics.unicode import unicode
from rldrill.solutions.answers.text import Unreadable, read_number
from rldrill.solutions.drawing import draw
from rldrill.solutions.exact import to_sympy
from rldrill.solutions.formula.notation import Quantity
from rldrill.solutions.formula.putting_in import evaluated
from rldrill.solutions.formula.typesetting import typeset
from rldrill.solutions.matrices import is_matrix
from rldrill.solutions.rational import RationalFunction
from rldrill.solutions.solution import Solution
from rldrill.solutions.work import Elimination, Equality, Note, Step

SEEDS = range(40, 42)
LETTERS = (*PARAMETERS, "y")


@cache
def drawn(name: str) -> list[Solution]:
    return [draw(name, level, seed) for level in family(name).levels for seed in SEEDS]


def equations(solution: Solution) -> Iterator[tuple[list[Expr], dict[Expr, Expr]]]:
    """The sides of the equations that are solved in front of the reader, and what the unknowns in them are."""
    group: list[Equality] = []
    before: dict[Expr, Expr] = {}  # a letter that was found is put in later
    for line in solution.lines:
        letters = {unicode(typeset(letter)): letter for each in group for letter in unknowns(each)}
        if isinstance(line, Step) and (letter := letters.get(unicode(line.equation().left))):  # P = −b − √… ends it
            yield from ((sides(each), {letter: to_sympy(line.value)}) for each in group)
            group = []
        if isinstance(line, Elimination):
            found = dict(zip(line.names.values(), map(to_sympy, line.values), strict=True))
            for each in line.lines():
                if isinstance(each, Equality):
                    yield sides(each), found
        if isinstance(line, Equality) and not any(map(is_matrix, line.rights)) and holds_by_itself(line):
            continue
        if isinstance(line, Equality) and not any(map(is_matrix, line.rights)) and len(unknowns(line)) < 3:
            group.append(line)
            left, right = sides(line)[0], sides(line)[-1]
            if isinstance(left, sympy.Symbol | Quantity) and not right.has(left):  # γ = 3/4 ends it
                before[left] = right
                yield from ((sides(each), dict(before)) for each in group)
                group = []
    assert not group


def holds_by_itself(line: Equality) -> bool:
    """Whether nothing is solved: a value is calculated, whatever is left open."""
    first, *others = sides(line)
    return all(sympy.simplify(evaluated(first) - evaluated(other)) == 0 for other in others)


def unknowns(line: Equality) -> set[Expr]:
    """The letters of an equation; many of them stand in one of formulas, which is not solved for a number."""
    found = set().union(*(side.free_symbols | side.atoms(Quantity) for side in sides(line)))
    return {each for each in found if not any(each in other.free_symbols for other in found - {each})}


def sides(line: Equality) -> list[Expr]:
    return [side if isinstance(side, Expr) else to_sympy(side) for side in (line.left, *line.rights)]


def lines(solution: Solution) -> list[tuple[str, Any]]:
    """The right sides of steps that give a number, or a matrix of one, each with the number."""
    found = []
    for line in solution.lines:
        if not isinstance(line, Step):
            continue
        single = is_matrix(line.value) and line.value.nrows() == line.value.ncols() == 1
        value = line.value[0, 0] if single else line.value
        if isinstance(value, fmpq | RationalFunction | Expr):
            written = line.equation().rights[line.own :]  # a derivative is written in letters first
            found += [(unicode(right), value) for right in written]
    return found


def in_small(value: Any) -> Expr:
    """A value with all its letters small, as they are read."""
    expression = to_sympy(value)
    return expression.xreplace({letter: sympy.Symbol(letter.name.lower()) for letter in expression.free_symbols})


@pytest.mark.parametrize("name", families())
def test_every_line_has_the_value_of_its_step(name: str) -> None:
    for solution in drawn(name):
        for text, value in lines(solution):
            if "|" in text:  # bars are read as those between the cells of a table
                continue
            try:
                read = read_number(text, LETTERS).value
            except Unreadable:
                continue  # names, maxima over a set, vectors
            same = read == value or sympy.simplify(in_small(read) - in_small(value)) == 0
            assert same, f"{solution.problem.identity}: {text} is {read}, not {value}"


@pytest.mark.parametrize("name", families())
def test_every_equation_that_is_solved_holds_for_what_is_found(name: str) -> None:
    for solution in drawn(name):
        for equal, found in equations(solution):
            first, *others = (evaluated(side).xreplace(found) for side in equal)
            assert all(sympy.simplify(first - other) == 0 for other in others), (solution.problem.identity, equal)


def test_most_lines_are_read() -> None:
    told = [line for name in families() for solution in drawn(name) for line in lines(solution)]
    unread = 0
    for text, _ in told:
        try:
            read_number(text, LETTERS)
        except Unreadable:
            unread += 1
    assert len(told) > 5000
    assert unread < len(told) / 30  # names, factorials, vectors


@pytest.mark.parametrize("name", families())
def test_mathematics_in_sentences_is_closed(name: str) -> None:
    for level in (1, 2, 3):
        for seed in range(5):
            for line in draw(name, level, seed).lines:
                assert not isinstance(line, Note) or line.text.count("$") % 2 == 0, line.text
