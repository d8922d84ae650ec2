"""What the numbers in a line of somebody's working tell: which of the ways to get its value was gone."""

import re
from collections import Counter
from collections.abc import Iterable, Iterator

from flint import fmpq
from sympy import Expr

from rldrill.problems import mathematics as written
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.grammar import read
from rldrill.problems.latex import typed
from rldrill.problems.mathematics import Math
from rldrill.problems.notation import Node, Numeral, Operation
from rldrill.problems.spelling import Unreadable
from rldrill.solutions.diagnosis import weights
from rldrill.solutions.diagnosis.alternatives import terms, value_or_none
from rldrill.solutions.diagnosis.causes import Cause
from rldrill.solutions.diagnosis.replay import UNDONE, Application
from rldrill.solutions.exact import is_rational
from rldrill.solutions.formula.edits import SCALE, SHIFT, probes
from rldrill.solutions.formula.lines import lines_between
from rldrill.solutions.formula.notation import Quantity
from rldrill.solutions.formula.putting_in import put_in
from rldrill.solutions.formula.typesetting import typeset

#: The numbers of a line, without signs; zeros and ones are left out, as people leave them out.
Numbers = Counter[Fraction]
#: A fraction among factors is one number: 1/2·4/5.
_FRACTION = re.compile(r"(?<![\w.)/^])\d+/\d+(?![\w.(/^])")
#: A line is known by its numbers where at most one of so many is another one.
_IDENTIFY = 3
#: A line with fewer numbers is a value, and tells nothing of how it was found.
_FEWEST = 2


def numbers_typed(text: str) -> Numbers | None:
    """The numbers in what somebody wrote; None where there is only one, or it cannot be read."""
    try:
        found = list(_numerals(read(typed(_FRACTION.sub(r"(\g<0>)", text), len(text) + 2 * text.count("/")))))
    except Unreadable:
        return None
    return _told(found) if len(found) >= _FEWEST else None


def _numerals(node: Node) -> Iterator[Fraction]:
    if isinstance(node, Numeral):
        yield node.value
    elif isinstance(node, Operation):
        parts = [part.value for part in node.parts if isinstance(part, Numeral)]
        if node.sign == "/" and len(parts) == len(node.parts) and parts[1]:
            yield parts[0] / parts[1]
            return
        for part in node.parts:
            yield from _numerals(part)


def by_the_numbers(application: Application, causes: Iterable[Cause], line: Numbers) -> list[Cause]:
    """Those of the causes whose line has the numbers that were written, or comes nearest to them."""
    right = _numbers_of(application, None)
    far = [(apart(_line_of(cause, application, right), line), cause) for cause in causes]
    far.sort(key=lambda each: each[0])
    return [cause for distance, cause in far if distance == far[0][0]]


def told_by(application: Application, causes: Iterable[Cause], line: Numbers) -> tuple[int, list[Cause]] | None:
    """Those of the causes that the numbers of a line tell, and how many of these differ; None where they tell none."""
    right = _numbers_of(application, None)
    found: dict[int, list[Cause]] = {}
    for cause in causes:
        for those in (_line_of(cause, application, right), *_lines_between(cause, application)):
            far = apart(those, line)
            alike = (those & line).total() - (cause.kind == "elsewhere")
            if far * _IDENTIFY <= those.total() and alike > 1 - (far == 0):
                found.setdefault(far, []).append(cause)
                break
    return min(found.items(), key=lambda each: each[0], default=None)


def _lines_between(cause: Cause, application: Application) -> Iterator[Numbers]:
    """The numbers of the lines that come before the value, of somebody who goes on from an edit."""
    if cause.edit is None or cause.term:
        return
    try:
        for between in lines_between(put_in(cause.edit.right, application.known), own=application.step.own):
            yield numbers_in(between)
    except UNDONE:
        return


def put_in_otherwise(application: Application, line: Numbers) -> Iterator[Cause]:
    """A number of the line in the place of a value that it has not: 2 for V(warm), which is 4."""
    foreign = line - _numbers_of(application, None)
    known = application.known
    for probe in probes(application.right):
        if not (isinstance(probe.part, Quantity) or probe.part.is_Symbol):
            continue
        for term, at in list(terms(probe.within, known)) if probe.within else [((), {})]:
            here = {**known, **dict(zip((over.index.name for over in probe.within), term, strict=True))}
            was = value_or_none(probe.part, here)
            if not is_rational(was):
                continue
            for number in foreign:
                for other in (fmpq(number.numerator, number.denominator), -fmpq(number.numerator, number.denominator)):
                    letters = {**at, SCALE.name: fmpq(0), SHIFT.name: other}
                    came = value_or_none(probe.right, {**known, **letters})
                    if is_rational(came):
                        yield Cause("elsewhere", weights.INSIDE["elsewhere"], application, application.formula,
                                    probe=probe, term=term, was=was, other=other, became=came)  # fmt: skip


def _line_of(cause: Cause, application: Application, right: Numbers) -> Numbers:
    """The numbers that stand in the line of somebody who errs so."""
    if cause.probe is not None:
        return right - _one(cause.was) + _one(cause.other)
    if cause.edit is None or cause.term:
        return right
    return _numbers_of(application, cause)


def _numbers_of(application: Application, cause: Cause | None) -> Numbers:
    right = application.right if cause is None or cause.edit is None else cause.edit.right
    try:
        return numbers_in(put_in(right, application.known))
    except UNDONE:
        return Counter()


def numbers_in(expression: Expr) -> Numbers:
    """The numbers that stand in an expression as it is written."""
    return _told(_in(typeset(expression)))


def _one(value: object) -> Numbers:
    return _told([Fraction(int(value.p), int(value.q))]) if is_rational(value) else Counter()


def _told(numbers: Iterable[Fraction]) -> Numbers:
    return Counter(abs(number) for number in numbers if abs(number) not in (0, 1))


def apart(one: Numbers, other: Numbers) -> int:
    """How many numbers stand in one line or in another, and not in both."""
    return sum(((one - other) + (other - one)).values())


def _in(math: Math) -> Iterator[Fraction]:
    """The numbers in typeset mathematics."""
    match math:
        case written.Glyph(text, "number"):
            yield fraction_of(text)
        case written.Fraction(written.Glyph(above, "number"), written.Glyph(below, "number")):
            yield Fraction(int(above), int(below))
        case written.Fraction(above, below):
            yield from _in(above)
            yield from _in(below)
        case written.Row(items):
            for item in items:
                yield from _in(item)
        case written.Script(body, below, above):
            for part in (body, below, above):
                if part is not None:
                    yield from _in(part)
        case written.Fence(body, _, _) | written.Root(body) | written.Accent(body, _):
            yield from _in(body)
