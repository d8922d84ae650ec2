"""Whatever rldrill prints as an answer, in whatever form, is right when it is typed back."""

import json
from collections.abc import Iterator
from typing import Any

import pytest

from rldrill.exercise import Exercise
from rldrill.problems.catalogue import families, family
from rldrill.problems.parts import Choice, Part
from rldrill.render.markdown import markdown
from rldrill.render.mathematics.unicode import inline, unicode
from rldrill.render.terminal import plain
from rldrill.render.unicode import unicode_text
from rldrill.solutions.answers.judging import Outcome, judge
from rldrill.solutions.answers.key import answer_lines
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.drawing import draw

SEEDS = (100, 101, 102)


def printed(exercise: Exercise, part: Part) -> Iterator[str]:
    """The answer of a part in every form in which it is printed."""
    value, kind = exercise.solution.answers[part.label], answer_kind(part.kind)
    block = exercise.answer(part)
    yield plain([block])  # solve, quiz
    yield unicode_text(block)
    yield markdown([block])  # notebooks
    key = [unicode(line) for line in answer_lines(part, value)]  # exact, then as a decimal
    yield "\n".join(key)
    yield "; ".join(key)
    yield kind.write(value)
    for data in (kind.data(value), kind.decimals(value)):
        if not missing(data):
            yield json.dumps(data)
            yield json.dumps(data, ensure_ascii=False, indent=2)
    if isinstance(part.kind, Choice):
        yield f"({value}) {inline(part.kind.options[value])}"
        yield inline(part.kind.options[value])


def missing(data: Any) -> bool:
    """Whether a number has no decimal, or there are none."""
    if isinstance(data, dict | list):
        return any(map(missing, data.values() if isinstance(data, dict) else data))
    return data is None


@pytest.mark.parametrize("name", families())
def test_what_is_printed_can_be_typed(name: str) -> None:
    for level in family(name).levels:
        for seed in SEEDS:
            exercise = Exercise(draw(name, level, seed))
            for part in exercise.parts:
                for text in printed(exercise, part):
                    verdict = judge(exercise.solution, part.label, text)
                    assert verdict.outcome is Outcome.RIGHT, (level, seed, part.label, text, verdict)
