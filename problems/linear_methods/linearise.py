"""The matrices A and B of a robot's dynamics, linearised at an operating point."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.parts import Matrix, Numbers, Part
from rldrill.problems.robots import Entries, System, discretised, drawn_robot, situation, values_of

TITLE = "Linearisation"
SOURCE = "Åström & Murray 2008, section 5.4"
REVISION = 9
#: An operating point and a deviation have all coordinates; on which of them the derivatives depend is for the reader to
#: find out. Entries say what is asked.
DISTRACTORS = ("state.*", "action.*", "deviation.*", "entries.*")


class Given(System):
    """A system; what is asked for are A and B, of its Euler step or zero-order hold if it has one.

    With ``entries`` only these are asked for. With a deviation of state and action from the operating point, it is
    asked by how much the rates, or the next state, change to first order.
    """

    entries: Entries | None = Field(default=None, description="The entries that are asked for; all, if left out.")
    deviation: tuple[Exact, ...] | None = Field(
        default=None,
        max_length=10,
        description="How far state and action are from the operating point, in the order of their letters.",
        examples=[["1/10", 0, "-1/5"]],
    )

    @model_validator(mode="after")
    def _asked(self) -> Self:
        if self.entries is not None:
            self.entries.check(len(self.state), len(self.action))
        if self.deviation is not None and len(self.deviation) != len(self.state) + len(self.action):
            raise ValueError("deviation: give a number for every letter of the state and of the action")
        return self


def draw(level: int, rng: Draws) -> Given:
    """A pendulum or a tank; then wheels, friction or two tanks; then an Euler step of a larger robot."""
    step = rng.fraction("1/10", "1/5", "1/2") if level == 3 else None
    robot = drawn_robot(rng, "linearise", level)
    system = values_of(rng, robot)
    if level == 1:
        return Given(**system)
    count = len(system["state"]) + len(system["action"])
    moved = level == 3 or rng.chance(Fraction(1, 2))
    sizes = ("1/5", "-1/5", "2/5", "-2/5") if level == 3 else ("1/2", "-1/2")
    deviation = tuple(rng.fraction(*sizes) for _ in range(count)) if moved else None
    return Given(**system, step=step, entries=Entries(**robot.varying), deviation=deviation)


def question(given: Given) -> Question:
    """The system and its operating point; both matrices, and how the system answers to a deviation."""
    f, A, B = ("f", "A", "B") if given.step is None else ("F", "A_Δ", "B_Δ")
    near = f"Near the operating point, ${f}(s, a) ≈ {f}(s̄, ā) + {A} (s − s̄) + {B} (a − ā)$."
    said = near if given.step is None else f"{discretised(given)} {near}"
    n, m = len(given.state), len(given.action)
    if given.entries is not None:
        parts = [*given.entries.part("A", A), *given.entries.part("B", B)]
    else:
        of = "" if n == m == 1 else "the matrix "
        parts = [Part(f"What is {of}${A}$?", Matrix(n, n)), Part(f"What is {of}${B}$?", Matrix(n, m))]
    if given.deviation is not None:
        s, a = (_column(numbers) for numbers in (given.deviation[:n], given.deviation[n:]))
        ask = (
            f"For $δ s = s − s̄ = {s}$ and $δ a = a − ā = {a}$, what is $δ {f} = {f}(s, a) − {f}(s̄, ā)$, to first order?"
        )
        parts.append(Part(ask, Numbers(tuple(f"δ {f}_{index}" for index in range(1, n + 1))), zero=True))
    return Question(tuple(situation(given, said)), tuple(parts))


def _column(numbers: tuple[Fraction, ...]) -> str:
    inside = ", ".join(map(shown, numbers))
    return f"({inside})^⊤" if len(numbers) > 1 else inside
