"""Blocks as LaTeX, for any engine: amsmath, amssymb and TikZ must be loaded."""

from collections.abc import Iterable

from rldrill.problems.document import Beside, Block, Equation, Heading, Paragraph, Table
from rldrill.problems.pictures import Picture, Timeline
from rldrill.render.markdown import latex_block_equation
from rldrill.render.mathematics.latex import latex_text, latex_typed, typed
from rldrill.render.pictures.tikz import tikz


def latex_document(blocks: Iterable[Block]) -> str:
    """Blocks one under the other."""
    return "\n".join(map(latex_block, blocks)) + "\n"


def latex_block(block: Block) -> str:
    """One block."""
    match block:
        case Paragraph(text):
            return f"\n{latex_text(text)}\n"
        case Heading(text):
            return f"\n\\textbf{{{latex_text(text)}}}\\nopagebreak\n"
        case Table(header, rows):
            lines = [" & ".join(map(latex_text, line)) + r" \\ \hline" for line in (header, *rows)]
            body = "\n".join(lines)
            table = f"\\begin{{tabular}}{{|{'c|' * len(header)}}}\\hline\n{body}\n\\end{{tabular}}"
            return f"\n\\fitted{{{table}}}\n"
        case Equation(rights=rights):
            if block.is_bare:
                sides = " \\quad ".join(f"$\\displaystyle {latex_typed(right)}$" for right in rights)
                return f"\n{{\\raggedright {sides}\\par}}\n"
            return f"\n\\fitted{{$\\displaystyle {typed(latex_block_equation(block))}$}}\n"
        case Beside(blocks):
            return "\n".join(map(latex_block, blocks))
        case Timeline():
            return _timeline(block)
        case Picture():
            drawing = tikz(block)
            return f"\n\\fitted{{{drawing}}}\n" if drawing else ""
        case _:
            raise TypeError(f"{type(block).__name__} has no LaTeX")


def _timeline(line: Timeline) -> str:
    steps: list[str] = []
    for moment in line.moments():
        frame = rf"\fbox{{{latex_text(moment.state)}}}"
        when = latex_text(moment.label)
        steps.append(rf"$\overset{{\text{{{when}}}}}{{\text{{{frame}}}}}$" if when else frame)
        if moment.goes_on:
            action, reward = latex_text(moment.action or ""), latex_text(moment.reward or "")
            steps.append(rf"$\xrightarrow[\text{{{reward}}}]{{\text{{{action}}}}}$")
    return "\n{\\raggedright " + " ".join(steps) + "\\par}\n"
