"""The matrices A and B of a robot's dynamics, linearised at an operating point."""

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.family import Question
from rldrill.problems.parts import Matrix, Part
from rldrill.problems.robots import System, discretised, draw_system, situation

TITLE = "Linearisation"
SOURCE = "Åström & Murray 2008, section 5.4"
REVISION = 2


class Given(System):
    """A system; what is asked for are A and B, of its Euler step or zero-order hold if it has one."""


def draw(level: int, rng: Draws) -> Given:
    """A pendulum or a tank; then wheels, friction or two tanks; then an Euler step of a larger robot."""
    step = rng.fraction("1/10", "1/5", "1/2", "1/100") if level == 3 else None
    return Given(**draw_system(rng, "linearise", level), step=step)


def question(given: Given) -> Question:
    """The system and its operating point; both matrices."""
    f, A, B = ("f", "A", "B") if given.step is None else ("F", "A_Δ", "B_Δ")
    near = Paragraph(f"Near the operating point, ${f}(s, a) ≈ {f}(s̄, ā) + {A} (s − s̄) + {B} (a − ā)$.")
    n, m = len(given.state), len(given.action)
    return Question(
        (*situation(given), *((discretised(given),) if given.step else ()), near),
        (
            Part(f"What is the matrix ${A}$?", Matrix(n, n)),
            Part(f"What is the matrix ${B}$?", Matrix(n, m)),
        ),
    )
