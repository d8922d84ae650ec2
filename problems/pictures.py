"""Pictures as data: what is drawn, not how; the terminal and the PDF each draw them in their own way.

Labels are texts, with mathematics between ``$`` signs.
"""

from collections.abc import Iterator
from itertools import zip_longest
from typing import Literal

from msgspec import Struct

from rldrill.problems.document import Block


class Picture(Block):
    """A block that is drawn."""

    __slots__ = ()


class Arrow(Struct, frozen=True):
    """One transition of a state diagram: from a state by an action to a state."""

    state: str
    action: str
    next: str
    probability: str
    reward: str


class StateDiagram(Picture, Struct, frozen=True):
    """States as circles, actions as dots, probabilities and rewards on the arrows.

    ``states`` holds the terminal ones too, in the order in which they are drawn.
    """

    states: tuple[str, ...]
    terminal: tuple[str, ...]
    arrows: tuple[Arrow, ...]


class Moment(Struct, frozen=True):
    """A state of a run with the label above it, and the action and the reward behind it, None where there is none."""

    label: str
    state: str
    action: str | None
    reward: str | None
    last: bool

    @property
    def goes_on(self) -> bool:
        """Whether an arrow leaves the state."""
        return not self.last or self.action is not None


class Timeline(Picture, Struct, frozen=True):
    """A run over time: states, and between them actions (if any) and rewards, all as they are labelled.

    There may be an action in the last state, too; ``ended`` says that the last state is terminal.
    ``times`` are the labels above the states, empty where nothing stands there.
    """

    times: tuple[str, ...]
    states: tuple[str, ...]
    actions: tuple[str, ...]
    rewards: tuple[str, ...]
    ended: bool = False

    def moments(self) -> Iterator[Moment]:
        """The run from its beginning."""
        for number, each in enumerate(zip_longest(self.times, self.states, self.actions, self.rewards), 1):
            yield Moment(*each, last=number == len(self.states))


class GridPicture(Picture, Struct, frozen=True):
    """A grid world: the label of every cell, row by row; ``#`` is a wall."""

    rows: tuple[tuple[str, ...], ...]


class Branch(Struct, frozen=True):
    """A line of a backup diagram downwards, with what stands beside it."""

    node: "Node"
    label: str = ""


class Node(Struct, frozen=True):
    """A node of a backup diagram: an open circle for a state, a filled dot for an action, a square for the end.

    ``maximum`` draws the arc across the branches; ``dots`` says that the diagram goes on between this node
    and the next in the same way.
    """

    kind: Literal["state", "action", "end"]
    branches: tuple[Branch, ...] = ()
    label: str = ""
    maximum: bool = False
    dots: bool = False


class BackupDiagram(Picture, Struct, frozen=True):
    """A backup diagram as Sutton & Barto draw it, root above, and over it a title if there is one."""

    root: Node
    title: str = ""


class Bars(Picture, Struct, frozen=True):
    """Shares side by side, such as a belief before and after: for every name one bar in each series.

    ``shares`` and ``labels`` have a row for each series; shares are between 0 and 1, labels are what
    stands above the bars. A single series may go without a name.
    """

    names: tuple[str, ...]
    series: tuple[str, ...]
    shares: tuple[tuple[float, ...], ...]
    labels: tuple[tuple[str, ...], ...]


class Bumps(Picture, Struct, frozen=True):
    """Radial basis functions over a state axis, and the state that is asked about."""

    centres: tuple[float, ...]
    width: float
    shape: Literal["gaussian", "tent"]
    state: float


class Arm(Picture, Struct, frozen=True):
    """A planar arm: its links, and the joints' angles in degrees, each relative to the link before.

    The first is relative to the base's own axis, which may be ``turned`` by an angle, in degrees.
    """

    lengths: tuple[float, ...]
    angles: tuple[float, ...]
    turned: float = 0.0


class Pendulum(Picture, Struct, frozen=True):
    """A pendulum at an angle in degrees from hanging down; ``cart`` puts it on a cart, standing up at 180."""

    angle: float
    cart: bool = False
