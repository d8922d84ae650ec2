"""The manifest of an exam: all that was printed, as JSON, from which it is graded and printed again years later."""

import json
import re
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Annotated, Any, TypeGuard

from msgspec import Struct
from msgspec.structs import asdict, replace
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError

from rldrill import __version__
from rldrill.exam.blueprint import Notation
from rldrill.exam.choices import DecimalMark, Language, Paper, Partial, Solutions, Space
from rldrill.exam.exam import Exam, Head, Layout, Person, Version, minutes_of, points_of
from rldrill.exam.fairness import fairness
from rldrill.exercise import Exercise, read
from rldrill.files import read_data, shown
from rldrill.problems.complaints import says
from rldrill.problems.document import joined
from rldrill.problems.errors import FileError, UsageError
from rldrill.problems.identity import Identity, looks_like_id, split_id
from rldrill.problems.notations import LECTURE
from rldrill.solutions.effort import minutes_of as part_minutes

#: The version of the manifest's form.
FORMAT = 2
#: As many bytes as the largest exam has: a problem takes a thousand or two.
LARGEST = 250 * 10**6


def manifest(exam: Exam, printed_with: str | None = None, blueprint: str | None = None) -> dict[str, Any]:
    """All that is printed: enough to print it again or to grade, also after a family has changed.

    Args:
        exam: the exam.
        printed_with: the version of Typst, which decides the bytes of the PDFs.
        blueprint: the digest of the blueprint that it was begun from, where somebody sits it.
    """
    return {
        "format": FORMAT,
        "rldrill": __version__,
        "typst": printed_with,
        **({} if blueprint is None else {"blueprint": blueprint}),
        **asdict(exam.head),
        "seed": exam.seed,
        **({"sealed": True} if exam.sealed else {}),
        "points": exam.versions[0].points,
        **({} if exam.scale is None else {"scale": exam.scale}),
        "partial": exam.partial,
        "layout": asdict(exam.layout),
        "fairness": fairness(exam).data(),
        "versions": [_version(version) for version in exam.versions],
    }


def written(data: Mapping[str, Any]) -> bytes:
    """A manifest as its file holds it."""
    return (json.dumps(data, ensure_ascii=False, indent=1) + "\n").encode()


def _version(version: Version) -> dict[str, Any]:
    whose = {} if version.person is None else {"person": asdict(version.person)}
    placed = enumerate(zip(version.slots, version.exercises, strict=True))
    problems = [_problem(index + 1, *each, version.rules(index)) for index, each in placed]
    return {"code": version.code, **whose, "points": version.points, "minutes": version.minutes, "problems": problems}


def _problem(number: int, slot: int, exercise: Exercise, rules: Mapping[str, str]) -> dict[str, Any]:
    parts = [
        {
            "part": part.label,
            "kind": part.kind.name,
            "points": part.points,
            **({"partial": rules[part.label]} if part.label in rules else {}),
            "minutes": round(float(part_minutes(exercise.solution, part.label)), 1),
        }
        for part in exercise.parts
    ]
    return {
        "number": number,
        "slot": slot,
        "id": exercise.id,
        "family": exercise.problem.family.name,
        "level": exercise.problem.level,
        "points": points_of(exercise),
        "minutes": minutes_of(exercise),
        "parts": parts,
        "problem": exercise.problem.data(),
    }


def is_manifest(path: Path) -> bool:
    """Whether a file is the manifest of an exam."""
    try:
        return _is_exam(read_data(path, LARGEST))
    except FileError:
        return False


def _is_exam(data: object) -> TypeGuard[dict[str, Any]]:
    return isinstance(data, dict) and "rldrill" in data and "versions" in data


class _Table(BaseModel):
    model_config = ConfigDict(extra="ignore", frozen=True)


class _Part(_Table):
    part: str
    points: Annotated[int, Field(ge=0)]
    partial: Partial | None = None


class _Problem(_Table):
    id: str | None = None
    family: str | None = None
    slot: Annotated[int, Field(ge=0)] | None = None
    parts: Annotated[tuple[_Part, ...], Field(min_length=1)]
    problem: dict[str, Any]

    @property
    def families(self) -> set[str]:
        """The families that it is of, by its ID, its own word and the problem itself: one, unless they differ."""
        named = split_id(self.id)[0] if self.id is not None and looks_like_id(self.id) else None
        return {name for name in (named, self.family, self.problem.get("family")) if isinstance(name, str)}


def _short(code: str) -> str:
    if not re.fullmatch("[A-Z0-9]{1,8}", code):
        raise ValueError("must be 1 to 8 capital letters or digits")
    return code


class _Person(_Table):
    name: str
    number: str


class _Version(_Table):
    code: Annotated[str, AfterValidator(_short)]  # it is in the names of files
    person: _Person | None = None
    problems: Annotated[tuple[_Problem, ...], Field(min_length=1)]


class _Layout(_Table):
    paper: Paper = "a4"
    space: Space = "normal"
    solutions: Solutions = "separate"
    ids: bool = False
    duplex: bool = False
    notation: Notation = LECTURE


class _Manifest(_Table):
    typst: str | None = None
    blueprint: str | None = None
    title: str
    course: str = ""
    date: str = ""
    duration: int | None = None
    instructions: str = ""
    language: Language = "en"
    decimal_mark: DecimalMark = "."
    seed: int
    sealed: bool = False
    scale: Annotated[int, Field(ge=1)] | None = None
    partial: Partial = "all"
    layout: _Layout = _Layout()
    versions: Annotated[tuple[_Version, ...], Field(min_length=1)]


def read_manifest(path: str | Path) -> Exam:
    """The exam that a manifest records, every problem made again from the givens that the manifest holds.

    So it is the exam that was printed also where a family draws other problems by now.

    Raises:
        FileError: the file cannot be read, is no manifest, or a problem in it cannot be made.
    """
    exam, makes = read_exam(path)
    return replace(exam, versions=tuple(make() for make in makes))


def read_exam(path: str | Path) -> tuple[Exam, tuple[Callable[[], Version], ...]]:
    """The same with no version yet, and for every version what makes it: solving takes a while.

    Raises:
        FileError: the file cannot be read, or is no manifest; a problem that cannot be made is told with its version.
    """
    data, where = _checked(path), shown(path)
    head = Head(**{name: getattr(data, name) for name in Head.__struct_fields__})
    layout = Layout(**data.layout.model_dump())
    makes = tuple(partial(_made, version, where) for version in data.versions)
    return Exam(head, data.seed, (), data.partial, layout, data.sealed, data.scale), makes


def read_problems(path: str | Path) -> Mapping[str, tuple[Callable[[], tuple[Exercise, Mapping[str, Partial]]], ...]]:
    """For every version and each of its problems what makes it, with the rules of parts that have one of their own.

    So a problem that cannot be made takes no other with it.

    Raises:
        FileError: the file cannot be read, or is no manifest; a problem that cannot be made is told with its place.
    """
    data, where = _checked(path), shown(path)
    return {
        version.code: tuple(partial(_ruled, problem, here) for problem, here in _placed(version, where))
        for version in data.versions
    }


def codes(path: str | Path) -> tuple[str, ...]:
    """The codes of a manifest's versions; nothing is solved for it.

    Raises:
        FileError: the file cannot be read, or is no manifest.
    """
    return tuple(version.code for version in _checked(path).versions)


class Printed(Struct, frozen=True):
    """What a manifest says of a version without solving it: whose it is, and its problems in their order.

    ``ids`` holds None for a problem of somebody's own; ``slots`` are the places in the blueprint, from 0; ``worth`` has
    for every problem the points of its parts.
    """

    code: str
    person: Person | None
    ids: tuple[str | None, ...]
    slots: tuple[int, ...]
    worth: tuple[Mapping[str, int], ...]


def printed(path: str | Path) -> tuple[Printed, ...]:
    """The versions of a manifest; nothing is solved for it.

    Raises:
        FileError: the file cannot be read, or is no manifest.
    """
    return tuple(
        Printed(
            version.code,
            None if version.person is None else Person(version.person.name, version.person.number),
            tuple(problem.id for problem in version.problems),
            _slots(version),
            tuple({part.part: part.points for part in problem.parts} for problem in version.problems),
        )
        for version in _checked(path).versions
    )


def typst_of(path: str | Path) -> str | None:
    """The version of Typst that a manifest's PDFs were made with, where it says so.

    Raises:
        FileError: the file cannot be read, or is no manifest.
    """
    return _checked(path).typst


def digest_of(path: str | Path) -> str | None:
    """The digest of the blueprint from which somebody began to sit a manifest's exam, where it says so.

    Raises:
        FileError: the file cannot be read, or is no manifest.
    """
    return _checked(path).blueprint


def _checked(path: str | Path) -> _Manifest:
    data, where = read_data(path, LARGEST), shown(path)
    if not _is_exam(data):
        raise FileError(
            f"{where}: this is no manifest of an exam; name the .json file that was written beside the PDFs."
        )
    version = data.get("format")
    if version != FORMAT or isinstance(version, bool):
        raise FileError(
            f"{where}: its format is {str(version)[:20]}, and this release reads format {FORMAT}; "
            f"use the release that wrote it ({str(data['rldrill'])[:20]}) or a newer one."
        )
    try:
        result = _Manifest.model_validate(data)
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(str(step + 1) if isinstance(step, int) else str(step) for step in first["loc"])
        raise FileError(
            f"{where}: the manifest is damaged at {place} ({says(first)}); take it from a backup, or write the exam "
            "again."
        ) from None
    codes = [each.code for each in result.versions]
    if twice := next((code for code in codes if codes.count(code) > 1), None):
        raise FileError(f"{where}: the manifest is damaged: version {twice} stands there twice; take it from a backup.")
    return result


def _made(version: _Version, where: str) -> Version:
    made = [_ruled(problem, here) for problem, here in _placed(version, where)]
    person = None if version.person is None else Person(version.person.name, version.person.number)
    exercises, rules = zip(*made, strict=True)
    return Version(version.code, exercises, _slots(version), person, rules)


def _placed(version: _Version, where: str) -> Iterator[tuple[_Problem, str]]:
    """The problems of a version, each with how complaints call its place."""
    for number, problem in enumerate(version.problems, 1):
        yield problem, f"{where}, version {version.code}, problem {number}"


def _ruled(problem: _Problem, where: str) -> tuple[Exercise, Mapping[str, Partial]]:
    rules = {part.part: part.partial for part in problem.parts if part.partial is not None}
    return _exercise(problem, where), rules


def _slots(version: _Version) -> tuple[int, ...]:
    return tuple(index if problem.slot is None else problem.slot for index, problem in enumerate(version.problems))


def _exercise(entry: _Problem, where: str) -> Exercise:
    try:
        exercise = read(entry.problem, where)
    except UsageError as error:
        raise FileError(f"{where}: {error}") from None
    if len(entry.families) > 1:
        of = joined(sorted(entry.families))
        raise FileError(f"{where}: its ID, family and problem are of {of}, not of one; take it from a backup.")
    worth = {part.part: part.points for part in entry.parts}
    asked = [part.label for part in exercise.problem.parts]
    if list(worth) != asked:
        raise FileError(
            f"{where}: the manifest has points for {', '.join(worth)}, and in this release the problem asks "
            f"{', '.join(asked)}; use the release that printed it."
        )
    identity = None
    if entry.id is not None and looks_like_id(entry.id):
        family, level, seed, revision = split_id(entry.id)
        current = exercise.problem.family.revision
        identity = Identity(family, level, seed, current if revision is None else revision)
    problem = replace(exercise.problem, identity=identity)
    return Exercise(replace(exercise.solution, problem=problem), worth=worth)
