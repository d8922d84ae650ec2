"""What an answer comes from: the causes that give it, weighed against each other and against chance."""

from collections.abc import Iterable, Mapping, Sequence
from functools import cache, partial
from itertools import permutations
from typing import Any

from msgspec import Struct
from msgspec.structs import replace
from sympy import Expr, preorder_traversal

from rldrill.solutions.diagnosis import weights
from rldrill.solutions.diagnosis.causes import Cause
from rldrill.solutions.diagnosis.clock import Clock
from rldrill.solutions.diagnosis.outcomes import Outcome, Outcomes
from rldrill.solutions.diagnosis.replay import Change, Traced
from rldrill.solutions.diagnosis.search import Search
from rldrill.solutions.diagnosis.typed import Typed, equal
from rldrill.solutions.diagnosis.weighing import Weighing, room
from rldrill.solutions.diagnosis.weights import ALIKE, LEFT_OUT, SLIPS
from rldrill.solutions.formula.notation import Quantity

#: All causes together are so likely, the rest is chance; and so likely are those that are told. Then about one number
#: from nowhere in twenty is accused of something.
ENOUGH, TOLD = 0.57, 0.4
#: So likely it must be where the likeliest is that a factor was left out, or where the answers to the parts before were
#: right and nothing is here, which leaves fewer causes.
ENOUGH_IF_PLAIN = 0.52
#: So likely it must be where hardly anything else gives the answer, of which nothing is right, and it is no slip of
#: arithmetic: a line of a table that has but two, or something plain. Nearly all is so much of what gives it.
ENOUGH_OF_A_LINE, ENOUGH_ALONE, NEARLY_ALL = 0.1, 0.3, 0.8
PLAIN = frozenset(("factor-left-out", "earlier-time", "other-side"))
#: What is said rather than what comes to the same: V is kept, not its change missing; P is missing, not a bracket off.
PLAINEST = frozenset(("kept", "factor-left-out"))
#: So likely two causes together must be: one that nobody thought of often gives what two others give by chance.
ENOUGH_FOR_TWO = 0.9
#: So likely edits must be that a right answer to a part before denies: who made them did not go on from it.
ENOUGH_ANEW = 0.9
#: So sure it is that somebody did what gives the wrong answers to the parts before as well.
MADE_BEFORE = 0.95
#: Where the time did not suffice, something likelier may have been missed: what weighs less is not spoken of.
SURE_ENOUGH = 4.0
#: A cause so much less likely than the likeliest is not spoken of; nor are more causes than this.
NEAR, MOST = 0.15, 2
#: From this share of the likeliest on another cause is about as likely.
AS_LIKELY = 0.6
#: As many answers there must be that could have been typed, before two causes together are believed.
ROOM_FOR_TWO = 20_000
#: Of so few answers one proves nothing: yes or no, a choice, an action or two.
_FEW = 4
#: Who reads the other one of two lines has no third one to read.
_TWO_LINES = 2


class Explained(Struct, frozen=True):
    """The causes that an answer is put down to, the likeliest first, and how likely each of them is, 0 to 1.

    ``made_before``: they give the wrong answers to the parts before, too.
    """

    causes: tuple[Cause, ...] = ()
    shares: tuple[float, ...] = ()
    made_before: bool = False

    @property
    def confidence(self) -> float:
        """How sure it is one of them."""
        return sum(self.shares)


def explained(
    outcomes: Outcomes,
    typed: Typed,
    clock: Clock,
    settled: Mapping[str, Any] | None = None,
    wrong: Mapping[str, Any] | None = None,
) -> Explained:
    """What a wrong answer comes from; nothing, where that could be anything, or answers that are settled deny it.

    A cause that gives the ``wrong`` answers to the parts before, too, is hardly chance.
    """
    found, finished = giving(outcomes, typed, clock, settled or {}, wrong)
    if not found:
        return Explained()
    again = [each for each in found if outcomes.gives_before(each, wrong)] if wrong else []
    found = again or [_doubted(outcomes, each, wrong) for each in found]
    causes = [each.cause for each in found]
    shares = Weighing(outcomes, typed, found).shares()
    if again:
        shares = [MADE_BEFORE * share / sum(shares) for share in shares]
    groups = distinct(causes, outcomes.search)
    first, *_ = told = likeliest(shares, _led(groups, causes, shares))
    if not _are_enough(causes, shares, told, typed, settled) or (
        not finished and not again and causes[first[1]].weight < SURE_ENOUGH
    ):
        return Explained()
    beside = _beside_others(groups, causes, shares)
    told = likeliest(beside, _led(groups, causes, beside), next(group for group in groups if first[1] in group))
    told.sort(key=lambda each: -_said_so(each[1], groups, causes, beside))
    return Explained(
        tuple(causes[number] for _, number in told), tuple(share for share, _ in told), made_before=bool(again)
    )


def _are_enough(
    causes: Sequence[Cause],
    shares: Sequence[float],
    told: Sequence[tuple[float, int]],
    typed: Typed,
    settled: Mapping[str, Any] | None,
) -> bool:
    """Whether all causes together are likely enough to be told, the likeliest first, and those that are told."""
    whole, (share, first) = sum(shares), told[0]
    line = _is_only_other_line(causes[first])
    all_wrong = len(typed.wrong) == len(typed.key)
    if all(cause.then is not None for cause in causes):
        enough = ENOUGH_FOR_TWO
    elif all(cause.anew and cause.mistake is None for cause in causes):
        enough = ENOUGH_ANEW
    elif all_wrong and (line or causes[first].kind in PLAIN) and share >= NEARLY_ALL * whole:
        return whole >= (ENOUGH_OF_A_LINE if line else ENOUGH_ALONE)
    else:
        plain = (settled and all_wrong) or causes[first].kind == "factor-left-out"
        enough = ENOUGH_IF_PLAIN if plain else ENOUGH
    return whole >= enough and sum(share for share, _ in told) >= TOLD


def _said_so(first: int, groups: Sequence[Sequence[int]], causes: Sequence[Cause], shares: Sequence[float]) -> float:
    """How likely it is that just this was done to this, of all that says the same as the first cause of a group.

    Of a slip of arithmetic nobody can say why: what is about as likely is told before it.
    """
    (group,) = (group for group in groups if first in group)
    cause = causes[first]
    if cause.mistake is not None:
        return sum(shares[one] for one in group)
    alike = sum(shares[one] for one in group if (causes[one].kind, causes[one].part) == (cause.kind, cause.part))
    return AS_LIKELY * alike if cause.kind in SLIPS else alike


def _is_only_other_line(cause: Cause) -> bool:
    """Whether it is the only other line of a table that was read for one."""
    if cause.kind != "another-line" or cause.application is None or not isinstance(cause.part, Quantity):
        return False
    table = cause.application.known.get(cause.part.code)
    return isinstance(table, Mapping) and len(table) == _TWO_LINES


def _led(groups: Sequence[Sequence[int]], causes: Sequence[Cause], shares: Sequence[float]) -> list[list[int]]:
    """The groups of causes that say the same, in each the one first that stands for it."""
    return [sorted(group, key=partial(_standing, _foremost(group, causes, shares), causes, shares)) for group in groups]


def _foremost(group: Sequence[int], causes: Sequence[Cause], shares: Sequence[float]) -> tuple[str, Expr | None]:
    """What was done to what by the likeliest cause of a group; or by one about as likely that is plainer."""
    most = max(shares[one] for one in group)
    likely = [one for one in group if shares[one] >= AS_LIKELY * most]
    first = causes[max(likely, key=lambda one: (causes[one].kind in PLAINEST, shares[one]))]
    return first.kind, first.part


def _standing(
    foremost: tuple[str, Expr | None], causes: Sequence[Cause], shares: Sequence[float], number: int
) -> tuple[int, float]:
    """Which of those that say the same stands for them: a mistake that is stated, and rather one made all along."""
    cause = causes[number]
    if cause.mistake is not None:
        return int(cause.application is not None), -shares[number]
    return 2 if (cause.kind, cause.part) == foremost else 3, -shares[number]


def _doubted(outcomes: Outcomes, outcome: Outcome, wrong: Mapping[str, Any] | None) -> Outcome:
    """An outcome, less likely where somebody who goes on from own wrong answers to the parts before gets another."""
    if not wrong or outcomes.stands(outcome, wrong):
        return outcome
    return replace(outcome, cause=replace(outcome.cause, weight=outcome.cause.weight * weights.ANEW))


def _beside_others(groups: Sequence[Sequence[int]], causes: Sequence[Cause], shares: Sequence[float]) -> list[float]:
    """The shares of one whole, in which a line of a table that was read for another counts more beside other causes.

    Of each such line alone little can be said, for there are many of them; but all together they are a common mistake.
    """
    lines = [next((one for one in group if _is_another_line(causes[one])), None) for group in groups]
    read = [share * (weights.BESIDE_OTHERS if one in lines else 1.0) for one, share in enumerate(shares)]
    return [share * sum(shares) / sum(read) for share in read]


def _is_another_line(cause: Cause) -> bool:
    return cause.kind == "another-line" and bool(cause.term)


def likeliest(
    shares: Sequence[float], groups: Sequence[Sequence[int]], kept: Sequence[int] = ()
) -> list[tuple[float, int]]:
    """What is told, the likeliest first: how likely it is, and the cause that stands for its group, the first of it.

    The group of causes that are ``kept`` is told, however many others there are.
    """
    found = [(sum(shares[one] for one in group), group[0]) for group in groups]
    found.sort(key=lambda each: -each[0])
    told = [each for each in found[:MOST] if each[0] >= NEAR * found[0][0]]
    if (own := next((each for each in found if each[1] in kept), None)) and own not in told:
        told = [*told[: MOST - 1], own]
    return told


def _overlap(one: Expr, other: Expr) -> bool:
    """Whether one part of a formula is in the other."""
    return one in preorder_traversal(other) or other in preorder_traversal(one)


def giving(
    outcomes: Outcomes,
    typed: Typed,
    clock: Clock,
    settled: Mapping[str, Any],
    wrong: Mapping[str, Any] | None = None,
) -> tuple[list[Outcome], bool]:
    """The causes that give what was typed, and whether all were looked at.

    Where so few answers are possible that one proves nothing, those alone that give wrong answers before, too.
    """
    many = room(typed, exact=True)
    if many < _FEW and not wrong:
        return [], True

    denied: list[Outcome] = []

    def standing(found: Iterable[Outcome]) -> list[Outcome]:
        stand: list[Outcome] = []
        for each in found:
            (stand if outcomes.stands(each, settled) else denied).append(each)
        return [outcomes.made_here(each, settled) for each in stand]

    finished = outcomes.grow(clock)
    found = standing(outcomes.giving(typed))
    if many < _FEW:
        return [each for each in found if outcomes.gives_before(each, wrong or {})], finished
    found += _anew(outcomes, denied, found, settled)
    if not found and many >= ROOM_FOR_TWO and finished:
        found = standing(outcomes.giving_apart(typed))
        if not found:
            finished = outcomes.grow_pairs(clock)
            found = standing(outcomes.giving_in_turn(typed))
    return sorted(found, key=lambda each: -each.cause.weight), finished


def _anew(
    outcomes: Outcomes, denied: Sequence[Outcome], standing: Sequence[Outcome], settled: Mapping[str, Any]
) -> list[Outcome]:
    """What somebody does who goes on from no right answer before.

    Where something is found that denies none, that is a stated mistake alone, and one likelier than all of these.
    """
    highest = max((each.cause.weight for each in standing), default=0.0)
    found = [anew for each in denied if (anew := outcomes.anew(each, settled)) is not None]
    return [each for each in found if not standing or (each.cause.mistake and each.cause.weight > highest)]


def distinct(causes: Sequence[Cause], search: Search | None = None) -> list[list[int]]:
    """The numbers of the causes, those together that say the same; a search tells which values follow from others."""
    groups: list[list[int]] = []
    for number, cause in enumerate(causes):
        for group in groups:
            stated = [one for one in group[1:] if causes[one].mistake is not None]
            if any(_alike(cause, causes[one]) for one in ((group[0], *stated) if cause.mistake is None else group)):
                group.append(number)
                break
        else:
            groups.append([number])
    return groups if search is None else _carried_on(groups, causes, search)


def _carried_on(groups: list[list[int]], causes: Sequence[Cause], search: Search) -> list[list[int]]:
    """The groups, those together in which one turned sign follows from another: −2 for 2 from −1 for 1."""
    for early, late in permutations(groups, 2):
        one, two = (next((causes[one] for one in group if _is_turned(causes[one])), None) for group in (early, late))
        if one is not None and two is not None and _follows(one, two, search):
            early += late
            late.clear()
    return [group for group in groups if group]


def _is_turned(cause: Cause) -> bool:
    """Whether it is the sign of the value of one step, however that was come by."""
    return cause.kind == "sign" and cause.application is not None and cause.part is None and not cause.on_paper


def _follows(early: Cause, late: Cause, search: Search) -> bool:
    """Whether the wrong value of one step comes out where another one has a wrong value."""
    assert early.application is not None
    assert late.application is not None
    if early.application.number >= late.application.number:
        return False
    trace: list[Traced] = []
    search.replay(Change(values={early.application.number: early.became}), trace)
    return any(number == late.application.number and equal(value, late.became) for number, _, _, value in trace)


def _alike(one: Cause, two: Cause) -> bool:
    if _is_put_in(one, two) or _is_put_in(two, one):
        return True
    if not _at_the_same_place(one, two):
        return False
    if one.mistake and two.mistake:
        return one.mistake.says == two.mistake.says
    if one.mistake or two.mistake:
        return _is_stated(one, two) or _is_stated(two, one)
    here, there = one.part, two.part
    near = here is None or there is None or _overlap(here, there)
    for zero, other in ((one, two), (two, one)):
        if zero.kind in ("elsewhere", "another-line") and zero.other == 0 and other.kind.endswith("left-out"):
            return near
        if zero.probe is not None and zero.other == 1 and other.kind.endswith("factor-left-out"):
            return other.edit is not None and zero.probe.part == other.edit.part
    if one.probe is not None and two.probe is not None and one.application is two.application:
        return near  # −5 is put in for V(s′), or for γV(s′)
    if {one.kind, two.kind} <= SLIPS and one.probe is None and two.probe is None:
        return True
    for edit, other in ((one, two), (two, one)):  # P is missing in a part of P(r + γV)
        if edit.kind == "bracket" and other.kind == "factor-left-out":
            return edit.edit is not None and other.part in edit.edit.part.args
    if one.kind == two.kind or any({one.kind, two.kind} <= group for group in ALIKE):
        return near
    return {one.kind, two.kind} <= LEFT_OUT and (here is None or there is None or here == there)


def _is_put_in(slip: Cause, other: Cause) -> bool:
    """Whether the wrong value of a step is what is put in for it in a later one."""
    if slip.application is None or slip.part is not None or slip.mistake or other.probe is None:
        return False
    return str(slip.was) == str(other.was) and str(slip.became) == str(other.other)


def _at_the_same_place(one: Cause, two: Cause) -> bool:
    """Whether both may be the same application; all those of one quantity, where it was done every time.

    The equations of one state are one place, whatever they are solved for: the first or the second feature.
    """
    here, there = one.application, two.application
    if here is there or here is None or there is None:
        return True
    any_of_them = one.always or two.always or (here.equation and there.equation)
    return any_of_them and here.right == there.right and here.names == there.names


def _is_stated(mistake: Cause, edit: Cause) -> bool:
    """Whether a mistake is stated beside the formula that was edited, and reads it as the edit does."""
    if mistake.mistake is None or edit.edit is None or edit.formula is None or edit.term or edit.nth is not None:
        return False
    stated = edit.formula.misread.get(mistake.mistake)
    return stated is not None and _collected(stated) == _collected(edit.edit.right)


@cache
def _collected(expression: Expr) -> Expr:
    """An expression in the order and with the signs that sympy gives it, whatever it was written like."""
    if not expression.args:
        return expression
    collected: Expr = expression.func(*map(_collected, expression.args))
    return collected
