"""The parts (a), (b), … of a problem, and the kinds of answer that they ask for."""

from collections.abc import Iterable, Mapping
from string import ascii_lowercase
from typing import ClassVar, TypeAlias

from msgspec import Struct

Key: TypeAlias = str | tuple[str, str]
#: A problem has no more parts than there are letters for them.
LETTERS = len(ascii_lowercase)


class Number(Struct, frozen=True):
    """One number, or an expression in the parameters left open."""

    name: ClassVar[str] = "number"


class Numbers(Struct, frozen=True):
    """Numbers in a stated order; ``entries`` says in mathematics what each is (``R_0``), ``called`` in words."""

    entries: tuple[str, ...]
    called: tuple[str, ...] = ()
    name: ClassVar[str] = "vector"


class Matrix(Struct, frozen=True):
    """A matrix of a known shape."""

    rows: int
    columns: int
    name: ClassVar[str] = "matrix"


class Values(Struct, frozen=True):
    """A number for every state, or for every pair of state and action.

    ``of`` is the function asked for, ``V``; a dot in it says where the key stands, ``p(D|·)``.
    """

    of: str
    keys: tuple[Key, ...]
    name: ClassVar[str] = "table"


class Policy(Struct, frozen=True):
    """An action for every state; ``actions`` holds the states, and what is possible in each, ``of`` its letter.

    A single choice that no state is named for has no letter, and is told by itself.
    """

    actions: Mapping[str, tuple[str, ...]]
    of: str = "π"
    name: ClassVar[str] = "policy"


class Choice(Struct, frozen=True):
    """One of several options, each a letter and its text."""

    options: Mapping[str, str]
    name: ClassVar[str] = "choice"


class YesNo(Struct, frozen=True):
    """Yes or no."""

    name: ClassVar[str] = "yes/no"


Kind: TypeAlias = Number | Numbers | Matrix | Values | Policy | Choice | YesNo


class Part(Struct, frozen=True):
    """One thing asked.

    Args:
        ask: the sentence that asks, with its mathematics between ``$`` signs.
        kind: what kind of answer is wanted.
        points: what a right answer earns; they follow the minutes that it takes, when those are known.
        ties: whether several best actions may be right together (only where the question is about ties).
        zero: whether 0 is as good an answer as any other.
        label: the letter of the part, ``a``; its question gives it.
    """

    ask: str
    kind: Kind
    points: int = 0
    ties: bool = False
    zero: bool = False
    label: str = ""


def label(index: int) -> str:
    """The letter of the part at that place, counted from 0.

    Raises:
        ValueError: a problem has no more than 26 parts.
    """
    if index >= LETTERS:
        raise ValueError(f"a problem has at most {LETTERS} parts")
    return ascii_lowercase[index]


def lettered(parts: Iterable[Part]) -> tuple[Part, ...]:
    """Parts with the letters a, b, … in their order."""
    return tuple(
        [Part(part.ask, part.kind, part.points, part.ties, part.zero, label(n)) for n, part in enumerate(parts)]
    )
