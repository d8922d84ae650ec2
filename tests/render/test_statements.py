"""A statement fits on a third of a page: what is told, drawn and asked, as a terminal of 100 columns shows it."""

import pytest
from rich.console import Group

from rldrill.exercise import draw
from rldrill.problems.catalogue import families, family
from rldrill.render.terminal import asked, console, render

#: The lines that a third of a page holds.
MOST = 36
#: Long draws: three episodes with both policies, three states with two policies, a model that has changed.
LONGEST = (
    ("importance-sampling", 2, 3),
    ("importance-sampling", 3, 0),
    ("policy-improvement-theorem", 2, 19),
    ("policy-improvement-theorem", 3, 18),
    ("dyna-q", 3, 3),
    ("policy-evaluation", 2, 27),
    ("bellman-residual", 2, 26),
)


def lines(name: str, level: int, seed: int) -> int:
    exercise = draw(name, level, seed)
    screen = console()
    screen.width = 100
    blocks = Group(render(exercise.question()), *(asked(part) for part in exercise.parts))
    with screen.capture() as captured:
        screen.print(blocks)
    return len(captured.get().rstrip().splitlines())


@pytest.mark.parametrize(("name", "level", "seed"), LONGEST)
def test_the_longest_draws_fit(name: str, level: int, seed: int) -> None:
    assert lines(name, level, seed) <= MOST


@pytest.mark.parametrize("name", families())
def test_every_family_fits_at_every_level(name: str) -> None:
    assert all(lines(name, level, 5) <= MOST for level in family(name).levels)
