"""The matrices A and B of a robot's dynamics, linearised at an operating point."""

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import shown
from rldrill.problems.family import Question
from rldrill.problems.parts import Matrix, Part
from rldrill.problems.robots import System, draw_system, situation

TITLE = "Linearisation"
SOURCE = "Åström & Murray 2008, section 5.4"
REVISION = 1


class Given(System):
    """A system; what is asked for are A and B, of its Euler step if it has one."""


def draw(level: int, rng: Draws) -> Given:
    """A pendulum or a tank; then wheels, friction or two tanks; then an Euler step of a larger robot."""
    step = rng.fraction("1/10", "1/5", "1/2", "1/100") if level == 3 else None
    return Given(**draw_system(rng, "linearise", level), step=step)


def question(given: Given) -> Question:
    """The system and its operating point; both matrices."""
    if given.step is None:
        about = Paragraph('Near the operating point, $f(s, a) ≈ f("s̄", "ā") + A (s − "s̄") + B (a − "ā")$.')
        names = "A", "B"
    else:
        about = Paragraph(
            f"Time is discretised by an Euler step: $s_{{t+1}} = F(s_t, a_t) = s_t + Δ t f(s_t, a_t)$ with "
            f"$Δ t = {shown(given.step)}$. Near the operating point, "
            '$F(s, a) ≈ F("s̄", "ā") + A_Δ (s − "s̄") + B_Δ (a − "ā")$.'
        )
        names = "A_Δ", "B_Δ"
    n, m = len(given.state), len(given.action)
    return Question(
        (*situation(given), about),
        (
            Part("a", f"What is the matrix ${names[0]}$?", Matrix(n, n), points=2),
            Part("b", f"What is the matrix ${names[1]}$?", Matrix(n, m), points=2),
        ),
    )
