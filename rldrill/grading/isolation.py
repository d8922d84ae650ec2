"""Marks in a process of its own: whatever happens there, a crash, an endless search, costs one task only."""

import pickle
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any, NoReturn, Protocol

from rldrill.grading.marking import Desk, Marked, Rules, Task
from rldrill.grading.report import Judged
from rldrill.problems.errors import FileError, UserError

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

#: How long a problem may take to be solved, and the memory that there is for marking.
LOADING = 60.0
MEMORY = 4 * 2**30
#: What Linux calls the signal that a process is sent when the one that started it has ended (linux/prctl.h).
_PR_SET_PDEATHSIG = 1
#: So many judgements are kept as they are sent.
_BLOBS = 10_000


class Marker(Protocol):
    """What marks a task within some seconds; ``loading`` is how many went into solving problems so far."""

    loading: float

    def mark(self, task: Task, seconds: float) -> Marked:
        """Mark it.

        Raises:
            UserError: it cannot be marked.
        """


class Here:
    """Marks in this very process, without a bound."""

    loading = 0.0

    def __init__(self, manifest: Path | None, rules: Rules) -> None:
        self._desk = Desk(manifest, rules)

    def mark(self, task: Task, seconds: float) -> Marked:  # noqa: ARG002
        """Mark it."""
        return self._desk.mark(task)


class Apart:
    """Marks in a process of its own, which is ended and begun anew where it takes too long or breaks down."""

    def __init__(self, manifest: Path | None, rules: Rules) -> None:
        self._arguments = (manifest, rules)
        self._connection: Connection | None = None
        self._process: Any = None
        self._judged: dict[bytes, Judged] = {}
        self._hopeless: dict[Any, str] = {}
        self.loading = 0.0

    def mark(self, task: Task, seconds: float) -> Marked:
        """Mark it.

        Raises:
            FileError: it cannot be marked, takes too long, or breaks the process down.
        """
        if said := self._hopeless.get(task.ref):
            raise FileError(said)
        fresh = self._connection is None
        problem, stage = f"solving {task.name}", "loading"
        # Everybody has the problems of an exam; what else somebody names is solved in their own time.
        most = LOADING if isinstance(task.ref, tuple) else min(LOADING, seconds)
        begun = perf_counter()
        try:
            self._open().send(task)
            said = self._received(most)
            self.loading += perf_counter() - begun
            if said is None:
                problem, stage = f"grading what was answered to {task.name}", "marking"
                said = self._received(seconds)
        except TimeoutError as error:
            self._give_up(task, f"{problem} took more than {error} seconds", stage == "loading" and most == LOADING)
        except (EOFError, OSError):
            if not fresh:  # what broke it down may have come before, once that was marked
                self.close()
                return self.mark(task, seconds)
            self._give_up(task, f"{problem} broke the interpreter down", stage == "loading")
        if isinstance(said, str):
            raise FileError(said)
        parts, refused, notes = said
        entries = (*task.entries, None)
        return Marked(tuple((label, entries[place], self._of(blob)) for label, place, blob in parts), refused, notes)

    def _of(self, blob: bytes) -> Judged:
        """What was judged, kept once."""
        if blob not in self._judged:
            self._judged[blob] = pickle.loads(blob)
        return self._judged[blob]

    def _received(self, seconds: float) -> Any:
        assert self._connection is not None
        if not self._connection.poll(max(seconds, 0.01)):
            raise TimeoutError(f"{seconds:.3g}")
        return self._connection.recv()

    def _give_up(self, task: Task, says: str, hopeless: bool) -> NoReturn:
        self.close()
        says = f"{says}; it is not graded, all else is."
        if hopeless:
            self._hopeless[task.ref] = says
        raise FileError(says)

    def _open(self) -> "Connection":
        if self._connection is None:
            from multiprocessing import get_context

            forks = sys.platform == "linux"
            context: Any = get_context("fork" if forks else "spawn")
            self._connection, other = context.Pipe()
            inherited = self._connection if forks else None
            self._process = context.Process(target=_work, args=(other, inherited, *self._arguments), daemon=True)
            self._process.start()
            other.close()
        return self._connection

    def close(self) -> None:
        """End the process."""
        if self._connection is not None:
            self._process.kill()
            self._process.join()
            self._connection.close()
            self._connection = None


@contextmanager
def marker(manifest: Path | None, rules: Rules, *, isolated: bool) -> Iterator[Marker]:
    """What marks, in a process of its own or here."""
    if not isolated:
        yield Here(manifest, rules)
        return
    apart = Apart(manifest, rules)
    try:
        yield apart
    finally:
        apart.close()


def _work(connection: "Connection", inherited: "Connection | None", manifest: Path | None, rules: Rules) -> None:
    """The other process: for every task None once its problem is solved, then the marks, or a sentence."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the one who asked ends this process
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    if inherited is not None:
        inherited.close()  # while it is open here, nobody hears that the one who asks has ended
        _end_with_parent()
    _bound_memory()
    desk = Desk(manifest, rules)
    blobs: dict[int, tuple[Judged, bytes]] = {}

    def blob(judged: Judged) -> bytes:
        if len(blobs) > _BLOBS:
            blobs.clear()
        if id(judged) not in blobs:
            blobs[id(judged)] = (judged, pickle.dumps(judged))  # with the object, so that its id stays its own
        return blobs[id(judged)][1]

    with suppress(EOFError, OSError):  # nobody asks any more
        while True:
            task: Task = connection.recv()
            try:
                desk.problem(task.ref)
                connection.send(None)
                marked = desk.mark(task)
                places = {id(entry): place for place, entry in enumerate(task.entries)}
                parts = [(label, places.get(id(entry), -1), blob(judged)) for label, entry, judged in marked.parts]
                connection.send((parts, marked.refused, marked.notes))
            except UserError as error:
                connection.send(str(error))
            except MemoryError:
                connection.send(f"{task.name} needs more than {MEMORY // 2**30} GB of memory; it is not graded.")
            except Exception as error:  # one student's answer must not end the run
                connection.send(f"rldrill itself failed on it ({type(error).__name__}: {str(error)[:200]}); report it.")


def _end_with_parent() -> None:
    """Be ended by the system with whoever asks, also in the midst of marking: a pipeline must not be held up by it."""
    with suppress(ImportError, OSError, AttributeError):
        import ctypes

        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def _bound_memory() -> None:
    """Bound what is taken beside what there is already: whoever calls this as a library may hold much memory."""
    with suppress(ImportError, ValueError, OSError):
        import resource

        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0]) if sys.platform == "linux" else 0
        most = pages * resource.getpagesize() + MEMORY
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
