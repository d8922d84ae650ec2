"""A sealed exam is drawn again by nobody who lacks its secret, and printed and graded by whoever has its manifest."""

import hmac
import json
import os
import subprocess
from pathlib import Path

import pytest
from typer.testing import CliRunner

from rldrill.cli import app
from rldrill.exam.blueprint import Blueprint, Entry
from rldrill.exam.exam import Exam
from rldrill.exam.fairness import content
from rldrill.exam.planning import plan
from rldrill.exam.sealing import Secret, read_secret
from rldrill.problems.draws import Draws
from rldrill.problems.errors import FileError, UserError

KEY = b"sixteen bytes and more"
BLUEPRINT = Blueprint(problems=(Entry(family="td-zero", level=2), Entry(topic=("bellman",))), seed=7, versions=3)


def problems(exam: Exam) -> set[str]:
    return {content(exercise) for version in exam.versions for exercise in version.exercises}


def test_the_same_secret_is_the_same_exam_and_without_it_no_problem_is_found() -> None:
    sealed = plan(BLUEPRINT, secret=Secret(KEY))
    again = plan(BLUEPRINT, secret=Secret(KEY))
    assert problems(sealed) == problems(again)
    assert [each.code for each in sealed.versions] == [each.code for each in again.versions]
    assert sealed.sealed
    for other in (plan(BLUEPRINT), plan(BLUEPRINT, secret=Secret(KEY + b"!"))):
        assert not problems(sealed) & problems(other)
        assert not {each.code for each in sealed.versions} & {each.code for each in other.versions}


def test_seeds_are_drawn_by_the_hmac_of_secret_and_place() -> None:
    # Of the first candidates for the first place those of about the same time are taken.
    stream = Draws(hmac.digest(KEY, b"problems 7 version 0 place 0", "sha256").hex())
    candidates = [stream.below(10**12) for _ in range(20)]
    taken = [version.exercises[0].problem.identity for version in plan(BLUEPRINT, secret=Secret(KEY)).versions]
    assert all(identity is not None and identity.seed in candidates for identity in taken)


def test_codes_say_nothing_and_differ() -> None:
    codes = Secret(KEY).codes(7, 999)
    assert len(set(codes)) == 999
    assert all(len(code) == 6 and set(code) <= set("CDFGHJKMNPQRTVWXY34679") for code in codes)
    assert list(codes) != sorted(codes)
    assert codes[:2] == Secret(KEY).codes(7, 2)
    assert codes[:2] != Secret(KEY).codes(8, 2)


def test_a_secret_is_made_where_there_is_none_and_read_without_its_line_end(tmp_path: Path) -> None:
    path = tmp_path / "new.secret"
    made, is_new = read_secret(path)
    assert is_new
    assert len(path.read_text().strip()) == 64
    if os.name == "posix":
        assert path.stat().st_mode & 0o777 == 0o600
    path.write_bytes(path.read_bytes().rstrip() + b"\r\n")
    read, is_new = read_secret(path)
    assert not is_new
    assert read.mixed("x") == made.mixed("x")


@pytest.mark.parametrize("content", [b"", b"fifteen bytes..\n", b" " * 100, b"x" * 5000])
def test_what_is_no_secret_is_refused(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "a.secret").write_bytes(content)
    with pytest.raises(FileError, match=r"a\.secret: a secret"):
        read_secret(tmp_path / "a.secret")


def test_no_id_is_printed_on_a_sealed_exam() -> None:
    with pytest.raises(UserError, match="sealed"):
        plan(BLUEPRINT.but(ids=True), secret=Secret(KEY))


def test_the_manifest_prints_and_grades_it_and_holds_no_secret(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a.secret").write_bytes(KEY)

    def run(*arguments: str) -> str:
        done = CliRunner().invoke(app, list(arguments))
        assert done.exit_code in (0, 1), done.output
        return done.output

    run("worksheet", "td-zero", "-n", "1", "--seed", "7", "--versions", "2", "--secret-file", "a.secret", "-o", "e.pdf")
    data = json.loads(Path("e.json").read_text())
    assert data["sealed"] is True
    version = data["versions"][1]
    pages = subprocess.run(["pdftotext", f"e-{version['code']}.pdf", "-"], check=True, capture_output=True, text=True)
    assert f"Version {version['code']}" in pages.stdout
    (problem,) = version["problems"]
    for secret in (problem["id"], problem["id"].split("/")[2].split("@")[0], "seed"):
        assert secret not in pages.stdout
    run("worksheet", "--from", "e.json", "--key", "-o", "k.pdf")
    assert Path(f"k-{version['code']}-key.pdf").exists()
    Path("ann.csv").write_text("student,problem,part,answer\nAnn,1,a,1000\n")
    told = run("verify", "ann.csv", "--for", "e.json", "--version", version["code"].lower(), "--json")
    assert problem["id"] not in told
    assert json.loads(told)["students"][0]["version"] == version["code"]
    assert not any(KEY in path.read_bytes() for path in tmp_path.iterdir() if path.suffix != ".secret")
    refused = CliRunner().invoke(app, ["worksheet", "--from", "e.json", "--ids", "-o", "x.pdf"])
    assert "sealed" in str(refused.exception)
