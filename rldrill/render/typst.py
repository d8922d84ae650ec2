"""Mathematics and blocks as Typst, the language that PDFs are typeset from.

Every text ends up inside a quoted string or escaped, so that no name can be read as Typst code. Blocks call
functions of ``PREAMBLE``, which must stand before them.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass

from rldrill.problems.document import Beside, Block, Document, Equation, Heading, Paragraph, Table, pieces
from rldrill.problems.mathematics import (
    EMPTY,
    Accent,
    Big,
    Fence,
    Fraction,
    Glyph,
    Math,
    Root,
    Row,
    Script,
    Style,
    Tabular,
)
from rldrill.problems.pictures import Picture
from rldrill.render.pictures import preamble
from rldrill.render.unicode import unicode

#: The functions that blocks call. Equations measure themselves: they are broken where they would be wider
#: than the column, and shrunk where no break is left.
_BLOCKS = r"""
#let wide(body) = measure(math.equation(block: true, body)).width
#let node(whole, ..parts) = (whole: whole.body, parts: parts.pos())
#let align-point = $&$.body
#let filled(node, lines, limit) = {
  let last = lines.last()
  let joined = if last == none { node.whole } else { last + node.whole }
  if wide(joined) <= limit { return lines.slice(0, -1) + (joined,) }
  if node.parts.len() > 0 and wide(node.whole) > limit {
    for part in node.parts { lines = filled(part, lines, limit) }
    return lines
  }
  if last == none { (node.whole,) } else { lines + ($""$.body + node.whole,) }
}
#let fitted(body, room) = {
  let width = measure(body).width
  if width > room { scale(room / width * 99%, origin: left, reflow: true, body) } else { body }
}
#let stacked(left, rights, room) = {
  let hang = 1em.to-absolute()
  let beside = wide(left) <= 0.4 * room
  let lead = if beside { wide(left) } else { hang }
  let rows = if beside { () } else { (align-point + left,) }
  for (index, (sign, tree)) in rights.enumerate() {
    let sign-width = if sign == [] { 0pt } else { wide($""$.body + sign + $""$.body) }
    let lines = filled(tree, (none,), room - lead - sign-width - hang)
    for (number, line) in lines.enumerate() {
      let start = if number == 0 { sign } else { h(sign-width + hang) }
      let before = if beside and index == 0 and number == 0 { left } else { [] }
      let indent = if beside { [] } else { h(hang) }
      rows.push(before + align-point + indent + start + line)
    }
  }
  rows.join(linebreak())
}
#let chain(left, ..rights) = block(width: 100%, breakable: false, layout(size => {
  set par(leading: 1.25 * par.leading)
  show math.equation.where(block: true): set align(start)
  let pairs = rights.pos().map(right => (right.at(0).body, right.at(1)))
  let line = left.body + pairs.map(pair => pair.at(0) + pair.at(1).whole).join()
  let body = if wide(line) <= size.width { line } else { stacked(left.body, pairs, size.width) }
  fitted(math.equation(block: true, body), size.width)
}))
// Without leading, an equation within a line is as tall as it looks.
#let inline-box(item) = box({ set par(leading: 0pt); math.equation(math.display(item.body)) })
#let flow(..items) = block(par(leading: 0.9em, items.pos().map(inline-box).join([#h(1.8em, weak: true) ])))
#let grid-table(columns, ..cells) = block(layout(size => fitted({ set par(leading: 0.3em); table(
  columns: columns,
  align: (column, row) => if column == 0 { left + horizon } else { center + horizon },
  stroke: (_, row) => (top: if row == 0 { 0.7pt } else if row == 1 { 0.4pt } else { 0pt }),
  inset: (x: 0.7em, y: 0.38em),
  ..cells.pos(),
  table.hline(stroke: 0.7pt),
) }, size.width)))
"""
PREAMBLE = _BLOCKS + preamble.PREAMBLE

_FUNCTIONS = {"max", "min", "arg max", "arg min", "ln", "exp", "log", "sin", "cos", "tr", "det"}
_BIGS = {"Σ": "sum", "Π": "product", "∏": "product", "∑": "sum", "∫": "integral"}
_SIGNS = {
    ";": r"\; space",
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
_CLASSES: dict[Style, str] = {"operator": "binary", "relation": "relation", "punctuation": "punctuation"}
_NAME = re.compile(r"(?P<stem>.*?)(?P<digits>[₀-₉]*)(?P<primes>[′']*)", re.DOTALL)
_COMMA = Glyph(",", "punctuation")
_MINUS = Glyph("−", "operator")
_DIGITS = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
#: Equations of at most this many signs stand side by side.
_SHORT = 24


def typst(math: Math) -> str:
    """Mathematics as the inside of a Typst equation."""
    match math:
        case Glyph():
            return _attached(*_taken_apart(math))
        case Row(items):
            return _row(items)
        case Fraction(numerator, denominator):
            return f"frac({typst(numerator)}, {typst(denominator)})"
        case Script(body, below, above):
            return _script(body, below, above)
        case Fence(body, left, right):
            return f"lr({_fence(left)} {typst(body)} {_fence(right)})"
        case Big(sign, below, above):
            base = _BIGS.get(sign) or f"op({quoted(sign)}, limits: #true)"
            return _attached(base, _optional(below), _optional(above))
        case Root(body):
            return f"sqrt({typst(body)})"
        case Accent(body, mark):
            return f"{_ACCENTS[mark]}({typst(body)})"
        case Tabular(rows, left, right):
            lines = "; ".join(", ".join(map(typst, line)) for line in rows)
            return f"lr({_fence(left)} mat(delim: #none, {lines}) {_fence(right)})"


def quoted(text: str) -> str:
    """A text as a Typst string; control characters and line breaks become spaces."""
    plain = "".join(sign if sign.isprintable() or sign == "\u200b" else " " for sign in text)
    escaped = plain.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def text(text: str) -> str:
    """Running text as Typst markup, its mathematics in equations."""
    return "".join(f"#{quoted(piece)};" if isinstance(piece, str) else _inline(piece) for piece in pieces(text))


def _inline(math: Math) -> str:
    """Mathematics within a line; the line may break between the equations of a list."""
    items = math.items if isinstance(math, Row) else (math,)
    groups = _grouped(items, lambda before, _: before == _COMMA)
    if len(groups) == 1 or not any(isinstance(item, Glyph) and item.style == "relation" for item in groups[-1]):
        return _kept_together(math)
    return '#", ";'.join(_kept_together(Row(group[:-1] if group[-1] == _COMMA else group)) for group in groups)


def _kept_together(math: Math) -> str:
    return f"#box[${typst(math)}$]" if len(unicode(math)) <= _SHORT else f"${typst(math)}$"


def block(block: Block) -> str:
    """A block as Typst markup."""
    match block:
        case Paragraph(words):
            return f"#par[{text(words)}]\n"
        case Heading(words):
            return f"#block(sticky: true, strong[{text(words)}])\n"
        case Table(header, rows):
            cells = "".join(f", [{text(cell)}]" for line in rows for cell in line)
            first = ", ".join(f"[{text(cell)}]" for cell in header)
            return f"#grid-table({len(header)}, table.header({first}){cells})\n"
        case Equation(left, rights, signs):
            if left == EMPTY and not any(signs):
                return _apart(rights)
            links = "".join(
                f", (${_relation(sign)}$, {_node(_tree(right))})" for sign, right in zip(signs, rights, strict=True)
            )
            return f"#chain(${'' if left == EMPTY else typst(left)}${links})\n"
        case Beside(blocks):
            return _side_by_side(blocks)
        case Picture():
            from rldrill.render.pictures.typst import picture  # it writes its labels with this module

            return picture(block)
        case _:
            raise TypeError(f"{type(block).__name__} has no Typst")


def _side_by_side(blocks: Document) -> str:
    bodies = [body for body in map(block, blocks) if body]  # a picture that is too large is left out
    return f"#beside({', '.join(f'[{body}]' for body in bodies)})\n"


def _apart(items: tuple[Math, ...]) -> str:
    """Mathematics that stands side by side where there is room."""
    if all(len(unicode(item)) <= 2 * _SHORT for item in items):
        return f"#flow({', '.join(f'${typst(item)}$' for item in items)})\n"
    return "".join(f"#chain($$, ($$, {_node(_tree(item))}))\n" for item in items)


def document(blocks: Document) -> str:
    """Blocks one under the other; short equations that follow each other share a line."""
    result: list[str] = []
    waiting: list[str] = []
    for item in (*blocks, None):
        if isinstance(item, Equation) and _is_short(item):
            waiting.append(f"${line(item)}$")
            continue
        if waiting:
            result.append(f"#flow({', '.join(waiting)})\n")
            waiting = []
        if item is not None:
            result.append(block(item))
    return "".join(result)


def _is_short(equation: Equation) -> bool:
    if len(equation.rights) != 1:
        return False
    return len(unicode(equation.left)) + len(unicode(equation.rights[0])) <= _SHORT


def line(equation: Equation) -> str:
    """An equation as the inside of a Typst equation, on one line however long it is."""
    links = zip(equation.signs, equation.rights, strict=True)
    return " ".join([typst(equation.left), *(f"{_relation(sign)} {typst(right)}" for sign, right in links)])


def _relation(sign: str) -> str:
    return _sign(sign, "relation") if sign else ""


# Glyphs and scripts


def _taken_apart(glyph: Glyph) -> tuple[str, str, str]:
    """A glyph as base, subscript and superscript: ``s₁′`` has all three."""
    match = _NAME.fullmatch(glyph.text)
    if match is None or glyph.style not in ("variable", "word"):
        return _sign(glyph.text, glyph.style), "", ""
    primes = " ".join(["prime"] * len(match["primes"]))
    if not match["stem"]:
        return primes or quoted(glyph.text), "", ""
    return _sign(match["stem"], glyph.style), match["digits"].translate(_DIGITS), primes


def _sign(text: str, style: Style) -> str:
    if style == "number" and re.fullmatch(r"[0-9]+(\.[0-9]+)?", text):
        return text
    if style == "word":
        return f"op({quoted(text)})" if text in _FUNCTIONS else f"upright({quoted(text)})"
    if len(text) == 1 and style != "number":
        return _SIGNS.get(text) or _character(text)
    kind = _CLASSES.get(style)
    return f'class("{kind}", {quoted(text)})' if kind else f"upright({quoted(text)})"


def _character(sign: str) -> str:
    if sign.isascii():
        return sign if sign.isalpha() else rf"\{sign}"
    return rf"\u{{{ord(sign):x}}}"


def _script(body: Math, below: Math | None, above: Math | None) -> str:
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
    return "" if math is None else typst(_on_one_line(math))


def _on_one_line(math: Math) -> Math:
    """Small print has no room for one number above another: ``3/2``."""
    if isinstance(math, Row):
        return Row(tuple(map(_on_one_line, math.items)))
    if isinstance(math, Fraction) and isinstance(math.numerator, Glyph) and isinstance(math.denominator, Glyph):
        return Row((math.numerator, Glyph("/", "punctuation"), math.denominator))
    return math


def _fence(sign: str) -> str:
    return _FENCES[sign] if sign in _FENCES else _character(sign[:1])


# Rows


def _row(items: tuple[Math, ...]) -> str:
    result: list[str] = []
    for position, item in enumerate(items):
        if not position and len(items) > 1 and item == _MINUS:  # −5, with no more space than +5 would have
            result.append('class("unary", minus)')
            continue
        if result and _is_prime(item):
            result[-1] = f"attach({result[-1]}, t: {typst(item)})"
            continue
        # A word keeps the space beside it in Typst, which a bracket after it must not have.
        close = position > 0 and _is_word(items[position - 1]) and isinstance(item, Fence)
        result.append(typst(item) if close or not result else f" {typst(item)}")
    return "".join(result) or '""'


def _is_word(item: Math) -> bool:
    return isinstance(item, Glyph) and item.style == "word"


def _is_prime(item: Math) -> bool:
    return isinstance(item, Glyph) and set(item.text) <= set("′'") and bool(item.text)


# Where a long row may be broken


@dataclass(frozen=True, slots=True)
class _Tree:
    """Mathematics, and the parts that it falls into where it does not fit on a line."""

    whole: str
    parts: tuple["_Tree", ...] = ()


def _node(tree: _Tree) -> str:
    return f"node(${tree.whole}${''.join(f', {_node(part)}' for part in tree.parts)})"


def _tree(math: Math) -> _Tree:
    items = math.items if isinstance(math, Row) else (math,)
    for begins in (_begins_term, _begins_factor):
        groups = _grouped(items, begins)
        if len(groups) > 1:
            return _Tree(_row(items), tuple(_tree(Row(group)) for group in groups))
    return _fence_opened(items)


def _fence_opened(items: tuple[Math, ...]) -> _Tree:
    whole = _row(items)
    if not items or not isinstance(fence := items[-1], Fence):
        return _Tree(whole)
    inside = _tree(fence.body)
    if not inside.parts:
        return _Tree(whole)
    head = f"{_row(items[:-1])} " if len(items) > 1 else ""
    first = _begun(inside.parts[0], head, _fence(fence.left))
    return _Tree(whole, (first, *inside.parts[1:-1], _ended(inside.parts[-1], _fence(fence.right))))


def _begun(tree: _Tree, head: str, bracket: str) -> _Tree:
    parts = (_begun(tree.parts[0], head, bracket), *tree.parts[1:]) if tree.parts else ()
    return _Tree(f"{head}lr({bracket} {tree.whole})", parts)


def _ended(tree: _Tree, bracket: str) -> _Tree:
    parts = (*tree.parts[:-1], _ended(tree.parts[-1], bracket)) if tree.parts else ()
    return _Tree(f"lr({tree.whole} {bracket})", parts)


def _grouped(items: tuple[Math, ...], begins: Callable[[Math, Math], bool]) -> list[tuple[Math, ...]]:
    starts = [at for at in range(len(items)) if at == 0 or begins(items[at - 1], items[at])]
    return [items[start:end] for start, end in zip(starts, [*starts[1:], len(items)], strict=True)]


def _begins_term(before: Math, item: Math) -> bool:
    if isinstance(before, Glyph) and before.style == "punctuation" and before.text in (",", ";"):
        return True
    if isinstance(before, Big) or (isinstance(before, Glyph) and before.style in _CLASSES):
        return False
    return isinstance(item, Glyph) and (
        item.style == "relation" or (item.style == "operator" and item.text in ("+", "−", "±"))
    )


def _begins_factor(before: Math, item: Math) -> bool:
    if isinstance(item, Glyph):
        return item.style == "operator" and item.text in ("·", "×") and not isinstance(before, Big)
    return _is_tall(before) and _is_tall(item)


def _is_tall(item: Math) -> bool:
    return isinstance(item.body if isinstance(item, Script) else item, Fence | Tabular | Fraction)
