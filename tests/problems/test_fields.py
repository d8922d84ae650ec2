"""The fields of problem files: each is described, and its example can be given."""

import json
import typing
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from pydantic import BaseModel, create_model

import rldrill
from limits import limits
from rldrill.problems.catalogue import families, family
from rldrill.problems.errors import FileError
from rldrill.problems.family import Givens
from rldrill.problems.fields import _range
from rldrill.problems.fractions import Fraction
from rldrill.problems.grids import Grid


def models(annotation: Any, seen: set[type[BaseModel]]) -> Iterator[type[BaseModel]]:
    """A model and the models within it, each once."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel) and annotation not in seen:
        seen.add(annotation)
        yield annotation
        for field in annotation.model_fields.values():
            yield from models(field.annotation, seen)
    for part in typing.get_args(annotation):
        yield from models(part, seen)


ALL = [*families()]
PINNED = Path(__file__).parents[1] / "golden" / "fields.json"


@pytest.mark.parametrize("name", ALL)
def test_every_field_is_described_with_an_example_that_says_more_than_the_default(name: str) -> None:
    found = rldrill.fields(name)
    assert found
    for field in found:
        assert field.means.endswith("."), f"{name}: {field.path} needs Field(description=…), one plain sentence"
        assert field.takes != "a value", f"{name}: {field.path} needs words for its type"
        assert field.example not in ('""', field.default), f"{name}: {field.path} needs Field(examples=…)"
        json.loads(field.example)


@pytest.mark.parametrize("name", ALL)
def test_every_field_of_every_model_is_listed(name: str) -> None:
    listed = {field.path.rpartition(".")[2] for field in rldrill.fields(name)}
    for kind in family(name).kinds:
        for model in models(kind, set()):
            assert set(model.model_fields) <= listed


def test_the_examples_that_are_written_down_can_be_given() -> None:
    seen: set[type[BaseModel]] = {Grid}
    every = [Grid, *(model for name in ALL for kind in family(name).kinds for model in models(kind, seen))]
    for model in every:
        for field in model.model_fields.values():
            for example in field.examples or ():
                create_model("Alone", __base__=Givens, field=(field.annotation, field)).model_validate(
                    {"field": example}
                )


def test_the_examples_that_were_drawn_can_be_given() -> None:
    # Top fields with an example each are, in a family without alternatives, a problem.
    for name in ("return", "lqr-gain", "softmax-policy"):
        given = {field.path: json.loads(field.example) for field in rldrill.fields(name) if field.default is None}
        assert family(name).read(given)


def paths(name: str) -> dict[str, rldrill.FileField]:
    return {field.path: field for field in rldrill.fields(name)}


def test_optional_fields_are_found_with_their_defaults() -> None:
    found = paths("policy-evaluation")
    assert (found["in_place"].takes, found["in_place"].default) == ("true or false", "false")
    assert (found["mdp.slip"].takes, found["mdp.slip"].default) == ("a number from 0 to 1", '"0"')
    assert {"mdp.ends", "mdp.returns", "mdp.gymnasium"} <= set(found)
    assert "equiprobable" in found["policy"].means
    assert found["policy"].default == "nothing"
    assert found["gamma"].default is None
    assert paths("sarsa-lambda")["traces"].default == "nothing"


def test_rows_name_their_entries_and_choices_their_words() -> None:
    rows = [field.takes for field in rldrill.fields("value-iteration") if field.path == "mdp.transitions"]
    assert rows[0].endswith("[state, action, next, probability, reward]")
    assert "[state, next, probability, reward]" in rows[1]
    assert "[state, action, next, probability]" in rows[2]
    assert paths("monte-carlo")["visits"].takes == '"first" or "every"'
    assert paths("value-iteration")["sweeps"].takes == "a whole number from 1 to 1000"


@pytest.mark.parametrize(
    ("name", "forms"), [("bandit", 4), ("advantage", 3), ("expected-sarsa", 2), ("td-zero", 2), ("n-step-return", 1)]
)
def test_every_form_of_a_union_is_listed(name: str, forms: int) -> None:
    assert len({field.form for field in rldrill.fields(name)}) == forms


def test_the_forms_of_a_model_are_told_apart() -> None:
    forms = {field.path: field.form for field in rldrill.fields("value-iteration")}
    assert len({forms["mdp.transitions"], forms["mdp.grid"], forms["mdp.gymnasium"], forms["gamma"]}) == 4


@pytest.mark.parametrize(
    ("name", "change", "says"),
    [
        ("td-zero", {"gama": 1}, "given.gama is not a field (did you mean gamma?); the fields there are"),
        (
            "td-zero",
            {"xyz": 1},
            "xyz is not a field; the fields there are known, trajectory, values, alpha, gamma, td_errors, transitions",
        ),
        ("q-learning", {"terminal": ["x"]}, "given.terminal is not a field (did you mean trajectory.terminal?); the"),
        ("td-zero", {"rewards": [1]}, "given.rewards is not a field (did you mean trajectory.rewards?); the fields"),
        ("value-iteration", {"transitions": []}, "given.transitions is not a field (did you mean mdp.transitions?)"),
        (
            "value-iteration",
            {"mdp": {"xyz": 1}},
            "given.mdp.xyz is not a field; rldrill.fields('value-iteration') and 'rldrill fields value-iteration' list",
        ),
        ("value-iteration", {"mdp": {"gird": "..G"}}, "given.mdp.gird is not a field (did you mean grid?)"),
        (
            "value-iteration",
            {"mdp": {"grid": "..G", "slipp": 1}},
            "slipp is not a field of a grid (did you mean slip?)",
        ),
        ("bandit", {"pulls": [["x", 1], ["y", 1]], "C": 1}, "given.C is not a field (did you mean c?)"),
        ("kalman-filter", {"steps": [{"u": 1, "zz": 1}]}, "given.steps[1].zz is not a field (did you mean z?)"),
    ],
)
def test_an_unknown_field_is_told_with_the_nearest_known_one(name: str, change: dict[str, Any], says: str) -> None:
    given = rldrill.draw(name, 1, 1).data()["given"] | change
    with pytest.raises(FileError) as error:
        rldrill.read({"family": name, "given": given})
    assert says in str(error.value)


def test_files_and_processes_without_actions_are_forms_of_a_model() -> None:
    found = [field for field in rldrill.fields("policy-value") if field.path.startswith("mdp.")]
    files = [field for field in found if field.path == "mdp.file"]
    assert [json.loads(field.example) for field in files] == ["model.csv"]
    rows = [field for field in found if field.path == "mdp.transitions" and "reward]" in field.takes]
    alone = rows[1]
    assert alone.takes == "a list, each a list [state, next, probability, reward]"
    solved = rldrill.read(
        {
            "family": "policy-value",
            "given": {"mdp": {"transitions": json.loads(alone.example), "terminal": ["off"]}, "gamma": 0},
        }
    )
    assert solved.answers()["a"] == {"low": Fraction(1, 2), "high": 2}


def test_an_angle_that_is_not_given_is_shown_as_files_write_it() -> None:
    assert paths("forward-kinematics")["base.phi"].default == '"0"'


def test_the_average_reward_needs_no_discount_by_the_schema() -> None:
    schema = family("policy-value").schema()
    assert schema["required"] == ["mdp"]
    assert schema["else"] == {"required": ["gamma"]}
    assert paths("policy-value")["gamma"].default is None


def test_the_form_over_actions_has_an_example_with_actions() -> None:
    actions = [json.loads(field.example) for field in rldrill.fields("monte-carlo") if field.path == "trajectory"]
    assert [run.get("actions") for run in actions] == [None, ["left", "right"]]


@pytest.mark.parametrize("name", ALL)
def test_the_limits_and_defaults_of_the_fields_are_those_that_were_agreed(name: str) -> None:
    pinned = json.loads(PINNED.read_text(encoding="utf-8"))
    assert limits(family(name)) == pinned.get(name), (
        f"What a file of {name} may hold has changed; where that is meant, run 'python tests/golden/write.py {name}'."
    )


@pytest.mark.parametrize(
    ("schema", "unit", "says"),
    [
        ({"low": 1, "high": 9}, "", " from 1 to 9"),
        ({"low": 1, "high": 9}, " entries", " of 1 to 9 entries"),
        ({"low": 3, "high": 3}, " entries", " of 3 entries"),
        ({"high": 9}, " entries", " of at most 9 entries"),
        ({"high": 9}, "", ", at most 9"),
        ({"low": 1}, " entries", " that is not empty"),
        ({"low": 1}, "", ", at least 1"),
        ({"low": 2}, " entries", " of at least 2 entries"),
        ({"low": 0}, "", ""),
        ({}, "", ""),
    ],
)
def test_how_small_and_large_is_said(schema: dict[str, Any], unit: str, says: str) -> None:
    assert _range(schema, "low", "high", unit) == says
