"""Typed numbers worked out exactly, and shown back as they were read."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sympy
from flint import fmpq

from rldrill.problems.exact import PARAMETERS
from rldrill.problems.grammar import read
from rldrill.problems.notation import ATOM, POWER, PRODUCT, SUM, Name, Node, Numeral, folded, nodes, rank
from rldrill.problems.spelling import Source, Unreadable, quoted
from rldrill.solutions.answers.arithmetic import Arithmetic
from rldrill.solutions.exact import Value

_ECHO = 60
_CONSTANTS = {"e": sympy.E, "pi": sympy.pi}
#: How strongly the parts of an operation must bind to need no brackets.
_LEAST = {"+": (SUM, PRODUCT), "-": (SUM, PRODUCT), "*": (PRODUCT, POWER), "/": (PRODUCT, POWER), "^": (ATOM, ATOM),
          "%": (ATOM,)}  # fmt: skip
_ENDLESS = frozenset({"nan", "inf", "infinity", "∞"})


@dataclass(frozen=True, slots=True)
class Reading:
    """A number that was typed.

    Attributes:
        value: the exact value.
        echo: how it was read, short enough to be shown back.
        decimal: whether it holds a decimal point, an exponent or a percent, and so may be rounded.
    """

    value: Value
    echo: str
    decimal: bool


def number(source: Source, parameters: Sequence[str], arithmetic: Arithmetic) -> Reading:
    """Read one number.

    Args:
        source: all that was typed of it.
        parameters: the open parameters it may contain.
        arithmetic: what it is worked out with; one for the whole answer.

    Raises:
        Unreadable: it is not a number, or not one of moderate size.
    """
    tree = read(source)
    names = {node.text: _meant(node, parameters) for node in nodes(tree) if isinstance(node, Name)}

    def worth(node: Node, parts: list[Value]) -> Value:
        try:
            return _worth(node, parts, names, arithmetic)
        except Unreadable as complaint:  # of the arithmetic, which knows no columns
            raise Unreadable(complaint.message, node.at) from None

    value = arithmetic.finish(folded(tree, worth))
    echo = folded(tree, lambda node, parts: _echo(node, parts, names))
    echo = echo if len(echo) <= _ECHO else f"{echo[: _ECHO - 1]}…"
    return Reading(value, echo, any(map(_is_decimal, nodes(tree))))


def _meant(name: Name, parameters: Sequence[str]) -> str:
    """The parameter or constant that is meant by a name."""
    typed = name.text if name.text in parameters else name.text.lower()
    for parameter in parameters:
        if typed in (parameter, PARAMETERS.get(parameter)):
            return parameter
    constant = "pi" if typed == "π" else typed
    if constant in _CONSTANTS:
        return constant
    if typed in _ENDLESS:
        message = f"{quoted(name.text)} is not a number; write a finite one."
    else:
        instead = f"it may contain {', '.join(parameters)}" if parameters else "write a number such as 3/4"
        message = f"{quoted(name.text)} is not something this answer may contain; {instead}."
    raise Unreadable(message, name.at)


def _worth(node: Node, parts: list[Value], names: Mapping[str, str], arithmetic: Arithmetic) -> Value:
    """What a node is worth, by what its parts are worth."""
    if isinstance(node, Numeral):
        return fmpq(node.value.numerator, node.value.denominator)
    if isinstance(node, Name):
        name = names[node.text]
        return _CONSTANTS[name] if name in _CONSTANTS else arithmetic.parameter(name)
    if node.sign == "-":
        negative = arithmetic.negate(parts[-1])
        return arithmetic.add(parts[0], negative) if len(parts) == 2 else negative
    if node.sign == "%":
        return arithmetic.divide(parts[0], fmpq(100))
    work = {"+": arithmetic.add, "*": arithmetic.multiply, "/": arithmetic.divide, "^": arithmetic.power}
    return work[node.sign](*parts) if node.sign in work else arithmetic.call(node.sign, parts)


def _echo(node: Node, parts: list[str], names: Mapping[str, str]) -> str:
    """How a node is shown back, by how its parts are."""
    if isinstance(node, Numeral):
        return (f"0{node.text}" if node.text.startswith(".") else node.text).removesuffix(".").lower()
    if isinstance(node, Name):
        return names[node.text]

    single = len(parts) == 1
    least = (PRODUCT,) if node.sign == "-" and single else _LEAST.get(node.sign, (SUM,) * len(parts))
    within = [
        text if rank(part) >= needed else f"({text})"
        for part, text, needed in zip(node.parts, parts, least, strict=True)
    ]
    match node.sign:
        case "+" | "-":
            return f"-{within[0]}" if single else f" {node.sign} ".join(within)
        case "*" | "/" | "^":
            return node.sign.join(within)
        case "%":
            return f"{within[0]}%"
    return f"{node.sign}({', '.join(within)})"


def _is_decimal(node: Node) -> bool:
    if isinstance(node, Numeral):
        return not node.text.replace("/", "").isdigit()
    return not isinstance(node, Name) and node.sign == "%"
