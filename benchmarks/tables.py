"""The tables of what rldrill costs: how fast it starts, draws, writes LaTeX, judges, computes, and solves large models.

python benchmarks/tables.py [TABLE …] [--against REF] [--rounds N]

Without a table all are printed. ``--against`` takes a git ref: its checkout is measured in the same run, in turns.
Seconds are those of the processor, so that what else runs on the machine counts little; in every cell stands the
median of the rounds, and behind it the lowest and the highest.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from math import isnan
from pathlib import Path
from statistics import median

from rich.console import Console
from rich.table import Table

#: What is measured in one process: a number by the name of each line.
Measured = dict[str, float]

_HERE = Path(__file__).resolve().parent


@contextmanager
def checkout(ref: str | None) -> Iterator[Path]:
    """The folder of a git ref's files, or of those here."""
    if ref is None:
        yield _HERE.parent
        return
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["git", "worktree", "add", "-q", "--detach", folder, ref], cwd=_HERE.parent, check=True)
        try:
            yield Path(folder)
        finally:
            subprocess.run(["git", "worktree", "remove", "-f", folder], cwd=_HERE.parent, check=True)


def measured(table: str, root: Path) -> Measured:
    """What one process measures with the files of a checkout."""
    env = {**os.environ, "PYTHONPATH": str(root)}
    env.pop("PYTHONDONTWRITEBYTECODE", None)  # the installed program keeps what is compiled
    command = [sys.executable, str(_HERE / "measuring.py"), table]
    done = subprocess.run(command, env=env, cwd=root, stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(done.stdout)


def _cell(values: list[float]) -> str:
    if not values:
        return "–"
    if any(map(isnan, values)):
        return "not installed"
    low, middle, high = (f"{value:,.3g}" if value < 100 else f"{value:,.0f}" for value in _spread(values))
    return f"{middle} ({low}–{high})"


def _spread(values: list[float]) -> tuple[float, float, float]:
    return min(values), median(values), max(values)


def _printed(title: str, rounds: list[dict[str, Measured]], lines: Callable[[Measured], Iterable[str]]) -> None:
    """A table with a column for each checkout, and how many times the second is the first."""
    labels = list(rounds[0])
    table = Table("", *labels, *(["now ÷ before"] if len(labels) > 1 else []), title=title, title_justify="left")
    for row in lines(rounds[0][labels[-1]]):
        values = [[one[label][row] for one in rounds if row in one[label]] for label in labels]
        ratio = [f"{median(values[1]) / median(values[0]):.2f}"] if len(labels) > 1 and all(values) else []
        table.add_row(row, *map(_cell, values), *ratio)
    Console(width=140).print(table)


def _slowest(rates: Measured) -> list[str]:
    """The ten smallest rates, and what is measured before them."""
    first, *families = rates
    return [first, *sorted(families, key=lambda name: rates[name])[:10]]


TABLES: dict[str, tuple[str, Callable[[Measured], Iterable[str]]]] = {
    "start": ("Starting: seconds; times of hello-world for -h and list, of the imports for the others", list),
    "drawing": ("Accepted problems of level 2 with answers and mistakes: a second", _slowest),
    "latex": ("Problems of level 2 with their working as LaTeX: a second", list),
    "judging": ("Answers judged for a problem in hand: a second", list),
    "formulas": ("Values of formulas: a second; times of what is compiled ÷ written by hand", list),
    "models": ("Optimal values of random models (4 actions, 3 outcomes each): seconds", list),
    "million": ("A million problems of level 2 with working, by what 600 cost more than 200", list),
}  # fmt: skip


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tables", nargs="*", metavar="TABLE", help=", ".join(TABLES))
    parser.add_argument("--against", metavar="REF")
    parser.add_argument("--rounds", type=int, default=3)
    asked = parser.parse_args()
    if unknown := set(asked.tables) - set(TABLES):
        parser.error(f"there is no table {', '.join(sorted(unknown))}; there are {', '.join(TABLES)}")
    with checkout(asked.against) as before:
        roots = ({asked.against: before} if asked.against else {}) | {"now": _HERE.parent}
        for name in asked.tables or TABLES:
            title, lines = TABLES[name]
            rounds = [{label: measured(name, root) for label, root in roots.items()} for _ in range(asked.rounds)]
            _printed(title, rounds, lines)


if __name__ == "__main__":
    main()
