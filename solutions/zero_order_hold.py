"""A linear system while the action is held: exactly where the exponential ends or is a number's, else in decimals."""

from functools import cached_property
from typing import Any

from flint import arb, arb_mat, ctx, fmpq
from msgspec import Struct

from rldrill.solutions import matrices
from rldrill.solutions.closed_forms import PRECISELY
from rldrill.solutions.exact import Value, enclosure
from rldrill.solutions.matrices import AnyMatrix
from rldrill.solutions.sheet.linear_methods import EULER_A, EULER_B, EULER_F, nilpotent_hold, scalar_hold
from rldrill.solutions.work import Work

_BITS = 200
_DECIMALS = 10**12


class ZeroOrderHold(Struct, frozen=True, dict=True):
    """The matrix of the rates A s, and the time Δt for which the action is held."""

    A: AnyMatrix
    dt: Value

    @cached_property
    def _order(self) -> int | None:
        """The lowest power of A that vanishes, if one does."""
        power = self.A
        for order in range(1, self.A.nrows() + 1):
            if all(entry == 0 for entry in power.entries()):
                return order
            power = power * self.A
        return None

    @property
    def _known(self) -> dict[str, Any]:
        size = self.A.nrows()
        return {"Ai": self.A, "Ak": self.A[0, 0], "dt": self.dt, "unit": matrices.identity(size)}

    def state(self, work: Work) -> AnyMatrix:
        """A of the step."""
        work.say(
            "With a zero-order hold $A_Δ$ is $e$ to the power $A Δ t$, and $B_Δ$ its integral over the step, times $B$."
        )
        result: AnyMatrix
        if self._order is not None:
            work.say("Here $A = 0$." if self._order == 1 else f"Here $A^{self._order} = 0$, so the series of it ends.")
            result = work.step(nilpotent_hold(self._order).state, **self._known)
        elif self.A.nrows() == 1:
            result = matrices.matrix([[work.step(scalar_hold().state, **self._known)]])
        else:
            work.say("Its series does not end here, so both are given to twelve decimals.")
            result = self._rounded(matrices.identity(self.A.nrows()), integral=False)
            work.give(EULER_A, result)
        return result

    def action(self, work: Work, B: AnyMatrix) -> AnyMatrix:
        """B of the step."""
        result: AnyMatrix
        if self._order is not None:
            result = work.step(nilpotent_hold(self._order).action, Bi=B, **self._known)
        elif self.A.nrows() == 1:
            step = scalar_hold().action
            result = matrices.matrix([[work.step(step, Bk=entry, **self._known) for entry in B.entries()]])
        else:
            result = self._rounded(B, integral=True)
            work.give(EULER_B, result)
        return result

    def point(self, work: Work, state: AnyMatrix, rates: AnyMatrix) -> AnyMatrix:
        """Where the operating point has gone after the step, if its rates are held like an action."""
        result: AnyMatrix
        if self._order is not None:
            result = work.step(nilpotent_hold(self._order).point, sbar=state, fbar=rates, **self._known)
        elif self.A.nrows() == 1:
            known = {"sbark": state[0, 0], "fbark": rates[0, 0]}
            result = matrices.matrix([[work.step(scalar_hold().point, **known, **self._known)]])
        else:
            work.say("The same integral, times the rates at the operating point, leads from there to")
            result = state + self._rounded(rates, integral=True)
            work.give(EULER_F, result)
        return result

    def _rounded(self, right: AnyMatrix, *, integral: bool) -> AnyMatrix:
        """The exponential, or its integral times a matrix, to twelve decimals: a block of a larger exponential."""
        n, columns = self.A.nrows(), right.ncols()
        with PRECISELY, ctx.workprec(_BITS):
            dt = enclosure(self.dt)
            rows = [
                [*(enclosure(entry) * dt for entry in line), *(enclosure(entry) * dt for entry in beside)]
                for line, beside in zip(self.A.tolist(), right.tolist(), strict=True)
            ]
            size = n + columns
            powers = arb_mat(size, size, [entry for line in rows for entry in line] + [0] * (columns * size)).exp()
            block = range(n, size) if integral else range(n)
            return matrices.matrix([_short(powers[i, j]) for j in block] for i in range(n))


def _short(number: arb) -> fmpq:
    """A number rounded to twelve decimals."""
    mantissa, exponent = number.mid().man_exp()
    middle = fmpq(mantissa) * fmpq(2) ** int(exponent)
    return fmpq((middle * _DECIMALS + fmpq(1, 2)).floor(), _DECIMALS)
