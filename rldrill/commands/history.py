"""``rldrill history``."""

import sys
from pathlib import Path
from typing import Annotated, Literal

import typer

NAME = "history"


def command(
    what: Annotated[
        Literal["export", "import", "forget"], typer.Argument(help="Write it out, read it in, or delete it.")
    ],
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="FILE|FAMILY", help="The file (else stdin or stdout); with forget, topics or families."),
    ] = None,
    yes: Annotated[bool, typer.Option("--yes", "-y", help="Forget without asking.")] = False,
) -> None:
    """Your answers in the quiz, as JSON Lines, an answer a line; they lie on this machine only.

    Examples: rldrill history export all.jsonl · rldrill history import all.jsonl · rldrill history forget bellman
    """
    from rldrill.history.place import history_file, told
    from rldrill.problems.errors import UsageError

    path = history_file()
    if what != "forget" and len(names or ()) > 1:
        raise UsageError(f"'rldrill history {what}' takes one file.")
    with told(path):
        if what == "export":
            _export(path, Path(names[0]) if names else None)
        elif what == "import":
            _import(path, Path(names[0]) if names else None)
        else:
            _forget(path, names or [], yes=yes)


def _export(path: Path, target: Path | None) -> None:
    from rldrill.history.attempts import to_line
    from rldrill.history.log import read
    from rldrill.render.encodable import shows_all
    from rldrill.writing import write_bytes_atomically

    ascii_only = target is None and not shows_all(sys.stdout.encoding)
    lines = "".join(f"{to_line(attempt, ascii_only=ascii_only)}\n" for attempt in read(path))
    if target is None:
        typer.echo(lines, nl=False)
    else:
        write_bytes_atomically(target, lines.encode())


def _import(path: Path, source: Path | None) -> None:
    from rldrill.files import decoded, shown
    from rldrill.history.attempts import from_lines
    from rldrill.history.log import append

    where = "stdin" if source is None else shown(source)
    content = sys.stdin.buffer.read() if source is None else source.read_bytes()
    attempts = list(from_lines(decoded(content, where).split("\n"), where))
    new = append(path, attempts)
    typer.echo(f"{new} of {len(attempts)} answers were new.", err=True)


def _forget(path: Path, names: list[str], *, yes: bool) -> None:
    from rldrill.history.log import forget
    from rldrill.problems.catalogue import selection

    families = [family.name for family in selection(names)] if names else []
    said = " and ".join(names) if names else "everything"
    if not yes:
        typer.confirm(f"Forget {said} that was answered, for good?", abort=True, err=True)
    typer.echo(f"{forget(path, families)} answers are forgotten.", err=True)
