"""Section 7 of the sheet: linear methods."""

from sympy import Pow, evaluate

from rldrill.solutions.formula.formula import Formula, misread
from rldrill.solutions.formula.notation import Quantity, Transposed, quantity, subscripted, t


def _matrix(code: str, head: str) -> type[Quantity]:
    return quantity(code, subscripted(head), matrix=True)


At = _matrix("At", "A")
Bt = _matrix("Bt", "B")
Pt = _matrix("Pt", "P")
Rt = _matrix("Rt", "R")
Lt = _matrix("Lt", "L")

with evaluate(False):
    LQR_GAIN = Formula(
        "lqr-gain",
        Lt(t),
        Pow(Transposed(Bt(t)) * Pt(t + 1) * Bt(t) - Rt(t), -1) * Transposed(Bt(t)) * Pt(t + 1) * At(t),
        title="LQR gain",
        source="Bertsekas 2017, section 3.1, with P = −K",
        hint="Work out Bᵀ P first; it stands in the bracket and behind it.",
        note="P is the matrix of the value sᵀPs, negative semidefinite; in the cost-to-go convention S = −P.",
    )
    POSITIVE_S = misread(
        LQR_GAIN,
        "cost-to-go-for-value",
        Pow(-Transposed(Bt(t)) * Pt(t + 1) * Bt(t) - Rt(t), -1) * -Transposed(Bt(t)) * Pt(t + 1) * At(t),
        "The sheet's P is the matrix of the value, so negative; the positive cost-to-go S belongs in (R + BᵀSB)⁻¹BᵀSA.",
    )
    FORGOT_R = misread(
        LQR_GAIN,
        "forgot-r",
        Pow(Transposed(Bt(t)) * Pt(t + 1) * Bt(t), -1) * Transposed(Bt(t)) * Pt(t + 1) * At(t),
        "The price R of the action belongs in the bracket: BᵀPB − R.",
    )
    TRANSPOSED_A = misread(
        LQR_GAIN,
        "transposed-a",
        Pow(Transposed(Bt(t)) * Pt(t + 1) * Bt(t) - Rt(t), -1) * Transposed(Bt(t)) * Pt(t + 1) * Transposed(At(t)),
        "A stands untransposed at the end; only B is transposed.",
        when=lambda given: len(given.A) > 1,  # a scalar is its own transpose
    )
