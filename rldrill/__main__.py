"""The program ``rldrill``, and ``python -m rldrill``."""

import atexit
import gc
import os
import sys
from contextlib import suppress
from typing import NoReturn

#: Commands that have ended before there is anything worth collecting; or that turn it on again, once all is imported.
_BRIEF = frozenset({"list", "show", "solve", "verify"})


def run() -> NoReturn:
    """Run a command, and end at once: taking down what was imported takes longer than most commands themselves."""
    if not _BRIEF.isdisjoint(sys.argv[1:2]):
        gc.disable()
    code = 0
    try:
        from rldrill.cli import main

        main()
    except SystemExit as end:
        if isinstance(end.code, str):
            raise
        code = end.code or 0
    except KeyboardInterrupt:  # while the command is imported; from then on Typer ends it so
        code = 130
    atexit._run_exitfuncs()  # of what child processes there are, say
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):  # ``main`` has told of what cannot be written
            stream.flush()
    os._exit(code)


if __name__ == "__main__":
    run()
