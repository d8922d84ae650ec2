"""Whatever is handed in, a report comes out: nothing is run, echoed raw, opened outside of its folder or waited for."""

import contextlib
import json
import os
import runpy
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import rldrill
from promptness import at_once
from rldrill.exam.blueprint import read_blueprint
from rldrill.exam.manifest import printed
from rldrill.exam.roster import read_roster
from rldrill.grading.assignment import Assignment
from rldrill.grading.reports import data, github, gradescope, junit, page, tables, text
from rldrill.grading.verification import Settings, verify
from rldrill.problems.errors import FileError, UserError

HEAD = "student,problem,part,answer\n"
ID = "td-zero/1/62590"
#: The answers that take long, to every part of every family where the benchmark is run by itself.
HOSTILE = runpy.run_path(str(Path(__file__).parents[2] / "benchmarks" / "hostile.py"))


def written(folder: Path, name: str, content: str | bytes) -> Path:
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


def verdicts(path: Path) -> dict[str, str]:
    return {each.student: each.parts[0].judged.verdict for each in verify([path]).students}


def command(*arguments: object, **options: object) -> "subprocess.CompletedProcess[bytes]":
    line = [sys.executable, "-m", "rldrill", "verify", *map(str, arguments)]
    return subprocess.run(line, check=False, timeout=60, **options)  # type: ignore[call-overload]


@pytest.mark.parametrize(
    "content",
    [
        ("student;problem;part;answer\r\nAnn;td-zero/1/62590;a;5,25\r\n").encode("utf-16"),
        b"\xef\xbb\xbfsep=;\r\nstudent;problem;part;answer\r\nAnn;td-zero/1/62590;a;5,25\r\n",
        b'student,problem,part,answer\rAnn,td-zero/1/62590,a,"=""5.25"""\r',
        "student,problem,part,answer\nA\u200cn\u200dn,td-zero/1/62590,a,5.25\n",
        "Student\u00a0Name\tProblem\tPart\tAnswer\nAnn\u00a0Lee\ttd-zero/1/62590\ta\t5.25\n",
    ],
)
def test_what_spreadsheets_and_scripts_make_of_a_file_is_read(tmp_path: Path, content: str | bytes) -> None:
    assert list(verdicts(written(tmp_path, "a.csv", content)).values()) == ["right"]


@pytest.mark.parametrize(
    "date",
    ["3-Apr", "Apr-03", "4-Mar", "03. Apr", "3-Apr-24", "2024-04-03", "2024-04-03 00:00:00", "3.4.2024", "3/4/2024"],
)
def test_a_fraction_that_became_a_date_is_recognised_and_said(tmp_path: Path, date: str) -> None:
    (part,) = verify([written(tmp_path, "a.csv", f"{HEAD}Ann,td-zero/1/62590,a,{date}\n")]).parts
    assert part.judged.verdict == "unreadable"
    assert "is a date: a spreadsheet makes one of a fraction such as 3/4" in part.judged.reason
    assert (part.line, part.column) == (2, 4)


def test_escape_codes_are_never_echoed(tmp_path: Path) -> None:
    evil = "\x1b]0;mine\x07\x9b31m\u202e"
    rows = (f"Ann,{ID},a,{evil}", f"A{evil},{ID},a,1", f"Ben,{evil},a,1", f"Ben,{ID},{evil},1")
    content = HEAD + "".join(f"{row}\n" for row in rows)
    path = written(tmp_path, "a.csv", content)
    report = verify([path])
    texts = [form.written(report, "key") for form in (data, github, gradescope, junit, page, tables, text)]
    done = command(path, capture_output=True)
    assert done.returncode == 3
    texts += [github.summary(report, "key"), done.stdout.decode(), done.stderr.decode()]
    for said in texts:
        assert not set(said) & set("\x1b\x07\x9b\u202e")
    json.loads(texts[0])


def test_pipes_devices_and_loops_are_refused_at_once(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.csv")
    (tmp_path / "device.csv").symlink_to("/dev/zero")
    (tmp_path / "loop.csv").symlink_to(tmp_path / "loop.csv")
    with written(tmp_path, "huge.csv", HEAD).open("r+b") as file:
        file.truncate(2**30)  # a gigabyte that takes no room
    report = verify([tmp_path / f"{name}.csv" for name in ("pipe", "device", "loop", "huge")])  # a pipe waits for ever
    assert len(report.refused) == 4
    assert report.exit_code == 3


def test_deep_and_long_tables_are_refused_in_a_sentence(tmp_path: Path) -> None:
    for name, content in {
        "a.json": '{"td-zero/1/62590": ' + "[" * 100_000,
        "b.json": '{"a":' * 5000 + "1" + "}" * 5000,
        "c.toml": f'"td-zero/1/62590" = {"[" * 3000}',
        "d.toml": f'"td-zero/1/62590" = {"9" * 100_000}',
        "e.json": f'{{"td-zero/1/62590": {"9" * 100_000}}}',
    }.items():
        (refusal,) = verify([written(tmp_path, name, content)]).refused
        assert len(refusal.says) < 400


def test_paths_in_a_manifest_open_nothing(tmp_path: Path) -> None:
    content = {"format": 2, "rldrill": "0", "title": "t", "seed": 1, "versions": [{"code": "A", "problems": [
        {"id": "../../etc/passwd", "parts": [{"part": "a", "points": 1}], "problem": {
            "family": "optimal-value", "given": {"gamma": "1/2", "mdp": {"file": "/etc/passwd.csv"}}}}]}]}  # fmt: skip
    path = written(tmp_path, "exam.json", json.dumps(content))
    report = verify([written(tmp_path, "a.csv", HEAD + "Ann,1,a,1\n")], Settings(assignment=Assignment(path)))
    assert report.exit_code == 3
    assert "passwd.csv: there is no such file" not in str(report.refused)


@pytest.mark.parametrize("code", ["../x", "/etc/x", "A\n", "a b", "", "\x1b[31m", "A" * 9])
def test_the_code_of_a_version_leads_nowhere(tmp_path: Path, code: str) -> None:
    problem = {"id": "td-zero/1/62590@4", "parts": [{"part": "a", "points": 1}], "problem": {}}
    data = {"format": 2, "rldrill": "0", "title": "t", "seed": 1, "versions": [{"code": code, "problems": [problem]}]}
    with pytest.raises(FileError, match=r"the manifest is damaged at versions\.1\.code"):
        printed(written(tmp_path, "exam.json", json.dumps(data)))


def test_a_closed_output_is_no_reason_to_fail(tmp_path: Path) -> None:
    path = written(tmp_path, "a.csv", HEAD + "Ann,td-zero/1/62590,a,5.25\n")
    for streams in (">&- 2>&-",):
        line = f'"{sys.executable}" -m rldrill verify "{path}" {streams}'
        assert subprocess.run(line, shell=True, check=False, timeout=60, stderr=subprocess.DEVNULL).returncode == 0


ANY = st.binary(max_size=150) | st.text(
    st.sampled_from('[]{}",:;=\n\r \t\\utd-zero/1/7@2abversionABstudent#'), max_size=90
).map(str.encode)


@settings(max_examples=120, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(content=ANY)
@pytest.mark.parametrize("head", [b"", b"student,version\n", b"number;version\n"])
def test_any_roster_is_read_or_refused(tmp_path: Path, head: bytes, content: bytes) -> None:
    path = written(tmp_path, "roster.csv", head + content)
    manifest = tmp_path / "exam.json"
    if not manifest.exists():
        problem = {"id": "td-zero/1/62590@2", "parts": [{"part": "a", "points": 1}], "problem": {}}
        versions = [{"code": code, "problems": [problem]} for code in "AB"]
        manifest.write_text(json.dumps({"format": 2, "rldrill": "0", "title": "t", "seed": 1, "versions": versions}))
    with contextlib.suppress(UserError):
        Assignment(manifest, roster=path)


@settings(max_examples=100, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(content=ANY)
@pytest.mark.parametrize("head", [b"", b"name,number\n", b"Number;Name\r\n"])
def test_any_list_of_people_is_read_or_refused(tmp_path: Path, head: bytes, content: bytes) -> None:
    with contextlib.suppress(UserError):
        read_roster(written(tmp_path, "course.csv", head + content))


@settings(max_examples=100, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(content=ANY)
@pytest.mark.parametrize("head", [b"", b"[[problems]]\n", b"points = 9\n[[problems]]\nfamily = 'return'\n"])
def test_any_blueprint_is_read_or_refused(tmp_path: Path, head: bytes, content: bytes) -> None:
    with contextlib.suppress(UserError):
        read_blueprint(written(tmp_path, "exam.toml", head + content))


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=8), inner, max_size=3),
    max_leaves=8,
)


@settings(max_examples=80, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(content=JSON | st.dictionaries(st.sampled_from(["format", "rldrill", "title", "seed", "versions"]), JSON))
def test_any_manifest_is_read_or_refused(tmp_path: Path, content: object) -> None:
    path = written(tmp_path, "exam.json", json.dumps(content))
    with contextlib.suppress(UserError):
        printed(path)
        Assignment(path, "A")


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.toml", '"td-zero/1/62590".' + "a." * 100_000 + "b = 1"),  # the library takes 5 GB for it
        ("a.toml", '["td-zero/1/62590" .' + " '' . " * 100_000 + "b]"),
        ("a.toml", "x = {" + '"\\"" . ' * 50_000 + "b = 1}"),
        ("a.toml", "\n" * 900_000 + "="),
        ("a.toml", '"td-zero/1/62590" = "' + '\\"' * 400_000 + '"'),
        ("a.toml", '"td-zero/1/62590" = [' + "1," * 2_000_000 + "]"),
        ("a.json", '{"td-zero/1/62590": [' + "1," * 2_000_000 + "1]}"),
        ("a.csv", "problem,answer" + ",x" * 100_000 + "\ntd-zero/1/62590,1" + "," * 100_000 + "\n"),
        ("a.csv", HEAD + "A" + "\u0301\u0316" * 500_000 + ",td-zero/1/62590,a,1\n"),
        ("a.csv", HEAD + 'A,td-zero/1/62590,a,"\n' * 10_000),
    ],
)
def test_no_small_file_takes_long(tmp_path: Path, name: str, content: str) -> None:
    path = written(tmp_path, name, content)
    with at_once(yardsticks=600):
        verify([path])


def test_a_long_answer_costs_only_itself(tmp_path: Path) -> None:
    long = "".join(f"{name},td-zero/1/62590,a,{'9' * 200_000}\n" for name in "ABCDEFGHIJKLMNOPQRSTUVWXY")
    found = verdicts(written(tmp_path, "a.csv", f"{HEAD}{long}Zoe,td-zero/1/62590,a,5.25\n"))
    assert found.pop("Zoe") == "right"
    assert set(found.values()) == {"unreadable"}


PRIMES = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61)


@pytest.mark.parametrize("problem", ["return/1/2166", "td-zero/1/62590"])
@pytest.mark.parametrize(
    "answer",
    [
        "a" * 300_000,
        "a=\n" * 100_000,
        "²" * 1999,
        "(" * 990 + "1" + ")" * 990,
        "(((9^64)^64)^64)^64",
        "sqrt(" * 330 + "2" + ")" * 330,
        "/".join(["3"] * 900),
        "+".join(f"1/{number}" for number in range(1001, 1250)),
        "1/(" + "+".join(f"sqrt({prime})" for prime in PRIMES) + ")",
        "(" + "+".join(f"exp({number}/7)" for number in range(1, 60)) + ")^64",
        "\\frac{1}{" * 180 + "2" + "}" * 180,
    ],
)
def test_no_answer_takes_long(problem: str, answer: str) -> None:
    exercise = rldrill.load(problem)
    exercise.check("1")  # what is worked out once for a problem is no answer's doing
    with at_once():
        assert not exercise.check(answer).accepted


@pytest.mark.parametrize("problem", ["reinforce/3/3", "lqr-gain/2/4", "policy-value/2/7"])
def test_no_answer_in_the_shape_of_its_part_takes_long(problem: str) -> None:
    exercise = rldrill.load(problem)
    exercise.check("1")  # what is worked out once for a problem is no answer's doing
    for name, typed in HOSTILE["submissions"](exercise, exercise.parts[0]):
        with at_once(name):
            HOSTILE["judged"](exercise, typed)


def test_a_number_too_long_for_a_root_ends_nothing() -> None:
    # The distance (d) is the root of the squares of the weights (c): 1800 digits, more than a float holds.
    exercise = rldrill.load("apprenticeship/1/3")
    graded = exercise.grade({"c": f"{'9' * 900}, {'9' * 900}", "d": "12345"})
    assert not graded["c"].accepted
    assert not graded["d"].accepted
