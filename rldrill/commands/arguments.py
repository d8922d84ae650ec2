"""The arguments that several commands share, and the completion of topics, families and IDs."""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

_TOLD = 6


def tell(notes: Sequence[str], where: str = "") -> None:
    """Say beside the output what was read otherwise than it is written, and in which file if there may be several."""
    for note in notes[:_TOLD]:
        typer.echo(f"rldrill: {where}{note}", err=True)
    if len(notes) > _TOLD:
        typer.echo(f"rldrill: {where}{len(notes) - _TOLD} more were read in the same way", err=True)


def complete_names(incomplete: str) -> list[str]:
    """Topics and families that begin so."""
    from rldrill.problems.catalogue import families, topics

    names = [*(topic.replace("_", "-") for topic in topics()), *families()]
    return [name for name in names if name.startswith(incomplete)]


def complete_families(incomplete: str) -> list[str]:
    """Families that begin so."""
    from rldrill.problems.catalogue import families

    return [name for name in families() if name.startswith(incomplete)]


def complete_ids(incomplete: str) -> list[str]:
    """Families, and IDs of a family once it stands."""
    from rldrill.problems.catalogue import families

    head, slash, _ = incomplete.partition("/")
    if slash and head in families():
        return [name for level in (1, 2, 3) if (name := f"{head}/{level}/").startswith(incomplete)]
    return [f"{name}/" for name in families() if name.startswith(incomplete)]


def complete(incomplete: str) -> list[str]:
    """Topics, families and IDs that begin so."""
    return [*complete_names(incomplete), *complete_ids(incomplete)]


Names = Annotated[
    list[str] | None,
    typer.Argument(metavar="TOPIC|FAMILY", autocompletion=complete_names, help="Topics or families; all, if none."),
]
Level = Annotated[
    int | None,
    typer.Option("--level", "-l", min=1, max=3, help="1 warm-up, 2 exam, 3 hard; mixed, if not given."),
]
Seed = Annotated[int | None, typer.Option("--seed", "-s", min=0, help="Repeat the problems of an earlier run.")]
Json = Annotated[bool, typer.Option("--json", help="Print data for programs.")]


def _use(name: str | None) -> str | None:
    from rldrill.problems.notations import use

    if name is not None:
        use(name)
    return name


NotationOption = Annotated[
    str | None,
    typer.Option(
        "--notation", metavar="NAME", callback=_use, help="How quantities are written: lecture, sutton-barto, control."
    ),
]
Output = Annotated[Path | None, typer.Option("--output", "-o", help="Write to this file.")]
