"""Mathematics as MathML, which every browser sets and every screen reader reads."""

from collections.abc import Sequence
from html import escape

from rldrill.problems.document import Equation
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
    Tabular,
    is_sign,
    with_joined_scripts,
)
from rldrill.render.mathematics.scripts import on_one_line, taken_apart
from rldrill.render.mathematics.spacing import is_tall, needs_space, opens
from rldrill.render.mathematics.unicode import unmarked

_BIGS = {"Σ": "∑", "Π": "∏", "∏": "∏", "∑": "∑", "∫": "∫"}
_MARKS = {"hat": "^", "bar": "‾", "tilde": "~"}
#: A sign that belongs to what follows, as in −5.
_SIGNED: dict[Math, str] = {
    Glyph(sign, "operator"): f'<mo form="prefix" lspace="0" rspace="0">{sign}</mo>' for sign in "+−±"
}
_THIN = '<mspace width="0.17em"></mspace>'


def mathml(math: Math) -> str:
    """Mathematics as a ``math`` element within a line."""
    return f"<math>{element(math)}</math>"


def element(math: Math) -> str:
    """Mathematics as what stands inside of a ``math`` element: one element, always."""
    match math:
        case Glyph():
            base, below, above = _taken_apart(math)
            return _scripts(base, below, above)
        case Row(items):
            return f"<mrow>{_row(items)}</mrow>"
        case Fraction(numerator, denominator):
            return f"<mfrac>{element(numerator)}{element(denominator)}</mfrac>"
        case Script():
            return _script(with_joined_scripts(math))
        case Fence(body, left, right):
            grows = is_tall(body)
            brackets = _fence(left, "prefix", grows=grows), _fence(right, "postfix", grows=grows)
            return f"<mrow>{brackets[0]}{element(body)}{brackets[1]}</mrow>"
        case Big(sign, below, above):
            lower, upper = ("" if limit is None else element(limit) for limit in (below, above))
            return _scripts(_big(sign), lower, upper, ("munder", "mover", "munderover"))
        case Root(body):
            return f"<msqrt>{element(body)}</msqrt>"
        case Accent(body, mark):
            return f'<mover accent="true">{element(body)}<mo stretchy="false">{_MARKS[mark]}</mo></mover>'
        case Marked(body):
            return f'<mrow class="marked{" sign" * is_sign(body)}">{element(body)}</mrow>'
        case Tabular(rows, left, right):
            lines = "".join(f"<mtr>{''.join(f'<mtd>{element(cell)}</mtd>' for cell in line)}</mtr>" for line in rows)
            return f"<mrow>{_fence(left, 'prefix')}<mtable>{lines}</mtable>{_fence(right, 'postfix')}</mrow>"


def chain(equation: Equation) -> str:
    """An equation as one element, its right sides one under the other."""
    left = "" if equation.left == EMPTY else element(equation.left)
    links = list(zip(equation.signs, equation.rights, strict=True))
    if len(links) == 1:
        ((sign, right),) = links
        return f"<mrow>{left}{_relation(sign)}{element(right)}</mrow>"
    lefts = (left, *[""] * (len(links) - 1))
    lines = "".join(
        f"<mtr><mtd>{before}</mtd><mtd><mrow>{_relation(sign)}{element(right)}</mrow></mtd></mtr>"
        for before, (sign, right) in zip(lefts, links, strict=True)
    )
    return f'<mtable class="chain" displaystyle="true">{lines}</mtable>'


def _relation(sign: str) -> str:
    """The sign between two sides; nothing where there is none."""
    return f"<mo>{escape(sign)}</mo>" if sign else ""


def _fence(sign: str, form: str, *, grows: bool = True) -> str:
    """A bracket; one that may grow takes the room of the largest in some browsers, also where it does not grow."""
    if not sign:
        return ""
    stretchy = "true" if grows else "false"
    return f'<mo fence="true" stretchy="{stretchy}" form="{form}" lspace="0" rspace="0">{escape(sign)}</mo>'


def _big(sign: str) -> str:
    if sign in _BIGS:
        return f'<mo movablelimits="false">{_BIGS[sign]}</mo>'
    return f'<mo movablelimits="false" lspace="0.1em" rspace="0.17em">{escape(sign)}</mo>'


def _taken_apart(glyph: Glyph) -> tuple[str, str, str]:
    """A glyph as base, subscript and superscript: ``s₁′`` has all three."""
    stem, digits, primes = taken_apart(glyph.text, glyph.style)
    if not stem:
        return _sign(glyph.text, glyph.style), "", ""
    below = f"<mn>{digits}</mn>" if digits else ""
    above = f"<mo>{'′' * primes}</mo>" if primes else ""
    return _sign(stem, glyph.style), below, above


def _sign(text: str, style: str) -> str:
    shown = escape(text)
    match style:
        case "number":
            return f"<mn>{shown}</mn>"
        case "variable":
            return f"<mi>{shown}</mi>"
        case "word":  # no mtext: beside that an operator's space moves to the end of the row
            return f"<mi>{shown}</mi>" if len(text) > 1 else f'<mi mathvariant="normal">{shown}</mi>'
        case "punctuation" if text == "|":
            return '<mo stretchy="false" lspace="0.2em" rspace="0.2em" form="infix">|</mo>'
        case "punctuation" if text == "/":
            return '<mo lspace="0" rspace="0">/</mo>'
        case "punctuation":
            return f'<mo separator="true" stretchy="false" lspace="0" rspace="0.25em">{shown}</mo>'
        case _:
            return f"<mo>{shown}</mo>"


def _script(script: Script) -> str:
    body, below, above = script.body, script.below, script.above
    base, digits, primes = _taken_apart(body) if isinstance(body, Glyph) else (element(body), "", "")
    lower = [part for part in (digits, "" if below is None else element(on_one_line(below))) if part]
    upper = [part for part in (primes, "" if above is None else element(on_one_line(above))) if part]
    return _scripts(base, _joined(lower), _joined(upper))


def _joined(parts: Sequence[str]) -> str:
    return parts[0] if len(parts) == 1 else f"<mrow>{''.join(parts)}</mrow>" if parts else ""


def _scripts(base: str, below: str, above: str, tags: Sequence[str] = ("msub", "msup", "msubsup")) -> str:
    """What stands below and above; the tags are those for the one, the other and both."""
    tag = tags[2 if below and above else 0 if below else 1]
    return f"<{tag}>{base}{below}{above}</{tag}>" if below or above else base


def _row(items: tuple[Math, ...]) -> str:
    written: list[str] = []
    bare = tuple(map(unmarked, items))
    for before, after, item in zip((None, *bare), bare, items, strict=False):
        if before is not None and needs_space(before, after):
            written.append(_THIN)
        written.append(_SIGNED[item] if item in _SIGNED and (before is None or opens(before)) else element(item))
    return "".join(written)
