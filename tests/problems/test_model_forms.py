"""Models in other forms than a list of transitions: grids drawn as text, and Gymnasium's tables."""

import re
from typing import Any

import pytest
from flint import fmpq
from pydantic import ValidationError

from asking import solved
from rldrill.problems.catalogue import family
from rldrill.problems.exact import Parameter
from rldrill.problems.fractions import Fraction
from rldrill.problems.grids import Grid
from rldrill.problems.gymnasium import from_table
from rldrill.problems.model_forms import SCHEMAS, read_form
from rldrill.problems.models import Model, sums_to_one, transitions_table

SQUARE = "took P for P[action][state][next], as pymdptoolbox has it"

# The 4×3 world of Russell & Norvig, AIMA, section 17.1: moves succeed with 0.8 and slip to either side with 0.1.
AIMA = {"grid": "...G\n.#.P\n....", "rewards": {"G": 1, "P": -1}, "step": "-0.04", "slip": "0.2"}


def outcomes(model: Model, state: str, action: str) -> dict[str, tuple[Fraction, Fraction]]:
    return {row.next: (row.probability, row.reward) for row in model.outcomes[state, action]}  # type: ignore[misc]


def test_a_grid_drawn_as_text() -> None:
    model = Model.model_validate(AIMA)
    assert model.terminal == ("r1c4", "r2c4")
    assert len(model.states) == 9  # 12 cells, one wall, two ends
    # From (3, 3) of the book, to the right: the goal with 0.8, down with 0.1, and up against the edge with 0.1.
    step = Fraction(-4, 100)
    assert outcomes(model, "r1c3", "right") == {
        "r1c4": (Fraction(4, 5), 1 + step),
        "r2c3": (Fraction(1, 10), step),
        "r1c3": (Fraction(1, 10), step),
    }
    # Beside the wall: left and right of an upward move from r3c2 are free, above it is the wall.
    assert outcomes(model, "r3c2", "up") == {
        "r3c2": (Fraction(4, 5), step),
        "r3c3": (Fraction(1, 10), step),
        "r3c1": (Fraction(1, 10), step),
    }


def test_a_cliff_leads_back_to_the_start() -> None:
    cliff = {"grid": "...\nSCG", "rewards": {"C": -99}, "step": -1, "ends": ["G"], "returns": {"C": "S"}}
    model = Model.model_validate(cliff)
    assert outcomes(model, "r2c1", "right") == {"r2c1": (1, -100)}
    assert outcomes(model, "r1c2", "down") == {"r2c1": (1, -100)}
    assert model.terminal == ("r2c3",)
    assert "r2c2" not in model.states


def process(*rows: list[object], **more: object) -> Model:
    return Model.model_validate({"transitions": list(rows)} | more)


def test_an_outcome_in_two_rows_is_added_up() -> None:
    # p(s, 2 | s, W) = 0.3 and p(s, -1 | s, W) = 0.2: s with 0.5, and (0.3·2 - 0.2·1)/0.5 = 0.8 on average.
    model = process(["s", "W", "s", 0.3, 2], ["s", "W", "s", 0.2, -1], ["s", "W", "t", 0.5, 1], terminal=["t"])
    assert outcomes(model, "s", "W") == {"s": (Fraction(1, 2), Fraction(4, 5)), "t": (Fraction(1, 2), 1)}


def test_ends_are_found_where_none_are_named() -> None:
    assert process(["s", "a", "t", 1, 0], ["s", "b", "s", 1, 0]).terminal == ("t",)
    with pytest.raises(ValidationError, match="'u' is reached but has no action"):
        process(["s", "a", "t", 0.5, 0], ["s", "a", "u", 0.5, 0], terminal=["t"])


def test_a_name_in_other_capitals_is_no_end_unless_it_is_said() -> None:
    rows: list[list[object]] = [["A", "go", "b", 1, 1], ["B", "go", "A", 1, 0]]
    with pytest.raises(ValidationError, match="'b' has no action, but 'B' has; write its name alike, or list 'b' as"):
        process(*rows)
    assert process(*rows, terminal=["b"]).terminal == ("b",)


def test_rewards_of_states_and_of_actions() -> None:
    rows: list[list[object]] = [["s", "go", "t", 0.5], ["s", "go", "s", 0.5], ["s", "no", "s", 1]]
    half = Fraction(1, 2)
    assert outcomes(process(*rows, rewards={"s": 2}), "s", "go") == {"t": (half, 2), "s": (half, 2)}
    by_action = process(*rows, rewards={"s": {"go": 2, "no": 3}})
    assert outcomes(by_action, "s", "go") == {"t": (half, 2), "s": (half, 2)}
    assert outcomes(by_action, "s", "no") == {"s": (1, 3)}
    entering = process(*rows, rewards={"s": 2, "t": 9}, rewards_on="entering")
    assert outcomes(entering, "s", "go") == {"t": (half, 9), "s": (half, 2)}


def test_a_process_without_actions() -> None:
    model = process(["s", "s", 0.5, 2], ["s", "t", 0.5, 1], terminal=["t"])
    assert outcomes(model, "s", "step") == {"s": (Fraction(1, 2), 2), "t": (Fraction(1, 2), 1)}
    assert transitions_table(model).header == ("$s$", "$s'$", "$P_{s s'}$", "$R_{s s'}$")
    assert outcomes(process(["s", "s", 1], rewards={"s": 2}), "s", "step") == {"s": (1, 2)}


@pytest.mark.parametrize("name", ["0,0", "(0,0)", "(-1, 2)", "-1", "+1", "−", "→", "r1c1", "a" * 40, "s'", "s_1", 7])
def test_what_is_a_name(name: object) -> None:
    assert process([name, name, name, 1, 0]).states == (str(name),)


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("a" * 41, "'a{39}…' has 41 characters, 40 are the most"),
        ("a,b", "'a,b' is no name; .* commas between numbers"), ("(1", "brackets in pairs"),
        ("$x$", "is no name"), ("", "is no name"), ("a ", "is no name"), ("_", "is no name"), ("a\nb", "is no name"),
    ],
)  # fmt: skip
def test_what_is_no_name(name: str, says: str) -> None:
    with pytest.raises(ValidationError, match=says):
        process([name, "go", name, 1, 0])


# The forest of pymdptoolbox's documentation, three states: 0 waits, 1 cuts; p = 0.1 is the chance of a fire.
FOREST = [[[0.1, 0.9, 0.0], [0.1, 0.0, 0.9], [0.1, 0.0, 0.9]], [[1, 0, 0], [1, 0, 0], [1, 0, 0]]]


@pytest.mark.parametrize(
    ("R", "reward"),
    [
        ([0, 1, 4], 4),
        ([[0, 0], [0, 1], [4, 2]], 4),
        ([[[0, 0, 0], [0, 0, 0], [5, 0, 6]], [[0, 0, 0], [1, 0, 0], [2, 0, 0]]], 6),
    ],
)
def test_arrays_of_pymdptoolbox(R: Any, reward: int) -> None:
    model = Model.model_validate({"P": FOREST, "R": R})
    assert model.states == ("0", "1", "2")
    assert outcomes(model, "2", "0")["2"] == (Fraction(9, 10), reward)
    assert set(outcomes(model, "0", "1")) == {"0"}


@pytest.mark.parametrize(
    ("given", "fragment"),
    [
        ({"P": FOREST}, "R, the array of rewards, is missing"),
        ({"P": FOREST, "R": [1, 2]}, r"R has the shape \(2,\), which does not fit P's \(2, 3, 3\)"),
        ({"P": FOREST[0][:2], "R": [1, 2, 3]}, r"P has the shape \(2, 3\); it must be \(A, S, S\)"),
        ({"P": [[[1], [1, 2]]], "R": [1]}, "rows of different lengths"),
        ({"P": FOREST, "R": [1, 2, 3], "gamma": 1}, "'gamma' is not understood beside the arrays P and R"),
        ({"P": {"0": {"0": [[1, 0, 0]]}}}, "outcome 1 of 0 in 0 must be"),
        ({"P": {"0": {"0": [[1, 0, 0, True]]}}, "R": [1]}, "'R' is not understood beside Gymnasium's table P"),
        ({"P": {"0": [[1, 0, 0, True]]}}, "P: '0' must have a table of its actions"),
        ({"file": "model.csv"}, "a file is read for problems that stand in a file"),
        ({"transitions": [["s", "s", 1]], "rewards": {}}, "that of 's' is missing"),
        ({"transitions": [["s", "a", "s", 1, 1]], "rewards": {"s": 1}}, "beside rewards"),
        ({"transitions": [["s", "t", 1]], "rewards": {"s": 1, "t": 2}}, "'t' is an end, which is never left"),
        ({"transitions": [["s", "s", 1]], "rewards": {"s": 1, "u": 2}}, "'u' does not occur"),
        ({"transitions": [["s", "t", 1]], "rewards": {"s": 1}, "rewards_on": "x"}, "write 'leaving' or 'entering'"),
        ({"transitions": [["s", "t", 1]], "rewards": 1}, "rewards: must be a table beside transitions"),
        ({"grid": "s", "transitions": 1, "rewards": {"s": 1}}, "rewards"),
        ({"transitions": [["s", "a", "t", 1]], "rewards": {"s": {"b": 1}}}, "that of 'a' in 's' is missing; write 0"),
        (
            {"transitions": [["s", "a", "t", 1]], "rewards": {"t": {"a": 1}}, "rewards_on": "entering"},
            "those of actions are earned by taking them; leave out rewards_on",
        ),
        ({"transitions": [["s", "t", 1]], "rewards": {"s": "much"}}, "rewards: that of s: 'much' is not a number"),
        (
            {"transitions": [["s", "a", "t", "p", 1], ["s", "a", "t", "1-p", 2]]},
            "s, a, t is given twice; where a parameter is left open, give it once",
        ),
        ({"transitions": [["s", "a", "t", 1]]}, "in every row of a process without actions"),
        ({"grid": ".G", "rewards": {"G": 1}, "rewards_on": "leaving", "exit": False}, "set exit = true"),
    ],
)
def test_what_a_form_cannot_say_is_one_sentence(given: dict[str, Any], fragment: str) -> None:
    with pytest.raises(ValidationError, match=fragment):
        Model.model_validate(given)


@pytest.mark.parametrize(
    ("given", "fragment"),
    [
        ({"grid": "..\n."}, "differ in length"),
        ({"grid": ". .\n.."}, "parted unevenly"),
        ({"grid": "# -100 #\n1 S 10"}, "parted unevenly; draw each as one sign, free ones as '.'"),
        ({"grid": "S   G"}, "parted unevenly"),  # blanks for free cells, or for nothing
        ({"grid": "..", "rewards": {"G": 1}}, "'G', but no cell"),
        ({"grid": "..", "slip": 3}, "slip: 3 is not between"),
        ({"grid": "..", "sleep": 3}, "sleep"),
        ({"grid": "SC\n..", "returns": {"C": "."}}, "must stand for one cell"),
        ({"grid": ("." * 60 + "\n") * 20}, "1200 cells"),
        ({"gymnasium": "FrozenLake-v1", "gamma": 1}, "'gamma' is not understood"),
        ({"gymnasium": "antigravity:FrozenLake-v1"}, "'antigravity:FrozenLake-v1' is not the ID of an environment"),
    ],
)
def test_what_does_not_fit_is_one_sentence(given: dict[str, Any], fragment: str) -> None:
    with pytest.raises(ValidationError, match=fragment):
        Model.model_validate(given)


def test_a_table_with_doubled_rows_and_ends() -> None:
    # Two ways into state 1 by one action: 1/3 with reward 0 and 1/3 with reward 3 are 2/3 with 3/2 on average.
    table = {0: {0: [(1 / 3, 1, 0.0, False), (1 / 3, 1, 3.0, False), (1 / 3, 2, 1.0, True)]},
             1: {0: [(1.0, 0, 0.0, False)]}, 2: {0: [(1.0, 2, 0.0, True)]}}  # fmt: skip
    model = Model.model_validate(from_table(table))
    assert outcomes(model, "0", "0") == {"1": (Fraction(2, 3), Fraction(3, 2)), "2": (Fraction(1, 3), 1)}
    assert model.terminal == ("2",)


def test_where_an_episode_may_also_go_on_it_ends_in_a_state_of_its_own() -> None:
    """State 1 is entered while the episode goes on, and left by what ends it and earns 5; so does staying in 2."""
    table = {0: {0: [(1.0, 1, 0.0, False)], 1: [(1.0, 3, 1.0, True)]}, 1: {0: [(1.0, 1, 5.0, True)]},
             2: {0: [(0.5, 2, 4.0, True), (0.5, 2, 0.0, False)]}, 3: {0: [(1.0, 0, -1.0, False)]}}  # fmt: skip
    model = Model.model_validate(from_table(table))
    assert set(model.states) == {"0", "1", "2"}
    assert outcomes(model, "1", "0") == {"over": (1, 5)}
    assert outcomes(model, "2", "0") == {"over": (Fraction(1, 2), 4), "2": (Fraction(1, 2), 0)}
    assert outcomes(model, "0", "1") == {"3": (1, 1)}
    assert set(model.terminal) == {"3", "over"}


def test_a_state_is_left_however_long_the_way_to_it_is() -> None:
    """A leads to B, B to Y, Y to X, whence 100 are earned; A's other action ends the episode in X or in Y."""
    table = {"A": {0: [(1, "B", 0, False)], 1: [("1/2", "Y", 0, True), ("1/2", "X", 0, True)]},
             "B": {0: [(1, "Y", 0, False)]}, "Y": {0: [(1, "X", 0, False)]},
             "X": {0: [(1, "Z", 100, True)]}}  # fmt: skip
    model = Model.model_validate(from_table(table))
    assert outcomes(model, "X", "0") == {"Z": (1, 100)}
    assert outcomes(model, "Y", "0") == {"X": (1, 0)}
    assert outcomes(model, "A", "1") == {"over": (1, 0)}
    assert set(model.terminal) == {"Z", "over"}


def test_a_state_that_is_called_over_is_no_end() -> None:
    """B is entered by what ends the episode and by what does not, and left for "over", whence 100 are earned."""
    table = {"A": {0: [(1, "B", 1, True)]}, "C": {0: [(1, "B", 0, False)]}, "B": {0: [(1, "over", 5, False)]},
             "over": {0: [(1, "end", 100, True)]}}  # fmt: skip
    model = Model.model_validate(from_table(table))
    assert outcomes(model, "A", "0") == {"over_2": (1, 1)}
    assert outcomes(model, "over", "0") == {"end": (1, 100)}
    assert set(model.terminal) == {"end", "over_2"}


def test_what_cannot_happen_ends_nothing() -> None:
    table = {0: {0: [(1.0, 1, 0.0, False), (0.0, 1, 0.0, True)]}, 1: {0: [(1.0, 0, 7.0, False)]}}
    assert outcomes(Model.model_validate(from_table(table)), "1", "0") == {"0": (1, 7)}


@pytest.mark.parametrize("terminal", ["2", 2, ["2"], [2]])
@pytest.mark.parametrize(
    "model",
    [{"P": [[[0, 1, 0], [0, 0, 1], [0, 0, 1]]], "R": [1, 1, 1]}, {"transitions": [[0, 1, 1, 1], [1, 2, 1, 1]]}],
    ids=["arrays", "rows"],
)
def test_one_terminal_state_needs_no_brackets(model: dict[str, Any], terminal: Any) -> None:
    given = family("policy-value").read({"gamma": "1/2", "mdp": model | {"terminal": terminal}})
    assert given.mdp.terminal == ("2",)  # type: ignore[attr-defined]


def test_a_terminal_state_of_two_digits_is_one_state() -> None:
    chain = [[[float(after == state + 1) for after in range(13)] for state in range(12)] + [[0.0] * 12 + [1.0]]]
    assert Model.model_validate({"P": chain, "R": [1] * 13, "terminal": "12"}).terminal == ("12",)


@pytest.mark.parametrize("nothing", [0, 0.0, "0.0", "0/1", "-0"])
def test_an_end_may_be_given_its_reward_of_nothing(nothing: Any) -> None:
    model = {"transitions": [["s", "t", 1]], "rewards": {"s": 1, "t": nothing}}
    assert outcomes(Model.model_validate(model), "s", "step") == {"t": (1, 1)}


def test_a_square_alone_is_a_process_without_actions() -> None:
    for rewards in ([1, 0], [[1, 1], [0, 0]]):
        model = Model.model_validate({"P": [[0.5, 0.5], [0, 1]], "R": rewards})
        assert model == Model.model_validate({"transitions": [[0, 0, "1/2", 1], [0, 1, "1/2", 1], [1, 1, 1, 0]]})


def test_a_grid_may_be_a_list_of_its_rows() -> None:
    drawn = {"rewards": {"G": 1}, "ends": ["G", "H"]}
    text = Model.model_validate({"grid": "SF\nHG"} | drawn)
    assert Model.model_validate({"grid": ["SF", "HG"]} | drawn) == text
    assert Model.model_validate({"grid": [["S", "F"], ["H", "G"]]} | drawn) == text


def test_names_of_cells_that_mean_nothing_are_told() -> None:
    told: list[str] = []
    Model.model_validate({"grid": "SF\nHG", "rewards": {"G": 1}}, context=told.append)
    assert told == ["took F and H, with no reward and no end, for free cells"]


def test_gymnasiums_environments() -> None:
    pytest.importorskip("gymnasium")
    lake = Model.model_validate({"gymnasium": "FrozenLake-v1"})
    assert len(lake.states) == 11  # 16 cells, four holes and a goal
    assert lake.terminal == ("5", "7", "11", "12", "15")
    assert outcomes(lake, "14", "2") == {
        "14": (Fraction(1, 3), 0), "15": (Fraction(1, 3), 1), "10": (Fraction(1, 3), 0)
    }  # fmt: skip
    with pytest.raises(ValidationError, match="no table of transitions"):
        Model.model_validate({"gymnasium": "CartPole-v1"})
    with pytest.raises(ValidationError, match="cannot make 'NoSuch-v0'"):
        Model.model_validate({"gymnasium": "NoSuch-v0"})


@pytest.mark.parametrize("schema", [*SCHEMAS, Grid.model_json_schema()], ids=lambda schema: schema["required"][0])
def test_the_examples_of_the_fields_of_a_form_make_a_model(schema: dict[str, Any]) -> None:
    if "file" in schema["required"]:
        return  # it is read beside a problem file, and tested where these are
    if "gymnasium" in schema["required"]:
        pytest.importorskip("gymnasium")
    examples = {name: field["examples"][0] for name, field in schema["properties"].items() if field.get("examples")}
    assert set(schema["required"]) <= set(examples)
    assert Model.model_validate(examples).states


def test_probabilities_sum_to_one_with_a_parameter_and_its_complement() -> None:
    half, p, rest = Fraction(1, 2), Parameter("p"), Parameter("1-p")
    assert sums_to_one([half, half])
    assert sums_to_one([p, rest])
    assert sums_to_one([rest, p])
    assert not sums_to_one([half, Fraction(1, 4)])
    assert not sums_to_one([p, p])
    assert not sums_to_one([rest])
    assert not sums_to_one([p, rest, half])
    assert not sums_to_one([p, Parameter("1-q")])
    assert not sums_to_one([p, half])


@pytest.mark.parametrize(
    "drawn", ["S . .\n. # G", "  S . .\n  . # G", "|S|.|.|\n|.|#|G|", "| S | . | . |\n| . | # | G |"]
)
def test_a_grid_may_be_drawn_with_blanks_or_bars_between_its_cells(drawn: str) -> None:
    # r1c1 is three moves from r2c3: right, right, down
    given = {"mdp": {"grid": drawn, "step": -1, "ends": ["G"]}, "gamma": 1}
    assert solved("optimal-value", **given)["a"] == {"r1c1": -3, "r1c2": -2, "r1c3": -1, "r2c1": -4}


@pytest.mark.parametrize(
    "written",
    [
        "s\ta\ts'\tprob\tr\nA\tgo\tB\t50%\t1\nA\tgo\tend\t0,5\t-1\nB\tgo\tend\t1\t2\n",
        "\n\ns\ta\ts'\tp\tr\nA\tgo\tB\t0,5\t1\nA\tgo\tend\t0,5\t-1\nB\tgo\tend\t1\t2\n",
        "\nsep=;\ns;a;s';p;r\nA;go;B;0,5;1\nA;go;end;0,5;-1\nB;go;end;1;2\n",
        "\nstate,action,next,p,reward\nA,go,B,1/2,1\nA,go,end,1/2,-1\nB,go,end,1,2\n",
        "|s|a|s'|p|r|\n|--|--|--|--|--|\n|A|go|B|1/2|1|\n|A|go|end|1/2|-1|\n|B|go|end|1|2|",
        [
            {"s": "A", "a": "go", "s'": "B", "p": 0.5, "r": 1},
            {"s": "A", "a": "go", "s'": "end", "p": 0.5, "r": -1},
            {"s": "B", "a": "go", "s'": "end", "p": 1, "r": 2},
        ],
    ],
)
def test_transitions_may_be_a_table_that_is_pasted(written: object) -> None:
    # B: 2; A: (1 + 9/10·2)/2 − 1/2 = 9/10
    given = {"mdp": {"transitions": written, "terminal": ["end"]}, "gamma": "9/10"}
    assert solved("optimal-value", **given)["a"] == {"A": fmpq(9, 10), "B": 2}


@pytest.mark.parametrize(
    ("written", "says"),
    [
        ("A go B 1\nB go A 1", "transitions: the column 'A go B 1' is not known; call the columns state, action"),
        ("s,a,s',r\nA,go,B\n", "transitions: line 2 has 3 entries, the header has 4; make them equal"),
        ([{"s": "A", "a": "go", "r": 1}], "transitions: the column 'next' is missing"),
        ("s,a,s',cost\nA,go,B,5\n", "the column 'cost' holds costs; turn their signs, and call it reward"),
        ("s,a,s',r\nA,go,B,1\nB,,A,2\n", "'' is no name"),
    ],
)
def test_a_pasted_table_that_does_not_fit(written: object, says: str) -> None:
    with pytest.raises(ValidationError, match=re.escape(says)):
        Model.model_validate({"transitions": written})


@pytest.mark.parametrize(("P", "told"), [([[[1, 0], [0, 1]]], []), ([[[1, 0], [0, 1]], [[0, 1], [1, 0]]], [SQUARE])])
def test_it_is_told_how_arrays_are_read_whose_order_cannot_be_seen(P: object, told: list[str]) -> None:
    notes: list[str] = []
    read_form({"P": P, "R": [0, 1]}, notes.append)
    assert notes == told


#: Going leads from A to B and earns 5, half of the time; else it stays there for nothing. B ends.
GOES = [["A", "go", "B", "1/2", 5], ["A", "go", "A", "1/2", 0]]


@pytest.mark.parametrize(
    "model",
    [
        GOES,
        {"transitions": "A go B 1/2 5\nA go A 1/2 0"},
        "A, go, B, 1/2, 5\nA, go, A, 1/2, 0",
        {"transitions": "# a remark\nstate,action,next,p,r\nA,go,B,1/2,5\n,,A,1/2,0\n"},
        {"transitions": "Zustand;Aktion;Folgezustand;Wahrscheinlichkeit;Belohnung\nA;go;B;0,5;5\nA;go;A;0,5;0\n"},
        {"transitions": "# s,a,s',p,r\nA,go,B,.5,5\n#\nA,go,A,.5,0\n".replace("#\n", "")},
        {"transitions": {"A": {"go": {"B": ["1/2", 5], "A": ["1/2", 0]}}}},
    ],
)
def test_rows_alone_without_a_header_or_inside_tables(model: object) -> None:
    assert Model.model_validate(model) == process(*GOES)


def test_tables_inside_tables_with_rewards_beside_them() -> None:
    """By state and action, whose next state is enough where it is certain; without actions by state alone."""
    certain = {
        "transitions": {"A": {"go": "B", "stay": "A"}, "B": {"go": {"A": 1}}},
        "rewards": {"A": 3, "B": {"go": 2}},
    }
    rows = [["A", "go", "B", 1, 3], ["A", "stay", "A", 1, 3], ["B", "go", "A", 1, 2]]
    assert Model.model_validate(certain) == process(*rows)
    alone = {"P": {"A": {"A": "1/2", "B": "1/2"}, "B": {"B": 1}}, "R": {"A": 1, "B": 2}}
    rows = [["A", "A", "1/2", 1], ["A", "B", "1/2", 1], ["B", "B", 1, 2]]
    assert Model.model_validate(alone) == process(*rows)
    with pytest.raises(ValidationError, match="'A' must have a table of its actions"):
        Model.model_validate({"transitions": {"A": "B"}})


@pytest.mark.parametrize(
    ("P", "R"),
    [
        ("[[[0, 1], [1, 0]], [[1/2, 1/2], [0, 1]]]", "[0, 3]"),
        ("array([[[0. , 1. ],\n        [1. , 0. ]],\n\n       [[0.5, 0.5],\n        [0. , 1. ]]])", [0, 3]),
        ({"0": [[0, 1], [1, 0]], "1": [["1/2", "1/2"], [0, 1]]}, [0, 3]),
        ({"0": "[0 1; 1 0]", "1": "[1/2 1/2; 0 1]"}, {"0": [0, 3], "1": [0, 3]}),
        ([[[0, 1], [1, 0]], [["1/2", "1/2"], [0, 1]]], "[0 0; 3 3]"),
    ],
)
def test_arrays_as_text_and_by_the_names_of_the_actions(P: Any, R: Any) -> None:
    rows = [["0", "0", "1", 1, 0], ["0", "1", "0", "1/2", 0], ["0", "1", "1", "1/2", 0], ["1", "0", "0", 1, 3],
            ["1", "1", "1", 1, 3]]  # fmt: skip
    assert Model.model_validate({"P": P, "R": R}) == process(*rows)


@pytest.mark.parametrize(
    "names",
    [{"states": ["low", "high"], "actions": ["go", "stay"]}, {"states": ["low", "high"], "actions": ["go", "stay"],
                                                             "R": {"low": 0, "high": 3}}],
)  # fmt: skip
def test_arrays_with_names(names: dict[str, Any]) -> None:
    P = [[[0, 1], [1, 0]], [["1/2", "1/2"], [0, 1]]]
    rows = [["low", "go", "high", 1, 0], ["low", "stay", "low", "1/2", 0], ["low", "stay", "high", "1/2", 0],
            ["high", "go", "low", 1, 3], ["high", "stay", "high", 1, 3]]  # fmt: skip
    assert Model.model_validate({"P": P, "R": [0, 3]} | names) == process(*rows)
    by_action = {"P": dict(zip(("go", "stay"), P, strict=True)), "R": {"low": 0, "high": 3}, "states": ["low", "high"]}
    assert Model.model_validate(by_action) == process(*rows)
    ends = {"P": P, "R": [0, 3], "terminal": "high"} | names
    assert Model.model_validate(ends).terminal == ("high",)


def test_arrays_by_the_names_of_actions_take_their_order_and_names_from_a_list() -> None:
    go, stay = [[0, 1], [1, 0]], [["1/2", "1/2"], [0, 1]]
    named = {"R": [[0, 1], [2, 3]], "states": ["low", "high"], "actions": ["go", "stay"]}
    plain = Model.model_validate({"P": [go, stay]} | named)
    assert Model.model_validate({"P": {"stay": stay, "go": go}} | named) == plain
    assert Model.model_validate({"P": {"0": go, "1": stay}} | named) == plain
    with pytest.raises(ValidationError, match="actions: go, stay are not those of P, a, b"):
        Model.model_validate({"P": {"a": go, "b": stay}} | named)
    same = {"states": ["a", "b"], "actions": ["b", "a"], "R": {"a": [1, 2], "b": [3, 4]}}
    with pytest.raises(ValidationError, match="its names are those of states and of actions"):
        Model.model_validate({"P": [go, stay]} | same)


@pytest.mark.parametrize("names", [("x", "y"), ("p", "q"), ("1", "2"), ("0", "1"), ("A", "B")])
def test_what_an_action_leads_to_for_sure_may_have_any_name(names: tuple[str, str]) -> None:
    one, two = names
    table = {one: {"go": two, "stay": one}, two: {"go": {one: "1/2", two: "1/2"}}}
    rows = [[one, "go", two, 1, 1], [one, "stay", one, 1, 1], [two, "go", one, "1/2", 2], [two, "go", two, "1/2", 2]]
    assert Model.model_validate({"transitions": table, "rewards": {one: 1, two: 2}}) == process(*rows)
    alone = {one: {one: "1/2", two: "1/2"}, two: {two: 1}}
    rows = [[one, one, "1/2", 1], [one, two, "1/2", 1], [two, two, 1, 2]]
    assert Model.model_validate({"transitions": alone, "rewards": {one: 1, two: 2}}) == process(*rows)


@pytest.mark.parametrize(
    ("P", "R", "says"),
    [
        ("[[1, 0], [0, 1]", [0, 0], "the brackets of the array '[[1, 0], [0, 1]' do not fit"),
        ("]", [0, 0], "the brackets of the array ']' do not fit"),
        ("[" * 5000 + "1" + "]" * 5000, [0], "the brackets of the array '[[[[[[[[[[[[[[[[[[[[' do not fit"),
        ({"go": [[1, 0], [0, 1]], "stay": [[1, 0], [0, 1]]}, {"go": [0, 0]}, "R: the rewards of 'stay' are missing"),
        (
            {"go": [[1, 0], [0, 1]]},
            {"go": [0, 0], "stay": [0, 0]},
            "R: 'stay' is the name of no state and of no action",
        ),
    ],
)
def test_arrays_that_do_not_fit(P: Any, R: Any, says: str) -> None:
    with pytest.raises(ValidationError, match=re.escape(says)):
        Model.model_validate({"P": P, "R": R})


def test_every_state_of_the_arrays_needs_a_name_of_its_own() -> None:
    for states in (["A"], ["A", "A"], ["A", "B", "C"]):
        with pytest.raises(ValidationError, match=f"states: {len(states)} names are given for 2 states"):
            Model.model_validate({"P": [[[1, 0], [0, 1]]], "R": [0, 0], "states": states})


def test_it_is_told_which_index_of_the_rewards_is_which() -> None:
    notes: list[str] = []
    read_form({"P": [[[1, 0], [0, 1]], [[0, 1], [1, 0]]], "R": [[0, 1], [2, 3]]}, notes.append)
    assert notes == [SQUARE.replace(",", " and R for R[state][action],")]
    notes.clear()
    read_form({"P": [[[1, 0], [0, 1]], [[0, 1], [1, 0]]], "R": [[[0, 1], [2, 3]]] * 2}, notes.append)
    assert notes == [SQUARE]


def test_rows_of_numbers_that_could_be_another_process_are_told() -> None:
    told: list[str] = []
    rows = [[0, 0, 0, 0], [0, 1, 1, 5], [1, 0, 0, 0], [1, 1, 1, 0]]  # or [state, action, next, reward]
    read_form({"transitions": rows}, told.append)
    assert told == [
        "took rows of four for [state, next, probability, reward], without actions; with actions, write all five"
    ]
    told.clear()
    read_form({"transitions": [["a", "b", 0.5, 1], ["a", "a", 0.5, 0], ["b", "a", 1, 0]]}, told.append)
    assert told == []
