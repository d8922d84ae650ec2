"""Linear systems with quadratic rewards, as problems give them."""

from collections.abc import Sequence
from typing import Any, ClassVar, Literal, NamedTuple, Self, TypeVar

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Equation, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, Probability, Scalar, dot, shown
from rldrill.problems.family import Givens
from rldrill.problems.fractions import Fraction
from rldrill.problems.mathematics import mathematics
from rldrill.problems.matrices import (
    MatricesField,
    MatrixField,
    NumberRows,
    OpenMatricesField,
    Rows,
    check_shape,
    check_weights,
    diagonal,
    tabular,
)

#: What every such problem says of itself.
REWARD = "$r(s_t, a_t) = −(s_t^⊤ Q_t s_t + a_t^⊤ R_t a_t)$"
#: Today's longest runs; with few states they may be longer, as long as the fractions in them do not grow too much.
_LONG = 12
_EFFORT = 100


def one_or(count: int) -> str:
    """How matrices are given, to whoever gave as many as there are no times."""
    return f"give one, as a list of rows such as [[1, 2], [3, 4]], or {count} for the times from 0"


AnyRows = TypeVar("AnyRows", bound=Rows)

Convention = Literal["value", "cost-to-go", "xuKP"]


class Notation(NamedTuple):
    """The letters of state, action, gain and value matrix; whether that matrix is a cost's, and so positive."""

    state: str
    action: str
    gain: str
    value: str
    costs: bool


NOTATIONS: dict[Convention, Notation] = {
    "value": Notation("s", "a", "L", "P", costs=False),
    "cost-to-go": Notation("s", "a", "L", "S", costs=True),
    "xuKP": Notation("x", "u", "K", "P", costs=True),
}


class Discounted(Givens):
    """What a quadratic cost may have beside Q and R."""

    OWN: ClassVar[str] = "A"  # the matrix

    gamma: Probability = Field(
        default=Fraction(1),
        gt=0,
        exclude_if=lambda gamma: gamma == 1,
        description="The discount, above 0.",
        examples=["9/10"],
    )


class Conventional(Discounted):
    """What may also be said of a problem that asks for gains and value matrices: in whose letters."""

    convention: Convention = Field(
        default="value",
        exclude_if=lambda convention: convention == "value",
        description="In whose letters; value: rewards, V(s) = sᵀPs with P negative, a = −Ls; cost-to-go: costs, sᵀSs "
        "with S positive, a = −Ls; xuKP: costs, xᵀPx with P positive, u = −Kx.",
    )

    @property
    def notation(self) -> Notation:
        """The letters of the convention."""
        return NOTATIONS[self.convention]


class LinearQuadratic(Discounted):
    """A system s' = A s + B a with the reward −(sᵀQs + aᵀRa) at the times 0 to ``horizon``, and its start.

    Every matrix is a list of rows (a plain number, if it is 1×1). A list of matrices gives one for every
    time: A, B and N for 0 to horizon − 1, Q and R for 0 to horizon.
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
    N: MatricesField | None = Field(
        default=None,
        description="The cross term: the cost has 2 sᵀNa, too, before the horizon; none if left out.",
        examples=[[["1/2"]]],
    )
    Q_T: MatrixField | None = Field(
        default=None, description="The cost of states at the horizon; as before it, if left out.", examples=[[[2]]]
    )
    start: tuple[Exact, ...] = Field(min_length=1, max_length=6, description="The first state.")
    horizon: int = Field(ge=1, le=_EFFORT, description="The last time.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        n, m = len(self.A[0]), len(self.B[0][0])
        where = f"with {n} state{'s' * (n != 1)} and {m} action{'s' * (m != 1)} "
        if self.horizon > (most := max(_LONG, _EFFORT // n**2)):
            raise ValueError(f"horizon is {self.horizon}; {where.rstrip()}, {most} is the most")
        shapes = (
            ("A", self.A, n, n, self.horizon), ("B", self.B, n, m, self.horizon),
            ("Q", self.Q, n, n, self.horizon + 1), ("R", self.R, m, m, self.horizon + 1),
            ("N", self.N or (), n, m, self.horizon), ("Q_T", (self.Q_T,) if self.Q_T else (), n, n, 1),
        )  # fmt: skip
        for name, series, _, _, count in shapes:
            if series and len(series) not in (1, count):
                raise ValueError(f"{name} holds {len(series)} matrices; {one_or(count)}")
        if len(self.start) != n:
            raise ValueError(f"start: A has {n} row{'s' * (n != 1)}, so give as many entries, not {len(self.start)}")
        for name, series, rows, columns, _ in shapes:
            for matrix in series:
                check_shape(name, matrix, rows, columns, where)
                if name in ("Q", "R", "Q_T"):
                    check_weights(name, matrix, positive=False)
        if self.Q_T and len(self.Q) > 1:
            raise ValueError("Q_T is given twice, since Q has a matrix for the horizon, too; leave one of them out")
        if self.N:
            for time in range(self.horizon):
                check_cross(by_time(self.Q, time), by_time(self.R, time), by_time(self.N, time))
        return self

    @property
    def actions(self) -> int:
        """How many entries an action has."""
        return len(self.B[0][0])

    @property
    def state_costs(self) -> tuple[NumberRows, ...]:
        """The matrices Q of all times, or one for all."""
        return self.Q if self.Q_T is None else (*(self.Q * self.horizon), self.Q_T)

    @property
    def price(self) -> Fraction:
        """The price of the only action, where it is a number; else 1."""
        entry = self.R[0][0][0]
        return entry if isinstance(entry, Fraction) else Fraction(1)

    @property
    def plain(self) -> bool:
        """Whether there is neither a discount nor a cross term nor a final cost of its own."""
        return self.gamma == 1 and self.N is None and self.Q_T is None


def check_cross(Q: Rows, R: Rows, N: Rows) -> None:
    """Demand that the cost of a state and an action together is never negative, whatever N adds to it.

    Raises:
        ValueError: it may be negative.
    """
    upper = [(*left, *right) for left, right in zip(Q, N, strict=True)]
    lower = [(*left, *right) for left, right in zip(zip(*N, strict=True), R, strict=True)]
    check_weights("with the cross term the matrix of all costs, (Q N; Nᵀ R),", (*upper, *lower), positive=False)


def by_time(series: tuple[AnyRows, ...], time: int) -> AnyRows:
    """The matrix of a time; a single one holds at all times."""
    return series[time] if len(series) > 1 else series[0]


def situation(given: LinearQuadratic) -> tuple[Block, ...]:
    """The sentences and matrices of the system."""
    scalar = len(given.start) == given.actions == 1
    constant = all(len(getattr(given, name)) == 1 for name in ("A", "B", "Q", "R"))
    left_open = any(isinstance(entry, Parameter) for matrix in given.R for line in matrix for entry in line)
    return (
        Paragraph(
            "A system with the dynamics $s_{t+1} = A_t s_t + B_t a_t$ earns the reward "
            f"{REWARD} at {_at(0, given.horizon)}." + (" States and actions are numbers." if scalar else "")
        ),
        Paragraph(
            (
                f"{'The coefficients' if scalar else 'The matrices'} are the same at all times"
                if constant
                else f"{'A coefficient' if scalar else 'A matrix'} with index $t$ holds at all times"
            )
            + ("; the price $ρ > 0$ of the action is left open:" if left_open else ":")
        ),
        *(block for name in ("A", "B", "Q", "R") for block in listed(name, getattr(given, name))),
        Equation(mathematics("s_0"), (tabular(tuple((entry,) for entry in given.start)),), ("=",), linear=True),
    )


def listed(name: str, matrices: Sequence[Rows]) -> list[Equation]:
    """Matrices by time; a single one has the index t."""
    indices = ["t"] if len(matrices) == 1 else [f"{{{time}}}" for time in range(len(matrices))]
    return [
        Equation(mathematics(f"{name}_{index}"), (tabular(matrix),), ("=",), linear=True)
        for index, matrix in zip(indices, matrices, strict=True)
    ]


def quadratic(notation: Notation, index: str = "", *, crossed: bool) -> str:
    """The cost of a state and an action, as mathematics; ``index`` is ``_t`` where matrices have one."""
    x, u = f"{notation.state}_t", f"{notation.action}_t"
    cross = f" + 2 {x}^⊤ N{index} {u}" if crossed else ""
    return f"{x}^⊤ Q{index} {x}{cross} + {u}^⊤ R{index} {u}"


def costs(given: LinearQuadratic, notation: Notation) -> tuple[Block, ...]:
    """The sentences and matrices of a system of which more is said than of a plain one."""
    x, u, last = notation.state, notation.action, given.horizon
    scalar = len(given.start) == given.actions == 1
    stage, end = quadratic(notation, "_t", crossed=given.N is not None), f"{x}_T^⊤ Q_T {x}_T"
    earns = f"costs ${stage}$" if notation.costs else f"earns the reward $r({x}_t, {u}_t) = −({stage})$"
    pays = f"costs ${end}$" if notation.costs else f"earns $−{end}$"
    left_open = any(isinstance(entry, Parameter) for matrix in given.R for line in matrix for entry in line)
    discounted = "" if given.gamma == 1 else (
        f" The {'cost' if notation.costs else 'reward'} at time $t$ is discounted by $γ^t$, "
        f"with $γ = {shown(given.gamma)}$."
    )  # fmt: skip
    Q_T = Equation(mathematics("Q_T"), (tabular(by_time(given.state_costs, last)),), ("=",), linear=True)
    before = given.state_costs[:last] if len(given.Q) > 1 else given.Q
    return (
        Paragraph(
            f"A system has the dynamics ${x}_{{t+1}} = A_t {x}_t + B_t {u}_t$. It {earns} at "
            f"{_at(0, last - 1)}, and at the end, at time $T = {last}$, the state alone {pays}.{discounted}"
        ),
        Paragraph(
            f"{'A coefficient' if scalar else 'A matrix'} with index $t$ holds before $T$"
            + ("; the price $ρ > 0$ of the action is left open:" if left_open else ":")
        ),
        *listed("A", given.A), *listed("B", given.B), *listed("Q", before), Q_T,
        *listed("R", given.R if len(given.R) == 1 else given.R[:last]), *listed("N", given.N or ()),
        Equation(mathematics(f"{x}_0"), (tabular(tuple((entry,) for entry in given.start)),), ("=",), linear=True),
    )  # fmt: skip


def _at(first: int, last: int) -> str:
    """At which times, in words: one, or each of several."""
    return f"{'time' if first == last else 'every time'} $t = {times(first, last)}$"


def times(first: int, last: int) -> str:
    """The times from the first to the last, as mathematics."""
    return ", ".join(map(str, range(first, last + 1))) if last - first < 3 else f"{first}, …, {last}"


def draw_system(rng: Draws, states: int, price: Scalar) -> dict[str, Any]:
    """Small matrices of whole numbers: A, B with one action, Q diagonal, R the price; none of them is another one."""
    A: Rows
    B: Rows
    Q: Rows
    if states == 1:
        b = rng.whole(1, 2)
        A, B, Q = ((rng.fitting(-2, 3, lambda a: a != b),),), ((b,),), ((rng.fitting(1, 3, lambda q: q != price),),)
    else:
        costs_ = rng.shuffled([Fraction(cost) for cost in (1, 2, 3) if cost != price])
        A, B, Q = rng.choice(_MOVES), rng.choice(_INPUTS), diagonal(*costs_[:2])
    return {"A": (A,), "B": (B,), "Q": (Q,), "R": (((price,),),)}


def _numbers(*rows: Sequence[int]) -> Rows:
    return tuple(tuple(map(Fraction, row)) for row in rows)


_MOVES = (
    _numbers((1, 1), (0, 1)), _numbers((0, 1), (1, 1)), _numbers((1, 1), (-1, 1)), _numbers((1, 0), (1, 1)),
    _numbers((2, 1), (0, 1)), _numbers((0, 1), (-1, 2)), _numbers((1, -1), (1, 0)),
)  # fmt: skip
_INPUTS = (_numbers((0,), (1,)), _numbers((1,), (0,)), _numbers((1,), (1,)), _numbers((0,), (2,)))


def single_gain(A: NumberRows, B: NumberRows, price: Fraction, P: NumberRows) -> tuple[Fraction, ...]:
    """The gain of a single action from the next value matrix; with a discount γ, for the price divided by it."""
    inputs = [line[0] for line in B]
    ahead = [dot(inputs, column) for column in zip(*P, strict=True)]
    return tuple(dot(ahead, column) / (dot(ahead, inputs) - price) for column in zip(*A, strict=True))


def value_before(
    A: NumberRows, B: NumberRows, Q: NumberRows, P: NumberRows, gain: Sequence[Fraction], gamma: Fraction
) -> NumberRows:
    """The value matrix one time earlier, with the gain of a single action."""
    columns, inputs = tuple(zip(*A, strict=True)), [line[0] for line in B]
    ahead = [[dot(column, line) for line in zip(*P, strict=True)] for column in columns]  # AᵀP
    return tuple(
        tuple(
            gamma * (dot(row, column) - dot(row, inputs) * entry) - cost
            for column, entry, cost in zip(columns, gain, costs_, strict=True)
        )
        for row, costs_ in zip(ahead, Q, strict=True)
    )
