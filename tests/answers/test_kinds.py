"""What each kind of answer is in JSON, as typed text and as advice, for one value of each, written down by hand."""

from typing import Any

import pytest
from flint import fmpq, fmpq_mat

from rldrill.problems.parts import Choice, Kind, Matrix, Number, Numbers, Policy, Values, YesNo
from rldrill.solutions.answers.kinds import answer_kind

HALF = fmpq(1, 2)
TIED = {"s": ("l", "r"), "t": ("l",)}


@pytest.mark.parametrize(
    ("kind", "value", "data", "decimals", "typed"),
    [
        (Number(), HALF, "1/2", "0.5", "1/2"),
        (Numbers(("R_0", "R_1")), (HALF, fmpq(3)), ["1/2", "3"], ["0.5", "3"], "1/2, 3"),
        (Matrix(1, 1), fmpq_mat([[HALF]]), [["1/2"]], [["0.5"]], "[1/2]"),
        (Matrix(2, 1), fmpq_mat([[HALF], [2]]), [["1/2"], ["2"]], [["0.5"], ["2"]], "[1/2; 2]"),
        (Values("V", ("s", "t")), {"s": HALF, "t": fmpq(2)}, {"s": "1/2", "t": "2"}, {"s": "0.5", "t": "2"},
         "s: 1/2, t: 2"),
        (Values("Q", (("s", "l"), ("s", "r"))), {("s", "l"): HALF, ("s", "r"): fmpq(2)}, {"s": {"l": "1/2", "r": "2"}},
         {"s": {"l": "0.5", "r": "2"}}, "(s, l): 1/2, (s, r): 2"),
        (Policy({"s": ("l", "r"), "t": ("l",)}), TIED, {"s": ["l", "r"], "t": "l"}, None, "s: l, t: l"),
        (Choice({"a": "one", "b": "two"}), "b", "b", None, "b"),
        (YesNo(), True, "yes", None, "yes"),
    ],
)  # fmt: skip
def test_an_answer_as_json_has_it_and_as_it_is_typed(
    kind: Kind, value: Any, data: Any, decimals: Any, typed: str
) -> None:
    answer = answer_kind(kind)
    assert answer.data(value) == data
    assert answer.decimals(value) == decimals
    assert answer.write(value) == typed


def test_one_action_that_was_typed_and_several_are_the_same_sort_of_value() -> None:
    kind = answer_kind(Policy({"s": ("left", "right"), "t": ("left",)}))
    assert kind.value({"s": "left", "t": ["left", "right"]}) == {"s": ("left",), "t": ("left", "right")}


def test_one_entry_is_typed_as_a_number_and_more_as_rows() -> None:
    assert answer_kind(Matrix(1, 1)).how_to_type() == "a number: 3/4 or 0.75"
    for rows, columns in ((1, 2), (2, 1), (2, 2)):
        assert answer_kind(Matrix(rows, columns)).how_to_type().startswith(f"{rows} × {columns}, ")
