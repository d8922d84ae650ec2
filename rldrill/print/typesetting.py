"""The PDFs of one version of an exam, made from the manifest alone: in this process, or in several at once."""

import os
from collections import deque
from collections.abc import Callable, Iterator
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct

from rldrill.background import deaf_processes
from rldrill.exam.exam import Exam, Version
from rldrill.print.fonts import needs_system_fonts
from rldrill.print.key import key_source
from rldrill.print.paper import pdf
from rldrill.print.worksheet import worksheet_source
from rldrill.problems.notations import used
from rldrill.writing import write_bytes_atomically

if TYPE_CHECKING:
    from multiprocessing.pool import AsyncResult, Pool

#: With fewer versions another process takes longer to start than it saves.
_MANY = 6
#: After so many versions a process is replaced by a fresh one, which has less in its memory.
_REPLACED = 25


class Task(Struct, frozen=True):
    """A version that is to be typeset.

    Args:
        exam: what all versions have in common, and how they are printed.
        make: what makes the version, which takes a while.
        worksheet: where the worksheet is written; None for nowhere.
        key: where the key is written; None for nowhere.
    """

    exam: Exam
    make: Callable[[], Version]
    worksheet: Path | None
    key: Path | None


def typeset(tasks: deque[Task]) -> Iterator[list[Path]]:
    """Typeset versions, and tell of each what was written; the tasks are taken out one by one, and forgotten.

    Raises:
        FileError: the manifest holds a problem that cannot be made.
        OSError: a file cannot be written.
    """
    others = min(os.cpu_count() or 1, len(tasks) // (_MANY // 2)) - 1
    if len(tasks) < _MANY or others < 1:
        while tasks:
            yield _typeset(tasks.popleft())
        return
    with deaf_processes():
        os.environ["RAYON_NUM_THREADS"] = "1"  # what Typst goes by: each process takes one processor
        pool = get_context("spawn").Pool(others, maxtasksperchild=_REPLACED)
    with pool:  # which ends them, whatever happens
        yield from _shared(pool, others, tasks)


def _shared(pool: "Pool", others: int, waiting: deque[Task]) -> Iterator[list[Path]]:
    """Other processes have a task each and one in store, and this one takes its part as well: that saves memory."""
    running: deque[AsyncResult[list[Path]]] = deque()
    while waiting or running:
        while waiting and len(running) < 2 * others:
            running.append(pool.apply_async(_typeset, (waiting.popleft(),)))
        if waiting:
            yield _typeset(waiting.popleft())
        while running and (running[0].ready() or not waiting):
            yield running.popleft().get()


def _typeset(task: Task) -> list[Path]:
    exam, wanted = task.exam, ((task.worksheet, worksheet_source), (task.key, key_source))
    with used(exam.layout.notation, exam.head.decimal_mark):
        version = task.make()
        people = () if version.person is None else (version.person,)
        system = needs_system_fonts(exam.head, people, str([each.problem.data() for each in version.exercises]))
        for path, source in wanted:
            if path is not None:
                write_bytes_atomically(path, pdf(source(exam, version), accessible=True, system_fonts=system))
    return [path for path, _ in wanted if path is not None]
