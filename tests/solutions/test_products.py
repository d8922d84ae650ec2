"""No product of matrices, and no sum of multiples of vectors, is worked out in one step: a line shows the products."""

import re

import pytest

from rldrill.render.mathematics.unicode import unicode
from rldrill.solutions.drawing import draw
from rldrill.solutions.work import Step

VECTORS = ("reinforce", "reinforce-baseline", "actor-critic", "semi-gradient-td", "score-function")
MATRICES = ("jacobian", "lqr-gain", "lqr-reward", "lqr-backward", "lqr-infinite")
MULTIPLE = re.compile(r"[·)]\([^()]*, ")  # 1/2·(1, 0)
PRODUCT = re.compile(r"\[([^]]*)](ᵀ?)\[([^]]*)]")


def before_the_value(name: str, level: int, seed: int) -> list[str]:
    """The lines that stand before the value of every step, where it takes more than putting in."""
    steps = [line for line in draw(name, level, seed).lines if isinstance(line, Step) and line.value is not None]
    rights = [step.equation().rights for step in steps]
    return [unicode(each[-2]) for each in rights if len(each) > 1]


def is_sum(product: re.Match[str]) -> bool:
    """Whether an entry of a product adds up several products; one of zeros and ones only picks."""
    left, right = ([re.split(" +", line.strip()) for line in product[i].split(";")] for i in (1, 3))
    columns, rows = list(zip(*right, strict=True)), list(zip(*left, strict=True)) if product[2] else left
    return any(sum(a != "0" != b for a, b in zip(row, column, strict=True)) > 1 for row in rows for column in columns)


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
            assert not any(map(is_sum, PRODUCT.finditer(line))), line
