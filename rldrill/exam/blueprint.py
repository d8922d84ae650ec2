"""Blueprints: what an exam shall be, read from a TOML file or put together from a command line."""

import re
from collections.abc import Mapping, Sequence
from datetime import date
from hashlib import sha256
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, PrivateAttr, ValidationError
from pydantic_core import PydanticCustomError

from rldrill.exam.choices import DecimalMark, Language, Paper, Partial, Solutions, Space
from rldrill.exam.exam import DEFAULT_TITLE, Head, Layout
from rldrill.files import parse, read_text, shown
from rldrill.problems.catalogue import chosen
from rldrill.problems.complaints import nearest, says
from rldrill.problems.errors import FileError, UsageError
from rldrill.problems.notations import LECTURE, known

#: So many problems and versions an exam has at most.
MOST_PROBLEMS, MOST_VERSIONS = 100, 999
LONGEST_TITLE = 200
_WAYS = ("family", "topic", "id", "file")
_EACH = re.compile(r"^\s*\[\[\s*problems\s*\]\]", re.MULTILINE)


def _listed(value: object) -> object:
    return [value] if isinstance(value, str | int) and not isinstance(value, bool) else value


def _written_date(value: object) -> object:
    return value.isoformat() if isinstance(value, date) else value


def _known_notation(name: str) -> str:
    try:
        return known(name)
    except UsageError as error:
        said = str(error)[:-1]
        raise PydanticCustomError("notation", "{said}", {"said": said[:1].lower() + said[1:]}) from None


#: The name of a notation.
Notation = Annotated[str, AfterValidator(_known_notation)]
_Points = Annotated[int, Field(ge=1, le=1000)]
_Names = Annotated[tuple[str, ...], BeforeValidator(_listed), Field(strict=False)]


class _Table(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)


class Entry(_Table):
    """One ``[[problems]]``: a family, so many of a topic, one ID or a problem file."""

    family: str | None = None
    topic: _Names | None = None
    id: str | None = None
    file: str | None = None
    level: Annotated[int, Field(ge=1, le=3)] | None = None
    count: Annotated[int, Field(ge=1, le=MOST_PROBLEMS)] | None = None
    points: _Points | Annotated[tuple[_Points, ...], Field(strict=False, min_length=1)] | None = None
    partial: Partial | Annotated[tuple[Partial, ...], Field(strict=False, min_length=1)] | None = None

    @property
    def is_fixed(self) -> bool:
        """Whether it is one problem, the same in every version."""
        return self.id is not None or self.file is not None


class Blueprint(_Table):
    """What an exam shall be; ``rldrill worksheet --init exam.toml`` writes one with comments."""

    title: Annotated[str, Field(max_length=LONGEST_TITLE)] = DEFAULT_TITLE
    course: Annotated[str, Field(max_length=200)] = ""
    date: Annotated[str, BeforeValidator(_written_date), Field(max_length=60)] = ""
    duration: Annotated[int, Field(ge=1, le=1440)] | None = None
    instructions: Annotated[str, Field(max_length=2000)] = ""
    language: Language = "en"
    decimal_mark: DecimalMark = "."
    seed: Annotated[int, Field(ge=0)] | None = None
    versions: Annotated[int, Field(ge=1, le=MOST_VERSIONS)] = 1
    order: Literal["fixed", "shuffled"] = "fixed"
    minutes: Annotated[int, Field(ge=1, le=600)] | None = None
    points: Annotated[int, Field(ge=1, le=10_000)] | None = None
    scale: Annotated[int, Field(ge=1, le=10_000)] | None = None
    partial: Partial = "all"
    exclude: _Names = ()
    paper: Paper = "a4"
    space: Space = "normal"
    solutions: Solutions = "separate"
    ids: bool = False
    duplex: bool = False
    notation: Notation = LECTURE
    problems: Annotated[tuple[Entry, ...], Field(strict=False)] = (Entry(topic=(), count=8),)
    _where: str = PrivateAttr("")
    _lines: tuple[int, ...] = PrivateAttr(())
    _total: str = PrivateAttr("")
    _folder: Path = PrivateAttr(Path())

    @property
    def head(self) -> Head:
        """What is said of the exam as a whole."""
        return Head(**{name: getattr(self, name) for name in Head.__struct_fields__})

    @property
    def layout(self) -> Layout:
        """How it is printed."""
        return Layout(**{name: getattr(self, name) for name in Layout.__struct_fields__})

    @property
    def digest(self) -> str:
        """A digest of all that decides which problems there are, for how many points; the seed is kept beside it."""
        asked = self.model_dump_json(exclude=_NO_MATTER, exclude_defaults=True)
        return sha256(asked.encode()).hexdigest()[:16]

    @property
    def folder(self) -> Path:
        """Where the paths of problem files begin."""
        return self._folder

    def place(self, index: int | None = None) -> str:
        """Where an entry, or the whole, is written: what complaints begin with."""
        if not self._where:
            return ""
        if index is None or index >= len(self._lines):
            return f"{self._where}: "
        return f"{self._where}, line {self._lines[index]}: "

    @property
    def place_of_total(self) -> str:
        """Where the total of the points is written."""
        return self._total or self.place()

    def but(self, **changes: Any) -> "Blueprint":
        """The same with some fields changed; what is None stays as it is.

        Raises:
            UsageError: the title is too long.
        """
        given = {name: value for name, value in changes.items() if value is not None}
        if (length := len(given.get("title", ""))) > LONGEST_TITLE:
            raise UsageError(f"The title has {length} characters; give one of at most {LONGEST_TITLE}.")
        return self.model_copy(update=given)


#: What an exam that was begun takes from its blueprint anew.
_NO_MATTER = {"seed", "duration", "instructions", "language", "decimal_mark", *Layout.__struct_fields__}


def template() -> str:
    """A blueprint with comments, to begin with."""
    return files("rldrill.exam").joinpath("blueprint.toml").read_text(encoding="utf-8")


def read_blueprint(path: str | Path) -> Blueprint:
    """The blueprint in a TOML file.

    Raises:
        FileError: the file cannot be read, or is no blueprint; the sentence names the line.
    """
    text = read_text(path, (".toml",))
    where = shown(path)
    data = parse(text, path)
    try:
        blueprint = Blueprint.model_validate(data)
    except ValidationError as error:
        raise FileError(_sentence(error, text, where)) from None
    if not (isinstance(data, dict) and data.get("problems")):
        raise FileError(f"{where}: there are no problems in it; begin one with a line [[problems]].")
    blueprint._where, blueprint._folder = where, Path(path).parent
    if line := _line(text, ["points"]):
        blueprint._total = f"{where}, line {line}: "
    starts = [text.count("\n", 0, found.end()) + 1 for found in _EACH.finditer(text)]
    blueprint._lines = tuple(starts) if len(starts) == len(blueprint.problems) else ()
    _check_left_out(blueprint.exclude, f"{where}, line {_line(text, ['exclude'])}")
    for index, entry in enumerate(blueprint.problems):
        flaw = _flaw(entry)
        if flaw:
            raise FileError(f"{blueprint.place(index)}{flaw}")
    return blueprint


def _check_left_out(names: Sequence[str], where: str) -> None:
    """Refuse what is neither a topic nor a family.

    Raises:
        FileError: one of the names is none.
    """
    try:
        chosen(names)
    except UsageError as error:
        raise FileError(f"{where}: {error}") from None


def is_blueprint(data: object) -> bool:
    """Whether what a TOML file holds is meant as a blueprint, not as one problem."""
    return isinstance(data, dict) and "given" not in data and "family" not in data


def _flaw(entry: Entry) -> str | None:
    named = [way for way in _WAYS if getattr(entry, way) is not None]
    if len(named) != 1:
        found = f"this one names {' and '.join(named)}" if named else "this one names none"
        return f"a problem is named by family, topic, id or file, and by one of them alone; {found}."
    way = named[0]
    if entry.is_fixed and (entry.level or entry.count):
        return f"{way} names one problem; leave level and count out."
    return None


def _sentence(error: ValidationError, text: str, where: str) -> str:
    faults = sorted(error.errors(), key=lambda fault: fault["type"] != "extra_forbidden")
    first, *rest = _one_of_each(faults)
    place = _place(first)
    line = _line(text, place)
    at = f"{where}, line {line}" if line else where
    more = f" (and {len(rest)} more fault{'s' * (len(rest) > 1)})" if rest else ""
    name = next((str(step) for step in reversed(place) if isinstance(step, str)), "problems")
    if first["type"] == "extra_forbidden":
        known = tuple(Entry.model_fields if len(place) > 1 else Blueprint.model_fields)
        near = nearest(name, known) or f"; there are {', '.join(known)}"
        whose = "[[problems]]" if len(place) > 1 else "a blueprint"
        return f"{at}: {name[:40]!r} is not a field of {whose}{near}{more}."
    if place == ["problems"] and isinstance(first["input"], dict):
        return f"{at}: every problem begins with a line [[problems]], in two brackets{more}."
    if first["type"] == "model_type":
        return (
            f"{at}: a problem is not its name alone; write a line [[problems]], and below it family = 'return'{more}."
        )
    return f"{at}: {name}: {says(first)}{more}."


def _one_of_each(faults: Sequence[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    """Of several faults of one field the first: it may be of several types, and each has a fault of its own."""
    found: dict[tuple[int | str, ...], Mapping[str, Any]] = {}
    for fault in faults:
        if not isinstance(fault["input"], list):  # what is a list is not meant for a number
            found.setdefault(tuple(_place(fault)), fault)
    return [*found.values()] or [*faults]


def _place(fault: Mapping[str, Any]) -> list[int | str]:
    """Where a fault is, by the names of fields alone: pydantic adds those of the types that a field may have."""
    if fault["type"] == "extra_forbidden":
        return list(fault["loc"])
    return [step for step in fault["loc"] if isinstance(step, int) or step in _KNOWN]


_KNOWN = frozenset((*Entry.model_fields, *Blueprint.model_fields))


def _line(text: str, place: Sequence[int | str]) -> int | None:
    """The line where a field stands; the place is as pydantic has it, ``("problems", 2, "level")``."""
    start, end = 0, len(text)
    headers = [found.start() for found in _EACH.finditer(text)]
    if place[:1] == ["problems"] and len(place) > 1 and isinstance(place[1], int) and place[1] < len(headers):
        start = headers[place[1]]
        end = next((other for other in headers if other > start), len(text))
        place = place[2:]
        if not place:
            return text.count("\n", 0, text.index("[", start)) + 1
    name = next((str(step) for step in place if isinstance(step, str)), None)
    if name is None:
        return None
    found = re.compile(
        rf"^[ \t]*[\"']?{re.escape(name)}[\"']?[ \t]*=|^\s*\[+\s*{re.escape(name)}\b", re.MULTILINE
    ).search(text, start, end)
    if found is None:
        return text.count("\n", 0, text.index("[", start)) + 1 if start else None
    return text.count("\n", 0, found.end()) + 1
