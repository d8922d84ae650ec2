"""No product of matrices, and no sum of multiples of vectors, is worked out in one step: a line shows the products."""

import re

import pytest

from rldrill.render.mathematics.unicode import unicode
from rldrill.solutions.drawing import draw
from rldrill.solutions.work import Step

VECTORS = ("reinforce", "reinforce-baseline", "actor-critic", "semi-gradient-td", "score-function")
MATRICES = ("jacobian", "lqr-gain", "lqr-reward", "lqr-backward", "lqr-infinite")
MULTIPLE = re.compile(r"[·)]\([^()]*, ")  # 1/2·(1, 0)
PRODUCT = re.compile(r"][ᵀ]?\[(?=[^]]*[^] 0;1−])")  # of two matrices; those of zeros and ones only pick


def before_the_value(name: str, level: int, seed: int) -> list[str]:
    """The lines that stand before the value of every step, where it takes more than putting in."""
    steps = [line for line in draw(name, level, seed).lines if isinstance(line, Step) and line.value is not None]
    rights = [step.equation().rights for step in steps]
    return [unicode(each[-2]) for each in rights if len(each) > 1]


@pytest.mark.parametrize("level", [1, 2, 3])
@pytest.mark.parametrize("name", VECTORS)
def test_multiples_of_vectors_are_worked_out_before_they_are_added(name: str, level: int) -> None:
    for seed in range(8):
        for line in before_the_value(name, level, seed):
            assert not (MULTIPLE.search(line) and " + " in line), line


@pytest.mark.parametrize("level", [1, 2, 3])
@pytest.mark.parametrize("name", MATRICES)
def test_the_entries_of_a_product_of_matrices_are_shown_as_sums(name: str, level: int) -> None:
    for seed in range(8):
        for line in before_the_value(name, level, seed):
            assert not PRODUCT.search(line), line
