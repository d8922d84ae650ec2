"""An exam as a page of the web: readable on a phone, printable, and for practice judged where it stands."""

from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

from rldrill.exam.choices import DecimalMark, Language
from rldrill.exam.exam import Exam, Version, points_of
from rldrill.exercise import Exercise
from rldrill.export.asked import Cell, Quantity, Word, answer, cells, label, wrong_answers
from rldrill.export.page import beside, embedded, page
from rldrill.export.words import PageWords, page_words
from rldrill.print.words import words, written_points, written_time
from rldrill.problems.parts import Choice, Matrix, Part, Policy, YesNo
from rldrill.render.html import Html
from rldrill.render.mathematics.mathml import mathml

#: Of so many wrong answers to a part, the likeliest, the page shows how they read a formula: it is long to write.
_READ = 8
#: How a page is written.
HTML = Html()


def html_exam(exam: Exam, version: Version, *, practice: bool) -> str:
    """A version as one page.

    Args:
        exam: the exam.
        version: which of its versions.
        practice: whether the page judges, hints and shows the working; else nothing of the answers is in it.
    """
    problems = "".join(
        _problem(exam, number, exercise, practice=practice) for number, exercise in enumerate(version.exercises, 1)
    )
    told = page_words(exam.head.language)
    score = '<p id="score" role="status"></p>\n' if practice else ""
    return page(
        exam.title_of(version),
        _front(exam, version) + problems + score,
        language=exam.head.language,
        more=scripts(tasks(enumerate(version.exercises, 1)), told, mark=exam.head.decimal_mark) if practice else "",
    )


def scripts(tasks: dict[str, Any], told: PageWords, *, mark: DecimalMark = ".") -> str:
    """What judges in the page, and what it judges by; with a decimal comma it reads 0,5 as 1/2."""
    data = embedded({"tasks": tasks, "score": told.score, "told": {**told.verdicts, "comma": mark == ","}})
    return (
        f'<script type="application/json" id="tasks">{data}</script>\n'
        f"<script>\n{beside('judge.js')}{beside('page.js')}</script>\n"
    )


def tasks(numbered: Iterable[tuple[int, Exercise]]) -> dict[str, Any]:
    """For the form of every part: its cells with what is right in them, and the wrong answers that are known."""
    return {_form_name(number, part): task(exercise, part) for number, exercise in numbered for part in exercise.parts}


def task(exercise: Exercise, part: Part) -> dict[str, Any]:
    """What the page must know to judge a part."""
    return {
        "parameters": list(exercise.problem.parameters),
        "cells": [
            {"name": cell.name, "words": list(cell.right)}
            if isinstance(cell, Word)
            else {"name": cell.name, "key": cell.exact}
            for cell in cells(exercise, part)
        ],
        "mistakes": [
            {"cells": _known(part, wrong.cells), "says": wrong.says}
            | ({} if wrong.read is None or index >= _READ else {"read": HTML.block(wrong.read)})
            for index, wrong in enumerate(wrong_answers(exercise, part))
        ],
    }


def _known(part: Part, typed: Sequence[str]) -> list[Any]:
    """The cells of a wrong answer: a word is one of a list, as in the key."""
    return [[word] for word in typed] if isinstance(part.kind, Choice | YesNo | Policy) else list(typed)


def _form_name(number: int, part: Part) -> str:
    """The name of a part's form."""
    return f"part-{number}-{part.label}"


def _front(exam: Exam, version: Version) -> str:
    head, told = exam.head, words(exam.head.language)
    place = " · ".join(filter(None, (head.course, head.date)))
    who = "" if version.person is None else f"{told.name}: {version.person.name} · {version.person.number}"
    code = f"{told.version} {version.code}" if len(exam.versions) > 1 else ""
    points = f"{told.total}: {written_points(told, version.points)}"
    time = written_time(told, head.duration, version.minutes)
    lines = (place, who, " · ".join(filter(None, (code, points))), f"{told.rule} {time}", head.instructions)
    below = "".join(f"<p>{escape(line)}</p>" for line in lines if line)
    return f"<header>\n<h1>{escape(head.title)}</h1>\n{below}\n</header>\n"


def _problem(exam: Exam, number: int, exercise: Exercise, *, practice: bool) -> str:
    told, language = words(exam.head.language), exam.head.language
    identity = f" · {exercise.id}" if exam.layout.ids and exercise.id else ""
    parts = "".join(part_form(language, number, exercise, part, practice=practice) for part in exercise.parts)
    return (
        f'<section aria-labelledby="problem-{number}">\n<h2 id="problem-{number}">{told.problem} {number}: '
        f"{HTML.text(exercise.problem.family.title)} <small>({written_points(told, points_of(exercise))}"
        f"{escape(identity)})</small></h2>\n{HTML.blocks(exercise.question())}\n{parts}</section>\n"
    )


def part_form(language: Language, number: int, exercise: Exercise, part: Part, *, practice: bool) -> str:
    """A part as a form: what is asked, boxes for the answer, and for practice all that helps."""
    name = _form_name(number, part)
    tag = "form" if practice else "div"
    told, said = words(language), page_words(language)
    worth = f" <small>({written_points(told, part.points)})</small>" if len(exercise.parts) > 1 else ""
    judged = f'<button type="submit">{said.check}</button><output></output>\n' if practice else ""
    helps = _helps(language, exercise, part) if practice else ""
    extra = ' autocomplete="off"' if practice else ""
    return (
        f'<{tag} class="part" id="{name}"{extra}>\n'
        f'<fieldset><legend class="ask">{label(exercise, part)}{HTML.text(part.ask)}{worth}</legend>\n'
        f"{_boxes(language, part, cells(exercise, part, language))}</fieldset>\n{judged}{helps}</{tag}>\n"
    )


def _helps(language: Language, exercise: Exercise, part: Part) -> str:
    said, found = page_words(language), answer(exercise, part, words(language))
    return (
        f'<details class="hint"><summary>{said.hint}</summary>{HTML.blocks(exercise.hint(part.label))}</details>\n'
        f'<details class="working"><summary>{said.working}</summary>{HTML.block(found)}'
        f"{HTML.blocks(exercise.working(part.label))}</details>\n"
    )


def _boxes(language: Language, part: Part, asked: Sequence[Cell]) -> str:
    if isinstance(part.kind, Choice | YesNo):
        (only,) = asked
        assert isinstance(only, Word)
        options = "".join(_option(part, value, text) for value, text in only.options.items())
        return f'<div class="options">{options}</div>\n'
    if isinstance(part.kind, Matrix):
        boxes = "".join(_box(language, index, cell) for index, cell in enumerate(asked))
        return (
            f'<div class="cells matrix" style="grid-template-columns: repeat({part.kind.columns}, minmax(3.2em, 6em))">'
            f"{boxes}</div>\n"
        )
    boxes = "".join(f"<label>{_left(cell)}{_box(language, i, cell)}</label>" for i, cell in enumerate(asked))
    return f'<div class="cells{" single" if len(asked) == 1 else ""}">{boxes}</div>\n'


def _left(cell: Cell) -> str:
    return "" if cell.left is None else f'{mathml(cell.left)}<span aria-hidden="true">=</span>'


def _option(part: Part, value: str, text: str) -> str:
    letter = f"({escape(value)}) " if isinstance(part.kind, Choice) else ""
    return (
        f'<label><input type="radio" name="cell-0" value="{escape(value)}">'
        f"<span>{letter}{HTML.text(text)}</span></label>"
    )


def _box(language: Language, index: int, cell: Cell) -> str:
    called = escape(cell.name or words(language).answer)
    if isinstance(cell, Quantity):
        return (
            f'<input type="text" name="cell-{index}" data-cell="{index}" aria-label="{called}" autocomplete="off" '
            'autocapitalize="none" spellcheck="false">'
        )
    options = "".join(f'<option value="{escape(option)}">{escape(option)}</option>' for option in cell.options)
    return (
        f'<select name="cell-{index}" data-cell="{index}" aria-label="{called}">'
        f'<option value="">{page_words(language).choose}</option>{options}</select>'
    )
