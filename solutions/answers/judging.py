"""From a typed answer to a verdict that says what is wrong and why."""

import re
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from enum import Enum
from fractions import Fraction
from typing import Any, NamedTuple

from flint import fmpq
from msgspec import Struct

from rldrill.problems.document import joined
from rldrill.problems.expressions import GREEK
from rldrill.problems.notation import FUNCTIONS
from rldrill.problems.parts import Choice, Kind, Number, Part, Policy, YesNo
from rldrill.solutions.answers.kinds import Allowed, Cell, answer_kind
from rldrill.solutions.answers.rule import DIGITS, is_close, is_right, is_short, last_digit, tolerance, within
from rldrill.solutions.answers.source import LONGEST
from rldrill.solutions.answers.text import Reading, Unreadable
from rldrill.solutions.exact import NotReal, Value, absolute, is_rational, parameters, sign
from rldrill.solutions.formula.formula import Misconception
from rldrill.solutions.solution import Solution

#: An answer may be so many times as long as the right one is as it is typed: with decimals, names, and spaces.
_ROOM = 4
#: So many of the entries that were left out, or have too few digits, are named.
_NAMED = 3
_TWO_DIGITS = 10
_CUT_OFF = "The digits are right, but the last one is cut off: round it, do not cut it off, or give an exact value."
_SHORT = "Right idea; give an exact value or three digits."
_CLOSE = "Close, but not right: look for a slip, or for numbers that were rounded on the way."
#: A line of a working that says what it works out: the head of the name and its index, R and 0 of R_0^(2) = 2.
_NAMED_LINE = re.compile(r"\s*+([^\W\d_]++)(?:_?\{?([0-9]+))?[^=:≈\n]*+[=:≈]")
#: A decimal, with its last zeros: 1.0.
_DECIMAL = re.compile(r"-?[0-9]*\.([0-9]{1,4})")
#: The names of states and actions in a question; the value of one, V(cool) = 3.
_QUOTED = re.compile(r'"([^"$]+)"')
_OF_NAME = re.compile(r"\s*([^\W\d_][^\s()=:≈]*)\s*\(([^\W\d_]{2,}[^()=:≈]*)\)\s*[=:≈]")
#: A name that can be no number.
_WORD = re.compile(r"[^\W\d_]{3,}(?: [^\W\d_]+)*")


class Outcome(Enum):
    """What an answer is."""

    RIGHT = "right"
    FOLLOW_THROUGH = "follow-through"
    CLOSE = "close"
    MISCONCEPTION = "misconception"
    WRONG = "wrong"
    UNREADABLE = "unreadable"


class Verdict(Struct, frozen=True):
    """The judgement of one part.

    Args:
        outcome: what the answer is.
        says: one or two sentences to the person.
        credit: the share of the points that it earns, 0 to 1.
        read: how the answer was read; empty if it was not.
        misconceptions: the typical mistakes that give exactly this answer.
        told: those of them that ``says`` tells of; where few answers are possible, a wrong one proves none of several.
        wrong_cells: which entries of a table, vector or matrix are wrong.
        value: the value that was read, to go on from in later parts; None if it is not whole.
        missing: the sentence that asks for entries that were left out, where one may type again; they count as wrong.
    """

    outcome: Outcome
    says: str
    credit: Fraction = Fraction(0)
    read: str = ""
    misconceptions: tuple[Misconception, ...] = ()
    wrong_cells: tuple[str, ...] = ()
    value: Any = None
    told: tuple[Misconception, ...] = ()
    missing: str = ""

    def __repr__(self) -> str:
        return f"<Verdict {self.outcome.value}: {self.says}>"

    @property
    def accepted(self) -> bool:
        """Whether the part is done."""
        return self.outcome in (Outcome.RIGHT, Outcome.FOLLOW_THROUGH)

    @property
    def counts(self) -> bool:
        """Whether it is a try where one may type again: neither unreadable nor incomplete."""
        return self.outcome is not Outcome.UNREADABLE and not self.missing


def judge(solution: Solution, label: str, text: str, earlier: Mapping[str, Any] | None = None) -> Verdict:
    """Judge what was typed as the answer of a part.

    Args:
        solution: the solution of the problem.
        label: the part, ``a``.
        text: what was typed.
        earlier: the values that the person gave to earlier parts (``Verdict.value``), for follow-through.

    Raises:
        KeyError: the problem has no such part.
    """
    part = part_of(solution, label)
    try:
        cells = read_answer(solution, part, text)
    except Unreadable as error:
        return Verdict(Outcome.UNREADABLE, str(error))
    if missing := what_is_missing(solution, part, cells):
        return _partly(solution, part, cells, missing, earlier or {})
    value = answer_kind(part.kind).value({name: _content(cell) for name, cell in cells.items()})
    return _judge(solution, part, cells, value, _read(cells), dict(earlier or {}))


def read_answer(solution: Solution, part: Part, text: str) -> dict[str, Cell]:
    """What was typed as the answer of a part, cell by cell; it may be longer than the right one, but not much.

    A cell that was left out is not in it; ``what_is_missing`` asks for it.

    Raises:
        Unreadable: it cannot be understood.
    """
    kind, problem = answer_kind(part.kind), solution.problem
    if isinstance(part.kind, Number) and len(text) <= LONGEST:
        _refuse_other_quantity(text, part.ask)
    longest = LONGEST
    if len(text) > LONGEST:  # to write the right answer takes its time
        longest = max(LONGEST, _ROOM * len(kind.write(solution.answers[part.label])))
    names = kind.cells(solution.answers[part.label])
    if not isinstance(part.kind, Choice) and part.label not in {*names, *problem.parameters, "e"}:
        text = re.sub(rf"^\s*\(?{part.label}\)\s*(?=\S)", "", text)  # (a) 6.5
    allowed = Allowed(problem.parameters, problem.terminal_states, longest, _actions(problem.parts))
    return kind.read(text, allowed)


def _actions(parts: Sequence[Part]) -> tuple[str, ...]:
    """The actions that policies are asked for, but for those whose names could be numbers or letters of numbers."""
    found: dict[str, None] = {}
    for part in parts:
        if isinstance(part.kind, Policy):
            found |= dict.fromkeys(action for actions in part.kind.actions.values() for action in actions)
    return tuple(action for action in found if _WORD.fullmatch(action) and action not in GREEK)


def what_is_missing(solution: Solution, part: Part, cells: Mapping[str, Cell]) -> str:
    """The sentence that asks for the entries which an answer leaves out; empty if it leaves none out."""
    names = answer_kind(part.kind).cells(solution.answers[part.label])
    missing = [name for name in names if name not in cells]
    if not missing:
        return ""
    more = [f"{len(missing) - _NAMED} more"] if len(missing) > _NAMED + 1 else missing[_NAMED:]
    are, them = ("is", "it") if len(missing) == 1 else ("are", "them")
    return f"{joined([*missing[:_NAMED], *more])} {are} missing; give {them} too."


def _refuse_other_quantity(text: str, ask: str) -> None:
    """Refuse the value of another state; and lines of a working of which an earlier one names what is asked for.

    Raises:
        Unreadable: so it is.
    """
    states = _QUOTED.findall(ask)
    named = _OF_NAME.match(text.strip().rpartition("\n")[2])
    is_name = named is not None and named[1].lower() not in FUNCTIONS
    if named and is_name and states and not any(state.casefold() in named[2].casefold() for state in states):
        raise Unreadable(f"{named[1]}({named[2]}) is not asked for here, but {named[1]}({states[0]}).")
    lines = unicodedata.normalize("NFKC", text).strip().split("\n")  # R₀ is R0
    *earlier, last = [_NAMED_LINE.match(line) for line in lines]
    asked = [line for line in earlier if line and _is_named(line, ask)]
    if asked and last and not _is_named(last, ask):
        other, wanted = ("".join(filter(None, line.groups())) for line in (last, asked[-1]))
        raise Unreadable(f"The last line gives {other}, but {wanted} is asked for; type its value alone.")


def _is_named(line: re.Match[str], ask: str) -> bool:
    """Whether what a line works out is named in a question: with its index, if both have one."""
    name = re.escape(GREEK.get(line[1], line[1]))
    index = r"(?![^\W_])" if line[2] is None else rf"(?:_?\{{?{line[2]}(?![0-9])|(?!_?\{{?[0-9])(?![^\W_]))"
    return re.search(rf"(?<![^\W_]){name}{index}", ask) is not None


def part_of(solution: Solution, label: str) -> Part:
    """The part with that letter.

    Raises:
        KeyError: there is none.
    """
    for part in solution.problem.parts:
        if part.label == label:
            return part
    raise KeyError(label)


class _Left(NamedTuple):
    """The cells that are left wrong, with what would be right there; whether the rest goes on from own answers."""

    right: Mapping[str, tuple[Any, ...]]
    goes_on: bool = False

    @property
    def wrong(self) -> tuple[str, ...]:
        """The names of the cells."""
        return tuple(self.right)


def _left(solution: Solution, part: Part, cells: Mapping[str, Cell], earlier: Mapping[str, Any]) -> _Left:
    """What is wrong by the key, and by what follows from the person's own earlier answers.

    Every number may be the one or the other. A policy is held against one of them as a whole, that which leaves fewer
    wrong: of two actions each would be right, where the two differ.
    """
    key = answer_kind(part.kind).cells(solution.answers[part.label])
    wrong = wrong_cells(cells, key)
    ways = list(_following(solution, part, cells, earlier)) if wrong and earlier else []
    if isinstance(part.kind, Policy):
        way = min([key, *ways], key=lambda each: len(wrong_cells(cells, each)))
        return _Left({name: (way[name],) for name in wrong_cells(cells, way)}, way is not key)
    left = set(wrong).intersection(*(wrong_cells(cells, way) for way in ways))
    return _Left({name: (key[name], *(way[name] for way in ways)) for name in wrong if name in left}, left < set(wrong))


def _following(
    solution: Solution, part: Part, cells: Mapping[str, Cell], earlier: Mapping[str, Any]
) -> Iterator[dict[str, Any]]:
    """The cells of what follows from the person's own earlier answers, as far as it can be compared with."""
    for answers in solution.ways(earlier):
        with suppress(NotReal):  # an odd earlier answer leads to what is no real number: nobody can have typed it
            if part.label in answers:
                way = answer_kind(part.kind).cells(answers[part.label])
                wrong_cells(cells, way)
                yield way


def _partly(
    solution: Solution, part: Part, cells: dict[str, Cell], missing: str, earlier: Mapping[str, Any]
) -> Verdict:
    """The judgement of an answer that leaves entries out: they are wrong ones."""
    key = answer_kind(part.kind).cells(solution.answers[part.label])
    left = _left(solution, part, cells, earlier)
    named = [name if name in cells else f"{name} (left out)" for name in left.wrong]
    earned = credit(part.kind, len(key), len(left.wrong))
    says = _says_wrong(part.kind, named, len(key), goes_on=left.goes_on)
    return Verdict(Outcome.WRONG, says, earned, _read(cells), wrong_cells=left.wrong, missing=missing)


def _judge(
    solution: Solution, part: Part, cells: dict[str, Cell], value: Any, read: str, earlier: dict[str, Any]
) -> Verdict:
    left = _left(solution, part, cells, earlier)
    if not left.right:
        outcome, says = Outcome.RIGHT, "Right."
        if left.goes_on:
            outcome, says = Outcome.FOLLOW_THROUGH, "Right, going on from your earlier answer."
        return Verdict(outcome, says, Fraction(1), read, value=value)
    made = _made(solution, part, cells, earlier)
    count = len(solution.cells[part.label])
    earned = credit(part.kind, count, len(left.right))
    named = tuple(name for name in left.right if name)
    if told := _told(part.kind, made):
        says = " Or: ".join(dict.fromkeys(misconception.says for misconception in told))
        return Verdict(Outcome.MISCONCEPTION, says, earned, read, made, named, value, told)
    near = _close_to(cells, left.right)
    short = _with_few_digits(cells, left.right, near)
    if len({*near, *short}) == len(left.right):
        return Verdict(Outcome.CLOSE, _says_close(cells, near, short), earned, read, (), named, value)
    says = _says_wrong(part.kind, named, count, goes_on=left.goes_on, short=short)
    return Verdict(Outcome.WRONG, says, earned, read, made, named, value)


def _close_to(cells: Mapping[str, Cell], right: Mapping[str, tuple[Any, ...]]) -> dict[str, Value]:
    """What each wrong cell is close to, as far as it is close to something."""
    return {
        name: content
        for name, contents in right.items()
        for content in reversed(contents)
        if _is_close(cells[name], content)
    }


def _with_few_digits(
    cells: Mapping[str, Cell], right: Mapping[str, tuple[Any, ...]], near: Mapping[str, Value]
) -> list[str]:
    """The wrong cells that are rounded where their own digits end; beside one that surely is, also those of few."""
    sure = [name for name, content in near.items() if _is_short(cells[name], content)]
    if not sure:
        return []
    return [
        name
        for name, contents in right.items()
        if name in sure or any(_is_rounded(cells[name], content) for content in contents)
    ]


def _says_close(cells: Mapping[str, Cell], near: Mapping[str, Value], short: Sequence[str]) -> str:
    if all(_is_cut_off(cells[name], content) for name, content in near.items()) and not {*short} - {*near}:
        return _CUT_OFF
    done = {*short, *(name for name, content in near.items() if _is_cut_off(cells[name], content))}
    return _SHORT if done >= near.keys() else _CLOSE


def _says_wrong(kind: Kind, named: Sequence[str], cells: int, *, goes_on: bool, short: Sequence[str] = ()) -> str:
    off = [name for name in named if name not in short]
    if not short and not 0 < len(off) < cells:
        return "Not right."
    if goes_on and isinstance(kind, Policy):
        return f"At {_these(off)} this does not go on from your earlier answer; the rest does."
    said = f"Not right at {_these(off)}"
    if short:
        where = f"at {_these(short)}" if len(short) <= _NAMED + 1 else f"at {len(short)} others"
        said += f"; {where} there are too few digits, give three or an exact value"
    if len(named) == cells:
        return f"{said}."
    return f"{said}; the rest is right{', going on from your earlier answer' if goes_on else ''}."


def _these(named: Sequence[str]) -> str:
    *first, last = named
    between = "; " if any(", " in name for name in named) else ", "
    return f"{f'{between.join(first)} and ' if first else ''}{last}"


def credit(kind: Kind, cells: int, wrong: int) -> Fraction:
    """The share of the points that an answer with some wrong cells earns.

    Cells of a policy earn what is beyond guessing: with two actions everywhere, half of the states right is nothing.
    """
    if cells == 1:
        return Fraction(0)
    share = Fraction(cells - wrong, cells)
    if isinstance(kind, Policy):
        chance = sum((Fraction(1, len(possible)) for possible in kind.actions.values()), Fraction(0)) / cells
        return max(Fraction(0), (share - chance) / (1 - chance)) if chance < 1 else Fraction(0)
    return share


def _made(solution: Solution, part: Part, cells: dict[str, Cell], earlier: dict[str, Any]) -> tuple[Misconception, ...]:
    """The misconceptions that give this answer, from the start or from the person's earlier answers.

    One from the start is none if the earlier answers deny it: with the right ones it does not give this answer, or
    neither gives the wrong ones nor this answer with them.
    """
    wrong = {label: value for label, value in earlier.items() if solution.tells_apart({label: value})}
    right = {label: solution.answers[label] for label in earlier if label not in wrong}

    def stands(misconception: Misconception, answers: Mapping[str, Any]) -> bool:
        if right and not matches(part, cells, solution.answers_with(misconception, right) or {}):
            return False
        if not wrong or all(label in answers and not _differ(solution, label, answers, wrong) for label in wrong):
            return True
        return matches(part, cells, solution.answers_with(misconception, earlier) or {})

    made = tuple(
        misconception
        for misconception, answers in solution.mistakes
        if matches(part, cells, answers) and stands(misconception, answers)
    )
    # where nothing follows from what was answered before, a mistake that makes it follow is not to blame
    later = solution.mistaken(earlier) if earlier and not made and part.label in solution.following(earlier) else ()
    return made or tuple(misconception for misconception, answers in later if matches(part, cells, answers))


def _differ(solution: Solution, label: str, answers: Mapping[str, Any], others: Mapping[str, Any]) -> bool:
    """Whether two answers to a part are told apart; those of other cells are."""
    try:
        return solution.differ(label, answers[label], others[label])
    except (KeyError, NotReal):
        return True


def _told(kind: Kind, made: tuple[Misconception, ...]) -> tuple[Misconception, ...]:
    """The mistakes to tell of: a word can be wrong for many reasons, so at most the first; yes or no for any."""
    if isinstance(kind, YesNo):
        return made[:1] if len({misconception.says for misconception in made}) == 1 else ()
    return made[:1] if isinstance(kind, Choice | Policy) else made


def matches(part: Part, cells: Mapping[str, Cell], answers: Mapping[str, Any]) -> bool:
    """Whether what was typed is the answer that a mistake, or somebody's earlier answer, leads to."""
    if part.label not in answers:
        return False
    try:
        return not wrong_cells(cells, answer_kind(part.kind).cells(answers[part.label]))
    except NotReal:
        return False  # an odd earlier answer leads to what is no real number: nobody can have typed it


def _content(cell: Cell) -> Any:
    return cell.value if isinstance(cell, Reading) else cell


def _read(cells: Mapping[str, Cell]) -> str:
    return ", ".join(f"{name}: {_echo(cell)}" if name else _echo(cell) for name, cell in cells.items())


def _echo(cell: Cell) -> str:
    if isinstance(cell, Reading):
        return cell.echo
    return cell if isinstance(cell, str) else " or ".join(cell)


def wrong_cells(cells: Mapping[str, Cell], key: Mapping[str, Any]) -> tuple[str, ...]:
    """The names of the cells that are not right, or left out."""
    return tuple(name for name, content in key.items() if name not in cells or not _cell_is_right(cells[name], content))


def _cell_is_right(cell: Cell, key: Any) -> bool:
    if isinstance(cell, Reading):
        return is_right(cell.value, key, rounded=cell.decimal)
    return all(word in key for word in ((cell,) if isinstance(cell, str) else cell))


def _is_close(cell: Cell, key: Value) -> bool:
    """Whether a number that may be a rounded one is near the key; who writes 5/16 or 2√3 means just that."""
    if not isinstance(cell, Reading):
        return False
    rounded = cell.decimal or (is_rational(cell.value) and cell.value.q == 1)
    return rounded and is_close(cell.value, key)


def _is_short(cell: Cell, key: Value) -> bool:
    return isinstance(cell, Reading) and is_short(cell.value, key)


def _is_rounded(cell: Cell, key: Value) -> bool:
    """Whether a number is the key, rounded to a decimal of one or two digits, or to a whole number of two."""
    if not isinstance(cell, Reading) or not is_rational(cell.value) or parameters(key):
        return False
    decimal = _DECIMAL.fullmatch(cell.echo)
    unit = fmpq(1, 10 ** len(decimal[1])) if decimal else last_digit(cell.value)
    if unit is None or not cell.value or abs(cell.value) >= 100 * unit or (unit == 1 and abs(cell.value) < _TWO_DIGITS):
        return False
    return (cell.decimal or unit == 1) and within(cell.value, key, unit / 2)


def _is_cut_off(cell: Cell, key: Value) -> bool:
    """Whether a decimal is the key's first three digits, where the third one had to be rounded up."""
    if not isinstance(cell, Reading) or len(re.sub("[^0-9]", "", cell.echo).lstrip("0")) < DIGITS:
        return False
    if not is_rational(cell.value) or (cell.value / (2 * tolerance(key))).q != 1:
        return False
    behind = absolute(key) - absolute(cell.value)
    return sign(cell.value) == sign(key) and sign(behind) > 0 and sign(2 * tolerance(key) - behind) > 0
