"""Mathematics as data: what formulas, steps and questions are made of before they are typeset.

Questions write it between ``$`` signs in the sheet's own notation: ``$V(s_{t+1}) = 3/4$``. Greek letters
stand for themselves, a combining hat makes an accent (``V̂``), ``_`` and ``^`` make scripts, a word of several letters
or in quotes is set upright,
``3/4`` and ``{…}/{…}`` are fractions, ``√(…)`` is a root, ``∑_i`` a sum (``Σ`` is the letter), ``dθ`` a differential,
``⊤`` the mark of a transpose. Formulas arrive here from sympy expressions. What begins with ``!`` stays as it is in
every notation (``rldrill.problems.notations``).
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from typing import Literal, TypeAlias
from unicodedata import normalize

from msgspec import Struct

Style = Literal["variable", "word", "number", "operator", "relation", "punctuation"]


class Glyph(Struct, frozen=True):
    """One sign: a letter, a word, a number, an operator."""

    text: str
    style: Style


class Name(Glyph, frozen=True):
    """The same, but no letter of a notation: the name of a state or an action, or what is a problem's own."""


class Row(Struct, frozen=True):
    """Things side by side."""

    items: tuple["Math", ...]


class Fraction(Struct, frozen=True):
    """A quotient, one above the other where there is room."""

    numerator: "Math"
    denominator: "Math"


class Script(Struct, frozen=True):
    """Something with a subscript, a superscript or both."""

    body: "Math"
    below: "Math | None" = None
    above: "Math | None" = None


class Fence(Struct, frozen=True):
    """Something in brackets that grow with it."""

    body: "Math"
    left: str = "("
    right: str = ")"


class Big(Struct, frozen=True):
    """A large operator with limits: Σ, max, arg max, 𝔼."""

    sign: str
    below: "Math | None" = None
    above: "Math | None" = None


class Root(Struct, frozen=True):
    """A square root."""

    body: "Math"


class Accent(Struct, frozen=True):
    """A letter with a mark above it."""

    body: "Math"
    mark: Literal["hat", "bar", "tilde"]


class Tabular(Struct, frozen=True):
    """A matrix, or a column of cells, between brackets."""

    rows: tuple[tuple["Math", ...], ...]
    left: str = "["
    right: str = "]"


class Marked(Struct, frozen=True):
    """Something that is other than it should be."""

    body: "Math"


Math: TypeAlias = Glyph | Row | Fraction | Script | Fence | Big | Root | Accent | Tabular | Marked


def variable(text: str) -> Glyph:
    """A letter that stands for a quantity."""
    return Glyph(text, "variable")


def word(text: str) -> Glyph:
    """A word or name, set upright."""
    return Glyph(text, "word")


def operator(text: str) -> Glyph:
    """A sign between two terms or factors."""
    return Glyph(text, "operator")


def relation(text: str) -> Glyph:
    """A sign between two sides."""
    return Glyph(text, "relation")


def punctuation(text: str) -> Glyph:
    """A comma, a bar, a bracket."""
    return Glyph(text, "punctuation")


def row(*items: Math) -> Math:
    """Things side by side; rows inside are dissolved."""
    flat: list[Math] = []
    for item in items:
        flat.extend(item.items if isinstance(item, Row) else [item])
    return flat[0] if len(flat) == 1 else Row(tuple(flat))


#: Nothing at all.
EMPTY = Row(())


def listed(items: Iterable[Math], separator: str = ",") -> Math:
    """Things with a separator between them."""
    result: list[Math] = []
    for item in items:
        if result:
            result.append(punctuation(separator))
        result.append(item)
    return row(*result)


def name(text: str) -> Name:
    """The name of a state or an action: a letter (with digits, primes) is a variable, what begins with a capital or is
    longer is a word, as it is in tables and sentences. No notation writes it otherwise."""
    return Name(text, "word" if re.match(r"[A-Z]", text) else letters(text).style)


def own(text: str) -> Name:
    """A letter that is no letter of a notation, such as one that a problem leaves open."""
    return Name(text, "variable")


def letters(text: str) -> Glyph:
    """Letters in mathematics: one (with digits, primes) is a variable, more are a word."""
    return variable(text) if re.fullmatch(r"[^\W\d_][₀-₉′]*", text) else word(text)


def number(value: object) -> Math:
    """A rational number, its minus sign typographic; anything with ``/`` in it becomes a fraction."""
    text = str(value)
    minus = text.startswith("-")
    numerator, _, denominator = text.removeprefix("-").partition("/")
    magnitude: Math = Glyph(numerator, "number")
    if denominator:
        magnitude = Fraction(magnitude, Glyph(denominator, "number"))
    return row(operator("−"), magnitude) if minus else magnitude


def with_joined_scripts(script: Script) -> Script:
    """The index of what has an index stands beside that one, ``A_{Δ,13}``, and a power above it, ``w_i^2``."""
    match script:
        case Script(Script(body, inner, None), outer, above) if inner is not None:
            return Script(body, inner if outer is None else row(inner, punctuation(","), outer), above)
    return script


def signs(math: Math) -> Iterator[str]:
    """All that is written in mathematics, sign by sign, with marks for fractions, roots and brackets."""
    match math:
        case Glyph(text, _):
            yield text
        case Row(items):
            for item in items:
                yield from signs(item)
        case Fraction(numerator, denominator):
            yield "/"
            yield from signs(numerator)
            yield from signs(denominator)
        case Script(body, below, above) | Big(body, below, above):
            yield from signs(body) if not isinstance(body, str) else (body,)
            yield from () if below is None else ("_", *signs(below))
            yield from () if above is None else ("^", *signs(above))
        case Fence(body, left, right):
            yield left
            yield from signs(body)
            yield right
        case Tabular(rows, left, right):
            yield left
            for line in rows:
                for cell in line:
                    yield from signs(cell)
            yield right
        case Root(body) | Marked(body):
            yield "√" if isinstance(math, Root) else "mark"
            yield from signs(body)
        case Accent(body, mark):
            yield mark
            yield from signs(body)


_TOKEN = re.compile(
    r"""(?P<quoted>"[^"]*")|(?P<number>\d+(?:\.\d+)?(?:/\d+)?)|(?P<letters>d(?=[A-ZΑ-ω](?![^\W\d_]))|[^\W\d_]+[\u0302-\u0304]?[₀-₉'′]*)
    |(?P<space>\s+)|(?P<other>.)""",
    re.VERBOSE,
)
_MARKS: dict[str, Literal["hat", "bar", "tilde"]] = {"\u0302": "hat", "\u0304": "bar", "\u0303": "tilde"}
_RELATIONS = set("=<>≤≥≠←→∈≈∼↦")
_OPERATORS = set("+−-·×*±")
#: Signs that stand for something, as letters do.
_SYMBOLS = set("∂∇∞…")
_OPENING = {"(": ")", "[": "]", "{": "}", "‖": "‖"}


@lru_cache(maxsize=4096)
def mathematics(text: str) -> Math:
    """Read the notation between ``$`` signs.

    Raises:
        ValueError: a brace or bracket is left open.
    """
    tokens = [match for match in _TOKEN.finditer(text) if match.lastgroup != "space"]
    items, rest = _sequence(tokens, 0, None)
    if rest != len(tokens):
        raise ValueError(f"unmatched {tokens[rest][0]!r} in the mathematics {text!r}")
    return row(*items)


def _sequence(tokens: Sequence[re.Match[str]], at: int, closing: str | None) -> tuple[list[Math], int]:
    items: list[Math] = []
    while at < len(tokens):
        token = tokens[at][0]
        if token == closing or (token in ")]}" and closing is not None):
            return items, at
        if token in "_^":
            # A star above is a star, as in V^*; elsewhere it multiplies.
            star = token == "^" and at + 1 < len(tokens) and tokens[at + 1][0] == "*"
            script, at = (operator("*"), at + 2) if star else _single(tokens, at + 1)
            body = items.pop() if items else word("")
            below, above = (script, None) if token == "_" else (None, script)
            if isinstance(body, Script) and (body.below is None or below is None):
                body = Script(body.body, body.below or below, body.above or above)
            else:
                body = Script(body, below, above)
            items.append(body)
            continue
        opens = token == "|" and (not items or is_sign(items[-1]))  # and is not that of p(a|b)
        item, at = _fenced(tokens, at, "|") if opens else _single(tokens, at)
        items.append(item)
    if closing is not None:
        raise ValueError(f"{closing!r} is missing in mathematics")
    return items, at


def _fenced(tokens: Sequence[re.Match[str]], at: int, closing: str) -> tuple[Math, int]:
    items, end = _sequence(tokens, at + 1, closing)
    if tokens[end][0] != closing:
        raise ValueError(f"{closing!r} is missing in mathematics")
    inside, opening = row(*items), tokens[at][0]
    return (inside if opening == "{" else Fence(inside, opening, closing)), end + 1


def is_sign(item: Math) -> bool:
    """Whether something is an operator or a relation."""
    return isinstance(item, Glyph) and item.style in ("operator", "relation")


def _single(tokens: Sequence[re.Match[str]], at: int) -> tuple[Math, int]:
    if at >= len(tokens):
        raise ValueError("a script is missing in mathematics")
    match = tokens[at]
    token = match[0]
    if token in _OPENING:
        inside, end = _fenced(tokens, at, _OPENING[token])
        if token == "{" and [each[0] for each in tokens[end : end + 2]] == ["/", "{"]:
            below, end = _single(tokens, end + 1)
            return Fraction(inside, below), end
        return inside, end
    if token == "√":
        under, after = _single(tokens, at + 1)
        return Root(under.body if isinstance(under, Fence) else under), after
    if token == "∑":
        index, after = _single(tokens, at + 2)
        return Big("Σ", index), after
    if match.lastgroup == "quoted":
        return name(token[1:-1]), at + 1
    if match.lastgroup == "number":
        return number(token), at + 1
    if match.lastgroup == "letters":
        plain = normalize("NFD", token)  # ā may be one character or two
        if plain[-1] in _MARKS and (len(plain) == 2 or plain == token):
            return Accent(letters(plain[:-1]), _MARKS[plain[-1]]), at + 1
    if match.lastgroup == "letters":
        return letters(token.replace("'", "′")), at + 1
    if token == "⊤":
        return word("T"), at + 1
    if token in _SYMBOLS:
        return variable(token), at + 1
    if token in _RELATIONS:
        return relation(token), at + 1
    if token in _OPERATORS:
        return operator(token.replace("-", "−").replace("*", "·")), at + 1
    return punctuation(token), at + 1
