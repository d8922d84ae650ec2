"""An exam as a deck for Anki: a note for every problem, known again by its ID; the bytes are the same every time."""

import hashlib
import tempfile
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rldrill.exam.exam import Exam
from rldrill.exercise import Exercise
from rldrill.export.asked import Wrong, answer, label, listed, typeset
from rldrill.export.packed import packed
from rldrill.export.page import beside
from rldrill.print.solved import with_mathematics
from rldrill.print.words import Words, words
from rldrill.problems.errors import UsageError
from rldrill.problems.parts import Choice, Part
from rldrill.render.html import LatexHtml

if TYPE_CHECKING:
    import genanki

_MODEL = 1_609_224_471
_FIELDS = ("ID", "Question", "Answer")
_FRONT = "{{Question}}"
_BACK = '{{FrontSide}}<hr id="answer">{{Answer}}<p class="id">{{ID}}</p>'
#: The moment that all notes are of, so that the same exam is the same file.
_TIME = 1_600_000_000.0
_HTML = LatexHtml()


def anki_exam(
    exam: Exam,
    *,
    practice: bool,  # noqa: ARG001
    advance: Callable[[], None] = lambda: None,
) -> bytes:
    """All versions in one package, each as a deck below that of the exam.

    Raises:
        UsageError: genanki is not installed.
    """
    try:
        import genanki
    except ImportError:
        raise UsageError("Anki's decks need genanki: pip install 'rldrill[anki]'.") from None
    model = genanki.Model(
        _MODEL,
        "rldrill",
        fields=[{"name": name} for name in _FIELDS],
        templates=[{"name": "Problem", "qfmt": _FRONT, "afmt": _BACK}],
        css=beside("card.css"),
    )
    decks = []
    for version in exam.versions:
        name = exam.head.title.replace("::", ":") + (f"::{version.code}" if len(exam.versions) > 1 else "")
        deck = genanki.Deck(_number(name), name)
        for exercise in version.exercises:
            deck.add_note(_note(genanki, model, exercise, words(exam.head.language)))
        decks.append(deck)
        advance()
    return _packed(genanki.Package(decks))


def _packed(package: "genanki.Package") -> bytes:
    """The package without the times at which it was made."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "deck.apkg"
        package.write_to_file(str(path), timestamp=_TIME)
        with zipfile.ZipFile(path) as made:
            return packed({name: made.read(name) for name in sorted(made.namelist())})


def _number(text: str) -> int:
    """A number for a name, always the same."""
    return 2**30 + int.from_bytes(hashlib.sha256(text.encode()).digest()[:4], "big") % 2**30


def _note(genanki: Any, model: Any, exercise: Exercise, told: Words) -> Any:
    identity = exercise.id or hashlib.sha256(repr(exercise.problem.data()).encode()).hexdigest()[:16]
    asked = "".join(_asked(exercise, part) for part in exercise.parts)
    solved = "".join(_solved(exercise, part, told) for part in exercise.parts)
    question = f"<h3>{_HTML.text(exercise.problem.family.title)}</h3>{_HTML.blocks(exercise.question())}{asked}"
    return genanki.Note(
        model=model,
        fields=[identity, question, solved],
        guid=genanki.guid_for("rldrill", identity),
        tags=[exercise.problem.family.topic.replace("_", "-"), exercise.problem.family.name],
    )


def _asked(exercise: Exercise, part: Part) -> str:
    options = ""
    if isinstance(part.kind, Choice):
        options = "".join(f"<p>({letter}) {_HTML.text(text)}</p>" for letter, text in part.kind.options.items())
    return f"<p>{label(exercise, part)}{_HTML.text(part.ask)}</p>{options}"


def _solved(exercise: Exercise, part: Part, told: Words) -> str:
    wrong = "".join(_wrong(part, each) for each in listed(exercise, part))
    mistakes = f"<p>{told.mistakes}</p><ul>{wrong}</ul>" if wrong else ""
    return (
        f"<p><b>{label(exercise, part)}</b></p>{_HTML.block(answer(exercise, part, told))}"
        f"{_HTML.blocks(exercise.working(part.label))}{mistakes}"
    )


def _wrong(part: Part, wrong: Wrong) -> str:
    read = "" if wrong.read is None else _HTML.block(wrong.read)
    is_choice = isinstance(part.kind, Choice)
    typed = f"({wrong.cells[0]})" if is_choice else " &emsp; ".join(map(_HTML.math, typeset(part, wrong)))
    return f"<li>{typed}: {_HTML.text(with_mathematics(wrong.says))}{read}</li>"
