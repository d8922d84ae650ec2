"""The value of every policy, both sides of every constraint, and the worst violation."""

from typing import Any

from flint import fmpq

from rldrill.problems.exact import Parameter, shown
from rldrill.problems.inverse_rl.max_margin import EXPERT, Given
from rldrill.solutions import knowns
from rldrill.solutions.exact import ZERO, exact, largest, sign
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.inverse_rl import MAX_MARGIN, MAX_MARGIN_BOUND, REWARD_OF_FEATURES, SLACK, SUM_FOR_MAXIMUM
from rldrill.solutions.slips import right_answers
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """Values; then constraint by constraint with a slack; then the slack that is needed."""
    mus = {EXPERT: given.expert} | {name: rival.mu for name, rival in given.policies.items()}
    known: dict[str, Any] = {
        "w": dict(enumerate(map(exact, given.w), 1)),
        "features": tuple(range(1, len(given.w) + 1)),
        "mu_policy": knowns.features(mus),
    }
    worth = {name: work.step(REWARD_OF_FEATURES, policy=name, **known) for name in mus}
    margins = {EXPERT: ZERO} | {name: exact(rival.margin) for name, rival in given.policies.items()}
    if given.asked_for:
        _balance(given, work, given.asked_for, worth, margins)
        return
    worth = dict(zip(worth, work.answer(tuple(worth.values())), strict=True))
    sides: dict[str, Any] = {"worth": worth, "worth_expert": worth[EXPERT], "margin": margins}
    work.recall(MAX_MARGIN)
    work.say(f"With $ξ = {shown(given.slack)}$ the right side of each constraint is:")
    holding = sum([_holds(work, name, sides, exact(given.slack)) for name in given.policies])
    work.say(f"So {_counted(holding, len(given.policies))}.")
    work.answer(fmpq(holding))
    violated = tuple(
        name
        for name in given.policies
        if sign(worth[EXPERT] - work.value(MAX_MARGIN_BOUND, policy=name, xi=ZERO, **sides)) < 0
    )
    work.say(
        "Solved for $ξ$, each constraint is a lower bound, $ξ ≥ w^⊤ μ(π) + m(π_E, π) − w^⊤ μ(π_E)$, and $ξ ≥ 0$ is one "
        "more. The greatest of them is the smallest $ξ$:"
    )
    slack = work.answer(work.step(SLACK, policies=tuple(given.policies), violated=violated, **sides))
    if not violated and slack == 0:
        work.say("No constraint is violated, so no slack is needed.")


def _counted(holding: int, count: int) -> str:
    """How many of the constraints hold, in words."""
    if holding == count:
        return {1: "the constraint holds", 2: "both constraints hold"}.get(count, f"all {count} constraints hold")
    return f"{holding or 'none'} of the {count} constraints {'hold' if holding > 1 else 'holds'}"


def _balance(given: Given, work: Work, letter: str, worth: dict[str, Any], margins: dict[str, Any]) -> None:
    """The open weight at which each constraint holds with equality; the greatest of these is enough for all."""
    work.recall(MAX_MARGIN)
    work.say("With $ξ = 0$ the right side of each constraint is:")
    least, place = {}, given.w.index(letter)
    for name in given.policies:
        right = work.step(MAX_MARGIN_BOUND, policy=name, worth=worth, margin=margins, xi=ZERO)
        work.say("Both sides are equal for:")
        least[name] = work.equate(letter, worth[EXPERT], right)
    least = work.answer(least)
    enough = largest(tuple(least.values()))
    open_ = shown(Parameter(letter))
    each = ", ".join(f"{open_} ≥ {value}" for value in least.values())
    more = ", ".join(f"{shown(given.expert[place])} > {shown(rival.mu[place])}" for rival in given.policies.values())
    work.say(
        f"The expert has more of feature ${place + 1}$ than every other policy, ${more}$, so each constraint is a "
        f"lower bound on ${open_}$: ${each}$. All of them hold for ${open_} ≥ {enough}$, so the smallest one "
        f"is ${enough}$.".replace("-", "−")
    )
    work.answer(enough)


def _holds(work: Work, name: str, sides: dict[str, Any], slack: fmpq) -> bool:
    known = sides | {"policy": name, "xi": slack}
    left = sides["worth_expert"]
    right = work.step(MAX_MARGIN_BOUND, **known)
    holds = sign(left - right) >= 0
    relation = "≥" if holds else "<"
    compared = f"$w^⊤ μ(π_E) = {shown(left)} {relation} {shown(right)}$"
    work.say(f"{compared}: this constraint {'holds' if holds else 'is violated'}.")
    return holds


def _margins_decide(given: Given) -> bool:
    """Whether there is anything that margins make different: a weight from which on, or a violation."""
    return given.asked_for is not None or max(given.missing.values()) > 0


@slip(
    "margin-on-the-wrong-side",
    "The margin makes the constraint harder: it is added to the other policy's side, not to the expert's.",
    when=lambda given: any(rival.margin for rival in given.policies.values()) and _margins_decide(given),
)
def margin_on_the_wrong_side(given: Given, work: Work) -> None:
    """The same constraints with every margin taken away instead of added."""
    rivals = {name: rival.model_copy(update={"margin": -rival.margin}) for name, rival in given.policies.items()}
    solve(given.model_copy(update={"policies": rivals}), work)


@slip(
    "not-divided",
    "The last thing to do is to divide by what the open weight is multiplied with: the expert's feature minus the "
    "other policy's.",
    when=lambda given: given.asked_for is not None,
)
def not_divided(given: Given, work: Work) -> None:
    """The open weight times what stands before it."""
    least, _ = right_answers(solve, given, work)
    place = given.w.index(given.asked_for)
    before = {name: exact(given.expert[place]) - exact(rival.mu[place]) for name, rival in given.policies.items()}
    least = work.answer({name: least[name] * factor for name, factor in before.items()})
    work.answer(largest(tuple(least.values())))


MISCONCEPTIONS = (margin_on_the_wrong_side, SUM_FOR_MAXIMUM, not_divided.where_it_shows())


def oracle(given: Given) -> Answers:
    """Slacks tried by bisection until the smallest that does is found, on matrices."""
    mus = np.array([[at(value) for value in mu] for mu in (given.expert, *(r.mu for r in given.policies.values()))])
    margins = np.array([at(rival.margin) for rival in given.policies.values()])
    if given.asked_for:
        place = given.w.index(given.asked_for)
        others = np.array([0.0 if index == place else at(weight) for index, weight in enumerate(given.w)])
        ahead = mus[0] - mus[1:]
        least = (margins - ahead @ others) / ahead[:, place]
        return (least, least.max())
    values = mus @ [at(weight) for weight in given.w]
    needed = values[1:] + margins
    low, high = 0.0, 1.0 + np.abs(needed).sum() + abs(values[0])
    if (values[0] >= needed - 1e-12).all():
        high = 0.0
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (low, middle) if (values[0] + middle >= needed).all() else (middle, high)
    return (values, (values[0] >= needed - at(given.slack) - 1e-12).sum(), high)
