"""``rldrill list``."""

from typing import Annotated

import typer

from rldrill.commands.arguments import Json, complete_names

NAME = "list"


def command(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="TOPIC|FAMILY", autocompletion=complete_names, help="Only these."),
    ] = None,
    json: Json = False,
) -> None:
    """List the topics and their families of problems, with the minutes that each level takes by hand.

    Examples: rldrill list · rldrill list bellman · rldrill list --json
    """
    import json as json_

    from rldrill.exam.expected import minutes
    from rldrill.problems.catalogue import selection

    families = selection(tuple(names or ()))
    if json:
        rows = [
            {"topic": family.topic, "family": family.name, "title": family.title, "levels": list(family.levels),
             "minutes": minutes().get(family.name), "revision": family.revision, "source": family.source}
            for family in families
        ]  # fmt: skip
        typer.echo(json_.dumps(rows, ensure_ascii=False, indent=2))
        return
    from rich.table import Table
    from rich.text import Text

    from rldrill.render.terminal import console

    table = Table(box=None, pad_edge=False)
    for title in ("Topic", "Family", "Asks", "Minutes"):
        table.add_column(title, style="bold" if title == "Family" else None, no_wrap=title != "Asks")
    topic = ""
    for family in families:
        table.add_row(
            Text(family.topic.replace("_", "-") if family.topic != topic else ""),
            Text(family.name),
            Text(family.summary),
            Text(" · ".join(map(str, minutes().get(family.name, ())))),
        )
        topic = family.topic
    console().print(table)
