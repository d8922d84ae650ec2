"""Whatever is typed, in whatever order, the quiz goes on to its end."""

import io
from itertools import chain, cycle

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rich.console import Console

import rldrill
from rldrill.problems.catalogue import families
from rldrill.quiz.screen import Screen
from rldrill.quiz.session import Session
from rldrill.solutions.answers.kinds import answer_kind

KEYS = ("", "h", "m", "p", "s", "w", "t", "?")
ODD = (
    "sqrt(2)", "-7/3", "0", "1", "10^9", "ln 2", "gamma", "1/(1-x)", "yes", "A", "1, 2", "1 2 x", "[1 2; 3 4]",
    "cool: 1", "V = 2", "=", "1e400", "\x1b[A",
)  # fmt: skip


def answers(exercise: rldrill.Exercise) -> list[str]:
    """What is right in some part, or comes of a typical mistake, and the same with other numbers in it."""
    ways = [exercise.solution.answers, *(answers for _, answers in exercise.solution.mistakes)]
    written = [answer_kind(part.kind).write(way[part.label]) for part in exercise.parts for way in ways]
    return [
        *written,
        *(text.replace("1", "sqrt(3)") for text in written),
        *(text.replace("2", "-5") for text in written),
    ]


@given(st.sampled_from(families()), st.sampled_from((1, 2, 3)), st.integers(0, 10**6), st.data())
@settings(max_examples=12, deadline=None, suppress_health_check=list(HealthCheck))
def test_the_quiz_goes_on_to_its_end(name: str, level: int, seed: int, data: st.DataObject) -> None:
    exercise = rldrill.draw(name, level, seed)
    lines = st.one_of(st.sampled_from(answers(exercise)), st.sampled_from(ODD), st.sampled_from(KEYS))
    typed = chain(data.draw(st.lists(lines, max_size=25)), cycle(("", "q")))
    console = Console(file=io.StringIO(), width=data.draw(st.sampled_from((40, 80, 120))))
    Screen(console, lambda *_: next(typed)).run([exercise], Session(1))
    *_, last = console.file.getvalue().split("\n\n")
    assert "points in" in last or "Nothing was answered" in last
