"""The key of a worksheet: for every problem what is asked, the answers, the working with points, typical mistakes."""

from rldrill.exam.exam import Exam, Version
from rldrill.exercise import Exercise
from rldrill.print.exam_page import ending, front, heading, label, setup
from rldrill.print.solved import solved_part
from rldrill.print.words import words
from rldrill.print.worksheet import options
from rldrill.render.mathematics.typst import plain, text
from rldrill.render.typst import document, long_or_not


def key_source(exam: Exam, version: Version) -> str:
    """The key, as Typst source."""
    told = words(exam.head.language)
    what = f"{told.key} {version.code}"
    problems = "".join(_solved(exam, index, item) for index, item in enumerate(version.exercises, 1))
    head = setup(exam, version, what, to_fill_in=False)
    return f"{head}{front(exam, what, f'#par[{plain(told.right)}]')}{problems}{ending(exam, told)}"


def _solved(exam: Exam, index: int, exercise: Exercise) -> str:
    parts = "".join(
        f"#asked-short[{label(exercise, part.label)} {text(part.ask)}{options(part)}]\n"
        f"{solved_part(exam, exercise, part)}"
        for part in exercise.parts
    )
    question = exercise.question()
    stated = f"#asked-short([{document(question)}]{long_or_not(question)})\n"
    return f"{heading(exam, index, exercise, identified=True)}{stated}{parts}"
