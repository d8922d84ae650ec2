"""Mathematics on one line of Unicode, for terminals."""

import re

from rldrill.problems.document import pieces
from rldrill.problems.mathematics import (
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
)
from rldrill.render.mathematics.spacing import is_word, opens

#: Signs and their small forms below and above the line.
BELOW = dict(zip("0123456789+−=()aehijklmnoprstuvxβγρφχ", "₀₁₂₃₄₅₆₇₈₉₊₋₌₍₎ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓᵦᵧᵨᵩᵪ", strict=True))
ABOVE = dict(
    zip(
        "0123456789+−=()abcdefghijklmnoprstuvwxyzTABβγδφ",
        "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁼⁽⁾ᵃᵇᶜᵈᵉᶠᵍʰⁱʲᵏˡᵐⁿᵒᵖʳˢᵗᵘᵛʷˣʸᶻᵀᴬᴮᵝᵞᵟᵠ",
        strict=True,
    )
)
#: Primes stand below the line as they are.
_LOWERED = BELOW | {"′": "′"}
_LARGE = str.maketrans({small: large for large, small in ABOVE.items()})
_SMALL_POWER = re.compile(f"(?<![^\\W\\d_])e([{re.escape(''.join(ABOVE.values()))}]+)")
_PARTIAL = Glyph("∂", "variable")
_DIFFERENTIALS = (_PARTIAL, Glyph("d", "variable"), Script(_PARTIAL, above=Glyph("2", "number")))
_MARKS = {"hat": "\u0302", "bar": "\u0304", "tilde": "\u0303"}


def unicode(math: Math) -> str:
    """Mathematics as one line of text, with Unicode's scripts where they exist."""
    match math:
        case Glyph(text, style):
            if style == "relation":
                return f" {text} "
            if style == "punctuation" and text in ",;:":
                return f"{text} "
            return text
        case Row(items):
            return _row(tuple(map(unmarked, items)))
        case Fraction(numerator, denominator):
            above = unicode(numerator).strip() if _is_plain_product(numerator) else _grouped(numerator)
            return _one_way(f"{above}/{_grouped(denominator)}")
        case Script(body, below, above):
            return _script(body, below, above)
        case Fence(body, left, right):
            return f"{left}{unicode(body).strip()}{right}"
        case Big(sign, below, above):
            return f"{sign}{scripts(below, above)} "
        case Root(body):
            return f"√({unicode(body)})" if isinstance(body, Script) else f"√{_grouped(body)}"
        case Accent(body, mark):
            return unicode(body) + _MARKS[mark]
        case Marked(body):
            return unicode(body)
        case Tabular(rows, left, right):
            lines = ["  ".join(unicode(cell) for cell in line) for line in rows]
            return f"{left}{' ; '.join(lines)}{right}"


def _one_way(quotient: str) -> str:
    """A quotient in which powers of e are written in one way: exp(0) beside exp(ln 2)."""
    if "exp(" not in quotient:
        return quotient
    return _SMALL_POWER.sub(lambda power: f"exp({power[1].translate(_LARGE)})", quotient)


def unmarked(math: Math) -> Math:
    """What is marked by itself: as it is spaced among others."""
    return math.body if isinstance(math, Marked) else math


#: Stands for the spaces of a formula while its paragraph is broken into lines.
GLUE = "\ue000"
#: A formula that is longer than this may be broken, a list of formulas between two of them.
_LONG = 48


def inline(text: str, *, glued: bool = False) -> str:
    """A text with its mathematics in Unicode; ``glued`` where formulas stay in one piece, unless they are long."""
    return "".join(piece if isinstance(piece, str) else _piece(piece, glued=glued) for piece in pieces(text))


def _piece(math: Math, *, glued: bool) -> str:
    written = unicode(math).strip()
    if not glued:
        return written
    return written.replace(" ", GLUE) if len(written) <= _LONG else _between_formulas(written)


def _between_formulas(written: str) -> str:
    """Formulas one after the other, with a space to break at behind each comma only; a single one as it is."""
    depth, text = 0, ""
    for sign in written:
        depth += (sign in "([{") - (sign in ")]}")
        text += GLUE if sign == " " and (depth or not text.endswith((",", ";"))) else sign
    return text if " " in text else written


def _row(items: tuple[Math, ...]) -> str:
    text = ""
    for position, item in enumerate(items):
        if isinstance(item, Glyph) and item.style == "operator" and item.text in "+−±":
            # A sign with nothing before it belongs to what follows; between two terms it stands free.
            binary = position > 0 and not opens(items[position - 1])
            text += f" {item.text} " if binary else item.text
        else:
            if isinstance(item, Big) and text and text[-1] not in " ([{|":
                text += " "
            if position and isinstance(items[position - 1], Fence) and _is_letter(item):
                text += " "
            if is_word(item) and text and text[-1].isalnum():
                text += " "
            text += unicode(item)
            if is_word(item) and position + 1 < len(items) and isinstance(items[position + 1], Glyph | Script):
                following = items[position + 1]
                if not (isinstance(following, Glyph) and following.style in ("punctuation", "relation", "operator")):
                    text += " "
    return text


def _is_plain_product(item: Math) -> bool:
    """A number and letters side by side: 2π/3 needs no brackets above the line."""
    return isinstance(item, Row) and all(
        isinstance(part, Root) or (isinstance(part, Glyph) and part.style in ("number", "variable"))
        for part in item.items
    )


def _is_letter(item: Math) -> bool:
    head = item.body if isinstance(item, Script) else item
    return isinstance(head, Glyph) and head.style in ("variable", "word")


def _grouped(math: Math) -> str:
    """Something above or below a slash, in brackets unless it is a single thing."""
    text = unicode(math).strip()
    single = (
        isinstance(math, Glyph | Fence | Root)
        or (isinstance(math, Script) and not isinstance(math.body, Fraction))
        or (isinstance(math, Row) and len(math.items) == 2 and isinstance(math.items[1], Fence)
            and isinstance(math.items[0], Glyph) and math.items[0].style in ("word", "variable"))
        or (isinstance(math, Row) and len(math.items) == 2 and math.items[0] in _DIFFERENTIALS)
    )  # fmt: skip
    return text if single else f"({text})"


def scripts(below: Math | None, above: Math | None) -> str:
    """A subscript and a superscript as text."""
    lowered = "" if below is None else _shifted(below, _LOWERED, "_")
    if above == Glyph("*", "operator"):
        return f"{lowered}*"
    return lowered if above is None else lowered + _shifted(above, ABOVE, "^")


def _script(body: Math, below: Math | None, above: Math | None) -> str:
    base = unicode(body)
    if body == Glyph("e", "variable") and below is None and above is not None and not _is_readable_above(above):
        return f"exp({unicode(above)})"
    if isinstance(body, Fraction | Row):
        base = f"({base})"
    return base + scripts(below, above)


def _is_readable_above(math: Math) -> bool:
    """Whether an exponent can be written with small signs, and holds no words such as ln."""
    words = any(map(is_word, math.items if isinstance(math, Row) else ()))
    return not words and all(sign in ABOVE for sign in unicode(math).replace(" ", ""))


def _shifted(math: Math, table: dict[str, str], mark: str) -> str:
    text = unicode(math).replace(" ", "")
    if text.strip("′") and all(sign in table for sign in text):
        return "".join(table[sign] for sign in text)
    return f"{mark}{text}" if len(text) == 1 or _bracketed(text) else f"{mark}({text})"


def _bracketed(text: str) -> bool:
    return text.startswith("(") and text.endswith(")") and "(" not in text[1:]
