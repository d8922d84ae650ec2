"""One backward step of differential dynamic programming: the quadratic Q, and the change of the action."""

from collections.abc import Mapping
from typing import Annotated, Any, Self

from pydantic import Field, model_validator

from rldrill.problems.angles import Angle, AngleField, read_angle, text
from rldrill.problems.document import Beside, Equation, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact
from rldrill.problems.expressions import Expression, letter, letters
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.mathematics import mathematics
from rldrill.problems.matrices import MatrixField, check_shape, check_symmetric, tabular
from rldrill.problems.names import once
from rldrill.problems.parts import Matrix, Part
from rldrill.problems.robots import (
    Letter,
    Lettered,
    Robot,
    System,
    column,
    drawn_robot,
    letter_values,
    plan,
    radians,
    slope,
    values_of,
    worth,
)

TITLE = "Backward step of DDP"
SOURCE = "Tassa, Erez & Todorov 2012"
REVISION = 7
_LEFT_OUT = "Left out here, where the dynamics give the next state itself: it is for rates of change."


class Given(System):
    """A system of which the dynamics give the next state, its reward, and the value of the next state.

    ``gradient`` and ``hessian`` are the next value's at the next state. With ``second_order`` the second
    derivatives of the dynamics count (DDP), without they do not (iLQR).
    """

    dynamics: Lettered[Expression] = Field(
        min_length=1, max_length=6, description="For every letter of the state its next value, not its rate of change."
    )
    where: Lettered[Expression] = Field(
        default_factory=dict, max_length=8, description=_LEFT_OUT, examples=[{"D": "m_c + m_p"}]
    )
    step: Exact | None = Field(default=None, description=_LEFT_OUT, examples=["1/10"])
    reward: Expression = Field(description="The reward, in the letters of the state and the action.")
    gradient: tuple[Exact, ...] = Field(
        min_length=1, max_length=6, description="The gradient of the next value at the next state."
    )
    hessian: MatrixField = Field(description="The Hessian of the next value at the next state.")
    second_order: bool = Field(
        default=True, description="Whether the second derivatives of the dynamics count (DDP) or not (iLQR)."
    )
    reached: Annotated[dict[Letter, AngleField], Field(max_length=6), once(letter)] | None = Field(
        default=None,
        description="A state near the operating point, for which the action is asked for.",
        examples=[{"v": "3/2"}],
    )

    @model_validator(mode="after")
    def _next(self) -> Self:
        if self.step is not None or self.where:
            raise ValueError("the dynamics give the next state itself here; leave out 'step' and 'where'")
        known = {*self.state, *self.action, *self.constants}
        if unknown := [name for name in letters(self.reward) if name not in known]:
            raise ValueError(f"the reward holds {unknown[0]!r}, which has no value; give it one")
        n = len(self.state)
        if len(self.gradient) != n:
            raise ValueError(f"gradient has {len(self.gradient)} entries, but the state {n}; give as many")
        check_shape("hessian", self.hessian, n, n, f"with {n} states ")
        check_symmetric("hessian", self.hessian)
        if self.reached is not None and set(self.reached) != set(self.state):
            raise ValueError("reached must have the letters of the state")
        return self


def draw(level: int, rng: Draws) -> Given:
    """A step of iLQR; then of DDP, and what it does in a state beside the operating point; then two states."""
    robot = drawn_robot(rng, "ddp", level)
    while True:
        system = values_of(rng, robot)
        missing = _missing(robot, system)
        if all(missing.values()) and not _settles(robot, system):
            break
    n = len(system["state"])
    steepest = 3 if level < 3 else 7
    hessian = tuple(tuple(-rng.whole(1, steepest) if i == j else Fraction(0) for j in range(n)) for i in range(n))
    gradient = []
    for name in robot.dynamics:
        steep = rng.whole(1, steepest)
        rises = missing[name] > 0 if name in missing else rng.chance(Fraction(1, 2))
        gradient.append(steep if rises else -steep)
    second_order = level == 2 or (level == 3 and rng.chance(Fraction(3, 4)))
    if level == 2 and rng.chance(Fraction(1, 2)):
        aside = rng.fraction("-1/2", "1")
        system["reached"] = {name: Angle(value.number + aside) for name, value in system["state"].items()}
    return Given(**system, gradient=tuple(gradient), hessian=hessian, second_order=second_order)


def _missing(robot: Robot, system: Mapping[str, Any]) -> dict[str, float]:
    """By how much the next state falls short of what is wanted of it; its value rises towards that."""
    letters_ = letter_values(system)
    short = {}
    for name, wanted in robot.wanted.items():
        aim = letters_[wanted] if wanted in letters_ else radians(read_angle(wanted))
        short[name] = round((aim - worth(robot.dynamics[name], letters_)).real, 9)
    return short


def _settles(robot: Robot, system: Mapping[str, Any]) -> bool:
    """Whether the one state has no influence on the next one, so that most derivatives are 0."""
    if len(robot.dynamics) > 1:
        return False
    ((name, rate),) = robot.dynamics.items()
    return abs(slope(rate, name, system)) < 1e-9


def question(given: Given) -> Question:
    """The system and the next value; all derivatives of Q, then k and K."""
    n, m = len(given.state), len(given.action)
    kept = (
        "in a step of DDP: the second derivatives of $f$ count"
        if given.second_order
        else "in a step of iLQR: the second derivatives of $f$ are left out"
    )
    hessian = "second derivative" if n == 1 else "Hessian"
    wanted = (
        (f"{_first(n)} $Q_s$", n, 1), (f"{_first(m)} $Q_a$", m, 1), (f"{_second(n, n)} $Q_{{s s}}$", n, n),
        (f"{_second(m, n)} $Q_{{a s}}$", m, n), (f"{_second(m, m)} $Q_{{a a}}$", m, m),
        ("constant term $k$ of the change of the action", m, 1), ("gain $K$", m, n),
    )  # fmt: skip
    known = f"At $f(s̄, ā)$ the value $V′$ of the next state has this {_first(n)} and this {hessian}:"
    return Question(
        (
            *plan(given, given.reward, known),
            Beside(
                (
                    Equation(mathematics("V′_s"), (tabular(tuple((entry,) for entry in given.gradient)),), ("=",)),
                    Equation(mathematics("V′_{s s}"), (tabular(given.hessian),), ("=",)),
                )
            ),
            Paragraph(
                f"$Q(s, a) = r(s, a) + V′(f(s, a))$ is expanded to second order around the operating point, {kept}. "
                "The best action is then $a = ā + k + K (s − s̄)$."
            ),
        ),
        (
            *(Part(f"What is the {what}?", Matrix(rows, columns)) for what, rows, columns in wanted),
            *_action_asked(given),
        ),
    )


def _action_asked(given: Given) -> tuple[Part, ...]:
    if given.reached is None:
        return ()
    state = column(text(given.reached[name]) for name in given.states)
    return (Part(f"Which action $a$ is the best one in the state $s = {state}$?", Matrix(len(given.action), 1)),)


def _first(count: int) -> str:
    """What a first derivative is called."""
    return "derivative" if count == 1 else "gradient"


def _second(rows: int, columns: int) -> str:
    """What second derivatives are called."""
    return "second derivative" if rows == columns == 1 else "matrix"
