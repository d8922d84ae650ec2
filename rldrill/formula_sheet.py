"""The formula sheet as pages, as Markdown and for the terminal, all from the same formulas."""

from collections.abc import Sequence
from itertools import zip_longest
from typing import TYPE_CHECKING

from rldrill.paper import Paper, page_setup
from rldrill.problems.document import Equation, pieces
from rldrill.problems.errors import UsageError
from rldrill.render.latex import latex
from rldrill.render.typst import block, text
from rldrill.render.unicode import inline, unicode_text
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.sheet import SECTIONS, Gallery, gallery, section

if TYPE_CHECKING:
    from rich.text import Text

TITLE = "Reinforcement Learning: formula sheet"

_HELPERS = r"""
#let section(title) = block(width: 100%, sticky: true, above: 1.5em, below: 0.8em, stroke: (bottom: 0.7pt),
  inset: (bottom: 0.35em), text(1.25em, strong(title)))
#let remark(note) = text(0.8em, luma(60), style: "italic", note)
#let formula(title, source, equation, note) = block(width: 100%, breakable: false, spacing: 1.1em, {
  block(sticky: true, below: 0.55em, {
    text(0.85em, strong(title)); h(1fr); h(0.6em); box(text(0.68em, luma(110), source))
  })
  pad(left: 0.6em, equation)
  if note != [] { block(above: 0.55em, remark(note)) }
})
#let gallery(note, ..pictures) = block(width: 100%, breakable: false, {
  pictures.pos().map(box).join(h(1.6em, weak: true))
  block(above: 0.8em, remark(note))
})
"""


def sections(names: Sequence[str]) -> dict[str, tuple[str, tuple[Formula, ...]]]:
    """The sections of these names, or all: for each its title and its formulas.

    Raises:
        UsageError: there is no section of that name.
    """
    wanted = {_section_name(name) for name in names} or set(SECTIONS)
    return {name: (title, section(name)) for name, title in SECTIONS.items() if name in wanted}


def _section_name(name: str) -> str:
    wanted = name.strip().lower().replace("-", "_")
    if wanted not in SECTIONS:
        known = ", ".join(known.replace("_", "-") for known in SECTIONS)
        raise UsageError(f"There is no section {name[:40]!r}; the sections are {known}.")
    return wanted


def sheet_source(names: Sequence[str], paper: Paper) -> str:
    """The formula sheet as Typst source: two columns.

    Raises:
        UsageError: there is no section of that name.
    """
    setup = page_setup(paper, title=TITLE, left="", right="", margin="1.6cm", size="9.5pt", columns=2)
    head = f'#place(top, scope: "parent", float: true, text(1.7em, strong[{text(TITLE)}]))\n'
    found = sections(names).items()
    return setup + _HELPERS + head + "".join(_section(name, title, formulas) for name, (title, formulas) in found)


def _section(name: str, title: str, found: tuple[Formula, ...]) -> str:
    return f"#section[{text(title)}]\n" + "".join(map(_formula, found)) + _gallery(gallery(name))


def _gallery(found: Gallery) -> str:
    if not found.pictures:
        return ""
    pictures = ", ".join(f"[{block(picture)}]" for picture in found.pictures)
    return f"#gallery([{text(found.note)}], {pictures})\n"


def _formula(formula: Formula) -> str:
    return (
        f"#formula([{text(formula.title)}], [{text(formula.source)}], "
        f"[{block(formula.equation())}], [{text(formula.note)}])\n"
    )


def markdown(names: Sequence[str]) -> str:
    """The formula sheet as Markdown, its mathematics in LaTeX.

    Raises:
        UsageError: there is no section of that name.
    """
    lines = [f"# {TITLE}", ""]
    for name, (title, found) in sections(names).items():
        lines += [f"## {title}", ""]
        for formula in found:
            lines += [
                f"**{formula.title}** ({formula.source})",
                "",
                f"$${latex_equation(formula.equation())}$$",
                "",
            ]
            if formula.note:
                lines += [_latex_text(formula.note), ""]
        for picture in gallery(name).pictures:
            lines += ["```text", unicode_text(picture), "```", ""]
        if gallery(name).note:
            lines += [_latex_text(gallery(name).note), ""]
    return "\n".join(lines).rstrip("\n") + "\n"


def latex_equation(equation: Equation) -> str:
    """An equation as LaTeX on one line."""
    signs = {"←": r"\leftarrow", "≈": r"\approx"}
    links = zip(equation.signs, equation.rights, strict=True)
    return " ".join([latex(equation.left), *(f"{signs.get(sign, sign)} {latex(right)}" for sign, right in links)])


def _latex_text(words: str) -> str:
    return "".join(piece if isinstance(piece, str) else f"${latex(piece)}$" for piece in pieces(words))


def terminal(names: Sequence[str], *, as_latex: bool = False) -> "list[Text]":
    """The formula sheet as lines for a terminal, mathematics in Unicode or in LaTeX.

    Raises:
        UsageError: there is no section of that name.
    """
    from rich.text import Text

    lines: list[Text] = []
    for name, (title, found) in sections(names).items():
        lines += [*([Text()] if lines else []), Text(title, style="bold")]
        for formula in found:
            equation = latex_equation(formula.equation()) if as_latex else unicode_text(formula.equation())
            head = Text.assemble("\n  ", (formula.title, "cyan"), "  ", (formula.source, "dim"))
            lines += [head, Text(f"    {equation}")]
            if formula.note:
                lines.append(
                    Text(
                        f"    {_latex_text(formula.note) if as_latex else inline(formula.note)}",
                        style="italic",
                    )
                )
        lines += _drawn(gallery(name))
    return lines


def _drawn(found: Gallery) -> "list[Text]":
    """Pictures side by side as lines for a terminal."""
    from rich.text import Text

    blocks = [unicode_text(picture).splitlines() for picture in found.pictures]
    widths = [max(map(len, block)) for block in blocks]
    rows = zip_longest(*blocks, fillvalue="")
    lines = ["   ".join(map(str.ljust, row, widths)).rstrip() for row in rows]
    texts = [Text(f"    {line}", no_wrap=True) for line in lines]
    return [Text(), *texts, Text(), Text(f"    {inline(found.note)}", style="italic")] if texts else []
