"""Whoever mixes two givens up gets another answer: what might be mixed up is never the same number."""

from fractions import Fraction
from itertools import pairwise
from typing import Any

import pytest

from rldrill.problems.centres import square
from tests.problems.test_promises import drawn

#: Of every reading the hypotheses, the one under which it is the most probable first.
ORDER = {
    "looks open": ("open", "ajar", "closed"), "looks closed": ("closed", "ajar", "open"),
    "wet": ("water", "sand", "rock"), "dry": ("rock", "sand", "water"),
    "quiet": ("sound", "worn", "cracked"), "noisy": ("cracked", "worn", "sound"),
}  # fmt: skip


def test_what_a_sensor_reads_fits_the_story() -> None:
    for given in drawn("bayes-rule", (1, 2, 3), 100):
        for reading, row in given.likelihood.items():
            known = {name: chance for name, chance in row.items() if isinstance(chance, Fraction)}
            chances = [known[name] for name in ORDER.get(reading, ()) if name in known]
            assert all(more > less for more, less in pairwise(chances)), (reading, row)


def test_weights_can_tell_all_policies_apart() -> None:
    for given in drawn("max-margin", (1, 2, 3), 100):
        mus = [given.expert, *(rival.mu for rival in given.policies.values())]
        assert len(set(mus)) == len(mus)


@pytest.mark.parametrize("family", ["rbf", "piecewise-linear-rbf"])
def test_a_plane_is_more_than_a_line(family: str) -> None:
    in_plane = [given for given in drawn(family, (2,), 100) if len(given.position) == 2]
    assert len(in_plane) > 20
    for given in in_plane:
        ways = [[abs(x - y) for x, y in zip(given.position, centre, strict=True)] for centre in given.centres]
        assert any(all(way) for way in ways)  # there neither the greatest nor the sum of both is the distance
        if family == "piecewise-linear-rbf":
            slanted = [(way, square(given.position, centre)) for way, centre in zip(ways, given.centres, strict=True)]
            near = [max(way) < given.width for way, _ in slanted if all(way)]
            assert any(near)  # so that the greatest of both would give another feature


def test_the_parameters_of_a_link_are_different() -> None:
    for given in drawn("denavit-hartenberg", (1,), 100):
        (link,) = given.links
        assert link.theta != link.alpha
        assert link.d != link.a


@pytest.mark.parametrize("family", ["jacobian", "forward-kinematics"])
def test_links_are_not_of_the_same_length_and_joints_not_of_the_same_speed(family: str) -> None:
    for given in drawn(family, (1, 2, 3), 100):
        for numbers in (given.lengths, getattr(given, "rates", None) or ()):
            assert len(set(numbers)) == len(numbers)


def test_velocities_of_joints_are_found_from_a_jacobian_without_zeros() -> None:
    found = [given for given in drawn("jacobian", (3,), 100) if given.velocity]
    assert len(found) > 20
    for given in found:
        assert given.angles[0].number.denominator == 4  # along a diagonal both entries of every link count
        assert given.angles[1].number in (Fraction(1, 2), Fraction(-1, 2))


def scalar(rows: Any) -> Any:
    return rows[0][0]


def test_the_numbers_of_a_scalar_system_are_different() -> None:
    for given in drawn("lqr-gain", (1,), 100):
        assert len({scalar(given.A), scalar(given.B), scalar(given.R)}) == 3
    for given in drawn("lqr-infinite", (1, 2, 3), 100):
        if len(given.A) == 1:
            assert scalar(given.A) != scalar(given.B)
            assert scalar(given.Q) != scalar(given.R)
    for family in ("lqr-reward", "lqr-backward"):
        for given in drawn(family, (1, 2), 100):
            (A,), (B,), (Q,), (R,) = given.A, given.B, given.Q, given.R
            assert scalar(R) not in {Q[i][i] for i in range(len(Q))}
            if len(A) == 1:
                assert scalar(A) != scalar(B)


def test_what_a_first_action_costs_is_not_what_the_first_state_costs() -> None:
    for given in drawn("lqr-reward", (1,), 100):
        assert abs(scalar(given.L[0])) != 1


def test_the_outer_step_of_maml_moves_its_parameter() -> None:
    for given in drawn("maml-step", (1, 2), 100):
        assert sum((1 - given.alpha * task.curvature) ** 2 * task.curvature * (given.theta - task.optimum)
                   for task in given.tasks) != 0  # fmt: skip


def test_level_2_of_apprenticeship_has_something_of_its_own() -> None:
    kinds = set()
    for given in drawn("apprenticeship", (2,), 100):
        assert len(given.expert) == 3 or given.tolerance is not None or given.candidates
        kinds.add((len(given.expert), given.tolerance is not None, bool(given.candidates)))
    assert len(kinds) == 4
