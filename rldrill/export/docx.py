"""An exam for Word: its Markdown, converted by pandoc, the computer's own or the one that pypandoc brings along."""

import hashlib
import os
import re
import shutil
import subprocess
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from rldrill.exam.exam import Exam, Version
from rldrill.export.text import BELOW, markdown_exam
from rldrill.print.paper import png_of_svg
from rldrill.problems.errors import UsageError
from rldrill.problems.pictures import Picture, Timeline
from rldrill.render.markdown import markdown, markdown_plain
from rldrill.render.mathematics.spacing import parted
from rldrill.render.pictures.described import described
from rldrill.render.pictures.svg import svg

_SECONDS = 120
#: How wide a picture is on the screen.
_WIDTH = re.compile(r' width="(\d+)"')
#: A document tells when it was written; the same exam shall be the same document. No zip file is older than that.
_WRITTEN = {"SOURCE_DATE_EPOCH": "315532800"}


def docx_exam(exam: Exam, version: Version, *, practice: bool) -> bytes:
    """A version as a document of Word, with mathematics that Word can edit.

    Raises:
        UsageError: pandoc is not installed, refuses the text, or takes too long.
    """
    program = shutil.which("pandoc") or _brought_along()
    if program is None:
        raise UsageError(
            "Documents of Word are made by pandoc, which is not installed; get it with pip install 'rldrill[docx]', or "
            "from https://pandoc.org."
        )
    with TemporaryDirectory() as folder:
        drawn = partial(_drawn, Path(folder))
        written = partial(markdown, drawn=drawn)
        source = _together(markdown_exam(exam, version, practice=practice, answers=BELOW, written=written))
        path = Path(folder) / "exam.docx"
        # The first heading becomes the title, as Word knows it, and those of the problems the first of all.
        told = ["--shift-heading-level-by=-1", f"--metadata=lang:{exam.head.language}"]
        run = [program, "--from=gfm+attributes", "--to=docx", *told, f"--output={path}"]
        try:
            done = subprocess.run(
                run,
                input=source.encode(),
                cwd=folder,
                env=os.environ | _WRITTEN,
                capture_output=True,
                timeout=_SECONDS,
                check=False,
            )
        except subprocess.TimeoutExpired:
            raise UsageError(f"pandoc is not done after {_SECONDS} seconds; ask for fewer problems.") from None
        if done.returncode or not path.exists():
            said = done.stderr.decode(errors="replace").strip().partition("\n")[0][:200]
            raise UsageError(f"pandoc refuses the text ({said}); a newer release of it may not.")
        return path.read_bytes()


def _together(text: str) -> str:
    """The text with hyphens that end no line, where none may end: in Q-learning."""
    return "".join(piece.replace("-", "\u2011") if whole else piece for piece, whole in parted(text))


def _drawn(folder: Path, picture: Picture) -> str:
    """A picture as a file in the folder; a row of texts, and what cannot be drawn readably, with signs."""
    drawing = "" if isinstance(picture, Timeline) else svg(picture)
    if not drawing:
        return markdown([picture])
    name = f"{hashlib.sha256(drawing.encode()).hexdigest()}.png"
    (folder / name).write_bytes(png_of_svg(drawing.encode()))
    (width,) = _WIDTH.findall(drawing)[:1]
    return f"![{markdown_plain(described(picture))}]({name}){{width={width}px}}"


def _brought_along() -> str | None:
    try:
        from pypandoc import get_pandoc_path

        return str(get_pandoc_path())
    except (ImportError, OSError):
        return None
