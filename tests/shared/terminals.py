"""A quiz that runs in a pseudo-terminal."""

import os
import re
import shlex
import signal
import sys
import termios
import time
from pathlib import Path

import pexpect

#: A blank, or a line that ends there, or a colour that does, or the cursor that is moved over blanks.
_BLANK = r"(?:[\s\b]|\x1b\[[0-9;?]*[A-Za-z])"


class Terminal:
    """A quiz that runs, with a history of its own.

    Args:
        home: where its history lies.
        width: the columns of the terminal.
        arguments: what stands behind ``rldrill quiz``.
        then: what a shell with job control does when the quiz has been stopped or has ended; no shell, if nothing.
        environment: variables.
    """

    def __init__(self, home: Path, width: int, *arguments: str, then: str = "", **environment: str) -> None:
        command = [sys.executable, "-m", "rldrill", "quiz", *arguments]
        if then:
            command = ["bash", "-mc", f"{shlex.join(command)}; {then}"]
        own = {"TERM": "xterm", "NO_COLOR": "1", "RLDRILL_HOME": str(home), "PYTHONUTF8": "1", **environment}
        inherited = {name: value for name, value in os.environ.items() if name not in ("COLUMNS", "LINES")}
        self.child = pexpect.spawn(
            command[0], command[1:], encoding="utf-8", timeout=15, echo=False, dimensions=(30, width),
            env={**inherited, **own}, preexec_fn=_deaf,
        )  # fmt: skip

    def presses(self, keys: str, *then: str) -> None:
        """Press keys, without Enter, and wait for one text after the other."""
        self.child.send(keys)
        self.sees(*then)

    def types(self, line: str, *then: str) -> None:
        """Type a line, and wait for one text after the other."""
        self.child.sendline(line)
        self.sees(*then)

    def sees(self, *texts: str) -> None:
        """Wait for one text after the other."""
        for text in texts:
            self.child.expect(re.escape(text).replace(r"\ ", rf"{_BLANK}+") + f"{_BLANK}*")

    def is_read(self) -> None:
        """Wait until every key is read as it comes: what was typed before would be lost with a signal."""
        until = time.monotonic() + 10
        while termios.tcgetattr(self.child.child_fd)[3] & termios.ICANON:
            assert time.monotonic() < until
            time.sleep(0.01)

    def ends(self) -> int:
        """Wait for the end; what is returned is the exit code."""
        self.child.expect(pexpect.EOF)
        self.child.close()
        assert isinstance(self.child.exitstatus, int)
        return self.child.exitstatus


def _deaf() -> None:
    """A child inherits what whoever runs the tests has blocked and ignores; the quiz must not mind."""
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    signal.signal(signal.SIGINT, signal.SIG_IGN)
