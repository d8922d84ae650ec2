"""Grid worlds drawn as text, as models: one character for every cell."""

import re
from collections.abc import Mapping
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from rldrill.problems.complaints import nearest, says
from rldrill.problems.exact import Exact, Probability
from rldrill.problems.fractions import Fraction
from rldrill.problems.readings import Note

WALL, FREE = "#", "."
#: The moves, each with its step down and to the right.
MOVES = {"up": (-1, 0), "right": (0, 1), "down": (1, 0), "left": (0, -1)}
#: The one action of an end that must be left, and the state that it leads to.
EXIT, OVER = "exit", "over"
_LARGEST = 1000
_BAR, _GAP = re.compile(r"\s*\|\s*"), re.compile(r"(?<=\S)\s*(?=\S)")

Cell = tuple[int, int]


class Grid(BaseModel):
    """A grid world drawn as text; a cell is called by row and column, ``r1c3``."""

    model_config = ConfigDict(frozen=True, extra="forbid", arbitrary_types_allowed=True, defer_build=True)

    grid: str = Field(
        min_length=1,
        max_length=5000,
        description="The cells, a line a row: . is free, # a wall, any other sign a cell of that name.",
        examples=["..G\n.#T\n..."],
    )
    rewards: dict[str, Exact] = Field(
        default={}, description="What a cell of that name earns.", examples=[{"G": 10, "T": -5}]
    )
    rewards_on: Literal["entering", "leaving"] = Field(
        default="entering",
        description="Whether a reward is earned on entering the cell, or on leaving it as the textbooks' R(s) is.",
    )
    step: Exact = Field(default=Fraction(0), description="What every move earns besides.", examples=[-1])
    bump: Exact = Field(
        default=Fraction(0), description="What a move against a wall or the edge earns besides.", examples=[-1]
    )
    slip: Probability = Field(
        default=Fraction(0),
        description="The probability to go at a right angle to the move, half of it to either side.",
        examples=["1/5"],
    )
    ends: tuple[str, ...] | None = Field(
        default=None,
        description="The names of the cells in which an episode ends; without it, those with rewards.",
        examples=[["G", "T"]],
    )
    exit: bool | None = Field(
        default=None,
        description=(
            "Whether an end is left by the one action there, exit, which earns its reward, without step, and ends the "
            "episode; without it, where rewards are earned on leaving. Else entering an end ends the episode."
        ),
    )
    returns: dict[str, str] = Field(
        default={},
        description=(
            "For cells of that name, the name of the cell that entering them leads to; where rewards are earned on "
            "leaving, that every move from them leads to."
        ),
        examples=[{"T": "G"}],
    )
    story: str = Field(
        default="", description="A sentence that is printed first.", examples=["A robot cleans a corridor."]
    )

    @property
    def exits(self) -> bool:
        """Whether an end is left by an action of its own."""
        return self.rewards_on == "leaving" if self.exit is None else self.exit

    def told(self) -> str:
        """The story, with the sentences that say when rewards are earned, unless all are on entering."""
        on = f"Rewards of cells are earned on {self.rewards_on} them." if self.rewards_on == "leaving" else ""
        out = f"In an end, the one action is {EXIT}: it earns the end's reward, and the episode is over."
        return " ".join(filter(None, [self.story, on, out if self.exits and self._ends() else ""]))

    def transitions(self) -> tuple[list[list[Any]], list[str]]:
        """The transitions of the world, and its terminal states; a cell is called by row and column, ``r1c3``.

        Raises:
            ValueError: the rows differ in length, or a name stands for no cell or for several.
        """
        cells = self._cells()
        named = {sign for sign in cells.values() if sign not in (FREE, WALL)}
        for what, names in (("rewards", self.rewards), ("ends", self.ends or ()), ("returns", self.returns)):
            for name in names:
                if name not in named:
                    raise ValueError(f"{what} names {name!r}, but no cell of the grid is called so; correct the name")
        if self.rewards_on == "leaving" and not self.exits:
            raise ValueError("exit: with rewards on leaving, an end that is not left earns nothing; set exit = true")
        ends = {cell for cell, sign in cells.items() if sign in self._ends()}
        passed = self.returns if self.rewards_on == "entering" else ()  # nobody stays there
        rows: list[list[Any]] = []
        for cell, sign in cells.items():
            if cell in ends and self.exits:
                rows.append([_name(cell), EXIT, OVER, 1, self.rewards.get(sign, Fraction(0))])
            elif sign != WALL and cell not in ends and sign not in passed:
                for move in MOVES:
                    rows += self._outcomes(cells, cell, move)
        return rows, [OVER] if self.exits and ends else [_name(cell) for cell in sorted(ends)]

    def without_meaning(self) -> tuple[str, ...]:
        """The names in the drawing of which nothing is said; S, where one starts, needs none."""
        said = {FREE, WALL, "S", *self.rewards, *self._ends(), *self.returns, *self.returns.values()}
        return tuple(dict.fromkeys(sign for sign in self._cells().values() if sign not in said))

    def _ends(self) -> tuple[str, ...]:
        if self.ends is not None:
            return self.ends
        return tuple(name for name in self.rewards if name not in self.returns)

    def _cells(self) -> dict[Cell, str]:
        drawn = [_BAR.sub(" ", line).strip() for line in self.grid.strip().splitlines()]
        gaps = {gap for line in drawn for gap in _GAP.findall(line)}
        if len(gaps) > 1 or max(map(len, gaps), default=0) > 1:
            raise ValueError(
                "the cells of the grid are parted unevenly; draw each as one sign, free ones as '.', all with or all "
                "without a space between"
            )
        lines = ["".join(line.split()) for line in drawn]
        if len({len(line) for line in lines}) != 1:
            raise ValueError("the rows of the grid differ in length; write walls as '#'")
        cells = {(row, column): sign for row, line in enumerate(lines) for column, sign in enumerate(line)}
        if len(cells) > _LARGEST:
            raise ValueError(f"the grid has {len(cells)} cells; {_LARGEST} are the most")
        return cells

    def _outcomes(self, cells: Mapping[Cell, str], cell: Cell, move: str) -> list[list[Any]]:
        names = list(MOVES)
        place = names.index(move)
        chances = {move: 1 - self.slip, names[(place + 1) % 4]: self.slip / 2, names[(place - 1) % 4]: self.slip / 2}
        return [
            [_name(cell), move, after, chance, reward]
            for way, chance in chances.items()
            if chance
            for after, reward in [self._moved(cells, cell, way)]
        ]

    def _moved(self, cells: Mapping[Cell, str], cell: Cell, way: str) -> tuple[str, Fraction]:
        """Where a move leads, and what it earns."""
        down, right = MOVES[way]
        after, left = (cell[0] + down, cell[1] + right), cells[cell]
        leaving = self.rewards_on == "leaving"
        earned = self.step + (self.rewards.get(left, Fraction(0)) if leaving else 0)
        if leaving and left in self.returns:
            return _name(self._target(cells, left)), earned
        if cells.get(after, WALL) == WALL:
            return _name(cell), earned + self.bump
        sign = cells[after]
        if leaving:
            return _name(after), earned
        if not (self.exits and sign in self._ends()):
            earned += self.rewards.get(sign, Fraction(0))
        return _name(self._target(cells, sign) if sign in self.returns else after), earned

    def _target(self, cells: Mapping[Cell, str], sign: str) -> Cell:
        targets = [cell for cell, name in cells.items() if name == self.returns[sign]]
        if len(targets) != 1:
            raise ValueError(
                f"returns leads to {self.returns[sign]!r}, which must stand for one cell; "
                "name a cell, or a sign that stands once"
            )
        return targets[0]


def _name(cell: Cell) -> str:
    return f"r{cell[0] + 1}c{cell[1] + 1}"


def _are_signs(row: object) -> bool:
    return isinstance(row, list | tuple) and all(isinstance(sign, str) for sign in row)


def read_grid(data: Mapping[str, Any], note: Note) -> dict[str, Any]:
    """A drawn grid as the transitions of a model.

    Args:
        data: the fields of a ``Grid``.
        note: told what is read otherwise than it is written.

    Raises:
        ValueError: the drawing does not fit.
    """
    rows = data["grid"]
    if isinstance(rows, list | tuple):  # as Gymnasium has its maps
        data = {**data, "grid": "\n".join("".join(row) if _are_signs(row) else str(row) for row in rows)}
    try:
        grid = Grid.model_validate(data, context=note)
        transitions, terminal = grid.transitions()
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, first["loc"]))
        if first["type"] == "extra_forbidden":
            known = tuple(Grid.model_fields)
            raise ValueError(
                f"{where} is not a field of a grid{nearest(where, known)}; its fields are {', '.join(known)}"
            ) from None
        raise ValueError(f"{where}: {says(first)}") from None
    if plain := grid.without_meaning():
        note(f"took {' and '.join(plain)}, with no reward and no end, for free cells")
    return {"transitions": transitions, "terminal": terminal, "story": grid.told()}
