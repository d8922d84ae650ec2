"""A run of chosen tests in a copy of the tree, in a process of its own that may hang, crash or eat memory."""

import importlib
import importlib.util
import json
import math
import multiprocessing
import os
import resource
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from multiprocessing.connection import wait
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

_MEMORY = 4 * 2**30
#: A run may take its limit of the processor, and this many times its limit by the clock, for others work too.
_PATIENCE = 4
_FORK = multiprocessing.get_context("fork")
#: Loaded once here, so that no run has to: none of them loads a part of the program.
_HEAVY = ("flint", "numpy", "pydantic", "rich", "sympy", "typer", "typst")


@dataclass(frozen=True)
class Run:
    """What is to be run: tests in their order; a file's changed content; all tests are only collected if asked.

    After ``budget`` seconds of the processor no other test is begun: by the clock, tests take longer where others work.
    """

    tests: tuple[str, ...] = ()
    path: str = ""
    content: bytes = b""
    collect_only: bool = False
    keep_going: bool = False
    budget: float = math.inf


@dataclass
class Result:
    """How a run ended: pytest's exit code, None where it hung or crashed; the tests seen, how many ran, the failed."""

    code: int | None = None
    hung: bool = False
    seconds: float = 0.0
    seen: list[str] = field(default_factory=list)
    ran: int = 0
    failed: list[str] = field(default_factory=list)


class Chosen:
    """A plugin of pytest that runs the chosen tests only, in their order, and notes what became of them."""

    def __init__(self, run: Run, result: Result, now: Path) -> None:
        self._places = {test: place for place, test in enumerate(run.tests)}
        self._result = result
        self._budget, self._begun, self._now = run.budget, 0.0, now

    @pytest.hookimpl(trylast=True)
    def pytest_configure(self) -> None:
        # A slow machine is no reason to call a change noticed.
        quick = settings.get_profile("quick")
        settings.register_profile("unhurried", quick, deadline=None, suppress_health_check=list(HealthCheck))
        settings.load_profile("unhurried")

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        if self._places:
            chosen = (item for item in items if item.nodeid in self._places)
            items[:] = sorted(chosen, key=lambda item: self._places[item.nodeid])
        self._result.seen = [item.nodeid for item in items]
        self._begun = _spent()

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        if report.failed:
            self._result.failed.append(report.nodeid)

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> bool | None:
        """Pass over what there is no time for; note what is run, for it may crash."""
        if _spent() - self._begun > self._budget:
            return True
        self._now.write_text(item.nodeid, encoding="utf-8")
        self._result.ran += 1
        return None

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed:
            self._result.failed.append(report.nodeid)


def _spent() -> float:
    """Seconds of the processor, with those of processes that have ended."""
    return sum(os.times()[:4])


def files(root: Path) -> list[str]:
    """The paths of the tree, tracked or new, without what git ignores."""
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    listed = subprocess.run(command, cwd=root, check=True, capture_output=True).stdout
    return sorted({name for name in os.fsdecode(listed).split("\0") if name and os.path.lexists(root / name)})


def copied(root: Path, paths: Sequence[str], copy: Path) -> None:
    """Copy the tree, links as links."""
    for name in paths:
        (copy / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(root / name, copy / name, follow_symlinks=False)


def load() -> None:
    """Load what every run needs."""
    os.environ.update(PYTHONDONTWRITEBYTECODE="1", OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    for name in _HEAVY:
        importlib.import_module(name)


def run_all(runs: Sequence[Run], copies: Sequence[Path], limit: float) -> Iterator[tuple[int, Result]]:
    """Do all runs, one at a time in each copy; yield the number of each with its result as it ends."""
    free, waiting, running = list(copies), list(enumerate(runs)), list[_Running]()
    try:
        while waiting or running:
            while waiting and free:
                number, run = waiting.pop(0)
                running.append(_Running(number, run, free.pop(), limit))
            wait([each.process.sentinel for each in running], timeout=max(0.0, min(each.left() for each in running)))
            for each in [each for each in running if each.is_over()]:
                running.remove(each)
                free.append(each.copy)
                yield each.number, each.end()
    finally:
        for each in running:
            each.end()


class _Running:
    """A run that has begun."""

    def __init__(self, number: int, run: Run, copy: Path, limit: float) -> None:
        self.number, self.copy = number, copy
        self._restore = _change(copy, run)
        self._begun, self._limit = time.monotonic(), _PATIENCE * limit
        self._report = copy.with_suffix(".json")
        self._report.unlink(missing_ok=True)
        self._now = copy.with_suffix(".now")
        self._now.write_text("the import of the tests", encoding="utf-8")
        self.process: BaseProcess = _FORK.Process(target=_work, args=(run, copy, self._report, self._now, limit))
        self.process.start()

    def left(self) -> float:
        return self._begun + self._limit - time.monotonic()

    def is_over(self) -> bool:
        return not self.process.is_alive() or self.left() <= 0

    def end(self) -> Result:
        hung = self.process.is_alive()
        if hung:
            assert self.process.pid
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.join()
        hung = hung or self.process.exitcode == -signal.SIGXCPU
        self._restore()
        found: dict[str, Any] = {"failed": [self._now.read_text(encoding="utf-8")]}
        if self._report.exists() and not hung:
            found = json.loads(self._report.read_text(encoding="utf-8"))
        return Result(**found | {"hung": hung, "seconds": time.monotonic() - self._begun})


def _change(copy: Path, run: Run) -> Callable[[], None]:
    """Change the file in the copy, and return what takes the change back."""
    if not run.path:
        return lambda: None
    path = copy / run.path
    before = path.read_bytes()
    Path(importlib.util.cache_from_source(path)).unlink(missing_ok=True)
    path.write_bytes(run.content)

    def restore() -> None:
        path.write_bytes(before)

    return restore


def _work(run: Run, copy: Path, report: Path, now: Path, limit: float) -> None:
    """What the process does; it writes its report at the end."""
    os.setsid()
    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(limit), resource.RLIM_INFINITY))
    os.chdir(copy)
    os.environ["PYTHONPATH"] = str(copy)
    sys.path.insert(0, str(copy))
    sys.dont_write_bytecode = not run.collect_only
    found = importlib.util.find_spec("rldrill")
    assert found
    assert Path(found.origin or "").is_relative_to(copy), "the copy is what must be tested"
    with copy.with_suffix(".log").open("w") as log:
        os.dup2(log.fileno(), 1)
        os.dup2(log.fileno(), 2)
        result = Result()
        options = ["-p", "no:cacheprovider", "--hypothesis-profile=quick", "--hypothesis-seed=0", "--tb=short"]
        options += [f"--rootdir={copy}", f"--basetemp={copy.with_suffix('.tmp')}"]
        if run.collect_only:
            options += ["--collect-only", "--ignore=tests/mutation", "tests"]
        else:
            options += ["-x"] * (not run.keep_going) + sorted({test.partition("::")[0] for test in run.tests})
        if run.tests or run.collect_only:
            result.code = int(pytest.main(options, plugins=[Chosen(run, result, now)]))
        else:
            result.code = pytest.ExitCode.NO_TESTS_COLLECTED
        report.write_text(json.dumps(vars(result)), encoding="utf-8")
