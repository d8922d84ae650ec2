"""The key of a worksheet: for every problem the answers, each exact and as a decimal, then the whole working."""

from rldrill.exam.exam import Exam, Version
from rldrill.exercise import Exercise
from rldrill.print.heading import heading, setup, title
from rldrill.print.paper import Paper
from rldrill.problems.parts import Part
from rldrill.render.mathematics.typst import text
from rldrill.render.typst import block, document
from rldrill.solutions.answers.rule import RULE


def key_source(exam: Exam, version: Version, paper: Paper) -> str:
    """The key: for every problem the answers, then the whole working."""
    problems = "".join(_solved(index, item) for index, item in enumerate(version.exercises, 1))
    return (
        f"{setup(exam, version, paper, f'{exam.head.title} – key')}{title(exam, version, 'Key')}"
        f"#par[{text(f'Right is {RULE}.')}]\n{problems}"
    )


def _solved(index: int, exercise: Exercise) -> str:
    answers = "".join(_answer(exercise, part) for part in exercise.parts)
    return (
        f"#block(above: 1.8em, sticky: true, {heading(index, exercise)})\n"
        f"#block(width: 100%, fill: luma(240), radius: 2pt, inset: 0.7em, sticky: true)[{answers}]\n"
        f"{document(exercise.working())}"
    )


def _answer(exercise: Exercise, part: Part) -> str:
    label = text(f"({part.label})") if len(exercise.parts) > 1 else ""
    body = block(exercise.answer(part))
    return f"#grid(columns: (auto, 1fr), column-gutter: 0.6em, align: horizon, [{label}], [{body}])\n"
