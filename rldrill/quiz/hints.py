"""Hints as a ladder: the formula, what its symbols are here, then the working line by line."""

from collections.abc import Iterable, Iterator

import sympy
from msgspec import Struct

from rldrill.exercise import Exercise
from rldrill.problems.document import Block, Document, Equation, Paragraph
from rldrill.problems.parts import YesNo
from rldrill.render.sentences import in_letters
from rldrill.solutions.exact import NoSolution, NotGiven
from rldrill.solutions.formula.compiling import needs, value_of
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.formula.node import Node
from rldrill.solutions.formula.putting_in import indexed
from rldrill.solutions.formula.typesetting import typeset
from rldrill.solutions.matrices import is_matrix
from rldrill.solutions.work import Recalled, Step, shown_value

#: The lines of a working are at most so many hints; longer workings give several lines at once.
_LINES = 6
_NO_FORMULA = "No formula is needed here: go by what is given, and by what you found before."


class Rung(Struct, frozen=True):
    """One hint: what it is about, what it shows, and whether that is a line of the working."""

    says: str
    blocks: Document
    is_working: bool = False


def ladder(exercise: Exercise, label: str) -> list[Rung]:
    """The hints to a part, from the formula to the last line of its working."""
    return list(exercise.problem.written(lambda: tuple(_ladder(exercise, label))))


def _ladder(exercise: Exercise, label: str) -> list[Rung]:
    formulas = _formulas(exercise, label)
    stated = [formula.equation() for formula in formulas]
    rungs = [Rung("what it takes", tuple(stated) or (Paragraph(_NO_FORMULA),))]
    meaning = (*_said(formula.hint for formula in formulas), *_symbols(exercise, label))
    if meaning:
        rungs.append(Rung("what stands for what here", meaning))
    stated += [formula.equation(formula.right) for formula in formulas]  # as the working states them
    written = [block for block in exercise.working(label) if block not in stated]
    lines = list(_first_apart(_lines(written)))
    for number, several in enumerate(_spread(lines)):
        says = "how it begins" if number == 0 else "how it goes on"
        rungs.append(Rung(says, tuple(block for line in several for block in line), is_working=True))
    return rungs


def _formulas(exercise: Exercise, label: str) -> tuple[Formula, ...]:
    """The formulas of a part; whether something is so follows from the parts before, unless it has its own."""
    own = any(isinstance(line, Step | Recalled) for line in exercise.solution.lines_of(label))
    part = next(part for part in exercise.parts if part.label == label)
    return exercise.formulas(label) if own or not isinstance(part.kind, YesNo) else ()


def _said(hints: Iterable[str]) -> Iterator[Block]:
    for hint in dict.fromkeys(hints):
        yield Paragraph(in_letters(hint))


def _symbols(exercise: Exercise, label: str) -> Iterator[Equation]:
    """What the symbols of each formula are in the first step that uses it: γ = 1/2, V(sₜ) = V(cool) = 7.

    What an earlier step gives is not told: it is found on the way.
    """
    formulas, told = set[Formula](), set[sympy.Basic]()
    for step in (line for line in exercise.solution.lines_of(label) if isinstance(line, Step)):
        if step.formula not in formulas:
            formulas.add(step.formula)
            for expression in sympy.preorder_traversal(step.right):
                equation = _symbol(expression, step) if expression not in told else None
                told.add(expression)
                if equation is not None:
                    yield equation
        told.add(step.named)


def _symbol(expression: sympy.Basic, step: Step) -> Equation | None:
    is_quantity = isinstance(expression, Node) and bool(expression.code)
    if not (is_quantity or isinstance(expression, sympy.Symbol)) or not set(needs(expression)) <= set(step.known):
        return None
    try:
        value = value_of(expression, step.known)
        if isinstance(value, str | tuple | list | dict) or (is_matrix(value) and value.nrows() * value.ncols() > 1):
            return None  # a state, a set or a table stands in the question
        rights = dict.fromkeys((typeset(indexed(expression, step.known)), shown_value(value)))
    except (NotGiven, NoSolution, KeyError, TypeError, AttributeError):
        return None  # what has no value of its own here is not told
    left = typeset(expression)
    rights.pop(left, None)
    return Equation(left, tuple(rights), ("=",) * len(rights)) if rights else None


def _lines(blocks: Iterable[Block]) -> Iterator[list[Block]]:
    """The lines of a working, sentences together with the equation that they introduce."""
    line: list[Block] = []
    for block in blocks:
        line.append(block)
        if not isinstance(block, Paragraph):
            yield line
            line = []
    if line:
        yield line


def _first_apart(lines: Iterable[list[Block]]) -> Iterator[list[Block]]:
    """The lines, the first of them once without what comes out of it, and then whole."""
    for number, line in enumerate(lines):
        equation = line[-1]
        if number == 0 and isinstance(equation, Equation) and len(equation.rights) > 1:
            yield [*line[:-1], equation.without_last()]
            yield [equation]
        else:
            yield line


def _spread(lines: list[list[Block]]) -> Iterator[list[list[Block]]]:
    """The first line for itself, the others in few parts that are about equally long."""
    if lines:
        yield lines[:1]
    rest, parts = lines[1:], min(len(lines) - 1, _LINES - 1)
    for number in range(parts):
        yield rest[number * len(rest) // parts : (number + 1) * len(rest) // parts]
