"""The grammar of one typed number: ``3/4``, ``1 3/4``, ``75%``, ``2(1 + γ)``, ``exp(-1/8)``."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import sympy
from flint import fmpq

from rldrill.problems.exact import PARAMETERS
from rldrill.solutions.answers.arithmetic import FUNCTIONS, Arithmetic, Number
from rldrill.solutions.answers.source import Source, Unreadable, quoted
from rldrill.solutions.exact import Value

_DIGITS = 40
_DEPTH = 40
_OPERATIONS = 300
_ECHO = 60
_CONSTANTS = {"e": sympy.E, "pi": sympy.pi, "π": sympy.pi}
_ENDLESS = frozenset({"nan", "inf", "infinity", "∞"})
_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻", "0123456789+-")
_COMMA = re.compile(r"([0-9]+),([0-9]+)(?![0-9.,])")
_THOUSANDS = re.compile(r"[1-9][0-9]{0,2}(,[0-9]{3})+(?![0-9])(\.[0-9]*)?")
_TAKEN = rf"(?i:{'|'.join(FUNCTIONS)})(?=[0-9])"  # ln3
_TOKEN = re.compile(
    r"(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<raised>[⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻]+)"
    rf"|(?P<name>{_TAKEN}|[A-Za-z][A-Za-z0-9_]*|[^\W\d_]|∞)"  # a Greek letter is a name of its own: αγ is α times γ
    r"|(?P<sign>\*\*|[-+*/^(),;%√])"
)
_SUM, _PRODUCT, _POWER, _ATOM = range(4)


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


class _Token(NamedTuple):
    kind: str  # number, name, raised, end, or the sign itself
    text: str
    at: int
    spaced: bool


class _Term(NamedTuple):
    value: Number
    echo: str
    rank: int

    def within(self, rank: int) -> str:
        """Its echo, in brackets if it binds less than its surroundings."""
        return self.echo if self.rank >= rank else f"({self.echo})"


def number(source: Source, parameters: Sequence[str], arithmetic: Arithmetic) -> Reading:
    """Read one number.

    Args:
        source: all that was typed of it.
        parameters: the open parameters it may contain.
        arithmetic: what it is worked out with; one for the whole answer.

    Raises:
        Unreadable: it is not a number, or not one of moderate size.
    """
    if not source.text:
        raise source.unreadable("Nothing was typed.")
    return _Parser(source, parameters, arithmetic).reading()


def refuse_comma(source: Source, index: int) -> None:
    """Complain about a comma between digits, which may be meant as a decimal or a thousands comma."""
    start = index
    while start and source.text[start - 1] in "0123456789.,":
        start -= 1
    if thousands := _THOUSANDS.match(source.text, start):
        plain = quoted(thousands[0].replace(",", ""))
        message = f"{quoted(thousands[0])} is ambiguous; leave out the thousands separator and write {plain}."
        raise source.unreadable(message, index)
    if comma := _COMMA.match(source.text, start):
        shown, point = comma[0][:_DIGITS], f"{comma[1]}.{comma[2]}"[:_DIGITS]
        raise source.unreadable(f"{shown} has a decimal comma; write {point}.", index)


class _Parser:
    """A recursive descent; each method reads what it is named after and works it out."""

    def __init__(self, source: Source, parameters: Sequence[str], arithmetic: Arithmetic) -> None:
        self._source = source
        self._arithmetic = arithmetic
        self._names = {name: name for name in parameters}
        self._names |= {PARAMETERS.get(name, name): name for name in parameters}
        self._tokens = list(_tokens(source))
        self._next = 0
        self._depth = 0
        self._operations = 0

    def reading(self) -> Reading:
        try:
            term = self._sum()
            if self._token.kind != "end":
                raise self._unexpected()
            value = self._arithmetic.finish(term.value)
        except Unreadable as complaint:  # of the arithmetic, which knows no columns
            if complaint.position is None:
                raise self._source.unreadable(complaint.message, self._before.at) from None
            raise
        echo = term.echo if len(term.echo) <= _ECHO else term.echo[: _ECHO - 1] + "…"
        return Reading(value, echo, any(_is_decimal(token) for token in self._tokens))

    @property
    def _token(self) -> _Token:
        return self._tokens[self._next]

    @property
    def _before(self) -> _Token:
        return self._tokens[max(self._next - 1, 0)]

    def _take(self, *kinds: str) -> _Token | None:
        token = self._token
        if token.kind not in kinds:
            return None
        self._next += 1
        return token

    def _operate(self) -> None:
        self._operations += 1
        if self._operations > _OPERATIONS:
            raise self._error(f"It holds more than {_OPERATIONS} operations; write it in a simpler form.")

    def _deeper(self) -> None:
        self._depth += 1
        if self._depth > _DEPTH:
            raise self._error(f"It nests deeper than {_DEPTH} brackets; write it in a simpler form.")

    def _error(self, message: str) -> Unreadable:
        return self._source.unreadable(message, self._token.at)

    def _unexpected(self) -> Unreadable:
        token, before = self._token, self._before
        if token.kind in (",", ";"):
            refuse_comma(self._source, token.at)
            return self._error("One number is needed here, and this goes on after it; leave the rest out.")
        if token.kind == ")" and not self._depth:
            return self._error("A bracket is closed here that was not opened; take it out, or open it.")
        if token.kind != "end":
            return self._error(f"A number is missing before {quoted(token.text)}; write one.")
        if token.at == 0 or before.kind in ("number", "name", "raised", ")", "%"):
            return self._error("It ends in the middle; write the rest, or close the bracket.")
        return self._error(f"A number is missing after {quoted(before.text)}; write one.")

    def _negative(self) -> bool:
        """Skip the signs before a number; whether they make it negative."""
        negative, count = False, 0
        while sign := self._take("+", "-"):
            negative ^= sign.text == "-"
            count += 1
            self._operate()
            if count > _DEPTH:
                raise self._error("Too many signs follow each other; write at most one.")
        return negative

    def _negated(self, term: _Term) -> _Term:
        return _Term(self._arithmetic.negate(term.value), f"-{term.within(_PRODUCT)}", _SUM)

    def _sum(self) -> _Term:
        negative = self._negative()
        left = self._product()
        if negative:
            left = self._negated(left)
        while sign := self._take("+", "-"):
            self._operate()
            right = self._product()
            value = right.value if sign.text == "+" else self._arithmetic.negate(right.value)
            echo = f"{left.echo} {sign.text} {right.within(_PRODUCT)}"
            left = _Term(self._arithmetic.add(left.value, value), echo, _SUM)
        return left

    def _product(self) -> _Term:
        left, divided = self._factor(), False
        while True:
            if sign := self._take("*", "/"):
                right, divided = self._factor(), sign.text == "/"
            elif self._token.kind in ("name", "(", "√", "number"):
                self._check_implicit(divided)
                right = self._power()
            else:
                return left
            self._operate()
            if divided:
                echo = f"{left.within(_PRODUCT)}/{right.within(_POWER)}"
                left = _Term(self._arithmetic.divide(left.value, right.value), echo, _PRODUCT)
            else:
                echo = f"{left.within(_PRODUCT)}*{right.within(_POWER)}"
                left = _Term(self._arithmetic.multiply(left.value, right.value), echo, _PRODUCT)

    def _check_implicit(self, divided: bool) -> None:
        token, before = self._token, self._before
        if token.kind == "number" and before.kind == "number":
            pair = quoted(f"{before.text} {token.text}")
            raise self._error(f"{pair} are two numbers with nothing between; write a sign or a comma there.")
        if token.kind == "number" or before.kind == "%":
            raise self._error(f"{quoted(token.text)} follows without a sign; write * before it if it is a factor.")
        if divided:
            what = quoted(f"/{before.text}{token.text}")
            raise self._error(f"{what} may be read in two ways; write brackets, as in 1/(2γ) or (1/2)γ.")

    def _factor(self) -> _Term:
        negative = self._negative()
        return self._negated(self._power()) if negative else self._power()

    def _power(self) -> _Term:
        base = self._raised()
        if not self._take("^"):
            return base
        self._deeper()
        self._operate()
        negative = self._negative()
        alone = self._token.kind == "number"
        exponent = self._power()
        if alone and self._before.kind == "number" and self._token.kind == "name" and not self._token.spaced:
            what = quoted(f"^{self._before.text}{self._token.text}")
            raise self._error(f"{what} may be read in two ways; write brackets, as in e^(2γ) or (e^2)γ.")
        if negative:
            exponent = self._negated(exponent)
        self._depth -= 1
        value = self._arithmetic.power(base.value, exponent.value)
        return _Term(value, f"{base.within(_ATOM)}^{exponent.within(_ATOM)}", _POWER)

    def _raised(self) -> _Term:
        """An atom with what is written behind it: percent signs and small raised numbers."""
        term = self._atom()
        while sign := self._take("%", "raised"):
            self._operate()
            if sign.kind == "%":
                value = self._arithmetic.divide(term.value, fmpq(100))
                term = _Term(value, f"{term.within(_ATOM)}%", _ATOM)
                continue
            digits = sign.text.translate(_RAISED)
            if not re.fullmatch("[+-]?[0-9]{1,3}", digits):
                message = f"The exponent {quoted(sign.text)} is not understood; write it as ^2."
                raise self._source.unreadable(message, sign.at)
            value = self._arithmetic.power(term.value, fmpq(int(digits)))
            exponent = f"({digits})" if digits.startswith("-") else digits
            term = _Term(value, f"{term.within(_ATOM)}^{exponent}", _POWER)
        return term

    def _atom(self) -> _Term:
        if token := self._take("number"):
            return self._mixed(token) or _Term(self._literal(token), _written(token.text), _ATOM)
        if self._take("("):
            self._deeper()
            term = self._sum()
            self._close()
            return term
        if self._take("√"):
            return self._call("sqrt")
        if token := self._take("name"):
            return self._named(token)
        raise self._unexpected()

    def _close(self) -> None:
        if not self._take(")"):
            raise self._unexpected()
        self._depth -= 1

    def _literal(self, token: _Token) -> fmpq:
        digits, _, exponent = token.text.lower().partition("e")
        whole, _, places = digits.partition(".")
        power = exponent.lstrip("+-").lstrip("0")
        if len(whole) + len(places) > _DIGITS or len(power) > 2 or int(power or 0) > _DIGITS:
            message = f"{quoted(token.text)} is too long for a number; {_DIGITS} digits are the most."
            raise self._source.unreadable(message, token.at)
        scale = (-int(power or 0) if exponent.startswith("-") else int(power or 0)) - len(places)
        value = int(whole + places)
        return fmpq(value * 10**scale) if scale >= 0 else fmpq(value, 10**-scale)

    def _mixed(self, whole: _Token) -> _Term | None:
        """A whole number and a fraction after a space: 1 3/4."""
        fraction = self._tokens[self._next : self._next + 3]
        if [token.kind for token in fraction] != ["number", "/", "number"]:
            return None
        top, _, bottom = fraction
        if not top.spaced or not all(token.text.isdigit() for token in (whole, top, bottom)):
            return None
        before = self._tokens[self._next - 2].kind if self._next > 1 else "("
        self._next += 3
        after = self._token.kind
        if before not in ("(", "+", "-", "*", ",", ";") or after not in (")", "+", "-", "*", ",", ";", "end"):
            message = "A whole number and a fraction may be read in two ways here; put brackets around them."
            raise self._source.unreadable(message, whole.at)
        self._operate()
        below_one: fmpq = self._arithmetic.divide(self._literal(top), self._literal(bottom))
        if below_one >= 1:
            message = "After a whole number the fraction must be below one, as in 1 3/4; write a sign between."
            raise self._source.unreadable(message, top.at)
        value = self._arithmetic.add(self._literal(whole), below_one)
        return _Term(value, str(value), _PRODUCT)

    def _named(self, token: _Token) -> _Term:
        name = token.text if token.text in self._names else token.text.lower()
        if name in self._names:
            parameter = self._names[name]
            return _Term(self._arithmetic.parameter(parameter), parameter, _ATOM)
        if name in _CONSTANTS:
            return _Term(_CONSTANTS[name], "pi" if name == "π" else name, _ATOM)
        if name in FUNCTIONS:
            return self._call(name)
        if name in _ENDLESS:
            message = f"{quoted(token.text)} is not a number; write a finite one."
        elif self._names:
            allowed = ", ".join(dict.fromkeys(self._names.values()))
            message = f"{quoted(token.text)} is not something this answer may contain; it may contain {allowed}."
        else:
            message = f"{quoted(token.text)} is not something this answer may contain; write a number such as 3/4."
        raise self._source.unreadable(message, token.at)

    def _call(self, name: str) -> _Term:
        self._operate()
        self._deeper()
        arguments = self._arguments(name) if self._take("(") else [self._bare(name)]
        self._depth -= 1
        value = self._arithmetic.call(name, [argument.value for argument in arguments])
        return _Term(value, f"{name}({', '.join(argument.echo for argument in arguments)})", _ATOM)

    def _arguments(self, name: str) -> list[_Term]:
        arguments = [self._sum()]
        _, most = FUNCTIONS[name]
        while len(arguments) < most and self._take(",", ";"):
            arguments.append(self._sum())
        if not self._take(")"):
            raise self._unexpected()
        return arguments

    def _bare(self, name: str) -> _Term:
        """What a function is taken of where no bracket follows it: √2, ln 2."""
        if self._token.kind not in ("number", "name", "√"):
            raise self._error(f"Put what {name} is taken of in brackets: {name}(…).")
        argument = self._atom()
        loose = self._before.kind in ("number", "name")
        after = self._token.kind
        unclear = ("^", "raised", "%", "name", "number", "(", "√", *(() if name == "sqrt" else ("/",)))
        if loose and after in unclear:
            raise self._error(f"What {name} is taken of may be read in two ways; put it in brackets: {name}(…).")
        return argument


def _tokens(source: Source) -> list[_Token]:
    tokens: list[_Token] = []
    index = 0
    text = source.text
    while index < len(text):
        start = index
        while text[index].isspace():
            index += 1
        match = _TOKEN.match(text, index)
        if match is None:
            if text[index:] == "." and tokens:  # the end of a sentence
                break
            raise source.unreadable(_foreign(text, index), index)
        kind = match.lastgroup or ""
        sign = "^" if match[0] == "**" else match[0]
        tokens.append(_Token(sign if kind == "sign" else kind, match[0], index, start < index))
        index = match.end()
    return [*tokens, _Token("end", "", len(text), False)]


def _foreign(text: str, index: int) -> str:
    character = text[index]
    if character in "[{⟨" and not any(closing in text for closing in "]}⟩"):
        return f"The bracket {quoted(character)} is not closed; close it."
    if character in "[]{}⟨⟩":
        return f"{quoted(character)} is not read inside a number; use round brackets."
    if character == "=":
        return "'=' is not understood here; write the value alone, once."
    return f"{quoted(character)} is not understood here; write a number such as 3, 0.75 or 3/4."


def _is_decimal(token: _Token) -> bool:
    return token.kind == "%" or (token.kind == "number" and not token.text.isdigit())


def _written(literal: str) -> str:
    """A literal as it is shown back: ``.5`` as ``0.5``, ``3.`` as ``3``."""
    literal = f"0{literal}" if literal.startswith(".") else literal
    return literal.removesuffix(".").lower()
