"""Work in a process of its own: its steps, its result and its errors arrive here, and so does its end."""

import os
import signal
from collections.abc import Callable

import pytest

from rldrill.background import apart
from rldrill.problems.errors import UsageError


def three_steps(advance: Callable[[], None]) -> tuple[int, ...]:
    for _ in range(3):
        advance()
    return (os.getpid(),)


def refuses(_: Callable[[], None]) -> None:
    raise UsageError("There are too few problems.")


def is_ended(_: Callable[[], None]) -> None:
    os.kill(os.getpid(), signal.SIGTERM)


def test_steps_and_the_result_arrive_from_another_process() -> None:
    steps: list[None] = []
    (where,) = apart(three_steps, lambda: steps.append(None))
    assert len(steps) == 3
    assert where != os.getpid()


def test_an_error_is_raised_here_as_it_was_there() -> None:
    with pytest.raises(UsageError, match="too few problems"):
        apart(refuses, lambda: None)


def test_whoever_ends_the_process_does_not_leave_the_other_one_waiting() -> None:
    with pytest.raises(ChildProcessError, match="ended before"):
        apart(is_ended, lambda: None)
