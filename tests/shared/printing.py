"""Everything that is printed of a family's first problems: what the golden pages hold, and a test holds them to."""

import hashlib
import io
import json
from collections.abc import Iterable, Mapping
from typing import Any

from rich.console import Console, RenderableType

from rldrill.exercise import Exercise, draw
from rldrill.problems.document import Block, Paragraph
from rldrill.problems.family import Family
from rldrill.render.html import Html
from rldrill.render.latex import latex_document
from rldrill.render.markdown import markdown
from rldrill.render.mathematics.unicode import unicode
from rldrill.render.terminal import asked, render
from rldrill.render.typst import document
from rldrill.solutions.answers.key import answer_lines
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.solution import Solution

#: As many problems of a level are held to what they were, as many to what is said and solved, as many to how they look.
DRAWN, SAID, SEEN = 4, 3, 1


def page(family: Family) -> str:
    """One problem of every level as the terminal shows it, with working and mistakes; the rest as digests."""
    return "\n".join(_level(family, level) for level in family.levels)


def _level(family: Family, level: int) -> str:
    exercises = [draw(family.name, level, seed) for seed in range(DRAWN)]
    exercise, said, seen = exercises[0], exercises[:SAID], exercises[:SEEN]
    drawn = [each.problem.data() for each in exercises]
    everything = [*exercise.question(), *(Paragraph(part.ask) for part in exercise.parts), *exercise.working()]
    pictured = [block for each in seen for block in each.question()]
    return "\n".join(
        [
            f"{'=' * 20} {exercise.id}",
            _shown(exercise),
            f"drawn {_digest(json.dumps(drawn, sort_keys=True))}",
            f"asked {_digest(json.dumps([_asked(each) for each in said]))}",
            f"solved {_digest(json.dumps([_solved(each) for each in said]))}",
            f"seen {_digest(''.join(document(each.question()) for each in seen))}",
            f"terminal {_digest(''.join(_terminal(each.question(), 80) for each in seen))}",
            f"narrow {_digest(_terminal(everything, 48))}",
            f"typst {_digest(document(tuple(everything)))}",
            f"markdown {_digest(markdown(tuple(everything)))}",
            f"latex {_digest(latex_document([*everything, *pictured]))}",
            f"html {_digest(Html().blocks([*everything, *pictured]))}",
            "",
        ]
    )


def _asked(exercise: Exercise) -> list[object]:
    """What is printed for the reader."""
    return [markdown(exercise.question()), [(part.ask, part.points) for part in exercise.parts]]


def _solved(exercise: Exercise) -> list[object]:
    """The working, the answers, and what each mistake gives."""
    told = {mistake.name: _typed(exercise.solution, answers) for mistake, answers in exercise.solution.mistakes}
    return [markdown(exercise.working()), _typed(exercise.solution, exercise.solution.answers), told]


def _typed(solution: Solution, answers: Mapping[str, Any]) -> list[str]:
    """Answers as they are typed."""
    return [f"({part.label}) {answer_kind(part.kind).write(answers[part.label])}" for part in solution.problem.parts]


def _shown(exercise: Exercise) -> str:
    lines = [_terminal(exercise.question(), 100)]
    for part in exercise.parts:
        kind, value = answer_kind(part.kind), exercise.solution.answers[part.label]
        lines.append(f"{_console(asked(part), 100)}  {kind.how_to_type()}")
        lines.append(_terminal(exercise.hint(part.label), 100))
        lines.append(_terminal(exercise.working(part.label), 100))
        lines += [f"  {unicode(line)}" for line in answer_lines(part, value)]
    for mistake, answers in exercise.solution.mistakes:
        told = "; ".join(_typed(exercise.solution, answers))
        lines.append(f"{mistake.name}: {mistake.says} {told}")
    return "\n".join(line.rstrip() for text in lines for line in text.splitlines())


def _terminal(blocks: Iterable[Block], width: int) -> str:
    return _console(render(blocks), width)


def _console(content: RenderableType, width: int) -> str:
    console = Console(file=io.StringIO(), width=width, color_system=None, highlight=False, markup=False, emoji=False)
    with console.capture() as capture:
        console.print(content)
    return capture.get()


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:16]
