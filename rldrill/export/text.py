"""An exam as Markdown, with GitHub's mathematics, and as JSON."""

import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TypeAlias

from rldrill.exam.exam import Exam, Version, points_of
from rldrill.exercise import Exercise
from rldrill.export.asked import answer
from rldrill.export.words import page_words
from rldrill.print.words import Words, words, written_points, written_time
from rldrill.problems.document import Block
from rldrill.problems.parts import Choice, Part
from rldrill.render.markdown import markdown, markdown_plain, markdown_text

_MISTAKES = 8


#: What stands before and after the answer to a part: folded away on the web, below a line in bold letters elsewhere.
FOLDED, BELOW = ("<details><summary>{}</summary>", "</details>"), ("**{}**",)
#: How the blocks of a page are written.
Writer: TypeAlias = Callable[[Iterable[Block]], str]


def markdown_exam(
    exam: Exam, version: Version, *, practice: bool, answers: Sequence[str] = FOLDED, written: Writer = markdown
) -> str:
    """A version as Markdown; for practice with answer and working behind each part.

    Args:
        exam: the exam.
        version: which of its versions.
        practice: whether it is for practice.
        answers: what stands before and after the answers.
        written: how blocks are written.
    """
    return "\n\n".join(_lines(exam, version, answers if practice else (), written)) + "\n"


def _lines(exam: Exam, version: Version, answers: Sequence[str], written: Writer) -> Iterator[str]:
    told, head = words(exam.head.language), exam.head
    code = f" ({told.version} {version.code})" if len(exam.versions) > 1 else ""
    yield f"# {markdown_plain(head.title)}{code}"
    for line in (head.course, head.date, head.instructions):
        if line:
            yield markdown_plain(line)
    time = written_time(told, head.duration, version.minutes)
    yield f"{told.rule} {time}"
    for number, exercise in enumerate(version.exercises, 1):
        worth = written_points(told, points_of(exercise))
        yield f"## {told.problem} {number}: {markdown_text(exercise.problem.family.title)} ({worth})"
        yield written(exercise.question())
        for part in exercise.parts:
            around = [each.format(page_words(head.language).working) for each in answers]
            yield from _part(exercise, part, told, around, written)


def _part(exercise: Exercise, part: Part, told: Words, answers: Sequence[str], written: Writer) -> Iterator[str]:
    yield f"**({part.label})** {markdown_text(part.ask)}"
    if isinstance(part.kind, Choice):
        yield "\n".join(f"- ({letter}) {markdown_text(text)}" for letter, text in part.kind.options.items())
    if answers:
        yield answers[0]
        yield written((answer(exercise, part, told), *exercise.working(part.label)))
        yield from answers[1:]


def json_exam(exam: Exam, *, practice: bool, advance: Callable[[], None] = lambda: None) -> str:
    """All versions as JSON; for practice with answers, steps and wrong answers, and what a problem file holds."""
    versions = []
    # A diagram's givens name what it shows, and rldrill solves any problem of which it has the givens, or the ID.
    hidden = () if practice else ("given",) if exam.layout.ids else ("given", "id")
    for version in exam.versions:
        told = (
            exercise.data(answers=practice, mistakes=_MISTAKES if practice else 0) for exercise in version.exercises
        )
        problems = [{name: value for name, value in data.items() if name not in hidden} for data in told]
        versions.append({"code": version.code, "problems": problems})
        advance()
    data = {"title": exam.head.title, "versions": versions}
    return json.dumps(data, ensure_ascii=False, indent=2) + "\n"
