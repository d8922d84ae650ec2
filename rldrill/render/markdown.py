"""Documents as Markdown, their mathematics in LaTeX: for notebooks and files."""

import re
from collections.abc import Callable, Iterable

from rldrill.problems.document import Beside, Block, Equation, Heading, Paragraph, Table, pieces
from rldrill.problems.mathematics import Glyph, Math
from rldrill.problems.pictures import Picture
from rldrill.render.mathematics.latex import latex
from rldrill.render.unicode import unicode_text

#: What Markdown would take for its own within mathematics, which GitHub reads after it.
_TAKEN = re.compile(r"(?<=[^\w\s])_(?!\s)|\\[{}]|[*|]")
#: The same to LaTeX; an underscore before room begins no emphasis.
_SPARED = {"_": "_ ", r"\{": r"\lbrace ", r"\}": r"\rbrace ", "*": r"\ast ", "|": r"\vert "}
_SPECIAL = re.compile(r"([\\`*_\[\]<$#|])")


def _in_text(picture: Picture) -> str:
    return f"```text\n{unicode_text(picture)}\n```"


def markdown(blocks: Iterable[Block], drawn: Callable[[Picture], str] = _in_text) -> str:
    """Blocks one under the other.

    Args:
        blocks: the blocks.
        drawn: how a picture is written; with signs, if nothing else is said.
    """
    return "\n\n".join(_block(each, drawn) for each in blocks)


def markdown_block(block: Block) -> str:
    """One block."""
    return _block(block, _in_text)


def _block(block: Block, drawn: Callable[[Picture], str]) -> str:
    match block:
        case Paragraph(text):
            return markdown_text(text)
        case Heading(text):
            return f"**{markdown_text(text)}**"
        case Table(header, rows):
            lines = [header, ("---",) * len(header), *rows]
            return "\n".join(f"| {' | '.join(map(markdown_text, line))} |" for line in lines)
        case Equation():
            return f"$${_spared(latex_block_equation(block))}$$"
        case Beside(blocks):
            return markdown(blocks, drawn)
        case Picture():
            return drawn(block)
        case _:
            raise TypeError(f"{type(block).__name__} has no Markdown")


def markdown_text(text: str) -> str:
    """Running text; its signs are not taken for Markdown, and bars do not end the cell of a table."""
    return "".join(markdown_plain(piece) if isinstance(piece, str) else _math(piece) for piece in pieces(text))


def markdown_plain(text: str) -> str:
    """Text that holds no mathematics, whatever signs are in it."""
    return _SPECIAL.sub(r"\\\1", text)


def _math(math: Math) -> str:
    return f"${_spared(latex(math))}$"


def _spared(written: str) -> str:
    """LaTeX in which Markdown finds nothing of its own: neither emphasis, nor escaped signs, nor the end of a cell."""
    return _TAKEN.sub(lambda taken: _SPARED[taken[0]], written)


def latex_block_equation(equation: Equation) -> str:
    """An equation as LaTeX, its right sides one under the other."""
    return _aligned(equation) if len(equation.rights) > 1 else latex_equation(equation)


def latex_equation(equation: Equation) -> str:
    """An equation as LaTeX on one line."""
    links = zip(equation.signs, equation.rights, strict=True)
    return " ".join([latex(equation.left), *(f"{_sign(sign)} {latex(right)}" for sign, right in links)])


def _aligned(equation: Equation) -> str:
    links = zip(equation.signs, equation.rights, strict=True)
    lines = r" \\ ".join(f"&{_sign(sign)} {latex(right)}" for sign, right in links)
    return rf"\begin{{aligned}} {latex(equation.left)} {lines} \end{{aligned}}"


def _sign(sign: str) -> str:
    return latex(Glyph(sign, "relation"))
