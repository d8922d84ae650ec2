"""The letters and names that the parts of a problem ask for."""

import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from typing import Any

from rldrill.problems.exact import PARAMETERS
from rldrill.problems.parts import Matrix, Number, Numbers, Part, Values
from rldrill.solutions.diagnosis.alternatives import numbers, plain
from rldrill.solutions.diagnosis.search import Search
from rldrill.solutions.diagnosis.written_names import letters

#: The letter that a part asks for: For which number $n$ of data points …?
_LETTER = re.compile(r"(?:\w+ )?[Ww]h(?:ich|at)(?: is| must)?(?: [\w ]+?)? \$([^\W\d_])(?: = [^$]*)?\$(?!-)")
#: The name of what a part asks for: What is the entry $B_{2 1}$ …?
_QUANTITY = re.compile(r"What is (?:the [\w ]+ )?\$([^$]+)\$(?!-)")

#: The letter of a matrix that a part asks for: What is $J$ at this configuration?
_MATRIX = re.compile(r"What is (?:the [\w ]+ )?\$([^\W\d_])\$")


def called(part: Part) -> Sequence[str]:
    """The names of what a part asks for, in mathematics."""
    if isinstance(part.kind, Numbers):
        return part.kind.entries
    if isinstance(part.kind, Values):
        of = part.kind.of.split("(")[0]
        return [f"{of}({key if isinstance(key, str) else ','.join(key)})" for key in part.kind.keys]
    if isinstance(part.kind, Matrix) and (found := _MATRIX.match(part.ask)):
        places = product(range(1, part.kind.rows + 1), range(1, part.kind.columns + 1))
        line = 1 in (part.kind.rows, part.kind.columns)
        return [f"{found[1]}{max(place) if line else f'{place[0]}{place[1]}'}" for place in places]
    if isinstance(part.kind, Number) and (found := _QUANTITY.match(part.ask)):
        return [found[1]]
    return []


def numbers_of(value: Any) -> Iterator[Any]:
    """All numbers of an answer, in their order."""
    if isinstance(value, Mapping | tuple):
        for inner in value.values() if isinstance(value, Mapping) else value:
            yield from numbers_of(inner)
    else:
        yield from numbers(value) or ()


def asked_letters(search: Search) -> dict[str, Any]:
    """The letters that are asked for without an equation that was solved for them, with their values."""
    spelled_out = {glyph: code for code, glyph in PARAMETERS.items()}
    of_steps = {letter for each in search.applications for letter in letters(each.step)}
    asked = {}
    for part in search.problem.parts:
        found = _LETTER.match(part.ask) if isinstance(part.kind, Number) else None
        value = search.solution.answers.get(part.label)
        if found and found[1] not in of_steps and plain(value):
            letter = spelled_out.get(found[1], found[1])
            if letter not in search.problem.given.left_open:
                asked[letter] = value
    return asked
