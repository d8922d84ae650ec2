"""``rldrill fields``."""

from typing import TYPE_CHECKING, Annotated

import typer

from rldrill.commands.arguments import Json, complete_families

if TYPE_CHECKING:
    from rldrill.problems.fields import FileField

NAME = "fields"


def command(
    family: Annotated[
        str, typer.Argument(metavar="FAMILY", autocompletion=complete_families, help="The family of the problem.")
    ],
    json: Json = False,
) -> None:
    """List what a problem file of a family holds: every field, what it takes, its default and an example.

    With --json it is the JSON Schema of what stands under 'given'.

    Examples: rldrill fields td-zero · rldrill fields value-iteration --json
    """
    from rldrill.problems.catalogue import family as family_of

    found = family_of(family)
    if json:
        from rldrill.commands.output import print_json

        print_json(found.written_schema())
        return
    from rldrill.problems.exact import PARAMETERS_TOLD
    from rldrill.problems.fields import fields
    from rldrill.render.terminal import console, words

    out = console()
    out.print(words((found.name, "bold"), f": {found.summary}"))
    out.print(words(f'A problem file holds family = "{found.name}" and, under [given], these fields.'))
    listed = fields(found.name)
    if any("parameter left open" in field.takes for field in listed):
        out.print(words(f"A parameter left open, or asked for, is one of {PARAMETERS_TOLD}."))
    form = ""
    for field in listed:
        if field.form != form:
            form = field.form
            out.print(words("\n", (form or "The other fields:", "bold")))
        _print(field)


def _print(field: "FileField") -> None:
    from rich.padding import Padding

    from rldrill.render.terminal import console, words

    out = console()
    needed = "; needed" if field.default is None else f"; {field.default} if not given"
    out.print(words("\n", (field.path, "bold"), f": {field.takes}{needed}"))
    out.print(Padding(words(field.means), (0, 0, 0, 4)))
    out.print(Padding(words(("such as ", "dim"), field.example), (0, 0, 0, 4)))
