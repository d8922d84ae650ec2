"""The rooms: imports go one way, every family has its twin, and nothing lies astray."""

import ast
from itertools import pairwise
from pathlib import Path
from statistics import median

import pytest

from rldrill.exam import expected
from rldrill.problems.catalogue import families, family, topics
from rldrill.solutions.drawing import draw
from rldrill.solutions.effort import minutes, whole
from rldrill.solutions.sheet import SECTIONS, formulas
from rldrill.solutions.solution import Solution, solver

ROOT = Path(__file__).parent.parent
NOT_TOPICS = {"formula", "sheet", "answers", "__pycache__"}


def imported(path: Path) -> set[str]:
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: imports are absolute"
            names |= {node.module or ""} | {f"{node.module}.{alias.name}" for alias in node.names}
    return names


@pytest.mark.parametrize(("room", "allowed"), [("problems", ("problems",)), ("solutions", ("problems", "solutions"))])
def test_imports_go_one_way(room: str, allowed: tuple[str, ...]) -> None:
    files = list((ROOT / room).rglob("*.py"))
    assert files
    for path in files:
        own = {name for name in imported(path) if name.split(".")[0] == "rldrill"}
        rooms = {".".join(name.split(".")[:2]) for name in own}
        assert rooms <= {f"rldrill.{name}" for name in allowed}, f"{path} imports {rooms}"


def test_problems_do_without_the_heavy_libraries() -> None:
    for path in (ROOT / "problems").rglob("*.py"):
        heavy = {name.split(".")[0] for name in imported(path)} & {"sympy", "numpy", "flint", "typst", "rich"}
        assert not heavy, f"{path} imports {heavy}; 'rldrill list' would wait for it"


def test_oracles_use_none_of_the_formulas() -> None:
    used = imported(ROOT / "solutions" / "oracle.py")
    assert not {name for name in used if name.startswith("rldrill.solutions")}


def test_every_family_has_its_twin_and_nothing_is_astray() -> None:
    twins = {
        (folder.name, file.stem)
        for folder in (ROOT / "solutions").iterdir()
        if folder.is_dir() and folder.name not in NOT_TOPICS
        for file in folder.glob("*.py")
    }
    asked = {(folder.parent.name, folder.stem) for folder in (ROOT / "problems").glob("*/*.py")}
    assert twins - asked == set(), "solvers without a problem"
    assert asked - twins == set(), "problems without a solver"
    assert {topic for topic, _ in asked} == set(topics()), "a topic's folder needs an __init__.py"


def test_family_names_are_unique() -> None:
    assert len(set(families())) == len(families())


@pytest.mark.parametrize("name", families())
def test_a_family_is_complete(name: str) -> None:
    found = family(name)
    assert found.title
    assert found.source
    assert found.revision >= 1
    assert found.summary.endswith("."), "the module's docstring opens with one sentence: what is asked"
    assert found.given.__doc__
    twin = solver(found)
    assert twin.misconceptions, "a family recognises at least one typical mistake"
    assert len({m.name for m in twin.misconceptions}) == len(twin.misconceptions)
    used = {formula for level in found.levels for formula in draw(name, level, 0).formulas()}
    for misconception in twin.misconceptions:
        assert misconception.says.endswith("."), misconception
        assert misconception.formula is None or misconception.formula in used, (
            f"{misconception} misreads {misconception.formula}, which {name} does not use"
        )


@pytest.mark.parametrize("name", families())
@pytest.mark.parametrize("seed", range(3))
def test_a_problem_is_complete(name: str, seed: int) -> None:
    for level in family(name).levels:
        solution: Solution = draw(name, level, seed)
        labels = [part.label for part in solution.problem.parts]
        assert labels == list("abcdefghijklmnopqrstuvwxyz"[: len(labels)])
        assert list(solution.answers) == labels
        assert solution.problem.question.blocks
        for part in solution.problem.parts:
            assert part.ask.endswith("?"), part.ask
            for formula in solution.formulas(part.label):
                assert formula.hint, f"{formula} needs a hint"
                assert formula.key in formulas(), f"{formula} is not on the sheet"


def test_formulas_are_complete() -> None:
    assert len(formulas()) == len({id(formula) for formula in formulas().values()})
    for key, formula in formulas().items():
        assert formula.title, key
        assert formula.source, key
        assert formula.hint.endswith("."), key
    modules = {file.stem for file in (ROOT / "solutions" / "sheet").glob("*.py")} - {"__init__"}
    assert modules == set(SECTIONS), "a section of the sheet is a module, and is named in SECTIONS"


@pytest.mark.parametrize("name", families())
def test_levels_ask_for_more_and_more_work(name: str) -> None:
    work = [median(minutes(draw(name, level, seed)) for seed in range(15)) for level in family(name).levels]
    assert all(easier < harder for easier, harder in pairwise(work)), [float(m) for m in work]
    assert expected.minutes().get(name) == [whole(m) for m in work], "run 'python tests/golden/write.py'"
