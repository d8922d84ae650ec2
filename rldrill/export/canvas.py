"""An exam as quizzes for Canvas: QTI 1.2 with the metadata that Canvas reads, a quiz for every version.

Canvas judges one answer a question by a tolerance, so every number is a question of its own, below one that only
shows what is given. What its importer demands is tested in ``tests/export/test_canvas.py``.
"""

import hashlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from decimal import Decimal
from html import escape
from typing import Literal
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from msgspec import Struct
from msgspec.structs import replace

from rldrill.exam.choices import Language
from rldrill.exam.exam import Exam, Version
from rldrill.exercise import Exercise
from rldrill.export.asked import Cell, Quantity, Word, Wrong, cells, is_open, said_of_words, told_apart, wrong_answers
from rldrill.export.packed import packed
from rldrill.export.with_files import WithFiles
from rldrill.export.words import page_words, typing_note
from rldrill.problems.notations import with_mark
from rldrill.problems.parts import Choice, Part, YesNo
from rldrill.render.mathematics.unicode import inline

_XSI = "http://www.w3.org/2001/XMLSchema-instance"
_QTI = "http://www.imsglobal.org/xsd/ims_qtiasiv1p2"
_PACKAGE = "http://www.imsglobal.org/xsd/imsccv1p1/imscp_v1p1"
_META = "http://canvas.instructure.com/xsd/cccv1p0"
_PLACE = "response_"
_ONLY = "response1"
_BESIDE = "associatedcontent/imscc_xmlv1p1/learning-application-resource"


def canvas_exam(exam: Exam, *, practice: bool, advance: Callable[[], None] = lambda: None) -> bytes:
    """All versions in one package, each as a quiz of its own, none of them published.

    Args:
        exam: the exam.
        practice: whether the working is told after an attempt.
        advance: called after each version.
    """
    manifest = Element("manifest", {"identifier": _name(exam, "manifest"), "xmlns": _PACKAGE})
    schema = SubElement(manifest, "metadata")
    SubElement(schema, "schema").text = "IMS Content"
    SubElement(schema, "schemaversion").text = "1.1.3"
    SubElement(manifest, "organizations")
    resources = SubElement(manifest, "resources")
    files: dict[str, str] = {}
    for version in exam.versions:
        name = _name(exam, version.code)
        writer = WithFiles(f"{name}/picture")
        written = {
            f"{name}/{name}.xml": _xml(_quiz(writer, name, exam, version, practice=practice)),
            f"{name}/assessment_meta.xml": _xml(_settings(name, exam, version, practice=practice)),
        }
        quiz, settings = written
        _resource(resources, name, "imsqti_xmlv1p2", None, (quiz, *writer.files), needs=f"{name}-settings")
        _resource(resources, f"{name}-settings", _BESIDE, settings, (settings,))
        files |= written | writer.files
        advance()
    return packed({"imsmanifest.xml": _xml(manifest), **files})


def _name(exam: Exam, *of: str) -> str:
    """A name that no other exam uses, and that this exam has every time: Canvas knows by it what it has already."""
    text = "\n".join((exam.head.title, exam.head.date, str(exam.seed), *of))
    return f"g{hashlib.sha256(text.encode()).hexdigest()[:32]}"


def _xml(element: Element) -> str:
    ElementTree.indent(element)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{ElementTree.tostring(element, encoding="unicode")}\n'


def _resource(
    resources: Element, name: str, kind: str, href: str | None, files: Iterable[str], needs: str | None = None
) -> None:
    resource = SubElement(resources, "resource", {"identifier": name, "type": kind} | ({"href": href} if href else {}))
    for file in files:
        SubElement(resource, "file", href=file)
    if needs:
        SubElement(resource, "dependency", identifierref=needs)


def _settings(name: str, exam: Exam, version: Version, *, practice: bool) -> Element:
    """What Canvas keeps of a quiz beside its questions."""
    quiz = Element("quiz", {"identifier": name, "xmlns": _META})
    note = typing_note(exam.head, reads="language")
    limit = {} if exam.head.duration is None else {"time_limit": str(exam.head.duration)}
    said = {
        "title": exam.title_of(version),
        "description": "".join(f"<p>{escape(line)}</p>" for line in (exam.head.instructions, note) if line),
        "shuffle_answers": "false",
        "quiz_type": "practice_quiz" if practice else "assignment",
        "points_possible": str(version.points),
        "show_correct_answers": "true" if practice else "false",
        "available": "false",
        "allowed_attempts": "-1" if practice else "1",
        **limit,
    }
    for tag, text in said.items():
        SubElement(quiz, tag).text = text
    return quiz


def _quiz(writer: WithFiles, name: str, exam: Exam, version: Version, *, practice: bool) -> Element:
    root = Element("questestinterop", {"xmlns": _QTI, "xmlns:xsi": _XSI, "xsi:schemaLocation": f"{_QTI} {_QTI}p1.xsd"})
    assessment = SubElement(root, "assessment", ident=name, title=exam.title_of(version))
    _fields(SubElement(assessment, "qtimetadata"), {"cc_maxattempts": "unlimited" if practice else "1"})
    section = SubElement(assessment, "section", ident="root_section")
    for number, exercise in enumerate(version.exercises, 1):
        for place, question in enumerate(_questions(writer, exam.head.language, number, exercise, practice=practice)):
            section.append(_item(question, _name(exam, version.code, str(number), str(place))))
    return root


class _Option(Struct, frozen=True):
    """One of several things to choose: its text as HTML, whether it is right, and what is said of it."""

    text: str
    right: bool
    says: str


class _Question(Struct, frozen=True):
    """A question of a quiz.

    Args:
        kind: what Canvas calls its kind.
        title: its title.
        text: what it asks, as HTML.
        points: what it earns.
        places: the names of its places, and what there is to choose in each.
        number: the number that is right, if one is.
        wrong: what is told after a wrong answer, as HTML.
        working: what is told after any answer, as HTML.
    """

    kind: str
    title: str
    text: str
    points: Decimal = Decimal(0)
    places: tuple[tuple[str, tuple[_Option, ...]], ...] = ()
    number: Quantity | None = None
    wrong: str = ""
    working: str = ""


def _questions(
    writer: WithFiles, language: Language, number: int, exercise: Exercise, *, practice: bool
) -> Iterator[_Question]:
    """What is given, and a question for everything that is asked."""
    title = f"{number:02} {inline(exercise.problem.family.title)}"
    yield _Question("text_only_question", title, writer.blocks(exercise.question()))
    for part in exercise.parts:
        working = writer.solved(exercise, part, language) if practice else ""  # its pictures are files of the package
        for question in _of_part(writer, language, exercise, part):
            yield replace(question, title=f"{title} {question.title}".strip(), working=working)


def _of_part(writer: WithFiles, language: Language, exercise: Exercise, part: Part) -> Iterator[_Question]:
    every, wrong = cells(exercise, part, language), tuple(wrong_answers(exercise, part))
    label = f"({part.label})" if len(exercise.parts) > 1 else ""
    ask, points = f"<p>{label} {writer.text(part.ask)}</p>", Decimal(part.points)
    if isinstance(part.kind, Choice | YesNo):
        ((place, options, _),) = _choices(writer, part, every, wrong)
        yield _Question("multiple_choice_question", label, ask, points, ((place, options),))
        return
    if isinstance(every[0], Word):
        choices = list(_choices(writer, part, every, wrong))
        lines = "".join(f"<p>{left}[{place.removeprefix(_PLACE)}]</p>" for place, _, left in choices)
        places = tuple((place, options) for place, options, _ in choices)
        yield _Question("multiple_dropdowns_question", label, ask + lines, points, places)
        return
    for index, cell in enumerate(every):
        assert isinstance(cell, Quantity)
        of = f"{label} {index + 1}/{len(every)}" if len(every) > 1 else label
        text = ask + (f"<p>{_left(writer, cell)}</p>" if len(every) > 1 or cell.left else "")
        share = points / len(every)
        if is_open(cell):
            by_hand = f"<p><em>{page_words(language).by_hand}</em></p>"
            yield _Question("essay_question", of, text + by_hand, share)
        else:
            told = (
                f"<p>{_number(other)}: {escape(inline(says))}</p>" for other, says in told_apart(cell, index, wrong)
            )
            yield _Question("numerical_question", of, text, share, number=cell, wrong="".join(told))


def _number(number: Quantity) -> str:
    """A number as it is known, and as it is typed here."""
    decimal = f"{Decimal(number.decimal or 0):.4g}"
    return escape(with_mark(number.exact if number.exact == number.decimal else f"{number.exact} = {decimal}"))


def _left(writer: WithFiles, cell: Cell) -> str:
    return f"{escape(cell.name)}:" if cell.left is None else f"{writer.math(cell.left)} ="


def _choices(
    writer: WithFiles, part: Part, every: Sequence[Cell], wrong: Sequence[Wrong]
) -> Iterator[tuple[str, tuple[_Option, ...], str]]:
    """For every cell with a word the name of its place, what there is to choose, and what stands before it."""
    says = said_of_words(wrong)
    for index, cell in enumerate(every):
        assert isinstance(cell, Word)
        options = tuple(
            _Option(
                f"({escape(option)}) {writer.text(text)}" if isinstance(part.kind, Choice) else escape(text),
                option in cell.right,
                "" if option in cell.right else inline(says.get(option, "")),
            )
            for option, text in cell.options.items()
        )
        yield f"{_PLACE}{part.label}{index + 1}", options, "" if cell.left is None else f"{writer.math(cell.left)} = "


def _item(question: _Question, name: str) -> Element:
    """A question as Canvas reads it."""
    item = Element("item", ident=name, title=question.title)
    about = {"question_type": question.kind, "points_possible": f"{question.points:.12g}"}
    _fields(SubElement(SubElement(item, "itemmetadata"), "qtimetadata"), about)
    shown = SubElement(item, "presentation")
    _html(shown, question.text)
    if question.kind == "text_only_question":
        return item
    for place, options in question.places:
        _to_choose(shown, question, place, options)
    if not question.places:
        typed = SubElement(shown, "response_str", ident=_ONLY, rcardinality="Single")
        box = SubElement(typed, "render_fib", {"fibtype": "Decimal"} if question.number else {})
        SubElement(box, "response_label", ident="answer1")
    judging = SubElement(item, "resprocessing")
    scale = {"maxvalue": "100", "minvalue": "0", "varname": "SCORE", "vartype": "Decimal"}
    SubElement(SubElement(judging, "outcomes"), "decvar", scale)
    for key, says in _judged(judging, question):
        _html(SubElement(SubElement(item, "itemfeedback", ident=key), "flow_mat"), says)
    return item


def _to_choose(shown: Element, question: _Question, place: str, options: Sequence[_Option]) -> None:
    chosen = SubElement(shown, "response_lid", ident=place, rcardinality="Single")
    if question.kind == "multiple_dropdowns_question":
        SubElement(SubElement(chosen, "material"), "mattext").text = place.removeprefix(_PLACE)
    listed = SubElement(chosen, "render_choice")
    for key, option in _keys(question, place, options):
        _html(SubElement(listed, "response_label", ident=key), option.text)


def _keys(question: _Question, place: str, options: Sequence[_Option]) -> Iterator[tuple[str, _Option]]:
    """Options with their names, which are numbers: of others Canvas drops what is said of them."""
    before = 1000 * (1 + [name for name, _ in question.places].index(place))
    return ((str(before + index), option) for index, option in enumerate(options, 1))


def _judged(judging: Element, question: _Question) -> Iterator[tuple[str, str]]:
    """Write how the answer is judged; yields what is told, by name."""
    if question.working:
        SubElement(_when(judging, "Yes"), "other")
        _tell(judging, "general_fb")
        yield "general_fb", question.working
    dropdowns = question.kind == "multiple_dropdowns_question"
    for place, options in question.places:
        for key, option in _keys(question, place, options):
            if option.says:
                SubElement(_when(judging, "Yes"), "varequal", respident=place).text = key
                _tell(judging, f"{key}_fb")
                yield f"{key}_fb", f"<p>{escape(option.says)}</p>"
            if option.right:
                SubElement(_when(judging, "Yes" if dropdowns else "No"), "varequal", respident=place).text = key
                _score(judging, "Add" if dropdowns else "Set", Decimal(100) / len(question.places))
    if question.number is not None:
        _within(_when(judging, "No"), question.number)
        _score(judging, "Set", Decimal(100))
    elif not question.places:
        SubElement(_when(judging, "No"), "other")
    if question.wrong:
        SubElement(_when(judging, "Yes"), "other")
        _tell(judging, "general_incorrect_fb")
        yield "general_incorrect_fb", question.wrong


def _when(judging: Element, going_on: Literal["Yes", "No"]) -> Element:
    """A further condition: what it says is put into what is returned."""
    return SubElement(SubElement(judging, "respcondition", {"continue": going_on}), "conditionvar")


def _score(judging: Element, action: Literal["Set", "Add"], score: Decimal) -> None:
    """What the last condition earns, in percent."""
    SubElement(judging[-1], "setvar", varname="SCORE", action=action).text = f"{score:.12g}"


def _tell(judging: Element, key: str) -> None:
    """What is told where the last condition holds."""
    SubElement(judging[-1], "displayfeedback", feedbacktype="Response", linkrefid=key)


def _within(condition: Element, number: Quantity) -> None:
    """Whether the answer is that number by its tolerance, as Canvas writes it itself."""
    value, bound = Decimal(number.decimal or 0), Decimal(number.tolerance or 0)
    either = SubElement(condition, "or")
    SubElement(either, "varequal", respident=_ONLY).text = f"{value:f}"
    both = SubElement(either, "and")
    SubElement(both, "vargte", respident=_ONLY).text = f"{value - bound:f}"
    SubElement(both, "varlte", respident=_ONLY).text = f"{value + bound:f}"


def _fields(parent: Element, fields: Mapping[str, str]) -> None:
    for label, entry in fields.items():
        each = SubElement(parent, "qtimetadatafield")
        SubElement(each, "fieldlabel").text = label
        SubElement(each, "fieldentry").text = entry


def _html(parent: Element, text: str) -> None:
    SubElement(SubElement(parent, "material"), "mattext", texttype="text/html").text = text
