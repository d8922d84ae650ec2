"""What was worked out with a letter in it, once the letter is found."""

from typing import Any

from rldrill.solutions.formula.finding import with_number
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.formula.putting_in import indexed
from rldrill.solutions.rational import with_found
from rldrill.solutions.value import Value
from rldrill.solutions.work import Equality, Work


def put_in_found(work: Work, formula: Formula, letter: str, value: Value, found: Value, **indices: Any) -> Value:
    """The value for the number that was found, which is put in in front of the reader.

    Args:
        work: the working.
        formula: the formula whose quantity it is.
        letter: the letter.
        value: what was worked out, in terms of the letter.
        found: the letter's value.
        **indices: those of the quantity.
    """
    there = with_found(value, found)
    work.lines.append(Equality(indexed(formula.left, indices), (with_number([[value]], letter, found), there)))
    return there
