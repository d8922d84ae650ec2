"""What worksheets and keys share: the page with its head, and the line above every problem."""

import re

from rldrill.exam.exam import Exam, Person, Version, minutes_of, points_of
from rldrill.exercise import Exercise
from rldrill.print.paper import TYPST_PAPERS
from rldrill.print.words import Words, words, written_points
from rldrill.render.mathematics.typst import plain, quoted, text
from rldrill.render.typst import PREAMBLE
from rldrill.render.typst_files import typst_file

_LONG = re.compile(r"(\S{24})(?=\S)")


def setup(exam: Exam, version: Version, what: str, *, to_fill_in: bool) -> str:
    """What stands at the head of the source.

    Args:
        exam: the exam.
        version: the version.
        what: the name of the version or its key.
        to_fill_in: whether nobody's page has room for a name.
    """
    told = words(exam.head.language)
    person = Person("", "") if version.person is None and to_fill_in else version.person
    who = "" if person is None else (
        f"name: ([{plain(told.name)}], [{broken(person.name)}]), "
        f"number: ([{plain(told.number)}], [{broken(person.number)}]), "
    )  # fmt: skip
    seed = f" · seed {exam.seed}" if exam.layout.ids else ""
    return (
        f"{typst_file('rldrill.print', 'exam.typ')}{PREAMBLE}"
        f"#show: exam-page.with(paper: {quoted(TYPST_PAPERS[exam.layout.paper])}, lang: {quoted(exam.head.language)}, "
        f"title: {quoted(f'{exam.head.title} – {what}')}, what: [{plain(what + seed)}], "
        f"{who}problem: [{plain(told.problem)}])\n"
    )


def front(exam: Exam, what: str, lines: str) -> str:
    """The title, what is said of the exam, and what this is."""
    head = exam.head
    under = " · ".join(filter(None, (head.course, head.date)))
    return f"#front([{broken(head.title)}], [{broken(under)}], [{plain(what)}])[{lines}]\n"


def broken(words: str) -> str:
    """A person's own text: no mathematics in it, and a very long word may be broken."""
    return plain(_LONG.sub("\\1\u200b", words))


def heading(exam: Exam, index: int, exercise: Exercise, *, identified: bool) -> str:
    """The line above a problem: number, title, minutes and points, and the ID where it is wanted."""
    told = words(exam.head.language)
    time = told.minutes.format(minutes_of(exercise))
    name = exercise.id if identified and exercise.id else ""
    return (
        f"#heading-line([{plain(str(index))}], [{text(exercise.problem.family.title)}], [{plain(name)}], "
        f"[{plain(f'{time} · {written_points(told, points_of(exercise))}')}])\n"
    )


def label(exercise: Exercise, letter: str) -> str:
    """The letter of a part; nothing where there is only one."""
    return plain(f"({letter})") if len(exercise.parts) > 1 else ""


def ending(exam: Exam, told: Words) -> str:
    """What stands at the end of the source: the rest of the last page stays as it is."""
    return f"#finish({'true' if exam.layout.duplex else 'false'}, [{plain(told.empty)}])\n"
