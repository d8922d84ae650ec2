"""Givens from outside: whatever is wrong with them is one sentence that names the field."""

import re
from itertools import product
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

import rldrill
from rldrill import problems
from rldrill.problems.catalogue import families, family
from rldrill.problems.draws import Draws
from rldrill.problems.errors import FileError
from rldrill.problems.family import trusted
from rldrill.problems.temporal_difference.sample_average import Given as SampleAverage
from rldrill.solutions.drawing import draw

MDP = {
    "transitions": [["a", "go", "b", "1/2", 1], ["a", "go", "end", 0.5, 2], ["b", "go", "a", 1, 3]],
    "terminal": ["end"],
}
VALUE_ITERATION: dict[str, Any] = {"mdp": MDP, "gamma": "9/10", "sweeps": 2}


def changed(**fields: object) -> dict[str, Any]:
    return VALUE_ITERATION | fields


def mdp(*transitions: list[object], terminal: tuple[str, ...] = ("end",)) -> dict[str, Any]:
    return changed(mdp={"transitions": list(transitions), "terminal": list(terminal)})


@pytest.mark.parametrize(
    ("given", "fragment"),
    [
        (changed(gamma="x"), "x is left open, so no action can be called greedy"),
        (changed(gamma="11/10"), "given.gamma: 11/10 is not between 0 and 1"),
        (changed(gamma=float("nan")), "given.gamma"),
        (changed(sweeps=0), "given.sweeps"),
        (changed(sweeps=10**9), "given.sweeps"),
        (changed(extra=1), "given.extra is not a field"),
        ({"mdp": MDP, "gamma": 1}, "given.sweeps: is missing"),
        (changed(start={"a": 1}), "value of 'b' is missing"),
        (changed(start={"a": 1, "b": 2, "c": 3}), "given for 'c'"),
        (mdp(["a", "go", "end", "1/2", 1]), "sum to 1/2, not to 1; change one of them"),
        (
            mdp(["a", "go", "end", 0.33, 1], ["a", "go", "a", 0.66, 1]),
            "sum to 99/100, not to 1; write what is rounded as a fraction, as '1/3'",
        ),
        (mdp(["a", "go", "end", "3/2", 1]), "not between 0 and 1"),
        (mdp(["a", "go", "b", 1, 1]), "'b' is reached but has no action"),
        (mdp(["a", "go", "end", 1, 1], ["end", "go", "a", 1, 1]), "'end' is terminal"),
        (mdp(["a", "go", "end", "1/2", 1], ["a", "go", "end", "3/4", 1]), "sum to 5/4, not to 1"),
        (mdp(["a", "go", "end", "0.333333", 1], ["a", "go", "a", "0.666666", 1]), "sum to 0.999999, not to 1"),
        (mdp(["a", "go", "end", 1]), "given.mdp.transitions"),
        (mdp(["a", "go", "$x$", 1, 1]), "given.mdp.transitions"),
        (mdp(["a", "go", "x\ny", 1, 1]), "given.mdp.transitions"),
        (mdp(["a" * 200, "go", "end", 1, 1]), "given.mdp.transitions"),
        (mdp(), "given.mdp.transitions"),
        ("nothing", "given"),
        (None, "given"),
    ],
)
def test_wrong_givens(given: Any, fragment: str) -> None:
    with pytest.raises(FileError) as error:
        family("value-iteration").read(given)
    assert fragment in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("gamma", ["9/10", 0.9, "0.9", " 0.90 "])
def test_a_number_reads_the_same_however_it_is_written(gamma: object) -> None:
    assert family("value-iteration").read(changed(gamma=gamma)) == family("value-iteration").read(VALUE_ITERATION)


@pytest.mark.parametrize("name", families())
def test_givens_survive_being_written_and_read(name: str) -> None:
    for level in family(name).levels:
        problem = draw(name, level, 5).problem
        assert problem.family.read(problem.data()["given"]) == problem.given


def test_givens_are_checked_unless_they_are_our_own_draws() -> None:
    with pytest.raises(ValidationError):
        SampleAverage(counts="none")
    with trusted():
        assert SampleAverage(counts="none").model_fields_set == {"counts"}


@pytest.mark.parametrize("name", families())
def test_what_is_drawn_unchecked_is_what_checking_would_make_of_it(name: str) -> None:
    for level, key in product(family(name).levels, "abcdef"):
        checked = family(name).draw(level, Draws(key))
        with trusted():
            drawn = family(name).draw(level, Draws(key))
        assert drawn == checked
        assert drawn.model_dump_json() == checked.model_dump_json()


GAIN: dict[str, Any] = {"A": [[1, 0], [0, 1]], "B": [[1], [1]], "R": 1, "P": [[-1, 0], [0, -1]]}
LQR: dict[str, Any] = {"A": 1, "B": 1, "Q": 1, "R": 1, "start": [1], "horizon": 1}
SENSOR = {"wet": {"rain": 1, "sun": 0}, "dry": {"rain": 0, "sun": 1}}
STAYING = {"motion": {"x": {"a": {"a": 1}}}, "policy": {"a": {"x": 1}}, "start": {"a": 1}, "gamma": "1/2"}
RULE: dict[str, Any] = {"prior": {"rain": "1/2", "sun": "1/2"}, "likelihood": SENSOR, "measurements": ["wet"]}
FILTER: dict[str, Any] = {
    "belief": {"rain": 1, "sun": 0},
    "motion": {"wait": {"rain": {"sun": 1}, "sun": {"sun": 1}}},
    "likelihood": SENSOR,
    "run": [{"action": "wait", "measurement": "dry"}],
}
COINS: dict[str, Any] = {"models": {"bent": {}, "fair": {"theta": "1/2"}}, "prior": {"bent": "1/2", "fair": "1/2"}}
COINS |= {"heads": 2, "tails": 1}
TANK: dict[str, Any] = {"dynamics": {"h": "u - sqrt(h)"}, "state": {"h": 1}, "action": {"u": 1}}
EXPERT: dict[str, Any] = {"expert": [2, 2], "first": [0, 0], "policies": [[4, 0], [2, 4]]}


@pytest.mark.parametrize(
    ("name", "given", "says"),
    [
        # matrices that are none
        ("lqr-gain", GAIN | {"A": [[1, 2], [3]]}, "given.A: row 2 has length 1, row 1 has 2; make them equal."),
        ("lqr-gain", GAIN | {"A": []}, "given.A: is empty; a matrix needs at least one row with one entry."),
        ("lqr-gain", GAIN | {"B": [[]]}, "given.B: is empty; a matrix needs at least one row with one entry."),
        ("lqr-backward", LQR | {"A": [[1, 2], [3]]}, "given.A: row 2 has length 1, row 1 has 2"),
        ("lqr-backward", LQR | {"Q": [[[1]], [[1, 2], [3]]]}, "given.Q: matrix 2: row 2 has length 1, row 1 has 2"),
        ("lqr-backward", LQR | {"B": []}, "given.B: is empty"),
        ("kalman-filter", {"mean": 0, "covariance": 1, "process": 1, "sensor": 1, "B": [], "steps": [{"u": 1}]},
         "given.B: is empty"),
        # what is impossible
        ("bayes-rule", RULE | {"measurements": ["wet", "dry"]}, "measurements[2]: 'dry' is impossible under the"),
        ("bayes-filter", FILTER | {"run": [{"measurement": "dry"}]},
         "run[1]: the measurement 'dry' is impossible under the belief"),
        ("bayes-filter", FILTER | {"run": [{"action": "wait", "measurement": "wet"}]}, "run[1]: the measurement 'wet'"),
        ("model-comparison", COINS | {"models": {"bent": {}, "fair": {"theta": 1}}}, "models: 'fair' has the prior 0"),
        ("model-comparison", COINS | {"prior": {"bent": 1, "fair": 0}}, "models: 'fair' has the prior 0"),
        ("model-comparison", COINS | {"models": {"bent": {"theta": 0}, "fair": {"theta": 1}}}, "models: every model"),
        ("model-comparison", COINS | {"models": {"bent": {}, "fair": {"theta": "1/2", "a": 2}}},
         "given.models.fair: with theta there is no prior Beta(a, b); leave out theta, or a and b."),
        ("apprenticeship", EXPERT | {"policies": [[0, 0]]}, "policies[1]: this is where the projection stands"),
        ("apprenticeship", EXPERT | {"policies": [[4, 0], [2, 0]]}, "policies[2]: this is where the projection stands"),
        # what is not of the kind that is needed
        ("rbf", {"position": "1,2", "centres": [[4]], "sigma": 1},
         "given.position: must be a list; a single entry, too, stands in brackets: ['1,2']."),
        ("lqr-backward", LQR | {"start": True}, "given.start: must be a list; a single entry"),
        ("lqr-backward", LQR | {"Q": "eye(2)"}, "given.Q: 'eye(2)' is not worked out here; write its rows, as [["),
        ("lqr-infinite", {"A": 1, "B": 1, "Q": "I", "R": 1}, "given.Q: 'I' is not worked out here; write its rows"),
        ("sample-average", {"values": {"a": 0}, "visits": [["a", 4]]},
         "given.counts: the number of visits of 'a' is missing; add it."),
        ("lqr-backward", LQR | {"start": []}, "given.start: is empty; it needs at least 1 entry."),
        ("lqr-backward", LQR | {"horizon": "x"}, "given.horizon: 'x' is not a whole number; write one, such as 3."),
        ("lqr-backward", LQR | {"horizon": 0}, "given.horizon: 0 is too small; it must be at least 1."),
        ("lqr-backward", LQR | {"horizon": 999}, "given.horizon: 999 is too large; it must be at most 100."),
        ("bayes-rule", RULE | {"prior": {"sun": 1}}, "given.prior: has 1 entry; it needs at least 2 entries."),
        ("bayes-rule", RULE | {"prior": {}}, "given.prior: is empty; it needs at least 2 entries."),
        ("feature-expectations", {"features": {}, "trajectories": [["a"]], "gamma": 1},
         "given.features: is empty; it needs at least 1 entry."),
        ("feature-expectations-policy", STAYING | {"features": {}},
         "given.features: is empty; it needs at least 1 entry."),
        ("bayes-rule", RULE | {"prior": [1, 2]},
         "given.prior: must be a table, in which every name has its value: {A = …, B = …}."),
        ("bayes-rule", RULE | {"prior": "uniform"}, "given.prior: 'uniform' says not of what; write every name with"),
        ("bayes-predict", {"belief": {"a": 1, "b": 0}, "motion": {"go": {"a": "uniform", "b": "b"}}, "actions": ["go"]},
         "given.motion.go.a: 'uniform' says not of what; write every name with its probability: {A = '1/2',"),
        ("bayes-rule", RULE | {"likelihood": {}},
         "a measurement is 'wet', of which likelihood says nothing; add it there."),
        ("bayes-rule", RULE | {"prior": {"$a$": 1, "b": 0}}, "given.prior: '$a$' is no name; a name begins with"),
        ("bayes-rule", RULE | {"prior": {"a,b": 1, "b": 0}}, "given.prior: 'a,b' is no name; a name begins with"),
        ("bayes-rule", RULE | {"story": "$"}, "given.story: may hold neither $ nor a backslash; take them out."),
        ("bayes-rule", RULE | {"story": "a" * 300}, "given.story: has 300 characters, 200 are the most; shorten it."),
        ("value-iteration", mdp(["a", "go", "end"]),
         "given.mdp.transitions[1][4]: is missing; add it; the row is [state, action, next, probability, reward] (and"),
        ("value-iteration", mdp(["a", "go", "end", 1, 1, 1]), "given.mdp.transitions[1]"),
        ("value-iteration", mdp(1),
         "given.mdp.transitions[1]: must be a list, [state, action, next, probability, reward]"),
        ("value-iteration", changed(mdp=1), "given.mdp: must be a table, in which every name has its value."),
        ("ddp-backward", {"second_order": "x"}, "given.dynamics: is missing; add it (and"),
        ("bandit", {"pulls": [["x", 1]], "preferences": {}, "alpha": 1, "pulled": ["x", 1]},
         "given.preferences: is empty; it needs at least 2 entries."),
        # what belongs to one of several kinds of problems
        ("bandit", "nothing", "given: must be a table, in which every name has its value."),
        ("bandit", {"pulls": [["x", 1]], "c": "x"}, "given.c: 'x' is not a number"),
        ("bandit", {"pulls": [["x", 1], ["y", 1]], "C": 1}, "given.C is not a field (did you mean c?)"),
        ("bandit", {"pulls": [["x", 1], ["y", 1]], "pulled": ["x", 1], "alpha": 1}, "given.preferences: is missing"),
        ("expected-sarsa", [], "given: must be a table, in which every name has its value."),
        ("expected-sarsa", {}, "given: give either policy or epsilon."),
        ("advantage", {"lookahead": {}, "run": {}, "gamma": 1}, "given: give either lookahead or run."),
        ("advantage", {"lookahead": 1, "gamma": 1}, "given.lookahead: must be a table"),
        ("advantage", {"lookahead": {"policy": 1}, "gamma": 1}, "given.lookahead.dynamics: is missing; add it (and"),
        ("linearise", TANK | {"dynamics": {"height": "1"}}, "given.dynamics: 'height' is not a letter; write one such"),
        ("linearise", TANK | {"dynamics": {"e": "1"}}, "given.dynamics: 'e' is the number e; write another letter"),
        ("linearise", TANK | {"dynamics": {"t": "1"}}, "given.dynamics: 't' is the time; write another letter"),
        ("linearise", TANK | {"picture": "x"}, "given.picture: 'x' is not possible here; write 'pendulum'"),
        ("optimal-policy-from-q", {"values": {"a": {"x": 1}}, "missing": {"transitions": [["b", "x", "a", 1, "x"]]},
                                   "gamma": 1}, "values: 'b' does not occur; give it there"),
    ],
)  # fmt: skip
def test_one_plain_sentence_names_the_field(name: str, given: Any, says: str) -> None:
    with pytest.raises(FileError) as error:
        family(name).read(given)
    assert says in str(error.value)
    assert str(error.value).startswith("given")
    assert str(error.value).endswith(".")
    assert not str(error.value).endswith("..")
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("name", "given", "says"),
    [
        ("linearise", TANK | {"state": {"h": 0}}, "do not exist at the operating point"),
        ("linearise", TANK | {"dynamics": {"h": "u/(h - 1)"}}, "do not exist at the operating point"),
        ("linearise-affine", TANK | {"state": {"h": 0}, "step": 1}, "do not exist at the operating point"),
        ("ddp-backward", TANK | {"state": {"h": 0}, "reward": "-u^2", "gradient": [1], "hessian": -1},
         "do not exist at the operating point"),
    ],
)  # fmt: skip
def test_what_has_no_answer_says_why(name: str, given: Any, says: str) -> None:
    with pytest.raises(FileError, match=r"has no answer: .*; change .*\.$") as error:
        rldrill.read({"family": name, "given": given})
    assert says in str(error.value)


@pytest.mark.parametrize("name", ["lambda", "λ", "lambda_1", "ϕ", "φ", "phi"])
def test_greek_letters_of_dynamics_in_all_their_spellings(name: str) -> None:
    given = TANK | {"dynamics": {name: f"u - 3*{name}"}, "state": {name: 1}}
    assert str(rldrill.read({"family": "linearise", "given": given}).solve()["a"][0, 0]) == "-3"


def test_spellings_of_a_letter_may_be_mixed() -> None:
    for key, used in (("lambda", "λ"), ("ϕ", "phi"), ("φ", "ϕ")):
        given = TANK | {"dynamics": {key: f"u - 3*{used}"}, "state": {used: 1}}
        assert str(rldrill.read({"family": "linearise", "given": given}).solve()["a"][0, 0]) == "-3"


CAFE = "cafe\N{COMBINING ACUTE ACCENT}"
SEEN = {"trajectory": {"states": [CAFE, "end"], "rewards": [4], "terminal": ["end"]}, "alpha": "1/2", "gamma": 1}
COINS = {"prior": {"a": "1/2", "b": "1/2"}, "heads": 1, "tails": 1}


@pytest.mark.parametrize(
    ("name", "given", "says"),
    [
        ("linearise", TANK | {"constants": {"theta_1": 1, "θ₁": 7}}, "given.constants: 'θ_1'"),
        ("linearise", TANK | {"dynamics": {"x": "u - x", "x1": "x1", "x_1": "x"}}, "given.dynamics: 'x_1'"),
        ("td-zero", SEEN | {"values": {"café": 4, CAFE: 100}}, "given.values: 'café'"),
        ("epsilon-greedy", {"values": {"café": 4, CAFE: 1, "tea": 0}, "epsilon": "1/5"}, "given.values: 'café'"),
        (
            "model-comparison",
            COINS | {"models": {"é": {"theta": "1/2"}, "e\u0301": {"theta": "1/3"}, "b": {"theta": 1}}},
            "given.models: 'é'",
        ),
        ("rbf", {"position": 0, "centres": [0, 1], "logarithms": {"1": "-1/2", "01": "-1"}}, "given.logarithms: 1"),
        ("rbf", {"position": 0, "centres": [0, 1], "logarithms": {"1": "-1/2", "1.0": "-1"}}, "given.logarithms: 1"),
    ],
)
def test_no_name_is_given_twice_in_two_spellings(name: str, given: Any, says: str) -> None:
    with pytest.raises(FileError) as error:
        rldrill.read({"family": name, "given": given})
    assert f"{says} is given twice, in two spellings; leave one out" in str(error.value)


def test_every_table_is_read_so() -> None:
    lines = [line for path in Path(problems.__file__).parent.rglob("*.py") for line in path.read_text().splitlines()]
    tables = [line for line in lines if re.search(r"(?<!-> )\bdict\[(Name|Letter),", line)]
    assert len(tables) > 10
    assert [line for line in tables if "once(" not in line] == []


def test_the_kinds_of_a_union_are_its_models() -> None:
    from rldrill.problems.bayes.bayes_rule import Given
    from rldrill.problems.control.bandit import Balance, Bounds, Estimates, Preferences

    assert family("bandit").kinds == (Estimates, Bounds, Balance, Preferences)
    assert family("bayes-rule").kinds == (Given,)


def test_a_rate_may_be_left_open_under_any_letter() -> None:
    # 10 + 1/2·(4 + θ·6 − 10) = 9 for θ = 2/3
    run = {"states": ["a", "b"], "actions": ["x", "y"], "rewards": [4]}
    values = {"a": {"x": 10, "y": 2}, "b": {"x": 8, "y": 6}}
    outcome = ["a", "x", 9]
    for letter, asked in (("gamma", "discount $γ$"), ("theta", "value of $θ$")):
        given = {"trajectory": run, "values": values, "alpha": "1/2", "gamma": letter, "outcome": outcome}
        exercise = rldrill.read({"family": "sarsa", "given": given})
        assert asked in exercise.parts[0].ask
        assert exercise.check("2/3").accepted
