"""How long the quiz takes in a terminal: to its start, from a key to its echo, from Enter to what comes then.

    python benchmarks/answering.py [PROBLEMS] [SEED]

A quiz runs in a pseudo-terminal. Somebody reads for a second, types an answer key by key in two, first a wrong one and
then the right one, and goes on. The clock is right on an idle machine only; beside it stands what the thread that reads
keys and writes took of the processor, without what works in the background. Linux only.
"""

import os
import re
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from statistics import median, quantiles

import pexpect

from rldrill.exercise import Exercise
from rldrill.history.attempts import Attempt
from rldrill.history.log import append
from rldrill.problems.catalogue import families
from rldrill.problems.parts import Choice, YesNo
from rldrill.quiz.questions import questions
from rldrill.solutions.answers.kinds import answer_kind

#: So long, in seconds, somebody reads, and types an answer.
_READS, _TYPES = 1.0, 2.0
_VERDICT, _PROMPT = "[✓✗≈]|Not understood", r">(?:[\s\b]|\x1b\[[0-9;?]*[A-Za-z])+$"


#: What the quiz cannot do without; pydantic imports most of itself with the first model.
_NEEDED = """
import typer, rich.console, sympy, flint, fsrs, prompt_toolkit, sqlite3, platformdirs
from pydantic import BaseModel
class Model(BaseModel): pass
input('>')
"""
_ROUNDS = 7


def _spawned(home: str, *arguments: str) -> pexpect.spawn:
    environment = {**os.environ, "RLDRILL_HOME": home, "TERM": "xterm-256color"}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # the installed program keeps what is compiled
    child = pexpect.spawn(
        sys.executable, list(arguments), encoding="utf-8", timeout=60, dimensions=(24, 80), env=environment
    )
    child.delaybeforesend = None
    return child


def _processor(child: pexpect.spawn, *, whole: bool) -> float:
    """The seconds that a process has had of the processor, or its main thread alone."""
    tasks = Path(f"/proc/{child.pid}/task")
    threads = tasks.iterdir() if whole else [tasks / str(child.pid)]
    return sum(int((thread / "schedstat").read_text().split()[0]) for thread in threads) / 1e9


def starts(home: str) -> dict[str, float]:
    """The seconds of the processor up to what the quiz says first, and up to its first question."""
    quiz = ("-m", "rldrill", "quiz")
    cases = {
        "the bare imports": (("-c", _NEEDED), ">"),
        "the first line": (quiz, "Your first quiz"),
        "a newcomer's first prompt": (quiz, "n the problem"),
        "the first question": ((*quiz, "return/1/7"), r"\(a\) >"),
    }
    times: dict[str, list[float]] = {}
    for _ in range(_ROUNDS):
        for what, (arguments, then) in cases.items():
            child = _spawned(home, *arguments)
            child.expect(then)
            times.setdefault(what, []).append(_processor(child, whole=True))
            child.close(force=True)
    return {what: median(each) for what, each in times.items()}


def _knows_all(home: Path) -> None:
    """Every family was asked once, so that none begins with a worked example."""
    long_ago = datetime(2026, 1, 1, tzinfo=UTC)
    append(
        home / "history.db",
        (Attempt(name, long_ago, name, name, 1, 0, 1, "a", 1, "", "right", (), 0, 0, 60.0, 1.0) for name in families()),
    )


class Person:
    """Answers at a terminal, and measures how long each answer takes: by the clock, and of the processor."""

    def __init__(self, number: int, seed: int, home: str) -> None:
        self._child = _spawned(home, "-m", "rldrill", "quiz", "-n", str(number), "--seed", str(seed))
        self.times: dict[str, list[tuple[float, float]]] = {}

    def sits(self, exercises: Iterator[Exercise]) -> None:
        """Answer all of them."""
        for exercise in exercises:
            self._child.expect(_PROMPT)
            for part in exercise.parts:
                if not isinstance(part.kind, YesNo | Choice):
                    wrong = exercise.diagnosing.wrong_answers(part.label, 1)
                    if wrong:
                        self._answers("verdict on a wrong answer", wrong[0].answer)
                right = answer_kind(part.kind).write(exercise.solution.answers[part.label])
                self._answers("verdict on a right answer", right)
            time.sleep(_READS)
            self._takes("next problem", "\r", "Problem|points in")
        self._child.close(force=True)

    def _answers(self, what: str, text: str) -> None:
        for key in text:
            time.sleep(_TYPES / len(text))
            self._takes("echo of a key", key, re.escape(key) + r"|\x1b\[")
        time.sleep(0.1)
        self._takes(what, "\r", _VERDICT)
        self._child.expect(_PROMPT)

    def _takes(self, what: str, keys: str, then: str) -> None:
        with suppress(pexpect.TIMEOUT):
            self._child.expect(".+", timeout=0)  # what was written before
        clock, processor = time.perf_counter(), _processor(self._child, whole=False)
        self._child.send(keys)
        self._child.expect(then)
        took = time.perf_counter() - clock, _processor(self._child, whole=False) - processor
        self.times.setdefault(what, []).append(took)


def main() -> None:
    """Print how it starts, and the medians and the 90 % quantiles of what comes then."""
    number, seed = ([int(each) for each in sys.argv[1:]] + [12, 7][len(sys.argv) - 1 :])[:2]
    with tempfile.TemporaryDirectory() as home:
        started = starts(home)
        for what, seconds in started.items():
            print(f"{what:26} {seconds:.2f} s of the processor, {seconds / started['the bare imports']:.2f} times")
        _knows_all(Path(home))
        exercises, _ = questions([], number, None, lambda: seed)
        person = Person(number, seed, home)
        person.sits(exercises)
    print(f"{'':26}      by the clock: median, 90 % within      of the processor: the same")
    for what, times in person.times.items():
        clock, processor = zip(*times, strict=True)
        told = (f"{1000 * median(each):5.1f} {1000 * quantiles(each, n=10)[-1]:7.1f} ms" for each in (clock, processor))
        print(f"{what:26} {len(times):5}   {'                  '.join(told)}")


if __name__ == "__main__":
    main()
