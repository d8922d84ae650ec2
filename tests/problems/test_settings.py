"""The worlds of the problems: what is drawn in one keeps to what its words say."""

from collections.abc import Iterator

import pytest

from rldrill.exercise import draw
from rldrill.problems.draws import Draws
from rldrill.problems.settings import Setting, Shape, draw_model, draw_moves, draw_way, possible, settings

#: Families whose transitions have a world's action between two of its states.
WITH_ACTIONS = (
    "q-learning", "sarsa", "expected-sarsa", "double-q-learning", "sarsa-lambda", "sarsa-versus-q-learning", "dyna-q",
    "importance-sampling", "reinforce", "reinforce-baseline", "actor-critic", "advantage", "policy-iteration",
    "optimal-value", "action-value", "bellman-backup", "value-iteration", "policy-improvement",
)  # fmt: skip


def _transitions(data: object) -> Iterator[tuple[str, str, str]]:
    """All that a problem's givens say about where an action leads, wherever it stands in them."""
    if isinstance(data, list):
        for item in data:
            match item:
                case [str(state), str(action), *rest] if rest:
                    named = {*_world(state).states, _world(state).terminal}
                    yield from ((state, action, after) for after in rest[:2] if after in named)
                case _:
                    yield from _transitions(item)
    if isinstance(data, dict):
        if "states" in data and data.get("actions"):
            yield from zip(data["states"], data["actions"], data["states"][1:], strict=False)
        for value in data.values():
            yield from _transitions(value)


def _world(state: str) -> Setting:
    return next(world for world in settings() if state in world.states)


@pytest.mark.parametrize("name", WITH_ACTIONS)
def test_an_action_leads_only_where_its_world_lets_it_lead(name: str) -> None:
    for level in (1, 2, 3):
        for seed in range(5):
            for state, action, after in _transitions(draw(name, level, seed).data()["given"]):
                world = _world(state)
                places = [world.states[:end] for end in range(2, len(world.states) + 1)]
                reached = [after in world.reached((*some, *end), state, action)
                           for some in places if state in some for end in ((), (world.terminal,))]  # fmt: skip
                assert any(reached), f"{name}/{level}/{seed}: {action} leads from {state} to {after}"


def test_a_run_takes_actions_that_lead_on_as_it_goes() -> None:
    (world,) = [world for world in settings() if world.terminal == "broken"]
    for key in map(str, range(20)):
        states, actions = draw_way(Draws(key), world, "aba.", ("run", "repair"), same=True)
        assert states[0] == states[2]
        assert actions == ("run", "repair", "run")  # nothing is mended by running it, and nothing breaks by repair


@pytest.mark.parametrize("world", settings(), ids=lambda world: world.terminal)
def test_no_action_keeps_the_last_state_of_an_endless_model_for_ever(world: Setting) -> None:
    for key in map(str, range(20)):
        model = draw_model(Draws(key), world, Shape(states=2, actions=2, branches=1, ends=False))
        first, last = model.states
        assert {row.next for row in model.transitions if row.state == last} == {first}


def test_what_no_action_can_do_is_not_possible() -> None:
    (world,) = [world for world in settings() if world.terminal == "overheated"]
    assert not possible(world, (("a", "."),), ("slow",))
    assert draw_moves(Draws("one"), world, (("a", "."),), ("fast",))[0]["a"] in ("hot", "smoking")
