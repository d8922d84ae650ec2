"""The constant term C of a linearisation, and the matrices that pull it into the state."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.draws import Draws
from rldrill.problems.family import Question
from rldrill.problems.parts import Matrix, Part
from rldrill.problems.robots import Entries, System, discretised, drawn_robot, situation, values_of

TITLE = "Linearisation with a constant term"
SOURCE = "Åström & Murray 2008, section 5.4"
REVISION = 6
#: An operating point has all coordinates; what is linear in them cancels in C. Entries say what is asked.
DISTRACTORS = ("state.*", "action.*", "entries.*")


class Given(System):
    """A system with its Euler step; asked for are C and the matrices for the state (s, 1).

    With ``entries`` those of the step's matrices are asked for first, then C, and what is new in the larger matrix.
    """

    entries: Entries | None = Field(
        default=None, description="The entries of A_Δ and B_Δ that are asked for; the larger matrices, if left out."
    )

    @model_validator(mode="after")
    def _steps(self) -> Self:
        if self.step is None:
            raise ValueError("step is missing: the 1 that is added to the state stays 1 from one time to the next")
        if self.entries is not None:
            self.entries.check(len(self.state), len(self.action))
        return self


def draw(level: int, rng: Draws) -> Given:
    """One tank; then two states; then a robot on wheels."""
    step = rng.fraction("1/2", "1") if level < 3 else rng.fraction("1/10", "1/5", "1/2")
    robot = drawn_robot(rng, "affine", level)
    system = values_of(rng, robot)
    if level == 1:
        return Given(**system, step=step)
    return Given(**system, step=step, entries=Entries(**robot.varying))


def question(given: Given) -> Question:
    """The system and its operating point; entries of its step, or none; C; the larger matrices, or what is new."""
    n, m = len(given.state), len(given.action)
    moved = "B̃ a_t" if given.entries is None else "(B_Δ a_t, 0)^⊤"
    then = (
        f"{discretised(given)} The linearisation of $F$ at the operating point is multiplied out, "
        "$F(s, a) ≈ A_Δ s + B_Δ a + C$. Then the constant $1$ is made part of the state, $s̃_t = (s_t, 1)^⊤$, and $C$ "
        f"part of a column of $Ã$, so that $s̃_{{t+1}} = Ã s̃_t + {moved}$."
    )
    constant = Part("What is $C$?", Matrix(n, 1))
    if given.entries is not None:
        steps = (*given.entries.part("A", "A_Δ"), *given.entries.part("B", "B_Δ"))
        parts = (*steps, constant, Part(f"What is column ${n + 1}$ of $Ã$?", Matrix(n + 1, 1)))
    else:
        larger = Part("What is the matrix $Ã$?", Matrix(n + 1, n + 1))
        parts = (constant, larger, Part("What is the matrix $B̃$?", Matrix(n + 1, m)))
    return Question(tuple(situation(given, then)), parts)
