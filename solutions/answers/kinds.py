"""The kinds of answer: how each is read, written, taken apart into cells, and tested with samples."""

import re
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import lru_cache
from typing import Any, Generic, TypeAlias, TypeVar

from msgspec import Struct

from rldrill.problems import parts
from rldrill.problems.document import joined, pieces
from rldrill.problems.mathematics import (
    Fence,
    Math,
    listed,
    name,
    row,
    signs,
    word,
)
from rldrill.problems.notations import AS_IT_STANDS, LECTURE, in_notation, in_use, notations, read_mathematics, used
from rldrill.solutions.answers.source import LONGEST
from rldrill.solutions.answers.text import (
    Reading,
    Unreadable,
    names_alone,
    read_choice,
    read_matrix,
    read_number,
    read_table,
    read_vector,
    read_words,
    read_yes_no,
)
from rldrill.solutions.exact import Value, decimal, in_one_quotient, is_rational, to_sympy
from rldrill.solutions.formula.typesetting import tabular, typeset_answer
from rldrill.solutions.matrices import is_matrix, matrix

KindT = TypeVar("KindT", bound=parts.Kind)
#: A cell of a typed answer: a number as it was read, a word, or words that are said to be equally good.
Cell: TypeAlias = Reading | str | tuple[str, ...]


class Samples(Struct, frozen=True):
    """Texts that a kind makes up to test itself with, from a right answer."""

    right: tuple[str, ...]
    wrong: tuple[str, ...]
    unreadable: tuple[str, ...]


class Allowed(Struct, frozen=True):
    """What a typed answer may contain.

    Args:
        parameters: the open parameters of the problem.
        ends: its terminal states, which may be given their 0, or no action.
        longest: the most characters that are read.
        actions: what may be said in brackets behind a value: the action that it comes from.
    """

    parameters: Sequence[str] = ()
    ends: Sequence[str] = ()
    longest: int = LONGEST
    actions: Sequence[str] = ()


class Answer(ABC, Generic[KindT]):
    """One kind of answer. A value is what a solver gave; its cells are what is judged one by one."""

    def __init__(self, kind: KindT) -> None:
        self.kind = kind

    @abstractmethod
    def cells(self, value: Any) -> dict[str, Any]:
        """The value cell by cell, each under the name that a person would use for it."""

    @abstractmethod
    def read(self, text: str, allowed: Allowed) -> dict[str, Cell]:
        """What was typed, cell by cell; a cell that was left out is not in it.

        Args:
            text: what was typed.
            allowed: what it may contain, and how long it may be.

        Raises:
            Unreadable: it cannot be understood.
        """

    @abstractmethod
    def value(self, cells: Mapping[str, Any]) -> Any:
        """The value that these cells make up: the inverse of ``cells``."""

    @abstractmethod
    def write(self, value: Any) -> str:
        """The value as a person would type it."""

    @abstractmethod
    def data(self, value: Any) -> Any:
        """The value as JSON has it; numbers are exact strings."""

    @abstractmethod
    def decimals(self, value: Any) -> Any:
        """The same, with decimals; None where a parameter is open or there are no numbers."""

    @abstractmethod
    def lines(self, value: Any) -> list[tuple[Math | None, Math]]:
        """The value typeset, line by line: what it is (None where the question says it), and what it is worth."""

    @abstractmethod
    def how_to_type(self) -> str:
        """An example of what to type."""

    def samples(self, value: Any) -> Samples:
        """Right, wrong and unreadable texts for the given right answer."""
        right = self.write(value)
        return Samples((right, f"  {right} "), tuple(self._wrong(value)), ("", "?!", "1 +", "x" * 3000))

    def _wrong(self, value: Any) -> list[str]:
        cells = self.cells(value)
        return [self.write(self.value(cells | {cell: _spoilt(content)})) for cell, content in cells.items()]


def text_of(value: Value) -> str:
    """An exact number as it is typed and stored: ``7/2``, ``exp(-1/8)``, ``gamma/(1 - gamma)``."""
    if is_rational(value):
        return str(value)  # flint's, which has no limit of digits
    return str(in_one_quotient(to_sympy(value))).replace("**", "^")


def _spoilt(content: Any) -> Any:
    return content * 2 if content else content + 1


class NumberAnswer(Answer[parts.Number]):
    """One number or expression."""

    def cells(self, value: Any) -> dict[str, Any]:
        return {"": value}

    def read(self, text: str, allowed: Allowed) -> dict[str, Cell]:
        return {"": read_number(text, allowed.parameters, allowed.longest)}

    def value(self, cells: Mapping[str, Any]) -> Any:
        return cells[""]

    def write(self, value: Any) -> str:
        return text_of(value)

    data = write

    def decimals(self, value: Any) -> Any:
        return decimal(value)

    def lines(self, value: Any) -> list[tuple[Math | None, Math]]:
        return [(None, typeset_answer(value))]

    def how_to_type(self) -> str:
        return "a number: 3/4, 0.75 or 2 + 1/2*3"


class NumbersAnswer(Answer[parts.Numbers]):
    """Numbers in a stated order."""

    def cells(self, value: Any) -> dict[str, Any]:
        return {f"entry {index + 1}": number for index, number in enumerate(value)}

    def read(self, text: str, allowed: Allowed) -> dict[str, Cell]:
        refused: Unreadable | None = None
        for names in _names(self.kind.entries, in_use().notation) if _NAMED.search(text) else (self._entries,):
            try:
                read = self._read(text, names, allowed)
            except Unreadable as error:
                refused = refused or error
            else:
                return {name: reading for name, reading in self.cells(read).items() if reading is not None}
        assert refused is not None
        raise refused

    @property
    def _entries(self) -> tuple[str, ...]:
        return tuple(entry.removeprefix(AS_IT_STANDS) for entry in self.kind.entries)

    def _read(self, text: str, names: Sequence[str], allowed: Allowed) -> tuple[Reading | None, ...]:
        return read_vector(text, len(names), allowed.parameters, names, allowed.longest, self.kind.called)

    def value(self, cells: Mapping[str, Any]) -> Any:
        return tuple(cells.values())

    def write(self, value: Any) -> str:
        return ", ".join(map(text_of, value))

    def data(self, value: Any) -> Any:
        return [text_of(number) for number in value]

    def decimals(self, value: Any) -> Any:
        return [decimal(number) for number in value]

    def lines(self, value: Any) -> list[tuple[Math | None, Math]]:
        return [
            (read_mathematics(entry), typeset_answer(number))
            for entry, number in zip(self.kind.entries, value, strict=True)
        ]

    def how_to_type(self) -> str:
        return f"{len(self.kind.entries)} numbers in that order: 1, 3/4, 0.5 …"


#: A name before a number, with its index.
_NAMED = re.compile(r"[^\W\d_][^=:\s]*\s*[=:]")


@lru_cache(maxsize=256)
def _names(entries: tuple[str, ...], notation: str) -> tuple[tuple[str, ...], ...]:
    """What entries are called: in the notation in use, in the lecture's, and as other courses call them, G₀ for R₀."""
    lecture = tuple(entry.removeprefix(AS_IT_STANDS) for entry in entries)
    plain = _spelled(entries, LECTURE)
    others = {name: _spelled(entries, name) for name in notations()}
    found = [names for names in others.values() if names != plain]
    first = [others[notation]] if others.get(notation, plain) != plain else []
    return tuple(dict.fromkeys((*first, lecture, *found)))


def _spelled(entries: tuple[str, ...], notation: str) -> tuple[str, ...]:
    with used(notation):
        return tuple("".join(signs(in_notation(read_mathematics(entry)))) for entry in entries)


class MatrixAnswer(Answer[parts.Matrix]):
    """A matrix, row by row."""

    def _lines(self, value: Any) -> list[list[Any]]:
        return [list(line) for line in (value.tolist() if is_matrix(value) else value)]

    def cells(self, value: Any) -> dict[str, Any]:
        return {
            f"row {row_ + 1}, column {column + 1}": entry
            for row_, line in enumerate(self._lines(value))
            for column, entry in enumerate(line)
        }

    def read(self, text: str, allowed: Allowed) -> dict[str, Cell]:
        read = read_matrix(text, (self.kind.rows, self.kind.columns), allowed.parameters, allowed.longest)
        return {name: reading for name, reading in self.cells(read).items() if reading is not None}

    def value(self, cells: Mapping[str, Any]) -> Any:
        entries = list(cells.values())
        width = self.kind.columns
        return matrix(entries[start : start + width] for start in range(0, len(entries), width))

    def write(self, value: Any) -> str:
        return f"[{'; '.join(', '.join(map(text_of, line)) for line in self._lines(value))}]"

    def data(self, value: Any) -> Any:
        return [[text_of(entry) for entry in line] for line in self._lines(value)]

    def decimals(self, value: Any) -> Any:
        return [[decimal(entry) for entry in line] for line in self._lines(value)]

    def lines(self, value: Any) -> list[tuple[Math | None, Math]]:
        rows = self._lines(value)
        return [(None, typeset_answer(rows[0][0]) if len(rows) == len(rows[0]) == 1 else tabular(rows, typeset_answer))]

    def how_to_type(self) -> str:
        if self.kind.rows == self.kind.columns == 1:
            return "a number: 3/4 or 0.75"
        return f"{self.kind.rows} × {self.kind.columns}, rows parted by semicolons: [1, 2; 3, 4]"


class ValuesAnswer(Answer[parts.Values]):
    """A number for every state, or every state and action."""

    def _name(self, key: parts.Key) -> str:
        return key if isinstance(key, str) else f"({', '.join(key)})"

    def cells(self, value: Any) -> dict[str, Any]:
        return {self._name(key): value[key] for key in self.kind.keys}

    def read(self, text: str, allowed: Allowed) -> dict[str, Cell]:
        if said := "|".join(map(re.escape, allowed.actions)):  # cool: 3 (slow)
            text = re.sub(rf"(?<=[0-9.%)])\s\((?:{said})\)(?=\s*(?:[,;|\n]|\Z))", lambda each: " " * len(each[0]), text)
        read = read_table(text, self.kind.keys, allowed.parameters, allowed.ends, allowed.longest)
        return {self._name(key): reading for key, reading in read.items()}

    def value(self, cells: Mapping[str, Any]) -> Any:
        return {key: cells[self._name(key)] for key in self.kind.keys}

    def write(self, value: Any) -> str:
        return ", ".join(f"{self._name(key)}: {text_of(value[key])}" for key in self.kind.keys)

    def data(self, value: Any) -> Any:
        return self._nested(value, text_of)

    def decimals(self, value: Any) -> Any:
        return self._nested(value, decimal)

    def _nested(self, value: Any, write: Any) -> Any:
        result: dict[str, Any] = {}
        for key in self.kind.keys:
            if isinstance(key, str):
                result[key] = write(value[key])
            else:
                result.setdefault(key[0], {})[key[1]] = write(value[key])
        return result

    def lines(self, value: Any) -> list[tuple[Math | None, Math]]:
        return [(self._left(key), typeset_answer(value[key])) for key in self.kind.keys]

    def _left(self, key: parts.Key) -> Math:
        names = (key,) if isinstance(key, str) else key
        if "·" in self.kind.of:
            return read_mathematics(self.kind.of.replace("·", ", ".join(f'"{each}"' for each in names)))
        return row(read_mathematics(self.kind.of), Fence(listed(map(name, names))))

    def how_to_type(self) -> str:
        return f"one value for each: {self._name(self.kind.keys[0])}: 3/4, …"


#: What a single choice is called, before it; nothing that rules it out: a != blue, not: blue.
_CALLED = re.compile(r"(?:(?!\b(?:not|no|but|except|never|nicht)\b)[^=:!<>≠≤≥~])*[=:](?!=)", re.IGNORECASE)


class PolicyAnswer(Answer[parts.Policy]):
    """An action for every state; the value holds all best actions, and any of them is right."""

    def cells(self, value: Any) -> dict[str, Any]:
        return {state: value[state] for state in self.kind.actions}

    def read(self, text: str, allowed: Allowed) -> dict[str, Cell]:
        asked = tuple(self.kind.actions), self.kind.actions, allowed.ends, allowed.longest
        try:
            return dict(read_words(text, *asked))
        except Unreadable:
            called = _CALLED.match(text)
            named, chosen = names_alone(text[called.end() :] if called else text)
            if self.kind.of or chosen == text:
                raise
        with suppress(Unreadable):
            return dict(read_words(named, *asked))
        return dict(read_words(chosen, *asked))  # whatever the choice is called: a₇ = blue, the blue arm

    def value(self, cells: Mapping[str, Any]) -> Any:
        return {state: (action,) if isinstance(action, str) else tuple(action) for state, action in cells.items()}

    def write(self, value: Any) -> str:
        named = [(f"{state}: " if self.kind.of else "") + value[state][0] for state in self.kind.actions]
        return ", ".join(named)

    def data(self, value: Any) -> Any:
        return {state: value[state][0] if len(value[state]) == 1 else list(value[state]) for state in self.kind.actions}

    def decimals(self, value: Any) -> Any:  # noqa: ARG002
        return None

    def lines(self, value: Any) -> list[tuple[Math | None, Math]]:
        return [(self._left(state), name(" or ".join(value[state]))) for state in self.kind.actions]

    def _left(self, state: str) -> Math | None:
        return row(read_mathematics(self.kind.of), Fence(name(state))) if self.kind.of else None

    def how_to_type(self) -> str:
        state, actions = next(iter(self.kind.actions.items()))
        if not self.kind.of:
            return f"one of {joined(list(actions))}"
        return f"an action for each state: {state}: {actions[0]}, …"

    def _wrong(self, value: Any) -> list[str]:
        return [
            self.write(value | {state: (other,)})
            for state, actions in self.kind.actions.items()
            for other in actions
            if other not in value[state]
        ]


class ChoiceAnswer(Answer[parts.Choice]):
    """One of several options."""

    def cells(self, value: Any) -> dict[str, Any]:
        return {"": (value,)}

    def read(self, text: str, allowed: Allowed) -> dict[str, Cell]:  # noqa: ARG002
        return {"": read_choice(text, self.kind.options)}

    def value(self, cells: Mapping[str, Any]) -> Any:
        content = cells[""]
        return content if isinstance(content, str) else content[0]

    def write(self, value: Any) -> str:
        return str(value)

    data = write

    def decimals(self, value: Any) -> Any:  # noqa: ARG002
        return None

    def lines(self, value: Any) -> list[tuple[Math | None, Math]]:
        words = (word(piece.strip()) if isinstance(piece, str) else piece for piece in pieces(self.kind.options[value]))
        return [(None, row(name(f"({value})"), *words))]

    def how_to_type(self) -> str:
        return f"one of {joined(list(self.kind.options))}"

    def _wrong(self, value: Any) -> list[str]:
        return [option for option in self.kind.options if option != value]


class YesNoAnswer(Answer[parts.YesNo]):
    """Yes or no."""

    def cells(self, value: Any) -> dict[str, Any]:
        return {"": (self.write(value),)}

    def read(self, text: str, allowed: Allowed) -> dict[str, Cell]:  # noqa: ARG002
        return {"": self.write(read_yes_no(text))}

    def value(self, cells: Mapping[str, Any]) -> Any:
        content = cells[""]
        return (content if isinstance(content, str) else content[0]) == "yes"

    def write(self, value: Any) -> str:
        return "yes" if value else "no"

    data = write

    def decimals(self, value: Any) -> Any:  # noqa: ARG002
        return None

    def lines(self, value: Any) -> list[tuple[Math | None, Math]]:
        return [(None, name(self.write(value)))]

    def how_to_type(self) -> str:
        return "yes or no"

    def _wrong(self, value: Any) -> list[str]:
        return [self.write(not value)]


_KINDS: dict[type, type[Answer[Any]]] = {
    parts.Number: NumberAnswer,
    parts.Numbers: NumbersAnswer,
    parts.Matrix: MatrixAnswer,
    parts.Values: ValuesAnswer,
    parts.Policy: PolicyAnswer,
    parts.Choice: ChoiceAnswer,
    parts.YesNo: YesNoAnswer,
}


def answer_kind(kind: parts.Kind) -> Answer[Any]:
    """How answers of this kind are handled."""
    return _KINDS[type(kind)](kind)


__all__ = ["Answer", "Cell", "Samples", "Unreadable", "answer_kind", "text_of"]
