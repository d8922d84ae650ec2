"""What is said of a cause: one sentence, as a good lecturer puts it."""

from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

from flint import fmpq
from msgspec.structs import replace
from sympy import Expr, Mul, preorder_traversal

from rldrill.problems.mathematics import Math, mathematics, name, number, relation, row
from rldrill.solutions.diagnosis.alternatives import numbers, terms
from rldrill.solutions.diagnosis.arithmetic import MOST_DIGITS
from rldrill.solutions.diagnosis.causes import Cause
from rldrill.solutions.diagnosis.givens import ordinal
from rldrill.solutions.diagnosis.replay import Application
from rldrill.solutions.exact import decimal, is_rational
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.formula.edits import IN_ONE_TERM, Edit, flat
from rldrill.solutions.formula.letters import GLYPHS
from rldrill.solutions.formula.nodes.leaves import put_in_name
from rldrill.solutions.formula.nodes.sets import Over
from rldrill.solutions.formula.notation import Quantity
from rldrill.solutions.formula.putting_in import indexed
from rldrill.solutions.formula.typesetting import typeset, typeset_value
from rldrill.solutions.matrices import is_matrix
from rldrill.solutions.vector import Vector

#: A sentence, or a part of one: words, and mathematics between them.
Words: TypeAlias = tuple[str | Math, ...]

#: What an edit does, by its kind; {part} is what was changed, {instead} what stands there.
_EDITS = {
    "term-left-out": "{part} is missing",
    "factor-left-out": "{part} is missing",
    "only-factor-left-out": "the factor {part} is missing",
    "bracket-left-out": "the factor ({part}) is missing",
    "sign": "{part} has the wrong sign",
    "twice": "{part} is counted twice",
    "difference": "{part} is taken with the opposite sign",
    "bracket": "a bracket is set in the wrong place in {part}",
    "index": "{instead} stands where {part} belongs",
    "twin": "{instead} stands where {part} belongs",
    "range": "there is a term too many or too few in the sum",
    "factor-moved": "{instead} stands where {part} belongs",
    "other-table": "{instead} stands where {part} belongs",
    "complement": "{instead} stands where {part} belongs",
    "complement-of-value": "{instead} stands where {part} belongs",
    "confused": "{instead} stands where {part} belongs",
    "exchanged": "{part} and {instead} are exchanged",
    "arguments-exchanged": "{part} and {instead} are exchanged",
    "squared": "the factor {part} is there twice",
    "squared-value": "the factor {part} is there twice",
    "added": "the factors of {part} are added instead of multiplied",
    "divided": "it is divided by {part} instead of multiplied with it",
    "upside-down": "{part} is upside down",
    "order-of-factors": "the matrices of {part} stand in the wrong order",
    "inverse": "the inverse is forgotten in {part}",
    "root": "the root is forgotten in {part}",
    "power": "the power is off in {part}",
    "power-of-sum": "{instead} stands where {part} belongs",
    "power-of-terms": "{instead} stands where {part} belongs",
    "power-as-product": "{part} is taken for a product instead of a power",
    "transposed": "the transpose is forgotten in {part}",
    "case": "the wrong case is taken in {part}",
    "choice": "{instead} is taken without the choice",
    "function": "{instead} stands where {part} belongs",
    "summand-left-out": "a term of the sum is missing",
    "summand-sign": "a term of the sum has the wrong sign",
    "factor-for-one": "what stands before the sum is applied to one of its terms only",
    "factor-for-all": "the factor of one term of the sum multiplies all of it",
    "smallest": "the smallest is taken instead of the greatest",
    "other-taken": "the value of another action than the best is taken",
    "mean-for-max": "the mean is taken instead of the maximum",
    "min-for-max": "the minimum is taken instead of the maximum",
    "sum-for-max": "the sum is taken instead of the maximum",
    "mean-for-sum": "the mean is taken instead of the sum {part}",
    "max-for-sum": "the maximum is taken instead of the sum {part}",
    "min-for-sum": "the minimum is taken instead of the sum {part}",
    "sum-for-mean": "the sum is taken instead of the mean",
    "max-for-mean": "the maximum is taken instead of the mean",
    "min-for-mean": "the minimum is taken instead of the mean",
    "sum-for-product": "the sum is taken instead of the product",
    "mean-for-product": "the mean is taken instead of the product",
    "max-for-product": "the maximum is taken instead of the product",
    "min-for-product": "the minimum is taken instead of the product",
}
#: What is done to a factor, which a formula may hold twice: then it is told in which product.
_OF_FACTORS = frozenset(("factor-left-out", "squared", "squared-value", "complement", "complement-of-value", "divided"))
#: What happened to the value of a place in a formula; {was} was right, {became} was taken.
_INSIDE = {
    "minus-lost": "the minus of {part} = {was} is lost",
    "sign": "{part} = {was} has the wrong sign",
    "tenfold": "the decimal point of {part} = {was} has slipped: {became}",
    "elsewhere": "{became} is put in for {part}, which is {was}",
    "stale": "{part} is put in as it was at the start, {became} for {was}",
    "as-given": "you gave {part}, as it was before, not what comes of it",
    "another-line": "{line} = {became} is put in for {part} = {was}",
    "digits": "the digits of {part} = {was} are exchanged: {became}",
    "inverse": "{part} = {was} is upside down",
    "complement": "{became}, 1 minus it, is put in for {part}, which is {was}",
    "crosswise": "the fractions of {part} are added top to top and bottom to bottom",
    "inverse-signs": "the signs beside the diagonal are not turned in the inverse of {part}",
    "inverse-diagonal": "the numbers on the diagonal are not exchanged in the inverse of {part}",
    "inverse-undivided": "the inverse of {part} is not divided by the determinant",
    "": "{became} is put in for {part}, which is {was}",
}
#: What happened to the value that a step gives.
_VALUES = {
    "kept": "the old value {became} is kept",
    "repeated": "the update is made twice",
    "stale": "a value that has been updated since is put in as it was at the start",
    "sign": "the result has the wrong sign: {became} for {was}",
    "tenfold": "the decimal point of the result has slipped: {became} for {was}",
    "digits": "two digits of the result are exchanged: {became} for {was}",
    "inverse": "the result is upside down: {became} for {was}",
    "": "there is a slip of arithmetic: {became} for {was}",
}
#: What happened all along, or to the answer.
_WHOLE = {
    "stale": "the old values are used all along, though some of them have been updated",
    "stale…": "every step goes on from what there was at the start, not from what the step before gave",
    "early": "new values are used at once, though they should wait for the next round",
    "round-left-out": "the {what} round of updates is left out",
    "one-too-many": "{what} is taken one too large",
    "one-too-few": "{what} is taken one too small",
    "counted-again": "the {what} is counted twice",
    "givens-exchanged": "two givens are exchanged: {what}",
    "rows-exchanged": "two entries are exchanged: {what}",
    "lines-exchanged": "two entries are exchanged: {what}",
    "another-row": "{what}",
    "another-cell": "{what}",
    "led-elsewhere": "{what}",
    "rows-and-columns": "rows and columns are exchanged in {what}",
    "end-unpaid": "the rewards for reaching a terminal state are left out, whose value alone is 0",
    "as-above": "the {what} {is} taken over from the one before",
    "minus-lost": "a minus is lost in reading {what}",
    "complement": "{what} is taken for 1 minus itself",
    "reversed": "the {what} are taken in the opposite order",
    "entry-left-out": "the {what} is left out",
    "entries-exchanged": "the order is wrong in {what}",
    "number-moved": "a number has changed sides of the equation and kept its sign",
    "unknown-moved": "the unknown has changed sides of the equation and kept its sign",
    "multiplied": "it is multiplied by the number before the unknown instead of divided by it",
    "unsolved": "the equations are gone through {what}, from 0 on, instead of solved",
    "another-quantity": "you gave {left}, which is not what is asked for",
    "another-quantity…": "you gave {left}, …, which are not what is asked for",
    "another-part": "you gave the answer to {what}",
    "exchanged-cells": "the answers for {what} are exchanged",
    "all-signs": "all signs are turned",
    "sign": "the sign is wrong",
    "answer-reversed": "the answers are given in the opposite order",
    "answer-rearranged": "these are the right numbers, in the wrong order",
    "answer-transposed": "rows and columns are exchanged",
    "answer-scaled": "all entries are wrong by the same factor, {was}",
    "one-minus": "you gave 1 minus the answer",
    "inverse": "the answer is upside down",
    "percent": "the answer is given in percent",
    "standard-deviation": "you gave the standard deviation, the root of the variance",
    "tenfold": "the decimal point has slipped",
    "digits": "two digits are exchanged",
    "": "there is a slip of arithmetic in the last step",
}

#: What is counted, by the name of its number.
_COUNTED = {
    "after": "step",
    "branches": "branch",
    "heads": "head",
    "horizon": "step",
    "rounds": "round",
    "steps": "step",
    "sweeps": "sweep",
    "tails": "tail",
}
_ONE_OFF = {"one-too-many": "too many", "one-too-few": "too few"}


def saying(cause: Cause, applications: Sequence[Application]) -> Words:
    """What was done, and where, without a full stop."""
    if cause.kind == "other-side":
        return _of_two_sides(cause, applications)
    words = (*_what(cause), *_where(cause, applications))
    if cause.then is not None:
        words = (*words, ", and ", *saying(cause.then, applications))
    return words


def _what(cause: Cause) -> Words:
    if cause.edit is not None:
        template = _EDITS[cause.kind]
        if cause.kind == "factor-left-out" and not cause.edit.part.is_Symbol:
            template = "the factor {part} is missing"
        if cause.kind == "inverse" and cause.edit.part.is_commutative is not False:
            template = "it is multiplied with {instead} instead of divided by it"
        instead = None if cause.edit.instead is None else typeset(cause.edit.instead)
        words = _filled(template, part=_short(cause.edit.part) if "{part}" in template else None, instead=instead)
        return (*words, *_in_which_product(cause))
    if cause.probe is not None:
        template = _INSIDE.get(cause.kind, _INSIDE[""])
        cause = _upright(cause) if template == _INSIDE[""] else cause
        part = typeset(named) if (named := _in_its_term(cause)) is not None else _part(cause)
        write = _written(cause.kind, cause.was, cause.other)
        was = write(cause.was) if "{was}" in template else None
        became = write(cause.other) if "{became}" in template else None
        line = typeset(_line(cause)) if "{line}" in template else None
        return _filled(template, line=line, part=part, was=was, became=became)
    if cause.application is not None and cause.kind != "another-quantity":
        template = _VALUES.get(cause.kind, _VALUES[""])
        was, became = _changed(cause.was, cause.became)
        write = _written(cause.kind, was, became)
        return _filled(template, was=write(was), became=write(became))
    if cause.application is not None:
        return _filled(_WHOLE[cause.kind + cause.what], left=typeset(cause.application.step.left))
    if cause.kind == "earlier-time":
        return (
            "you gave what there is at ",
            row(GLYPHS_T, relation("="), name(str(cause.time))),
            ", one time too early",
        )
    first, _, rest = cause.what.partition(" ")
    if cause.kind in _ONE_OFF and first in _COUNTED:
        return (f"there is one {_COUNTED[first]} {_ONE_OFF[cause.kind]}{rest and ' in'}{rest.removeprefix('of')}",)
    template = _WHOLE.get(cause.kind + cause.what) or _WHOLE.get(cause.kind, _WHOLE[""])
    was = None if cause.was is None else _number(cause.was)
    verb = "are" if first.endswith("s") else "is"
    words = _filled(template, what=cause.what.replace("_", " "), was=was, **{"is": verb})
    return (*words, f" at {cause.what}") if cause.on_paper and cause.what and "{what}" not in template else words


def _of_two_sides(cause: Cause, applications: Sequence[Application]) -> Words:
    """11 fits the one of two quantities that were found, but not the other."""
    own = cause.application
    assert own is not None
    other = next(each for each in applications if each.step.left == own.step.left and each.known != own.known)
    codes = {each.formula.left.code for each in applications if isinstance(each.formula.left, Quantity)}
    part = next(part for part in own.right.atoms(Quantity) if part.code in codes)
    fits, fails = (
        row(typeset(indexed(part, each.known)), relation("="), _number(value_of(part, each.known)))
        for each in (own, other)
    )
    return ("you took ", _number(cause.became), ", which fits ", fits, ", but not ", fails)


def _part(cause: Cause) -> Math:
    assert cause.probe is not None
    return _short(cause.probe.part)


def _upright(cause: Cause) -> Cause:
    """A number that was put in for what stands below a line, not one over it for one over what stands there."""
    assert cause.probe is not None
    part = cause.probe.part
    below = part.is_Pow and part.exp == -1
    if not below or not all(isinstance(each, fmpq) and each != 0 for each in (cause.was, cause.other)):
        return cause
    return replace(cause, probe=replace(cause.probe, part=part.base), was=1 / cause.was, other=1 / cause.other)


def _in_which_product(cause: Cause) -> Words:
    """Where a factor stands that the formula holds more than once: the product from there on."""
    formula = cause.formula if cause.application is None else cause.application
    if cause.kind not in _OF_FACTORS or cause.edit is None or formula is None:
        return ()
    right = flat(formula.right)
    if sum(part == cause.edit.part for part in preorder_traversal(right)) < 2:
        return ()
    product = _edited(right, cause.edit)
    if not product.is_Mul or cause.edit.part not in product.args:
        return ()
    place = min(product.args.index(cause.edit.part), len(product.args) - 2)
    return (" in ", typeset(Mul(*product.args[place:], evaluate=False)))


def _edited(right: Expr, edit: Edit) -> Expr:
    """The smallest part of a right side that holds all that was changed in it."""
    one, other = right, edit.right
    while one.func is other.func and len(one.args) == len(other.args):
        differing = [pair for pair in zip(one.args, other.args, strict=True) if pair[0] != pair[1]]
        if len(differing) != 1:
            break
        inside, instead = differing[0]
        if inside == edit.part:
            break
        one, other = inside, instead
    return one


def _filled(template: str, **values: Any) -> Words:
    words: list[str | Math] = []
    for piece in template.replace("}", "{").split("{"):
        words.append(values[piece] if piece in values and values[piece] is not None else piece)
    return tuple(word for word in words if word != "")


def _short(part: Expr) -> Math:
    return typeset(part.args[0]) if isinstance(part, Over) and part.body.is_Add else typeset(part)


def _changed(was: Any, became: Any) -> tuple[Any, Any]:
    """The entry that was changed, where it is one of several."""
    one, two = numbers(was), numbers(became)
    if one is None or two is None or len(one) != len(two):
        return was, became
    changed = [pair for pair in zip(one, two, strict=True) if str(pair[0]) != str(pair[1])]
    return changed[0] if len(changed) == 1 else (was, became)


def _written(kind: str, was: Any, became: Any) -> Callable[[Any], Any]:
    """How two numbers are written: as decimals, where it is their digits that are exchanged."""
    if kind != "digits" or not is_rational(was) or not is_rational(became):
        return _number
    exchanged = sorted(_decimal(was)) == sorted(_decimal(became))
    return (lambda value: number(_decimal(value))) if exchanged else _number


def _decimal(value: fmpq) -> str:
    return str(decimal(value, MOST_DIGITS))


def _number(value: Any) -> Any:
    from rldrill.solutions.work import shown_value

    if isinstance(value, tuple) or is_matrix(value) or isinstance(value, Vector):
        return shown_value(value)
    return typeset_value(value)


def _where(cause: Cause, applications: Sequence[Application]) -> Words:
    if cause.kind in ("another-quantity", "as-given") or (cause.application is None and cause.formula is None):
        return ()
    term = _term(cause)
    if cause.application is None:
        assert cause.formula is not None
        if cause.here:
            return (*term, f" in ({cause.here})")
        updates = cause.formula.sign == "←"
        return (*term, " in every update" if updates else " every time")
    if cause.time is not None:
        steps = "update" if cause.application.formula.sign == "←" else "step"
        return (*term, f" in every {steps} at ", row(GLYPHS_T, relation("="), name(str(cause.time))))
    if cause.always:
        return (*term, " every time in ", typeset(indexed(cause.application.formula.left, cause.application.known)))
    return (*term, *place(cause.application, applications))


def place(application: Application, applications: Sequence[Application]) -> Words:
    """Where an application stands in the working: `` in the second update (t = 1)``."""
    alike = [each for each in applications if each.formula is application.formula]
    left = typeset(application.step.left)
    update = application.formula.sign == "←"
    if application.equation:
        return (" in the equation of ", left)
    if len(alike) == 1:
        return (" in the update",) if update else (" in ", left)
    time = application.known.get("t")
    times = [each.known.get("t") for each in alike]
    at: Words = ()
    if isinstance(time, int):
        at = (row(GLYPHS_T, relation("="), name(str(time))),)
    if update and (not at or len(set(times)) == len(times)):
        where: Words = (f" in the {ordinal(alike.index(application))} update",)
        return (*where, " (", *at, ")") if at else where
    lefts = [str(each.step.left) for each in alike]
    if lefts.count(str(application.step.left)) == 1:
        return (" in ", left)
    if label := application.step.label:
        return (" in ", left, " (", mathematics(label), ")")
    if at:
        return (" in ", left, " at ", *at)
    nth = [each for each in alike if str(each.step.left) == str(application.step.left)].index(application)
    return (f" in the {ordinal(nth)} step for ", left)


GLYPHS_T = next((glyph for symbol, glyph in GLYPHS.items() if symbol.name == "t"), name("t"))


def _in_its_term(cause: Cause) -> Expr | None:
    """What was put in for, by the name it has in one term of a sum: V(warm) for V(s′); None if that is the same."""
    if cause.probe is None or not cause.term:
        return None
    own = {over.index.name: item for over, item in zip(cause.probe.within, cause.term, strict=True)}
    known = {} if cause.application is None else cause.application.known
    named = indexed(cause.probe.part, {**known, **own})
    return None if named == cause.probe.part else named


def _line(cause: Cause) -> Expr:
    """The quantity of the line that was read instead of the right one."""
    assert cause.application is not None
    assert cause.probe is not None
    part = cause.probe.part
    assert isinstance(part, Quantity)
    key = next(key for key, value in cause.application.known[part.code].items() if str(value) == str(cause.other))
    return part.func(*map(put_in_name, key if isinstance(key, tuple) else (key,)))


def _term(cause: Cause) -> Words:
    within = cause.edit.within if cause.edit is not None else cause.probe.within if cause.probe is not None else ()
    own = cause.kind in IN_ONE_TERM
    if not cause.term and cause.nth is not None:
        nth = ordinal(cause.nth)
        return (f" (the {nth} one)" if own else f" in the {nth} term of the sum",)
    if not cause.term or _in_its_term(cause) is not None:
        return ()
    every = [] if cause.application is None else [term for term, _ in terms(within, cause.application.known)]
    if any(str(item) == over.index.name for term in every for over, item in zip(within, term, strict=True)):
        nth = ordinal(every.index(cause.term))  # a = a and a = b say nothing
        return (f" (the {nth} one)" if own else f" in the {nth} term of the sum",)
    pairs = [
        row(typeset(over.index), relation("="), name(str(item))) for over, item in zip(within, cause.term, strict=True)
    ]
    words: list[str | Math] = [" (that of " if own else " in the term of "]
    for pair in pairs:
        words += [", ", pair] if len(words) > 1 else [pair]
    return (*words, ")") if own else tuple(words)
