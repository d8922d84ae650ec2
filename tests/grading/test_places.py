"""Every answer in a TOML or JSON file is told with its line and column, however the file is written."""

import json
import tomllib
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rldrill.grading.places import places
from rldrill.grading.reports import junit, tables, text
from rldrill.grading.verification import verify

TOML = Path("a.toml")
JSON = Path("a.json")

#: A file, and for the keys that lead to a value the line and the column where it stands, counted by hand.
WRITTEN = {
    '"x/1/7" = 5\n': {("x/1/7",): (1, 11)},
    '# "x" = 1\n\n["x/1/7"] # a\n  a = "3/4" # "b" = 2\nb   =   [1,\n  2]\nc = 1.5\n': {
        ("x/1/7",): (3, 1), ("x/1/7", "a"): (4, 7), ("x/1/7", "b"): (5, 9), ("x/1/7", "c"): (7, 5),
    },
    "answers.'x'={ a=1 , \"b\" = {u=1.0,v=[[2],{w=3}]},c='''\n\n''' }\r\nz=0": {
        ("answers", "x"): (1, 13), ("answers", "x", "a"): (1, 17), ("answers", "x", "b"): (1, 27),
        ("answers", "x", "c"): (1, 51), ("z",): (4, 3),
    },
    '[ answers . "x" ]\na = """\n[y]\n"b" = 1 \\" """""\nd.e = 1979-05-27 07:32:00\n[[w]]\nk = {}\n': {
        ("answers", "x"): (1, 1), ("answers", "x", "a"): (2, 5), ("answers", "x", "d", "e"): None, ("w",): (6, 1),
        ("w", "k"): (7, 5),
    },
    '"\\u0061\\"]" = "\\\\"\n\'b"\' = \'\\\'\nc = true': {('a"]',): (1, 15), ('b"',): (2, 8), ("c",): (3, 5)},
}  # fmt: skip
OBJECTS = {
    '{"x": {"a": 1,\n "b" : {"a": [1, {"c": 2}]}}, "y":\n\n[]}': {
        ("x",): (1, 7), ("x", "a"): (1, 13), ("x", "b"): (2, 8), ("x", "b", "a"): (2, 14), ("y",): (4, 1),
    },
    '\n {"\\u0061" : 12345e3, "": {} , "b":"}\\"{" }': {("a",): (2, 14), ("",): (2, 27), ("b",): (2, 36)},
    '{"x":{"a":1,"b":2},"y":3}': {("x",): (1, 6), ("x", "a"): (1, 11), ("x", "b"): (1, 17), ("y",): (1, 24)},
    "[]": {},
}  # fmt: skip


@pytest.mark.parametrize("content", WRITTEN)
def test_values_of_toml_are_found(content: str) -> None:
    tomllib.loads(content)
    found = places(content, TOML)
    for keys, place in WRITTEN[content].items():
        assert found.get(keys) == place, keys


@pytest.mark.parametrize("content", OBJECTS)
def test_values_of_json_are_found(content: str) -> None:
    assert places(content, JSON) == OBJECTS[content]


VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(max_size=6),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner, max_size=3),
    max_leaves=10,
)


@given(value=st.dictionaries(st.text(max_size=4), VALUES, max_size=4), indent=st.sampled_from([None, 0, 3]))
def test_at_every_place_of_json_its_value_stands(value: dict[str, object], indent: int | None) -> None:
    content = json.dumps(value, indent=indent)
    lines = content.split("\n")
    for keys, (line, column) in places(content, JSON).items():
        wanted: object = value
        for key in keys:
            assert isinstance(wanted, dict)
            wanted = wanted[key]
        rest = "\n".join([lines[line - 1][column - 1 :], *lines[line:]])
        assert json.JSONDecoder().raw_decode(rest)[0] == wanted


@given(st.text(st.sampled_from("abx1./-_+:[]{}=,.\"'#\\\n\r\t u"), max_size=40))
def test_no_text_is_too_much(content: str) -> None:
    for path in (TOML, JSON):
        places(content, path)


def test_every_message_about_an_answer_has_its_place(tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    path.write_text(
        'student = "Ann"\n["return/1/2166"]\na = "2/3"\n  b = "1,5"\nz = 1\n[ "td-zero/1/62590"]\na = 2024-01-01\n'
    )
    report = verify([path])
    assert [refusal.line for refusal in report.refused] == [7, 5]
    assert f"{path}, line 7, column 5: the answer to td-zero/1/62590 is neither" in report.refused[0].says
    assert f"{path}, line 5, column 5: there is no part 'z'" in report.refused[1].says
    for form in (text, junit):
        told = form.written(report, "verdict")
        assert f"{path}, line 3, column 5" in told
        assert f"{path}, line 4, column 7" in told
    assert f"return/1/2166@5,b,{path},4,7," in tables.written(report, "verdict")


def test_a_line_of_json_has_its_columns(tmp_path: Path) -> None:
    path = tmp_path / "a.jsonl"
    path.write_text('\n{"problem": "return/1/2166", "part": "a",  "answer":  "2/3"}\n')
    assert f"({path}, line 2, column 55)" in text.written(verify([path]), "reason")
