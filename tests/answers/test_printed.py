"""Whatever rldrill prints as an answer, in whatever form, is right when it is typed back."""

import json
import random
from collections.abc import Iterator
from typing import Any

import pytest

from rldrill.exercise import Exercise, read
from rldrill.problems.catalogue import families, family
from rldrill.problems.mathematics import mathematics
from rldrill.problems.parts import Choice, Numbers, Part
from rldrill.render.markdown import markdown
from rldrill.render.mathematics.unicode import inline, unicode
from rldrill.render.terminal import plain
from rldrill.render.unicode import unicode_text
from rldrill.solutions.answers.judging import Outcome, judge
from rldrill.solutions.answers.key import answer_lines
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.drawing import draw

#: Enough that the answers fill several thousand characters, with numbers of some fifty digits.
STATES = 30
SEEDS = (100,)


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


def test_named_entries_may_stand_in_any_order() -> None:
    for name in families():
        for level in family(name).levels:
            exercise = Exercise(draw(name, level, 5))
            for part in exercise.parts:
                if isinstance(part.kind, Numbers):
                    answer = exercise.data()["parts"][exercise.parts.index(part)]["answer"]["exact"]
                    names = [unicode(mathematics(entry)) for entry in part.kind.entries]
                    lines = [f"{entry} = {value}" for entry, value in zip(names, answer, strict=True)]
                    verdict = judge(exercise.solution, part.label, "; ".join(reversed(lines)))
                    assert verdict.outcome is Outcome.RIGHT, (exercise.id, part.label, lines, verdict)


def test_what_is_printed_of_a_large_model_can_be_typed() -> None:
    chance = random.Random(5)
    names = [f"s{number}" for number in range(STATES)]
    rows = []
    for state in names:
        for action in ("left", "right"):
            weights = [chance.randint(1, 7) for _ in range(3)]
            for after, weight in zip(chance.sample(names, 3), weights, strict=True):
                rows.append([state, action, after, f"{weight}/{sum(weights)}", chance.randint(-5, 9)])
    exercise = read({"family": "optimal-value", "given": {"mdp": {"transitions": rows}, "gamma": "9/10"}})
    for part in exercise.parts:
        texts = [*printed(exercise, part)]
        assert max(map(len, texts)) > 2000 or part.label == "b"
        for text in texts:
            assert exercise.check(text, part.label).outcome is Outcome.RIGHT, (part.label, text[:200])
        assert "longer than" in exercise.check("1" * 5 * max(map(len, texts)), part.label).says


def test_what_is_printed_of_hundreds_of_tosses_can_be_typed() -> None:
    given = {"heads": 140, "tails": 110, "prior": {"biased": 0.5, "fair": 0.5},
             "models": {"biased": {"a": 1, "b": 1}, "fair": {"theta": 0.5}}}  # fmt: skip
    exercise = read({"family": "model-comparison", "given": given})
    for text in (*printed(exercise, exercise.parts[0]), "2.635·10⁻⁷⁶, 5.527·10⁻⁷⁶", "2.635e-76, 2^-250"):
        assert exercise.check(text).outcome is Outcome.RIGHT, text
    assert exercise.diagnose(f"1/1{'0' * 400}, 2^-250").kind == "unexplained"  # no fault of its size
