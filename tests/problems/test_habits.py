"""What people write otherwise than models have it, and what only looks like it."""

from fractions import Fraction
from typing import Any

import pytest

import rldrill
from rldrill.problems.catalogue import family
from rldrill.problems.errors import FileError

RUN = {"states": ["a", "b", "end"], "rewards": [1, 2], "terminal": ["end"]}


@pytest.mark.parametrize(
    ("name", "given", "usual"),
    [
        # one entry without brackets
        ("eligibility-trace", {"states": ["a"], "gamma": 1, "lam": 1, "asked": 0}, {"asked": [0]}),
        ("return-infinite", {"first": 2, "repeated": "7", "gamma": "1/2"}, {"first": [2], "repeated": [7]}),
        ("rbf", {"position": 0.5, "centres": [0, 1], "sigma": 1}, {"position": [0.5], "centres": [[0], [1]]}),
        ("td-zero", {"trajectory": RUN | {"terminal": "end"}, "values": {"a": 0, "b": 0}, "alpha": 1, "gamma": 1},
         {"trajectory": RUN}),
        ("feature-expectations", {"features": {"a": 1}, "trajectories": [["a"]], "gamma": 1}, {"features": {"a": [1]}}),
        ("kalman-filter", {"mean": 0, "covariance": 1, "process": 0, "sensor": 1, "steps": {"z": 1}},
         {"steps": [{"z": 1}]}),
        # one row without the brackets of the list
        ("bandit", {"pulls": ["a", 1], "arms": ["a", "b"]}, {"pulls": [["a", 1]]}),
        # other names of fields
        ("eligibility-trace", {"states": ["a"], "\N{GREEK SMALL LETTER GAMMA}": 1, "lambda": 1, "asked": [0]},
         {"gamma": 1, "lam": 1}),
        ("linear-value", {"theta": [1, 2], "actions": ["l", "r"], "bumps": {"position": 0, "centers": [0], "width": 1}},
         {"bumps": {"position": [0], "centres": [[0]], "width": 1}}),
        # by state and action, where it is by action and state
        ("bayes-predict", {"belief": {"a": 1, "b": 0}, "actions": "go",
                           "motion": {"a": {"go": {"b": "1/3", "a": "2/3"}}, "b": {"go": {"b": 1}}}},
         {"actions": ["go"], "motion": {"go": {"a": {"b": "1/3", "a": "2/3"}, "b": {"b": 1}}}}),
        ("value-from-action-values", {"values": {"s": {"l": 1, "r": 3}}, "policy": "random"}, {"policy": "uniform"}),
        ("value-from-action-values", {"values": {"s": {"random": 1, "r": 3}}, "policy": "random"},
         {"policy": {"s": {"random": 1}}}),  # an action of that name
        # columns
        ("kalman-filter", {"mean": [1, 2], "covariance": [[1, 0], [0, 1]], "A": [[1, 1], [0, 1]], "B": [[0], [1]],
                           "C": [[1, 0]], "process": [[0, 0], [0, 0]], "sensor": 1, "steps": [{"u": [3], "z": [4]}]},
         {"mean": [[1], [2]], "steps": [{"u": 3, "z": 4}]}),
        # words in another case
        ("bic", {"criterion": "aic", "fitted": {"x": {"log_likelihood": -9, "k": 1},
                                                "y": {"log_likelihood": -8, "k": 1}}}, {"criterion": "AIC"}),
    ],
)  # fmt: skip
def test_what_can_mean_one_thing_only_is_read(name: str, given: dict[str, Any], usual: dict[str, Any]) -> None:
    kept = {key: value for key, value in given.items() if key not in ("\N{GREEK SMALL LETTER GAMMA}", "lambda")}
    assert family(name).read(given) == family(name).read(kept | usual)


@pytest.mark.parametrize(
    ("name", "given", "says"),
    [
        # one trajectory, or three of one state each
        ("feature-expectations", {"features": {"a": [1]}, "trajectories": ["a", "a", "a"], "gamma": 1},
         "given.trajectories[1]: must be a list"),
        ("eligibility-trace", {"states": "a b", "gamma": 1, "lam": 1, "asked": [0]}, "given.states: must be a list"),
        ("eligibility-trace", {"states": ["a"], "gamma": 1, "lam": 1, "lambda": 1, "asked": [0]},
         "given.lambda is not a field"),
        ("eligibility-trace", {"states": ["a"], "discount": 1, "discount_factor": 1, "lam": 1, "asked": [0]},
         "given.discount_factor is not a field"),
        ("rbf", {"position": [0, 1], "centres": [0, 1], "sigma": 1}, "given"),
        # one task of curvature 1 and optimum 3, or two
        ("maml-step", {"theta": 0, "alpha": 1, "beta": 1, "tasks": [1, 3]},
         "given.tasks[1]: must be a list, [curvature, optimum]"),
        ("n-step-return", {"trajectory": RUN, "values": {"a": 0, "b": 0}, "gamma": 1, "asked": [0, 2]},
         "given.asked[1]: must be a list of 2 entries, in brackets of its own (and "),
        ("n-step-return", {"trajectory": RUN, "values": {"a": 0, "b": 0}, "gamma": 1, "asked": 2},
         "given.asked: must be a list, in which each entry is a list of 2 entries."),
        ("bic", {"criterion": "AICc", "fitted": {}}, "given.criterion: 'AICc' is not possible here"),
    ],
)  # fmt: skip
def test_what_can_mean_two_things_is_refused(name: str, given: dict[str, Any], says: str) -> None:
    with pytest.raises(FileError) as error:
        family(name).read(given)
    assert says in str(error.value)


def test_the_problem_is_the_one_that_was_meant() -> None:
    """(0.45)\N{SUPERSCRIPT TWO} + 1 for the state visited at 0 and 2, with γλ = 0.45; 0.45 for the one between."""
    given = {"states": ["a", "b", "a"], "gamma": 0.9, "lambda": 0.5, "asked": 2}
    assert rldrill.read({"family": "eligibility-trace", "given": given}).answers() == {
        "a": {"a": Fraction(481, 400), "b": Fraction(9, 20)}
    }


def test_the_letters_of_a_state_may_have_their_index_without_a_sign() -> None:
    """∂(−4x₁ + x₁x₂ + u₁) is −4 + x₂ = −2 by x₁, x₁ = 1 by x₂, and 1 by u₁."""
    given = {"dynamics": {"x1": "x_2", "x₂": "-4 x1 + x₁*x2 + u1"}, "state": {"x_1": 1, "x2": 2}, "action": {"u1": 0}}
    answers = rldrill.read({"family": "linearise", "given": given}).answers()
    assert answers == {"a": ((0, 1), (-2, 1)), "b": ((0,), (1,))}


#: Two states; going earns 5 and 2, staying 1 and 0; γ = 1/2.
TWO = {
    "transitions": [["A", "go", "B", 1, 5], ["A", "stay", "A", 1, 1], ["B", "go", "A", 1, 2], ["B", "stay", "B", 1, 0]]
}


@pytest.mark.parametrize(
    ("policy", "values"),
    [
        # V(A) = 5 + V(B)/2, V(B) = 2 + V(A)/2: 8 and 6
        ("go", (8, 6)),
        ({"go": 1}, (8, 6)),
        # V(A) = (5 + V(B)/2 + 1 + V(A)/2)/2, V(B) = (2 + V(A)/2 + V(B)/2)/2: 5 and 3
        ({"go": 0.5, "stay": "1/2"}, (5, 3)),
        ("uniform", (5, 3)),
    ],
)
def test_a_policy_that_is_the_same_everywhere_may_be_written_once(policy: Any, values: tuple[int, int]) -> None:
    problem = {"family": "policy-value", "given": {"mdp": TWO, "gamma": 0.5, "policy": policy}}
    assert rldrill.read(problem).answers() == {"a": dict(zip("AB", values, strict=True))}


def test_the_policy_to_start_from_may_be_one_action() -> None:
    given = {"mdp": TWO, "gamma": 0.5, "start": "go", "rounds": 1}
    assert rldrill.read({"family": "policy-iteration", "given": given}).answers()["a"] == {"A": 8, "B": 6}


@pytest.mark.parametrize("policy", ["fly", {"go": 1, "A": "go"}, {"fly": 1}, ["go", "stay"]])
def test_a_policy_of_something_else_is_refused(policy: Any) -> None:
    with pytest.raises(FileError):
        family("policy-value").read({"mdp": TWO, "gamma": 0.5, "policy": policy})


def test_an_equiprobable_policy_is_not_one_over_the_actions_that_another_takes() -> None:
    run = {"states": ["s", "end"], "actions": ["left"], "rewards": [1], "terminal": ["end"]}
    given = {"episodes": [run], "target": {"s": "left"}, "behaviour": "random", "gamma": 1}
    with pytest.raises(FileError, match=r"given.behaviour: 'random' over which actions of 's'\?"):
        family("importance-sampling").read(given)
    # b takes left with 1/2, π always: ρ = 2
    target = {"s": {"left": 1, "right": 0}}
    problem = rldrill.read({"family": "importance-sampling", "given": given | {"target": target}})
    assert problem.answers()["a"] == 2


def test_the_cost_at_the_horizon_by_its_other_names() -> None:
    """Q = 0 and Q_T = 1: S₂ = 1, L₁ = 1/2, S₁ = 1/2, L₀ = (1/2)/(3/2) = 1/3."""
    given = {"A": 1, "B": 1, "Q": 0, "Qf": 1, "R": 1, "start": 1, "horizon": 2}
    answers = rldrill.read({"family": "lqr-backward", "given": given}).answers()
    assert (answers["a"], answers["c"]) == (((Fraction(1, 2),),), ((Fraction(1, 3),),))


def test_ways_may_have_costs() -> None:
    """S, A, B, G costs 1 + 2 + 3 = 6; S, A, G and S, B, G cost 7 each."""
    costs = [["S", "A", 1], ["S", "B", "4"], ["A", "B", 2], ["A", "G", 6], ["B", "G", "3"]]
    given = {"start": "S", "goal": "G", "costs": costs}
    answers = rldrill.read({"family": "principle-of-optimality", "given": given}).answers()
    assert answers == {"a": {"S": -6, "A": -5, "B": -3}, "b": {"S": "A", "A": "B"}}
    for wrong in (["S", "A"], ["S", "A", "x"], ["S", "A", "far"]):
        with pytest.raises(FileError, match="edges"):
            family("principle-of-optimality").read(given | {"costs": [wrong]})
    with pytest.raises(FileError, match="costs is not a field"):
        family("principle-of-optimality").read(given | {"edges": costs})
