"""A package of families that somebody else installs: it has the same rights, and the same checks."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "examples" / "families"


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder in which the example package is installed as its wheel would be."""
    folder = tmp_path_factory.mktemp("installed")
    (folder / "my_course").symlink_to(PACKAGE / "my_course")
    metadata = folder / "my_course-1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: my-course\nVersion: 1.0\n")
    (metadata / "entry_points.txt").write_text("[rldrill.families]\nmy-course = my_course\n")
    return folder


def run(installed: Path, *arguments: str, module: bool = True) -> "subprocess.CompletedProcess[str]":
    environment = os.environ | {"PYTHONPATH": f"{ROOT}{os.pathsep}{installed}"}
    command = [sys.executable, *(("-m", "rldrill") if module else ()), *arguments]
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=60)


def test_its_families_are_audited_like_our_own(installed: Path) -> None:
    done = run(installed, "audit", "optimism", "-n", "6", "--json")
    assert done.returncode == 0, done.stderr
    findings = json.loads(done.stdout)
    assert [(each["level"], each["drawn"]) for each in findings] == [(1, 6), (2, 6), (3, 6)]
    for finding in findings:
        assert finding["disagreements"] == finding["refused"] == []
        assert finding["misconceptions"]["recognised"] == finding["misconceptions"]["made"] > 0


@pytest.mark.parametrize("wanted", [["optimism"], ["optimism/2"], ["exploration", "-m", "20"]])
def test_its_problems_stand_in_exams(installed: Path, tmp_path: Path, wanted: list[str]) -> None:
    output = tmp_path / "exam.json"
    done = run(installed, "worksheet", *wanted, "--seed", "1", "-o", str(output))
    assert done.returncode == 0, done.stderr
    (version,) = json.loads(output.read_text())["versions"]
    assert {problem["id"].partition("/")[0] for problem in version["problems"]} == {"optimism"}


def test_it_is_fixed_in_an_exam_that_fills_a_time(installed: Path, tmp_path: Path) -> None:
    done = run(installed, "worksheet", "optimism/1/7", "return", "-m", "20", "-o", str(tmp_path / "exam.json"))
    assert done.returncode == 0, done.stderr


def test_its_answers_are_graded_with_their_mistakes(installed: Path, tmp_path: Path) -> None:
    # 1/2² · 6 / (1 − 1/2) = 3; with one more step 3/2.
    (tmp_path / "mine.toml").write_text('family = "optimism"\ngiven = {reward = 6, time = 2, gamma = "1/2"}\n')
    answers = tmp_path / "answers.csv"
    answers.write_text("student,problem,part,answer\nAnn,mine.toml,a,3\nBen,mine.toml,a,3/2\n")
    done = run(installed, "verify", str(answers), "--allow-files", "--json")
    ann, ben = (student["answers"][0] for student in json.loads(done.stdout)["students"])
    assert (ann["verdict"], ben["verdict"]) == ("right", "misconception")
    assert "its factor is γ^n" in ben["reason"]


def test_the_quiz_knows_its_skills_and_its_mistakes(installed: Path) -> None:
    code = """if True:
        from datetime import UTC, datetime
        from itertools import islice
        from rldrill.quiz.drilling import drill
        from rldrill.quiz.planning import Plan, skills
        from rldrill.quiz.topics import topic_map
        now = datetime.now(UTC)
        order = skills(["optimism"])
        print(*(f"{skill.family}/{skill.level}" for skill in order), Plan(order, [], 3, now).next(now))
        for mistake in ("begins-at-once", "doubled"):
            (exercise,) = islice(drill(mistake, [], ["optimism"]).exercises(1), 1)
            print(exercise.problem.family.name)
        topic_map([], now)
    """
    done = run(installed, "-c", code, module=False)
    assert done.stdout.split("\n") == [
        "optimism/1 optimism/2 optimism/3 optimism, level 1", "optimism", "optimism", "",
    ], done.stderr  # fmt: skip
    topics = [share["name"] for share in json.loads(run(installed, "stats", "--json").stdout)["shares"]]
    assert topics[-1] == "exploration"


def test_a_package_that_is_none_is_told(tmp_path: Path) -> None:
    metadata = tmp_path / "other-1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: other\nVersion: 1.0\n")
    (metadata / "entry_points.txt").write_text("[rldrill.families]\nother = no_such_package\n")
    done = run(tmp_path, "list")
    assert done.returncode == 70
    assert "names 'no_such_package', which is no package" in done.stderr
    assert "Traceback" not in done.stderr


def test_its_files_are_where_its_metadata_says() -> None:
    import tomllib

    data = tomllib.loads((PACKAGE / "pyproject.toml").read_text())
    assert data["project"]["entry-points"] == {"rldrill.families": {"my-course": "my_course"}}
