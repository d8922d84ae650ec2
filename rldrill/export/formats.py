"""Which formats an exam is written in, and by what endings they are known."""

from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path

from msgspec import Struct

from rldrill.exam.exam import Exam, Version
from rldrill.exam.manifest import is_manifest
from rldrill.problems.errors import UsageError
from rldrill.problems.notations import used
from rldrill.writing import write_bytes_atomically


class Format(Struct, frozen=True):
    """A format of files.

    Args:
        name: what it is called on the command line.
        ending: of its files.
        writer: the module of this package and the function in it that writes a version, or the exam, as bytes or text.
        whole: whether one file holds all versions; else each has one of its own.
        by_box: the program that reads it, if it can give points box by box alone.
    """

    name: str
    ending: str
    writer: tuple[str, str]
    whole: bool = False
    by_box: str = ""


FORMATS = {
    each.name: each
    for each in (
        Format("html", ".html", ("html", "html_exam")),
        Format("moodle", ".xml", ("moodle", "moodle_exam"), whole=True, by_box="Moodle"),
        Format("qti", ".zip", ("qti", "qti_exam"), whole=True),
        Format("canvas", ".zip", ("canvas", "canvas_exam"), whole=True, by_box="Canvas"),
        Format("anki", ".apkg", ("anki", "anki_exam"), whole=True),
        Format("latex", ".tex", ("latex", "latex_exam")),
        Format("markdown", ".md", ("text", "markdown_exam")),
        Format("docx", ".docx", ("docx", "docx_exam")),
        Format("json", ".json", ("text", "json_exam"), whole=True),
    )
}


def format_of(path: Path | None, name: str | None = None) -> Format | None:
    """The format of that name, or the one that the file's ending tells; None for a PDF, which is printed.

    Raises:
        UsageError: there is no such format, or the file's name ends as those of none.
    """
    if name is None:
        if path is None or path.is_dir():
            return None
        endings = {".pdf": None, **{each.ending: each for each in reversed(FORMATS.values())}}
        if path.suffix.lower() not in endings:
            raise UsageError(f"{path} has the ending of no format; give it one of {', '.join(endings)}.")
        return endings[path.suffix.lower()]
    wanted = name.strip().lower()
    if wanted == "pdf":
        return None
    if wanted not in FORMATS:
        raise UsageError(f"There is no format {name[:40]!r}; there are pdf, {', '.join(FORMATS)}.")
    return FORMATS[wanted]


def named(path: Path, format_: Format) -> Path:
    """The path with the ending that the format has."""
    if path.name.lower().endswith(format_.ending):
        return path
    return path.with_name(path.stem + format_.ending)


def export(
    exam: Exam, path: Path, format_: Format, *, practice: bool, advance: Callable[[], None] = lambda: None
) -> Iterator[Path]:
    """Write an exam in a format, each file whole or not at all.

    Args:
        exam: the exam.
        path: the file; where each version has one of its own, its code is put before the ending.
        format_: the format.
        practice: whether it is for practice, with answers, hints and working; else for an exam.
        advance: called after each version.

    Raises:
        OSError: a file cannot be written; ``filename`` says which.
        UsageError: a package that the format needs is not installed.
    """
    module, function = format_.writer
    write: Callable[..., str | bytes] = getattr(import_module(f"rldrill.export.{module}"), function)
    if format_.whole:
        with used(exam.layout.notation, exam.head.decimal_mark):
            content = write(exam, practice=practice, advance=advance)
        write_bytes_atomically(path, _bytes(content))
        yield path
        return
    for version in exam.versions:
        target = version_path(exam, path, format_, version)
        with used(exam.layout.notation, exam.head.decimal_mark):
            content = write(exam, version, practice=practice)
        write_bytes_atomically(target, _bytes(content))
        advance()
        yield target


def check(exam: Exam, path: Path, format_: Format, *, force: bool) -> None:
    """Refuse to write where something is already.

    Raises:
        UsageError: so it is, and it is not to be replaced; or it is the manifest of an exam.
    """
    there = [target for version in exam.versions if (target := version_path(exam, path, format_, version)).exists()]
    if there and is_manifest(there[0]):
        raise UsageError(
            f"{there[0]} is the manifest of an exam, without which it can be neither printed again nor graded; choose "
            "another name with -o."
        )
    if there and not force:
        raise UsageError(f"{there[0]} is there already; --force replaces it, or choose another name with -o.")


def says_what_is_lost(exam: Exam, format_: Format) -> str:
    """Where a program gives points that the exam does not: a sentence, or nothing."""
    from rldrill.export.asked import all_or_nothing, cells

    several = (
        part.label in all_or_nothing(exam, version, index) and len(cells(exercise, part)) > 1
        for version in exam.versions
        for index, exercise in enumerate(version.exercises)
        for part in exercise.parts
    )
    if not format_.by_box or not any(several):
        return ""
    return f'{format_.by_box} marks box by box: parts with partial = "all" earn a share there for what is right in them'


def version_path(exam: Exam, path: Path, format_: Format, version: Version) -> Path:
    """Where a version is written."""
    if format_.whole or (len(exam.versions) == 1 and version.person is None):
        return path
    return path.with_name(f"{path.name[: -len(format_.ending)]}-{version.code}{format_.ending}")


def _bytes(content: str | bytes) -> bytes:
    return content.encode() if isinstance(content, str) else content
