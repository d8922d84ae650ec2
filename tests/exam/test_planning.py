"""An exam as it is planned: its title, and how its versions are called."""

import pytest

from rldrill.exam.planning import plan, version_code
from rldrill.exam.selection import MAX_DRAWN, fresh_seed, sequence
from rldrill.problems.errors import UsageError


def test_a_title_of_120_characters_is_printed() -> None:
    assert plan(("td-zero",), 1, 1, 0, 1, title="x" * 120).title == "x" * 120
    with pytest.raises(UsageError, match=r"The title has 121 characters; give one of at most 120\."):
        plan(("td-zero",), 1, 1, 0, 1, title="x" * 121)


@pytest.mark.parametrize(
    ("index", "code"),
    [(0, "A"), (1, "B"), (25, "Z"), (26, "AA"), (27, "AB"), (51, "AZ"), (52, "BA"), (701, "ZZ"), (702, "AAA")],
)
def test_versions_are_called_as_columns_of_a_sheet(index: int, code: str) -> None:
    assert version_code(index) == code


def test_every_version_has_as_many_problems_as_are_asked_for_and_is_told() -> None:
    done: list[None] = []
    exam = plan(("bellman",), 3, 2, 7, 2, advance=lambda: done.append(None))
    assert [len(version.exercises) for version in exam.versions] == [3, 3]
    assert [version.code for version in exam.versions] == ["A", "B"]
    assert len(done) == 2
    assert (exam.names, exam.level, exam.seed) == (("bellman",), 2, 7)


def test_seeds_can_be_typed_from_paper() -> None:
    assert all(0 <= fresh_seed() < 10**6 for _ in range(20))
    drawn = sequence((), None, 3)
    assert all(0 <= next(drawn)[2] < MAX_DRAWN == 10**6 for _ in range(50))
