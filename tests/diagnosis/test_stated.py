"""Mistakes that are stated beside a formula which other families read, too."""

import re

import pytest

from rldrill.problems.catalogue import selection
from rldrill.problems.family import Family
from rldrill.solutions.diagnosis.search import Search
from rldrill.solutions.drawing import draw

#: What only some problems have: a sentence that begins with it says nothing in the others.
METHODS = re.compile(r"\b(?:actor|baseline|BIC|critic|expert|filter|Q-learning|Sarsa|softmax|sweep)\b")


@pytest.mark.parametrize("family", selection([]), ids=lambda family: family.name)
def test_no_sentence_speaks_of_a_method_that_the_problem_does_not_have(family: Family) -> None:
    for level in family.levels:
        solution = draw(family.name, level, 101)
        read = [f"{formula.title} {formula.hint}" for formula in solution.work.read]
        told = " ".join((family.title, str(solution.problem.question), *read)).casefold()
        for candidate in Search(solution).stated():
            assert candidate.cause.mistake is not None
            beginning = re.split("[:;]", candidate.cause.mistake.says)[0]
            assert not [word for word in METHODS.findall(beginning) if word.casefold() not in told]
