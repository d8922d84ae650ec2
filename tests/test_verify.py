"""Files of answers: how they are read, judged, reported and refused."""

import contextlib
import errno
import json
import subprocess
import sys
from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

import pytest
import typer
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from typer.testing import CliRunner

from rldrill.commands import verify as verify_command
from rldrill.grading.answers_file import read_answers
from rldrill.grading.marking import Rules
from rldrill.grading.report import MarkedPart, Report, Score
from rldrill.grading.verification import Settings
from rldrill.grading.verification import verify as verify_with
from rldrill.problems.catalogue import family
from rldrill.problems.errors import FileError, NothingToGrade, UsageError

EXAMPLES = Path(__file__).parents[1] / "examples"

# R₁ = −2 + 1/2 · 4 + 1/4 · 1 = 1/4, then R₀ = 3 + 1/2 · 1/4 = 25/8.
RETURN = 'family = "return"\n[given]\nrewards = [3, -2, 4, 1]\ngamma = "1/2"\ntime = 1\n'
# V(rim) = 7 + 1/10 · (1 + 4/5 · 5 − 7) = 34/5; with γ forgotten 7 + 1/10 · (1 + 5 − 7) = 69/10.
TD_ZERO = """family = "td-zero"
[given]
trajectory = { states = ["rim", "cave"], actions = [], rewards = [1] }
values = { rim = 7, cave = 5 }
alpha = 0.1
gamma = 0.8
"""
# V₁(rim) = max(5 + 1/2 · (−2), −3 + 1/2 · (−1)) = 4; V₁(slope) = max(0, 2 + 1/2 · (−1)) = 3/2.
# Greedy for V₁: rim: drill, 5 + 1/2 · 3/2 against −3 + 1/2 · 4; slope: drive, 2 + 1/2 · 4 against 0.
SWEEP = """family = "value-iteration"
[given]
gamma = "1/2"
sweeps = 1
start = { rim = -1, slope = -2 }
[given.mdp]
transitions = [
  ["rim", "drill", "slope", 1, 5],
  ["rim", "drive", "rim", 1, -3],
  ["slope", "drill", "lander", 1, 0],
  ["slope", "drive", "rim", 1, 2],
]
terminal = ["lander"]
"""
# BᵀPB = 4 · (−4) = −16, so R − BᵀPB = 17; BᵀPA = 2 · (−4) · [2 −1] = [−16 8];
# L = −[−16 8]/17 = [16/17 −8/17].
GAIN = """family = "lqr-gain"
[given]
A = [[-1, 0], [2, -1]]
B = [[0], [2]]
R = [[1]]
P = [[-3, 0], [0, -4]]
"""
PROBLEMS = {"return.toml": RETURN, "td.toml": TD_ZERO, "sweep.toml": SWEEP, "gain.toml": GAIN}


def verify(paths: Sequence[Path]) -> Report:
    """Grade with the problem files that lie beside the answers."""
    return verify_with(paths, Settings(allow_files=True))


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name, content in PROBLEMS.items():
        (tmp_path / name).write_text(content)
    return tmp_path


def write(folder: Path, name: str, content: str | bytes) -> Path:
    path = folder / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


def rows(report: Report) -> list[MarkedPart]:
    assert not report.refused, report.refused
    return list(report.parts)


def judged(folder: Path, content: str) -> list[MarkedPart]:
    return rows(verify([write(folder, "answers.toml", content)]))


def says(folder: Path, name: str, content: str | bytes) -> tuple[str, int]:
    report = verify([write(folder, name, content)])
    (failure,) = report.refused
    assert report.exit_code == failure.exit_code
    assert "\n" not in failure.says
    return failure.says, failure.exit_code


@pytest.fixture(autouse=True)
def a_point_a_part(monkeypatch: pytest.MonkeyPatch) -> None:
    """What a part earns follows from its minutes, and is tested where these are; here it is one point."""
    monkeypatch.setattr("rldrill.exercise.points", lambda solution: {part.label: 1 for part in solution.problem.parts})


# --- verdicts ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("answers", "part", "verdict", "points"),
    [
        ('"return.toml" = {a = "1/4"}', "a", "right", 1),
        ('"return.toml" = {a = 0.25}', "a", "right", 1),
        ('"return.toml" = {a = "1/4", b = "3.125"}', "b", "right", 1),
        ('"return.toml" = {a = "1/4", b = 3.13}', "b", "right", 1),  # 3.125 rounded
        ('"return.toml" = {a = "1/4", b = 3.12}', "b", "right", 1),  # half a unit away, the bound included
        ('"return.toml" = {a = "1/4", b = 3.1}', "b", "close", 0),
        ('"return.toml" = {a = "1/4", b = 7}', "b", "wrong", 0),
        ('"return.toml" = {a = "1/8"}', "a", "misconception", 0),  # 1/2 · 1/4: the first reward discounted
        ('"return.toml" = {a = 10, b = 8}', "a", "wrong", 0),
        ('"return.toml" = {a = 10, b = 8}', "b", "follow-through", 1),  # 3 + 1/2 · 10
        ('"return.toml" = {b = 8}', "b", "wrong", 0),  # with nothing to go on from
        ('"return.toml" = {a = "1,5", b = 8}', "b", "wrong", 0),  # nor from what is unreadable
        ('"return.toml" = {a = "1,5", b = "25/8"}', "b", "right", 1),
        ('"return.toml" = {a = "1,5"}', "a", "unreadable", 0),
        ('"return.toml" = {a = "", b = "25/8"}', "a", "missing", 0),
        ('"return.toml" = {b = "25/8"}', "a", "missing", 0),
        ('"td.toml" = "34/5"', "a", "right", 1),
        ('"td.toml" = 6.80', "a", "right", 1),
        ('"td.toml" = {a = {rim = "34/5"}}', "a", "right", 1),
        ('"td.toml" = {a = "rim: 6.9"}', "a", "misconception", 0),
        ('"sweep.toml" = {a = {rim = 4, slope = "3/2"}}', "a", "right", 1),
        ('"sweep.toml" = {a = {slope = 1.5, rim = 4}}', "a", "right", 1),
        ('"sweep.toml" = {a = [4, 1.5]}', "a", "right", 1),
        ('"sweep.toml" = {a = [4, 2]}', "a", "wrong", Fraction(1, 2)),
        ('"sweep.toml" = {a = [4]}', "a", "unreadable", 0),
        ('"sweep.toml" = {a = {rim = 4}}', "a", "wrong", Fraction(1, 2)),
        ('"sweep.toml" = {a = {rim = 4, slope = "1,5"}}', "a", "unreadable", 0),
        ('"sweep.toml" = {a = "4, 1.5", b = "drill, drive"}', "b", "right", 1),
        ('"sweep.toml" = {a = "4, 1.5", b = ["drill", "drive"]}', "b", "right", 1),
        ('"sweep.toml" = {a = "4, 1.5", b = {rim = "drill", slope = "drive"}}', "b", "right", 1),
        # With V(rim) = −10: at rim 5 + 1/2 · 3/2 beats −3 − 5, and at slope 0 beats 2 + 1/2 · (−10).
        ('"sweep.toml" = {a = "-10, 1.5", b = "drill, drill"}', "b", "follow-through", 1),
        ('"sweep.toml" = {a = "4, 1.5", b = "drive, drill"}', "b", "misconception", 0),
        ('"gain.toml" = "[16/17, -8/17]"', "a", "right", 1),
        ('"gain.toml" = ["16/17", "-8/17"]', "a", "right", 1),
        ('"gain.toml" = {a = [["16/17", "-8/17"]]}', "a", "right", 1),
        ('"gain.toml" = [[0.941, -0.471]]', "a", "right", 1),
        ('"gain.toml" = [["16/17", "8/17"]]', "a", "wrong", Fraction(1, 2)),
        ('"gain.toml" = [["16/17, -8/17"]]', "a", "unreadable", 0),  # one entry is not read as two
    ],
)
def test_verdicts(folder: Path, answers: str, part: str, verdict: str, points: Fraction | int) -> None:
    (row,) = [row for row in judged(folder, answers) if row.part == part]
    assert (row.judged.verdict, row.score.points, row.score.of) == (verdict, points, 1)
    assert row.judged.accepted == (verdict in ("right", "follow-through"))


def test_every_verdict_has_its_reason(folder: Path) -> None:
    wrong, unreadable = judged(folder, '"sweep.toml" = {a = "4, 2", b = "dril, drive"}')
    assert "slope" in wrong.judged.reason
    assert wrong.judged.read == "rim: 4, slope: 2"
    assert "'dril' is not one of drill, drive" in unreadable.judged.reason
    assert unreadable.judged.read == ""
    assert unreadable.typed == "dril, drive"
    misconception, missing = judged(folder, '"return.toml" = {a = "1/8"}')
    assert "first reward" in misconception.judged.reason
    assert missing.judged.reason == "Not answered."


def test_a_later_student_does_not_go_on_from_an_earlier_ones_answer(folder: Path) -> None:
    path = write(folder, "a.csv", "student,problem,part,answer\nAnn,return.toml,a,10\nBen,return.toml,b,8\n")
    assert [(row.part, row.judged.verdict) for row in rows(verify([path]))] == [
        ("a", "wrong"),
        ("b", "missing"),
        ("a", "missing"),
        ("b", "wrong"),
    ]


def test_parts_are_judged_in_their_order_not_in_the_files(folder: Path) -> None:
    path = write(folder, "a.csv", "problem,part,answer\nreturn.toml,b,8\nreturn.toml,a,10\n")
    assert [(row.part, row.judged.verdict) for row in rows(verify([path]))] == [
        ("a", "wrong"),
        ("b", "follow-through"),
    ]


# --- formats ----------------------------------------------------------------------------------------------

SAME: dict[str, str | bytes] = {
    "a.toml": """student = "Ann"
["return.toml"]
a = "10"
b = 8
["td.toml"]
a = {rim = 6.8}
["sweep.toml"]
a = [4, 1.5]
""",
    "nested.toml": """student = "Ann"
answers."return.toml" = {a = "10", b = 8}
answers."td.toml" = {a = {rim = 6.8}}
[answers."sweep.toml"]
a = [4, 1.5]
""",
    "a.json": """{"student": "Ann", "return.toml": {"a": "10", "b": 8}, "td.toml": {"a": {"rim": 6.8}},
    "sweep.toml": {"a": [4, 1.5], "b": null}}""",
    "nested.json": """{"answers": {"return.toml": {"a": "10", "b": 8}, "td.toml": {"a": {"rim": 6.8}},
    "sweep.toml": {"a": [4, 1.5]}}, "student": "Ann"}""",
    "a.csv": """student,problem,part,answer
Ann,return.toml,a,10
Ann,return.toml,b,8
Ann,td.toml,a,rim: 6.8
Ann,sweep.toml,a,"[4, 1.5]"
Ann,sweep.toml,b,
""",
    "semicolons.csv": b"\xef\xbb\xbf"
    b'Answer;Part;Problem;Student;Time\r\n10;(a);return.toml;Ann;9:00\r\n"8";B;return.toml;Ann;\r\n'
    b";;;;\r\nrim: 6.8;;td.toml;Ann;\r\n[4, 1.5];a;sweep.toml;Ann;",
    "tabs.csv": "problem\tpart\tstudent\tanswer\nreturn.toml\ta\tAnn\t10\nreturn.toml\tb\tAnn\t8\n"
    "td.toml\t\tAnn\trim: 6.8\nsweep.toml\ta\tAnn\t[4, 1.5]\n",
    "a.jsonl": """{"student": "Ann", "problem": "return.toml", "part": "a", "answer": "10"}

{"student": "Ann", "problem": "return.toml", "part": "b", "answer": 8}
{"student": "Ann", "problem": "td.toml", "answer": {"rim": 6.8}}
{"student": "Ann", "problem": "sweep.toml", "part": "a", "answer": [4, 1.5]}""",
    "a.NDJSON": '{"student":"Ann","problem":"return.toml","part":"a","answer":10}\r\n'
    '{"student":"Ann","problem":"./return.toml","part":"b","answer":"8"}\r\n'
    '{"student":"Ann","problem":"td.toml","part":"a","answer":"rim: 6.8"}\r\n'
    '{"student":"Ann","problem":"sweep.toml","part":"a","answer":["4","1.5"]}\r\n',
}


SAME |= {
    "sep.csv": b"\xef\xbb\xbfsep=;\r\n STUDENT ; Problem ;Part;Answer;;\r\nAnn;return.toml;a;10;;\r\n"
    b'Ann;return.toml;b;8\r\nAnn;td.toml;;"rim: 6,8";;\r\nAnn;sweep.toml;a;"4; 1,5";;;\r\n',
    "excel.csv": 'Student Name,Problem ID,Part,Response\nAnn,return.toml,a,="10"\nAnn,return.toml,b,"=""8"""\n'
    'Ann,td.toml,,rim: 6.8\nAnn,sweep.toml,a,"4, 1.5"\n',
}


@pytest.mark.parametrize("name", SAME)
def test_every_format_gives_the_same_report(folder: Path, name: str) -> None:
    report = verify([write(folder, name, SAME[name])])
    assert [(row.problem, row.part, row.judged.read, row.judged.verdict) for row in rows(report)] == [
        ("return.toml", "a", "10", "wrong"),
        ("return.toml", "b", "8", "follow-through"),
        ("td.toml", "a", "rim: 6.8", "right"),
        ("sweep.toml", "a", "rim: 4, slope: 1.5", "right"),
        ("sweep.toml", "b", "", "missing"),
    ]
    (student,) = report.students
    assert student.student == "Ann"
    assert (report.score, report.exit_code) == (Score(Fraction(3), 5), 1)


def test_names_in_two_columns_are_one_name(folder: Path) -> None:
    head = '"Last name","First name",problem,part,answer\n'
    content = head + "Doe,Ann,td.toml,a,6.8\nRoe,Ann,td.toml,a,6.8\n,Ben,td.toml,a,6.8\n"
    report = verify([write(folder, "a.csv", content)])
    assert [student.student for student in report.students] == ["Ann Doe", "Ann Roe", "Ben"]


def test_a_name_in_two_normal_forms_is_one_student(folder: Path) -> None:
    path = write(folder, "a.csv", HEAD + "J\u00f6rg,return.toml,a,1/4\nJo\u0308rg,return.toml,b,25/8\n")
    (student,) = verify([path]).students
    assert [part.judged.verdict for part in student.parts] == ["right", "right"]


@pytest.mark.parametrize(
    ("content", "verdicts"),
    [
        # Semicolons part the columns and no answer has a point: the comma is a decimal comma where nothing else fits.
        (
            "A;td.toml;a;6,8\nB;sweep.toml;a;4 1,5\nC;sweep.toml;a;4,2\n",
            ["right", "right", "missing", "wrong", "missing"],
        ),
        ("A;td.toml;a;6,8\nB;td.toml;a;6.8\n", ["unreadable", "right"]),
        ("A;sweep.toml;a;rim: 4, slope: 1,5\n", ["right", "missing"]),
    ],
)
def test_decimal_commas_are_read_where_the_whole_file_allows_it(
    folder: Path, content: str, verdicts: list[str]
) -> None:
    report = verify([write(folder, "a.csv", "student;problem;part;answer\n" + content)])
    assert [row.judged.verdict for row in rows(report)] == verdicts


def test_what_was_typed_is_shown_as_it_was_typed(folder: Path) -> None:
    (row,) = rows(verify([write(folder, "a.csv", "problem;answer\ntd.toml;6,8\n")]))
    assert (row.typed, row.judged.read) == ("6,8", "rim: 6.8")


def test_tied_actions_may_be_a_list(folder: Path) -> None:
    first, second = judged(folder, '"sweep.toml" = {a = [4, 1.5], b = {rim = ["drill", "drive"], slope = ["drive"]}}')
    assert (first.judged.verdict, second.judged.verdict, second.judged.read) == (
        "right",
        "wrong",
        "rim: drill or drive, slope: drive",
    )


def test_lines_are_kept(folder: Path) -> None:
    csv = write(folder, "a.csv", 'problem,part,answer\nreturn.toml,a,"1/4\n"\n\nreturn.toml,b,3\n')
    assert [entry.line for entry in read_answers(csv).entries] == [2, 5]
    lines = write(folder, "a.jsonl", '\n{"problem": "td.toml", "answer": 1}\n')
    assert [entry.line for entry in read_answers(lines).entries] == [2]


def test_yes_and_no_may_be_truth_values_and_students_numbers(folder: Path) -> None:
    path = write(folder, "a.json", '{"student": 123, "x.toml": [true, false]}')
    assert [(entry.student, entry.text) for entry in read_answers(path).entries] == [("123", "[true, false]")]
    path = write(folder, "b.json", '{"x.toml": {"a": {"cool": {"fast": 1, "slow": 0.50}, "warm": -1}, "b": []}}')
    assert [entry.text for entry in read_answers(path).entries] == [
        "(cool, fast): 1, (cool, slow): 0.50, warm: -1",
        "",
    ]


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.toml", 'name = "Ann"\n"Student ID" = 7\n"td.toml" = 1'),
        ("a.toml", 'student = "Ann"\nname = "Exam of spring"\nnumber = "7"\n"td.toml" = 1'),
        ("a.jsonl", '{"name": "Exam of spring", "student": "Ann", "sid": 7, "problem": "td.toml", "answer": 1}'),
        ("a.toml", 'student = "Ann"\nnumber = "7"\n[answers]\n"td.toml" = 1'),
        ("a.json", '{"Name": "Ann", "Matrikelnummer": 7, "answers": {"td.toml": 1}}'),
        ("a.jsonl", '{"Student name": "Ann", "sid": 7, "Problem ID": "td.toml", "response": 1}'),
        ("a.csv", "Name;Matrikelnummer;Aufgabe;Antwort\nAnn;7;td.toml;1\n"),
    ],
)
def test_fields_have_the_names_that_columns_may_have(folder: Path, name: str, content: str) -> None:
    (entry,) = read_answers(write(folder, name, content)).entries
    assert (entry.student, entry.number, entry.problem, entry.text) == ("Ann", "7", "td.toml", "1")


def test_an_id_may_be_typed_with_or_without_its_revision(folder: Path) -> None:
    (row,) = judged(folder, f'"{NOW}" = {{a = "1"}}')
    assert row.problem == NOW
    assert judged(folder, '"td-zero/1/62590" = {a = "1"}')[0].problem == NOW


# --- faults -----------------------------------------------------------------------------------------------

HEAD = "student,problem,part,answer\n"
#: An ID with the revision of this release.
NOW = f"td-zero/1/62590@{family('td-zero').revision}"
FAULTY = [
    ("a.toml", 'td-zero/1/62590 = "1"', "Problem IDs stand in quotes"),
    ("a.toml", '[td-zero/1/62590]\na = "1"', "Problem IDs stand in quotes"),
    ("a.toml", 'colour = "red"', "'colour' is neither a problem ID"),
    ("a.toml", 'colour = "red"\n[answers]\n"td.toml" = 1', "'colour' stands outside 'answers'"),
    ("a.toml", 'answers = 3', "'answers' must be a table"),
    ("a.toml", 'student = ["Ann"]\n"td.toml" = 1', "'student' must be a text"),
    ("a.toml", '"td.toml" = 2024-01-01', "is neither a text nor a number"),
    ("a.toml", '"td.toml" = {a = [[["1"]]]}', "nests too deeply"),
    ("a.toml", '"td.toml" = {b = 1}', "there is no part 'b'; td.toml has a."),
    ("a.toml", '"return.toml" = 1', "the part is missing; return.toml has a, b."),
    ("a.toml", '"return.toml" = {a = 1, A = 2}', "return.toml (a) is answered twice"),
    ("a.toml", f'"td-zero/1/62590" = "1"\n"{NOW}" = "2"', f"{NOW} (a) is answered twice"),
    ("a.toml", '"td-zero/1/62590@99" = "1"', "is of revision 99"),
    ("a.toml", '"td-zeri/1/7" = "1"', "There is no family 'td-zeri'"),
    ("a.toml", '"none.toml" = "1"', "none.toml: there is no such file"),
    ("a.toml", '"broken.toml" = "1"', "broken.toml, line 1"),
    ("a.toml", '"inconsistent.toml" = "1"', "inconsistent.toml: given.gamma"),
    ("a.json", "[1]", "a file of answers is a table"),
    ("a.json", '{"td.toml": 1, "td.toml": 2}', "stands twice"),
    ("a.json", '{"td\\u0000.toml": 1}', "cannot be printed"),
    ("a.csv", "student,problem,part\nAnn,td.toml,a\n", "line 1: the column 'answer' is missing"),
    ("a.csv", "Ann,td.toml,a,1\n", "line 1: the column 'problem' is missing"),
    ("a.csv", "sep=;\nproblem;part\n", "line 2: the column 'answer' is missing"),
    ("a.csv", "sep=;\nproblem;answer\ntd.toml;1;2\n", "line 3: 3 fields where"),
    ("a.csv", "sep=\r\nproblem,answer\r\n", "line 1: the column 'problem' is missing"),
    ("a.csv", 'sep="\nproblem,answer\n', "line 1: the column 'problem' is missing"),
    ("a.csv", "problem,answer,answer\ntd.toml,1,2\n", "the column 'answer' stands twice"),
    ("a.csv", HEAD + "Ann,td.toml,a,1\nAnn,sweep.toml,a,4, 1.5\n", "line 3: 5 fields where"),
    ("a.csv", HEAD + "Ann,td.toml,1\n", "line 2: 3 fields where"),
    ("a.csv", HEAD + 'Ann,td.toml,a,"1\n\n', "line 2: its quotes are broken"),
    ("a.csv", HEAD + "A,td.toml,a,1\nB,td.toml,a,1\nA,td.toml,,2\n", "line 4: td.toml (a) is answered twice"),
    ("a.csv", HEAD + "A,td.toml,a,1\nB,td.toml,a,1\nA,td.toml,,2\n", "twice by A (first in line 2)"),
    ("a.csv", HEAD + "Ann,td.toml,a,1\nAnn,td.toml,c,1\n", "line 3: there is no part 'c'"),
    ("a.csv", HEAD + "Ann,return.toml,,1\n", "line 2: the part is missing"),
    ("a.csv", HEAD + "Ann,,a,1\n", "line 2: '' is neither a problem ID"),
    ("a.csv", HEAD + "Ann,td-zero/4/7,a,1\n", "line 2: 'td-zero/4/7' is neither a problem ID"),
    ("a.csv", HEAD + "Ann,td-zero/1/62590@98,a,1\n", "line 2: td-zero/1/62590@98 is of revision 98"),
    ("a.csv", HEAD + "Ann,none.json,a,1\n", "line 2: "),
    ("a.csv", HEAD + "\x1b[31mAnn,td.toml,a,1\n", "'student' holds a character that cannot be printed"),
    ("a.jsonl", '{"problem": "td.toml", "answer": 1}\n{"problem": \n', "line 2, column"),
    ("a.jsonl", '{"problem": "td.toml", "answer": 1}\n[]\n', "line 2: a line is an object"),
    ("a.jsonl", '{"problem": "td.toml"}', "line 1: the field 'answer' is missing"),
    ("a.jsonl", '{"name": "Ann", "full name": "A", "problem": "td.toml", "answer": 1}', "'name' and 'full name' stand"),
    ("a.jsonl", '{"id": "td.toml", "question": "What?", "answer": 1}', "'id' and 'question' stand for the problem;"),
    ("a.toml", 'name = "Ann"\n"Full name" = "A"\n"td.toml" = 1', "'name' and 'Full name' stand for the student"),
    ("a.csv", HEAD + "Ann,2a,b,1\n", "line 2: '2a' and the part 'b' stand there; keep one of them"),
    ("a.jsonl", '{"problem": 1.5, "answer": 1}', "'1.5' is neither a problem ID"),
    ("a.jsonl", '{"problem": "td.toml", "answer": 1, "answer": 2}', "line 1: the key 'answer' stands twice"),
    ("a.txt", "1", "must end in .toml, .json, .csv, .jsonl or .ndjson"),
]  # fmt: skip


@pytest.mark.parametrize("answers", [",5", "5,", "5, ", " ,5,"])
@pytest.mark.parametrize("repeated", ["", "first", "last"])
def test_a_blank_answer_takes_no_place(folder: Path, answers: str, repeated: str) -> None:
    lines = "".join(f"A,td.toml,a,{answer}\n" for answer in answers.split(","))
    path = write(folder, "a.csv", HEAD + lines)
    report = verify_with([path], Settings(allow_files=True, rules=Rules(repeated=repeated)))
    assert [each.typed for each in rows(report)] == ["5"]


@pytest.mark.parametrize(("name", "content", "fragment"), FAULTY)
def test_a_faulty_file_is_one_sentence(folder: Path, name: str, content: str, fragment: str) -> None:
    write(folder, "broken.toml", "family = \n")
    write(folder, "inconsistent.toml", RETURN.replace('"1/2"', "2"))
    sentence, code = says(folder, name, content)
    assert sentence.startswith(str(folder / name))
    assert fragment in sentence
    assert code == 3


def test_quotes_are_asked_for_only_where_ids_stand_without(folder: Path) -> None:
    sentence, _ = says(folder, "a.json", '{td-zero/1/62590: "1"}')
    assert "stand in quotes: [" not in sentence


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.toml", ""),
        ("a.toml", "# nothing yet\n"),
        ("a.toml", 'student = "Ann"\n[answers]\n'),
        ("a.toml", '"td.toml" = {a = " "}'),
        ("a.json", "\n"),
        ("a.json", '{"answers": {}}'),
        ("a.json", '{"td.toml": null}'),
        ("a.csv", b"\xef\xbb\xbf"),
        ("a.csv", HEAD),
        ("a.csv", HEAD + ",td.toml,a,\n"),
        ("a.jsonl", "\n\n"),
    ],
)
def test_a_file_without_answers_has_nothing_to_grade(folder: Path, name: str, content: str | bytes) -> None:
    sentence, code = says(folder, name, content)
    assert "there are no answers in it" in sentence
    assert code == 4
    with pytest.raises(NothingToGrade):
        read_answers(folder / name)


def test_a_bad_row_costs_only_itself(folder: Path) -> None:
    lines = [
        "Ann,td.toml,a,6.8",
        "Ben,td-zeri/1/7,a,1",  # no such family
        "Cem,td.toml,x,1",  # no such part
        "Dot,td.toml,a,6.8",
        "Dot,td.toml,a,7",  # twice: the first counts
        'Eva,td.toml,a,"6.8',  # a quote that is never closed
        "Fay,td.toml,a,6.8,9",  # a field too many
        "\x07,td.toml,a,6.8",
        "Gus,td.toml,a,6.8",
    ]
    report = verify([write(folder, "a.csv", HEAD + "\n".join(lines) + "\n")])
    assert {student.student: student.score for student in report.students} == {
        "Ann": Score(Fraction(1), 1), "Cem": Score(Fraction(0), 1), "Dot": Score(Fraction(1), 1),
        "Gus": Score(Fraction(1), 1),
    }  # fmt: skip
    assert sorted(refusal.line or 0 for refusal in report.refused) == [3, 4, 6, 7, 8, 9]
    assert report.exit_code == 3
    strict = verify_with([folder / "a.csv"], Settings(allow_files=True, strict=True))
    assert (strict.students, strict.exit_code) == ((), 3)


def test_a_bad_answer_in_a_table_costs_only_itself(folder: Path) -> None:
    content = 'student = "Ann"\n"td.toml" = 6.8\n"nonsense" = 1\n"return.toml" = {a = "1/4", b = 2024-01-01}\n'
    report = verify([write(folder, "a.toml", content)])
    assert [part.judged.verdict for part in report.parts] == ["right", "right", "missing"]
    assert len(report.refused) == 2


def test_files_that_answers_name_are_opened_only_with_leave_and_only_beside_them(folder: Path) -> None:
    inner = folder / "inner"
    inner.mkdir()
    (inner / "link.toml").symlink_to(folder / "td.toml")
    for name in ("../td.toml", str(folder / "td.toml"), "link.toml"):
        sentence, code = says(inner, "a.csv", f"problem,part,answer\n{name},a,6.8\n")
        assert "not in the folder of the answers" in sentence
        assert code == 3
    (refusal,) = verify_with([write(folder, "a.csv", "problem,part,answer\ntd.toml,a,6.8\n")]).refused
    assert "names a problem file; --allow-files opens those that lie beside the answers." in refusal.says


@pytest.mark.parametrize("state", ["market", "may", "decoy"])
def test_words_that_begin_as_a_month_does_are_no_dates(folder: Path, state: str) -> None:
    # V₁ = max(5 + 1/2 · 0, 1 + 1/2 · 0) = 5.
    write(folder, "own.toml", f"""family = "value-iteration"
[given]
gamma = "1/2"
sweeps = 1
start = {{ {state} = 0 }}
[given.mdp]
transitions = [["{state}", "sell", "end", 1, 5], ["{state}", "keep", "{state}", 1, 1]]
terminal = ["end"]
""")  # fmt: skip
    sheet = write(folder, "a.csv", f"problem,part,answer\nown.toml,a,{state} 5\n")
    assert verify([sheet]).parts[0].judged.verdict == "right"


@pytest.mark.parametrize(
    "typed", ["3-Apr", "03. Apr", "Mar-04", "4 March", "12-Dez-2024", "2024-04-03", "1. Mai", "04. Mrz"]
)
def test_dates_are_told(folder: Path, typed: str) -> None:
    sheet = write(folder, "a.csv", f"problem,part,answer\nreturn.toml,a,{typed}\n")
    assert "is a date" in verify([sheet]).parts[0].judged.reason


def test_a_path_that_cannot_be_looked_at_does_not_stop_the_others(folder: Path) -> None:
    good = write(folder, "good.toml", '["td.toml"]\na = "6.8"\n')
    report = verify([good, folder / f"{'a' * 300}.csv"])
    assert [part.judged.verdict for part in report.parts] == ["right"]
    assert report.exit_code == 3


def test_one_bad_file_does_not_stop_the_others(folder: Path) -> None:
    right = write(folder, "right.toml", '"td.toml" = 6.8')
    wrong = write(folder, "wrong.toml", '"td.toml" = 7')
    empty = write(folder, "empty.toml", "")
    none = folder / "none.toml"
    assert verify([right]).exit_code == 0
    assert verify([right, wrong]).exit_code == 1
    assert verify([empty, none, right]).exit_code == 3
    assert verify([right, empty]).exit_code == 1
    assert verify([empty, empty]).exit_code == 4
    assert verify([]).exit_code == 4
    report = verify([none, right, wrong])
    assert [Path(student.paths[0]).name for student in report.students] == ["right.toml", "wrong.toml"]
    assert report.score == Score(Fraction(1), 2)


@settings(max_examples=100, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(
    content=st.binary(max_size=120)
    | st.text(st.sampled_from('[]{}",:;=\n \t\\ua1td.oml/-zero#student'), max_size=80).map(str.encode),
    head=st.sampled_from(
        [b"", b'"td.toml" = ', b'{"td.toml": ', b"problem,answer\n", b'{"problem": "td.toml", "answer": ']
    ),
)
@pytest.mark.parametrize("suffix", ["toml", "json", "csv", "jsonl", "ndjson", "txt"])
def test_any_bytes_are_judged_or_refused(folder: Path, suffix: str, head: bytes, content: bytes) -> None:
    path = write(folder, f"any.{suffix}", head + content)
    with contextlib.suppress(FileError, NothingToGrade):
        read_answers(path)
    assert verify([path]).exit_code in (0, 1, 3, 4)


# --- the command ------------------------------------------------------------------------------------------

app = typer.Typer()
app.command(verify_command.NAME)(verify_command.command)


def run(*arguments: object) -> tuple[int, str, str]:
    chosen = [str(argument) for argument in arguments]
    result = CliRunner().invoke(app, ["--allow-files", *chosen], env={"COLUMNS": "140"})
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result.exit_code, result.stdout, result.stderr


def test_the_table_says_what_is_wrong_in_words(folder: Path) -> None:
    path = write(folder, "[red].toml", '["return.toml"]\na = "1/8"\nb = "1,5"\n["td.toml"]\na = 6.8\n')
    code, out, err = run(path)
    assert code == 1
    assert err == ""
    for word in (
        "misconception",
        "unreadable",
        "right",
        "decimal comma",
        "[red].toml",
        "Score: 1 of 3 (33.3 %)",
    ):
        assert word in out
    assert "25/8" not in out
    assert "25/8" in run(path, "--show-key")[1]


@pytest.mark.parametrize(
    ("enough", "code"), [("33%", 0), ("34%", 1), ("0.33", 0), ("0.34", 1), ("1/3", 0), ("100 %", 1), ("0", 0)]
)
def test_a_share_of_the_points_is_enough(folder: Path, enough: str, code: int) -> None:
    path = write(folder, "third.toml", '["return.toml"]\na = "1/4"\nb = "1"\n["td.toml"]\na = 1\n')  # one of three
    assert run(path, "--pass", enough)[0] == code


@pytest.mark.parametrize("enough", ["half", "101%", "1/0", "-1%", "1.01", "1e999999999", "1e-999999999", "nan", "%"])
def test_what_is_no_share_of_the_points_is_refused(folder: Path, enough: str) -> None:
    with pytest.raises(UsageError, match="no share of the points"):
        CliRunner().invoke(app, ["--pass", enough, str(folder / "td.toml")], catch_exceptions=False)


def test_no_report_takes_the_place_of_what_is_read_or_of_another(folder: Path) -> None:
    path = write(folder, "a.csv", "problem,part,answer\ntd.toml,a,1\n")
    for reports, sentence in (
        ([f"json={folder / '.' / 'a.csv'}"], "is read here"),
        (["text=both", "json=both"], "Two reports"),
        ([f"text={folder / 'b-totals.csv'}", f"csv={folder / 'b.csv'}"], "Two reports"),
        (["csv=/"], "is no report"),
    ):
        with pytest.raises(UsageError, match=sentence):
            verify_command.command([path], reports=reports)
    assert path.read_text(encoding="utf-8").startswith("problem,part")


def test_a_report_that_cannot_be_written_does_not_keep_others_from_it(folder: Path) -> None:
    path = write(folder, "a.csv", "problem,part,answer\ntd.toml,a,6.8\n")
    with pytest.raises(FileError, match="is a directory"):
        verify_command.command(
            [path], reports=[f"text={folder}", f"json={folder / 'report.json'}"], allow_files=True, feedback="none"
        )
    assert json.loads((folder / "report.json").read_text())["exit_code"] == 0


def test_a_report_that_cannot_be_written_leaves_the_one_before(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = write(folder, "a.csv", "problem,part,answer\ntd.toml,a,6.8\n")
    before = write(folder, "report.json", "{}")

    def is_full(_handle: int) -> None:
        raise OSError(errno.ENOSPC, "no space left on device")

    monkeypatch.setattr("os.fsync", is_full)
    with pytest.raises(FileError, match=r"report\.json: it cannot be written"):
        verify_command.command([path], reports=[f"json={before}"], allow_files=True, feedback="none")
    assert before.read_text() == "{}"


@pytest.mark.parametrize(("names", "told"), [(("Ann", "Ben"), True), (("Ann", "Ann"), False)])
def test_who_reports_many_to_gradescope_is_told_that_it_is_one_submission(
    folder: Path, names: tuple[str, str], told: bool
) -> None:
    first, second = names
    rows = f"{first},td.toml,a,6.8\n{second},return.toml,a,10\n"
    path = write(folder, "a.csv", f"student,problem,part,answer\n{rows}")
    _, _, said = run(path, "--report", f"gradescope={folder / 'results.json'}")
    assert ("2 students stand in these files" in said) is told


@pytest.mark.parametrize("columns", ["40", "60", "80"])
def test_narrow_terminals_fold_and_do_not_cut(folder: Path, columns: str) -> None:
    path = write(folder, "a.toml", '"td.toml" = 6.9')  # γ forgotten
    (row,) = rows(verify([path]))
    result = CliRunner().invoke(app, [str(path), "--allow-files"], env={"COLUMNS": columns})
    told = result.stdout.split()
    assert "…" not in result.stdout
    for text in (row.problem, row.judged.verdict, row.judged.reason):
        assert not Counter(text.split()) - Counter(word.rstrip(",") for word in told), "no word is cut or broken"


def test_students_are_told_apart(folder: Path) -> None:
    path = write(folder, "a.csv", HEAD + "Ann,td.toml,a,6.8\nBen [b],td.toml,a,7\n,td.toml,a,6.8\n")
    code, out, _ = run(path)
    assert code == 1
    for words in ("a.csv: Ann", "a.csv: Ben [b]", "a.csv: no name", "All together: 2 of 3 (66.7 %)"):
        assert words in out.replace("\n", "")


def test_json_is_versioned_and_keeps_the_key_to_itself(folder: Path) -> None:
    path = write(folder, "a.csv", HEAD + 'Ann,sweep.toml,a,"4, 7.3"\n')
    code, out, _ = run(path, "--json")
    data = json.loads(out)
    assert code == data["exit_code"] == 1
    assert data["format"] == 2
    assert data["points"] == {"exact": "1/2", "decimal": "0.5", "of": 2}
    (student,) = data["students"]
    assert student["student"] == "Ann"
    first, second = student["answers"]
    assert first == {
        "problem": "sweep.toml",
        "part": "a",
        "slot": None,
        "file": str(path),
        "line": 2,
        "column": 4,
        "typed": "4, 7.3",
        "read": "rim: 4, slope: 7.3",
        "verdict": "wrong",
        "accepted": False,
        "reason": "Not right at slope; the rest is right.",
        "points": {"exact": "1/2", "decimal": "0.5", "of": 1},
        "diagnosis": None,
    }
    assert (second["verdict"], second["line"]) == ("missing", None)
    assert json.loads(run(path, "--json", "--show-key")[1])["students"][0]["answers"][0]["key"] == (
        "rim: 4, slope: 3/2"
    )


def test_json_says_what_a_wrong_answer_comes_from(folder: Path) -> None:
    # The key is rim: 4, slope: 3/2.
    path = write(folder, "a.csv", HEAD + 'Ann,sweep.toml,a,"4, 7.3"\nBen,sweep.toml,a,"3/2, 4"\n')
    students = json.loads(run(path, "--json")[1])["students"]
    assert students[0]["answers"][0]["diagnosis"] is None
    diagnosis = students[1]["answers"][0]["diagnosis"]
    assert diagnosis["kind"] == "exchanged-cells"
    assert diagnosis["sentence"] == "It looks as if the answers for rim and slope are exchanged."


def test_sentences_go_to_stderr_and_data_to_stdout(folder: Path) -> None:
    right = write(folder, "right.toml", '"td.toml" = 6.8')
    code, out, err = run(folder / "none.toml", right, "--json")
    assert code == 3
    assert err == f"rldrill: {folder / 'none.toml'}: there is no such file; check its name and folder.\n"
    data = json.loads(out)
    assert [failure["exit_code"] for failure in data["refused"]] == [3]
    assert data["points"]["of"] == 1
    assert run(write(folder, "empty.csv", ""))[0] == 4


def test_the_whole_program_in_a_pipe_has_no_colours(folder: Path) -> None:
    path = write(folder, "right.toml", '"td.toml" = 6.8')
    command = [sys.executable, "-m", "rldrill", "verify", "--allow-files", str(path)]
    done = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "Score: 1 of 1 (100 %)" in done.stdout
    assert "\x1b" not in done.stdout


# --- the examples -----------------------------------------------------------------------------------------


def test_the_examples_say_what_their_comments_say() -> None:
    assert [
        (row.problem.split("@")[0], row.part, row.judged.verdict) for row in rows(verify([EXAMPLES / "answers.toml"]))
    ] == [
        ("td-zero/1/62590", "a", "right"),
        ("return/1/2166", "a", "misconception"),
        ("return/1/2166", "b", "follow-through"),
        ("n-step-return/2/269", "a", "unreadable"),
        ("n-step-return/2/269", "b", "right"),
        ("bayes-rule/1/43", "a", "right"),
        ("return/2/4333", "a", "wrong"),
        ("return/2/4333", "b", "right"),
    ]
    verdicts = [row.judged.verdict for row in rows(verify([EXAMPLES / "answers.csv"]))]
    assert verdicts == ["right"] * 3 + ["unreadable", "wrong", "missing", "right"]


def test_what_a_program_wrote_in_a_problem_file_is_told_once(folder: Path) -> None:
    thirds = {"prior": dict.fromkeys("abc", 0.3333333333333333), "measurements": ["hit"]}
    thirds |= {"likelihood": {"hit": dict.fromkeys("abc", "1/2"), "miss": dict.fromkeys("abc", "1/2")}}
    (folder / "thirds.json").write_text(json.dumps({"family": "bayes-rule", "given": thirds}))
    # Whatever is seen tells nothing, so that the prior is kept: 1/3 each.
    lines = "".join(f"{student},thirds.json,a,a: 1/3 b: 1/3 c: 1/3\n" for student in ("Ann", "Bob"))
    path = write(folder, "a.csv", HEAD + lines)
    name = str(folder / "thirds.json")
    code, _, told = run(path)
    assert (code, told) == (0, f"rldrill: {name}: read 0.3333333333333333 as 1/3\n")
    data = json.loads(run(path, "--json")[1])
    assert data["notes"] == {name: ["read 0.3333333333333333 as 1/3"]}
    assert "notes" not in str(data["students"])


@pytest.mark.parametrize(("lines", "more"), [(50, None), (51, "and 1 more"), (53, "and 3 more")])
def test_fifty_refusals_are_told_and_how_many_more_there_are(tmp_path: Path, lines: int, more: str | None) -> None:
    path = tmp_path / "answers.jsonl"
    row = '{{"problem": "no-family-{}/1/7", "part": "a", "answer": "1"}}\n'
    path.write_text("".join(map(row.format, range(lines))))
    _, _, told = run(path)
    sentences = [line for line in told.splitlines() if "no-family" in line]
    assert len(sentences) == 50
    assert [line for line in told.splitlines() if " more; " in line] == (
        [f"rldrill: {more}; --report json=FILE holds all of them."] if more else []
    )
