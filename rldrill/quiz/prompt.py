"""Typing at the prompt: line editing, the history of what was typed, and pasted lines, where the system has them."""

import contextlib
import signal
import sys
from collections.abc import Callable

from rldrill.background import in_background

#: Asks for what is typed: a line, or the lines that are pasted together. EOFError is the end of input.
Ask = Callable[[str], str]

#: So long after a line, in seconds, the next one of a paste has come; nobody types so fast.
_PASTED = 0.03


def line_editor() -> Ask:
    """``input`` with line editing; importing readline is what makes it edit."""
    # Whoever sits there may press Ctrl-C, though a script that started us has ignored or blocked it.
    if is_interactive():
        signal.signal(signal.SIGINT, signal.default_int_handler)
        if sys.platform != "win32":
            signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    with contextlib.suppress(ImportError):  # Windows' own console edits lines by itself
        import readline

        # A paste is then put into the line as a whole, and Enter ends it.
        readline.parse_and_bind("set enable-bracketed-paste on")
    return _ask


def _ask(prompt: str) -> str:
    lines = [input(prompt)]
    while _is_waiting():
        try:
            lines.append(input())
        except EOFError:
            break
    return "\n".join(lines)


def hold_resumes() -> None:
    """Keep the signal of ``fg`` for the one thread that waits for it; to be called before any thread begins.

    Else it may reach a thread of some library, and the main thread would not hear of it before the next line.
    """
    if sys.platform != "win32":
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGCONT})


def on_resume(redraw: Callable[[], str]) -> None:
    """After Ctrl-Z and fg show again what is asked, and what was typed so far.

    Args:
        redraw: shows it, and gives the prompt.
    """
    if sys.platform == "win32":
        return

    def wait() -> None:
        import readline

        while True:
            signal.sigwait({signal.SIGCONT})
            print()
            print(f"{redraw()}{readline.get_line_buffer()}", end="", flush=True)

    in_background(wait)


def _is_waiting() -> bool:
    """Whether more has been typed already, as when lines are pasted on a terminal that does not say so."""
    if sys.platform == "win32":
        import msvcrt

        return msvcrt.kbhit()
    import select

    return bool(select.select([sys.stdin], [], [], _PASTED)[0])


def is_interactive() -> bool:
    """Whether somebody sits at both ends."""
    return sys.stdin.isatty() and sys.stdout.isatty()
