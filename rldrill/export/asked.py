"""What is asked and what is right, cell by cell: what formats that judge by themselves are made from."""

from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from itertools import islice
from typing import Any

from msgspec import Struct

from rldrill.entries import by_name
from rldrill.exam.choices import Language
from rldrill.exam.exam import Exam, Version
from rldrill.exercise import Exercise
from rldrill.print.solved import answer_block
from rldrill.print.words import Words, words
from rldrill.problems.document import Block, Equation, Paragraph
from rldrill.problems.mathematics import Math
from rldrill.problems.notations import all_in_notation
from rldrill.problems.parts import Choice, Part, Policy, YesNo
from rldrill.solutions.answers.judging import Outcome, read_answer
from rldrill.solutions.answers.key import answer_lines
from rldrill.solutions.answers.kinds import answer_kind, text_of
from rldrill.solutions.answers.rule import tolerance
from rldrill.solutions.answers.text import Reading, Unreadable, read_number
from rldrill.solutions.exact import NotReal, decimal, parameters

#: So many wrong answers to a part go along, the likeliest ones.
_MISTAKES = 24
#: So many of them a reader is told in a list.
_LISTED = 4
#: So many wrong answers are told in one cell.
_TOLD = 6
#: A decimal in a file has so many significant digits.
_DIGITS = 12


class Word(Struct, frozen=True):
    """A cell that holds one of several words; more than one of them may be right."""

    name: str
    left: Math | None
    options: Mapping[str, str]
    right: tuple[str, ...]


class Quantity(Struct, frozen=True):
    """A cell that holds a number: the exact one as it is typed, and if it has one its decimal and tolerance."""

    name: str
    left: Math | None
    exact: str
    decimal: str | None
    tolerance: str | None


Cell = Word | Quantity


class Wrong(Struct, frozen=True):
    """A wrong answer, cell by cell as it is typed, what is said of the mistake, and the formula as it reads it.

    ``value`` is the answer as a solver would give it; ``possible`` says whether the statement leaves room for it.
    """

    cells: tuple[str, ...]
    value: Any
    says: str
    read: Equation | None
    possible: bool


def cells(exercise: Exercise, part: Part, language: Language = "en") -> tuple[Cell, ...]:
    """The cells of a part with what is right in them; yes and no in that language."""
    kind, value = answer_kind(part.kind), exercise.solution.answers[part.label]
    content, lines = kind.cells(value), kind.lines(value)
    lefts = [left for left, _ in lines] if len(lines) == len(content) else [None] * len(content)
    written = iter(all_in_notation([left for left in lefts if left is not None]))
    return tuple(
        _cell(part, name, None if left is None else next(written), each, words(language))
        for (name, each), left in zip(content.items(), lefts, strict=True)
    )


def all_or_nothing(exam: Exam, version: Version, index: int) -> frozenset[str]:
    """The labels of the parts that earn nothing for a wrong entry, of a problem by its place in the version, from 0."""
    rules = version.rules(index)
    return frozenset(
        part.label for part in version.exercises[index].parts if rules.get(part.label, exam.partial) == "all"
    )


def answer(exercise: Exercise, part: Part, told: Words) -> Block:
    """The answer to a part as it is written out; of a choice what its letter stands for, too."""
    if isinstance(part.kind, Choice):
        letter = exercise.solution.answers[part.label]
        return Paragraph(f"({letter}) {part.kind.options[letter]}")
    return answer_block(exercise, part, told)


def label(exercise: Exercise, part: Part) -> str:
    """The letter of a part, with the space behind it; nothing where there is only one."""
    return f"({part.label}) " if len(exercise.parts) > 1 else ""


def _cell(part: Part, name: str, left: Math | None, content: Any, told: Words) -> Cell:
    match part.kind:
        case Choice(options):
            return Word(name, None, options, content)
        case YesNo():
            return Word(name, None, {"yes": told.yes, "no": told.no}, content)
        case Policy(actions):
            return Word(name, left, {action: action for action in actions[name]}, tuple(content))
    return quantity(name, left, content)


def quantity(name: str, left: Math | None, value: Any) -> Quantity:
    """A number as a cell."""
    if parameters(value):
        return Quantity(name, left, text_of(value), None, None)
    bound = tolerance(value)
    return Quantity(name, left, text_of(value), decimal(value, _DIGITS), written(Fraction(int(bound.p), int(bound.q))))


def quantity_of(typed: str) -> Quantity | None:
    """A number as it is typed, as a cell; None if it has no decimal, or is none."""
    try:
        found = quantity("", None, read_number(typed).value)
    except (Unreadable, NotReal):
        return None
    return None if found.decimal is None else found


def written(value: Fraction) -> str:
    """A fraction whose denominator is made of twos and fives, as a decimal."""
    return f"{Decimal(value.numerator) / Decimal(value.denominator):f}"


def wrong_answers(exercise: Exercise, part: Part, most: int = _MISTAKES) -> Iterator[Wrong]:
    """Wrong answers to a part, the likeliest first; none to yes or no, where every mistake is the other.

    Words are few, and can be wrong for many reasons: of them only those of which judging tells a mistake.
    """
    if isinstance(part.kind, YesNo):
        return
    for wrong in exercise.diagnosing.wrong_answers(part.label, most):
        sentence, read = wrong.sentence, wrong.read
        if isinstance(part.kind, Choice | Policy):
            verdict = exercise.check(wrong.answer, part.label)
            if verdict.outcome is not Outcome.MISCONCEPTION:
                continue
            sentence, read = verdict.says, read if verdict.says == sentence else None
        try:
            found = read_answer(exercise.solution, part, wrong.answer)
        except Unreadable:
            continue  # a number so large that nobody types it
        value = answer_kind(part.kind).value({name: _content(cell) for name, cell in found.items()})
        yield Wrong(tuple(map(_typed, found.values())), value, by_name(sentence, part.kind), read, wrong.possible)


def listed(exercise: Exercise, part: Part) -> Iterator[Wrong]:
    """Wrong answers to a part that a reader is told; those that the statement rules out are recognised only."""
    possible = (each for each in wrong_answers(exercise, part, 2 * _LISTED) if each.possible)
    return islice(possible, _LISTED)


def typeset(part: Part, wrong: Wrong) -> Sequence[Math]:
    """A wrong answer as mathematics, a line for every number."""
    return all_in_notation(answer_lines(part, wrong.value))


def _content(cell: Any) -> Any:
    return cell.value if isinstance(cell, Reading) else cell


def _typed(cell: Any) -> str:
    if isinstance(cell, Reading):
        return text_of(cell.value)
    return cell if isinstance(cell, str) else cell[0]


def said_of_words(wrong: Sequence[Wrong]) -> Mapping[str, str]:
    """What is said of a wrong word, where it is all of the answer: one of several alone proves no mistake."""
    return {each.cells[0]: each.says for each in reversed(wrong) if len(each.cells) == 1}


def told_apart(right: Quantity, index: int, wrong: Sequence[Wrong]) -> Iterator[tuple[Quantity, str]]:
    """The wrong numbers in a cell that no tolerance confuses with others, the likeliest, with what is said of them."""
    told = [right]
    for each in wrong:
        other = quantity_of(each.cells[index])
        if other is None or len(told) > _TOLD or any(_overlap(other, known) for known in told):
            continue
        told.append(other)
        yield other, each.says


def _overlap(one: Quantity, other: Quantity) -> bool:
    apart = abs(Decimal(one.decimal or 0) - Decimal(other.decimal or 0))
    return apart <= Decimal(one.tolerance or 0) + Decimal(other.tolerance or 0)


def is_open(cell: Cell) -> bool:
    """Whether the cell is an expression in a parameter, which most other programs cannot judge."""
    return isinstance(cell, Quantity) and cell.decimal is None
