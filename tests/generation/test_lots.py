"""Problems in bulk: which they are, and that neither jobs nor shards nor a kill change them."""

import json
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Barrier
from typing import Any

import pytest
from typer.testing import CliRunner

from rldrill.cli import app
from rldrill.exam.selection import MAX_DRAWN
from rldrill.generation.folder import Folder, seed_of
from rldrill.generation.lots import Lot, Split, lots
from rldrill.generation.records import Extra, Record
from rldrill.generation.running import Here, drawn, processes
from rldrill.problems.errors import UsageError


def written(every: tuple[Lot, ...], executor: object = None, ahead: int = 1) -> list[str]:
    found = drawn(every, (Extra.ANSWERS,), executor or Here(), ahead)  # type: ignore[arg-type]
    return [line for _, lines in found for line in lines]


def test_the_number_is_shared_out_and_every_family_and_level_gets_as_many() -> None:
    every = lots(("td-zero", "bayes"), None, 100, 1)
    assert sum(lot.count for lot in every) == 100
    assert {lot.count for lot in every} <= {100 // len(every), 100 // len(every) + 1}


def test_the_splits_have_no_seed_in_common_and_none_that_a_quiz_draws() -> None:
    train, held_out = Split.TRAIN.seeds, Split.HELD_OUT.seeds
    assert MAX_DRAWN <= train.start < train.stop <= held_out.start
    for split in Split:
        for lot in lots((), None, 10**8, 3, split):
            assert lot.first in split.seeds
            assert lot.first + 2 * lot.count in split.seeds


def test_several_processes_write_what_one_writes() -> None:
    every = lots(("return", "sample-average"), 1, 200, 5)
    with processes(2) as executor:
        assert written(every, executor, 8) == written(every)


def test_no_problem_comes_twice_and_a_lot_ends_where_there_are_no_more(monkeypatch: pytest.MonkeyPatch) -> None:
    def seven(_family: str, _level: int, first: int, count: int, _extras: object) -> list[Record]:
        return [Record(bytes([seed % 7]), str(seed % 7)) for seed in range(first, first + count)]

    monkeypatch.setattr("rldrill.generation.running.block", seven)
    (lot,) = lots(("return",), 1, 5000, 2)
    assert sorted(written((lot,))) == list("0123456")
    (lot,) = lots(("return",), 1, 5, 2)
    assert len(set(written((lot,)))) == 5


def test_a_level_that_none_has_is_a_sentence() -> None:
    with pytest.raises(UsageError, match="There is no topic or family"):
        lots(("no-such-family",), 1, 5, 1)


def arguments(folder: Path, *more: str) -> list[str]:
    return ["generate", "td-zero", "return", "-n", "150", "--seed", "9", "--answers", "-o", str(folder), *more]


def generate(folder: Path, *more: str) -> Any:
    return CliRunner().invoke(app, arguments(folder, *more))


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if not path.name.startswith(".")}


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("generated") / "whole"
    assert generate(folder).exit_code == 0
    return folder


def test_shards_together_are_the_whole(tmp_path: Path, whole: Path) -> None:
    for share in ("1/2", "2/2"):
        assert generate(tmp_path / "shards", "--shard", share).exit_code == 0
    assert contents(tmp_path / "shards") == contents(whole)


def test_a_killed_run_goes_on(tmp_path: Path, whole: Path) -> None:
    killed = tmp_path / "killed"
    command = [sys.executable, "-m", "rldrill", *arguments(killed)]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    deadline = time.monotonic() + 60
    while not list(killed.glob("*.jsonl")) and time.monotonic() < deadline:
        time.sleep(0.01)
    process.kill()
    process.wait()
    finished = contents(killed)
    assert generate(killed).exit_code == 0
    assert contents(killed) == contents(whole)
    assert finished.items() <= contents(killed).items()


def test_a_folder_of_another_run_is_left_alone(tmp_path: Path, whole: Path) -> None:
    refused = generate(whole, "--split", "held-out").exception
    assert "was begun with other arguments" in str(refused)
    (tmp_path / "notes.txt").write_text("mine")
    assert "holds other files already" in str(generate(tmp_path).exception)
    assert "is no folder; give the name of one" in str(generate(tmp_path / "notes.txt").exception)


def test_a_run_without_a_seed_goes_on_with_that_of_its_folder(tmp_path: Path) -> None:
    def run(folder: str, *more: str) -> Any:
        return CliRunner().invoke(app, ["generate", "return", "-n", "3", "-o", str(tmp_path / folder), *more])

    begun = run("g")
    written_then = contents(tmp_path / "g")
    (tmp_path / "g" / "return-2.jsonl").unlink()
    again = run("g")
    assert (again.exit_code, again.stderr) == (0, begun.stderr)  # seed 153634, the same
    assert contents(tmp_path / "g") == written_then
    assert "was begun with other arguments" in str(run("g", "--seed", "1").exception)
    assert "was begun with other arguments" in str(run("g", "--answers").exception)
    (tmp_path / "broken").mkdir()
    (tmp_path / "broken" / "generate.json").write_text("[]")
    assert "was begun with other arguments" in str(run("broken").exception)


@pytest.mark.parametrize(("seed", "read"), [("7", 7), ("true", None), ("-5", None), ('"7"', None)])
def test_what_is_no_seed_is_none(tmp_path: Path, seed: str, read: int | None) -> None:
    (tmp_path / "generate.json").write_text(f'{{"seed": {seed}}}')
    assert seed_of(tmp_path) == read


def test_shards_that_begin_a_folder_at_once_share_it(tmp_path: Path) -> None:
    shards = 8
    together = Barrier(shards)

    def begun(path: Path) -> None:
        together.wait()
        Folder(path, "jsonl", {"names": ["return"], "seed": 1})

    with ThreadPoolExecutor(shards) as pool:
        for turn in range(50):
            list(pool.map(begun, [tmp_path / str(turn)] * shards))
    assert [path.name for path in (tmp_path / "0").iterdir()] == ["generate.json"]


def test_what_a_shard_that_was_ended_has_left_unfinished_is_no_other_file(tmp_path: Path) -> None:
    (tmp_path / ".generate.json.k3j2").write_text("")
    Folder(tmp_path, "jsonl", {"seed": 1})
    Folder(tmp_path, "jsonl", {"seed": 1})


def test_parquet_holds_the_same_records(tmp_path: Path, whole: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet", reason="an extra; CI has it")
    assert generate(tmp_path / "columns", "--format", "parquet").exit_code == 0
    for path in whole.glob("*.jsonl"):
        rows = parquet.read_table(tmp_path / "columns" / f"{path.stem}.parquet").to_pylist()
        lines = path.read_text(encoding="utf-8").splitlines()
        assert [row["record"] for row in rows] == lines
        first = json.loads(lines[0])
        assert rows[0]["id"] == first["id"]
        assert json.loads(rows[0]["answers"])["a"] == first["parts"][0]["answer"]
        assert first["parts"][0]["ask"] in rows[0]["question"]


@pytest.mark.parametrize(
    ("more", "says"),
    [
        (("--shard", "3/2"), "--shard 3/2 is not a share; write 3/16 for the third of sixteen."),
        (("--with", "answer"), "--with answer is not known; it takes answers, working, hints, latex, mistakes"),
        (("--format", "parquet"), "Parquet is written to a folder; name one with --output."),
        (("-o", "all.parquet"), "all.parquet: -o names a folder, which gets a file for each family and level"),
        (("-o", "all.jsonl"), "leave -o out and redirect to one file, as in > problems.jsonl"),
        (("--dask", "nowhere"), "No scheduler of dask answers at nowhere"),
    ],
)
def test_what_does_not_fit_is_a_sentence(more: tuple[str, ...], says: str) -> None:
    assert says in str(CliRunner().invoke(app, ["generate", "return", "-n", "1", *more]).exception)
