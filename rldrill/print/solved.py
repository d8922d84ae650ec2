"""A part as a marker needs it: the answer, the working with the points of its steps, and typical wrong answers."""

import re
from collections.abc import Iterator
from typing import Any

from rldrill.exam.exam import Exam
from rldrill.exercise import Exercise
from rldrill.misreading import misreading
from rldrill.print.exam_page import label
from rldrill.print.possible import is_possible
from rldrill.print.words import words, written_points
from rldrill.problems.document import Block
from rldrill.problems.notations import all_in_notation
from rldrill.problems.parts import Choice, Part
from rldrill.render.mathematics.typst import equation, plain, quoted, text
from rldrill.render.typst import block, document, line
from rldrill.render.unicode import unicode_text
from rldrill.solutions.answers.key import answer_lines
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.exact import NotReal
from rldrill.solutions.formula.formula import Misconception

_NAMED = re.compile(r"\b([VQ])\^?([π*])((?:\((?:[^()]|\([^()]*\))*\))?)(?!\w)")
#: So many typical wrong answers to a part are told.
_MISTAKES = 5


def solved_part(exam: Exam, exercise: Exercise, part: Part) -> str:
    """The answer of a part, then how it is found and what else is answered."""
    told = words(exam.head.language)
    worth = plain(written_points(told, part.points))
    answer = f"#answer-block([{label(exercise, part.label)}], [{_answer(exercise, part)}], [{worth}])\n"
    working = "".join(_earned(blocks, points) for blocks, points in exercise.scheme(part.label))
    return answer + working + _mistakes(exercise, part, told.mistakes)


def _answer(exercise: Exercise, part: Part) -> str:
    if isinstance(part.kind, Choice):
        letter = answer_kind(part.kind).write(exercise.solution.answers[part.label])
        return text(f"({letter}) {part.kind.options[letter]}")
    return block(exercise.answer(part))


def _earned(blocks: tuple[Block, ...], points: int) -> str:
    if not points:
        return document(blocks)
    *before, last = blocks
    return f"{document(tuple(before))}#earning([{points}])[{block(last)}]\n"


def _mistakes(exercise: Exercise, part: Part, title: str) -> str:
    rows = [
        f"([{given}], [{text(with_mathematics(mistake.says))}{_read(exercise, mistake)}])"
        for given, mistake in _wrong(exercise, part)
    ]
    return f"#mistakes([{plain(title)}], {', '.join(rows)})\n" if rows else ""


def with_mathematics(sentence: str) -> str:
    """A sentence for every screen, with what it names as a formula would write it: ``V^π`` and ``Q*``."""
    return _NAMED.sub(r"$\1^\2\3$", sentence)


def _read(exercise: Exercise, mistake: Misconception) -> str:
    """The formula as somebody reads it who makes the mistake."""
    read = misreading(exercise.solution, mistake)
    return "" if read is None else f" #tall({quoted(unicode_text(read))}, ${line(read)}$)"


def _wrong(exercise: Exercise, part: Part) -> Iterator[tuple[str, Misconception]]:
    """The wrong answers that typical mistakes give, each once, with the mistake."""
    told = set[str]()
    for misconception, answers in exercise.solution.mistakes:
        if len(told) == _MISTAKES:
            return
        answer = answers[part.label]
        written = answer_kind(part.kind).write(answer)
        if written in told or not _tells(exercise, part, answer) or not is_possible(exercise, part, answer):
            continue
        told.add(written)
        if isinstance(part.kind, Choice):
            yield plain(f"({written})"), misconception
        else:
            lines = all_in_notation(answer_lines(part, answer))
            yield " #h(0.8em) ".join(equation(each, "tall") for each in lines), misconception


def _tells(exercise: Exercise, part: Part, answer: Any) -> bool:
    """Whether a mistake leads to an answer that a marker can tell from the right one."""
    try:
        return exercise.solution.tells_apart({part.label: answer})
    except NotReal:
        return False  # it takes the logarithm of nothing: nobody writes that down
