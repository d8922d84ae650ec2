"""An exam for Word: its Markdown, converted by pandoc where that is installed."""

import shutil
import subprocess
from pathlib import Path
from tempfile import TemporaryDirectory

from rldrill.exam.exam import Exam, Version
from rldrill.export.text import markdown_exam
from rldrill.problems.errors import UsageError

_SECONDS = 120


def docx_exam(exam: Exam, version: Version, *, practice: bool) -> bytes:
    """A version as a document of Word, with mathematics that Word can edit.

    Raises:
        UsageError: pandoc is not installed, refuses the text, or takes too long.
    """
    program = shutil.which("pandoc")
    if program is None:
        raise UsageError("Documents of Word are made by pandoc, which is not installed: see https://pandoc.org.")
    source = markdown_exam(exam, version, practice=practice)
    with TemporaryDirectory() as folder:
        path = Path(folder) / "exam.docx"
        run = [program, "--from=gfm", "--to=docx", f"--output={path}"]
        try:
            done = subprocess.run(run, input=source.encode(), capture_output=True, timeout=_SECONDS, check=False)
        except subprocess.TimeoutExpired:
            raise UsageError(f"pandoc is not done after {_SECONDS} seconds; ask for fewer problems.") from None
        if done.returncode or not path.exists():
            said = done.stderr.decode(errors="replace").strip().partition("\n")[0][:200]
            raise UsageError(f"pandoc refuses the text ({said}); a newer release of it may not.")
        return path.read_bytes()
