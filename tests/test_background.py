"""Work in a process of its own: its steps, its result and its errors arrive here, and so does its end."""

import os
import signal
import sys

import pytest

from beside import hears_ctrl_c, is_ended, refuses, three_steps
from rldrill.background import apart, in_background
from rldrill.problems.errors import UsageError


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


@pytest.mark.skipif(sys.platform == "win32", reason="there are no masks of signals")
def test_ctrl_c_is_for_whoever_waits() -> None:
    assert not apart(hears_ctrl_c, lambda: None)


@pytest.mark.skipif(sys.platform == "win32", reason="there are no masks of signals")
@pytest.mark.parametrize("name", ["SIGINT", "SIGCONT", "SIGWINCH"])
def test_what_the_prompt_waits_for_reaches_no_thread_beside_it(name: str) -> None:
    masks: list[set[int]] = []
    in_background(lambda: masks.append(set(signal.pthread_sigmask(signal.SIG_BLOCK, ())))).join()
    assert signal.Signals[name] in masks[0]
    assert signal.Signals[name] not in signal.pthread_sigmask(signal.SIG_BLOCK, ())
