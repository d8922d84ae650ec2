"""Files that are written whole: which of several writers has begun one."""

import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Barrier

import pytest

from rldrill.writing import begin, whole, write_bytes_atomically


def test_of_several_that_begin_a_file_at_once_one_does_and_the_others_are_told(tmp_path: Path) -> None:
    writers = 8
    together = Barrier(writers)

    def write(path: Path, number: int) -> tuple[bool, bytes]:
        together.wait()
        return begin(path, b"%d" % number * 1000), path.read_bytes()

    with ThreadPoolExecutor(writers) as pool:
        for turn in range(25):
            path = tmp_path / str(turn)
            found = list(pool.map(lambda number, path=path: write(path, number), range(writers)))
            assert [is_ours for is_ours, _ in found].count(True) == 1
            assert {text for _, text in found} == {path.read_bytes()}
    assert len(list(tmp_path.iterdir())) == 25


def test_an_error_of_something_else_keeps_its_words(tmp_path: Path) -> None:
    for error in (OSError("the printer is on fire"), FileNotFoundError(2, "No such file", "other.txt")):
        with pytest.raises(OSError, match=re.escape(str(error))) as raised, whole(tmp_path / "new"):
            raise error
        assert raised.value is error
    with pytest.raises(OSError, match="new") as raised, whole(tmp_path / "new"):
        raise OSError(28, "No space left on device")
    assert raised.value.filename == str(tmp_path / "new")


def test_a_link_that_names_itself_stays_and_is_told(tmp_path: Path) -> None:
    link = tmp_path / "link"
    link.symlink_to(link)
    with pytest.raises(OSError, match="link") as raised:
        write_bytes_atomically(link, b"1")
    assert raised.value.filename == str(link)
    assert link.is_symlink()


def test_a_file_is_begun_where_there_are_no_links(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise PermissionError(1, "Operation not permitted")

    monkeypatch.setattr(Path, "hardlink_to", refuse)
    assert begin(tmp_path / "new", b"1")
    assert not begin(tmp_path / "new", b"2")
    assert (tmp_path / "new").read_bytes() == b"1"
