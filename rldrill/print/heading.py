"""What worksheets and keys share: the head of the pages, and the line above every problem."""

import re

from rldrill.exam.exam import Exam, Version, minutes_of, points_of
from rldrill.exercise import Exercise
from rldrill.print.paper import Paper, page_setup
from rldrill.render.mathematics.typst import text
from rldrill.render.typst_files import typst_file


def setup(exam: Exam, version: Version, paper: Paper, title: str) -> str:
    """What stands at the head of the source."""
    right = f"Version {version.code} · seed {exam.seed}"
    head = page_setup(paper, title=f"{title}, version {version.code}", left=title, right=right)
    return head + typst_file("rldrill.print", "problems.typ")


def title(exam: Exam, version: Version, kind: str) -> str:
    """The title of the exam, and which version this is."""
    words = re.sub(r"(\S{30})", "\\1\u200b", exam.head.title)  # a very long word may be broken
    return (
        "#block(width: 100%, grid(columns: (1fr, auto), column-gutter: 1em, "
        "align: (left + bottom, right + bottom), "
        f"text(1.5em, strong[{text(words)}]), text(1.2em, strong[{text(kind)} {text(version.code)}])))\n"
    )


def heading(index: int, exercise: Exercise) -> str:
    """The line above a problem: number, family, ID, minutes and points."""
    return (
        f"heading-line([{text(str(index))}], [{text(exercise.problem.family.title)}], [{text(exercise.id or '')}], "
        f"[{text(f'about {minutes_of(exercise)} min · {written_points(points_of(exercise))}')}])"
    )


def written_points(points: int) -> str:
    """Points in words."""
    return "1 point" if points == 1 else f"{points} points"
