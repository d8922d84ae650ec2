"""``rldrill verify``."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rldrill.commands.arguments import Json, tell

if TYPE_CHECKING:
    from rich.console import RenderableType

    from rldrill.grading.verification import Report, Score, StudentReport

NAME = "verify"
_COLOURS = {"right": "green", "follow-through": "green", "close": "yellow", "misconception": "yellow"}


def command(
    files: Annotated[
        list[Path], typer.Argument(metavar="FILE", help="Files of answers: .toml, .json, .csv or .jsonl.")
    ],
    json: Json = False,
    show_key: Annotated[bool, typer.Option("--show-key", help="Print the right answers too.")] = False,
) -> None:
    """Check files of answers, and say of each answer what is wrong and why.

    A file holds a problem's ID (or a problem file), the part, and what was typed:

    \b
      TOML   student = "Ann"
             ["return/1/7"]
             a = "3/4"
      CSV    student,problem,part,answer
             Ann,return/1/7,a,3/4
      JSON   {"student": "Ann", "answers": {"return/1/7": {"a": "3/4"}}}
      JSONL  {"problem": "return/1/7", "part": "a", "answer": "3/4"}

    An answer is right if it is exact, or right to 3 significant digits.

    A part that was not answered counts as missing.

    Exit codes: 0 all right, 1 not all right, 3 a bad file, 4 no answers.

    Examples: rldrill verify answers.toml · rldrill verify handed-in/*.csv --json
    """

    from rldrill.commands.output import print_json
    from rldrill.grading.verification import verify

    report = verify(files)
    for failure in report.failures:
        typer.echo(f"rldrill: {failure.says}", err=True)
    for problem, notes in report.notes.items():
        tell(notes, f"{problem}: ")
    if json:
        print_json(report.to_json(show_key=show_key))
    else:
        _print(report, show_key=show_key)
    raise typer.Exit(report.exit_code)


def _print(report: "Report", *, show_key: bool) -> None:
    from rich.text import Text

    from rldrill.render.terminal import console, words

    out = console()
    students = [(file, student) for file in report.files for student in file.students]
    for file, student in students:
        whose = student.student or ("no name" if len(file.students) > 1 else "")
        out.print(words((f"{file.path}: {whose}" if whose else file.path, "bold")))
        out.print(_table(student, show_key=show_key))
        out.print(Text(f"\nScore: {_points(student.score)}\n"))
    if len(students) > 1:
        out.print(Text(f"All together: {_points(report.score)}"))


def _table(student: "StudentReport", *, show_key: bool) -> "RenderableType":
    from rldrill.render.terminal import table

    header = ("Problem", "Part", "Read as", "Verdict", "Why", "Points", *(["Key"] if show_key else []))
    rows = []
    for row in student.parts:
        why = "" if row.verdict == "right" else row.reason
        points = f"{row.score.points} of {row.score.of}"
        verdict = (row.verdict, _COLOURS.get(row.verdict, "red"))
        rows.append((row.problem, row.part, row.read or "–", verdict, why, points, row.key)[: len(header)])
    return table(header, rows, whole=("Part", "Points"), ruled=True)


def _points(score: "Score") -> str:
    return f"{score.points} of {score.of} ({float(100 * score.points / score.of):.3g} %)"
