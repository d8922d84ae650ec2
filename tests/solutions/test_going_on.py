"""Going on from somebody's own answers, whatever they are."""

from typing import Any

import pytest
import sympy
from flint import fmpq

import rldrill
from rldrill.problems.catalogue import families
from rldrill.problems.parts import Matrix, Number, Numbers, Part, Values
from rldrill.solutions.answers.judging import Outcome, Verdict
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.value import Value

ODD = (
    fmpq(0), fmpq(1), fmpq(-7, 3), fmpq(10**9), sympy.sqrt(2), -1 / sympy.sqrt(3), sympy.log(2), sympy.E**2, sympy.pi,
)  # fmt: skip


def with_numbers(part: Part, answer: Any, odd: Value) -> Any:
    """An answer of the same shape in which every number is the odd one; what holds none stays."""
    kind = answer_kind(part.kind)
    if not isinstance(part.kind, Number | Numbers | Values | Matrix):
        return answer
    return kind.value(dict.fromkeys(kind.cells(answer), odd))


@pytest.mark.parametrize("level", [2, 3])
@pytest.mark.parametrize("name", families())
def test_any_number_may_be_gone_on_from(name: str, level: int) -> None:
    """Rightly or with a mistake: the parts are answered until nothing follows; the diagnosis says so much at least."""
    exercise = rldrill.draw(name, level, 907)
    solution, labels = exercise.solution, list(exercise.solution.answers)
    wrong = Verdict(Outcome.WRONG, "Not right.")
    for odd in ODD:
        *before, last = solution.problem.parts
        earlier = {part.label: with_numbers(part, solution.answers[part.label], odd) for part in before}
        if not earlier:
            continue
        followed = solution.following(earlier)
        assert list(followed) == labels[: len(followed)]
        assert all(list(answers) == labels for _, answers in solution.mistaken(earlier))
        if not followed:
            text = answer_kind(last.kind).write(solution.answers[last.label])
            assert exercise.diagnosing.diagnose(last.label, text, wrong, earlier, seconds=0).sentence
