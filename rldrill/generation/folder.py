"""A folder of problems in bulk: a file for every lot, written whole or not at all, so that a run can go on."""

import json
import os
from collections.abc import Callable, Iterable
from itertools import islice
from pathlib import Path
from typing import Any

from rldrill import __version__
from rldrill.generation.lots import Lot
from rldrill.problems.errors import FileError, UsageError
from rldrill.writing import begin, whole

_ABOUT = "generate.json"
#: Rows that Parquet keeps together.
_ROWS = 2000


def seed_of(path: Path) -> int | None:
    """The seed of the run that has begun a folder; None where none has."""
    try:
        about = json.loads((path / _ABOUT).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    seed = about.get("seed") if isinstance(about, dict) else None
    return seed if type(seed) is int and seed >= 0 else None


class Folder:
    """Where the lots of one run are written.

    Args:
        path: the folder; it is made.
        ending: ``jsonl`` or ``parquet``.
        about: the arguments of the run; a folder that was begun with others is refused.

    Raises:
        UsageError: it holds something else, or Parquet is asked for and pyarrow is not installed.
        FileError: what it says of itself cannot be read.
        OSError: it cannot be made.
    """

    def __init__(self, path: Path, ending: str, about: dict[str, Any]) -> None:
        self._path, self._ending = path, ending
        if ending == "parquet":
            _pyarrow()
        if path.exists() and not path.is_dir():
            raise UsageError(f"{path} is no folder; give the name of one, such as problems/.")
        path.mkdir(parents=True, exist_ok=True)
        own = path / _ABOUT
        told = json.dumps({"rldrill": __version__, **about}, indent=1) + "\n"
        if _holds_others(path) and not own.exists():  # another shard writes it before its lots
            raise UsageError(f"{path} holds other files already; take an empty folder, or a new one.")
        if begin(own, told.encode()):
            return
        try:
            same = json.loads(own.read_text(encoding="utf-8")) == json.loads(told)
        except ValueError:
            raise FileError(f"{own} is not what rldrill wrote there; take another folder.") from None
        if not same:
            raise UsageError(f"{path} was begun with other arguments ({own} has them); take another folder.")

    def has(self, lot: Lot) -> bool:
        """Whether a lot was written already."""
        return self._file(lot).exists()

    def write(self, lot: Lot, lines: Iterable[str]) -> int:
        """Write a lot; the file appears when it is complete.

        Returns:
            How many problems it has.

        Raises:
            OSError: it cannot be written; ``filename`` says which.
        """
        with whole(self._file(lot)) as unfinished:
            return _WRITERS[self._ending](unfinished, lines)

    def _file(self, lot: Lot) -> Path:
        return self._path / f"{lot.name}.{self._ending}"


def _holds_others(folder: Path) -> bool:
    """Whether there are files that are not of rldrill's beginning; what is hidden, and may be unfinished, is none."""
    return any(not path.name.startswith(".") and path.name != _ABOUT for path in folder.iterdir())


def _jsonl(path: Path, lines: Iterable[str]) -> int:
    number = 0
    with path.open("w", encoding="utf-8") as file:
        for number, line in enumerate(lines, 1):  # noqa: B007 (the last number is how many there are)
            file.write(line + "\n")
        file.flush()
        os.fsync(file.fileno())
    return number


def _parquet(path: Path, lines: Iterable[str]) -> int:
    """Columns to select by, the question and the answers as text, and the whole record as JSON."""
    pyarrow, parquet = _pyarrow()
    names = ("id", "family", "level", "question", "answers", "record")
    schema = pyarrow.schema([(name, pyarrow.int8() if name == "level" else pyarrow.string()) for name in names])
    number = 0
    with parquet.ParquetWriter(path, schema) as writer:
        rows_of = map(_row, lines)
        while rows := list(islice(rows_of, _ROWS)):
            number += len(rows)
            writer.write_table(pyarrow.Table.from_pylist(rows, schema=schema))
    return number


def _row(line: str) -> dict[str, Any]:
    data = json.loads(line)
    question = data["question"] if isinstance(data["question"], str) else "\n\n".join(data["question"])
    asked = (f"({part['part']}) {part['ask']}" for part in data["parts"])
    answers = {part["part"]: part["answer"] for part in data["parts"] if "answer" in part}
    return {
        "id": data["id"],
        "family": data["family"],
        "level": data["level"],
        "question": "\n\n".join((question, *asked)),
        "answers": json.dumps(answers, ensure_ascii=False),
        "record": line,
    }


def _pyarrow() -> tuple[Any, Any]:
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError:
        raise UsageError("Parquet needs pyarrow; install rldrill[parquet], or take --format jsonl.") from None
    return pyarrow, parquet


_WRITERS: dict[str, Callable[[Path, Iterable[str]], int]] = {"jsonl": _jsonl, "parquet": _parquet}
