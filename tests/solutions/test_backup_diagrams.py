"""Backup diagrams: what holds between their values, and what is refused."""

from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import rldrill
from rldrill.problems.backup_diagrams.backup_diagram_value import diagram
from rldrill.problems.backups import BACKUPS, TITLES
from rldrill.problems.errors import FileError
from rldrill.problems.pictures import Node
from rldrill.solutions.drawing import draw

seeds = st.integers(0, 10_000)


def solved(family: str, **given_: Any) -> Any:
    return rldrill.read({"family": family, "given": given_}).solve()["a"]


@given(seeds)
@settings(deadline=None, max_examples=15)
def test_one_level_under_a_policy_is_a_bellman_backup(seed: int) -> None:
    problem = draw("bellman-backup", 2, seed).problem.data()["given"]
    below = [f"{name} next" for name in problem["values"]]
    renamed = dict(zip(problem["values"], below, strict=True))
    rows = [[s, a, renamed[after], p, r] for s, a, after, p, r in problem["dynamics"]["transitions"]]
    value = solved(
        "backup-diagram-value", dynamics={"transitions": rows}, policy=problem["policy"], gamma=problem["gamma"],
        values={renamed[name]: value for name, value in problem["values"].items()},
    )  # fmt: skip
    assert value == solved("bellman-backup", **problem)


@given(seeds, st.sampled_from([1, 2, 3]))
@settings(deadline=None, max_examples=30)
def test_no_policy_is_worth_more_than_the_arcs(seed: int, level: int) -> None:
    problem = draw("backup-diagram-value", level, seed).problem.data()["given"]
    assume("known" not in problem)
    policy = problem.pop("policy", None)
    best = solved("backup-diagram-value", **problem)
    if policy is not None:
        assert solved("backup-diagram-value", **problem, policy=policy) <= best


@given(seeds)
@settings(deadline=None, max_examples=15)
def test_without_a_future_only_the_first_rewards_count(seed: int) -> None:
    problem = draw("backup-diagram-value", 3, seed).problem.data()["given"] | {"gamma": "0"}
    assume("known" not in problem)
    flat = problem | {"values": dict.fromkeys(problem["values"], 7)}
    assert solved("backup-diagram-value", **problem) == solved("backup-diagram-value", **flat)


@given(seeds, st.sampled_from([1, 2, 3]))
@settings(deadline=None, max_examples=30)
def test_every_given_number_stands_on_the_diagram(seed: int, level: int) -> None:
    given_: Any = draw("backup-diagram-value", level, seed).problem.given
    leaves = [value for row in given_.action_values.values() for value in row.values()] or [*given_.values.values()]
    drawn = [node.label for node in nodes(diagram(given_).root) if not node.branches]
    assert sorted(drawn) == sorted(f"${str(value).replace('-', '−')}$" for value in leaves)


def nodes(root: Node) -> list[Node]:
    return [root, *(node for branch in root.branches for node in nodes(branch.node))]


@pytest.mark.parametrize("name", BACKUPS)
def test_every_diagram_can_be_asked_for(name: str) -> None:
    others = [other for other in BACKUPS if other != name]
    exercise = rldrill.read({
        "family": "backup-diagram-name", "given": {"diagrams": [{"shows": name, "options": [*others, name]}]},
    })  # fmt: skip
    assert exercise.solve()["a"] == "J"
    assert exercise.solution.mistakes
    for letter, other in zip("ABCDEFGHI", others, strict=True):
        verdict = exercise.check(letter)
        assert verdict.outcome.value == "misconception"
        assert [m.name for m in verdict.misconceptions] == [f"took-it-for-{other}"]
    assert len(set(TITLES.values())) == len(BACKUPS)


STEP = [["s", "a", "t", 1, 1]]


@pytest.mark.parametrize(
    ("given_", "message"),
    [
        ({"dynamics": {"transitions": STEP}, "gamma": 1}, "the value of 't' is missing"),
        ({"dynamics": {"transitions": STEP}, "values": {"t": 1, "u": 1}, "gamma": 1}, "'u', which does not occur"),
        ({"dynamics": {"transitions": [["s", "a", "s", 1, 1]]}, "gamma": 1}, "leads back or too far"),
        ({"dynamics": {"transitions": STEP}, "action_values": {"t": {}}, "gamma": 1}, "actions of 't' are missing"),
        (
            {"dynamics": {"transitions": STEP}, "values": {"t": 1}, "action_values": {"t": {"b": 1}}, "gamma": 1},
            "cannot both be given",
        ),
        (
            {"dynamics": {"transitions": [*STEP, ["s", "b", "t", 1, 1]]}, "action_values": {"t": {"b": 1}}, "gamma": 1},
            "one action only",
        ),
        (
            {"dynamics": {"transitions": STEP}, "values": {"t": 1}, "policy": {"s": {"a": "1/2"}}, "gamma": 1},
            "sum to 1/2, not to 1",
        ),
    ],
)
def test_a_value_that_cannot_be_read_off_is_one_sentence(given_: dict[str, Any], message: str) -> None:
    with pytest.raises(FileError, match=message):
        solved("backup-diagram-value", **given_)


@pytest.mark.parametrize(
    ("shown", "message"),
    [
        ({"shows": "sarsa", "options": ["td-zero", "q-learning"]}, "'sarsa', which is shown, must be among them"),
        ({"shows": "sarsa", "options": ["sarsa", "sarsa"]}, "given twice"),
        ({"shows": "sarsa", "options": ["sarsa"]}, "at least 2"),
        ({"shows": "tree", "options": ["sarsa", "tree"]}, "shows"),
    ],
)
def test_a_name_that_cannot_be_chosen_is_one_sentence(shown: dict[str, Any], message: str) -> None:
    with pytest.raises(FileError, match=message):
        solved("backup-diagram-name", diagrams=[shown])


CHANGED = {
    "shows": "q-learning", "change": "no-arc", "options": ["expected-sarsa", "sarsa"], "target": "sarsa",
    "changes": ["arc", "one-action", "all-states"],
}  # fmt: skip


def test_a_change_of_the_picture_makes_another_method_of_it() -> None:
    """Q-learning without its arc is the mean of Expected Sarsa; with one action of it, it is Sarsa."""
    exercise = rldrill.read({"family": "backup-diagram-name", "given": CHANGED})
    assert exercise.solve() == {"a": "A", "b": "B"}


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"change": "to-the-end"}, "makes no diagram that has a name of 'q-learning'"),
        ({"options": ["q-learning", "sarsa"]}, "'expected-sarsa', which is shown after the change, must be among"),
        ({"changes": ["arc", "all-states"]}, "one of them, and no more, must make 'sarsa' of 'expected-sarsa'"),
        ({"changes": ["sampled", "one-action"]}, "one of them, and no more, must make"),
        ({"changes": ["arc", "arc", "one-action"]}, "one is given twice"),
    ],
)
def test_a_change_that_leads_nowhere_is_one_sentence(wrong: dict[str, Any], message: str) -> None:
    with pytest.raises(FileError, match=message):
        solved("backup-diagram-name", **CHANGED | wrong)


def test_no_draw_takes_a_change_that_can_be_understood_in_two_ways() -> None:
    for seed in range(60):
        given: Any = draw("backup-diagram-name", 3, seed).problem.given
        if given.shows in ("expected-sarsa", "q-learning", "bellman-optimality-v", "bellman-optimality-q"):
            assert given.change not in ("sampled", "everything")


def test_no_two_branches_of_a_tree_look_alike() -> None:
    """Whoever takes one subtree for the other comes to another value."""
    for seed in range(40):
        given = draw("backup-diagram-value", 2, seed).problem.given
        leaves = [tuple(row.values()) for row in given.action_values.values()]
        assert len(set(leaves)) == len(leaves)


def test_the_second_question_about_a_change_does_not_answer_the_first() -> None:
    for seed in range(40):
        given = draw("backup-diagram-name", 3, seed).problem.given
        assert given.target not in given.options
        assert given.change not in given.changes
