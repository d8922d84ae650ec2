"""What an answer comes from: the causes that give it, weighed against each other and against chance."""

from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from typing import Any

from msgspec import Struct
from msgspec.structs import replace
from sympy import Expr, preorder_traversal

from rldrill.solutions.diagnosis import weights
from rldrill.solutions.diagnosis.causes import Cause
from rldrill.solutions.diagnosis.clock import Clock
from rldrill.solutions.diagnosis.outcomes import Outcome, Outcomes
from rldrill.solutions.diagnosis.typed import Typed
from rldrill.solutions.diagnosis.weighing import Weighing, room
from rldrill.solutions.diagnosis.weights import ALIKE, SLIPS

#: All causes together are so likely, the rest is chance; and so likely are those that are told. Then about one number
#: from nowhere in twenty is accused of something.
ENOUGH, TOLD = 0.57, 0.4
#: So likely two causes together must be: one that nobody thought of often gives what two others give by chance.
ENOUGH_FOR_TWO = 0.9
#: So likely edits must be that a right answer to a part before denies: who made them did not go on from it.
ENOUGH_ANEW = 0.7
#: So sure it is that somebody did what gives the wrong answers to the parts before as well.
MADE_BEFORE = 0.95
#: Where the time did not suffice, something likelier may have been missed: what weighs less is not spoken of.
SURE_ENOUGH = 4.0
#: A cause so much less likely than the likeliest is not spoken of; nor are more causes than this.
NEAR, MOST = 0.15, 2
#: From this share of the likeliest on another cause is about as likely.
AS_LIKELY = 0.8
#: As many answers there must be that could have been typed, before two causes together are believed.
ROOM_FOR_TWO = 20_000
#: Of so few answers one proves nothing: yes or no, a choice, an action or two.
_FEW = 4


class Explained(Struct, frozen=True):
    """The causes that an answer is put down to, the likeliest first, and how likely each of them is, 0 to 1."""

    causes: tuple[Cause, ...] = ()
    shares: tuple[float, ...] = ()

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
    found, finished = giving(outcomes, typed, clock, settled or {})
    if not found:
        return Explained()
    again = [each for each in found if outcomes.gives_before(each, wrong)] if wrong else []
    found = again or [_doubted(outcomes, each, wrong) for each in found]
    causes = [each.cause for each in found]
    shares = Weighing(outcomes, typed, found).shares()
    if again:
        shares = [MADE_BEFORE * share / sum(shares) for share in shares]
    told = likeliest(shares, _grouped(causes, shares))
    enough = sum(shares) >= _demanded(causes) and sum(share for share, _ in told) >= TOLD
    if not enough or (not finished and not again and causes[told[0][1]].weight < SURE_ENOUGH):
        return Explained()
    shares = _beside_others(causes, shares)
    groups = _grouped(causes, shares)
    told = _with_its_like(likeliest(shares, groups), groups, causes, shares)
    return Explained(tuple(causes[number] for _, number in told), tuple(share for share, _ in told))


def _demanded(causes: Sequence[Cause]) -> float:
    """How likely causes must be all together to be told."""
    if all(cause.then is not None for cause in causes):
        return ENOUGH_FOR_TWO
    return ENOUGH_ANEW if all(cause.anew and cause.mistake is None for cause in causes) else ENOUGH


def _grouped(causes: Sequence[Cause], shares: Sequence[float]) -> list[list[int]]:
    """The causes that say the same, of each group the one first that stands for it."""
    return [sorted(group, key=lambda one: (_standing(causes[one]), -shares[one])) for group in distinct(causes)]


def _doubted(outcomes: Outcomes, outcome: Outcome, wrong: Mapping[str, Any] | None) -> Outcome:
    """An outcome, less likely where somebody who goes on from own wrong answers to the parts before gets another."""
    if not wrong or outcomes.stands(outcome, wrong):
        return outcome
    return replace(outcome, cause=replace(outcome.cause, weight=outcome.cause.weight * weights.ANEW))


def _beside_others(causes: Sequence[Cause], shares: Sequence[float]) -> list[float]:
    """The shares of one whole, in which a line of a table that was read for another counts more beside other causes.

    Of each such line alone little can be said, for there are many of them; but all together they are a common mistake.
    """
    counts = [weights.BESIDE_OTHERS if _is_another_line(cause) else 1.0 for cause in causes]
    read = [share * count for share, count in zip(shares, counts, strict=True)]
    return [share * sum(shares) / sum(read) for share in read]


def _is_another_line(cause: Cause) -> bool:
    return cause.kind == "another-line" and bool(cause.term)


def _standing(cause: Cause) -> int:
    """Which of those that say the same stands for them: a mistake that is stated, and rather one made all along."""
    return 2 if cause.mistake is None else int(cause.application is not None)


def likeliest(shares: Sequence[float], groups: Sequence[Sequence[int]]) -> list[tuple[float, int]]:
    """What is told, the likeliest first: how likely it is, and the cause that stands for its group, the first of it."""
    found = [(sum(shares[one] for one in group), group[0]) for group in groups]
    found.sort(key=lambda each: -each[0])
    told = [each for each in found[:MOST] if each[0] >= NEAR * found[0][0]]
    return sorted(told, key=lambda each: -shares[each[1]])


def _with_its_like(
    told: list[tuple[float, int]], groups: Sequence[Sequence[int]], causes: Sequence[Cause], shares: Sequence[float]
) -> list[tuple[float, int]]:
    """What is told; beside one edit alone also that of another part, of the same step and kind, and about as likely."""
    if len(told) == MOST or (edit := causes[told[0][1]].edit) is None:
        return told
    share, first = told[0]
    group = next(group for group in groups if group[0] == first)
    for other in group[1:]:
        another = causes[other]
        if another.edit is None or another.kind != causes[first].kind or _overlap(edit.part, another.edit.part):
            continue
        if shares[other] >= AS_LIKELY * shares[first]:
            return [(share - shares[other], first), (shares[other], other)]
    return told


def _overlap(one: Expr, other: Expr) -> bool:
    """Whether one part of a formula is in the other."""
    return one in preorder_traversal(other) or other in preorder_traversal(one)


def giving(outcomes: Outcomes, typed: Typed, clock: Clock, settled: Mapping[str, Any]) -> tuple[list[Outcome], bool]:
    """The causes that give what was typed, and whether all were looked at; none, where so few answers are possible."""
    many = room(typed, exact=True)
    if many < _FEW:
        return [], True

    def standing(found: Iterable[Outcome]) -> list[Outcome]:
        return [outcome for outcome in found if outcomes.stands(outcome, settled)]

    finished = outcomes.grow(clock)
    every = outcomes.giving(typed)
    found = standing(every)
    found += _anew(outcomes, every, found, settled)
    if not found and many >= ROOM_FOR_TWO and finished:
        found = standing(outcomes.giving_apart(typed))
        if not found:
            finished = outcomes.grow_pairs(clock)
            found = standing(outcomes.giving_in_turn(typed))
    return sorted(found, key=lambda each: -each.cause.weight), finished


def _anew(
    outcomes: Outcomes, every: Sequence[Outcome], standing: Sequence[Outcome], settled: Mapping[str, Any]
) -> list[Outcome]:
    """What somebody does who goes on from no right answer before.

    Where something is found that denies none, that is a stated mistake alone, and one likelier than all of these.
    """
    highest = max((each.cause.weight for each in standing), default=0.0)
    denied = [each for each in every if not any(each is other for other in standing)]
    found = [anew for each in denied if (anew := outcomes.anew(each, settled)) is not None]
    return [each for each in found if not standing or (each.cause.mistake and each.cause.weight > highest)]


def distinct(causes: Sequence[Cause]) -> list[list[int]]:
    """The numbers of the causes, those together that say the same."""
    groups: list[list[int]] = []
    for number, cause in enumerate(causes):
        for group in groups:
            stated = (one for one in group[1:] if causes[one].mistake is not None)
            if any(_alike(cause, causes[one]) for one in (group[0], *stated)):
                group.append(number)
                break
        else:
            groups.append([number])
    return groups


def _alike(one: Cause, two: Cause) -> bool:
    if not _at_the_same_place(one, two):
        return False
    for zero, other in ((one, two), (two, one)):
        if zero.kind in ("elsewhere", "another-line") and zero.other == 0 and other.kind.endswith("left-out"):
            return True
        if zero.probe is not None and zero.other == 1 and other.kind.endswith("factor-left-out"):
            return other.edit is not None and zero.probe.part == other.edit.part
    if one.mistake and two.mistake:
        return one.mistake.says == two.mistake.says
    if one.mistake or two.mistake:
        return _is_stated(one, two) or _is_stated(two, one)
    if one.probe is not None and two.probe is not None and one.application is two.application:
        return _overlap(one.probe.part, two.probe.part)  # −5 is put in for V(s′), or for γV(s′)
    if {one.kind, two.kind} <= SLIPS and one.probe is None and two.probe is None:
        return True
    return one.kind == two.kind or any({one.kind, two.kind} <= group for group in ALIKE)


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
