"""Typesetting a worksheet and the formula sheet."""

from pytest_benchmark.fixture import BenchmarkFixture

from rldrill.exam.blueprint import Blueprint, Entry
from rldrill.exam.planning import plan
from rldrill.print.formula_sheet import sheet_source
from rldrill.print.paper import pdf
from rldrill.print.worksheet import worksheet_source


def bench_worksheet_of_eight(benchmark: BenchmarkFixture) -> None:
    exam = plan(Blueprint(problems=(Entry(topic=(), count=8),), seed=1, versions=20))
    sources = iter([worksheet_source(exam, version) for version in exam.versions])
    benchmark.pedantic(lambda: pdf(next(sources), accessible=True), rounds=20)  # the compiler remembers a source


def bench_formula_sheet(benchmark: BenchmarkFixture) -> None:
    benchmark(pdf, sheet_source([], "a4"))
