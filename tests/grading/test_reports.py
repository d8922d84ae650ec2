"""Every report is what the program that reads it expects, judged by tools that are not ours."""

import csv
import io
import json
import re
from fractions import Fraction
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import jsonschema
import pytest
import xmlschema
from junitparser import JUnitXml
from msgspec.structs import replace
from typer.testing import CliRunner

from rldrill.cli import app
from rldrill.exam.blueprint import Blueprint
from rldrill.exam.blueprint import Entry as Asked
from rldrill.exam.manifest import manifest, written
from rldrill.exam.planning import plan
from rldrill.grading.assignment import Assignment
from rldrill.grading.marking import Rules
from rldrill.grading.report import FEEDBACK, Report, Score
from rldrill.grading.reports import data, github, gradescope, junit, page, tables
from rldrill.grading.reports import text as text_report
from rldrill.grading.verification import Settings, verify

#: Ann is right, Ben misread the decimal comma, the third one tries what can be tried.
EVIL = "=cmd|' /C calc'!A0"
ROWS = [
    ("student", "problem", "part", "answer"),
    ("Ann", "td-zero/1/62590", "a", "21/4"),
    ("Ben", "td-zero/1/62590", "a", "worn: 5,25"),
    ("Ben", "return/1/2166", "a", "2/3"),
    (EVIL, "return/1/2166", "a", "<script>alert(1)</script>"),
    (EVIL, "return/1/2166", "b", "=1+1\n::error::mine"),
    ("Cem", "td-zero/9/7", "a", "1"),
]
#: The schema by which Jenkins reads it.
JUNIT = Path(__file__).parent / "schemas" / "junit-10.xsd"
#: https://gradescope-autograders.readthedocs.io/en/latest/specs/
GRADESCOPE = {
    "type": "object",
    "additionalProperties": False,
    "properties": {
        "score": {"type": "number"}, "execution_time": {"type": "number"}, "output": {"type": "string"},
        "output_format": {"enum": ["text", "html", "simple_format", "md", "ansi"]},
        "test_output_format": {"enum": ["text", "html", "simple_format", "md", "ansi"]},
        "visibility": {"enum": ["hidden", "after_due_date", "after_published", "visible"]},
        "stdout_visibility": {"enum": ["hidden", "after_due_date", "after_published", "visible"]},
        "extra_data": {"type": "object"},
        "leaderboard": {"type": "array"},
        "tests": {
            "type": "array",
            "items": {
                "type": "object",
                "additionalProperties": False,
                "properties": {
                    "score": {"type": "number"}, "max_score": {"type": "number"},
                    "status": {"enum": ["passed", "failed"]},
                    "name": {"type": "string"}, "number": {"type": "string"}, "output": {"type": "string"},
                    "output_format": {"const": "text"}, "tags": {"type": "array"},
                    "extra_data": {"type": "object"},
                    "visibility": {"enum": ["hidden", "after_due_date", "after_published", "visible"]},
                },
            },
        },
    },
}  # fmt: skip
#: The example in Gradescope's own specification, without its comments.
DOCUMENTED = {
    "score": 44.0, "execution_time": 136, "output": "Text relevant to the entire submission",
    "visibility": "after_due_date", "stdout_visibility": "visible", "extra_data": {},
    "tests": [
        {
            "score": 2.0, "max_score": 2.0, "name": "Your name here", "number": "1.1", "output": "Giant string",
            "tags": ["tag1", "tag2", "tag3"], "visibility": "visible", "extra_data": {},
        }
    ],
    "leaderboard": [{"name": "Accuracy", "value": 0.926}, {"name": "Time", "value": 15.1, "order": "asc"}],
}  # fmt: skip


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Report:
    path = tmp_path_factory.mktemp("a") / "answers.csv"
    with path.open("w", newline="") as file:
        csv.writer(file).writerows(ROWS)
    return verify([path], Settings(rules=Rules(keys=True)))


@pytest.mark.parametrize("feedback", FEEDBACK)
def test_the_json_fits_the_schema_that_is_printed(report: Report, feedback: str) -> None:
    schema = json.loads(CliRunner().invoke(app, ["verify", "--schema"]).stdout)
    jsonschema.Draft202012Validator.check_schema(schema)
    text = data.written(report, feedback)
    jsonschema.validate(json.loads(text), schema)
    assert json.loads(text) == report.to_json(feedback)
    assert text == json.dumps(json.loads(text), ensure_ascii=False, indent=2) + "\n"


@pytest.mark.parametrize("feedback", FEEDBACK)
def test_the_junit_report_fits_its_schema_and_is_read_by_others(report: Report, feedback: str) -> None:
    text = junit.written(report, feedback)
    xmlschema.XMLSchema(JUNIT).validate(ElementTree.fromstring(text))
    read = JUnitXml.fromstring(text.encode())
    # Ann's part, Ben's three, the third one's two, and the row that is no problem.
    assert (read.tests, read.errors) == (1 + 3 + 2 + 1, 1)
    # Ben's comma, his mistake, what he left out, and whatever the third one typed.
    assert read.failures == (0 if feedback == "none" else 5)


@pytest.mark.parametrize("feedback", FEEDBACK)
def test_the_gradescope_results_fit_their_specification(report: Report, feedback: str) -> None:
    jsonschema.validate(DOCUMENTED, GRADESCOPE)
    results = json.loads(gradescope.written(report, feedback))
    jsonschema.validate(results, GRADESCOPE)
    assert bool(results["tests"]) == (feedback != "none")


def test_the_same_under_two_names_earns_no_more_in_one_submission(tmp_path: Path) -> None:
    for number, (name, answer) in enumerate([("Ann", "9"), ("Anna", "21/4"), ("A.", "21/4")]):
        (tmp_path / f"{number}.csv").write_text(f"student,problem,part,answer\n{name},td-zero/1/62590,a,{answer}\n")
    report = verify(sorted(tmp_path.iterdir()))
    assert [float(student.score.points) for student in report.students] == [0, 1, 1]
    results = json.loads(gradescope.written(report, "reason"))
    assert (results["score"], results["extra_data"]["of"], len(results["tests"])) == (0, 1, 1)
    assert results["output"] == "td-zero/1/62590@4 (a) is answered more than once; the first answer counts."


def test_what_is_in_several_files_of_a_submission_counts_together(tmp_path: Path) -> None:
    (tmp_path / "1.toml").write_text('"1" = "21/4"\n')
    (tmp_path / "2.toml").write_text('["2"]\na = "10"\n')
    blueprint = Blueprint(problems=(Asked(id="td-zero/1/62590"), Asked(id="return/1/2166")), seed=7)
    (tmp_path / "exam.json").write_bytes(written(manifest(plan(blueprint))))
    answers = sorted(tmp_path.glob("*.toml"))
    results = json.loads(
        gradescope.written(verify(answers, Settings(assignment=Assignment(tmp_path / "exam.json"))), "reason")
    )
    assert [(test["name"], test["score"]) for test in results["tests"]][:2] == [
        ("problem 1 (a)", 1),
        ("problem 2 (a)", 0),
    ]
    assert (results["score"], results["extra_data"]["of"], results["output"]) == (1, 3, "")


def test_annotations_are_ten_at_most_and_begin_no_commands_of_their_own(report: Report) -> None:
    lines = github.written(report, "reason").splitlines()
    assert len(lines) <= 10
    for line in lines:
        assert re.fullmatch(r"::(error|notice) (file=[^:,]*,)?(line=\d+,)?title=[^:,]*::[^\r\n]*", line), line
    assert any("line=8," in line and "neither a problem ID" in line for line in lines)
    table = github.summary(report, "reason")
    assert "<script" not in table
    assert table.count("\n| ") == 1 + len(report.students) + 1 + len(report.parts)


@pytest.mark.parametrize(("found", "more"), [(10, 0), (11, 2), (30, 21)])
def test_of_more_than_ten_annotations_the_last_tells_how_many_are_left_out(
    report: Report, found: int, more: int
) -> None:
    ours = replace(report, students=(), refused=report.refused[:1] * found)
    *_, last = lines = github.written(ours, "reason").splitlines()
    assert len(lines) == 10
    assert (f"{more} more are in the summary" in last) == bool(more)


def test_a_share_that_is_not_enough_is_never_shown_as_if_it_were() -> None:
    shares = {
        Fraction(1, 3): "33.3",
        Fraction(5997, 10000): "59.97",
        Fraction(1): "100",
        Fraction(999999, 10**6): "99.9999",
    }
    assert {share: Score(60 * share, 60).percent() for share in shares} == shares
    assert Score(Fraction(0), 0).percent() == "0"


def test_no_cell_of_a_table_is_a_formula(report: Report) -> None:
    for text in (tables.written(report, "key"), tables.totals(report)):
        for row in csv.reader(io.StringIO(text)):
            for cell in row:
                assert not cell.startswith(("=", "+", "@", "\t")), cell
                assert not cell.startswith("-") or re.fullmatch(r"-[0-9.]+", cell)
    totals = list(csv.DictReader(io.StringIO(tables.totals(report))))
    assert (totals[0]["student"], totals[0]["points"], totals[0]["of"]) == ("Ann", "1", "1")


class _Tags(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []
        self.open: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append(tag)
        for name, value in attrs:
            assert not name.startswith("on")
            assert name not in ("src", "href"), value
        if tag not in ("meta", "rect"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if tag != "rect":
            assert self.open.pop() == tag


def test_the_page_stands_alone_and_runs_nothing(report: Report) -> None:
    text = page.written(report, "reason")
    tags = _Tags()
    tags.feed(text)
    assert tags.open == []
    assert tags.found.count("svg") == 2 + 1  # points, parts, and the one mistake that was made
    assert "script" not in tags.found
    assert "https://" not in text
    # 2/3 is 1/3 · 2: the first reward discounted too, once.
    assert "first reward" in text


def test_the_bar_of_most_students_is_the_highest(tmp_path: Path) -> None:
    path = tmp_path / "answers.csv"
    # td-zero/1/62590 is 21/4: three have it, the fourth does not.
    path.write_text("student,problem,part,answer\n" + "".join(
        f"{who},td-zero/1/62590,a,{answer}\n" for who, answer in zip("ABCD", ("21/4", "5.25", "21/4", "7"), strict=True)
    ))  # fmt: skip
    text = page.written(verify([path], Settings()), "reason")
    bars = re.findall(r'<rect class="bar" x="(\d+)" y="([\d.]+)" width="50" height="([\d.]+)"/>', text)
    assert bars[0] == ("10", "100.0", "40.0")
    assert [height for _, _, height in bars[1:]] == ["0.0"] * 8 + ["120.0"]


def test_a_table_has_a_column_for_each_thing_that_is_told(report: Report) -> None:
    heads = [tables.written(report, feedback).splitlines()[0].split(",") for feedback in FEEDBACK]
    assert [head[10:] for head in heads] == [
        [], ["typed", "verdict"], ["typed", "verdict", "reason"], ["typed", "verdict", "reason", "key"]
    ]  # fmt: skip


@pytest.mark.parametrize("feedback", FEEDBACK)
def test_no_more_is_told_than_is_asked_for(report: Report, feedback: str) -> None:
    forms = (data, junit, github, gradescope, tables)
    text = "\n".join(form.written(report, feedback) for form in forms) + github.summary(report, feedback)
    assert ("29/3" in text) == (feedback == "key")  # the key of (b)
    assert ("misconception" in text) == (feedback != "none")
    seen = github.summary(report, feedback) + junit.written(report, feedback)
    assert bool(re.search(r"\d of \d", text_report.written(report, feedback))) == (feedback != "none")
    assert ("points" in seen) == (feedback != "none")
    assert ("first reward" in text) == (feedback in ("reason", "key"))


def test_a_long_name_is_not_cut_within_a_character(tmp_path: Path) -> None:
    name = f"x{'&' * 30}.toml"
    (tmp_path / name).write_text('family = "return"\ngiven = {rewards = [3, -2, 4, 1], gamma = "1/2", time = 1}\n')
    answers = tmp_path / "a.csv"
    answers.write_text(f"problem,part,answer\n{name},a,1\n")
    text = page.written(verify([answers], Settings(allow_files=True)), "reason")
    assert f">x{'&amp;' * 30}.toml" in text
    assert not re.search("&(?!(amp|lt|gt|quot|#x27);)", text)


def test_the_verdict_is_the_same_whether_it_is_searched_for_causes(tmp_path: Path) -> None:
    # R_0 = 8 + 4/2 + 9/4 + 6/8 = 13; with γ·i for γⁱ R_1 = 9/2 + 6 = 21/2, and R_0 = 8 + 21/4 = 13.25, within 2 %.
    path = tmp_path / "a.csv"
    path.write_text("student,problem,part,answer\nA,return/1/1745,b,13.25\nB,return/1/1745,b,13.1\n")
    searched, judged = (verify([path], Settings(rules=Rules(causes=causes))).students for causes in (True, False))
    assert [student.parts[1].judged.verdict for student in searched] == ["wrong", "close"]
    assert [student.parts[1].judged.verdict for student in judged] == ["wrong", "close"]


def test_a_dictionary_as_python_prints_it_keeps_its_quotes_in_a_cell(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"  # V(worn) = 21/4; a mark before a text, as spreadsheets put it, is no part of it
    typed = ["{'worn': '21/4'}", "['21/4']", "'21/4", '"=""21/4"""']
    rows = "".join(f"{number},td-zero/1/62590,a,{text}\n" for number, text in enumerate(typed))
    path.write_text(f"student,problem,part,answer\n{rows}")
    assert [student.parts[0].judged.verdict for student in verify([path]).students] == ["right"] * len(typed)
