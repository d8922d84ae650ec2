"""The command line: one module for every command, and one place where errors become sentences."""

import os
import signal
import sys
from codecs import register_error
from importlib import import_module
from io import TextIOWrapper
from typing import IO

import typer

from rldrill.problems.errors import BrokenFamily, UserError, reason

INTERNAL_ERROR = 70

app = typer.Typer(
    name="rldrill",
    help="Drill the formulas of Reinforcement Learning and Robot Learning, with exact answers.",
    epilog="Start with 'rldrill quiz'. Exit codes: 0 all right, 1 answers wrong, 2 usage, 3 a bad file, "
    "4 nothing to grade, 70 our own fault, 130 Ctrl-C.",
    no_args_is_help=True,
    context_settings={"help_option_names": ["-h", "--help"]},
    pretty_exceptions_enable=False,
)
_COMMANDS = (
    "quiz", "stats", "history", "worksheet", "verify", "solve", "show", "sheet", "list_", "fields", "gallery",
    "generate", "audit",
)  # fmt: skip
_NAMED = [name for name in _COMMANDS if sys.argv[1:2] == [name.rstrip("_")]]
for module in [import_module(f"rldrill.commands.{name}") for name in _NAMED or _COMMANDS]:  # others only take time
    app.command(module.NAME)(module.command)


@app.callback(invoke_without_command=True)
def version(
    show_version: bool = typer.Option(False, "--version", help="Print the version and exit."),
) -> None:
    """Drill the formulas of Reinforcement Learning and Robot Learning, with exact answers."""
    if show_version:
        from rldrill import __version__

        typer.echo(__version__)
        raise typer.Exit


def _end(*_: object) -> None:
    """Whoever is told to end takes its processes along."""
    sys.exit(128 + signal.SIGTERM)


def main() -> None:
    """Run a command; whatever goes wrong ends in one sentence and the exit code that belongs to it."""
    _open_streams()
    if hasattr(signal, "SIGPIPE"):
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # when nobody reads on, end quietly as every Unix tool does
    signal.signal(signal.SIGTERM, _end)
    try:
        try:
            app()
        finally:
            sys.stdout.flush()  # a full disk is told here, not by the interpreter when it ends
    except UserError as error:
        fail(str(error), error.exit_code)
    except BrokenFamily as error:
        fail(str(error), INTERNAL_ERROR)
    except OSError as error:
        if error.filename is None and error.errno is None:
            raise
        sys.stdout = _nowhere("w")  # what cannot be written is not tried again
        fail(f"{error.filename or 'The system'}: {reason(error)}.", 3)
    except Exception as error:
        if "RLDRILL_DEBUG" in os.environ:
            raise
        fail(
            f"rldrill itself failed ({type(error).__name__}: {error}). Please report it with the command that you "
            "ran; RLDRILL_DEBUG=1 shows where.",
            INTERNAL_ERROR,
        )


def _open_streams() -> None:
    """Stand in for streams that are closed, and let the others spell the signs that they lack."""
    register_error("rldrill", _spelled)
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            setattr(sys, name, _nowhere(mode))
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="rldrill")


def _nowhere(mode: str) -> IO[str]:
    """A stream that is always empty and takes everything."""
    return os.fdopen(os.open(os.devnull, os.O_RDWR), mode, encoding="utf-8")


def _spelled(error: UnicodeError) -> tuple[str, int]:
    from rldrill.render.encodable import replaced

    return replaced(error)


def fail(sentence: str, code: int) -> None:
    """Print one sentence to stderr and exit."""
    print(f"rldrill: {sentence}", file=sys.stderr)
    sys.exit(code)


if __name__ == "__main__":
    main()
