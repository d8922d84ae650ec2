"""Every way in which a file can be unreadable is one sentence and exit code 3; numbers stay exact."""

import json
import os
from pathlib import Path

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

import rldrill
from rldrill.files import read_data
from rldrill.problem_file import read_problem
from rldrill.problems.catalogue import families
from rldrill.problems.errors import FileError, UserError

PROBLEM = '{"family": "return", "given": {"rewards": [1, "1/2"], "gamma": 0.90, "time": 0}}'

BAD = [
    ("broken.toml", "a = \n", "line 1, column 5: the syntax is broken (invalid value)"),
    ("open.toml", 'a = "x', "the syntax is broken"),
    (
        "third.toml",
        'a = ["1/2",\n 1/3, 3]',
        'line 2, column 3: the syntax is broken (unclosed array); a fraction stands in quotes: "1/3".',
    ),
    ("half.toml", "a = -1/2", 'a fraction stands in quotes: "-1/2".'),
    ("point.toml", "a = .5", "a number begins with a digit: 0.5."),
    ("points.toml", "a = [1, -.25]", "a number begins with a digit: -0.25."),
    ("word.toml", "family = td-zero  # the family", 'a text stands in quotes: "td-zero".'),
    ("greek.toml", "γ = 0.9", "a Greek name stands in quotes there, or is spelled out: gamma."),
    ("inline.toml", 'x = {"μ" = 1, σ_1 = 2}', "or is spelled out: sigma_1."),
    ("twice.toml", "a = 1\na = 2", "a stands twice; keep one of them."),
    ("yaml.toml", "family: return\n", "write name = value, as TOML has it; YAML is not read."),
    ("date.toml", 'a = "1/2" x', "(expected newline or end of document after a statement); fix it there."),
    ("twice.toml", "a = 1\na = 2\n", "line 2, column"),
    (
        "quote.toml",
        'a = "x\nb = 1\n',
        "line 1, column 7: the syntax is broken (illegal character '\\n'); a quote that "
        "begins there is not closed; close it.",
    ),
    ("broken.json", '{"a": 1,\n "b" 2}', "line 2, column 6: the syntax is broken (expecting ':' delimiter)"),
    ("end.json", '{"a": ', "the syntax is broken"),
    ("after.json", "{} {}", "line 1, column 4: the syntax is broken (extra data)"),
    ("twice.json", '{"a": 1, "b": {"c": 1, "c": 2}}', "the key 'c' stands twice"),
    ("half.json", '["\\ud800"]', "half a character"),
    ("long.json", f'{{"a": {"9" * 41}}}', "more than 40 digits"),
    ("endless.json", f"[{'9' * 5000}]", "more than 40 digits"),
    ("endless.toml", f"a = {'9' * 5000}", "more than 40 digits"),
    ("hexadecimal.toml", f"a = 0x{'f' * 5000}", "more than 40 digits"),
    ("deep.json", "[" * 40 + "]" * 40, "nests deeper than 32"),
    ("deepest.json", "[" * 100_000, "nests deeper than 32"),
    ("deepest.toml", f"a = {'[' * 100_000}", "nests deeper than 32"),
    ("dotted.toml", f"{'a.' * 60}a = 1", "nests deeper than 32"),
    ("empty.toml", "", "the file is empty"),
    ("blank.json", " \n\t", "the file is empty"),
    ("null.toml", 'a = 1\nb = "\0"', "line 2: there is a null byte"),
    ("latin.json", b'{\n"a": "\xe4"}', "line 2: this is not UTF-8"),
    ("utf16.toml", "a = 1".encode("utf-16") + b"\x00", "begins as UTF-16"),
    ("large.json", b" " * (10**7 + 1), "larger than 10 MB"),
    ("problem.yaml", "a: 1", "must end in .toml or .json"),
    ("problem", "a = 1", "must end in .toml or .json"),
]


def write(folder: Path, name: str, content: str | bytes) -> Path:
    path = folder / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


@pytest.mark.parametrize(("name", "content", "fragment"), BAD, ids=[name for name, _, _ in BAD])
def test_bad_data_is_one_sentence(tmp_path: Path, name: str, content: str | bytes, fragment: str) -> None:
    path = write(tmp_path, name, content)
    with pytest.raises(FileError) as caught:
        read_data(path)
    says = str(caught.value)
    assert says.startswith(str(path))
    assert fragment in says
    assert "; " in says, "it says what to do"
    assert "\n" not in says
    assert len(says) < len(str(path)) + 200
    assert caught.value.exit_code == 3


def test_places_that_are_no_files(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="no such file"):
        read_data(tmp_path / "none.toml")
    with pytest.raises(FileError, match="a directory"):
        read_data(tmp_path)
    with pytest.raises(FileError, match="no such file"):
        read_data(write(tmp_path, "file.toml", "a = 1") / "below.toml")
    with pytest.raises(FileError, match="cannot be read"):
        read_data(tmp_path / ("long" * 100 + ".toml"))
    with pytest.raises(FileError, match="cannot be read"):
        read_data("null\0.toml")


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may read everything")
def test_a_forbidden_file(tmp_path: Path) -> None:
    path = write(tmp_path, "mine.toml", "a = 1")
    path.chmod(0)
    with pytest.raises(FileError, match="not permitted"):
        read_data(path)


def test_what_a_terminal_cannot_print_is_escaped(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"red\\x1b\[31m"):
        read_data(tmp_path / "red\x1b[31m.toml")


def test_numbers_stay_as_they_are_written(tmp_path: Path) -> None:
    toml = read_data(write(tmp_path, "a.TOML", "a = [0.9, 1_000.50, 1e-3, 3, -0.10]"))
    assert toml == {"a": ["0.9", "1000.50", "1e-3", 3, "-0.10"]}
    assert read_data(write(tmp_path, "a.Json", '{"a": [0.9, 1E-3, 3, 1e400]}')) == {"a": ["0.9", "1E-3", 3, "1e400"]}


def test_a_byte_order_mark_is_passed_over(tmp_path: Path) -> None:
    assert read_data(write(tmp_path, "a.toml", b"\xef\xbb\xbfa = 1")) == {"a": 1}
    assert read_data(write(tmp_path, "a.json", b'\xef\xbb\xbf{"a": 1}')) == {"a": 1}


def test_a_problem_file_is_solved_exactly(tmp_path: Path) -> None:
    # R₀ = 1 + 9/10 · 1/2 = 29/20
    assert rldrill.load(write(tmp_path, "p.json", PROBLEM)).data()["parts"][0]["answer"]["exact"] == "29/20"


@pytest.mark.parametrize("family", families())
def test_what_show_writes_is_read_back(tmp_path: Path, family: str) -> None:
    shown = rldrill.draw(family, 1, 7)
    path = write(tmp_path, "p.json", json.dumps(shown.data()))
    assert set(read_problem(path)) == {"family", "given"}
    again = rldrill.load(path)
    assert again.problem.given == shown.problem.given
    assert again.id is None


@pytest.mark.parametrize(
    ("content", "fragment"),
    [
        ("[]", "is a table with 'family' and 'given', not a list"),
        ('{"family": "return", "given": {}, "format": 2}', "its format is 2"),
        ('{"family": "return", "given": {}, "format": true}', "its format is True"),
        ('{"family": "return", "given": {}, "format": [1]}', "its format is a list"),
        ('{"family": "return", "given": {}, "gamma": 1}', "'gamma' is not a field of a problem file"),
        ('{"given": {}}', "'family' is missing; a problem needs 'family' and 'given'"),
        ('{"family": "return"}', "'given' is missing; a problem needs 'family' and 'given'"),
        ('{"family": 1, "given": {}}', "'family' must be the name of a family in quotes, such as 'td-zero'."),
        ('{"famly": "return", "given": {}}', "'famly' is not a field of a problem file (did you mean family?);"),
        (
            '{"family": "return", "given": {"rewards": [1], "gamma": 2}}',
            "given.gamma: 2 is not between 0 and 1",
        ),
    ],
)
def test_a_problem_file_that_is_none(tmp_path: Path, content: str, fragment: str) -> None:
    with pytest.raises(FileError) as caught:
        rldrill.load(write(tmp_path, "p.json", content))
    assert fragment in str(caught.value)
    assert "p.json" in str(caught.value)


@settings(max_examples=300, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(content=st.binary(max_size=200) | st.text(max_size=200).map(lambda text: text.encode(errors="replace")))
@example(content=PROBLEM.encode())
@example(content=b'family = "return"\n[given]\nrewards = [1]\ngamma = 1e999999999\n')
@pytest.mark.parametrize("suffix", [".toml", ".json", ""])
def test_any_bytes_are_read_or_refused(tmp_path: Path, suffix: str, content: bytes) -> None:
    path = write(tmp_path, f"any{suffix}", content)
    try:
        rldrill.load(path)
    except UserError as error:
        assert str(error)  # noqa: PT017 - anything else is the failure


@pytest.mark.parametrize(
    ("given", "shown"),
    [
        ("nan", "'nan'"),
        ("-inf", "'-inf'"),
        ("true", "true"),
        ("2020-01-01", "2020-01-01"),
        ("[1, 2]", "a list"),
        ("{a = 1}", "a table"),
    ],
)
def test_what_is_no_number_is_told_with_its_field(tmp_path: Path, given: str, shown: str) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(f'family = "td-zero"\n[given]\nalpha = {given}\ngamma = 1\nvalues = {{ a = 1 }}\n'
                    'trajectory = { states = ["a", "b"], rewards = [1], terminal = ["b"] }\n')  # fmt: skip
    with pytest.raises(FileError) as caught:
        rldrill.load(path)
    assert f"given.alpha: {shown} is not a number; write it as 3, 0.75 or 3/4." in str(caught.value)


def test_a_terminal_state_that_nothing_leads_to_is_told(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text('family = "optimal-value"\n[given]\ngamma = "1/2"\n[given.mdp]\nterminal = ["end", "goal"]\n'
                    'transitions = [["a", "x", "a", "1/2", 1], ["a", "x", "end", "1/2", 2]]\n')  # fmt: skip
    exercise = rldrill.load(path)
    assert exercise.notes == ("nothing leads to the terminal state 'goal'; correct its name, or take it out",)
    assert exercise.answers()["a"] == {"a": 2}  # V = 1/2·(1 + 1/2·V) + 1/2·2
