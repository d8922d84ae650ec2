"""Expressions in letters as texts: ``(u - b*ω - m*g*l*sin(θ))/(m*l^2)``. Read, never executed.

Python's own grammar reads them; what is not a number, a letter, arithmetic or one of a few functions is refused.
"""

import ast
import re
import unicodedata
from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from functools import lru_cache
from typing import Annotated, Any

from pydantic import AfterValidator

from rldrill.problems import mathematics as maths
from rldrill.problems.exact import read_fraction
from rldrill.problems.mathematics import Fence, Math, Root, Script, mathematics, operator, row, word

FUNCTIONS = ("sin", "cos", "tan", "sqrt", "exp")
#: Greek letters by their names.
GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "zeta": "ζ", "eta": "η", "theta": "θ",
    "iota": "ι", "kappa": "κ", "lambda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "rho": "ρ", "sigma": "σ", "tau": "τ",
    "phi": "φ", "chi": "χ", "psi": "ψ", "omega": "ω",
}  # fmt: skip
_LAMBDA = re.compile(r"\blambda\b")  # a word of Python's own
#: Letters that mean something already.
_TAKEN = {"e": "the number e", "π": "the number π", "t": "the time"}
_LONGEST, _MOST = 300, 120
_HIGHEST = 4
_SUM, _PRODUCT, _POWER, _ATOM = range(4)
_LEVELS = {ast.Add: _SUM, ast.Sub: _SUM, ast.USub: _SUM, ast.Mult: _PRODUCT, ast.Div: _ATOM, ast.Pow: _POWER}


def letter(name: str) -> str:
    """A name as it is used: ``theta_1`` is ``θ_1``.

    Raises:
        ValueError: it is not one letter (or a Greek one spelled out), perhaps with an index.
    """
    # One sign of several for the same letter, as Python's own grammar has it: φ for ϕ.
    head, _, index = unicodedata.normalize("NFKC", name).partition("_")
    head = GREEK.get(head, head)
    if not index and head in _TAKEN:
        raise ValueError(f"{name!r} is {_TAKEN[head]}; write another letter, such as θ, theta or m_1")
    if len(head) != 1 or not head.isalpha() or (index and not index.isalnum()) or len(index) > 3 or name[-1:] == "_":
        raise ValueError(f"{name!r} is not a letter; write one such as θ, theta or m_1")
    return f"{head}_{index}" if index else head


@lru_cache(maxsize=1024)
def parsed(text: str) -> ast.expr:
    """The tree of an expression.

    Raises:
        ValueError: it is not one, or is too long.
    """
    if len(text) > _LONGEST:
        raise ValueError(f"the expression is longer than {_LONGEST} characters")
    try:
        tree = ast.parse(_LAMBDA.sub("λ", text.replace("^", "**").replace("−", "-")).strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise ValueError(f"{text!r} is not an expression; write one such as -g*sin(θ)/l + u") from None
    if sum(1 for _ in ast.walk(tree)) > 3 * _MOST:
        raise ValueError(f"the expression {text[:40]!r}… is too long")
    _check(tree)
    return tree


def _check(node: ast.AST) -> None:
    match node:
        case ast.BinOp(left, ast.Pow(), ast.Constant(int(exponent))) if 1 <= exponent <= _HIGHEST:
            _check(left)
        case ast.BinOp(_, ast.Pow(), _):
            raise ValueError(f"an exponent in an expression is a whole number from 1 to {_HIGHEST}")
        case ast.BinOp(left, ast.Add() | ast.Sub() | ast.Mult() | ast.Div(), right):
            _check(left)
            _check(right)
        case ast.UnaryOp(ast.USub(), operand):
            _check(operand)
        case ast.Call(ast.Name(name), [argument], []) if name in FUNCTIONS:
            _check(argument)
        case ast.Name(name):
            letter(name)
        case ast.Constant(int() | float()) if not isinstance(node.value, bool):
            _number(node)
        case _:
            raise ValueError(
                f"{ast.unparse(node)[:40]!r} is not understood in an expression; it may hold numbers, letters, "
                f"+ - * / ^ and {', '.join(FUNCTIONS)}"
            )


def _number(node: ast.Constant) -> Fraction:
    return read_fraction(node.value)


def _expression(text: str) -> str:
    parsed(text)
    return text


#: The text of an expression, in a problem's givens.
Expression = Annotated[str, AfterValidator(_expression)]


@lru_cache(maxsize=1024)
def letters(text: str) -> tuple[str, ...]:
    """The letters of an expression, in the order in which they first stand there."""
    return tuple(dict.fromkeys(_letters(parsed(text))))


def _letters(node: ast.AST) -> Iterator[str]:
    match node:
        case ast.Name(name):
            yield letter(name)
        case ast.Call(_, arguments, _):
            for argument in arguments:
                yield from _letters(argument)
        case _:
            for child in ast.iter_child_nodes(node):
                yield from _letters(child)


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

    def walk(node: ast.AST) -> Any:
        match node:
            case ast.BinOp(left, ast.Pow(), ast.Constant(int(exponent))):
                return walk(left) ** exponent
            case ast.BinOp(left, sign, right):
                a, b = walk(left), walk(right)
                match sign:
                    case ast.Add():
                        return a + b
                    case ast.Sub():
                        return a - b
                    case ast.Mult():
                        return a * b
                return a / b
            case ast.UnaryOp(_, operand):
                return -walk(operand)
            case ast.Call(ast.Name(name), [argument]):
                return functions[name](walk(argument))
            case ast.Name(name):
                return values[letter(name)]
            case ast.Constant():
                return number(_number(node))
        raise TypeError(ast.dump(node))

    return walk(parsed(text))


@lru_cache(maxsize=1024)
def written(text: str) -> Math:
    """An expression as mathematics."""
    return _written(parsed(text))


def _level(node: ast.AST) -> int:
    match node:
        case ast.BinOp(_, sign, _):
            return _LEVELS[type(sign)]
        case ast.UnaryOp():
            return _SUM
    return _ATOM


def _within(node: ast.AST, level: int) -> Math:
    inside = _written(node)
    return inside if _level(node) >= level else Fence(inside)


def _written(node: ast.AST) -> Math:
    match node:
        case ast.BinOp(left, ast.Add(), right):
            return row(_written(left), operator("+"), _within(right, _PRODUCT))
        case ast.BinOp(left, ast.Sub(), right):
            return row(_written(left), operator("−"), _within(right, _PRODUCT))
        case ast.BinOp(left, ast.Mult(), right):
            between = () if _touches(left, right) else (operator("·"),)
            return row(_first(left), *between, _within(right, _PRODUCT))
        case ast.BinOp(left, ast.Div(), right):
            return maths.Fraction(_written(left), _written(right))
        case ast.BinOp(ast.Call(function, arguments), ast.Pow(), ast.Constant(exponent)):
            return row(Script(_written(function), above=maths.number(exponent)), Fence(_written(arguments[0])))
        case ast.BinOp(left, ast.Pow(), right):
            return Script(_within(left, _ATOM), above=_written(right))
        case ast.UnaryOp(_, operand):
            return row(operator("−"), _within(operand, _PRODUCT))
        case ast.Call(ast.Name("sqrt"), [argument]):
            return Root(_written(argument))
        case ast.Call(ast.Name(name), [argument]):
            return row(word(name), Fence(_written(argument)))
        case ast.Name(name):
            return word(name) if name in FUNCTIONS else written_letter(name)
        case ast.Constant():
            return maths.number(_number(node))
    raise TypeError(ast.dump(node))


def _first(node: ast.AST) -> Math:
    """The first factor of a product; its minus sign needs no brackets there."""
    return _written(node) if isinstance(node, ast.UnaryOp) else _within(node, _PRODUCT)


def _touches(left: ast.AST, right: ast.AST) -> bool:
    """Whether two factors need no sign between them; two numbers do, and what stands beside a fraction."""
    last = left.right if isinstance(left, ast.BinOp) and isinstance(left.op, ast.Mult) else left
    fraction = any(isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div) for node in (last, right))
    return not fraction and not isinstance(right, ast.Constant) and not isinstance(last, ast.Call)


def written_letter(name: str) -> Math:
    """A letter as mathematics."""
    return mathematics(_marked(letter(name)))


def _marked(name: str) -> str:
    head, _, index = name.partition("_")
    return f"{head}_{{{' '.join(index)}}}" if index else head
