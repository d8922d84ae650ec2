"""Worksheets: the same arguments print the same bytes, versions share no problem, all fits the page."""

import hashlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner

from printed import poppler, words
from rldrill import load, read
from rldrill.commands import worksheet as worksheet_command
from rldrill.exam.exam import Exam, Version, points_of
from rldrill.exam.manifest import manifest
from rldrill.exam.planning import plan, version_code
from rldrill.print.exam_files import write
from rldrill.print.key import key_source
from rldrill.print.paper import PAPERS, paper_of, pdf
from rldrill.print.worksheet import worksheet_source
from rldrill.problems.catalogue import families
from rldrill.problems.errors import UsageError
from rldrill.problems.parts import Matrix, Number, Part
from rldrill.render.mathematics.unicode import unicode
from rldrill.solutions.answers.key import answer_lines
from rldrill.solutions.answers.rule import RULE
from rldrill.writing import write_bytes_atomically

A4, LETTER = PAPERS["a4"], PAPERS["letter"]
MARGIN = 2 * 72 / 2.54 - 1
TITLE = "Quiz #1 *for* <all> $ ] // @x"


@pytest.fixture(scope="module")
def exam() -> Exam:
    return plan([], len(families()), None, 5, 3, title=TITLE)


@pytest.fixture(scope="module")
def folder(exam: Exam, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("printed")
    write(exam, folder / "exam.pdf", LETTER)
    return folder


def test_versions_share_families_and_levels_but_no_problem(exam: Exam) -> None:
    slots = [
        [(item.problem.family.name, item.problem.level) for item in version.exercises] for version in exam.versions
    ]
    assert slots[0] == slots[1] == slots[2]
    problems = [json.dumps(item.problem.data()) for version in exam.versions for item in version.exercises]
    assert len(set(problems)) == len(problems)


def test_a_version_repeats_no_problem() -> None:
    version = plan(["return"], 40, 1, 3, 1).versions[0]
    assert len({json.dumps(item.problem.data()) for item in version.exercises}) == 40


def test_versions_earn_the_same_place_by_place() -> None:
    versions = plan(["control", "bellman"], 5, 2, 8, 3).versions
    earned = [[points_of(exercise) for exercise in version.exercises] for version in versions]
    assert earned[0] == earned[1] == earned[2]
    assert len({exercise.id for version in versions for exercise in version.exercises}) == 15


def test_versions_are_lettered() -> None:
    assert [version_code(index) for index in (0, 25, 26, 27, 199)] == ["A", "Z", "AA", "AB", "GR"]


def test_files_of_several_versions(folder: Path) -> None:
    names = {"exam.json", *(f"exam-{code}{key}.pdf" for code in "ABC" for key in ("", "-key"))}
    assert {path.name for path in folder.iterdir()} == names


def test_files_of_one_version(tmp_path: Path) -> None:
    written = write(plan(["return"], 1, 1, 1, 1), tmp_path / "one.pdf", A4)
    assert [path.name for path in written] == ["one.pdf", "one-key.pdf", "one.json"]


def test_the_manifest_draws_the_same_problems(exam: Exam, folder: Path) -> None:
    data = json.loads((folder / "exam.json").read_text())
    assert data == json.loads(json.dumps(manifest(exam, "letter")))
    assert (data["seed"], data["title"], data["paper"]) == (5, TITLE, "letter")
    for version in data["versions"]:
        assert version["points"] == sum(problem["points"] for problem in version["problems"])
        for problem in version["problems"]:
            assert re.fullmatch(r"[a-z-]+/\d/\d+@\d+", problem["id"])
            assert load(problem["id"]).problem.data() == problem["problem"]
            assert problem["points"] == sum(part["points"] for part in problem["parts"])


def test_what_stands_on_the_worksheet(exam: Exam, folder: Path) -> None:
    printed = poppler("pdftotext", "-layout", str(folder / "exam-B.pdf"), "-")
    pages = [page for page in printed.split("\f") if page.strip()]
    assert all("Version B" in page and "seed 5" in page for page in pages)
    assert TITLE in pages[0]
    assert "Name:" in pages[0]
    assert "Total" in pages[0]
    assert RULE in " ".join(pages[0].split())
    for exercise in exam.versions[1].exercises:
        assert str(exercise.id) in printed


def test_the_key_has_every_id_and_title(exam: Exam, folder: Path) -> None:
    printed = poppler("pdftotext", "-layout", str(folder / "exam-C-key.pdf"), "-")
    assert all(str(exercise.id) in printed for exercise in exam.versions[2].exercises)
    assert "Key C" in printed


@pytest.mark.parametrize("name", ["exam-A", "exam-A-key", "exam-B", "exam-C-key"])
def test_every_word_is_inside_the_margins(folder: Path, name: str) -> None:
    found = list(words(folder / f"{name}.pdf"))
    assert found
    for word in found:
        inside = word.left > MARGIN and word.right < 612 - MARGIN and word.top > 20 and word.bottom < 772
        assert inside, word


def test_a_problem_is_torn_only_if_no_page_can_hold_it_or_the_first_would_stay_empty(exam: Exam, folder: Path) -> None:
    pages = poppler("pdftotext", "-layout", str(folder / "exam-A.pdf"), "-").split("\f")
    identities = [str(exercise.id) for exercise in exam.versions[0].exercises]
    torn = 0
    for exercise in exam.versions[0].exercises:
        page = next(page for page in pages if str(exercise.id) in page)
        before, rest = page.split(str(exercise.id))
        several = len(exercise.parts) > 1
        assert not several or "(a)" in rest, "the first part stays with the statement"
        if several and not all(f"({part.label})" in rest for part in exercise.parts):
            torn += page is not pages[0]
            assert not any(identity in before for identity in identities), "it had a page of its own to begin on"
    assert torn <= len(identities) // 5


def test_no_page_is_left_to_the_head_alone(tmp_path: Path) -> None:
    version = plan(["ddp-backward"], 1, 2, 2, 1).versions[0]
    (tmp_path / "x.pdf").write_bytes(pdf(worksheet_source(version, paper_of("a4"))))
    first, second, *_ = poppler("pdftotext", "-layout", str(tmp_path / "x.pdf"), "-").split("\f")
    assert str(version.exercises[0].id) in first
    assert "(a)" in first
    assert "(g)" in second


@pytest.mark.parametrize(("paper", "size"), [("a4", "595.276 x 841.89"), ("letter", "612 x 792")])
def test_paper_sizes(paper: str, size: str, tmp_path: Path) -> None:
    version = plan(["return"], 1, 1, 1, 1).versions[0]
    (tmp_path / "x.pdf").write_bytes(pdf(worksheet_source(version, paper_of(paper))))
    assert size in poppler("pdfinfo", str(tmp_path / "x.pdf"))


def test_there_are_two_papers() -> None:
    with pytest.raises(UsageError, match="a4 or letter"):
        paper_of("a5")


def test_the_same_bytes_in_every_process() -> None:
    program = (
        "import hashlib\nfrom rldrill.exam.planning import plan\nfrom rldrill.print.key import key_source\n"
        "from rldrill.print.paper import PAPERS, pdf\nfrom rldrill.print.worksheet import worksheet_source\n"
        "version = plan(['return', 'value-iteration', 'lqr-gain'], 3, None, 9, 2).versions[1]\n"
        "sources = (worksheet_source(version, PAPERS['a4']), key_source(version, PAPERS['a4']))\n"
        "print(*(hashlib.sha256(pdf(source)).hexdigest() for source in sources))\n"
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
    version = plan(["return", "value-iteration", "lqr-gain"], 3, None, 9, 2).versions[1]
    here = [pdf(source(version, A4)) for source in (worksheet_source, key_source)]
    assert first.split() == [hashlib.sha256(data).hexdigest() for data in here]


def test_typst_errors_are_runtime_errors() -> None:
    with pytest.raises(RuntimeError):
        pdf("#nothing-of-that-name")


def test_too_few_different_problems_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rldrill.exam.planning._ATTEMPTS", 0)
    with pytest.raises(UsageError, match="too few different problems"):
        plan(["return"], 1, 1, 1, 1)


def test_a_title_that_is_too_long_is_refused() -> None:
    with pytest.raises(UsageError, match="121 characters"):
        plan(["return"], 1, 1, 1, 1, title="x" * 121)


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


def test_a_missing_folder_is_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError) as caught:
        write_bytes_atomically(tmp_path / "no" / "x.pdf", b"")
    assert caught.value.filename == str(tmp_path / "no" / "x.pdf")


def test_a_file_is_replaced_with_its_rights(tmp_path: Path) -> None:
    path = tmp_path / "x.pdf"
    path.write_bytes(b"old")
    path.chmod(0o640)
    write_bytes_atomically(path, b"new")
    assert path.read_bytes() == b"new"
    assert path.stat().st_mode & 0o777 == 0o640


def test_a_json_file_that_is_no_manifest_is_not_overwritten(tmp_path: Path) -> None:
    (tmp_path / "x.json").write_text('{"mine": 1}')
    with pytest.raises(UsageError, match=r"x\.json would be overwritten"):
        write(plan(["return"], 1, 1, 1, 1), tmp_path / "x.pdf", A4)
    assert [path.name for path in tmp_path.iterdir()] == ["x.json"]


# The command


@pytest.fixture
def app() -> typer.Typer:
    app = typer.Typer()
    app.command()(worksheet_command.command)
    return app


def test_the_command_prints_the_files_and_echoes_the_seed(app: typer.Typer, tmp_path: Path) -> None:
    arguments = ["return", "-n", "2", "--seed", "4", "--json", "-o", str(tmp_path / "a.pdf")]
    result = CliRunner().invoke(app, arguments, catch_exceptions=False)
    assert json.loads(result.stdout) == [str(tmp_path / name) for name in ("a.pdf", "a-key.pdf", "a.json")]
    assert result.stderr == "seed 4\n"


@pytest.mark.parametrize(("output", "message"), [(".", "is a folder"), ("x.txt", "does not end in .pdf")])
def test_the_command_refuses_other_paths(app: typer.Typer, output: str, message: str) -> None:
    result = CliRunner().invoke(app, ["-o", output])
    assert isinstance(result.exception, UsageError)
    assert message in str(result.exception)


def test_a_missing_folder_is_found_out_before_anything_is_drawn(app: typer.Typer, tmp_path: Path) -> None:
    result = CliRunner().invoke(app, ["-o", str(tmp_path / "no" / "x.pdf")])
    assert isinstance(result.exception, FileNotFoundError)
    assert result.exception.filename == str(tmp_path / "no")
    assert result.stderr == ""


def test_a_part_has_room_for_each_line_of_its_working_and_a_problem_at_most_nine_centimetres() -> None:
    from rldrill.exercise import draw, read
    from rldrill.print.worksheet import _spaces

    one_line = read({"family": "return", "given": {"gamma": "1/2", "rewards": [1, 4], "time": 1}})  # R₁ = 4
    first, second = _spaces(one_line)
    assert first == pytest.approx(1.2 + 2 * 0.6)  # the formula, then its numbers
    assert second == pytest.approx(1.2 + 2 * 0.6)  # R₀ = 1 + 1/2·4 = 1 + 2 = 3
    many = draw("value-iteration", 3, 0)
    assert sum(_spaces(many)) == pytest.approx(9)


@pytest.mark.parametrize(("problems", "columns"), [(1, [2]), (13, [14]), (14, [8, 7]), (28, [10, 10, 9])])
def test_points_stand_in_tables_of_at_most_fourteen_columns_as_wide_as_each_other(
    problems: int, columns: list[int]
) -> None:
    version = plan(("td-zero", "epsilon-greedy"), problems, 1, 3, 1).versions[0]
    tables = re.findall(r"points-table\(\(\[#?\"?Problem\"?;?\], ([^)]*)\)", worksheet_source(version, PAPERS["a4"]))
    assert [len(table.split(", ")) for table in tables] == columns


@pytest.mark.parametrize(("states", "rows"), [(1, [1]), (5, [5]), (6, [5, 1]), (11, [5, 5, 1])])
def test_five_empty_cells_stand_side_by_side(states: int, rows: list[int]) -> None:
    cycle = [[f"s{n}", "a", f"s{(n + 1) % states}", 1, 1] for n in range(states)]
    exercise = read({"family": "policy-value", "given": {"mdp": {"transitions": cycle}, "gamma": "1/2"}})
    version = Version("Title", 1, "A", (exercise,))
    tables = re.findall(r"#empty-table\((.*)\)", worksheet_source(version, PAPERS["a4"]))
    assert [len(table.split("$, $")) for table in tables] == rows
