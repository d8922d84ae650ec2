"""Work beside the thread that a terminal talks to: in another thread, or in a process of its own."""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Thread
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

T = TypeVar("T")


def in_background(work: Callable[[], None]) -> Thread:
    """Start a thread that Ctrl-C and ``fg`` pass by: the prompt is to hear of them."""
    thread = Thread(target=work, daemon=True)
    with deaf():
        thread.start()
    return thread


@contextmanager
def deaf() -> Iterator[None]:
    """What is started here hears neither Ctrl-C nor ``fg`` nor of another size: the thread that asks waits for them."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    # What is new has the mask of what started it.
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGCONT, signal.SIGWINCH})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def deaf_processes() -> Iterator[None]:
    """The same for processes: the one that Python starts with the first of them would let Ctrl-C through again."""
    if hasattr(signal, "pthread_sigmask"):
        from multiprocessing.resource_tracker import ensure_running

        ensure_running()
    with deaf():
        yield


def apart(work: Callable[[Callable[[], None]], T], advance: Callable[[], None]) -> T:
    """Do some work in a process of its own, which takes all its memory with it when it ends.

    Args:
        work: the work, which calls what it is given at each of its steps; with its result and errors it can be pickled.
        advance: called here at each of its steps.

    Raises:
        ChildProcessError: the process was ended by somebody.
    """
    from multiprocessing import get_context

    context = get_context("spawn")
    here, there = context.Pipe(duplex=False)
    process = context.Process(target=_apart, args=(there, work), daemon=True)
    with deaf_processes():
        process.start()
    there.close()
    try:
        while True:
            match here.recv():
                case None:
                    advance()
                case BaseException() as error:
                    raise error
                case (result,):
                    return result
    except EOFError:
        raise ChildProcessError("a process was ended before its work was done") from None
    finally:
        process.kill()
        process.join()


def _apart(connection: "Connection", work: Callable[[Callable[[], None]], Any]) -> None:
    try:
        connection.send((work(lambda: connection.send(None)),))
    except Exception as error:  # it is raised on the other side
        connection.send(error)
