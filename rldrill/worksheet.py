"""Worksheets: versions of one length and difficulty that share no problem, their keys and their manifest."""

import errno
import json
import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from itertools import islice
from pathlib import Path
from typing import Any

from flint import fmpq

from rldrill import __version__
from rldrill.exercise import Exercise, draw
from rldrill.paper import Paper, page_setup, pdf, write_bytes_atomically
from rldrill.problems import parts
from rldrill.problems.document import Equation
from rldrill.problems.errors import UsageError
from rldrill.problems.family import Family
from rldrill.problems.mathematics import EMPTY, Glyph, Math, Script, Tabular, number, operator, relation, row
from rldrill.problems.parts import Part
from rldrill.problems.pictures import Picture
from rldrill.render.typst import block, document, text, typst
from rldrill.render.unicode import unicode_text
from rldrill.selection import sequence
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.answers.rule import RULE
from rldrill.solutions.effort import minutes, whole
from rldrill.solutions.exact import Value, decimal

#: The version of the manifest's form.
FORMAT = 1
DEFAULT_TITLE = "Reinforcement Learning: worksheet"
_LONGEST_TITLE = 120
#: How many problems are drawn for one place of a worksheet before the family counts as used up.
_ATTEMPTS = 400
_DIGITS = 4
#: How many signs a person writes on a line.
_BY_HAND = 60
#: The most room for working that a problem demands, in centimetres; pages give more where they have it.
_MOST_SPACE = 9.0
_PER_LINE = 14
_COLUMNS = 5

Advance = Callable[[], None]


@dataclass(frozen=True)
class Version:
    """One version of a worksheet: what one person gets."""

    title: str
    seed: int
    code: str
    exercises: tuple[Exercise, ...]

    @property
    def points(self) -> int:
        """What the whole version earns."""
        return sum(map(points_of, self.exercises))


@dataclass(frozen=True)
class Sheet:
    """A worksheet in all its versions, and what it was planned from."""

    title: str
    seed: int
    names: tuple[str, ...]
    level: int | None
    versions: tuple[Version, ...]


def points_of(exercise: Exercise) -> int:
    """What a problem earns, all parts together."""
    return sum(part.points for part in exercise.parts)


def minutes_of(exercise: Exercise) -> int:
    """How many minutes a problem takes by hand, estimated from its steps."""
    return whole(minutes(exercise.solution))


# Planning


def plan(
    names: Sequence[str],
    count: int,
    level: int | None,
    seed: int,
    versions: int,
    *,
    title: str = DEFAULT_TITLE,
    advance: Advance | None = None,
) -> Sheet:
    """Choose and draw the problems; the same arguments give the same worksheet.

    Args:
        names: topics and families; all, if there are none.
        count: how many problems a version has.
        level: 1 to 3, or None for a mixture.
        seed: what the choice depends on.
        versions: how many versions; they share families and levels, and no problem.
        title: what is printed at the head.
        advance: called after each version.

    Raises:
        UsageError: a name does not exist, the title is too long, or there are too few different problems.
    """
    if len(title) > _LONGEST_TITLE:
        raise UsageError(f"The title has {len(title)} characters; give one of at most {_LONGEST_TITLE}.")
    slots = [(family, wanted) for family, wanted, _ in islice(sequence(names, level, seed), count)]
    used: set[str] = set()
    result = []
    for index in range(versions):
        seeds = (drawn for _, _, drawn in sequence(names, level, seed, index))
        exercises = tuple(_new_problem(family, wanted, seeds, used) for family, wanted in slots)
        result.append(Version(title, seed, version_code(index), exercises))
        if advance is not None:
            advance()
    return Sheet(title, seed, tuple(names), level, tuple(result))


def version_code(index: int) -> str:
    """A, B, …, Z, AA, AB, …"""
    head, last = divmod(index, 26)
    return (version_code(head - 1) if head else "") + chr(ord("A") + last)


def _new_problem(family: Family, level: int, seeds: Iterator[int], used: set[str]) -> Exercise:
    for seed in islice(seeds, _ATTEMPTS):
        exercise = draw(family.name, level, seed)
        content = json.dumps(exercise.problem.data(), sort_keys=True)
        if content not in used:
            used.add(content)
            return exercise
    raise UsageError(
        f"{family.name} has too few different problems at level {level} for this worksheet; "
        "ask for fewer versions or problems, or for more families."
    )


# Pages

_HELPERS = r"""
#let small(body) = text(0.75em, luma(90), body)
#let code(body) = text(font: "DejaVu Sans Mono", 0.62em, luma(90), body)
#let rule-line(width) = box(width: width, height: 0.9em, stroke: (bottom: 0.5pt))
#let heading-line(number, title, id, points) = block(width: 100%, sticky: true, below: 0.9em,
  grid(columns: (auto, 1fr, auto), column-gutter: 0.7em,
    align: (left + bottom, left + bottom, right + bottom),
    text(1.15em, strong(number)), [#strong(title) #h(0.5em) #code(id)], small(points)))
#let points-table(..columns) = grid(columns: columns.pos().first().len(), align: center + horizon,
  inset: (x: 0.6em, y: 0.5em), stroke: 0.4pt + luma(120), ..columns.pos().flatten())
#let checkbox = box(width: 0.8em, height: 0.8em, stroke: 0.5pt, baseline: 0.1em)
"""

_SHEET_HELPERS = r"""
#let answer-line = [Answer: #rule-line(6cm)]
#let empty-matrix(rows, columns) = math.equation(math.mat(delim: "[", row-gap: 0.25cm, column-gap: 0.25cm,
  ..range(rows).map(_ => (box(width: 1.7cm, height: 0.8cm, stroke: 0.4pt + luma(150)),) * columns)))
#let empty-table(..names) = layout(size => fitted(table(columns: names.pos().len(), align: center + horizon,
  stroke: 0.4pt + luma(120), inset: 0.4em, ..names.pos(),
  ..names.pos().map(_ => box(width: 2.3cm, height: 0.55cm))), size.width))
#let part-block(part, scale) = block(breakable: false, width: 100%, {
  block(below: 0.6em, grid(columns: (1fr, auto), column-gutter: 0.5em,
    { part.label; part.ask }, small(part.points)))
  block(width: 100%, stroke: 0.4pt + luma(190), radius: 2pt, inset: 0.6em, above: 0.6em,
    { v(calc.max(0.6cm, part.space * scale)); part.field })
})
// A problem as what stays together: its statement with the first part, then every further part.
#let problem(head, statement, ..parts) = parts.pos().enumerate().map(((index, part)) => (
  begins: index == 0,
  space: part.space,
  draw: scale => block(width: 100%, breakable: false, {
    if index == 0 { head; statement }
    part-block(part, scale)
  }),
))
// Fill pages: problems stay whole, unless no page could hold one or the first page would stay empty; then the space
// for working, little until here, grows to fill every page.
#let (least, most, most-at-the-end) = (0.6, 2.4, 1.4)
#let packed(front, problems) = context {
  let (width, height) = (page.width - 2 * margin, page.height - 2 * margin)
  let (gap, between) = (1.2em.to-absolute(), 0.9em.to-absolute())
  let taken(body) = measure(width: width, body).height
  let pages = ((chunks: (), used: taken(front)),)
  for chunks in problems {
    let heights(scale) = chunks.map(chunk => taken((chunk.draw)(scale)) + if chunk.begins { gap } else { between })
    let whole = (least, least / 2, 0).find(scale => heights(scale).sum() <= height)
    let scale = if whole == none { least } else { whole }
    let heights = heights(scale)
    let here = pages.pop()
    if here.used + heights.sum() > height {
      let begins = here.used + heights.first() <= height
      if here.chunks.len() > 0 or not begins {
        pages.push(here)
        here = (chunks: (), used: 0pt)
      }
    }
    for (chunk, tall) in chunks.zip(heights) {
      if here.used + tall > height and here.chunks.len() > 0 {
        pages.push(here)
        here = (chunks: (), used: 0pt)
      }
      here = (chunks: here.chunks + ((..chunk, scale: scale),), used: here.used + tall)
    }
    pages.push(here)
  }
  front
  for (index, here) in pages.enumerate() {
    let space = here.chunks.map(chunk => chunk.space).sum(default: 1cm)
    let more = calc.max(0, (height - here.used - 4pt) / space)
    let limit = if index + 1 == pages.len() { most-at-the-end } else { most }
    for chunk in here.chunks {
      if chunk.begins { v(gap, weak: true) }
      (chunk.draw)(calc.min(chunk.scale + more, limit))
    }
    if index + 1 < pages.len() { pagebreak(weak: true) }
  }
}
"""
_MARGIN = "2cm"


def worksheet_source(version: Version, paper: Paper) -> str:
    """The worksheet that is handed out, as Typst source."""
    problems = "".join(_problem(index, item) for index, item in enumerate(version.exercises, 1))
    return (
        f"{_setup(version, paper, version.title)}#let margin = {_MARGIN}\n{_SHEET_HELPERS}\n"
        f"#packed([{_front(version)}], ({problems}))\n"
    )


def key_source(version: Version, paper: Paper) -> str:
    """The key: for every problem the answers, then the whole working."""
    problems = "".join(_solved(index, item) for index, item in enumerate(version.exercises, 1))
    return (
        f"{_setup(version, paper, f'{version.title} – key')}{_title(version, 'Key')}"
        f"#par[{text(f'Right is {RULE}.')}]\n{problems}"
    )


def _setup(version: Version, paper: Paper, title: str) -> str:
    right = f"Version {version.code} · seed {version.seed}"
    setup = page_setup(paper, title=f"{title}, version {version.code}", left=title, right=right, margin=_MARGIN)
    return setup + _HELPERS


def _title(version: Version, kind: str) -> str:
    title = re.sub(r"(\S{30})", "\\1\u200b", version.title)  # a very long word may be broken
    return (
        "#block(width: 100%, grid(columns: (1fr, auto), column-gutter: 1em, "
        "align: (left + bottom, right + bottom), "
        f"text(1.5em, strong[{text(title)}]), text(1.2em, strong[{text(kind)} {text(version.code)}])))\n"
    )


def _front(version: Version) -> str:
    return (
        f"{_title(version, 'Version')}"
        "#block(above: 1.6em, grid(columns: (2fr, 1fr), column-gutter: 1.5em, "
        "[Name: #box(width: 1fr, height: 0.9em, stroke: (bottom: 0.5pt))], "
        "[Date: #box(width: 1fr, height: 0.9em, stroke: (bottom: 0.5pt))]))\n"
        f"{_points_tables(version)}"
        f"#par[{text(f'Answer with {RULE}. Show your working. {_time(version)}')}]\n"
    )


def _time(version: Version) -> str:
    return f"Expect to work for about {sum(map(minutes_of, version.exercises))} minutes."


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


def _heading(index: int, exercise: Exercise) -> str:
    title = exercise.problem.family.title
    return (
        f"heading-line([{text(str(index))}], [{text(title)}], [{text(exercise.id or '')}], "
        f"[{text(f'about {minutes_of(exercise)} min · {_points(points_of(exercise))}')}])"
    )


def _points(points: int) -> str:
    return "1 point" if points == 1 else f"{points} points"


def _problem(index: int, exercise: Exercise) -> str:
    spaces = zip(exercise.parts, _spaces(exercise), strict=True)
    asked = "".join(f", {_part(exercise, part, space)}" for part, space in spaces)
    return f"problem({_heading(index, exercise)}, [{document(exercise.question())}]{asked}),\n"


def _part(exercise: Exercise, part: Part, space: float) -> str:
    several = len(exercise.parts) > 1
    return (
        f"(label: [{text(f'({part.label})') + '#h(0.5em)' if several else ''}], ask: [{text(part.ask)}], "
        f"points: [{text(_points(part.points)) if several else ''}], space: {space:.1f}cm, "
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


# Keys


def _solved(index: int, exercise: Exercise) -> str:
    answers = "".join(_answer(exercise, part) for part in exercise.parts)
    return (
        f"#block(above: 1.8em, sticky: true, {_heading(index, exercise)})\n"
        f"#block(width: 100%, fill: luma(240), radius: 2pt, inset: 0.7em, sticky: true)[{answers}]\n"
        f"{document(exercise.working())}"
    )


def _answer(exercise: Exercise, part: Part) -> str:
    label = text(f"({part.label})") if len(exercise.parts) > 1 else ""
    written = answer_lines(part, exercise.solution.answers[part.label])
    body = block(Equation(EMPTY, written, ("",) * len(written)))
    return f"#grid(columns: (auto, 1fr), column-gutter: 0.6em, align: horizon, [{label}], [{body}])\n"


def answer_lines(part: Part, value: Any) -> tuple[Math, ...]:
    """The answer of a part as equations, each number exact and then as a decimal."""
    kind = answer_kind(part.kind)
    cells = list(kind.cells(value).values())
    lines = kind.lines(value)
    if len(lines) != len(cells):
        return tuple(_equation(left, right, _rounded_grid(right, cells)) for left, right in lines)
    return tuple(_equation(left, right, rounded(cell)) for (left, right), cell in zip(lines, cells, strict=True))


def _equation(left: Math | None, right: Math, decimals: tuple[str, Math] | None) -> Math:
    head = () if left is None else (left, relation("="))
    tail = () if decimals is None else (relation(decimals[0]), decimals[1])
    return row(*head, right, *tail)


def rounded(value: Any) -> tuple[str, Math] | None:
    """A number as a decimal of at most four digits, and whether it equals that or nearly.

    None for a whole number, for an action, and while a parameter is open.
    """
    if isinstance(value, str | tuple | bool) or (isinstance(value, fmpq) and value.q == 1):
        return None
    written = decimal(value, _DIGITS)
    if written is None:
        return None
    shortened = Decimal(written)
    return ("=" if _is_exactly(value, shortened) else "≈"), _decimal(shortened)


def _is_exactly(value: Value, shortened: Decimal) -> bool:
    return isinstance(value, fmpq) and Fraction(int(value.p), int(value.q)) == Fraction(shortened)


def _decimal(value: Decimal) -> Math:
    exponent = value.adjusted()
    if -_DIGITS <= exponent <= 2 * _DIGITS or not value:
        return number(f"{value:f}")
    power = Script(Glyph("10", "number"), above=number(exponent))
    return row(number(f"{value.scaleb(-exponent):f}"), operator("·"), power)


def _rounded_grid(grid: Math, cells: Sequence[Value]) -> tuple[str, Math] | None:
    decimals = [rounded(cell) for cell in cells]
    if not isinstance(grid, Tabular) or not any(decimals):
        return None
    exact = [entry for line in grid.rows for entry in line]
    entries = [entry if pair is None else pair[1] for entry, pair in zip(exact, decimals, strict=True)]
    width = len(grid.rows[0])
    lines = tuple(tuple(entries[start : start + width]) for start in range(0, len(entries), width))
    sign = "=" if all(pair is None or pair[0] == "=" for pair in decimals) else "≈"
    return sign, Tabular(lines, grid.left, grid.right)


# Files


def manifest(sheet: Sheet, paper: Paper) -> dict[str, Any]:
    """What was printed: enough to print the keys again or to grade, also after a family has changed."""
    return {
        "format": FORMAT,
        "rldrill": __version__,
        "title": sheet.title,
        "seed": sheet.seed,
        "level": sheet.level,
        "names": list(sheet.names),
        "paper": paper.name,
        "versions": [
            {
                "code": version.code,
                "points": version.points,
                "problems": [_entry(index, item) for index, item in enumerate(version.exercises, 1)],
            }
            for version in sheet.versions
        ],
    }


def _entry(index: int, exercise: Exercise) -> dict[str, Any]:
    asked = [{"part": part.label, "kind": part.kind.name, "points": part.points} for part in exercise.parts]
    entry = {"number": index, "id": exercise.id, "points": points_of(exercise), "parts": asked}
    return entry | {"problem": exercise.problem.data()}


def check_output(output: Path) -> None:
    """Refuse a path that a worksheet cannot be written to, before any work is done.

    Raises:
        UsageError: it is a folder, does not end in ``.pdf``, or a file that is no manifest is in the way.
        FileNotFoundError: its folder does not exist.
    """
    if output.is_dir():
        raise UsageError(f"{output} is a folder; give the name of a PDF file, such as {output / 'worksheet.pdf'}.")
    if output.suffix.lower() != ".pdf":
        raise UsageError(f"{output} does not end in .pdf; a worksheet is written as PDF.")
    if not output.parent.is_dir():
        raise FileNotFoundError(errno.ENOENT, "No such folder", str(output.parent))
    beside = output.with_suffix(".json")
    if beside.exists() and not _is_manifest(beside):
        raise UsageError(f"{beside} would be overwritten, but is not a worksheet's manifest; choose another name.")


def _is_manifest(path: Path) -> bool:
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False
    return isinstance(data, dict) and "rldrill" in data and "versions" in data


def write(sheet: Sheet, output: Path, paper: Paper, advance: Advance | None = None) -> list[Path]:
    """Write every version, its key, and the manifest; nothing is written before all of it is typeset.

    Args:
        sheet: the worksheet.
        output: ``FILE.pdf``; beside it come ``FILE-key.pdf`` and ``FILE.json``, and with several versions
            ``FILE-A.pdf``, ``FILE-A-key.pdf`` and so on in its place.
        paper: the paper.
        advance: called after each version.

    Returns:
        The files, in the order in which they were written.

    Raises:
        UsageError: the path does not fit.
        OSError: a file cannot be written; ``filename`` says which.
    """
    check_output(output)
    files: dict[Path, bytes] = {}
    for version in sheet.versions:
        ending = f"-{version.code}" if len(sheet.versions) > 1 else ""
        stem = f"{output.stem}{ending}"
        files[output.with_name(f"{stem}{output.suffix}")] = pdf(worksheet_source(version, paper))
        files[output.with_name(f"{stem}-key{output.suffix}")] = pdf(key_source(version, paper))
        if advance is not None:
            advance()
    data = json.dumps(manifest(sheet, paper), ensure_ascii=False, indent=2) + "\n"
    files[output.with_suffix(".json")] = data.encode()
    for path, content in files.items():
        write_bytes_atomically(path, content)
    return list(files)
