"""Whatever happens while one student's answers are marked costs that student only."""

import mmap
import os
import sys
import time
from pathlib import Path

import pytest

from rldrill.grading import marking
from rldrill.grading.report import Score
from rldrill.grading.verification import Settings, verify
from rldrill.solutions.answers.judging import Verdict, judge
from rldrill.solutions.solution import Solution

HEAD = "student,problem,part,answer\n"
#: V(worn) = 4 + 1/4 (6 + 3/4 · 4 − 4) = 21/4, see examples/answers.toml.
RIGHT = "21/4"


def graded(folder: Path, *answers: str, **settings: float) -> tuple[dict[str, float], list[str]]:
    path = folder / "a.csv"
    path.write_text(HEAD + "".join(f"{name},td-zero/1/7,a,{text}\n" for name, text in zip("ABC", answers, strict=True)))
    report = verify([path], Settings(isolated=True, **settings))
    assert all(student.score.of == 1 for student in report.students)
    return {each.student: float(each.score.points) for each in report.students}, [each.says for each in report.refused]


def hostile(monkeypatch: pytest.MonkeyPatch, what: object) -> None:
    """Judging the answer 13 does something that it must not."""

    def judged(solution: Solution, label: str, text: str, earlier: object = None) -> Verdict:
        if text == "13":
            what()  # type: ignore[operator]
        return judge(solution, label, text, earlier)  # type: ignore[arg-type]

    monkeypatch.setattr(marking, "judge", judged)


def test_marking_apart_gives_what_marking_here_gives(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text(HEAD + "A,return/1/7,a,2/3\nA,return/1/7,b,83/9\nB,return/1/7,a,10\n")
    assert verify([path], Settings(isolated=True)) == verify([path])


def test_a_crash_of_the_interpreter_is_that_students_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    hostile(monkeypatch, lambda: os._exit(139))
    points, (says,) = graded(tmp_path, RIGHT, "13", RIGHT)
    assert points == {"A": 1, "C": 1}
    assert "line 3: grading what was answered to td-zero/1/7@3 broke the interpreter down" in says


def test_an_endless_search_ends_with_that_students_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    hostile(monkeypatch, lambda: time.sleep(60))
    begun = time.perf_counter()
    points, (says,) = graded(tmp_path, RIGHT, "13", RIGHT, student=0.5)
    assert points == {"A": 1, "C": 1}
    assert "took more than 0.5 seconds" in says
    assert time.perf_counter() - begun < 10


def test_an_error_of_our_own_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails() -> None:
        raise ArithmeticError("no such thing")

    hostile(monkeypatch, fails)
    points, (says,) = graded(tmp_path, RIGHT, "13", RIGHT)
    assert (points, "ArithmeticError: no such thing" in says) == ({"A": 1, "C": 1}, True)


@pytest.mark.skipif(sys.platform != "linux", reason="only there the bound is enforced")
def test_too_much_memory_is_that_students_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    hostile(monkeypatch, lambda: bytearray(8 * 2**30))
    points, (says,) = graded(tmp_path, RIGHT, "13", RIGHT)
    assert (points, "of memory" in says) == ({"A": 1, "C": 1}, True)


def test_a_problem_that_cannot_be_solved_in_time_is_tried_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rldrill.grading.isolation.LOADING", 0.3)
    load = marking.load
    monkeypatch.setattr(marking, "load", lambda name: time.sleep(60) if "bayes" in name else load(name))
    path = tmp_path / "a.csv"
    rows = [f"{name},{problem},a,{RIGHT}\n" for name in "ABCDEFGH" for problem in ("bayes-rule/1/7", "td-zero/1/7")]
    path.write_text(HEAD + "".join(rows))
    begun = time.perf_counter()
    report = verify([path], Settings(isolated=True))
    assert [student.score for student in report.students] == [Score(1, 1)] * 8  # type: ignore[arg-type]
    assert len(report.refused) == 8
    assert time.perf_counter() - begun < 8


def test_numbers_of_a_hundred_thousand_digits_are_an_answer_that_is_not_read(tmp_path: Path) -> None:
    points, refused = graded(tmp_path, "9" * 100_000, "9^9^9^9", RIGHT)
    assert (points, refused) == ({"A": 0, "B": 0, "C": 1}, [])


def test_memory_that_the_caller_holds_is_not_counted(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text(f"{HEAD}Ann,td-zero/1/7,a,{RIGHT}\n")
    held = mmap.mmap(-1, 5 * 2**30, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS | getattr(mmap, "MAP_NORESERVE", 0))
    try:
        report = verify([path], Settings(isolated=True))
    finally:
        held.close()
    assert not report.refused
    assert report.score.points == 1
