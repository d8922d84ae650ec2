"""What is said of how to type an answer: an example of the very shape that a part asks for."""

from collections.abc import Iterable, Sequence
from itertools import cycle, islice

from rldrill.entries import entry_name
from rldrill.problems.parts import Kind, Matrix, Number, Numbers, Policy, Values
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.answers.rule import DIGITS

#: So many entries are written out in an example.
_MANY = 4
_EXAMPLES = ("3/4", "0.5", "2", "-1")


def how_to_type(kind: Kind, parameters: Sequence[str] = ()) -> str:
    """How an answer is typed: its shape with an example, and the rule for numbers where it has any."""
    example = _examples(parameters)
    match kind:
        case Number() if parameters:
            return f"an expression in {' and '.join(parameters)}: {next(example)}, in any form"
        case Number() | Matrix(1, 1) | Values(keys=(_,)):
            return f"a number, {_exact(parameters)}: 3/4, 0.75 or 2 + 1/2*3"
        case Numbers(entries) if len(entries) == 1:
            return f"{entry_name(entries[0])}, {_exact(parameters)}: {next(example)}"
        case Numbers(entries):
            names = ", ".join(map(entry_name, entries))
            return f"{names} in this order, {_exact(parameters)}: {_shortened(example, len(entries))}"
        case Matrix(rows, columns):
            lines = [", ".join(islice(example, columns)) for _ in range(rows)]
            shown = "; ".join(lines)
            return f"{rows} × {columns}, {_exact(parameters)}: [{shown}]"
        case Values(_, keys):
            places = [key if isinstance(key, str) else f"({', '.join(key)})" for key in keys]
            pairs = (f"{name}: {number}" for name, number in zip(places, example, strict=False))
            return f"every value, {_exact(parameters)}: {_shortened(pairs, len(places))}"
        case Policy(actions, of) if of:
            pairs = (f"{state}: {possible[0]}" for state, possible in actions.items())
            return f"an action for every state, such as {_shortened(pairs, len(actions))}"
        case _:
            return answer_kind(kind).how_to_type()


def _exact(parameters: Sequence[str]) -> str:
    if parameters:
        return f"in {' and '.join(parameters)} where it depends on {'them' if len(parameters) > 1 else 'it'}"
    return f"exact or to {DIGITS} significant digits"


def _examples(parameters: Sequence[str]) -> "cycle[str]":
    return cycle([f"1 + 1/2*{parameters[0]}", *_EXAMPLES] if parameters else _EXAMPLES)


def _shortened(items: Iterable[str], number: int) -> str:
    shown = ", ".join(islice(items, min(number, _MANY)))
    return shown if number <= _MANY else f"{shown}, …"
