"""Typesetting a worksheet and the formula sheet."""

from pytest_benchmark.fixture import BenchmarkFixture

from rldrill.exam.planning import plan
from rldrill.print.formula_sheet import sheet_source
from rldrill.print.paper import PAPERS, pdf
from rldrill.print.worksheet import worksheet_source


def bench_worksheet_of_eight(benchmark: BenchmarkFixture) -> None:
    source = worksheet_source(plan([], 8, None, 1, 1).versions[0], PAPERS["a4"])
    benchmark(pdf, source)


def bench_formula_sheet(benchmark: BenchmarkFixture) -> None:
    benchmark(pdf, sheet_source([], PAPERS["a4"]))
