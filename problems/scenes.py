"""Where robots believe, move and sense: states in a line, two actions along it, and two readings."""

from msgspec import Struct

from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, Scalar
from rldrill.problems.fractions import Fraction


class Scene(Struct, frozen=True):
    """A place: its states in their order, the action that goes up this order and the one that goes down.

    The first of the readings becomes more probable up this order, less probable, or as it comes: ``trend`` is 1, −1, 0.
    """

    told: str
    states: tuple[str, ...]
    up: str
    down: str
    readings: tuple[str, str]
    trend: int


SCENES = (
    Scene(
        "A robot pushes and pulls a door.",
        ("closed", "ajar", "half open", "open"), "push", "pull", ("light", "no light"), 1,
    ),
    Scene(
        "A robot does not know where in a corridor it is.",
        ("west", "middle", "bend", "east"), "right", "left", ("door", "wall"), 0,
    ),
    Scene(
        "A rover goes down into a crater and up again.",
        ("rim", "slope", "ledge", "floor"), "descend", "climb", ("bright", "dark"), -1,
    ),
    Scene(
        "A machine wears while it runs; a mechanic can repair it.",
        ("sound", "worn", "rattling", "cracked"), "run", "repair", ("noisy", "quiet"), 1,
    ),
    Scene(
        "A robot rides in a lift without a display.",
        ("cellar", "ground", "first", "roof"), "up", "down", ("warm", "cold"), 1,
    ),
)  # fmt: skip


def draw_motion(
    scene: Scene, states: tuple[str, ...], success: tuple[Scalar, Scalar]
) -> dict[str, dict[str, dict[str, Scalar]]]:
    """Both actions: each leads to the neighbouring state with its success probability, else nowhere.

    Args:
        scene: the place.
        states: those of its states that there are.
        success: how probably going up and going down succeed.
    """
    return {
        action: {state: _onward(states, state, index + step, chance) for index, state in enumerate(states)}
        for action, step, chance in ((scene.up, 1, success[0]), (scene.down, -1, success[1]))
    }


def _onward(states: tuple[str, ...], state: str, target: int, chance: Scalar) -> dict[str, Scalar]:
    if not 0 <= target < len(states):
        return {state: Fraction(1)}
    failure = Parameter(f"1-{chance}") if isinstance(chance, Parameter) else 1 - chance
    return {state: failure, states[target]: chance} if failure else {states[target]: chance}


_CHANCES = ("1/4", "1/2", "3/4", "1/5", "4/5", "1/10", "9/10")


def draw_sensor(scene: Scene, states: tuple[str, ...], rng: Draws, *chances: str) -> dict[str, dict[str, Fraction]]:
    """How probable the two readings are in every state, not the same in all states; ``chances`` are drawn from."""
    while True:
        drawn = [rng.fraction(*(chances or _CHANCES)) for _ in states]
        if len(set(drawn)) > 1:
            in_order = sorted(drawn, reverse=scene.trend < 0) if scene.trend else drawn
            first = dict(zip(states, in_order, strict=True))
            return {scene.readings[0]: first, scene.readings[1]: {state: 1 - chance for state, chance in first.items()}}
