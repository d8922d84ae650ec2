"""What stands on the screen since a problem began, so that it can be shown once more where the window has changed."""

from collections.abc import Iterable

from rich.console import Console, RenderableType
from rich.control import Control
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from rldrill.quiz.prompt import Ask, Prompt
from rldrill.render.compact import WIDEST
from rldrill.render.encodable import Spelling
from rldrill.render.terminal import turn_page, words


class Display:
    """Prints on a console and asks through ``ask``, and keeps both until the page is turned.

    Args:
        console: where it is shown.
        ask: asks for a line.
        plain: whether it is read out, so that there are no pages.
        said: what stands there already.
    """

    def __init__(self, console: Console, ask: Ask, *, plain: bool = False, said: str = "") -> None:
        self.console = console
        self._typed = ask
        self._spelling = Spelling(console.encoding)
        self._plain = plain
        self._shown: list[tuple[RenderableType, bool]] = [(Text(said), False)] if said else []
        self._begun = False

    @property
    def width(self) -> int:
        """How wide a text may be: no wider than is read well."""
        return min(self.console.width, WIDEST)

    def turn(self) -> None:
        """Go on at the top of the screen; but what was said before the first problem stays."""
        begun, self._begun = self._begun, True
        if begun and not self._plain:
            turn_page(self.console)
            self._shown.clear()

    def redraw(self) -> None:
        """Show once more what was printed and typed since the page was turned, as wide as the window is now."""
        self.console.control(Control.home(), Control.clear())
        for content, whole in self._shown:
            self._show(content, whole=whole)

    def ask(self, prompt: Prompt, keys: str = "") -> str:
        """Ask for a line, or for one of the keys, which need no Enter."""

        def written() -> str:
            return self._spelling.plain(prompt() if callable(prompt) else prompt)

        typed = self._typed(written if callable(prompt) else written(), keys)
        self._shown.append((Text(f"{written()}{typed}"), False))
        return typed

    def print(self, content: RenderableType = "", *, whole: bool = False) -> None:
        """Print; a ``whole`` line, one with a path or a command, is not broken, so that it can be copied."""
        self._shown.append((content, whole))
        self._show(content, whole=whole)

    def keys(self, told: Iterable[tuple[str, str]]) -> None:
        """Print what may be typed, and what each of it does."""
        table = Table.grid(padding=(0, 2))
        for key, meaning in told:
            table.add_row(Text(f"  {key}", style="bold"), words(meaning))
        self.print(table)

    def indented(self, content: RenderableType) -> None:
        """Print a little to the right."""
        self.print(Padding(content, (0, 0, 0, 2), expand=False))

    def signed(self, sign: tuple[str, str], content: RenderableType) -> None:
        """Print a sign or word, with its style, and what it is about, whose further lines stand under the first."""
        grid = Table.grid(padding=(0, 1))
        grid.add_column(no_wrap=True)
        grid.add_column(overflow="fold")
        grid.add_row(words(sign), content)
        self.indented(grid)

    def _show(self, content: RenderableType, *, whole: bool) -> None:
        self.console.print(content, width=None if whole else self.width, soft_wrap=whole)
