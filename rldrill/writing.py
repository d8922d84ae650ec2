"""Files written whole or not at all."""

import errno
import os
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from time import monotonic, sleep

#: What says that somebody else holds a lock.
_HELD = (BlockingIOError, FileExistsError, PermissionError) if sys.platform == "win32" else (BlockingIOError,)


@contextmanager
def whole(path: Path, put: Callable[[Path, Path], object] = Path.replace) -> Iterator[Path]:
    """Where to write a file that appears when it is complete, or not at all, in a folder that is made if need be.

    What stood there before stays until then. A link stays, and what it names is replaced; a pipe or device is
    given what was written.

    Args:
        path: where it shall be.
        put: what puts the complete file there.

    Raises:
        OSError: the folder cannot be written to, or the disk is full; ``filename`` is set.
    """
    unfinished = None
    try:
        takes = path.exists() and not path.is_file()
        real = Path(os.path.realpath(path))
        if real.is_symlink():  # it leads to itself
            raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
        if not takes:
            real.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=None if takes else real.parent, prefix=f".{path.name[:40]}.")
        os.close(handle)
        unfinished = Path(name)
        try:
            yield unfinished
            if takes:
                path.write_bytes(unfinished.read_bytes())
            else:
                unfinished.chmod(_file_mode(real))
                put(unfinished, real)
        finally:
            unfinished.unlink(missing_ok=True)
    except OSError as error:
        is_another = unfinished is not None and error.filename not in (None, str(unfinished), str(real), str(path))
        if error.errno is None or is_another:
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error


def write_bytes_atomically(path: Path, data: bytes) -> None:
    """Write a file whole or not at all, as ``whole`` does; it lies on the disk then."""
    with whole(path) as unfinished:
        _write(unfinished, data)


def begin(path: Path, data: bytes) -> bool:
    """Write a file whole, unless there is one: of several processes that begin one at once, one does.

    Returns:
        Whether this is in it now; else it is another's.

    Raises:
        OSError: it can be neither written nor read; ``filename`` is set.
    """
    with whole(path, _put_first) as unfinished:
        _write(unfinished, data)
    return path.read_bytes() == data


@contextmanager
def alone(path: Path, seconds: float = 5.0) -> Iterator[None]:
    """Where one process at a time reads a file and replaces it.

    The lock goes with its process, however that ends. Who has waited for so many seconds, as for a process that was
    stopped in the middle, goes on; so does everybody where there are no locks.
    """
    end, handle = monotonic() + seconds, None
    while handle is None and monotonic() < end:
        try:
            handle = _locked(Path(os.path.realpath(path)))
        except _HELD:
            sleep(0.005)
        except OSError:
            break
    try:
        yield
    finally:
        if handle is not None:
            os.close(handle)


def _locked(path: Path) -> int:
    """A handle that holds the lock of a file until it is closed: its folder's, since the file itself is replaced."""
    if sys.platform == "win32":
        return os.open(path.with_name(f".{path.name}.lock"), os.O_CREAT | os.O_EXCL | os.O_TEMPORARY)
    import fcntl

    handle = os.open(path.parent, os.O_RDONLY)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(handle)
        raise
    return handle


def _put_first(unfinished: Path, path: Path) -> None:
    try:
        path.hardlink_to(unfinished)
    except FileExistsError:
        return
    except OSError:  # some file systems have no links
        if not path.exists():
            unfinished.replace(path)


def _write(path: Path, data: bytes) -> None:
    with path.open("wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())


def _file_mode(path: Path) -> int:
    """The rights of the file that is replaced, or those that a new file gets."""
    if path.exists():
        return path.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
