"""Paper: the page set-up that all PDFs share, their compilation, and files written whole or not at all."""

import os
import tempfile
from dataclasses import dataclass
from pathlib import Path

from rldrill.problems.errors import UsageError
from rldrill.render.typst import PREAMBLE, text

#: Every PDF carries this time, so that the same arguments give the same bytes.
_TIMESTAMP = 0


@dataclass(frozen=True, slots=True)
class Paper:
    """A paper size by its name on the command line, with Typst's name for it."""

    name: str
    typst: str


PAPERS = {"a4": Paper("a4", "a4"), "letter": Paper("letter", "us-letter")}


def paper_of(name: str) -> Paper:
    """The paper of that name.

    Raises:
        UsageError: there is none.
    """
    paper = PAPERS.get(name.strip().lower())
    if paper is None:
        raise UsageError(f"There is no paper {name[:20]!r}; choose {' or '.join(PAPERS)}.")
    return paper


def page_setup(
    paper: Paper,
    *,
    title: str,
    left: str,
    right: str,
    margin: str = "2cm",
    size: str = "10.5pt",
    columns: int = 1,
) -> str:
    """What stands at the head of every Typst source.

    Args:
        paper: the paper.
        title: the title in the PDF's properties.
        left: the text at the head of every page, left.
        right: the text at the head of every page, right.
        margin: the margin on all sides, or Typst's dictionary of margins.
        size: the size of the type.
        columns: how many columns a page has.
    """
    return f"""#set document(title: [{text(title)}], date: none)
#set text(font: "New Computer Modern", size: {size}, lang: "en")
#set page(
  paper: "{paper.typst}", margin: {margin}, columns: {columns}, header-ascent: 35%, footer-descent: 35%,
  header: text(0.8em, luma(90))[{text(left)} #h(1fr) {text(right)}],
  footer: context text(0.8em, luma(90))[#h(1fr) #counter(page).display("1 / 1", both: true) #h(1fr)],
)
#set par(leading: 0.6em, spacing: 0.9em)
#set block(spacing: 0.9em)
#set math.mat(row-gap: 0.4em, column-gap: 0.8em)
{PREAMBLE}"""


def pdf(source: str) -> bytes:
    """Typeset a Typst source; the same source gives the same bytes in every process.

    Raises:
        RuntimeError: Typst cannot compile the source.
    """
    import typst

    result: bytes = typst.compile(source.encode(), ignore_system_fonts=True, timestamp=_TIMESTAMP)
    return result


def write_bytes_atomically(path: Path, data: bytes) -> None:
    """Write a file whole or not at all; what stood there before stays until the new file is complete.

    Raises:
        OSError: the folder is missing or cannot be written to, or the disk is full; ``filename`` is set.
    """
    temporary: str | None = None
    try:
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name[:40]}.")
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        Path(temporary).chmod(_file_mode(path))
        Path(temporary).replace(path)
    except OSError as error:
        if temporary is not None:
            Path(temporary).unlink(missing_ok=True)
        raise OSError(error.errno, error.strerror or str(error), str(path)) from error


def _file_mode(path: Path) -> int:
    """The rights of the file that is replaced, or those that a new file gets."""
    if path.exists():
        return path.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
