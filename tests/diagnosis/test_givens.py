"""One thing of what is given read wrongly, on a run that is small enough to list by hand."""

from fractions import Fraction
from typing import Any, NamedTuple

import pytest
from pydantic import BaseModel, ConfigDict, Field

import rldrill
from rldrill.problems.catalogue import selection
from rldrill.problems.exact import Exact
from rldrill.problems.family import Family
from rldrill.solutions.diagnosis.givens import misread, ordinal
from rldrill.solutions.drawing import draw

# V(cave) = 8, V(floor) = 10, V(rim) = 6, rewards 7, −3 and 5, α = 1/4, γ = 1/2.
RUN = {
    "family": "td-zero",
    "given": {
        "trajectory": {"states": ["cave", "floor", "cave", "rim"], "rewards": [7, -3, 5]},
        "values": {"cave": 8, "floor": 10, "rim": 6},
        "alpha": "1/4",
        "gamma": "1/2",
    },
}


def read_as(kind: str) -> list[Any]:
    """The givens that are read so, in their order."""
    return [each.given for each in misread(rldrill.read(RUN).problem.given) if each.kind == kind]


def test_a_share_is_taken_for_its_complement() -> None:
    assert {(given.alpha, given.gamma) for given in read_as("complement")} == {
        (Fraction(3, 4), Fraction(1, 2)),
        (Fraction(1, 4), Fraction(1, 2)),  # 1 − γ is γ
    }


def test_neighbours_in_a_list_are_exchanged_and_the_rest_stays() -> None:
    assert [given.trajectory.rewards for given in read_as("entries-exchanged")][-2:] == [(-3, 7, 5), (7, 5, -3)]


def test_rows_and_rates_are_exchanged() -> None:
    values = [tuple(given.values[state] for state in ("cave", "floor", "rim")) for given in read_as("rows-exchanged")]
    assert values == [(10, 8, 6), (6, 10, 8), (8, 6, 10)]
    assert [(given.alpha, given.gamma) for given in read_as("givens-exchanged")] == [(Fraction(1, 2), Fraction(1, 4))]


def test_a_minus_is_lost() -> None:
    assert [given.trajectory.rewards for given in read_as("minus-lost")] == [(7, 3, 5)]


class Row(NamedTuple):
    name: str
    share: Exact
    pay: Exact


class Exactly(BaseModel):
    model_config = ConfigDict(arbitrary_types_allowed=True)


class Inner(BaseModel):
    count: int


class Small(Exactly):
    steps: int = Field(ge=1)
    share: Exact
    drift: Exact
    flag: bool
    table: dict[str, Exact]
    rewards: tuple[Exact, ...]
    rows: tuple[Row, ...]
    matrix: tuple[tuple[Exact, ...], ...]
    inner: dict[str, Inner]


SMALL = {
    "steps": 1, "share": "1/4", "drift": -2, "flag": True, "table": {"a": 3, "b": -1}, "rewards": (5, -4, -4),
    "rows": (("x", "1/2", -3), ("y", 1, 2)), "matrix": ((1, 2), (3, -4)), "inner": {"u": {"count": 7}},
}  # fmt: skip

#: Everything that can be read wrongly there: neither 0 steps, nor −2 or a quarter of one, make a problem.
READ_WRONGLY = [
    ("givens-exchanged", "share and drift", {"share": -2, "drift": "1/4"}),
    ("one-too-many", "steps", {"steps": 2}),
    ("complement", "share", {"share": "3/4"}),
    ("minus-lost", "drift", {"drift": 2}),
    ("minus-lost", "the table of b", {"table": {"a": 3, "b": 1}}),
    ("rows-exchanged", "table of a and b", {"table": {"a": -1, "b": 3}}),
    ("reversed", "rewards", {"rewards": (-4, -4, 5)}),
    ("entry-left-out", "first of the rewards", {"rewards": (-4, -4)}),
    ("entries-exchanged", "rewards, first and second", {"rewards": (-4, 5, -4)}),
    ("entry-left-out", "second of the rewards", {"rewards": (5, -4)}),
    ("minus-lost", "the second of the rewards", {"rewards": (5, 4, -4)}),
    ("entry-left-out", "third of the rewards", {"rewards": (5, -4)}),
    ("minus-lost", "the third of the rewards", {"rewards": (5, -4, 4)}),
    ("reversed", "rows", {"rows": (("y", 1, 2), ("x", "1/2", -3))}),
    ("entry-left-out", "first of the rows", {"rows": (("y", 1, 2),)}),
    ("minus-lost", "the first row of the rows", {"rows": (("x", "1/2", 3), ("y", 1, 2))}),
    ("givens-exchanged", "first row of the rows", {"rows": (("x", -3, "1/2"), ("y", 1, 2))}),
    ("entry-left-out", "second of the rows", {"rows": (("x", "1/2", -3),)}),
    ("givens-exchanged", "second row of the rows", {"rows": (("x", "1/2", -3), ("y", 2, 1))}),
    ("rows-and-columns", "matrix", {"matrix": ((1, 3), (2, -4))}),
    ("reversed", "matrix", {"matrix": ((3, -4), (1, 2))}),
    ("entry-left-out", "first of the matrix", {"matrix": ((3, -4),)}),
    ("givens-exchanged", "first row of the matrix", {"matrix": ((2, 1), (3, -4))}),
    ("entry-left-out", "second of the matrix", {"matrix": ((1, 2),)}),
    ("minus-lost", "the second row of the matrix", {"matrix": ((1, 2), (3, 4))}),
    ("givens-exchanged", "second row of the matrix", {"matrix": ((1, 2), (-4, 3))}),
    ("one-too-many", "count of u", {"inner": {"u": {"count": 8}}}),
    ("one-too-few", "count of u", {"inner": {"u": {"count": 6}}}),
]


def test_everything_is_read_wrongly_once() -> None:
    found = [(each.kind, each.what, each.given) for each in misread(Small(**SMALL))]
    assert found == [(kind, what, Small(**{**SMALL, **other})) for kind, what, other in READ_WRONGLY]


def test_equal_numbers_are_not_exchanged_and_a_share_is_between_0_and_1() -> None:
    other = {"share": 1, "drift": 1, "table": {"a": 3, "b": 3}, "rewards": (2,), "rows": (), "matrix": ((1, 1), (0, 0))}
    assert [(each.kind, each.what) for each in misread(Small(**{**SMALL, **other}))] == [
        ("one-too-many", "steps"),
        ("rows-and-columns", "matrix"),
        ("reversed", "matrix"),
        ("entry-left-out", "first of the matrix"),
        ("entry-left-out", "second of the matrix"),
        ("one-too-many", "count of u"),
        ("one-too-few", "count of u"),
    ]


class Features(Exactly):
    """A few numbers for every state."""

    features: dict[str, tuple[Exact, ...]]


def test_a_number_is_read_in_the_row_beside_its_own() -> None:
    given = Features(features={"bay": (1, 2), "reef": (1, 5), "cape": (7, 5)})
    found = {each.what: each.given.features for each in misread(given) if each.kind == "another-cell"}
    read = "is read for that of {} in the features"
    assert found == {
        f"the second number of reef {read.format('bay')}": {"bay": (1, 5), "reef": (1, 5), "cape": (7, 5)},
        f"the second number of bay {read.format('reef')}": {"bay": (1, 2), "reef": (1, 2), "cape": (7, 5)},
        f"the first number of cape {read.format('reef')}": {"bay": (1, 2), "reef": (7, 5), "cape": (7, 5)},
        f"the first number of reef {read.format('cape')}": {"bay": (1, 2), "reef": (1, 5), "cape": (1, 5)},
    }


class Pages(Exactly):
    """One matrix for every time."""

    matrices: tuple[tuple[tuple[Exact, ...], ...], ...]


@pytest.mark.parametrize(
    ("matrices", "turned"),
    [
        ((((1, 2), (3, 4)),), [(((1, 3), (2, 4)),)]),
        ((((1, 2), (3, 4)), ((5, 6), (6, 5))), [(((1, 3), (2, 4)), ((5, 6), (6, 5)))]),
        ((((1, 2), (2, 1)),), []),  # the same, turned
        ((((1, 2),),), []),  # not square
    ],
)
def test_rows_are_read_as_columns_in_the_matrices_of_all_times(matrices: Any, turned: list[Any]) -> None:
    found = [each.given for each in misread(Pages(matrices=matrices)) if each.kind == "rows-and-columns"]
    assert found == [Pages(matrices=other) for other in turned]


# Nothing is measured in the second step, which the robot rests in.
FILTER = {
    "family": "bayes-filter",
    "given": {
        "belief": {"open": "1/2", "shut": "1/2"},
        "motion": {
            "push": {"open": {"open": 1}, "shut": {"open": "3/5", "shut": "2/5"}},
            "rest": {"open": {"open": 1}, "shut": {"shut": 1}},
        },
        "likelihood": {"light": {"open": "4/5", "shut": "1/5"}, "dark": {"open": "1/5", "shut": "4/5"}},
        "run": [{"action": "push", "measurement": "light"}, {"action": "rest"}],
    },
}


def test_an_entry_is_taken_over_from_the_row_above() -> None:
    given = rldrill.read(FILTER).problem.given
    found = [(each.what, each.given.run[1]) for each in misread(given) if each.kind == "as-above"]
    assert [(what, event.action, event.measurement) for what, event in found] == [
        ("action of the second of the steps of the run", "push", None),
        ("measurement of the second of the steps of the run", "rest", "light"),
    ]


# At the exit 8 is earned, or 4.
LINE = {
    "family": "policy-value",
    "given": {
        "gamma": "1/2",
        "mdp": {
            "transitions": [
                ["hall", "go", "room", "1/2", 2],
                ["hall", "go", "exit", "1/2", 4],
                ["room", "go", "exit", 1, 8],
            ],
            "terminal": ["exit"],
        },
        "policy": {"hall": {"go": 1}, "room": {"go": 1}},
    },
}


def test_rewards_at_the_end_are_taken_for_worthless() -> None:
    exercise = rldrill.read(LINE)
    (unpaid,) = [each.given for each in misread(exercise.problem.given) if each.kind == "end-unpaid"]
    assert [row.reward for row in unpaid.mdp.transitions] == [2, 0, 0]
    # V(room) = 0, V(hall) = 1/2 · (2 + 0), where V(room) = 8 and V(hall) = 1/2 · (2 + 4) + 1/2 · 4 = 5 are right.
    said = exercise.diagnose("hall: 1, room: 0", "a").sentence
    assert "the rewards for reaching a terminal state are left out" in said


@pytest.mark.parametrize("family", selection([]), ids=lambda family: family.name)
def test_what_was_misread_is_said_so_that_it_is_one_thing(family: Family) -> None:
    for level in family.levels:
        found: dict[tuple[str, str], Any] = {}
        for each in misread(draw(family.name, level, 101).problem.given):
            if "row of" not in each.what:  # two numbers of one row
                assert found.setdefault((each.kind, each.what), each.given) == each.given


class Tables(Exactly):
    features: dict[str, tuple[Exact, ...]] = {}
    ways: dict[str, dict[str, Exact]] = {}


def test_a_table_is_read_by_columns_and_two_numbers_of_a_row_are_exchanged() -> None:
    given = Tables(features={"a": (1, 2), "b": (3, 3)}, ways={"u": {"u": 4, "v": 5}, "v": {"u": 6, "v": 7}})
    found = {each.what: each.given for each in misread(given) if each.kind == "rows-and-columns"}
    assert found["features"].features == {"a": (1, 3), "b": (2, 3)}
    assert found["ways"].ways == {"u": {"u": 4, "v": 6}, "v": {"u": 5, "v": 7}}
    (one,) = [each for each in misread(given) if each.what == "features of a, first and second"]
    assert one.given.features == {"a": (2, 1), "b": (3, 3)}
    # What is no square has no columns in the place of rows.
    wide = Tables(features={"a": (1, 2, 3), "b": (4, 5, 6)}, ways={"u": {"v": 4}, "v": {"u": 6}})
    assert not [each for each in misread(wide) if each.kind == "rows-and-columns"]


def test_a_share_in_a_table_is_taken_for_its_complement_or_read_in_the_other_row() -> None:
    given = Tables(ways={"on": {"u": "1/2", "v": "1/4"}, "off": {"u": "1/3", "v": 1}})
    found = {(each.kind, each.what): each.given for each in misread(given)}
    turned = Tables(ways={"on": {"u": "1/2", "v": "3/4"}, "off": {"u": "1/3", "v": 1}})
    assert found["complement", "ways of v at on"] == turned
    other = Tables(ways={"on": {"u": "1/2", "v": 1}, "off": {"u": "1/3", "v": "1/4"}})
    assert found["rows-exchanged", "ways of on and off at v"] == other
    assert not [what for kind, what in found if kind == "complement" and what.endswith("v at off")]


class List(BaseModel):
    numbers: tuple[int, ...]


def test_of_a_list_of_more_than_24_nothing_is_tried() -> None:
    left_out = [each.what for each in misread(List(numbers=(0,) * 24)) if each.kind == "entry-left-out"]
    assert left_out[8:12] == ["ninth of the numbers", "tenth of the numbers", "11th of the numbers",
                              "12th of the numbers"]  # fmt: skip
    assert len(left_out) == 24
    assert not list(misread(List(numbers=(0,) * 25)))


@pytest.mark.parametrize(("place", "word"), [
    (0, "first"), (9, "tenth"), (10, "11th"), (11, "12th"), (12, "13th"), (20, "21st"), (21, "22nd"), (22, "23rd"),
    (110, "111th"), (120, "121st"),
])  # fmt: skip
def test_places_are_counted_as_people_count(place: int, word: str) -> None:
    assert ordinal(place) == word
