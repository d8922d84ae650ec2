"""What a state must be worth so that the best action in another state is worth what is known."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple, TypeAlias

from rldrill.problems.document import begun, joined
from rldrill.problems.models import Transition
from rldrill.solutions.exact import NoSolution, Value, equals, parameters, told
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.rational import generator
from rldrill.solutions.work import Work

#: Chooses among the values with which one action or another is worth what is known.
Chosen: TypeAlias = Callable[[Iterable[Any]], Any]


class Known(NamedTuple):
    """A value that is known, and one that follows from it.

    Args:
        name: what the value is called that is known: ``V^*``.
        state: the state that has it.
        value: the value.
        sought: what the value is called that follows.
        other: the state that has that one.
    """

    name: str
    state: str
    value: Value
    sought: str
    other: str


def reached(
    work: Work,
    formula: Formula,
    given: Known,
    values: Mapping[str, Value],
    chosen: Chosen,
    **known: Any,
) -> tuple[Value, str]:
    """The value that is sought, and the action that is worth what is known with it.

    Args:
        work: where the steps are written.
        formula: what an action is worth.
        given: what is known, and what is sought.
        values: what the other states are worth.
        chosen: which of the values to take: the smallest, with which no action exceeds what is known.
        **known: the model and the discount.

    Raises:
        NoSolution: with no value is it what the best action is worth.
    """
    state, target = given.state, given.value
    work.say(f'Let $y = {given.sought}("{given.other}")$. The actions in {state} have these values:')
    ahead = {**values, given.other: generator("y")}
    worths = {action: work.step(formula, s=state, a=action, **known, V=ahead) for action in known["actions"][state]}
    moving = [action for action, worth in worths.items() if parameters(worth)]
    this = f'${given.name}("{state}") {equals(target)}$'
    if less := [action for action in worths if action not in moving]:
        beaten = f"{begun(joined(less))} {'is' if len(less) == 1 else 'are'} worth less than {this}"
        work.say(f"{beaten}, so {moving[0]} must be worth that:" if len(moving) == 1 else f"{beaten}.")
    ends = {}
    for action in moving:
        if len(moving) > 1:
            work.say(f"If {action} is best in {state}, this is {this}:")
        elif not less:
            work.say(f"This must be {this}:")
        ends[action] = work.equate("y", worths[action], target)
    others = [worth for action, worth in worths.items() if action not in ends]
    if ends and max(others, default=None) == target:
        raise NoSolution(
            f"more than one value of {given.other!r} is right: another action in {state!r} is worth {target} anyway"
        )
    if not ends or any(worth > target for worth in others):
        raise NoSolution(f"with no value of {given.other!r} is the best action in {state!r} worth {target}")
    value = chosen(ends.values())
    (best, *_) = (action for action, end in ends.items() if end == value)
    more = []
    for end in dict.fromkeys(end for end in ends.values() if end != value):
        work.say(f"With $y {equals(end)}$ {best} is worth:")
        worth = work.step(formula, s=state, a=best, **known, V={**values, given.other: end})
        more.append(f"${told(worth)}$ with $y {equals(end)}$")
    if more:
        too_much = f"{begun(best)} would be worth {joined(more)}, more than ${told(target)}$"
        work.say(f"{too_much}: so $y {equals(value)}$ is right.")
    elif len(moving) > 1:
        work.say(f"So {best} is best in {state}.")
    return value, best


def rewarded(
    work: Work,
    formula: Formula,
    row: Transition,
    name: str,
    value: Value,
    values: Mapping[str, Value],
    *,
    demanding: bool = True,
    **known: Any,
) -> tuple[Value, dict[str, Any]]:
    """The reward left open with which its action makes its state worth so much, and what all actions are worth there.

    Args:
        work: where the steps are written.
        formula: what an action is worth.
        row: the transition whose reward is left open.
        name: what the value is called.
        value: the value.
        values: what the next states are worth.
        demanding: whether the reward must follow; somebody's own value need not be a possible one.
        **known: the model and the discount.

    Raises:
        NoSolution: another action is worth as much.
    """
    state = row.state
    work.say(f"The actions in {state} have these values:")
    worths = {action: work.step(formula, s=state, a=action, **known, V=values) for action in known["actions"][state]}
    if demanding and any(worth >= value for action, worth in worths.items() if action != row.action):
        raise NoSolution(
            f"the reward of {row.action!r} does not follow: another action in {state!r} is worth as much or more"
        )
    work.say(f'Only {row.action} can be worth ${name}("{state}") {equals(value)}$:')
    return work.equate(str(row.reward), worths[row.action], value), worths
