"""The command line as a user meets it: help, exit codes, streams, start-up."""

import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import rldrill

ROOT = Path(__file__).parent.parent.parent
COMMANDS = (
    "quiz", "stats", "history", "worksheet", "verify", "solve", "show", "sheet", "list", "fields", "generate",
    "gallery", "audit",
)  # fmt: skip


def run(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "rldrill", *arguments],
        capture_output=True, text=True, encoding="utf-8", stdin=subprocess.DEVNULL, timeout=120, cwd=ROOT,
        env={**os.environ, "NO_COLOR": "1", "PYTHONIOENCODING": "utf-8", **environment},
    )  # fmt: skip


def one_sentence(process: subprocess.CompletedProcess[str]) -> str:
    lines = [line for line in process.stderr.splitlines() if not line.startswith("seed ")]
    assert len(lines) == 1, process.stderr
    assert lines[0].startswith("rldrill: ")
    assert lines[0].endswith(".")
    return lines[0]


def test_help_lists_every_command_and_each_has_help_with_examples() -> None:
    text = run("-h").stdout
    assert text == run("--help").stdout
    for name in COMMANDS:
        assert re.search(rf"\b{name}\b", text)
        from rldrill.cli import app

        registered = {command.name: command.callback for command in app.registered_commands}
        assert set(registered) == set(COMMANDS)
        callback = registered[name]
        assert callback is not None
        assert f"rldrill {name}" in (callback.__doc__ or ""), f"{name} needs examples in its help"
    assert "Examples" in run("show", "-h").stdout


def test_help_and_list_import_nothing_heavy() -> None:
    for arguments in (["-h"], ["list"], ["list", "bellman", "--json"]):
        process = subprocess.run(
            [sys.executable, "-X", "importtime", "-m", "rldrill", *arguments],
            capture_output=True,
            text=True,
            check=True,
        )
        loaded = {line.rpartition("|")[2].strip().split(".")[0] for line in process.stderr.splitlines()}
        assert "typer" in loaded
        assert not loaded & {"sympy", "numpy", "typst", "flint", "pexpect", "pytest"}


@pytest.mark.parametrize(
    ("arguments", "code", "fragment"),
    [
        (["quiz"], 2, "needs a terminal"),
        (["quiz", "--exam", "exam.toml", "--minutes", "5"], 2, "--exam says what is asked, and for how long"),
        (["quiz", "--exam", "exam.toml", "td-zero"], 2, "--exam says what is asked"),
        (["quiz", "td-zero/1/7", "-n", "3"], 2, "All problems are named; leave -n, --level and --seed out"),
        (["quiz", "td-zero/1/7", "--seed", "0"], 2, "All problems are named"),
        (["quiz", "td-zero/1/7", "--mistake", "forgot-gamma"], 2, "td-zero/1/7 is one problem; leave"),
        (["quiz", "bellman", "td-zero/1/7", "--exam-date", "2100-01-01"], 2, "td-zero/1/7 is one problem; leave"),
        (["quiz", "td-zero/2", "sarsa"], 2, "A quiz has one level for all that is drawn"),
        (["quiz", "td-zero/2", "sarsa/1"], 2, "A quiz has one level for all that is drawn"),
        (["quiz", "td-zero/2", "--level", "1"], 2, "A quiz has one level for all that is drawn"),
        (["quiz", "td-zero/2", "sarsa/2", "--level", "2"], 2, "needs a terminal"),
        (["quiz", "--version", "A"], 2, "are of an exam"),
        (["quiz", "--answers", "mine.toml"], 2, "are of an exam"),
        (["verify", "mine.toml", "--show-key", "--feedback", "none"], 2, "give one of them"),
        (["show", "nonsense"], 2, "nonsense"),
        (["show", "no-such/1/1"], 2, "no family"),
        (["show", "td-zero/1/1@9"], 2, "revision 9"),
        (["solve", "missing.toml"], 3, "missing.toml"),
        (["list", "no-such-topic"], 2, "no topic or family"),
        (["generate", "td-zer"], 2, "did you mean 'td-zero'"),
        (["solve", "examples"], 2, "examples"),
    ],
)
def test_errors_are_one_sentence_with_their_exit_code(arguments: list[str], code: int, fragment: str) -> None:
    process = run(*arguments)
    assert process.returncode == code, process.stderr
    assert process.stdout == ""
    assert fragment in one_sentence(process)


@pytest.mark.parametrize(
    "arguments", [["no-such-command"], ["quiz", "--level", "9"], ["generate", "-n", "0"], ["show"]]
)
def test_usage_errors_exit_2(arguments: list[str]) -> None:
    process = run(*arguments)
    assert process.returncode == 2
    assert "Traceback" not in process.stderr


@pytest.fixture
def own_signals() -> Iterator[None]:
    """What a command does with SIGPIPE does not outlast the test: the next write to a closed pipe would end pytest."""
    before = signal.getsignal(signal.SIGPIPE)
    yield
    signal.signal(signal.SIGPIPE, before)


@pytest.mark.usefixtures("own_signals")
def test_an_error_of_our_own_exits_70_without_a_traceback(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from rldrill import cli

    monkeypatch.setattr(sys, "argv", ["rldrill", "show", "td-zero/1/1"])
    monkeypatch.setattr("rldrill.exercise.load", lambda _: 1 / 0)
    with pytest.raises(SystemExit) as caught:
        cli.main()
    assert caught.value.code == 70
    assert "Traceback" not in capsys.readouterr().err


@pytest.mark.usefixtures("own_signals")
def test_a_broken_family_is_a_sentence_to_its_author(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from rldrill import cli
    from rldrill.problems.catalogue import family
    from rldrill.problems.fundamentals import expected_return

    monkeypatch.setattr(sys, "argv", ["rldrill", "show", "expected-return/1/1"])
    monkeypatch.delattr(expected_return, "TITLE")
    family.cache_clear()
    with pytest.raises(SystemExit) as caught:
        cli.main()
    assert caught.value.code == 70
    says = capsys.readouterr().err
    assert says.endswith("expected_return.py: a family must have TITLE; add it.\n")
    assert "report" not in says


def test_data_goes_to_stdout_and_the_seed_to_stderr() -> None:
    first = run("generate", "td-zero", "-n", "3", "--seed", "5", "--answers")
    again = run("generate", "td-zero", "-n", "3", "--seed", "5", "--answers", COLUMNS="40")
    assert first.stdout == again.stdout
    assert first.stderr == "seed 5\n"
    problems = [json.loads(line) for line in first.stdout.splitlines()]
    assert len(problems) == 3
    for problem in problems:
        # What was printed is a problem file: reading it gives the same answers.
        exercise = rldrill.read(problem)
        assert exercise.data()["parts"] == problem["parts"]
        assert exercise.data()["steps"] == problem["steps"]


def test_solve_prints_the_answers_first_then_the_working() -> None:
    text = run("solve", "examples/racing-car.toml").stdout
    assert text.index("V₂(cool) = 7/2") < text.index("V₂(warm) = 5/2") < text.index("Working") < text.index("Sweep 1")
    assert "max{1·(1 + 1·2); 1/2·(2 + 1·2) + 1/2·(2 + 1·1)}" in text


def test_solve_as_data() -> None:
    data = json.loads(run("solve", "examples/gridworld-4-1.toml", "--json").stdout)
    assert data["parts"][0]["answer"]["exact"]["1"] == "-14"
    assert data["steps"][0]["formula"] == "bellman-v"


def test_a_pipe_that_closes_early_is_no_error() -> None:
    process = subprocess.run(
        f"{sys.executable} -m rldrill generate td-zero -n 400 --seed 1 | head -1; echo ${{PIPESTATUS[0]}}",
        shell=True, executable="/bin/bash", capture_output=True, text=True, cwd=ROOT, timeout=60,
    )  # fmt: skip
    assert process.stderr == "seed 1\n"
    assert process.stdout.splitlines()[-1] == "141"  # ended by SIGPIPE, as cat and grep are


@pytest.mark.parametrize(("arguments", "code"), [(["list"], 0), (["show", "nothing"], 2)])
def test_a_command_that_ends_at_once_has_written_all_and_run_its_exit_handlers(arguments: list[str], code: int) -> None:
    program = "import atexit; atexit.register(print, 'the last line'); from rldrill.__main__ import run; run()"
    process = subprocess.run(
        [sys.executable, "-c", program, *arguments], capture_output=True, text=True, encoding="utf-8", timeout=120,
        cwd=ROOT, check=False,
    )  # fmt: skip
    assert process.returncode == code
    assert process.stdout.endswith("the last line\n")
    assert ("td-zero" in process.stdout) == (code == 0)


def test_ctrl_c_while_the_program_is_imported_ends_it_without_a_traceback() -> None:
    program = (
        "import sys\n"
        "class Interrupted:\n"
        "    def find_spec(self, name, *rest):\n"
        "        if name == 'rldrill.cli': raise KeyboardInterrupt\n"
        "sys.meta_path.insert(0, Interrupted())\n"
        "from rldrill.__main__ import run\n"
        "run()"
    )
    process = subprocess.run([sys.executable, "-c", program], capture_output=True, timeout=120, cwd=ROOT, check=False)
    assert (process.returncode, process.stdout, process.stderr) == (130, b"", b"")


def test_without_a_home_and_with_an_ascii_terminal() -> None:
    process = run("show", "td-zero/1/1", HOME="/nonexistent", LC_ALL="C", PYTHONIOENCODING="ascii")
    assert "Traceback" not in process.stderr
    assert process.returncode == 0


def test_the_audit_exits_1_on_a_disagreement(monkeypatch: pytest.MonkeyPatch) -> None:
    from rldrill.audit.checking import audit
    from rldrill.solutions import solution

    real = solution.solver
    import numpy as np
    from msgspec.structs import replace

    def broken(family):  # type: ignore[no-untyped-def]
        return replace(real(family), oracle=lambda given: [np.add(each, 1e9) for each in real(family).oracle(given)])

    monkeypatch.setattr("rldrill.audit.checking.solver", broken)
    (finding, *_) = audit(["td-zero"], number=2, seed=0)
    assert len(finding.disagreements) == 2
    assert not finding.clean


def test_completion_offers_names_and_ids() -> None:
    from rldrill.commands.arguments import complete_ids, complete_names

    assert complete_names("td-z") == ["td-zero"]
    assert "temporal-difference" in complete_names("temp")
    assert complete_ids("td-zero/") == ["td-zero/1/", "td-zero/2/", "td-zero/3/"]


def test_the_version() -> None:
    assert run("--version").stdout.strip() == rldrill.__version__
