"""Write every sentence that problems can print, one of a kind, so that somebody can read them all in one go.

    python docs/sentences.py [FAMILY ...] [-n 20]

Of many draws of every family and level: statements, questions, hints, sentences of workings, typical mistakes. Numbers
are written # and mathematics stays as it is, so that sentences which differ in numbers only come once.
"""

import argparse
import re
from collections.abc import Iterator, Mapping

from pydantic import BaseModel

from rldrill.exercise import Exercise, draw
from rldrill.problems.catalogue import families, family
from rldrill.problems.document import Beside, Block, Heading, Paragraph
from rldrill.problems.parts import Choice
from rldrill.render.unicode import unicode_text

_NUMBER = re.compile(r"−?\d+(/\d+)?")
_SENTENCE = re.compile(r"(?<=[.?!:]) +(?=[A-Z(])")


def texts(blocks: tuple[Block, ...]) -> Iterator[str]:
    """The running texts of a page."""
    for block in blocks:
        if isinstance(block, Paragraph | Heading):
            yield unicode_text(block)
        elif isinstance(block, Beside):
            yield from texts(block.blocks)


def said(exercise: Exercise) -> Iterator[tuple[str, str]]:
    """What a problem says, each text with where it stands."""
    for text in texts(tuple(exercise.question())):
        yield "states", text
    for part in exercise.parts:
        yield "asks", unicode_text(Paragraph(part.ask))
        if isinstance(part.kind, Choice):
            for option in part.kind.options.values():
                yield "offers", unicode_text(Paragraph(option))
    for text in texts(tuple(exercise.working())):
        yield "works", text
    for formula in exercise.formulas():
        yield "hints", formula.hint
    for mistake, _ in exercise.solution.mistakes:
        yield "corrects", mistake.says


def bare(text: str, names: set[str]) -> str:
    """A text without its numbers, and with one name in the place of every name."""
    for name in sorted(names, key=len, reverse=True):
        text = re.sub(rf"\b{re.escape(name)}\b", "~", text)
    return _NUMBER.sub("#", text)


def names_in(value: object) -> Iterator[str]:
    """The names that the givens hold: of states, actions, hypotheses."""
    if isinstance(value, BaseModel):
        for field in type(value).model_fields:
            yield from names_in(getattr(value, field))
    elif isinstance(value, Mapping):
        for key, inner in value.items():
            yield from (*names_in(key), *names_in(inner))
    elif isinstance(value, tuple):
        for item in value:
            yield from names_in(item)
    elif isinstance(value, str) and len(value) > 1:
        yield value


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("family", nargs="*")
    parser.add_argument("-n", type=int, default=20, help="draws of every level")
    chosen = parser.parse_args()
    for known in chosen.family or families():
        sentences: dict[str, str] = {}
        for level in family(known).levels:
            for seed in range(chosen.n):
                exercise = draw(known, level, seed)
                names = set(names_in(exercise.problem.given))
                for place, text in said(exercise):
                    for sentence in _SENTENCE.split(text):
                        sentences.setdefault(f"{place:9}{bare(sentence, names)}", "")
        print(f"\n{known}", *sorted(sentences), sep="\n  ")
