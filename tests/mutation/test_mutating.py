"""The mutation run: which changes it makes, which it leaves, and which tests it holds against them."""

from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest
from choice import Choice
from coverage import CoverageData
from covering import Covering
from places import Mutation, Source, mutations
from run import drawn
from trial import Chosen, Result, Run


def changes(text: str) -> set[str]:
    source = Source("rldrill/x.py", text.encode())
    return {source.changed(mutation).decode() for mutation in mutations(source)}


@pytest.mark.parametrize(
    ("text", "changed"),
    [
        ("γ + x", {"γ - x"}),
        ("(γ) - (x)", {"(γ) + (x)"}),
        ("x ** y // z", {"x * y // z", "x ** y / z"}),
        ("x *= y", {"x /= y"}),
        ("x < y <= z", {"x <= y <= z", "x < y < z"}),
        ("x not in y", {"x in y"}),
        ("x is  not y", {"x is y"}),
        ("x or y and z", {"x and y and z", "x or y or z"}),
        ("(x and # and not or\n y)", {"(x or # and not or\n y)"}),
        ("not(x)", {"(x)"}),
        ("-x", {"x"}),
        ("7", {"8"}),
        ("0", {"1"}),
        ("True", {"False"}),
        ("x[0]", {"x[1]"}),
        ("x[-1]", {"x[-2]"}),
        ("x[y:]", {"x[(y) + 1:]"}),
        ("x[1:]", {"x[2:]"}),
        ("max(x)", {"min(x)"}),
        ("all(x)", {"any(x)"}),
        ("x if y else z", {"x if not (y) else z"}),
        ("[x for x in y if x]", {"[x for x in y if not (x)]"}),
        ("if x == y: z", {"if x != y: z"}),
        ("if not x: y", {"if x: y"}),
        ("def f(x='a'): ...", {'def f(x=""): ...'}),
        ("class A:\n    x: int = 1", {"class A:\n    x: int = 2"}),
        ("'1 + 1'", set()),
        ("f'{x + 1}'", set()),
        ("x + 'text'", set()),
        ("x: Literal[1]", set()),
        ("def f(x: A[0]) -> B[-1]: ...", set()),
        ("@cache(1)\ndef f(): ...", set()),
        ("assert x, y + z", set()),
        ("if TYPE_CHECKING: x = 1", set()),
        ("REVISION = 1", set()),
        ("zip(x, strict=True)", set()),
    ],
)
def test_one_small_thing_is_changed(text: str, changed: set[str]) -> None:
    assert changes(text) == changed


def test_a_change_is_shown_by_its_line() -> None:
    source = Source("rldrill/x.py", b"if (\n    x\n    and y\n): pass")
    mutation = next(each for each in mutations(source) if each.kind == "and → or")
    assert source.line(mutation) == 3
    assert source.shown(mutation) == ("and y", "or y")


def test_a_seed_draws_the_same_places() -> None:
    places = [Mutation("rldrill/x.py", start, start + 1, b"", "") for start in range(50)]
    assert drawn(places, 5, 1) == drawn(places, 5, 1) != drawn(places, 5, 2)
    assert sorted(drawn(places, 99, 1)) == places


def test_the_likeliest_tests_come_first_and_others_not_at_all(tmp_path: Path) -> None:
    files = {
        "problems/td/n_step.py": "",
        "solutions/td/n_step.py": "from rldrill.solutions.sheet.td import N_STEP\nx = 1",
        "solutions/sheet/td.py": "with a:\n N_STEP = Formula('n-step-formula', x + y)\n"
        "SLIP = slip('late', x - y)\nx = letter('x', 1)",
        "tests/test_all.py": "def test_family(name): ...\ndef test_other(): ...",
        "tests/test_td.py": "def test_identity(): ...",
        "tests/test_hand.py": "import rldrill\nBOOK = 'n-step/1/7'\ndef test_book(): BOOK\ndef test_other(): ...",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    (tmp_path / "rldrill").mkdir()
    for room in ("problems", "solutions"):
        (tmp_path / "rldrill" / room).symlink_to(f"../{room}")
    cases = ("n-step", "2-n-step", "n-step: late", "n-step-formula", "one-n-step", "n-step-two")
    other = ("tests/test_td.py::test_identity", "tests/test_hand.py::test_other", "tests/test_hand.py::test_book")
    choice = Choice(tmp_path, (*(f"tests/test_all.py::test_family[{case}]" for case in cases), *other))

    def ranks(path: str, number: int) -> dict[str, int]:
        source = Source.read(tmp_path, path)
        chosen = choice.ranked(source, mutations(source)[number])
        return {test.partition("::test_")[2].removeprefix("family"): rank for rank, test in chosen}

    own = {"[n-step]": 1, "[2-n-step]": 1, "[n-step: late]": 1, "book": 1}
    assert ranks("solutions/td/n_step.py", 0) == own | {"identity": 2}
    callers = {"[n-step]": 3, "[2-n-step]": 3, "book": 3, "identity": 1}
    assert ranks("solutions/sheet/td.py", 0) == callers | {"[n-step-formula]": 0, "[n-step: late]": 1}
    both = callers | {"[n-step-formula]": 0, "[n-step: late]": 0}
    assert ranks("solutions/sheet/td.py", 2) == both  # x, which both mention
    assert ranks("solutions/sheet/td.py", 1) == callers | {"[n-step-formula]": 1, "[n-step: late]": 0}


def test_only_tests_that_run_the_statement_come_into_question_where_they_are_known(tmp_path: Path) -> None:
    (tmp_path / "rldrill").mkdir()
    (tmp_path / "rldrill" / "tax.py").write_text("RATE = 3\ndef tax(x):\n    return (\n        x * RATE\n    )\n")
    (tmp_path / "tests").mkdir()
    (tmp_path / "tests" / "test_tax.py").write_text("def test_it(): ...\ndef test_name(): ...")
    (tmp_path / "tests" / "test_far.py").write_text("def test_all(): ...")
    ids = ("tests/test_tax.py::test_it", "tests/test_tax.py::test_name", "tests/test_far.py::test_all")
    data = CoverageData(str(tmp_path / "noted"))
    data.set_context("")
    data.add_lines({"/elsewhere/rldrill/tax.py": [1, 2]})
    for test, line in ((ids[0], 3), (ids[1], 2), (ids[2], 3)):
        data.set_context(f"{test}|run")
        data.add_lines({"/elsewhere/rldrill/tax.py": [line]})
    data.write()
    choice = Choice(tmp_path, ids, Covering(tmp_path / "noted"))
    source = Source.read(tmp_path, "rldrill/tax.py")
    constant, product = mutations(source)
    assert choice.tests(source, product) == (ids[0], ids[2])
    assert choice.tests(source, constant) == (ids[0], ids[2])  # the constant is used in the statement
    assert choice.tests(source, product, far=True) == (ids[0], ids[2], ids[1])
    (tmp_path / "rldrill" / "tax.py").write_text("RATE = 3\n")
    assert choice.tests(Source.read(tmp_path, "rldrill/tax.py"), constant) == ids[:2]  # who uses it is not known


def test_a_function_whose_results_are_kept_is_run_by_all_that_call_it(tmp_path: Path) -> None:
    (tmp_path / "rldrill").mkdir()
    text = "@cache\ndef tax():\n    return 3\n\ndef fee():\n    return tax()\n\ndef fine():\n    return 4\n"
    (tmp_path / "rldrill" / "tax.py").write_text(text)
    (tmp_path / "tests").mkdir()
    (tmp_path / "tests" / "test_tax.py").write_text("def test_a(): ...\ndef test_b(): ...\ndef test_c(): ...")
    ids = tuple(f"tests/test_tax.py::test_{letter}" for letter in "abc")
    data = CoverageData(str(tmp_path / "noted"))
    for test, lines in zip(ids, ([3, 6], [6], [9]), strict=True):
        data.set_context(f"{test}|run")
        data.add_lines({"/elsewhere/rldrill/tax.py": lines})
    data.write()
    choice = Choice(tmp_path, ids, Covering(tmp_path / "noted"))
    source = Source.read(tmp_path, "rldrill/tax.py")
    kept, fine = mutations(source)
    assert set(choice.tests(source, kept)) == {ids[0], ids[1]}
    assert choice.tests(source, fine) == (ids[2],)


def test_of_what_other_modules_use_those_come_first_that_run_rare_lines_there(tmp_path: Path) -> None:
    (tmp_path / "rldrill").mkdir()
    (tmp_path / "rldrill" / "rates.py").write_text("with x:\n    RATE = 3\n    OTHER = 4\n")
    (tmp_path / "rldrill" / "tax.py").write_text(
        "from rldrill.rates import OTHER, RATE\ndef tax(x):\n    return x * RATE\ndef fee():\n    return OTHER\n"
    )
    (tmp_path / "tests").mkdir()
    (tmp_path / "tests" / "test_rates.py").write_text("def test_it(): ...")
    (tmp_path / "tests" / "test_far.py").write_text("def test_tax(): ...\ndef test_fee(): ...")
    ids = ("tests/test_rates.py::test_it", "tests/test_far.py::test_tax", "tests/test_far.py::test_fee")
    data = CoverageData(str(tmp_path / "noted"))
    for test, line in ((ids[1], 3), (ids[2], 5)):
        data.set_context(f"{test}|run")
        data.add_lines({"/elsewhere/rldrill/tax.py": [line]})
    data.write()
    source = Source.read(tmp_path, "rldrill/rates.py")
    choice = Choice(tmp_path, ids, Covering(tmp_path / "noted"))
    assert [choice.tests(source, mutation) for mutation in mutations(source)] == [(ids[1], ids[0]), (ids[2], ids[0])]


def test_those_come_first_that_run_what_hardly_any_other_runs(tmp_path: Path) -> None:
    (tmp_path / "rldrill").mkdir()
    (tmp_path / "rldrill" / "tax.py").write_text("def tax(x):\n    if x < 3:\n        return 0\n    return x\n")
    (tmp_path / "tests").mkdir()
    (tmp_path / "tests" / "test_tax.py").write_text("def test_it(): ...")
    ids = tuple(f"tests/test_tax.py::test_it[{number}]" for number in range(30))
    data = CoverageData(str(tmp_path / "noted"))
    for number, test in enumerate(ids):
        data.set_context(f"{test}|run")
        data.add_lines({"/elsewhere/rldrill/tax.py": [2, 3] if number == 25 else [2, 4]})
    data.write()
    source = Source.read(tmp_path, "rldrill/tax.py")
    (less,) = (mutation for mutation in mutations(source) if mutation.new == b"<=")
    assert Choice(tmp_path, ids, Covering(tmp_path / "noted")).tests(source, less) == (ids[25], *ids[:25], *ids[26:])


def test_no_test_is_begun_after_the_time(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    clock = iter((10.0, 10.0, 13.0, 13.5))
    monkeypatch.setattr("trial._spent", lambda: next(clock))
    result = Result()
    chosen = Chosen(Run(("a", "b", "c"), budget=3), result, tmp_path / "now")
    chosen.pytest_collection_modifyitems([])
    items = [cast("pytest.Item", SimpleNamespace(nodeid=test)) for test in "abc"]
    assert [chosen.pytest_runtest_protocol(item) for item in items] == [None, None, True]
    assert result.ran == 2
    assert (tmp_path / "now").read_text() == "b"  # which it was, if it crashes
