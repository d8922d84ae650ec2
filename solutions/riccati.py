"""The Riccati equation of larger systems, which has no closed form: doubling, in rational arithmetic.

No library for floating point is needed for it, and the answer is as exact as its decimals say.
"""

from collections.abc import Iterable, Iterator
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
#: So far a state may have run away before what is rounded is seen in what brings it back.
_FAR = 2**60


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
        NoSolution: the cost-to-go grows without end, no policy makes the system stable, or some action never matters.
    """
    priced, charged = regulator, regulator.Q * 0
    for _ in range(regulator.A.nrows() + 1):
        if (uncrossed := priced.uncrossed()) is not None:
            return _stabilising(regulator, (charged + S for S in _solutions(uncrossed)))
        charged, priced = charged + priced.Q, priced.charged_ahead()
    raise NoSolution(_NO_MATTER)


def _stabilising(regulator: Regulator, solutions: Iterable[AnyMatrix]) -> AnyMatrix:
    for S in solutions:
        try:
            gain = regulator.gain(S)
        except ZeroDivisionError:
            raise NoSolution(_NO_MATTER) from None
        if _summed(regulator, gain, S * 0) is not None:
            return S
    raise NoSolution(
        "under the policy that costs least the state does not come to rest: what it does costs nothing there, or no "
        "action reaches it"
    )


def _solutions(regulator: Regulator) -> Iterator[AnyMatrix]:
    """The least cost-to-go of a system without a cross term, in which every action has a price; then the stabilising.

    The structure-preserving doubling algorithm (Chu, Fan, Lin & Wang 2004) for √γ A and √γ B: after k rounds H is
    the cost-to-go of a horizon of 2ᵏ steps, and H + Fᵀ(I + G)⁻¹F that of one with the price sᵀs on its last state,
    which does not let a state run away that costs nothing. A stands twice in every product: the first one takes γ.
    """
    F, B, H, R, _, gamma = regulator
    one = identity(F.nrows())
    brought_to_rest, settled = one, False
    try:
        G = B * R.inv() * B.transpose() * gamma
        for _ in range(_DOUBLINGS):
            W = (one + G * H).inv()
            step = F.transpose() * H * W * F * gamma
            F, G, H = map(_short, (F * W * F * gamma, G + F * W * G * F.transpose() * gamma, H + step))
            gamma = fmpq(1)
            settled, runs = _largest(step) < _AT_REST, _largest(F)
            if runs < _FAR:
                brought_to_rest = H + F.transpose() * (one + G).inv() * F
            if (settled and not 1 <= runs < _FAR) or _largest(H) > 2**_BITS:
                break
    except ZeroDivisionError:
        settled = False
    if not settled:
        raise NoSolution("the cost-to-go grows without end, since no action keeps the system from running away")
    yield H
    yield from _improved(regulator, brought_to_rest)


def _improved(regulator: Regulator, S: AnyMatrix) -> Iterator[AnyMatrix]:
    """What the policy iteration of Kleinman (1968) comes to, if the best gain for S makes the system stable."""
    for _ in range(_DOUBLINGS):
        gain = regulator.gain(S)
        better = _summed(regulator, gain, regulator.Q + gain.transpose() * regulator.R * gain)
        if better is None:
            return
        if _largest(better - S) < _AT_REST:
            yield better
            return
        S = better


def _summed(regulator: Regulator, gain: AnyMatrix, cost: AnyMatrix) -> AnyMatrix | None:
    """What a price on the states sums to under a = −Ls; None where the state does not come to rest."""
    F, gamma = regulator.A - regulator.B * gain, regulator.gamma
    for _ in range(_SQUARINGS):
        cost, F = _short(cost + F.transpose() * cost * F * gamma), _short(F * F * gamma)
        gamma = fmpq(1)
        if _largest(F) < _AT_REST:
            return cost
        if _largest(F) > 2**_BITS:
            break
    return None


def _short(value: AnyMatrix) -> AnyMatrix:
    """Entries rounded to ``_BITS`` bits behind the point."""
    return matrix([fmpq(round(entry * 2**_BITS), 2**_BITS) for entry in line] for line in value.tolist())


def _largest(value: AnyMatrix) -> fmpq:
    entries: list[fmpq] = value.entries()
    return max(map(abs, entries))
