"""``rldrill generate``."""

from typing import Annotated

import typer

from rldrill.commands.arguments import Level, Names, Seed

NAME = "generate"


def command(
    names: Names = None,
    number: Annotated[int, typer.Option("--number", "-n", min=1, max=1_000_000, help="How many problems.")] = 10,
    level: Level = None,
    seed: Seed = None,
    answers: Annotated[bool, typer.Option("--answers", help="With exact answers and steps.")] = False,
) -> None:
    """Print problems as JSON Lines, one problem a line.

    Examples: rldrill generate -n 100 --answers > problems.jsonl · rldrill generate td-zero --level 2 -n 5
    """
    from itertools import islice

    import rldrill
    from rldrill.commands.output import print_json
    from rldrill.exam.selection import announced_seed, sequence

    for family, wanted, own_seed in islice(sequence(names or (), level, announced_seed(seed)), number):
        exercise = rldrill.draw(family.name, wanted, own_seed)
        print_json(exercise.data(answers=answers), indent=None)
