"""What the README shows is what the program does: its commands are run, its picture is drawn again."""

import doctest
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
    assert lines, f"README.md does not show what {command} prints"
    assert set(lines) - {"…"}, f"README.md leaves out all that {command} prints"
    printed = "".join(f"{line.rstrip()}\n" for line in process.stdout.rstrip().splitlines())
    assert re.fullmatch(pattern(lines), printed), f"{command} prints\n{printed}"


def pattern(lines: list[str]) -> str:
    """What matches an output that the README shows: all of it, but for what an ellipsis stands for.

    An ellipsis is any lines where it has a line of its own, and the rest of the line where it ends one.
    """
    shown = (re.escape(line[:-1]) + ".*\n" if line.endswith("…") else re.escape(line) + "\n" for line in lines)
    return "".join("(?:.*\n)*" if line == "…" else written for line, written in zip(lines, shown, strict=True))


@pytest.mark.parametrize(
    ("printed", "same"),
    [
        ("a\nb  c\nd\n", True),
        ("a\nb  c\nd\ne\n", False),
        ("x\na\nb  c\nd\n", False),
        ("a\nb c\nd\n", False),
        ("a\nd\n", False),
        ("a\nb  c\n", False),
    ],
)
def test_an_output_that_differs_anywhere_is_noticed(printed: str, same: bool) -> None:
    assert (re.fullmatch(pattern(["a", "b  c", "d"]), printed) is not None) == same
    assert (re.fullmatch(pattern(["…", "a", "b  …", "d"]), printed) is not None) == (same or printed.startswith("x"))


def test_every_command_has_its_place_in_the_tour() -> None:
    from rldrill.cli import app

    for command in app.registered_commands:
        assert re.search(rf"`(rldrill )?{command.name}`|rldrill {command.name}\b", README)


def test_the_picture_of_the_quiz() -> None:
    picture = README.partition("<!-- quiz: racing car -->\n```text\n")[2].partition("```")[0]
    typed = iter(re.findall(r"^\([a-z]\) > (.*)$", picture, re.MULTILINE))
    screen = Console(file=StringIO(), width=98, highlight=False, markup=False)

    def ask(prompt: str, _keys: str = "") -> str:
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


def test_the_library_prints_what_the_readme_shows(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    (block,) = blocks("python")
    lines = doctest.DocTestParser().get_doctest(block, {}, "README.md", None, None)
    assert lines.examples
    found = StringIO()
    assert doctest.DocTestRunner().run(lines, out=found.write).failed == 0, found.getvalue()


def test_links_lead_somewhere() -> None:
    for link in re.findall(r"\]\(([^)#]+)\)", README):
        if not link.startswith("http"):
            assert (ROOT / link).exists(), link
