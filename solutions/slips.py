"""What slips are made of."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from rldrill.solutions.answers.rule import apart
from rldrill.solutions.exact import NoSolution, NotGiven
from rldrill.solutions.formula.formula import Misconception
from rldrill.solutions.work import Work


def right_answers(solve: Callable[[Any, Work], None], given: Any, work: Work) -> list[Any]:
    """The answers of the right way, going on from the same earlier ones: for a slip that exchanges some of them."""
    if work.right:
        return list(work.right)
    right = Work(carried=work.carried)
    solve(given, right)
    return list(right.answers.values())


def where_it_shows(solve: Callable[[Any, Work], None], mistake: Misconception) -> Misconception:
    """A mistake, for a solver, where its answers can be told from the right ones: numbers may hide it."""

    def shows(given: Any) -> bool:
        if not mistake.applies(given):
            return False
        right, wrong = Work(), Work(mistake)
        try:
            solve(given, right)
            (mistake.solve or solve)(given, wrong)
        except (NoSolution, NotGiven):
            return False
        return _apart(right.answers, wrong.answers)

    return replace(mistake, when=shows)


def _apart(right: Any, wrong: Any) -> bool:
    """Whether a marker can tell some answer from the right one."""
    if isinstance(right, dict):
        return any(_apart(number, wrong[key]) for key, number in right.items())
    if isinstance(right, tuple):
        return any(map(_apart, right, wrong))
    return right != wrong if isinstance(right, bool | str) else apart(right, wrong)
