"""rldrill drills the formulas of Reinforcement Learning and Robot Learning.

The library behind the commands: ``draw`` and ``load`` give an ``Exercise``, which can be shown, solved
and checked. Nothing heavy is imported before one of them is used.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rldrill.exercise import Exercise, draw, load, read

__version__ = "0.1.0"
__all__ = ["Exercise", "draw", "load", "read"]


def __getattr__(name: str) -> Any:
    if name in __all__:
        from rldrill import exercise

        return getattr(exercise, name)
    raise AttributeError(f"module 'rldrill' has no attribute {name!r}")
