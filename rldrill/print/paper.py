"""Paper: the page of all that is no exam, and how PDFs are compiled."""

import ctypes
import sys
from collections.abc import Mapping
from functools import cache
from importlib.metadata import version
from typing import TYPE_CHECKING

from rldrill.exam.choices import Paper
from rldrill.render.mathematics.typst import quoted, text
from rldrill.render.typst import PREAMBLE
from rldrill.render.typst_files import typst_file

if TYPE_CHECKING:
    import typst

#: Typst keeps what it has laid out for so many documents: empty ones make it forget, which is cheaper than to keep it.
_REMEMBERED = 11

#: Every PDF carries this time, so that the same arguments give the same bytes.
_TIMESTAMP = 0


#: Typst's own names of the papers.
TYPST_PAPERS: Mapping[Paper, str] = {"a4": "a4", "letter": "us-letter"}


def page_setup(paper: Paper, *, title: str, margin: str, size: str, columns: int) -> str:
    """What stands at the head of a Typst source that is no exam.

    Args:
        paper: the paper.
        title: the title in the PDF's properties.
        margin: the margin on all sides, or Typst's dictionary of margins.
        size: the size of the type.
        columns: how many columns a page has.
    """
    arguments = (
        f"paper: {quoted(TYPST_PAPERS[paper])}, margin: {margin}, size: {size}, columns: {columns}, "
        f"title: [{text(title)}]"
    )
    return f"{typst_file('rldrill.print', 'page.typ')}#show: page-setup.with({arguments})\n{PREAMBLE}"


def pdf(source: str, *, accessible: bool = False, system_fonts: bool = False) -> bytes:
    """Typeset a Typst source; the same source gives the same bytes in every process.

    Args:
        source: the source.
        accessible: as PDF/UA-1, with tags, a language and words for all that is drawn.
        system_fonts: with the fonts of this computer too, where those that come along lack a letter.

    Raises:
        RuntimeError: Typst cannot compile the source.
    """
    compiler = _compiler(system_fonts)
    result = compiler.compile(input=source.encode(), timestamp=_TIMESTAMP, pdf_standards="ua-1" if accessible else None)
    for _ in range(_REMEMBERED):
        compiler.compile(input=b"", format="svg")
    _give_back()
    assert isinstance(result, bytes)
    return result


def _give_back() -> None:
    """Give the memory that a layout took back to the system, which glibc keeps for the next one."""
    if trim := getattr(ctypes.CDLL(None), "malloc_trim", None) if sys.platform == "linux" else None:
        trim(0)


@cache
def _compiler(system_fonts: bool) -> "typst.Compiler":
    """One compiler, which keeps its fonts and what several documents have in common."""
    import typst

    return typst.Compiler(ignore_system_fonts=not system_fonts)


def typst_version() -> str:
    """The version of Typst, which decides the bytes of a PDF."""
    return version("typst")


def png_of_svg(svg: bytes) -> bytes:
    """A picture as pixels.

    Args:
        svg: the picture; its type is set in Typst's fonts.
    """
    import typst

    source = f'#set page(width: auto, height: auto, margin: 0pt)\n#image(bytes({quoted(svg.decode())}), format: "svg")'
    result: bytes = typst.compile(source.encode(), format="png", ppi=144, ignore_system_fonts=True)
    return result
