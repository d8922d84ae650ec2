"""Typing at the prompt: lines with editing and history, pasted lines together, and keys that need no Enter."""

import contextlib
import os
import signal
import sys
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Protocol, TypeAlias

if TYPE_CHECKING:
    from prompt_toolkit.application import Application
    from prompt_toolkit.key_binding import KeyBindings, KeyPressEvent

#: So long after a line, in seconds, the next one of a paste has come; nobody types so fast.
_PASTED = 0.03
#: So long the window has had its size when everything is shown anew.
_STILL = 0.1
#: Every key that any prompt offers without Enter; a blank goes on, as Enter does.
_ALONE = "nptwvrqf? "


#: What stands before what is typed; one that is worked out is so again every second, as a clock is.
Prompt: TypeAlias = str | Callable[[], str]


class Ask(Protocol):
    """Asks for what is typed: a line, or the lines that are pasted together. EOFError is the end of input."""

    def __call__(self, prompt: Prompt, keys: str = "", /) -> str:
        """Ask; each of ``keys``, at the beginning of the line, needs no Enter where the terminal knows keys."""


def line_editor(redraw: Callable[[], None], *, plain: bool) -> Ask:
    """What asks for lines in this terminal.

    Args:
        redraw: shows all above the prompt once more, after the window got another size and after Ctrl-Z and ``fg``.
        plain: whether the terminal knows lines only, or what stands there is read out.
    """
    _hear_ctrl_c()
    if not plain:
        return _Editor(redraw)
    with contextlib.suppress(ImportError):  # Windows' own console edits lines by itself
        import readline

        # A paste is then put into the line as a whole, and Enter ends it.
        readline.parse_and_bind("set enable-bracketed-paste on")
    return Lines()


class Lines:
    """Lines with their Enter, whatever the keys; what is pasted or typed ahead is taken together."""

    def __init__(self) -> None:
        self._prompt = ""
        if sys.platform != "win32":
            signal.signal(signal.SIGCONT, self._again)

    def __call__(self, prompt: Prompt, _keys: str = "", /) -> str:
        """Ask for a line."""
        self._prompt = prompt() if callable(prompt) else prompt
        typed = [input(self._prompt)]
        while _is_waiting():
            try:
                typed.append(input())
            except EOFError:
                break
        return "\n".join(typed)

    def _again(self, *_: object) -> None:
        """After ``fg`` show what is asked, and what was typed; the shell has let the terminal echo meanwhile."""
        import readline
        import termios

        mode = termios.tcgetattr(sys.stdin)
        mode[3] &= ~(termios.ECHO | termios.ICANON)
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, mode)
        print(f"\n{self._prompt}{readline.get_line_buffer()}", end="", flush=True)


class _Editor:
    """Lines, and keys, where the terminal can place its cursor."""

    def __init__(self, redraw: Callable[[], None]) -> None:
        # Nothing is drawn below the prompt, so that the terminal need not be asked where the cursor stands.
        os.environ.setdefault("PROMPT_TOOLKIT_NO_CPR", "1")
        from prompt_toolkit import PromptSession

        self._redraw = redraw
        self._keys = ""
        self._session: PromptSession[str] = PromptSession(key_bindings=self._bindings())
        app = self._session.app
        self._size = app.output.get_size()
        app.before_render += self._look_at_size

    def __call__(self, prompt: Prompt, keys: str = "", /) -> str:
        self._keys = keys
        # Python's own way with Ctrl-C loses none that comes while a prompt begins or ends.
        return self._session.prompt(prompt, refresh_interval=float(callable(prompt)), handle_sigint=False)

    def _bindings(self) -> "KeyBindings":
        from prompt_toolkit.filters import Condition
        from prompt_toolkit.key_binding import KeyBindings

        bindings = KeyBindings()
        for key in _ALONE:
            bindings.add(key, filter=Condition(partial(self._offers, key)))(_press)
        bindings.add("enter", filter=Condition(self._is_more_coming))(_next_line)
        bindings.add("c-z")(self._suspend)
        bindings.add("c-l")(self._clear)
        return bindings

    def _offers(self, key: str) -> bool:
        """Whether a key needs no Enter now: what comes in one burst is a text that was pasted or typed ahead."""
        return key in self._keys and not self._session.default_buffer.text and not self._is_more_coming()

    def _is_more_coming(self) -> bool:
        return bool(self._session.app.key_processor.input_queue)

    def _suspend(self, event: "KeyPressEvent") -> None:
        from prompt_toolkit.application import run_in_terminal

        event.app.suspend_to_background()
        run_in_terminal(self._redraw)

    def _clear(self, _: "KeyPressEvent") -> None:
        from prompt_toolkit.application import run_in_terminal

        run_in_terminal(self._redraw)

    def _look_at_size(self, app: "Application[str]") -> None:
        """Wait until the window is let go, then show everything anew."""
        from prompt_toolkit.application import run_in_terminal

        size = app.output.get_size()
        if size == self._size or app.loop is None:
            return

        def when_still() -> None:
            if app.output.get_size() == size != self._size and app.is_running:
                self._size = size
                run_in_terminal(self._redraw)

        app.loop.call_later(_STILL, when_still)


def _press(event: "KeyPressEvent") -> None:
    """End the line with the key alone; the arrow keys do not bring it back, as they do an answer."""
    event.current_buffer.insert_text(event.data)
    event.app.exit(result=event.data)


def _next_line(event: "KeyPressEvent") -> None:
    event.current_buffer.insert_text("\n")


def _hear_ctrl_c() -> None:
    """Whoever sits there may press Ctrl-C, though a script that started us has ignored or blocked it."""
    if is_interactive():
        signal.signal(signal.SIGINT, signal.default_int_handler)
        if sys.platform != "win32":
            signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})


def _is_waiting() -> bool:
    """Whether more has been typed already, as when lines are pasted on a terminal that does not say so."""
    if sys.platform == "win32":
        import msvcrt

        return msvcrt.kbhit()
    import select

    return bool(select.select([sys.stdin], [], [], _PASTED)[0])


def is_interactive() -> bool:
    """Whether somebody sits at both ends."""
    return sys.stdin.isatty() and sys.stdout.isatty()
