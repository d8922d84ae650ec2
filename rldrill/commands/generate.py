"""``rldrill generate``."""

from enum import Enum
from typing import Annotated

import typer

from rldrill.commands.arguments import Level, Names, Seed

NAME = "generate"
#: So many wrong answers are printed for every part.
_MISTAKES = 8


class Extra(Enum):
    """What can be printed besides."""

    MISTAKES = "mistakes"


def command(
    names: Names = None,
    number: Annotated[int, typer.Option("--number", "-n", min=1, max=1_000_000, help="How many problems.")] = 10,
    level: Level = None,
    seed: Seed = None,
    answers: Annotated[bool, typer.Option("--answers", help="With exact answers and steps.")] = False,
    more: Annotated[list[Extra] | None, typer.Option("--with", help="With wrong answers and their causes.")] = None,
) -> None:
    """Print problems as JSON Lines, one problem a line.

    Examples: rldrill generate -n 100 --answers > problems.jsonl · rldrill generate td-zero -n 5 --with mistakes
    """
    from itertools import islice

    import rldrill
    from rldrill.commands.output import print_json
    from rldrill.exam.selection import announced_seed, sequence

    for family, wanted, own_seed in islice(sequence(names or (), level, announced_seed(seed)), number):
        exercise = rldrill.draw(family.name, wanted, own_seed)
        wrong = _MISTAKES if Extra.MISTAKES in (more or ()) else 0
        print_json(exercise.data(answers=answers, mistakes=wrong), indent=None)
