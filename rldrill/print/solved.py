"""A part as a marker needs it: the answer, the working with the points of its steps, and typical wrong answers."""

import re
from collections.abc import Iterator
from typing import Any

from rldrill.exam.exam import Exam
from rldrill.exercise import Exercise
from rldrill.misreading import misreading, said
from rldrill.possible import is_possible
from rldrill.print.exam_page import label
from rldrill.print.words import Words, words, written_points
from rldrill.problems.document import Block, Equation
from rldrill.problems.mathematics import EMPTY, Math, name
from rldrill.problems.notations import all_in_notation
from rldrill.problems.parts import Choice, Part, YesNo
from rldrill.render.mathematics.typst import equation, plain, quoted, text
from rldrill.render.typst import block, document, line, long_or_not
from rldrill.render.unicode import unicode_text
from rldrill.solutions.answers.key import answer_lines
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.exact import NotReal
from rldrill.solutions.formula.formula import Misconception

_NAMED = re.compile(r"\b([VQ]\^?|[vq]_)([π*])((?:\((?:[^()]|\([^()]*\))*\))?)(?!\w)")
#: So many typical wrong answers to a part are told.
_MISTAKES = 5


def solved_part(exam: Exam, exercise: Exercise, part: Part) -> str:
    """The answer of a part, then how it is found and what else is answered."""
    told = words(exam.head.language)
    worth = plain(written_points(told, part.points))
    written, long = _answer(exercise, part, told)
    answer = f"#answer-block([{label(exercise, part.label)}], [{written}], [{worth}]{long})\n"
    working = "".join(_earned(blocks, points) for blocks, points in exercise.scheme(part.label))
    return answer + working + _mistakes(exercise, part, told)


def _answer(exercise: Exercise, part: Part, told: Words) -> tuple[str, str]:
    """The answer to a part as Typst markup, and the argument that breaks a long one across pages."""
    if isinstance(part.kind, Choice):
        letter = answer_kind(part.kind).write(exercise.solution.answers[part.label])
        return text(f"({letter}) {part.kind.options[letter]}"), ""
    answer = answer_block(exercise, part, told)
    return block(answer), long_or_not((answer,))


def answer_block(exercise: Exercise, part: Part, told: Words) -> Equation:
    """The answer to a part, one line for every number; yes and no in the language of the exam."""
    lines = _lines(part, exercise.solution.answers[part.label], told)
    return Equation(EMPTY, lines, ("",) * len(lines))


def _lines(part: Part, answer: Any, told: Words) -> tuple[Math, ...]:
    if isinstance(part.kind, YesNo):
        return (name(told.yes if answer else told.no),)
    return answer_lines(part, answer)


def _earned(blocks: tuple[Block, ...], points: int) -> str:
    if not points:
        return document(blocks)
    *before, last = blocks
    return f"{document(tuple(before))}#earning([{points}], [{block(last)}]{long_or_not((last,))})\n"


def _mistakes(exercise: Exercise, part: Part, told: Words) -> str:
    rows = [
        f"([{given}], [{text(with_mathematics(said(exercise.solution, mistake)))}{_read(exercise, mistake)}])"
        for given, mistake in _wrong(exercise, part, told)
    ]
    return f"#mistakes([{plain(told.mistakes)}], {', '.join(rows)})\n" if rows else ""


def with_mathematics(sentence: str) -> str:
    """A sentence for every screen, with what it names as a formula would write it: ``V^π``, ``Q*`` and ``v_π``."""
    return _NAMED.sub(
        lambda match: f"${match[1][0]}{'_' if match[1][-1] == '_' else '^'}{match[2]}{match[3]}$", sentence
    )


def _read(exercise: Exercise, mistake: Misconception) -> str:
    """The formula as somebody reads it who makes the mistake."""
    read = misreading(exercise.solution, mistake)
    return "" if read is None else f" #tall({quoted(unicode_text(read))}, ${line(read)}$)"


def _wrong(exercise: Exercise, part: Part, told: Words) -> Iterator[tuple[str, Misconception]]:
    """The wrong answers that typical mistakes give, each once, with the mistake."""
    known = set[str]()
    for misconception, answers in exercise.solution.mistakes:
        if len(known) == _MISTAKES:
            return
        answer = answers[part.label]
        written = answer_kind(part.kind).write(answer)
        if written in known or not _tells(exercise, part, answer):
            continue
        if not is_possible(exercise.solution, part.label, answers):
            continue
        known.add(written)
        if isinstance(part.kind, Choice):
            yield plain(f"({written})"), misconception
        else:
            lines = all_in_notation(_lines(part, answer, told))
            yield " #h(0.8em) ".join(equation(each, "tall") for each in lines), misconception


def _tells(exercise: Exercise, part: Part, answer: Any) -> bool:
    """Whether a mistake leads to an answer that a marker can tell from the right one."""
    try:
        return exercise.solution.tells_apart({part.label: answer})
    except NotReal:
        return False  # it takes the logarithm of nothing: nobody writes that down
