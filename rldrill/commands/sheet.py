"""``rldrill sheet``: the formula sheet."""

from pathlib import Path
from typing import Annotated

import typer

from rldrill.commands.arguments import NotationOption, Output
from rldrill.exam.choices import Paper

NAME = "sheet"


def complete_sections(incomplete: str) -> list[str]:
    """Sections of the formula sheet that begin so."""
    folder = Path(__file__).parents[1] / "solutions" / "sheet"
    names = sorted(file.stem.replace("_", "-") for file in folder.glob("*.py") if file.stem != "__init__")
    return [name for name in names if name.startswith(incomplete)]


def command(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="SECTION", autocompletion=complete_sections, help="Sections; all, if none."),
    ] = None,
    output: Output = None,
    paper: Annotated[Paper, typer.Option("--paper", case_sensitive=False, help="The paper of a PDF.")] = "a4",
    latex: Annotated[bool, typer.Option("--latex", help="Print the formulas as LaTeX.")] = False,
    workings: Annotated[
        bool, typer.Option("--all", help="Also the formulas that only workings need; in a PDF, with sources.")
    ] = False,
    notation: NotationOption = None,  # noqa: ARG001 - its callback sets it
) -> None:
    """Print the formula sheet, or write it as PDF or Markdown.

    Examples:

        rldrill sheet

        rldrill sheet bellman temporal-difference

        rldrill sheet -o sheet.pdf --paper letter

        rldrill sheet -o sheet.md --all
    """
    if output is None:
        _print(names or [], as_latex=latex, workings=workings)
        return
    from rldrill.print.formula_sheet import markdown, sheet_source
    from rldrill.print.paper import pdf
    from rldrill.problems.errors import UsageError
    from rldrill.writing import write_bytes_atomically

    if output.is_dir():
        raise UsageError(f"{output} is a folder; give the name of a file, such as {output / 'sheet.pdf'}.")
    if latex:
        raise UsageError(
            "--latex prints to the terminal; leave it out with --output, or write a file that ends in .md."
        )
    suffix = output.suffix.lower()
    if suffix not in (".pdf", ".md"):
        raise UsageError(f"{output} must end in .pdf or .md: the formula sheet is written as PDF or Markdown.")
    if suffix == ".pdf":
        data = pdf(sheet_source(names or [], paper, workings=workings))
    else:
        data = markdown(names or [], workings=workings).encode()
    write_bytes_atomically(output, data)
    typer.echo(str(output))


def _print(names: list[str], *, as_latex: bool, workings: bool) -> None:
    from rldrill.print.formula_sheet import terminal
    from rldrill.render.encodable import Spelling
    from rldrill.render.terminal import console

    out = console()
    for line in terminal(names, as_latex=as_latex, workings=workings, spelling=Spelling(out.encoding)):
        out.print(line, soft_wrap=True)
