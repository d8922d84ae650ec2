"""Blocks as plain text, their mathematics in Unicode."""

from rldrill.problems.document import Beside, Block, Equation, Heading, Paragraph, Table
from rldrill.problems.pictures import Picture
from rldrill.render.mathematics.unicode import inline, unicode


def unicode_text(block: Block) -> str:
    """A block as plain text, mathematics in Unicode; a table has a line for every row, cells parted by bars."""
    match block:
        case Paragraph(text) | Heading(text):
            return inline(text)
        case Table(header, rows):
            return "\n".join(" | ".join(map(inline, line)) for line in (header, *rows))
        case Equation(left, rights, signs):
            return unicode(left) + "".join(
                f" {sign} {unicode(right)}" for sign, right in zip(signs, rights, strict=True)
            )
        case Beside(blocks):
            return "\n".join(map(unicode_text, blocks))
        case Picture():
            from rldrill.render.pictures.text import lines

            return "\n".join(lines(block))
        case _:
            raise TypeError(f"{type(block).__name__} has no text")
