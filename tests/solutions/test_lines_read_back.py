"""Every line of a working, read by the grammar that reads answers, has the value of the step."""

import pytest
import sympy
from flint import fmpq

from rldrill.problems.catalogue import families, family
from rldrill.render.mathematics.unicode import unicode
from rldrill.solutions.answers.text import Unreadable, read_number
from rldrill.solutions.drawing import draw
from rldrill.solutions.exact import parameters, to_sympy
from rldrill.solutions.rational import RationalFunction
from rldrill.solutions.work import Step

SEEDS = range(40, 43)


def lines(name: str, level: int, seed: int) -> list[tuple[str, object, tuple[str, ...]]]:
    """The right sides of steps that give a number, each with the number and what is left open in it."""
    found = []
    for line in draw(name, level, seed).lines:
        if isinstance(line, Step) and isinstance(line.value, fmpq | RationalFunction):
            letters = tuple(parameters(line.value))
            found += [(unicode(right), line.value, letters) for right in line.equation().rights]
    return found


@pytest.mark.parametrize("name", families())
def test_every_line_has_the_value_of_its_step(name: str) -> None:
    for level in family(name).levels:
        for seed in SEEDS:
            for text, value, letters in lines(name, level, seed):
                if "|" in text:  # bars are read as those between the cells of a table
                    continue
                try:
                    read = read_number(text, letters).value
                except Unreadable:
                    continue  # names, maxima over a set, vectors
                same = read == value or sympy.simplify(to_sympy(read) - to_sympy(value)) == 0
                assert same, f"{name}/{level}/{seed}: {text} is {read}, not {value}"


def test_most_lines_are_read() -> None:
    told = [line for name in ("td-zero", "bellman-backup", "return", "q-learning") for line in lines(name, 2, 40)]
    unread = 0
    for text, _, letters in told:
        try:
            read_number(text, letters)
        except Unreadable:
            unread += 1
    assert len(told) > 10
    assert unread < len(told) / 4
