"""Typed mathematics as a small tree: numbers, names, and signs or functions with what they are applied to.

What its names stand for, and which functions may stand where, is up to those who use it.
"""

import operator
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar, TypeAlias, TypeVar

from rldrill.problems.fractions import Fraction

Worth = TypeVar("Worth")

#: The names of functions, with the most parts they are applied to.
FUNCTIONS = {"sqrt": 1, "exp": 1, "ln": 1, "log": 1, "sin": 1, "cos": 1, "tan": 1, "abs": 1, "max": 20, "min": 20}


@dataclass(frozen=True, slots=True)
class Numeral:
    """A number and how it is written; ``at`` is its column, which counts for nothing when trees are compared."""

    value: Fraction
    text: str
    at: int = field(default=0, compare=False)
    parts: ClassVar[tuple[()]] = ()


@dataclass(frozen=True, slots=True)
class Name:
    """A name, as it was typed."""

    text: str
    at: int = field(default=0, compare=False)
    parts: ClassVar[tuple[()]] = ()


@dataclass(frozen=True, slots=True)
class Operation:
    """One of ``+ - * / ^ %`` or a function, with its parts; ``-`` with a single one is its negative."""

    sign: str
    parts: "tuple[Node, ...]"
    at: int = field(default=0, compare=False)


Node: TypeAlias = Numeral | Name | Operation

#: How strongly what a node is written with binds.
SUM, PRODUCT, POWER, ATOM = range(4)
_RANKS = {"+": SUM, "-": SUM, "*": PRODUCT, "/": PRODUCT, "^": POWER}


def rank(node: Node) -> int:
    """How strongly a node binds, which decides where it needs brackets."""
    if isinstance(node, Numeral):
        return PRODUCT if "/" in node.text else ATOM
    return _RANKS.get(node.sign, ATOM) if isinstance(node, Operation) else ATOM


def nodes(tree: Node) -> list[Node]:
    """All nodes of a tree from left to right, the parts before the whole."""
    found, waiting = [], [tree]
    while waiting:
        node = waiting.pop()
        found.append(node)
        waiting += node.parts
    return found[::-1]


def folded(tree: Node, worth: Callable[[Node, list[Worth]], Worth]) -> Worth:
    """What a tree is worth, if ``worth`` tells it of a node by what its parts are worth."""
    worked: list[Worth] = []
    for node in nodes(tree):
        first = len(worked) - len(node.parts)
        worked[first:] = [worth(node, worked[first:])]
    return worked[0]


def whole(node: Node) -> int | None:
    """The whole number that a node is, perhaps with a minus sign; None if it is something else."""
    match node:
        case Numeral(value) if value.denominator == 1:
            return int(value)
        case Operation("-", (Numeral(value),)) if value.denominator == 1:
            return -int(value)
    return None


_CALCULATED = {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}


def worked_out(
    tree: Node,
    number: Callable[[Fraction], Any],
    name: Callable[[str], Any],
    call: Callable[[str, Any], Any],
    power: Callable[[Any, Any], Any] = operator.pow,
) -> Any:
    """What a tree is worth in an arithmetic that has Python's operators.

    Args:
        tree: the tree.
        number: what its numbers become.
        name: what its names stand for.
        call: a function, by its name, of a number.
        power: a number raised to an exponent, which is None where it is no whole number.
    """

    def walk(node: Node) -> Any:
        if isinstance(node, Numeral):
            return number(node.value)
        if isinstance(node, Name):
            return name(node.text)
        sign, first = node.sign, walk(node.parts[0])
        if sign == "^":
            return power(first, whole(node.parts[1]))
        if sign == "%":
            return first / number(Fraction(100))
        if sign not in _CALCULATED:
            return call(sign, first)
        return _CALCULATED[sign](first, walk(node.parts[1])) if len(node.parts) == 2 else -first

    return walk(tree)
