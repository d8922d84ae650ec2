"""Which module lays out which picture."""

from rldrill.problems.pictures import (
    Arm,
    BackupDiagram,
    Bars,
    Bumps,
    GridPicture,
    Pendulum,
    Picture,
    StateDiagram,
)
from rldrill.render.pictures import backup, graph, mechanics, plots
from rldrill.render.pictures.scene import Scene


def scene_of(picture: Picture) -> Scene | None:
    """A picture as a scene; None for a state diagram that is too large to be readable.

    Raises:
        TypeError: there is no scene of this picture.
    """
    match picture:
        case StateDiagram():
            return graph.scene(picture)
        case BackupDiagram(root, title):
            return backup.scene(root, title)
        case GridPicture():
            return plots.grid(picture)
        case Bars():
            return plots.bars(picture)
        case Bumps():
            return plots.bumps(picture)
        case Arm():
            return mechanics.arm(picture)
        case Pendulum():
            return mechanics.pendulum(picture)
        case _:
            raise TypeError(f"{type(picture).__name__} has no scene")
