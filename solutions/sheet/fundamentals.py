"""Section 1 of the sheet: returns."""

from sympy import evaluate

from rldrill.solutions.formula.formula import Formula, misread
from rldrill.solutions.formula.notation import DOTS, INFINITY, Counting, G, SumOver, T, gamma, i, r, t

with evaluate(False):
    _ALL = Counting(0, T - t - 1, INFINITY)

    RETURN = Formula(
        "return",
        G(t),
        SumOver(gamma**i * r(t + 1 + i), i, _ALL),
        title="Return",
        source="Sutton & Barto 2018, eq. 3.8",
        hint="Add the rewards after time t; each further step back costs one more factor γ.",
        also=(r(t + 1) + gamma * r(t + 2) + gamma**2 * r(t + 3) + DOTS,),
    )
    FIRST_DISCOUNTED = misread(
        RETURN,
        "first-reward-discounted",
        SumOver(gamma ** (i + 1) * r(t + 1 + i), i, _ALL),
        "The first reward after time t is not discounted: its factor is γ⁰ = 1.",
    )
    STARTS_EARLY = misread(
        RETURN,
        "starts-at-r-t",
        SumOver(gamma**i * r(t + i), i, _ALL),
        "The return from time t begins with the reward that comes after it, at t + 1.",
    )
    UNDISCOUNTED = misread(
        RETURN, "no-discount", SumOver(r(t + 1 + i), i, _ALL), "Later rewards are discounted by powers of γ."
    )
    LINEAR_DISCOUNT = misread(
        RETURN,
        "gamma-times-i",
        SumOver(gamma * i * r(t + 1 + i), i, _ALL),
        "The discount of a reward i steps later is the power γ^i, not the product γ·i.",
    )

    RETURN_RECURSIVE = Formula(
        "return-recursive",
        G(t),
        r(t + 1) + gamma * G(t + 1),
        title="Return, recursively",
        source="Sutton & Barto 2018, eq. 3.9",
        hint="Begin with the last return, which is the last reward, and go back in time.",
    )
    RECURSION_UNDISCOUNTED = misread(
        RETURN_RECURSIVE, "no-discount", r(t + 1) + G(t + 1), "The return that follows is discounted by γ."
    )
