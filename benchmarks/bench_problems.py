"""Drawing and solving accepted problems, and judging answers."""

from itertools import count

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from rldrill.problems.catalogue import families, family
from rldrill.solutions.answers.judging import judge
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.drawing import draw

CASES = [(name, level) for name in families() for level in family(name).levels]


@pytest.mark.parametrize(("name", "level"), CASES)
def bench_draw_and_solve(benchmark: BenchmarkFixture, name: str, level: int) -> None:
    draw(name, level, 0)  # formulas are compiled once
    seeds = count(1)
    benchmark.pedantic(lambda: draw(name, level, next(seeds)), rounds=100, iterations=1, warmup_rounds=5)


@pytest.mark.parametrize("outcome", ["right", "wrong", "unreadable"])
def bench_judge(benchmark: BenchmarkFixture, outcome: str) -> None:
    solution = draw("value-iteration", 2, 1)
    part = solution.problem.parts[0]
    samples = answer_kind(part.kind).samples(solution.answers["a"])
    text = getattr(samples, outcome)[-1 if outcome != "unreadable" else 1]
    benchmark(judge, solution, "a", text)
