"""Deciding that two exponentials are the same: by algebra, and by sympy's own means for comparison."""

import pytest
import sympy
from pytest_benchmark.fixture import BenchmarkFixture
from sympy import exp

from rldrill.solutions.exponentials import vanishes

x = sympy.Symbol("sigma")
ZERO = {
    "square": (exp(1 / x) + 1) ** 2 - exp(2 / x) - 2 * exp(1 / x) - 1,
    "quotient": 1 / (1 + exp(-2 * x)) - exp(x) / (exp(x) + exp(-x)),
    "twelfth power": (exp(1 / x) + exp(x)) ** 12 - (exp(2 / x) + exp(2 * x) + 2 * exp(x + 1 / x)) ** 6,
}


@pytest.mark.parametrize("case", ZERO)
@pytest.mark.benchmark(group="equivalence")
def bench_by_algebra(benchmark: BenchmarkFixture, case: str) -> None:
    assert benchmark(vanishes, ZERO[case])


@pytest.mark.parametrize("case", ZERO)
@pytest.mark.benchmark(group="equivalence")
def bench_by_simplification(benchmark: BenchmarkFixture, case: str) -> None:
    def simplified() -> bool:
        sympy.core.cache.clear_cache()
        return bool(sympy.simplify(ZERO[case]) == 0)

    assert benchmark.pedantic(simplified, rounds=3)
