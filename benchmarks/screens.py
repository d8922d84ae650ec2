"""How many problems fit a terminal: what stands on the screen until the first answer is typed, in lines.

python benchmarks/screens.py [WIDTH HEIGHT]
"""

import contextlib
import sys
from collections import Counter
from io import StringIO

from rich.console import Console

from rldrill.exercise import draw
from rldrill.problems.catalogue import families, family
from rldrill.quiz.screen import Screen
from rldrill.quiz.session import Session


class _EnoughError(Exception):
    """Something is asked."""


def _nothing(_: str) -> str:
    raise _EnoughError


def lines(name: str, level: int, seed: int, width: int, height: int) -> int:
    """The lines from the header to the prompt, that included."""
    out = StringIO()
    console = Console(file=out, width=width, height=height, color_system=None, markup=False, highlight=False)
    with contextlib.suppress(_EnoughError):
        Screen(console, _nothing).run([draw(name, level, seed)], Session(10))
    return out.getvalue().strip("\n").count("\n") + 2


def main() -> None:
    """Print the share that fits, and what does not."""
    width, height = (int(text) for text in sys.argv[1:3]) if len(sys.argv) > 2 else (80, 24)
    seeds = range(3)
    taller = Counter(
        {
            f"{name}/{level}": sum(lines(name, level, seed, width, height) > height for seed in seeds)
            for name in families()
            for level in family(name).levels
        }
    )
    print(f"{width}×{height}: {1 - taller.total() / (len(taller) * len(seeds)):.0%} of {len(taller) * len(seeds)} fit")
    print(", ".join(f"{place} {number}" for place, number in taller.most_common() if number))


if __name__ == "__main__":
    main()
