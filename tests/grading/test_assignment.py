"""An exam is graded as it was given out: exactly its problems, all of them, whatever a file of answers says."""

import json
import os
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from msgspec.structs import replace

from rldrill.exam.blueprint import Blueprint
from rldrill.exam.blueprint import Entry as Asked
from rldrill.exam.exam import Layout, Person
from rldrill.exam.manifest import manifest, written
from rldrill.exam.planning import plan
from rldrill.grading import marking
from rldrill.grading.assignment import Assignment
from rldrill.grading.marking import Rules
from rldrill.grading.report import Report, StudentReport
from rldrill.grading.reports import github, gradescope, junit, page, tables, text
from rldrill.grading.verification import Settings, verify
from rldrill.problems.errors import FileError, UsageError
from rldrill.solutions.answers.judging import judge

HEAD = "student,number,problem,part,answer\n"


def exam(folder: Path, versions: int = 1, roster: tuple[Person, ...] = (), ids: bool = True) -> tuple[Path, Any]:
    """The manifest of an exam of td-zero (1 part) and return (2 parts), at level 1."""
    asked = (Asked(topic=("td-zero",), level=1), Asked(topic=("return",), level=1))
    made = plan(Blueprint(problems=asked, versions=versions, seed=7), roster=roster)
    made = replace(made, layout=Layout(ids=ids))
    path = folder / "exam.json"
    path.write_bytes(written(manifest(made)))
    return path, made


def keys(version: Any) -> dict[tuple[str, str], str]:
    """By number and part the right answers of a version."""
    found = {}
    for number, exercise in enumerate(version.exercises, 1):
        for part in exercise.parts:
            answer = exercise.answers()[part.label]
            text = (
                ", ".join(f"{state}: {v}" for state, v in answer.items()) if isinstance(answer, dict) else str(answer)
            )
            found[str(number), part.label] = text
    return found


def graded(folder: Path, rows: list[tuple[str, ...]], assignment: Assignment, **settings: Any) -> Report:
    path = folder / "answers.csv"
    lines = [",".join(f'"{cell}"' for cell in row) for row in rows]
    path.write_text(HEAD + "\n".join(lines) + "\n", encoding="utf-8")
    return verify([path], Settings(assignment=assignment, **settings))


def student(report: Report, name: str) -> StudentReport:
    return next(each for each in report.students if each.student == name)


def test_everything_right_is_everything_and_what_is_left_out_counts(tmp_path: Path) -> None:
    path, made = exam(tmp_path)
    right = keys(made.versions[0])
    rows = [("Ann", "", number, part, text) for (number, part), text in right.items()]
    rows += [("Ben", "", "1", "a", right["1", "a"])]
    report = graded(tmp_path, rows, Assignment(path))
    of = made.versions[0].points
    assert tables.totals(report).startswith("student,number,version,points,of,percent,passed,remark")
    assert student(report, "Ann").score.points == student(report, "Ann").score.of == of
    ben = student(report, "Ben")
    assert ben.score.of == of
    assert [part.judged.verdict for part in ben.parts] == ["right", "missing", "missing"]
    assert report.exit_code == 1


@pytest.mark.parametrize(("mark", "points"), [(",", 3), (".", 0)])
def test_answers_to_an_exam_with_decimal_commas_may_have_them(tmp_path: Path, mark: str, points: int) -> None:
    blueprint = Blueprint(problems=(Asked(id="td-zero/2/18"),), seed=1, decimal_mark=mark)
    (tmp_path / "exam.json").write_bytes(written(manifest(plan(blueprint))))
    # α = 1/5, γ = 4/5: δ₀ = −5 + 4/5·5 − 5 = −6, V = 19/5; δ₁ = −1 + 4/5·10 − 19/5 = 3.2; δ₂ = 7 − 10 = −3
    rows = [("Ann", "", "1", "a", "-6; 3,2; -3,0"), ("Ben", "", "1", "a", "-6; 3.2; -3.0")]
    report = graded(tmp_path, rows, Assignment(tmp_path / "exam.json"))
    assert student(report, "Ann").score.points == points
    assert student(report, "Ben").score.points == 3
    assert student(report, "Ben").parts[0].judged.read.startswith("δ₀: ")


def test_of_an_exam_with_decimal_commas_the_comma_is_not_blamed(tmp_path: Path) -> None:
    blueprint = Blueprint(problems=(Asked(id="td-zero/2/18"),), seed=1, decimal_mark=",")
    (tmp_path / "exam.json").write_bytes(written(manifest(plan(blueprint))))
    report = graded(tmp_path, [("Ann", "", "1", "a", "-6; 3,2; minus three")], Assignment(tmp_path / "exam.json"))
    judged = student(report, "Ann").parts[0].judged
    assert (judged.verdict, "comma" in judged.reason, "'three'" in judged.reason) == ("unreadable", False, True)


def test_a_part_that_shall_not_count_decides_nothing(tmp_path: Path) -> None:
    path, made = exam(tmp_path)
    data = json.loads(path.read_text())
    (part,) = data["versions"][0]["problems"][0]["parts"]
    part["points"] = 0
    path.write_text(json.dumps(data))
    rows = [("Ann", "", *place, text) for place, text in keys(made.versions[0]).items()]
    for first in ([("Ann", "", "1", "a", "no")], []):
        report = graded(tmp_path, [*first, *rows[1:]], Assignment(path))
        assert report.exit_code == 0
        assert report.students[0].score.share == 1
        assert "yes" in tables.totals(report)
    assert graded(tmp_path, [rows[0]], Assignment(path)).exit_code == 1


def test_an_entry_that_is_left_out_costs_what_a_wrong_one_costs(tmp_path: Path) -> None:
    blueprint = Blueprint(problems=(Asked(id="td-zero/2/18", partial=("entries", "all")),), seed=1, decimal_mark=",")
    (tmp_path / "exam.json").write_bytes(written(manifest(plan(blueprint))))
    # (a) is −6; 16/5; −3, as above, and of 3 points; (b) is medium: 111/25, critical: 47/5.
    for typed in ("-6; ; -3", "-6; 0; -3", "-6; ; -3,0", "delta_0 = -6, delta_2 = -3"):
        rows = [("Ann", "", "1", "a", typed), ("Ann", "", "1", "b", "critical: 9,4")]
        report = graded(tmp_path, rows, Assignment(tmp_path / "exam.json"))
        a, b = student(report, "Ann").parts
        assert (a.judged.verdict, a.score.points) == ("wrong", 2), typed
        assert (b.judged.verdict, b.score.points) == ("wrong", 0)
        assert b.judged.reason == "Not right at medium (left out); the rest is right."


def test_cheating_earns_nothing(tmp_path: Path) -> None:
    path, made = exam(tmp_path, versions=2)
    a, b = made.versions
    (tmp_path / "easy.toml").write_text('family = "return"\n[given]\nrewards = [1, 1]\ngamma = "1/2"\ntime = 0\n')
    identity = b.exercises[0].problem.identity
    attempts = {
        b.exercises[0].id: "is of version B",  # the neighbour's paper
        f"td-zero/2/{identity.seed}": "of another level",
        "return/1/1": "is not in this exam; its problems may be called by their numbers, 1 to 2;",  # one that is known
        "easy.toml": "a file of one's own",
        "../easy.toml": "a file of one's own",
        f"{str(a.exercises[0].id).split('@')[0]}@99": f"revision than the exam's; write {a.exercises[0].id} or 1",
        "3": "the exam has 2 problems",
    }
    rows = [("Eve", "", str(name), "a", "3/2") for name in attempts]
    rows[0] = ("Eve", "", str(b.exercises[0].id), "a", keys(b)["1", "a"])
    report = graded(tmp_path, rows, Assignment(path, "A"))
    (eve,) = report.students
    assert (eve.score.points, eve.score.of) == (0, a.points)
    for said, reason in zip(eve.extra, attempts.values(), strict=True):
        assert reason in said
    assert report.refused == ()


def test_the_roster_says_who_sat_which_version(tmp_path: Path) -> None:
    path, made = exam(tmp_path, versions=2)
    with pytest.raises(UsageError, match="Who sat which version"):
        Assignment(path)
    with pytest.raises(UsageError, match="no version 'C'"):
        Assignment(path, "C")
    roster = tmp_path / "roster.csv"
    roster.write_text("Vorname;Nachname;Matrikelnummer;Version\nJörg;Weiß;007;b\nAnn;Lee;8;A\n", encoding="utf-8")
    right = {version.code: keys(version)["1", "a"] for version in made.versions}
    rows = [
        ("J\u200cO\u0308RG  WEISS", "", "1", "a", right["B"]),  # capitals, the other normal form, what is not seen
        ("", "8", "1", "a", right["A"]),
        ("Mallory", "", "1", "a", right["A"]),
    ]
    report = graded(tmp_path, rows, Assignment(path, roster=roster))
    assert [(each.student, each.number, each.version) for each in report.students] == [
        ("Jörg Weiß", "007", "B"),
        ("Ann Lee", "8", "A"),
    ]
    assert all(each.parts[0].judged.accepted for each in report.students)
    (refusal,) = report.refused
    assert "'Mallory' is not on the roster" in refusal.says


def test_an_exam_for_people_knows_them(tmp_path: Path) -> None:
    path, made = exam(tmp_path, roster=(Person("Ann Lee", "8"), Person("Ben Ali", "9")))
    report = graded(tmp_path, [("ann lee", "", "1", "a", "1"), ("", "9", "1", "a", "1")], Assignment(path))
    assert [(each.student, each.version) for each in report.students] == [
        (version.person.name, version.code) for version in made.versions
    ]


TWO = (Person("Ann Lee", "8"), Person("Ben Ali", "0009"))


def test_a_number_alone_has_nobody_beside_it(tmp_path: Path) -> None:
    path, _ = exam(tmp_path, roster=TWO)
    (ann, _) = graded(tmp_path, [("", "8", "1", "a", "1")], Assignment(path)).students
    assert ann.student == "Ann Lee"
    assert ann.extra == ()
    (ann, _) = graded(tmp_path, [("Bob", "8", "1", "a", "1")], Assignment(path)).students
    assert "beside it stands 'Bob'" in ann.extra[0]


@pytest.mark.parametrize(("known", "typed"), [("0009", "9"), ("9", "0009"), ("0009", "0009")])
def test_the_zeros_before_a_number_may_be_lost(tmp_path: Path, known: str, typed: str) -> None:
    path, _ = exam(tmp_path, roster=(Person("Ann Lee", "8"), Person("Ben Ali", known)))
    (ben, _) = graded(tmp_path, [("", typed, "1", "a", "1")], Assignment(path)).students
    assert ben.student == "Ben Ali"


def test_of_two_of_one_name_the_number_must_be_known(tmp_path: Path) -> None:
    path, _ = exam(tmp_path, roster=(Person("Ann Lee", "8"), Person("Ann Lee", "9")))
    says = [refusal.says for refusal in graded(tmp_path, [("Ann Lee", "7", "1", "a", "1")], Assignment(path)).refused]
    assert says[0].endswith("called 'Ann Lee', and none of them has the number '7'; correct it.")
    says = [refusal.says for refusal in graded(tmp_path, [("Ann Lee", "", "1", "a", "1")], Assignment(path)).refused]
    assert says[0].endswith("called 'Ann Lee'; give the number.")


@pytest.mark.parametrize("number", ["0", "000", ""])
def test_a_number_of_zeros_is_nobodys_who_has_none(tmp_path: Path, number: str) -> None:
    path, made = exam(tmp_path, versions=2)
    roster = tmp_path / "roster.csv"
    roster.write_text("student,version\nAnn,A\nBen,B\n", encoding="utf-8")
    right = {version.code: keys(version)["1", "a"] for version in made.versions}
    rows = [("Ann", "4711", "1", "a", right["A"]), ("Ben", number, "1", "a", right["B"])]
    report = graded(tmp_path, rows, Assignment(path, roster=roster))
    assert [(each.student, each.parts[0].judged.accepted) for each in report.students] == [("Ann", True), ("Ben", True)]


@pytest.mark.parametrize("typed", ["7", "1"])
def test_a_number_that_several_have_is_told(tmp_path: Path, typed: str) -> None:
    path, _ = exam(tmp_path)
    roster = tmp_path / "roster.csv"
    roster.write_text("student,number\nAnn,007\nBen,07\nCid,1\nDan,1\n", encoding="utf-8")
    (refusal,) = graded(tmp_path, [("", typed, "1", "a", "1")], Assignment(path, roster=roster)).refused
    assert refusal.says.endswith(f"several students on the roster have the number {typed!r}; correct the roster.")


def test_whoever_may_have_handed_in_is_not_said_to_have_handed_in_nothing(tmp_path: Path) -> None:
    path, _ = exam(tmp_path, roster=TWO)
    report = graded(tmp_path, [("Bob", "8", "1", "a", "1", "and more")], Assignment(path))  # one field too many
    assert student(report, "Ann Lee").unread == "handed in, could not be read"
    assert student(report, "Ben Ali").unread == ""
    report = graded(tmp_path, [("Benjamin", "", "1", "a", "1")], Assignment(path))
    assert "perhaps it is under one that is not on the roster" in student(report, "Ben Ali").unread


def test_blank_answers_are_a_hand_in(tmp_path: Path) -> None:
    path, _ = exam(tmp_path, roster=TWO)
    report = graded(tmp_path, [("Ann Lee", "", "1", "a", ""), ("", "8", "2", "a", " ")], Assignment(path))
    ann = student(report, "Ann Lee")
    assert [(part.judged.verdict, part.score.points) for part in ann.parts] == [("missing", 0)] * 3
    assert (ann.unread, report.refused, report.exit_code) == ("", (), 1)
    assert student(report, "Ben Ali").unread == ""


@pytest.mark.parametrize("content", ['student = "Ann Lee"', 'student = "Ann Lee"\n[1]\n'])
def test_a_file_with_nothing_but_a_name_is_a_hand_in(tmp_path: Path, content: str) -> None:
    path, _ = exam(tmp_path, roster=TWO)
    (tmp_path / "ann.toml").write_text(content)
    report = verify([tmp_path / "ann.toml"], Settings(assignment=Assignment(path)))
    assert [(each.student, each.unread) for each in report.students] == [
        ("Ann Lee", "handed in, without an answer"),
        ("Ben Ali", ""),
    ]
    assert report.exit_code == 1


@pytest.mark.parametrize(("known", "typed"), [("Ben O\u2019Hara", "ben O'Hara"), ("Li-Lei", "Li\u2010Lei")])
def test_apostrophes_and_hyphens_are_alike_in_names(tmp_path: Path, known: str, typed: str) -> None:
    path, _ = exam(tmp_path, roster=(Person(known, "8"), Person("Ben Ali", "9")))
    assert graded(tmp_path, [(typed, "", "1", "a", "1")], Assignment(path)).students[0].student == known


def test_of_two_of_one_name_nobody_is_said_to_have_handed_in_for_certain(tmp_path: Path) -> None:
    path, _ = exam(tmp_path)
    roster = tmp_path / "roster.csv"
    roster.write_text("student,number\nJohn Smith,15\nJohn Smith,16\nAnn,17\n", encoding="utf-8")
    report = graded(tmp_path, [("John Smith", "", "1", "a", "1")], Assignment(path, roster=roster))
    (refusal,) = report.refused
    assert refusal.says.endswith("several students on the roster are called 'John Smith'; give the number.")
    perhaps = "nothing was read; perhaps one of the files that could not be read"
    assert [each.unread for each in report.students] == [perhaps, perhaps, ""]


def test_the_roster_that_an_exam_was_printed_from_will_do(tmp_path: Path) -> None:
    path, made = exam(tmp_path, roster=TWO)
    roster = tmp_path / "roster.csv"
    roster.write_text("name,number\nBen Ali,0009\nAnn Lee,8\n", encoding="utf-8")
    report = graded(tmp_path, [("", "8", "1", "a", "1"), ("", "9", "1", "a", "1")], Assignment(path, roster=roster))
    codes = {version.person.name: version.code for version in made.versions}
    assert {each.student: each.version for each in report.students} == codes
    roster.write_text("name,number\nCid,1\n", encoding="utf-8")
    with pytest.raises(FileError, match="line 2: the exam was not printed for them; add a version"):
        Assignment(path, roster=roster)


def test_namesakes_are_told_apart_by_numbers_whose_zeros_a_spreadsheet_lost(tmp_path: Path) -> None:
    path, made = exam(tmp_path, roster=(Person("Ann Lee", "007"), Person("Ann Lee", "008")))
    right = {version.person.number: keys(version)["1", "a"] for version in made.versions}
    roster = tmp_path / "roster.csv"
    roster.write_text("name,number\nAnn Lee,7\nAnn Lee,8\n", encoding="utf-8")
    rows = [("Ann Lee", "7", "1", "a", right["007"]), ("Ann Lee", "8", "1", "a", right["008"])]
    report = graded(tmp_path, rows, Assignment(path, roster=roster))
    assert [each.parts[0].judged.accepted for each in report.students] == [True, True]
    roster.write_text("name,number\nAnn Lee,9\n", encoding="utf-8")
    with pytest.raises(FileError, match=r"line 2: several students .* 'Ann Lee', and none of them has the number '9'"):
        Assignment(path, roster=roster)


@pytest.mark.parametrize(
    ("problem", "part"),
    [("2", "a"), ("2.0", "a"), ("Problem 2", "A"), ("#2", "a"), ("2)", "a"), ("2a", ""), ("2 (a)", ""), ("2.a", ""),
     ("Aufgabe 2a", ""), ("Q2", "a")],
)  # fmt: skip
def test_a_problem_may_be_named_as_people_do(tmp_path: Path, problem: str, part: str) -> None:
    path, made = exam(tmp_path)
    report = graded(tmp_path, [("Ann", "", problem, part, keys(made.versions[0])["2", "a"])], Assignment(path))
    assert [part.judged.verdict for part in report.students[0].parts] == ["missing", "right", "missing"]


@pytest.mark.parametrize("typed", ["'{}", "={}", '"{}"', "'{}'"])
def test_what_a_spreadsheet_marks_as_text_is_read(tmp_path: Path, typed: str) -> None:
    blueprint = Blueprint(problems=(Asked(id="return/1/2166"),), seed=1)
    (tmp_path / "exam.json").write_bytes(written(manifest(plan(blueprint))))
    path = tmp_path / "answers.csv"  # R₁ = −1 + 1/3 · 8 + 1/9 · 3 = 2
    path.write_text(f"{HEAD}'t Hooft,,1,a,{typed.format('2')}\n", encoding="utf-8")
    (student,) = verify([path], Settings(assignment=Assignment(tmp_path / "exam.json"))).students
    assert student.student == "'t Hooft"
    assert student.parts[0].judged.verdict == "right"


@pytest.mark.parametrize(("which", "right", "points"), [
    ("first", 0, 1), ("best", 0, 1), ("last", 1, 0), ("first", 1, 0), ("best", 1, 1), ("last", 2, 1), ("best", 2, 1),
])  # fmt: skip
def test_of_several_hand_ins_one_counts(tmp_path: Path, which: str, right: int, points: int) -> None:
    path, made = exam(tmp_path)
    worth = made.versions[0].exercises[0].parts[0].points
    files = []
    for number in range(3):
        typed = keys(made.versions[0])["1", "a"] if number == right else "1000"
        files.append(tmp_path / f"{number}.csv")
        files[-1].write_text(f'{HEAD}Ann,,1,a,"{typed}"\n')
    report = verify(files, Settings(assignment=Assignment(path), hand_ins=which))
    assert [each.score.points for each in report.students] == [points * worth]


def test_the_printed_givens_are_graded_when_the_family_has_moved_on(tmp_path: Path) -> None:
    path, _ = exam(tmp_path)
    data = json.loads(path.read_text())
    problem = data["versions"][0]["problems"][1]
    problem["id"] = "return/1/5@1"
    problem["problem"]["given"] |= {"rewards": ["3", "-2", "4", "1"], "gamma": "1/2", "time": 1}
    path.write_text(json.dumps(data))
    # R₁ = −2 + 1/2 · 4 + 1/4 · 1 = 1/4, then R₀ = 3 + 1/2 · 1/4 = 25/8.
    rows = [("Ann", "", "return/1/5@1", "a", "1/4"), ("Ann", "", "return/1/5", "b", "25/8")]
    (ann,) = graded(tmp_path, rows, Assignment(path)).students
    assert [part.judged.verdict for part in ann.parts] == ["missing", "right", "right"]
    assert ann.parts[1].problem == "return/1/5@1"


def test_an_id_that_was_not_printed_is_not_told(tmp_path: Path) -> None:
    path, made = exam(tmp_path, ids=False)
    version = made.versions[0]
    seeds = {str(exercise.problem.identity.seed) for exercise in version.exercises}
    rows = [("Ann", "", "1", "z", "1"), ("Ann", "", "2", "a", "1"), ("Ann", "", "td-zero/2/1", "a", "1")]
    report = graded(tmp_path, rows, Assignment(path))
    assert [part.problem for part in report.parts] == ["problem 1", "problem 2", "problem 2"]
    # A sitting in the terminal writes whole IDs; of somebody who tries them out none is taken.
    whole = str(version.exercises[0].id)
    assert graded(tmp_path, [("Ann", "", whole, "a", "1")], Assignment(path)).parts[0].judged.verdict == "wrong"
    tries = [("Ann", "", f"td-zero/1/{seed}@2", "a", "1") for seed in range(20)]
    tried = graded(tmp_path, [*tries, ("Ann", "", whole, "a", "1")], Assignment(path))
    assert tried.parts[0].judged.verdict == "missing"
    assert tried.students[0].extra == (
        "So many IDs are guesses; the problems of this exam are called by their numbers.",
    )
    told = json.dumps(report.to_json("key"), ensure_ascii=False)
    for seed in seeds:
        assert f"/{seed}" not in told


@pytest.mark.parametrize(
    ("answer", "share"),
    [
        ("1, 2; 0, 1", 0),
        ("3/4, 2; 0, 1", Fraction(1, 2)),
        ("3/4, -1; 0, 1", 1),
        ("3/4, -1; 0, 2", Fraction(2, 3)),
    ],
)
def test_entries_that_are_the_same_in_every_draw_earn_nothing(tmp_path: Path, answer: str, share: Fraction) -> None:
    # (b) asks for Ã = [3/4 −1; 0 1]: 1 − 1/2·2/(2·√4) = 3/4, 4 + 1/2·(6 − 2·√4) = 5, 5 − 3/4·4 − 1/2·6 = −1; the last
    # row is 0 1 in every draw.
    path = tmp_path / "answers.csv"
    path.write_text(f'{HEAD}Ann,,linearise-affine/1/6,b,"{answer}"\n')
    (part,) = [part for part in verify([path]).parts if part.part == "b"]
    assert part.score.points == share * part.score.of
    rules = Settings(rules=Rules(partial="all"))
    (part,) = [part for part in verify([path], rules).parts if part.part == "b"]
    assert part.score.points == (part.score.of if share == 1 else 0)


@pytest.mark.parametrize(("problem", "answer"), [("kalman-filter/1/5", "9, 4"), ("kalman-filter/1/7", "9, 3")])
def test_an_entry_that_some_draws_have_alike_counts(tmp_path: Path, problem: str, answer: str) -> None:
    # (b) asks for the mean and the variance behind the measurement, Σ̄ Q / (Σ̄ + Q) with Σ̄ = Σ₀ + R: of 2 + 4 and 12 it
    # is 6 · 12 / 18 = 4, of 3 + 1 and 12 it is 4 · 12 / 16 = 3. The draws of the seeds 0 to 3 have 4, too.
    path = tmp_path / "answers.csv"
    path.write_text(f'{HEAD}Ann,,{problem},b,"{answer}"\n')
    (part,) = [part for part in verify([path]).parts if part.part == "b"]
    assert part.score.share == Fraction(1, 2)


def test_whoever_is_on_the_roster_and_handed_in_nothing_counts(tmp_path: Path) -> None:
    path, made = exam(tmp_path)
    of = made.versions[0].points
    roster = tmp_path / "roster.csv"
    roster.write_text("student,number\nAnn,1\nBen,2\nCem,3\n", encoding="utf-8")  # one version: no column for it
    rows = [("Ann", "", *key, text) for key, text in keys(made.versions[0]).items()]
    report = graded(tmp_path, rows, Assignment(path, roster=roster))
    assert [(each.student, each.score.points, each.score.of) for each in report.students] == [
        ("Ann", of, of),
        ("Ben", 0, of),
        ("Cem", 0, of),
    ]
    assert (report.score.points, report.score.of) == (of, 3 * of)
    assert report.exit_code == 1
    told = {
        "text": text.written(report, "reason"),
        "html": page.written(report, "reason"),
        "github": github.written(report, "reason"),
        "summary": github.summary(report, "reason"),
        "junit": junit.written(report, "reason"),
        "csv": tables.totals(report),
    }
    for form, said in told.items():
        assert said.count("handed in nothing") >= (1 if form == "html" else 2), form
        assert "Ben" in said
        assert "Cem" in said
    assert [each["handed_in"] for each in report.to_json()["students"]] == [True, False, False]
    # A submission to Gradescope is one student's: what others did not hand in is no business of theirs.
    assert "Ben" not in gradescope.written(report, "reason")
    assert len(json.loads(gradescope.written(report, "reason"))["tests"]) == len(rows)
    alone = graded(tmp_path, rows, Assignment(path, roster=roster), absent=False)
    assert [each.student for each in alone.students] == ["Ann"]
    assert alone.exit_code == 0


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("b.json", '{"student": "Ben", "answers": {"1": {"a": 1/2}}}'),
        ("b.json", '{\n  "number": 2,\n  "answers": {"1": {"a": "1", "a": "2"}}\n}'),
        ("b.toml", 'student = "Ben"\n[answers.1]\na = "1\n'),
        ("b.jsonl", '{"student": "Ben", "problem": "1", "part": "a", "answer": 1/2}\n'),
    ],
)
def test_of_whoever_handed_in_what_cannot_be_read_it_is_not_said_that_they_handed_in_nothing(
    tmp_path: Path, name: str, content: str
) -> None:
    path, _ = exam(tmp_path)
    roster, handed = tmp_path / "roster.csv", tmp_path / name
    roster.write_text("student,number\nBen,2\nCem,3\n", encoding="utf-8")
    handed.write_text(content, encoding="utf-8")
    report = verify([handed], Settings(assignment=Assignment(path, roster=roster)))
    assert [each["handed_in"] for each in report.to_json()["students"]] == [True, False]
    ben, cem = tables.totals(report).splitlines()[1:]
    assert "handed in, could not be read" in ben
    assert cem.endswith("handed in nothing")
    assert "1 handed in nothing" in page.written(report, "reason")


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("b.json", '{"student": "Ben", "answers": {"2": {"a": NaN, "b": "1"}}}'),
        ("b.toml", 'student = "Ben"\n[answers.2]\na = inf\nb = 1\n'),
    ],
)
def test_what_is_no_number_costs_itself_alone(tmp_path: Path, name: str, content: str) -> None:
    path, _ = exam(tmp_path)
    (tmp_path / name).write_text(content, encoding="utf-8")
    (ben,) = verify([tmp_path / name], Settings(assignment=Assignment(path))).students
    assert [part.judged.verdict for part in ben.parts] == ["missing", "unreadable", "wrong"]


def test_where_a_file_tells_not_whose_it_is_nobody_is_said_to_have_handed_in_nothing(tmp_path: Path) -> None:
    path, _ = exam(tmp_path)
    roster, handed = tmp_path / "roster.csv", tmp_path / "x.toml"
    roster.write_text("student,number\nBen,2\nCem,3\n", encoding="utf-8")
    handed.write_bytes(b"\xff\xfe\x00")
    report = verify([handed], Settings(assignment=Assignment(path, roster=roster)))
    assert "handed in nothing" not in tables.totals(report) + page.written(report, "reason")
    assert tables.totals(report).count("perhaps one of the files that could not be read") == 2


def test_a_problem_that_cannot_be_graded_stays_in_what_there_is_to_earn(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, made = exam(tmp_path)
    right = keys(made.versions[0])
    rows = [("Eve", "", "1", "a", right["1", "a"]), ("Eve", "", "2", "a", "13")]

    def judged(solution: Any, label: str, text: str, earlier: Any = None) -> Any:
        if text == "13":
            os._exit(139)
        return judge(solution, label, text, earlier)

    monkeypatch.setattr(marking, "judge", judged)
    report = graded(tmp_path, rows, Assignment(path), isolated=True, needed=Fraction(1, 2))
    (eve,) = report.students
    assert [part.judged.verdict for part in eve.parts] == ["right", "not graded", "not graded"]
    assert eve.score.of == made.versions[0].points
    assert not report.passed(eve)  # whoever breaks the grading of what they cannot do has not passed by the rest
    assert report.exit_code == 3


def test_every_report_tells_the_points_on_the_exams_scale(tmp_path: Path) -> None:
    path, made = exam(tmp_path)
    data = json.loads(path.read_text())
    data["scale"] = 100
    worth = {("1", "a"): 2, ("2", "a"): 0, ("2", "b"): 3}  # weights set after the exam: (2a) does not count any more
    for (number, label), points in worth.items():
        parts = data["versions"][0]["problems"][int(number) - 1]["parts"]
        next(part for part in parts if part["part"] == label)["points"] = points
    path.write_text(json.dumps(data))
    right = keys(made.versions[0])
    report = graded(tmp_path, [("Ann", "", "1", "a", right["1", "a"])], Assignment(path))
    (ann,) = report.students
    # 2 of 2 + 0 + 3 points are 40 of 100.
    assert (ann.score.points, ann.score.of) == (2, 5)
    assert report.to_json()["students"][0]["scaled"] == {"exact": "40", "decimal": "40", "of": 100}
    assert "2 of 5 (40 %), 40 of 100" in text.written(report, "reason")
    assert "40 of 100" in page.written(report, "reason")
    assert "2 of 5 points, 40 of 100" in github.summary(report, "reason")
    assert tables.totals(report).startswith("student,number,version,points,of,percent,scaled,scaled of,passed,remark")
    assert "2,5,40,40,100,no" in tables.totals(report)
    assert '<property name="scaled" value="40" />' in junit.written(report, "reason")
    results = json.loads(gradescope.written(report, "reason"))
    assert results["score"] == 40
    assert [(test["score"], test["max_score"]) for test in results["tests"]] == [(40, 40), (0, 0), (0, 60)]


def test_what_is_handed_in_in_somebody_elses_name_is_seen(tmp_path: Path) -> None:
    path, made = exam(tmp_path, roster=(Person("Ann Lee", "8"), Person("Ben Ali", "9")))
    right = {version.person.name: keys(version)["1", "a"] for version in made.versions}
    for name, row in {
        "ann": ("Ann Lee", "8", "1", "a", right["Ann Lee"]),
        "ben": ("Ben Ali", "9", "1", "a", right["Ben Ali"]),
        "mallory": ("Mallory", "9", "1", "a", "1000"),
    }.items():
        (tmp_path / f"{name}.csv").write_text(HEAD + ",".join(f'"{cell}"' for cell in row) + "\n")
    report = verify([tmp_path / f"{name}.csv" for name in ("ann", "ben", "mallory")], Settings(Assignment(path)))
    ann, ben = report.students
    assert (ann.extra, ann.others, ann.remark) == ((), (), "")
    assert ben.others == (str(tmp_path / "ben.csv"),)
    assert ben.remark == "1 of 2 hand-ins"
    (said,) = ben.extra
    assert "number 9 is Ben Ali's, and beside it stands 'Mallory'" in said
    assert "1 of 2 hand-ins" in tables.totals(report)
    assert "1 of 2 hand-ins" in page.written(report, "reason")


def test_answers_that_leave_something_open_earn_nothing(tmp_path: Path) -> None:
    path, made = exam(tmp_path)
    right = keys(made.versions[0])["2", "a"]
    tricks = [
        "V(s)", "R_1", "x", "0/0", "1/0", "NaN", f"1 or {right}", f"{right} or 1", f"{right}; 1", f"[0, {right}]",
        f"{right} ± 9", f"0..{right}", f"a: 1, a: {right}", f"{{1, {right}}}", "key", "?", f"{right}\u200b", "9^9^9",
    ]  # fmt: skip
    for trick in tricks:
        (ann,) = graded(tmp_path, [("Ann", "", "2", "a", trick)], Assignment(path)).students
        assert ann.score.points == 0, trick
        assert ann.parts[1].judged.verdict in ("unreadable", "missing"), trick


def test_partial_points_are_given_part_by_part(tmp_path: Path) -> None:
    # linearise-affine/1/6 (b) is [3/4 −1; 0 1], see above; its last row is the same in every draw.
    path = tmp_path / "exam.json"
    shares = []
    for partial in ("entries", ("entries", "all", "entries"), None):
        asked = Asked(id="linearise-affine/1/6", partial=partial)
        path.write_bytes(written(manifest(plan(Blueprint(problems=(asked,), seed=7)))))
        (ann,) = graded(tmp_path, [("Ann", "", "1", "b", "3/4, 2; 0, 1")], Assignment(path)).students
        shares += [part.score.share for part in ann.parts if part.part == "b"]
    assert shares == [Fraction(1, 2), 0, 0]
    with pytest.raises(UsageError, match="Partial is given for 1 part, and linearise-affine has 3 here"):
        plan(Blueprint(problems=(Asked(id="linearise-affine/1/6", partial=("all",)),), seed=7))


def test_a_file_that_is_named_twice_is_read_once(tmp_path: Path) -> None:
    path, made = exam(tmp_path)
    answers = tmp_path / "a.csv"
    answers.write_text(f"{HEAD}Ann,,1,a,{keys(made.versions[0])['1', 'a']}\n", encoding="utf-8")
    (tmp_path / "b.csv").symlink_to(answers)
    for settings in (Settings(), Settings(assignment=Assignment(path))):
        report = verify(
            [answers, answers, tmp_path / "b.csv", tmp_path / "." / ".." / tmp_path.name / "a.csv"], settings
        )
        assert [each.remark for each in report.students] == ([""] if settings.assignment else [])
        assert len(report.refused) == (0 if settings.assignment else 1)  # problem 1 of which exam?


def test_the_version_that_is_said_is_that_of_all_whomever_the_exam_was_printed_for(tmp_path: Path) -> None:
    path, made = exam(tmp_path, roster=TWO)  # Ann has A, Ben has B
    roster = tmp_path / "roster.csv"
    roster.write_text("name,number\nBen Ali,0009\nDora,99\n", encoding="utf-8")
    right = keys(made.versions[0])["1", "a"]
    rows = [("Ben Ali", "", "1", "a", right), ("Dora", "", "1", "a", right)]
    report = graded(tmp_path, rows, Assignment(path, version="A", roster=roster))
    found = [(each.student, each.version, each.parts[0].judged.verdict) for each in report.students]
    assert found == [("Ben Ali", "A", "right"), ("Dora", "A", "right")]


def test_a_number_in_the_column_of_names_may_have_lost_its_zeros_too(tmp_path: Path) -> None:
    path, _ = exam(tmp_path, roster=TWO)
    (ben, _) = graded(tmp_path, [("9", "", "1", "a", "1")], Assignment(path)).students
    assert ben.student == "Ben Ali"


@pytest.mark.parametrize("row", [("", "9"), ("9", "")])
def test_whose_row_cannot_be_read_is_known_by_a_number_without_its_zeros(tmp_path: Path, row: tuple[str, str]) -> None:
    path, _ = exam(tmp_path, roster=TWO)
    report = graded(tmp_path, [(*row, "xx", "a", "1", "and more")], Assignment(path))
    assert [each.unread for each in report.students] == ["", "handed in, could not be read"]
