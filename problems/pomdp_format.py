"""The file format of Cassandra's pomdp-solve, as far as it describes a Markov decision process, as a model."""

import re
from collections.abc import Iterator
from itertools import product
from typing import Any

from rldrill.problems.exact import read_fraction
from rldrill.problems.fractions import Fraction

_STATEMENT = re.compile(r"\s*(discount|values|states|actions|observations|start|[TOR])\b\s*(?:include|exclude)?\s*:")
_LARGEST = 10**6  # transitions that are written out


def read_pomdp(text: str) -> dict[str, Any]:
    """The model, and its ``discount`` if it has one.

    Raises:
        ValueError: it has observations, which no decision process has, or is no such file; the sentence names the line.
    """
    model = _Model()
    for line, keyword, body in _statements(text):
        try:
            model.read(keyword, body)
        except ValueError as error:
            raise ValueError(f"line {line}: {error}") from None
    return model.transitions()


def _statements(text: str) -> Iterator[tuple[int, str, list[str]]]:
    """Every statement: its line, its keyword and its words, colons among them."""
    begun: tuple[int, str, list[str]] | None = None
    for number, raw in enumerate(text.splitlines(), 1):
        line = raw.partition("#")[0]
        found = _STATEMENT.match(line)
        if found:
            if begun:
                yield begun
            begun = (number, found[1], [])
            line = line[found.end() :]
        words = line.replace(":", " : ").split()
        if words and begun is None:
            raise ValueError(f"line {number}: {words[0][:40]!r} begins no statement; write one such as discount: 0.9")
        if begun:
            begun[2].extend(words)
    if begun:
        yield begun


class _Model:
    """What the statements that were read have said."""

    def __init__(self) -> None:
        self.names: dict[str, tuple[str, ...]] = {}
        self.sign = 1
        self.said = 0
        self.discount: str | None = None
        self.chances: dict[tuple[str, str], dict[str, str]] = {}
        self.rewards: dict[tuple[str, ...], tuple[int, Fraction]] = {}

    def read(self, keyword: str, body: list[str]) -> None:
        if keyword in ("observations", "O"):
            raise ValueError("observations make this a POMDP, and only an MDP is solved; take out observations and O")
        if keyword == "discount":
            self.discount = " ".join(body)
        elif keyword == "values":
            if body not in (["reward"], ["cost"]):
                raise ValueError("values: must be reward or cost")
            self.sign = 1 if body == ["reward"] else -1
        elif keyword in ("states", "actions"):
            counted = len(body) == 1 and body[0].isdecimal() and len(body[0]) < 5
            self.names[keyword] = tuple(map(str, range(int(body[0])))) if counted else tuple(body)
        elif keyword == "T":
            self._chances(*self._split(body))
        elif keyword == "R":
            self._rewards(*self._split(body))

    def _split(self, body: list[str]) -> tuple[list[str], list[str]]:
        """The names between colons, and the numbers or words after them."""
        if set(self.names) != {"states", "actions"}:
            raise ValueError("states and actions must be named before T and R")
        names, rest = body[:1], body[1:]
        while rest[:1] == [":"]:
            names, rest = names + rest[1:2], rest[2:]
        if len(names) == 4 and names[3] != "*":
            raise ValueError("a reward that depends on the observation makes this a POMDP; write R: a : s : s' r")
        return names[:3], rest

    def _meant(self, name: str, kind: str) -> tuple[str, ...]:
        known = self.names[kind]
        if name == "*":
            return known
        if name in known:
            return (name,)
        if name.isdecimal() and len(name) < 7 and int(name) < len(known):
            return (known[int(name)],)
        raise ValueError(f"{name[:40]!r} is not among the {kind}; add it there, or correct it")

    def _pairs(self, names: list[str]) -> Iterator[tuple[str, str]]:
        actions = self._meant(names[0], "actions") if names else ()
        return product(actions, self._meant(names[1] if len(names) > 1 else "*", "states"))

    def _chances(self, names: list[str], values: list[str]) -> None:
        states = self.names["states"]
        many = 1 if values in (["uniform"], ["identity"]) else len(values)
        wanted = {1: len(states) ** 2, 2: len(states), 3: 1}.get(len(names), 0)
        if (many != 1 and many != wanted) or (many == 1 and len(names) == 3 and values[0].isalpha()):
            raise ValueError(f"T: {many} numbers stand here, {wanted} are needed, or uniform or identity")
        pairs = list(self._pairs(names))
        more = len(pairs) * (1 if len(names) == 3 or values == ["identity"] else len(states))
        if sum(map(len, self.chances.values())) + more > _LARGEST:
            raise ValueError(f"T: there are more than {_LARGEST} transitions; write a smaller model")
        for action, state in pairs:
            row = self.chances.setdefault((action, state), {})
            if len(names) == 3:
                row |= dict.fromkeys(self._meant(names[2], "states"), values[0])
                continue
            first = states.index(state) * len(states) if len(names) == 1 else 0
            self.chances[action, state] = self._row(state, values, first)

    def _row(self, state: str, values: list[str], first: int) -> dict[str, str]:
        states = self.names["states"]
        if values == ["identity"]:
            return {state: "1"}
        if values == ["uniform"]:
            return dict.fromkeys(states, f"1/{len(states)}")
        if len(values) < first + len(states):
            raise ValueError(f"T: {len(values)} numbers stand here, {len(states)} are needed in a row")
        return dict(zip(states, values[first : first + len(states)], strict=True))

    def _rewards(self, names: list[str], values: list[str]) -> None:
        states = self.names["states"]
        wanted = {1: len(states) ** 2, 2: len(states), 3: 1}.get(len(names), 0)
        if len(values) != wanted:
            raise ValueError(f"R: {len(values)} numbers stand here, {wanted} are needed")
        numbers = [self.sign * read_fraction(value) for value in values]
        for name, kind in zip(names, ("actions", "states", "states"), strict=False):
            self._meant(name, kind)
        keys = product(*(states for _ in range(3 - len(names))))
        for key, number in zip(keys, numbers, strict=True):
            exact = [name if name == "*" else self._meant(name, kind)[0]
                     for name, kind in zip(names, ("actions", "states", "states"), strict=False)]  # fmt: skip
            self.said += 1
            self.rewards[(*exact, *key)] = self.said, number

    def transitions(self) -> dict[str, Any]:
        """All that was said, as the transitions of a model."""
        if not self.chances:
            raise ValueError("there are no transitions; write states, actions, and T for every action")
        rows = [
            [state, action, after, chance, str(self._reward(action, state, after))]
            for action in self.names["actions"]
            for state in self.names["states"]
            for after, chance in self.chances.get((action, state), {}).items()
            if read_fraction(chance) != 0
        ]
        return {"transitions": rows} | ({} if self.discount is None else {"discount": self.discount})

    def _reward(self, *where: str) -> Fraction:
        """The reward that was said last of what holds here; 0, if none was."""
        every = product(*((name, "*") for name in where))
        return max((self.rewards[key] for key in every if key in self.rewards), default=(0, Fraction(0)))[1]
