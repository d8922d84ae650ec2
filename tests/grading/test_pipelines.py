"""What examples/ci offers to copy is run here as far as it runs without the service that it is for."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from check_jsonschema import main as check_jsonschema
from click.testing import CliRunner
from junitparser import JUnitXml
from ruamel.yaml import YAML

from rldrill.exam.blueprint import Blueprint
from rldrill.exam.blueprint import Entry as Asked
from rldrill.exam.manifest import manifest, written
from rldrill.exam.planning import plan

ROOT = Path(__file__).parents[2]
CI = ROOT / "examples" / "ci"


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """A folder with an exam of two problems, of 1 and 2 points, the first answered right; rldrill in the path."""
    made = plan(Blueprint(problems=(Asked(id="td-zero/1/62590"), Asked(id="return/1/2166")), seed=7))
    (tmp_path / "exam.json").write_bytes(written(manifest(made)))
    (tmp_path / "ann.answers.toml").write_text('"1" = "21/4"\n["2"]\na = "10"\n')
    tool = tmp_path / "bin" / "rldrill"
    tool.parent.mkdir()
    tool.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m rldrill "$@"\n')
    tool.chmod(0o755)
    return tmp_path


def run(script: str, folder: Path, **more: str) -> "subprocess.CompletedProcess[str]":
    path = f"{folder / 'bin'}{os.pathsep}{os.environ['PATH']}"
    environment = os.environ | {"PATH": path, "PYTHONPATH": str(ROOT)} | more
    return subprocess.run(
        ["bash", "-e", "-c", script],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )


@pytest.mark.parametrize(
    ("schema", "files"),
    [
        ("github-actions", ["action.yml"]),
        (
            "github-workflows",
            [".github/workflows/ci.yml", ".github/workflows/release.yml", "examples/ci/github/rldrill.yml"],
        ),
        ("dependabot", [".github/dependabot.yml"]),
        ("gitlab-ci", ["examples/ci/gitlab/.gitlab-ci.yml"]),
    ],
)
def test_the_pipelines_fit_the_schemas_of_their_services(schema: str, files: list[str]) -> None:
    more = ["--data-transform", "gitlab-ci"] if schema == "gitlab-ci" else []
    arguments = ["--builtin-schema", f"vendor.{schema}", *more, *(str(ROOT / name) for name in files)]
    done = CliRunner().invoke(check_jsonschema, arguments)
    assert done.exit_code == 0, done.output


def test_the_workflows_are_safe() -> None:
    files = [ROOT / "action.yml", ROOT / ".github", CI / "github" / "rldrill.yml"]
    settings = ["--offline", "--no-progress", "--config", str(ROOT / ".github" / "zizmor.yml")]
    command = [str(Path(sys.executable).with_name("zizmor")), *settings, *map(str, files)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0, done.stdout


def test_the_action_annotates_and_writes_its_summary(course: Path) -> None:
    action = YAML(typ="safe").load(ROOT / "action.yml")
    (step,) = [step for step in action["runs"]["steps"] if step.get("name") == "Verify"]
    assert "${{" not in step["run"], "what a pull request names would be run"
    environment = {
        "ANSWERS": "*.answers.toml",
        "EXAM": "exam.json",
        "VERSION": "",
        "ENOUGH": "60%",
        "FEEDBACK": "verdict",
    }
    assert set(environment) == set(step["env"])
    done = run(step["run"], course, **environment, GITHUB_STEP_SUMMARY=str(course / "summary.md"))
    assert done.returncode == 1, done.stderr
    assert done.stdout.startswith("::error file=ann.answers.toml,line=3,title=problem 2")
    assert (course / "summary.md").read_text().count("\n| ") == 4


def test_the_action_takes_what_is_called_like_a_command_for_a_file(course: Path) -> None:
    action = YAML(typ="safe").load(ROOT / "action.yml")
    script = action["runs"]["steps"][-1]["run"]
    environment = {
        "ANSWERS": "$(touch${IFS}mine) --schema",
        "EXAM": "",
        "VERSION": "",
        "ENOUGH": "",
        "FEEDBACK": "none",
    }
    assert run(script, course, **environment).returncode == 3
    assert not (course / "mine").exists()


def test_the_gitlab_job_writes_a_report_that_is_read(course: Path) -> None:
    job = YAML(typ="safe").load(CI / "gitlab" / ".gitlab-ci.yml")["rldrill"]
    install, verify = job["script"]
    assert install.startswith("pip install")
    assert run(verify, course).returncode == 1
    report = JUnitXml.fromfile(str(course / job["artifacts"]["reports"]["junit"]))
    assert (report.tests, report.failures) == (3, 2)


@pytest.mark.parametrize("handed_in", [True, False])
def test_the_gradescope_autograder_writes_its_results(course: Path, handed_in: bool) -> None:
    (course / "source").mkdir()
    (course / "submission").mkdir()
    (course / "exam.json").rename(course / "source" / "exam.json")
    if handed_in:
        (course / "ann.answers.toml").rename(course / "submission" / "answers.toml")
    done = run(f'"{CI / "gradescope" / "run_autograder"}"', course, AUTOGRADER=str(course))
    assert done.returncode == 0, done.stderr
    results = json.loads((course / "results" / "results.json").read_text())
    assert results["score"] == handed_in
    if handed_in:
        assert [(test["score"], test["status"]) for test in results["tests"]] == [
            (1, "passed"), (0, "failed"), (0, "failed"),
        ]  # fmt: skip


@pytest.mark.parametrize(("answer", "right"), [("21/4", True), (5.25, True), ("8", False)])
def test_the_notebook_cell_passes_for_right_answers_alone(answer: object, right: bool) -> None:
    cell = compile((CI / "notebook" / "cell.py").read_text(encoding="utf-8"), "cell.py", "exec")
    if right:
        exec(cell, {"answer": answer})
    else:
        with pytest.raises(AssertionError, match="Not right"):
            exec(cell, {"answer": answer})


def test_the_hook_takes_answer_files_and_refuses_what_is_wrong(course: Path) -> None:
    (hook,) = YAML(typ="safe").load(ROOT / ".pre-commit-hooks.yaml")
    config = YAML(typ="safe").load(CI / "pre-commit" / ".pre-commit-config.yaml")
    assert config["repos"][0]["hooks"] == [{"id": hook["id"]}]
    assert re.search(hook["files"], "a/b.answers.toml")
    assert not re.search(hook["files"], "answers.toml")
    (course / "bad.answers.toml").write_text('"td-zero/1/62590" = "9"\n')
    assert run(f"{hook['entry']} bad.answers.toml", course).returncode == 1


def test_the_plugin_makes_a_test_of_every_part(tmp_path: Path) -> None:
    right = (CI / "pytest" / "course.answers.toml").read_text(encoding="utf-8")
    (tmp_path / "course.answers.toml").write_text(right, encoding="utf-8")
    (tmp_path / "wrong.answers.toml").write_text('"return/1/2166" = {a = "2/3"}\n"nonsense" = 1\n')
    plugin = ["-p", "rldrill.grading.pytest_plugin", "-p", "no:cacheprovider"]
    command = [sys.executable, "-m", "pytest", "--color=no", *plugin, str(tmp_path)]
    environment = os.environ | {"PYTHONPATH": str(ROOT), "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert re.search(r"3 failed, 3 passed", done.stdout), done.stdout
    assert "first reward" in done.stdout
    assert "Traceback" not in done.stdout


def test_every_pipeline_pins_the_release_and_has_a_short_readme() -> None:
    for folder in (each for each in CI.iterdir() if each.is_dir()):
        lines = [line for line in (folder / "README.md").read_text(encoding="utf-8").splitlines() if line.strip()]
        assert len(lines) <= 11, folder
    from rldrill import __version__

    for name in (
        "github/rldrill.yml",
        "gitlab/.gitlab-ci.yml",
        "gradescope/setup.sh",
        "pre-commit/.pre-commit-config.yaml",
    ):
        assert __version__ in (CI / name).read_text(encoding="utf-8")
    assert __version__ in (ROOT / "action.yml").read_text(encoding="utf-8")


def test_ci_runs_on_every_system_and_python_that_the_wheel_is_tested_on() -> None:
    workflows = (YAML(typ="safe").load(ROOT / ".github" / "workflows" / f"{name}.yml") for name in ("ci", "release"))
    runs, wheels = (
        {
            (system, python)
            for job in workflow["jobs"].values()
            for matrix in [job.get("strategy", {}).get("matrix")]
            if matrix
            for system in matrix.get("system", [job["runs-on"]])
            for python in matrix["python"]
        }
        for workflow in workflows
    )
    assert runs == wheels
