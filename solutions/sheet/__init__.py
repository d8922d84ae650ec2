"""The formula sheet: one module per section; each formula is stated here and nowhere else."""

import importlib
from functools import cache

from msgspec import Struct

from rldrill.problems.pictures import Picture
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
    "backup_diagrams": "Backup diagrams",
    "bayes": "Bayesian methods",
    "inverse_rl": "Inverse reinforcement learning",
    "function_approximation": "Function approximation",
    "beyond_the_sheet": "Beyond the sheet",
}


class Gallery(Struct, frozen=True):
    """Pictures of a section, and a sentence on how to read them."""

    pictures: tuple[Picture, ...] = ()
    note: str = ""


def gallery(name: str) -> Gallery:
    """The pictures of one section; most have none."""
    module = importlib.import_module(f"{__name__}.{name}")
    found: Gallery = getattr(module, "GALLERY", Gallery())
    return found


@cache
def section(name: str) -> tuple[Formula, ...]:
    """The formulas of one section, in the order in which its module states them."""
    module = importlib.import_module(f"{__name__}.{name}")
    return tuple(value for value in vars(module).values() if isinstance(value, Formula) and value.key)


@cache
def formulas() -> dict[str, Formula]:
    """Every formula of the sheet by its key, in order."""
    return {formula.key: formula for name in SECTIONS for formula in section(name)}
