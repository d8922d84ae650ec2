"""Work in the background of a terminal."""

import signal
from collections.abc import Callable
from threading import Thread


def in_background(work: Callable[[], None]) -> Thread:
    """Start a thread that Ctrl-C passes by: else it may reach this one, and the prompt would not hear of it."""
    thread = Thread(target=work, daemon=True)
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        thread.start()
        return thread
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # a new thread has the mask of the one before
    try:
        thread.start()
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
    return thread
