"""One linear system for every feature, then the mean over the start distribution."""

from collections.abc import Iterable, Mapping
from typing import Any

from msgspec.structs import replace

from rldrill.problems.exact import Parameter, shown
from rldrill.problems.fractions import Fraction
from rldrill.problems.inverse_rl.feature_expectations_policy import Given
from rldrill.problems.recurrence import end_components
from rldrill.solutions import knowns
from rldrill.solutions.endless import Loop, no_expectation
from rldrill.solutions.exact import ONE, ZERO, NoSolution, Value, exact, is_zero
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.inverse_rl import (
    FEATURES_FROM,
    FEATURES_FROM_START,
    START_IGNORED,
    START_NOT_COUNTED,
    mu_of,
)
from rldrill.solutions.work import Work


def solve(given: Given, work: Work) -> None:
    """The system of each feature over all states; then μ(π), component by component."""
    states = given.states
    motion = knowns.motion(given.motion)
    reached = {
        (state, action): tuple(target for target, chance in rows[state].items() if chance)
        for action, rows in given.motion.items()
        for state in states
    }
    P: dict[Any, Any] = knowns.Sparse()
    P.update({(state, action, target): chance for (target, state, action), chance in motion.items()})
    known: dict[str, Any] = {
        "P": P,
        "successors": reached,
        "states": states,
        "actions": {
            state: tuple(action for action, chance in given.policy[state].items() if chance) for state in states
        },
        "pi": knowns.policy(given.policy),
        "phi": knowns.Sparse(knowns.features(given.features)),
        "gamma": exact(given.gamma),
    }
    loops = _endless(given, motion, known) if known["gamma"] == ONE else []
    expectations: dict[tuple[int, str], Any] = {}
    for index in range(1, given.size + 1):
        fixed = {(index, state): ZERO for state in given.terminal} | _resting(work, index, loops, known["phi"])
        cases = [{"component": index, "s": state} for state in states if (index, state) not in fixed]
        if index > 1 and cases:
            work.say(f"These are the equations of (a) with $φ_{index}$ for $φ_1$: only the features in them change.")
        solved = work.system(FEATURES_FROM, mu_of, cases, mu_of=fixed, **known) if cases else fixed
        answer = {state: solved[index, state] for state in states}
        if given.matched is None:
            answer = work.answer(answer)
        expectations |= {(index, state): value for state, value in answer.items()}
    begins = {"start_chance": knowns.values(given.start_chances), "states": known["states"], "mu_of": expectations}
    total = tuple(work.step(FEATURES_FROM_START, component=index, **begins) for index in range(1, given.size + 1))
    if given.matched is None:
        work.answer(total if len(total) > 1 else total[0])
    else:
        work.say(f"This must equal the expert's ${shown(given.matched)}$:")
        work.answer(work.equate(given.asked_for, total[0], exact(given.matched), share=True))


def _endless(given: Given, motion: Mapping[Any, Value], known: Mapping[str, Any]) -> list[Loop]:
    """The loops that the policy never leaves; in place of rewards they have nothing yet."""
    pi = known["pi"]
    chances: dict[str, dict[str, Value]] = {
        state: {
            target: chance
            for target in (*given.states, *given.terminal)
            if not is_zero(chance := sum((pi[a, state] * motion[target, state, a] for a in given.motion), ZERO))
        }
        for state in given.states
    }
    ways = {state: [(None, to)] for state, to in chances.items() if not any(end in to for end in given.terminal)}
    return [
        Loop(
            {state: known["actions"][state] for state in component},
            dict.fromkeys(component, ZERO),
            {state: chances[state] for state in component},
        )
        for component in end_components(ways)
    ]


def _resting(
    work: Work, index: int, loops: Iterable[Loop], phi: Mapping[tuple[int, str], Value]
) -> dict[tuple[int, str], Value]:
    """The states that an undiscounted process never leaves although it has not ended: their feature must be 0.

    Raises:
        NoSolution: it is not, so that its sum never ends.
    """
    resting: dict[tuple[int, str], Value] = {}
    for each in loops:
        loop = replace(each, rewards={state: phi[index, state] for state in each.actions})
        if not loop.pays_nothing:
            raise NoSolution(no_expectation(loop, index))
        work.say(f"Whoever comes to {loop} stays there for ever, and $φ_{{{index}}}$ is $0$ there: so is its sum.")
        for state in loop.actions:
            work.give(FEATURES_FROM, ZERO, component=index, s=state)
            resting[index, state] = ZERO
    return resting


MISCONCEPTIONS = (START_IGNORED, START_NOT_COUNTED.where_it_shows())


def oracle(given: Given) -> Answers:
    """The feature expectations; or where the expert's are matched, the probability that does it, by bisection."""
    if given.matched is None:
        return _pushed(given)
    matched, (low, high) = at(given.matched), (0.0, 1.0)
    rising = _from_start(given, high) > _from_start(given, low)
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if (_from_start(given, middle) < matched) == rising else (low, middle)
    return (low,)


def possible(given: Given) -> bool:
    """Whether the policy has the expert's feature expectation for some probability."""
    return given.matched is None or bool(np.isclose(_from_start(given, oracle(given)[0]), at(given.matched)))


def _from_start(given: Given, chance: float) -> float:
    """What the policy expects from the start with this number in place of what is left open."""
    number = Fraction(chance)
    policy = {
        state: {
            action: (1 - number if share.complement else number) if isinstance(share, Parameter) else share
            for action, share in row.items()
        }
        for state, row in given.policy.items()
    }
    *_, total = _pushed(given.model_copy(update={"policy": policy, "matched": None}))
    return float(total)


def _pushed(given: Given) -> Answers:
    """The discounted state distribution pushed forward, for twice as many steps each time, all states at once."""
    states = (*given.states, *given.terminal)
    count = len(given.states)
    chain = np.zeros((count, len(states)))
    for action in given.motion:
        share = np.array([at(given.policy[state].get(action, 0)) for state in given.states])
        rows = np.array(
            [[at(given.motion[action][state].get(target, 0)) for target in states] for state in given.states]
        )
        chain += share[:, None] * rows
    features = np.array([[at(value) for value in given.features[state]] for state in given.states])
    moved, total = at(given.gamma) * chain[:, :count], features
    for _ in range(40):  # the sum over the first 2ⁿ steps, and what is left after them
        total = total + moved @ total
        moved = moved @ moved
    begins = np.array([at(chance) for chance in given.start_chances.values()])
    start = begins @ total
    return [*total.T, start if len(start) > 1 else start[0]]
