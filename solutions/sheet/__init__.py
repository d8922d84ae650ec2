"""The formula sheet: one module per section; each formula is stated here and nowhere else."""

import importlib
from functools import cache

from rldrill.solutions.formula.formula import Formula

#: The sections in the sheet's order, and their titles.
SECTIONS = {
    "fundamentals": "Fundamentals",
    "bellman": "Bellman equations",
    "dynamic_programming": "Dynamic programming",
    "temporal_difference": "Temporal difference learning",
    "control": "TD control",
    "policy_gradient": "Policy gradient",
    "linear_methods": "Linear methods",
    "bayes": "Bayesian methods",
    "function_approximation": "Function approximation",
}


@cache
def section(name: str) -> tuple[Formula, ...]:
    """The formulas of one section, in the order in which its module states them."""
    module = importlib.import_module(f"{__name__}.{name}")
    return tuple(value for value in vars(module).values() if isinstance(value, Formula) and value.key)


@cache
def formulas() -> dict[str, Formula]:
    """Every formula of the sheet by its key, in order."""
    return {formula.key: formula for name in SECTIONS for formula in section(name)}
