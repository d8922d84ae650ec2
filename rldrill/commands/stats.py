"""``rldrill stats``."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rldrill.commands.arguments import Json, Names

if TYPE_CHECKING:
    from rldrill.history.memory import Skill
    from rldrill.history.progress import Progress

NAME = "stats"
_ENDINGS = (".svg", ".html", ".png", ".txt")


def command(
    names: Names = None,
    json: Json = False,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FILE", help="A picture: .svg, .png, .html, or .txt.")
    ] = None,
) -> None:
    """Your progress: what is mastered and what is due, day by day, and the mistakes that you make most.

    Examples: rldrill stats · rldrill stats bellman · rldrill stats -o progress.svg
    """
    from datetime import datetime

    from rldrill.commands.output import print_json
    from rldrill.history.log import read
    from rldrill.history.place import history_file, told
    from rldrill.history.progress import progress
    from rldrill.history.zone import LOCAL
    from rldrill.problems.errors import UsageError

    if output is not None and output.suffix.lower() not in _ENDINGS:
        raise UsageError(f"{output} has none of the endings {', '.join(_ENDINGS)}, which say how it is written.")
    path = history_file()
    with told(path):
        attempts = read(path)
    found = progress(attempts, _groups(names or []), datetime.now(LOCAL))
    if json:
        print_json(found.to_json())
    elif output is not None:
        _write(found, output)
    else:
        from rldrill.quiz.progress import shown
        from rldrill.render.terminal import console

        console().print(shown(found))


def _groups(names: list[str]) -> "dict[str, list[Skill]]":
    """All skills by topic; or those of the topics and families that are named, by family."""
    from rldrill.problems.catalogue import chosen, topics
    from rldrill.quiz.planning import skills

    wanted = set(chosen(names))
    topic = {family: name.replace("_", "-") for name, families in topics().items() for family in families}
    groups: dict[str, list[Skill]] = {}
    for skill in sorted(skills(wanted), key=lambda skill: (list(topic).index(skill.family), skill.level)):
        groups.setdefault(skill.family if names else topic[skill.family], []).append(skill)
    return groups


def _write(found: "Progress", output: Path) -> None:
    """Write what the terminal shows as a picture or a page."""
    from io import StringIO

    from rich.console import Console

    from rldrill.quiz.progress import WIDTH, shown
    from rldrill.writing import write_bytes_atomically

    screen = Console(
        file=StringIO(), record=True, width=WIDTH, highlight=False, markup=False, force_terminal=True,
        color_system="truecolor", legacy_windows=False,
    )  # fmt: skip
    screen.print(shown(found))
    ending = output.suffix.lower()
    if ending == ".html":
        data = screen.export_html(inline_styles=True).encode()
    elif ending == ".txt":
        data = screen.export_text().encode()
    else:
        data = screen.export_svg(title="rldrill stats").encode()
    write_bytes_atomically(output, _png(data) if ending == ".png" else data)


def _png(svg: bytes) -> bytes:
    from rldrill.print.paper import png_of_svg

    return png_of_svg(svg.replace(b"Fira Code", b"DejaVu Sans Mono"))  # which Typst has
