"""The log on the disk: SQLite, one transaction for every answer, nothing ever changed."""

import json
import sqlite3
import time
from collections.abc import Iterable, Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from datetime import UTC
from itertools import chain
from pathlib import Path
from typing import Any

from msgspec import convert

from rldrill.history.attempts import NAMES, Attempt
from rldrill.history.place import HistoryError

#: What brings the database from one version to the next, statement by statement, for ``executescript`` would end the
#: transaction; the version is how many of these were run.
MIGRATIONS: tuple[tuple[str, ...], ...] = (
    (
        """
        CREATE TABLE attempt (
            id TEXT PRIMARY KEY, time TEXT NOT NULL, sitting TEXT NOT NULL, family TEXT NOT NULL,
            level INTEGER, seed INTEGER, revision INTEGER,
            part TEXT NOT NULL, parts INTEGER NOT NULL, typed TEXT NOT NULL,
            outcome TEXT NOT NULL, misconceptions TEXT NOT NULL, hints INTEGER NOT NULL, retries INTEGER NOT NULL,
            seconds REAL NOT NULL, credit REAL NOT NULL
        )
        """,
        "CREATE INDEX attempt_time ON attempt (time)",
        "CREATE TRIGGER nothing_changes BEFORE UPDATE ON attempt BEGIN SELECT RAISE(ABORT, 'the log only grows'); END",
    ),
)
#: How long to wait for another quiz that is just writing, in seconds.
_PATIENCE = 5.0
#: Where the header of a SQLite file holds our version.
_VERSION_IN_HEADER = slice(60, 64)
_INSERT = f"INSERT OR IGNORE INTO attempt ({', '.join(NAMES)}) VALUES ({', '.join('?' * len(NAMES))})"
_SELECT = f"SELECT {', '.join(NAMES)} FROM attempt ORDER BY time, rowid"


class BrokenRowError(HistoryError):
    """Another program wrote something into the database; answers can be written to it all the same."""


def read(path: Path) -> tuple[Attempt, ...]:
    """All attempts in the order of their times; none where there is no database yet.

    Raises:
        HistoryError: the database is of a newer version, or another program wrote something into it.
        sqlite3.Error: it cannot be read.
    """
    if not path.exists():
        return ()
    _refuse_newer(path)
    try:
        with _opened(path) as database:
            return _attempts(database, path)
    except sqlite3.OperationalError:  # a folder that cannot be written: read the file as it lies there
        with closing(sqlite3.connect(f"{path.as_uri()}?mode=ro&immutable=1", uri=True)) as database:
            return _attempts(database, path)


def append(path: Path, attempts: Iterable[Attempt]) -> int:
    """Write attempts in one transaction, all or none; those that are there already stay as they are.

    Returns:
        How many were new.

    Raises:
        HistoryError: the database is of a newer version.
        sqlite3.Error, OSError: it cannot be written.
    """
    with closing(Writer(path)) as writer:
        return writer.append(attempts)


class Writer:
    """The log, open for one answer after the other: to close it and open it again takes several times as long.

    Raises:
        HistoryError: the database is of a newer version.
        sqlite3.Error, OSError: it cannot be written.
    """

    def __init__(self, path: Path) -> None:
        path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        _refuse_newer(path)
        self._path = path
        self._open = ExitStack()
        self._database = self._open.enter_context(_opened(path))
        self._file = path.stat().st_ino

    @property
    def is_there(self) -> bool:
        """Whether the file is still the one that was opened, and not deleted or another."""
        return self._path.exists() and self._path.stat().st_ino == self._file

    def append(self, attempts: Iterable[Attempt]) -> int:
        """Write attempts in one transaction, as ``append`` does."""
        with _transaction(self._database):
            before = self._database.total_changes
            self._database.executemany(_INSERT, map(_row, attempts))
            return self._database.total_changes - before

    def close(self) -> None:
        """Tidy up; whatever was written is kept without that, too."""
        self._open.close()


def forget(path: Path, families: Sequence[str] = ()) -> int:
    """Delete the attempts at these families, or everything, copies of older versions too.

    Raises:
        HistoryError: the database is of a newer version.
        sqlite3.Error, OSError: it cannot be written.
    """
    if not path.exists():
        return 0
    _refuse_newer(path)
    with _opened(path) as database:
        database.execute("PRAGMA secure_delete = ON")
        with _transaction(database):
            if families:
                marks = ", ".join("?" * len(families))
                gone = database.execute(f"DELETE FROM attempt WHERE family IN ({marks})", families).rowcount
            else:
                gone = database.execute("DELETE FROM attempt").rowcount
        database.execute("VACUUM")
        database.execute("PRAGMA wal_checkpoint(TRUNCATE)")  # a quiz may have it open
    for copy in path.parent.glob(f"{path.name}.v*"):
        copy.unlink()
    return gone


def _refuse_newer(path: Path) -> None:
    """Look into the header before anything is opened: a newer database is not touched."""
    if not path.exists():
        return
    with path.open("rb") as file:
        header = file.read(100)
    if header.startswith(b"SQLite format 3"):
        _refuse_version(path, int.from_bytes(header[_VERSION_IN_HEADER], "big"))


def _refuse_version(path: Path, version: int) -> None:
    if version > len(MIGRATIONS):
        raise HistoryError(
            f"{path} was written by a newer rldrill (version {version}, this one reads {len(MIGRATIONS)}); "
            "it was left as it is. Install that rldrill again, or name another folder in RLDRILL_HOME."
        )


@contextmanager
def _opened(path: Path) -> Iterator[sqlite3.Connection]:
    """The database, brought to this version."""
    with closing(sqlite3.connect(path, timeout=_PATIENCE, isolation_level=None)) as database:
        _write_ahead(database)
        database.execute("PRAGMA synchronous = FULL")
        if _version(database) != len(MIGRATIONS):
            _migrate(database, path)
        yield database


def _write_ahead(database: sqlite3.Connection) -> None:
    """Switch to the write-ahead log; SQLite does not wait by itself where two do so at once."""
    deadline = time.monotonic() + _PATIENCE
    while True:
        try:
            if database.execute("PRAGMA journal_mode").fetchone()[0] != "wal":
                database.execute("PRAGMA journal_mode = WAL")
            return
        except sqlite3.OperationalError as error:
            if "locked" not in str(error) or time.monotonic() > deadline:
                raise
            time.sleep(0.01)


@contextmanager
def _transaction(database: sqlite3.Connection) -> Iterator[None]:
    database.execute("BEGIN IMMEDIATE")
    try:
        yield
    except BaseException:
        if database.in_transaction:  # a full disk has ended it already
            database.execute("ROLLBACK")
        raise
    database.execute("COMMIT")


def _version(database: sqlite3.Connection) -> int:
    return int(database.execute("PRAGMA user_version").fetchone()[0])


def _migrate(database: sqlite3.Connection, path: Path) -> None:
    """Run what is missing, in one transaction; an older database is copied first."""
    with _transaction(database):
        version = _version(database)  # another quiz may have done it while this one waited
        _refuse_version(path, version)
        if 0 < version < len(MIGRATIONS):
            copy = path.with_name(f"{path.name}.v{version}")
            with closing(sqlite3.connect(path)) as source, closing(sqlite3.connect(copy)) as target:
                source.backup(target)
        for statement in chain.from_iterable(MIGRATIONS[version:]):
            database.execute(statement)
        database.execute(f"PRAGMA user_version = {len(MIGRATIONS)}")


def _row(attempt: Attempt) -> tuple[Any, ...]:
    values = {name: getattr(attempt, name) for name in NAMES}
    values["time"] = attempt.time.astimezone(UTC).isoformat()
    values["misconceptions"] = json.dumps(attempt.misconceptions, ensure_ascii=False)
    # What no text holds (half a pair of surrogates, pasted) is not worth an answer.
    values["typed"] = attempt.typed.encode("utf-8", "replace").decode("utf-8")
    return tuple(values.values())


def _attempts(database: sqlite3.Connection, path: Path) -> tuple[Attempt, ...]:
    return tuple(_attempt(dict(zip(NAMES, row, strict=True)), path) for row in database.execute(_SELECT))


def _attempt(row: dict[str, Any], path: Path) -> Attempt:
    try:
        return convert(row | {"misconceptions": json.loads(row["misconceptions"])}, Attempt)
    except (ValueError, TypeError) as error:
        raise BrokenRowError(
            f"{path}: the answer {str(row['id'])[:40]!r} is not as rldrill wrote it ({error}); "
            "delete this row in SQLite, or move the file elsewhere, and a new one is begun."
        ) from None
