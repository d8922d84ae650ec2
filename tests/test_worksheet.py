"""Worksheets: the same arguments print the same bytes, versions share nothing, all fits the page."""

import hashlib
import json
import os
import re
import signal
import subprocess
import sys
import time
from fractions import Fraction
from pathlib import Path

import pytest
import typer
from msgspec.structs import replace
from typer.testing import CliRunner

from layout import measured
from printed import poppler
from rldrill import draw, load, read
from rldrill.commands import worksheet as worksheet_command
from rldrill.exam.blueprint import Blueprint, Entry
from rldrill.exam.exam import Exam, Head, Layout, Version
from rldrill.exam.planning import plan
from rldrill.print.exam_page import setup
from rldrill.print.fonts import needs_system_fonts
from rldrill.print.key import key_source
from rldrill.print.paper import pdf
from rldrill.print.worksheet import even_columns, options, space_of, worksheet_source
from rldrill.problems.errors import FileError, UsageError
from rldrill.problems.notations import used
from rldrill.problems.parts import Choice, Matrix, Number, Part
from rldrill.problems.pictures import Picture
from rldrill.render.mathematics.unicode import unicode
from rldrill.render.unicode import unicode_text
from rldrill.solutions.answers.key import answer_lines
from rldrill.solutions.answers.rule import RULE
from rldrill.writing import write_bytes_atomically

TITLE = "Quiz #1 *for* <all> $ ] // @x costs $5 and $6"


def exam_of(*names: str, count: int = 3, seed: int = 5, level: int | None = None, **more: object) -> Exam:
    return plan(Blueprint(problems=(Entry(topic=names, count=count, level=level),), seed=seed, **more))


def printed(exam: Exam, folder: Path, source: object = worksheet_source, version: int = 0) -> Path:
    path = folder / "x.pdf"
    with used(exam.layout.notation, exam.head.decimal_mark):
        path.write_bytes(pdf(source(exam, exam.versions[version]), accessible=True))
    return path


def text_of(path: Path) -> str:
    return poppler("pdftotext", "-layout", str(path), "-")


@pytest.fixture(scope="module")
def exam() -> Exam:
    return exam_of(
        "td-zero", "bellman", "forward-kinematics", count=8, versions=2, title=TITLE, paper="letter", ids=True,
        course="Robot Learning", date="2027-02-11", instructions="No $ calculators.", duration=90,
    )  # fmt: skip


@pytest.fixture(scope="module")
def sheet(exam: Exam, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return printed(exam, tmp_path_factory.mktemp("sheet"), version=1)


@pytest.fixture(scope="module")
def key(exam: Exam, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return printed(exam, tmp_path_factory.mktemp("key"), key_source, version=1)


def test_what_stands_on_the_worksheet(exam: Exam, sheet: Path) -> None:
    pages = [page for page in text_of(sheet).split("\f") if page.strip()]
    for number, page in enumerate(pages, 1):
        head = page.strip().splitlines()[0]
        assert "Name:" in head
        assert "Number:" in head
        assert "Version B" in head
        assert f"{number}/{len(pages)}" in head
    first = " ".join(pages[0].split())
    for said in (TITLE, "Robot Learning · 2027-02-11", "No $ calculators.", RULE, "You have 90 minutes.", "Total"):
        assert said in first
    assert all(str(exercise.id) in text_of(sheet) for exercise in exam.versions[1].exercises)


def test_no_id_and_no_seed_is_printed_unless_it_is_asked_for(exam: Exam, tmp_path: Path) -> None:
    hidden = text_of(printed(replace(exam, layout=Layout()), tmp_path))
    assert "seed" not in hidden
    assert not any(str(exercise.id).partition("@")[0] in hidden for exercise in exam.versions[0].exercises)


def test_every_part_has_its_points_and_a_total(exam: Exam, sheet: Path) -> None:
    version = exam.versions[1]
    lines = [line for line in text_of(sheet).splitlines() if "Version" not in line]
    marks = [found[1] for line in lines if (found := re.search(r" {9}/ ?(\d+)$", line))]
    assert [int(mark) for mark in marks] == [part.points for item in version.exercises for part in item.parts]
    assert sum(map(int, marks)) == version.points


def test_the_key_has_the_questions_the_answers_and_the_points(exam: Exam, key: Path) -> None:
    text = text_of(key)
    assert "Key B" in text
    assert all(str(exercise.id) in text for exercise in exam.versions[1].exercises)
    assert "Typical wrong answers" in text


def test_a_key_has_no_room_for_a_name(sheet: Path, key: Path) -> None:
    assert "Name:" in text_of(sheet)
    assert "Name:" not in text_of(key)


def test_a_key_goes_without_a_mistake_that_gives_no_number() -> None:
    """Without exp the probability of h = 0 is 0, and 0 ln 0 is nothing that anybody writes down."""
    exercise = load("softmax-policy/3/493395")
    exam = Exam(Head(), 1, (Version("A", (exercise,), (0,)),))
    assert "nan" not in key_source(exam, exam.versions[0])


def test_the_key_of_a_choice_says_its_text() -> None:
    exercise = draw("backup-diagram-name", 1, 3)
    (part,) = exercise.parts
    right = part.kind.options[exercise.solve()["a"]]
    exam = Exam(Head(), 1, (Version("A", (exercise,), (0,)),))
    source = key_source(exam, exam.versions[0])
    block = source[source.index("#answer-block") :].partition("\n")[0]
    assert right.partition("$")[0] in block


def test_the_key_tells_the_wrong_number_of_a_typical_mistake() -> None:
    """R₀ = 1 + 1/2·4 = 3; who forgets γ answers 1 + 4 = 5."""
    exercise = read({"family": "return", "given": {"gamma": "1/2", "rewards": [1, 4], "time": 0}})
    exam = Exam(Head(), 1, (Version("A", (exercise,), (0,)),))
    source = key_source(exam, exam.versions[0])
    assert "$5$" in source[source.index("#mistakes") :]


def test_the_points_of_a_part_are_earned_by_its_steps() -> None:
    for name in ("policy-value", "td-zero", "lqr-gain", "backup-diagram-name"):
        exercise = draw(name, 2, 4)
        for part in exercise.parts:
            assert sum(points for _, points in exercise.scheme(part.label)) == part.points


def test_every_update_of_three_that_are_alike_earns_a_point_of_three() -> None:
    exercise = draw("td-zero", 2, 1)
    assert exercise.parts[0].points == 3
    assert [points for _, points in exercise.scheme("a")] == [1, 1, 1]


def test_no_piece_of_a_working_stands_without_points_before_the_last() -> None:
    for name in ("policy-value", "lqr-infinite", "sarsa", "kalman-filter"):
        exercise = draw(name, 2, 4)
        for part in exercise.parts:
            assert all(points > 0 for _, points in exercise.scheme(part.label)[:-1])


@pytest.mark.parametrize("what", ["sheet", "key"])
def test_nothing_is_in_the_margins_and_pages_are_filled(what: str, request: pytest.FixtureRequest) -> None:
    pages = measured(request.getfixturevalue(what).read_bytes())
    assert not any(page.overfull for page in pages)
    assert all(page.filled > 0.5 for page in pages[:-1])
    assert min(page.smallest for page in pages) > 4.5


def test_twelve_problems_for_an_hour_take_seven_pages_at_most(tmp_path: Path) -> None:
    exam = plan(Blueprint(problems=(Entry(topic=(), count=12),), minutes=54, seed=1))
    assert 49 <= exam.versions[0].minutes <= 59
    assert len(measured(printed(exam, tmp_path).read_bytes())) <= 7


def test_room_follows_the_minutes_and_a_tick_gets_none() -> None:
    long, short = draw("reinforce", 3, 0), draw("markov-property", 1, 1)
    rooms = {
        (item.problem.family.name, part.label): space_of(item, part, "normal")
        for item in (long, short)
        for part in item.parts
    }
    assert rooms["reinforce", "b"] == Fraction(48, 10)  # twelve minutes of four millimetres, the most
    yes_no = next(part for part in short.parts if part.kind.name == "yes/no")
    assert rooms["markov-property", yes_no.label] == 0
    part = long.parts[1]
    assert space_of(long, part, "none") == 0 < space_of(long, part, "tight") < space_of(long, part, "wide")


def test_an_answer_with_letters_in_it_has_wider_cells() -> None:
    for level, cell in ((2, "2.4cm"), (3, "5.2cm")):  # at level 3 the values are asked for in terms of γ
        version = Version("A", (draw("policy-value", level, 1),), (0,))
        assert f", {cell}, [" in worksheet_source(Exam(Head(), 1, (version,)), version)


def test_no_single_wrong_answer_is_left_to_the_next_page(tmp_path: Path) -> None:
    """Of three wrong answers of a line each, pages are tried that end between any two of them."""
    version = Version("A", (), (0,))
    exam = Exam(Head(), 1, (version,))
    rows = ", ".join(f"([{word}], [is wrong])" for word in ("One", "Two", "Three"))
    split = set()
    for room in range(230, 260):
        source = f"{setup(exam, version, 'Key', to_fill_in=False)}#v({room}mm)\n#mistakes([Wrong], {rows})\n"
        (path := tmp_path / "key.pdf").write_bytes(pdf(source, accessible=False))
        _, *rest = text_of(path).split("\f")
        split.add(sum(word in "".join(rest) for word in ("One", "Two", "Three")))
    assert split == {0, 2, 3}


def test_short_options_stand_side_by_side_and_are_read_down_the_columns() -> None:
    exercise = draw("backup-diagram-name", 1, 1)
    (part, *_) = exercise.parts
    six = {letter: f"option {letter}" for letter in "ABCDEF"}
    assert options(replace(part, kind=Choice(six))) == "#choices(3, {})\n".format(
        ", ".join(f'[#"({letter}) option {letter}";]' for letter in "ACEBDF")
    )
    long = {letter: "of an option that is a whole sentence there is one on a line " + letter for letter in "AB"}
    assert options(replace(part, kind=Choice(long))).startswith("#choices(1, ")


@pytest.mark.parametrize(("cells", "columns"), [(1, 1), (5, 5), (6, 3), (7, 4), (11, 4), (16, 4)])
def test_no_cell_of_a_table_for_answers_is_left_alone(cells: int, columns: int) -> None:
    assert even_columns(cells, most=5) == columns


@pytest.mark.parametrize(("problems", "columns"), [(1, [2]), (13, [14]), (14, [8, 7]), (28, [10, 10, 9])])
def test_points_stand_in_tables_of_at_most_fourteen_columns_as_wide_as_each_other(
    problems: int, columns: list[int]
) -> None:
    exam = exam_of("td-zero", "epsilon-greedy", count=problems, level=1)
    source = worksheet_source(exam, exam.versions[0])
    tables = re.findall(r"#points-table\(\(\[#?\"?Problem\"?;?\], ([^)]*)\)", source)
    assert [len(table.split(", ")) for table in tables] == columns


# A person's own words


@pytest.mark.parametrize("title", ["$5", "Costs $5 and $6", "x" * 120, "Übung ¼", "امتحان", "#let a = $", "@a <b> *c*"])
def test_titles_are_plain_text(title: str, tmp_path: Path) -> None:
    exam = exam_of("return", count=1, level=1, title=title)
    path = printed(exam, tmp_path)
    found = "".join(text_of(path).split()).replace("\u200b", "")
    if title.isascii():
        assert title.replace(" ", "") in found
    assert not any(page.overfull for page in measured(path.read_bytes()))


def test_a_character_that_no_font_has_is_said() -> None:
    assert not needs_system_fonts(Head(title="Übung"), ())
    with pytest.raises(UsageError, match="No font on this computer has"):
        needs_system_fonts(Head(title="\U0001f9ff\ue123"), ())


def test_the_fixed_words_are_german_and_decimals_have_a_comma(tmp_path: Path) -> None:
    exam = exam_of("return", count=2, level=2, language="de", decimal_mark=",")
    assert {"Aufgabe", "Punkte", "Summe", "Matrikelnummer:"} <= set(text_of(printed(exam, tmp_path)).split())
    key = text_of(printed(exam, tmp_path, key_source))
    assert not re.search(r"\d\.\d", key.replace("\n", " "))


def test_solutions_stand_in_the_worksheet_where_they_are_wanted() -> None:
    exam = exam_of("return", count=1, level=1, solutions="inline")
    source = worksheet_source(exam, exam.versions[0])
    assert "#answer-block" in source
    assert "#field" not in source.partition("#front")[2]


def test_duplex_pages_are_even(tmp_path: Path) -> None:
    for names in (("return",), ("optimal-value",)):
        exam = exam_of(*names, count=1, level=3, duplex=True)
        assert len(measured(printed(exam, tmp_path).read_bytes())) % 2 == 0


# PDF


@pytest.mark.parametrize(("paper", "size"), [("a4", "595.276 x 841.89"), ("letter", "612 x 792")])
def test_paper_sizes_tags_and_language(paper: str, size: str, tmp_path: Path) -> None:
    exam = exam_of("return", count=1, level=1, paper=paper)
    path = printed(exam, tmp_path)
    said = poppler("pdfinfo", str(path))
    assert size in said
    assert re.search(r"Tagged: +yes", said)
    assert "Version A" in said
    assert re.search(rb"/Lang *\(en", path.read_bytes())


def test_the_same_bytes_in_every_process() -> None:
    program = (
        "import hashlib\nfrom rldrill.exam.blueprint import Blueprint, Entry\nfrom rldrill.exam.planning import plan\n"
        "from rldrill.print.key import key_source\nfrom rldrill.print.paper import pdf\n"
        "from rldrill.print.worksheet import worksheet_source\n"
        "entry = Entry(topic=('return', 'value-iteration', 'lqr-gain'), count=3)\n"
        "exam = plan(Blueprint(problems=(entry,), seed=9, versions=2))\n"
        "for source in (worksheet_source, key_source):\n"
        "    print(hashlib.sha256(pdf(source(exam, exam.versions[1]), accessible=True)).hexdigest())\n"
    )
    processes = [
        subprocess.Popen(
            [sys.executable, "-c", program],
            env={**os.environ, "PYTHONHASHSEED": salt},
            stdout=subprocess.PIPE,
            text=True,
        )
        for salt in ("1", "2")
    ]
    first, second = (process.communicate()[0] for process in processes)
    assert first == second
    exam = exam_of("return", "value-iteration", "lqr-gain", seed=9, versions=2)
    here = [pdf(source(exam, exam.versions[1]), accessible=True) for source in (worksheet_source, key_source)]
    assert first.split() == [hashlib.sha256(data).hexdigest() for data in here]


def test_typst_errors_are_runtime_errors() -> None:
    with pytest.raises(RuntimeError):
        pdf("#nothing-of-that-name")


def exact_and_decimal(kind: Number | Matrix, value: object) -> str:
    return "; ".join(map(unicode, answer_lines(Part("?", kind), value)))


def test_keys_give_exact_numbers_and_decimals() -> None:
    import sympy
    from flint import fmpq, fmpq_mat

    assert exact_and_decimal(Number(), fmpq(7)) == "7"
    assert exact_and_decimal(Number(), fmpq(7, 2)) == "7/2 = 3.5"
    assert exact_and_decimal(Number(), fmpq(-1, 3)) == "−1/3 ≈ −0.3333"
    assert exact_and_decimal(Number(), fmpq(1, 3 * 10**7)) == "1/30000000 ≈ 3.333·10⁻⁸"
    assert exact_and_decimal(Number(), sympy.exp(1)) == "e ≈ 2.718"
    assert exact_and_decimal(Matrix(1, 2), fmpq_mat(1, 2, [fmpq(1, 3), 2])) == "[1/3  2] ≈ [0.3333  2]"


# Writing


def test_an_old_file_stays_when_the_new_one_fails(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "old.pdf"
    path.write_bytes(b"old")

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("rldrill.writing.os.fsync", full)
    with pytest.raises(OSError, match="No space left") as caught:
        write_bytes_atomically(path, b"new")
    assert caught.value.filename == str(path)
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_missing_folder_is_made(tmp_path: Path) -> None:
    write_bytes_atomically(tmp_path / "no" / "none" / "x.pdf", b"new")
    assert (tmp_path / "no" / "none" / "x.pdf").read_bytes() == b"new"


def test_a_folder_that_cannot_be_made_is_named(tmp_path: Path) -> None:
    (tmp_path / "no").write_text("a file")
    with pytest.raises(FileExistsError) as caught:
        write_bytes_atomically(tmp_path / "no" / "x.pdf", b"")
    assert caught.value.filename == str(tmp_path / "no" / "x.pdf")


def test_a_file_is_replaced_with_its_rights(tmp_path: Path) -> None:
    path = tmp_path / "x.pdf"
    path.write_bytes(b"old")
    path.chmod(0o640)
    write_bytes_atomically(path, b"new")
    assert path.read_bytes() == b"new"
    assert path.stat().st_mode & 0o777 == 0o640


def test_a_link_stays_one_and_what_it_names_is_replaced(tmp_path: Path) -> None:
    real, link, dangling = tmp_path / "there" / "real.json", tmp_path / "link.json", tmp_path / "dangling.json"
    write_bytes_atomically(real, b"old")
    link.symlink_to("there/real.json")
    dangling.symlink_to(tmp_path / "there" / "none.json")
    for path in (link, dangling):
        write_bytes_atomically(path, b"new")
        assert path.is_symlink()
        assert path.read_bytes() == b"new"
    assert real.read_bytes() == b"new"
    assert {path.name for path in (tmp_path / "there").iterdir()} == {"real.json", "none.json"}


@pytest.mark.skipif(sys.platform == "win32", reason="there are no such pipes")
def test_a_pipe_stays_one_and_takes_what_is_written(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reading = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    write_bytes_atomically(pipe, b"new")
    assert os.read(reading, 9) == b"new"
    os.close(reading)
    assert pipe.is_fifo()
    assert list(tmp_path.iterdir()) == [pipe]


# The command


def run(*arguments: str | Path) -> tuple[list[str], str]:
    """The files that the command names, and what it says beside them."""
    app = typer.Typer()
    app.command()(worksheet_command.command)
    result = CliRunner().invoke(app, [*map(str, arguments), "--json"], catch_exceptions=False)
    assert result.exit_code == 0, result.stderr
    return [Path(path).name for path in json.loads(result.stdout)], result.stderr


def refused(*arguments: str | Path) -> str:
    """The sentence that the command refuses with."""
    with pytest.raises(UsageError) as caught:
        run(*arguments)
    return str(caught.value)


def bytes_in(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.glob("*.pdf")}


def test_the_command_prints_the_files_and_echoes_the_seed(tmp_path: Path) -> None:
    written, said = run("return", "-n", 2, "--seed", 4, "-o", tmp_path / "a.pdf")
    assert written == ["a.pdf", "a-key.pdf", "a.json"]
    assert said == "seed 4\n"


def test_a_manifest_prints_the_same_bytes_again_and_keys_alone(tmp_path: Path) -> None:
    there, again, keys = tmp_path / "there", tmp_path / "again", tmp_path / "keys"
    for folder in (there, again, keys):
        folder.mkdir()
    _, said = run("return", "td-zero/1/62590", "-n", 2, "--seed", 4, "--versions", 2, "-o", there / "a.pdf")
    assert "2 versions: shared problems 0, 1 the same in all, shared answers 0" in said
    data = json.loads((there / "a.json").read_text())
    assert data["typst"]
    first, *_ = data["versions"][0]["problems"]
    assert load(first["id"]).problem.data() == first["problem"]
    for version in data["versions"]:  # as if the family had moved on since
        for problem in version["problems"]:
            problem["id"] = re.sub(r"@\d+", "@99", problem["id"]) if problem["slot"] else problem["id"]
    written, _ = run("--from", there / "a.json", "-o", again / "a.pdf")
    assert written == ["a-A.pdf", "a-A-key.pdf", "a-B.pdf", "a-B-key.pdf", "a.json"]
    assert bytes_in(there) == bytes_in(again)
    assert (there / "a.json").read_bytes() == (again / "a.json").read_bytes()
    (keys / "a.json").write_text(json.dumps(data))
    assert run("--from", keys / "a.json", "--key")[0] == ["a-A-key.pdf", "a-B-key.pdf"]


def test_a_second_run_overwrites_nothing_unless_it_is_forced_and_leaves_nothing_stale(tmp_path: Path) -> None:
    output = ("-o", tmp_path / "a.pdf")
    run("return", "-n", 1, "--seed", 4, "--versions", 3, *output)
    before = bytes_in(tmp_path)
    told = refused("return", "-n", 1, "--seed", 5, "--versions", 2, *output)
    assert "a.json" in told
    assert "--force" in told
    assert bytes_in(tmp_path) == before
    run("return", "-n", 1, "--seed", 5, "--versions", 2, "--force", *output)
    assert set(bytes_in(tmp_path)) == {"a-A.pdf", "a-A-key.pdf", "a-B.pdf", "a-B-key.pdf"}
    assert bytes_in(tmp_path)["a-A.pdf"] != before["a-A.pdf"]


def test_an_exam_stays_until_the_next_one_is_drawn(tmp_path: Path) -> None:
    blueprint, output = tmp_path / "exam.toml", ("-o", tmp_path / "a.pdf")
    blueprint.write_text('points = 5\n[[problems]]\nfamily = "return"\nlevel = 1\n')
    run(blueprint, *output)
    before = {path.name: path.read_bytes() for path in tmp_path.glob("a*")}
    blueprint.write_text(blueprint.read_text().replace("5", "1"))  # for two parts
    with pytest.raises(FileError, match="raise the total"):
        run(blueprint, *output, "--force")
    assert {path.name: path.read_bytes() for path in tmp_path.glob("a*")} == before


def test_keys_that_are_printed_elsewhere_are_those_of_the_exam_that_is_named(tmp_path: Path) -> None:
    for seed, name in enumerate(("one", "two")):
        run("return", "-n", 1, "--seed", seed, "-o", tmp_path / f"{name}.pdf")
    printed = bytes_in(tmp_path)
    one, two = (("--from", tmp_path / f"{name}.json", "--key", "-o", tmp_path / "keys.pdf") for name in ("one", "two"))
    assert run(*one)[0] == ["keys-key.pdf"]
    for again in (one, two):  # nothing tells whose the keys are that lie there
        assert "keys-key.pdf" in refused(*again)
    assert bytes_in(tmp_path)["keys-key.pdf"] == printed["one-key.pdf"]
    assert run(*two, "--force")[0] == ["keys-key.pdf"]
    assert bytes_in(tmp_path) == {**printed, "keys-key.pdf": printed["two-key.pdf"]}


def test_keys_that_are_forced_on_another_exam_leave_its_manifest(tmp_path: Path) -> None:
    for seed, name in enumerate(("one", "two")):
        run("return", "-n", 1, "--seed", seed, "-o", tmp_path / f"{name}.pdf")
    manifest = (tmp_path / "one.json").read_bytes()
    run("--from", tmp_path / "two.json", "--key", "-o", tmp_path / "one.pdf", "--force")
    assert (tmp_path / "one.json").read_bytes() == manifest
    assert (tmp_path / "one.pdf").exists()


def test_no_export_takes_the_place_of_a_manifest(tmp_path: Path) -> None:
    run("return", "-n", 1, "--seed", 4, "-o", tmp_path / "a.pdf")
    manifest = (tmp_path / "a.json").read_bytes()
    for made in (["--from", tmp_path / "a.json", "--format", "json"], ["td-zero", "-o", tmp_path / "a.json"]):
        assert "a.json is the manifest of an exam, without which it" in refused(*made, "--force")
    assert (tmp_path / "a.json").read_bytes() == manifest
    assert run("--from", tmp_path / "a.json", "-o", tmp_path / "b.json")[0] == ["b.json"]
    assert run("--from", tmp_path / "a.json", "-o", tmp_path / "b.json", "--force")[0] == ["b.json"]


def test_a_run_that_was_ended_goes_on(tmp_path: Path) -> None:
    arguments = ("return", "-n", 1, "--seed", 4, "--versions", 2, "-o", tmp_path / "a.pdf")
    run(*arguments)
    whole = bytes_in(tmp_path)
    (tmp_path / "a-B.pdf").unlink()
    written, said = run(*arguments)
    assert written == ["a-B.pdf", "a.json"]
    assert "3 of 4 PDFs are there already; the rest is written" in said
    written, said = run(*arguments)
    assert "4 of 4 PDFs are there already; --force writes them anew" in said
    assert bytes_in(tmp_path) == whole


def test_a_roster_gives_everybody_a_version_and_one_pdf_of_all(tmp_path: Path) -> None:
    (tmp_path / "course.csv").write_text('name,number\n"Lee, Ann",17\nBob,4\n')
    arguments = ("return", "-n", 1, "--seed", 4, "--solutions", "none", "--roster", tmp_path / "course.csv")
    written, _ = run(*arguments, "-o", tmp_path / "a.pdf")
    assert written == ["a-A.pdf", "a-B.pdf", "a.pdf", "a.json"]
    pages = text_of(tmp_path / "a.pdf").split("\f")
    assert "Lee, Ann" in pages[0]
    assert "17" in pages[0]
    assert "Bob" in pages[1]
    whole = (tmp_path / "a.pdf").read_bytes()
    (tmp_path / "a.pdf").unlink()
    run(*arguments, "-o", tmp_path / "a.pdf")
    assert (tmp_path / "a.pdf").read_bytes() == whole


def test_a_blueprint_is_written_read_and_printed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    run("--init", "exam.toml")
    assert "is there already" in refused("--init", "exam.toml")
    assert run("exam.toml", "--versions", 1)[0] == ["exam.pdf", "exam-key.pdf", "exam.json"]
    assert json.loads(Path("exam.json").read_text())["points"] == 60
    for more, out in ((("bellman",), "the other names"), (("-n", 3), "-n"), (("--level", 2), "--level")):
        assert f"leave {out} out" in refused("exam.toml", *more)


def test_what_an_option_would_not_do_is_refused(tmp_path: Path) -> None:
    roster = tmp_path / "course.csv"
    roster.write_text("name,number\nAda,1\n")
    assert "leave --versions out" in refused("return", "--roster", roster, "--versions", 2)
    for option in (["return"], ["-n", 3], ["--paper", "letter"], ["--no-ids"], ["-o", "x.pdf"], ["--seed", 0]):
        assert "leave the rest out" in refused("--init", tmp_path / "new.toml", *option)
    assert not (tmp_path / "new.toml").exists()


def test_problems_that_are_the_same_in_all_versions_are_counted(tmp_path: Path) -> None:
    _, said = run("td-zero/1/62590", "return", "-n", 2, "--versions", 2, "--seed", 4, "-o", tmp_path / "a.pdf")
    assert "2 versions: shared problems 0, 1 the same in all, shared answers 0" in said


def test_names_ids_and_files_are_mixed(tmp_path: Path) -> None:
    mine = tmp_path / "mine.toml"
    mine.write_text('family = "return"\n[given]\ngamma = "1/2"\nrewards = [1, 4]\ntime = 0\n')
    run("td-zero/1/62590", mine, "bellman", "-n", 4, "--seed", 1, "-x", "policy-value", "-o", tmp_path / "a.pdf")
    problems = json.loads((tmp_path / "a.json").read_text())["versions"][0]["problems"]
    assert [problem["family"] for problem in problems[:2]] == ["td-zero", "return"]
    assert len(problems) == 4


@pytest.mark.parametrize(
    ("output", "message"),
    [
        (".", "is a folder"),
        ("x.txt", "x.txt has the ending of no format; give it one of .pdf, "),
        ("x", "x has the ending of no format; give it one of .pdf, "),
    ],
)
def test_the_command_refuses_other_paths(output: str, message: str) -> None:
    assert message in refused("-o", output)


def test_a_json_file_that_is_no_manifest_is_not_overwritten(tmp_path: Path) -> None:
    (tmp_path / "x.json").write_text('{"mine": 1}')
    assert "x.json would be overwritten" in refused("return", "--force", "-o", tmp_path / "x.pdf")
    assert [path.name for path in tmp_path.iterdir()] == ["x.json"]


def test_families_may_be_named_with_a_level(tmp_path: Path) -> None:
    run("bayes-filter/1", "td-zero", "optimal-value/3", "-n", "3", "-o", tmp_path / "x.json")
    (version,) = json.loads((tmp_path / "x.json").read_text())["versions"]
    ids = [problem["id"].split("/") for problem in version["problems"]]
    assert [(family, level) for family, level, _ in ids[:2]] == [("bayes-filter", "1"), ("optimal-value", "3")]
    assert [family for family, _, _ in ids[2:]] == ["td-zero"]


def test_a_problem_that_is_named_twice_is_printed_once(tmp_path: Path) -> None:
    run("td-zero/1/62590", "td-zero/1/62590", "-o", tmp_path / "x.json")
    (version,) = json.loads((tmp_path / "x.json").read_text())["versions"]
    assert len(version["problems"]) == 1


def test_a_family_at_a_level_is_a_problem_as_often_as_it_is_named(tmp_path: Path) -> None:
    run("return/1", "return/1", "return/2", "-o", tmp_path / "x.json")
    (version,) = json.loads((tmp_path / "x.json").read_text())["versions"]
    assert [problem["level"] for problem in version["problems"]] == [1, 1, 2]


@pytest.mark.parametrize("option", [["-n", 3], ["--level", 2]])
def test_where_all_problems_are_named_nothing_says_what_else_is_drawn(tmp_path: Path, option: list[str | int]) -> None:
    said = f"All problems are named; leave {option[0]} out"
    assert said in refused("td-zero/1/7", "return/1", *option, "-o", tmp_path / "x.json")


@pytest.mark.parametrize("names", [["td-zero/1/7", "return"], ["td-zero/1/7", "return/1"]])
def test_no_more_problems_are_named_than_are_wanted(tmp_path: Path, names: list[str]) -> None:
    assert "2 problems are named, and -n asks for 1" in refused(*names, "-n", 1, "-o", tmp_path / "x.json")
    run(*names, "-n", 2, "-o", tmp_path / "x.json")
    (version,) = json.loads((tmp_path / "x.json").read_text())["versions"]
    assert len(version["problems"]) == 2


@pytest.mark.parametrize(("wanted", "said"), [(24, False), (300, True)])  # eight short problems take 300 nowhere
def test_minutes_that_are_missed_are_told(tmp_path: Path, wanted: int, said: bool) -> None:
    _, told = run("bellman", "--level", 1, "-n", 8, "-m", wanted, "--seed", 1, "-o", tmp_path / "no" / "x.html")
    assert (f" minutes, not {wanted}; ask for other minutes, or name more topics or problems" in told) == said


OWN = 'family = "return"\n[given]\nrewards = [7, 11, 13]\ngamma = "1/2"\n'  # R₀ = 7 + 11/2 + 13/4 = 63/4
WITH_OWN = 'title = "x"\nseed = 1\n[[problems]]\nfile = "own.toml"\n[[problems]]\nid = "td-zero/1/7"\n'


@pytest.mark.parametrize("ending", ["md", "html", "json", "tex"])
def test_a_blueprint_with_a_problem_of_ones_own_is_an_exam_too(tmp_path: Path, ending: str) -> None:
    (tmp_path / "own.toml").write_text(OWN)
    (tmp_path / "exam.toml").write_text(WITH_OWN)
    target = tmp_path / f"e.{ending}"
    run(tmp_path / "exam.toml", "-o", target)
    text = target.read_text(encoding="utf-8")
    if ending == "tex":  # which holds the solutions, not to be printed
        assert "% \\printanswers" in text
        return
    assert not any(told in text for told in ("63/4", "15.75", "<details", "<script", '"steps"', '"answer"'))


@pytest.mark.skipif(sys.platform == "win32", reason="there nobody is asked to end")
def test_whoever_is_told_to_end_ends_without_a_word_and_can_go_on(tmp_path: Path) -> None:
    wanted = ["worksheet", "return", "-n", "1", "--level", "1", "--seed", "3", "--versions", "12"]
    command = [sys.executable, "-m", "rldrill", *wanted, "-o", str(tmp_path / "e.pdf")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as running:
        while not [*tmp_path.glob("*.pdf")]:
            assert running.poll() is None
            time.sleep(0.02)
        running.send_signal(signal.SIGTERM)
        _, said = running.communicate(timeout=60)
    assert running.returncode == 128 + signal.SIGTERM
    assert "Traceback" not in said
    again = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120)
    assert "are there already" in again.stderr
    assert len([*tmp_path.glob("*.pdf")]) == 24


def test_points_stand_at_the_last_line_of_an_equation_and_at_the_conclusion() -> None:
    last = [unicode_text(blocks[-1]) for blocks, _ in load("optimal-policy-from-v/3/1").scheme("a")]
    assert last[:2] == ["x = 0", "x = 9"]
    assert last[-1] == "The best action in slope is climb."
    *_, (blocks, points) = load("bayes-filter/2/17").scheme("a")
    assert points == 0
    assert isinstance(blocks[-1], Picture)
