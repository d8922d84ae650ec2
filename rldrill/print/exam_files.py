"""The files of an exam: a worksheet and a key for every version, the manifest, and all of a roster in one."""

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from msgspec import Struct
from msgspec.structs import replace

from rldrill.exam.exam import Layout
from rldrill.exam.manifest import codes, is_manifest, read_exam
from rldrill.print.bundle import bundled
from rldrill.print.typesetting import Task, typeset
from rldrill.problems.errors import FileError, UsageError
from rldrill.writing import write_bytes_atomically

_TOLD = 4


class Files(Struct, frozen=True):
    """Which files an exam has, by the name of the first.

    Args:
        output: ``FILE.pdf``; beside it come ``FILE-key.pdf`` and ``FILE.json``, and with several versions
            ``FILE-A.pdf``, ``FILE-A-key.pdf`` and so on in its place.
        codes: the codes of the versions.
        layout: which keys there are.
        personal: whether there is a roster, so that ``FILE.pdf`` holds all versions.
        only_keys: whether nothing but the keys is printed.
    """

    output: Path
    codes: tuple[str, ...]
    layout: Layout
    personal: bool = False
    only_keys: bool = False

    @property
    def manifest(self) -> Path:
        """Where the manifest is."""
        return self.output.with_suffix(".json")

    @property
    def bundle(self) -> Path | None:
        """Where all versions stand one after the other, for a roster."""
        return self.output if self.personal and not self.only_keys else None

    def worksheet(self, code: str) -> Path | None:
        """Where the worksheet of a version is."""
        return None if self.only_keys else self._path(code, "")

    def key(self, code: str) -> Path | None:
        """Where the key of a version is."""
        return self._path(code, "-key") if self.layout.solutions == "separate" or self.only_keys else None

    def _path(self, code: str, ending: str) -> Path:
        version = f"-{code}" if len(self.codes) > 1 or self.personal else ""
        return self.output.with_name(f"{self.output.stem}{version}{ending}{self.output.suffix}")

    def pdfs(self) -> list[Path]:
        """All PDFs in their order."""
        found = [path for code in self.codes for path in (self.worksheet(code), self.key(code)) if path is not None]
        return found if self.bundle is None else [*found, self.bundle]

    def printed(self) -> list[Path]:
        """Those that are there."""
        return [path for path in self.pdfs() if path.exists()]


def check_output(output: Path) -> None:
    """Refuse a path that a worksheet cannot be written to, before any work is done.

    Raises:
        UsageError: it is a folder, does not end in ``.pdf``, or a file that is no manifest is in the way.
    """
    if output.is_dir():
        raise UsageError(f"{output} is a folder; give the name of a PDF file, such as {output / 'worksheet.pdf'}.")
    if output.suffix.lower() != ".pdf":
        raise UsageError(f"{output} does not end in .pdf; a worksheet is written as PDF.")
    beside = output.with_suffix(".json")
    if beside.exists() and not is_manifest(beside):
        raise UsageError(f"{beside} would be overwritten, but is not a worksheet's manifest; choose another name.")


def earlier(files: Files) -> list[Path]:
    """What an earlier run has left: its files by these names, and those of versions that there are no more."""
    names = [files.manifest, *files.pdfs()]
    if is_manifest(files.manifest):
        try:
            old = codes(files.manifest)
        except FileError:
            old = ()
        for personal in (False, True):
            names += Files(files.output, old, Layout(), personal).pdfs()
    return [path for path in dict.fromkeys(names) if path.exists()]


def make_room(found: Sequence[Path], *, force: bool) -> None:
    """Take away what an earlier run has left, if that is wanted.

    Raises:
        UsageError: something is there, and it is not to be replaced.
        OSError: a file cannot be removed.
    """
    if found and not force:
        told = ", ".join(path.name for path in found[:_TOLD])
        more = f" and {len(found) - _TOLD} more" if len(found) > _TOLD else ""
        raise UsageError(
            f"An earlier worksheet is there ({told}{more}); --force removes it and writes the new one, "
            "or choose another name with -o."
        )
    for path in found:
        path.unlink()


def write(files: Files, manifest: bytes, advance: Callable[[], None] = lambda: None) -> Iterator[Path]:
    """Write the manifest, then version after version whatever is not there yet, each file whole or not at all.

    So a run that was ended goes on where it was.

    Args:
        files: the files.
        manifest: what the manifest holds.
        advance: called after each version, also one that was there already.

    Raises:
        OSError: a file cannot be written; ``filename`` says which.
    """
    if not files.manifest.exists():
        write_bytes_atomically(files.manifest, manifest)
    yield from print_from(files.manifest, files, advance)
    yield files.manifest


def print_from(manifest: Path, files: Files, advance: Callable[[], None]) -> Iterator[Path]:
    """Print an exam from its manifest: whatever is not there yet.

    Raises:
        FileError: the manifest is damaged.
        OSError: a file cannot be written; ``filename`` says which.
    """
    waiting = _waiting(manifest, files)
    some = bool(waiting)
    for _ in range(len(files.codes) - len(waiting)):
        advance()
    for written in typeset(waiting):
        advance()
        yield from written
    if files.bundle is not None and (some or not files.bundle.exists()):
        worksheets = map(files.worksheet, files.codes)
        write_bytes_atomically(files.bundle, bundled([path for path in worksheets if path is not None]))
        yield files.bundle


def _waiting(manifest: Path, files: Files) -> deque[Task]:
    exam, makes = read_exam(manifest)
    exam = replace(exam, layout=files.layout)
    tasks = (
        Task(exam, make, _missing(files.worksheet(code)), _missing(files.key(code)))
        for code, make in zip(files.codes, makes, strict=True)
    )
    return deque(task for task in tasks if task.worksheet or task.key)


def _missing(path: Path | None) -> Path | None:
    return None if path is None or path.exists() else path
