"""A newcomer's first minutes, key by key: what is new on the screen after each, and what the clock says.

    pip install pyte
    python benchmarks/newcomer.py [COLUMNS LINES] > minutes.txt

The time is the program's and that of typing; reading and thinking are left out.
"""

import os
import re
import sys
import tempfile
import time

import pexpect
import pyte

from rldrill.exercise import Exercise, load
from rldrill.solutions.answers.kinds import answer_kind

#: So long between two keys; so long nothing more is written when the program waits.
_KEY, _QUIET = 0.12, 0.4
_NAMES = {"\r": "Enter", " ": "the space bar", "\x1b[A": "up", "\x03": "Ctrl-C"}


class Newcomer:
    """Somebody at a terminal, whose screen is written down."""

    def __init__(self, home: str, columns: int, lines: int) -> None:
        self._screen = pyte.Screen(columns, lines)
        self._stream = pyte.Stream(self._screen)
        self._size, self._home = (lines, columns), home
        self._begun, self._written = time.perf_counter(), ""
        self._before: list[str] = []

    def starts(self) -> None:
        """Start the quiz."""
        self._screen.reset()
        self._child = pexpect.spawn(
            sys.executable, ["-m", "rldrill", "quiz"], encoding="utf-8", dimensions=self._size,
            env={**os.environ, "RLDRILL_HOME": self._home, "TERM": "xterm-256color"},
        )  # fmt: skip
        self._shows("rldrill quiz")

    def presses(self, keys: str) -> None:
        """Press keys one by one."""
        for key in re.findall(r"\x1b\[.|.", keys, re.DOTALL):
            time.sleep(_KEY)
            self._child.send(key)
        self._shows(" ".join(_NAMES.get(key, key) for key in re.findall(r"\x1b\[.|[\r\x03 ]|[^\x1b\r\x03]+", keys)))

    @property
    def exercise(self) -> Exercise:
        """The problem on the screen, by its ID."""
        return load(re.findall(r"[a-z-]+/\d/\d+@\d+", self._written)[-1])

    def right(self, label: str = "a") -> str:
        """The right answer to a part."""
        part = next(part for part in self.exercise.parts if part.label == label)
        return answer_kind(part.kind).write(self.exercise.solution.answers[label])

    def wrong(self, label: str = "a") -> str:
        """The likeliest wrong answer to a part."""
        return self.exercise.diagnosing.wrong_answers(label, 1)[0].answer

    def _is_asked(self) -> bool:
        """Whether the cursor stands behind a prompt."""
        return self._screen.display[self._screen.cursor.y].rstrip().endswith(">")

    def _shows(self, pressed: str) -> None:
        last = time.perf_counter()
        while not self._is_asked() or time.perf_counter() - last < _QUIET:
            try:
                written = self._child.read_nonblocking(65536, timeout=0.05)
                self._written += written
                self._stream.feed(written)
                last = time.perf_counter()
            except pexpect.TIMEOUT:
                continue
            except pexpect.EOF:
                break
        print(f"\n[{last - self._begun:5.1f} s] {pressed}")
        shown = "\n".join(line.rstrip() for line in self._screen.display).rstrip().splitlines()
        print("\n".join(f"  | {line}".rstrip() for line in _new(self._before, shown)))
        self._before = shown


def _new(before: list[str], shown: list[str]) -> list[str]:
    """The lines that were not there before, however far those have scrolled; the prompt was, but for what was typed."""
    for gone in range(len(before)):
        kept = before[gone:-1]
        if kept and shown[: len(kept)] == kept:
            return shown[len(kept) :]
    return shown


def main() -> None:
    """Print the record."""
    columns, lines = ([int(each) for each in sys.argv[1:]] + [80, 24][len(sys.argv) - 1 :])[:2]
    with tempfile.TemporaryDirectory() as home:
        somebody = Newcomer(home, columns, lines)
        somebody.starts()
        somebody.presses("\r")
        somebody.presses("\r")
        somebody.presses(f"{somebody.wrong()}\r")
        somebody.presses("hint\r")
        somebody.presses(f"{somebody.right()}\r")
        somebody.presses(f"{somebody.right('b')}\r")
        somebody.presses("w")
        somebody.presses("\r")
        somebody.presses("t")
        somebody.presses("n")
        somebody.presses("?")
        somebody.presses("banana\r")
        somebody.presses("skip\r")
        somebody.presses("5\r")
        somebody.presses("q")
        somebody.presses("f")
        somebody.presses("3\r")
        somebody.presses("\x03")
        somebody.starts()


if __name__ == "__main__":
    main()
