"""The worksheet that is handed out: problems with room for working and answers."""

import math
from fractions import Fraction

from rldrill.exam.exam import Exam, Version, points_of
from rldrill.exercise import Exercise
from rldrill.print.exam_page import broken, ending, front, heading, label, setup
from rldrill.print.solved import solved_part
from rldrill.print.words import Words, words, written_time
from rldrill.problems import parts
from rldrill.problems.document import Paragraph
from rldrill.problems.notations import all_in_notation
from rldrill.problems.parts import Part
from rldrill.render.mathematics.typst import equation, plain, text
from rldrill.render.typst import document, long_or_not
from rldrill.render.unicode import unicode_text
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.effort import minutes_of

#: The least room for a minute of working, in centimetres; pages give more where they have it. A part that is only
#: ticked has none, and what takes long has room for twelve minutes.
SPACES = {"tight": Fraction(3, 10), "normal": Fraction(4, 10), "wide": Fraction(1)}
_LEAST, _LONGEST = Fraction(8, 10), 12
_PER_LINE = 14
#: So many options stand side by side at most, where a line has room for so many signs, with so many between them.
_OPTIONS, _LINE, _BETWEEN = 4, 108, 8
#: How wide the cells for answers are, and how many stand side by side at most; wider for answers with letters in them.
_NARROW, _WIDE = ("2.4cm", 5), ("5.2cm", 3)
#: A table of more lines for answers is broken across pages.
_LONG_TABLE = 9


def worksheet_source(exam: Exam, version: Version) -> str:
    """The worksheet that is handed out, as Typst source; with the solutions in it where they are wanted inline."""
    told = words(exam.head.language)
    what = f"{told.version} {version.code}"
    problems = "".join(_problem(exam, version, index) for index in range(1, len(version.exercises) + 1))
    lines = f"{_points_tables(version, told)}#par[{_instructions(exam, version, told)}]\n"
    head = setup(exam, version, what, to_fill_in=True)
    return f"{head}{front(exam, what, lines)}{problems}{ending(exam, told)}"


def _instructions(exam: Exam, version: Version, told: Words) -> str:
    time = written_time(told, exam.head.duration, version.minutes)
    own = f"{broken(exam.head.instructions)} " if exam.head.instructions else ""
    return own + plain(f"{told.rule} {told.show} {time}")


def _points_tables(version: Version, told: Words) -> str:
    columns = [(str(index), str(points_of(item))) for index, item in enumerate(version.exercises, 1)]
    columns.append((told.total, str(version.points)))
    result = []
    width = math.ceil(len(columns) / math.ceil(len(columns) / _PER_LINE))
    for start in range(0, len(columns), width):
        group = columns[start : start + width]
        lines = [
            (told.problem, *(head for head, _ in group)),
            (told.points.capitalize(), *(value for _, value in group)),
            (told.reached, *("" for _ in group)),
        ]
        cells = ", ".join("(" + ", ".join(f"[{plain(cell)}]" for cell in line) + ")" for line in lines)
        result.append(f"#points-table({cells})\n")
    return "".join(result)


def _problem(exam: Exam, version: Version, index: int) -> str:
    """A problem; the last part of all stays with the one before, so that it is not alone on the last page."""
    exercise = version.exercises[index - 1]
    kept = exercise.parts[-2:-1] if index == len(version.exercises) else ()
    if index == 1 and len(exercise.parts) == 2:  # the page would be left to the title
        kept = ()
    asked = "".join(_part(exam, exercise, part, together=part in kept) for part in exercise.parts)
    question = exercise.question()
    stated = f"#statement([{document(question)}]{long_or_not(question)})\n"
    return f"{heading(exam, index, exercise, identified=exam.layout.ids)}{stated}{asked}"


def _part(exam: Exam, exercise: Exercise, part: Part, *, together: bool) -> str:
    told = words(exam.head.language)
    ask = f"#asked([{label(exercise, part.label)}], [{text(part.ask)}], [{part.points}])\n"
    if exam.layout.solutions == "inline":
        return f"{ask}{options(part)}{solved_part(exam, exercise, part)}"
    space = space_of(exercise, part, exam.layout.space)
    field, long = _field(exercise, part, told)
    kept = ", long: true" if long else ", together: true" if together else ""
    return f"{ask}#working({float(space):.1f}cm, {float(space):.1f})\n#field([{field}]{kept})\n"


def space_of(exercise: Exercise, part: Part, space: str) -> Fraction:
    """The room for working in a part, in centimetres: it follows the minutes that the part takes."""
    if isinstance(part.kind, parts.Choice | parts.YesNo) or space == "none":
        return Fraction(0)
    room = minutes_of(exercise.solution, part.label) * SPACES[space]
    return min(max(room, _LEAST), _LONGEST * SPACES[space])


def options(part: Part) -> str:
    """What there is to choose from, where there is: in columns, one read after the other, if it is short."""
    if not isinstance(part.kind, parts.Choice):
        return ""
    lines = [f"({key}) {option}" for key, option in part.kind.options.items()]
    widest = max(len(unicode_text(Paragraph(line))) for line in lines)
    rows = math.ceil(len(lines) / min(_OPTIONS, max(1, _LINE // (widest + _BETWEEN))))
    across = [line for row in range(rows) for line in lines[row::rows]]
    return f"#choices({math.ceil(len(lines) / rows)}, {', '.join(f'[{text(line)}]' for line in across)})\n"


def _field(exercise: Exercise, part: Part, told: Words) -> tuple[str, bool]:
    """The place for an answer, and whether it is broken across pages."""
    match part.kind:
        case parts.Matrix(rows, columns) if rows * columns > 1:
            return f"#empty-matrix([{plain(told.answer)}], {rows}, {columns})", False
        case parts.Choice():
            return options(part), False
        case parts.YesNo():
            return f"#checkbox #h(0.4em) {plain(told.yes)} #h(2em) #checkbox #h(0.4em) {plain(told.no)}", False
        case kind:
            lines = answer_kind(kind).lines(exercise.solution.answers[part.label])
            lefts = all_in_notation([left for left, _ in lines if left is not None])
            names = [f"[{equation(left)}]" for left in lefts]
            cell, most = _WIDE if exercise.solution.problem.parameters else _NARROW
            if not names:
                return f"#answer-line([{plain(told.answer)}])", False
            columns = even_columns(len(names), most)
            long = math.ceil(len(names) / columns) > _LONG_TABLE
            table = "long-table" if long else "empty-table"
            return f"#{table}({columns}, {cell}, {', '.join(names)})", long


def even_columns(cells: int, most: int) -> int:
    """How many cells stand side by side, so that no line is much shorter than the others."""
    return math.ceil(cells / math.ceil(cells / most)) if cells else 1
