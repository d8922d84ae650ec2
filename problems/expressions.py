"""Expressions in letters as texts: ``(u - b*ω - m g l sin(θ))/(m l²)``. Read, never executed."""

import re
import unicodedata
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Annotated, Any

from pydantic import AfterValidator, WithJsonSchema

from rldrill.problems import mathematics as maths
from rldrill.problems import notation
from rldrill.problems.fractions import Fraction
from rldrill.problems.grammar import read
from rldrill.problems.latex import typed
from rldrill.problems.mathematics import Fence, Math, Root, Script, mathematics, operator, row, word
from rldrill.problems.notation import ATOM, PRODUCT, Name, Node, Numeral, Operation, nodes, rank, whole
from rldrill.problems.spelling import Unreadable, quoted

FUNCTIONS = ("sin", "cos", "tan", "sqrt", "exp")
#: Greek letters by their names.
GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "zeta": "ζ", "eta": "η", "theta": "θ",
    "iota": "ι", "kappa": "κ", "lambda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "rho": "ρ", "sigma": "σ", "tau": "τ",
    "phi": "φ", "chi": "χ", "psi": "ψ", "omega": "ω",
}  # fmt: skip
#: Letters that mean something already.
_TAKEN = {"e": "the number e", "π": "the number π", "t": "the time"}
#: An index without its sign: x1, θ₁.
_INDEXED = re.compile(r"^([^\W\d_]+)([0-9])$")
_LONGEST, _MOST = 300, 180
_HIGHEST = 4


@lru_cache(maxsize=1024)
def letter(name: str) -> str:
    """A name as it is used: ``theta_1``, ``theta1`` and ``θ₁`` are ``θ_1``.

    Raises:
        ValueError: it is not one letter (or a Greek one spelled out), perhaps with an index.
    """
    # One sign of several for the same letter: φ for ϕ.
    head, _, index = _INDEXED.sub(r"\1_\2", unicodedata.normalize("NFKC", name)).partition("_")
    head = GREEK.get(head, head)
    if not index and head in _TAKEN:
        raise ValueError(f"{name!r} is {_TAKEN[head]}; write another letter, such as θ, theta or m_1")
    if len(head) != 1 or not head.isalpha() or (index and not index.isalnum()) or len(index) > 3 or name[-1:] == "_":
        raise ValueError(f"{name!r} is not a letter; write one such as θ, theta or m_1")
    return f"{head}_{index}" if index else head


@lru_cache(maxsize=1024)
def parsed(text: str) -> Node:
    """The tree of an expression.

    Raises:
        ValueError: it is not one, or is too long.
    """
    try:
        tree = read(typed(text, _LONGEST))
        for count, node in enumerate(nodes(tree), 1):
            _check(node)
            if count > _MOST:
                raise Unreadable(f"It holds more than {_MOST} numbers, letters and signs; name a part of it.", tree.at)
    except Unreadable as fault:
        raise ValueError(f"{text[:40]!r}, column {(fault.position or 0) + 1}: {fault.message}") from None
    return tree


def _check(node: Node) -> None:
    match node:
        case Operation("^", (_, exponent)) if whole(exponent) not in range(1, _HIGHEST + 1):
            message = f"An exponent in an expression is a whole number from 1 to {_HIGHEST}."
            raise Unreadable(message, exponent.at)
        case Operation(sign) if sign in notation.FUNCTIONS and sign not in FUNCTIONS:
            message = f"{quoted(sign)} is not understood in an expression; the functions are {', '.join(FUNCTIONS)}."
            raise Unreadable(message, node.at)
        case Name(name):
            try:
                letter(name)
            except ValueError as fault:
                raise Unreadable(f"{fault}; the functions are {', '.join(FUNCTIONS)}.", node.at) from None


def _expression(text: str) -> str:
    parsed(text)
    return text


#: The text of an expression, in a problem's givens.
Expression = Annotated[
    str, AfterValidator(_expression), WithJsonSchema({"type": "string", "title": "an expression such as -g sin(θ)/l"})
]


@lru_cache(maxsize=1024)
def letters(text: str) -> tuple[str, ...]:
    """The letters of an expression, in the order in which they first stand there."""
    return tuple(dict.fromkeys(letter(node.text) for node in nodes(parsed(text)) if isinstance(node, Name)))


def has_powers(text: str) -> bool:
    """Whether a power stands in an expression."""
    return any(isinstance(node, Operation) and node.sign == "^" for node in nodes(parsed(text)))


@lru_cache(maxsize=1024)
def turning(text: str) -> tuple[str, ...]:
    """The letters that are angles: those of which sines and cosines are taken as they stand, or in sums."""
    return tuple(
        dict.fromkeys(
            letter(inner.text)
            for node in nodes(parsed(text))
            if isinstance(node, Operation) and node.sign in ("sin", "cos", "tan")
            and all(isinstance(part, Name) or (isinstance(part, Operation) and part.sign in "+-")
                    for part in nodes(node.parts[0]))
            for inner in nodes(node.parts[0]) if isinstance(inner, Name)
        )
    )  # fmt: skip


def worked_out(
    text: str,
    values: Mapping[str, Any],
    functions: Mapping[str, Callable[[Any], Any]],
    number: Callable[[Fraction], Any],
) -> Any:
    """What an expression is worth in any arithmetic: exact numbers, sympy's symbols, complex floats.

    Args:
        text: the expression.
        values: what its letters stand for.
        functions: its functions, by their names.
        number: what its numbers become.

    Raises:
        KeyError: a letter has no value.
    """
    return notation.worked_out(
        parsed(text),
        number,
        lambda name: values[letter(name)],
        lambda function, argument: functions[function](argument),
    )


@lru_cache(maxsize=1024)
def written(text: str) -> Math:
    """An expression as mathematics."""
    return _written(parsed(text))


def _within(node: Node, least: int) -> Math:
    """A node in brackets, if it binds less than its surroundings; a fraction never does."""
    inside = _written(node)
    return inside if rank(node) >= least or _is_fraction(node) else Fence(inside)


def _is_fraction(node: Node) -> bool:
    """Whether it is set with a line between what stands above and below."""
    return node.sign in ("/", "%") if isinstance(node, Operation) else whole(node) is None and isinstance(node, Numeral)


def _written(node: Node) -> Math:
    match node:
        case Operation("+" | "-" as sign, (left, right)):
            return row(_written(left), operator(sign.replace("-", "−")), _within(right, PRODUCT))
        case Operation("*", (left, right)):
            between = () if _touches(left, right) else (operator("·"),)
            return row(_within(left, PRODUCT), *between, _within(right, PRODUCT))
        case Operation("/", (left, right)):
            return maths.Fraction(_written(left), _written(right))
        case Operation("^", (Operation("sqrt") as root, exponent)):
            return Script(Fence(_written(root)), above=_written(exponent))
        case Operation("^", (Operation(function, (argument,)), exponent)) if function in FUNCTIONS:
            return row(Script(word(function), above=_written(exponent)), Fence(_written(argument)))
        case Operation("^", (left, right)):
            return Script(_within(left, ATOM), above=_written(right))
        case Operation("-", (Operation("/", (left, right)),)):  # the sign stands in the fraction
            return maths.Fraction(_written(Operation("-", (left,))), _written(right))
        case Operation("-", (of,)):
            return row(operator("−"), _within(of, PRODUCT))
        case Operation("%", (of,)):
            return maths.Fraction(_written(of), maths.number(100))
        case Operation("sqrt", (argument,)):
            return Root(_written(argument))
        case Operation(function, (argument,)):
            return row(word(function), Fence(_written(argument)))
        case Numeral(value):
            return maths.number(value)
        case Name(name):
            return written_letter(name)
    raise TypeError(node)


def _touches(left: Node, right: Node) -> bool:
    """Whether two factors need no sign between them; two numbers do, and what stands beside a fraction."""
    last = left.parts[-1] if isinstance(left, Operation) and left.sign == "*" else left
    if isinstance(right, Numeral) or _is_fraction(last) or _is_fraction(right):
        return False
    return not isinstance(last, Operation) or last.sign not in FUNCTIONS


def written_letter(name: str) -> Math:
    """A letter as mathematics."""
    return mathematics(_marked(letter(name)))


def _marked(name: str) -> str:
    head, _, index = name.partition("_")
    return f"{head}_{{{' '.join(index)}}}" if index else head
