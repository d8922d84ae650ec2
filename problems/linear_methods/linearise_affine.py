"""The constant term C of a linearisation, and the matrices that pull it into the state."""

from collections.abc import Mapping
from typing import Any, Self

from pydantic import Field, model_validator

from rldrill.problems.draws import Draws
from rldrill.problems.family import Question, flag
from rldrill.problems.fractions import Fraction
from rldrill.problems.parts import Matrix, Part
from rldrill.problems.robots import Entries, System, discretised, drawn_robot, situation, slope, values_of

TITLE = "Linearisation with a constant term"
SOURCE = "Åström & Murray 2008, section 5.4"
REVISION = 10
#: An operating point has all coordinates; what is linear in them cancels in C. Entries say what is asked.
DISTRACTORS = ("state.*", "action.*", "entries.*")


class Given(System):
    """A system with its Euler step; asked for are C and the matrices for the state (s, 1).

    With ``entries`` those of the step's matrices are asked for first, then C, and what is new in the larger matrix.
    """

    entries: Entries | None = Field(
        default=None, description="The entries of A_Δ and B_Δ that are asked for; the larger matrices, if left out."
    )

    moved: bool = flag("Whether it is asked, too, where the operating point goes in one step.")

    @model_validator(mode="after")
    def _steps(self) -> Self:
        if self.step is None:
            raise ValueError("step is missing: the 1 that is added to the state stays 1 from one time to the next")
        if self.entries is not None:
            self.entries.check(len(self.state), len(self.action))
        return self


def draw(level: int, rng: Draws) -> Given:
    """One tank; then two states; then a robot on wheels."""
    robot = drawn_robot(rng, "affine", level)
    while True:
        system = values_of(rng, robot)
        if steps := [step for step in _STEPS[level] if _keeps_half(system, step)]:
            break
    if level == 1:
        return Given(**system, step=rng.choice(steps))
    entries = Entries(**robot.varying)
    return Given(**system, step=rng.choice(steps), entries=entries, moved=rng.chance(Fraction(1, 2)))


_STEPS = {
    1: (Fraction(1, 4), Fraction(1, 2), Fraction(1)),
    2: (Fraction(1, 4), Fraction(1, 2), Fraction(1)),
    3: (Fraction(1, 10), Fraction(1, 5), Fraction(1, 2)),
}


def _keeps_half(system: Mapping[str, Any], step: Fraction) -> bool:
    """Whether more than half of every state is left after a step: no tank runs dry, and no state is forgotten."""
    kept = (1 + float(step) * slope(rate, name, system) for name, rate in system["dynamics"].items())
    return all(round(share, 9) > 1 / 2 for share in kept)  # a half is a half on every machine


def question(given: Given) -> Question:
    """The system and its operating point; entries of its step, or none; C; the larger matrices, or what is new."""
    n, m = len(given.state), len(given.action)
    copied = "" if given.entries is None else ", where $B̃$ is $B_Δ$ with a row of zeros below it"
    then = (
        f"{discretised(given)} The linearisation of $F$ at the operating point is multiplied out, "
        "$F(s, a) ≈ A_Δ s + B_Δ a + C$. Then $s̃$ is the state with the constant $1$ below it, and $C$ becomes part of "
        f"a column of $Ã$, so that $s̃_{{t+1}} = Ã s̃_t + B̃ a_t${copied}."
    )
    constant = (
        *([Part("What is $F(s̄, ā)$?", Matrix(n, 1))] if given.moved else []),
        Part("What is $C$?", Matrix(n, 1)),
    )
    if given.entries is not None:
        steps = (*given.entries.part("A", "A_Δ"), *given.entries.part("B", "B_Δ"))
        parts = (*steps, *constant, Part(f"What is column ${n + 1}$ of $Ã$?", Matrix(n + 1, 1)))
    else:
        larger = Part("What is the matrix $Ã$?", Matrix(n + 1, n + 1))
        parts = (*constant, larger, Part("What is the matrix $B̃$?", Matrix(n + 1, m)))
    return Question(tuple(situation(given, then)), parts)
