"""The names under which somebody may write a quantity of the working: V(cool), V_1, R'0, p_bar(dry)."""

import re
from collections.abc import Iterator, Sequence
from functools import cache
from unicodedata import combining, normalize

from sympy import Expr, preorder_traversal

from rldrill.problems.mathematics import Accent, Big, Fence, Fraction, Glyph, Math, Root, Row, Script
from rldrill.problems.notations import in_notation
from rldrill.solutions.formula.edits import flat
from rldrill.solutions.formula.typesetting import typeset
from rldrill.solutions.sheet import formulas
from rldrill.solutions.work import Step

#: The brackets in which more than one sign is above or below a letter: V^(π₀)(cool).
_SCRIPT = re.compile(r"[_^][({]([^(){}]*)[)}]")
#: What stands above a letter before its argument: V^pi(cool).
_ABOVE = re.compile(r"\^\w+(?=\()")
#: What stands behind a letter for a sign above it.
_MARKS = re.compile(r"′|(?:bar|hat|tilde)(?=\W|\d|\Z)")
#: What somebody types at a keyboard in the place of a stroke, and an index before it: R_0' is R′₀.
_STROKE, _INDEX_FIRST = re.compile(r"['’`]"), re.compile(r"(?<![^\W\d_])([^\W\d_]+)(\d+)(′+)")
#: What comes behind a letter: its index, the condition of a probability.
_INDEX, _CONDITION = re.compile(r"(?<=[^\W\d_])\d+(?=\(|\Z)|(?<=′)\d+(?=\(|\Z)"), re.compile(r"\|[^()|]*(?=\))")
#: That something was measured, whatever it was.
_MEASURED = re.compile(r"\|z\d*(?=\))")
_WORDS = {"gamma": "γ", "alpha": "α", "delta": "δ", "lambda": "λ", "epsilon": "ε", "theta": "θ", "pi": "π", "rho": "ρ",
          "sigma": "σ", "beta": "β", "phi": "φ", "omega": "ω"}  # fmt: skip


def plain_name(label: str) -> str:
    """A name without what differs from one hand to another."""
    return spelled(label).lower()


def spelled(label: str) -> str:
    """The same, large letters kept."""
    name = re.sub(r"[\s_{}^]|new", "", "".join(sign for sign in normalize("NFKD", label) if not combining(sign)))
    for word, letter in _WORDS.items():
        name = name.replace(word, letter)
    name = re.sub(r"(?<![^\W\d_])mu(?![^\W\d_])", "μ", name)
    name = re.sub(r"(?<![^\W\d_])bel(?=\W|\d|bar)", "p", name)
    return _INDEX_FIRST.sub(r"\1\3\2", _STROKE.sub("′", name))


def readings(label: str) -> Iterator[str]:
    """The names that a label may be, the one that it says first; V' may be the new V."""
    wanted = plain_name(label)
    yield wanted
    yield plain_name(_SCRIPT.sub(r"\1", label))
    yield plain_name(_ABOVE.sub("", label))
    yield _MARKS.sub("", wanted)
    yield _MEASURED.sub("", wanted)


def of_another_index(label: str) -> str:
    """The name without its index, where it has an argument, too: p2(dry) is p(dry) at some step."""
    wanted = _MARKS.sub("", plain_name(label))
    return _INDEX.sub("", wanted) if "(" in wanted else ""


def names(step: Step) -> set[str]:
    """The names under which somebody may write a step."""
    time = step.known.get("t")
    found = set()
    for written in set(names_of(step.left)):
        head = re.sub(r"\(.*", "", written)
        found |= {written, re.sub(r"[(),]", "", written), head, _CONDITION.sub("", written)}
        if len(indices := {*re.findall(r"\d+", written.removeprefix(head))}) == 1:
            found.add(head + indices.pop())  # r1 for r(s_1)
        if isinstance(time, int):
            found |= {f"{head}{time}", re.sub("t(?![a-z])", str(time), written)}
    return found


def names_of(quantity: Expr) -> Iterator[str]:
    """A name in the notation in use, without what is above and below its letters, and with the letter of the textbooks.

    Where the notation in use has another letter for it, the lecture's may be that of something else.
    """
    left = in_notation(typeset(quantity))
    for math in (left, *_without_scripts(left), _with_plain_arguments(left)):
        written = plain_name(_signs(math))
        yield written
        yield written.replace("(s,", "(")  # h(search) for h(s, search)
        if (code := getattr(quantity, "code", "")).isupper() and len(code) == 1:  # G, which is R on the sheet
            yield code.lower() + written[1:]


def _with_plain_arguments(math: Math) -> Math:
    """The name without indices in its brackets: p(D|loaded) for p(D_z|loaded)."""
    match math:
        case Row(items):
            return Row(tuple(map(_with_plain_arguments, items)))
        case Fence(Row(items), left, right):
            return Fence(Row(tuple(each.body if isinstance(each, Script) else each for each in items)), left, right)
        case _:
            return math


def letters(step: Step) -> set[str]:
    """The letter of a step alone, without its index or argument, large or small as it is."""
    left = in_notation(typeset(step.left))
    written = (spelled(_signs(math)) for math in (left, *_without_scripts(left)))
    found = {_INDEX.sub("", re.sub(r"\(.*", "", name)) for name in written}
    return {letter for letter in found if len(letter) == 1 and letter.isalpha()}


@cache
def parts_with_letters(right: Expr) -> Sequence[tuple[str, Expr]]:
    """The parts of a right side that are a formula of their own, with its letter: δ in an update by TD(0)."""
    of_sheet = {flat(formula.right): formula.left for formula in formulas().values()}
    parts = (part for part in preorder_traversal(flat(right)) if part.is_Add and part != right)
    return [(spelled(_signs(typeset(of_sheet[part])))[0], part) for part in parts if part in of_sheet]


def _without_scripts(left: Math) -> Iterator[Math]:
    """The name without what stands above its first sign, V(s) for V^π(s), and below it, where more comes."""
    match left:
        case Row((Script(body, _, _), *others)) if others:
            yield Row((body, *others))
            yield from (Row((first, *others)) for first in _without_scripts(left.items[0]))
        case Script(body, below, _):
            yield Script(body, below)


def _signs(math: Math) -> str:
    """Mathematics as bare signs, one after the other."""
    match math:
        case Glyph(text, _):
            return text
        case Row(items):
            return "".join(map(_signs, items))
        case Fraction(above, below):
            return f"{_signs(above)}/{_signs(below)}"
        case Script(body, below, above):
            return _signs(body) + "".join(_signs(each) for each in (below, above) if each is not None)
        case Fence(body, left, right):
            return f"{left}{_signs(body)}{right}"
        case Root(body) | Accent(body, _):
            return _signs(body)
        case Big(sign, _, _):
            return sign
        case _:
            return ""
