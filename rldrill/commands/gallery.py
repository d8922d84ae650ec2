"""``rldrill gallery``."""

from pathlib import Path
from typing import Annotated

import typer

from rldrill.commands.arguments import Names, NotationOption

NAME = "gallery"


def command(
    names: Names = None,
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="FOLDER", help="Write the pages into this folder.")
    ] = Path("site"),
    notation: NotationOption = None,  # noqa: ARG001 - its callback sets it
) -> None:
    """Write the catalogue as a site: every family with its formulas, an example at each level, and its mistakes.

    Examples: rldrill gallery -o site/ · rldrill gallery bellman -o site/
    """
    from rldrill.export.gallery import gallery
    from rldrill.problems.catalogue import headers
    from rldrill.problems.errors import UsageError

    if output.exists() and not output.is_dir():
        raise UsageError(f"{output} is a file; give the name of a folder, such as site/.")
    paths = list(gallery(output, headers(names or ())))
    pages = "1 page" if len(paths) == 2 else f"{len(paths) - 1} pages"
    typer.echo(f"{paths[-1]} and {pages} beside it")
