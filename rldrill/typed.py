"""An answer given as data, written as a person would type it: numbers, lists, tables."""

import math
import re
from collections.abc import Iterator, Mapping
from decimal import Decimal
from numbers import Number, Rational, Real

from flint import fmpq, fmpz
from sympy import Expr, sympify

from rldrill.problems.errors import UsageError

_PARTING = re.compile(r"[,;\n]")


def typed(value: object, what: str) -> str:
    """A value as text: texts and numbers as they are, lists in brackets, tables with colons; blank for nothing,
    or a question mark in a list.

    Args:
        value: the answer; a float stands for the shortest decimal that is this float.
        what: what complaints call it.

    Raises:
        UsageError: it is neither a text nor a number, list or table.
    """
    if isinstance(value, str):
        return value
    value = _plain(value)
    if isinstance(value, dict):
        return ", ".join(_pairs(value, what))
    if isinstance(value, list | tuple):
        entries = ", ".join("?" if item is None else _row(item, what) for item in value)
        return "" if all(item is None for item in value) else f"[{entries}]"
    return _scalar(value, what)


def _plain(value: object) -> object:
    """Arrays and series of other libraries as lists and tables."""
    if hasattr(value, "to_dict"):  # pandas
        return value.to_dict()
    if hasattr(value, "tolist") and not isinstance(value, Number):  # numpy's, and flint's
        return value.tolist()
    return value


def _pairs(table: Mapping[object, object], what: str) -> Iterator[str]:
    for state, value in table.items():
        if isinstance(value, dict):
            for action, number in value.items():
                yield f"({state}, {action}): {_scalar(number, what)}"
        else:
            name = f"({', '.join(map(str, state))})" if isinstance(state, tuple) else state
            yield f"{name}: {_row(value, what)}"  # tied best actions, or a row of a table, stand in a list


def _row(value: object, what: str) -> str:
    value = _plain(value)
    if isinstance(value, list | tuple):
        return f"[{', '.join('?' if item is None else _scalar(item, what) for item in value)}]"
    return _scalar(value, what)


def _scalar(value: object, what: str) -> str:
    match value:
        case None:
            return ""
        case bool():
            return str(value).lower()
        case str():
            whole = value[:1] == "(" and value[-1:] == ")"
            return f"({value})" if _PARTING.search(value) and not whole else value  # it must not be read as several
        case fmpq():
            return f"{value.p}/{value.q}"
        case fmpz():
            return str(value)
        case Expr():
            return str(value)
        case _ if hasattr(value, "_sympy_"):  # what solve() gives with an open letter
            return str(sympify(value, strict=True))
        case Rational():
            try:
                return str(value)
            except ValueError:
                raise UsageError(f"{what} has more digits than anybody writes; give a shorter number.") from None
        case float() if math.isfinite(value):
            return float.__repr__(value)
        case Real() | Decimal() if math.isfinite(value):  # among them numpy's, of 32 bits
            return str(value)
        case list() | tuple() | dict():
            raise UsageError(f"{what} nests too deeply; write numbers, a list, a list of rows or a table.")
        case _:
            raise UsageError(f"{what} is neither a text nor a number; write it in quotes.")
