"""rldrill drills the formulas of Reinforcement Learning and Robot Learning.

The library behind the commands: ``families`` names what there is, ``fields`` what a problem file holds; ``draw`` and
``load`` give an ``Exercise``, which can be shown, solved, checked and graded. Nothing heavy is imported before one of
them is used.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rldrill.exercise import Exercise, draw, load, read
    from rldrill.graded import Graded, GradedPart
    from rldrill.problems.catalogue import families
    from rldrill.problems.errors import FileError, UsageError, UserError
    from rldrill.problems.fields import FileField, fields
    from rldrill.solutions.answers.judging import Outcome, Verdict

__version__ = "0.1.0"
__all__ = [
    "Exercise",
    "FileError",
    "FileField",
    "Graded",
    "GradedPart",
    "Outcome",
    "UsageError",
    "UserError",
    "Verdict",
    "draw",
    "families",
    "fields",
    "load",
    "read",
]

_HOMES = {
    "exercise": ("Exercise", "draw", "load", "read"),
    "graded": ("Graded", "GradedPart"),
    "problems.catalogue": ("families",),
    "problems.errors": ("FileError", "UsageError", "UserError"),
    "problems.fields": ("FileField", "fields"),
    "solutions.answers.judging": ("Outcome", "Verdict"),
}


def __getattr__(name: str) -> Any:
    for home, names in _HOMES.items():
        if name in names:
            return getattr(import_module(f"rldrill.{home}"), name)
    raise AttributeError(f"module 'rldrill' has no attribute {name!r}")


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
