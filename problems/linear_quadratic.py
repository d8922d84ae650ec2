"""Linear systems with quadratic rewards, as problems give them."""

from typing import Any, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Equation, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, Scalar
from rldrill.problems.family import Givens
from rldrill.problems.mathematics import mathematics
from rldrill.problems.matrices import (
    MatricesField,
    OpenMatricesField,
    Rows,
    check_shape,
    check_weights,
    tabular,
)

#: What every such problem says of itself.
REWARD = "$r(s_t, a_t) = −(s_t^⊤ Q_t s_t + a_t^⊤ R_t a_t)$"


class LinearQuadratic(Givens):
    """A system s' = A s + B a with the reward −(sᵀQs + aᵀRa) at the times 0 to ``horizon``, and its start.

    Every matrix is a list of rows (a plain number, if it is 1×1). A list of matrices gives one for every
    time: A and B for 0 to horizon − 1, Q and R for 0 to horizon.
    """

    A: MatricesField = Field(
        description="How the state moves by itself, the same at all times or one for each from 0 to horizon − 1."
    )
    B: MatricesField = Field(
        description="How the action moves the state, the same at all times or one for each from 0 to horizon − 1."
    )
    Q: MatricesField = Field(
        description="The cost of states, the same at all times or one for each from 0 to the horizon."
    )
    R: OpenMatricesField = Field(
        description="The cost of actions, the same at all times or one for each from 0 to the horizon."
    )
    start: tuple[Exact, ...] = Field(min_length=1, max_length=6, description="The first state.")
    horizon: int = Field(ge=1, le=12, description="The last time.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        n = len(self.start)
        m = len(self.B[0][0]) if self.B[0] else 0
        where = f"with {n} state{'s' * (n != 1)} and {m} action{'s' * (m != 1)} "
        for name, series, rows, columns, count in (
            ("A", self.A, n, n, self.horizon), ("B", self.B, n, m, self.horizon),
            ("Q", self.Q, n, n, self.horizon + 1), ("R", self.R, m, m, self.horizon + 1),
        ):  # fmt: skip
            if len(series) not in (1, count):
                raise ValueError(f"{name} holds {len(series)} matrices; give one, or {count} for the times from 0")
            for matrix in series:
                check_shape(name, matrix, rows, columns, where)
                if name in "QR":
                    check_weights(name, matrix, positive=name == "R")
        return self

    @property
    def actions(self) -> int:
        """How many entries an action has."""
        return len(self.B[0][0])


def by_time(series: tuple[Rows, ...], time: int) -> Rows:
    """The matrix of a time; a single one holds at all times."""
    return series[time] if len(series) > 1 else series[0]


def situation(given: LinearQuadratic) -> tuple[Paragraph | Equation, ...]:
    """The sentences and matrices of the system."""
    scalar = len(given.start) == given.actions == 1
    lines = []
    for name in ("A", "B", "Q", "R"):
        series = getattr(given, name)
        for time, matrix in enumerate(series):
            index = "t" if len(series) == 1 else str(time)
            lines.append(Equation(mathematics(f"{name}_{index}"), (tabular(matrix),), ("=",)))
    constant = all(len(getattr(given, name)) == 1 for name in ("A", "B", "Q", "R"))
    left_open = any(isinstance(entry, Parameter) for matrix in given.R for line in matrix for entry in line)
    return (
        Paragraph(
            "A system with the dynamics $s_{t+1} = A_t s_t + B_t a_t$ earns the reward "
            f"{REWARD} at every time $t = {times(0, given.horizon)}$."
            + (" States and actions are numbers." if scalar else "")
        ),
        Paragraph(
            ("The matrices are the same at all times" if constant else "A matrix with index $t$ holds at all times")
            + ("; the price $ρ > 0$ of the action is left open:" if left_open else ":")
        ),
        *lines,
        Equation(mathematics("s_0"), (tabular(tuple((entry,) for entry in given.start)),), ("=",)),
    )


def times(first: int, last: int) -> str:
    """The times from the first to the last, as mathematics."""
    return ", ".join(map(str, range(first, last + 1))) if last - first < 3 else f"{first}, …, {last}"


def draw_system(rng: Draws, states: int, price: Scalar) -> dict[str, Any]:
    """Small matrices of whole numbers: A, B with one action, Q diagonal, R the price."""
    if states == 1:
        return {"A": ((rng.nonzero(-2, 3),),), "B": ((rng.whole(1, 2),),), "Q": ((rng.whole(1, 3),),), "R": ((price,),)}
    A = rng.choice((((1, 1), (0, 1)), ((0, 1), (1, 1)), ((1, 1), (-1, 1)), ((1, 0), (1, 1)), ((2, 1), (0, 1)),
                    ((0, 1), (-1, 2)), ((1, -1), (1, 0))))  # fmt: skip
    B = rng.choice((((0,), (1,)), ((1,), (0,)), ((1,), (1,)), ((0,), (2,))))
    Q = ((rng.whole(1, 3), 0), (0, rng.whole(0, 2)))
    return {"A": A, "B": B, "Q": Q, "R": ((price,),)}
