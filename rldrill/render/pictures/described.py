"""Pictures in words: what is read aloud to somebody who does not see them."""

from rldrill.problems.document import Paragraph
from rldrill.problems.pictures import (
    Arm,
    BackupDiagram,
    Bars,
    Bumps,
    GridPicture,
    Node,
    Pendulum,
    Picture,
    StateDiagram,
    Timeline,
)
from rldrill.render.unicode import unicode_text


def described(picture: Picture) -> str:
    """A picture in a sentence or two, with everything that is written in it."""
    match picture:
        case StateDiagram(states, terminal, arrows):
            ends = f"; terminal: {', '.join(terminal)}" if terminal else ""
            ways = "; ".join(
                f"from {arrow.state} by {arrow.action} to {arrow.next} with probability {arrow.probability}, "
                f"reward {arrow.reward}"
                for arrow in arrows
            )
            said = f"State diagram of {', '.join(states)}{ends}. Arrows: {ways}."
        case Timeline():
            said = f"Timeline of a run: {_run(picture)}."
        case GridPicture(rows):
            said = f"Grid: {'; '.join(' | '.join(cell or 'empty' for cell in row) for row in rows)}."
        case BackupDiagram(root, title):
            said = f"Backup diagram{f' of {title}' if title else ''}: {_node(root)}."
        case Bars(names, series, _, labels):
            bars = "; ".join(
                f"{name or 'shares'}: {', '.join(f'{which} {label}' for which, label in zip(names, row, strict=True))}"
                for name, row in zip(series, labels, strict=True)
            )
            said = f"Bars: {bars}."
        case Bumps(centres, width, shape, state):
            middles = ", ".join(f"{centre:g}" for centre in centres)
            said = f"Radial basis functions ({shape}) around {middles}, of width {width:g}; the state is {state:g}."
        case Arm(lengths, angles, turned):
            links = ", ".join(
                f"a link of {length:g} at {angle:g}°" for length, angle in zip(lengths, angles, strict=True)
            )
            said = f"Planar arm{f' on a base that is turned by {turned:g}°' if turned else ''}: {links}."
        case Pendulum(angle, cart):
            said = f"Pendulum{' on a cart' if cart else ''} at {angle:g}° from hanging down."
        case _:
            raise TypeError(f"{type(picture).__name__} has no description")
    return unicode_text(Paragraph(said))


def _run(line: Timeline) -> str:
    said: list[str] = []
    for moment in line.moments():
        said.append(" ".join(filter(None, (moment.label, moment.state))))
        said += [] if moment.action is None else [f"action {moment.action}"]
        said += [] if moment.reward is None else [f"reward {moment.reward}"]
    return ", ".join(said)


def _node(node: Node) -> str:
    name = " ".join(filter(None, (node.kind, node.label)))
    below = ", ".join(" ".join(filter(None, (branch.label, _node(branch.node)))) for branch in node.branches)
    return f"{name} ({'the best of ' if node.maximum else ''}{below})" if below else name
