"""The Riccati equation of larger systems, which has no closed form: doubling, in rational arithmetic.

No library for floating point is needed for it, and the answer is as exact as its decimals say.
"""

from flint import fmpq

from rldrill.solutions.exact import NoSolution
from rldrill.solutions.matrices import AnyMatrix, identity, matrix

_BITS = 200
_DOUBLINGS = 40


def stationary(A: AnyMatrix, B: AnyMatrix, Q: AnyMatrix, R: AnyMatrix) -> AnyMatrix:
    """The stabilising cost-to-go matrix S of S = Q + AᵀS(I + BR⁻¹BᵀS)⁻¹A, to some fifty digits.

    The structure-preserving doubling algorithm (Chu, Fan, Lin & Wang 2004): after k rounds it has the
    cost-to-go of a horizon of 2ᵏ steps.

    Raises:
        NoSolution: the cost-to-go grows without end, or stays but does not make the system stable.
    """
    try:
        G, H, F = B * R.inv() * B.transpose(), Q, A
        for _ in range(_DOUBLINGS):
            W = (identity(A.nrows()) + G * H).inv()
            step = F.transpose() * H * W * F
            F, G, H = map(_short, (F * W * F, G + F * W * G * F.transpose(), H + step))
            if _largest(step) < fmpq(1, 2 ** (_BITS - 40)):
                return _checked(A, B, R, H)
            if _largest(H) > 2**_BITS:
                break
    except ZeroDivisionError:
        pass
    raise NoSolution("the cost-to-go grows without end, since no action keeps the system from running away")


def _checked(A: AnyMatrix, B: AnyMatrix, R: AnyMatrix, S: AnyMatrix) -> AnyMatrix:
    closed = A - B * (R + B.transpose() * S * B).inv() * B.transpose() * S * A
    for _ in range(12):
        closed = _short(closed * closed)
    if _largest(closed) >= 1:
        raise NoSolution("no action is worth its price, so the system is left to itself and does not come to rest")
    return S


def _short(value: AnyMatrix) -> AnyMatrix:
    """Entries rounded to ``_BITS`` bits behind the point."""
    return matrix([fmpq(round(entry * 2**_BITS), 2**_BITS) for entry in line] for line in value.tolist())


def _largest(value: AnyMatrix) -> fmpq:
    entries: list[fmpq] = value.entries()
    return max(map(abs, entries))
