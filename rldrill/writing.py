"""Files written whole or not at all."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """Where to write a file that appears when it is complete, or not at all, in a folder that is made if need be.

    What stood there before stays until then. A link stays, and what it names is replaced; a pipe or device is
    given what was written.

    Raises:
        OSError: the folder cannot be written to, or the disk is full; ``filename`` is set.
    """
    try:
        takes = path.exists() and not path.is_file()
        real = Path(os.path.realpath(path))
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
                unfinished.replace(real)
        finally:
            unfinished.unlink(missing_ok=True)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from error


def write_bytes_atomically(path: Path, data: bytes) -> None:
    """Write a file whole or not at all, as ``whole`` does; it lies on the disk then."""
    with whole(path) as unfinished, unfinished.open("wb") as file:
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
