"""Whatever happens while one student's answers are marked costs that student only."""

import mmap
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from rldrill.exam.blueprint import Blueprint
from rldrill.exam.blueprint import Entry as Asked
from rldrill.exam.manifest import manifest, written
from rldrill.exam.planning import plan
from rldrill.grading import isolation, marking, verification
from rldrill.grading.assignment import Assignment
from rldrill.grading.marking import Desk, Rules
from rldrill.grading.report import Score
from rldrill.grading.verification import Settings, verify
from rldrill.solutions.answers.judging import Verdict, judge
from rldrill.solutions.solution import Solution

HEAD = "student,problem,part,answer\n"
#: V(worn) = 4 + 1/4 (6 + 3/4 · 4 − 4) = 21/4, see examples/answers.toml.
RIGHT = "21/4"


def graded(folder: Path, *answers: str, **settings: float) -> tuple[dict[str, float], list[str]]:
    path = folder / "a.csv"
    path.write_text(
        HEAD + "".join(f"{name},td-zero/1/62590,a,{text}\n" for name, text in zip("ABC", answers, strict=True))
    )
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
    path.write_text(HEAD + "A,return/1/2166,a,2/3\nA,return/1/2166,b,83/9\nB,return/1/2166,a,10\n")
    assert verify([path], Settings(isolated=True)) == verify([path])


def test_a_crash_of_the_interpreter_is_that_students_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    hostile(monkeypatch, lambda: os._exit(139))
    points, (says,) = graded(tmp_path, RIGHT, "13", RIGHT)
    assert points == {"A": 1, "C": 1}
    assert "line 3: grading what was answered to td-zero/1/62590@4 broke the interpreter down" in says


def test_what_breaks_the_process_down_afterwards_costs_nobody(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    marked = isolation.Apart.mark

    def killed(self: isolation.Apart, *task: Any) -> Any:
        try:
            return marked(self, *task)
        finally:
            self._process.kill()
            self._process.join()

    monkeypatch.setattr(isolation.Apart, "mark", killed)
    assert graded(tmp_path, RIGHT, RIGHT, RIGHT) == ({"A": 1, "B": 1, "C": 1}, [])


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
    load, tried = marking.load, tmp_path / "tried"

    def slow(name: Any) -> Any:
        if "bayes" in name:
            with tried.open("a") as file:
                file.write("tried, ")
            time.sleep(60)
        return load(name)

    monkeypatch.setattr(marking, "load", slow)
    path = tmp_path / "a.csv"
    problems = ("bayes-rule/1/43", "td-zero/1/62590")
    rows = [f"{name},{problem},a,{RIGHT}\n" for name in "ABCDEFGH" for problem in problems]
    path.write_text(HEAD + "".join(rows))
    report = verify([path], Settings(isolated=True))
    assert [student.score for student in report.students] == [Score(1, 1)] * 8  # type: ignore[arg-type]
    assert len(report.refused) == 8
    assert tried.read_text() == "tried, "


def test_numbers_of_a_hundred_thousand_digits_are_an_answer_that_is_not_read(tmp_path: Path) -> None:
    points, refused = graded(tmp_path, "9" * 100_000, "9^9^9^9", RIGHT)
    assert (points, refused) == ({"A": 0, "B": 0, "C": 1}, [])


def test_memory_that_the_caller_holds_is_not_counted(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text(f"{HEAD}Ann,td-zero/1/62590,a,{RIGHT}\n")
    held = mmap.mmap(-1, 5 * 2**30, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS | getattr(mmap, "MAP_NORESERVE", 0))
    try:
        report = verify([path], Settings(isolated=True))
    finally:
        held.close()
    assert not report.refused
    assert report.score.points == 1


def test_whoever_names_problem_after_problem_spends_their_own_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    load = marking.load
    monkeypatch.setattr(marking, "load", lambda name: (time.sleep(0.2 if "bayes" in name else 0), load(name))[1])
    path = tmp_path / "a.csv"
    rows = [f"Eve,bayes-rule/1/{seed},a,1\n" for seed in range(500)]
    path.write_text(HEAD + "".join(rows) + f"Ann,td-zero/1/62590,a,{RIGHT}\n")
    begun = time.perf_counter()
    report = verify([path], Settings(isolated=True, student=1.0))
    assert time.perf_counter() - begun < 10
    assert len(report.refused) > 480
    assert "grading this student took more than 1 seconds" in report.refused[-1].says
    (ann,) = [student for student in report.students if student.student == "Ann"]
    assert ann.score.points == 1


def test_solving_the_exam_is_not_the_first_students_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    exam = plan(Blueprint(problems=(Asked(id="td-zero/1/62590"), Asked(id="return/1/2166")), seed=7))
    manifest_path = tmp_path / "exam.json"
    manifest_path.write_bytes(written(manifest(exam)))
    problem = Desk.problem

    def slow(desk: Desk, ref: Any) -> Any:
        if ref not in desk._problems:
            time.sleep(0.5)
        return problem(desk, ref)

    monkeypatch.setattr(Desk, "problem", slow)
    path = tmp_path / "a.csv"
    path.write_text(f"{HEAD}Ann,1,a,{RIGHT}\nAnn,2,a,2\nAnn,2,b,29/3\n")
    report = verify([path], Settings(assignment=Assignment(manifest_path), isolated=True, student=0.9))
    assert not report.refused
    assert report.score.points == report.score.of


def test_the_whole_run_has_a_bound(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.csv"
    path.write_text(f"{HEAD}A,td-zero/1/62590,a,{RIGHT}\n")
    assert verify([path]).exit_code == 0  # what is imported for it is there now
    monkeypatch.setattr("rldrill.grading.verification.RUN", 1.3)
    hostile(monkeypatch, lambda: time.sleep(0.7))
    path.write_text(HEAD + "".join(f"{number},td-zero/1/62590,a,{13}\n" for number in range(3)))
    monkeypatch.setattr(marking, "_KEPT", -1)  # nothing is remembered, so that every answer takes its time
    report = verify([path], Settings(isolated=True, rules=Rules(causes=False)))
    assert len(report.students) == 2
    assert "the run took more than 1.3 seconds; grade the rest in another one" in report.refused[0].says


def test_only_the_problems_of_one_version_are_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    exam = plan(Blueprint(problems=(Asked(family="return", level=1, count=2),), versions=3, seed=5))
    path = tmp_path / "exam.json"
    path.write_bytes(written(manifest(exam)))
    (tmp_path / "roster.csv").write_text("student,version\nA,C\nB,A\nC,C\nD,B\n")
    answers = tmp_path / "a.csv"
    answers.write_text(HEAD + "".join(f"{student},1,a,1\n" for student in "ABCD"))
    loaded: list[tuple[str, int]] = []
    make_room = Desk._make_room

    def counted(desk: Desk, ref: tuple[str, int]) -> None:
        loaded.append(ref)
        make_room(desk, ref)
        assert len(desk._problems) < 2

    monkeypatch.setattr(Desk, "_make_room", counted)
    report = verify([answers], Settings(assignment=Assignment(path, roster=tmp_path / "roster.csv")))
    assert [student.student for student in report.students] == ["A", "B", "C", "D"]
    assert loaded == [("A", 0), ("B", 0), ("C", 0)]  # each version once, and nothing that nobody answered


def test_a_problem_of_the_exam_that_cannot_be_made_takes_no_other_with_it(tmp_path: Path) -> None:
    data = manifest(plan(Blueprint(problems=(Asked(id="td-zero/1/62590"), Asked(family="return", level=1)), seed=5)))
    data["versions"][0]["problems"][1]["problem"]["family"] = "of-another-package"
    path, answers = tmp_path / "exam.json", tmp_path / "a.csv"
    path.write_bytes(written(data))
    answers.write_text(f"{HEAD}A,1,a,{RIGHT}\nA,2,a,1\n")
    report = verify([answers], Settings(assignment=Assignment(path), isolated=True))
    assert [part.judged.verdict for part in report.parts][:2] == ["right", "not graded"]
    (refused,) = report.refused
    assert "version A, problem 2: There is no family 'of-another-package'" in refused.says


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere another judge is not inherited")
def test_whoever_ends_the_grading_ends_its_marking_too(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text(f"{HEAD}A,td-zero/1/62590,a,13\n")
    program = (
        "import os, signal, sys, time\n"
        "from rldrill.grading import marking, verification\n"
        "def judge(*_):\n"
        "    os.kill(os.getppid(), signal.SIGTERM)\n"
        "    time.sleep(60)\n"
        "marking.judge = judge\n"
        "verification.verify([sys.argv[1]], verification.Settings(isolated=True))\n"
    )
    run = [sys.executable, "-c", program, str(tmp_path / "a.csv")]
    done = subprocess.run(run, capture_output=True, timeout=30, check=False)  # the pipes close with the last process
    assert done.returncode == -signal.SIGTERM


def test_the_bounds_are_those_that_are_told() -> None:
    told = (Path(__file__).parents[2] / "docs" / "grading.md").read_text(encoding="utf-8")
    assert f"| solving one problem | {isolation.LOADING:g} s;" in told
    assert f"| grading one student | `--seconds`, {verification.STUDENT:g};" in told
    assert (verification.RUN, "| the whole run | one hour;" in told) == (3600, True)
    assert f"come from | {marking.SEARCH:g} s a problem, {marking.ALL_SEARCHES:g} s in all;" in told
    assert f"| memory of marking | {isolation.MEMORY // 2**30} GB," in told
