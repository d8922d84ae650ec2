"""Grid worlds drawn as text, as models: one character for every cell."""

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from rldrill.problems.complaints import nearest
from rldrill.problems.exact import Exact, Probability

WALL, FREE = "#", "."
#: The moves, each with its step down and to the right.
MOVES = {"up": (-1, 0), "right": (0, 1), "down": (1, 0), "left": (0, -1)}
_LARGEST = 1000

Cell = tuple[int, int]


class Grid(BaseModel):
    """A grid world drawn as text; a cell is called by row and column, ``r1c3``."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    grid: str = Field(
        min_length=1,
        max_length=5000,
        description="The cells, a line a row: . is free, # a wall, any other sign a cell of that name.",
        examples=["..G\n.#T\n..."],
    )
    rewards: dict[str, Exact] = Field(
        default={}, description="What entering a cell of that name earns.", examples=[{"G": 10, "T": -5}]
    )
    step: Exact = Field(default=Fraction(0), description="What every move earns besides.", examples=[-1])
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
    returns: dict[str, str] = Field(
        default={},
        description="For cells of that name, the name of the cell that entering them leads to.",
        examples=[{"T": "G"}],
    )

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
                    raise ValueError(f"{what} names {name!r}, but no cell of the grid is called so")
        ends = {cell for cell, sign in cells.items() if sign in self._ends()}
        rows: list[list[Any]] = []
        for cell, sign in cells.items():
            if sign != WALL and cell not in ends and sign not in self.returns:
                for move in MOVES:
                    rows += self._outcomes(cells, cell, move)
        return rows, [_name(cell) for cell in sorted(ends)]

    def _ends(self) -> tuple[str, ...]:
        if self.ends is not None:
            return self.ends
        return tuple(name for name in self.rewards if name not in self.returns)

    def _cells(self) -> dict[Cell, str]:
        lines = [line.strip() for line in self.grid.strip().splitlines()]
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
        reached: dict[tuple[str, Fraction], Fraction] = {}
        for way, chance in chances.items():
            if chance:
                after, reward = self._entered(cells, cell, way)
                reached[after, reward] = reached.get((after, reward), Fraction(0)) + chance
        merged: dict[str, tuple[Fraction, Fraction]] = {}
        for (after, reward), chance in reached.items():
            total, worth = merged.get(after, (Fraction(0), Fraction(0)))
            merged[after] = total + chance, worth + chance * reward
        return [[_name(cell), move, after, total, worth / total] for after, (total, worth) in merged.items()]

    def _entered(self, cells: Mapping[Cell, str], cell: Cell, way: str) -> tuple[str, Fraction]:
        down, right = MOVES[way]
        after = (cell[0] + down, cell[1] + right)
        if cells.get(after, WALL) == WALL:
            return _name(cell), self.step
        sign = cells[after]
        reward = self.step + self.rewards.get(sign, Fraction(0))
        if sign in self.returns:
            targets = [other for other, name in cells.items() if name == self.returns[sign]]
            if len(targets) != 1:
                raise ValueError(f"returns leads to {self.returns[sign]!r}, which must stand for one cell")
            after = targets[0]
        return _name(after), reward


def _name(cell: Cell) -> str:
    return f"r{cell[0] + 1}c{cell[1] + 1}"


def read_grid(data: Mapping[str, Any]) -> dict[str, Any]:
    """A drawn grid as the transitions of a model.

    Raises:
        ValueError: the drawing does not fit.
    """
    try:
        transitions, terminal = Grid.model_validate(data).transitions()
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, first["loc"]))
        if first["type"] == "extra_forbidden":
            raise ValueError(f"{where} is not a field of a grid{nearest(where, tuple(Grid.model_fields))}") from None
        raise ValueError(f"{where}: {str(first['msg']).removeprefix('Value error, ')}") from None
    return {"transitions": transitions, "terminal": terminal}
