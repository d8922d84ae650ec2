"""Draws are the same everywhere: the stream is pinned, and so are the problems of every family."""

import json
from collections import Counter
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from draw_pins import fingerprint, pinned
from rldrill.exercise import draw
from rldrill.problems.catalogue import families, family
from rldrill.problems.draws import Draws
from rldrill.problems.errors import UsageError
from rldrill.problems.fractions import Fraction
from rldrill.problems.identity import split_id
from rldrill.solutions.drawing import by_id

GOLDEN = Path(__file__).parent.parent / "golden" / "problems.json"


def test_the_stream_is_that_of_the_documented_generator() -> None:
    # random.Random(n).random() with n the SHA-256 of the key, computed here by itself.
    import hashlib
    import random

    number = int.from_bytes(hashlib.sha256(b"key").digest(), "big")
    reference = random.Random(number)
    assert [Draws("key").below(1000)] == [int(reference.random() * 1000)]


@pytest.mark.parametrize("name", families())
def test_every_family_draws_and_answers_what_the_golden_file_holds(name: str) -> None:
    golden = json.loads(GOLDEN.read_text(encoding="utf-8"))
    drawn = [draw(name, level, seed) for level in family(name).levels for seed in (0, 1)]
    assert [key for key in golden if key.startswith(f"{name}/")] == [exercise.id for exercise in drawn], (
        f"Run 'python tests/golden/write.py {name}' and review its diff."
    )
    for exercise in drawn:
        data, pinned = exercise.data(), golden[exercise.id]
        assert data["given"] == pinned["given"], (
            f"{exercise.id} draws another problem than before. If that is meant, raise the family's REVISION and run "
            f"'python tests/golden/write.py {name}'."
        )
        answers = {part["part"]: part["answer"]["exact"] for part in data["parts"]}
        assert answers == pinned["answers"], f"{exercise.id} has another answer than before."


@pytest.mark.parametrize("name", families())
def test_what_a_family_draws_does_not_change_without_another_revision(name: str) -> None:
    before, now = pinned().get(name), fingerprint(family(name))
    command = f"run 'python tests/shared/draw_pins.py {name}'"
    assert before is not None, command
    if now["draws"] != before["draws"]:
        assert now["revision"] > before["revision"], (
            f"{name} draws other problems than before. If that is meant, raise its REVISION and {command}."
        )
    assert now == before, command


def test_the_golden_file_has_a_line_for_every_problem_and_no_other() -> None:
    golden = json.loads(GOLDEN.read_text(encoding="utf-8"))
    assert {key.partition("/")[0] for key in golden} == set(families())
    assert len(GOLDEN.read_text(encoding="utf-8").splitlines()) == len(golden) + 2


def test_shares_are_a_split_in_whole_numbers() -> None:
    shares, whole = Draws("key").shares(3, (4, 5))
    assert whole in (4, 5)
    assert sum(shares) == whole
    assert Draws("key").split(3, (4, 5)) == tuple(Fraction(share, whole) for share in shares)


@given(st.integers(2, 5), st.text(max_size=5))
def test_a_split_is_a_distribution_without_zeros(parts: int, key: str) -> None:
    chances = Draws(key).split(parts, (2, 4, 5, 10))
    assert len(chances) == parts
    assert sum(chances) == 1
    assert all(chance > 0 for chance in chances)


@given(st.text(max_size=5))
def test_samples_keep_the_order_and_shuffles_keep_the_items(key: str) -> None:
    rng = Draws(key)
    assert list(sample := rng.sample("abcdefg", 3)) == sorted(sample)
    assert Counter(rng.shuffled("abcdefg")) == Counter("abcdefg")
    assert len(set(rng.distinct(4, -2, 3))) == 4


def test_choices_are_even() -> None:
    rng = Draws("even")
    counts = Counter(rng.below(6) for _ in range(6000))
    assert max(abs(count - 1000) for count in counts.values()) < 150  # five standard deviations
    heads = sum(rng.chance(Fraction(3, 4)) for _ in range(4000))
    assert abs(heads - 3000) < 140


def test_neighbouring_seeds_give_different_problems() -> None:
    given_ = [json.dumps(draw("td-zero", 2, seed).problem.data()) for seed in range(40)]
    assert len(set(given_)) == 40


@pytest.mark.parametrize(
    ("text", "fragment"),
    [
        ("nonsense", "not a problem ID"),
        ("td-zero/4/1", "not a problem ID"),
        ("td-zero/1/-1", "not a problem ID"),
        ("no-such/1/1", "no family 'no-such'"),
        ("td-zer/1/1", "did you mean 'td-zero'"),
        ("td-zero/1/1@99", "revision 99"),
        ("td-zero/1/1@0", "revision 0"),
    ],
)
def test_ids_that_are_refused(text: str, fragment: str) -> None:
    with pytest.raises(UsageError, match=fragment):
        by_id(text)


def test_an_id_may_leave_out_its_revision() -> None:
    assert split_id("td-zero/2/7") == ("td-zero", 2, 7, None)
    assert by_id("td-zero/2/7").problem.given == by_id(f"td-zero/2/7@{family('td-zero').revision}").problem.given
