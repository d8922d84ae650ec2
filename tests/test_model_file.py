"""Models in files of their own: tables, arrays, JSON and pomdp-solve's format."""

import csv
import io
import json
import zipfile
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rldrill
from rldrill.problems.errors import FileError, UsageError

# The racing car of Berkeley's CS188 at γ = 0.9, which slows down when warm: V*(cool) = 31/2, V*(warm) = 29/2.
CAR = """state,action,next,probability,reward
cool,slow,cool,1,1
cool,fast,cool,0.5,2
cool,fast,warm,0.5,2
warm,slow,cool,0.5,1
warm,slow,warm,0.5,1
warm,fast,off,1,-10
"""
RACING = {"cool": Fraction(31, 2), "warm": Fraction(29, 2)}
RECORDS = [dict(zip(("s", "a", "s'", "p", "r"), line.split(","), strict=True)) for line in CAR.splitlines()[1:]]
# The same car in the format of pomdp-solve; it has no ends, so "off" goes on for nothing.
CASSANDRA = """# the racing car
discount: 0.9
values: cost
states: cool warm off
actions: slow fast
start: uniform

T: slow : cool
1 0 0
T: slow : warm
0.5 0.5 0
T: fast
0.5 0.5 0
0 0 1
0 0 1
T: * : off : 2 1.0
R: slow : * : * -1
R: fast : cool : * -2
R: fast : warm : off 10
R: * : off : * 0
"""


def optimal(folder: Path, name: str, content: str | bytes, mdp: str = "", gamma: str = "gamma = 0.9\n") -> Any:
    (folder / name).write_bytes(content.encode() if isinstance(content, str) else content)
    problem = f'family = "optimal-value"\n[given]\n{gamma}[given.mdp]\nfile = "{name}"\n{mdp}'
    (folder / "problem.toml").write_text(problem, encoding="utf-8")
    return rldrill.load(folder / "problem.toml").answers()["a"]


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("car.csv", CAR),
        ("car.tsv", CAR.replace(",", "\t").replace("state\taction", "State\tAction")),
        ("percent.csv", CAR.replace(",", ";").replace("0.5", "50,00%").replace(";1;", ";100 %;")),
        ("excel.csv", "sep=;\n" + CAR.replace(",", ";").replace("0.5", "0,5")),
        ("other-order.csv", "p,r,s,a,s'\n" + "".join(",".join([*line.split(",")[3:], *line.split(",")[:3]]) + "\n"
                                                     for line in CAR.splitlines()[1:])),
        ("frame.csv", "".join(f"{index - 1 if index else ''},{line}\n" for index, line in enumerate(CAR.splitlines()))),
        ("done.csv", CAR.replace("reward\n", "reward,done\n").replace("1\n", "1,False\n").replace("2\n", "2,False\n")
         .replace("-10\n", "-10,True\n")),
        ("books.csv", CAR.replace("state,action,next,probability,reward", "s,a,s',\"P(s'|s, a)\",\"R(s,a,s')\"")),
        ("car.md", "# A car\n\n" + "\n".join(f"| {line} |".replace(",", " | ") for line in CAR.splitlines())
         .replace("reward |\n", "reward |\n|:--|--|--|:-:|--:|\n").replace("0.5", "0,5").replace("| -10", "| $-10$")
         + "\n\nno | more\n"),
        ("bars.md", "\n".join(f"|{line}|".replace(",", "|") for line in CAR.splitlines())
         .replace("probability", "P(s'\\|s,a)").replace("|next|", "|`s'`|").replace("|cool|", "|**cool**|")),
        ("headers.tsv", CAR.replace("state,action,next,probability,reward", "s,a,s',T(s;a;s'),R(s;a;s')")
         .replace(",", "\t").replace("(s;a;s')", "(s,a,s')")),
        ("headers.csv", CAR.replace("state,action,next,probability,reward", "s,a,s',T(s#a#s'),R(s#a#s')")
         .replace(",", ";").replace("#", ",")),
        ("car.json", json.dumps(RECORDS)),
        ("bare.csv", CAR.partition("\n")[2]),
        ("loose.csv", CAR.replace(",", " | ").replace("\n", "\n--|--|--|--|--\n", 1)),
        ("rows.json", json.dumps([line.split(",") for line in CAR.splitlines()[1:]])),
        ("model.json", json.dumps({"transitions": [line.split(",") for line in CAR.splitlines()[1:]]})),
        ("gymnasium.json", json.dumps({
            "cool": {"slow": [[1.0, "cool", 1, False]], "fast": [[0.5, "cool", 2, False], [0.5, "warm", 2, False]]},
            "warm": {"slow": [[0.5, "cool", 1, False], [0.5, "warm", 1, False]], "fast": [[1.0, "off", -10, True]]}})),
    ],
)  # fmt: skip
def test_one_model_in_many_files(tmp_path: Path, name: str, content: str) -> None:
    assert optimal(tmp_path, name, content) == RACING


def test_the_format_of_pomdp_solve_brings_its_discount(tmp_path: Path) -> None:
    assert optimal(tmp_path, "car.POMDP", CASSANDRA, gamma="") == RACING | {"off": 0}


# The forest of pymdptoolbox's documentation at γ = 0.9, whose policy iteration prints 26.244, 29.484, 33.484.
FOREST = np.array([[[0.1, 0.9, 0], [0.1, 0, 0.9], [0.1, 0, 0.9]], [[1, 0, 0], [1, 0, 0], [1, 0, 0]]])
REWARDS = np.array([[0, 0], [0, 1], [4, 2]])


def test_arrays(tmp_path: Path) -> None:
    np.savez(tmp_path / "forest.npz", P=FOREST, R=REWARDS)
    values = {"0": Fraction("26.244"), "1": Fraction("29.484"), "2": Fraction("33.484")}
    assert optimal(tmp_path, "forest.npz", (tmp_path / "forest.npz").read_bytes()) == values
    listed = json.dumps({"P": FOREST.tolist(), "R": REWARDS.tolist()})
    assert optimal(tmp_path, "forest.json", listed) == values


def test_a_process_without_actions(tmp_path: Path) -> None:
    # V = 1 + V/4, since γ = 1/2 and s stays with 1/2.
    (tmp_path / "chain.csv").write_text("from,to,prob,reward\ns,s,1/2,1\ns,t,1/2,1\n", encoding="utf-8")
    problem = '{"family": "policy-value", "given": {"gamma": "1/2", "mdp": {"file": "chain.csv"}}}'
    (tmp_path / "problem.json").write_text(problem, encoding="utf-8")
    assert rldrill.load(tmp_path / "problem.json").answers()["a"] == {"s": Fraction(4, 3)}


@pytest.mark.parametrize(
    ("name", "content", "says"),
    [
        ("a.csv", "", "the column 'state' is missing"),
        ("a.csv", CAR.replace("reward", "payoff"), "the column 'payoff' is not known; call the columns state, action"),
        ("a.csv", "s,s,s'\n", "the column 's' is the second of its kind"),
        ("a.csv", "s,a,s',r\n", "there is no transition below the header"),
        ("a.csv", CAR + "cool,slow\n", "line 8 has 2 entries, the header has 5"),
        ("a.csv", "s,s',r,done\nx,y,1,perhaps\n", "line 2: whether the episode ends is 'perhaps'; write true or false"),
        ("a.csv", 's,a,s\',r\n"x\n y",go,z,1\ncool,slow\n', "line 4 has 2 entries, the header has 4"),
        ("a.md", "s, a, s', r\n", "there is no table; begin its lines with |, as in | state | action | next |"),
        ("a.md", "\n\n| s | a | s' | r |\n|---|---|---|---|\n| x | y |\n", "line 5 has 2 entries, the header has 4"),
        # 1,000 is one or a thousand.
        ("a.csv", CAR.replace(",", ";").replace("-10", "1,000"), "may be '1.000' or '1000'; write the one"),
        ("a.md", "| s | s' | r |\n|--|--|--|\n| x | y | -12,500 |\n", "'-12,500' is not a number"),
        ("a.json", "[1, 2]", "given.mdp.transitions[1]"),
        ("a.json", "3", "a model is a table or a list of transitions, not a single value"),
        ("a.json", '{"family": "td-zero"}', "this is a problem file"),
        ("a.npz", "nonsense", "this is no file of numpy's"),
        ("a.txt", "nonsense", "the name must end in .csv"),
        ("a.pomdp", CASSANDRA + "O: * : * : hear 1\n", "line 21: observations make this a POMDP"),
        ("a.pomdp", "discount: 0.9\nT: slow\nidentity\n", "line 2: states and actions must be named before"),
        ("a.pomdp", CASSANDRA + "T: halt identity\n", "line 21: 'halt' is not among the actions"),
        ("a.pomdp", CASSANDRA + "T: slow\n1 0\n", "line 21: T: 2 numbers stand here, 9 are needed"),
        ("a.pomdp", CASSANDRA + "R: slow : cool : * : loud 3\n", "line 21: a reward that depends on the observation"),
        ("a.pomdp", CASSANDRA + "R: slow : cool 3\n", "line 21: R: 1 numbers stand here, 3 are needed"),
        ("a.pomdp", "values: money\n", "line 1: values: must be reward or cost"),
        ("a.pomdp", "states: a b\nactions: x\n", "there are no transitions; write states, actions, and T"),
        ("a.pomdp", "hello\n", "line 1: 'hello' begins no statement"),
    ],
)  # fmt: skip
def test_what_a_file_cannot_say_is_one_sentence(tmp_path: Path, name: str, content: str, says: str) -> None:
    with pytest.raises(FileError) as error:
        optimal(tmp_path, name, content)
    assert says in str(error.value)
    assert "\n" not in str(error.value)


def test_a_quote_that_swallows_the_rest_of_the_file_is_looked_for(tmp_path: Path) -> None:
    before = csv.field_size_limit(1000)  # reading answers sets it higher
    try:
        with pytest.raises(FileError, match="look for a quote that is not closed"):
            optimal(tmp_path, "a.csv", CAR + '"cool,slow' + ",x" * 1000)
    finally:
        csv.field_size_limit(before)


def packed(**members: bytes) -> bytes:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as file:
        for name, member in members.items():
            file.writestr(f"{name}.npy", member)
    return content.getvalue()


def damaged(folder: Path) -> bytes:
    np.savez_compressed(folder / "whole.npz", P=FOREST, R=REWARDS)
    content = bytearray((folder / "whole.npz").read_bytes())
    content[content.index(b"P.npy") + 30] ^= 0xFF
    return bytes(content)


_HEADER = (
    b"\x93NUMPY\x01\x00v\x00"
    + b"{'descr': '<f8', 'fortran_order': False, 'shape': (17179869184,), }".ljust(117)
    + b"\n"
)


@pytest.mark.parametrize("content", [packed(P=b"no array"), packed(P=_HEADER, R=_HEADER), b"PK\x05\x06", None])
def test_what_is_no_file_of_numpys_is_said_to_be_none(tmp_path: Path, content: bytes | None) -> None:
    with pytest.raises(FileError, match="this is no file of numpy's; write it with"):
        optimal(tmp_path, "a.npz", damaged(tmp_path) if content is None else content)


@pytest.mark.parametrize("discount", ["discount", '"\N{GREEK SMALL LETTER GAMMA}"', "gamma"])
def test_a_discount_of_the_problem_goes_before_that_of_its_model(tmp_path: Path, discount: str) -> None:
    model = CASSANDRA.replace("discount: 0.9", "discount: 0.5")
    assert optimal(tmp_path, "car.pomdp", model, gamma=f"{discount} = 0.9\n") == RACING | {"off": 0}


def test_an_episode_that_ends_where_another_goes_on_ends_in_a_state_of_its_own(tmp_path: Path) -> None:
    # V(X) = 100 + V(A)/2, V(B) = V(X)/2; A's own episode is over, for nothing.
    table = "s,a,s',p,r,done\nA,go,X,1,0,true\nB,go,X,1,0,false\nX,go,A,1,100,false\n"
    assert optimal(tmp_path, "a.csv", table, gamma="gamma = 0.5\n") == {"A": 0, "B": 50, "X": 100}


def test_objects_in_arrays_are_not_read(tmp_path: Path) -> None:
    np.savez(tmp_path / "a.npz", P=np.array([None, 1], dtype=object), R=REWARDS)
    with pytest.raises(FileError, match=r"holds Python objects, which are not read; write arrays with np\.savez"):
        optimal(tmp_path, "a.npz", (tmp_path / "a.npz").read_bytes())


def test_a_model_alone_is_no_problem() -> None:
    with pytest.raises(
        UsageError, match=r"is no problem file; if it holds a model, write one beside it, .*file = \"car\.csv\""
    ):
        rldrill.load("car.csv")


def test_an_answer_or_data_from_elsewhere_opens_no_file() -> None:
    with pytest.raises(FileError, match="a file is read for problems that stand in a file themselves"):
        rldrill.read({"family": "optimal-value", "given": {"gamma": "9/10", "mdp": {"file": "car.csv"}}})
