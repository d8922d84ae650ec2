"""From the command line to its first output."""

import subprocess
import sys

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

FIRST_QUESTION = """
from rldrill.exercise import draw
from rldrill.render.terminal import console, render
console().print(render(draw("td-zero", 2, 1).question()))
"""


@pytest.mark.parametrize(
    "arguments",
    [["-c", "pass"], ["-m", "rldrill", "-h"], ["-m", "rldrill", "list"], ["-c", FIRST_QUESTION]],
    ids=["python alone", "rldrill -h", "rldrill list", "first question"],
)
def bench_start(benchmark: BenchmarkFixture, arguments: list[str]) -> None:
    benchmark.pedantic(
        lambda: subprocess.run([sys.executable, *arguments], check=True, capture_output=True),
        rounds=7,
        iterations=1,
    )
