"""Identities of the policy gradient families, and what is wrong with givens that do not fit."""

from typing import Any

import mpmath
import pytest
import sympy
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

import rldrill
from asking import rounded, solved
from numbers_drawn import small
from rldrill.problems.catalogue import family
from rldrill.problems.document import Paragraph
from rldrill.problems.errors import FileError
from rldrill.problems.exact import Logarithm, read_weight, shown
from rldrill.solutions.exact import exact, simplest
from rldrill.solutions.formula.putting_in import put_in, without_slots
from rldrill.solutions.sheet.policy_gradient import PREFERENCE, SCORE_FUNCTION, SOFTMAX_POLICY
from rldrill.solutions.sheet.policy_gradient import theta as theta_of_index
from rldrill.solutions.softmax import action_features, by_number
from rldrill.solutions.vector import Vector

ACTIONS = ("left", "right", "stay")
numbers = small(-4, 4, 3)
texts = numbers.map(str)
weights = st.one_of(texts, st.sampled_from(["ln 2", "ln 3"]))
rows = st.lists(st.integers(0, 3), min_size=2, max_size=2)
discounts = st.sampled_from(["0", "1/2", "9/10", "1"])


def equal(one: Any, other: Any) -> bool:
    """Whether two closed forms agree to forty places; sympy's own comparison takes minutes for some."""
    with mpmath.workdps(60):
        return bool(abs(decimal(sympy.sympify(one)) - decimal(sympy.sympify(other))) < 1e-40)


def decimal(expression: Any) -> Any:
    """A closed form, worked out from its leaves."""
    if expression.is_Rational:
        return mpmath.mpf(int(expression.p)) / int(expression.q)
    if expression is sympy.E:
        return mpmath.e
    arguments = [decimal(argument) for argument in expression.args]
    if expression.is_Add:
        return mpmath.fsum(arguments)
    if expression.is_Mul:
        return mpmath.fprod(arguments)
    return {"Pow": mpmath.power, "exp": mpmath.exp, "log": mpmath.log}[expression.func.__name__](*arguments)


def log_probability(theta: list[sympy.Symbol], features: dict[str, list[int]], action: str) -> sympy.Expr:
    """The logarithm of the sheet's softmax, its sums written out, the weights left as symbols."""
    known = {"s": "s", "features": (1, 2), "choices": tuple(features)} | action_features({"s": features})  # type: ignore[dict-item]
    written = put_in(SOFTMAX_POLICY.right, {"s": "s", "a": action, "choices": tuple(features)})
    preferences = {
        put_in(PREFERENCE.left, {"s": "s", "a": other}): put_in(PREFERENCE.right, known | {"a": other})
        for other in features
    }
    expression = written.xreplace(preferences)
    letters = {node: theta[int(node.args[0]) - 1] for node in expression.atoms(theta_of_index)}
    return sympy.log(without_slots(expression.xreplace(letters)).doit())


@given(st.lists(rows, min_size=2, max_size=3), st.lists(weights, min_size=2, max_size=2), st.integers(0, 1))
@settings(deadline=None, max_examples=8)
def test_the_score_function_is_the_derivative_of_log_softmax(
    table: list[list[int]], theta: list[str], chosen: int
) -> None:
    features = dict(zip(ACTIONS, table, strict=False))
    action = ACTIONS[chosen]
    letters = list(sympy.symbols("w1 w2", real=True))
    log = log_probability(letters, features, action)
    values = [sympy.sympify(exact(read_weight(text))) for text in theta]
    at = dict(zip(letters, values, strict=True))
    known = by_number(values) | action_features({"s": features}) | {"s": "s", "choices": tuple(features)}  # type: ignore[arg-type]
    known["H"] = {("s", other): PREFERENCE.value(known | {"a": other}) for other in features}
    known["pi"] = {(other, "s"): simplest(SOFTMAX_POLICY.value(known | {"a": other})) for other in features}
    score = SCORE_FUNCTION.value(known | {"a": action})
    for letter, entry in zip(letters, score, strict=True):
        assert equal(sympy.diff(log, letter).subs(at), sympy.sympify(entry))


@given(
    st.lists(rows, min_size=2, max_size=2),
    st.lists(weights, min_size=2, max_size=2),
    st.lists(texts, min_size=2, max_size=2),
)
@settings(deadline=None, max_examples=5)
def test_reinforce_is_the_derivative_of_the_weighted_log_likelihood(
    table: list[list[int]], theta: list[str], rewards: list[str]
) -> None:
    features = dict(zip(ACTIONS, table, strict=False))
    run = {"states": ["s", "s", "end"], "actions": ["left", "right"], "rewards": rewards, "terminal": ["end"]}
    answers = solved("reinforce", trajectory=run, features={"s": features}, theta=theta, alpha=1, gamma="1/2")
    letters = list(sympy.symbols("w1 w2", real=True))
    objective = sum(
        sympy.sympify(G) * log_probability(letters, features, action)
        for G, action in zip(answers["a"], ("left", "right"), strict=True)
    )
    values = [sympy.sympify(exact(read_weight(text))) for text in theta]
    at = dict(zip(letters, values, strict=True))
    for letter, value, slope, after in zip(letters, values, answers["b"], answers["c"], strict=True):
        assert equal(sympy.diff(objective, letter).subs(at), sympy.sympify(slope))
        assert equal(value + sympy.sympify(slope), sympy.sympify(after))


@given(st.lists(rows, min_size=3, max_size=3), st.sampled_from([["1/2", "1/4", "1/4"], ["1/5", "1/5", "3/5"]]))
@settings(deadline=None, max_examples=20)
def test_scores_are_zero_on_average(table: list[list[int]], chances: list[str]) -> None:
    scores = solved(
        "score-function",
        features=dict(zip(ACTIONS, table, strict=True)),
        policy=dict(zip(ACTIONS, chances, strict=True)),
    )
    total = sum((Vector(v) * fmpq(*map(int, p.split("/"))) for v, p in zip(scores.values(), chances, strict=True)), 0)
    assert all(entry == 0 for entry in total)


@given(st.lists(rows, min_size=3, max_size=3), st.lists(texts, min_size=3, max_size=3), texts)
@settings(deadline=None, max_examples=15)
def test_a_baseline_does_not_change_the_expected_gradient(
    table: list[list[int]], rewards: list[str], baseline: str
) -> None:
    features = dict(zip(ACTIONS, table, strict=True))
    theta = ["ln 2", "ln 3"]
    probabilities = solved("score-function", features=features, theta=theta)["a"]

    def expected(of: str, **more: Any) -> Vector:
        total: Any = 0
        for action, reward in zip(ACTIONS, rewards, strict=True):
            run = {"states": ["s", "end"], "actions": [action], "rewards": [reward], "terminal": ["end"]}
            answers = solved(of, trajectory=run, features={"s": features}, theta=theta, alpha=1, gamma=1, **more)
            total = Vector(answers["b"]) * probabilities[action] + total
        return Vector(total)

    assert expected("reinforce") == expected("reinforce-baseline", baseline={"s": baseline})


@given(st.lists(texts, min_size=3, max_size=3), discounts)
@settings(deadline=None, max_examples=15)
def test_without_a_baseline_it_is_reinforce(rewards: list[str], gamma: str) -> None:
    run = {"states": ["s", "t", "s", "end"], "actions": ["left", "right", "right"], "rewards": rewards}
    run["terminal"] = ["end"]
    features = {"s": {"left": [1, 0], "right": [0, 1]}, "t": {"left": [2, 1], "right": [0, 0]}}
    given_ = {"trajectory": run, "features": features, "theta": ["ln 2", "ln 2"], "alpha": "1/2", "gamma": gamma}
    with_zero = solved("reinforce-baseline", **given_, baseline={"s": 0, "t": 0})
    assert with_zero == solved("reinforce", **given_)
    if gamma == "0":
        assert [str(G) for G in with_zero["a"]] == rewards


@given(texts, texts, texts, discounts)
@settings(deadline=None, max_examples=15)
def test_the_critic_of_actor_critic_is_td_zero(reward: str, here: str, there: str, gamma: str) -> None:
    run = {"states": ["s", "t", "s"], "rewards": [reward, "1"]}
    values, features = {"s": here, "t": there}, {"left": [1, 0], "right": [0, 1]}
    learnt = solved(
        "actor-critic", trajectory=run | {"actions": ["left", "right"]}, features={"s": features, "t": features},
        theta=["0", "0"], values=values, alpha="1/3", beta="1/2", gamma=gamma,
    )  # fmt: skip
    assert learnt["b"] == solved("td-zero", trajectory=run, values=values, alpha="1/3", gamma=gamma)["a"]


@given(st.sampled_from(["1/5", "1/2", "9/10"]), texts, st.sampled_from(["1/10", "1/5"]))
@settings(deadline=None)
def test_without_a_change_of_policy_the_objective_is_the_advantage(chance: str, advantage: str, epsilon: str) -> None:
    sample = {"state": "s", "action": "left", "old": chance, "new": chance, "advantage": advantage}
    answers = solved("ppo-clip", samples=[sample], epsilon=epsilon)
    assert answers["a"] == 1
    assert str(answers["c"]) == advantage
    assert answers["d"] is False


@given(st.integers(0, 10_000))
@settings(deadline=None, max_examples=25)
def test_the_clipped_objective_never_exceeds_the_unclipped_one(seed: int) -> None:
    answers = rldrill.draw("ppo-clip", level=1, seed=seed).solve()
    unclipped, _ = answers["b"]
    assert answers["c"] <= unclipped
    assert answers["d"] == (answers["c"] < unclipped)


@given(st.lists(texts, min_size=3, max_size=3), st.lists(texts, min_size=2, max_size=2), discounts)
@settings(deadline=None, max_examples=20)
def test_gae_is_the_td_error_for_lambda_0_and_monte_carlo_for_lambda_1(
    rewards: list[str], values: list[str], gamma: str
) -> None:
    run = {"states": ["s", "t", "s", "end"], "rewards": rewards, "terminal": ["end"]}
    known = {"trajectory": run, "values": dict(zip("st", values, strict=True))}
    one_step = solved("advantage", run=known | {"lam": 0}, gamma=gamma)
    assert one_step["a"] == one_step["b"]
    whole = solved("advantage", run=known | {"lam": 1}, gamma=gamma)["b"]
    returns = solved("return", rewards=rewards, gamma=gamma)["a"]
    V = [exact(read_weight(values[0])), exact(read_weight(values[1]))]
    assert whole == tuple(G - value for G, value in zip(returns, (V[0], V[1], V[0]), strict=True))


@pytest.mark.parametrize("level", [1, 2])
def test_two_actions_that_are_compared_are_never_worth_the_same(level: int) -> None:
    for seed in range(150):
        exercise = rldrill.draw("advantage", level, seed)
        for values in exercise.answers()["a"].values():
            assert len(set(values.values())) == len(values), exercise.id


@given(st.integers(0, 10_000))
@settings(deadline=None, max_examples=25)
def test_advantages_are_zero_on_average(seed: int) -> None:
    solution = rldrill.draw("advantage", level=2, seed=seed).solution
    ahead = solution.problem.given.lookahead  # type: ignore[attr-defined]
    chances = ahead.policy[ahead.state]
    assert sum(exact(chances[action]) * value for (_, action), value in solution.answers["c"].items()) == 0


@given(st.lists(rows, min_size=3, max_size=3), st.lists(texts, min_size=2, max_size=2))
@settings(deadline=None, max_examples=20)
def test_the_linear_policy_does_not_depend_on_the_scale_of_the_weights(
    table: list[list[int]], theta: list[str]
) -> None:
    features = {"s": dict(zip(ACTIONS, table, strict=True))}
    doubled = [str(2 * sympy.Rational(weight)) for weight in theta]
    assert (
        solved("linear-policy", theta=theta, features=features)["b"]
        == (solved("linear-policy", theta=doubled, features=features)["b"])
    )


def test_a_weight_may_be_a_logarithm() -> None:
    assert read_weight("ln 2") == read_weight(" ln(2) ") == Logarithm("ln 2")
    assert shown(read_weight("ln x")) == "ln x"
    assert equal(exact(Logarithm("ln 2")), sympy.log(2))
    answers = solved("score-function", theta=["ln x"], features={"a": [1], "b": [0]}, action="a")
    assert str(sympy.sympify(answers["b"][0])) == "1/(x + 1)"
    with pytest.raises(ValueError, match="above 1"):
        read_weight("ln 1")
    with pytest.raises(ValueError, match="is not a number"):
        read_weight("ln two words")


RUN = {"states": ["s", "end"], "actions": ["left"], "rewards": [1], "terminal": ["end"]}
FEATURES = {"s": {"left": [1, 0], "right": [0, 1]}}
REINFORCE = {"trajectory": RUN, "features": FEATURES, "theta": [0, 0], "alpha": 1, "gamma": 1}
SAMPLE = {"state": "s", "action": "left", "old": "1/2", "new": "1/4", "advantage": 1}
AHEAD = {"transitions": [["s", "go", "t", 1, 1]]}


@pytest.mark.parametrize(
    ("name", "given_", "fragment"),
    [
        ("reinforce", REINFORCE | {"theta": [0]}, "'left' has 2 features, but theta 1"),
        ("reinforce", REINFORCE | {"features": {"s": {"right": [0, 1]}}}, "'left' is taken in 's' but has no features"),
        ("reinforce", REINFORCE | {"features": {"s": {}}}, "'s' has no action"),
        ("reinforce", REINFORCE | {"features": {"t": FEATURES["s"]}}, "the row of features of 's' is missing"),
        ("reinforce", REINFORCE | {"trajectory": RUN | {"terminal": []}}, "must end in a terminal state"),
        ("reinforce", REINFORCE | {"trajectory": RUN | {"actions": []}}, "1 steps need as many actions, not 0"),
        ("reinforce-baseline", REINFORCE | {"baseline": {}}, "the baseline of 's' is missing"),
        ("actor-critic", REINFORCE | {"values": {}, "beta": 1}, "the value of 's' is missing"),
        ("score-function", {"features": FEATURES["s"]}, "either the weights theta or the policy's"),
        ("score-function", {"features": FEATURES["s"], "policy": {"left": 1, "right": 1}}, "sum to 2, not to 1"),
        ("score-function", {"features": FEATURES["s"], "theta": [1, 1], "action": "up"}, "'up' has no features"),
        ("linear-policy", {"theta": [1], "features": FEATURES}, "'left' has 2 features, but theta 1"),
        ("ppo-clip", {"samples": [SAMPLE | {"old": 0}], "epsilon": "1/5"}, "its probability was not 0"),
        ("ppo-clip", {"samples": [SAMPLE], "epsilon": 1}, "given.epsilon"),
        ("ppo-clip", {"samples": [], "epsilon": "1/5"}, "given.samples"),
        ("ppo-clip", {"samples": [SAMPLE | {"preferences": {"left": 0}}], "epsilon": "1/5"}, "give either the new"),
        ("advantage", {"gamma": 1}, "give either lookahead or run"),
        ("advantage", {"lookahead": {"dynamics": AHEAD, "values": {"t": 1}}, "gamma": 1}, "value of 's' is missing"),
        (
            "advantage",
            {"lookahead": {"dynamics": AHEAD, "values": {"t": 1, "s": 2}, "policy": {"s": "go"}}, "gamma": 1},
            "the value of 's' follows from it",
        ),
    ],
)
def test_wrong_givens(name: str, given_: Any, fragment: str) -> None:
    with pytest.raises(FileError) as error:
        family(name).read(given_)
    assert fragment in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("seed", range(12))
def test_a_policy_is_better_than_one_action_and_worse_than_another(seed: int) -> None:
    advantages = rldrill.draw("advantage", 1, seed).solve()["b"].values()
    assert min(advantages) < 0 < max(advantages)


@pytest.mark.parametrize("seed", range(12))
def test_every_step_counts_against_the_baseline(seed: int) -> None:
    assert all(rldrill.draw("reinforce-baseline", 1 + seed % 2, seed).solve()["a"])


def sample(new: str, advantage: int) -> dict[str, Any]:
    return {"state": "s", "action": "left", "old": "1/2", "new": new, "advantage": advantage}


def test_the_clipping_range_follows_from_the_objective() -> None:
    # Ratios 3/2 and 3/2, advantages 2 and −2: the second gradient is never cut off, u₁ = −3; L = ((1 + ε)·2 − 3)/2 is
    # −2/5 for ε = 1/10.
    answers = solved("ppo-clip", samples=[sample("3/4", 2), sample("3/4", -2)], objective="-2/5")
    assert answers == {"a": (fmpq(3, 2), fmpq(3, 2)), "b": (3, -3), "c": fmpq(1, 10)}
    # (1 + ε)·2 = 4 − 3 … with L = 1/4 the ratio would have to be clipped above 3/2.
    with pytest.raises(FileError, match="no ε gives this objective"):
        solved("ppo-clip", samples=[sample("3/4", 2), sample("3/4", -2)], objective="1/4")
    with pytest.raises(FileError, match="exactly one sample"):
        solved("ppo-clip", samples=[sample("3/4", 2), sample("3/4", 1)], objective=1)


def test_below_which_clipping_range_a_gradient_is_cut_off() -> None:
    # Ratios 3/2, 1/2 and 1/4 with the advantages 1, −1 and 1: the first two are cut off, up to 1/2 each, and go to
    # their advantages; the third keeps 1/4. The mean of 1, −1 and 1/4 is 1/12.
    answers = solved("ppo-clip", samples=[sample("3/4", 1), sample("1/4", -1), sample("1/8", 1)])
    assert answers["b"] == (fmpq(1, 2), fmpq(1, 2), 0)
    assert answers["c"] == fmpq(1, 12)


@pytest.mark.parametrize(("first", "second", "option"), [(1, 1, "B"), (-1, -1, "C"), (1, -1, "D"), (-1, 1, "A")])
def test_of_two_gradients_it_is_told_which_are_cut_off(first: int, second: int, option: str) -> None:
    # Ratios 3/2 and 1/2: a positive advantage is cut off above the range, a negative one below it.
    answers = solved("ppo-clip", samples=[sample("3/4", first), sample("1/4", second)], epsilon="1/5")
    assert answers["e"] == option


def test_samples_of_a_clipping_range_that_is_asked_for_are_different() -> None:
    for seed in range(25):
        samples = rldrill.draw("ppo-clip", 3, seed).solution.answers["a"]
        assert len(set(samples)) == len(samples)


def test_x_follows_from_how_often_actions_are_taken() -> None:
    # left: 2x, right: 3, stay: 1; left is twice as likely as right for x = 3, and then they are 6/10, 3/10 and 1/10.
    answers = solved(
        "softmax-policy", theta=["ln 2", "ln 3", "ln x"], odds=["left", "right", 2],
        features={"left": [1, 0, 1], "right": [0, 1, 0], "stay": [0, 0, 0]},
    )  # fmt: skip
    assert answers == {"a": 3, "b": {"left": fmpq(3, 5), "right": fmpq(3, 10), "stay": fmpq(1, 10)}}


def test_a_probability_follows_from_a_score() -> None:
    # The score of left is (1 − p)·(2, 3): 1/2 in the first place for p = 3/4; that of right is −3/4·(2, 3).
    answers = solved(
        "score-function", features={"left": [2, 3], "right": [0, 0]}, policy={"left": "p", "right": "1-p"},
        action="left", component=[1, "1/2"],
    )  # fmt: skip
    assert answers == {"a": fmpq(3, 4), "b": (fmpq(-3, 2), fmpq(-9, 4))}


def test_the_weight_at_which_the_greedy_action_changes() -> None:
    # θ = (w, 1): in s left is worth 2w and right 3, equal at 3/2; in t −w and w + 4, equal at −2. At w = 1 right wins.
    features = {"s": {"left": [2, 0], "right": [0, 3]}, "t": {"left": [-1, 0], "right": [1, 4]}}
    answers = solved("linear-policy", theta=["w", 1], features=features, at=1)
    assert answers == {"a": {"s": fmpq(3, 2), "t": -2}, "b": {"s": ("right",), "t": ("right",)}}


@pytest.mark.parametrize(
    ("name", "given_", "fragment"),
    [
        ("ppo-clip", {"samples": [SAMPLE], "epsilon": "1/5", "objective": 1}, "not both"),
        (
            "softmax-policy",
            {"theta": ["ln 2"], "features": {"a": [1], "b": [0]}, "odds": ["a", "b", 2]},
            "must be ln x",
        ),
        ("softmax-policy", {"theta": ["ln x"], "features": {"a": [1], "b": [0]}, "odds": ["a", "c", 2]}, "no features"),
        ("linear-policy", {"theta": ["w", 1], "features": FEATURES}, "at: give it where"),
        ("score-function", {"features": FEATURES["s"], "theta": [1, 1], "action": "left", "component": [1, 1]}, "1-p"),
    ],
)
def test_wrong_givens_of_what_is_sought(name: str, given_: Any, fragment: str) -> None:
    with pytest.raises(FileError) as error:
        family(name).read(given_)
    assert fragment in str(error.value)


def test_an_entropy_with_long_numbers_is_not_factored() -> None:
    # h = 500 ln 2 and 500 ln 3: nobody takes 2^500 + 3^500 apart into primes.
    answers = solved("softmax-policy", theta=["ln 2", "ln 3"], features={"a": [500, 0], "b": [0, 500]}, entropy=True)
    assert rounded(answers["c"], 3) == "0.000"


def test_the_entropy_of_a_policy_is_a_third_question() -> None:
    given = {"features": {"l": [1, 0], "r": [0, 1]}, "theta": [0, 0]}
    question = rldrill.read({"family": "softmax-policy", "given": given | {"entropy": True}})
    assert [part.label for part in question.parts] == ["a", "b", "c"]
    assert question.solve()["c"] == sympy.log(2)  # both actions with 1/2
    assert [part.label for part in rldrill.read({"family": "softmax-policy", "given": given}).parts] == ["a", "b"]


def test_the_logarithms_of_an_entropy_are_taken_apart_action_by_action() -> None:
    # exp(h) = 6, 2 and 1 of 9: probabilities 2/3, 2/9 and 1/9.
    features = {"l": [1, 1], "m": [1, 0], "r": [0, 0]}
    given = {"theta": ["ln 2", "ln 3"], "features": features, "entropy": True}
    working = rldrill.read({"family": "softmax-policy", "given": given}).working("c")
    lines = [" ".join(line.split()).strip("= ") for line in str(working).splitlines()]
    assert lines[-4:] == [
        "H = −(2/3·ln(2/3) + 2/9·ln(2/9) + 1/9·ln(1/9))",
        "−(2/3·(ln 2 − ln 3) + 2/9·(ln 2 − 2·ln 3) + 1/9·(−2·ln 3))",
        "−2/3·ln 2 + 2/3·ln 3 − 2/9·ln 2 + 4/9·ln 3 + 2/9·ln 3",
        "−8/9·ln 2 + 4/3·ln 3",
    ]


def test_a_factor_of_time_is_left_out_only_where_there_is_one() -> None:
    for name in ("reinforce", "reinforce-baseline", "actor-critic"):
        for level in (1, 2, 3):
            for seed in range(10):
                exercise = rldrill.draw(name, level, seed)
                question = " ".join(str(exercise.question()).split())
                assert ("no further factor" in question) == (exercise.problem.given.gamma != 1)  # type: ignore[attr-defined]


def test_the_gradient_with_a_baseline_is_stated_before_the_scores() -> None:
    for level in (1, 2, 3):
        for seed in range(6):
            working = str(rldrill.draw("reinforce-baseline", level, seed).working("b"))
            assert working.index("∇_θJ(θ) ≈ Σ") < working.index("h(s, a)")
            assert working.count("∇_θJ(θ) ≈ Σ") == 1


def test_the_weight_that_is_found_is_taken_for_what_it_is() -> None:
    for seed in range(40):
        exercise = rldrill.draw("softmax-policy", 3, seed)
        given_ = exercise.problem.given
        if given_.odds is None:  # type: ignore[attr-defined]
            continue
        place = list(map(str, given_.theta)).index("ln x") + 1  # type: ignore[attr-defined]
        x = exercise.solve()["a"]
        assert f"θ{'₀₁₂₃'[place]} = ln({x})" in str(exercise.working("b")).replace(f"ln {x}", f"ln({x})"), exercise.id


def test_of_two_values_one_is_the_greater_of_three_the_greatest() -> None:
    for name in ("linear-policy", "linear-value"):
        for level in (1, 2):
            for seed in range(10):
                exercise = rldrill.draw(name, level, seed)
                given_, working = exercise.problem.given, str(exercise.working())
                rows = getattr(given_, "actions", None) or next(iter(given_.features.values()))  # type: ignore[attr-defined]
                assert ("has the greatest value" in working) <= (len(rows) > 2), exercise.id
                assert ("has the greater value" in working) <= (len(rows) == 2), exercise.id


@pytest.mark.parametrize(
    ("new", "said"),
    [("2/5", "stays as it is"), ("3/5", "stays as it is"), ("61/100", "lies above"), ("39/100", "lies below")],
)
def test_a_ratio_on_the_border_is_not_clipped(new: str, said: str) -> None:
    # old 1/2 and ε = 1/5: the borders 4/5 and 6/5 are the ratios of 2/5 and 3/5
    sample = {"state": "rock", "action": "drift", "old": "1/2", "new": new, "advantage": 4}
    exercise = rldrill.read({"family": "ppo-clip", "given": {"samples": [sample], "epsilon": "1/5"}})
    assert any(said in block.text for block in exercise.working("b") if isinstance(block, Paragraph))
