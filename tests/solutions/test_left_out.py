"""What has the probability 0 may be left out, and an action may stand for itself alone: it is the same problem."""

from typing import Any

import pytest

import rldrill
from rldrill.problems.catalogue import families
from rldrill.problems.errors import UserError
from rldrill.solutions.solution import solver


def with_policies(data: Any) -> list[dict[str, Any]]:
    """The tables of a problem that may hold a policy: for every state the probabilities of its actions."""
    if not isinstance(data, dict):
        return []
    table = data.get("policy")
    own = isinstance(table, dict) and any(isinstance(row, dict) and len(row) > 1 for row in table.values())
    return [data] * own + [found for inner in data.values() for found in with_policies(inner)]


def solved(family: str, given: dict[str, Any]) -> rldrill.Exercise | str:
    try:
        return rldrill.read({"family": family, "given": given})
    except UserError as error:
        return str(error)


def working(exercise: rldrill.Exercise) -> list[str]:
    return [str(line) for part in exercise.parts for line in exercise.working(part.label)]


@pytest.mark.parametrize("name", families())
def test_an_action_that_is_never_taken_need_not_be_listed(name: str) -> None:
    for level in (2, 3):
        given = rldrill.draw(name, level, 1).data()["given"]
        for place in with_policies(given):
            table = {state: row for state, row in place["policy"].items() if isinstance(row, dict)}
            first = {state: next(iter(row)) for state, row in table.items()}
            forms = (
                {state: {action: int(action == first[state]) for action in row} for state, row in table.items()},
                {state: {action: 1} for state, action in first.items()},
                first,
            )
            exercises = []
            for form in forms:
                place["policy"] = {**place["policy"], **form}
                exercises.append(solved(name, given))
            listed = exercises[0]
            if isinstance(listed, str):  # such as values that another policy has
                assert all(isinstance(each, str) for each in exercises)
                continue
            for other in exercises[1:]:
                assert isinstance(other, rldrill.Exercise)
                assert not listed.solution.tells_apart(other.solution.answers)
                assert working(listed) == working(other)
                oracle = solver(listed.problem.family).oracle
                assert str(oracle(listed.problem.given)) == str(oracle(other.problem.given))
