"""Which share of all problems fits a screen, with what is asked, how to type it, the keys and the prompt.

python benchmarks/screens.py [COLUMNS LINES [DRAWS]]
"""

import sys
from io import StringIO

from rich.console import Console

from rldrill.exercise import draw
from rldrill.problems.catalogue import families, family
from rldrill.quiz.screen import Screen
from rldrill.quiz.session import Session


def lines(name: str, level: int, seed: int, width: int, height: int) -> int:
    """How many lines a problem takes on such a screen, up to its first prompt."""
    console = Console(file=StringIO(), width=width, height=height, color_system=None, highlight=False)
    shown = 0

    def ask(*_: str) -> str:
        nonlocal shown
        shown = shown or console.file.getvalue().count("\n") + 1  # type: ignore[attr-defined]
        raise EOFError

    Screen(console, ask).run([draw(name, level, seed)], Session(10))
    return shown


def main() -> None:
    """Print the share, and what does not fit."""
    given = [int(each) for each in sys.argv[1:]]
    width, height, draws = given + [80, 24, 20][len(given) :]
    drawn = [(name, level, seed) for name in families() for level in family(name).levels for seed in range(draws)]
    taken = {key: lines(*key, width, height) for key in drawn}
    large = {key: needed for key, needed in taken.items() if needed > height}
    fit = len(drawn) - len(large)
    print(f"{fit} of {len(drawn)} problems fit {width} × {height}: {fit / len(drawn):.1%}")
    for key, needed in large.items():
        print("/".join(map(str, key)), needed)


if __name__ == "__main__":
    main()
