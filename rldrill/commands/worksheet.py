"""``rldrill worksheet``: printed worksheets with their keys."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from rldrill.commands.arguments import Json, Level, Names, Seed

NAME = "worksheet"


def command(
    names: Names = None,
    count: Annotated[int, typer.Option("--count", "-n", min=1, max=100, help="Problems in each version.")] = 8,
    level: Level = None,
    seed: Seed = None,
    versions: Annotated[int, typer.Option("--versions", min=1, max=200, help="How many versions.")] = 1,
    paper: Annotated[str, typer.Option("--paper", metavar="a4|letter", help="The paper.")] = "a4",
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE.pdf", help="Write to this file.")] = Path(
        "worksheet.pdf"
    ),
    title: Annotated[str | None, typer.Option("--title", help="What is printed at the head.")] = None,
    as_json: Json = False,
) -> None:
    """Typeset a worksheet as PDF, with a key for each version.

    Versions share topics and levels, and never a problem. A manifest (FILE.json) records what was printed.

    Examples:

        rldrill worksheet

        rldrill worksheet bellman td-zero -n 6 --level 2 -o exam.pdf

        rldrill worksheet -n 5 --versions 30 --seed 7 -o quiz.pdf
    """
    from rldrill.exam.blueprint import Blueprint, Entry
    from rldrill.exam.planning import plan
    from rldrill.exam.selection import fresh_seed
    from rldrill.print.exam_files import check_output, write
    from rldrill.print.paper import paper_of

    size = paper_of(paper)
    check_output(output)
    chosen = fresh_seed() if seed is None else seed
    typer.echo(f"seed {chosen}", err=True)
    with _progress(2 * versions) as advance:
        entry = Entry(topic=tuple(names or ()), count=count, level=level)
        blueprint = Blueprint(problems=(entry,), versions=versions, seed=chosen)
        exam = plan(blueprint.but(title=title, paper=size.name), advance=advance)
        written = write(exam, output, size, advance)
    _print([str(path) for path in written], as_json=as_json)


@contextmanager
def _progress(steps: int) -> Iterator[Callable[[], None]]:
    from rich.progress import Progress

    from rldrill.render.terminal import console

    screen = console(stderr=True)
    if not screen.is_terminal:  # even a progress that is disabled ends with an empty line in some releases
        yield lambda: None
        return
    with Progress(console=screen, transient=True) as progress:
        task = progress.add_task("Typesetting", total=steps)
        yield lambda: progress.advance(task)


def _print(paths: list[str], *, as_json: bool) -> None:
    from rldrill.commands.output import print_json

    if as_json:
        print_json(paths)
    else:
        typer.echo("\n".join(paths))
