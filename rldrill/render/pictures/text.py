"""Pictures as lines of signs, for the terminal and for plain text."""

from rldrill.problems.pictures import (
    Arm,
    Arrow,
    BackupDiagram,
    Bars,
    Bumps,
    GridPicture,
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
            return raster(mechanics.arm(picture))
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
    """Three lines, or folded as many times: time, states with arrows, and between them actions and rewards."""
    steps = [_step(line, time) for time in range(len(line.states))]
    result: list[str] = []
    while steps:
        fitting = 1
        while fitting < len(steps) and sum(len(step[0]) for step in steps[: fitting + 1]) <= width:
            fitting += 1
        row, steps = steps[:fitting], steps[fitting:]
        folded = ["".join(parts).rstrip() for parts in zip(*row, strict=True)]
        result += [*([""] if result else []), *(text for text in folded if text)]
    return result


def _step(line: Timeline, time: int) -> tuple[str, str, str, str]:
    """A state and the arrow that leaves it: the lines for time, action, state and reward."""
    last = time == len(line.states) - 1
    time_label = inline(line.times[time])
    state = f"{'□' if line.ended and last else '○'} {inline(line.states[time])}"
    action = inline(line.actions[time]) if time < len(line.actions) else ""
    reward = "" if last else inline(line.rewards[time])
    if last and not action:
        return (time_label.ljust(len(state)), " " * len(state), state, " " * len(state))
    wide = max(len(action), len(reward), 3) + 3
    arrow = f" {'─' * (wide - 2)}▶ "
    before = " " * (len(state) + 1)
    return (
        time_label.ljust(len(state) + wide + 1),
        f"{before}{action.center(wide - 2)}  ",
        f"{state}{arrow}",
        f"{before}{reward.center(wide - 2)}  ",
    )


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
