"""A question takes no more than a third of a page: 36 lines of a terminal, with its picture and its options."""

from io import StringIO

import pytest
from rich.console import Console

import rldrill
from rldrill.problems.catalogue import selection
from rldrill.render.terminal import asked, render

MOST = 36
TOPICS = (
    "backup-diagrams", "bayes", "beyond-the-sheet", "function-approximation", "inverse-rl", "linear-methods",
    "policy-gradient",
)  # fmt: skip


@pytest.mark.parametrize("name", [family.name for family in selection(TOPICS)])
def test_a_question_takes_no_more_than_a_third_of_a_page(name: str) -> None:
    for level in (1, 2, 3):
        for seed in (1, 2) if level == 3 else (1,):
            exercise = rldrill.draw(name, level, seed)
            screen = Console(file=StringIO(), width=100)
            with screen.capture() as captured:
                screen.print(render(exercise.question()))
                for part in exercise.parts:
                    screen.print(asked(part))
            assert captured.get().rstrip().count("\n") < MOST, exercise.id
