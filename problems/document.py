"""A page as data: the blocks that questions and workings are made of, before anything renders them.

Every text may hold mathematics between ``$`` signs (see ``rldrill.problems.mathematics``).
"""

import re
from collections.abc import Iterator, Mapping
from typing import Any, TypeAlias

from msgspec import Struct
from msgspec.structs import fields, force_setattr, replace

from rldrill.problems.mathematics import Math
from rldrill.problems.notations import (
    AS_IT_STANDS,
    PLAIN,
    Writing,
    all_in_notation,
    as_it_stands,
    in_use,
    read_mathematics,
    with_mark,
)


class Block:
    """Something that stands on lines of its own."""

    __slots__ = ()


class Paragraph(Block, Struct, frozen=True):
    """Running text."""

    text: str


class Heading(Block, Struct, frozen=True):
    """A short line above what follows."""

    text: str


class Table(Block, Struct, frozen=True):
    """A table with a header line; cells are texts."""

    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


class Equation(Block, Struct, frozen=True, eq=False):
    """Mathematics on lines of its own: a left side, then right sides one under the other.

    ``signs`` holds the relation before each right side; an empty sign goes on with the side above.
    What is not yet in the notation in use is rewritten, and ``notation`` says that it is. ``linear`` says that it is of
    a linear system, whose R_t is a matrix and no return, where its mathematics does not tell.
    """

    left: Math
    rights: tuple[Math, ...]
    signs: tuple[str, ...]
    label: str = ""
    notation: Writing = PLAIN
    linear: bool = False

    def __post_init__(self) -> None:
        if self.notation == in_use():
            return
        left, *rights = all_in_notation((self.left, *self.rights), linear=self.linear)
        force_setattr(self, "left", left)
        force_setattr(self, "rights", tuple(rights))
        force_setattr(self, "notation", in_use())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Equation) and self._compared == other._compared

    def __hash__(self) -> int:
        return hash(self._compared)

    @property
    def _compared(self) -> tuple[object, ...]:
        return self.left, self.rights, self.signs, self.label

    @property
    def is_bare(self) -> bool:
        """Whether it is right sides alone, with no relation before any of them: the lines of an answer."""
        return not any(self.signs)

    def without_last(self) -> "Equation":
        """The same without its last right side, which is what comes out of it."""
        return replace(self, rights=self.rights[:-1], signs=self.signs[:-1])


class Beside(Block, Struct, frozen=True):
    """Blocks side by side where the page is wide enough, else one under the other."""

    blocks: tuple[Block, ...]


Document: TypeAlias = tuple[Block, ...]

_PIECES = re.compile(r"\$([^$]*)\$")


def pieces(text: str) -> list[str | Math]:
    """Take a text apart into plain text and mathematics, each as it is written now."""
    parts = _PIECES.split(text)
    found = iter(all_in_notation([read_mathematics(part) for part in parts[1::2] if part]))
    return [next(found) if index % 2 else with_mark(part) for index, part in enumerate(parts) if part]


def kept(written: Any) -> Any:
    """Blocks, texts and all that holds some, with their mathematics as the lecture writes it in every notation."""
    match written:
        case str():
            return _PIECES.sub(lambda piece: f"${AS_IT_STANDS}{piece[1].removeprefix(AS_IT_STANDS)}$", written)
        case Equation(left, rights):
            return replace(written, left=as_it_stands(left), rights=as_it_stands(rights))
        case Struct():
            return replace(written, **{field.name: kept(getattr(written, field.name)) for field in fields(written)})
        case Mapping():
            return {name: kept(each) for name, each in written.items()}
        case tuple():
            return tuple(map(kept, written))
    return written


def mathematics_in(written: Any) -> Iterator[Math]:
    """The mathematics in blocks, in texts and in all that holds some."""
    match written:
        case str():
            yield from (read_mathematics(piece) for piece in _PIECES.findall(written) if piece)
        case Equation(left, rights):
            yield from (left, *rights)
        case Struct():
            yield from mathematics_in(tuple(getattr(written, field.name) for field in fields(written)))
        case Mapping():
            yield from mathematics_in(tuple(written.values()))
        case tuple():
            for each in written:
                yield from mathematics_in(each)


def joined(items: list[str]) -> str:
    """A list in words: ``a``, ``a and b``, ``a, b and c``."""
    return items[0] if len(items) == 1 else f"{', '.join(items[:-1])} and {items[-1]}"


def begun(sentence: str) -> str:
    """A sentence with a capital at its beginning, and all other letters as they are."""
    return sentence[:1].upper() + sentence[1:]


def counted(number: int, what: str) -> str:
    """A number of things: ``1 part``, ``2 parts``."""
    return f"{number} {what}{'' if number == 1 else 's'}"
