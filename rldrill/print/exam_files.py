"""The files of an exam: a worksheet and a key for every version, and the manifest."""

import errno
from collections.abc import Callable
from pathlib import Path

from rldrill.exam.exam import Exam
from rldrill.exam.manifest import is_manifest, manifest, written
from rldrill.print.files import write_bytes_atomically
from rldrill.print.key import key_source
from rldrill.print.paper import Paper, pdf
from rldrill.print.worksheet import worksheet_source
from rldrill.problems.errors import UsageError


def check_output(output: Path) -> None:
    """Refuse a path that a worksheet cannot be written to, before any work is done.

    Raises:
        UsageError: it is a folder, does not end in ``.pdf``, or a file that is no manifest is in the way.
        FileNotFoundError: its folder does not exist.
    """
    if output.is_dir():
        raise UsageError(f"{output} is a folder; give the name of a PDF file, such as {output / 'worksheet.pdf'}.")
    if output.suffix.lower() != ".pdf":
        raise UsageError(f"{output} does not end in .pdf; a worksheet is written as PDF.")
    if not output.parent.is_dir():
        raise FileNotFoundError(errno.ENOENT, "No such folder", str(output.parent))
    beside = output.with_suffix(".json")
    if beside.exists() and not is_manifest(beside):
        raise UsageError(f"{beside} would be overwritten, but is not a worksheet's manifest; choose another name.")


def write(exam: Exam, output: Path, paper: Paper, advance: Callable[[], None] | None = None) -> list[Path]:
    """Write every version, its key, and the manifest; nothing is written before all of it is typeset.

    Args:
        exam: the exam.
        output: ``FILE.pdf``; beside it come ``FILE-key.pdf`` and ``FILE.json``, and with several versions
            ``FILE-A.pdf``, ``FILE-A-key.pdf`` and so on in its place.
        paper: the paper.
        advance: called after each version.

    Returns:
        The files, in the order in which they were written.

    Raises:
        UsageError: the path does not fit.
        OSError: a file cannot be written; ``filename`` says which.
    """
    check_output(output)
    files: dict[Path, bytes] = {}
    for version in exam.versions:
        ending = f"-{version.code}" if len(exam.versions) > 1 else ""
        stem = f"{output.stem}{ending}"
        files[output.with_name(f"{stem}{output.suffix}")] = pdf(worksheet_source(exam, version, paper))
        files[output.with_name(f"{stem}-key{output.suffix}")] = pdf(key_source(exam, version, paper))
        if advance is not None:
            advance()
    data = written(manifest(exam))
    files[output.with_suffix(".json")] = data
    for path, content in files.items():
        write_bytes_atomically(path, content)
    return list(files)
