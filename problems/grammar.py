"""The grammar of typed mathematics, in answers and in problem files: ``1 3/4``, ``75%``, ``2(1 + γ)``, ``m l²``."""

import re
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import NamedTuple
from unicodedata import normalize

from rldrill.problems.notation import FUNCTIONS, Name, Node, Numeral, Operation
from rldrill.problems.spelling import VULGAR, Source, Unreadable, quoted

DIGITS = 40  # longer numbers are slips of the keyboard, or mischief
_DEPTH = 40
_OPERATIONS = 300
_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻", "0123456789+-")
_COMMA = re.compile(r"([0-9]+),([0-9]+)(?![0-9.,])")
_THOUSANDS = re.compile(r"[1-9][0-9]{0,2}(,[0-9]{3})+(?![0-9])(\.[0-9]*)?")
_TAKEN = rf"(?i:{'|'.join(FUNCTIONS)})(?=[0-9])"  # ln3
_TOKEN = re.compile(
    rf"(?P<mixed>[0-9]+(?:\s*[{VULGAR}]|\s+[0-9]+\s*/\s*[0-9]+(?![0-9.])))"
    rf"|(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|[{VULGAR}])"
    r"|(?P<raised>[⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻]+)"
    # a Greek letter is a name of its own, perhaps with an index: αγ is α times γ
    rf"|(?P<name>{_TAKEN}|(?:[A-Za-z][A-Za-z0-9]*|[^\W\d_])(?:_\w+)?|∞)"
    r"|(?P<sign>\*\*|[-+*/^(),;%√])"
)
_ENDS = ("number", "mixed", "name", "raised", ")", "%")  # of what may stand alone
_LOOSE = {"(", "+", "-", "*", ",", ";", ")", "end"}  # what may stand beside a mixed number


class _Token(NamedTuple):
    kind: str  # number, mixed, name, raised, end, or the sign itself
    text: str
    at: int  # its column
    spaced: bool


def read(source: Source) -> Node:
    """The tree of a text.

    Raises:
        Unreadable: it is not in the grammar, or is too long, or nests too deep.
    """
    if not source.text:
        raise source.unreadable("Nothing was typed.")
    return _Parser(source).all()


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
        shown, point = comma[0][:DIGITS], f"{comma[1]}.{comma[2]}"[:DIGITS]
        raise source.unreadable(f"{shown} has a decimal comma; write {point}.", index)


class _Parser:
    """A recursive descent; each method reads what it is named after."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self._tokens = list(_tokens(source))
        self._next = self._depth = self._operations = 0

    def all(self) -> Node:
        node = self._sum()
        if self._token.kind != "end":
            raise self._unexpected()
        return node

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

    def _deeper(self) -> None:
        self._depth += 1
        if self._depth > _DEPTH:
            raise self._error(f"It nests deeper than {_DEPTH} brackets; write it in a simpler form.")

    def _operation(self, sign: str, token: _Token, *parts: Node) -> Node:
        self._operations += 1
        if self._operations > _OPERATIONS:
            raise self._error(f"It holds more than {_OPERATIONS} operations; write it in a simpler form.")
        return Operation(sign, parts, token.at)

    def _error(self, message: str, token: _Token | None = None) -> Unreadable:
        return Unreadable(message, (token or self._token).at)

    def _unexpected(self) -> Unreadable:
        token, before = self._token, self._before
        if token.kind in (",", ";"):
            refuse_comma(self._source, token.at - self._source.start)
            return self._error("One number is needed here, and this goes on after it; leave the rest out.")
        if token.kind == ")" and not self._depth:
            return self._error("A bracket is closed here that was not opened; take it out, or open it.")
        if token.kind != "end":
            return self._error(f"A number is missing before {quoted(token.text)}; write one.")
        if before.kind in _ENDS:
            return self._error("It ends in the middle; write the rest, or close the bracket.")
        return self._error(f"A number is missing after {quoted(before.text)}; write one.")

    def _signed(self, read: Callable[[], Node]) -> Node:
        """What ``read`` reads, perhaps behind signs."""
        signs: list[_Token] = []
        while sign := self._take("+", "-"):
            signs.append(sign)
            if len(signs) > _DEPTH:
                raise self._error("Too many signs follow each other; write at most one.")
        node = read()
        return self._operation("-", signs[0], node) if sum(sign.kind == "-" for sign in signs) % 2 else node

    def _sum(self) -> Node:
        left = self._signed(self._product)
        while sign := self._take("+", "-"):
            left = self._operation(sign.kind, sign, left, self._product())
        return left

    def _product(self) -> Node:
        left, divided = self._signed(self._power), False
        while True:
            if sign := self._take("*", "/"):
                right, divided = self._signed(self._power), sign.kind == "/"
            elif self._token.kind in ("name", "(", "√", "number", "mixed"):
                sign = self._token
                self._check_implicit(divided)
                right = self._power()
            else:
                return left
            left = self._operation("/" if divided else "*", sign, left, right)

    def _check_implicit(self, divided: bool) -> None:
        token, before = self._token, self._before
        numbers = ("number", "mixed")
        if token.kind in numbers and before.kind in numbers:
            pair = quoted(f"{before.text} {token.text}")
            raise self._error(f"{pair} are two numbers with nothing between; write a sign or a comma there.")
        if token.kind in numbers or before.kind == "%":
            raise self._error(f"{quoted(token.text)} follows without a sign; write * before it if it is a factor.")
        if divided:
            what = quoted(f"/{before.text}{token.text}")
            raise self._error(f"{what} may be read in two ways; write brackets, as in 1/(2γ) or (1/2)γ.")

    def _power(self) -> Node:
        base = self._raised()
        if not (sign := self._take("^")):
            return base
        self._deeper()
        exponent = self._signed(self._power)
        if self._before.kind == "number" and self._token.kind == "name" and not self._token.spaced:
            what = quoted(f"^{self._before.text}{self._token.text}")
            raise self._error(f"{what} may be read in two ways; write brackets, as in e^(2γ) or (e^2)γ.")
        self._depth -= 1
        return self._operation("^", sign, base, exponent)

    def _raised(self) -> Node:
        """An atom with what is written behind it: percent signs and small raised numbers."""
        node = self._atom()
        while sign := self._take("%", "raised"):
            if sign.kind == "%":
                node = self._operation("%", sign, node)
                continue
            digits = re.fullmatch("([+-]?)([0-9]{1,3})", sign.text.translate(_RAISED))
            if not digits:
                raise self._error(f"The exponent {quoted(sign.text)} is not understood; write it as ^2.", sign)
            exponent: Node = Numeral(Fraction(digits[2]), digits[2], sign.at)
            if digits[1] == "-":
                exponent = self._operation("-", sign, exponent)
            node = self._operation("^", sign, node, exponent)
        return node

    def _atom(self) -> Node:
        if token := self._take("mixed"):
            return self._mixed(token)
        if token := self._take("number"):
            digits = _digits(token)
            return Numeral(self._value(token, digits), digits, token.at)
        if self._take("("):
            self._deeper()
            node = self._sum()
            self._close()
            return node
        if token := self._take("√"):
            return self._call("sqrt", token)
        if token := self._take("name"):
            name = token.text.lower()
            return self._call(name, token) if name in FUNCTIONS else Name(token.text, token.at)
        raise self._unexpected()

    def _close(self) -> None:
        if not self._take(")"):
            raise self._unexpected()
        self._depth -= 1

    def _value(self, token: _Token, digits: str) -> Fraction:
        mantissa, _, exponent = digits.lower().partition("e")
        if max(len(part) for part in mantissa.replace(".", "").split("/")) > DIGITS or abs(int(exponent or 0)) > DIGITS:
            raise self._error(f"{quoted(token.text)} is too long for a number; {DIGITS} digits are the most.", token)
        try:
            return Fraction(digits)
        except ZeroDivisionError:
            raise self._error("It divides by zero.", token) from None

    def _mixed(self, token: _Token) -> Node:
        """A whole number and a fraction after it: 1 3/4, 1¾."""
        around = {self._tokens[self._next - 2].kind if self._next > 1 else "(", self._token.kind}
        if not around <= _LOOSE:
            message = "A whole number and a fraction may be read in two ways here; put brackets around them."
            raise self._error(message, token)
        above, below_one = (self._value(token, digits) for digits in _digits(token).split(maxsplit=1))
        if below_one >= 1:
            message = "After a whole number the fraction must be below one, as in 1 3/4; write a sign between."
            raise self._error(message, token)
        return Numeral(above + below_one, str(above + below_one), token.at)

    def _call(self, name: str, token: _Token) -> Node:
        self._deeper()
        if not self._take("("):
            arguments = [self._bare(name)]
            self._depth -= 1
        else:
            arguments = [self._sum()]
            while len(arguments) < FUNCTIONS[name] and self._take(",", ";"):
                arguments.append(self._sum())
            self._close()
        return self._operation(name, token, *arguments)

    def _bare(self, name: str) -> Node:
        """What a function is taken of where no bracket follows it: √2, ln 2."""
        if self._token.kind not in ("number", "name", "√"):
            raise self._error(f"Put what {name} is taken of in brackets: {name}(…).")
        argument = self._atom()
        unclear = ("^", "raised", "%", "name", "number", "mixed", "(", "√", *(() if name == "sqrt" else ("/",)))
        if self._before.kind in ("number", "name") and self._token.kind in unclear:
            raise self._error(f"What {name} is taken of may be read in two ways; put it in brackets: {name}(…).")
        return argument


def _tokens(source: Source) -> Iterator[_Token]:
    index, text = 0, source.text
    while index < len(text):
        start = index
        while text[index].isspace():
            index += 1
        match = _TOKEN.match(text, index)
        if match is None:
            if text[index:] == "." and index:  # the end of a sentence
                break
            raise source.unreadable(_foreign(text, index), index)
        kind = match.lastgroup or ""
        sign = "^" if match[0] == "**" else match[0]
        yield _Token(sign if kind == "sign" else kind, match[0], source.column(index), start < index)
        index = match.end()
    yield _Token("end", "", source.column(len(text)), False)


def _foreign(text: str, index: int) -> str:
    character = text[index]
    if character in "[{⟨" and not any(closing in text for closing in "]}⟩"):
        return f"The bracket {quoted(character)} is not closed; close it."
    if character in "[]{}⟨⟩":
        return f"{quoted(character)} is not read inside a number; use round brackets."
    if character == "=":
        return "'=' is not understood here; write the value alone, once."
    return f"{quoted(character)} is not understood here; write a number such as 3, 0.75 or 3/4."


def _digits(token: _Token) -> str:
    """A number in plain digits: 3/4 for ¾, 1 3/4 for 1¾."""
    spread = "".join(f" {normalize('NFKC', sign)}" if sign in VULGAR else sign for sign in token.text)
    return spread.replace("⁄", "/").strip()
