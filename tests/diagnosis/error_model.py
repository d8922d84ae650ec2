"""How students err: wrong answers with what is known of them, made without the program's own edits.

Errors are made in three ways, none of which knows how the program searches:

- in the *written* step, as a student writes it down with the numbers put in: a term is lost between two lines, a sign,
  a bracket, a factor; once (a slip), or in every step by that formula (a wrong idea). The wrong value is worked out
  by the small arithmetic of ``_worth``, and the solver goes on with it;
- in the *value* of a step: an arithmetic slip that is carried forward, an old value that is kept;
- in the *answer*: entries exchanged, another quantity written down, a sign lost on the way to the sheet.

What wrong procedures give is worked out family by family in ``by_hand.py``.
"""

import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from operator import add, mul
from typing import Any

import sympy
from flint import fmpq

from rldrill.problems.parts import Policy
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.answers.rule import apart
from rldrill.solutions.exact import NoSolution, NotGiven, NotReal, decimal, is_rational, parameters, simplest
from rldrill.solutions.formula.nodes.choices import Choice, Greatest, Least
from rldrill.solutions.formula.nodes.leaves import MatrixLeaf, Negative, Slot, VectorLeaf
from rldrill.solutions.formula.nodes.matrices import Transposed
from rldrill.solutions.formula.nodes.sets import MaxOf
from rldrill.solutions.matrices import is_matrix, matrix
from rldrill.solutions.rational import generator
from rldrill.solutions.solution import Solution, solver
from rldrill.solutions.vector import Vector
from rldrill.solutions.work import Step, Work


@dataclass(frozen=True)
class Erroneous:
    """A wrong answer: to which part, how it was made, in which step (None: in all by that formula), and the text."""

    kind: str
    part: str
    text: str
    formula: str | None = None
    place: int | None = None
    everywhere: bool = False
    twofold: bool = False


# The student's arithmetic ---------------------------------------------------------------------------
def _worth(expression: Any) -> Any:
    """What a written line is worth; raises TypeError where nobody would work it out in numbers."""
    if isinstance(expression, VectorLeaf):
        return Vector(map(simplest, expression.args[0]))
    if isinstance(expression, MatrixLeaf):
        return matrix([[simplest(entry) for entry in row] for row in expression.args[0].tolist()])
    if isinstance(expression, Negative | Slot):
        return _worth(expression.args[0])
    if isinstance(expression, Transposed):
        return _worth(expression.args[0]).transpose()
    if isinstance(expression, Greatest | Least):
        values = [_worth(each) for each in expression.args]
        if not all(map(is_rational, values)):
            raise TypeError("not numbers")
        return max(values) if isinstance(expression, Greatest) else min(values)
    if expression.is_Rational:
        return fmpq(int(expression.p), int(expression.q))
    if expression.is_Symbol and expression.name in ("gamma", "alpha", "lam", "epsilon", "p", "beta"):
        return generator(expression.name)
    if expression.is_Add:
        return reduce(add, map(_worth, expression.args))
    if expression.is_Mul:
        return reduce(mul, map(_worth, expression.args))
    if expression.is_Pow and expression.args[1].is_Integer:
        base, power = _worth(expression.args[0]), int(expression.args[1])
        if is_matrix(base):
            return base.inv() if power == -1 else _fail()
        return base**power if power >= 0 else 1 / base**-power
    if isinstance(expression, sympy.Abs):
        return abs(_worth(expression.args[0]))
    if isinstance(expression, sympy.exp):
        inner = _worth(expression.args[0])
        return sympy.exp(sympy.sympify(inner)) if is_rational(inner) and inner else _fail()
    return _fail()


def _fail() -> Any:
    raise TypeError("nothing to work out")


# Errors in a written line ---------------------------------------------------------------------------
Rewrite = Callable[[Any], Iterator[Any]]


def _sum(terms: Sequence[Any]) -> Any:
    return terms[0] if len(terms) == 1 else sympy.Add(*terms, evaluate=False)


def _product(factors: Sequence[Any]) -> Any:
    return factors[0] if len(factors) == 1 else sympy.Mul(*factors, evaluate=False)


def _without(items: Sequence[Any], place: int) -> list[Any]:
    return [*items[:place], *items[place + 1 :]]


def term_lost(line: Any) -> Iterator[Any]:
    if line.is_Add:
        yield from (_sum(_without(line.args, place)) for place in range(len(line.args)))


def factor_lost(line: Any) -> Iterator[Any]:
    if line.is_Mul and not any(isinstance(each, MatrixLeaf | Transposed) for each in line.args):
        yield from (_product(_without(line.args, place)) for place, each in enumerate(line.args) if each != -1)


def sign_turned(line: Any) -> Iterator[Any]:
    if line.is_Add:
        for place, term in enumerate(line.args):
            turned = sympy.Mul(sympy.S.NegativeOne, term, evaluate=False)
            yield _sum([*line.args[:place], turned, *line.args[place + 1 :]])


def bracket_lost(line: Any) -> Iterator[Any]:
    """a·(b + c) read as a·b + c."""
    if line.is_Mul and line.args[-1].is_Add and len(line.args) > 1:
        *factors, bracket = line.args
        first, *rest = bracket.args
        yield _sum([_product([*factors, first]), *rest])


def bracket_widened(line: Any) -> Iterator[Any]:
    """a + b·c read as (a + c)·b; with a product in the place of a nobody does."""
    if line.is_Add and not any(term.is_Mul and term.args[0] != -1 for term in line.args[:1]):
        for place, term in enumerate(line.args):
            if term.is_Mul and len(term.args) == 2 and term.args[0] != -1:
                yield _product([term.args[0], _sum([*_without(line.args, place), term.args[1]])])


def minus_lost(line: Any) -> Iterator[Any]:
    if isinstance(line, Negative):
        yield -line.args[0]


def power_off(line: Any) -> Iterator[Any]:
    if line.is_Pow and line.args[1].is_Integer and line.args[1] > 1:
        for power in (line.args[1] - 1, line.args[1] + 1):
            yield sympy.Pow(line.args[0], power, evaluate=False)


def power_as_product(line: Any) -> Iterator[Any]:
    if line.is_Pow and line.args[1].is_Integer and line.args[1] > 1:
        yield _product([line.args[0], line.args[1]])


def square_forgotten(line: Any) -> Iterator[Any]:
    if line.is_Pow and line.args[1] == 2:
        yield line.args[0]


def factor_twice(line: Any) -> Iterator[Any]:
    if line.is_Mul and all(each.is_commutative is not False for each in line.args):
        for place, factor in enumerate(line.args):
            if factor.is_Rational and factor != -1:
                yield _product([*line.args[: place + 1], *line.args[place:]])


def smallest_taken(line: Any) -> Iterator[Any]:
    if isinstance(line, MaxOf) and len(line.args) > 1:
        yield Least(*line.args)


def mean_taken(line: Any) -> Iterator[Any]:
    if isinstance(line, MaxOf) and len(line.args) > 1:
        yield _product([sympy.Rational(1, len(line.args)), _sum(line.args)])


def all_added(line: Any) -> Iterator[Any]:
    if isinstance(line, MaxOf) and len(line.args) > 1:
        yield _sum(line.args)


def first_taken(line: Any) -> Iterator[Any]:
    if isinstance(line, Choice) and len(line.args) > 1:
        yield from line.args


def complement_taken(line: Any) -> Iterator[Any]:
    """1 − 1/4 for the factor 1/4."""
    if line.is_Mul:
        for place, factor in enumerate(line.args):
            if factor.is_Rational and 0 < factor < 1 and factor.q != 2:
                yield _product([*line.args[:place], 1 - factor, *line.args[place + 1 :]])


def complement_forgotten(line: Any) -> Iterator[Any]:
    """1/4 for 1 − 1/4."""
    if line.is_Add and len(line.args) == 2 and line.args[0] == 1 and line.args[1].is_Mul and line.args[1].args[0] == -1:
        yield _product(line.args[1].args[1:])


def inverse_forgotten(line: Any) -> Iterator[Any]:
    if line.is_Pow and line.args[1] == -1:
        yield line.args[0]


def upside_down(line: Any) -> Iterator[Any]:
    """b/a for a/b."""
    if line.is_Mul and any(each.is_Pow and each.args[1] == -1 for each in line.args):
        yield sympy.Pow(_product(line.args), -1, evaluate=False)


def transposition_forgotten(line: Any) -> Iterator[Any]:
    if isinstance(line, Transposed):
        yield line.args[0]


def matrices_exchanged(line: Any) -> Iterator[Any]:
    if line.is_Mul:
        for place in range(len(line.args) - 1):
            if all(each.is_commutative is False for each in line.args[place : place + 2]):
                one, two = line.args[place : place + 2]
                yield _product([*line.args[:place], two, one, *line.args[place + 2 :]])


def added_for_multiplied(line: Any) -> Iterator[Any]:
    if line.is_Mul and len(line.args) == 2 and line.args[0] != -1 and all(each.is_Rational for each in line.args):
        yield _sum(line.args)


def point_shifted(line: Any) -> Iterator[Any]:
    """0.09 for 0.9: in the product of two numbers."""
    if line.is_Mul and len(line.args) >= 2 and line.args[0].is_Rational and line.args[0] != -1:
        yield _product([sympy.Rational(1, 10), *line.args])
        yield _product([sympy.Integer(10), *line.args])


def fractions_added_crosswise(line: Any) -> Iterator[Any]:
    """a/b + c/d as (a + c)/(b + d)."""
    if line.is_Add and len(line.args) == 2:
        try:
            one, two = map(_worth, line.args)
        except (TypeError, ZeroDivisionError, ValueError):
            return
        if is_rational(one) and is_rational(two) and one.q != 1 and two.q != 1 and one.q != two.q:
            yield sympy.Rational(int(one.p + two.p), int(one.q + two.q))


def numbers_exchanged(line: Any) -> Iterator[Any]:
    """The two numbers of a difference, the other way round."""
    if line.is_Add and len(line.args) == 2 and line.args[1].is_Mul and line.args[1].args[0] == -1:
        yield sympy.Mul(sympy.S.NegativeOne, line, evaluate=False)


#: Errors between two written lines, by their names.
WRITTEN: dict[str, Rewrite] = {
    rewrite.__name__: rewrite
    for rewrite in (
        term_lost, factor_lost, sign_turned, bracket_lost, bracket_widened, minus_lost, power_off, power_as_product,
        square_forgotten, factor_twice, smallest_taken, mean_taken, all_added, first_taken, complement_taken,
        complement_forgotten, inverse_forgotten, upside_down, transposition_forgotten, matrices_exchanged,
        added_for_multiplied, point_shifted, fractions_added_crosswise, numbers_exchanged,
    )
}  # fmt: skip
#: Those that somebody makes every time, if at all: a wrong idea of the formula. The others are slips alone.
IDEAS = {
    "term_lost", "factor_lost", "sign_turned", "bracket_lost", "bracket_widened", "power_off", "square_forgotten",
    "smallest_taken", "mean_taken", "all_added", "complement_taken", "complement_forgotten", "inverse_forgotten",
    "transposition_forgotten", "matrices_exchanged", "numbers_exchanged",
}  # fmt: skip


def rewritten(line: Any, rewrite: Rewrite, depth: int = 0) -> Iterator[tuple[tuple[int, ...], Any]]:
    """The line with one of its parts rewritten, and where."""
    for number, other in enumerate(rewrite(line)):
        yield (-1 - number,), other
    if isinstance(line, MatrixLeaf | Negative | Slot) or not line.args:
        return
    for place, part in enumerate(line.args):
        if not isinstance(part, sympy.Basic):
            continue
        for path, other in rewritten(part, rewrite, depth + 1):
            arguments = [*line.args[:place], other, *line.args[place + 1 :]]
            if line.is_Add or line.is_Mul or line.is_Pow or isinstance(line, sympy.exp | sympy.log | sympy.Abs):
                yield (place, *path), line.func(*arguments, evaluate=False)
            else:
                yield (place, *path), line.func(*arguments)


# Errors in a value ----------------------------------------------------------------------------------
Spoil = Callable[[fmpq, random.Random], Any]


def _digits_swapped(value: fmpq, rng: random.Random) -> Any:
    top = str(abs(int(value.p)))
    places = [place for place in range(len(top) - 1) if top[place] != top[place + 1] and top[place + 1] != "0"]
    if not places:
        return None
    place = rng.choice(places)
    swapped = top[:place] + top[place + 1] + top[place] + top[place + 2 :]
    return fmpq(int(swapped) * (1 if value > 0 else -1), int(value.q))


#: Arithmetic slips in the value of a step.
SPOILT: dict[str, Spoil] = {
    "value_sign": lambda value, _: -value,
    "value_tenfold": lambda value, rng: value * 10 if rng.random() < 0.5 else value / 10,
    "value_one_off": lambda value, rng: value + rng.choice((-1, 1)),
    "value_digits_swapped": _digits_swapped,
    "value_numerator_off": lambda value, rng: (
        fmpq(int(value.p) + rng.choice((-1, 1)), int(value.q)) if value.q != 1 else None
    ),
    "value_denominator_off": lambda value, rng: (
        fmpq(int(value.p), int(value.q) + rng.choice((-1, 1))) if value.q > 2 else None
    ),
    "value_halved": lambda value, rng: value * 2 if rng.random() < 0.5 else value / 2,
}


class Erring(Work):
    """A solver's notebook in the hands of somebody who errs: ``err`` says what is written for a step's value."""

    def __init__(self, err: Callable[[int, Step], Any]) -> None:
        super().__init__()
        self.err = err
        self.count = 0

    def step(self, *arguments: Any, **named: Any) -> Any:
        value = super().step(*arguments, **named)
        wrong = self.err(self.count, self.lines[-1])
        self.count += 1
        return value if wrong is None else wrong


def _answers(solution: Solution, err: Callable[[int, Step], Any]) -> Mapping[str, Any] | None:
    work = Erring(err)
    try:
        solver(solution.problem.family).solve(solution.problem.given, work)
    except (NoSolution, NotGiven, NotReal, ArithmeticError, TypeError, ValueError, LookupError, AttributeError):
        return None
    return work.answers if list(work.answers) == list(solution.answers) else None


def steps_of(solution: Solution) -> list[Step]:
    """The steps of the right working that are taken one by one."""
    taken: list[Step] = []
    _answers(solution, lambda _, step: taken.append(step))
    return taken


def _same_form(wrong: Any, right: Any) -> bool:
    if is_matrix(right):
        return is_matrix(wrong) and (wrong.nrows(), wrong.ncols()) == (right.nrows(), right.ncols())
    if isinstance(right, Vector):
        return isinstance(wrong, Vector)
    return not isinstance(wrong, Vector) and not is_matrix(wrong)


def _rewritten_value(step: Step, rewrite: Rewrite, path: tuple[int, ...]) -> Any:
    """The value of a step whose written line has an error at this place; None where it has no such place."""
    for here, line in rewritten(step.put_in, rewrite):
        if here == path:
            try:
                wrong = _worth(line)
            except (TypeError, ZeroDivisionError, ValueError, NoSolution):
                return None
            return wrong if _same_form(wrong, step.value) else None
    return None


# Wrong answers --------------------------------------------------------------------------------------
def _typed(kind: Any, value: Any, rng: random.Random) -> str | None:
    """How somebody types an answer: as fractions, or now and then as decimals of four digits."""
    answer = answer_kind(kind)
    text = answer.write(value)
    if rng.random() < 0.3 and not isinstance(kind, Policy):
        cells = answer.cells(value)
        if all(not isinstance(each, tuple) and not parameters(each) for each in cells.values()):
            rounded = {name: fmpq(*_ratio(decimal(each, 4) or "0")) for name, each in cells.items()}
            return answer.write(answer.value(rounded))
    return text


def _ratio(text: str) -> tuple[int, int]:
    number = sympy.Rational(text)
    return int(number.p), int(number.q)


def differs(kind: Any, key: Any, other: Any) -> bool:
    """Whether an answer is wrong, and so that a marker can see it."""
    answer = answer_kind(kind)
    try:
        right, wrong = answer.cells(key), answer.cells(other)
        return any(
            apart(content, wrong[name]) if not isinstance(content, tuple) else not set(content) & set(wrong[name])
            for name, content in right.items()
        )
    except (NotReal, NoSolution, TypeError, AttributeError, LookupError, ValueError):
        return False


def numeric(solution: Solution, label: str) -> bool:
    """Whether a part is answered with numbers."""
    part = next(part for part in solution.problem.parts if part.label == label)
    return part.kind.name not in ("choice", "yes/no", "policy")


def _first_wrong(solution: Solution, answers: Mapping[str, Any], rng: random.Random) -> tuple[str, str] | None:
    """The first part that is answered wrongly in numbers, and the text that is typed for it."""
    for part in solution.problem.parts:
        if not numeric(solution, part.label):
            continue
        if differs(part.kind, solution.answers[part.label], answers[part.label]):
            try:
                text = _typed(part.kind, answers[part.label], rng)
            except (NotReal, TypeError, AttributeError):
                return None
            return (part.label, text) if text is not None and len(text) < 400 else None
    return None


def _candidates(solution: Solution, rng: random.Random) -> Iterator[Erroneous]:
    steps = steps_of(solution)
    if not steps:
        return
    kinds = list(WRITTEN)
    rng.shuffle(kinds)
    for kind in kinds:
        rewrite = WRITTEN[kind]
        order = list(range(len(steps)))
        rng.shuffle(order)
        for number in order[:4]:
            paths = [path for path, _ in rewritten(steps[number].put_in, rewrite)]
            if not paths:
                continue
            path = rng.choice(paths)
            formula = steps[number].formula
            wrong = _rewritten_value(steps[number], rewrite, path)
            if wrong is None:
                continue
            slip = _answers(solution, lambda at, _, n=number, w=wrong: w if at == n else None)
            yield from _made(solution, slip, rng, Erroneous(kind, "", "", formula.key, number))
            times = sum(step.formula is formula for step in steps)
            if kind in IDEAS and times > 1:
                idea = _answers(
                    solution,
                    lambda _, step, f=formula, r=rewrite, p=path: (
                        _rewritten_value(step, r, p) if step.formula is f else None
                    ),
                )
                yield from _made(solution, idea, rng, Erroneous(kind, "", "", formula.key, None, everywhere=True))
            break
    for kind, spoil in SPOILT.items():
        order = list(range(len(steps)))
        rng.shuffle(order)
        for number in order[:3]:
            value = steps[number].value
            wrong = _spoilt(value, spoil, rng)
            if wrong is None:
                continue
            slip = _answers(solution, lambda at, _, n=number, w=wrong: w if at == n else None)
            yield from _made(solution, slip, rng, Erroneous(kind, "", "", steps[number].formula.key, number))
            break
    yield from _kept(solution, steps, rng)
    yield from _twofold(solution, steps, rng)


def _spoilt(value: Any, spoil: Spoil, rng: random.Random) -> Any:
    if is_rational(value):
        return spoil(value, rng) if value else None
    if is_matrix(value) and all(map(is_rational, value.entries())):
        rows = value.tolist()
        row, column = rng.randrange(len(rows)), rng.randrange(len(rows[0]))
        wrong = spoil(rows[row][column], rng) if rows[row][column] else None
        if wrong is None:
            return None
        rows[row][column] = wrong
        return matrix(rows)
    return None


def _kept(solution: Solution, steps: Sequence[Step], rng: random.Random) -> Iterator[Erroneous]:
    """An update is left out: the old value stays; or it is made twice in a row."""
    updates = [number for number, step in enumerate(steps) if step.sign == "←" and is_rational(step.value)]
    rng.shuffle(updates)
    for number in updates[:1]:
        step = steps[number]
        old = _old(step)
        if old is None:
            continue
        slip = _answers(solution, lambda at, _, n=number, w=old: w if at == n else None)
        yield from _made(solution, slip, rng, Erroneous("update_left_out", "", "", step.formula.key, number))
        twice = step.value + (step.value - old)
        slip = _answers(solution, lambda at, _, n=number, w=twice: w if at == n else None)
        yield from _made(solution, slip, rng, Erroneous("change_doubled", "", "", step.formula.key, number))


def _old(step: Step) -> Any:
    """What stood at the place that a step updates, looked up as somebody would on paper."""
    table = step.known.get(getattr(step.formula.left, "code", ""), None)
    if not isinstance(table, dict):
        return None
    names = [str(argument) for argument in getattr(step.left, "args", ())]
    key = names[0] if len(names) == 1 else tuple(names)
    return table.get(key)


def _twofold(solution: Solution, steps: Sequence[Step], rng: random.Random) -> Iterator[Erroneous]:
    """Two slips in one working: a wrong line, and an arithmetic slip or another wrong line later."""
    if len(steps) < 2:
        return
    for _ in range(4):
        first, second = sorted(rng.sample(range(len(steps)), 2))
        kind = rng.choice(("term_lost", "factor_lost", "sign_turned", "minus_lost"))
        paths = [path for path, _ in rewritten(steps[first].put_in, WRITTEN[kind])]
        other = rng.choice(("sign_turned", "factor_lost", "value_sign"))
        if not paths:
            continue
        path = rng.choice(paths)
        chosen = rng.random()

        def err(at: int, step: Step) -> Any:
            if at == first:  # noqa: B023
                return _rewritten_value(step, WRITTEN[kind], path)  # noqa: B023
            if at != second:  # noqa: B023
                return None
            if other == "value_sign":  # noqa: B023
                return -step.value if is_rational(step.value) else None
            places = [path for path, _ in rewritten(step.put_in, WRITTEN[other])]  # noqa: B023
            return _rewritten_value(step, WRITTEN[other], places[int(chosen * len(places))]) if places else None  # noqa: B023

        answers = _answers(solution, err)
        made = Erroneous(f"{kind} + {other}", "", "", steps[first].formula.key, first, twofold=True)
        yield from _made(solution, answers, rng, made)
        return


def _made(
    solution: Solution, answers: Mapping[str, Any] | None, rng: random.Random, error: Erroneous
) -> Iterator[Erroneous]:
    if answers is not None and (wrong := _first_wrong(solution, answers, rng)):
        yield replace(error, part=wrong[0], text=wrong[1])


def _of_answers(solution: Solution, rng: random.Random) -> Iterator[Erroneous]:
    """What goes wrong between the working and the sheet."""
    for part in solution.problem.parts:
        if not numeric(solution, part.label):
            continue
        answer = answer_kind(part.kind)
        key = solution.answers[part.label]
        cells = answer.cells(key)
        names = list(cells)
        others: list[tuple[str, dict[str, Any]]] = []
        if len(names) > 1:
            one, two = rng.sample(names, 2)
            others.append(("entries_exchanged", cells | {one: cells[two], two: cells[one]}))
            spot = rng.choice(names)
            others.append(("one_sign_lost", cells | {spot: -cells[spot]}))
        others.append(("answer_sign", {name: -value for name, value in cells.items()}))
        if len(names) == 1 and is_rational(cells[names[0]]) and cells[names[0]] not in (0, 1, -1):
            others.append(("answer_upside_down", {names[0]: 1 / cells[names[0]]}))
            steps = [
                step.value
                for step in steps_of(solution)
                if is_rational(step.value) and step.value not in (cells[names[0]], 0)
            ]
            if steps:
                others.append(("another_quantity", {names[0]: rng.choice(steps)}))
        if part.kind.name == "matrix" and part.kind.rows == part.kind.columns > 1:
            rows = [list(line) for line in (key.tolist() if is_matrix(key) else key)]
            others.append(("answer_transposed", answer.cells(matrix(zip(*rows, strict=True)))))
        for kind, wrong in others:
            value = answer.value(wrong)
            if differs(part.kind, key, value):
                text = _typed(part.kind, value, rng)
                if text is not None and len(text) < 400:
                    yield Erroneous(kind, part.label, text)
        return


def erroneous(solution: Solution, seed: int = 0) -> list[Erroneous]:
    """Wrong answers to a problem: each kind of error that has a place in it, once."""
    rng = random.Random(seed)
    return [*_candidates(solution, rng), *_of_answers(solution, rng)]


def random_wrong(solution: Solution, label: str, seed: int, *, alone: bool = False) -> str | None:
    """A wrong answer of the right size and form that comes from nothing.

    Every number is replaced by another one; or one alone, among several.
    """
    rng = random.Random(seed)
    part = next(part for part in solution.problem.parts if part.label == label)
    answer = answer_kind(part.kind)
    cells = answer.cells(solution.answers[label])
    if not all(is_rational(value) for value in cells.values()):
        return None
    size = max(abs(float(int(v.p)) / float(int(v.q))) for v in cells.values()) or 1.0
    if alone and len(cells) == 1:
        return None
    wrong = dict(cells)
    for name in [rng.choice(list(cells))] if alone else cells:
        value = cells[name]
        about = abs(float(int(value.p)) / float(int(value.q))) or size
        number = rng.uniform(0.2, 2.5) * about * rng.choice((1, 1, 1, -1))
        if value.q == 1 and about >= 5:
            wrong[name] = fmpq(round(number))
        elif value.q < 60:
            q = int(value.q) if value.q > 1 else rng.choice((2, 4, 5, 10))
            wrong[name] = fmpq(round(number * q), q)
        else:
            wrong[name] = fmpq(*_ratio(f"{number:.4g}"))
    value = answer.value(wrong)
    return answer.write(value) if differs(part.kind, solution.answers[label], value) else None
