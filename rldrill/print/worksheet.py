"""The worksheet that is handed out: problems with room for working and answers."""

import math

from rldrill.exam.exam import Exam, Version, points_of
from rldrill.exercise import Exercise
from rldrill.print.heading import heading, setup, title, written_points
from rldrill.print.paper import Paper
from rldrill.problems import parts
from rldrill.problems.parts import Part
from rldrill.problems.pictures import Picture
from rldrill.render.mathematics.typst import text, typst
from rldrill.render.typst import document
from rldrill.render.typst_files import typst_file
from rldrill.render.unicode import unicode_text
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.answers.rule import RULE

#: How many signs a person writes on a line.
_BY_HAND = 60
#: The most room for working that a problem demands, in centimetres; pages give more where they have it.
_MOST_SPACE = 9.0
_PER_LINE = 14
_COLUMNS = 5


def worksheet_source(exam: Exam, version: Version, paper: Paper) -> str:
    """The worksheet that is handed out, as Typst source."""
    problems = "".join(_problem(index, item) for index, item in enumerate(version.exercises, 1))
    return (
        f"{setup(exam, version, paper, exam.head.title)}{typst_file('rldrill.print', 'worksheet.typ')}"
        f"#packed([{_front(exam, version)}], ({problems}))\n"
    )


def _front(exam: Exam, version: Version) -> str:
    return (
        f"{title(exam, version, 'Version')}"
        "#block(above: 1.6em, grid(columns: (2fr, 1fr), column-gutter: 1.5em, "
        "[Name: #box(width: 1fr, height: 0.9em, stroke: (bottom: 0.5pt))], "
        "[Date: #box(width: 1fr, height: 0.9em, stroke: (bottom: 0.5pt))]))\n"
        f"{_points_tables(version)}"
        f"#par[{text(f'Answer with {RULE}. Show your working. {_time(version)}')}]\n"
    )


def _time(version: Version) -> str:
    return f"Expect to work for about {version.minutes} minutes."


def _points_tables(version: Version) -> str:
    columns = [(str(index), str(points_of(item))) for index, item in enumerate(version.exercises, 1)]
    columns.append(("Total", str(version.points)))
    result = []
    width = math.ceil(len(columns) / math.ceil(len(columns) / _PER_LINE))
    for start in range(0, len(columns), width):
        group = columns[start : start + width]
        lines = [("Problem", *(head for head, _ in group)), ("Points", *(value for _, value in group))]
        lines.append(("Reached", *("" for _ in group)))
        cells = ", ".join("(" + ", ".join(f"[{text(cell)}]" for cell in line) + ")" for line in lines)
        result.append(f"#block(text(0.9em, points-table({cells})))\n")
    return "".join(result)


def _problem(index: int, exercise: Exercise) -> str:
    spaces = zip(exercise.parts, _spaces(exercise), strict=True)
    asked = "".join(f", {_part(exercise, part, space)}" for part, space in spaces)
    return f"problem({heading(index, exercise)}, [{document(exercise.question())}]{asked}),\n"


def _part(exercise: Exercise, part: Part, space: float) -> str:
    several = len(exercise.parts) > 1
    return (
        f"(label: [{text(f'({part.label})') + '#h(0.5em)' if several else ''}], ask: [{text(part.ask)}], "
        f"points: [{text(written_points(part.points))}], space: {space:.1f}cm, "
        f"field: [{_field(exercise, part)}])"
    )


def _spaces(exercise: Exercise) -> list[float]:
    """The least room for working in every part, in centimetres: it grows with the printed working."""
    heights = []
    for part in exercise.parts:
        written = (item for item in exercise.working(part.label) if not isinstance(item, Picture))
        lengths = [len(unicode_text(item)) for item in written]
        heights.append(1.2 + 0.6 * sum(math.ceil(length / _BY_HAND) for length in lengths))
    most = _MOST_SPACE / max(_MOST_SPACE, sum(heights))
    return [height * most for height in heights]


def _field(exercise: Exercise, part: Part) -> str:
    match part.kind:
        case parts.Matrix(rows, columns) if rows * columns > 1:
            return f"Answer: #empty-matrix({rows}, {columns})"
        case parts.Choice(options):
            return " ".join(f"#block[#checkbox {text(f'({key}) {option}')}]" for key, option in options.items())
        case parts.YesNo():
            return "#checkbox yes #h(2em) #checkbox no"
        case kind:
            lines = answer_kind(kind).lines(exercise.solution.answers[part.label])
            names = [f"${typst(left)}$" for left, _ in lines if left is not None]
            groups = [names[start : start + _COLUMNS] for start in range(0, len(names), _COLUMNS)]
            return "".join(f"#empty-table({', '.join(group)})\n" for group in groups) or "#answer-line"
