"""An exam as a content package in QTI 2.1: an item for every problem, a test for every version.

https://www.imsglobal.org/question/qtiv2p1/imsqti_infov2p1.html
"""

from collections.abc import Callable, Collection, Iterator, Sequence
from decimal import Decimal
from html import escape

from rldrill.exam.exam import Exam, Head, Version, points_of
from rldrill.exercise import Exercise
from rldrill.export.asked import (
    Cell,
    Quantity,
    Word,
    Wrong,
    all_or_nothing,
    cells,
    is_open,
    label,
    said_of_words,
    told_apart,
    wrong_answers,
)
from rldrill.export.packed import packed
from rldrill.export.with_files import WithFiles, matrix_rows
from rldrill.export.words import note
from rldrill.problems.document import Equation, Table
from rldrill.problems.mathematics import Math
from rldrill.problems.parts import Choice, Matrix, Part, YesNo
from rldrill.render.mathematics.mathml import chain, element
from rldrill.render.mathematics.unicode import inline

_XML = '<?xml version="1.0" encoding="UTF-8"?>\n'
_XSI = 'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"'
_SPACE = "http://www.imsglobal.org/xsd/imsqti_v2p1"
_QTI = f'xmlns="{_SPACE}" {_XSI} xsi:schemaLocation="{_SPACE} {_SPACE}.xsd"'
_PACKAGE = "http://www.imsglobal.org/xsd/imscp_v1p1"
_MATHML = "http://www.w3.org/1998/Math/MathML"
_WORKING = "WORKING"


class _Writer(WithFiles):
    """XHTML as items may hold it, with MathML."""

    def math(self, math: Math) -> str:
        """Mathematics within a line."""
        return _mathml(element(math))

    def table(self, table: Table) -> str:
        """A table with its head apart."""
        head = "".join(f"<th>{self.text(cell)}</th>" for cell in table.header)
        lines = (f"<tr>{''.join(f'<td>{self.text(cell)}</td>' for cell in line)}</tr>" for line in table.rows)
        return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(lines)}</tbody></table>"

    def equation(self, equation: Equation) -> str:
        """An equation in a paragraph of its own."""
        if equation.is_bare:
            sides = "\u2003".join(map(self.math, equation.rights))
            return f"<p>{sides}</p>"
        return f"<p>{_mathml(chain(equation))}</p>"


def _mathml(inside: str) -> str:
    return f'<math xmlns="{_MATHML}">{inside}</math>'


def qti_exam(exam: Exam, *, practice: bool, advance: Callable[[], None] = lambda: None) -> bytes:
    """All versions in one package, each as a test of its own.

    Args:
        exam: the exam.
        practice: whether the working is told after an attempt.
        advance: called after each version.
    """
    files: dict[str, str] = {}
    resources: list[str] = []
    for version in exam.versions:
        names = []
        for number, exercise in enumerate(version.exercises, 1):
            writer = _Writer(name := f"item-{version.code}-{number}", end="/>")
            whole = all_or_nothing(exam, version, number - 1)
            files[f"{name}.xml"] = _item(exam.head, writer, name, number, exercise, whole, practice=practice)
            files |= writer.files
            resources.append(_resource(name, "item", [*writer.files]))
            names.append(name)
        test = f"test-{version.code}"
        files[f"{test}.xml"] = _test(exam, version, names)
        resources.append(_resource(test, "test", [], names))
        advance()
    manifest = (
        f'{_XML}<manifest xmlns="{_PACKAGE}" {_XSI} xsi:schemaLocation="{_PACKAGE} {_PACKAGE}.xsd" identifier="exam">\n'
        f"<metadata><schema>QTIv2.1 Package</schema><schemaversion>1.0.0</schemaversion></metadata>\n"
        f"<organizations/>\n<resources>\n{''.join(resources)}</resources>\n</manifest>\n"
    )
    return packed({"imsmanifest.xml": manifest, **files})


def _resource(name: str, what: str, beside: Sequence[str], needed: Sequence[str] = ()) -> str:
    files = "".join(f'<file href="{file}"/>' for file in (f"{name}.xml", *beside))
    needs = "".join(f'<dependency identifierref="{other}"/>' for other in needed)
    return f'<resource identifier="{name}" type="imsqti_{what}_xmlv2p1" href="{name}.xml">{files}{needs}</resource>\n'


def _test(exam: Exam, version: Version, names: Sequence[str]) -> str:
    title = escape(exam.title_of(version))
    items = "".join(f'<assessmentItemRef identifier="{name}" href="{name}.xml"/>\n' for name in names)
    limit = "" if exam.head.duration is None else f'<timeLimits maxTime="{60 * exam.head.duration}"/>\n'
    return (
        f'{_XML}<assessmentTest {_QTI} identifier="test-{version.code}" title="{title}">\n{limit}'
        '<testPart identifier="part" navigationMode="nonlinear" submissionMode="individual">\n'
        f'<assessmentSection identifier="problems" title="{title}" visible="true">\n{items}'
        "</assessmentSection>\n</testPart>\n</assessmentTest>\n"
    )


def _item(
    head: Head, writer: _Writer, name: str, number: int, exercise: Exercise, whole: Collection[str], *, practice: bool
) -> str:
    asked = [
        _Asked(
            part,
            cells(exercise, part, head.language),
            tuple(wrong_answers(exercise, part)),
            whole=part.label in whole,
        )
        for part in exercise.parts
    ]
    told = note(head, [cell for each in asked if not each.by_hand for cell in each.cells], reads="point")
    body = "".join(
        each.body(writer, label(exercise, each.part), note(head, each.cells, reads="point") if each.by_hand else "")
        for each in asked
    )
    question = writer.blocks(exercise.question()) + _noted(told)
    conditions, feedback = [], []
    for each in asked:
        for condition, says in each.judged():
            conditions.append(condition)
            feedback += says
    if practice:
        working = "".join(writer.solved(exercise, part, head.language) for part in exercise.parts)
        feedback.append((_WORKING, f"<div>{working}</div>"))
        conditions.append(_tell(_WORKING))
    modal = "".join(
        f'<modalFeedback outcomeIdentifier="FEEDBACK" identifier="{key}" showHide="show">{says}</modalFeedback>\n'
        for key, says in feedback
    )
    return (
        f'{_XML}<assessmentItem {_QTI} identifier="{name}" '
        f'title="{escape(f"{number:02} {inline(exercise.problem.family.title)}")}" adaptive="false" '
        f'timeDependent="false">\n{"".join(each.declared() for each in asked)}'
        f'<outcomeDeclaration identifier="SCORE" cardinality="single" baseType="float" '
        f'normalMaximum="{points_of(exercise)}"><defaultValue><value>0</value></defaultValue></outcomeDeclaration>\n'
        '<outcomeDeclaration identifier="FEEDBACK" cardinality="multiple" baseType="identifier"/>\n'
        f"<itemBody>\n{question}\n{body}</itemBody>\n"
        f"<responseProcessing>\n{''.join(conditions)}</responseProcessing>\n{modal}</assessmentItem>\n"
    )


def _noted(told: str) -> str:
    return f"<p><em>{told}</em></p>" if told else ""


class _Asked:
    """A part, and its cells as responses.

    ``by_hand`` says whether it is marked by a person, and then as a whole; ``whole`` whether a wrong cell costs all.
    """

    def __init__(self, part: Part, asked: Sequence[Cell], wrong: Sequence[Wrong], *, whole: bool) -> None:
        self.part, self.cells, self.wrong = part, asked, wrong
        self.by_hand, self._whole = any(map(is_open, asked)), whole

    def declared(self) -> str:
        """The responses with what is right in them."""
        return "".join(
            f'<responseDeclaration identifier="{self._name(index)}" cardinality="single" baseType="{self._type(cell)}"'
            f"><correctResponse><value>{escape(self._right(cell))}</value></correctResponse></responseDeclaration>\n"
            for index, cell in enumerate(self.cells)
        )

    def _type(self, cell: Cell) -> str:
        if isinstance(cell, Word):
            return "identifier"
        return "string" if self.by_hand else "float"

    def _right(self, cell: Cell) -> str:
        """The right answer, or one of them."""
        if isinstance(cell, Word):
            return _key(cell, cell.right[0])
        return cell.exact if self.by_hand or cell.decimal is None else cell.decimal

    def body(self, writer: _Writer, letter: str, told: str) -> str:
        """What is asked with what is told of it, and where it is answered."""
        ask = f"<p>{letter}{writer.text(self.part.ask)}</p>\n{_noted(told)}"
        if isinstance(self.part.kind, Choice | YesNo):
            (only,) = self.cells
            assert isinstance(only, Word)
            options = "".join(
                f'<simpleChoice identifier="{_key(only, option)}">{self._option(writer, option, text)}</simpleChoice>'
                for option, text in only.options.items()
            )
            return f'{ask}<choiceInteraction responseIdentifier="{self._name(0)}" shuffle="false" maxChoices="1">' \
                   f"{options}</choiceInteraction>\n"  # fmt: skip
        if self.by_hand:
            places = (
                f'<div>{_left(writer, cell)}<extendedTextInteraction responseIdentifier="{self._name(index)}"/></div>'
                for index, cell in enumerate(self.cells)
            )
            return f"{ask}{''.join(places)}\n"
        boxes = [self._box(index, cell) for index, cell in enumerate(self.cells)]
        if isinstance(self.part.kind, Matrix):
            return f"{ask}<table><tbody>{matrix_rows(boxes, self.part.kind)}</tbody></table>\n"
        lines = (f"<p>{_left(writer, cell)}{box}</p>" for cell, box in zip(self.cells, boxes, strict=True))
        return f"{ask}{''.join(lines)}\n"

    def judged(self) -> Iterator[tuple[str, list[tuple[str, str]]]]:
        """What earns points, and of every cell what is told of its wrong answers."""
        if self.by_hand:
            return
        rights = [_is_right(self._name(index), cell) for index, cell in enumerate(self.cells)]
        earning = [_all(rights)] if self._whole else rights
        worth = f"{Decimal(self.part.points) / len(earning):.12g}"
        score = f'<sum><variable identifier="SCORE"/><baseValue baseType="float">{worth}</baseValue></sum>'
        for right in earning:
            yield _first([(right, f'<setOutcomeValue identifier="SCORE">{score}</setOutcomeValue>')]), []
        for index, cell in enumerate(self.cells):
            known = [(f"F_{self._name(index)}_{n}", *each) for n, each in enumerate(self._mistakes(index, cell), 1)]
            if known:
                yield (
                    _first([(test, _tell(key)) for key, test, _ in known]),
                    [(key, f"<p>{escape(inline(says))}</p>") for key, _, says in known],
                )

    def _mistakes(self, index: int, cell: Cell) -> Iterator[tuple[str, str]]:
        name = self._name(index)
        if isinstance(cell, Quantity):
            for other, says in told_apart(cell, index, self.wrong):
                yield _equal(name, other), says
            return
        sentences = said_of_words(self.wrong)
        for option in cell.options:
            if option not in cell.right and option in sentences:
                yield _is(name, _key(cell, option)), sentences[option]

    def _name(self, index: int) -> str:
        return f"R_{self.part.label}_{index + 1}"

    def _option(self, writer: _Writer, option: str, text: str) -> str:
        return f"({escape(option)}) {writer.text(text)}" if isinstance(self.part.kind, Choice) else writer.text(text)

    def _box(self, index: int, cell: Cell) -> str:
        name = self._name(index)
        if isinstance(cell, Quantity):
            return f'<textEntryInteraction responseIdentifier="{name}" expectedLength="12"/>'
        options = "".join(
            f'<inlineChoice identifier="{_key(cell, option)}">{escape(option)}</inlineChoice>'
            for option in cell.options
        )
        return (
            f'<inlineChoiceInteraction responseIdentifier="{name}" shuffle="false">{options}</inlineChoiceInteraction>'
        )


def _left(writer: _Writer, cell: Cell) -> str:
    return "" if cell.left is None else f"{writer.math(cell.left)} = "


def _key(cell: Word, option: str) -> str:
    """An option's name: what it says may be any text."""
    return f"o{[*cell.options].index(option) + 1}"


def _is_right(name: str, cell: Cell) -> str:
    if isinstance(cell, Quantity):
        return _equal(name, cell)
    tests = [_is(name, _key(cell, option)) for option in cell.right]
    return tests[0] if len(tests) == 1 else f"<or>{''.join(tests)}</or>"


def _all(tests: Sequence[str]) -> str:
    return tests[0] if len(tests) == 1 else f"<and>{''.join(tests)}</and>"


def _first(rules: Sequence[tuple[str, str]]) -> str:
    """What is done where the first of these tests holds that does."""
    tags = ["responseIf", *["responseElseIf"] * (len(rules) - 1)]
    branches = "".join(f"<{tag}>{test}{does}</{tag}>" for tag, (test, does) in zip(tags, rules, strict=True))
    return f"<responseCondition>{branches}</responseCondition>\n"


def _is(name: str, key: str) -> str:
    return f'<match><variable identifier="{name}"/><baseValue baseType="identifier">{key}</baseValue></match>'


def _equal(name: str, number: Quantity) -> str:
    """Whether a response is that number, by its tolerance."""
    return (
        f'<equal toleranceMode="absolute" tolerance="{number.tolerance} {number.tolerance}">'
        f'<variable identifier="{name}"/><baseValue baseType="float">{number.decimal}</baseValue></equal>'
    )


def _tell(key: str) -> str:
    return (
        '<setOutcomeValue identifier="FEEDBACK"><multiple><variable identifier="FEEDBACK"/>'
        f'<baseValue baseType="identifier">{key}</baseValue></multiple></setOutcomeValue>'
    )
