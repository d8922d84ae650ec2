"""Blocks as Typst. They call functions of ``PREAMBLE``, which must stand before them."""

from rldrill.problems.document import Beside, Block, Document, Equation, Heading, Paragraph, Table
from rldrill.problems.mathematics import EMPTY, Math
from rldrill.problems.pictures import Picture
from rldrill.render.mathematics.typst import SHORT, quoted, relation, text, typst
from rldrill.render.mathematics.typst_breaks import breakable
from rldrill.render.mathematics.unicode import unicode
from rldrill.render.pictures.typst import picture
from rldrill.render.typst_files import typst_file
from rldrill.render.unicode import unicode_text

PREAMBLE = typst_file("rldrill.render", "blocks.typ") + typst_file("rldrill.render.pictures", "pictures.typ")


def block(item: Block) -> str:
    """A block as Typst markup."""
    match item:
        case Paragraph(words):
            return f"#par[{text(words)}]\n"
        case Heading(words):
            return f"#block(sticky: true, strong[{text(words)}])\n"
        case Table(header, rows):
            cells = "".join(f", [{text(cell)}]" for line in rows for cell in line)
            first = ", ".join(f"[{text(cell)}]" for cell in header)
            signs = sum(max(map(len, map(_unicode, column))) for column in zip(header, *rows, strict=True))
            return f"#grid-table({len(header)}, {signs}, table.header({first}){cells})\n"
        case Equation(left, rights, signs):
            if left == EMPTY and not any(signs):
                return _apart(rights)
            links = "".join(
                f", (${relation(sign)}$, {breakable(right)})" for sign, right in zip(signs, rights, strict=True)
            )
            said = unicode_text(item)
            return f"#chain({quoted(said)}, {len(said)}, ${'' if left == EMPTY else typst(left)}${links})\n"
        case Beside(blocks):
            return _side_by_side(blocks)
        case Picture():
            return picture(item)
        case _:
            raise TypeError(f"{type(item).__name__} has no Typst")


def _unicode(words: str) -> str:
    return unicode_text(Paragraph(words))


def _side_by_side(blocks: Document) -> str:
    bodies = [body for body in map(block, blocks) if body]  # a picture that is too large is left out
    return f"#beside({', '.join(f'[{body}]' for body in bodies)})\n"


def _apart(items: tuple[Math, ...]) -> str:
    """Mathematics that stands side by side where there is room."""
    if all(len(unicode(item)) <= 2 * SHORT for item in items):
        return f"#flow({', '.join(f'({quoted(unicode(item))}, ${typst(item)}$)' for item in items)})\n"
    return "".join(
        f"#chain({quoted(unicode(item))}, {len(unicode(item))}, $$, ($$, {breakable(item)}))\n" for item in items
    )


def document(blocks: Document) -> str:
    """Blocks one under the other; short equations that follow each other share a line."""
    result: list[str] = []
    waiting: list[str] = []
    for item in (*blocks, None):
        if isinstance(item, Equation) and _is_short(item):
            waiting.append(f"({quoted(unicode_text(item))}, ${line(item)}$)")
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
    return len(unicode(equation.left)) + len(unicode(equation.rights[0])) <= SHORT


def line(equation: Equation) -> str:
    """An equation as the inside of a Typst equation, on one line however long it is."""
    links = zip(equation.signs, equation.rights, strict=True)
    return " ".join([typst(equation.left), *(f"{relation(sign)} {typst(right)}" for sign, right in links)])
