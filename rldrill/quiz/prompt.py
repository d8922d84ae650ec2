"""Typing at the prompt: line editing and the history of what was typed, where the system has them."""

import contextlib
import sys
from collections.abc import Callable

#: The end of input, or a way to ask for one line.
Ask = Callable[[str], str]


def line_editor() -> Ask:
    """``input`` with line editing; importing readline is what makes it edit."""
    with contextlib.suppress(ImportError):  # Windows' own console edits lines by itself
        import readline  # noqa: F401
    return input


def is_interactive() -> bool:
    """Whether somebody sits at both ends."""
    return sys.stdin.isatty() and sys.stdout.isatty()
