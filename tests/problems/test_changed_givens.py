"""A problem file in which anything is changed is solved, or refused in one sentence."""

import copy
import random
from collections.abc import Iterator
from typing import Any

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import rldrill
from rldrill.problems.catalogue import families
from rldrill.problems.errors import UserError

OTHERS = (
    "0", "1", "-1", "2", "1/2", "-7/3", "gamma", "x", "theta", "1-x", "sqrt(2)", "ln 2", "10^9", "1e-9", "", None, [],
    {}, True, 3, "end", "1/0", "nan", [1, 2], [[1]], "0.3333", "a",
)  # fmt: skip


def places(data: Any, before: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Where something stands in it, within whatever else."""
    for key, inner in data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ():
        yield (*before, key)
        yield from places(inner, (*before, key))


def standing(data: Any, place: tuple[Any, ...]) -> Any:
    """What stands there."""
    for key in place:
        data = data[key]
    return data


def change(data: dict[str, Any], choose: random.Random) -> None:
    """Leave something out, repeat it, put it under another name, or put something else in its place."""
    every = list(places(data))
    if not every:
        return
    *within, key = choose.choice(every)
    around, how = standing(data, tuple(within)), choose.randrange(8)
    if how == 0:
        del around[key]
    elif how == 1 and isinstance(around, list):
        around.append(copy.deepcopy(choose.choice(around)))
    elif how == 1:
        around[choose.choice(("zz", "end", "a", "gamma"))] = copy.deepcopy(around[key])
    elif how == 2:
        around[key] = copy.deepcopy(standing(data, choose.choice(every)))
    else:
        around[key] = choose.choice(OTHERS)


@given(st.sampled_from(families()), st.sampled_from((1, 2, 3)), st.integers(0, 99), st.integers(0, 10**9))
@settings(max_examples=80, deadline=None, suppress_health_check=list(HealthCheck))
def test_it_is_solved_or_refused(name: str, level: int, seed: int, key: int) -> None:
    choose = random.Random(key)
    data = rldrill.draw(name, level, seed).data()["given"]
    for _ in range(choose.choice((1, 1, 2))):
        change(data, choose)
    try:
        exercise = rldrill.read({"family": name, "given": data})
    except UserError as error:
        refused = str(error)
    else:
        refused = ""
        assert str(exercise.question())
        assert str(exercise.working())
        exercise.grade({part.label: "1" for part in exercise.parts})
    assert "\n" not in refused
