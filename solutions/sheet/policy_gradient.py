"""Section 6 of the sheet: policy gradient methods."""

from sympy import evaluate, exp

from rldrill.problems.mathematics import Fence, Math, Script, listed, row, variable
from rldrill.solutions.formula.formula import Formula, misread
from rldrill.solutions.formula.notation import (
    Choices,
    Features,
    SumOver,
    a,
    b,
    called,
    i,
    pi,
    quantity,
    s,
    subscripted,
)


def _feature(index: Math, *arguments: Math) -> Math:
    return row(Script(variable("f"), index), Fence(listed(arguments)))


theta = quantity("theta", subscripted("θ"))
f = quantity("f", _feature)
H = quantity("H", called("h"))

with evaluate(False):
    PREFERENCE = Formula(
        "action-preference",
        H(s, a),
        SumOver(theta(i) * f(i, s, a), i, Features),
        title="Preference of an action",
        source="Sutton & Barto 2018, eq. 13.3",
        hint="Multiply each weight with the action's own feature, and add.",
    )
    SOFTMAX_POLICY = Formula(
        "softmax-policy",
        pi(a, s),
        exp(H(s, a)) / SumOver(exp(H(s, b)), b, Choices),
        title="Softmax policy",
        source="Sutton & Barto 2018, eq. 13.2",
        hint="Exponentiate every action's preference, then divide by the sum of them all.",
    )
    NOT_NORMALISED = misread(
        SOFTMAX_POLICY,
        "not-normalised",
        exp(H(s, a)),
        "Probabilities sum to 1: divide by the sum over all actions.",
    )
    WITHOUT_EXP = misread(
        SOFTMAX_POLICY,
        "normalised-without-exp",
        H(s, a) / SumOver(H(s, b), b, Choices),
        "The preferences are exponentiated before they are normalised.",
    )
