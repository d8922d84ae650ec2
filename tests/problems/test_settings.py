"""The worlds of the problems: what is drawn in one keeps to what its words say."""

from collections import defaultdict
from collections.abc import Iterator
from itertools import pairwise

import pytest

from rldrill.exercise import draw
from rldrill.problems.catalogue import selection
from rldrill.problems.draws import Draws
from rldrill.problems.settings import Setting, draw_moves, draw_visits, draw_way, in_order, maps, possible, settings
from rldrill.problems.transition_tables import ALONE

#: An action that is none: what happens without one.
UNNAMED = ""
#: A state, an action, where it leads, and with what probability.
Leads = tuple[str, str, str, object]

#: Families whose states are the places of maps, which have no order.
MAPPED = ("expected-return", "principle-of-optimality")
FAMILIES = [family.name for family in selection([]) if family.name not in MAPPED]


def _leads(data: object) -> Iterator[Leads]:
    """All that a problem's givens say about where something leads, wherever it stands in them."""
    if isinstance(data, list):
        for item in data:
            match item:
                case [str(state), str(action), str(after), chance, _] if _known(state, action, after):
                    yield state, action, after, chance
                case [str(state), str(action), str(after), *_] if _known(state, action, after):
                    yield state, action, after, None
                case [str(state), str(action), _, str(after)] if _known(state, action, after):
                    yield state, action, after, None
                case [str(state), str(after), _] if _known(state, UNNAMED, after):
                    yield state, UNNAMED, after, None
                case _:
                    yield from _leads(item)
    if isinstance(data, dict):
        states = data.get("states")
        if isinstance(states, list) and len(states) > 1 and _known(states[0], UNNAMED, states[1]):
            actions = data.get("actions") or [UNNAMED] * len(states)
            yield from ((s, a, after, None) for (s, after), a in zip(pairwise(states), actions, strict=False))
        for value in data.values():
            yield from _leads(value)


def _known(state: str, action: str, after: str) -> bool:
    return any(
        state in world.states
        and after in (*world.states, world.terminal)
        and action in (*world.actions, ALONE, UNNAMED)
        for world in settings()
    )


def _world(state: str) -> Setting:
    return next(world for world in settings() if state in world.states)


def _places(state: str) -> Iterator[tuple[str, ...]]:
    """What may be all places of a small model that has the state."""
    world = _world(state)
    for end in range(world.states.index(state) + 1, len(world.states) + 1):
        yield from ((*world.states[:end], *last) for last in ((), (world.terminal,)))


@pytest.mark.parametrize("name", FAMILIES)
def test_what_is_drawn_keeps_to_what_the_words_of_its_world_say(name: str) -> None:
    for level in (1, 2, 3):
        for seed in range(2):
            rows: dict[tuple[str, str], list[tuple[str, object]]] = defaultdict(list)
            for state, action, after, chance in _leads(draw(name, level, seed).data()["given"]):
                rows[state, action].append((after, chance))
            for (state, action), outcomes in rows.items():
                for after, chance in outcomes:
                    said = f"{name}/{level}/{seed}: {action} leads from {state} to {after}"
                    assert any(after in _world(state).reached(places, state, action) for places in _places(state)), said
                    if after == state and chance in (None, 1) and max(steps := _world(state).steps(action)) < 0:
                        assert state == _world(state).states[0], f"{said}, although it leads {steps} states on"


def test_no_certain_action_does_nothing() -> None:
    # Only the outer places hold somebody: an action that leads back stays in the first state.
    for name in ("policy-iteration", "optimal-value", "policy-improvement", "value-iteration", "bellman-residual"):
        for level in (1, 2, 3):
            for seed in range(20):
                for state, action, after, chance in _leads(draw(name, level, seed).data()["given"]):
                    if after == state and chance == 1:
                        world = _world(state)
                        assert (max(world.steps(action)) < 0, state) == (True, world.states[0]), (name, level, seed)


@pytest.mark.parametrize("visits", ["aba.", "abab", "aab.", "abac.", "abca.", "abcba", "abcd", "abb."])
def test_a_run_without_actions_goes_where_its_world_goes_by_itself(visits: str) -> None:
    for key in map(str, range(40)):
        world, states = draw_visits(Draws(key), visits)
        places = (*world.states, world.terminal)
        for here, after in pairwise(map(places.index, states)):
            assert after - here in (*world.alone, 0)
        assert not (world.terminal == "broken" and "ba" in visits)  # nothing mends itself


def test_a_run_takes_actions_that_lead_on_as_it_goes() -> None:
    (world,) = [world for world in settings() if world.terminal == "broken"]
    for key in map(str, range(20)):
        states, actions = draw_way(Draws(key), world, "aba.", ("run", "repair"), same=True)
        assert states[0] == states[2]
        assert actions == ("run", "repair", "run")  # nothing is mended by running it, and nothing breaks by repair


def test_what_no_action_can_do_is_not_possible() -> None:
    (world,) = [world for world in settings() if world.terminal == "overheated"]
    assert not possible(world, (("a", "."),), ("slow",))
    assert not possible(
        world, (("a", "b"), ("a", "a")), ("slow",)
    )  # only a cool car stays as it is, and it gets no cooler
    assert draw_moves(Draws("one"), world, (("a", "."),), ("fast",))[0]["a"] in ("hot", "smoking")


def test_states_stand_in_the_order_of_their_world() -> None:
    assert in_order(("empty", "low", "high", "low")) == ("high", "low")


def test_every_world_has_names_of_its_own() -> None:
    states = [state for world in settings() for state in (*world.states, world.terminal)]
    assert len(states) == len(set(states))
    assert all(len(place.states) == 4 and len(place.actions) == 2 for place in maps())
