"""Value matrices and gains of a finite horizon, backwards in time, and the first action."""

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter
from rldrill.problems.family import Question
from rldrill.problems.linear_quadratic import LinearQuadratic, draw_system, situation
from rldrill.problems.parts import Matrix, Part
from rldrill.problems.phrases import in_open

TITLE = "LQR over a finite horizon"
SOURCE = "Bertsekas 2017, section 3.1"
REVISION = 2


class Given(LinearQuadratic):
    """A system; what is asked for are P and L of all times before the horizon, and the first action."""


def draw(level: int, rng: Draws) -> Given:
    """One step back with numbers; then two; then two with two states, or with the price of the action open."""
    left_open = level == 3 and rng.chance(rng.fraction("1/2"))
    states = 2 if level == 3 and not left_open else 1
    price = Parameter("rho") if left_open else rng.whole(1, 3)
    start = tuple(rng.nonzero(-3, 4) for _ in range(states))
    return Given(**draw_system(rng, states, price), start=start, horizon=1 if level == 1 else 2)


def question(given: Given) -> Question:
    """Gain and value matrix of every time, the last first; then the action."""
    n, m, last = len(given.start), given.actions, given.horizon
    wanted = []
    for time in range(last - 1, -1, -1):
        action, value = f"a_{{{time}}} = −L_{{{time}}} s_{{{time}}}", f"V_{{{time}}}(s) = s^⊤ P_{{{time}}} s"
        wanted += [
            (f"What is the gain $L_{{{time}}}$ of the best action ${action}$", Matrix(m, n), 2),
            (f"What is the matrix $P_{{{time}}}$ of the value ${value}$", Matrix(n, n), 2),
        ]
    wanted.append(("What is the best first action $a_0$", Matrix(m, 1), 1))
    return Question(
        (
            *situation(given),
            Paragraph(
                f"The rewards of the times $0$ to ${last}$ are added, without a discount, and the sum is to be as "
                f"large as possible. $V_t(s) = s^⊤ P_t s$ is the largest sum from time $t$ on, so $P_t$ is "
                f"{'not positive' if n == m == 1 else 'negative semidefinite'}. At time ${last}$ the best action "
                "is $0$."
            ),
        ),
        tuple(Part(ask + in_open(given) + "?", kind, points, zero=n > 1) for ask, kind, points in wanted),
    )
