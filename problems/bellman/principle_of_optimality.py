"""The best paths of a small graph without chance: from the start, and from every state on the way."""

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from graphlib import CycleError, TopologicalSorter
from itertools import pairwise
from typing import NamedTuple, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, is_scalar, read_scalar, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Name
from rldrill.problems.parts import Number, Part, Policy, Values
from rldrill.problems.settings import maps

TITLE = "Principle of optimality"
SOURCE = "Bertsekas 2017, sections 1.3 and 2.1"
REVISION = 4


class Edge(NamedTuple):
    """A way from one state to the next, and what it earns; a cost is negative."""

    state: Name
    next: Name
    reward: Exact


def _earning(row: object) -> object:
    """A way with its cost as one with its reward; what is none is told as a row of edges is."""
    match row:
        case [state, after, cost] if is_scalar(cost) and not isinstance(read_scalar(cost), Parameter):
            return [state, after, str(-Fraction(read_scalar(cost)))]
    return row


class Given(Givens):
    """A graph without cycles, where its paths start and end, and a state that some path is to go through."""

    edges: tuple[Edge, ...] = Field(
        min_length=1,
        max_length=2000,
        description="The ways of the graph, which has no cycle; or costs, the same with what each costs.",
    )
    start: Name = Field(description="Where the paths start.")
    goal: Name = Field(description="Where the paths end.")
    through: Name | None = Field(default=None, description="A state that one more path is to go through.")
    story: str = Field(
        default="", max_length=200, pattern=r"^[^$\\]*$", description="A sentence that is printed first."
    )

    @model_validator(mode="before")
    @classmethod
    def _earned(cls, data: object) -> object:
        """Ways whose ``costs`` are given as edges, which earn what is negative."""
        if not isinstance(data, dict) or "costs" not in data or "edges" in data or not isinstance(data["costs"], list):
            return data
        given = {name: field for name, field in data.items() if name != "costs"}
        return given | {"edges": [_earning(row) for row in data["costs"]]}

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if len({edge[:2] for edge in self.edges}) < len(self.edges):
            raise ValueError("edges: an edge is given twice; give each once")
        if self.goal in self.onward:
            raise ValueError(f"edges: {self.goal!r} is the goal, so no edge can lead on from it; take those out")
        for edge in self.edges:
            if edge.next != self.goal and edge.next not in self.onward:
                raise ValueError(f"edges: no edge leads on from {edge.next!r}, which is not the goal; add one")
        if self.start not in self.onward:
            raise ValueError(f"start: no edge leads on from {self.start!r}; add one")
        try:
            backwards = self.backwards
        except CycleError as error:
            raise ValueError(
                f"edges: a path can go round and round through {error.args[1][0]!r}; take one of its edges out"
            ) from None
        if self.through is not None and self.through not in backwards:
            raise ValueError(f"through: {self.through!r} is no state of the graph before the goal; name one that is")
        if self.through is not None and self.through not in self.reached:
            raise ValueError(f"through: no path from {self.start!r} reaches {self.through!r}; name another state")
        return self

    def terminal_states(self) -> tuple[str, ...]:
        """The goal, where nothing more is earned."""
        return (self.goal,)

    @cached_property
    def onward(self) -> dict[str, tuple[str, ...]]:
        """The next states of every state."""
        found: dict[str, list[str]] = {}
        for edge in self.edges:
            found.setdefault(edge.state, []).append(edge.next)
        return {state: tuple(after) for state, after in found.items()}

    @property
    def forks(self) -> dict[str, tuple[str, ...]]:
        """The next states of those states that have several."""
        return {state: after for state, after in self.onward.items() if len(after) > 1}

    @cached_property
    def backwards(self) -> tuple[str, ...]:
        """The states before the goal, each after all the states that it leads to.

        Raises:
            CycleError: there is no such order.
        """
        order = TopologicalSorter(self.onward).static_order()
        return tuple(state for state in order if state != self.goal)

    @property
    def reached(self) -> frozenset[str]:
        """The states that paths from the start come to."""
        found = {self.start}
        for state in reversed(self.backwards):
            if state in found:
                found.update(self.onward[state])
        return frozenset(found)


#: How many states lie before the goal at each level, and how many edges there are beside those from each to the next.
_SIZES = {1: (3, 2), 2: (4, 3), 3: (4, 4)}


def draw(level: int, rng: Draws) -> Given:
    """Three states before the goal; then four; then more edges, and a path that must go through a state.

    The best path leaves out one state at most, and somewhere on it another edge earns more at once. A state that a
    path must go through is the one left out, and there are several ways to it.
    """
    place = rng.choice(maps())
    count, more = _SIZES[level]
    names = (*place.states[:count], place.terminal)
    left_out = rng.choice((2, 3)) if level == 3 else rng.below(count)  # the start never is: then none is
    path = [state for state in range(count + 1) if not state or state != left_out]
    farther = [(here, after) for here in range(count) for after in range(here + 2, count + 1)]
    needed = {*pairwise(path)} & {*farther}
    if level == 3:
        needed.add(rng.choice([edge for edge in farther if edge[1] <= left_out]))
    others = [edge for edge in farther if edge not in needed]
    ways = sorted([*pairwise(range(count + 1)), *needed, *rng.sample(others, more - len(needed))])
    best = dict(pairwise(path))
    for here, after in rng.shuffled(ways):
        best.setdefault(here, after)
    paid = [*_paid(rng, ways, path, best)]
    most = [max(reward for state, _, reward in paid if state == here) for here in range(count)]
    if any([reward for state, _, reward in paid if state == here].count(most[here]) > 1 for here in range(count)):
        return draw(level, rng)  # which way earns most at once would be open
    return Given(
        edges=tuple(Edge(names[here], names[after], reward) for here, after, reward in paid),
        start=names[0],
        goal=place.terminal,
        through=names[left_out] if level == 3 else None,
        story=place.story,
    )


def _paid(
    rng: Draws, ways: Sequence[tuple[int, int]], path: Sequence[int], best: Mapping[int, int]
) -> Iterator[tuple[int, int, Fraction]]:
    """What the edges earn, so that these are the best next states; on the path another earns more at once."""
    values = [*rng.integers(len(best) + 1, -4, 5)]
    here, after = bait = rng.choice([(here, after) for here, after in ways if here in path and after != best[here]])
    values[after] = values[best[here]] - 2 - rng.below(3)
    for here, after in ways:
        lost = 0 if best[here] == after else 1 if (here, after) == bait else 1 + rng.below(3)
        yield here, after, Fraction(values[here] - values[after] - lost)


def question(given: Given) -> Question:
    """The edges; the best total and the best next state from everywhere, and the best path through a state."""
    negative = " (a cost, if it is negative)" if any(edge.reward < Fraction(0) for edge in given.edges) else ""
    blocks = (
        Paragraph(
            f"{given.story} The moves are deterministic: each takes one of these edges and earns its "
            f"reward{negative}. The return is the undiscounted sum of the rewards up to "
            f'{given.goal}, where the path ends: $V^*("{given.goal}") = 0$.'.strip()
        ),
        Table(
            header=("$s$", "$s'$", "$R_{s s'}$"),
            rows=tuple((edge.state, edge.next, f"${shown(edge.reward)}$") for edge in given.edges),
        ),
    )
    states = tuple(given.onward)
    parts = [
        Part(
            f"What is $V^*(s)$, the greatest return of a path from $s$ to {given.goal}, for every state $s$?",
            Values("V^*", states),
        ),
    ]
    if given.forks:
        ask = "Which state $s'(s)$ does an optimal path visit next, from each state $s$ with a choice?"
        parts.append(Part(ask, Policy(given.forks, "s'")))
    if given.through is not None:
        ask = f"What is the greatest return of a path from {given.start} to {given.goal} that visits {given.through}?"
        parts.append(Part(ask, Number()))
    return Question(blocks, tuple(parts))
