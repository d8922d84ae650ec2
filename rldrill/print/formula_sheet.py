"""The formula sheet as pages, as Markdown and for the terminal, all from the same formulas."""

from collections.abc import Sequence
from itertools import zip_longest
from typing import TYPE_CHECKING

from rldrill.exam.choices import Paper
from rldrill.print.paper import page_setup
from rldrill.problems.document import Equation
from rldrill.problems.errors import UsageError
from rldrill.render.encodable import UNICODE, Spelling
from rldrill.render.markdown import latex_equation, markdown_block, markdown_text
from rldrill.render.mathematics.typst import text
from rldrill.render.typst import block, line
from rldrill.render.typst_files import typst_file
from rldrill.render.unicode import unicode_text
from rldrill.solutions.formula.formula import Formula, Place
from rldrill.solutions.sheet import SECTIONS, Gallery, gallery, section

if TYPE_CHECKING:
    from rich.text import Text

TITLE = "Reinforcement and Robot Learning: formula sheet"
#: The size of the type with which the whole sheet is two pages.
_SIZES = {"a4": "7.5pt", "letter": "7.1pt"}
#: No formula is taken to fit a column of the sheet without measuring.
_COLUMN = 0.0
_LEGEND = "Formulas marked + go beyond the lecture's sheet."


def sections(names: Sequence[str] = (), *, workings: bool = False) -> dict[str, tuple[str, tuple[Formula, ...]]]:
    """The sections of these names, or all: for each its title and its formulas.

    Args:
        names: names of sections; all, if none.
        workings: also the formulas that only a working needs.

    Raises:
        UsageError: there is no section of that name.
    """
    wanted = {_section_name(name) for name in names} or set(SECTIONS)
    return {name: (title, _printed(name, workings)) for name, title in SECTIONS.items() if name in wanted}


def _printed(name: str, workings: bool) -> tuple[Formula, ...]:
    return tuple(formula for formula in section(name) if workings or formula.place is not Place.WORKING)


def _section_name(name: str) -> str:
    wanted = name.strip().lower().replace("-", "_")
    if wanted not in SECTIONS:
        known = ", ".join(known.replace("_", "-") for known in SECTIONS)
        raise UsageError(f"There is no section {name[:40]!r}; the sections are {known}.")
    return wanted


def _title(formula: Formula) -> str:
    return f"{formula.title} +" if formula.place is Place.BEYOND else formula.title


def sheet_source(names: Sequence[str], paper: Paper, *, workings: bool = False) -> str:
    """The formula sheet as Typst source; with the formulas of the workings it also names every source.

    Raises:
        UsageError: there is no section of that name.
    """
    # A few sections are a handout, in the size of a book.
    size, columns, title_size = ("10pt", 1, "1.5em") if names else (_SIZES[paper], 2, "1.9em")
    margin = "(x: 1cm, top: 0.9cm, bottom: 1cm)"
    setup = page_setup(paper, title=TITLE, margin=margin, size=size, columns=columns)
    head = f"text({title_size}, strong[{text(TITLE)}]); h(1fr); remark[{text(_LEGEND)}]"
    found = sections(names, workings=workings).items()
    helpers = typst_file("rldrill.print", "formula_sheet.typ")
    return (
        f"{setup}#set columns(gutter: 0.6cm)\n{helpers}"
        f'#place(top, scope: "parent", float: true, clearance: 0.9em, {{{head}}})\n'
        + "".join(_section(name, title, formulas, workings=workings) for name, (title, formulas) in found)
    )


def _section(name: str, title: str, found: tuple[Formula, ...], *, workings: bool) -> str:
    rows = "".join(f", {_formula(formula, workings=workings)}" for formula in found)
    return f"#section([{text(title)}]{rows})\n{_gallery(gallery(name))}"


def _gallery(found: Gallery) -> str:
    if not found.pictures:
        return ""
    pictures = ", ".join(f"[{block(picture)}]" for picture in found.pictures)
    return f"#gallery([{text(found.note)}], {pictures})\n"


def _formula(formula: Formula, *, workings: bool) -> str:
    beyond = "true" if formula.place is Place.BEYOND else "false"
    source = text(formula.source) if workings else ""
    equation = _equation(formula, workings=workings)
    parts = f"[{source}], ${line(equation)}$, [{block(equation, _COLUMN)}], [{text(formula.note)}]"
    return f"formula([{text(formula.title)}], {beyond}, {parts})"


def _equation(formula: Formula, *, workings: bool) -> Equation:
    return formula.equation() if workings else formula.printed()


def markdown(names: Sequence[str], *, workings: bool = False) -> str:
    """The formula sheet as Markdown, its mathematics in LaTeX.

    Raises:
        UsageError: there is no section of that name.
    """
    lines = [f"# {TITLE}", "", _LEGEND, ""]
    for name, (title, found) in sections(names, workings=workings).items():
        lines += [f"## {title}", ""]
        for formula in found:
            head = f"**{_title(formula)}** ({formula.source})"
            lines += [head, "", f"$${latex_equation(_equation(formula, workings=workings))}$$", ""]
            if formula.note:
                lines += [markdown_text(formula.note), ""]
        for picture in gallery(name).pictures:
            lines += [markdown_block(picture), ""]
        if gallery(name).note:
            lines += [markdown_text(gallery(name).note), ""]
    return "\n".join(lines).rstrip("\n") + "\n"


def terminal(
    names: Sequence[str], *, workings: bool = False, as_latex: bool = False, spelling: Spelling = UNICODE
) -> "list[Text]":
    """The formula sheet as lines for a terminal, mathematics in Unicode or in LaTeX.

    Raises:
        UsageError: there is no section of that name.
    """
    from rich.text import Text

    lines: list[Text] = []
    for name, (title, found) in sections(names, workings=workings).items():
        lines += [*([Text()] if lines else []), Text(title, style="bold")]
        for formula in found:
            printed = _equation(formula, workings=workings)
            equation = latex_equation(printed) if as_latex else spelling.plain(unicode_text(printed))
            head = Text.assemble(
                "\n  ", (spelling.plain(_title(formula)), "cyan"), "  ", (spelling.plain(formula.source), "dim")
            )
            lines += [head, Text(f"    {equation}")]
            if formula.note:
                note = markdown_text(formula.note) if as_latex else spelling.inline(formula.note)
                lines.append(Text(f"    {note}", style="italic"))
        lines += _drawn(gallery(name), spelling)
    return lines


def _drawn(found: Gallery, spelling: Spelling) -> "list[Text]":
    """Pictures side by side as lines for a terminal."""
    from rich.text import Text

    blocks = [spelling.lines(picture) for picture in found.pictures]
    widths = [max(map(len, block)) for block in blocks]
    rows = zip_longest(*blocks, fillvalue="")
    lines = ["   ".join(map(str.ljust, row, widths)).rstrip() for row in rows]
    texts = [Text(f"    {line}", no_wrap=True) for line in lines]
    note = [Text(), Text(f"    {spelling.inline(found.note)}", style="italic")] if found.note else []
    return [Text(), *texts, *note] if texts else []
