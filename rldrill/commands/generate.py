"""``rldrill generate``."""

import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from rldrill.commands.arguments import Level, Names, Seed

if TYPE_CHECKING:
    from rldrill.generation.lots import Lot
    from rldrill.generation.records import Extra

NAME = "generate"
_SHARD = re.compile(r"([0-9]{1,6})/([0-9]{1,6})")


#: What to do instead of naming a single file, by its ending.
_FILES = {
    ".jsonl": "leave -o out and redirect to one file, as in > problems.jsonl",
    ".json": "leave -o out and redirect to one file, as in > problems.jsonl",
    ".parquet": "name a folder, and --format parquet",
    ".csv": "CSV is not written; name a folder",
}


def command(
    names: Names = None,
    number: Annotated[int, typer.Option("--number", "-n", min=1, max=10**8, help="How many problems.")] = 10,
    level: Level = None,
    seed: Seed = None,
    answers: Annotated[bool, typer.Option("--answers", help="With exact answers and steps.")] = False,
    more: Annotated[
        str, typer.Option("--with", metavar="A,B", help="With answers, working, hints, mistakes; latex writes them so.")
    ] = "",
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FOLDER", help="A file for each family and level there.")
    ] = None,
    form: Annotated[
        Literal["jsonl", "parquet"], typer.Option("--format", help="Of the files in the folder.")
    ] = "jsonl",
    jobs: Annotated[int, typer.Option("--jobs", "-j", min=1, max=256, help="Draw in so many processes.")] = 1,
    shard: Annotated[str, typer.Option("--shard", metavar="i/k", help="Only the i-th of k shares of the files.")] = "",
    dask: Annotated[
        str | None, typer.Option("--dask", metavar="ADDRESS", help="Draw on a cluster: tcp://… of its scheduler.")
    ] = None,
    split: Annotated[
        Literal["train", "held-out"], typer.Option("--split", help="Problems of one split are in no other.")
    ] = "train",
) -> None:
    """Print problems as JSON Lines, or fill a folder with millions of them.

    The same arguments give the same problems, whatever the jobs, shards or machines; no problem comes twice. In a
    folder a file appears when it is complete: the same command goes on where an earlier run was ended, with its seed.

    Examples:

        rldrill generate -n 100 --answers > problems.jsonl

        rldrill generate td-zero -n 5 --with answers,mistakes

        rldrill generate -n 1000000 --with answers,working,latex -o problems/ --jobs 8
    """
    from rldrill.exam.selection import announced_seed
    from rldrill.generation.folder import Folder, seed_of
    from rldrill.generation.lots import Split, lots
    from rldrill.generation.running import drawn, workers
    from rldrill.problems.errors import UsageError

    extras = _extras(more, answers=answers)
    index, shards = _shares(shard)
    if output is None and form == "parquet":
        raise UsageError("Parquet is written to a folder; name one with --output.")
    if output is not None and output.suffix in _FILES and not output.is_dir():
        raise UsageError(
            f"{output}: -o names a folder, which gets a file for each family and level; {_FILES[output.suffix]}."
        )
    if seed is None and output is not None:
        seed = seed_of(output)
    chosen = announced_seed(seed)
    every = lots(names or (), level, number, chosen, Split(split))[index - 1 :: shards]
    about = {"names": list(names or ()), "number": number, "level": level, "seed": chosen, "format": form}
    about |= {"with": [extra.value for extra in extras], "split": split}
    folder = None if output is None else Folder(output, form, about)
    with workers(jobs, dask) as executor, _progress(every) as advance:
        missing = [lot for lot in every if folder is None or not folder.has(lot)]
        advance(sum(lot.count for lot in every) - sum(lot.count for lot in missing))
        for lot, lines in drawn(missing, extras, executor, 4 * jobs if dask is None else 64):
            counted = _counted(lines, advance)
            found = _print(counted) if folder is None else folder.write(lot, counted)
            if found < lot.count:
                typer.echo(f"rldrill: {lot.family} has only {found} different problems at level {lot.level}", err=True)


def _extras(text: str, *, answers: bool) -> "tuple[Extra, ...]":
    from rldrill.generation.records import Extra
    from rldrill.problems.errors import UsageError

    wanted = [word.strip() for word in text.split(",") if word.strip()] + ["answers"] * answers
    known = {extra.value: extra for extra in Extra}
    for word in wanted:
        if word not in known:
            raise UsageError(f"--with {word[:30]} is not known; it takes {', '.join(known)}, with commas between them.")
    return tuple(extra for extra in Extra if extra.value in wanted)


def _shares(text: str) -> tuple[int, int]:
    from rldrill.problems.errors import UsageError

    match = _SHARD.fullmatch(text or "1/1")
    if match is None or not 1 <= int(match[1]) <= int(match[2]):
        raise UsageError(f"--shard {text[:30]} is not a share; write 3/16 for the third of sixteen.")
    return int(match[1]), int(match[2])


def _counted(lines: Iterable[str], advance: Callable[[int], None]) -> Iterator[str]:
    for line in lines:
        yield line
        advance(1)


def _print(lines: Iterable[str]) -> int:
    import json
    import sys

    from rldrill.render.encodable import shows_all

    plain = shows_all(sys.stdout.encoding)
    number = 0
    for number, line in enumerate(lines, 1):  # noqa: B007 (the last number is how many there are)
        typer.echo(line if plain else json.dumps(json.loads(line)))
    return number


@contextmanager
def _progress(lots: Iterable["Lot"]) -> Iterator[Callable[[int], None]]:
    """How many problems are drawn, how fast, and how long it takes still; nothing where nobody looks."""
    import sys

    from rldrill.render.terminal import console

    screen = console(stderr=True)
    if not screen.is_terminal or sys.stdout.isatty():  # what is printed to the terminal shows the progress itself
        yield lambda _: None
        return
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TaskProgressColumn,
        TextColumn,
        TimeRemainingColumn,
    )

    columns = (BarColumn(), MofNCompleteColumn(), TaskProgressColumn(show_speed=True), TextColumn("left"))
    with Progress(*columns, TimeRemainingColumn(), console=screen, transient=True) as progress:
        task = progress.add_task("", total=sum(lot.count for lot in lots))
        yield lambda number: progress.advance(task, number)
