"""The Riccati equation of larger systems, which has no closed form: doubling, in rational arithmetic.

No library for floating point is needed for it, and the answer is as exact as its decimals say.
"""

from typing import NamedTuple

from flint import fmpq

from rldrill.solutions.exact import NoSolution
from rldrill.solutions.matrices import AnyMatrix, identity, matrix

_BITS = 200
_NO_MATTER = "some action costs nothing and changes nothing that does, so no single one is the best"
#: What is smaller has come to rest.
_AT_REST = fmpq(1, 2 ** (_BITS - 40))
#: So often a matrix is squared that tells whether a state comes to rest: some 10⁹ steps.
_SQUARINGS = 30
_DOUBLINGS = 40


class Regulator(NamedTuple):
    """A system with the costs sᵀQs + 2sᵀNa + aᵀRa, those of every time counted γ times less than before."""

    A: AnyMatrix
    B: AnyMatrix
    Q: AnyMatrix
    R: AnyMatrix
    N: AnyMatrix
    gamma: fmpq

    def gain(self, S: AnyMatrix) -> AnyMatrix:
        """The best gain, if S is the next state's cost-to-go."""
        ahead = self.B.transpose() * S * self.gamma
        return (self.R + ahead * self.B).inv() * (ahead * self.A + self.N.transpose())

    def before(self, S: AnyMatrix) -> AnyMatrix:
        """The cost-to-go one time earlier."""
        ahead = self.A.transpose() * S * self.gamma
        return self.Q + ahead * self.A - (ahead * self.B + self.N) * self.gain(S)

    def charged_ahead(self) -> "Regulator":
        """The same, but the cost of a state is charged to the action that leads to it: what then is left of S − Q."""
        ahead, beside = self.A.transpose() * self.Q * self.gamma, self.B.transpose() * self.Q * self.gamma
        return self._replace(Q=ahead * self.A, R=self.R + beside * self.B, N=self.N + ahead * self.B)

    def uncrossed(self) -> "Regulator | None":
        """The same for what is added to the action −R⁻¹Nᵀs, with no cross term; None where R is singular."""
        try:
            back = self.R.inv() * self.N.transpose()
        except ZeroDivisionError:
            return None
        return self._replace(A=self.A - self.B * back, Q=self.Q - self.N * back, N=self.N * 0)


def stationary(regulator: Regulator) -> AnyMatrix:
    """The stabilising cost-to-go matrix, to some fifty digits.

    Where R is singular, the states' costs are charged to earlier actions until every action has a price of its own.

    Raises:
        NoSolution: the cost-to-go grows without end, or stays but does not make the system stable; or some action
            never matters.
    """
    priced, charged = regulator, regulator.Q * 0
    for _ in range(regulator.A.nrows() + 1):
        if (uncrossed := priced.uncrossed()) is not None:
            return _checked(regulator, charged + _doubled(uncrossed))
        charged, priced = charged + priced.Q, priced.charged_ahead()
    raise NoSolution(_NO_MATTER)


def _doubled(regulator: Regulator) -> AnyMatrix:
    """The cost-to-go of a system without a cross term, in which every action has a price.

    The structure-preserving doubling algorithm (Chu, Fan, Lin & Wang 2004) for √γ A and √γ B: after k rounds it has
    the cost-to-go of a horizon of 2ᵏ steps. A stands twice in every product, so that the first one takes γ.
    """
    F, B, H, R, _, gamma = regulator
    try:
        G = B * R.inv() * B.transpose() * gamma
        for _ in range(_DOUBLINGS):
            W = (identity(F.nrows()) + G * H).inv()
            step = F.transpose() * H * W * F * gamma
            F, G, H = map(_short, (F * W * F * gamma, G + F * W * G * F.transpose() * gamma, H + step))
            gamma = fmpq(1)
            if _largest(step) < _AT_REST:
                return H
            if _largest(H) > 2**_BITS:
                break
    except ZeroDivisionError:
        pass
    raise NoSolution("the cost-to-go grows without end, since no action keeps the system from running away")


def _checked(regulator: Regulator, S: AnyMatrix) -> AnyMatrix:
    try:
        closed = regulator.A - regulator.B * regulator.gain(S)
    except ZeroDivisionError:
        raise NoSolution(_NO_MATTER) from None
    closed = _short(closed * closed * regulator.gamma)
    for _ in range(_SQUARINGS):
        if _largest(closed) < _AT_REST:
            return S
        if _largest(closed) > 2**_BITS:
            break
        closed = _short(closed * closed)
    raise NoSolution(
        "under the policy that costs least the state does not come to rest: what it does costs nothing there, or no "
        "action reaches it"
    )


def _short(value: AnyMatrix) -> AnyMatrix:
    """Entries rounded to ``_BITS`` bits behind the point."""
    return matrix([fmpq(round(entry * 2**_BITS), 2**_BITS) for entry in line] for line in value.tolist())


def _largest(value: AnyMatrix) -> fmpq:
    entries: list[fmpq] = value.entries()
    return max(map(abs, entries))
