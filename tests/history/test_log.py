"""The log of answers: nothing is lost, nothing is changed, and nothing stops a quiz."""

import os
import signal
import sqlite3
import subprocess
import sys
import time
from contextlib import closing
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from msgspec.structs import replace

from rldrill.history import log
from rldrill.history.attempts import Attempt, from_lines, to_line
from rldrill.history.keeping import Keeper
from rldrill.history.place import HistoryError, history_file
from rldrill.problems.errors import FileError

ROOT = Path(__file__).parent.parent.parent
FIRST = Attempt(
    id="1", time=datetime(2026, 11, 25, 8, tzinfo=UTC), sitting="one", family="td-zero", level=1, seed=7, revision=1,
    part="a", parts=1, typed="34/5", outcome="right", misconceptions=(), hints=0, retries=0, seconds=40.5, credit=1.0,
)  # fmt: skip
SECOND = replace(
    FIRST,
    id="2",
    time=FIRST.time + timedelta(days=1),
    outcome="misconception",
    misconceptions=("forgot-γ",),
    credit=0.0,
)

#: Writes answer after answer, and says each as soon as it is written.
WRITER = """
import sys
from msgspec.structs import replace
from itertools import count
from pathlib import Path
sys.path.insert(0, {tests!r})
from rldrill.history import log
from rldrill.history.attempts import from_lines
(first,) = from_lines([sys.argv[2]], "")
kept = log.Writer(Path(sys.argv[1]))
for number in count() if sys.argv[4] == "endless" else range(int(sys.argv[4])):
    name = f"{{sys.argv[3]}}-{{number}}"
    kept.append([replace(first, id=name)])
    print(name, flush=True)
"""


def writer(path: Path, name: str, number: str) -> subprocess.Popen[str]:
    code = WRITER.format(tests=str(ROOT))
    return subprocess.Popen(
        [sys.executable, "-c", code, str(path), to_line(FIRST), name, number],
        stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONPATH": str(ROOT)},
    )  # fmt: skip


def test_what_is_written_is_read_again(tmp_path: Path) -> None:
    path = tmp_path / "deep" / "deeper" / "history.db"  # a fresh home has neither
    assert log.read(path) == ()
    assert log.append(path, [SECOND]) == 1
    assert log.append(path, [FIRST]) == 1
    assert log.read(path) == (FIRST, SECOND)  # by their times
    assert log.append(path, [FIRST, SECOND]) == 0  # what is there already counts once


def test_nothing_is_ever_changed(tmp_path: Path) -> None:
    path = tmp_path / "history.db"
    log.append(path, [FIRST])
    with sqlite3.connect(path) as database, pytest.raises(sqlite3.IntegrityError, match="only grows"):
        database.execute("UPDATE attempt SET credit = 1")


def test_lines_of_json_are_read_again() -> None:
    lines = [to_line(FIRST), "", to_line(SECOND)]
    assert list(from_lines(lines, "a file")) == [FIRST, SECOND]


@pytest.mark.parametrize(
    ("line", "fragment"),
    [
        ("{", "line 1"),
        ("[]", "an object"),
        ("{}", "'id' is missing"),
        (to_line(FIRST).replace('"credit"', '"credits"'), "'credits'"),
        (to_line(FIRST).replace('"level": 1', '"level": "1"'), "'level'"),
        (to_line(FIRST).replace("+00:00", ""), "time zone"),
        (to_line(FIRST).replace('"right"', '"splendid"'), "splendid"),
        (to_line(FIRST).replace("40.5", "NaN"), "'seconds' is a number from 0"),
        (to_line(FIRST).replace("40.5", "-5"), "'seconds' is a number from 0"),
        (to_line(FIRST).replace("40.5", "1" + 400 * "0"), "'seconds' is a number from 0"),
        (to_line(FIRST).replace('"credit": 1.0', '"credit": 7'), "'credit' is a number from 0 to 1"),
        (to_line(FIRST).replace('"parts": 1', '"parts": 0'), "'parts' is a whole number from 1"),
        (to_line(FIRST).replace('"level": 1', '"level": 99'), "'level' is a whole number from 1 to 3"),
        (to_line(FIRST).replace('"retries": 0', '"retries": -1'), "'retries' is a whole number from 0"),
        (to_line(FIRST).replace('"one"', '"\\ud800"'), "'sitting' is a text"),
        (to_line(FIRST).replace("[]", '["\\u001b[31mx"]'), "'misconceptions' is a list of texts"),
        (to_line(FIRST).replace("2026-11-25", "9999-12-31"), "'time' is in a year from 1970 to 2199"),
        (to_line(FIRST).replace("2026-11-25T08:00:00+00:00", "0001-01-01T00:00:00+14:00"), "line 1"),
    ],
)
def test_a_line_that_is_no_attempt_is_named(line: str, fragment: str) -> None:
    with pytest.raises(FileError, match=fragment):
        list(from_lines([line], "a file"))


def test_forgetting_takes_one_family_or_all_and_leaves_no_trace(tmp_path: Path) -> None:
    path = tmp_path / "history.db"
    log.append(path, [FIRST, replace(SECOND, family="sarsa", typed="a very private answer")])
    (tmp_path / "history.db.v0").touch()
    assert log.forget(path, ["sarsa"]) == 1
    assert log.read(path) == (FIRST,)
    assert log.forget(path) == 1
    assert log.read(path) == ()
    assert not any(b"private" in file.read_bytes() for file in tmp_path.iterdir())
    assert not (tmp_path / "history.db.v0").exists()


def test_forgetting_leaves_no_trace_where_a_quiz_has_the_log_open_either(tmp_path: Path) -> None:
    path = tmp_path / "history.db"
    with closing(log.Writer(path)) as quiz:
        quiz.append([replace(FIRST, typed="a very private answer")])
        assert log.forget(path) == 1
        assert not any(b"private" in file.read_bytes() for file in tmp_path.iterdir())
        quiz.append([SECOND])
    assert log.read(path) == (SECOND,)


def test_a_log_that_is_deleted_in_the_middle_of_a_quiz_is_begun_again(tmp_path: Path) -> None:
    path, said = tmp_path / "history.db", list[str]()
    with closing(Keeper(said.append, lambda: path)) as keeper:
        keeper.keep(FIRST)
        for file in tmp_path.iterdir():
            file.unlink()
        keeper.keep(SECOND)
    assert log.read(path) == (SECOND,)
    assert said == []


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL")
def test_no_answer_is_lost_when_the_process_is_killed(tmp_path: Path) -> None:
    path = tmp_path / "history.db"
    told: set[str] = set()
    rounds = int(os.environ.get("KILLS", "20"))
    for number in range(rounds):
        process = writer(path, str(number), "endless")
        assert process.stdout is not None
        told.add(process.stdout.readline().strip())
        time.sleep(0.013 * (number % 7))
        process.send_signal(signal.SIGKILL)
        told |= {line.strip() for line in process.stdout if line.endswith("\n")}
        process.wait()
        assert told <= {attempt.id for attempt in log.read(path)}
    assert len(told) >= rounds


def test_two_at_once_write_all(tmp_path: Path) -> None:
    path = tmp_path / "new" / "history.db"
    both = [writer(path, name, "20") for name in "ab"]
    assert [process.wait(60) for process in both] == [0, 0]
    for process in both:
        assert process.stdout is not None
        process.stdout.close()
    assert {attempt.id for attempt in log.read(path)} == {f"{name}-{number}" for name in "ab" for number in range(20)}


def test_an_older_version_is_copied_and_brought_up_to_date(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "history.db"
    log.append(path, [FIRST])
    monkeypatch.setattr(log, "MIGRATIONS", (*log.MIGRATIONS, ("CREATE TABLE another (id TEXT)",)))
    assert log.read(path) == (FIRST,)
    with sqlite3.connect(path) as new, sqlite3.connect(tmp_path / "history.db.v1") as old:
        assert new.execute("PRAGMA user_version").fetchone() == (2,)
        assert old.execute("PRAGMA user_version").fetchone() == (1,)
        assert old.execute("SELECT id FROM attempt").fetchall() == [("1",)]


def test_a_new_log_has_no_older_version_to_copy(tmp_path: Path) -> None:
    log.append(tmp_path / "history.db", [FIRST])
    assert not [*tmp_path.glob("*.v*")]


def test_a_migration_that_fails_changes_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "history.db"
    log.append(path, [FIRST])
    before = log.MIGRATIONS
    monkeypatch.setattr(log, "MIGRATIONS", (*before, ("DELETE FROM attempt", "DROP TABLE nowhere")))
    with pytest.raises(sqlite3.OperationalError):
        log.append(path, [SECOND])
    monkeypatch.setattr(log, "MIGRATIONS", before)
    assert log.read(path) == (FIRST,)


def test_a_newer_version_is_refused_and_not_touched(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "history.db"
    with monkeypatch.context() as newer:
        newer.setattr(log, "MIGRATIONS", (*log.MIGRATIONS, ("CREATE TABLE another (id TEXT)",)))
        log.append(path, [FIRST])
    before = {file.name: (file.read_bytes(), file.stat().st_mtime_ns) for file in tmp_path.iterdir()}
    for use in (log.read, log.forget, lambda path: log.append(path, [SECOND])):
        with pytest.raises(HistoryError, match="newer rldrill"):
            use(path)
    assert {file.name: (file.read_bytes(), file.stat().st_mtime_ns) for file in tmp_path.iterdir()} == before


def test_a_quiz_that_cannot_write_says_so_once_and_goes_on(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    said: list[str] = []
    keeper = Keeper(said.append, lambda: tmp_path / "file" / "history.db")  # a file is no folder
    assert keeper.read() == ()
    keeper.keep(FIRST)
    keeper.keep(SECOND)
    assert len(said) == 1
    assert said[0].startswith(f"Your answers are not kept: {tmp_path / 'file'}")


def test_a_file_that_is_no_database_is_told_and_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "history.db"
    path.write_text("my shopping list, which is much longer than the header of a database " * 3)
    before = path.read_bytes()
    said: list[str] = []
    keeper = Keeper(said.append, lambda: path)
    keeper.keep(FIRST)
    assert len(said) == 1
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    "values", ["misconceptions = 'x'", "misconceptions = '[1]'", "time = 'noon'", "time = '2026-11-25'", "level = 'x'"]
)
def test_a_row_that_another_program_wrote_is_named_and_a_quiz_goes_on(tmp_path: Path, values: str) -> None:
    path = tmp_path / "history.db"
    log.append(path, [FIRST])
    with closing(sqlite3.connect(path)) as database:
        database.execute("DROP TRIGGER nothing_changes")
        database.execute(f"UPDATE attempt SET {values}")
        database.commit()
    with pytest.raises(HistoryError, match=r"history\.db: the answer '1' is not as rldrill wrote it"):
        log.read(path)
    said: list[str] = []
    keeper = Keeper(said.append, lambda: path)
    assert keeper.read() == ()
    keeper.keep(SECOND)
    keeper.close()
    assert len(said) == 1
    with closing(sqlite3.connect(path)) as database:
        assert database.execute("SELECT count(*) FROM attempt").fetchone() == (2,)


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_that_cannot_be_written_is_still_read(tmp_path: Path) -> None:
    path = tmp_path / "history.db"
    log.append(path, [FIRST])
    tmp_path.chmod(0o500)
    said: list[str] = []
    keeper = Keeper(said.append, lambda: path)
    try:
        assert keeper.read() == (FIRST,)
        keeper.keep(SECOND)
    finally:
        tmp_path.chmod(0o700)
    assert len(said) == 1


def test_what_a_full_disk_refused_is_written_with_the_next_answer(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "history.db"
    said: list[str] = []
    keeper = Keeper(said.append, lambda: path)
    with monkeypatch.context() as full:
        full.setattr(log, "_INSERT", log._INSERT.replace("VALUES", "SELECT * FROM full_disk; --"))
        keeper.keep(FIRST)
    assert log.read(path) == ()
    keeper.keep(SECOND)
    assert log.read(path) == (FIRST, SECOND)
    assert len(said) == 1


def test_a_disk_that_is_full_leaves_what_was_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "history.db"
    log.append(path, [FIRST])
    opened = sqlite3.connect

    def small(*arguments: object, **options: object) -> sqlite3.Connection:
        database = opened(*arguments, **options)  # type: ignore[call-overload]
        pages = database.execute("PRAGMA page_count").fetchone()[0]
        database.execute(f"PRAGMA max_page_count = {pages}")
        return database

    said: list[str] = []
    with monkeypatch.context() as full:
        full.setattr(sqlite3, "connect", small)
        Keeper(said.append, lambda: path).keep(replace(SECOND, typed="9" * 100_000))
    assert said == ["Your answers are not kept: database or disk is full."]
    assert log.read(path) == (FIRST,)


@pytest.mark.skipif(sys.platform == "win32", reason="no limits")
def test_a_file_that_may_not_grow_is_told_once_and_keeps_what_it_has(tmp_path: Path) -> None:
    path = tmp_path / "history.db"
    log.append(path, [FIRST])
    size = path.stat().st_size
    code = f"""
import resource, sys
from pathlib import Path
from rldrill.history.attempts import from_lines
from rldrill.history.keeping import Keeper
resource.setrlimit(resource.RLIMIT_FSIZE, ({size}, {size}))
keeper = Keeper(print, lambda: Path(sys.argv[1]))
for attempt in from_lines(sys.argv[2:], ""):
    keeper.keep(attempt)
"""
    long = [to_line(replace(SECOND, id=name, typed="9" * 30_000)) for name in "xy"]
    ran = subprocess.run(
        [sys.executable, "-c", code, str(path), *long], capture_output=True, text=True, check=True,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )  # fmt: skip
    assert ran.stdout.splitlines() == ["Your answers are not kept: disk I/O error."]
    assert log.read(path) == (FIRST,)


def test_the_folder_is_the_one_that_is_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("RLDRILL_HOME", str(tmp_path))
    assert history_file() == tmp_path / "history.db"
    monkeypatch.setenv("RLDRILL_HOME", "relative")
    assert history_file().is_absolute()


def test_without_a_home_there_is_no_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("RLDRILL_HOME", raising=False)
    monkeypatch.setattr("platformdirs.user_data_path", lambda *_, **__: Path("~/.local/share/rldrill"))
    with pytest.raises(HistoryError, match="no home"):
        history_file()
