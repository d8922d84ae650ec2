"""Value matrices and gains of a finite horizon, backwards in time, and the first action."""

from rldrill.problems.document import Block, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter
from rldrill.problems.family import Question
from rldrill.problems.linear_quadratic import Conventional, LinearQuadratic, costs, draw_system, situation
from rldrill.problems.parts import LETTERS, Matrix, Part
from rldrill.problems.phrases import in_open

TITLE = "LQR over a finite horizon"
SOURCE = "Bertsekas 2017, section 3.1"
REVISION = 2


class Given(LinearQuadratic, Conventional):
    """A system; what is asked for are P and L of all times before the horizon, and the first action."""

    @property
    def asked(self) -> range:
        """The times whose matrices are asked for, the last first: as many of the first as there are letters for."""
        return range(min(self.horizon, (LETTERS - 1) // 2) - 1, -1, -1)


def draw(level: int, rng: Draws) -> Given:
    """One step back with numbers; then two; then two with two states, or with the price of the action open."""
    left_open = level == 3 and rng.chance(rng.fraction("1/2"))
    states = 2 if level == 3 and not left_open else 1
    price = Parameter("rho") if left_open else rng.whole(1, 3)
    start = tuple(rng.nonzero(-3, 4) for _ in range(states))
    return Given(**draw_system(rng, states, price), start=start, horizon=1 if level == 1 else 2)


def question(given: Given) -> Question:
    """Gain and value matrix of every time, the last first; then the action."""
    n, m = len(given.start), given.actions
    x, u, L, P, in_costs = given.notation
    wanted = []
    for time in given.asked:
        action = f"{u}_{{{time}}} = −{L}_{{{time}}} {x}_{{{time}}}"
        value = f"{x}^⊤ {P}_{{{time}}} {x}" if in_costs else f"V_{{{time}}}({x}) = {x}^⊤ {P}_{{{time}}} {x}"
        wanted += [
            (f"What is the gain ${L}_{{{time}}}$ of the best action ${action}$", Matrix(m, n), 2),
            (f"What is the matrix ${P}_{{{time}}}$ of the {'cost-to-go' if in_costs else 'value'} ${value}$",
             Matrix(n, n), 2),
        ]  # fmt: skip
    wanted.append((f"What is the best first action ${u}_0$", Matrix(m, 1), 1))
    blocks = _plain(given) if given.plain and not in_costs else _costs(given)
    if len(given.asked) < given.horizon:
        first = f"Only the first {len(given.asked)} of the {given.horizon} times are asked for"
        blocks = (*blocks, Paragraph(f"{first}; the recursion begins at the horizon all the same."))
    return Question(blocks, tuple(Part(ask + in_open(given) + "?", kind, points, zero=n > 1)
                                  for ask, kind, points in wanted))  # fmt: skip


def _plain(given: Given) -> tuple[Block, ...]:
    last = given.horizon
    return (
        *situation(given),
        Paragraph(
            f"The rewards of the times $0$ to ${last}$ are added, without a discount, and the sum is to be as "
            f"large as possible. $V_t(s) = s^⊤ P_t s$ is the largest sum from time $t$ on, so $P_t$ is "
            f"{_signed(given, 'negative')}. At time ${last}$ the best action is $0$."
        ),
    )


def _costs(given: Given) -> tuple[Block, ...]:
    x, u, L, P, in_costs = given.notation
    what, wanted, most, value, sign = (
        ("costs", "small", "smallest", f"{x}^⊤ {P}_t {x}", "positive")
        if in_costs
        else ("rewards", "large", "largest", f"V_t({x}) = {x}^⊤ {P}_t {x}", "negative")
    )
    from_there = "" if given.gamma == 1 else ", discounted to time $t$"
    return (
        *costs(given, given.notation),
        Paragraph(
            f"The sum of all {what} is to be as {wanted} as possible. ${value}$ is the {most} sum from time $t$ "
            f"on{from_there}, so ${P}_t$ is {_signed(given, sign)}; the best action is ${u}_t = −{L}_t {x}_t$."
        ),
    )


def _signed(given: Given, sign: str) -> str:
    if len(given.start) == given.actions == 1:
        return f"not {'positive' if sign == 'negative' else 'negative'}"
    return f"{sign} semidefinite"
