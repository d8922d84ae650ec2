"""Blocks as HTML, every text escaped: mathematics as MathML, or as LaTeX for programs that typeset it themselves."""

from collections.abc import Iterable
from html import escape

from rldrill.problems.document import Beside, Block, Equation, Heading, Paragraph, Table, pieces
from rldrill.problems.mathematics import Math
from rldrill.problems.pictures import Picture, Timeline
from rldrill.render.markdown import latex_block_equation
from rldrill.render.mathematics.latex import latex
from rldrill.render.mathematics.mathml import chain, mathml
from rldrill.render.mathematics.spacing import parted
from rldrill.render.mathematics.unicode import inline, unicode
from rldrill.render.pictures.described import described
from rldrill.render.pictures.svg import svg

#: Mathematics of at most so many signs is narrower than any screen.
_LONG = 32


class Html:
    """Writes blocks as HTML with MathML, which needs nothing else."""

    def blocks(self, blocks: Iterable[Block]) -> str:
        """Blocks one under the other."""
        return "".join(map(self.block, blocks))

    def text(self, text: str) -> str:
        """Running text with its mathematics."""
        return "".join(self.words(piece) if isinstance(piece, str) else self.math(piece) for piece in pieces(text))

    def words(self, text: str) -> str:
        """Text without mathematics; no line ends behind the hyphen of Q-learning."""
        return "".join(
            f'<span class="unparted">{escape(piece)}</span>' if whole else escape(piece)
            for piece, whole in parted(text)
        )

    def math(self, math: Math) -> str:
        """Mathematics within a line; what is long is moved sideways where the screen is narrower."""
        written = mathml(math)
        return f'<span class="long" tabindex="0">{written}</span>' if len(unicode(math)) > _LONG else written

    def block(self, block: Block) -> str:
        """One block."""
        match block:
            case Paragraph(text):
                return f"<p>{self.text(text)}</p>"
            case Heading(text):
                return f'<p class="heading"><strong>{self.text(text)}</strong></p>'
            case Table():
                return self.table(block)
            case Equation():
                return self.equation(block)
            case Beside(blocks):
                return f'<div class="beside">{"".join(f"<div>{self.block(each)}</div>" for each in blocks)}</div>'
            case Timeline():
                return self.timeline(block)
            case Picture():
                return self.picture(block)
            case _:
                raise TypeError(f"{type(block).__name__} has no HTML")

    def table(self, table: Table) -> str:
        """A table, moved sideways where the screen is narrower."""
        head = "".join(f'<th scope="col">{self._named(cell)}</th>' if cell else "<td></td>" for cell in table.header)
        lines = ("".join(f"<td>{self.text(cell)}</td>" for cell in line) for line in table.rows)
        body = "".join(f"<tr>{line}</tr>" for line in lines)
        return _wide(f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>", "Table")

    def _named(self, cell: str) -> str:
        """A heading of a table; to some readers of screens one of mathematics alone would be empty."""
        written = self.text(cell)
        if not written.startswith("<math>"):
            return written
        return written.replace("<math>", f'<math aria-label="{escape(inline(cell))}">', 1)

    def equation(self, equation: Equation) -> str:
        """An equation, its right sides one under the other."""
        if equation.is_bare:  # mathematics that stands side by side where there is room
            sides = "".join(f'<span class="wide">{self.math(right)}</span>' for right in equation.rights)
            return f'<div class="flow">{sides}</div>'
        return _wide(f'<math display="block">{chain(equation)}</math>', "Formula")

    def picture(self, picture: Picture) -> str:
        """A picture; nothing where it cannot be drawn readably."""
        drawing = svg(picture)
        return f'<figure class="wide" tabindex="0">{drawing}</figure>' if drawing else ""

    def timeline(self, line: Timeline) -> str:
        """A run as a row of texts, broken where the screen ends."""
        steps = []
        for moment in line.moments():
            ends = ' class="end"' if line.ended and moment.last else ""
            steps.append(f"<li><small>{self.text(moment.label)}</small><b{ends}>{self.text(moment.state)}</b></li>")
            if moment.goes_on:
                action, reward = self.text(moment.action or ""), self.text(moment.reward or "")
                steps.append(f'<li class="arrow"><small>{action}</small><i>⟶</i><small>{reward}</small></li>')
        return f'<ol class="timeline" aria-label="{escape(described(line))}">{"".join(steps)}</ol>'


class LatexHtml(Html):
    """Writes blocks as HTML with LaTeX between ``\\(`` and ``\\)``, as MathJax reads it, and without styles."""

    def math(self, math: Math) -> str:
        """Mathematics within a line."""
        return escape(rf"\({latex(math)}\)")

    def words(self, text: str) -> str:
        """Text without mathematics, and nothing else."""
        return escape(text)

    def table(self, table: Table) -> str:
        """A table with lines, which few programs draw by themselves."""
        lines = [f"<tr>{''.join(f'<th>{self.text(cell)}</th>' for cell in table.header)}</tr>"]
        lines += [f"<tr>{''.join(f'<td>{self.text(cell)}</td>' for cell in line)}</tr>" for line in table.rows]
        return f'<table border="1" cellpadding="4">{"".join(lines)}</table>'

    def equation(self, equation: Equation) -> str:
        """An equation on lines of its own."""
        if equation.is_bare:
            sides = (escape(rf"\(\displaystyle {latex(right)}\)") for right in equation.rights)
            return f"<p>{' &emsp; '.join(sides)}</p>"
        written = rf"\[{latex_block_equation(equation)}\]"
        return f"<p>{escape(written)}</p>"

    def timeline(self, line: Timeline) -> str:
        """A run on one line."""
        steps = []
        for moment in line.moments():
            steps.append(" ".join(filter(None, (self.text(moment.label), f"<b>{self.text(moment.state)}</b>"))))
            if moment.goes_on:
                above = filter(None, (moment.action, moment.reward))
                steps.append(f"—{', '.join(map(self.text, above))}→")
        return f"<p>{' '.join(steps)}</p>"


def _wide(body: str, what: str) -> str:
    """Something that is moved sideways where the screen is narrower; with the keyboard, too."""
    return f'<div class="wide" role="group" aria-label="{what}" tabindex="0">{body}</div>'
