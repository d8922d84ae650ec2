"""The keys of a saved exam are derived again; the schema of a problem file is one for other programs."""

import json
import tomllib
from pathlib import Path

import jsonschema
import pytest
from typer.testing import CliRunner

import rldrill
from rldrill.cli import app
from rldrill.exam.blueprint import Blueprint
from rldrill.exam.blueprint import Entry as Asked
from rldrill.exam.manifest import manifest, written
from rldrill.exam.planning import plan
from rldrill.solutions.temporal_difference import td_zero

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def exam(tmp_path: Path) -> Path:
    path = tmp_path / "exam.json"
    path.write_bytes(
        written(manifest(plan(Blueprint(problems=(Asked(topic=("td-zero",), level=1),), versions=2, seed=7))))
    )
    return path


def test_the_keys_of_a_saved_exam_are_held_against_the_other_solver(
    exam: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    done = CliRunner().invoke(app, ["audit", "--manifest", str(exam), "--json"])
    (finding,) = json.loads(done.stdout)
    assert (done.exit_code, finding["family"], finding["drawn"], finding["disagreements"]) == (0, "td-zero", 2, [])
    from rldrill.solutions.solution import solver

    solver.cache_clear()
    monkeypatch.setattr(td_zero, "oracle", lambda given: [[1000.0]])  # noqa: ARG005
    done = CliRunner().invoke(app, ["audit", "--manifest", str(exam)])
    solver.cache_clear()
    assert done.exit_code == 1
    assert "version A, problem 1 (a): exact" in done.stderr
    assert "version B, problem 1 (a): exact" in done.stderr


def test_a_manifest_that_lost_a_given_is_one_sentence(exam: Path) -> None:
    data = json.loads(exam.read_text())
    del data["versions"][1]["problems"][0]["problem"]["given"]["gamma"]
    exam.write_text(json.dumps(data))
    done = CliRunner().invoke(app, ["audit", "--manifest", str(exam)])
    assert "version B, problem 1" in str(done.exception)


@pytest.mark.parametrize("name", ["td-zero", "value-iteration", "lqr-gain", "bic"])
def test_the_schema_of_a_problem_file_takes_what_is_drawn_and_refuses_what_is_not(name: str) -> None:
    schema = json.loads(CliRunner().invoke(app, ["solve", "--schema", name]).stdout)
    jsonschema.Draft202012Validator.check_schema(schema)
    drawn = rldrill.draw(name, 2, 7).data()
    jsonschema.validate(drawn, schema)
    for broken in ({**drawn, "family": "other"}, {**drawn, "given": 1}, {"family": name}, {**drawn, "colour": 1}):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate(broken, schema)


def test_the_schema_takes_the_examples() -> None:
    for path in EXAMPLES.glob("*.toml"):
        data = tomllib.loads(path.read_text(encoding="utf-8"))
        if "family" in data:
            schema = json.loads(CliRunner().invoke(app, ["solve", "--schema", data["family"]]).stdout)
            jsonschema.validate(data, schema)
