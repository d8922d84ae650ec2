"""Blocks and mathematics as Typst: all compiles, nothing is read as code, nothing is too wide."""

import io
import math
import re
from collections.abc import Callable
from pathlib import Path

import pypdf
import pytest

from printed import Word, words
from rldrill.exercise import Exercise, draw
from rldrill.print.paper import page_setup, pdf
from rldrill.problems.catalogue import families, family
from rldrill.problems.document import Beside, Equation, Heading, Paragraph, Table
from rldrill.problems.mathematics import (
    EMPTY,
    Accent,
    Big,
    Fence,
    Fraction,
    Glyph,
    Math,
    Root,
    Row,
    Script,
    Tabular,
    mathematics,
    number,
    operator,
    row,
    variable,
    with_joined_scripts,
    word,
)
from rldrill.render.mathematics.latex import latex
from rldrill.render.mathematics.mathml import mathml
from rldrill.render.mathematics.typst import text, typst
from rldrill.render.mathematics.width import width, width_of_line
from rldrill.render.typst import PAGE, block, document
from rldrill.solutions.sheet import formulas

HOSTILE = [
    "a#b",
    "*x*",
    "$",
    'say"so"',
    "back\\slash",
    "]",
    "//x",
    "@x",
    "<l>",
    "`c`",
    "#eval",
    "_u_",
    "~",
    "=h",
]
SETUP = page_setup("a4", title="t", margin="2cm", size="10.5pt", columns=1)
NARROW = SETUP + "#set page(width: 9cm, height: 25cm, margin: 1cm)\n#set text(size: 9pt)\n"
CENTIMETRE = 72 / 2.54


def words_of(data: bytes, folder: Path) -> list[Word]:
    """Every word of a PDF."""
    (folder / "page.pdf").write_bytes(data)
    return list(words(folder / "page.pdf"))


def assert_inside(data: bytes, folder: Path, margin: float) -> None:
    edge = margin * CENTIMETRE - 1
    assert not [word for word in words_of(data, folder) if word.left < edge or word.right > word.width - edge]


def exercises(seed: int) -> list[Exercise]:
    """One of every family, of a level after the other."""
    levels = [(name, family(name).levels) for name in families()]
    return [draw(name, some[(number + seed) % len(some)], seed) for number, (name, some) in enumerate(levels)]


def everything(room: float, seed: int) -> str:
    parts = [block(formula.equation(), room) for formula in formulas().values()]
    for exercise in exercises(seed):
        parts += [block(each, room) for each in (*exercise.question(), *exercise.working())]
        parts += [document(exercise.question()), document(exercise.working())] if room == PAGE else []
        for part in exercise.parts:
            parts += [block(Paragraph(f"({part.label}) {part.ask}")), block(exercise.answer(part), room)]
    return "".join(parts)


def test_all_formulas_questions_and_workings_stay_inside_the_page(tmp_path: Path) -> None:
    assert_inside(pdf(SETUP + everything(PAGE, 1)), tmp_path, 2)


def test_they_do_so_in_a_narrow_column_too(tmp_path: Path) -> None:
    assert_inside(pdf(NARROW + everything(0, 2)), tmp_path, 1)


def test_names_are_never_read_as_code(tmp_path: Path) -> None:
    blocks = [
        *(Paragraph(f"in {name} end") for name in HOSTILE),
        *(Heading(f"head {name}") for name in HOSTILE),
        Table(("name",), tuple((name,) for name in HOSTILE)),
        *(Equation(row(variable("V"), Fence(word(name))), (word(name),), ("=",)) for name in HOSTILE),
    ]
    found = [word.text for word in words_of(pdf(SETUP + document(tuple(blocks))), tmp_path)]
    joined = "".join(found).replace("”", '"').replace("“", '"')
    for name in HOSTILE:
        assert joined.count(name) >= 5, name


@pytest.mark.parametrize("style", ["variable", "word", "number", "operator", "relation", "punctuation"])
def test_every_sign_of_every_style_compiles(style: str) -> None:
    signs = [chr(code) for code in range(32, 127)] + [
        "ab",
        "1x",
        "",
        "′",
        "日",
        "𝔼",
        "∼",
        "s₁′",
        "…",
        "#",
        ";;",
        "--",
    ]
    glyphs: list[Math] = [Glyph(sign, style) for sign in signs]  # type: ignore[arg-type]
    inside = [*glyphs, *(Script(glyph, glyph, glyph) for glyph in glyphs), *(Fraction(g, g) for g in glyphs)]
    pdf(SETUP + "".join(f"${typst(item)}$ " for item in inside) + f"$ {typst(Tabular((tuple(glyphs),)))} $")


def test_every_kind_of_mathematics_compiles() -> None:
    x = variable("x")
    kinds: list[Math] = [
        EMPTY, Fraction(EMPTY, EMPTY), Root(x), Accent(x, "hat"), Accent(x, "bar"), Accent(x, "tilde"),
        Big("∫", x, x), Big("𝔼", x), Big("arg max", x), Big("Σ"),
        Fence(x, "|", "|"), Fence(x, "⟨", "⟩"), Fence(x, "{", ""), Fence(EMPTY),
        Tabular(((x, x), (x, EMPTY))), Tabular(((x,),), "{", ""), Script(EMPTY, x), Row((x, Glyph("′", "word"))),
    ]  # fmt: skip
    pdf(SETUP + "".join(f"${typst(item)}$ $ {typst(item)} $" for item in kinds))


@pytest.mark.parametrize(
    ("source", "written"),
    [
        ("V(s)", "V lr(paren.l s paren.r)"),
        ("3/4", "frac(3, 4)"),
        ("s_{t+1}", r"attach(s, b: t \+ 1)"),
        ('V("cool")', 'V lr(paren.l upright("cool") paren.r)'),
        ("e^{3/2}", r"attach(e, t: 3 \/ 2)"),
        ("γ", r"\u{3b3}"),
    ],
)
def test_mathematics_is_written_explicitly(source: str, written: str) -> None:
    assert typst(mathematics(source)) == written


def test_text_is_a_string_and_mathematics_an_equation() -> None:
    assert text('a "b" \\ $x$') == r'#"a \"b\" \\ ";#kept("x", $x$)'


def long_sum(terms: int) -> Math:
    return row(*(item for index in range(1, terms) for item in (number(index * 1111), operator("+"))), number(1))


@pytest.mark.parametrize(
    "wide",
    [
        lambda: long_sum(60),
        lambda: row(word("max"), Fence(long_sum(60), "{", "}")),
        lambda: row(Fence(long_sum(20)), Fence(row(long_sum(9), operator("−"), Fence(long_sum(30))))),
        lambda: row(*[Tabular(((number("1/3"),) * 4,) * 4)] * 9),
        lambda: Fraction(long_sum(60), number(2)),
        lambda: row(variable("x"), Script(Fence(long_sum(60)), above=number(2))),
        lambda: word("w" * 300),
    ],
)
def test_whatever_is_too_wide_is_broken_or_shrunk(wide: Callable[[], Math], tmp_path: Path) -> None:
    blocks = document((
        Equation(variable("V"), (wide(), number(7)), ("=", "=")),
        Equation(wide(), (number(7),), ("=",)),
        Equation(EMPTY, (wide(),), ("",)),
    ))  # fmt: skip
    assert_inside(pdf(SETUP + blocks), tmp_path, 2)


def test_a_wide_table_is_shrunk(tmp_path: Path) -> None:
    line = tuple(f"rattling{index}" for index in range(20))
    assert_inside(pdf(SETUP + block(Table(line, (line, line)))), tmp_path, 2)


def test_a_table_that_is_too_wide_and_too_long_is_set_in_smaller_type_and_broken(tmp_path: Path) -> None:
    line = ("a long cell",) * 12
    data = pdf(SETUP + block(Table(line, (line,) * 99)))
    assert_inside(data, tmp_path, 2)
    found = [word for word in words_of(data, tmp_path) if word.text == "cell"]
    assert len(found) == 12 * (99 + max(word.page for word in found))  # a head on every page
    assert all(word.bottom < word.height - 2 * CENTIMETRE for word in found)


_TABLE = Table(("$s$", "$V(s)$"), (("low", "1"), ("high", "2")))


def test_narrow_tables_stand_side_by_side_each_below_the_sentence_that_announces_it() -> None:
    first, second = Paragraph("The policy is:"), Paragraph("The values are:")
    together = document((first, _TABLE, second, _TABLE))
    assert together.startswith("#announced((")
    sentences, *tables = together.split("grid-table")
    assert sentences.index("policy") < sentences.index("values")  # as they are read; the tables begin at one height
    assert len(tables) == 2
    assert not document((first, _TABLE, Paragraph("They are known."), _TABLE)).count("#announced")
    wide = Table(tuple("abcdefghijklmnopqr"), (tuple("abcdefghijklmnopqr"),))
    assert not document((first, wide, second, _TABLE)).count("#announced")


def test_a_sentence_above_a_table_takes_one_line_where_there_is_room_and_two_where_there_is_not() -> None:
    def widths(*sentences: str) -> list[float]:
        blocks = [block for sentence in sentences for block in (Paragraph(sentence), _TABLE)]
        return [float(width) for width in re.findall(r"([\d.]+)em", document(tuple(blocks)).partition(")")[0])]

    alone = "The start state of an episode is:"  # 33 signs
    assert widths(alone, "The policy is:")[0] == pytest.approx(33 * 0.65 + 2, abs=0.06)
    assert widths(alone, "The policy is:", alone)[0] == pytest.approx(33 * 0.65 / 2 + 2, abs=0.06)


def test_what_announces_something_stays_on_the_page_of_what_it_announces() -> None:
    assert block(Paragraph("Sweep 2:")) == '#block(sticky: true, par[#"Sweep 2:";])\n'
    assert block(Paragraph("Sweep 2.")) == '#par[#"Sweep 2.";]\n'


def test_three_narrow_tables_stand_on_as_many_lines_as_they_need() -> None:
    pair = (Paragraph("So it is:"), _TABLE)
    assert document(pair * 3).count("#announced") == 1
    assert document(pair * 8).count("#announced") == 2


def test_an_equation_that_just_fits_stays_on_its_line() -> None:
    item = Equation(mathematics("x"), (mathematics("a + b"), mathematics("c")), ("=", "="))
    wide = width_of_line(item.left, item.rights, item.signs)
    assert block(item, wide).startswith("#one-line(")
    assert block(item, math.nextafter(wide, 0)).startswith("#chain(")
    alone = Equation(EMPTY, (mathematics("+".join(["abc"] * 20)),), ("",))
    wide = width(alone.rights[0])
    assert block(alone, wide).startswith("#one-line(")
    assert block(alone, math.nextafter(wide, 0)).startswith("#chain(")


def test_tables_that_just_fit_are_not_measured_and_two_stand_abreast() -> None:
    # Three signs of 6/10 of the type and two columns of 14/10 are 4.6; twice that and 1.2 between them are 10.4, where
    # the line has 12/10 of the room.
    table = Table(("a", "b"), (("cc", "d"),))
    assert block(table, 4.601).startswith("#block(")
    assert block(table, 4.599).startswith("#wide-block(")
    assert block(Beside((table, table)), 10.401 / 1.2).startswith("#abreast(")
    assert block(Beside((table, table)), 10.399 / 1.2).startswith("#beside(")


@pytest.mark.parametrize(("signs", "function"), [(48, "#flow("), (49, "#one-line(")])
def test_values_of_48_signs_share_a_line_and_longer_ones_do_not(signs: int, function: str) -> None:
    assert block(Equation(EMPTY, (word("a" * signs), word("b")), ("", "")), PAGE).startswith(function)


@pytest.mark.parametrize("word", ["Q-learning", "ε-greedy", "n-step"])
def test_a_letter_and_its_word_stay_on_one_line(word: str) -> None:
    for narrow in range(60, 140, 4):
        page = f"#set page(width: {narrow}pt, height: 400pt, margin: 2pt)\n"
        made = pypdf.PdfReader(io.BytesIO(pdf(page + text(f"Sarsa and then {word}, or a state-action pair"))))
        assert word in made.pages[0].extract_text(), narrow


def test_an_index_of_what_has_one_stands_beside_it_in_every_notation() -> None:
    entry = Script(Script(Glyph("A", "variable"), Glyph("Δ", "variable")), Glyph("13", "number"))
    assert typst(entry) == r"attach(A, b: \u{394} \, 13)"
    assert latex(entry) == r"A_{\Delta , 13}"
    assert mathml(entry).count("<msub>") == 1
    power = Script(Script(Glyph("A", "variable"), Glyph("t", "variable")), above=Glyph("T", "word"))
    assert with_joined_scripts(power) == Script(Glyph("A", "variable"), Glyph("t", "variable"), Glyph("T", "word"))
    assert latex(power) == r"A_{t}^{\text{T}}"


def test_a_comma_has_its_space_before_a_sign_and_a_fraction() -> None:
    assert typst(mathematics("(-1,-2)")) == r'lr(paren.l class("unary", minus) 1 \, thin minus 2 paren.r)'
    assert typst(mathematics("0,1/2")) == r"0 \, thin frac(1, 2)"
    assert typst(mathematics("a,b_t")) == r"a \, attach(b, b: t)"


def test_a_long_equation_in_a_text_is_broken_before_its_relations_only() -> None:
    written = text("$L_t = (R_t + B^⊤ S_{t+1} B)^{-1} B^⊤ S_{t+1} A = X_t + (R_t + B^⊤ S_{t+1} B)^{-1} B^⊤ S_{t+1} A$")
    sides = re.findall(r'#(kept|eq)\("([^"]*)"', written)
    assert [(how, said[:5].strip()) for how, said in sides] == [("kept", "Lₜ ="), ("kept", "= Xₜ")]
    assert len(re.findall(r"#kept", text("$a = b$"))) == 1


def test_short_equations_side_by_side_share_a_line_with_those_that_follow() -> None:
    one, two, three = (Equation(Glyph(sign, "variable"), (Glyph("1", "number"),), ("=",)) for sign in "abc")
    assert document((Beside((one, two)), three)).count("#flow") == 1


def test_a_colon_clings_to_what_stands_before_it() -> None:
    assert typst(mathematics("t: s")) == 't class("normal", colon) thick s'
    assert latex(mathematics("t: s")) == r"t \colon s"
