"""A family of problems, a problem drawn from it, and the base of all givens."""

import importlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Set
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache, cached_property
from operator import not_
from types import ModuleType, NoneType
from typing import Any, ClassVar, Self, TypeVar, cast, get_args

from msgspec import Struct
from msgspec.structs import force_setattr, replace
from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError
from pydantic.json_schema import GenerateJsonSchema
from pydantic_core import to_jsonable_python

from rldrill.problems.angles import Angle
from rldrill.problems.complaints import sentence
from rldrill.problems.document import Document, kept, mathematics_in
from rldrill.problems.draws import Draws
from rldrill.problems.errors import BrokenFamily, FileError
from rldrill.problems.exact import PARAMETERS, Logarithm, Parameter
from rldrill.problems.fractions import Fraction
from rldrill.problems.habits import settled, written
from rldrill.problems.identity import LEVELS, Identity
from rldrill.problems.notations import AS_IT_STANDS, LECTURE, Writing, in_use, takes, used
from rldrill.problems.parts import Numbers, Part, Policy, Values, lettered
from rldrill.problems.readings import Note

Written = TypeVar("Written")

#: Whether givens are made by a draw of ours, which makes only what is valid.
_TRUSTED: ContextVar[bool] = ContextVar("trusted", default=False)


@contextmanager
def trusted() -> Iterator[None]:
    """Take givens that are made here as they are: validating them takes as long as solving the problem."""
    token = _TRUSTED.set(True)
    try:
        yield
    finally:
        _TRUSTED.reset(token)


@cache
def _defaults(model: type[BaseModel]) -> dict[str, Any]:
    """The fields in their order, each with its default if it has one."""
    return {name: field.get_default(call_default_factory=True) for name, field in model.model_fields.items()}


class Givens(BaseModel):
    """What a problem gives: typed, frozen, exact, validated; the same form is read from problem files."""

    model_config = ConfigDict(frozen=True, extra="forbid", arbitrary_types_allowed=True, defer_build=True)
    #: Letters that notations have, by which problems of this kind call something of their own.
    OWN: ClassVar[str] = ""
    #: The field that gives what comes out, where what is left open is asked for and not in the answers.
    FOUND_BY: ClassVar[str] = ""

    def __init__(self, **fields: Any) -> None:
        if not _TRUSTED.get():
            super().__init__(**fields)
            return
        object.__setattr__(self, "__dict__", _defaults(type(self)) | fields)
        object.__setattr__(self, "__pydantic_fields_set__", set(fields))
        object.__setattr__(self, "__pydantic_extra__", None)
        object.__setattr__(self, "__pydantic_private__", None)

    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]  # what is read from files does not come here

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """The same with some fields exchanged, unchecked; what was worked out from the fields is worked out anew."""
        copied = super().model_copy(update=update, deep=deep)
        for name in copied.__dict__.keys() - type(self).model_fields.keys():
            del copied.__dict__[name]
        return copied

    def parameters(self) -> tuple[str, ...]:
        """The parameters that an answer may contain: those left open, unless they are asked for."""
        return () if self.FOUND_BY and getattr(self, self.FOUND_BY) is not None else self.left_open

    @cached_property
    def left_open(self) -> tuple[str, ...]:
        """The parameters left open anywhere; mistakes, the question and the answers ask for them again and again."""
        found: dict[str, None] = {}
        _collect_parameters(_inside(self), found)
        return tuple(found)

    def own_letters(self) -> Set[str]:
        """The letters that no notation may take from the problem: those it leaves open, and its ``OWN``."""
        return {*self.OWN, *(PARAMETERS[name] for name in self.left_open)}

    def terminal_states(self) -> tuple[str, ...]:
        """The terminal states anywhere in the givens."""
        return tuple(dict.fromkeys(_ends(self)))


def flag(description: str) -> Any:
    """A field that says yes or no; it is left out of files where it says no."""
    return Field(default=False, exclude_if=not_, description=description)


class AskedFor(Givens):
    """Givens of which what is left open is asked for: no answer is an expression in it."""

    def parameters(self) -> tuple[str, ...]:
        """None that an answer may contain."""
        return ()


def _ends(givens: BaseModel) -> Iterator[str]:
    for field in type(givens).model_fields:
        value = getattr(givens, field)
        if field == "terminal":
            yield from value
        for inner in value if isinstance(value, tuple) else (value,):
            if isinstance(inner, BaseModel):
                yield from _ends(inner)


#: What no parameter is in.
_CLOSED = frozenset({Fraction, str, int, bool, NoneType})


def _collect_parameters(items: Iterable[object], found: dict[str, None]) -> None:
    for item in items:
        if type(item) in _CLOSED:
            continue
        if isinstance(item, Parameter):
            found[item.symbol] = None
        else:
            _collect_parameters(_inside(item), found)


def _inside(value: object) -> Iterable[object]:
    if isinstance(value, BaseModel):
        return [getattr(value, field) for field in _open_fields(type(value))]
    if isinstance(value, dict):
        return value.values()
    if isinstance(value, Logarithm):
        return (value.of,)
    return value if isinstance(value, tuple) else ()


@cache
def _open_fields(model: type[BaseModel]) -> tuple[str, ...]:
    """The fields of givens in which a parameter may be."""
    return tuple(name for name, field in model.model_fields.items() if _may_be_open(field.annotation))


def _may_be_open(kind: Any) -> bool:
    if kind in (Any, Parameter, Logarithm):
        return True
    if isinstance(kind, type) and issubclass(kind, BaseModel):
        return bool(_open_fields(kind))
    inside = kind.__annotations__.values() if hasattr(kind, "_fields") else get_args(kind)  # the entries of a row
    return any(map(_may_be_open, inside))


class Question(Struct, frozen=True):
    """What is printed: the situation, then the parts, which get their letters here."""

    blocks: Document
    parts: tuple[Part, ...]

    def __post_init__(self) -> None:
        force_setattr(self, "parts", lettered(self.parts))


def _named(part: Part) -> Part:
    """A part, and what its answers are called as the lecture writes it."""
    kind = part.kind
    if isinstance(kind, Numbers):
        kind = replace(kind, entries=tuple(f"{AS_IT_STANDS}{entry}" for entry in kind.entries))
    elif isinstance(kind, Values | Policy) and kind.of:
        kind = replace(kind, of=f"{AS_IT_STANDS}{kind.of}")
    return replace(part, kind=kind)


class Family(Struct, frozen=True, dict=True):
    """One family: the module ``problems/<topic>/<name>.py`` as an object.

    ``given`` is a model; or, where the family has several kinds of problems, ``Annotated`` with the ``Discriminator``
    that tells them apart, the union of their models, each with its ``Tag``. ``distractors`` are the places of givens
    that need not matter, such as ``values.*``: what an exam would print, too.
    """

    name: str
    topic: str
    title: str
    summary: str
    source: str
    revision: int
    given: Any
    draw: Callable[[int, Draws], Givens]
    question: Callable[[Any], Question]
    levels: tuple[int, ...] = LEVELS
    distractors: tuple[str, ...] = ()
    package: str = "rldrill"

    def __hash__(self) -> int:
        return hash(self.name)

    @classmethod
    def load(cls, topic: str, name: str, package: str = "rldrill") -> "Family":
        """Load a family from its module in a package.

        Raises:
            BrokenFamily: the module lacks something that a family must have.
        """
        module = importlib.import_module(f"{package}.problems.{topic}.{name.replace('-', '_')}")
        return cls(
            package=package,
            name=name,
            topic=topic,
            title=_demanded(module, "TITLE"),
            summary=(module.__doc__ or "").partition("\n")[0],
            source=_demanded(module, "SOURCE"),
            revision=_demanded(module, "REVISION"),
            given=_demanded(module, "Given"),
            draw=_demanded(module, "draw"),
            question=_demanded(module, "question"),
            levels=getattr(module, "LEVELS", LEVELS),
            distractors=getattr(module, "DISTRACTORS", ()),
        )

    @cached_property
    def kinds(self) -> tuple[type[Givens], ...]:
        """The models of its givens, one for each kind of problem; most families have one."""
        union, *_ = get_args(self.given) or (None,)
        return tuple(get_args(tagged)[0] for tagged in get_args(union)) or (self.given,)

    def read(self, given: object, note: Note | None = None) -> Givens:
        """Read givens from what a file holds.

        Args:
            given: what it holds.
            note: told what is read otherwise than it is written, such as 0.3333333333333333 as 1/3.

        Raises:
            FileError: they do not fit; the sentence names the field.
        """
        try:
            return self._validated(given, note)
        except ValidationError as error:
            fault = error
        try:
            meant = settled(given, self.schema())  # a schema takes a while, so only where it is needed
        except ValueError as error:
            raise FileError(str(error)) from None
        if meant != given:
            try:
                return self._validated(meant, note)
            except ValidationError as error:
                fault = error
        raise FileError(sentence(fault, self.schema(), family=self.name, tagged=len(self.kinds) > 1)) from None

    def _validated(self, given: object, note: Note | None) -> Givens:
        """The same, with nothing told of what is refused in the end."""
        told: list[str] = []
        found = self._reader.validate_python(given, context=told.append)
        if note is not None:
            for each in told:
                note(each)
        return found

    def schema(self) -> dict[str, Any]:
        """The JSON Schema of what a file gives; it is made once, so nobody may change it."""
        return self._schema

    def written_schema(self) -> dict[str, Any]:
        """The JSON Schema of what a file may hold, with the short forms that are read, too."""
        return written(self._schema)

    @cached_property
    def _schema(self) -> dict[str, Any]:
        return self._reader.json_schema(schema_generator=_SchemaWriter)

    @cached_property
    def _reader(self) -> TypeAdapter[Givens]:
        return TypeAdapter(self.given)


class _SchemaWriter(GenerateJsonSchema):
    """Writes exact numbers as files have them; a title is what a value is called, an entry's description its name."""

    def field_title_should_be_set(self, _schema: Any) -> bool:
        """Nothing is called by the name of its field."""
        return False

    def encode_default(self, dft: Any) -> Any:
        """A default as files have it."""
        return str(dft) if isinstance(dft, Angle) else to_jsonable_python(dft, fallback=str)

    def named_tuple_schema(self, schema: Any) -> dict[str, Any]:
        """The entries of a row, each with its name."""
        row = super().named_tuple_schema(schema)
        for entry, field in zip(row["prefixItems"], schema["fields"], strict=True):
            entry["description"] = field["name"]
        return row

    def dict_schema(self, schema: Any) -> dict[str, Any]:
        """A table of names, whose values keep what they are called."""
        return super().dict_schema(schema) | {"additionalProperties": self.generate_inner(schema["values_schema"])}


def _demanded(module: ModuleType, name: str) -> Any:
    try:
        return getattr(module, name)
    except AttributeError:
        raise BrokenFamily(f"{module.__file__}: a family must have {name}; add it.") from None


class Problem(Struct, frozen=True, dict=True):
    """One problem: its family and what is given; its identity unless somebody brought it from outside."""

    family: Family
    given: Givens
    identity: Identity | None = None

    @property
    def question(self) -> Question:
        """The situation and the parts, as they are printed."""
        writing = in_use()
        if writing not in self._questions:
            self._questions[writing] = self._kept() if self.keeps_letters else self.family.question(self.given)
        return self._questions[writing]

    @cached_property
    def _questions(self) -> dict[Writing, Question]:
        """The question in every way in which it was asked for: equations are rewritten when they are made."""
        return {}

    def _plain(self) -> Question:
        with used(LECTURE):
            return self.question

    def _kept(self) -> Question:
        question = kept(self._plain())
        return replace(question, parts=tuple(map(_named, question.parts)))

    @property
    def keeps_letters(self) -> bool:
        """Whether the notation in use has letters of the problem's own, so that the problem stays in the lecture's."""
        notation = in_use().notation
        if notation not in self._keeps:
            self._keeps[notation] = takes(self.given.own_letters(), mathematics_in(self._plain()))
        return self._keeps[notation]

    @cached_property
    def _keeps(self) -> dict[str, bool]:
        """The same of every notation that was in use."""
        return {LECTURE: False}

    def written(self, make: Callable[[], Written]) -> Written:
        """What is made, from blocks and texts of the problem, in the notation that the problem is written in."""
        if not self.keeps_letters:
            return make()
        with used(LECTURE, in_use().mark):
            made = make()
        return cast(Written, kept(made))

    @property
    def parts(self) -> tuple[Part, ...]:
        """The parts in their order."""
        return self.question.parts

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        """The parameters that an answer may contain."""
        return self.given.parameters()

    @cached_property
    def terminal_states(self) -> tuple[str, ...]:
        """The terminal states, whose values nobody has to type."""
        return self.given.terminal_states()

    @property
    def level(self) -> int | None:
        """1 to 3, or None for a problem from outside."""
        return None if self.identity is None else self.identity.level

    def data(self) -> dict[str, Any]:
        """The problem as problem files hold it: ``{"family": …, "given": …}``."""
        return {"family": self.family.name, "given": self.given.model_dump(mode="json", exclude_none=True)}
