"""The Gaussian belief of a robot on a line after moving and measuring; with its velocity at level 3."""

from collections.abc import Sequence
from functools import cache
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Equation, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, shown
from rldrill.problems.family import AskedFor, Givens, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.mathematics import mathematics
from rldrill.problems.matrices import (
    ColumnField,
    MatrixField,
    OpenMatrixField,
    Rows,
    check_shape,
    check_weights,
    diagonal,
    tabular,
)
from rldrill.problems.parts import LETTERS, Matrix, Number, Numbers, Part

TITLE = "Kalman filter"
SOURCE = "Thrun, Burgard & Fox 2005, section 3.2"
REVISION = 6

_0, _1 = Fraction(0), Fraction(1)
_ONE = ((_1,),)
#: From so many steps on they stand below each other.
_WIDE = 6
#: How many entries all covariances together may have: with every step the fractions in them grow.
_EFFORT = 100


class Event(Givens):
    """What happens in one step: a motion with the command u, then unless z is missing a measurement."""

    u: ColumnField | None = Field(default=None, description="The command of the motion, a column; 0 if left out.")
    z: ColumnField | None = Field(default=None, description="The measurement after it, a column, if there is one.")


class Given(AskedFor):
    """The first belief, the models A, B, C, the noises of motion and sensor (their covariances), and the steps.

    Vectors are matrices of one column; a plain number is a 1×1 matrix, and A, B and C are 1 unless given. Where no step
    has a command, there is no B, and the state moves by A and the noise alone. With ``variance``, that after the only
    measurement on a line, the variance of one noise is left open and found from it.
    """

    mean: ColumnField = Field(description="The mean of the first belief, a column.")
    covariance: MatrixField = Field(description="The covariance of the first belief.")
    A: MatrixField = Field(default=_ONE, description="How the state moves by itself.")
    B: MatrixField = Field(
        default=_ONE,
        exclude_if=lambda B: B == _ONE,
        description="How the command moves the state.",
    )
    C: MatrixField = Field(default=_ONE, description="What the sensor sees of the state.")
    process: OpenMatrixField = Field(description="The covariance of the noise of the motion.")
    sensor: OpenMatrixField = Field(description="The covariance of the noise of the sensor.")
    steps: tuple[Event, ...] = Field(
        min_length=1, max_length=_EFFORT, description="The steps, each a motion and, if there is one, a measurement."
    )

    variance: Exact | None = Field(
        default=None,
        description="The variance after the measurement, from which the variance w of a noise is found.",
        examples=["3/2"],
    )

    @model_validator(mode="after")
    def _found(self) -> Self:
        if (self.variance is None) == bool(self.left_open):
            raise ValueError("variance: it goes with the variance of one noise that is left open, such as w")
        one = self.on_a_line and len(self.steps) == 1 and self.steps[0].z is not None
        if self.variance is not None and not one:
            raise ValueError("variance: it goes with a single step on a line, with a measurement")
        return self

    @model_validator(mode="after")
    def _fits(self) -> Self:
        n, inputs, readings = len(self.mean), len(self.B[0]), len(self.C)
        if len(self.steps) > (most := max(5, _EFFORT // n**2)):
            raise ValueError(
                f"steps has {len(self.steps)} entries; with {n} component{'s' * (n != 1)} of the state, {most} are the "
                "most: split the run, and go on from the last belief"
            )
        for name, matrix, rows, columns in (
            ("mean", self.mean, n, 1), ("covariance", self.covariance, n, n), ("A", self.A, n, n),
            ("C", self.C, readings, n), ("process", self.process, n, n), ("sensor", self.sensor, readings, readings),
            *((("B", self.B, n, inputs),) if self.driven else ()),
        ):  # fmt: skip
            if name == "B" and n > 1 and "B" not in self.model_fields_set:
                raise ValueError("B, by which the commands u move the state, is missing; add it")
            check_shape(
                name, matrix, rows, columns, f"with a mean of {n} and {readings} reading{'s' * (readings > 1)} "
            )
        for event in self.steps:
            if event.u is not None:
                check_shape("u", event.u, inputs, 1, f"with {inputs} inputs ")
            if event.z is not None:
                check_shape("z", event.z, readings, 1, f"with {readings} reading{'s' * (readings > 1)} ")
        check_weights("covariance", self.covariance, positive=False)
        check_weights("process", self.process, positive=False)
        check_weights("sensor", self.sensor, positive=True)
        return self

    @property
    def driven(self) -> bool:
        """Whether there are commands at all."""
        return any(event.u is not None for event in self.steps)

    def command(self, event: Event) -> Rows:
        """The command of a step; nothing but zeros where none is given."""
        return event.u or tuple((Fraction(0),) for _ in self.B[0])

    @property
    def asked(self) -> range:
        """The steps whose beliefs are asked for: all, or as many of the last as there are letters for."""
        first, parts = len(self.steps) + 1, 0
        for event in reversed(self.steps):
            parts += (1 if self.on_a_line else 2) + (event.z is not None) * (1 if self.on_a_line else 3)
            if parts > LETTERS:
                break
            first -= 1
        return range(first, len(self.steps) + 1)

    @property
    def on_a_line(self) -> bool:
        """Whether the state is a position that is moved and measured itself."""
        return len(self.mean) == 1 and self.A == self.B == self.C == _ONE


_BOTH, _MOVE = True, False
#: The greatest numerator or denominator of a mean or variance, by level.
_MOST = {1: 60, 2: 50, 3: 60}


def draw(level: int, rng: Draws) -> Given:
    """One step on a line; two, perhaps without a measurement or commands; a velocity, or the variance of a noise."""
    if level == 3 and rng.chance(Fraction(1, 2)):
        return _with_velocity(rng)
    shapes = {1: ((_BOTH,),), 2: ((_BOTH, _BOTH), (_MOVE, _BOTH), (_BOTH, _MOVE)), 3: ((_BOTH,),)}
    driven = level != 2 or rng.chance(Fraction(3, 4))
    while True:
        mean = rng.whole(0, 9)
        variance, process, sensor = map(Fraction, rng.choice(_handy()))
        place, steps = mean, []
        for measured in rng.choice(shapes[level]):
            u = rng.nonzero(-3, 6) if driven else Fraction(0)
            place += u
            z = place + rng.nonzero(-4, 4)
            if z == mean:  # the one must not pass for the other
                z += 5
            steps.append(Event(u=((u,),) if driven else None, z=((z,),) if measured else None))
        beliefs = _beliefs((mean, variance), process, sensor, steps)
        numbers = [number for belief in beliefs for number in belief]
        if max(max(abs(number.numerator), number.denominator) for number in numbers) <= _MOST[level]:
            break
    open_ = rng.choice(("process", "sensor")) if level == 3 else ""
    return Given(
        mean=((mean,),),
        covariance=((variance,),),
        process=((Parameter("w") if open_ == "process" else process,),),
        sensor=((Parameter("w") if open_ == "sensor" else sensor,),),
        steps=tuple(steps),
        variance=beliefs[-1][1] if open_ else None,
    )


def _with_velocity(rng: Draws) -> Given:
    """A position and a velocity, of which the first is measured; with a command, or without."""
    driven = rng.chance(Fraction(1, 2))
    u = ((rng.nonzero(-2, 2),),) if driven else None
    place, velocity = rng.whole(0, 5), rng.nonzero(-2, 3)
    z = rng.whole(2, 12)
    while z in (place, place + velocity):  # a measurement as it was predicted changes nothing
        z += 1
    return Given(
        mean=((place,), (velocity,)),
        covariance=diagonal(rng.whole(1, 4), rng.whole(1, 3)),
        A=((_1, _1), (_0, _1)),
        **({"B": ((_0,), (_1,))} if driven else {}),
        C=((_1, _0),),
        process=diagonal(rng.whole(1, 2), rng.whole(1, 2)),
        sensor=((rng.whole(1, 4),),),
        steps=(Event(u=u, z=((z,),)),),
    )


Belief = tuple[Fraction, Fraction]


def _beliefs(belief: Belief, process: Fraction, sensor: Fraction, steps: Sequence[Event]) -> list[Belief]:
    """Means and variances on a line, after every motion and measurement."""
    (mean, variance), beliefs = belief, []
    for event in steps:
        mean, variance = mean + (event.u[0][0] if event.u else 0), variance + process
        beliefs.append((mean, variance))
        if event.z is not None:
            gain = variance / (variance + sensor)
            mean, variance = mean + gain * (event.z[0][0] - mean), (1 - gain) * variance
            beliefs.append((mean, variance))
    return beliefs


@cache
def _handy() -> tuple[tuple[int, int, int], ...]:
    """Variances of the belief, the motion and the sensor that give a whole variance after the first measurement."""
    return tuple(
        (before, process, sensor)
        for before in range(1, 9)
        for process in range(1, 7)
        for sensor in range(1, 13)
        if before + process != sensor
        and len({before, process, sensor}) == 3
        and (before + process) * sensor % (before + process + sensor) == 0
    )


def question(given: Given) -> Question:
    """The models and the steps; the belief after every motion and every measurement."""
    blocks = _line(given) if given.on_a_line else _models(given)
    if given.variance is not None:
        noise = "motion" if isinstance(given.process[0][0], Parameter) else "sensor"
        ask = f"The variance after the measurement is $Σ_1 = {shown(given.variance)}$. What is the variance $w$ of the "
        mean = Part("What is the mean $μ_1$ after the measurement?", Number(), zero=True)
        return Question((*blocks, _steps(given)), (Part(f"{ask}{noise}'s noise?", Number()), mean))
    parts: list[Part] = []
    for time in given.asked:
        for ask, kind in _wanted(given, time, given.steps[time - 1]):
            parts.append(Part(ask, kind, zero=True))
    left_out = given.asked[0] - 1
    told = f"What comes out is asked for from step ${left_out + 1}$ on."
    return Question((*blocks, _steps(given), *([Paragraph(told)] if left_out else [])), tuple(parts))


def _steps(given: Given) -> Table:
    """Commands and measurements, a column for every step, or a row where they are many."""
    lines = [("$t$", *(f"${time}$" for time in range(1, len(given.steps) + 1)))]
    if given.driven:
        lines.append(("$u_t$", *(_column(given.command(event)) for event in given.steps)))
    lines.append(("$z_t$", *("–" if event.z is None else _column(event.z) for event in given.steps)))
    header, *rows = lines if len(given.steps) < _WIDE else zip(*lines, strict=True)
    return Table(header=header, rows=tuple(rows))


def _column(vector: Rows) -> str:
    numbers = ", ".join(shown(line[0]) for line in vector)
    return f"${numbers}$" if len(vector) == 1 else f"$({numbers})$"


def _line(given: Given) -> tuple[Block, ...]:
    mean, variance, process, sensor = (
        shown(rows[0][0]) for rows in (given.mean, given.covariance, given.process, given.sensor)
    )
    moves = "it first moves by $u_t$ plus" if given.driven else "its position first changes by"
    return (
        Paragraph(
            f"A robot's belief about its position on a line is normal with mean $μ_0 = {mean}$ and variance "
            f"$Σ_0 = {variance}$. In every step {moves} normal noise of variance "
            f"$R = {process}$; then it measures its position as $z_t$, with normal noise of variance $Q = {sensor}$. "
            f"All noises are independent, with mean $0$.{_unmeasured(given)}"
        ),
    )


def _unmeasured(given: Given) -> str:
    """What a dash stands for."""
    return " Where $z_t$ is –, nothing is measured." if any(event.z is None for event in given.steps) else ""


def _models(given: Given) -> tuple[Block, ...]:
    named = (
        ("A", given.A), *((("B", given.B),) if given.driven else ()), ("R", given.process), ("C", given.C),
        ("Q", given.sensor), ("μ_0", given.mean), ("Σ_0", given.covariance),
    )  # fmt: skip
    driven = " + B u_t" if given.driven else ""
    size = len(given.mean)
    moves = size == 2 and all(given.A[i][j] == value for i, j, value in ((0, 0, 1), (1, 0, 0), (1, 1, 1)))
    told = (
        "A robot's state is its position and its velocity"
        if moves and given.A[0][1] != 0
        else f"A robot's state has {size} component{'s' * (size > 1)}"
    )
    return (
        Paragraph(
            f"{told}. In every step it becomes $x_t = A x_{{t−1}}{driven} + ε_t$, and $z_t = C x_t + δ_t$ is measured. "
            "The noises $ε_t$ and $δ_t$ are normal and independent, with mean $0$ and covariances $R$ and $Q$. The "
            f"first belief is normal, with mean $μ_0$ and covariance $Σ_0$.{_unmeasured(given)}"
        ),
        *(Equation(mathematics(name), (tabular(rows),), ("=",), linear=True) for name, rows in named),
    )


_CALLED = ("mean", "variance")


def _wanted(given: Given, time: int, event: Event) -> list[tuple[str, Numbers | Matrix]]:
    after = f"after the motion of step ${time}${', before the measurement' if event.z is not None else ''}"
    if given.on_a_line:
        ahead = Numbers((f"μ\u0304_{{{time}}}", f"Σ\u0304_{{{time}}}"), called=_CALLED)
        wanted: list[tuple[str, Numbers | Matrix]] = [(f"What are the mean and the variance {after}?", ahead)]
        if event.z is not None:
            entries = Numbers((f"μ_{{{time}}}", f"Σ_{{{time}}}"), called=_CALLED)
            wanted.append((f"What are the mean and the variance after the measurement $z_{{{time}}}$?", entries))
        return wanted
    n = len(given.mean)
    wanted = [
        (f"What is the mean $μ\u0304_{{{time}}}$ {after}?", Matrix(n, 1)),
        (f"What is the covariance $Σ\u0304_{{{time}}}$ {after}?", Matrix(n, n)),
    ]
    if event.z is not None:
        wanted += [
            (f"What is the Kalman gain $K_{{{time}}}$?", Matrix(n, len(given.C))),
            (f"What is the mean $μ_{{{time}}}$ after the measurement?", Matrix(n, 1)),
            (f"What is the covariance $Σ_{{{time}}}$ after the measurement?", Matrix(n, n)),
        ]
    return wanted
