"""``rldrill history`` as it is used: out, in, and gone."""

import os
import sqlite3
import subprocess
import sys
from datetime import UTC, datetime
from pathlib import Path

import pytest
from msgspec.structs import replace
from typer.testing import CliRunner

from rldrill.cli import app
from rldrill.history import log
from rldrill.history.attempts import Attempt
from rldrill.history.place import HistoryError
from rldrill.problems.errors import FileError

ROOT = Path(__file__).parent.parent.parent
FIRST = Attempt(
    id="1", time=datetime(2026, 11, 25, 8, tzinfo=UTC), sitting="one", family="td-zero", level=1, seed=7, revision=1,
    part="a", parts=1, typed="γ = ½", outcome="wrong", misconceptions=(), hints=0, retries=0, seconds=1.0, credit=0.0,
)  # fmt: skip
SECOND = replace(FIRST, id="2", family="bellman-residual")


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("RLDRILL_HOME", str(tmp_path / "home"))
    log.append(tmp_path / "home" / "history.db", [FIRST, SECOND])
    return tmp_path / "home" / "history.db"


def run(*arguments: str, typed: str = "") -> str:
    result = CliRunner().invoke(app, ["history", *arguments], input=typed)
    if isinstance(result.exception, Exception):
        raise result.exception
    return result.stdout


def test_what_is_written_out_is_read_in_elsewhere(home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run("export", str(tmp_path / "out.jsonl"))
    text = run("export")
    assert text == (tmp_path / "out.jsonl").read_text(encoding="utf-8")
    assert len(text.splitlines()) == 2
    monkeypatch.setenv("RLDRILL_HOME", str(tmp_path / "elsewhere"))
    run("import", str(tmp_path / "out.jsonl"))
    run("import", typed=text)  # twice is once
    assert log.read(tmp_path / "elsewhere" / "history.db") == log.read(home)


@pytest.mark.parametrize("encoding", ["cp1252", "utf-8", "ascii"])
def test_what_goes_through_a_pipe_is_the_same_whatever_the_console_takes(
    home: Path, tmp_path: Path, encoding: str
) -> None:
    def piped(folder: Path, *arguments: str, typed: bytes = b"") -> bytes:
        return subprocess.run(
            [sys.executable, "-m", "rldrill", "history", *arguments], check=True, input=typed, stdout=subprocess.PIPE,
            env={**os.environ, "RLDRILL_HOME": str(folder), "PYTHONIOENCODING": encoding, "PYTHONPATH": str(ROOT)},
        ).stdout  # fmt: skip

    piped(tmp_path / "a", "import", typed=piped(home.parent, "export"))
    assert log.read(tmp_path / "a" / "history.db") == log.read(home)  # γ = ½
    run("export", str(tmp_path / "out.jsonl"))
    piped(tmp_path / "b", "import", typed=(tmp_path / "out.jsonl").read_bytes())
    assert log.read(tmp_path / "b" / "history.db") == log.read(home)


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_a_file_that_a_shell_has_written_is_read(home: Path, tmp_path: Path, encoding: str) -> None:
    text = run("export")
    run("forget", "--yes")
    (tmp_path / "out.jsonl").write_text(text, encoding=encoding)
    run("import", str(tmp_path / "out.jsonl"))
    assert log.read(home) == (FIRST, SECOND)


def test_what_is_no_text_is_not_read(home: Path, tmp_path: Path) -> None:
    (tmp_path / "out.jsonl").write_bytes(run("export").encode("cp1252", "backslashreplace"))
    with pytest.raises(FileError, match=r"out\.jsonl, line 1: this is not UTF-8 text"):
        run("import", str(tmp_path / "out.jsonl"))
    assert len(log.read(home)) == 2


def test_a_file_with_a_bad_line_is_not_read_at_all(home: Path, tmp_path: Path) -> None:
    file = tmp_path / "bad.jsonl"
    file.write_text(run("export").replace('"id": "1"', '"id": "3"') + "nonsense\n", encoding="utf-8")
    with pytest.raises(FileError, match=r"bad\.jsonl, line 3"):
        run("import", str(file))
    assert len(log.read(home)) == 2


def test_forgetting_asks_first(home: Path) -> None:
    run("forget", typed="n\n")
    assert len(log.read(home)) == 2
    run("forget", "bellman", typed="y\n")
    assert log.read(home) == (FIRST,)
    run("forget", "--yes")
    assert log.read(home) == ()


def test_a_broken_database_is_one_sentence(home: Path) -> None:
    home.write_bytes(b"nothing that a database would hold " * 9)
    with pytest.raises(HistoryError, match="not a database"):
        run("export")


def test_a_newer_history_is_not_written_out(home: Path) -> None:
    with sqlite3.connect(home) as database:
        database.execute("PRAGMA user_version = 99")
    database.close()
    with pytest.raises(HistoryError, match="newer"):
        run("export")
