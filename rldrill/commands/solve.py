"""``rldrill solve``."""

from typing import Annotated

import typer

from rldrill.commands.arguments import Json, complete_ids, tell

NAME = "solve"


def command(
    problem: Annotated[
        str | None,
        typer.Argument(metavar="ID|FILE", autocompletion=complete_ids, help="A problem's ID, or a problem file."),
    ] = None,
    schema: Annotated[
        str | None,
        typer.Option(
            "--schema", metavar="FAMILY", help="Print the JSON Schema of that family's problem files, and end."
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Solve a problem exactly: the answers first, then every step of the working.

    Examples: rldrill solve examples/racing-car.toml · rldrill solve td-zero/2/7 --json
    """

    from rich.padding import Padding

    import rldrill
    from rldrill.commands.output import print_json
    from rldrill.problem_file import schema_of
    from rldrill.problems.document import Heading
    from rldrill.problems.errors import UsageError
    from rldrill.render.terminal import asked, console, render

    if schema is not None:
        print_json(schema_of(schema))
        return
    if problem is None:
        raise UsageError("Which problem? Name its ID or its file, as in 'rldrill solve td-zero/2/7'.")
    exercise = rldrill.load(problem)
    tell(exercise.notes)
    if json:
        print_json(exercise.data())
        return
    out = console()
    for part in exercise.parts:
        out.print(asked(part, only=len(exercise.parts) == 1))
        out.print(Padding(render([exercise.answer(part)]), (0, 0, 0, 4), expand=False))
    out.print(render([Heading("Working"), *exercise.working()]))
