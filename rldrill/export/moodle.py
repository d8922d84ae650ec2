"""An exam as Moodle XML: a cloze question for every problem, with our tolerance and the mistakes as feedback."""

import re
from base64 import b64encode
from collections.abc import Callable, Iterator, Sequence
from html import escape
from math import gcd, lcm
from xml.etree import ElementTree

from rldrill.exam.choices import Language
from rldrill.exam.exam import Exam, Head, points_of
from rldrill.exercise import Exercise
from rldrill.export.asked import Cell, Word, Wrong, cells, is_open, label, said_of_words, told_apart, wrong_answers
from rldrill.export.with_files import WithFiles, matrix_rows
from rldrill.export.words import note, page_words
from rldrill.problems.parts import Choice, Matrix, Part
from rldrill.render.mathematics.unicode import inline

#: What stands before the names of files.
_PLACE = "@@PLUGINFILE@@/"
#: What ends an answer or a feedback in a box of cloze, or keeps another sign from doing so.
_SPECIAL = re.compile(r"[\\{}#~]")


def moodle_exam(exam: Exam, *, practice: bool, advance: Callable[[], None] = lambda: None) -> bytes:
    """All versions in one file, each in a category of its own.

    Args:
        exam: the exam.
        practice: whether the working is told after an attempt.
        advance: called after each version.
    """
    quiz = ElementTree.Element("quiz")
    times = _times([exercise for version in exam.versions for exercise in version.exercises])
    for version in exam.versions:
        category = ElementTree.SubElement(quiz, "question", type="category")
        name = exam.head.title.replace("/", "//") + (f"/{version.code}" if len(exam.versions) > 1 else "")
        _text(ElementTree.SubElement(category, "category"), f"$course$/top/{name}")
        for number, exercise in enumerate(version.exercises, 1):
            quiz.append(_question(exam.head, number, exercise, times, practice=practice))
        advance()
    ElementTree.indent(quiz)
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + ElementTree.tostring(quiz, encoding="utf-8") + b"\n"


def _text(parent: ElementTree.Element, text: str) -> ElementTree.Element:
    ElementTree.SubElement(parent, "text").text = text
    return parent


def _html(question: ElementTree.Element, tag: str, text: str, writer: WithFiles | None = None) -> None:
    element = _text(ElementTree.SubElement(question, tag, format="html"), text)
    for name, drawing in writer.files.items() if writer else ():
        file = ElementTree.SubElement(element, "file", name=name, path="/", encoding="base64")
        file.text = b64encode(drawing.encode()).decode()


def _times(exercises: Sequence[Exercise]) -> int:
    """By how much all points are multiplied: Moodle adds up the weights of the boxes, which are whole numbers."""
    parts = [(part.points, len(cells(exercise, part))) for exercise in exercises for part in exercise.parts]
    return lcm(*(boxes // gcd(points, boxes) for points, boxes in parts))


def _question(head: Head, number: int, exercise: Exercise, times: int, *, practice: bool) -> ElementTree.Element:
    asked = [cell for part in exercise.parts for cell in cells(exercise, part)]
    by_hand = any(map(is_open, asked))
    question = ElementTree.Element("question", type="essay" if by_hand else "cloze")
    _text(ElementTree.SubElement(question, "name"), f"{number:02} {inline(exercise.problem.family.title)}")
    writer, solved = WithFiles("picture", _PLACE), WithFiles("picture", _PLACE)
    told = note(head, asked, reads="both")
    body = writer.blocks(exercise.question()) + (f"<p><em>{told}</em></p>" if told else "")
    _html(
        question,
        "questiontext",
        body + "".join(_parts(writer, head.language, exercise, times, by_hand=by_hand)),
        writer,
    )
    working = "".join(solved.solved(exercise, part, head.language) for part in exercise.parts)
    _html(question, "generalfeedback", working if practice else "", solved if practice else None)
    if by_hand:
        ElementTree.SubElement(question, "defaultgrade").text = str(times * points_of(exercise))
        ElementTree.SubElement(question, "responseformat").text = "editor"
        _html(question, "graderinfo", working, solved)
    if exercise.id:
        ElementTree.SubElement(question, "idnumber").text = exercise.id
    return question


def _parts(writer: WithFiles, language: Language, exercise: Exercise, times: int, *, by_hand: bool) -> Iterator[str]:
    asked = {part.label: cells(exercise, part, language) for part in exercise.parts}
    for part in exercise.parts:
        yield f"<p>{label(exercise, part)}{writer.text(part.ask)}</p>"
        if by_hand:
            continue
        weight = times * part.points // len(asked[part.label])
        wrong = tuple(wrong_answers(exercise, part))
        boxes = [_box(language, part, cell, index, weight, wrong) for index, cell in enumerate(asked[part.label])]
        yield _laid_out(writer, part, asked[part.label], boxes)


def _laid_out(writer: WithFiles, part: Part, asked: Sequence[Cell], boxes: Sequence[str]) -> str:
    if isinstance(part.kind, Matrix):
        return f"<table>{matrix_rows(boxes, part.kind)}</table>"
    lefts = ("" if cell.left is None else f"{writer.math(cell.left)} = " for cell in asked)
    options = ""
    if isinstance(part.kind, Choice):
        options = "".join(f"<p>({letter}) {writer.text(text)}</p>" for letter, text in part.kind.options.items())
    return options + "".join(f"<p>{left}{box}</p>" for left, box in zip(lefts, boxes, strict=True))


def _box(language: Language, part: Part, cell: Cell, index: int, weight: int, wrong: Sequence[Wrong]) -> str:
    if isinstance(cell, Word):
        return _options(part, cell, weight, wrong)
    right = page_words(language).right
    answers = [f"={cell.decimal}:{cell.tolerance}#{_escaped(right)}"]
    for other, says in told_apart(cell, index, wrong):
        answers.append(f"%0%{other.decimal}:{other.tolerance}#{_escaped(says)}")
    return f"{{{weight}:NUMERICAL:{'~'.join(answers)}}}"


def _options(part: Part, cell: Word, weight: int, wrong: Sequence[Wrong]) -> str:
    says = said_of_words(wrong)
    answers = []
    for option, text in cell.options.items():
        shown = _escaped(option if isinstance(part.kind, Choice) else text)  # what a letter stands for is told above
        answers.append(f"={shown}" if option in cell.right else f"{shown}#{_escaped(says.get(option, ''))}")
    return f"{{{weight}:MULTICHOICE:{'~'.join(answers)}}}"


def _escaped(text: str) -> str:
    """A text inside a cloze box: HTML, whose signs are written so that none of them is one of the box.

    Moodle undoes entities once and then takes backslashes away before two signs only, so they are of no use.
    """
    return _harmless(_harmless(inline(text)))


def _harmless(text: str) -> str:
    return _SPECIAL.sub(lambda sign: f"&#{ord(sign[0])};", escape(text, quote=False))
