"""Mathematics, and texts with mathematics in them, as Typst, the language that PDFs are typeset from.

Every text ends up inside a quoted string or escaped, so that no name can be read as Typst code.
"""

import re

from rldrill.problems.document import pieces
from rldrill.problems.mathematics import (
    EMPTY,
    Accent,
    Big,
    Fence,
    Fraction,
    Glyph,
    Marked,
    Math,
    Root,
    Row,
    Script,
    Style,
    Tabular,
    with_joined_scripts,
)
from rldrill.render.mathematics.breaking import begins_side, grouped, packed
from rldrill.render.mathematics.scripts import on_one_line, taken_apart
from rldrill.render.mathematics.spacing import is_word, parted
from rldrill.render.mathematics.unicode import unicode

_FUNCTIONS = {"max", "min", "arg max", "arg min", "ln", "exp", "log", "sin", "cos", "tr", "det"}
_BIGS = {"Σ": "sum", "Π": "product", "∏": "product", "∑": "sum", "∫": "integral"}
_SIGNS = {
    ";": r"\; space",
    ":": 'class("normal", colon) thick',
    "−": "minus",
    "-": "minus",
    "·": "dot.op",
    "*": "ast.op",
    "|": 'class("relation", bar.v)',
}
_FENCES = {
    "(": "paren.l", ")": "paren.r", "[": "bracket.l", "]": "bracket.r", "{": "brace.l", "}": "brace.r",
    "|": "bar.v", "‖": "bar.v.double", "": "",
}  # fmt: skip
_ACCENTS = {"hat": "hat", "bar": "overline", "tilde": "tilde"}
CLASSES: dict[Style, str] = {"operator": "binary", "relation": "relation", "punctuation": "punctuation"}
_SEPARATORS = (Glyph(",", "punctuation"), Glyph(";", "punctuation"))
_COMMA, _MINUS = Glyph(",", "punctuation"), Glyph("−", "operator")
#: Equations of at most this many signs stand side by side, and are not broken; nor is a side of at most so many.
SHORT, _SIDE = 24, 48


def typst(math: Math) -> str:
    """Mathematics as the inside of a Typst equation."""
    match math:
        case Glyph():
            return _attached(*_taken_apart(math))
        case Row(items):
            return typst_row(items)
        case Fraction(numerator, denominator):
            return f"frac({typst(numerator)}, {typst(denominator)})"
        case Script():
            return _script(with_joined_scripts(math))
        case Fence(body, left, right):
            return f"lr({typst_fence(left)} {typst(body)} {typst_fence(right)})"
        case Big(sign, below, above):
            base = _BIGS.get(sign) or f"op({quoted(sign)}, limits: #true)"
            return _attached(base, _optional(below), _optional(above))
        case Root(body):
            return f"sqrt({typst(body)})"
        case Accent(body, mark):
            return f"{_ACCENTS[mark]}({typst(body)})"
        case Marked(body):
            kind = CLASSES.get(body.style) if isinstance(body, Glyph) else None
            return f'class("{kind}", grounded({typst(body)}))' if kind else f"marked({typst(body)})"
        case Tabular(rows, left, right):
            lines = "; ".join(", ".join(map(typst, line)) for line in rows)
            return f"lr({typst_fence(left)} mat(delim: #none, {lines}) {typst_fence(right)})"


def quoted(text: str) -> str:
    """A text as a Typst string; control characters and line breaks become spaces."""
    plain = "".join(sign if sign.isprintable() or sign == "\u200b" else " " for sign in text)
    escaped = plain.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def text(text: str) -> str:
    """Running text as Typst markup, its mathematics in equations."""
    return "".join(plain(piece) if isinstance(piece, str) else _inline(piece) for piece in pieces(text))


def _inline(math: Math) -> str:
    """Mathematics within a line; the line may break between the equations of a list."""
    items = math.items if isinstance(math, Row) else (math,)
    groups = grouped(items, lambda before, _: before in _SEPARATORS)
    if len(groups) == 1 or not any(isinstance(item, Glyph) and item.style == "relation" for item in groups[-1]):
        return _sides(items)
    *lists, last = groups
    return "".join(f"{_sides(group[:-1])}#{quoted(f'{unicode(group[-1]).strip()} ')};" for group in lists) + _sides(
        last
    )


def _sides(items: tuple[Math, ...]) -> str:
    """An equation; a line may end before the relations of a long one, and nowhere behind them."""
    whole = Row(items)
    if len(unicode(whole)) <= SHORT:
        return equation(whole, "kept")
    sides = packed(grouped(items, begins_side), lambda side, _: len(unicode(side)), _SIDE)
    return " ".join(equation(side, "kept" if len(unicode(side)) <= _SIDE else "eq") for side in sides)


def equation(math: Math, function: str = "eq") -> str:
    """Mathematics as an equation within a line, with its Unicode as what is read aloud."""
    return f"#{function}({quoted(unicode(math))}, ${typst(math)}$)"


def plain(text: str) -> str:
    """Text without mathematics as Typst markup, dollar signs and all; no line ends behind the hyphen of Q-learning."""
    return "".join(f"#box[#{quoted(piece)};]" if whole else f"#{quoted(piece)};" for piece, whole in parted(text))


def relation(sign: str) -> str:
    """The sign between two sides of an equation; nothing where there is none."""
    return _sign(sign, "relation") if sign else ""


# Glyphs and scripts


def _taken_apart(glyph: Glyph) -> tuple[str, str, str]:
    """A glyph as base, subscript and superscript: ``s₁′`` has all three."""
    stem, digits, primes = taken_apart(glyph.text, glyph.style)
    above = " ".join(["prime"] * primes)
    return (_sign(stem, glyph.style), digits, above) if stem else (above or quoted(glyph.text), "", "")


def _sign(text: str, style: Style) -> str:
    if style == "number" and re.fullmatch(r"[0-9]+(\.[0-9]+)?", text):
        return text
    if style == "number" and "," in text:  # in one string with digits it would have spaces around
        whole, _, decimals = text.partition(",")
        return rf'{_sign(whole, style)} class("normal", \,) {_sign(decimals, style)}'
    if style == "word":
        return f"op({quoted(text)})" if text in _FUNCTIONS else f"upright({quoted(text)})"
    if len(text) == 1 and style != "number":
        return _SIGNS.get(text) or _character(text)
    kind = CLASSES.get(style)
    return f'class("{kind}", {quoted(text)})' if kind else f"upright({quoted(text)})"


def _character(sign: str) -> str:
    if sign.isascii():
        return sign if sign.isalpha() else rf"\{sign}"
    return rf"\u{{{ord(sign):x}}}"


def _script(script: Script) -> str:
    body, below, above = script.body, script.below, script.above
    base, digits, primes = _taken_apart(body) if isinstance(body, Glyph) else (typst(body), "", "")
    lower = r" \, ".join(filter(None, (digits, _optional(below))))
    upper = " ".join(filter(None, (primes, _optional(above))))
    return _attached(base, lower, upper)


def _attached(base: str, below: str, above: str) -> str:
    if not below and not above:
        return base
    lower = f", b: {below}" if below else ""
    upper = f", t: {above}" if above else ""
    return f"attach({base}{lower}{upper})"


def _optional(math: Math | None) -> str:
    return "" if math is None else typst(on_one_line(math))


def typst_fence(sign: str) -> str:
    """A bracket as the inside of ``lr``."""
    return _FENCES[sign] if sign in _FENCES else _character(sign)


# Rows


def typst_row(items: tuple[Math, ...]) -> str:
    """Mathematics side by side."""
    result: list[str] = []
    for position, item in enumerate(items):
        if not position and len(items) > 1 and item == _MINUS:  # −5, with no more space than +5 would have
            result.append('class("unary", minus)')
            continue
        if result and _is_prime(item):
            result[-1] = f"attach({result[-1]}, t: {typst(item)})"
            continue
        if position and items[position - 1] == _COMMA and not isinstance(_head(item), Glyph):
            result.append(" thin")  # which Typst leaves before letters and numbers only
        # A word keeps the space beside it in Typst, which a bracket after it must not have.
        close = position > 0 and is_word(items[position - 1]) and isinstance(item, Fence)
        result.append(typst(item) if close or not result else f" {typst(item)}")
    return "".join(result) or '""'


def _head(item: Math) -> Math:
    """What an item begins with; a sign before it is nothing of it."""
    if isinstance(item, Script):
        return _head(item.body)
    return EMPTY if isinstance(item, Glyph) and item.style == "operator" else item


def _is_prime(item: Math) -> bool:
    return isinstance(item, Glyph) and set(item.text) <= set("′'") and bool(item.text)
