"""Numbers of books, read off backup diagrams."""

from typing import Any

from flint import fmpq

import rldrill


def value(**given: Any) -> Any:
    return rldrill.read({"family": "backup-diagram-value", "given": given}).solve()["a"]


def test_the_centre_of_the_gridworld() -> None:
    # Sutton & Barto 2018, exercise 3.14 with figure 3.2: the centre has the neighbours +2.3, +0.4, −0.4 and +0.7,
    # moves are equally probable and pay nothing, γ = 0.9. 0.9 · (2.3 + 0.4 − 0.4 + 0.7)/4 = 0.675, printed as +0.7.
    neighbours = {"north": "2.3", "east": "0.4", "south": "-0.4", "west": "0.7"}
    rows = [["centre", f"go {side}", side, 1, 0] for side in neighbours]
    policy = {"centre": {f"go {side}": "1/4" for side in neighbours}}
    found = value(dynamics={"transitions": rows}, policy=policy, values=neighbours, gamma="0.9")
    assert found == fmpq(27, 40)


def test_the_recycling_robot_when_it_is_optimal() -> None:
    # Sutton & Barto 2018, example 3.9: v*(h) = max{r_s + γ[α v*(h) + (1 − α) v*(l)]; r_w + γ v*(h)}, here with
    # α = 1/2, γ = 1/2, r_s = 2, r_w = 1, v*(h) = 4 and v*(l) = 2 below: max{2 + 1/2 · 3; 1 + 1/2 · 4} = 7/2.
    rows = [["now high", "search", "high", "1/2", 2], ["now high", "search", "low", "1/2", 2],
            ["now high", "wait", "high", 1, 1]]  # fmt: skip
    assert value(dynamics={"transitions": rows}, values={"high": 4, "low": 2}, gamma="1/2") == fmpq(7, 2)
