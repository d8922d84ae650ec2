"""The catalogue as a site: a page for every family, and a front page that searches them without a server."""

from collections.abc import Iterator
from html import escape
from itertools import groupby
from pathlib import Path
from unicodedata import name, normalize

from msgspec import Struct

from rldrill.exercise import Exercise, draw
from rldrill.export.html import HTML, part_form, scripts, tasks
from rldrill.export.page import beside, page
from rldrill.export.words import page_words
from rldrill.misreading import misreading
from rldrill.problems.catalogue import family as family_of
from rldrill.problems.document import Equation, Paragraph
from rldrill.problems.headers import Header
from rldrill.render.mathematics.unicode import inline
from rldrill.render.unicode import unicode_text
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.solution import solver
from rldrill.writing import write_bytes_atomically

_TITLE = "rldrill: what can be drilled"
_SEED = 1
#: What something is called elsewhere, so that it is found by that, too.
_ALSO = {
    "step size": "learning rate",
    "discount": "discount factor",
    "greedy": "exploration exploitation",
    "td(": "temporal difference",
    "lqr": "linear quadratic regulator",
    "bic": "bayesian information criterion",
    "advantage": "gae",
    "trace": "eligibility",
    "covariance": "sigma",
}


def gallery(folder: Path, headers: tuple[Header, ...]) -> Iterator[Path]:
    """Write the site: ``index.html``, and beside it a page for every family.

    Args:
        folder: where; it is made if it is not there.
        headers: the families, in the order of the catalogue.

    Raises:
        OSError: a file cannot be written; ``filename`` says which.
    """
    folder.mkdir(parents=True, exist_ok=True)
    cards: list[_Card] = []
    for header in headers:
        exercises = tuple(draw(header.name, level, _SEED) for level in header.levels)
        formulas = tuple(dict.fromkeys(formula for exercise in exercises for formula in exercise.formulas()))
        cards.append(_Card(header, formulas, _searched(header, exercises, formulas)))
        path = folder / f"{header.name}.html"
        write_bytes_atomically(path, _family(header, exercises, formulas).encode())
        yield path
    write_bytes_atomically(folder / "index.html", _front(cards).encode())
    yield folder / "index.html"


class _Card(Struct, frozen=True):
    """A family on the front page: its formulas, and the words that it is found by."""

    header: Header
    formulas: tuple[Formula, ...]
    words: str


def _searched(header: Header, exercises: tuple[Exercise, ...], formulas: tuple[Formula, ...]) -> str:
    """All that is said of a family, every word once: its questions, formulas and mistakes, also by other names."""
    said = [header.name, header.topic.replace("_", " "), header.title, header.summary, header.source]
    for formula in formulas:
        said += (formula.title, unicode_text(formula.equation()), formula.hint)
    for mistake in solver(family_of(header.name)).misconceptions:
        said += (mistake.name, mistake.says)
    for exercise in exercises:
        said += (block.text for block in exercise.question() if isinstance(block, Paragraph))
        said += (part.ask for part in exercise.parts)
    text = inline(" ".join(said))
    found = text.lower()
    also = " ".join(other for one, other in _ALSO.items() if one in found)
    return " ".join(dict.fromkeys((*found.split(), *also.split(), *_greek(text))))


def _greek(text: str) -> Iterator[str]:
    """The names of the small Greek letters in a text; large ones are signs of sums and products."""
    for sign in sorted(set(normalize("NFD", text))):
        if (named := name(sign, "")).startswith("GREEK SMALL"):
            yield named.split()[-1].lower().replace("lamda", "lambda")


def _front(cards: list[_Card]) -> str:
    sections = "".join(
        f'<section><h2>{escape(_topic(topic))}</h2>\n<ul class="cards">\n{"".join(map(_card, found))}</ul></section>\n'
        for topic, found in groupby(cards, key=lambda card: card.header.topic)
    )
    body = (
        f"<h1>{_TITLE}</h1>\n<p>{len(cards)} families of problems, each drawn anew for every seed, solved step by step "
        "and judged exactly. Every page shows an example at each level; answers can be tried on the page.</p>\n"
        '<p><label for="search">Search</label> <input type="text" id="search" autocomplete="off"> '
        '<span id="found" role="status"></span></p>\n'
    )
    return page(_TITLE, body + sections, more=f"<script>\n{beside('search.js')}{beside('search_page.js')}</script>\n")


def _card(card: _Card) -> str:
    header, formulas = card.header, card.formulas
    first = f'<div class="wide" tabindex="0">{HTML.block(formulas[0].equation())}</div>' if formulas else ""
    return (
        f'<li data-text="{escape(card.words)}"><a href="{header.name}.html">{HTML.text(header.title)}</a> '
        f"<small>{header.name}</small>\n<p>{HTML.text(header.summary)}</p>{first}</li>\n"
    )


def _topic(topic: str) -> str:
    words = topic.replace("_", " ")
    return words[:1].upper() + words[1:]


def _family(header: Header, exercises: tuple[Exercise, ...], formulas: tuple[Formula, ...]) -> str:
    stated = "".join(
        f"<h3>{HTML.text(formula.title)} <small>{escape(formula.source)}</small></h3>{HTML.block(formula.equation())}"
        f"<p>{HTML.text(formula.hint)}</p>"
        for formula in formulas
    )
    made = _mistakes(header, exercises)
    leveled = list(zip(header.levels, exercises, strict=True))
    examples = "".join(_example(level, item) for level, item in leveled)
    body = (
        f'<nav><a href="index.html">All families</a></nav>\n<h1>{HTML.text(header.title)}</h1>\n'
        f"<p>{HTML.text(header.summary)} <small>{escape(header.source)}</small></p>\n"
        f"<p><code>rldrill quiz {header.name}</code></p>\n{examples}"
        f"<section><h2>Formulas</h2>\n{stated}</section>\n"
        f"<section><h2>Typical mistakes</h2>\n<ul>{made}</ul></section>\n"
        '<p id="score" role="status"></p>\n'
    )
    return page(f"{header.title} · rldrill", body, more=scripts(tasks(leveled), page_words("en")))


def _mistakes(header: Header, exercises: tuple[Exercise, ...]) -> str:
    """What is said of the family's mistakes, and how those that read a formula otherwise read it."""
    said: dict[str, Equation | None] = {}
    for mistake in solver(family_of(header.name)).misconceptions:
        read = next(filter(None, (misreading(exercise.solution, mistake) for exercise in exercises)), None)
        said[mistake.says] = said.get(mistake.says) or read
    return "".join(f"<li>{HTML.text(says)}{HTML.block(read) if read else ''}</li>" for says, read in said.items())


def _example(level: int, exercise: Exercise) -> str:
    parts = "".join(part_form("en", level, exercise, part, practice=True) for part in exercise.parts)
    return (
        f'<section aria-labelledby="level-{level}"><h2 id="level-{level}">Level {level} '
        f"<small>{escape(exercise.id or '')}</small></h2>\n{HTML.blocks(exercise.question())}\n{parts}</section>\n"
    )
