"""Pictures as lines of signs, for the terminal and for plain text."""

from rldrill.problems.pictures import (
    Arm,
    Arrow,
    BackupDiagram,
    Bars,
    Bumps,
    GridPicture,
    Moment,
    Pendulum,
    Picture,
    StateDiagram,
    Timeline,
)
from rldrill.render.mathematics.unicode import inline
from rldrill.render.pictures import mechanics, plots
from rldrill.render.pictures.raster import raster
from rldrill.render.pictures.tree import tree

_BAR = 20
_MOST_ARROWS = 24
#: The arcs of more joints than these run into one another where two dots are a sign; the table says it all.
_MOST_LINKS = 2
_PARTS = " ▏▎▍▌▋▊▉█"


def lines(picture: Picture, width: int = 100) -> list[str]:
    """A picture as lines of at most that many signs, where it can be folded.

    Raises:
        TypeError: it cannot be drawn with signs.
    """
    match picture:
        case StateDiagram(states, terminal, arrows):
            return _states(states, terminal, arrows)
        case Timeline():
            return _timeline(picture, width)
        case GridPicture(rows):
            return _grid([[inline(cell) for cell in row] for row in rows])
        case BackupDiagram(root, title):
            return [*([inline(title)] if title else []), *tree(root)]
        case Bars():
            return _bars(picture)
        case Bumps():
            return raster(plots.bumps(picture))
        case Arm():
            return raster(mechanics.arm(picture)) if len(picture.lengths) <= _MOST_LINKS else []
        case Pendulum():
            return raster(mechanics.pendulum(picture))
        case _:
            raise TypeError(f"{type(picture).__name__} cannot be drawn with signs")


def _states(states: tuple[str, ...], terminal: tuple[str, ...], arrows: tuple[Arrow, ...]) -> list[str]:
    """A branch for every state, under it its actions, and behind these where they lead."""
    if len(arrows) > _MOST_ARROWS:
        return []
    result = []
    wide = max(len(arrow.action) for arrow in arrows)
    far = max(len(arrow.next) for arrow in arrows)
    for state in states:
        if state in terminal:
            continue
        result.append(f"○ {state}")
        own: dict[str, list[Arrow]] = {}
        for arrow in arrows:
            if arrow.state == state:
                own.setdefault(arrow.action, []).append(arrow)
        for number, (action, outcomes) in enumerate(own.items()):
            last = number == len(own) - 1
            for index, arrow in enumerate(outcomes):
                sign = "□" if arrow.next in terminal else "○"
                to = f"▶ {sign} {arrow.next:{far}}  {inline(arrow.probability)}, {inline(arrow.reward)}"
                if index == 0:
                    head = f"{'└' if last else '├'}─● {action} {'─' * (wide - len(action))}─"
                    result.append(f"{head}{'─' if len(outcomes) == 1 else '┬'}{to}")
                else:
                    head = f"{' ' if last else '│'}{' ' * (wide + 5)}"
                    result.append(f"{head}{'└' if index == len(outcomes) - 1 else '├'}{to}")
    return result


def _timeline(line: Timeline, width: int) -> list[str]:
    """Three lines, or folded as many times: time, states with arrows, and between them actions and rewards.

    Where it is folded, the next lines begin with the state that these end in.
    """
    moments = list(line.moments())
    states = [_state(moment, ends=line.ended and moment.last) for moment in moments]
    arrows = list(map(_arrow, moments))
    last = len(states) - 1
    result: list[str] = []
    start = 0
    while not result or start < last:
        end, row = start, [states[start]]
        while end < last:
            more = [arrows[end], states[end + 1], *([arrows[last]] if end + 1 == last else [])]
            if end > start and max(map(len, _folded([*row, *more]))) > width:
                break
            row, end = [*row, *more], end + 1
        if start == last:
            row.append(arrows[last])
        result += [*([""] if result else []), *(text for text in _folded(row) if text)]
        start = end
    return result


#: What stands in the lines for time, action, state and reward, equally wide.
_Column = tuple[str, str, str, str]


def _folded(row: list[_Column]) -> list[str]:
    """The lines, without the spaces at their ends, which need no room."""
    return ["".join(parts).rstrip() for parts in zip(*row, strict=True)]


def _state(moment: Moment, *, ends: bool) -> _Column:
    state, label = f"{'□' if ends else '○'} {inline(moment.state)}", inline(moment.label)
    wide = max(len(state), len(label))
    return (label.ljust(wide), " " * wide, state.ljust(wide), " " * wide)


def _arrow(moment: Moment) -> _Column:
    """The arrow that leaves a state; nothing leaves the last one, unless an action is taken there."""
    action, reward = inline(moment.action or ""), inline(moment.reward or "")
    if moment.last and not action:
        return ("", "", "", "")
    wide = max(len(action), len(reward), 3) + 1
    return (" " * (wide + 3), f" {action.center(wide)}  ", f" {'─' * wide}▶ ", f" {reward.center(wide)}  ")


def _grid(rows: list[list[str]]) -> list[str]:
    wide = max(3, *(len(cell) + 2 for row in rows for cell in row))
    across = len(rows[0])

    def rule(left: str, middle: str, right: str) -> str:
        return left + middle.join(["─" * wide] * across) + right

    result = [rule("┌", "┬", "┐")]
    for index, row in enumerate(rows):
        cells = ("█" * wide if cell == "#" else cell.center(wide) for cell in row)
        result.append(f"│{'│'.join(cells)}│")
        result.append(rule("└", "┴", "┘") if index == len(rows) - 1 else rule("├", "┼", "┤"))
    return result


def _bars(picture: Bars) -> list[str]:
    """A line for every bar."""
    wide = max(map(len, picture.names))
    deep = max(map(len, picture.series))
    result = []
    for index, name in enumerate(picture.names):
        for row, series in enumerate(picture.series):
            head = (name if row == 0 else "").ljust(wide)
            parts = [head, *([series.ljust(deep)] if deep else []), _bar(picture.shares[row][index])]
            result.append(f"{'  '.join(parts)} {inline(picture.labels[row][index])}")
    return result


def _bar(share: float) -> str:
    eighths = round(share * _BAR * 8)
    return ("█" * (eighths // 8) + _PARTS[eighths % 8]).strip() or "▏"
