"""Identities of Bayesian methods, and one sentence for what does not fit."""

from fractions import Fraction
from json import dumps, loads
from math import comb
from re import MULTILINE, findall
from typing import Any

import pytest
import sympy
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

import rldrill
from asking import solved
from rldrill.problems.draws import Draws
from rldrill.problems.errors import FileError
from rldrill.problems.scenes import SCENES
from rldrill.render.unicode import unicode_text
from rldrill.solutions.answers.judging import judge
from rldrill.solutions.drawing import draw
from rldrill.solutions.solution import solver

quick = settings(deadline=None, max_examples=25)
seeds = st.integers(0, 10_000)


@pytest.mark.parametrize("name", ["bayes-predict", "bayes-filter"])
@given(seed=seeds, level=st.integers(1, 3))
@quick
def test_beliefs_sum_to_one(name: str, seed: int, level: int) -> None:
    for belief in draw(name, level, seed).answers.values():
        assert not isinstance(belief, dict) or sum(belief.values()) == 1


@pytest.mark.parametrize("name", ["bayes-rule", "bayes-predict", "bayes-filter"])
@given(seed=seeds)
@quick
def test_a_probability_that_is_found_gives_the_outcome_it_was_found_from(name: str, seed: int) -> None:
    given_ = draw(name, 3, seed).problem.data()["given"]
    if "outcome" not in given_:
        return
    outcome, after = given_.pop("outcome"), given_.pop("after", 1)
    found = Fraction(str(draw(name, 3, seed).answers["a"]))
    filled = loads(dumps(given_).replace('"1-q"', f'"{1 - found}"').replace('"q"', f'"{found}"'))
    belief = solved(name, **filled)["ab"[after - 1]]
    assert belief[outcome["state"]] == fmpq(*Fraction(outcome["probability"]).as_integer_ratio())


#: Three steps over three states.
RUN: dict[str, Any] = {
    "belief": {"left": "1/2", "middle": "1/4", "right": "1/4"},
    "motion": {
        "go": {"left": {"left": "1/4", "middle": "3/4"}, "middle": {"middle": "1/2", "right": "1/2"},
               "right": {"right": 1}},
        "back": {"left": {"left": 1}, "middle": {"left": "2/3", "middle": "1/3"}, "right": {"middle": 1}},
    },
    "likelihood": {"door": {"left": "1/2", "middle": "1/4", "right": "1/8"},
                   "wall": {"left": "1/2", "middle": "3/4", "right": "7/8"}},
    "run": [{"action": "go", "measurement": "door"}, {"action": "back", "measurement": "wall"},
            {"action": "go", "measurement": "wall"}],
}  # fmt: skip


def test_what_is_read_next_is_predicted_by_hand() -> None:
    # The belief 1/2, 1/2 stays under "stay"; then it reads "on" with 1/2·3/4 + 1/2·1/4 = 1/2.
    ahead = solved(
        "bayes-filter",
        belief={"a": "1/4", "b": "3/4"},
        likelihood={"on": {"a": "3/4", "b": "1/4"}},
        run=[{"measurement": "on"}],
        ahead={"measurement": "on"},
    )
    assert ahead == {"a": {"a": fmpq(1, 2), "b": fmpq(1, 2)}, "b": fmpq(1, 2)}


def test_the_filter_over_a_run_is_the_joint_distribution_conditioned() -> None:
    paths = {(state,): Fraction(chance) for state, chance in RUN["belief"].items()}
    for event in RUN["run"]:
        rows, row = RUN["motion"][event["action"]], RUN["likelihood"][event["measurement"]]
        paths = {
            (*path, after): chance * Fraction(rows[path[-1]].get(after, 0)) * Fraction(row[after])
            for path, chance in paths.items()
            for after in RUN["belief"]
        }
    total = sum(paths.values())
    last = solved("bayes-filter", **RUN)["c"]
    for state in RUN["belief"]:
        share = sum(chance for path, chance in paths.items() if path[-1] == state) / total
        assert last[state] == fmpq(share.numerator, share.denominator)


def test_the_order_of_independent_measurements_does_not_matter() -> None:
    readings = [{"measurement": event["measurement"]} for event in RUN["run"]]
    forth, back = (solved("bayes-filter", **RUN | {"run": run}) for run in (readings, readings[::-1]))
    assert forth["c"] == back["c"]


def test_a_filter_that_only_moves_predicts_and_one_that_only_measures_is_bayes_rule() -> None:
    belief, motion, likelihood = (RUN[name] for name in ("belief", "motion", "likelihood"))
    actions, readings = ([event[name] for event in RUN["run"]] for name in ("action", "measurement"))
    moved = solved("bayes-filter", **RUN | {"run": [{"action": action} for action in actions]})
    assert moved == solved("bayes-predict", belief=belief, motion=motion, actions=actions)
    read = solved("bayes-filter", **RUN | {"run": [{"measurement": reading} for reading in readings]})
    assert read == solved("bayes-rule", prior=belief, likelihood=likelihood, measurements=readings)


MOTION = {"push": {"open": {"open": 1}, "closed": {"open": "4/5", "closed": "1/5"}}}
PREDICT: dict[str, Any] = {"belief": {"open": "1/2", "closed": "1/2"}, "motion": MOTION, "actions": ["push"]}
FILTER: dict[str, Any] = {"belief": PREDICT["belief"], "motion": MOTION, "run": [{"action": "push"}]}


@pytest.mark.parametrize(
    ("name", "given_", "fragment"),
    [
        ("bayes-predict", PREDICT | {"belief": {"open": 1, "closed": "1/2"}}, "belief: the probabilities sum to 3/2"),
        ("bayes-predict", PREDICT | {"actions": ["pull"]}, "an action is 'pull', of which motion says nothing"),
        ("bayes-predict", PREDICT | {"motion": {"push": {"open": {"open": 1}}}}, "'push' of 'closed' is missing"),
        (
            "bayes-predict",
            PREDICT | {"motion": {"push": MOTION["push"] | {"open": {"ajar": 1}}}},
            "motion of 'push' in 'open' is given for 'ajar'",
        ),
        (
            "bayes-predict",
            PREDICT | {"motion": {"push": MOTION["push"] | {"open": {"open": "p", "closed": "1/2"}}}},
            "motion of 'push' in 'open': the probabilities sum to 1/2 and what is left open",
        ),
        ("bayes-filter", FILTER | {"run": [{}]}, "neither an action nor a measurement"),
        ("bayes-filter", FILTER | {"run": [{"measurement": "light"}]}, "is 'light', of which likelihood says nothing"),
        ("bayes-filter", FILTER | {"likelihood": {"light": {"open": 1}}}, "'light' of 'closed' is missing"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_one_sentence(name: str, given_: dict[str, Any], fragment: str) -> None:
    with pytest.raises(FileError) as error:
        solved(name, **given_)
    assert fragment in str(error.value)
    assert "\n" not in str(error.value)


def test_a_reading_that_cannot_happen_is_one_sentence() -> None:
    blind = {"belief": {"open": 1, "closed": 0}, "likelihood": {"light": {"open": 0, "closed": 1}}}
    with pytest.raises(FileError, match="the measurement 'light' is impossible under the belief"):
        solved("bayes-filter", **blind, run=[{"measurement": "light"}])


counts = st.integers(1, 8)


@given(counts, counts)
@quick
def test_a_flat_prior_makes_the_most_probable_parameter_the_most_likely(heads: int, tails: int) -> None:
    answers = solved("model-fitting", coin={"heads": heads, "tails": tails, "a": 1, "b": 1})
    assert answers["a"] == answers["b"] == fmpq(heads, heads + tails)


@given(st.lists(st.integers(-9, 9), min_size=2, max_size=6))
@quick
def test_a_wide_prior_says_nothing_and_a_narrow_one_everything(values: list[int]) -> None:
    wide, narrow = ({"mean": 7, "variance": width, "noise": 1} for width in ("1e30", "1e-30"))
    answers = solved("model-fitting", sample={"values": values, "prior": wide})
    assert abs(answers["d"] - answers["a"]) < fmpq(1, 10**20)
    assert abs(solved("model-fitting", sample={"values": values, "prior": narrow})["d"] - 7) < fmpq(1, 10**20)
    assert answers["b"] * len(values) == answers["c"] * (len(values) - 1)


@given(st.lists(st.tuples(st.integers(-9, 9), st.integers(-9, 9)), min_size=3, max_size=6, unique_by=lambda p: p[0]))
@quick
def test_the_residuals_of_a_least_squares_line_are_orthogonal_to_it(points: list[tuple[int, int]]) -> None:
    answers = solved("model-fitting", line={"points": points, "prior": {"variance": 1, "noise": 1}})
    slope, intercept = answers["a"]
    residuals = [y - slope * x - intercept for x, y in points]
    assert sum(residuals) == 0
    assert sum(residual * x for residual, (x, _) in zip(residuals, points, strict=True)) == 0
    assert abs(answers["b"][0]) <= abs(slope)  # the prior draws it towards 0


@given(st.integers(1, 4), st.integers(1, 4), counts)
@quick
def test_evidences_of_all_sequences_sum_to_one(a: int, b: int, tosses: int) -> None:
    models = {"bent": {"a": a, "b": b}, "known": {"theta": "1/3"}}
    for name in models:
        total = fmpq(0)
        for heads in range(tosses + 1):
            given_ = {"models": models, "prior": {"bent": "1/2", "known": "1/2"}, "heads": heads}
            total += comb(tosses, heads) * solved("model-comparison", **given_, tails=tosses - heads)["a"][name]
        assert total == 1


@given(seeds, st.sampled_from([2, 3]))
@quick
def test_odds_and_posteriors_are_those_of_the_joint(seed: int, level: int) -> None:
    solution = draw("model-comparison", level, seed)
    if solution.problem.given.odds is not None:
        return
    prior = {name: fmpq(p.numerator, p.denominator) for name, p in solution.problem.given.prior.items()}
    joint = {name: evidence * prior[name] for name, evidence in solution.answers["a"].items()}
    if len(joint) == 2:
        first, second = joint.values()
        assert solution.answers["b"] == first / second
    else:
        assert solution.answers["b"] == {name: value / sum(joint.values()) for name, value in joint.items()}


@given(st.integers(2, 12), st.integers(0, 4), st.integers(0, 4))
@quick
def test_a_parameter_more_costs_the_logarithm_of_n(power: int, k: int, more: int) -> None:
    fitted = {name: {"likelihood": f"1/{2**power}", "k": count} for name, count in (("x", k), ("y", k + 1 + more))}
    criteria = solved("bic", fitted=fitted, n=16)["a"]
    assert sympy.simplify(criteria["y"] - criteria["x"] - 4 * (1 + more) * sympy.log(2)) == 0


@pytest.mark.parametrize(
    ("text", "right"),
    [
        # −2 ln(1/256) + 0 = 16 ln 2 = ln 65536 = 11.0903…
        ("16*log(2)", True), ("2 ln 256", True), ("log(65536)", True), ("11.1", True), ("11.09", True),
        ("-2*log(1/256)", True), ("11", False), ("16*log(3)", False),
    ],
)  # fmt: skip
def test_logarithms_are_read_in_every_form(text: str, right: bool) -> None:
    fitted = {"none": {"likelihood": "1/256", "k": 0}, "one": {"likelihood": "1/16", "k": 1}}
    exercise = rldrill.read({"family": "bic", "given": {"fitted": fitted, "n": 8}})
    one = "8*log(2) + log(8)"
    assert judge(exercise.solution, "a", f"none: {text}, one: {one}").accepted is right


COIN: dict[str, Any] = {"heads": 1, "tails": 2, "a": 2, "b": 2}
MODELS: dict[str, Any] = {
    "models": {"x": {}, "y": {"theta": "1/2"}}, "prior": {"x": "1/2", "y": "1/2"}, "heads": 1, "tails": 2,
}  # fmt: skip
FITTED = {"x": {"likelihood": "1/2", "k": 1}, "y": {"likelihood": "1/4", "k": 0}}


@pytest.mark.parametrize(
    ("name", "given_", "fragment"),
    [
        ("model-fitting", {}, "give one of coin, sample and line"),
        ("model-fitting", {"coin": COIN, "sample": {"values": [1, 2]}}, "give one of coin, sample and line"),
        ("model-fitting", {"coin": COIN | {"heads": 0, "tails": 0}}, "without a toss"),
        ("model-fitting", {"coin": COIN | {"a": "1/2"}}, "a and b must be at least 1"),
        ("model-fitting", {"line": {"points": [[1, 2], [1, 3]]}}, "all x are the same"),
        ("model-fitting", {"sample": {"values": [1]}}, "given.sample.values"),
        (
            "model-fitting",
            {"sample": {"values": [1, 2], "prior": {"variance": 0, "noise": 1}}},
            "variance and noise must be above 0",
        ),
        (
            "model-fitting",
            {"line": {"points": [[1, 2], [2, 3]], "prior": {"mean": 1, "variance": 1, "noise": 1}}},
            "must have the mean 0",
        ),
        ("model-comparison", MODELS | {"prior": {"x": 1}}, "prior of 'y' is missing"),
        ("model-comparison", MODELS | {"prior": {"x": 1, "y": 1}}, "sum to 2"),
        ("model-comparison", MODELS | {"heads": 0, "tails": 0}, "without a toss"),
        ("model-comparison", MODELS | {"models": {"x": {"a": 0}, "y": {}}}, "given.models.x.a"),
        ("bic", {"fitted": FITTED}, "n, the number of data, is needed"),
        ("bic", {"n": 8}, "give either fitted models or data"),
        ("bic", {"fitted": FITTED | {"x": {"likelihood": 0, "k": 1}}, "n": 8}, "likelihood is 0"),
        ("bic", {"data": {"tosses": {"red": [3, 0]}, "models": ["fair", "own"]}}, "tosses: 'red' needs from 1"),
        ("bic", {"data": {"tosses": {"red": [3, 1]}, "models": ["own", "own"]}}, "compared with itself"),
    ],
)
def test_data_that_do_not_fit_are_one_sentence(name: str, given_: dict[str, Any], fragment: str) -> None:
    with pytest.raises(FileError) as error:
        solved(name, **given_)
    assert fragment in str(error.value)
    assert "\n" not in str(error.value)


def two_steps(seed: int) -> dict[str, Any]:
    rng = Draws(f"kalman {seed}")
    steps = [{"u": int(rng.whole(-3, 6)), "z": int(rng.whole(-4, 12))} for _ in range(2)]
    mean, *noises = (int(rng.whole(1, 9)) for _ in range(4))
    return {"mean": mean, "steps": steps} | dict(zip(("covariance", "process", "sensor"), noises, strict=True))


def kalman(seed: int, **changed: Any) -> Any:
    return solved("kalman-filter", **two_steps(seed) | changed)


@given(seeds)
@quick
def test_a_sensor_that_knows_nothing_keeps_the_prediction(seed: int) -> None:
    answers = kalman(seed, sensor="1e30")
    for predicted, corrected in (("a", "b"), ("c", "d")):
        for before, after in zip(answers[predicted], answers[corrected], strict=True):
            assert abs(before - after) < fmpq(1, 10**20)


@given(seeds)
@quick
def test_a_perfect_sensor_is_believed_and_the_variance_never_grows_by_measuring(seed: int) -> None:
    answers = kalman(seed, sensor="1e-30")
    for label, event in zip("bd", two_steps(seed)["steps"], strict=True):
        assert abs(answers[label][0] - event["z"]) < fmpq(1, 10**20)
    answers = kalman(seed)
    assert answers["b"][1] < answers["a"][1]
    assert answers["d"][1] < answers["c"][1]


@given(seeds)
@quick
def test_precisions_add(seed: int) -> None:
    solution = draw("kalman-filter", 1, seed)
    sensor = solution.problem.given.sensor[0][0]
    assert 1 / solution.answers["b"][1] == 1 / solution.answers["a"][1] + fmpq(sensor.denominator, sensor.numerator)


@given(seeds)
@quick
def test_the_order_of_two_measurements_without_motion_between_does_not_matter(seed: int) -> None:
    still = [{"u": 0, "z": event["z"]} for event in two_steps(seed)["steps"]]
    forth, back = (kalman(seed, process=0, steps=steps) for steps in (still, still[::-1]))
    assert forth["d"] == back["d"]


@given(seeds)
@quick
def test_covariances_stay_symmetric(seed: int) -> None:
    answers = draw("kalman-filter", 3, seed).answers
    for label in "be" if "e" in answers else "":
        assert answers[label] == answers[label].transpose()


KALMAN: dict[str, Any] = {"mean": 1, "covariance": 2, "process": 1, "sensor": 1, "steps": [{"u": 1, "z": 2}]}


@pytest.mark.parametrize(
    ("changed", "fragment"),
    [
        ({"covariance": -1}, "covariance must be positive semidefinite"),
        ({"process": -1}, "process must be positive semidefinite"),
        ({"sensor": 0}, "sensor must be positive definite"),
        ({"mean": [[1], [2]]}, "covariance is 1×1, but with a mean of 2 and 1 reading it must be 2×2"),
        ({"steps": [{"u": [[1], [2]], "z": 1}]}, "u is 2×1"),
        ({"steps": [{"u": 1, "z": [[1], [2]]}]}, "z is 2×1"),
    ],
)
def test_models_that_do_not_fit_are_one_sentence(changed: dict[str, Any], fragment: str) -> None:
    with pytest.raises(FileError) as error:
        solved("kalman-filter", **KALMAN | changed)
    assert fragment in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(("level", "seed"), [(level, seed) for level in (1, 2) for seed in range(8)])
def test_a_measurement_tells_something(level: int, seed: int) -> None:
    exercise = rldrill.draw("bayes-rule", level, seed)
    prior = {name: fmpq(p.numerator, p.denominator) for name, p in exercise.problem.given.prior.items()}  # type: ignore[attr-defined]
    assert list(exercise.solve().values())[-1] != prior


@pytest.mark.parametrize(("noises", "w"), [({"process": "w", "sensor": 3}, 4), ({"process": 4, "sensor": "w"}, 3)])
def test_the_variance_of_either_noise_is_found_from_that_after_the_measurement(noises: dict[str, Any], w: int) -> None:
    # Σ̄ = 2 + 4 = 6, K = 6/(6 + 3) = 2/3: Σ = (1 − 2/3)·6 = 2, μ = 3 + 2/3·(6 − 3) = 5.
    given_ = {"mean": 1, "covariance": 2, **noises, "steps": [{"u": 2, "z": 6}], "variance": 2}
    exercise = rldrill.read({"family": "kalman-filter", "given": given_})
    assert list(exercise.solve().values()) == [w, 5]
    assert solver(exercise.problem.family).oracle(exercise.problem.given) == pytest.approx([w, 5])


def test_a_variance_by_the_other_divisor_is_recognised_both_ways() -> None:
    sample = {"values": [1, 2, 6]}  # mean 3, squares 4 + 1 + 9 = 14
    exercise = rldrill.read({"family": "model-fitting", "given": {"sample": sample}})
    assert exercise.solve()["b"] == fmpq(14, 3)
    assert [m.name for m in exercise.check("7", "b").misconceptions] == ["n-minus-1-for-n"]
    assert [m.name for m in exercise.check("14/3", "c").misconceptions] == ["n-for-n-minus-1"]


def test_no_measurement_is_as_it_was_predicted() -> None:
    """Else the gain would not matter for the mean."""
    for seed in range(40):
        given_: Any = draw("kalman-filter", 3, seed).problem.given
        if len(given_.mean) == 2:
            (place,), (velocity,) = given_.mean
            assert given_.steps[0].z[0][0] not in (place, place + velocity)


def test_of_two_models_one_is_the_more_probable_of_three_the_most() -> None:
    for seed in range(12):
        for level in (1, 2, 3):
            exercise = rldrill.draw("model-comparison", level, seed)
            two = len(exercise.problem.given.models) == 2  # type: ignore[attr-defined]
            said = " ".join([part.ask for part in exercise.parts] + [str(exercise.working())])
            assert ("most probable model" if two else "more probable model") not in said


def test_the_letters_of_the_tosses_are_in_the_question() -> None:
    """n₁ and n₀ of the formulas are told where the tosses are."""
    for name in ("model-comparison", "bic", "model-fitting"):
        for seed in range(12):
            exercise = rldrill.draw(name, 2, seed)
            question, working = str(exercise.question()), str(exercise.working())
            assert ("n₁" in working) <= ("n₁" in question or "n_(1,c)" in question), exercise.id


def test_the_factorials_of_an_evidence_are_known_by_heart() -> None:
    for seed in range(15):
        for level in (2, 3):
            working = str(rldrill.draw("model-comparison", level, seed).working("a"))
            assert max(map(int, findall(r"\d+", working))) <= 720


def test_likelihoods_are_of_a_model_that_is_named_and_their_logarithms_are_taken_apart() -> None:
    for level in (2, 3):
        for seed in range(25):
            exercise = rldrill.draw("bic", level, seed)
            given_, working = exercise.problem.given, str(exercise.working())
            assert "ln p(shared)" not in working
            assert not findall(r"≈ -?\d+(?![.\d])", working.replace("−", "-")), exercise.id
            if given_.data is None:  # type: ignore[attr-defined]
                continue
            question = str(exercise.question())
            assert ("n counts all of them" in question) == (given_.criterion == "BIC")  # type: ignore[attr-defined]
            for name in given_.names:  # type: ignore[attr-defined]
                lines = working.split(f"ln p(D_z|{name}, θ̂) = ")[1].split("\n\n")[0].splitlines()
                together, apart, _ = [line for line in lines if line.strip().startswith("=")]  # and the sum of these
                assert "1 − " not in together, exercise.id
                assert "ln(" not in apart, exercise.id


def test_heads_of_all_coins_are_added_and_every_coin_has_its_own_estimate() -> None:
    working = str(rldrill.read({"family": "bic", "given": {"data": {
        "tosses": {"red": [16, 2], "blue": [2, 4]}, "models": ["shared", "own"],
    }}}).working("a"))  # fmt: skip
    assert "n₁ = 16 + 2 = 18 heads and n₀ = 2 + 4 = 6 tails of all coins" in working
    assert "θ̂_(red) = 16/(16 + 2)" in working
    assert "= 18·ln(3/4) + 6·ln(1/4)" in working
    assert "ln(8/9) = 3 ln 2 − 2 ln 3" in working


@pytest.mark.parametrize("level", [1, 2, 3])
def test_what_a_sensor_reads_fits_the_place(level: int) -> None:
    """The wider a door is open the more light there is, the deeper in a crater the less."""
    for seed in range(40):
        given_ = draw("bayes-filter", level, seed).problem.given
        for scene in SCENES:
            if scene.told == given_.story and scene.trend:
                for reading, row in given_.likelihood.items():
                    way = scene.trend if reading == scene.readings[0] else -scene.trend
                    assert list(row.values()) == sorted(row.values(), reverse=way < 0)


def test_what_stands_below_the_line_of_posteriors_is_added_up_before() -> None:
    for seed in range(20):
        for level in (2, 3):
            exercise = rldrill.draw("model-comparison", level, seed)
            if len(exercise.problem.given.models) > 2:  # type: ignore[attr-defined]
                working = str(exercise.working("b"))
                total = findall(r"= (\d+/\d+) *$", working.split("p(M|D_z)")[0], MULTILINE)[-1]
                assert f"({total})" in working, exercise.id


def test_a_uniform_prior_needs_one_integral() -> None:
    flat = {"models": {"x": {}, "y": {"theta": "1/2"}}, "prior": {"x": "1/2", "y": "1/2"}, "heads": 0, "tails": 2}
    exercise = rldrill.read({"family": "model-comparison", "given": flat})
    assert exercise.solve()["a"]["x"] == fmpq(1, 3)
    assert "(0!2!)/((0 + 2 + 1)!)" in str(exercise.working("a"))


@pytest.mark.parametrize(("actions", "labels"), [(["go"], ""), (["go", "go"], "1 1 1 2 2")])
def test_steps_are_numbered_where_there_is_more_than_one(actions: list[str], labels: str) -> None:
    # In the first the letter is found; then both states are worked out in the first and in the second.
    motion = {"go": {"a": {"a": "1/2", "b": "1/2"}, "b": {"b": 1}}}
    given_ = {"belief": {"a": "q", "b": "1-q"}, "motion": motion, "actions": actions,
              "outcome": {"state": "b", "probability": "3/4"}}  # fmt: skip
    exercise = rldrill.read({"family": "bayes-predict", "given": given_})
    written = "\n".join(unicode_text(block) for block in exercise.working())
    assert " ".join(findall(r"step (\d)", written)) == labels


def test_a_step_without_a_measurement_is_not_asked_before_one() -> None:
    steps = [{"u": [[1]]}, {"u": [[2]], "z": [[7]]}]
    given_ = {"mean": [[0]], "covariance": [[1]], "process": [[2]], "sensor": [[3]], "steps": steps}
    exercise = rldrill.read({"family": "kalman-filter", "given": given_})
    assert "Where zₜ is –, nothing is measured." in " ".join(str(exercise.question()).split())
    asked = [part.ask for part in exercise.parts]
    assert asked[0].endswith("after the motion of step $1$?")
    assert asked[1].endswith("after the motion of step $2$, before the measurement?")
    assert "nothing is measured" not in str(rldrill.draw("kalman-filter", 1, 1).question())
