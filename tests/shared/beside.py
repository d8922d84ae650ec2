"""Work for processes of their own, which can only be given what they can import."""

import os
import signal
from collections.abc import Callable

from rldrill.problems.errors import UsageError


def three_steps(advance: Callable[[], None]) -> tuple[int, ...]:
    for _ in range(3):
        advance()
    return (os.getpid(),)


def refuses(_: Callable[[], None]) -> None:
    raise UsageError("There are too few problems.")


def is_ended(_: Callable[[], None]) -> None:
    os.kill(os.getpid(), signal.SIGTERM)


def hears_ctrl_c(_: Callable[[], None]) -> bool:
    """Whether Ctrl-C would reach this process."""
    return signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, ())
