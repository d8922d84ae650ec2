"""``rldrill quiz``."""

from typing import Annotated

import typer

from rldrill.commands.arguments import Level, Seed, complete_ids, complete_names

NAME = "quiz"


def _complete(incomplete: str) -> list[str]:
    return [*complete_names(incomplete), *complete_ids(incomplete)]


def command(
    names: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="TOPIC|FAMILY|ID|FILE",
            autocompletion=_complete,
            help="Topics, families, problem IDs or problem files; all families, if none.",
        ),
    ] = None,
    number: Annotated[int, typer.Option("--number", "-n", min=1, max=1000, help="How many problems.")] = 10,
    level: Level = None,
    seed: Seed = None,
) -> None:
    """Drill in the terminal: fresh problems, judged answers, mistakes explained.

    Examples: rldrill quiz · rldrill quiz bellman -n 5 --level 2 · rldrill quiz td-zero/2/7
    """
    from rldrill.problems.errors import UsageError
    from rldrill.quiz.prompt import is_interactive, line_editor

    if not is_interactive():
        raise UsageError(
            "The quiz needs a terminal; without one use 'rldrill verify FILE' to grade answers, "
            "'rldrill worksheet' to print problems or 'rldrill generate' to get them as data."
        )
    from rldrill.exam.selection import announced_seed
    from rldrill.quiz.questions import questions
    from rldrill.quiz.screen import Screen
    from rldrill.quiz.session import Session
    from rldrill.render.terminal import console

    exercises, total = questions(tuple(names or ()), number, level, lambda: announced_seed(seed))
    if not Screen(console(), line_editor()).run(exercises, Session(total)):
        raise typer.Exit(130)
