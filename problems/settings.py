"""The little worlds in which problems are set, and random models of them."""

import tomllib
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from pathlib import Path

from rldrill.problems.draws import Draws
from rldrill.problems.models import Model, Transition


@dataclass(frozen=True, slots=True)
class Setting:
    """A world: what it is about, its states, the one in which it ends, and the actions."""

    story: str
    states: tuple[str, ...]
    terminal: str
    actions: tuple[str, ...]


@cache
def settings() -> tuple[Setting, ...]:
    """All worlds, from ``worlds.toml``."""
    with (Path(__file__).parent / "worlds.toml").open("rb") as file:
        worlds = tomllib.load(file)["world"]
    return tuple(
        Setting(world["story"], tuple(world["states"]), world["terminal"], tuple(world["actions"])) for world in worlds
    )


def draw_setting(rng: Draws) -> Setting:
    """One of the worlds."""
    return rng.choice(settings())


@dataclass(frozen=True, slots=True)
class Shape:
    """How large a random model is.

    Args:
        states: states in which an action is taken.
        actions: actions in each of them.
        branches: how many next states an action may have at most.
        reward: the largest reward; rewards are whole numbers from minus half of it.
        ends: whether there is a terminal state that can be reached from everywhere.
    """

    states: int
    actions: int
    branches: int
    reward: int = 6
    ends: bool = True
    denominators: tuple[int, ...] = (2, 4)


def draw_outcomes(rng: Draws, state: str, action: str, targets: tuple[str, ...], shape: Shape) -> list[Transition]:
    """The transitions of one action: to all the targets, with random probabilities and rewards."""
    chances = (Fraction(1),) if len(targets) == 1 else rng.split(len(targets), shape.denominators)
    return [
        Transition(state, action, target, chance, rng.whole(-(shape.reward // 2), shape.reward))
        for target, chance in zip(targets, chances, strict=True)
    ]


def draw_model(rng: Draws, setting: Setting, shape: Shape) -> Model:
    """A random model of a world: first actions can lead on, and so to the end; second ones can lead back."""
    states = setting.states[: shape.states]
    ends = (setting.terminal,) if shape.ends else ()
    everything = (*states, *ends)
    rows = []
    for index, state in enumerate(states):
        onward = everything[index + 1] if index + 1 < len(everything) else states[0]
        wanted = (onward, states[0])
        for number, action in enumerate(setting.actions[: shape.actions]):
            targets = rng.sample(everything, 1 + rng.below(min(shape.branches, len(everything))))
            if number < len(wanted) and wanted[number] not in targets:
                targets = tuple(target for target in everything if target in (wanted[number], *targets[1:]))
            rows += draw_outcomes(rng, state, action, targets, shape)
    return Model(story=setting.story, transitions=tuple(rows), terminal=ends)
