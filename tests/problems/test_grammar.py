"""One grammar for answers and problem files: what a text is read as, in all its spellings, and where it is refused."""

from collections.abc import Callable
from random import Random

import pytest
from flint import fmpq
from hypothesis import assume, given
from hypothesis import strategies as st

from promptness import at_once
from rldrill.problems.exact import read_fraction
from rldrill.problems.expressions import letters, parsed, worked_out, written
from rldrill.problems.fractions import Fraction
from rldrill.problems.grammar import read
from rldrill.problems.latex import typed
from rldrill.problems.notation import ATOM, POWER, PRODUCT, SUM, Name, Node, Numeral, Operation, nodes, rank
from rldrill.problems.spelling import Unreadable
from rldrill.render.unicode import unicode
from rldrill.solutions.answers.text import read_number
from rldrill.solutions.rational import RationalFunction

F = Fraction
GAMMA = F(1, 3)  # the value of γ in all of these tests


def n(value: int) -> Node:
    return Numeral(F(value), str(value))


def op(sign: str, *parts: Node) -> Node:
    return Operation(sign, parts)


def tree(text: str) -> Node:
    return read(typed(text, 500))


def as_answer(text: str) -> Fraction:
    value = read_number(text, ["gamma"]).value
    if isinstance(value, RationalFunction):
        value = value.top(fmpq(1, 3)) / value.bottom(fmpq(1, 3))
    assert isinstance(value, fmpq)
    return F(int(value.p), int(value.q))


def as_dynamics(text: str) -> Fraction:
    return worked_out(text, {"γ": GAMMA}, {}, F)


γ, a, b, c, x, θ = map(Name, ("γ", "a", "b", "c", "x", "θ"))

STRUCTURES = {
    "-2^2": op("-", op("^", n(2), n(2))),
    "(-2)^2": op("^", op("-", n(2)), n(2)),
    "2^-2": op("^", n(2), op("-", n(2))),
    "2^3^2": op("^", n(2), op("^", n(3), n(2))),
    "2³²": op("^", n(2), n(32)),
    "a-b-c": op("-", op("-", a, b), c),
    "a-(b-c)": op("-", a, op("-", b, c)),
    "a/b*c": op("*", op("/", a, b), c),
    "a/b/c": op("/", op("/", a, b), c),
    "a*b/c": op("/", op("*", a, b), c),
    "-a*b": op("-", op("*", a, b)),
    "a*-b": op("*", a, op("-", b)),
    "a*-b^2": op("*", a, op("-", op("^", b, n(2)))),
    "a*-b*c": op("*", op("*", a, op("-", b)), c),
    "-a-b": op("-", op("-", a), b),
    "- -a": a,
    "-+-+-a": op("-", a),
    "a--b": op("-", a, op("-", b)),
    "2a": op("*", n(2), a),
    "2a^2": op("*", n(2), op("^", a, n(2))),
    "a^2 b": op("*", op("^", a, n(2)), b),
    "a²b": op("*", op("^", a, n(2)), b),
    "a⁻²": op("^", a, op("-", n(2))),
    "a b/c": op("/", op("*", a, b), c),
    "(a)(b)c": op("*", op("*", a, b), c),
    "a(b + c)": op("*", a, op("+", b, c)),
    "θγ": op("*", θ, γ),
    "θ_1 γ": op("*", Name("θ_1"), γ),
    "½a": op("*", Numeral(F(1, 2), "1/2"), a),
    "¾²": op("^", Numeral(F(3, 4), "3/4"), n(2)),
    "1 3/4": Numeral(F(7, 4), "7/4"),
    "1¾ + a": op("+", Numeral(F(7, 4), "7/4"), a),
    "a - 1 3/4": op("-", a, Numeral(F(7, 4), "7/4")),
    "5%": op("%", n(5)),
    "5%²": op("^", op("%", n(5)), n(2)),
    "-5%": op("-", op("%", n(5))),
    "sin θ": op("sin", θ),
    "sin θ + a": op("+", op("sin", θ), a),
    "a sin θ*b": op("*", op("*", a, op("sin", θ)), b),
    "sin(θ)/a": op("/", op("sin", θ), a),
    "SIN(θ)^2": op("^", op("sin", θ), n(2)),
    "√2/2": op("/", op("sqrt", n(2)), n(2)),
    "√(2/3)": op("sqrt", op("/", n(2), n(3))),
    "ln3": op("ln", n(3)),
    "a¹²³": op("^", a, n(123)),
    "max(a, b, c)": op("max", a, b, c),
    "0.(3)": Numeral(F(1, 3), "1/3"),
    "0.0(6) a": op("*", Numeral(F(1, 15), "1/15"), a),
    "a + 0.1666…": op("+", a, Numeral(F(1, 6), "1/6")),
    "0.142857142857...": Numeral(F(1, 7), "1/7"),
    "0.1\u03058\u0305": Numeral(F(2, 11), "2/11"),
    "0.1\u030742857\u0307": Numeral(F(1, 7), "1/7"),
    "0.16\u0305": Numeral(F(1, 6), "1/6"),
    "∛8": op("^", n(8), Numeral(F(1, 3), "1/3")),
    "Sqrt[2]a": op("*", op("sqrt", n(2)), a),
    "np.exp(-a)": op("exp", op("-", a)),
    "Fraction(1, 4)": op("/", n(1), n(4)),
    "np.float64(2)": n(2),
    "a^{b - 1}": op("^", a, op("-", b, n(1))),
    r"\frac{a}{2}b": op("*", op("/", a, n(2)), b),
    r"\frac12": op("/", n(1), n(2)),
    r"\sqrt[3]{8}": op("^", n(8), op("/", n(1), n(3))),
    r"\sqrt 2": op("sqrt", n(2)),
    r"2\gamma\cdot a": op("*", op("*", n(2), γ), a),
    r"\left(a + b\right)\,c": op("*", op("+", a, b), c),
    r"\mathrm{e}^{-1}": op("^", Name("e"), op("-", n(1))),
    "٢/٤": op("/", n(2), n(4)),
    "२": n(2),
    "³⁄₄": op("/", n(3), n(4)),
}


@pytest.mark.parametrize("text", STRUCTURES)
def test_what_a_text_is_read_as(text: str) -> None:
    assert tree(text) == STRUCTURES[text]


VALUES = {
    "-2^2": F(-4), "2^3": F(8), "8/2*4": F(16), "8/2/2": F(2), "2 - 3 - 4": F(-5), "2*-3": F(-6), "1 3/4": F(7, 4),
    "-1 3/4": F(-7, 4), "1¾": F(7, 4), "½γ": F(1, 6), "2γ": F(2, 3), "γ²": F(1, 9), "2γ²": F(2, 9), "2(1 + γ)": F(8, 3),
    "γ(1 - γ)": F(2, 9), "75%": F(3, 4), "−γ": F(-1, 3), "γ**2": F(1, 9), "3·γ×2": F(2), "3÷4": F(3, 4), ".5": F(1, 2),
    "1e-2": F(1, 100), "6γ/2": F(1), "γ γ": F(1, 9), "(1/2)γ": F(1, 6), "1/(2γ)": F(3, 2), "2γ - γ": F(1, 3),
    "3.": F(3), "0.12345678901234567890123": F(12345678901234567890123, 10**23),
}  # fmt: skip


@pytest.mark.parametrize("text", VALUES)
def test_answers_and_files_agree(text: str) -> None:
    assert as_answer(text) == as_dynamics(text) == VALUES[text]
    if "γ" not in text:
        assert read_fraction(text) == VALUES[text]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("2θ", 10), ("θ²", 25), ("m l²", 63), ("m*l^2", 63), ("2(θ + ω)", 14), ("sin θ", 50), ("sin(θ)", 50),
        ("2sin θ", 100), ("½θ", 2.5), ("√4", 40), ("sqrt(θ)", 50), ("theta**2", 25), ("−θ", -5), ("θ·ω", 10),
        ("cos(2θ)^2", 10000), ("θω", 10), ("θ_1 ω", 22), ("-ω²/l", F(-4, 3)),
        ("sin^2(θ)", 2500), ("sin²(θ)", 2500), ("cos^{2}θ", 2500), ("sin^2 θ", 2500), ("m sin^3(ω) l", 168000),
        ("sin θ cos ω", 1000), ("sin²θ + cos²θ", 5000), ("sin^2(θ)^2", 6250000),
    ],
)  # fmt: skip
def test_files_read_what_answers_read(text: str, value: float) -> None:
    values = {"θ": F(5), "ω": F(2), "m": F(7), "l": F(3), "θ_1": F(11)}
    functions: dict[str, Callable[[Fraction], Fraction]] = dict.fromkeys(("sin", "cos", "sqrt"), lambda x: 10 * x)
    assert worked_out(text, values, functions, F) == value


@pytest.mark.parametrize(
    ("text", "column", "fault"),
    [
        ("1/2γ", 4, "two ways; write brackets"), ("γ/2(γ)", 4, "two ways; write brackets"),
        ("1/γγ", 4, "two ways; write brackets"), ("γ^2γ", 4, "two ways; write brackets"),
        ("1 2", 3, "two numbers with nothing between"), ("1 3/4.5", 3, "two numbers with nothing between"),
        ("γ 2", 3, "'2' follows without a sign"),
        ("½ ½", 3, "two numbers with nothing between"), ("5%γ", 3, "'γ' follows without a sign"),
        ("2/1 3/4", 3, "two ways here"), ("1 3/4γ", 1, "two ways here"), ("1¾^2", 1, "two ways here"),
        ("1 4/4", 1, "must be below one"), ("1 3/0", 1, "divides by zero"), ("2 + 1 3/4²", 5, "two ways here"),
        ("sin γ²", 6, "two ways; put it in brackets"), ("sin 2γ", 6, "two ways; put it in brackets"),
        ("sin γ/2", 6, "two ways; put it in brackets"),
        ("sin^-1(γ)", 4, "in brackets: sin"), ("sin^2", 4, "in brackets: sin"), ("ln^2(γ)", 3, "in brackets: ln"),
        ("sin^22(γ)", 4, "in brackets: sin"),
        ("sin γ ln γ", 7, "two ways; put it in brackets"), ("2 + sin -1", 9, "in brackets: sin"),
        ("1 + (γ*", 8, "missing after '*'"), ("1 + *2", 5, "missing before '*'"), ("(1 + γ", 7, "close the bracket"),
        ("(1))", 4, "not opened"), ("γ + @", 5, "'@' is not understood"), ("  γ + @", 7, "'@' is not understood"),
        ("1½ + @", 6, "'@' is not understood"), ("2⁺⁻", 2, "exponent"), ("γ\u200b", 2, "U+200B"), ("1,5γ", 2, "1.5"),
        ("[γ", 1, "is not closed"), ("1 + ." + "9" * 41, 5, "40 digits"),
        ("1e1001", 1, "1000 is the largest"), ("1 " + "9" * 41 + "/" + "9" * 42, 1, "40 digits"),
        ("ab + 1", 1, "'ab' is not"),
        ("γ + foo", 5, "'foo' is not"), ("γ + 50/2%", 7, "'50/2%' may be (50/2)% or 50/(2%)"),
        ("γ^2%", 2, "may be ^(2%) or (^2)%"), ("γ^1/3", 2, "may be ^(1/3) or (…^1)/3"),
        ("γ^-1/3", 2, "may be ^(-1/3) or (…^-1)/3"),
        ("1/4 / 1/2", 5, "may be …/(1/2) or (…/1)/2"), ("√9/16", 3, "two ways; put it in brackets"),
        ("2.5*10-1", 1, "'2.5*10-1' may be '2.5*10^-1' or '2.5*10 - 1'"), ("γ + 2.5 × 10 −1", 5, "'2.5*10^-1'"),
        ("2.5*103", 1, "may be 2.5*10^3 or 103*2.5"), ("10-1", 1, "may be '10^-1' or '10 - 1'"),
        ("1.2(34)", 1, "may be '611/495', its last digits repeated, or '1.2*34'"),
        ("0.142857...", 1, "does not show which digits repeat"),
        ("0.21112111...", 1, "may be '190009/900000' or '2111/9999'"),
        ("γ + 1'234", 6, "thousands separator; write '1234'"), ("1_234", 2, "thousands separator; write '1234'"),
        ("1 234", 3, "may be '1234' or two numbers"), ("1.234.567", 6, "write '1234567'"),
        ("1.234,5", 6, "write '1234.5'"), ("12,34,567.5", 3, "write '1234567.5'"),
        ("3,125", 2, "may be '3.125' or '3125'"),
        ("1\u066b5٢", 1, "mixes the digits of two scripts"), ("γ + 10₂", 5, "lowered digit"),
        ("γ + 5€", 6, "is a unit"),
        ("γ + \\frac{1}{2", 13, "not closed"), ("2\\frac12", 2, "may be 2 + 1/2 or 2*1/2"),
        ("γ\\foo", 2, "command '\\foo' is not understood"),
    ],
)  # fmt: skip
def test_both_refuse_and_name_the_column(text: str, column: int, fault: str) -> None:
    with pytest.raises(Unreadable) as refused:
        read_number(f"({text})" if text[0] == "[" else text, ["gamma"])
    assert fault in refused.value.message
    assert refused.value.position == column - 1 + (text[0] == "[")
    with pytest.raises(ValueError, match=f"column {column}: ") as complaint:
        parsed(text)
    assert fault in str(complaint.value)


@pytest.mark.parametrize(
    ("text", "column", "fault"),
    [
        ("x + e", 5, "the number e"), ("2x^5", 4, "from 1 to 4"), ("2x^0", 4, "from 1 to 4"),
        ("x^-1", 3, "from 1 to 4"), ("x^(1/2)", 5, "from 1 to 4"),
        ("x + ln(x)", 5, "'ln' is not understood in an expression"),
        ("max(x, u)", 1, "'max' is not understood"), ("x + m_", 6, "'_' is not understood"), ("t", 1, "the time"),
        ("x_1234", 1, "not a letter"), ("0x10", 2, "'x10' is not a letter"),
    ],
)  # fmt: skip
def test_what_dynamics_may_not_hold(text: str, column: int, fault: str) -> None:
    with pytest.raises(ValueError, match=f"column {column}: ") as complaint:
        parsed(text)
    assert fault in str(complaint.value)


@pytest.mark.parametrize(
    ("text", "column"), [("1 + 1/(γ-γ)", 6), ("2 + 3^1001", 6), ("2*√(0-2)", 3), ("γ + 2^γ", 6), ("1 + 0⁻¹", 6)]
)
def test_what_cannot_be_worked_out_is_refused_where_it_stands(text: str, column: int) -> None:
    with pytest.raises(Unreadable) as refused:
        read_number(text, ["gamma"])
    assert refused.value.position == column - 1


HOSTILE = ["9**9**9", "9^9^9^9", "(" * 10**5, "9" * 10**6, "-" * 250, "2^" * 149 + "2", "." + "9" * 41, "1\n" * 90]


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
@pytest.mark.parametrize("reader", [as_dynamics, read_fraction])
def test_hostile_texts_in_files_take_no_time(reader: Callable[[str], object], text: str) -> None:
    reader("1")  # what is imported for it is there now
    with at_once(), pytest.raises(ValueError, match=r".") as refused:
        reader(text)
    assert len(str(refused.value)) < 300
    assert "\n" not in str(refused.value)


def test_the_longest_that_is_read() -> None:
    assert as_dynamics("+".join("1" * 90)) == 90
    assert as_dynamics("-" + "+".join("1" * 90)) == 88
    with pytest.raises(ValueError, match="more than 180"):
        parsed("+".join("1" * 91))
    with pytest.raises(Unreadable, match="300 operations"):
        read_number("+".join("1" * 302))
    assert as_answer("+".join("1" * 301)) == 301
    assert as_answer("(" * 40 + "1" + ")" * 40) == 1
    assert as_answer("-" * 40 + "1") == 1
    assert as_answer("9" * 40) == as_dynamics("9" * 40) == read_fraction("9" * 40) == 10**40 - 1
    assert as_answer("*".join(["1^1"] * 50)) == 1  # powers side by side are not deep


def test_letters_stand_in_their_order_once() -> None:
    assert letters("(u - b ω - m g l sin θ)/(m l²)") == ("u", "b", "ω", "m", "g", "l", "θ")


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("a - (b + c)", "a − (b + c)"), ("a - b + c", "a − b + c"), ("-(a + b)", "−(a + b)"), ("-a*b", "−ab"),
        ("a*(b + c)", "a(b + c)"), ("(a + b)*c", "(a + b) c"), ("a*(b*c)", "abc"), ("2*3*a", "2·3a"),
        ("(a + b)^2", "(a + b)²"), ("(-a)^2", "(−a)²"), ("sin(θ)^2", "sin²(θ)"), ("sqrt(x)^2", "(√x)²"),
        ("sin(θ)*a", "sin(θ)·a"), ("a sin θ", "a sin(θ)"), ("m l² ω", "ml²ω"), ("½θ", "1/2·θ"), ("0.5θ", "1/2·θ"),
        ("5%*a", "5/100·a"), ("a/b*c", "a/b·c"), ("(a + b)/c", "(a + b)/c"), ("-a/b", "(−a)/b"),
    ],
)  # fmt: skip
def test_how_dynamics_are_set(text: str, shown: str) -> None:
    assert unicode(written(text)) == shown


MIXED = [Numeral(F(whole * 4 + 3, 4), str(F(whole * 4 + 3, 4))) for whole in range(1, 4)]
NUMERALS = (
    st.integers(0, 20).filter(lambda value: value != 10).map(n)  # 2*10-1 may have lost a superscript
    | st.sampled_from(["0.5", "2.25", "10.", "1e2"]).map(lambda text: Numeral(F(text), text))
    | st.sampled_from([Numeral(F(1, 2), "1/2"), Numeral(F(2, 3), "2/3"), *MIXED])
)


def combined(parts: st.SearchStrategy[Node]) -> st.SearchStrategy[Node]:
    return st.one_of(
        st.builds(op, st.sampled_from("+-*/"), parts, parts),
        st.builds(op, st.sampled_from("-%"), parts),
        st.builds(op, st.just("^"), parts, st.integers(2, 4).map(n)),
    )


TREES = st.recursive(NUMERALS | st.just(γ), combined, max_leaves=8)


def spelled(node: Node, random: Random, least: int = SUM) -> str:
    """A tree as a person may type it: with other signs, more brackets and spaces, and fewer signs of products."""
    gap = random.choice(["", " "])
    if isinstance(node, Numeral):
        text = node.text
        if node in MIXED:
            whole = node.value // 1
            return f"({random.choice([f'{whole} 3/4', f'{whole}¾', f'{whole} ¾'])})"
        text = {"1/2": "½", "2/3": "⅔"}.get(text, text)
    elif isinstance(node, Name):
        text = node.text
    elif node.sign == "%":
        text = f"{spelled(node.parts[0], random, ATOM)}{gap}%"
    elif node.sign == "^":
        base, exponent = spelled(node.parts[0], random, ATOM), spelled(node.parts[1], random, ATOM)
        raised = "⁰¹²³⁴"[int(exponent)] if exponent.isdigit() else f"^{exponent}"
        text = base + random.choice([f"{gap}^{gap}{exponent}", f"**{exponent}", raised])
    elif len(node.parts) == 1:
        text = random.choice("-−–") + gap + spelled(node.parts[0], random, PRODUCT)
    else:
        sign = random.choice({"-": "-−", "*": "*·×", "/": "/÷"}.get(node.sign, node.sign))
        sides = (SUM, PRODUCT) if node.sign in "+-" else (PRODUCT, POWER)
        left, right = (spelled(part, random, side) for part, side in zip(node.parts, sides, strict=True))
        if node.sign == "/":  # 50/2% and 1/4 / 1/2 may be read in two ways
            gap, right = "", f"({right})" if right.endswith("%") else right
        alone = isinstance(node.parts[0], Numeral | Name) or left.endswith(")")
        simple = alone and not isinstance(node.parts[0], Operation) and (right == "γ" or right.startswith("("))
        simple &= "." not in left  # 0.1(6) may be 1/6
        implicit = node.sign == "*" and simple and random.random() < 0.7
        text = f"{left}{gap}{right}" if implicit else f"{left}{gap}{sign}{gap}{right}"
    return f"({gap}{text}{gap})" if rank(node) < least or random.random() < 0.1 else text


#: The sign in whose column an operation stands; of a product without one, where the second factor begins.
SIGNS = {"+": "+", "-": "-−–", "*": "*·×γ(", "/": "/÷", "^": "^*¹²³⁴", "%": "%"}


@given(TREES, st.randoms(use_true_random=False))
def test_a_tree_is_read_back_from_all_its_spellings(written: Node, random: Random) -> None:
    text = spelled(written, random)
    assert tree(text) == written
    for node in nodes(tree(text)):
        assert not isinstance(node, Operation) or text[node.at] in SIGNS[node.sign]


@given(TREES, st.randoms(use_true_random=False))
def test_answers_and_dynamics_agree_on_the_value_of_every_tree(written: Node, random: Random) -> None:
    text = spelled(written, random)
    try:
        expected = as_dynamics(text)
    except ZeroDivisionError:
        assume(False)
    try:
        reading = read_number(text, ["gamma"])
    except Unreadable as refused:  # a number that grows too large, a quotient by what is zero for every γ; -½ (½)
        assert "too large" in refused.message or "may be" in refused.message  # noqa: PT017
        return
    assert as_answer(text) == expected
    if not reading.echo.endswith("…"):
        again = read_number(reading.echo, ["gamma"])
        assert again.value == reading.value
        assert as_dynamics(reading.echo) == expected


@given(TREES, st.randoms(use_true_random=False))
def test_a_slip_behind_anything_is_found_in_its_column(written: Node, random: Random) -> None:
    text = spelled(written, random)
    with pytest.raises(Unreadable) as refused:
        read_number(f"{text} + *", ["gamma"])
    assert refused.value.position == len(text) + 3


@pytest.mark.parametrize("text", ["0.133...", "0.12...", "0.3...", "1.4142…"])
def test_digits_that_do_not_show_how_they_go_on_are_refused(text: str) -> None:
    with pytest.raises(Unreadable, match="does not show which digits repeat"):
        tree(text)
