"""What the README shows is what the program does: its commands are run, its picture is drawn again."""

import os
import re
import shutil
import subprocess
import sys
from io import StringIO
from pathlib import Path

import pytest
from rich.console import Console

from rldrill.quiz.questions import questions
from rldrill.quiz.screen import Screen
from rldrill.quiz.session import Session

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", README, re.MULTILINE | re.DOTALL)


def shown() -> list[tuple[str, int, list[str]]]:
    """Every command of the README, the exit code it says, and the lines it shows beneath it."""
    found = []
    for block in blocks("console"):
        for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
            command, *lines = part.splitlines()
            code = re.search(r"# exit (\d+)", command)
            found.append((command.partition("#")[0].strip(), int(code[1]) if code else 0, lines))
    return found


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("readme")
    shutil.copytree(ROOT / "examples", path / "examples")
    return path


@pytest.mark.parametrize(("command", "code", "lines"), shown(), ids=[command for command, _, _ in shown()])
def test_commands(command: str, code: int, lines: list[str], folder: Path) -> None:
    program, *arguments = command.split()
    assert program == "rldrill"
    process = subprocess.run(
        [sys.executable, "-m", "rldrill", *arguments], cwd=folder, capture_output=True, text=True, encoding="utf-8",
        env={**os.environ, "PYTHONPATH": str(ROOT), "NO_COLOR": "1", "PYTHONIOENCODING": "utf-8",
             "COLUMNS": "140"},
    )  # fmt: skip
    assert process.returncode == code, process.stderr
    printed = iter(" ".join(line.split()) for line in process.stdout.splitlines())
    for line in lines:
        if line != "…":
            wanted = " ".join(line.split())
            assert any(wanted == found for found in printed), f"{command} does not print {wanted!r} there"


def test_every_command_has_its_place_in_the_tour() -> None:
    from rldrill.cli import app

    for command in app.registered_commands:
        assert re.search(rf"`(rldrill )?{command.name}`|rldrill {command.name}\b", README)


def test_the_picture_of_the_quiz() -> None:
    picture = README.partition("<!-- quiz: racing car -->\n```text\n")[2].partition("```")[0]
    typed = iter(re.findall(r"^\([a-z]\) > (.*)$", picture, re.MULTILINE))
    screen = Console(file=StringIO(), width=98, highlight=False, markup=False)

    def ask(prompt: str) -> str:
        line = next(typed, None)
        if line is None:
            raise EOFError
        screen.print(prompt + line)
        return line

    exercises, total = questions([str(ROOT / "examples" / "racing-car.toml")], 1, None, lambda: 0)
    Screen(screen, ask).run(exercises, Session(total))
    assert isinstance(screen.file, StringIO)
    seen = "\n".join(line.rstrip() for line in screen.file.getvalue().splitlines())
    assert picture.strip() in seen


def test_the_library_lines_run() -> None:
    (block,) = blocks("python")
    process = subprocess.run(
        [sys.executable, "-c", block], capture_output=True, text=True, encoding="utf-8", check=True,
        env={**os.environ, "PYTHONPATH": str(ROOT), "PYTHONIOENCODING": "utf-8"},
    )  # fmt: skip
    first, second = process.stdout.splitlines()
    assert first.startswith('What is $V("')
    assert second.partition(" ")[0] in ("right", "misconception", "wrong", "unreadable", "close")


def test_links_lead_somewhere() -> None:
    for link in re.findall(r"\]\(([^)#]+)\)", README):
        if not link.startswith("http"):
            assert (ROOT / link).exists(), link
