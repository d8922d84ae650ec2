"""What many tests do: state a problem, have it solved or mistaken, and round the answer as a book prints it."""

from typing import Any

import rldrill
from rldrill.solutions.exact import to_sympy


def solved(family: str, **given: Any) -> Any:
    """Return the answers of the parts of a problem with these givens."""
    return rldrill.read({"family": family, "given": given}).solve()


def mistaken(name: str, family: str, **given: Any) -> Any:
    """Return the answers that the mistake of that name gives to a problem with these givens."""
    solution = rldrill.read({"family": family, "given": given}).solution
    (answers,) = [answers for mistake, answers in solution.mistakes if mistake.name == name]
    return answers


def rounded(value: Any, decimals: int) -> str:
    """Return a value to so many decimals, as text."""
    return f"{float(to_sympy(value)):.{decimals}f}"
