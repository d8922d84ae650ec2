"""What is said of a mistake, and how it reads a formula, marked where it differs."""

from rldrill.problems.document import Equation
from rldrill.render.differences import marked
from rldrill.render.sentences import in_letters
from rldrill.solutions.formula.formula import Misconception
from rldrill.solutions.solution import Solution


def said(solution: Solution, mistake: Misconception) -> str:
    """What is said of a mistake, quantities named in the letters that the problem is written in."""
    return solution.problem.written(lambda: in_letters(mistake.says))


def misreading(solution: Solution, mistake: Misconception) -> Equation | None:
    """The formula as somebody reads it who makes the mistake; None where it is a slip in the procedure."""
    lines = misread_lines(solution, mistake)
    return None if lines is None else marked(*lines)


def misread_lines(solution: Solution, mistake: Misconception) -> tuple[Equation, Equation] | None:
    """The formula as the mistake reads it, and as it is."""
    if (formula := solution.misread(mistake)) is None:
        return None
    return solution.problem.written(
        lambda: (formula.equation(formula.misread[mistake]), formula.equation(formula.right))
    )
