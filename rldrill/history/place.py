"""Where the history lies."""

import os
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rldrill.problems.errors import UserError

#: The variable that names another folder.
VARIABLE = "RLDRILL_HOME"


class HistoryError(UserError):
    """The history cannot be read or written (exit code 3)."""

    exit_code = 3


@contextmanager
def told(path: Path) -> Iterator[None]:
    """What SQLite says of a database becomes a sentence that names it.

    Raises:
        HistoryError: the database cannot be read or written.
    """
    try:
        yield
    except sqlite3.Error as error:
        broken = any(said in str(error) for said in ("not a database", "malformed"))
        raise HistoryError(
            f"{path}: {error}{'; move it elsewhere, and a new one is begun' if broken else ''}."
        ) from None


def history_file() -> Path:
    """The database: in the folder that ``RLDRILL_HOME`` names, else where the system keeps a user's data.

    Raises:
        HistoryError: there is no such folder, as for a user without a home.
    """
    if named := os.environ.get(VARIABLE):
        return Path(named).absolute() / "history.db"
    from platformdirs import user_data_path

    try:
        folder = user_data_path("rldrill", appauthor=False)
    except (RuntimeError, OSError, KeyError):
        folder = Path()
    if not folder.is_absolute():
        raise HistoryError(f"There is no home folder; {VARIABLE} may name a folder for the history.")
    return folder / "history.db"
