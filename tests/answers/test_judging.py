"""The rule for answers, and the verdicts that come of it."""

from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
import sympy
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

import rldrill
from numbers_drawn import small
from rldrill.grading.answers_file import Entry
from rldrill.grading.marking import Judging, Rules
from rldrill.problems.catalogue import families, family
from rldrill.problems.family import Problem
from rldrill.problems.parts import Numbers, Policy, Values
from rldrill.render.mathematics.unicode import unicode
from rldrill.solutions.answers.judging import Outcome, Verdict, judge
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.answers.rule import apart, equivalent, is_close, is_right, tolerance, within
from rldrill.solutions.answers.text import read_number
from rldrill.solutions.drawing import draw
from rldrill.solutions.exact import parameters, to_sympy
from rldrill.solutions.rational import generator
from rldrill.solutions.solution import Solution, solve

RACING_CAR = {
    "gamma": 1,
    "sweeps": 2,
    "mdp": {
        "transitions": [
            ["cool", "slow", "cool", 1, 1], ["cool", "fast", "cool", 0.5, 2], ["cool", "fast", "warm", 0.5, 2],
            ["warm", "slow", "cool", 0.5, 1], ["warm", "slow", "warm", 0.5, 1], ["warm", "fast", "overheated", 1, -10],
        ],
        "terminal": ["overheated"],
    },
}  # fmt: skip


def problem(name: str, **given_: object) -> Solution:
    found = family(name)
    return solve(Problem(found, found.read(given_)))


@pytest.mark.parametrize(
    ("value", "half_a_unit"),
    [
        # 7/2 = 3.50: the third digit counts hundredths. 1234: tens. 0.00456: hundred-thousandths.
        (fmpq(7, 2), fmpq(1, 200)), (fmpq(1234), fmpq(5)), (fmpq(456, 100000), fmpq(1, 200000)),
        (fmpq(0), fmpq(1, 2000)), (fmpq(1), fmpq(1, 200)), (fmpq(999, 1000), fmpq(1, 2000)),
        (fmpq(-10), fmpq(1, 20)), (sympy.exp(3), fmpq(1, 20)), (sympy.sqrt(2), fmpq(1, 200)),
        (fmpq(1234, 10), fmpq(1, 2)), (fmpq(1234, 10**6), fmpq(5, 10**6)), (fmpq(9996, 10), fmpq(1, 2)),
        (fmpq(1000), fmpq(5)), (fmpq(1, 1000), fmpq(5, 10**6)), (fmpq(1, 10), fmpq(1, 2000)),
        # 1 in 10^86 below or above 100 decides, and which side zero is on does not.
        (100 - sympy.exp(-200), fmpq(1, 20)), (100 + sympy.exp(-200), fmpq(1, 2)), (-sympy.exp(3), fmpq(1, 20)),
    ],
)  # fmt: skip
def test_the_tolerance_is_half_a_unit_of_the_third_digit(value: object, half_a_unit: fmpq) -> None:
    assert tolerance(value) == half_a_unit


@pytest.mark.parametrize(
    ("text", "key", "right"),
    [
        ("3.495", fmpq(7, 2), True), ("3.505", fmpq(7, 2), True),  # the bounds are included
        ("3.4949", fmpq(7, 2), False), ("3.5051", fmpq(7, 2), False),
        ("0.333", fmpq(1, 3), True), ("0.33", fmpq(1, 3), False), ("0.33333", fmpq(1, 3), True),
        ("1/3", fmpq(1, 3), True),
        ("0.0005", fmpq(0), True), ("0.00051", fmpq(0), False), ("-0.0005", fmpq(0), True),
        ("20.1", sympy.exp(3), True), ("20", sympy.exp(3), False), ("e^3", sympy.exp(3), True),
        ("2 + 1/2*(-1 + 0.9*4 - 2)", fmpq(23, 10), True),
    ],
)  # fmt: skip
def test_the_rule_at_its_bounds(text: str, key: object, right: bool) -> None:
    reading = read_number(text)
    assert is_right(reading.value, key, rounded=reading.decimal) is right


@pytest.mark.parametrize(
    ("text", "right"),
    [
        ("1/(1-gamma)", True), ("-1/(gamma - 1)", True), ("(1+γ)/(1-γ^2)", True), ("1 + gamma", False),
        ("1.0/(1-gamma)", True), ("1.0002/(1-gamma)", True), ("1.01/(1-gamma)", False), ("1", False),
        # Agrees with the key at seven points that somebody might think are the ones compared.
        ("1.0/(1-gamma) + 100000*(γ-1/7)*(γ-3/11)*(γ-5/13)*(γ-9/17)*(γ-13/19)*(γ-19/23)*(γ-1/2)", False),
        ("1/(1-gamma) + sqrt(γ)*(γ-1/7)*(γ-3/11)*(γ-5/13)*(γ-9/17)*(γ-13/19)*(γ-19/23)", False),
    ],
)  # fmt: skip
def test_expressions_are_judged_by_equivalence(text: str, right: bool) -> None:
    reading = read_number(text, ["gamma"])
    assert is_right(reading.value, 1 / (1 - generator("gamma")), rounded=reading.decimal) is right


@pytest.mark.parametrize(
    ("value", "key", "close"),
    [
        (fmpq(102), fmpq(100), True), (fmpq(98), fmpq(100), True),  # 2 % of 100 is 2, the bounds included
        (fmpq(1020001, 10000), fmpq(100), False), (fmpq(979999, 10000), fmpq(100), False),
        (fmpq(-51), fmpq(-50), True), (fmpq(-49), fmpq(-50), True), (fmpq(-511, 10), fmpq(-50), False),
        (fmpq(50), fmpq(-50), False), (fmpq(0), fmpq(0), False), (fmpq(1, 10**9), fmpq(0), False),
        (sympy.sqrt(2) * fmpq(102, 100), sympy.sqrt(2), True), (sympy.exp(3), 1 + sympy.exp(3), False),
        (generator("gamma"), generator("gamma"), False), (fmpq(1), generator("gamma"), False),
        (generator("gamma"), fmpq(1), False),
    ],
)  # fmt: skip
def test_close_is_within_two_percent(value: object, key: object, close: bool) -> None:
    assert is_close(value, key) is close


@pytest.mark.parametrize(
    ("value", "key", "bound", "inside"),
    [
        (fmpq(1), fmpq(3), fmpq(2), True), (fmpq(3), fmpq(1), fmpq(2), True), (fmpq(1), fmpq(1), fmpq(0), True),
        (fmpq(1), fmpq(301, 100), fmpq(2), False), (fmpq(301, 100), fmpq(1), fmpq(2), False),
        (sympy.sqrt(2), fmpq(0), fmpq(141421, 10**5), False), (sympy.sqrt(2), fmpq(0), fmpq(141422, 10**5), True),
    ],
)  # fmt: skip
def test_a_bound_is_within_itself(value: object, key: object, bound: fmpq, inside: bool) -> None:
    assert within(value, key, bound) is inside


def test_answers_are_apart_where_their_tolerances_do_not_meet() -> None:
    # Both have a tolerance of 0.005: at a distance of 0.01 one number rounds to both.
    assert not apart(fmpq(1), fmpq(101, 100))
    assert apart(fmpq(1), fmpq(1010001, 10**6))
    assert not apart(sympy.exp(1), sympy.exp(1))
    gamma = generator("gamma")
    assert apart(gamma, gamma + fmpq(1, 10**9))
    assert apart(gamma, fmpq(1))
    assert not apart(sympy.exp(sympy.Symbol("sigma")) ** 2, sympy.exp(2 * sympy.Symbol("sigma")))


gamma_functions = st.builds(
    lambda a, b, c: (a + b * generator("gamma")) / (c + generator("gamma")),
    st.integers(-9, 9),
    st.integers(1, 9),
    st.integers(1, 9),
).filter(parameters)


@given(gamma_functions, gamma_functions)
@settings(deadline=None, max_examples=40)
def test_only_decimals_may_be_off_in_an_expression(key: Any, other: Any) -> None:
    assert equivalent(key, key) is True
    assert is_right(key, key, rounded=False)
    assert equivalent(key, other) is (to_sympy(key) - to_sympy(other)).equals(0)
    slightly = key * fmpq(100001, 100000)  # a thousandth of a percent is within half a unit of the third digit
    assert not equivalent(slightly, key)
    assert is_right(slightly, key, rounded=True)
    assert not is_right(slightly, key, rounded=False)
    assert not is_right(key * fmpq(102, 100), key, rounded=True)


@given(st.lists(small(-30, 30, 12), min_size=2, max_size=4).filter(lambda all_: any(all_[1:])))
def test_an_expression_is_right_with_each_of_its_numbers_rounded(numbers: list[Fraction]) -> None:
    terms = " + ".join(f"({number})*x^{power}" for power, number in enumerate(numbers))
    rounded = " + ".join(f"({float(number):.3g})*x^{power}" for power, number in enumerate(numbers))
    assert is_right(read_number(rounded, ["x"]).value, read_number(terms, ["x"]).value)


def test_two_letters_are_not_one() -> None:
    key = read_number("ln(gamma) + ln(x)", ["gamma", "x"]).value
    assert equivalent(read_number("ln(gamma x)", ["gamma", "x"]).value, key)
    for text in ("2 ln(x)", "2 ln(gamma)", "2.0 ln(x)"):
        reading = read_number(text, ["gamma", "x"])
        assert not is_right(reading.value, key, rounded=reading.decimal)


def test_a_number_is_no_function() -> None:
    assert not is_right(fmpq(1, 2), generator("gamma"), rounded=True)
    assert not is_right(generator("gamma"), fmpq(1, 2), rounded=True)
    assert not equivalent(generator("gamma"), generator("lambda"))


@pytest.mark.parametrize("text", ["ln(gamma - 1)", "sqrt(gamma - 1)", "ln(gamma - 2) + sqrt(gamma)"])
def test_what_is_not_real_between_0_and_1_is_no_answer(text: str) -> None:
    reading = read_number(text, ["gamma"])
    assert not is_right(reading.value, 1 / (1 - generator("gamma")), rounded=reading.decimal)


def test_what_no_proof_decides_is_compared_in_a_thousand_bits() -> None:
    assert equivalent(read_number("ln(gamma^2)", ["gamma"]).value, read_number("2 ln(gamma)", ["gamma"]).value)
    assert not equivalent(
        read_number("ln(gamma^2)", ["gamma"]).value, read_number("2 ln(gamma) + 1/10^30", ["gamma"]).value
    )


@given(st.fractions(-1000, 1000, max_denominator=500).filter(bool))
def test_rounding_to_three_digits_is_always_right(value: Fraction) -> None:
    key = fmpq(value.numerator, value.denominator)
    assert is_right(read_number(f"{float(value):.3g}").value, key)
    assert is_right(read_number(str(value)).value, key)
    assert not is_right(key + 3 * tolerance(key), key)


@pytest.mark.parametrize("name", families())
def test_every_kind_judges_its_own_samples(name: str) -> None:
    for level in family(name).levels:
        for seed in range(4):
            solution = draw(name, level, seed)
            for part in solution.problem.parts:
                samples = answer_kind(part.kind).samples(solution.answers[part.label])
                for text in samples.right:
                    assert judge(solution, part.label, text).outcome is Outcome.RIGHT, text
                for text in samples.wrong:
                    assert not judge(solution, part.label, text).accepted, text
                for text in samples.unreadable:
                    verdict = judge(solution, part.label, text)
                    assert verdict.outcome is Outcome.UNREADABLE, text
                    assert verdict.says


@pytest.mark.parametrize("name", families())
def test_answers_are_read_as_they_are_printed(name: str) -> None:
    for level in family(name).levels:
        solution = draw(name, level, 11)
        for part in solution.problem.parts:
            if isinstance(part.kind, Values | Numbers | Policy):
                lines = answer_kind(part.kind).lines(solution.answers[part.label])
                printed = "; ".join(
                    f"{unicode(left)} = {unicode(right)}" if left else unicode(right) for left, right in lines
                )
                assert judge(solution, part.label, printed).outcome is Outcome.RIGHT, printed


def verdicts(*typed: str) -> list[Verdict]:
    """The verdicts of answers to (a), (b), … of the racing car, each going on from the ones before."""
    solution = problem("value-iteration", **RACING_CAR)
    earlier: dict[str, object] = {}
    found = []
    for part, text in zip(solution.problem.parts, typed, strict=False):
        found.append(judge(solution, part.label, text, earlier))
        earlier[part.label] = found[-1].value
    return found


def test_right_in_all_ways_of_typing() -> None:
    for text in (
        "cool: 7/2, warm: 5/2",
        "3.5 2.5".replace(" ", ", "),
        "warm = 2.50; cool = 3 1/2",
        "V(cool)=3.5, V(warm)=2.5",
    ):
        assert verdicts(text)[0].outcome is Outcome.RIGHT, text


def test_a_typical_mistake_is_named() -> None:
    # One sweep more in place: V1(cool) = 2, V1(warm) = max(1/2·(1+2) + 1/2·(1+0), −10) = 2, then
    # V2(cool) = max(1+2, 1/2·(2+2) + 1/2·(2+2)) = 4, V2(warm) = 1/2·(1+4) + 1/2·(1+2) = 4.
    verdict = verdicts("cool: 4, warm: 4")[0]
    assert verdict.outcome is Outcome.MISCONCEPTION
    assert [m.name for m in verdict.misconceptions] == ["in-place"]


def test_a_word_proves_none_of_several_mistakes() -> None:
    tables = (judge(draw("markov-property", 1, seed), "b", "no") for seed in range(60))
    no = next(verdict for verdict in tables if len(verdict.misconceptions) > 1)
    assert (no.outcome, no.says, no.told) == (Outcome.WRONG, "Not right.", ())
    policies = (draw("linear-policy", 1, seed) for seed in range(60))
    chosen = (judge(policy, "b", other(policy)) for policy in policies)
    action = next(verdict for verdict in chosen if len(verdict.misconceptions) > 1)
    assert action.outcome is Outcome.MISCONCEPTION
    assert action.says == action.misconceptions[0].says


def other(policy: Solution) -> str:
    """Another action than the best one, in a policy of one state."""
    ((state, (best,)),) = policy.answers["b"].items()
    return next(action for action in policy.problem.given.features[state] if action != best)  # type: ignore[attr-defined]


def test_a_word_names_the_only_mistake_that_fits() -> None:
    diagram = judge(draw("backup-diagram-name", 1, 1), "a", "a")
    assert diagram.outcome is not Outcome.MISCONCEPTION or diagram.says == diagram.misconceptions[0].says
    yes = judge(draw("ppo-clip", 1, 11), "d", "yes")
    assert "Or:" not in yes.says


def test_part_of_a_table_earns_part_of_the_points() -> None:
    verdict = verdicts("cool: 3.5, warm: 9")[0]
    assert verdict.outcome is Outcome.WRONG
    assert verdict.credit == Fraction(1, 2)
    assert verdict.wrong_cells == ("warm",)


def test_a_slip_costs_once() -> None:
    # With V2 = (0, 50) the greedy action in cool is fast (2 + 25 > 1) and in warm slow (1 + 25 > −10);
    # with V2 = (50, 0) it is slow in cool (51 > 27).
    wrong, follows = verdicts("cool: 50, warm: 0", "cool: slow, warm: slow")
    assert wrong.outcome is Outcome.WRONG
    assert follows.outcome is Outcome.FOLLOW_THROUGH
    assert follows.credit == 1


_CLOSE = "Close, but not right: look for a slip, or for numbers that were rounded on the way."


#: R₁ = 8 and R₀ = −1 + 3/4·8 = 5; V(reef) = −2 + 1/2·7 = 3/2 and V(bay) = 4 + 1/2·4 = 6.
BAY = {
    "trajectory": {"states": ["reef", "bay", "harbour"], "rewards": [-1, 8], "terminal": ["harbour"]},
    "values": {"reef": -2, "bay": 4},
    "alpha": "1/2",
    "gamma": "3/4",
    "visits": "every",
}
_GOES_ON = "Right, going on from your earlier answer."


@pytest.mark.parametrize(
    ("typed", "credit", "says", "wrong"),
    [
        # From the returns 1 and 10: V(reef) = −2 + 1/2·3 = −1/2 and V(bay) = 4 + 1/2·6 = 7.
        ("reef: -1/2, bay: 7", 1, _GOES_ON, ()),
        ("reef: 3/2, bay: 7", 1, _GOES_ON, ()),
        ("reef: 3/2, bay: 6", 1, "Right.", ()),
        ("reef: 3/2, bay: 9", Fraction(1, 2), "Not right at bay; the rest is right.", ("bay",)),
        (
            "reef: -1/2, bay: 9",
            Fraction(1, 2),
            "Not right at bay; the rest is right, going on from your earlier answer.",
            ("bay",),
        ),
        ("reef: 8, bay: 9", 0, "Not right.", ("reef", "bay")),
        ("reef: -1/2, bay: 7.1", Fraction(1, 2), _CLOSE, ("bay",)),
        (
            "reef: -1/2",
            Fraction(1, 2),
            "Not right at bay (left out); the rest is right, going on from your earlier answer.",
            ("bay",),
        ),
    ],
)
def test_every_number_is_right_or_goes_on(typed: str, credit: Fraction, says: str, wrong: tuple[str, ...]) -> None:
    solution = problem("monte-carlo", **BAY)
    verdict = judge(solution, "b", typed, {"a": judge(solution, "a", "1, 10").value})
    assert (verdict.credit, verdict.says, verdict.wrong_cells) == (credit, says, wrong)


def test_what_goes_on_earns_its_share_wherever_it_is_graded() -> None:
    # From the returns 1 and 10 V(reef) is −1/2; the value of bay is neither 6 nor 7.
    given_ = rldrill.Exercise(problem("monte-carlo", **BAY))
    texts = {"a": "1, 10", "b": "reef: -1/2, bay: 9"}
    graded = given_.grade(texts)
    assert graded["b"].points == Fraction(graded["b"].of, 2)
    entries = {part: Entry("", "bay", part, text, None, Path("bay.csv")) for part, text in texts.items()}
    (_, _, judged) = Judging(given_, Rules(), {}).marks(entries)[1]
    assert judged.score.points == graded["b"].points
    assert judged.reason.startswith("Not right at bay; the rest is right, going on from your earlier answer.")


@pytest.mark.parametrize(
    ("typed", "credit", "says"),
    [
        # By V2 = (100, −200) it is slow in cool (101 > 2 − 50) and fast in warm (−10 > 1 − 50); right is fast, slow.
        ("cool: slow, warm: fast", 1, _GOES_ON),
        ("cool: fast, warm: slow", 1, "Right."),
        ("cool: slow, warm: slow", 0, "Not right at cool; the rest is right."),
        ("cool: fast, warm: fast", 0, "Not right at warm; the rest is right."),
    ],
)
def test_of_two_actions_not_both_are_right(typed: str, credit: int, says: str) -> None:
    _, verdict = verdicts("cool: 100, warm: -200", typed)
    assert (verdict.credit, verdict.says) == (credit, says)


def test_a_policy_goes_on_as_a_whole() -> None:
    # By V2 = (50, 0) it is slow in both: 51 > 2 + 25 and 1 + 25 > −10; right is fast in cool.
    _, verdict = verdicts("cool: 50, warm: 0", "cool: slow, warm: fast")
    assert verdict.says == "At warm this does not go on from your earlier answer; the rest does."
    assert (verdict.credit, verdict.wrong_cells) == (0, ("warm",))


def test_close_says_so_and_earns_nothing() -> None:
    solution = problem("return", rewards=[1, 1, 1], gamma="1/3", time=0)  # 13/9 = 1.444…
    verdict = judge(solution, "a", "1.46")
    assert verdict.outcome is Outcome.CLOSE
    assert verdict.credit == 0


_FEW = "there are too few digits, give three or an exact value"


@pytest.mark.parametrize(
    ("typed", "says"),
    [
        ("-13, 3.3, 0.1", "Right idea; give an exact value or three digits."),
        ("-13, 3.3, 0.2", f"Not right at c; at a and b {_FEW}."),
        ("-12.54, 3.3, 0.2", f"Not right at c; at b {_FEW}; the rest is right."),
        ("-12.54, 3.32, 0.1", "Not right at c; the rest is right."),  # no other entry is rounded so
        ("-13, 3.4, 0.1", "Not right."),
        ("-12, 3.3, 0.1", f"Not right at a; at b and c {_FEW}."),
        ("-13, 3, 0.1", "Not right."),
    ],
)
def test_entries_with_too_few_digits_are_parted_from_those_that_are_off(typed: str, says: str) -> None:
    # With α = γ = 1 and V = 0 the values are the returns: 0.06, 3.26 + 0.06 and −15.86 + 3.32.
    run = {"states": ["a", "b", "c", "end"], "rewards": ["-15.86", "3.26", "0.06"], "terminal": ["end"]}
    solution = problem("monte-carlo", trajectory=run, values=dict.fromkeys("abc", 0), alpha=1, gamma=1, visits="every")
    verdict = judge(solution, "b", typed)
    assert verdict.says == says
    assert not verdict.accepted


@pytest.mark.parametrize("odd", ["800, 0", "2, 1e40", "-1e40, 1e40"])
def test_an_odd_earlier_answer_breaks_nothing(odd: str) -> None:
    solution = problem("softmax-policy", theta=["1"], features={"left": ["1"], "right": ["2"]})
    earlier = {"a": judge(solution, "a", odd).value}
    assert not judge(solution, "b", "0.5, 0.4", earlier).accepted
    assert judge(solution, "b", "e/(e + e^2), e^2/(e + e^2)", earlier).accepted


def test_unreadable_says_what_and_keeps_nothing() -> None:
    verdict = verdicts("cool: 3,5; warm: 2,5")[0]
    assert verdict.outcome is Outcome.UNREADABLE
    assert "3.5" in verdict.says
    assert verdict.value is None


def test_any_of_tied_actions_is_right() -> None:
    # Both actions of "a" end the episode with reward 1.
    tied = {"transitions": [["a", "left", "end", 1, 1], ["a", "right", "end", 1, 1]], "terminal": ["end"]}
    solution = problem("value-iteration", gamma=1, sweeps=1, mdp=tied)
    assert {judge(solution, "b", f"a: {action}").outcome for action in ("left", "right")} == {Outcome.RIGHT}


def test_the_set_of_tied_actions_is_right_and_no_other() -> None:
    # "left" and "right" end the episode with reward 1, "wait" with 0.
    moves = [["a", "left", "end", 1, 1], ["a", "right", "end", 1, 1], ["a", "wait", "end", 1, 0]]
    solution = problem("value-iteration", gamma=1, sweeps=1, mdp={"transitions": moves, "terminal": ["end"]})
    for text in ("a: left or right", "left, right", "{left, right}", "a: right/left", '{"a": ["left", "right"]}'):
        verdict = judge(solution, "b", text)
        assert (verdict.outcome, verdict.read) == (Outcome.RIGHT, "a: left or right"), text
    for text in ("a: left or wait", "left, right, wait"):
        assert judge(solution, "b", text).outcome is Outcome.WRONG, text


def test_a_terminal_state_may_be_given_its_zero() -> None:
    assert verdicts("cool: 3.5, warm: 2.5, overheated: 0")[0].outcome is Outcome.RIGHT
    assert verdicts("3.5, 2.5, 0", "fast, slow, -")[1].outcome is Outcome.RIGHT
    assert "'overheated' is terminal" in verdicts("cool: 3.5, warm: 2.5, overheated: -10")[0].says


@pytest.mark.parametrize("zero", [", goal: 0", ", goal 0"])
def test_the_goal_of_a_graph_may_be_given_its_zero(zero: str) -> None:
    # From b to the goal 2; from a through b 1 + 2.
    solution = problem("principle-of-optimality", edges=[["a", "b", 1], ["b", "goal", 2]], start="a", goal="goal")
    typed = f"a{zero[6]} 3, b{zero[6]} 2{zero}".replace("  ", " ")
    assert judge(solution, "a", typed).outcome is Outcome.RIGHT
    assert "'goal' is terminal" in judge(solution, "a", "a: 3, b: 2, goal: 1").says


def test_an_action_in_a_terminal_state_may_be_given_its_zero() -> None:
    # Q(a, left) = 0 + 1/2·(4 + 0 − 0): what follows is the end, whose actions are worth nothing.
    moves = {"states": ["a", "end"], "actions": ["left"], "rewards": [4], "terminal": ["end"]}
    q = {"a": {"left": 0, "right": 0}}
    solution = problem("q-learning", trajectory=moves, values=q, alpha="1/2", gamma="1/2")
    assert judge(solution, "a", "Q(a, left) = 2, Q(end, left) = 0").outcome is Outcome.RIGHT


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("1.44", "Right."),  # 13/9 = 1.4444…
        ("1.43", _CLOSE),  # three digits, and not those of the key
        ("1.46", _CLOSE),
        ("10/7", "Not right."),  # 1.4286: nobody rounds to that
        ("sqrt(2)", "Not right."),
    ],
)
def test_what_is_close_is_told_why(text: str, says: str) -> None:
    solution = problem("return", rewards=[1, 1, 1], gamma="1/3", time=0)  # 13/9
    assert judge(solution, "a", text).says == says


@pytest.mark.parametrize(
    ("typed", "short"),
    # 20 and 8 have no more digits; 12.1 is rounded to 12
    [("19.9, 12.1, 8", False), ("20, 12.2, 8", False), ("20, 12.1, 7.9", False), ("20, 12, 8", True)],
)
def test_only_digits_of_the_key_are_called_too_few(typed: str, short: bool) -> None:
    # R₂ = 8, R₁ = 81/10 + 1/2·8 = 121/10, R₀ = 279/20 + 1/2·121/10 = 20
    solution = problem("return", rewards=["279/20", "81/10", 8], gamma="1/2")
    assert judge(solution, "a", typed).says.endswith("three digits." if short else "on the way.")


@pytest.mark.parametrize(("text", "cut"), [("0.219, 0.780", True), ("0.217, 0.78", False)])
def test_digits_that_are_cut_off_are_named(text: str, cut: bool) -> None:
    # P(sound) = 9/41 = 0.21951…, P(worn) = 32/41 = 0.78048…
    given_ = {"prior": {"sound": "9/41", "worn": "32/41"}, "likelihood": {"hum": {"sound": 0.5, "worn": 0.5}}}
    solution = problem("bayes-rule", measurements=["hum"], **given_)
    verdict = judge(solution, "a", text)
    assert verdict.outcome is Outcome.CLOSE
    assert ("do not cut it off" in verdict.says) is cut


BUMP = problem("rbf", position=[1], centres=[[4]], sigma="sigma")  # exp(−9/(2σ²))


@pytest.mark.parametrize(
    "same",
    [
        "exp(-9/(2 sigma^2))",
        "e^(-4.5/sigma^2)",
        "1/e^(9/2/sigma^2)",
        "sqrt(exp(-9/sigma^2))",
        "exp(-1/sigma^2)^(9/2)",
        "(e^(-9/(2 sigma^2)/100))^100",
        "e^(-3 ln(e^(3/2/sigma^2)))",
        "(exp(-9/sigma^2)+exp(-9/(2 sigma^2)))/(1+exp(-9/(2 sigma^2)))",
        "exp(-9/(2 sigma^2)) + (e^(1/sigma)+1)^2 - e^(2/sigma) - 2 e^(1/sigma) - 1",
        "exp(-9/(2 sigma^2)) * (e^(1/sigma)+e^sigma)^2/(e^(2/sigma)+e^(2 sigma)+2 e^(1/sigma+sigma))",
    ],
)
def test_every_form_of_an_exponential_is_accepted(same: str) -> None:
    assert judge(BUMP, "a", same).outcome is Outcome.RIGHT


@pytest.mark.parametrize(
    "other",
    [
        "exp(-9/(2 sigma^2)) + 1/10^30",
        "exp(-9/(2 sigma^2)) (1 + e^(-sigma)/10^20)",
        "exp(-9/(2 sigma^2)) + (e^(1/sigma)+1)^2 - e^(2/sigma) - 2 e^(1/sigma)",
    ],
)
def test_a_near_miss_of_an_exponential_is_not(other: str) -> None:
    assert judge(BUMP, "a", other).outcome is not Outcome.RIGHT


def test_a_working_of_several_lines_is_worth_what_its_last_line_says_of_what_is_asked_for() -> None:
    # R_0 = 3 + 1/2 · 1/4 = 25/8.
    given_ = {"rewards": [3, -2, 4, 1], "gamma": "1/2", "time": 1}
    exercise = rldrill.read({"family": "return", "given": given_})
    assert exercise.check("gamma = 1/2\nR_0 = 3 + 1/8 = 25/8", "b").accepted
    assert exercise.check("R_0 = 3 + 1/8\n= 25/8", "b").accepted
    verdict = exercise.check("R_0 = 25/8\ndelta = 1", "b")
    assert verdict.says == "The last line gives delta, but R0 is asked for; type its value alone."
    assert not verdict.accepted


#: V(a) = 4/3 = 1.333…, V(b) = 8/3 = 2.666…, V(c) = 3.
_LOOPS = [["a", "x", "a", 1, "2/3"], ["b", "x", "b", 1, "4/3"], ["c", "x", "c", 1, "3/2"]]
_CUT = "The digits are right, but the last one is cut off: round it, do not cut it off, or give an exact value."


@pytest.mark.parametrize(
    ("text", "outcome", "says", "wrong", "credit"),
    [
        ("a: 4/3, b: 8/3, c: 3", Outcome.RIGHT, "Right.", (), 1),
        ("a: 1.33, b: 2.67, c: 3", Outcome.RIGHT, "Right.", (), 1),
        ("a: 1.34, b: 8/3, c: 3", Outcome.CLOSE, _CLOSE, ("a",), Fraction(2, 3)),
        ("a: 4/3, b: 2.66, c: 3", Outcome.CLOSE, _CUT, ("b",), Fraction(2, 3)),
        ("a: 1.34, b: 2.66, c: 3", Outcome.CLOSE, _CLOSE, ("a", "b"), Fraction(1, 3)),
        (
            "a: 4/3, b: 2.66, c: 9",
            Outcome.WRONG,
            "Not right at b and c; the rest is right.",
            ("b", "c"),
            Fraction(1, 3),
        ),
        (
            "a: 1.34, b: 8/3, c: 9",
            Outcome.WRONG,
            "Not right at a and c; the rest is right.",
            ("a", "c"),
            Fraction(1, 3),
        ),
        ("a: 9, b: 8/3, c: 3", Outcome.WRONG, "Not right at a; the rest is right.", ("a",), Fraction(2, 3)),
        ("a: 9, b: 9, c: 9", Outcome.WRONG, "Not right.", ("a", "b", "c"), 0),
        ("a: 4/3, c: 3", Outcome.WRONG, "Not right at b (left out); the rest is right.", ("b",), Fraction(2, 3)),
        ("4/3, , 9", Outcome.WRONG, "Not right at b (left out) and c; the rest is right.", ("b", "c"), Fraction(1, 3)),
        ("a: 9", Outcome.WRONG, "Not right.", ("a", "b", "c"), 0),
    ],
)
def test_a_table_is_judged_entry_by_entry(
    text: str, outcome: Outcome, says: str, wrong: tuple[str, ...], credit: Fraction
) -> None:
    verdict = judge(problem("policy-value", mdp={"transitions": _LOOPS}, gamma="1/2"), "a", text)
    assert (verdict.outcome, verdict.says, verdict.wrong_cells, verdict.credit) == (outcome, says, wrong, credit)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("a: 4/3, c: 3", "b is missing; give it too."),
        ("b: 8/3", "a and c are missing; give them too."),
        ("a: 4/3, b: 8/3, c: 3", ""),
    ],
)
def test_where_one_may_type_again_what_is_left_out_is_asked_for(text: str, says: str) -> None:
    verdict = judge(problem("policy-value", mdp={"transitions": _LOOPS}, gamma="1/2"), "a", text)
    assert verdict.missing == says
    assert (verdict.value is None) == bool(says)  # nothing later goes on from half a table


def test_of_many_entries_that_are_left_out_three_are_named() -> None:
    loops = [[state, "x", state, 1, 1] for state in "abcdef"]
    verdict = judge(problem("policy-value", mdp={"transitions": loops}, gamma="1/2"), "a", "c: 2")
    assert verdict.missing == "a, b, d and 2 more are missing; give them too."
    assert verdict.credit == Fraction(1, 6)


def test_an_action_that_is_left_out_is_a_wrong_one() -> None:
    # Of three states with two actions each two are right: 2/3, of which 1/2 is guessed; (2/3 − 1/2)/(1 − 1/2) = 1/3.
    moves = [[state, action, "end", 1, reward] for state in "abc" for action, reward in (("stay", 1), ("go", 2))]
    mdp = {"transitions": moves, "terminal": ["end"]}
    verdict = judge(problem("value-iteration", gamma=1, sweeps=1, mdp=mdp), "b", "a: go, c: go")
    assert (verdict.outcome, verdict.credit, verdict.wrong_cells) == (Outcome.WRONG, Fraction(1, 3), ("b",))


@pytest.mark.parametrize("text", ["(a) 27/4", "a) 6.75", "(a)6.75", "a) (27/4)"])
def test_the_letter_of_the_part_may_stand_before_its_answer(text: str) -> None:
    # 8 + 1/2·(4 + 1/2·3 − 8) = 27/4
    run = {"states": ["cave", "rim"], "rewards": [4]}
    solution = problem("td-zero", trajectory=run, values={"cave": 8, "rim": 3}, alpha="1/2", gamma="1/2")
    assert judge(solution, "a", text).outcome is Outcome.RIGHT
    assert judge(solution, "a", text.replace("a", "b", 1)).outcome is not Outcome.RIGHT


@pytest.mark.parametrize(
    ("typed", "right"),
    [
        ("ln(x) + 0.693", True),
        ("1.00 ln x + 0.6935", True),
        ("0.69315 + ln x", True),
        ("ln(2.0x)", True),
        ("ln(2.01x)", False),  # ln 2.01 = 0.698
        ("ln(2.004x)", False),  # 0.695
        ("ln(x) + 0.694", False),
        ("1.01 ln(x) + 0.693", False),
        ("ln(x) + 0.693x", False),
    ],
)
def test_every_number_beside_a_logarithm_of_a_letter_has_three_digits(typed: str, right: bool) -> None:
    # ln 2 = 0.69315; three digits are 0.693, and within half of the last place it is from 0.6926 to 0.6936.
    x = sympy.Symbol("x", positive=True)
    reading = read_number(typed, ["x"])
    assert is_right(reading.value, sympy.log(2) + sympy.log(x), rounded=reading.decimal) is right


@pytest.mark.parametrize(
    ("typed", "right"),
    [
        ("(2310 - 1510q)/(211 - 156q)", True),  # 2309 and 1512 to three digits
        ("(2.31 - 1.51q)/(0.211 - 0.156q)", True),
        ("(2330 - 1510q)/(211 - 156q)", False),
        ("(2310 - 1510q)/(212 - 156q)", False),
        ("(2310 - 1520q)/(211 - 156q)", False),
    ],
)
def test_every_number_of_a_quotient_has_three_digits_as_it_is_written(typed: str, right: bool) -> None:
    key = read_number("(2309 - 1512q)/(211 - 156q)", ["q"]).value
    assert is_right(read_number(typed, ["q"]).value, key) is right


@pytest.mark.parametrize("typed", ["0.334 x + 0.5", "2.01/(1 - x)", "2.01 x + 3.01", "2.01/x"])
def test_a_number_that_is_not_written_gives_no_room(typed: str) -> None:
    for key in ("x/3 + 1/2", "2/(1 - x)", "2x + 3", "2/x"):
        assert not is_right(read_number(typed, ["x"]).value, read_number(key, ["x"]).value)


def test_a_number_below_the_line_alone_gives_no_room() -> None:
    # 1/3 to three digits is 0.333, also where it stands as 3γ below the line
    key = read_number("x/(3 gamma)", ["x", "gamma"]).value
    for typed, right in (("0.333 x/gamma", True), ("0.334 x/gamma", False)):
        assert is_right(read_number(typed, ["x", "gamma"]).value, key) is right


def test_what_follows_before_a_part_that_has_no_answer_then_is_right() -> None:
    exercise = rldrill.read({"family": "apprenticeship", "given": {
        "expert": [6, 0], "first": [8, 6], "policies": [[2, 0]],
        "candidates": {"A": [4, 3], "B": [5, 3], "C": [8, 3]}, "projected": False}})  # fmt: skip
    # From (6, 4) the weights are (6, 0) − (6, 4); with them all three policies are worth −12, so none is the next.
    graded = exercise.grade({"a": "6, 4", "b": "0, -4", "c": "A"})
    assert [part.verdict and part.verdict.outcome for part in graded.parts[:3]] == [
        Outcome.WRONG, Outcome.FOLLOW_THROUGH, Outcome.WRONG,
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("typed", "says"),
    [
        ("V(new) = 25", "V(new) is not asked for here, but V(worn)."),
        ("V^π(new): 25", "V^π(new) is not asked for here, but V^π(worn)."),
        ("V(new) = 3\nV(worn) = 25", ""),
        ("V(worn) = 3\nV(new) = 25", "V(new) is not asked for here, but V(worn)."),
        ("V_pi(Worn) = 25", ""),
        ("V(s = worn) = 25", ""),
        ("V(s) = 25", ""),
        ("abs(gamma) = 25", ""),
        ("25", ""),
    ],
)
def test_the_value_of_another_state_is_not_taken_for_that_of_the_one(typed: str, says: str) -> None:
    # V^π(worn) = 1/2·(8 + 4/5·30) + 1/2·(6 + 4/5·15) = 16 + 9
    steps = [["worn", "run", "rattling", 1, 8], ["worn", "repair", "new", 1, 6]]
    values, policy = {"new": 15, "rattling": 30}, {"worn": {"run": "1/2", "repair": "1/2"}}
    solution = problem("bellman-backup", dynamics={"transitions": steps}, values=values, gamma="4/5", policy=policy)
    verdict = judge(solution, "a", typed)
    if says:
        assert (verdict.outcome, verdict.says) == (Outcome.UNREADABLE, says)
    else:
        assert "asked for" not in verdict.says
