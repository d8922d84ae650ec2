"""``rldrill verify``."""

import gc
import re
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from rldrill.commands.arguments import Json, tell

if TYPE_CHECKING:
    from rich.console import RenderableType

    from rldrill.grading.report import Report, StudentReport
    from rldrill.render.terminal import Span

NAME = "verify"
_COLOURS = {"right": "green", "follow-through": "green", "close": "yellow", "misconception": "yellow"}
#: A share: 60%, 0.6 or 3/5.
_SHARE = re.compile(r"([0-9]{1,9}(?:\.[0-9]{1,9})?|[0-9]{1,9}/[1-9][0-9]{0,8})\s*(%)?")
#: So many things that could not be graded are told one by one.
_TOLD = 50
#: Of more students than this the terminal shows the totals only.
_TABLES = 30


def command(
    files: Annotated[
        list[Path] | None, typer.Argument(metavar="FILE", help="Files of answers: .toml, .json, .csv or .jsonl.")
    ] = None,
    exam: Annotated[
        Path | None, typer.Option("--for", metavar="EXAM.json", help="Grade exactly this exam's problems.")
    ] = None,
    version: Annotated[str | None, typer.Option("--version", metavar="A", help="The version that all sat.")] = None,
    roster: Annotated[
        Path | None, typer.Option("--roster", metavar="FILE.csv", help="Who sat which: student, number, version.")
    ] = None,
    reports: Annotated[
        list[str] | None,
        typer.Option(
            "--report",
            metavar="FORM=PATH",
            help="Also write text, json, junit, github, gradescope, csv or html; again for more; - is the output.",
        ),
    ] = None,
    enough: Annotated[
        str | None, typer.Option("--pass", metavar="60%", help="What every student needs; all right, if not given.")
    ] = None,
    feedback: Annotated[
        Literal["none", "verdict", "reason", "key"] | None,
        typer.Option("--feedback", help="How much is told; the reason, if not given."),
    ] = None,
    show_key: Annotated[bool, typer.Option("--show-key", help="Print the right answers too: --feedback key.")] = False,
    hand_ins: Annotated[
        Literal["last", "first", "best"] | None,
        typer.Option("--hand-ins", help="Which counts of one student's; with an exam the last."),
    ] = None,
    absent: Annotated[
        bool, typer.Option("--absent/--no-absent", help="Count people on the roster who handed in nothing.")
    ] = True,
    allow_files: Annotated[
        bool, typer.Option("--allow-files", help="Open problem files that answers name, beside the answers.")
    ] = False,
    strict: Annotated[
        bool, typer.Option("--strict/--keep-going", help="Grade nothing where something cannot be graded.")
    ] = False,
    seconds: Annotated[
        float, typer.Option("--seconds", min=0.1, max=3600, help="The time to grade one student in.")
    ] = 30,
    schema: Annotated[bool, typer.Option("--schema", help="Print the JSON Schema of the report, and end.")] = False,
    json: Json = False,
) -> None:
    """Check files of answers, and say of each answer what is wrong and why.

    A file holds a problem's ID (or its number in the exam, or a problem file), the part, and what was typed:

    \b
      TOML   student = "Ann"
             ["return/1/7"]
             a = "3/4"
      CSV    student,problem,part,answer
             Ann,return/1/7,a,3/4
      JSON   {"student": "Ann", "answers": {"return/1/7": {"a": "3/4"}}}
      JSONL  {"problem": "return/1/7", "part": "a", "answer": "3/4"}

    An answer is right if it is exact, or right to 3 significant digits.

    A part that was not answered counts as missing. What cannot be graded is told, and costs nobody else anything.

    Exit codes: 0 all right, or enough of it; 1 not; 3 something could not be graded; 4 no answers.

    Examples: rldrill verify answers.toml · rldrill verify in/*.csv --for exam.json --pass 50% --report html=class.html
    """
    from rldrill.commands.output import print_json

    if schema:
        from rldrill.grading.reports.data import schema as schema_of

        print_json(schema_of())
        return
    from rldrill.grading.assignment import Assignment
    from rldrill.grading.marking import Rules
    from rldrill.grading.verification import Settings, verify
    from rldrill.problems.errors import FileError, UsageError
    from rldrill.render.encodable import shows_all

    if not files:
        raise UsageError("Which answers? Name a file, as in 'rldrill verify answers.toml'.")
    if exam is None and (version or roster):
        raise UsageError("A version is one of an exam; name its manifest, --for exam.json.")
    if show_key and feedback not in (None, "key"):
        raise UsageError(f"--show-key prints the right answers, and --feedback {feedback} does not; give one of them.")
    told = "key" if show_key else feedback or "reason"
    wanted = [_wanted(each) for each in reports or ()]
    _keep_apart(wanted, [*files, *filter(None, (exam, roster))])
    settings = Settings(
        assignment=None if exam is None else Assignment(exam, version, roster),
        allow_files=allow_files,
        hand_ins=hand_ins,
        strict=strict,
        isolated=True,
        needed=None if enough is None else _share(enough),
        rules=Rules(causes=told in ("reason", "key"), keys=told == "key"),
        student=seconds,
        absent=absent,
    )
    gc.freeze()  # what is imported stays, and the process that marks shares it
    gc.enable()
    with _progress() as advance:
        report = verify(files, settings, advance)
    unwritten = [said for form, path in wanted if (said := _unwritten(report, form, path, told))]
    _complain(report)
    people = sum(1 for student in report.students if student.paths)
    if people > 1 and "gradescope" in {form for form, _ in wanted}:
        typer.echo(
            f"rldrill: gradescope's report is of one submission, and {people} students stand in these files; it holds "
            "what is said of any of them. Verify one submission at a time.",
            err=True,
        )
    if json:
        from rldrill.grading.reports.data import written

        typer.echo(written(report, told, ascii_only=not shows_all(sys.stdout.encoding)), nl=False)
    elif ("-" not in {path for _, path in wanted}) and told != "none":
        if len(report.students) > _TABLES:
            from rldrill.grading.reports.text import totals

            typer.echo(totals(report), nl=False)
        else:
            _print(report, told)
    if unwritten:
        raise FileError(" ".join(unwritten))
    raise typer.Exit(report.exit_code)


def _complain(report: "Report") -> None:
    """What could not be graded, and what is not marked, beside the output."""
    from rldrill.grading.reports.said import one_line

    said = [refusal.says for refusal in report.refused]
    said += [each for student in report.students for each in student.extra]
    for sentence in said[:_TOLD]:
        typer.echo(f"rldrill: {one_line(sentence)}", err=True)
    if len(said) > _TOLD:
        typer.echo(f"rldrill: and {len(said) - _TOLD} more; --report json=FILE holds all of them.", err=True)
    for problem, notes in report.notes.items():
        tell(notes, f"{problem}: ")


@contextmanager
def _progress() -> Iterator[Callable[[int, int], None] | None]:
    """A line on stderr that counts the students; none where nobody looks."""
    if not sys.stderr.isatty():
        yield None
        return

    def advance(count: int, total: int) -> None:
        if total > 1 and (count % 10 == 0 or count == total):
            print(f"\rgraded {count} of {total}", end="\n" if count == total else "", file=sys.stderr, flush=True)

    yield advance


_FORMS = ("text", "json", "junit", "github", "gradescope", "csv", "html")


def _wanted(text: str) -> tuple[str, str]:
    from rldrill.problems.errors import UsageError

    form, _, path = text.partition("=")
    if form not in _FORMS or not (Path(path).name or (form == "github" and not path)):
        raise UsageError(f"{text[:60]!r} is no report; say FORM=PATH, with one of {', '.join(_FORMS)} as the form.")
    return form, path or "-"


def _share(text: str) -> Fraction:
    from rldrill.problems.errors import UsageError

    found = _SHARE.fullmatch(text.strip())
    share = None if found is None else Fraction(found[1]) / (100 if found[2] else 1)
    if share is None or share > 1:
        raise UsageError(f"{text[:20]!r} is no share of the points; write one as 60%.")
    return share


def _keep_apart(reports: list[tuple[str, str]], read: list[Path]) -> None:
    """No report takes the place of what is read, or of another one.

    Raises:
        UsageError: one would.
    """
    from rldrill.problems.errors import UsageError

    named = [Path(path) for _, path in reports if path != "-"]
    named += [_totals(Path(path)) for form, path in reports if form == "csv" and path != "-"]
    for number, path in enumerate(named):
        if any(_same(path, other) for other in read):
            raise UsageError(f"{path} is read here, so no report can go there; choose another name.")
        if any(_same(path, other) for other in named[:number]):
            raise UsageError(f"Two reports cannot both go to {path}; choose another name for one.")


def _same(path: Path, other: Path) -> bool:
    """Whether two names are those of one file; pipes and devices take whatever comes."""
    try:
        return path.resolve() == other.resolve() and (path.is_file() or not path.exists())
    except (OSError, RuntimeError, ValueError):
        return False


def _unwritten(report: "Report", form: str, path: str, feedback: str) -> str:
    """Write a report; why it cannot be, so that the others are written all the same."""
    from rldrill.problems.errors import FileError

    try:
        _write(report, form, path, feedback)
    except FileError as error:
        return str(error)
    return ""


def _write(report: "Report", form: str, path: str, feedback: str) -> None:
    """Write a report to a file, or to the output."""
    import os
    from importlib import import_module

    modules = {"json": "data", "csv": "tables", "html": "page"}
    module = import_module(f"rldrill.grading.reports.{modules.get(form, form)}")
    text = module.written(report, feedback)
    if form == "csv" and path != "-":
        _put(module.totals(report), _totals(Path(path)))
    if form == "github" and (summary := os.environ.get("GITHUB_STEP_SUMMARY")):
        _put(module.summary(report, feedback), Path(summary), behind=True)
    if path == "-":
        typer.echo(text, nl=False)
    else:
        _put(text, Path(path))


def _totals(path: Path) -> Path:
    """Where the totals go beside a table of points."""
    return path.with_name(f"{path.stem}-totals{path.suffix}")


def _put(text: str, path: Path, *, behind: bool = False) -> None:
    """Write a file whole, or behind what it holds."""
    from rldrill.files import shown
    from rldrill.problems.errors import FileError, reason
    from rldrill.writing import write_bytes_atomically

    try:
        if behind:
            with path.open("ab") as file:
                file.write(text.encode())
        else:
            write_bytes_atomically(path, text.encode())
    except OSError as error:
        raise FileError(f"{shown(path)}: it cannot be written ({reason(error)}).") from None


def _print(report: "Report", feedback: str) -> None:
    from rich.text import Text

    from rldrill.grading.reports.text import earned, points
    from rldrill.render.terminal import console, words

    out = console()
    for student in report.students:
        whose = student.student or ("no name" if len(report.students) > 1 else "")
        where = ", ".join(student.paths)
        named = ": ".join(filter(None, (where, whose))) + (f", version {student.version}" if student.version else "")
        out.print(words((named, "bold")))
        if student.paths:
            out.print(_table(student, feedback))
        out.print(Text(f"\nScore: {earned(report, student)}\n"))
    if len(report.students) > 1:
        out.print(Text(f"All together: {points(report.score)}"))


def _table(student: "StudentReport", feedback: str) -> "RenderableType":
    from rldrill.grading.reports.said import one_line
    from rldrill.render.terminal import table

    why = feedback in ("reason", "key")
    header = ["Problem", "Part", "Read as", "Verdict", *(["Why"] if why else []), "Points"]
    header += ["Key"] if feedback == "key" else []
    rows = []
    for part in student.parts:
        judged = part.judged
        reason = [one_line("" if judged.verdict == "right" else judged.reason)] if why else []
        points = f"{judged.score.points} of {judged.score.of}"
        verdict = (judged.verdict, _COLOURS.get(judged.verdict, "red"))
        row: list[Span] = [part.problem, part.part, one_line(judged.read) or "–", verdict, *reason, points, judged.key]
        rows.append(row[: len(header)])
    return table(header, rows, whole=("Part", "Points"), ruled=True)
