"""What numpy, PyTorch, MATLAB, R, pandas, LaTeX and JSON print, and what people draw, is read as it is meant."""

import pytest

import rldrill
from rldrill.solutions.answers.pasted import laid_out
from rldrill.solutions.answers.text import (
    Unreadable,
    read_choice,
    read_matrix,
    read_number,
    read_table,
    read_vector,
    read_words,
)

STATES, ENDS = ["cool", "warm"], ["overheated"]
PAIRS = [("cool", "fast"), ("cool", "slow"), ("warm", "fast"), ("warm", "slow")]
ACTIONS = {"cool": ["slow", "fast"], "warm": ["slow", "fast"]}


def refusal(read, *arguments) -> str:
    with pytest.raises(Unreadable) as caught:
        read(*arguments)
    return caught.value.message


VECTORS = [
    "np.array([1, 2])",
    "array([1., 2.])",
    "tensor([1., 2.], device='cuda:0', grad_fn=<AddBackward0>)",
    "torch.tensor([1, 2], dtype=torch.float64)",
    "[np.float64(1.0), np.float64(2.0)]",
    "[Fraction(1, 1), Fraction(4, 2)]",
    "matrix([[1, 2]])",
    "[[1.]\n [2.]]",
    "[1. 2.]",
    "[1, ...\n 2]",
    "(1, 2)^T",
    "(1, 2)^{\\top}",
    "[1 2]'",
    r"\begin{pmatrix}1\\2\end{pmatrix}",
    r"\begin{pmatrix} 1 & 2 \end{pmatrix}^T",
    r"\left[ 1, \frac{4}{2} \right]",
    "⎡1⎤\n⎣2⎦",
    '["1", "2"]',
    "1\t2",
    "| 1 | 2 |",
    "c(1, 2)",
    "[1] 1.0 2.0",
    "2-element Vector{Float64}:\n 1.0\n 2.0",
    "x = (1, 2) = (1.0, 2.0)",
    "x=1 y=2",
    "x: 1 y: 2",
    "x = 2/2 = 1.0\ny = 2",
    "x = 3 − 2\n  = 1\ny = 2",
    "y ← 2, x ← 1",
]


@pytest.mark.parametrize("text", VECTORS)
def test_vectors(text):
    assert [reading.value for reading in read_vector(text, 2, (), ["x", "y"])] == [1, 2]


MATRICES = [
    "[[1. 2.] [3. 4.]]",
    "[[1. 2.]\n [3. 4.]]",
    "array([[1., 2.],\n       [3., 4.]], dtype=float32)",
    "tensor([[1., 2.],\n        [3., 4.]])",
    "matrix([[1, 2], [3, 4]])",
    "Matrix([[1, 2], [3, 4]])",
    "np.array([[1, 3], [2, 4]]).T",
    "[1, 2; ...\n 3, 4]",
    "ans =\n\n     1     2\n     3     4\n",
    r"\begin{pmatrix}1&2\\3&4\end{pmatrix}",
    r"$$\begin{bmatrix} 1 & 2 \\ 3 & 4 \\ \end{bmatrix}$$",
    r"L_1 = \left( \begin{array}{cc} 1 & 2 \\ 3 & 4 \end{array} \right)",
    '[["1", "2"], ["3", "4"]]',
    "⎡1  2⎤\n⎣3  4⎦",
    "     ⎡1  2⎤\nL₁ = ⎣3  4⎦",
    "⎡1    2⎤\n⎢      ⎥\n⎣3    4⎦",
    "1\t2\n3\t4",
    "| 1 | 2 |\n|---|---|\n| 3 | 4 |",
    "[1 2; 3 4] = [1.0 2.0; 3.0 4.0]",
    "     ⎡1  2⎤⎡1  0⎤\nL₁ = ⎣3  4⎦⎣0  1⎦\n     ⎡1  2⎤\n   = ⎣3  4⎦",
    "L₁ =\n⎛1  2⎞\n⎝3  4⎠",
    "⎛1  2⎞⎛1  0⎞\n⎝3  4⎠⎝0  1⎠\n=\n⎛1  2⎞\n⎝3  4⎠",
]


@pytest.mark.parametrize("text", MATRICES)
def test_matrices(text):
    assert [[entry.value for entry in row] for row in read_matrix(text, (2, 2))] == [[1, 2], [3, 4]]


def test_a_label_may_stand_beside_any_row_of_a_matrix():
    text = "     ⎡1  2⎤\nL₁ = ⎢3  4⎥\n     ⎣5  6⎦"
    assert [[entry.value for entry in row] for row in read_matrix(text, (3, 2))] == [[1, 2], [3, 4], [5, 6]]


def test_an_entry_of_a_printed_matrix_may_be_a_sum():
    rows = read_matrix("⎡−2 − 3   4⎤\n⎣     1  −1⎦", (2, 2))
    assert [[entry.value for entry in row] for row in rows] == [[-5, 4], [1, -1]]
    assert [row[0].value for row in read_matrix(r"\begin{matrix} - 2 - 2 \sqrt{4} \\ 1 \end{matrix}", (2, 1))] == [
        -6,
        1,
    ]


TABLES = [
    "{'cool': 3.5, 'warm': 2.5}",
    '{"cool": "7/2", "warm": "5/2"}',
    "{'cool': np.float64(3.5), 'warm': Fraction(5, 2)}",
    "defaultdict(<class 'float'>, {'cool': 3.5, 'warm': 2.5})",
    "cool=3.5 warm=2.5",
    "cool: 3.5 warm: 2.5",
    "cool 3.5, warm 2.5",
    "cool 3.5 warm 2.5",
    "cool\t3.5\nwarm\t2.5",
    "cool, 3.5\nwarm, 2.5",
    "cool | 3.5\nwarm | 2.5",
    "| state | V |\n|---|---:|\n| cool | 3.5 |\n| warm | 2.5 |",
    "| cool | warm |\n|---|---|\n| 3.5 | 2.5 |",
    "      cool  warm\nV     3.5   2.5",
    "cool    3.5\nwarm    2.5\ndtype: float64",
    "[('cool', 3.5), ('warm', 2.5)]",
    "V(cool) = 7/2 = 3.5\nV(warm) = 5/2 = 2.5",
    "V(cool) ← 3 + 1/2\n        = 7/2\nV(warm) ← 5/2",
    "V = {cool: 3.5, warm: 2.5}",
    '{"V": [3.5, 2.5]}',
    "array([3.5, 2.5])",
    "c: 3.5, w: 2.5",
    "c=3.5 w=2.5",
    "V(c) = 3.5, V(w) = 2.5",
    r"$$V\left( \text{cool} \right) = \frac{7}{2}, V\left( \text{warm} \right) = 2.5$$",
    r"\begin{aligned} V(\text{cool}) &= \frac{7}{2} \\ V(\text{warm}) &= 2.5 \end{aligned}",
    "cool: 3.5, warm: 2.5, overheated: 0",
    "3.5, 2.5, 0",
    "3.5 2.5 0.0",
    "c=3.5 w=2.5 o=0",
    "cool 3.5\nwarm 2.5\noverheated 0",
    '{"cool": 3.5, "warm": 2.5, "overheated": null}',
    r"\hat{V}(\text{cool}) = 3.5, \hat{V}(\text{warm}) = 2.5",
    r"\bar V(cool) = 3.5, \bar{V}(warm) = 2.5",
    r"\widehat{V}_{cool} = 3.5; \widehat{V}_{warm} = 2.5",
    r"\operatorname{V}(\mathrm{cool}) = 3.5;\ V(\mathbf{warm}) = 2.5",
    r'{"c\u006fol": 3.5, "warm": 2.5}',
    r"\begin{align*} V(cool) &= 3.5 \\ V(warm) &= 2.5 \end{align*}",
    "┌──────┬─────┐\n│ cool │ 3.5 │\n├──────┼─────┤\n│ warm │ 2.5 │\n└──────┴─────┘",
    "+------+-----+\n| cool | 3.5 |\n+------+-----+\n| warm | 2.5 |\n+------+-----+",
    "OrderedDict([('cool', 3.5), ('warm', 2.5)])",
    "{'cool': array(3.5), 'warm': tensor(2.5, dtype=torch.float64)}",
    "state\nwarm    2.5\ncool    3.5\nName: V, dtype: float64",
]


@pytest.mark.parametrize("text", TABLES)
def test_tables(text):
    assert {key: reading.value * 2 for key, reading in read_table(text, STATES, (), ENDS).items()} == {
        "cool": 7,
        "warm": 5,
    }


PAIRED = [
    "[[1, 2], [3, 4]]",
    "array([[1., 2.],\n       [3., 4.]])",
    "1 2\n3 4",
    "cool: [1, 2], warm: [3, 4]",
    '{"cool": {"fast": "1", "slow": "2"}, "warm": {"fast": "3", "slow": "4"}}',
    "{'cool': {'fast': 1, 'slow': 2}, 'warm': {'fast': 3, 'slow': 4}, 'overheated': {}}",
    "|      | fast | slow |\n|------|------|------|\n| cool | 1    | 2    |\n| warm | 3    | 4    |",
    "| | cool | warm |\n| fast | 1 | 3 |\n| slow | 2 | 4 |",
    "      fast  slow\ncool   1.0   2.0\nwarm   3.0   4.0",
    "\tfast\tslow\ncool\t1\t2\nwarm\t3\t4",
    "cool\tfast\t1\ncool\tslow\t2\nwarm\tfast\t3\nwarm\tslow\t4",
    "cool fast 1, cool slow 2, warm fast 3, warm slow 4",
    "Q(c,f)=1 Q(c,s)=2 Q(w,f)=3 Q(w,s)=4",
]


@pytest.mark.parametrize("text", PAIRED)
def test_tables_over_pairs(text):
    table = read_table(text, PAIRS, (), ENDS)
    assert [table[pair].value for pair in PAIRS] == [1, 2, 3, 4]


POLICIES = [
    "cool -> fast, warm -> slow",
    "cool fast, warm slow",
    "cool=f warm=s",
    "f, s",
    "F S",
    '{"cool": "fast", "warm": "slow"}',
    "np.array(['fast', 'slow'], dtype='<U4')",
    "| cool | fast |\n| warm | slow |",
    "cool\twarm\nfast\tslow",
    "fast\nslow",
    "π(cool) = arg maxₐ {86/25; 122/25} = fast\nπ(warm) = slow",
    r"\pi(\text{cool}) = \text{fast}, \pi(\text{warm}) = \text{slow}",
    "fast, slow, -",
    "fast slow –",
    "cool: fast, warm: slow, overheated: -",
    "cool: fast, warm: slow, overheated: none",
]


@pytest.mark.parametrize("text", POLICIES)
def test_policies(text):
    assert read_words(text, STATES, ACTIONS, ENDS) == {"cool": ("fast",), "warm": ("slow",)}


TIED = [
    "cool: fast or slow, warm: slow",
    "cool: slow/fast; warm: slow",
    "cool: {slow, fast}, warm: slow",
    "slow or fast, slow",
    "cool: fast, slow, warm: slow",
    '{"cool": ["slow", "fast"], "warm": "slow"}',
    '[["slow", "fast"], "slow"]',
    "cool = s/f warm = s",
    "π(cool) = slow or fast\nπ(warm) = slow",
    "cool: slow and fast; warm: slow",
]


@pytest.mark.parametrize("text", TIED)
def test_tied_actions(text):
    assert read_words(text, STATES, ACTIONS, ENDS) == {"cool": ("slow", "fast"), "warm": ("slow",)}


@pytest.mark.parametrize("text", ["E, S", "E or S", "{E, S}", "E/S", "E|S", "E & S", "[E, S]", "start: E, S"])
def test_of_one_state_a_list_is_a_tie(text):
    assert read_words(text, ["start"], {"start": ["N", "E", "S", "W"]}) == {"start": ("E", "S")}


# . . F
# . . .   with F terminal
CELLS, GOAL = ["r1c1", "r1c2", "r2c1", "r2c2", "r2c3"], ["r1c3"]
MOVES = {cell: ["up", "right", "down", "left"] for cell in CELLS}
DRAWN = [
    "→, →, ↑, ↑, ↑",
    "r1c1: →, r1c2: →, r2c1: ↑, r2c2: ↑, r2c3: ↑",
    "right right\nup up up",
    "→ → F\n↑ ↑ ↑",
    "→→F\n↑↑↑",
    "> > .\n^ ^ ^",
    ">>F\n^^^",
    "r r\nu u u",
    "E E #\nN N N",
    "east east\nnorth north north",
    "| → | → | F |\n| ↑ | ↑ | ↑ |",
    "[['→' '→' 'F']\n ['↑' '↑' '↑']]",
    "[['right','right',''],['up','up','up']]",
    "→ → F ↑ ↑ ↑",
    "➡️ ➡️\n⬆️ ⬆️ ⬆️",
    "r1c1 → →, r1c2 → →, r2c1 → ↑, r2c2 → ↑, r2c3 → ↑",
    "right, right; up, up, up",
    r"\rightarrow, \rightarrow, \uparrow, \uparrow, \uparrow",
]


@pytest.mark.parametrize("text", DRAWN)
def test_policies_in_the_shape_of_the_grid(text):
    policy = read_words(text, CELLS, MOVES, GOAL)
    assert [policy[cell] for cell in CELLS] == [("right",), ("right",), ("up",), ("up",), ("up",)]


@pytest.mark.parametrize(
    "text",
    [
        "0.5 1 0\n0.25 0.5 1",
        "0.5 1\n0.25 0.5 1",
        "0.5, 1, 0, 0.25, 0.5, 1",
        "[[0.5 1. 0.]\n [0.25 0.5 1.]]",
        "0.5 1 F\n0.25 0.5 1",
    ],
)
def test_values_in_the_shape_of_the_grid(text):
    assert [reading.value * 4 for reading in read_table(text, CELLS, (), GOAL).values()] == [2, 4, 1, 2, 4]


def test_walls_may_be_given_as_anything_or_left_out():
    # . # G
    # . . .
    cells, goal = ["r1c1", "r2c1", "r2c2", "r2c3"], ["r1c3"]
    for text in ("1 # 0\n2 3 4", "1 nan 0\n2 3 4", "1 0\n2 3 4", "1\n2 3 4", "1 9 0 2 3 4"):
        assert [reading.value for reading in read_table(text, cells, (), goal).values()] == [1, 2, 3, 4], text


def test_a_row_of_another_length_is_named():
    said = "Row 2 of the grid has {} entries; write 3, one for each cell."
    for text, entries in (("1 2 0\n3 4", 2), ("1 2 0\n3 4 5 6", 4)):
        assert refusal(read_table, text, CELLS, (), GOAL) == said.format(entries)


@pytest.mark.parametrize("arrow", ["←", ":=", "=", "→", "->", ":"])
def test_arrows_of_assignments(arrow):
    table = read_table(f"cool {arrow} 7/2, warm {arrow} 5/2", STATES, (), ENDS)
    assert {key: str(reading.value) for key, reading in table.items()} == {"cool": "7/2", "warm": "5/2"}


def test_all_states_by_their_numbers():
    # FrozenLake's first cells: 1 and 3 are terminal and stand between the others.
    assert [r.value for r in read_table("[7. 0. 5. 0. 4.]", ["0", "2", "4"], (), ["1", "3"]).values()] == [7, 5, 4]
    # A state that is worth nothing, too, leaves no doubt: the numbers say which of the zeros is whose.
    assert [r.value for r in read_table("[0. 0. 5. 0. 4.]", ["0", "2", "4"], (), ["1", "3"]).values()] == [0, 5, 4]
    # 2 comes before 10, whatever the letters say.
    assert {k: r.value for k, r in read_table("0 5 6 0", ["10", "2", "9"], (), ["1"]).items()} == {
        "2": 5,
        "9": 6,
        "10": 0,
    }


@pytest.mark.parametrize(
    ("text", "fragment"),
    [
        ("0, 2.5, 0", "may be read in 2 ways"),
        ("3.5, 2.5, 1", "3 numbers were read, 2 are needed"),
        ("cool: 3.5, warm: 2.5, overheated: 1", "'overheated' is terminal, so its value is 0"),
        ("wa'rm: 2.5, cool: 3.5", "'wa'rm' is not a key here"),
        ("war}m: 2.5, cool: 3.5", "'war}m' is not a key here"),
        ("war(m): 2.5, cool: 3.5", "'war(m)' is not a key here"),
        ("wârm: 2.5, cool: 3.5", "'wârm' is not a key here"),
        ("cool 3.5\nwarm 2.5\nhot 9", "'hot' is not a key here"),
        ("cool - 3.5, warm - 2.5", "may be a minus sign"),
        ("cool: 3.5 hot: 2.5", "holds two keys"),
        ("cool: 3, 5x, warm: 2", "'5x' is not understood; write it as cool: … ."),
        ("cool: 3, 5, warm: 2", "'3,5' may have a decimal comma; write '3.5'."),
        ("cool: 3.5 = 3.6, warm: 2", "differ"),
        ("cool: -1 warm: -0,5", "may have a decimal comma"),
    ],
)
def test_tables_refused(text, fragment):
    assert fragment in refusal(read_table, text, STATES, (), ENDS)


def test_a_first_letter_must_be_the_only_one():
    assert read_table("e: 1, m: 2", ["edge", "middle"])["edge"].value == 1
    assert "'e' may be any of edge, east" in refusal(read_table, "e: 1, east: 2", ["edge", "east"])
    assert "'e' may be any of edge, exit" in refusal(read_table, "e: 1, m: 2", ["edge", "middle"], (), ["exit"])
    actions = {state: ["stay", "slow", "fast"] for state in STATES}
    assert "'s' may be any of stay, slow" in refusal(read_words, "s, f", STATES, actions)


def test_a_point_of_the_compass_that_may_be_another_word_is_refused():
    assert "may be any of" in refusal(read_words, "e", ["s"], {"s": ["right", "exit"]})
    assert read_words("e", ["s"], {"s": ["right", "left"]}) == {"s": ("right",)}


def test_names_in_another_normal_form():
    assert read_table("fu\u0308r: 1, fur: 2", ["f\u00fcr", "fur"])["f\u00fcr"].value == 1


@pytest.mark.parametrize(
    ("text", "length"),
    [("-1 -0,5", 2), ("[-1 -0,5]", 2), ("-1\t-0,5", 2), ("0,5; 1,5", 2), ("0,5 1", 2), ("1 -2,5", 2), ("1,5 2 -3", 3)],
)
def test_decimal_commas_are_no_other_numbers(text, length):
    assert "has a decimal comma; write" in refusal(read_vector, text, length)


@pytest.mark.parametrize("text", ["0,5", "-0,5", "3,0", "[0,5]", "V = 0,5"])
def test_a_decimal_comma_is_no_terminal_state(text):
    assert "a decimal comma; write" in refusal(read_table, text, ["cool"], (), ENDS)
    assert read_table("3, 0", ["cool"], (), ENDS)["cool"].value == 3


@pytest.mark.parametrize("text", ["x = 1,2", "R = [1,2]", "(1,2)"])
def test_a_comma_between_digits_parts_two_entries_where_two_are_needed(text):
    assert [reading.value for reading in read_vector(text, 2)] == [1, 2]


def test_a_matrix_with_decimal_commas_is_refused():
    assert "0,5 has a decimal comma; write 0.5." in refusal(read_matrix, "0,5 1; 2 3", (2, 2))


@pytest.mark.parametrize(
    "text", ["x = 2 + 3 = 5", "5 = 5.0", "max{5; 2} = 5", "Fraction(10, 2)", "np.float64(5.0)", "array(5.)"]
)
def test_numbers(text):
    assert read_number(text).value == 5


def test_a_whole_number_may_be_a_rounded_one():
    assert read_number("6878/625 ≈ 11").value == read_number("6878/625").value


def test_forms_that_differ_are_refused():
    assert "differ" in refusal(read_number, "1/4 = 0.4")
    assert "are not equal" in refusal(read_matrix, "[1 2; 3 4] = [1 2; 3 5]", (2, 2))
    assert "'z' is not asked for here" in refusal(read_vector, "x = 1, z = 2", 2, (), ["x", "y"])


@pytest.mark.parametrize(
    "text", ["(b) rich", "b) rich", "b. rich", "b: rich", '"b"', "'rich'", "answer: b", r"\text{(b)}"]
)
def test_choices(text):
    assert read_choice(text, {"a": "poor", "b": "rich"}) == "b"


def test_a_letter_and_other_words_are_refused():
    said = refusal(read_choice, "(b) poor", {"a": "poor", "b": "rich"})
    assert "the letter of one option and words of another" in said


@pytest.mark.parametrize("text", [*VECTORS, *TABLES, *PAIRED, *POLICIES, *DRAWN])
def test_columns_are_kept(text):
    stacked = any(sign in text for sign in "⎡⎣")
    assert stacked or len(laid_out(text)) == len(text)


@pytest.mark.parametrize(
    "typed",
    ["0,0: 2, 0,1: 3", "'0,0': 2; '0,1': 3", '{"0,0": "2", "0,1": 3}', "(0,0): 2, (0,1): 3", "V(0,0)=2, V(0,1)=3"],
)
def test_coordinates_are_names_of_states(typed: str) -> None:
    rows = [["0,0", "go", "0,1", 1, 2], ["0,1", "go", "0,0", 1, 3]]
    given = {"gamma": "1/2", "sweeps": 1, "mdp": {"transitions": rows}}
    exercise = rldrill.read({"family": "value-iteration", "given": given})
    assert exercise.check(typed).outcome is rldrill.Outcome.RIGHT


def test_a_number_that_the_edge_of_the_terminal_tore_is_one() -> None:
    digits = "1234567890" * 4
    assert laid_out(f"R_0\n=\n{digits}\n{digits}/7\n11\n≈ 1.5") == f"R_0 = {digits}{digits}/711 ≈ 1.5"
    assert laid_out("1/4\n3") == "1/4\n3"


@pytest.mark.parametrize(
    "text",
    [
        "- a: -4\n- b: 4", "* a: -4\n* b: 4", "• a = -4\n• b = 4", "1. a: -4\n2. b: 4", "1) -4\n2) 4", "(a) -4\n(b) 4",
        "- -4\n- 4", "* -4\n\n* 4", "**a**: -4\n**b**: 4", "a = -4 and b = 4", "-4 and 4", "- **a**: -4\n- **b**: 4",
    ],
)  # fmt: skip
def test_lists_and_sentences(text: str) -> None:
    assert {key: str(reading.value) for key, reading in read_table(text, ["a", "b"]).items()} == {"a": "-4", "b": "4"}


def test_names_with_and_in_them_and_powers_stay() -> None:
    assert laid_out("rock and roll: 2**3, b: 2**2") == "rock and roll: 2**3, b: 2**2"
    assert laid_out("1. 2.\n2. 3.") == "1. 2.\n2. 3."  # rows as numpy prints them


def test_dashes_before_all_lines_may_be_signs() -> None:
    with pytest.raises(Unreadable, match="'- 4' may be '-4', or '4' in a list with dashes; leave the spaces or the"):
        read_vector("- 4\n- 5")
