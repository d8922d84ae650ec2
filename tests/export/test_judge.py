"""The page judges in the browser as rldrill does; its script is run here by the browser's own engine."""

import json
import re
from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import cache
from itertools import product
from types import MappingProxyType
from typing import Any

import pytest
from py_mini_racer import MiniRacer

import rldrill
from number_spellings import spellings
from rldrill.export.asked import Word, cells
from rldrill.export.html import task
from rldrill.export.page import beside
from rldrill.export.words import page_words
from rldrill.problems.catalogue import family
from rldrill.solutions.answers.judging import Outcome, read_answer
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.answers.rule import is_close, is_right
from rldrill.solutions.answers.text import Unreadable, read_number

READ = """
var said = (text) => {
  try { const value = Judge.read(text).value(0.5); return Array.isArray(value) ? value.join("/") : String(value); }
  catch (error) { if (!(error instanceof Judge.Unreadable)) throw error; return "unreadable"; }
};
var unread = (key, letters) => {
  try { Judge.right(Judge.read("1.5"), key, letters); return ""; }
  catch (error) { if (!(error instanceof Judge.Unreadable)) throw error; return error.message; }
};
"""
#: One problem for every form of answer: whole numbers, e, roots, logarithms, open parameters, words.
PROBLEMS = [
    "td-zero/2/234", "value-iteration/2/1", "policy-value/3/1", "softmax-policy/2/1",
    "rbf/3/1", "lqr-backward/3/1", "bandit/2/1", "lambda-return/3/1", "principle-of-optimality/1/2",
]  # fmt: skip


@cache
def engine() -> Callable[[str], Any]:
    machine = MiniRacer()
    machine.eval(beside("judge.js").replace("const Judge", "var Judge") + READ)
    return machine.eval


def judged(task: dict[str, Any], typed: list[str], told: Mapping[str, Any] = MappingProxyType({})) -> dict[str, Any]:
    given = ", ".join(map(json.dumps, (task, typed, dict(told))))
    verdict: dict[str, Any] = json.loads(engine()(f"JSON.stringify(Judge.part({given}))"))
    return verdict


def typed_cells(exercise: rldrill.Exercise, label: str, text: str) -> list[str]:
    """What is typed into each box of the page, from an answer that is typed as one text."""
    part = next(part for part in exercise.parts if part.label == label)
    read = read_answer(exercise.solution, part, text)
    return [
        cell if isinstance(cell, str) else cell[0] if isinstance(cell, tuple) else cell.echo for cell in read.values()
    ]


def test_the_page_reads_no_number_as_another_one() -> None:
    read = 0
    for _, (text, value) in spellings(1000, seed=5):
        said = engine()(f"said({json.dumps(text)})")
        if said == "unreadable":
            continue
        try:
            read_number(text)
        except Unreadable:
            continue  # the terminal asks back where the page takes the one meaning that it knows
        assert abs(float(Fraction(said)) - float(value)) <= 1e-9 * abs(float(value)), f"{text!r} was read as {said}"
        read += 1
    assert read > 300


@pytest.mark.parametrize(
    ("text", "value"), [("3/4", "3/4"), ("−0.75", "-3/4"), ("1 1/2", "3/2"), ("2½", "5/2"), ("75 %", "3/4"),
                        ("V(s) = 1/4 = 0.25", "1/4"), ("2·3 + 1", "7"), (r"\frac{3}{4}", "3/4"), ("1e-2", "1/100"),
                        ("2³", "8"), ("10·5", "50"), ("√9", "3"), ("-2^2", "-4"), ("(1+2)(3)", "9"), ("6/2*3", "9")],
)  # fmt: skip
def test_the_page_reads_what_people_type(text: str, value: str) -> None:
    assert Fraction(engine()(f"said({json.dumps(text)})")) == Fraction(value)


@pytest.mark.parametrize(
    "text", ["", "1,5", "1,234", "1/2/3", "2^3^2", "3/2%", "0.(3)", "1/2γ", "x", "1/0", "3 e -2", "alert(1)",
             "0·5", "-0⋅5", "V(s) = 0·5", "1 3/2", "3 6/4", "2 4/4"],
)  # fmt: skip
def test_the_page_asks_back_where_it_is_not_sure(text: str) -> None:
    assert engine()(f"said({json.dumps(text)})") == "unreadable"


@pytest.mark.parametrize(
    ("typed", "outcome"),
    [("0,667", "right"), ("0.667", "right"), ("2/3", "right"), (",667", "right"), ("6,67e-1", "right"),
     ("V(s, a) = 2/3 = 0,667", "right"), ("0,66", "close"), ("6,67", "wrong"), ("0{,}667", "right"),
     ("1.234", "unreadable"), ("1.234,5", "unreadable"), ("1,234,5", "unreadable"), ("0,667,", "unreadable")],
)  # fmt: skip
def test_with_decimal_commas_a_point_is_read_where_it_parts_no_thousands(typed: str, outcome: str) -> None:
    one = {"parameters": [], "cells": [{"name": "", "key": "2/3"}], "mistakes": []}
    assert judged(one, [typed], {"comma": True})["outcome"] == outcome


@pytest.mark.parametrize("identity", PROBLEMS)
def test_the_page_judges_as_the_library_does(identity: str) -> None:
    exercise = rldrill.load(identity)
    for part in exercise.parts:
        asked = task(exercise, part)
        samples = answer_kind(part.kind).samples(exercise.solution.answers[part.label])
        for text in (*samples.right[:1], *samples.wrong):
            verdict = judged(asked, typed_cells(exercise, part.label, text))
            assert (verdict["outcome"] == "right") == exercise.check(text, part.label).accepted, (identity, text)


@pytest.mark.parametrize("name", rldrill.families()[::2])
def test_the_page_reads_every_answer_that_it_holds(name: str) -> None:
    """Right and wrong ones: a key that it cannot read is a part that nothing is said of, whatever is typed."""
    exercise = rldrill.draw(name, family(name).levels[-1], 11)
    for part in exercise.parts:
        asked = task(exercise, part)
        known = [
            [cell["key"] for cell in asked["cells"] if "key" in cell],
            *(m["cells"] for m in asked["mistakes"]),
        ]
        for key in {key for keys in known for key in keys if isinstance(key, str)}:
            given = ", ".join(map(json.dumps, (key, asked["parameters"])))
            assert engine()(f"unread({given})") == "", (exercise.id, part.label, key)


@pytest.mark.parametrize(
    ("typed", "outcome", "says"),
    [("-5*cos(1)", "right", "Right."), ("-2.70", "right", "Right."), ("-2.69", "close", "Close, but"),
     ("5cos(1)", "misconception", "The sign."), ("sin(1)^2", "misconception", "A sine."), ("7", "wrong", "Not right.")],
)  # fmt: skip
def test_a_wrong_answer_that_has_no_value_keeps_no_other_from_being_told(typed: str, outcome: str, says: str) -> None:
    """−5·cos 1 = −2.7015…"""
    known = {"1/0": "None.", "whatever(2)": "None.", "5*cos(1)": "The sign.", "sin(1)^2": "A sine."}
    mistakes = [{"cells": [cell], "says": said} for cell, said in known.items()]
    one = {"parameters": [], "cells": [{"name": "", "key": "-5*cos(1)"}], "mistakes": mistakes}
    verdict = judged(one, [typed])
    assert (verdict["outcome"], verdict["says"][: len(says)]) == (outcome, says)


@pytest.mark.parametrize(
    ("text", "value"), [("log(2)^2", 0.480453), ("ln(2)²", 0.480453), ("sin(1)", 0.841471), ("tan(4)", 1.157821)]
)
def test_the_page_reads_functions_as_rldrill_writes_them(text: str, value: float) -> None:
    assert float(engine()(f"said({json.dumps(text)})")) == pytest.approx(value, abs=1e-6)


@pytest.mark.parametrize("text", ["tan(pi/2)", "tan(-pi/2)", "tan(5*pi/2)"])
def test_a_tangent_that_has_no_value_has_none_on_the_page(text: str) -> None:
    assert engine()(f"said({json.dumps(text)})") == "unreadable"


@pytest.mark.parametrize(
    ("typed", "outcome"),
    [("2/3", "right"), ("0.667", "right"), ("0.6662", "right"), ("0.6661", "close"), ("0.66", "close"),
     ("0.6", "wrong"), ("-2/3", "wrong"), ("33/50", "wrong"), ("sqrt(4/9 + 1/99)", "wrong"),
     ("0.6671", "right"), ("0.6672", "close")],
)  # fmt: skip
def test_three_significant_digits_are_enough(typed: str, outcome: str) -> None:
    """2/3 allows 0.0005 on either side: 0.66616… to 0.66716…"""
    one = {"parameters": [], "cells": [{"name": "", "key": "2/3"}], "mistakes": []}
    assert judged(one, [typed])["outcome"] == outcome


def test_the_bound_itself_is_right_and_what_lies_beyond_is_not() -> None:
    one = {"parameters": [], "cells": [{"name": "", "key": "1234"}], "mistakes": []}
    assert [judged(one, [typed])["outcome"] for typed in ("1229", "1239", "1239.001", "1228.999")] == [
        "right", "right", "close", "close",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("key", "letters", "typed", "outcome"),
    [
        # −0.96ρ is 4 % off, however small it is beside 30; −1.004ρ is −ρ to three digits, −1.006ρ is not.
        ("-rho - 30", ["rho"], "-0.96rho - 30", "wrong"), ("-rho - 30", ["rho"], "-1.004ρ - 30", "right"),
        ("-rho - 30", ["rho"], "-1.006rho - 30", "wrong"), ("200 + x/2", ["x"], "200.0 + x", "wrong"),
        ("200 + x/2", ["x"], "200.0", "wrong"), ("200 + x/2", ["x"], "0.5*(x + 400)", "right"),
        # 1/3 and 2/3 rounded, where the sum at many a point would need a fourth digit
        ("x/3 - 2/3", ["x"], "0.333x - 0.667", "right"), ("x/3 - 2/3", ["x"], "0.333x - 0.66", "wrong"),
        ("(2*gamma + 4)/(3 - gamma)", ["gamma"], "(0.667γ + 1.33)/(1 - 0.333γ)", "right"),
        ("(2*gamma + 4)/(3 - gamma)", ["gamma"], "(0.667γ + 1.33)/(1 - 0.34γ)", "wrong"),
        ("(2*gamma + 4)/(3 - gamma)", ["gamma"], "1.33/(1 - γ/3) + 0.667γ/(1 - γ/3)", "right"),
        # Two letters are two letters: 2γ + x is neither 2x + γ nor 3x.
        ("2*gamma + x", ["gamma", "x"], "2.0γ + x", "right"), ("2*gamma + x", ["gamma", "x"], "2.0x + γ", "wrong"),
        ("2*gamma + x", ["gamma", "x"], "3.0x", "wrong"), ("2*gamma + x", ["gamma", "x"], "2x + γ", "wrong"),
        ("x*gamma + x/3", ["gamma", "x"], "x(γ + 0.333)", "right"),
        # Not in lowest terms, as nobody takes the trouble
        ("(2 - gamma)/(3*(1 - gamma)^2)", ["gamma"], "0.33333/(1-γ) + 0.33333/(1-γ)^2", "right"),
        ("(2 - gamma)/(3*(1 - gamma)^2)", ["gamma"], "0.333/(1-γ) + 0.333/(1-γ)^2", "right"),
        ("(2 - gamma)/(3*(1 - gamma)^2)", ["gamma"], "0.34/(1-γ) + 0.33333/(1-γ)^2", "wrong"),
        ("(2 + gamma)/(6*(1 - gamma)^2)", ["gamma"], "0.333/(1-γ) + 0.5*γ/(1-γ)^2", "right"),
        ("(1 - 4*gamma/3)/(1 - gamma)^2", ["gamma"], "1.33/(1-γ) - 0.333/(1-γ)^2", "right"),
        ("100 + gamma + 100*gamma^2", ["gamma"], "(100 + 1.4*γ + 100.0*γ^2)*(1+γ)/(1+γ)", "wrong"),
        ("(2*gamma + 4)/(3 - gamma)", ["gamma"], "(2.0γ + 4)*(γ^2 + 0.1γ)/((3 - γ)*(γ^2 + 0.1γ))", "right"),
        # No quotient of polynomials: compared at points
        ("exp(gamma)/3", ["gamma"], "0.33333 e^γ", "right"), ("exp(gamma)/3", ["gamma"], "0.34 e^γ", "wrong"),
        ("sqrt(x)/3", ["x"], "0.33333 sqrt(x)", "right"), ("sqrt(x)/3", ["x"], "0.34 sqrt(x)", "wrong"),
    ],
)  # fmt: skip
def test_of_an_expression_each_number_is_right_to_three_digits(
    key: str, letters: list[str], typed: str, outcome: str
) -> None:
    one = {"parameters": letters, "cells": [{"name": "", "key": key}], "mistakes": []}
    assert judged(one, [typed])["outcome"] == outcome
    reading = read_number(typed, letters)
    assert is_right(reading.value, read_number(key, letters).value, rounded=reading.decimal) == (outcome == "right")


@pytest.mark.parametrize(
    ("key", "letters", "typed", "outcome"),
    [
        # √3/2 = 0.8660…, e^(−1/8) = 0.8824…, ln 2 + 3/4 = 1.4431…: the first is the answer, the other it rounded
        ("sqrt(3)/2", [], "sqrt(3)/2 ≈ 0.87", "right"), ("sqrt(3)/2", [], "√3/2 = 0.866", "right"),
        ("exp(-1/8)", [], "e^(-1/8) = 0.88", "right"), ("log(2) + 3/4", [], "log(2) + 3/4 ≈ 1.4", "right"),
        ("1/3", [], "1/3 ≈ 0.33", "right"), ("log(2)", ["x"], "log(2) ≈ 0.69", "right"),
        ("1/4", [], "1/4 = 25 %", "right"), ("1/200", [], "1/200 = 5e-3", "right"),
        ("pi", [], "π ≈ 3", "right"), ("2*gamma + 3", ["gamma"], "γ+1 = 2γ+3", "unreadable"),
        ("2/3", [], "2/3 = 0.66", "unreadable"), ("sqrt(3)/2", [], "0.87 = sqrt(3)/2", "unreadable"),
        ("log(2)", [], "ln 2 ≈ 0.69", "unreadable"),  # brackets are asked for
        # A name, also where it could be a number
        ("3", [], "V(s) = 3", "right"), ("3", [], "e = 3", "right"), ("3", ["p"], "p = 3", "right"),
        ("3", ["p", "x"], "P(x) = 3", "right"), ("E", [], "e = 2.718", "right"),
        ("exp(2)", [], "x = exp(2) = 7.389", "right"),
    ],
)  # fmt: skip
def test_a_number_may_stand_in_several_forms_and_a_name_before_it(
    key: str, letters: list[str], typed: str, outcome: str
) -> None:
    one = {"parameters": letters, "cells": [{"name": "", "key": key}], "mistakes": []}
    assert judged(one, [typed])["outcome"] == outcome


@pytest.mark.parametrize(
    ("typed", "outcome"),
    [
        ("0.8 + 0.8e", "unreadable"),
        ("0.8*(E+1)", "unreadable"),
        ("0.8 + 0.8ε", "right"),
        ("8e-1*(epsilon + 1)", "right"),
    ],
)
def test_an_e_is_asked_back_where_it_may_be_epsilon(typed: str, outcome: str) -> None:
    one = {"parameters": ["epsilon"], "cells": [{"name": "", "key": "4*(epsilon + 1)/5"}], "mistakes": []}
    assert judged(one, [typed])["outcome"] == outcome


@pytest.mark.parametrize(
    ("letters", "typed", "outcome"),
    [
        ([], "-pi (-3.14)", "unreadable"), ([], "log(2) + 2 (2.69)", "unreadable"), ([], "ln(6) (1.79)", "unreadable"),
        ([], "8 (8)", "unreadable"), ([], "29/4 (7.25)", "unreadable"), ([], "x = 8 (8.0)", "unreadable"),
        ([], "0.707 (√2/2)", "unreadable"), ([], "√2/2 (sqrt(2)/2)", "unreadable"),
        # A factor for sure
        ([], "2(4)", "right"), ([], "(4) * (2)", "right"), ([], "2 (sqrt(9) + 1)", "right"), ([], "9 - (1)", "right"),
        (["gamma"], "8 (γ + 1)/(1 + γ)", "right"), (["gamma"], "8(γ + 1) (1/(1 + γ))", "right"),
    ],
)  # fmt: skip
def test_a_number_in_brackets_behind_a_number_is_asked_back(letters: list[str], typed: str, outcome: str) -> None:
    one = {"parameters": letters, "cells": [{"name": "", "key": "8"}], "mistakes": []}
    assert judged(one, [typed])["outcome"] == outcome


@pytest.mark.parametrize(
    ("key", "typed", "outcome"),
    [("1/6", "0.17", "close"), ("1/6", "0.171", "wrong"), ("5/7", "0.7", "close"), ("10/7", "1.4", "close"),
     ("-1/2", "-0.51", "close"), ("-1/2", "-0.511", "wrong"), ("-1/2", "0.51", "wrong"), ("0", "0.001", "wrong"),
     ("50", "49", "close"), ("50", "48", "wrong"), ("50", "2401/49", "close"), ("pi", "3.08", "close"),
     ("pi", "3.07", "wrong")],
)  # fmt: skip
def test_what_lies_two_percent_off_is_close_the_bound_included(key: str, typed: str, outcome: str) -> None:
    """Of 1/6, 2 % are 1/300, and 0.17 − 1/6 is just that; 2 % off π is 3.0788."""
    one = {"parameters": [], "cells": [{"name": "", "key": key}], "mistakes": []}
    assert judged(one, [typed])["outcome"] == outcome
    assert is_close(read_number(typed).value, read_number(key).value) == (outcome == "close")


@pytest.mark.parametrize(
    ("key", "typed", "short"),
    [("20", "19.9", False), ("25/2", "12.6", False), ("8", "7.9", False), ("13/9", "1.43", False),
     ("121/10", "12", True), ("10/7", "1.4", True), ("-1/2", "-0.51", False),
     ("pi", "3.1", True), ("pi", "3.13", False)],
)  # fmt: skip
def test_only_digits_of_the_key_are_called_too_few(key: str, typed: str, short: bool) -> None:
    one = {"parameters": [], "cells": [{"name": "", "key": key}], "mistakes": []}
    assert judged(one, [typed])["says"].endswith("three digits." if short else "on the way.")


@pytest.mark.parametrize("typed", ["10^400", "-10^350", "γ*10^320"])
def test_what_is_too_large_is_not_right(typed: str) -> None:
    one = {"parameters": ["gamma"], "cells": [{"name": "", "key": "(2 - 4*gamma)/(1 - gamma^2)"}], "mistakes": []}
    assert judged(one, [typed])["outcome"] == "unreadable"


def test_keys_are_as_long_as_they_are() -> None:
    # MacKay's coin, 140 heads of 250: 140!·110!/251! = 2.635·10⁻⁷⁶ from a uniform prior; fair, 2⁻²⁵⁰ = 5.527·10⁻⁷⁶.
    tossed = {"heads": 140, "tails": 110, "prior": {"bent": "1/2", "fair": "1/2"}}
    given = tossed | {"models": {"bent": {"a": 1, "b": 1}, "fair": {"theta": "1/2"}}}
    exercise = rldrill.read({"family": "model-comparison", "given": given})
    of_page = task(exercise, exercise.parts[0])
    assert judged(of_page, ["2.635e-76", "5.527e-76"])["outcome"] == "right"
    assert judged(of_page, ["2.635e-76", "5.53e-75"])["outcome"] == "wrong"
    assert judged(of_page, ["1" * 41, "1"])["outcome"] == "unreadable"


def test_a_typical_mistake_is_told() -> None:
    exercise = rldrill.load("td-zero/2/234")
    wrong = exercise.diagnosing.wrong_answers("a", 1)[0]
    verdict = judged(task(exercise, exercise.parts[0]), typed_cells(exercise, "a", wrong.answer))
    assert (verdict["outcome"], verdict["says"]) == ("misconception", wrong.sentence)


@pytest.mark.parametrize(
    ("identity", "label"),
    [("policy-improvement/2/1", "b"), ("principle-of-optimality/1/2", "b"), ("value-iteration/2/1", "b"),
     ("backup-diagram-name/2/1", "a")],
)  # fmt: skip
def test_of_wrong_words_the_page_says_what_the_library_says(identity: str, label: str) -> None:
    """Whatever is chosen: which rewards are missing when one of two actions is wrong, nobody can know."""
    exercise = rldrill.load(identity)
    part = next(part for part in exercise.parts if part.label == label)
    boxes = [cell.options for cell in cells(exercise, part) if isinstance(cell, Word)]
    for words in product(*boxes):
        verdict, expected = judged(task(exercise, part), [*words]), exercise.check(", ".join(words), label)
        assert verdict["outcome"] == expected.outcome.value
        assert expected.outcome is not Outcome.MISCONCEPTION or verdict["says"] == expected.says


def test_what_is_unreadable_is_named_by_its_box() -> None:
    exercise = rldrill.load("td-zero/2/234")
    verdict = judged(task(exercise, exercise.parts[0]), ["1", "one", "2"])
    assert verdict["outcome"] == "unreadable"
    assert verdict["says"].startswith("entry 2: ")


@pytest.mark.parametrize(
    ("text", "names", "boxes"),
    [
        ("warm: 2.5, cool: 3.5", "cool warm", "3.5 2.5"), ("V(warm) = 5/2; V(cool) = 7/2", "cool warm", "7/2 5/2"),
        ('{"warm": 2.5, "cool": 3.5}', "cool warm", "3.5 2.5"), ("3.5, 2.5", "cool warm", "3.5 2.5"),
        ("Q(s, b) = 2, Q(s, a) = 1", "(s,a) (s,b)", "1 2"), ("(s, b): 2; (s, a): 1", "(s,a) (s,b)", "1 2"),
        ("[1 2; 3 4]", "a b c d", "1 2 3 4"), ("[[1. 2.]\n [3. -4.]]", "a b c d", "1. 2. 3. -4."),
        ("[[1, 2], [3, 4]]", "a b c d", "1 2 3 4"), ("(1, 2)", "a b", "1 2"), ("1\t2\n3\t4", "a b c d", "1 2 3 4"),
        ("3, f(1, 2)", "a b", "3 f(1,2)"), ("δ_0 = 10, δ_1 = -5", "a b", "δ_0=10 δ_1=-5"), ("[1 -1]", "a b", "1 -1"),
        # One number, or not clear whose
        ("0,5", "a b", ""), ("-1,5", "a b", ""), ("(1 + 2)", "a b", ""), ("1 2", "a b", ""), ("[1 - 1]", "a b", ""),
        ("cool: 1, 2", "cool warm", ""), ("cool: 1, hot: 2", "cool warm", ""), ("cool: 1, cool: 2", "cool warm", ""),
        ("1, 2, 3", "a b", ""),
    ],
)  # fmt: skip
def test_a_whole_answer_that_is_pasted_fills_the_boxes(text: str, names: str, boxes: str) -> None:
    found = json.loads(engine()(f"JSON.stringify(Judge.pasted({json.dumps(text)}, {json.dumps(names.split())}, 0))"))
    filled = {index: value.replace(" ", "") for index, value in found or ()}
    assert [filled[index] for index in sorted(filled)] == boxes.split()


def test_where_commas_are_decimal_blanks_behind_them_part_what_is_pasted() -> None:
    for text in ("0,5; 1,5", "0,5, 1,5", "[0,5 1,5]"):
        assert json.loads(engine()(f"JSON.stringify(Judge.pasted({json.dumps(text)}, ['', '', ''], 1, true))")) == [
            [1, "0,5"], [2, "1,5"],
        ]  # fmt: skip
    assert engine()("Judge.pasted('0,5', ['', ''], 0, true)") is None


def test_the_page_says_in_german_what_it_cannot_read() -> None:
    script, german = beside("judge.js"), page_words("de").verdicts
    english = set(re.findall(r'refuse\("([^"]+)"', script))
    assert len(re.findall(r"refuse\(", script)) == len(re.findall(r'refuse\("[^"]+"', script))
    assert english == {sentence for sentence in german if " " in sentence}
    assert all(sentence.count("{}") == german[sentence].count("{}") for sentence in english)
    one = {"parameters": ["gamma"], "cells": [{"name": "", "key": "gamma"}], "mistakes": []}
    told = {**german, "comma": True}
    assert judged(one, ["1.234"], told)["says"].startswith("„1.234“ kann mehrere Zahlen bedeuten")
    assert judged(one, ["2 $& x"], told)["says"] == "„$& x“ wird nicht verstanden; schreiben Sie eine Zahl wie 3/4."
    assert judged(one, ["2y"])["says"] == "“y” is not something this answer may contain; write numbers and gamma."
