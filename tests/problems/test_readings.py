"""Numbers that programs wrote are read as the fractions that they round, and somebody is told."""

from typing import Any

import pytest

import rldrill
from rldrill.problems.catalogue import family
from rldrill.problems.errors import FileError
from rldrill.problems.exact import read_fraction
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.readings import distribution, meant, told


@pytest.mark.parametrize(
    ("written", "value"),
    [
        (0.1 + 0.2, "3/10"),
        (1 - 0.9, "1/10"),
        (1 / 3, "1/3"),
        ("0.6666666666666666", "2/3"),
        ("0.8999999999999999", "9/10"),
        ("-1.3333333333333333", "-4/3"),
        (33.333333333333336, "100/3"),
        ("0.99999999999999989", "1"),
        (1 - 0.9 - 0.1, "0"),  # -2.7755575615628914e-17
        # What a person may have meant to the digit, or what is near no simple fraction.
        ("0.333", "333/1000"),
        ("0.33333333", "33333333/100000000"),
        ("1/3", "1/3"),
        ("0.7310585786300049", "7310585786300049/10000000000000000"),
        ("1.4142135623730951", "14142135623730951/10000000000000000"),
        ("123456789012345.6", "617283945061728/5"),
    ],
)
def test_a_number(written: str | float, value: str) -> None:
    assert meant(written, read_fraction(written), lambda _: None) == fraction_of(value)


@pytest.mark.parametrize(
    ("written", "read"),
    [
        (["0.333333333"] * 3, ["1/3"] * 3),
        (["0.1428571428571429"] * 7, ["1/7"] * 7),
        (["0.5", "0.5"], ["1/2", "1/2"]),
        (["0.333", "0.667"], ["333/1000", "667/1000"]),
        (["0.33", "0.66"], ["33/100", "33/50"]),  # misses 1: left as it is, to be refused
        # No simple fractions: the largest is what the other leaves.
        (["0.3745401188473625", "0.6254598811526374"], ["0.3745401188473625", "0.6254598811526375"]),
    ],
)
def test_a_distribution(written: list[str], read: list[str]) -> None:
    chances = {number: fraction_of(text) for number, text in enumerate(written)}
    assert list(distribution(chances, lambda _: None).values()) == [fraction_of(text) for text in read]


THIRD, TWO_THIRDS = "0.3333333333333333", "0.6666666666666666"
NEXT: dict[str, Any] = {"a": 1, "b": 0}


@pytest.mark.parametrize(
    ("name", "given"),
    [
        ("bayes-rule", {"prior": {"a": 1 / 3, "b": 2 / 3}, "measurements": ["z"],
                        "likelihood": {"z": {"a": THIRD, "b": 1}, "y": {"a": TWO_THIRDS, "b": 0}}}),
        ("bayes-predict", {"belief": {"a": THIRD, "b": TWO_THIRDS}, "actions": ["go"],
                           "motion": {"go": {"a": {"a": THIRD, "b": TWO_THIRDS}, "b": NEXT}}}),
        ("policy-value", {"mdp": {"transitions": [["a", "go", "b", THIRD, 1], ["a", "go", "c", TWO_THIRDS, 1],
                                                  ["a", "no", "b", 1, 0]], "terminal": ["b", "c"]},
                          "gamma": 1, "policy": {"a": {"go": THIRD, "no": TWO_THIRDS}}}),
        ("optimal-value", {"mdp": {"grid": ".G", "rewards": {"G": 1}, "slip": TWO_THIRDS, "step": "-" + THIRD},
                           "gamma": 1}),
    ],
)  # fmt: skip
def test_wherever_probabilities_stand_the_reading_is_told(name: str, given: dict[str, Any]) -> None:
    notes: list[str] = []
    read = family(name).read(given, notes.append)
    assert "read 0.6666666666666666 as 2/3" in notes
    assert "33333" not in str(read.model_dump(mode="json"))


def test_an_exercise_says_what_was_read() -> None:
    given = {"rewards": [1, 1], "gamma": 0.1 + 0.2}
    exercise = rldrill.read({"family": "return", "given": given})
    assert exercise.notes == ("read 0.30000000000000004 as 3/10",)
    assert exercise.answers()["a"] == (Fraction(13, 10), 1)


@pytest.mark.parametrize(("chances", "total"), [([0.3, 0.6], "9/10"), (["0.33333333"] * 3, "0.99999999")])
def test_what_misses_1_by_more_is_refused_with_the_sum(chances: list[Any], total: str) -> None:
    prior = dict(zip("abc", chances, strict=False))
    given = {"prior": prior, "likelihood": {"z": dict.fromkeys(prior, 1)}, "measurements": ["z"]}
    with pytest.raises(FileError, match=rf"given\.prior: the probabilities sum to {total}, not to 1"):
        family("bayes-rule").read(given)


def test_a_number_is_told_as_a_fraction_up_to_a_thousandth() -> None:
    assert told(Fraction(1, 1000)) == "1/1000"
    assert told(Fraction(1, 1001)).startswith("0.000999000999")
