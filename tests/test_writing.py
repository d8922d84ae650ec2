"""Files that are written whole: which of several writers has begun one."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Barrier

import pytest

from rldrill.writing import begin


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


def test_a_file_is_begun_where_there_are_no_links(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise PermissionError(1, "Operation not permitted")

    monkeypatch.setattr(Path, "hardlink_to", refuse)
    assert begin(tmp_path / "new", b"1")
    assert not begin(tmp_path / "new", b"2")
    assert (tmp_path / "new").read_bytes() == b"1"
