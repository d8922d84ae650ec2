"""Blocks as HTML: mathematics as MathML, pictures as SVG. Every text is escaped."""

from collections.abc import Iterable
from html import escape

from rldrill.problems.document import Beside, Block, Equation, Heading, Paragraph, Table, pieces
from rldrill.problems.mathematics import EMPTY
from rldrill.problems.pictures import Picture, Timeline
from rldrill.render.mathematics.mathml import element, mathml, relation
from rldrill.render.mathematics.unicode import inline
from rldrill.render.pictures.described import described
from rldrill.render.pictures.svg import svg


def html(blocks: Iterable[Block]) -> str:
    """Blocks one under the other."""
    return "".join(map(html_block, blocks))


def html_text(text: str) -> str:
    """Running text with its mathematics."""
    return "".join(escape(piece) if isinstance(piece, str) else mathml(piece) for piece in pieces(text))


def html_block(block: Block) -> str:
    """One block."""
    match block:
        case Paragraph(text):
            return f"<p>{html_text(text)}</p>"
        case Heading(text):
            return f'<p class="heading"><strong>{html_text(text)}</strong></p>'
        case Table(header, rows):
            head = "".join(
                f'<th scope="col" aria-label="{escape(inline(cell))}">{html_text(cell)}</th>' for cell in header
            )
            body = "".join(f"<tr>{''.join(f'<td>{html_text(cell)}</td>' for cell in line)}</tr>" for line in rows)
            return _wide(f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>", "Table")
        case Equation():
            return _wide(html_equation(block), "Formula")
        case Beside(blocks):
            return f'<div class="beside">{"".join(f"<div>{html_block(each)}</div>" for each in blocks)}</div>'
        case Timeline():
            return _timeline(block)
        case Picture():
            drawing = svg(block)
            return f'<figure class="wide" tabindex="0">{drawing}</figure>' if drawing else ""
        case _:
            raise TypeError(f"{type(block).__name__} has no HTML")


def html_equation(equation: Equation) -> str:
    """An equation, its right sides one under the other."""
    links = list(zip(equation.signs, equation.rights, strict=True))
    if not any(equation.signs):  # mathematics that stands side by side where there is room
        sides = "".join(f'<span class="wide">{mathml(right)}</span>' for right in equation.rights)
        return f'<div class="flow">{sides}</div>'
    if len(links) == 1:
        ((sign, right),) = links
        return f'<math display="block"><mrow>{_left(equation)}{relation(sign)}{element(right)}</mrow></math>'
    lefts = (_left(equation), *[""] * (len(links) - 1))
    lines = "".join(
        f"<mtr><mtd>{left}</mtd><mtd><mrow>{relation(sign)}{element(right)}</mrow></mtd></mtr>"
        for left, (sign, right) in zip(lefts, links, strict=True)
    )
    return f'<math display="block"><mtable class="chain" displaystyle="true">{lines}</mtable></math>'


def _left(equation: Equation) -> str:
    return "" if equation.left == EMPTY else element(equation.left)


def _wide(body: str, what: str) -> str:
    """Something that is moved sideways where the screen is narrower; with the keyboard, too."""
    return f'<div class="wide" role="group" aria-label="{what}" tabindex="0">{body}</div>'


def _timeline(line: Timeline) -> str:
    last = len(line.states) - 1
    steps = []
    for time, state in enumerate(line.states):
        ends = ' class="end"' if line.ended and time == last else ""
        steps.append(f"<li><small>{html_text(line.times[time])}</small><b{ends}>{html_text(state)}</b></li>")
        if time < last or time < len(line.actions):
            action = html_text(line.actions[time]) if time < len(line.actions) else ""
            reward = html_text(line.rewards[time]) if time < last else ""
            steps.append(f'<li class="arrow"><small>{action}</small><i>⟶</i><small>{reward}</small></li>')
    return f'<ol class="timeline" aria-label="{escape(described(line))}">{"".join(steps)}</ol>'
