"""Keeping answers as long as the disk lets us: a quiz goes on without its history, and says so once."""

import sqlite3
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from rldrill.history import log
from rldrill.history.attempts import Attempt
from rldrill.history.place import HistoryError, history_file

_TROUBLE = (sqlite3.Error, OSError, HistoryError)


class Keeper:
    """Writes every answer as soon as it is given.

    Args:
        say: what tells the person that answers are not kept, and why.
        where: names the database; it may fail, as for a user without a home.

    Attributes:
        trouble: whether the history could not be read or written.
    """

    def __init__(self, say: Callable[[str], None], where: Callable[[], Path] = history_file) -> None:
        self._say = say
        self._where = where
        self._waiting: list[Attempt] = []
        self.trouble = False
        self._writer: log.Writer | None = None

    def read(self) -> tuple[Attempt, ...]:
        """What was answered so far; nothing where that cannot be read."""
        try:
            return log.read(self._where())
        except log.BrokenRowError as error:
            self._say(f"What you answered before is left out: {error}")
            return ()
        except _TROUBLE as error:
            self._tell(error)
            return ()

    def keep(self, attempt: Attempt) -> None:
        """Write an answer, with those before that could not be written."""
        self._waiting.append(attempt)
        try:
            if self._writer is None or not self._writer.is_there:
                self.close()
                self._writer = log.Writer(self._where())
            self._writer.append(self._waiting)
        except _TROUBLE as error:
            self.close()
            self._tell(error)
        else:
            self._waiting = []

    def close(self) -> None:
        """No more answers come for now."""
        writer, self._writer = self._writer, None
        if writer is not None:
            with suppress(*_TROUBLE):
                writer.close()

    def _tell(self, error: Exception) -> None:
        if not self.trouble:
            self.trouble = True
            why = str(error)
            if isinstance(error, OSError) and error.strerror:
                why = f"{error.filename}: {error.strerror.lower()}" if error.filename else error.strerror
            self._say(f"Your answers are not kept: {why.rstrip('.')}.")
