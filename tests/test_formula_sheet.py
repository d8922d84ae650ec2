"""The formula sheet in the terminal, as PDF and as Markdown: always the same formulas."""

from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner

from printed import poppler, words
from rldrill.commands import sheet as sheet_command
from rldrill.print import paper as paper_module
from rldrill.print.formula_sheet import latex_equation, markdown, sections, sheet_source, terminal
from rldrill.print.paper import pdf
from rldrill.problems.errors import UsageError
from rldrill.render.unicode import unicode_text
from rldrill.solutions.formula.formula import Place
from rldrill.solutions.sheet import SECTIONS, formulas

MARGIN = 72 / 2.54 - 2
KEYS = (Path(__file__).parent / "formula" / "keys.txt").read_text(encoding="utf-8").split()


@pytest.fixture
def app() -> typer.Typer:
    app = typer.Typer()
    app.command()(sheet_command.command)
    return app


def test_the_terminal_shows_every_formula_that_is_asked_for() -> None:
    printed = "\n".join(line.plain for line in terminal([], workings=True))
    for formula in formulas().values():
        assert formula.title in printed
        assert unicode_text(formula.equation()) in printed
    assert all(title in printed for title in SECTIONS.values())


def test_pictures_in_the_terminal_are_explained_where_they_need_it() -> None:
    assert terminal(["backup-diagrams"])[-1].plain.startswith("    Open circles are states, filled dots are actions")
    assert terminal(["fundamentals"])[-1].plain.strip()  # the last line is one of a picture


def test_markdown_has_every_formula_in_latex() -> None:
    written = markdown([], workings=True)
    assert all(f"$${latex_equation(formula.equation())}$$" in written for formula in formulas().values())
    assert written.count("\n## ") == len(SECTIONS)


def test_the_sheet_has_every_formula_of_the_lecture_and_none_that_only_workings_need() -> None:
    printed = {formula.key: formula for _, found in sections().values() for formula in found}
    assert set(KEYS) <= set(printed)
    assert all(formula.place is not Place.WORKING for formula in printed.values())
    assert all(formulas()[key].place is Place.SHEET for key in KEYS)


def test_what_goes_beyond_the_lecture_is_marked() -> None:
    lines = [line.plain for line in terminal(["control"])]
    assert any(line.strip().startswith("Expected Sarsa +") for line in lines)
    assert any(line.strip().startswith("Sarsa  ") for line in lines)


def test_a_hidden_side_is_printed_only_with_the_workings() -> None:
    ppo = formulas()["ppo"]
    assert len(ppo.printed().rights) == 1 < len(ppo.equation().rights)
    assert unicode_text(ppo.equation()) not in "\n".join(line.plain for line in terminal(["policy-gradient"]))


def test_no_formula_stands_in_two_sections() -> None:
    assert sum(len(found) for _, found in sections(workings=True).values()) == len(formulas())


def test_sections_keep_the_order_of_the_sheet() -> None:
    assert list(sections(["temporal-difference", "Bellman"])) == ["bellman", "temporal_difference"]


def test_an_unknown_section_is_refused_with_the_list() -> None:
    with pytest.raises(UsageError, match="fundamentals, bellman, dynamic-programming"):
        sections(["belman"])


@pytest.mark.parametrize("workings", [False, True])
@pytest.mark.parametrize("paper", ["a4", "letter"])
def test_the_pdf_is_two_pages_with_every_word_inside_the_margins(paper: str, workings: bool, tmp_path: Path) -> None:
    path = tmp_path / "sheet.pdf"
    path.write_bytes(pdf(sheet_source([], paper, workings=workings)))
    found = list(words(path))
    assert len({word.page for word in found}) == (5 if workings else 2)
    assert not [word for word in found if word.left <= MARGIN or word.right >= word.width - MARGIN]
    below_title = [word for word in found if 80 < word.top < 740]
    assert not [word for word in below_title if word.left < word.width / 2 < word.right]


def test_a_section_alone_is_one_page_in_the_size_of_a_book(tmp_path: Path) -> None:
    path = tmp_path / "sheet.pdf"
    path.write_bytes(pdf(sheet_source(["bayes"], "a4")))
    printed = poppler("pdftotext", "-layout", str(path), "-")
    assert printed.count("\f") == 1
    assert "Bayes" in printed
    assert "Bellman" not in printed


def test_the_command_prints_plain_text_when_piped(app: typer.Typer) -> None:
    printed = CliRunner().invoke(app, ["bellman"], catch_exceptions=False).stdout
    assert "\x1b" not in printed
    assert "V^π(s) = " in printed


def test_the_command_prints_latex(app: typer.Typer) -> None:
    assert r"\gamma" in CliRunner().invoke(app, ["fundamentals", "--latex"], catch_exceptions=False).stdout


@pytest.mark.parametrize(("name", "begins"), [("sheet.pdf", b"%PDF"), ("sheet.md", b"# ")])
def test_the_command_writes_files(app: typer.Typer, tmp_path: Path, name: str, begins: bytes) -> None:
    path = tmp_path / name
    result = CliRunner().invoke(app, ["-o", str(path)], catch_exceptions=False)
    assert result.stdout == f"{path}\n"
    assert path.read_bytes().startswith(begins)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["-o", "x.html"], "must end in .pdf or .md"),
        (["-o", "."], "is a folder"),
        (["nope"], "There is no section"),
    ],
)
def test_the_command_refuses(app: typer.Typer, arguments: list[str], message: str) -> None:
    result = CliRunner().invoke(app, arguments)
    assert isinstance(result.exception, UsageError)
    assert message in str(result.exception)


def test_completion_offers_the_sections() -> None:
    assert {name.replace("-", "_") for name in sheet_command.complete_sections("")} == set(SECTIONS)


def test_only_fonts_that_come_along_are_used_unless_others_are_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []
    compiler = paper_module._compiler
    monkeypatch.setattr(paper_module, "_compiler", lambda system: asked.append(system) or compiler(system))
    pdf("text")
    assert asked == [False]
