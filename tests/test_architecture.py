"""The rooms: imports go one way, every family has its twin, and nothing is left over."""

import ast
import re
from fractions import Fraction
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from statistics import median

import pytest

import rldrill
from from_files import FROM_FILES
from rldrill.exam import expected
from rldrill.problems.catalogue import families, family, topics
from rldrill.solutions.drawing import draw
from rldrill.solutions.effort import minutes, whole
from rldrill.solutions.sheet import SECTIONS, formulas
from rldrill.solutions.solution import Solution, solver

ROOT = Path(__file__).parent.parent
NOT_TOPICS = {"formula", "diagnosis", "sheet", "answers", "__pycache__"}


#: What each room of rldrill/ may import, beside itself; docs/architecture.md has the same table.
MAY_IMPORT = {
    "render": {"problems"},
    "library": {"problems", "solutions", "render"},
    "exam": {"problems", "solutions", "library"},
    "print": {"problems", "solutions", "library", "render", "exam"},
    "export": {"problems", "solutions", "library", "render", "exam", "print"},
    "grading": {"problems", "solutions", "library", "exam"},
    "generation": {"problems", "solutions", "library", "render"},
    "history": {"problems"},
    "quiz": {"problems", "solutions", "library", "render", "exam", "grading", "history"},
    "audit": {"problems", "solutions", "exam"},
    "commands": {
        "problems",
        "library",
        "render",
        "exam",
        "print",
        "export",
        "grading",
        "generation",
        "history",
        "quiz",
        "audit",
    },
}


def module_name(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    parts = parts if parts[0] == "rldrill" else ("rldrill", *parts)
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


#: Every module with its file; what the links in rldrill/ lead to is met once.
MODULES = {
    module_name(path): path
    for room in ("problems", "solutions", "rldrill")
    for path in (ROOT / room).rglob("*.py")
    if path.relative_to(ROOT).parts[:2] not in (("rldrill", "problems"), ("rldrill", "solutions"))
}


@cache
def imported(path: Path) -> frozenset[str]:
    """Every name that a file imports, within functions too; not what only a type checker imports."""
    names = set()
    waiting: list[ast.AST] = [ast.parse(path.read_text(encoding="utf-8"))]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
            waiting += node.orelse
            continue
        waiting += ast.iter_child_nodes(node)
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: imports are absolute"
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return frozenset(names)


@cache
def edges() -> dict[str, set[str]]:
    """For every module the modules that it imports; what is no module itself is a name in one."""
    return {
        module: {name if name in MODULES else name.rpartition(".")[0] for name in imported(path)} & set(MODULES)
        for module, path in MODULES.items()
    }


def room_of(module: str) -> str:
    parts = module.split(".")
    if len(parts) > 1 and (ROOT / "rldrill" / parts[1]).is_dir():
        return parts[1]
    return {"cli": "commands", "__main__": "commands", "audit": "audit"}.get(parts[-1], "library")


def test_imports_run_in_no_circle() -> None:
    try:
        list(TopologicalSorter(edges()).static_order())
    except CycleError as error:
        pytest.fail(" → ".join(reversed(error.args[1])))


def test_a_room_imports_only_what_it_may() -> None:
    for module, others in edges().items():
        room = room_of(module)
        allowed = MAY_IMPORT.get(room)
        for other in others if allowed is not None else ():
            assert room_of(other) in {room, *allowed}, f"{module} imports {other}"


def test_the_documented_table_is_the_tested_one() -> None:
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `(\w+)` \|[^|]*\| ([^|]*) \|$", text, re.MULTILINE)
    assert {room: set(re.findall(r"\w+", others)) for room, others in rows} == MAY_IMPORT


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
    assert {name for name in used if name.startswith("rldrill.solutions")} <= {
        "rldrill.solutions.numerics.Array",
        "rldrill.solutions.numerics.np",
    }


def test_every_family_has_its_twin_and_nothing_is_left_over() -> None:
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
    assert all(kind.__doc__ for kind in found.kinds)
    twin = solver(found)
    assert twin.misconceptions, "a family recognises at least one typical mistake"
    assert len({m.name for m in twin.misconceptions}) == len(twin.misconceptions)
    used = {formula for level in found.levels for seed in range(8) for formula in draw(name, level, seed).formulas()}
    for family_, given in FROM_FILES:
        if family_ == name:
            used |= {*rldrill.read({"family": name, "given": given}).formulas()}
    for misconception in twin.misconceptions:
        assert misconception.says.endswith("."), misconception
        assert misconception.is_slip or any(misconception in formula.misread for formula in used), (
            f"{misconception} misreads no formula that {name} uses: take it out of MISCONCEPTIONS, or state what it "
            "reads in a formula that is used, under misread="
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
def test_an_exam_question_is_more_work_than_a_warm_up(name: str) -> None:
    """Level 3 is harder and may be shorter: a new idea counts more there than more steps of the old one."""
    work = [median(minutes(draw(name, level, seed)) for seed in range(15)) for level in family(name).levels]
    assert all(other > work[0] * Fraction(9, 10) for other in work[1:]), [float(m) for m in work]
    assert expected.minutes().get(name) == [whole(m) for m in work], f"run 'python tests/golden/write.py {name}'"


def test_the_changelog_says_how_many_families_there_are() -> None:
    told = re.search(r"^- (\d+) families of problems", (ROOT / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE)
    assert told
    assert int(told[1]) == len(families())
