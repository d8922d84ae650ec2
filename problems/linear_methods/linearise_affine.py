"""The constant term C of a linearisation, and the matrices that pull it into the state."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.draws import Draws
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.parts import Matrix, Part
from rldrill.problems.robots import Entries, System, discretised, drawn_robot, situation, values_of

TITLE = "Linearisation with a constant term"
SOURCE = "Åström & Murray 2008, section 5.4"
REVISION = 5
#: An operating point has all coordinates; what is linear in them cancels in C. Entries say what is asked.
DISTRACTORS = ("state.*", "action.*", "entries.*")


class Given(System):
    """A system with its Euler step; asked for are C and the matrices for the state (s, 1), or entries of them."""

    entries: Entries | None = Field(default=None, description="The entries that are asked for; all, if left out.")

    @model_validator(mode="after")
    def _steps(self) -> Self:
        if self.step is None:
            raise ValueError("step is missing: the 1 that is added to the state stays 1 from one time to the next")
        if self.entries is not None:
            self.entries.check(len(self.state) + 1, len(self.action))
        return self


def draw(level: int, rng: Draws) -> Given:
    """One tank; then two states; then a robot on wheels."""
    step = rng.fraction("1/2", "1") if level < 3 else rng.fraction("1/10", "1/5", "1/2")
    robot = drawn_robot(rng, "affine", level)
    system = values_of(rng, robot)
    if level == 1:
        return Given(**system, step=step)
    A = robot.varying["A"]
    entries = Entries(A=A) if len(A) > 1 and rng.chance(Fraction(1, 2)) else Entries(**robot.varying)
    return Given(**system, step=step, entries=entries)


def question(given: Given) -> Question:
    """The system and its operating point; C, then both matrices."""
    n, m = len(given.state), len(given.action)
    then = (
        f"{discretised(given)} The linearisation of $F$ at the operating point is multiplied out, "
        "$F(s, a) ≈ A_Δ s + B_Δ a + C$. Then $C$ is made part of the state: with $s̃_t = (s_t, 1)^⊤$ it reads "
        "$s̃_{t+1} = Ã s̃_t + B̃ a_t$."
    )
    return Question(
        tuple(situation(given, then)),
        (Part("What is $C$?", Matrix(n, 1)), *_matrices(given, n, m)),
    )


def _matrices(given: Given, n: int, m: int) -> list[Part]:
    if given.entries is not None:
        return [*given.entries.part("A", "Ã"), *given.entries.part("B", "B̃")]
    return [
        Part("What is the matrix $Ã$?", Matrix(n + 1, n + 1)),
        Part("What is the matrix $B̃$?", Matrix(n + 1, m)),
    ]
