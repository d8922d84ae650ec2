"""The features stacked block by block, their weighted sums, and the action with the greatest."""

from collections.abc import Callable, Mapping, Sequence

from rldrill.problems.exact import Parameter
from rldrill.problems.function_approximation.linear_value import Bumps, Given
from rldrill.solutions.centres import distances, measured
from rldrill.solutions.exact import ZERO, NoSolution, Value, equals, exact, sign
from rldrill.solutions.formula.compiling import arg_max
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.found import put_in_found
from rldrill.solutions.greedy import greedy
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.rational import generator
from rldrill.solutions.sheet.function_approximation import (
    GREEDY_LINEAR,
    LINEAR_VALUE,
    PIECEWISE_LINEAR_RBF,
    TENT_INSIDE,
)
from rldrill.solutions.work import Work


def _own_block(given: Given, action: str) -> range:
    """The places of the weights of an action."""
    first = given.actions.index(action) * given.size
    return range(first, first + given.size)


def solve(given: Given, work: Work, places: Callable[[Given, str], range] = _own_block) -> None:
    """Features, values, greedy action; or the state or the weight at which two values are equal."""
    if given.bumps is not None and given.bumps.position is None:
        _state_sought(given, given.bumps, work, places)
        return
    features = tuple(map(exact, given.features or ()))
    if given.bumps is not None:
        features = work.answer(_features(given.bumps, work))
    if given.action is not None:
        work.say("The features stand in the action's own block, and the other blocks are $0$.")
        work.answer(_stacked(given, features, places(given, given.action)))
    values = _values(given, work, features, places, [a for a in given.actions if a != given.raised])
    if given.raised is None:
        _greedy(work, work.answer(values), given.actions)
        return
    work.answer(values)
    best = arg_max(tuple(values), tuple(values.values()))
    raised = _values(given, work, features, places, [given.raised])
    if len(values) > 1:
        work.say(f"Its value must exceed the greatest other one, that of {best[0][1]}; the two are equal where")
    else:
        work.say("The two values are equal where")
    threshold = work.equate("w", raised["s", given.raised], values[best[0]])
    work.say(
        f"The feature that $w$ weighs is positive, so the value of {given.raised} grows with $w$: above this $w$ it is "
        "greedy."
    )
    work.answer(threshold)


def _values(
    given: Given, work: Work, features: Sequence[Value], places: Callable[[Given, str], range], actions: Sequence[str]
) -> dict[tuple[str, str], Value]:
    stacked = {
        (number, "s", action): value
        for action in actions
        for number, value in enumerate(_stacked(given, features, places(given, action)), 1)
    }
    theta = dict(enumerate(map(exact, given.theta), 1))
    known = {"s": "s", "theta": theta, "f": stacked, "features": tuple(theta)}
    return {("s", a): work.step(LINEAR_VALUE, a=a, **known) for a in actions}


def _greedy(work: Work, values: Mapping[tuple[str, str], Value], actions: tuple[str, ...]) -> None:
    best = work.step(GREEDY_LINEAR, s="s", Qhat=values, choices=actions)
    work.say(f"The action{'s' * (len(best) > 1)} {greedy(best, len(actions))}.")
    work.answer({"s": best})


def _state_sought(given: Given, bumps: Bumps, work: Work, places: Callable[[Given, str], range]) -> None:
    """Between the centres the features, and so the values, are straight lines in the state."""
    ((left,), (right,)) = bumps.centres
    x, width = generator("x"), exact(bumps.width)
    work.say("Between the centres the distances are $x − c_1$ and $c_2 − x$, neither greater than $b$:")
    both = _values(given, work, _inside(work, x - exact(left), exact(right) - x, width), places, given.actions)
    work.say("The two are equal where")
    state = work.equate("x", *both.values())
    outside = sign(state - exact(left)) < 0 or sign(exact(right) - state) < 0
    if outside and work.misconception is None:
        raise NoSolution("between the centres one action is always better than the other; change theta")
    work.answer(state)
    work.answer(_at(work, given.actions[0], both, state))
    work.say(f"At $c_1$, where $x {equals(exact(left))}$:")
    _greedy(work, {("s", a): _at(work, a, both, exact(left)) for a in given.actions}, given.actions)


def _at(work: Work, action: str, values: Mapping[tuple[str, str], Value], place: Value) -> Value:
    """The value of an action at a place that is put in for x."""
    return put_in_found(work, LINEAR_VALUE, "x", values["s", action], place, s="s", a=action)


def _inside(work: Work, from_left: Value, from_right: Value, width: Value) -> tuple[Value, ...]:
    """The features of a state at these distances from the two centres."""
    far = {1: from_left, 2: from_right}
    return tuple(work.step(TENT_INSIDE, s="s", i=number, distance=far, width=width) for number in far)


def _features(bumps: Bumps, work: Work) -> tuple[Value, ...]:
    known = distances(bumps, work) | {"width": exact(bumps.width)}
    return tuple(work.step(PIECEWISE_LINEAR_RBF, i=number, **known) for number in known["distance"])


def _stacked(given: Given, features: Sequence[Value], places: range) -> tuple[Value, ...]:
    """The features at the places of the action's weights, 0 elsewhere."""
    standing = dict(zip(places, features, strict=True))
    return tuple(standing.get(place, ZERO) for place in range(len(given.theta)))


def _interleaved(given: Given, action: str) -> range:
    """The places of the weights of an action, where they stand feature by feature."""
    return range(given.actions.index(action), len(given.theta), len(given.actions))


@slip(
    "block-of-the-wrong-action",
    "Every action has its own block of weights, in the order in which the actions are named; another one was used.",
    when=lambda given: given.raised is None and not given.between,
)
def wrong_block(given: Given, work: Work) -> None:
    """Every action with the next one's block, the last with the first one's."""
    *others, last = given.actions
    solve(given.model_copy(update={"actions": (last, *others)}), work)


@slip(
    "weights-interleaved",
    "The first block holds all weights of the first action; the weights were read feature by feature instead.",
    when=lambda given: given.size > 1 and given.raised is None,
)
def interleaved(given: Given, work: Work) -> None:
    """For the first feature a weight of every action, then for the second, and so on."""
    solve(given, work, _interleaved)


@slip(
    "weights-interleaved-beside-the-open-one",
    "The first block holds all weights of the first action; the weights were read feature by feature instead.",
    when=lambda given: given.size > 1 and given.raised is not None and _keeps_the_open_weight(given),
)
def interleaved_too(given: Given, work: Work) -> None:
    """The same where a weight is open, and is one of the same action either way."""
    solve(given, work, _interleaved)


def _keeps_the_open_weight(given: Given) -> bool:
    place = next(place for place, weight in enumerate(given.theta) if isinstance(weight, Parameter))
    return place // given.size == place % len(given.actions)


MISCONCEPTIONS = (wrong_block, interleaved, interleaved_too.where_it_shows())


def oracle(given: Given) -> Answers:
    """Kronecker products with unit vectors, and a matrix of weights with one row for each action; roots by halving."""
    table = np.array([0.0 if isinstance(weight, Parameter) else at(weight) for weight in given.theta])
    table = table.reshape(len(given.actions), -1)
    if given.bumps is not None and given.bumps.position is None:
        return _crossing(given, given.bumps, table)
    answers: list[object] = []
    if given.bumps is None:
        features = np.array([at(value) for value in given.features or ()])
    else:
        features = _tents(given.bumps, ())
        answers.append(features)
    values = table @ features
    if given.action is not None:
        answers.append(np.kron(np.eye(len(given.actions))[given.actions.index(given.action)], features))
    if given.raised is None:
        return (*answers, values, {"s": _best(given, values)})
    row = given.actions.index(given.raised)
    others = np.delete(values, row)
    place = [isinstance(weight, Parameter) for weight in given.theta].index(True) % given.size
    return (*answers, others, (others.max() - values[row]) / features[place])


def _tents(bumps: Bumps, state: Sequence[float]) -> Array:
    return np.interp(measured(bumps, state), [0.0, at(bumps.width)], [1.0, 0.0])


def _best(given: Given, values: Array) -> set[str]:
    return {action for action, value in zip(given.actions, values, strict=True) if value > values.max() - 1e-9}


def _crossing(given: Given, bumps: Bumps, table: Array) -> Answers:
    """The difference of the two values changes its sign once between the centres."""
    low, high = (at(centre) for (centre,) in bumps.centres)
    start = table @ _tents(bumps, (low,))
    for _ in range(60):
        middle = (low + high) / 2
        here = table @ _tents(bumps, (middle,))
        low, high = (middle, high) if (here[0] > here[1]) == (start[0] > start[1]) else (low, middle)
    return (low, (table @ _tents(bumps, (low,)))[0], {"s": _best(given, start)})
