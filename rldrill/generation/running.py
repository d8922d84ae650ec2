"""Drawing lots in this process, in several, or on a cluster: the same lines in the same order, whoever draws them."""

import multiprocessing
import signal
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor
from contextlib import AbstractContextManager, contextmanager
from itertools import chain, count, groupby
from operator import itemgetter
from typing import Any

from rldrill.generation.lots import Lot
from rldrill.generation.records import Extra, Record, block
from rldrill.problems.errors import UsageError

#: A piece of work is so many problems: a tenth of a second or so.
_BLOCK = 64
#: A lot ends where so many draws, one after the other, brought no problem that it did not have.
_IN_VAIN = 32 * _BLOCK


class Here(Executor):
    """Does at once what it is given, in this process."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        """Do it."""
        done: Future[Any] = Future()
        done.set_result(fn(*args, **kwargs))
        return done


def processes(jobs: int) -> Executor:
    """What draws in so many processes."""
    if jobs == 1:
        return Here()
    return ProcessPoolExecutor(
        jobs, multiprocessing.get_context("spawn"), signal.signal, (signal.SIGINT, signal.SIG_IGN)
    )


@contextmanager
def cluster(address: str) -> Iterator[Executor]:
    """What draws on a cluster, through a scheduler of dask.distributed.

    Raises:
        UsageError: dask is not installed, or nobody answers there.
    """
    try:
        from distributed import Client
    except ImportError:
        raise UsageError("--dask needs dask.distributed; install rldrill[dask].") from None
    try:
        client = Client(address, timeout="10s")
    except (OSError, ValueError) as error:
        raise UsageError(f"No scheduler of dask answers at {address[:100]}: {error}") from None
    with client, client.get_executor(pure=False, retries=3) as executor:
        yield executor


def workers(jobs: int, address: str | None) -> AbstractContextManager[Executor]:
    """What draws: a cluster if there is an address, else processes."""
    return cluster(address) if address else processes(jobs)


def drawn(
    lots: Iterable[Lot], extras: tuple[Extra, ...], executor: Executor, ahead: int = 1
) -> Iterator[tuple[Lot, Iterator[str]]]:
    """Every lot with its different problems, a line each, in the order of their seeds; take them before the next lot.

    There are fewer than asked for where a family has no more.

    Args:
        lots: the lots.
        extras: what is written of every problem besides.
        executor: what draws.
        ahead: how many pieces of work are given to it before the first is waited for.

    Raises:
        UsageError: a process was ended from outside.
    """
    for lot, pieces in groupby(_pieces(lots, extras, executor, ahead), key=itemgetter(0)):
        planned = (record for _, records in pieces for record in records)
        yield lot, _different(lot, chain(planned, _more(lot, extras, executor)))


def _different(lot: Lot, records: Iterable[Record]) -> Iterator[str]:
    seen: set[bytes] = set()
    in_vain = 0
    for record in records:
        in_vain += 1
        if record.digest not in seen:
            seen.add(record.digest)
            in_vain = 0
            yield record.line
        if len(seen) == lot.count or in_vain >= _IN_VAIN:
            return


def _pieces(
    lots: Iterable[Lot], extras: tuple[Extra, ...], executor: Executor, ahead: int
) -> Iterator[tuple[Lot, list[Record]]]:
    """The work that every lot takes at least, in order; some of it is under way while the first is taken."""
    waiting: deque[tuple[Lot, Future[list[Record]]]] = deque()
    try:
        for lot in lots:
            for done in range(0, lot.count, _BLOCK):
                size = min(_BLOCK, lot.count - done)
                waiting.append((lot, executor.submit(block, lot.family, lot.level, lot.first + done, size, extras)))
                if len(waiting) >= ahead:
                    yield _taken(*waiting.popleft())
        while waiting:
            yield _taken(*waiting.popleft())
    finally:
        for _, future in waiting:
            future.cancel()


def _more(lot: Lot, extras: tuple[Extra, ...], executor: Executor) -> Iterator[Record]:
    """What comes after that, where some problems came twice."""
    for first in count(lot.first + lot.count, _BLOCK):
        yield from _taken(lot, executor.submit(block, lot.family, lot.level, first, _BLOCK, extras))[1]


def _taken(lot: Lot, future: "Future[list[Record]]") -> tuple[Lot, list[Record]]:
    try:
        return lot, future.result()
    except BrokenExecutor:
        raise UsageError(
            "A process that draws was ended from outside, perhaps for want of memory; run it again with fewer --jobs."
        ) from None
