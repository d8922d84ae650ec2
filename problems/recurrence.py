"""Where a process may go round for ever: strong components, end components and recurrent classes."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import TypeAlias, TypeVar

State = TypeVar("State")
Label = TypeVar("Label")
#: For every state its ways: a name for each, and the states that it may lead to.
Ways: TypeAlias = Mapping[State, Sequence[tuple[Label, Collection[State]]]]


def strong_components(after: Mapping[State, Iterable[State]]) -> list[list[State]]:
    """The states in groups, in each of which every state can be reached from every other (Tarjan 1972)."""
    number: dict[State, int] = {}
    lowest: dict[State, int] = {}
    open_states: dict[State, None] = {}
    found: list[list[State]] = []
    for root in after:
        if root in number:
            continue
        number[root] = lowest[root] = len(number)
        open_states[root] = None
        path = [(root, iter(after[root]))]
        while path:
            state, ahead = path[-1]
            for target in ahead:
                if target not in number:
                    number[target] = lowest[target] = len(number)
                    open_states[target] = None
                    path.append((target, iter(after[target])))
                    break
                if target in open_states:
                    lowest[state] = min(lowest[state], number[target])
            else:
                path.pop()
                if path:
                    lowest[path[-1][0]] = min(lowest[path[-1][0]], lowest[state])
                if lowest[state] == number[state]:
                    component: list[State] = []
                    while not component or component[-1] != state:
                        component.append(open_states.popitem()[0])
                    found.append(component[::-1])
    return found


def end_components(ways: Ways[State, Label]) -> list[dict[State, list[Label]]]:
    """The largest sets of states that need never be left, with the ways that stay inside (de Alfaro 1997).

    Where every state has one way they are the recurrent classes of a Markov chain.

    Args:
        ways: the ways of every state; those that may end the process are not among them.
    """
    inside = {state: list(row) for state, row in ways.items()}
    while True:
        components = strong_components(
            {
                state: [target for _, targets in row for target in targets if target in inside]
                for state, row in inside.items()
            }
        )
        home = {state: index for index, component in enumerate(components) for state in component}
        kept = {
            state: [way for way in row if all(home.get(target) == home[state] for target in way[1])]
            for state, row in inside.items()
        }
        kept = {state: row for state, row in kept.items() if row}
        if kept == inside:
            order = {state: place for place, state in enumerate(ways)}
            return [
                {state: [label for label, _ in kept[state]] for state in sorted(component, key=order.__getitem__)}
                for component in sorted(components, key=lambda component: min(map(order.__getitem__, component)))
            ]
        inside = kept


def predecessors(ways: Ways[State, Label]) -> dict[State, list[State]]:
    """The states from which each state may be reached in one step."""
    before: dict[State, dict[State, None]] = {}
    for state, row in ways.items():
        for _, ahead in row:
            for target in ahead:
                before.setdefault(target, {})[state] = None
    return {target: list(states) for target, states in before.items()}


def ranks(before: Mapping[State, Sequence[State]], targets: Iterable[State]) -> dict[State, int]:
    """How many steps it takes at least to come to one of the targets, for the states from which that is possible.

    Args:
        before: the predecessors of every state.
        targets: the states to come to.
    """
    rank = dict.fromkeys(targets, 0)
    queue = list(rank)
    for state in queue:
        for earlier in before.get(state, ()):
            if earlier not in rank:
                rank[earlier] = rank[state] + 1
                queue.append(earlier)
    return rank


def loop_through(ways: Ways[State, Label], state: State) -> dict[State, Label]:
    """A loop with its ways: from a state on, by its first way, and back to it.

    Args:
        ways: of every state those that stay inside; each state can be reached from each.
        state: where the loop begins.
    """
    rank = ranks(predecessors(ways), [state])
    chosen: dict[State, Label] = {}
    queue = {state: None}
    while len(chosen) < len(queue):
        each = next(each for each in queue if each not in chosen)
        label, ahead = min(ways[each], key=lambda way: 0 if each == state else min(rank[after] for after in way[1]))
        chosen[each] = label
        queue |= dict.fromkeys(ahead)
    return chosen
