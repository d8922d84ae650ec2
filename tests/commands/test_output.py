"""What terminals, pipes and files get: signs that they have, whole rewards, and quiet ends."""

import json
import os
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent
RACING_CAR = ROOT / "examples" / "racing-car.toml"


def run(arguments: str, shell: str = "", **environment: str) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        ["sh", "-c", f"{sys.executable} -m rldrill {arguments} {shell}"],
        capture_output=True, timeout=120, cwd=ROOT, check=False,
        env={**os.environ, "NO_COLOR": "1", **environment},
    )  # fmt: skip


@pytest.mark.parametrize("encoding", ["ascii", "cp437", "koi8-r"])
@pytest.mark.parametrize(
    "command", ["show td-zero/2/7", "solve lqr-gain/2/1", "sheet temporal-difference", "list", "-h"]
)
def test_no_sign_becomes_a_question_mark(command: str, encoding: str) -> None:
    ours = run(command, PYTHONIOENCODING=encoding)
    assert ours.returncode == 0, ours.stderr
    assert ours.stdout.decode(encoding).count("?") == in_full(command).count("?")


@cache
def in_full(command: str) -> str:
    """What a command prints where every sign can be shown."""
    return run(command, PYTHONIOENCODING="utf-8").stdout.decode()


@pytest.mark.parametrize("encoding", ["ascii", "cp1252", "utf-8"])
def test_json_is_the_same_data_in_every_encoding(encoding: str) -> None:
    process = run("show td-zero/2/7 --json", PYTHONIOENCODING=encoding)
    assert process.stdout.isascii() == (encoding != "utf-8")
    data = json.loads(process.stdout.decode("utf-8"))
    assert any("γ = 1/2" in text for text in data["question"])


def test_names_that_are_spelled_alike_stay_apart(tmp_path: Path) -> None:
    run_ = {"states": ["α", "alpha", "end"], "rewards": [1, 2], "terminal": ["end"]}
    given = {"trajectory": run_, "values": {"α": 1, "alpha": 2}, "alpha": "1/2", "gamma": 1}
    file = tmp_path / "alike.json"
    file.write_text(json.dumps({"family": "td-zero", "given": given}), encoding="utf-8")
    # V(α) = 1 + (1 + 2 − 1)/2 = 2; V(alpha) = 2 + (2 + 0 − 2)/2 = 2.
    shown = run(f"solve {file}", PYTHONIOENCODING="ascii").stdout.decode("ascii")
    assert "V(alpha) = 2" in shown
    assert 'V("alpha") = 2' in shown


def test_a_closed_output_is_quiet() -> None:
    process = run("show return/1/2166", ">&-")
    assert (process.returncode, process.stdout, process.stderr) == (0, b"", b"")


def test_a_closed_input_gets_the_usual_sentence() -> None:
    process = run("quiz return/1/2166", "<&-")
    assert process.returncode == 2
    assert process.stderr.startswith(b"rldrill: The quiz needs a terminal;")


def test_a_closed_pipe_is_quiet() -> None:
    process = run("generate -n 200 td-zero --seed 1", "| head -n 1")
    assert process.stdout.count(b"\n") == 1
    assert process.stderr in (b"", b"seed 1\n")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="only some systems have a disk that is always full")
def test_a_full_disk_is_told_in_one_sentence() -> None:
    process = run("show return/1/2166", "> /dev/full")
    assert process.returncode == 3
    assert process.stderr == b"rldrill: The system: no space left on device.\n"


@pytest.mark.parametrize("columns", [20, 26, 30, 34, 40, 50, 60, 100])
def test_rewards_are_never_cut_off_and_names_never_broken(columns: int) -> None:
    shown = run(f"show {RACING_CAR}", PYTHONIOENCODING="utf-8", COLUMNS=str(columns)).stdout.decode()
    assert max(map(len, shown.splitlines())) <= columns
    assert shown.count("−10") == 2 if columns >= 60 else shown.count("−10") in (1, 2)
    assert "overheated" in shown
    assert shown.count("warm") >= 5


def test_tables_of_commands_become_paragraphs_on_narrow_terminals() -> None:
    shown = run("list bellman", PYTHONIOENCODING="utf-8", COLUMNS="30").stdout.decode()
    assert "Family: bellman-backup" in shown
    assert "…" not in shown


@pytest.mark.parametrize("terminal", [{"TERM": "dumb"}, {"NO_COLOR": "1"}])
def test_no_colours_where_none_are_wanted(terminal: dict[str, str]) -> None:
    assert b"\x1b" not in run("list bellman", **terminal).stdout
