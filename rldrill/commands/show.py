"""``rldrill show``."""

from typing import Annotated

import typer

from rldrill.commands.arguments import Json, NotationOption, complete_ids, tell

NAME = "show"


def command(
    problem: Annotated[
        str,
        typer.Argument(metavar="ID|FILE", autocompletion=complete_ids, help="A problem's ID, or a problem file."),
    ],
    json: Json = False,
    notation: NotationOption = None,  # noqa: ARG001 - its callback sets it
) -> None:
    """Show a problem without its answer; with --json as a problem file with answers and steps.

    Examples: rldrill show td-zero/2/7 · rldrill show td-zero/2/7 --json > mine.json
    """

    import rldrill
    from rldrill.commands.output import print_json
    from rldrill.render.terminal import asked, console, render

    exercise = rldrill.load(problem)
    tell(exercise.notes)
    if json:
        print_json(exercise.data())
        return
    out = console()
    out.print(render(exercise.question()))
    for part in exercise.parts:
        out.print(asked(part, only=len(exercise.parts) == 1))
