"""What is said of givens of the wrong form: one sentence that names the field and says what to do."""

import json
import re
from collections.abc import Iterator
from copy import deepcopy
from typing import Annotated, Any, Literal

import pytest
from pydantic import Field, TypeAdapter, ValidationError

from rldrill.problems.catalogue import families, family
from rldrill.problems.complaints import nearest, sentence
from rldrill.problems.errors import FileError
from rldrill.problems.family import Givens
from rldrill.solutions.drawing import draw


class Inner(Givens):
    depth: int = 0


class Toy(Givens):
    few: tuple[int, ...] = Field(default=(1, 2), min_length=2, max_length=3)
    some: dict[str, int] = Field(default={"a": 1}, min_length=1, max_length=1)
    word: str = Field(default="abc", min_length=1, max_length=5)
    sign: str = Field(default="a", pattern=r"^[^\\]*$")
    size: int = Field(default=1, ge=1, le=9)
    open: float = Field(default=0.5, gt=0, lt=1)
    kind: Literal["one", "two"] = "one"
    told: bool = False
    inner: Inner = Inner()
    inners: tuple[Inner, ...] = ()
    named: dict[Annotated[str, Field(max_length=3)], int] = Field(default={})


def complaint(given: object) -> str:
    adapter = TypeAdapter(Toy)
    with pytest.raises(ValidationError) as refused:
        adapter.validate_python(given)
    return sentence(refused.value, adapter.json_schema(), family="toy", tagged=False)


LISTED = "the fields there are few, some, word, sign, size, open, kind, told, inner, inners, named"


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"few": []}, "given.few: is empty; it needs at least 2 entries."),
        ({"few": [1]}, "given.few: has 1 entry; it needs at least 2 entries."),
        ({"few": [1, 2, 3, 4]}, "given.few: has 4 entries; it may have at most 3 entries."),
        ({"some": {}}, "given.some: is empty; it needs at least 1 entry."),
        ({"some": {"a": 1, "b": 2}}, "given.some: has 2 entries; it may have at most 1 entry."),
        ({"few": 1}, "given.few: must be a list; a single entry, too, stands in brackets: [1]."),
        ({"few": "ab"}, "given.few: must be a list; a single entry, too, stands in brackets: ['ab']."),
        ({"few": "1, 2"}, "given.few: must be a list; a single entry, too, stands in brackets: ['1', '2']."),
        ({"few": "[1 2 .5]"}, "given.few: must be a list; a single entry, too, stands in brackets: ['1', '2', '.5']."),
        ({"few": "no rain"}, "given.few: must be a list; a single entry, too, stands in brackets: ['no rain']."),
        ({"few": "[1; 2,5]"}, "given.few: must be a list; a single entry, too, stands in brackets: ['1', '2,5']."),
        (
            {"few": "1, 2, 3, 4, 5, 6"},
            "given.few: must be a list; a single entry, too, stands in brackets: ['1', '2', '3', '4', '5', …].",
        ),
        ({"few": True}, "given.few: must be a list; a single entry, too, stands in brackets: [true]."),
        ({"few": None}, "given.few: must be a list; a single entry, too, stands in brackets: [1, 2]."),
        ({"few": [1, 2, "x"]}, "given.few[3]: 'x' is not a whole number; write one, such as 3."),
        ({"word": "abcdef"}, "given.word: has 6 characters, 5 are the most; shorten it."),
        ({"word": ""}, "given.word: is empty; write something."),
        ({"word": 3}, "given.word: must be a text; put it in quotes."),
        ({"sign": "a\\b"}, "given.sign: may hold no backslash; take them out."),
        ({"size": 0}, "given.size: 0 is too small; it must be at least 1."),
        ({"size": 10}, "given.size: 10 is too large; it must be at most 9."),
        ({"size": 1.5}, "given.size: 1.5 is not a whole number; write one, such as 3."),
        ({"size": [1]}, "given.size: a list is not a whole number; write one, such as 3."),
        ({"size": {"a": 1}}, "given.size: a table is not a whole number; write one, such as 3."),
        ({"size": None}, "given.size: nothing is not a whole number; write one, such as 3."),
        ({"size": "x" * 50}, f"given.size: '{'x' * 38}… is not a whole number; write one, such as 3."),
        ({"open": 0}, "given.open: 0 is too small; it must be above 0.0."),
        ({"open": 1}, "given.open: 1 is too large; it must be below 1.0."),
        ({"kind": "three"}, "given.kind: 'three' is not possible here; write 'one' or 'two'."),
        ({"told": "maybe"}, "given.told: 'maybe' is neither true nor false; write one of them."),
        ({"inner": 3}, "given.inner: must be a table, in which every name has its value: depth."),
        ({"inners": [{}, {"depth": "x"}]}, "given.inners[2].depth: 'x' is not a whole number; write one, such as 3."),
        ({"named": {"abcd": 1}}, "given.named: has 4 characters, 3 are the most; shorten it."),
        ({"named": {"abc": "x"}}, "given.named.abc: 'x' is not a whole number; write one, such as 3."),
        ({"sized": 1}, f"given.sized is not a field (did you mean size?); {LISTED}."),
        ({"Few": [1, 2]}, f"given.Few is not a field (did you mean few?); {LISTED}."),
        ({"qqqqq": 1}, f"given.qqqqq is not a field; {LISTED}."),
        ({"inner": {"deep": 1}}, "given.inner.deep is not a field (did you mean depth?); the field there is depth."),
        ({"inners": "one"}, "given.inners: must be a list, in which each entry is a table of its own: {depth = …}."),
        ({"inners": [{"deep": 1}]},
         "given.inners[1].deep is not a field (did you mean depth?); the field there is depth."),
        ({"size": 0, "few": [1]}, "given.few: has 1 entry; it needs at least 2 entries (and 1 more fault)."),
        ({"size": 0, "few": [1], "sized": 1},
         f"given.sized is not a field (did you mean size?); {LISTED} (and 2 more faults)."),
        ([], "given: must be a table, in which every name has its value."),
    ],
)  # fmt: skip
def test_one_sentence_says_what_to_do(given: Any, said: str) -> None:
    assert complaint(given) == said


def test_a_text_of_forty_signs_is_shown_whole() -> None:
    assert complaint({"size": "x" * 38}).startswith(f"given.size: '{'x' * 38}' is not")
    assert complaint({"size": "x" * 39}).startswith(f"given.size: '{'x' * 38}… is not")
    assert complaint({"x" * 40: 1}).startswith(f"given.{'x' * 40} is")
    assert complaint({"a\nb\x07": 1}).startswith("given.a\\nb\\x07 is not a field")
    assert complaint({"x" * 41: 1}).startswith(f"given.{'x' * 39}… is")


def test_the_nearest_name() -> None:
    assert nearest("rewrads", ("rewards", "states")) == " (did you mean rewards?)"
    assert nearest("N", ("n", "a")) == " (did you mean n?)"
    assert nearest("zzz", ("rewards", "states")) == ""
    assert nearest("ratio", ("action", "old")) == ""


#: What no plain sentence holds.
NOT_PLAIN = re.compile(r"[Ii]nput |should|tuple|dictionary|instance|NoneType|Value error|\bTrue\b|\bNone\b")


def places(data: Any, place: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Where something stands in the givens; of lists the first two entries."""
    inside = data.items() if isinstance(data, dict) else enumerate(data[:2]) if isinstance(data, list) else ()
    for key, value in inside:
        yield (*place, key)
        yield from places(value, (*place, key))


def refusal(name: str, given: Any) -> str:
    """What is said of givens; nothing if they are taken."""
    try:
        family(name).read(given)
    except FileError as error:
        return str(error)
    return ""


@pytest.mark.parametrize("name", families())
def test_whatever_stands_in_a_field_is_refused_in_plain_words(name: str) -> None:
    given = json.loads(json.dumps(draw(name, 3, 1).problem.data()["given"]))
    for *way, last in places(given):
        for other in (None, True, "", [], {}):
            spoilt = deepcopy(given)
            inner = spoilt
            for step in way:
                inner = inner[step]
            inner[last] = other
            assert not NOT_PLAIN.search(refusal(name, spoilt))
