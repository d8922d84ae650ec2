"""The grammar of typed mathematics, in answers and in problem files: ``1 3/4``, ``75%``, ``2(1 + γ)``, ``m l²``."""

import re
import unicodedata
from collections.abc import Callable, Iterator
from math import isqrt
from typing import NamedTuple

from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.notation import FUNCTIONS, Name, Node, Numeral, Operation
from rldrill.problems.spelling import VULGAR, Source, Unreadable, quoted

DIGITS = 40  # longer numbers are slips of the keyboard, or mischief;
WHOLE_DIGITS = 2000  # but whole ones may come from a program
POWER_OF_TEN = 1000  # the probability of hundreds of tosses is as small
_DEPTH = 40
_OPERATIONS = 300
RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻", "0123456789+-")
_DOTS = r"\s?(?:…|⋯|\.{2,})"
_BAR, _DOT = "\u0305\u0304", "\u0307"  # over the digits that repeat; over the first and last of them
# Numbers as programs write them: np.sqrt(2), Fraction(1, 4), Sqrt[2]
_MODULES = r"(?:(?:np|numpy|jnp|math|sp|sympy|fractions|decimal|torch)\.)?"
_WRAPPERS = {"fraction": 2, "rational": 2, "decimal": 1, "float": 1, "float32": 1, "float64": 1}
_TAKEN = rf"(?i:{'|'.join(FUNCTIONS)})(?=[0-9])"  # ln3
_TOKEN = re.compile(
    rf"(?P<repeating>[0-9]*\.(?:[0-9]+{_DOTS}|[0-9{_BAR}{_DOT}]*[{_BAR}{_DOT}]|[0-9]*\([0-9]+\)))"
    rf"|(?P<mixed>[0-9]+(?:\s*[{VULGAR}]|\s+[0-9]+\s*/\s*[0-9]+(?![0-9.])))"
    # a comma in braces is LaTeX's for a decimal one
    rf"|(?P<number>(?:[0-9]+(?:\.[0-9]*|(?:\{{,\}}[0-9]+)+)?|\.[0-9]+)(?:(?:[eE]|\*\^)[+-]?[0-9]+)?|[{VULGAR}])"
    r"|(?P<raised>[⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻]+)"
    # a Greek letter is a name of its own, perhaps with an index: αγ is α times γ
    rf"|(?P<name>{_TAKEN}|{_MODULES}(?:[A-Za-z][A-Za-z0-9]*|[^\W\d_])(?:_\w+)?|∞)"
    r"|(?P<sign>\*\*|[-+*/^(),;%°√∛∜{}[\]])"
)
_EXPONENT = re.compile(r"[0-9]{1,2}\.?")  # as it stands where its superscript was lost
_ROOTS = {"∛": 3, "∜": 4}
_BRACKETS = {"(": ")", "{": "}", "[": "]"}
_ENDS = ("number", "mixed", "repeating", "name", "raised", ")", "}", "]", "%", "°")  # of what may stand alone
_LOOSE = {"(", "{", "[", "+", "-", "*", ",", ";", ")", "}", "]", "end"}  # what may stand beside a mixed number
_BEFORE_TERMS = ("end", "+", "-", "(", "[", "{", ",", ";")
_NUMBERS = ("number", "mixed", "repeating")
_OF_ANGLES = ("sin", "cos", "tan")
_BASES = ("2", "10")  # of log2(…) and log10(…)
#: Signs that are typed as words, or raised: minus 1/2, 50 percent, 45 deg, 45^∘
_SPOKEN = re.compile(
    r"(?P<minus>(?<!\w)(?:minus|negative)(?=\s))|(?<=[\w)}\s])(?P<percent>per\s?cent\b)"
    r"|(?<=[0-9)}\s])(?P<degrees>deg(?:rees?)?\b|\^\s*\{?\s*[°∘]\s*\}?)",
    re.IGNORECASE,
)
_SIGNS = {"minus": "-", "percent": "%", "degrees": "°"}


class _Token(NamedTuple):
    kind: str  # repeating, mixed, number, raised, name, end, or the sign itself
    text: str
    place: int  # in the source
    at: int  # in what was typed, its column
    spaced: bool


def read(source: Source) -> Node:
    """The tree of a text.

    Raises:
        Unreadable: it is not in the grammar, or is too long, or nests too deep.
    """
    if not source.text:
        raise source.unreadable("Nothing was typed.")
    return _Parser(source.replaced(_SPOKEN, lambda match: _SIGNS[match.lastgroup or ""])).all()


def refuse_comma(source: Source, index: int) -> None:
    """Complain about a comma or another separator between digits, if it may be a decimal or a thousands separator."""
    start = index
    while start and source.text[start - 1] in "0123456789.,'_":
        start -= 1
    run = _SEPARATED.match(source.text, start)
    if run and run.end() > index and (message := _what_to_type(run[0])):
        raise source.unreadable(message, index)


_SEPARATED = re.compile(r"[0-9]+(?:[.,'_][0-9]+)+(?![0-9])")
_SEPARATOR = re.compile(r"[.,'_ ]")


def _what_to_type(run: str) -> str | None:
    """The sentence about digits with separators in them: what they may mean, and how that is typed."""
    shown, marks, pieces = quoted(run), _SEPARATOR.findall(run), _SEPARATOR.split(run)
    thousands = "".join(pieces) if _grouped(pieces) else ""
    if marks == ["."]:
        return None
    if len(set(marks)) == 1:
        decimal = f"{pieces[0]}.{pieces[1]}" if marks == [","] else ""
        if thousands and decimal:
            thousands, decimal = quoted(thousands), quoted(decimal)
            return f"{shown} may be {decimal} or {thousands}; write the one that is meant."
        if decimal:
            return f"{run[:DIGITS]} has a decimal comma; write {decimal[:DIGITS]}."
        return f"{shown} has a thousands separator; write {quoted(thousands)}." if thousands else None
    if len(set(marks[:-1])) == 1 and marks[-1] in ".," and _grouped(pieces[:-1]):
        number = quoted(f"{''.join(pieces[:-1])}.{pieces[-1]}")
        return f"{shown} has a thousands separator and a decimal {_SAID[marks[-1]]}; write {number}."
    return None


_SAID = {".": "point", ",": "comma"}


def _grouped(pieces: list[str]) -> bool:
    """Whether some digits stand in groups as those of thousands do."""
    first, *middle, last = pieces if len(pieces) > 1 else ["", ""]
    return (
        first[:1] not in ("", "0")
        and len(first) <= 3
        and len(last) == 3
        and len(set(map(len, middle)) | {2, 3}) == 2
        and len(set(map(len, middle))) <= 1
    )


_NOTHING = _Token("end", "", 0, 0, False)


class _Parser:
    """A recursive descent; each method reads what it is named after."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self._tokens = list(_tokens(source))
        self._next = self._depth = self._operations = self._angles = 0

    def all(self) -> Node:
        self._check_alone()
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
            refuse_comma(self._source, token.place)
            return self._error("One number is needed here, and this goes on after it; leave the rest out.")
        if token.kind in (")", "}", "]") and not self._depth:
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
            self._check_superscript(sign)
            left = self._operation(sign.kind, sign, left, self._product())
        return left

    def _product(self) -> Node:
        left, divided = self._signed(self._power), False
        while True:
            percent = self._before.kind == "%"
            if sign := self._take("*", "/"):
                divided = sign.kind == "/"
                self._check_factor(sign)
                right = self._signed(self._power)
                if divided and self._before.kind == "%" and not percent:
                    raise self._percent_of_quotient(sign)
            elif self._token.kind in ("name", "(", "{", "√", *_ROOTS, *_NUMBERS):
                sign, divided = self._token, divided and not self._is_behind_fraction()
                self._check_implicit(divided)
                right = self._power()
            else:
                return left
            left = self._operation("/" if divided else "*", sign, left, right)

    def _percent_of_quotient(self, sign: _Token) -> Unreadable:
        above, line = self._tokens[self._tokens.index(sign) - 1], self._text(sign, self._before)
        above_text = above.text if above.kind in _NUMBERS else "(…)"
        readings = f"({above_text}{line[:-1]})% or {above_text}/({line[1:].strip()})"
        return self._error(f"{quoted(above_text + line)} may be {readings}; write the one that is meant.", sign)

    def _ahead(self, *kinds: str) -> list[_Token]:
        """The next tokens, if they are of these kinds."""
        tokens = self._tokens[self._next : self._next + len(kinds)]
        return tokens if [token.kind for token in tokens] == list(kinds) else []

    def _text(self, first: _Token, last: _Token) -> str:
        return self._source.text[first.place : last.place + len(last.text)]

    def _check_implicit(self, divided: bool) -> None:
        token, before = self._token, self._before
        if token.kind in _NUMBERS and before.kind in _NUMBERS:
            both = self._text(before, token)
            if "." in (token.text[:1], before.text[-1:]) or not token.spaced:
                refuse_comma(self._source, token.place)
            elif token.kind == "number" and _grouped(both.split(" ")):
                meant = quoted(both.replace(" ", ""))
                raise self._error(f"{quoted(both)} may be {meant} or two numbers; write {meant}, or a comma between.")
            pair = quoted(f"{before.text} {token.text}")
            raise self._error(f"{pair} are two numbers with nothing between; write a sign or a comma there.")
        if token.text in ("e", "E") and before.kind in _NUMBERS:
            self._check_exponent()
        if token.kind in _NUMBERS or before.kind in ("%", "°"):
            power = ", or ^ if it is a power" if before.kind == "name" and token.kind == "number" else ""
            what = f"{quoted(token.text)} follows without a sign"
            raise self._error(f"{what}; write * before it if it is a factor{power}.")
        if divided:
            what = quoted(f"/{before.text}{token.text}")
            raise self._error(f"{what} may be read in two ways; write brackets, as in 1/(2γ) or (1/2)γ.")

    def _check_exponent(self) -> None:
        """``2.5 e-1`` may be 2.5·10⁻¹ or 2.5·e − 1."""
        before = self._before
        if not (ahead := self._ahead("name", "+", "number") or self._ahead("name", "-", "number")):
            return
        _, sign, digits = ahead
        if not _EXPONENT.fullmatch(digits.text):
            return
        typed, number = quoted(self._text(before, digits)), f"{before.text}e{sign.text}{digits.text}"
        readings = f"{quoted(number)} or {quoted(f'{before.text}*e {sign.text} {digits.text}')}"
        raise self._error(f"{typed} may be {readings}; write the one that is meant.", before)

    def _check_factor(self, sign: _Token) -> None:
        """Spaces that part a quotient elsewhere than it is read: ``1/4 / 1/2``; and a lost superscript: ``2.5*103``."""
        before = self._tokens[self._next - 2]
        if sign.kind == "/" and sign.spaced and (ahead := self._ahead("number", "/", "number")):
            number, line, below = ahead
            if number.spaced and not line.spaced and not below.spaced:
                readings = f"…/({number.text}/{below.text}) or (…/{number.text})/{below.text}"
                raise self._error(f"{quoted(self._text(sign, below))} may be {readings}; write brackets.", sign)
        power = re.fullmatch("10([1-9])", self._token.text)
        if sign.text == "*" and power and "." in before.text and re.match("[1-9][.]", before.text):
            readings = f"{before.text}*10^{power[1]} or {power[0]}*{before.text}"
            raise self._error(f"{quoted(self._text(before, self._token))} may be {readings}; write it so.", before)

    def _check_superscript(self, sign: _Token) -> None:
        """A superscript that was lost on the way: ``2.5*10-1``, ``e-2``. Spaces on both sides make it a difference."""
        factor, times, ten = ([self._tokens[0]] * 3 + self._tokens[: self._next - 1])[-3:]
        digits = self._token
        if sign.kind != "-" or digits.kind not in _NUMBERS or (sign.spaced and digits.spaced):
            return
        if (ten.kind, ten.text.lower()) == ("name", "e"):
            first, base = ten, ten.text
        elif (times.kind, ten.text) == ("*", "10") and factor.kind in _NUMBERS and _EXPONENT.fullmatch(digits.text):
            first, base = factor, f"{factor.text}*10"
        else:
            return
        readings = f"{quoted(f'{base}^-{digits.text}')} or {quoted(f'{base} - {digits.text}')}"
        typed = quoted(self._text(first, digits))
        raise self._error(f"{typed} may be {readings}; write the one that is meant.", first)

    def _is_behind_fraction(self) -> bool:
        """Whether a name stands behind a fraction, with one blank between: ``53/8 γ``; LaTeX's commands leave more."""
        *before, above, line, below = [_NOTHING] * 4 + self._tokens[: self._next]
        fraction = (above.kind, line.kind, below.kind) == ("number", "/", "number") and below.text.isdigit()
        tight = not (line.spaced or below.spaced)
        blank = self._token.place == below.place + len(below.text) + 1
        letter = self._token.kind == "name" and self._token.text.lower() not in FUNCTIONS
        return fraction and tight and blank and letter and before[-1].kind in _BEFORE_TERMS

    def _check_alone(self) -> None:
        """A power of ten without its superscript, and nothing else: ``10-1``."""
        kinds = [token.kind for token in self._tokens]
        if kinds != ["number", "-", "number", "end"]:
            return
        ten, sign, digits = self._tokens[:3]
        if ten.text == "10" and _EXPONENT.fullmatch(digits.text) and not (sign.spaced and digits.spaced):
            message = (
                f"'10-{digits.text}' may be '10^-{digits.text}' or '10 - {digits.text}'; write the one that is meant."
            )
            raise self._error(message, ten)

    def _power(self) -> Node:
        base = self._raised()
        if not (sign := self._take("^")):
            return base
        self._deeper()
        exponent = self._signed(self._power)
        before, token = self._before, self._token
        if before.kind == "number" and token.kind == "name" and not token.spaced:
            what = quoted(f"^{before.text}{token.text}")
            raise self._error(f"{what} may be read in two ways; write brackets, as in e^(2γ) or (e^2)γ.")
        line = self._ahead("/", "number")
        if before.kind == "%":
            power = self._text(sign, before)
            raise self._error(f"{quoted(power)} may be ^({power[1:]}) or ({power[:-1]})%; write brackets.", sign)
        doubtful = before.text == "1" or (before.kind == "number" and isinstance(base, Name) and base.text in "eE")
        if doubtful and line and not line[0].spaced and not line[1].spaced:  # 2^1/3, e^-9/8
            power, below = self._text(sign, before), line[1].text
            readings = f"^({power[1:]}/{below}) or (…{power})/{below}"
            raise self._error(f"{quoted(self._text(sign, line[1]))} may be {readings}; write brackets.", sign)
        self._depth -= 1
        return self._operation("^", sign, base, exponent)

    def _raised(self) -> Node:
        """An atom with what is written behind it: percent signs and small raised numbers."""
        node = self._degrees(self._atom())
        while sign := self._take("%", "raised"):
            if sign.kind == "%":
                node = self._operation("%", sign, node)
                continue
            digits = re.fullmatch("([+-]?)([0-9]{1,3})", sign.text.translate(RAISED))
            if not digits:
                raise self._error(f"The exponent {quoted(sign.text)} is not understood; write it as ^2.", sign)
            exponent: Node = Numeral(fraction_of(digits[2]), digits[2], sign.at)
            if digits[1] == "-":
                exponent = self._operation("-", sign, exponent)
            node = self._operation("^", sign, node, exponent)
        return node

    def _degrees(self, node: Node) -> Node:
        """An atom, perhaps in degrees: where an angle is taken, it is clear what they are."""
        if not (sign := self._take("°")):
            return node
        if not self._angles:
            raise self._error("'°' is a unit; write the number alone, in the unit that is asked for.", sign)
        turned = Operation("/", (Name("π", sign.at), Numeral(Fraction(180), "180", sign.at)), sign.at)
        return self._operation("*", sign, node, turned)

    def _atom(self) -> Node:
        if token := self._take("mixed"):
            return self._mixed(token)
        if token := self._take("repeating"):
            value = _repeating(self._source, token)
            return Numeral(value, str(value), token.at)
        if token := self._take("number"):
            digits = _digits(token)
            if "," in digits:
                if digits.count(",") > 1 or _grouped(digits.split(",")):
                    raise self._error(_what_to_type(digits) or "Commas in a number are not understood.", token)
                digits = digits.replace(",", ".")
            return Numeral(self._value(token, digits), digits, token.at)
        if token := self._take("(", "{"):
            self._deeper()
            node = self._sum()
            self._close(token)
            return node
        if token := self._take("√"):
            return self._call("sqrt", token)
        if token := self._take(*_ROOTS):
            return self._operation("^", token, *self._arguments(token.text, 1), _part(_ROOTS[token.text], token.at))
        if token := self._take("name"):
            name = token.text.lower()
            if name in _WRAPPERS and self._token.kind in _BRACKETS:
                parts = self._arguments(name, _WRAPPERS[name])
                return parts[0] if len(parts) == 1 else self._operation("/", token, *parts)
            return self._call(name, token) if name in FUNCTIONS else Name(token.text, token.at)
        raise self._unexpected()

    def _close(self, opened: _Token) -> None:
        if not self._take(_BRACKETS[opened.kind]):
            raise self._unexpected()
        self._depth -= 1

    def _value(self, token: _Token, digits: str) -> Fraction:
        mantissa, _, exponent = digits.lower().partition("e")
        most = WHOLE_DIGITS if digits.isdigit() else DIGITS
        longest = max(len(part) for part in mantissa.replace(".", "").split("/"))
        if exponent and (len(exponent) > DIGITS or abs(int(exponent)) > POWER_OF_TEN):
            raise self._error(
                f"The power of ten in {quoted(token.text)} is too large; {POWER_OF_TEN} is the largest that is read.",
                token,
            )
        if longest > most:
            raise self._error(f"{quoted(token.text)} is too long for a number; {most} digits are the most.", token)
        try:
            return fraction_of(digits)
        except ZeroDivisionError:
            raise self._error("It divides by zero.", token) from None

    def _mixed(self, token: _Token) -> Node:
        """A whole number and a fraction after it: 1 3/4, 1¾."""
        # Before the first sign stands the last one, the end, as it were; all of 33 1/3 % are percent.
        if self._tokens[self._next - 2].kind not in _LOOSE or self._token.kind not in {*_LOOSE, "%", "°"}:
            message = "A whole number and a fraction may be read in two ways here; put brackets around them."
            raise self._error(message, token)
        above, below_one = (self._value(token, digits) for digits in _digits(token).split(maxsplit=1))
        if below_one >= 1:
            message = "After a whole number the fraction must be below one, as in 1 3/4; write a sign between."
            raise self._error(message, token)
        return Numeral(above + below_one, str(above + below_one), token.at)

    def _call(self, name: str, token: _Token) -> Node:
        self._angles += name in _OF_ANGLES
        power = self._power_of(name)
        node = self._operation(name, token, *self._arguments(name, FUNCTIONS[name]))
        self._angles -= name in _OF_ANGLES
        return self._operation("^", token, node, power) if power else node

    def _power_of(self, name: str) -> Node | None:
        """The power that stands between a function of angles and what it is taken of: sin²(θ), sin^2 θ."""
        raised = self._ahead("raised")
        ahead = self._ahead("^", "number") or self._ahead("^", "{", "number", "}") or raised
        digits = "".join(each.text for each in ahead).translate(RAISED).strip("^{}")
        if name not in _OF_ANGLES or not re.fullmatch("[2-9]", digits):
            return None
        if self._tokens[self._next + len(ahead)].kind not in ("name", *_BRACKETS):
            return None
        self._next += len(ahead)
        return Numeral(Fraction(int(digits)), digits, ahead[-1].at)

    def _arguments(self, name: str, most: int) -> list[Node]:
        """What a function is taken of."""
        self._deeper()
        opened = self._take(*_BRACKETS)
        if not opened:
            arguments = [self._bare(name)]
            self._depth -= 1
        else:
            arguments = [self._sum()]
            while len(arguments) < most and (mark := self._take(",", ";")):
                if mark.kind == ";" and (comma := next((t for t in self._tokens if t.kind == ","), None)):
                    refuse_comma(self._source, comma.place)
                arguments.append(self._sum())
            self._close(opened)
        return arguments

    def _bare(self, name: str) -> Node:
        """What a function is taken of where no bracket follows it: √2, ln 2."""
        if self._token.kind not in ("number", "name", "√"):
            raise self._error(f"Put what {name} is taken of in brackets: {name}(…).")
        argument = self._degrees(self._atom())
        if name == "log" and self._before.text in _BASES and self._token.kind == "(":
            base = self._before.text
            raise self._error(f"log is the natural logarithm here; write ln(…)/ln({base}) for that to the base {base}.")
        square = isinstance(argument, Numeral) and argument.value == isqrt(int(argument.value)) ** 2  # √9/16
        line = () if name == "sqrt" and not square else ("/",)
        if name in _OF_ANGLES and self._token.text.lower() in _OF_ANGLES:
            return argument  # sin θ cos θ
        unclear = ("^", "raised", "%", "name", "(", "{", "√", *_ROOTS, *_NUMBERS, *line)
        if self._before.kind in (*_NUMBERS, "name") and self._token.kind in unclear:
            raise self._error(f"What {name} is taken of may be read in two ways; put it in brackets: {name}(…).")
        return argument


def _tokens(source: Source) -> Iterator[_Token]:
    index, text = 0, source.text
    opened, called = 0, False  # square brackets stand only behind functions: Sqrt[2]
    while index < len(text):
        start = index
        while text[index].isspace():
            index += 1
        match = _TOKEN.match(text, index)
        if match is None or not _belongs(match[0], text, index, called, opened):
            if text[index:] == "." and index:  # the end of a sentence
                break
            refuse_comma(source, index)
            raise source.unreadable(_foreign(text, index), index)
        kind = match.lastgroup or ""
        token = match[0].rpartition(".")[2] if kind == "name" else match[0]
        sign = "^" if token == "**" else token
        yield _Token(sign if kind == "sign" else kind, token, index, source.column(index), start < index)
        opened += (token == "[") - (token == "]")
        called = kind == "name" and token.lower() in (*FUNCTIONS, *_WRAPPERS)
        index = match.end()
    yield _Token("end", "", len(text), source.column(len(text)), False)


def _belongs(token: str, text: str, index: int, called: bool, opened: int) -> bool:
    """Whether a bracket may stand in a number: a square one behind a function, a curly one that is closed."""
    if token == "[":
        return called and "]" in text[index:]
    if token == "]":
        return opened > 0
    return token != "{" or "}" in text[index:]


def _part(count: int, at: int) -> Node:
    return Numeral(Fraction(1, count), f"1/{count}", at)


def _repeating(source: Source, token: _Token) -> Fraction:
    """The exact value of a decimal whose last digits repeat: 0.(3), 0.333…, 0.3̅.

    Raises:
        Unreadable: it does not show which, or may be a product.
    """
    whole, _, digits = token.text.replace(" ", "").partition(".")
    if len(token.text) > 2 * DIGITS + 3:
        raise source.unreadable(f"{quoted(token.text)} is too long for a number.", token.place)
    if digits[-1] == ")":
        fixed, _, block = digits[:-1].partition("(")
        value = _endless(whole, fixed, block)
        if (whole + fixed).strip("0"):
            shown, product = quoted(str(value)), quoted(f"{whole}.{fixed}*{block}")
            message = f"{quoted(token.text)} may be {shown}, its last digits repeated, or {product}; write one of them."
            raise source.unreadable(message, token.place)
        return value
    if (plain := digits.rstrip(".…⋯")) != digits:
        values = {_endless(whole, *halves) for halves in _repetitions(plain)}
        if len(values) == 1:
            return values.pop()
        if values:
            shown = " or ".join(quoted(str(value)) for value in sorted(values))
            raise source.unreadable(f"{quoted(token.text)} may be {shown}; write the fraction.", token.place)
        shown = quoted(f"{whole or 0}.{plain}")
        message = f"{quoted(token.text)} does not show which digits repeat; write {shown}, or a fraction."
        raise source.unreadable(message, token.place)
    bare = re.sub(f"[{_BAR}{_DOT}]", "", digits)
    marked = [
        len(re.sub(f"[{_BAR}{_DOT}]", "", digits[: mark.start()])) - 1
        for mark in re.finditer(f"[{_BAR}{_DOT}]", digits)
    ]
    first = min(marked)
    rows = set(range(first, len(bare)))
    if first < 0 or not (set(marked) == rows or (set(marked) == {first, len(bare) - 1} and _DOT in digits)):
        raise source.unreadable(
            f"{quoted(token.text)} does not show which digits repeat; write a fraction.", token.place
        )
    return _endless(whole, bare[:first], bare[first:])


def _endless(whole: str, fixed: str, block: str) -> Fraction:
    """A decimal whose last digits are repeated for ever."""
    start = Fraction(int(f"{whole}{fixed}" or 0), 10 ** len(fixed))
    return start + Fraction(int(block), 10 ** len(fixed) * (10 ** len(block) - 1))


def _repetitions(digits: str) -> Iterator[tuple[str, str]]:
    """How digits before three dots may go on: what stands before a repeated block, and the block.

    One digit is seen to repeat where it stands three times, or alone; a longer block where it stands twice.
    """
    for length in range(1, len(digits) // 2 + 1):
        block = digits[-length:]
        times = 2 if length > 1 or digits == block * 2 else 3
        if digits.endswith(block * times):
            yield digits[:-length], block


def _foreign(text: str, index: int) -> str:
    character = text[index]
    if character in "[{⟨" and not any(closing in text for closing in "]}⟩"):
        return f"The bracket {quoted(character)} is not closed; close it."
    if character in "[]{}⟨⟩":
        return f"{quoted(character)} is not read inside a number; use round brackets."
    if unicodedata.category(character) == "Sc" or character in "′″":
        return f"{quoted(character)} is a unit; write the number alone, in the unit that is asked for."
    if character == "\\":
        command = re.match(r"\\[A-Za-z]*", text[index:])
        return f"The command {quoted(command[0] if command else character)} is not understood; write it in plain signs."
    if character == "=":
        return "'=' is not understood here; write the value alone, once."
    return f"{quoted(character)} is not understood here; write a number such as 3, 0.75 or 3/4."


def _digits(token: _Token) -> str:
    """A number in plain digits: 3/4 for ¾, 1 3/4 for 1¾."""
    spread = "".join(f" {unicodedata.normalize('NFKC', sign)}" if sign in VULGAR else sign for sign in token.text)
    return spread.replace("⁄", "/").replace("*^", "e").replace("{,}", ",").strip()
