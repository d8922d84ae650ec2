"""The little worlds in which problems are set, and random models of them."""

import tomllib
from collections.abc import Iterable
from functools import cache
from itertools import pairwise, permutations
from pathlib import Path
from typing import Any

from msgspec import Struct

from rldrill.problems.draws import Draws
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Model, Transition


class Setting(Struct, frozen=True):
    """A world: what it is about, its states, the one in which it ends, and the actions; what to add where it ends.

    ``moves`` holds for each action how many states further it leads, below 0 how many back, the most usual first;
    ``alone`` holds those that happen without an action that is named.
    """

    story: str
    ending: str
    states: tuple[str, ...]
    terminal: str
    actions: tuple[str, ...]
    moves: tuple[tuple[int, ...], ...]
    alone: tuple[int, ...]

    def __hash__(self) -> int:
        return hash(self.story)

    def told(self, terminal: tuple[str, ...]) -> str:
        """What the world is about, with its ending if there is a terminal state."""
        return f"{self.story}{self.ending if terminal else ''}."

    @property
    def onward(self) -> tuple[str, ...]:
        """The actions that lead on."""
        return tuple(action for action, moves in zip(self.actions, self.moves, strict=True) if max(moves) > 0)

    @property
    def returns(self) -> bool:
        """Whether earlier states come again where no action is named."""
        return min(self.alone) < 0

    def steps(self, action: str) -> tuple[int, ...]:
        """How many states further an action leads; what the world does not name stands for what happens alone."""
        return self.moves[self.actions.index(action)] if action in self.actions else self.alone

    def reached(self, places: tuple[str, ...], state: str, action: str) -> tuple[str, ...]:
        """Where an action can lead from a state, the most usual first; it goes no further than to the outer places."""
        return _reached(self, places, state, action)

    def seen(self, state: str, action: str) -> tuple[str, ...]:
        """Where an action is seen to lead in a run: those that lead back do not leave everything as it is."""
        places = (*self.states, self.terminal)
        reached = self.reached(places, state, action)
        still = max(self.steps(action)) > 0 or state == places[0]
        return reached if still else tuple(place for place in reached if place != state)


@cache
def _reached(setting: Setting, places: tuple[str, ...], state: str, action: str) -> tuple[str, ...]:
    here = places.index(state)
    steps = (*setting.steps(action), 0)
    return tuple(dict.fromkeys(places[min(max(here + step, 0), len(places) - 1)] for step in steps))


@cache
def _written() -> dict[str, list[dict[str, Any]]]:
    with (Path(__file__).parent / "worlds.toml").open("rb") as file:
        return tomllib.load(file)


@cache
def settings() -> tuple[Setting, ...]:
    """All worlds, from ``worlds.toml``."""
    return tuple(
        Setting(
            world["story"],
            world["ending"],
            tuple(world["states"]),
            world["terminal"],
            tuple(world["actions"]),
            tuple(map(tuple, world["moves"])),
            tuple(world.get("alone") or dict.fromkeys(step for moves in world["moves"] for step in moves)),
        )
        for world in _written()["world"]
    )


class Map(Struct, frozen=True):
    """Places without an order, the one in which it ends, and actions that may lead to any place still to come."""

    story: str
    states: tuple[str, ...]
    terminal: str
    actions: tuple[str, ...]


@cache
def maps() -> tuple[Map, ...]:
    """All maps, from ``worlds.toml``."""
    return tuple(
        Map(each["story"], tuple(each["states"]), each["terminal"], tuple(each["actions"]))
        for each in _written()["map"]
    )


def in_order(states: Iterable[str]) -> tuple[str, ...]:
    """States of a world, each once, from the first on; the one in which it ends is left out."""
    named = {*states}
    return tuple(state for world in settings() for state in world.states if state in named)


@cache
def _ways(
    setting: Setting, moves: tuple[tuple[str, str], ...], actions: tuple[str, ...]
) -> tuple[tuple[dict[str, str], tuple[tuple[str, ...], ...]], ...]:
    """All that letters can stand for, so that every move is possible; and the actions that can make each."""
    letters = sorted({letter for before, after in moves for letter in before + after} - {"."})
    reached = {(state, action): {*setting.seen(state, action)} for state in setting.states for action in actions}
    found = []
    for states in permutations(setting.states, len(letters)):
        named = dict(zip(letters, states, strict=True)) | {".": setting.terminal}
        fit = tuple(
            [
                tuple(
                    [action for action in actions if reached[named[before], action].issuperset(map(named.get, after))]
                )
                for before, after in moves
            ]
        )
        if all(fit):
            found.append((named, fit))
    return tuple(found)


def possible(setting: Setting, moves: tuple[tuple[str, str], ...], actions: tuple[str, ...]) -> bool:
    """Whether a world has states and actions for such moves."""
    return bool(_ways(setting, moves, actions))


def draw_moves(
    rng: Draws, setting: Setting, moves: tuple[tuple[str, str], ...], actions: tuple[str, ...]
) -> tuple[dict[str, str], tuple[str, ...]]:
    """States of a world for letters, and an action for every move, which can lead there as the world has it.

    Args:
        rng: the stream of choices.
        setting: the world; it must have such states.
        moves: for every action the letter of the state in which it is taken, and those to which it can lead; a full
            stop is the end.
        actions: those that may be taken.
    """
    named, fit = rng.choice(_ways(setting, moves, actions))
    return named, tuple(rng.choice(possible) for possible in fit)


def draw_way(
    rng: Draws, setting: Setting, visits: str, actions: tuple[str, ...], *, same: bool = False
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The states of a run through a world, and the actions that can lead from each to the next.

    Args:
        rng: the stream of choices.
        setting: the world.
        visits: a letter for every state, in the order of the visits; a full stop is the end: ``"aba."``.
        actions: those that may be taken; in a last state that is not the end, any of them.
        same: whether a state that is visited again sees the same action again.
    """
    steps = tuple(pairwise(visits))
    if same:
        after = {letter: "".join(dict.fromkeys(b for a, b in steps if a == letter)) for letter, _ in steps}
        named, habits = draw_moves(rng, setting, tuple(after.items()), actions)
        habit = dict(zip(after, habits, strict=True))
        taken = tuple(habit[letter] for letter, _ in steps)
    else:
        named, taken = draw_moves(rng, setting, steps, actions)
        habit = {}
    last = () if visits[-1] == "." else (habit.get(visits[-1]) or rng.choice(actions),)
    return tuple(named[letter] for letter in visits), (*taken, *last)


#: No action of any world.
_UNNAMED = ("",)


def draw_places(rng: Draws, steps: Iterable[tuple[str, str]]) -> tuple[Setting, dict[str, str]]:
    """A world and its states for letters, between which such steps happen without an action that is named.

    Args:
        rng: the stream of choices.
        steps: the letters of a state and of the next one; a full stop is the end.
    """
    moves = tuple(dict.fromkeys(steps))
    setting = rng.choice([setting for setting in settings() if possible(setting, moves, _UNNAMED)])
    return setting, draw_moves(rng, setting, moves, _UNNAMED)[0]


def draw_visits(rng: Draws, *visits: str) -> tuple[Setting, tuple[str, ...]]:
    """A world, and the states of a run through it in which no action is named.

    Args:
        rng: the stream of choices.
        visits: orders of visits, as ``draw_way`` takes them, one of which is chosen.
    """
    tour = rng.choice(visits)
    setting, named = draw_places(rng, pairwise(tour))
    return setting, tuple(named[letter] for letter in tour)


def draw_setting(rng: Draws) -> Setting:
    """One of the worlds."""
    return rng.choice(settings())


def draw_roaming(rng: Draws) -> Setting:
    """One of the worlds in which earlier states come again where no action is named."""
    return rng.choice([setting for setting in settings() if setting.returns])


class Shape(Struct, frozen=True):
    """How large a random model is.

    Args:
        states: states in which an action is taken.
        actions: actions in each of them.
        branches: how many next states an action may have at most.
        reward: the largest reward; rewards are whole numbers from minus half of it.
    """

    states: int
    actions: int
    branches: int
    reward: int = 6
    denominators: tuple[int, ...] = (2, 4)


def draw_outcomes(rng: Draws, state: str, action: str, targets: tuple[str, ...], shape: Shape) -> list[Transition]:
    """The transitions of one action: to all the targets, with random probabilities and rewards."""
    shares, whole = draw_shares(rng, targets, shape)
    return [
        Transition(state, action, target, Fraction(share, whole), rng.whole(-(shape.reward // 2), shape.reward))
        for target, share in zip(targets, shares, strict=True)
    ]


def draw_shares(rng: Draws, targets: tuple[str, ...], shape: Shape) -> tuple[tuple[int, ...], int]:
    """Random probabilities of all the targets: how many parts of the whole each gets, and how many there are."""
    return ((1,), 1) if len(targets) == 1 else rng.shares(len(targets), shape.denominators)


def draw_targets(
    rng: Draws,
    setting: Setting,
    places: tuple[str, ...],
    pair: tuple[str, str],
    shape: Shape,
    barred: str | None = None,
) -> tuple[str, ...]:
    """Where an action leads, as it fits the world, but not to a place that is barred, if it can be helped.

    What is most usual is always among it: no action does nothing for certain, if it can do anything.
    """
    state, action = pair
    possible = setting.reached(places, state, action)
    if barred is not None:
        possible = tuple(place for place in possible if place != barred) or possible
    chosen = rng.sample(possible, 1 + rng.below(min(shape.branches, len(possible))))
    if possible[0] not in chosen:
        chosen = (possible[0], *chosen[1:])
    return tuple([place for place in places if place in chosen])


def draw_model(rng: Draws, setting: Setting, shape: Shape) -> Model:
    """A random model of a world: first actions can lead on, and so to the end; second ones lead back."""
    states = setting.states[: shape.states]
    places = (*states, setting.terminal)
    rows = []
    for state in states:
        for action in setting.actions[: shape.actions]:
            targets = draw_targets(rng, setting, places, (state, action), shape)
            rows += draw_outcomes(rng, state, action, targets, shape)
    ends = (setting.terminal,)
    return Model(story=setting.told(ends), transitions=tuple(rows), terminal=ends)
