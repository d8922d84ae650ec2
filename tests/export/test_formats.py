"""What is written for other programs: read back as those programs read it."""

import io
import json
import re
import shutil
import sqlite3
import subprocess
import sys
import zipfile
from decimal import Decimal
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from flint import fmpq
from msgspec.structs import replace

import rldrill
from rldrill.exam.exam import Exam, Head, Version
from rldrill.exam.planning import version_code
from rldrill.exam.roster import Person
from rldrill.export.asked import Wrong, answer, cells, typeset
from rldrill.export.formats import FORMATS, check, export, format_of, named, says_what_is_lost, version_path
from rldrill.export.words import note
from rldrill.print.words import words
from rldrill.problems.document import Paragraph, Table
from rldrill.problems.errors import UsageError
from rldrill.problems.parts import Number, Part
from rldrill.render.html import Html
from rldrill.render.mathematics.latex import latex

PROBLEMS = [
    "td-zero/2/234",
    "value-iteration/2/1",
    "policy-value/3/1",
    "principle-of-optimality/1/2",
    "kalman-filter/2/1",
]
QTI = "{http://www.imsglobal.org/xsd/imsqti_v2p1}"
_VOID = {"meta", "input", "img", "br", "hr", "rect", "line", "path", "ellipse", "polygon", "polyline"}


@cache
def exam(title: str = "Costs $5 & <b>6</b>") -> Exam:
    exercises = tuple(map(rldrill.load, PROBLEMS))
    return Exam(Head(title=title), 1, (Version("A", exercises, tuple(range(len(exercises)))),))


def written(name: str, folder: Path, *, practice: bool = True) -> bytes:
    format_ = FORMATS[name]
    (path,) = export(exam(), folder / f"exam{format_.ending}", format_, practice=practice)
    return path.read_bytes()


def test_the_code_of_a_version_is_told_where_there_are_several() -> None:
    one = exam("Costs")
    (version,) = one.versions
    two = replace(one, versions=(version, replace(version, code="B")))
    assert one.title_of(version) == "Costs"
    assert [two.title_of(each) for each in two.versions] == ["Costs (A)", "Costs (B)"]


class Nesting(HTMLParser):
    """Complains about elements that are closed in another order than they are opened, and about names given twice."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.names: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.names += [value for name, value in attrs if name == "id" and value]
        if tag not in _VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        pass

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def test_the_page_is_well_formed_and_asks_for_nothing_from_elsewhere(tmp_path: Path) -> None:
    text = written("html", tmp_path).decode()
    reader = Nesting()
    reader.feed(text)
    reader.close()
    assert reader.open == []
    assert len(reader.names) == len(set(reader.names))
    assert not re.search(r'(?:src|href)="', text)
    assert "Costs $5 &amp; &lt;b&gt;6&lt;/b&gt;" in text


def test_an_exam_as_a_page_holds_nothing_of_its_answers(tmp_path: Path) -> None:
    text = written("html", tmp_path, practice=False).decode()
    assert "<script" not in text
    assert "<details" not in text
    for part in rldrill.load("kalman-filter/2/1").parts:
        assert part.ask.split("$")[0].strip() in text  # the questions are there, though


def test_every_box_of_moodle_has_the_key_the_tolerance_and_the_mistakes(tmp_path: Path) -> None:
    quiz = ElementTree.fromstring(written("moodle", tmp_path))
    kinds = [question.get("type") for question in quiz]
    assert kinds == ["category", "cloze", "cloze", "essay", "cloze", "cloze"]  # an open parameter is marked by hand
    text = quiz[1].findtext("questiontext/text") or ""
    boxes = re.findall(r"\{(\d+):NUMERICAL:(.*?)(?<!\\)\}", text)
    # δ₀ = 4 + 1/2·8 − (−2) = 10, and 10.0 allows 0.05
    assert boxes[0][1].startswith("=10:0.05#Right.~%0%")
    assert len(boxes) == 5
    for _, answers in boxes:
        known: list[tuple[Decimal, Decimal]] = []
        for told in re.split(r"(?<!\\)~", answers):
            found = re.fullmatch(r"(?:=|%0%)(-?[0-9.]+(?:e[+-]?\d+)?):([0-9.]+)#.+", told, re.DOTALL)
            assert found, told
            value, bound = Decimal(found[1]), Decimal(found[2])
            assert all(abs(value - other) > bound + room for other, room in known), "two answers in one range"
            known.append((value, bound))


def test_points_of_moodle_are_shared_as_those_of_the_parts(tmp_path: Path) -> None:
    text = ElementTree.fromstring(written("moodle", tmp_path))[1].findtext("questiontext/text") or ""
    weights = [int(weight) for weight in re.findall(r"\{(\d+):NUMERICAL", text)]
    first, second = rldrill.load("td-zero/2/234").parts
    assert sum(weights[:3]) * second.points == sum(weights[3:]) * first.points


def test_a_picture_of_moodle_is_a_file_with_its_words(tmp_path: Path) -> None:
    question = ElementTree.fromstring(written("moodle", tmp_path))[2]
    assert 'src="@@PLUGINFILE@@/picture-1.svg" alt="State diagram' in (question.findtext("questiontext/text") or "")
    assert [file.get("name") for file in question.findall("questiontext/file")] == ["picture-1.svg"]


def test_a_package_of_qti_names_all_that_is_in_it(tmp_path: Path) -> None:
    """Its schemas, which are not ours to hand on, find no fault in any family; this holds what they hold it to."""
    with zipfile.ZipFile(io.BytesIO(written("qti", tmp_path))) as package:
        files = {name: package.read(name) for name in package.namelist()}
    manifest = ElementTree.fromstring(files["imsmanifest.xml"])
    named = [file.get("href") for file in manifest.iter("{http://www.imsglobal.org/xsd/imscp_v1p1}file")]
    assert sorted(map(str, named)) == sorted(set(files) - {"imsmanifest.xml"})
    for number in range(1, len(PROBLEMS) + 1):
        item = ElementTree.fromstring(files[f"item-A-{number}.xml"])
        declared = {each.get("identifier") for each in item.iter(f"{QTI}responseDeclaration")}
        asked = [each.get("responseIdentifier") for each in item.iter() if each.get("responseIdentifier")]
        assert sorted(map(str, asked)) == sorted(map(str, declared))
        told = {each.get("identifier") for each in item.iter(f"{QTI}modalFeedback")}
        set_ = {each.text for each in item.iter(f"{QTI}baseValue") if (each.text or "").startswith(("F_", "WORKING"))}
        assert told == set_ >= {"WORKING"}
        assert {image.get("src") for image in item.iter(f"{QTI}img")} <= set(files)


def test_an_item_of_qti_has_the_key_the_tolerance_and_the_points(tmp_path: Path) -> None:
    with zipfile.ZipFile(io.BytesIO(written("qti", tmp_path, practice=False))) as package:
        item = ElementTree.fromstring(package.read("item-A-1.xml"))
    assert item.find(f"{QTI}modalFeedback[@identifier='WORKING']") is None
    first = next(item.iter(f"{QTI}responseCondition"))
    right, *wrong = first.iter(f"{QTI}equal")
    # δ₀ = 4 + 1/2·8 − (−2) = 10, and 10.0 allows 0.05
    assert (right.findtext(f"{QTI}baseValue"), right.get("tolerance")) == ("10", "0.05 0.05")
    assert wrong
    parts = rldrill.load("td-zero/2/234").parts
    worth = [float(each.findtext(f"{QTI}baseValue") or 0) for each in item.iter(f"{QTI}sum")]
    assert sum(worth) == pytest.approx(sum(part.points for part in parts), rel=1e-4)


def test_anki_reads_the_deck_and_knows_each_problem_by_its_id(tmp_path: Path) -> None:
    pytest.importorskip("genanki")
    package = written("anki", tmp_path)
    with zipfile.ZipFile(io.BytesIO(package)) as files:
        (tmp_path / "collection").write_bytes(files.read("collection.anki2"))
    with sqlite3.connect(tmp_path / "collection") as database:
        notes: list[Any] = database.execute("select guid, flds from notes order by id").fetchall()
    assert [fields.split("\x1f")[0] for _, fields in notes] == [rldrill.load(name).id for name in PROBLEMS]
    assert len({guid for guid, _ in notes}) == len(PROBLEMS)
    for (_, fields), name in zip(notes, PROBLEMS, strict=True):
        labels = [f"({part.label})" for part in rldrill.load(name).parts]
        assert all((f"<b>{label}" in fields) == (len(labels) > 1) for label in labels)
    assert package == written("anki", tmp_path), "the same exam is the same file"


@pytest.mark.parametrize(("codes", "decks"), [("A", ["a:b"]), ("AB", ["a:b::A", "a:b::B"])])
def test_anki_has_a_deck_below_the_title_for_each_of_several_versions(
    tmp_path: Path, codes: str, decks: list[str]
) -> None:
    pytest.importorskip("genanki")
    one = exam("a::b")  # two colons would part the title itself
    (version,) = one.versions
    several = replace(one, versions=tuple(replace(version, code=code) for code in codes))
    (path,) = export(several, tmp_path / "exam.apkg", FORMATS["anki"], practice=True)
    with zipfile.ZipFile(path) as files:
        (tmp_path / "collection").write_bytes(files.read("collection.anki2"))
    with sqlite3.connect(tmp_path / "collection") as database:
        (kept,) = database.execute("select decks from col").fetchone()
    assert [deck["name"] for deck in json.loads(kept).values() if deck["name"] != "Default"] == decks


def test_latex_compiles(tmp_path: Path) -> None:
    source = written("latex", tmp_path).decode()
    assert source.count(r"\begin{solution}") == sum(len(exercise.parts) for exercise in exam().versions[0].exercises)
    for name in re.findall(r"\\begin\{(\w+)\}", source):
        assert source.count(f"\\begin{{{name}}}") == source.count(f"\\end{{{name}}}")
    # TeX is gigabytes, and no part of rldrill: it is tried where it is installed; what is above holds everywhere.
    if (program := shutil.which("pdflatex")) is None or not _has_exam_class():
        pytest.skip("there is no LaTeX with the exam class here")
    run = [program, "-interaction=nonstopmode", "-halt-on-error", "exam.tex"]
    done = subprocess.run(run, cwd=tmp_path, capture_output=True, timeout=60, check=False)
    assert done.returncode == 0, done.stdout.decode(errors="replace")[-2000:]


def _has_exam_class() -> bool:
    finder = shutil.which("kpsewhich")
    return finder is not None and subprocess.run([finder, "exam.cls"], capture_output=True, check=False).returncode == 0


def test_markdown_and_json_leave_the_answers_of_an_exam_out(tmp_path: Path) -> None:
    assert b"<details>" in written("markdown", tmp_path)
    assert b"<details>" not in written("markdown", tmp_path, practice=False)
    problems = json.loads(written("json", tmp_path, practice=False))["versions"][0]["problems"]
    assert not any("answer" in part or "mistakes" in part for problem in problems for part in problem["parts"])
    assert not any("id" in problem for problem in problems)  # whoever has the ID has the key
    (first, *_) = json.loads(written("json", tmp_path))["versions"][0]["problems"]
    assert first["parts"][0]["answer"]["exact"] == ["10", "-5", "6"]  # δ₁ = −6 + 1/2·(−2) − (−2), δ₂ = 4 − (−2)


@cache
def german() -> Exam:
    # Two parameters, 16 points and a likelihood of 1/64: 2·6 ln 2 + 2 ln 16 = 20 ln 2 = 13.863
    exercises = (rldrill.load("bic/2/24"), rldrill.load("markov-property/1/1"))
    head = Head(title="Klausur 2.5", date="26.11.2026", language="de", decimal_mark=",")
    return Exam(head, 1, (Version("A", exercises, (0, 1)),))


@pytest.mark.parametrize("name", ["html", "moodle", "qti", "canvas", "latex", "markdown", "anki"])
def test_an_exam_with_decimal_commas_has_them_wherever_people_read(name: str, tmp_path: Path) -> None:
    if name == "anki":
        pytest.importorskip("genanki")
    (path,) = export(german(), tmp_path / f"exam{FORMATS[name].ending}", FORMATS[name], practice=True)
    text = _read(path)
    assert "13{,}86" in text or "13,86" in text
    shown = re.sub(r"<[^>]*>|&lt;.*?&gt;|\{\d+:NUMERICAL[^}]*\}", " ", text)
    assert "13.86 " not in shown.replace("26.11.2026", "")
    assert any(word in text for word in ("Antwort", "Dezimalzahlen mit drei richtigen Ziffern", "Typische falsche"))
    assert "Type decimals" not in text
    if name in ("moodle", "qti", "canvas"):  # what programs read has a point: 20 ln 2 = 13.8629436112
        assert "13.8629436112" in text


@pytest.mark.parametrize("level", [1, 2, 3])
def test_an_exam_as_json_does_not_name_the_diagrams_that_are_to_be_named(tmp_path: Path, level: int) -> None:
    asked = rldrill.draw("backup-diagram-name", level, 1)
    one = Exam(Head(), 1, (Version("A", (asked,), (0,)),))
    (path,) = export(one, tmp_path / "exam.json", FORMATS["json"], practice=False)
    (problem,) = json.loads(path.read_text("utf-8"))["versions"][0]["problems"]
    assert set(problem) == {"format", "family", "level", "question", "parts"}
    assert all(set(part) == {"part", "ask", "kind", "points", "options"} for part in problem["parts"])


@pytest.mark.parametrize("name", ["html", "moodle", "qti", "canvas", "latex", "markdown", "anki"])
def test_the_answer_to_yes_or_no_is_in_the_language_of_the_exam(tmp_path: Path, name: str) -> None:
    """π is not optimal: the answer is no. Most formats offer both words to choose from, too."""
    if name == "anki":
        pytest.importorskip("genanki")
    (version,) = german().versions
    asked = replace(version, exercises=(rldrill.load("policy-improvement/2/1"),), slots=(0,))
    one = replace(german(), versions=(asked,))
    (path,) = export(one, tmp_path / f"exam{FORMATS[name].ending}", FORMATS[name], practice=True)
    assert len(re.findall(r"\bnein\b", _read(path))) == (1 if name in ("anki", "markdown") else 2)


def test_numbers_of_json_keep_their_points(tmp_path: Path) -> None:
    (path,) = export(german(), tmp_path / "exam.json", FORMATS["json"], practice=True)
    decimals = json.loads(path.read_text("utf-8"))["versions"][0]["problems"][0]["parts"][0]["answer"]["decimal"]
    assert any(str(number).startswith("13.86") for number in decimals.values())


def _read(path: Path) -> str:
    if not zipfile.is_zipfile(path):
        return path.read_text("utf-8")
    with zipfile.ZipFile(path) as package:
        return "\n".join(package.read(name).decode("utf-8", "replace") for name in package.namelist())


def test_a_page_with_decimal_commas_tells_its_script(tmp_path: Path) -> None:
    (path,) = export(german(), tmp_path / "exam.html", FORMATS["html"], practice=True)
    text = path.read_text("utf-8")
    assert '"comma":true' in text
    assert "<span>ja</span>" in text
    assert "Klausur 2.5" in text


def test_word_gets_a_title_headings_formulas_and_a_line_before_each_answer(tmp_path: Path) -> None:
    pytest.importorskip("pypandoc")
    content = written("docx", tmp_path)
    with zipfile.ZipFile(io.BytesIO(content)) as document:
        text = document.read("word/document.xml").decode()
        about = document.read("docProps/core.xml").decode()
    title = "Costs $5 &amp; &lt;b&gt;6&lt;/b&gt;"
    shown = "".join(re.findall("<w:t[ >][^<]*", text)).replace(title, "", 1)
    assert text.count('w:val="Title"') == 1
    assert text.count('w:val="Heading1"') == len(PROBLEMS)
    assert text.count("<m:oMath>") > 100
    assert "$" not in shown
    assert "\\" not in shown
    assert text.count("Answer and working") == sum(len(exercise.parts) for exercise in exam().versions[0].exercises)
    assert f"<dc:title>{title}</dc:title>" in about
    assert written("docx", tmp_path) == content


def test_word_ends_no_line_behind_the_letter_of_q_learning(tmp_path: Path) -> None:
    pytest.importorskip("pypandoc")
    (path,) = export(exam("Q-learning, well-known"), tmp_path / "exam", FORMATS["docx"], practice=False)
    with zipfile.ZipFile(path) as document:
        text = "".join(re.findall("<w:t[ >][^<]*", document.read("word/document.xml").decode()))
    assert "Q\N{NON-BREAKING HYPHEN}learning, well-known" in text


def test_word_needs_pandoc_and_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setitem(sys.modules, "pypandoc", None)
    with pytest.raises(UsageError, match="made by pandoc, which is not installed"):
        written("docx", tmp_path)


@pytest.mark.parametrize(
    ("path", "name"), [("a.html", "html"), ("a.tex", "latex"), ("a.apkg", "anki"), ("a.md", "markdown")]
)
def test_the_ending_tells_the_format(path: str, name: str) -> None:
    found = format_of(Path(path))
    assert found is not None
    assert found.name == name
    assert format_of(Path("a.pdf")) is None


def test_an_unknown_format_is_said() -> None:
    with pytest.raises(UsageError, match="There is no format 'docs'"):
        format_of(None, "docs")


def test_an_empty_corner_of_a_table_is_no_heading() -> None:
    written = Html().table(Table(("", "$s$"), (("$V$", "3"),)))
    assert written.count("<th ") == 1
    assert '<td></td><th scope="col"><math aria-label="s">' in written


#: Two models to choose from, yes or no, and two matrices with one row, of two entries and of one.
OTHER_KINDS: tuple[tuple[str, dict[str, Any]], ...] = (
    ("bic", {"fitted": {"small": {"likelihood": "1/4", "k": 1}, "large": {"likelihood": "1/2", "k": 3}}, "n": 4}),
    ("policy-improvement-theorem", {
        "mdp": {"transitions": [["a", "x", "end", 1, 1], ["a", "y", "end", 1, 2]], "terminal": ["end"]},
        "policy": {"a": "x"}, "other": {"a": "y"}, "values": {"a": 1}, "gamma": "1/2",
    }),
    ("lqr-gain", {"A": [[1, 0], [0, 1]], "B": [[1], [1]], "R": 1, "P": [[-1, 0], [0, -2]], "start": [1, 2]}),
)  # fmt: skip


def other_kinds(versions: int = 1, person: Person | None = None) -> Exam:
    exercises = tuple(rldrill.read({"family": family, "given": given}) for family, given in OTHER_KINDS)
    codes = (version_code(number) for number in range(versions))
    return Exam(Head(title="t"), 1, tuple(Version(code, exercises, (0, 1, 2), person=person) for code in codes))


def other(name: str, folder: Path) -> bytes:
    (path,) = export(other_kinds(), folder / "exam", FORMATS[name], practice=False)
    return path.read_bytes()


def test_choices_and_matrices_of_a_page_are_buttons_and_boxes_in_their_columns(tmp_path: Path) -> None:
    (path,) = export(other_kinds(), tmp_path / "exam.html", FORMATS["html"], practice=True)
    text = path.read_text(encoding="utf-8")
    assert re.findall(r'type="radio" name="cell-0" value="(\w+)"><span>(.*?)</span>', text) == [
        ("A", "(A) small"), ("B", "(B) large"), ("yes", "yes"), ("no", "no"),
    ]  # fmt: skip
    assert re.findall(r'class="cells matrix" style="grid-template-columns: repeat\((\d),', text) == ["2", "1"]
    assert re.findall(r'aria-label="(row \d, column \d)"', text) == [
        "row 1, column 1", "row 1, column 2", "row 1, column 1",
    ]  # fmt: skip


def test_word_gets_pictures_as_pictures_with_what_they_show(tmp_path: Path) -> None:
    pytest.importorskip("pypandoc")
    with zipfile.ZipFile(io.BytesIO(other("docx", tmp_path))) as document:
        text = document.read("word/document.xml").decode()
        pictures = [document.read(name) for name in document.namelist() if name.endswith(".png")]
    assert pictures
    assert all(each.startswith(b"\x89PNG") for each in pictures)
    assert 'descr="State diagram of ' in text


def test_choices_and_matrices_of_latex_moodle_and_qti(tmp_path: Path) -> None:
    latex = other("latex", tmp_path).decode()
    assert "\\begin{checkboxes}\n\\choice (A) small\n\\choice (B) large\n\\end{checkboxes}\n" in latex
    assert "\\begin{oneparcheckboxes}\n\\choice yes \\choice no\n\\end{oneparcheckboxes}\n" in latex

    assert "Q^π" in other("json", tmp_path).decode()

    moodle = [each.findtext("questiontext/text") or "" for each in ElementTree.fromstring(other("moodle", tmp_path))]
    assert "<p>(A) small</p><p>(B) large</p>" in moodle[1]
    assert re.findall(r":MULTICHOICE:(.*?)#", moodle[1] + moodle[2]) == ["=A~B", "=yes~no"]
    assert [row.count("<td>") for row in re.findall("<tr>(.*?)</tr>", moodle[3])[-2:]] == [2, 1]

    with zipfile.ZipFile(io.BytesIO(other("qti", tmp_path))) as package:
        items = [package.read(name).decode() for name in sorted(package.namelist()) if name.endswith(".xml")]
    text = "".join(items)
    choices = re.findall(r'<choiceInteraction .*?maxChoices="1">(.*?)</choiceInteraction>', text)
    assert [re.findall("<simpleChoice [^>]*>(.*?)</simpleChoice>", each) for each in choices] == [
        ["(A) small", "(B) large"], ["yes", "no"],
    ]  # fmt: skip
    tables = re.findall(r"<table><tbody>(.*?)</tbody></table>", text)
    assert [(each.count("<tr>"), each.count("<td>")) for each in tables] == [(1, 2), (1, 1)]


def test_each_version_has_a_file_of_its_own_unless_the_format_holds_them_all(tmp_path: Path) -> None:
    ann = Person("Ann", "1")
    for exam, format_, names in (
        (other_kinds(), "latex", ["x.tex"]),
        (other_kinds(2), "latex", ["x-A.tex", "x-B.tex"]),
        (other_kinds(1, ann), "latex", ["x-A.tex"]),
        (other_kinds(2), "json", ["x.json"]),
    ):
        path = named(tmp_path / "x.pdf", FORMATS[format_])
        assert [version_path(exam, path, FORMATS[format_], each).name for each in exam.versions] == [
            *names, *names[:1] * (len(exam.versions) - len(names)),
        ]  # fmt: skip


def test_other_programs_take_all_versions_at_once_and_people_one_each() -> None:
    assert {name for name, each in FORMATS.items() if each.whole} == {"moodle", "qti", "canvas", "anki", "json"}
    assert {name for name, each in FORMATS.items() if not each.whole} == {"html", "latex", "markdown", "docx"}


def test_a_name_gets_the_ending_of_its_format() -> None:
    assert named(Path("a/x.html"), FORMATS["latex"]) == Path("a/x.tex")
    assert named(Path("a/x"), FORMATS["latex"]) == Path("a/x.tex")
    assert named(Path("a/x.TEX"), FORMATS["latex"]) == Path("a/x.TEX")


def test_a_format_may_be_named_in_any_case_and_a_pdf_is_none() -> None:
    assert format_of(Path("a.html"), " LaTeX ") == FORMATS["latex"]
    assert format_of(Path("a.html"), "PDF") is None
    assert format_of(None) is None


def test_what_is_there_is_replaced_only_by_force(tmp_path: Path) -> None:
    exam, path = other_kinds(2), tmp_path / "x.tex"
    check(exam, path, FORMATS["latex"], force=False)
    (tmp_path / "x-B.tex").write_text("")
    with pytest.raises(UsageError, match=r"x-B\.tex is there already; --force replaces it"):
        check(exam, path, FORMATS["latex"], force=False)
    check(exam, path, FORMATS["latex"], force=True)
    check(exam, tmp_path / "none" / "x.tex", FORMATS["latex"], force=True)  # the folder is made


def test_it_is_said_where_a_program_gives_points_that_the_exam_does_not() -> None:
    """Problems have tables and vectors; of single numbers nothing is lost."""
    entries = replace(exam(), partial="entries")
    (version,) = entries.versions
    numbers = replace(exam(), versions=(Version("A", (rldrill.load("optimal-value/3/5"),), (0,)),))
    ruled = replace(entries, versions=(replace(version, partial=({"a": "all"}, *[{}] * 4)),))
    for name, program in (("moodle", "Moodle"), ("canvas", "Canvas")):
        lost = f'{program} marks box by box: parts with partial = "all" earn a share there for what is right in them'
        assert says_what_is_lost(exam(), FORMATS[name]) == says_what_is_lost(ruled, FORMATS[name]) == lost
        assert says_what_is_lost(entries, FORMATS[name]) == ""
        assert says_what_is_lost(numbers, FORMATS[name]) == ""
    assert says_what_is_lost(exam(), FORMATS["qti"]) == ""


def test_what_is_only_chosen_is_told_nothing_of_decimals() -> None:
    chosen, typed = (rldrill.load(name) for name in ("backup-diagram-name/2/13", "td-zero/1/1"))
    asked = [[cell for part in each.parts for cell in cells(each, part)] for each in (chosen, typed)]
    assert note(Head(), asked[0], reads="both") == ""
    assert "0.667" in note(Head(), asked[0] + asked[1], reads="both")
    open_ = rldrill.load("policy-value/3/12")
    assert "by hand" in note(Head(), cells(open_, open_.parts[0]), reads="both")


def test_the_right_choice_is_told_in_words_and_a_wrong_number_as_it_is_written_by_hand() -> None:
    chosen = rldrill.load("backup-diagram-name/2/13")
    assert answer(chosen, chosen.parts[0], words("en")) == Paragraph("(B) the Monte Carlo method for state values")
    part = Part("?", Number(), label="a")
    wrong = Wrong(("-1/8",), fmpq(-1, 8), "", None, possible=True)
    assert [latex(line) for line in typeset(part, wrong)] == [r"- \frac{1}{8} = - 0.125"]
