"""What only files ask for: drawn problems with another option chosen, solved with the formulas and without them."""

from typing import Any

import pytest
from flint import fmpq

import rldrill
from rldrill.audit.checking import Finding, examine
from rldrill.problems.catalogue import family as family_of
from rldrill.problems.draws import Draws
from rldrill.problems.errors import FileError
from rldrill.problems.family import Problem
from rldrill.render.terminal import plain
from rldrill.solutions.formula.compiling import value_of
from rldrill.solutions.solution import solve
from rldrill.solutions.value import NoSolution
from rldrill.solutions.work import Step

#: Each with what is changed in drawn givens; None takes a field away.
OPTIONS: list[tuple[str, dict[str, Any]]] = [
    ("value-iteration", {"in_place": True}),
    ("value-iteration", {"action_values": True, "start": None}),
    ("batch-td-and-mc", {"visits": "every"}),
    ("batch-td-and-mc", {"visits": "first"}),
    ("eligibility-trace", {"replacing": True}),
    ("lambda-return", {"time": 1}),
    ("td-lambda-backward", {"replacing": True}),
    ("td-zero", {"td_errors": True}),
    ("q-learning", {"td_errors": True}),
    ("sarsa", {"td_errors": True}),
    ("sarsa-lambda", {"replacing": True}),
    ("sarsa-lambda", {"watkins": True}),
    ("sarsa-lambda", {"watkins": True, "replacing": True}),
    ("softmax-policy", {"entropy": True}),
    ("linearise", {"step": "1/10", "discretisation": "zero-order hold"}),
    ("linearise-affine", {"step": "1/10", "discretisation": "zero-order hold"}),
    ("lqr-backward", {"gamma": "1/2"}),
    ("lqr-backward", {"convention": "cost-to-go"}),
    ("lqr-backward", {"Q_T": [[3]]}),
    ("lqr-backward", {"Q_T": [[3, 1], [1, 2]]}),
    ("lqr-backward", {"N": [["1/4"]]}),
    ("lqr-backward", {"N": [["1/4"], ["1/8"]], "gamma": "1/2"}),
    ("lqr-backward", {"convention": "xuKP", "N": [["1/4"]], "gamma": "1/2"}),
    ("lqr-gain", {"convention": "xuKP", "P": [[5, 1], [1, 2]]}),
    ("lqr-gain", {"convention": "cost-to-go", "P": [[5]], "gamma": "1/2", "N": [["1/4"]]}),
    ("lqr-gain", {"N": [["1/4"], ["1/8"]]}),
    ("lqr-gain", {"N": [["1/4", 0], ["1/8", "1/2"]], "gamma": "1/2"}),
    ("lqr-gain", {"gamma": "1/2"}),
    ("lqr-gain", {"N": [["1/4"]]}),
    ("lqr-infinite", {"gamma": "1/2"}),
    ("lqr-infinite", {"N": [["1/4"]]}),
    ("lqr-infinite", {"N": [["1/4"]], "gamma": "3/4"}),
    ("lqr-infinite", {"N": [["1/4", 0], [0, "1/8"]]}),
    ("lqr-infinite", {"convention": "xuKP"}),
    ("lqr-infinite", {"convention": "cost-to-go", "N": [["1/4"]], "gamma": "3/4"}),
    ("lqr-reward", {"gamma": "1/2"}),
    ("lqr-reward", {"N": [["1/4"]]}),
    ("lqr-reward", {"N": [["1/4"], ["1/8"]], "gamma": "1/2"}),
    ("lqr-reward", {"Q_T": [[3]]}),
    ("lqr-reward", {"Q_T": [[3, 1], [1, 2]]}),
    ("bic", {"criterion": "AIC"}),
    ("denavit-hartenberg", {"frames": True}),
    ("denavit-hartenberg", {"base": [[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]}),
    ("denavit-hartenberg", {"frames": True, "base": [[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]}),
    ("forward-kinematics", {"frames": True}),
    ("forward-kinematics", {"base": {"x": 1, "y": -2, "phi": "pi/2"}}),
    ("forward-kinematics", {"frames": True, "base": {"x": 1, "y": -2, "phi": "pi/2"}}),
]


#: What drawn problems ask in other ways than the options do.
_NOT_WITH = {
    "sarsa-lambda": ("outcome",),
    "denavit-hartenberg": ("asked", "point"),
}


@pytest.mark.parametrize(
    ("name", "changed"), OPTIONS, ids=[f"{name}: {', '.join(changed)}" for name, changed in OPTIONS]
)
def test_both_ways_to_solve_it_agree(name: str, changed: dict[str, Any]) -> None:
    family = family_of(name)
    finding = Finding(family, 1)
    for level in family.levels:
        given = family.draw(level, Draws(f"options {level} 0")).model_dump(mode="json", exclude_none=True)
        given = {field: value for field, value in (given | changed).items() if value is not None}
        given = {field: value for field, value in given.items() if field not in _NOT_WITH.get(name, ())}
        try:
            solution = solve(Problem(family, family.read(given)))
        except (FileError, NoSolution):
            continue  # it does not fit this problem
        examine(solution, finding)
    assert finding.drawn
    assert not finding.disagreements
    assert not finding.refused


CHAIN = {"transitions": [["a", "go", "b", 1, 1], ["a", "wait", "a", 1, 0], ["b", "go", "end", 1, 2]],
         "terminal": ["end"]}  # fmt: skip
ENDED = {"states": ["a", "b", "end"], "rewards": [1, 2], "terminal": ["end"]}
GO = {"a": "go", "b": "go"}

#: Problems of files only, with their answers worked out by hand.
WHOLE: list[tuple[str, dict[str, Any], dict[str, Any]]] = [
    # The mean of 6, 4 and 8; the squares of 0, 2 and 2 over 3 and over 2.
    ("model-fitting", {"sample": {"values": [6, 4, 8]}}, {"a": 6, "b": fmpq(8, 3), "c": 4}),
    ("linear-value", {"theta": [3, -1, 1, 2], "actions": ["x", "y"], "features": [1, 3], "action": "y"},
     {"a": (0, 0, 1, 3), "b": {("s", "x"): 0, ("s", "y"): 7}, "c": {"s": ("y",)}}),
    # δ₀ = 1 + 1/2·4 − 1 and δ₁ = 2 − 4; then 2 + 1/2·1/2·(−2).
    ("advantage", {"run": {"trajectory": ENDED, "values": {"a": 1, "b": 4}, "lam": "1/2"}, "gamma": "1/2"},
     {"a": (2, -2), "b": (fmpq(3, 2), -2)}),
    # θ_x = 2 and θ_y = 4: δ₀ = 1 + 1/2·8 − 2 and δ₁ = 2 − 8, for nothing comes behind the end.
    ("semi-gradient-td",
     {"trajectory": ENDED | {"actions": ["x", "y"]}, "features": {"a": [1], "b": [2]}, "theta": [2, 4],
      "actions": ["x", "y"], "alpha": "1/2", "gamma": "1/2"}, {"a": (3, -6), "b": (fmpq(7, 2), -2)}),
    # Waiting loses nothing, but whoever always waits earns nothing.
    ("optimal-value", {"mdp": CHAIN, "gamma": 1},
     {"a": {"a": 3, "b": 2}, "b": {"a": ("go",), "b": ("go",)},
      "c": {("a", "go"): 3, ("a", "wait"): 3, ("b", "go"): 2}}),
    ("policy-iteration", {"mdp": CHAIN, "start": GO, "gamma": 1, "rounds": 1},
     {"a": {"a": 3, "b": 2}, "b": {"a": ("go",), "b": ("go",)}, "c": True}),
    ("policy-improvement-theorem", {"mdp": CHAIN, "policy": GO, "other": GO, "gamma": 1},
     {"a": {"a": 3, "b": 2}, "b": {("a", "go"): 3, ("b", "go"): 2}, "c": True}),
]  # fmt: skip


@pytest.mark.parametrize(("name", "given", "answers"), WHOLE, ids=[name for name, *_ in WHOLE])
def test_it_is_solved_as_by_hand_and_without_the_formulas(
    name: str, given: dict[str, Any], answers: dict[str, Any]
) -> None:
    family = family_of(name)
    solution = solve(Problem(family, family.read(given)))
    assert solution.answers == answers
    finding = Finding(family, 1)
    examine(solution, finding)
    assert not finding.disagreements
    assert not finding.refused


CONVENTIONS = [({}, -1), ({"convention": "xuKP"}, 1), ({"convention": "cost-to-go"}, 1)]


@pytest.mark.parametrize(("convention", "sign"), CONVENTIONS)
@pytest.mark.parametrize(
    ("system", "value", "gain", "loop"),
    [
        # P = 7 + 4P − (4P + 2)²/(5 + 4P): 4P² − 27P − 31 = 0, so P = (27 + 35)/8.
        ({"A": 2, "B": 2, "Q": 7, "R": 5, "N": 2}, fmpq(31, 4), fmpq(33, 36), fmpq(1, 6)),
        # P = 1 + 2P − (P + 1)²/(3 + P/2): P² − 3P − 4 = 0.
        ({"A": 2, "B": 1, "Q": 1, "R": 3, "N": 1, "gamma": "1/2"}, fmpq(4), fmpq(1), fmpq(1)),
    ],
)
def test_a_cross_term_in_every_convention(
    convention: dict[str, str], sign: int, system: dict[str, Any], value: fmpq, gain: fmpq, loop: fmpq
) -> None:
    family = family_of("lqr-infinite")
    solution = solve(Problem(family, family.read(system | convention)))
    assert [answer[0, 0] for answer in solution.answers.values()] == [sign * value, gain, loop]
    finding = Finding(family, 1)
    examine(solution, finding)
    assert not finding.disagreements
    # What is shown before it is solved holds for what comes out.
    (equation,) = (line for line in solution.lines if isinstance(line, Step) and line.value is None)
    assert value_of(equation.right, {**equation.known, equation.formula.left.name: sign * value}) == sign * value


#: With β = 3/2 for A = 2, B = Q = N = 1, R = 3 and γ = 1/2; the roots are 4 and −1 in costs.
WORDS = {
    "": ("P(γB²P − R) = (−Q + γA²P)·(γB²P − R) − (γBPA − N)²", "γB²P² + (γB²Q + (γA² − 1) R − 2γABN) P − (QR − N²) = 0",
         "The product of the two roots, −4, is negative, so one of them is negative.",
         "No reward is positive, since QR − N² = 2 is not negative, and neither is a sum of them: P is that root.",
         "other root, 1, is positive",
         "it reads S = Q + γAᵀSA − (γAᵀSB + N) L."),
    "xuKP": ("P(R + γB²P) = (Q + γA²P)·(R + γB²P) − (γBPA + N)²",
             "γB²P² − (γB²Q + (γA² − 1) R − 2γABN) P − (QR − N²) = 0",
             "so one of them is positive.", "No cost is negative, since QR − N² = 2 is not negative",
             "other root, −1, is negative"),
}  # fmt: skip


@pytest.mark.parametrize("convention", WORDS)
def test_what_is_said_of_the_equation_follows_the_convention(convention: str) -> None:
    system = {"A": 2, "B": 1, "Q": 1, "R": 3, "N": 1, "gamma": "1/2"}
    given = system | ({"convention": convention} if convention else {})
    said = " ".join(plain(rldrill.read({"family": "lqr-infinite", "given": given}).working("a")).split())
    for words in WORDS[convention]:
        assert words in said
    assert "·(−1)" not in said
