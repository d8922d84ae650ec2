"""What people write otherwise than models have it, and what only looks like it."""

from fractions import Fraction
from typing import Any

import jsonschema
import pytest

import rldrill
from rldrill.problems.catalogue import family
from rldrill.problems.errors import FileError

_OTHERWISE = ("S", "\N{GREEK SMALL LETTER GAMMA}", "lambda", "episode", "V")
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
        # several entries as one text
        ("eligibility-trace", {"states": "a,b; c", "gamma": 1, "lam": 1, "asked": "0, 1"},
         {"states": ["a", "b", "c"], "asked": [0, 1]}),
        ("return-infinite", {"first": "[1, 3/4, 2]", "repeated": "1 -2", "gamma": "1/2"},
         {"first": [1, "3/4", 2], "repeated": [1, -2]}),
        ("return-infinite", {"first": "1,3,2", "repeated": "3; 1.5", "gamma": "1/2"},
         {"first": [1, 3, 2], "repeated": [3, "1.5"]}),
        # one row without the brackets of the list
        ("bandit", {"pulls": ["a", 1], "arms": ["a", "b"]}, {"pulls": [["a", 1]]}),
        # rows and tables as one text, or as tables
        ("bandit", {"pulls": "a 1\na 3\nb 2"}, {"pulls": [["a", 1], ["a", 3], ["b", 2]]}),
        ("bandit", {"pulls": "a, 1; a, 3; b, 2"}, {"pulls": [["a", 1], ["a", 3], ["b", 2]]}),
        ("bandit", {"pulls": "| reward | arm |\n|---|---|\n| 1 | a |\n| 3 | b |"}, {"pulls": [["a", 1], ["b", 3]]}),
        ("td-zero", {"transitions": [{"s": "a", "r": 1, "s'": "b"}, {"s": "b", "s'": "a", "r": 2}], "alpha": 1,
                     "values": {"a": 0, "b": 0}, "gamma": 1}, {"transitions": [["a", "b", 1], ["b", "a", 2]]}),
        ("denavit-hartenberg", {"links": "a alpha d theta\n1 0 0 30°\n0 90° 2 0"},
         {"links": [{"a": 1, "alpha": 0, "d": 0, "theta": "30°"}, {"a": 0, "alpha": "90°", "d": 2, "theta": 0}]}),
        # runs in the order of time
        ("td-zero", {"trajectory": "a 1 b -.5 c", "values": {"a": 0, "b": 0, "c": 2}, "alpha": 1, "gamma": 1},
         {"trajectory": {"states": ["a", "b", "c"], "rewards": [1, "-1/2"]}}),
        ("sarsa", {"trajectory": "a → l → 1 → b → r", "values": {"a": {"l": 0}, "b": {"r": 2}}, "alpha": 1, "gamma": 1},
         {"trajectory": {"states": ["a", "b"], "actions": ["l", "r"], "rewards": [1]}}),
        ("batch-td-and-mc", {"episodes": ["A,0,B,0", {"states": ["B"], "rewards": [1], "times": 6}, "B 0"], "gamma": 1},
         {"episodes": [{"states": ["A", "B"], "rewards": [0, 0]}, {"states": ["B"], "rewards": [1], "times": 6},
                       {"states": ["B"], "rewards": [0]}]}),
        # where actions lead as rows alone
        ("bellman-backup", {"dynamics": [["c", "l", "d", 1, 2], ["c", "r", "e", 1, 4]], "values": {"d": 2, "e": 4},
                            "gamma": "1/2", "policy": "random"},
         {"dynamics": {"transitions": [["c", "l", "d", 1, 2], ["c", "r", "e", 1, 4]]}}),
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
        ("monte-carlo", {"episode": RUN, "V": {"a": 0, "b": 0}, "alpha": 1, "gamma": 1, "visits": "every"},
         {"trajectory": RUN, "values": {"a": 0, "b": 0}}),
        ("value-from-action-values", {"values": {"s": {"random": 1, "r": 3}}, "policy": "random"},
          {"policy": {"s": {"random": 1}}}),  # an action of that name
        # columns
        ("kalman-filter", {"mean": [1, 2], "covariance": [[1, 0], [0, 1]], "A": [[1, 1], [0, 1]], "B": [[0], [1]],
                           "C": [[1, 0]], "process": [[0, 0], [0, 0]], "sensor": 1, "steps": [{"u": [3], "z": [4]}]},
         {"mean": [[1], [2]], "steps": [{"u": 3, "z": 4}]}),
        # matrices and constants of books
        ("lqr-gain", {"A": "1/2 [1 1; 0 1]", "B": "[0; 3]/2", "R": 1, "S": "-[2 0; 0 4]", "gamma": 1},
         {"A": [["1/2", "1/2"], [0, "1/2"]], "B": [[0], ["3/2"]], "P": [[-2, 0], [0, -4]]}),
        ("linearise", {"dynamics": {"v": "u/m - g"}, "constants": {"m": 2, "g": "9.81"}, "state": {"v": 0},
                       "action": {"u": "m g"}}, {"action": {"u": "19.62"}}),
        # the names of states and actions may be numbers
        ("bayes-predict", {"belief": {"0": 1, "1": 0}, "motion": {0: {0: 1, 1: 1}, 1: {0: 0, 1: 0}}, "actions": [0]},
         {"motion": {"0": {"0": {"1": 1}, "1": {"1": 1}}, "1": {"0": {"0": 1}, "1": {"0": 1}}}, "actions": ["0"]}),
        # words in another case
        ("bic", {"criterion": "aic", "fitted": {"x": {"log_likelihood": -9, "k": 1},
                                                "y": {"log_likelihood": -8, "k": 1}}}, {"criterion": "AIC"}),
    ],
)  # fmt: skip
def test_what_can_mean_one_thing_only_is_read(name: str, given: dict[str, Any], usual: dict[str, Any]) -> None:
    kept = {key: value for key, value in given.items() if key not in _OTHERWISE}
    assert family(name).read(given) == family(name).read(kept | usual)


@pytest.mark.parametrize(
    ("name", "given", "says"),
    [
        # one trajectory, or three of one state each
        ("feature-expectations", {"features": {"a": [1]}, "trajectories": ["a", "a", "a"], "gamma": 1},
         "given.trajectories[1]: must be a list"),
        ("eligibility-trace", {"states": "a b", "gamma": 1, "lam": 1, "asked": [0]}, "given.states: must be a list"),
        ("return-infinite", {"first": [], "repeated": "2 1/2", "gamma": "1/2"}, "given.repeated: must be a list"),
        ("bayes-predict", {"belief": {"a": 1, "b": 0}, "motion": {"a": {"a": 1}, "b": {"b": 1}}, "actions": ["go"]},
         "given.motion: holds states alone; put the name of the action before them, as {go = {a = …}}."),
        ("eligibility-trace", {"states": ["a"], "gamma": 1, "lam": 1, "lambda": 1, "asked": [0]},
         "given.lambda is not a field"),
        ("eligibility-trace", {"states": ["a"], "discount": 1, "discount_factor": 1, "lam": 1, "asked": [0]},
         "given.discount_factor is not a field"),
        ("rbf", {"position": [0, 1], "centres": [0, 1], "sigma": 1}, "given"),
        # what would take for ever, or be longer than anything that is written
        ("lqr-gain", {"A": "1" + " " * 5000 + "[1", "B": 1, "R": 1, "P": -1}, "given.A[1][2]: '[1' is not a number"),
        ("eligibility-trace", {"states": ["a"], "gamma": 1, "lam": 1, "asked": "0, " + "9" * 5000},
         "given.asked[2]: '99"),
        ("linearise", {"dynamics": {"v": "u/m"}, "constants": {"m": 99}, "state": {"v": 0},
                       "action": {"u": "(" * 40 + "m" + "^4)" * 40}}, "given.action.u: '((((((((((((((((((("),
        ("bayes-predict", {"belief": {"0": 1, "b": 0}, "motion": {0: {0: 0.5}, "b": {"b": 0.5}}, "actions": [0]},
         "given.motion: holds states alone"),
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
        # by rows, as a text, and in the order of the states: V(A) = 5 + V(B)/2, V(B) = V(B)/2: 5 and 0
        ([["A", "go"], ["B", "stay"]], (5, 0)),
        ("A: go, B: stay", (5, 0)),
        ("π(A) = go; π(B) = stay", (5, 0)),
        ("A -> go\nB -> stay", (5, 0)),
        (["go", "stay"], (5, 0)),
        ([[1, 0], ["0", "1"]], (5, 0)),
        ([["A", "go", 0.5], ["A", "stay", 0.5], ["B", "go", "1/2"], ["B", "stay", "1/2"]], (5, 3)),
        ([["1/2", "1/2"], [0.5, 0.5]], (5, 3)),
    ],
)
def test_a_policy_that_is_the_same_everywhere_may_be_written_once(policy: Any, values: tuple[int, int]) -> None:
    problem = {"family": "policy-value", "given": {"mdp": TWO, "gamma": 0.5, "policy": policy}}
    assert rldrill.read(problem).answers() == {"a": dict(zip("AB", values, strict=True))}


@pytest.mark.parametrize(("A", "B"), [("top-left", "-1"), ("(0,0)", "(0,1)"), ("1", "2")])
def test_a_policy_as_a_text_may_be_of_cells_of_a_grid(A: str, B: str) -> None:
    names = {"A": A, "B": B}
    model = {"transitions": [[names.get(str(each), each) for each in row] for row in TWO["transitions"]]}
    given = {"mdp": model, "gamma": 0.5, "policy": f"{A}: go, {B}: stay"}
    assert rldrill.read({"family": "policy-value", "given": given}).answers() == {"a": {A: 5, B: 0}}


def test_an_action_with_two_probabilities_is_refused() -> None:
    policy = [["A", "go", 0.3], ["A", "go", 1], ["B", "go", 1]]
    with pytest.raises(FileError, match="'go' stands twice in 'A'"):
        rldrill.read({"family": "policy-value", "given": {"mdp": TWO, "gamma": 0.5, "policy": policy}})


def test_the_episodes_of_sutton_and_barto_as_they_print_them() -> None:
    """Example 6.4: batch TD(0) gives A and B 3/4, Monte Carlo gives A 0."""
    given = {"episodes": "A, 0, B, 0\n" + "B, 1\n" * 6 + "B, 0\n", "gamma": 1}
    answers = rldrill.read({"family": "batch-td-and-mc", "given": given}).answers()
    quarters = Fraction(3, 4)
    assert answers == {"a": {"A": 0, "B": quarters}, "b": {"A": quarters, "B": quarters}}


@pytest.mark.parametrize("run", ["1 5 2 15 3", "a -1 b 2,5 c", "a b c", "a 1 2 b", "1 a 2 b", ""])
def test_what_is_no_run_is_refused(run: str) -> None:
    with pytest.raises(FileError, match=r"given\.trajectory"):
        family("td-zero").read({"trajectory": run, "values": {"a": 0, "b": 0}, "alpha": 1, "gamma": 1})


def test_the_order_of_the_states_is_told_where_a_policy_rests_on_it() -> None:
    told: list[str] = []
    given = {"mdp": TWO, "gamma": 0.5, "policy": ["go", "stay"]}
    family("policy-value").read(given, told.append)
    assert told == ["took the policy in the order of the states A, B and of the actions go, stay"]


def test_rows_that_may_be_pairs_or_probabilities_are_refused() -> None:
    """Of [[1, 0], [0, 1]] the first row may say that action 0 is taken in state 1, or in state 0 for sure."""
    model = {"P": [[[1, 0], [0, 1]], [[0, 1], [1, 0]]], "R": [0, 1]}
    with pytest.raises(FileError, match="policy"):
        family("policy-value").read({"mdp": model, "gamma": 0.5, "policy": [[1, 0], [0, 1]]})


def test_the_policy_to_start_from_may_be_one_action() -> None:
    given = {"mdp": TWO, "gamma": 0.5, "start": "go", "rounds": 1}
    assert rldrill.read({"family": "policy-iteration", "given": given}).answers()["a"] == {"A": 8, "B": 6}


@pytest.mark.parametrize(
    "policy",
    [
        "fly",
        {"go": 1, "A": "go"},
        {"fly": 1},
        ["go", "fly"],
        ["go"],
        [["A", "go"], ["A", "stay"]],
        [1, 0],
        [["A", "go"], ["B", "go", 1]],
        "A: go, B",
    ],
)
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


ROWS = [["A", "go", "A", 1, 1]]


@pytest.mark.parametrize(
    ("name", "given"),
    [
        ("return-infinite", {"first": 2, "repeated": "7", "gamma": "1/2"}),
        ("return", {"rewards": 3, "gamma": 1}),
        ("bandit", {"pulls": "a 1\na 3\nb 2"}),
        ("kalman-filter", {"mean": 0, "covariance": 1, "process": 0, "sensor": 1, "steps": {"z": 1}}),
        ("td-zero", {"transitions": [{"s": "a", "r": 1, "s'": "b"}], "values": {"a": 0, "b": 0}, "alpha": 1,
                     "gamma": 1}),
        ("denavit-hartenberg", {"links": "a alpha d theta\n1 0 0 30°"}),
        ("td-zero", {"trajectory": "a 1 b", "values": {"a": 0, "b": 1}, "alpha": 1, "gamma": 1}),
        ("policy-value", {"mdp": {"transitions": ROWS}, "gamma": "1/2", "policy": "go"}),
        ("policy-value", {"mdp": {"transitions": ROWS}, "gamma": "1/2", "policy": [["A", "go"]]}),
        ("policy-value", {"mdp": {"transitions": "A go A 1 1"}, "gamma": "1/2"}),
        ("policy-value", {"mdp": ROWS, "gamma": "1/2"}),
        ("policy-value", {"mdp": {"transitions": {"A": {"go": {"A": [1, 5]}}}}, "gamma": "1/2"}),
        ("policy-value", {"mdp": {"P": "[[[1]]]", "R": "[1]"}, "gamma": "1/2"}),
        ("policy-value", {"mdp": {"P": {"go": [[1]]}, "R": {"go": [1]}}, "gamma": "1/2"}),
        ("action-value", {"dynamics": ROWS, "values": {"A": 1}, "gamma": "1/2"}),
    ],
)  # fmt: skip
def test_the_schema_of_files_takes_the_short_forms_that_are_read(name: str, given: dict[str, Any]) -> None:
    schema = family(name).written_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.validate(given, schema)
    family(name).read(given)


@pytest.mark.parametrize(
    ("name", "given"),
    [
        ("return", {"rewards": {"a": 3}, "gamma": 1}),
        ("eligibility-trace", {"states": ["a"], "gamma": 1, "lam": 1, "asked": "0, 1"}),
        ("rbf", {"position": [1], "centres": 3, "sigma": 1, "theta": "1 2", "more": 1}),
        ("policy-value", {"mdp": 3, "gamma": "1/2"}),
    ],
)
def test_the_schema_of_files_refuses_what_is_not_read(name: str, given: dict[str, Any]) -> None:
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(given, family(name).written_schema())
    with pytest.raises(FileError):
        family(name).read(given)
