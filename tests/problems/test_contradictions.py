"""Givens that go together are read and solved; where one is changed so that they do not, a sentence says why."""

from typing import Any

import pytest

from rldrill.audit.checking import Finding, examine
from rldrill.problems.catalogue import family
from rldrill.problems.errors import FileError
from rldrill.problems.family import Problem
from rldrill.solutions.exact import is_rational, to_sympy
from rldrill.solutions.formula.putting_in import evaluated
from rldrill.solutions.solution import solve
from rldrill.solutions.work import Step

FILTER: dict[str, Any] = {
    "belief": {"a": "q", "b": "1-q"}, "motion": {"go": {"a": {"a": 1}, "b": {"b": "1/2", "a": "1/2"}}},
    "likelihood": {"z": {"a": "1/2", "b": "1/4"}}, "run": [{"action": "go", "measurement": "z"}],
    "outcome": {"state": "a", "probability": "6/7"},
}  # fmt: skip
AHEAD = {"belief": {"a": "1/3", "b": "2/3"}, "outcome": None, "ahead": {"action": "go", "measurement": "z"}}
RULE: dict[str, Any] = {
    "prior": {"a": "1/2", "b": "1/2"}, "likelihood": {"z": {"a": "1-q", "b": "1/5"}}, "measurements": ["z"],
    "outcome": {"state": "a", "probability": "5/13"},
}  # fmt: skip
KALMAN: dict[str, Any] = {
    "mean": 4, "covariance": 7, "A": 1, "C": 1, "process": 5, "sensor": "w", "variance": 4, "steps": [{"u": 3, "z": 9}],
}  # fmt: skip
BACKUP: dict[str, Any] = {
    "dynamics": {"transitions": [["a", "x", "b", 1, 3], ["a", "y", "a", 1, 12]]}, "values": {"a": 10, "b": 8},
    "gamma": "1/2",
}  # fmt: skip
POLICY = {"policy": {"a": {"x": "1/2", "y": "1/2"}}}
SOUGHT: dict[str, Any] = {
    "mdp": {"transitions": [["a", "x", "b", 1, 1], ["b", "x", "end", 1, 1], ["b", "y", "a", 1, "x"]],
            "terminal": ["end"]},
    "gamma": "1/2", "optimum": {"a": 4},
}  # fmt: skip
AVERAGED: dict[str, Any] = {"values": {"a": {"x": 1, "y": "x"}}, "policy": {"a": {"x": "1/2", "y": "1/2"}}}
EQUAL: dict[str, Any] = {
    "values": {"a": {"x": 5, "y": 6}, "b": {"x": 10, "y": -3}}, "equal": True,
    "policy": {"a": {"x": "p", "y": "1-p"}, "b": {"x": "1-p", "y": "p"}},
}  # fmt: skip
LINK = {"theta": "pi/3", "d": 1, "a": 0, "alpha": "pi/2"}
ARM: dict[str, Any] = {"links": [LINK, LINK], "name": "an arm", "asked": "point", "point": [1, 1, -2]}
PLANAR: dict[str, Any] = {"lengths": ["w", 2], "angles": ["0", "pi/2"], "x": 3}
JACOBIAN: dict[str, Any] = {"lengths": [3, 3], "angles": ["0", "pi/2"], "rates": [2, 1], "orientation": False}
MAML: dict[str, Any] = {"theta": 1, "tasks": [[1, 5]], "alpha": "1/2", "beta": "1/4"}
GREEDY: dict[str, Any] = {"state": "a", "values": {"x": 1, "y": 6}, "epsilon": "epsilon", "state_value": 5}
EPISODE = {"states": ["a", "end"], "actions": ["x"], "rewards": [3], "terminal": ["end"]}
SAMPLED: dict[str, Any] = {
    "episodes": [EPISODE, EPISODE], "target": {"a": {"x": "2/3", "y": "1/3"}},
    "behaviour": {"a": {"x": "1/3", "y": "2/3"}}, "gamma": "1/2",
}  # fmt: skip
TRACES: dict[str, Any] = {
    "trajectory": {"states": ["a", "b", "a"], "actions": ["x", "x", "x"], "rewards": [1, 2]},
    "values": {"a": {"x": 4}, "b": {"x": 8}}, "alpha": "1/2", "gamma": "1/2", "lam": "1/2", "watkins": True,
}  # fmt: skip
KNOWN_Q: dict[str, Any] = {
    "values": {"a": {"x": 3}, "b": {"x": 6}}, "gamma": "1/2", "terminal": ["end"],
    "missing": {"transitions": [["a", "y", "b", 1, "x"]]},
}  # fmt: skip
# V*(a) = max(1 + 1/2·6, 0 + 1/2·4) = 4, V*(b) = 6
KNOWN_V: dict[str, Any] = {
    "mdp": {"transitions": [["a", "x", "b", 1, 1], ["a", "y", "a", 1, 0], ["b", "x", "end", 1, 6]],
            "terminal": ["end"]},
    "values": {"a": 4}, "missing": "b", "gamma": "1/2",
}  # fmt: skip
# One sweep from 0 gives 3 and 6: 1 + γ·6 = 3 + γ·3 for γ = 2/3.
TIE: dict[str, Any] = {
    "mdp": {"transitions": [["a", "x", "b", 1, 1], ["a", "y", "a", 1, 3], ["b", "x", "end", 1, 6]],
            "terminal": ["end"]},
    "sweeps": 1, "gamma": "gamma", "tie": "a",
}  # fmt: skip
SWEPT = TIE | {"tie": None, "gamma": "1/2", "action_values": True}
BUMPS = {"position": [4], "centres": [[3], [8]], "width": 5}
LINEAR: dict[str, Any] = {"theta": [3, 1], "actions": ["x", "y"], "features": [1]}
BETWEEN: dict[str, Any] = {
    "theta": [0, 1, 1, 0], "actions": ["x", "y"], "bumps": {"centres": [[0], [4]], "width": 4},
}  # fmt: skip
TENTS: dict[str, Any] = {"centres": [[0], [4]], "width": 4, "known": {"1": "3/4", "2": "1/4"}}
BELLS: dict[str, Any] = {"position": [1], "centres": [[0], [3]], "logarithms": {"1": "-1/2"}}
TENT_AT: dict[str, Any] = {"position": [1], "centres": [[0], [4]], "width": 4, "theta": [1, 2]}
BELL_AT: dict[str, Any] = {"position": [1], "centres": [[0], [3]], "sigma": 1, "theta": [1, 2]}
MOMENTS: dict[str, Any] = {
    "features": {"a": [4, 1], "b": [3, 3]}, "trajectories": [["a", "b"]], "gamma": "gamma", "estimate": 5,
}  # fmt: skip
MATCHED: dict[str, Any] = {
    "motion": {"x": {"a": {"end": 1}}, "y": {"a": {"a": "1/2", "end": "1/2"}}}, "policy": {"a": {"x": "q", "y": "1-q"}},
    "features": {"a": [4]}, "start": {"a": 1}, "terminal": ["end"], "gamma": "1/2", "matched": 5,
}  # fmt: skip
MEETING: dict[str, Any] = {
    "trajectory": {"states": ["a", "b"], "actions": ["x", "y"], "rewards": [1]},
    "values": {"a": {"x": 1, "y": 2}, "b": {"x": 3, "y": 4}}, "alpha": "1/2", "gamma": "1/2", "instead": ["b", "x", 5],
}  # fmt: skip
DDP: dict[str, Any] = {
    "dynamics": {"v": "v + u"}, "state": {"v": 1}, "action": {"u": 1}, "reward": "-(v^2 + u^2)", "gradient": [-3],
    "hessian": -2,
}  # fmt: skip
AFFINE: dict[str, Any] = {"dynamics": {"h": "u - h^2"}, "state": {"h": 1}, "action": {"u": 1}, "step": "1/2"}
GAIN: dict[str, Any] = {"A": 1, "B": 1, "R": "rho", "P": -2, "start": [2], "action": -1}
CLOSED: dict[str, Any] = {"A": 2, "B": 1, "Q": "rho", "R": 4, "closed_loop": "1/4"}
COSTS: dict[str, Any] = {
    "A": 1, "B": 1, "Q": 1, "R": "rho", "start": [1], "horizon": 1, "L": 1, "total": -3,
}  # fmt: skip
BACKWARD: dict[str, Any] = {"A": 1, "B": 1, "Q": 1, "R": "rho", "start": [3], "horizon": 1, "action": -1}
PRICED: dict[str, Any] = {
    "theta": ["w", -1], "features": {"a": {"x": [6, -5], "y": [1, -2]}}, "at": "1/2",
}  # fmt: skip
SAMPLE = {"state": "a", "action": "x", "old": "1/2", "preferences": {"x": "ln 4", "y": 0}, "advantage": 2}
CLIPPED: dict[str, Any] = {"samples": [SAMPLE, SAMPLE], "epsilon": "1/5"}
BOTH_OLD = {"state": "a", "action": "x", "old_preferences": {"x": 0, "y": 0}, "preferences": {"x": "ln 4", "y": 0},
            "advantage": 2}  # fmt: skip
ODDS: dict[str, Any] = {
    "theta": ["ln 2", "ln x"], "features": {"x": [0, 0], "y": [1, 1]}, "odds": ["y", "x", 8],
}  # fmt: skip
ACTIONS: dict[str, Any] = {
    "trajectory": {"states": ["a", "b"], "actions": ["x", "y"], "rewards": [4]},
    "values": {"a": {"x": 10, "y": 2}, "b": {"x": 8, "y": 6}}, "alpha": "1/2", "gamma": "1/2",
}  # fmt: skip
VALUED_RUN: dict[str, Any] = {
    "trajectory": {"states": ["a", "b"], "rewards": [4]}, "values": {"a": 4, "b": 2}, "alpha": "1/2", "gamma": "1/2",
}  # fmt: skip
ENDED = {"states": ["a", "end"], "actions": ["x"], "rewards": [4], "terminal": ["end"]}
BIC: dict[str, Any] = {
    "fitted": {"a": {"likelihood": "1/4", "k": 1}, "b": {"likelihood": "1/2", "k": 2}}, "n": 2,
}  # fmt: skip
COINS: dict[str, Any] = {"data": {"tosses": {"c": [1, 1000]}, "models": ["fair", "shared"]}}
BORDER = {"n": None, "border": "more"}
PULLED: dict[str, Any] = {"pulls": [["x", 5], ["x", 9], ["x", 7], ["y", 2]], "between": ["x", "y"]}

GO = {"a": "x", "b": "x"}
# V(b) = 2 and V(a) = 1 + 1/2·2.
VALUED: dict[str, Any] = {
    "mdp": {"transitions": [["a", "x", "b", 1, 1], ["b", "x", "end", 1, 2]], "terminal": ["end"]},
    "policy": {"a": {"x": 1}, "b": {"x": 1}}, "values": {"a": 2, "b": 2}, "gamma": "1/2",
}  # fmt: skip
NEARER: dict[str, Any] = {"start": {"a": 0}, "optimum": {"a": 4}, "gamma": "1/2", "sweeps": 2}

NAMED: dict[str, Any] = {"diagrams": [{"shows": "td-zero", "options": ["td-zero", "sarsa"]}]}
CHANGED: dict[str, Any] = {
    "shows": "n-step-td", "options": ["n-step-td", "td-zero"], "change": "one-step", "target": "monte-carlo",
    "changes": ["to-the-end", "sampled"],
}  # fmt: skip
TREE: dict[str, Any] = {
    "dynamics": {"transitions": [["s", "a", "s₁", 1, 4], ["s", "b", "s₂", 1, 1]]}, "values": {"s₁": 5, "s₂": 5},
    "gamma": "1/2",
}  # fmt: skip


def chain(levels: int) -> dict[str, Any]:
    """A tree of so many levels."""
    rows = [[f"s{level}", "a", f"s{level + 1}", 1, 4] for level in range(levels)]
    return {"dynamics": {"transitions": rows}, "values": {f"s{levels}": 5}, "gamma": "1/2"}


MOVE = {"go": {"a": {"a": "1/4", "b": "3/4"}, "b": {"b": 1}}}
PREDICT: dict[str, Any] = {
    "belief": {"a": "q", "b": "1-q"}, "motion": MOVE, "actions": ["go", "go"], "after": 2,
    "outcome": {"state": "b", "probability": "31/32"},
}  # fmt: skip
MODELS: dict[str, Any] = {
    "models": {"one": {"thetas": [["1/3", "1/2"], ["2/3", "1/2"]]}, "two": {"theta": "1/2"}},
    "prior": {"one": "1/2", "two": "1/2"}, "heads": 1, "tails": 1,
}  # fmt: skip


def first(**said: Any) -> dict[str, Any]:
    return {"models": MODELS["models"] | {"one": said}}


COIN: dict[str, Any] = {"coin": {"heads": 1, "tails": 0, "a": 1, "b": 1}}
MEASURED: dict[str, Any] = {"sample": {"values": [6, 4], "prior": {"mean": 4, "variance": "1/2", "noise": "1/2"}}}
LINE: dict[str, Any] = {"line": {"points": [[0, 2], [1, 3]]}}
CLAIMED: dict[str, Any] = {"mdp": VALUED["mdp"], "values": {"a": 1, "b": 2}, "gamma": "1/2", "optimal": True}
LOOP: dict[str, Any] = {"mdp": {"transitions": [["a", "x", "b", 1, 1], ["b", "x", "a", 1, 2]]}, "average": True}
PATHS: dict[str, Any] = {
    "edges": [["a", "b", 1], ["a", "c", 2], ["b", "end", 3], ["c", "end", 4]], "start": "a", "goal": "end",
    "through": "c",
}  # fmt: skip
DOUBLE = ACTIONS | {"second": {"a": {"x": 1, "y": 2}, "b": {"x": 3, "y": 4}}, "updates": [1]}
DYNA = ACTIONS | {"model": [], "planned": [["a", "x"]]}
EPISODES: dict[str, Any] = {"mdp": VALUED["mdp"], "gamma": "1/2", "start": {"a": 1}}
TABLE: dict[str, Any] = {
    "table": [["k", "h", "h", 16], ["k", "h", "s", 24], ["b", "h", "h", 2], ["b", "h", "s", 3]], "asked": "h",
}  # fmt: skip
#: V(a) = 8 is optimal where going round pays 4, for 4 + 1/2·8 = 8, and leaving pays 4.
RAISED: dict[str, Any] = {
    "mdp": {"transitions": [["a", "x", "end", 1, 4], ["a", "y", "a", 1, "x"]], "terminal": ["end"]},
    "values": {"a": 8}, "gamma": "1/2", "reward": 1,
}  # fmt: skip
#: y₀ = 2 + 1/2·6 = 5, so Q(a, x) = 4 + α, and y₁ = 3 + 1/2·(4 + α) = 21/4 for α = 1/2.
READ_AGAIN: dict[str, Any] = {
    "trajectory": {"states": ["a", "b", "a", "c"], "actions": ["x", "x", "x", "x"], "rewards": [2, 3, 1]},
    "values": {"a": {"x": 4, "y": 0}, "b": {"x": 6, "y": 0}, "c": {"x": 2, "y": 0}}, "alpha": "alpha", "gamma": "1/2",
    "known": "21/4",
}  # fmt: skip
BLOCKS: dict[str, Any] = {
    "trajectory": {"states": ["a", "b"], "actions": ["x", "y"], "rewards": [1]},
    "features": {"a": [1, 2], "b": [2, 1]}, "theta": [1, 1, 2, 3], "actions": ["x", "y"], "alpha": "1/2", "gamma": 1,
}  # fmt: skip
#: Two bells of width 1: the state is 1 from the first centre and 2 from the second, for −1/2·1² and −1/2·2².
FOUND_BETWEEN: dict[str, Any] = {"centres": [[0], [3]], "logarithms": {"1": "-1/2", "2": "-2"}, "sigma": 1}
AHEAD_OF_A: dict[str, Any] = {
    "lookahead": {"dynamics": {"transitions": [["a", "x", "b", 1, 3], ["a", "y", "c", 1, 1]]},
                  "values": {"a": 2, "b": 4, "c": 6}},
    "gamma": "1/2",
}  # fmt: skip
MOVES: dict[str, Any] = {
    "transitions": [["a", "x", "b", 1, "y"], ["b", "y", "end", 2]], "terminal": ["end"],
    "values": {"a": {"x": 1, "y": 5}, "b": {"y": 3, "x": 7}}, "alpha": "1/2", "gamma": "1/2",
}  # fmt: skip
HELD: dict[str, Any] = {
    "dynamics": {"h": "u - h"}, "state": {"h": 1}, "action": {"u": 2}, "step": "1/10",
    "discretisation": "zero-order hold",
}  # fmt: skip


def many_ways(more: int = 0) -> dict[str, Any]:
    """Ten ways from a to b and twenty from there to the end, 200 episodes; and some straight to the end."""
    ways = [["a", f"x{n}", "b", 1, n] for n in range(10)] + [["b", f"y{n}", "end", 1, n] for n in range(20)]
    return {"mdp": {"transitions": [*ways, *(["a", f"z{n}", "end", 1, 3] for n in range(more))], "terminal": ["end"]}}


def rows(*weights: object) -> dict[str, Any]:
    return {"table": [[*row[:3], weight] for row, weight in zip(TABLE["table"], weights, strict=True)]}


MARGIN: dict[str, Any] = {
    "w": [2, 3], "expert": [1, 4], "policies": {"one": {"mu": [2, 0], "margin": 2}},
}  # fmt: skip
TRACE: dict[str, Any] = {"states": ["a", "b", "a"], "gamma": "1/2", "lam": "1/2", "asked": [0, 2]}
AVERAGE: dict[str, Any] = {"values": {"a": 2}, "counts": {"a": 0}, "visits": [["a", 8]]}
CONSTANT: dict[str, Any] = {"values": {"a": 2}, "alpha": "1/2", "visits": [["a", 8]]}
SCORE: dict[str, Any] = {
    "features": {"x": [0, 4], "y": [-1, 2]}, "policy": {"x": "p", "y": "1-p"}, "action": "y", "component": [1, "-1/4"],
}  # fmt: skip
THRESHOLD: dict[str, Any] = {
    "mdp": {"transitions": [["a", "x", "end", 1, 4], ["a", "y", "end", 1, "x"]], "terminal": ["end"]},
    "start": {"a": "x"}, "gamma": "1/2", "reward": 6,
}  # fmt: skip
SYSTEM: dict[str, Any] = {"A": 1, "B": 1, "Q": 1, "R": 1, "start": [1], "horizon": 2}


def fitted(first: dict[str, Any], then: dict[str, Any]) -> dict[str, Any]:
    return {"fitted": {"a": first, "b": then}}


#: A family, givens that are read, what is changed, and what is said then.
CASES: list[tuple[str, dict[str, Any], dict[str, Any], str]] = [
    ("bayes-filter", FILTER, {"outcome": None},
     "motion: no probability may be left open here without an outcome to find it from"),
    ("bayes-filter", FILTER | AHEAD, {"ahead": {"action": "go"}}, "ahead: the step ahead has no measurement whose"),
    ("bayes-filter", FILTER, {"belief": {"a": "1/3", "b": "2/3"}}, "outcome: there must be one letter, such as q"),
    ("bayes-filter", FILTER, {"run": [{"action": "stay", "measurement": "z"}]}, "an action"),
    ("bayes-filter", FILTER, {"run": [{"action": "go", "measurement": "y"}]}, "a measurement"),
    ("bayes-rule", RULE, {"outcome": None}, "likelihood: a probability may be left open here only with an outcome"),
    ("kalman-filter", KALMAN, {"variance": None}, "variance: it goes with the variance of one noise that is left open"),
    ("kalman-filter", KALMAN, {"sensor": 3}, "variance: it goes with the variance of one noise that is left open"),
    ("kalman-filter", KALMAN, {"steps": [{"u": 3, "z": 9}] * 2}, "variance: "),
    ("kalman-filter", KALMAN, {"steps": [{"u": 3}]}, "variance: "),
    ("kalman-filter", KALMAN | {"sensor": 1, "variance": None}, {"sensor": 0}, "sensor"),
    ("kalman-filter", KALMAN | {"sensor": 1, "variance": None, "process": 0}, {"process": -1}, "process"),
    ("kalman-filter", KALMAN | {"sensor": 1, "variance": None}, {"mean": [[1, 1]]}, "mean"),
    ("model-fitting", {"sample": {"values": [6, 4], "prior": {"mean": 4, "variance": 2, "noise": 1}}},
     {"sample": {"values": [6, 4], "prior": {"mean": 4, "variance": "w", "noise": 1}}},
     "estimate: it goes with a variance that is left open as w, and is needed then"),
    ("action-value", BACKUP | {"chance": True}, {"dynamics": {
        "transitions": [["a", "x", "b", 1, 3], ["a", "y", "b", 1, 12]]}, "values": {"b": 8}},
     "chance: it follows from the value of 'a'"),
    ("action-value", BACKUP | {"chance": True}, {"gamma": "gamma"}, "chance: it follows from the value of 'a'"),
    ("action-value", BACKUP | {"values": {"a": 10, "b": 28}, "gamma": "gamma", "find": True}, {"gamma": "1/2"},
     "find: leave exactly one number open"),
    ("bellman-backup", BACKUP | POLICY | {"gamma": "gamma", "find": True}, {"dynamics": {
        "transitions": [["a", "x", "b", 1, 3], ["a", "y", "b", 1, 12]]}, "values": {"b": 8}},
     "values: to find what is left open, the value of 'a' is needed, too"),
    ("bellman-backup", BACKUP | POLICY, {"dynamics": {
        "transitions": [["a", "x", "b", 1, 3], ["b", "y", "a", 1, 12]]}}, "actions of one state only"),
    ("optimal-value", SOUGHT, {"optimum": {"b": 4}}, "optimum: give the optimal value of the state that is not 'b'"),
    ("optimal-value", SOUGHT, {"gamma": 1}, "gamma: give a discount above 0 and below 1"),
    ("optimal-value", SOUGHT, {"gamma": 0}, "gamma: give a discount above 0 and below 1"),
    ("optimal-value", SOUGHT, {"mdp": {"transitions": [["a", "x", "b", 1, 1], ["b", "y", "a", 1, "x"]]}},
     "mdp: 'b' has no action beside 'y'; give it another one"),
    ("optimal-value", SOUGHT, {"mdp": {"transitions": [*SOUGHT["mdp"]["transitions"], ["c", "x", "end", 1, 1]],
                                       "terminal": ["end"]}},
     "mdp: a reward can be asked for where there are two states"),
    ("value-from-action-values", AVERAGED | {"known": {"a": 3}}, {"values": {"a": {"x": 1, "y": 5}}},
     "values: leave exactly one number open"),
    ("value-from-action-values", AVERAGED | {"known": {"a": 3}}, {"values": {"a": {"x": "p", "y": "x"}}}, "open"),
    ("value-from-action-values", EQUAL, {"known": {"a": 3}}, "equal: give two states, and no known value"),
    ("denavit-hartenberg", ARM, {"point": None}, "point: it is needed where the coordinates of a point are asked for"),
    ("denavit-hartenberg", ARM, {"asked": "pose"},
     "point: it is needed where the coordinates of a point are asked for"),
    ("denavit-hartenberg", ARM, {"frames": True}, "asked: with frames or a base only the transforms are asked for"),
    ("forward-kinematics", PLANAR, {"x": None}, "x: it goes with a length that is left open"),
    ("forward-kinematics", PLANAR, {"lengths": [1, 2]}, "x: it goes with a length that is left open"),
    ("forward-kinematics", PLANAR, {"frames": True}, "x: a length is found for an arm at the origin, without frames"),
    ("forward-kinematics", PLANAR, {"base": {"x": 1, "y": 1, "phi": 0}},
     "x: a length is found for an arm at the origin"),
    ("jacobian", JACOBIAN, {"lengths": [3, "w"]}, "lengths: give a number for every link here"),
    ("jacobian", JACOBIAN, {"rates": None}, "give either rates, the joints' velocities, or velocity"),
    ("jacobian", JACOBIAN, {"velocity": [1, 2]}, "give either rates, the joints' velocities, or velocity"),
    ("jacobian", JACOBIAN, {"rates": [2]}, "rates holds 1, but there are 2 joints"),
    ("jacobian", JACOBIAN | {"rates": None, "velocity": [1, 2]}, {"velocity": [1]},
     "velocity: it needs as many entries"),
    ("jacobian", JACOBIAN | {"rates": None, "velocity": [1, 2]}, {"orientation": True}, "velocity: it needs as many"),
    ("maml-step", MAML, {"theta": None},
     "theta: which one the outer step leaves alone is asked without beta and after"),
    ("maml-step", MAML, {"beta": None}, "give either beta or what theta is after the outer step"),
    ("maml-step", MAML, {"after": 2}, "give either beta or what theta is after the outer step"),
    ("maml-step", MAML | {"beta": None, "after": 2}, {"alpha": "alpha"}, "alpha: give a number where theta or beta is"),
    ("maml-step", MAML | {"beta": None, "after": 2}, {"first_order": True}, "first_order: give theta and beta, too"),
    ("epsilon-greedy", GREEDY, {"taken": ["y", "9/10"]}, "give either taken or state_value"),
    ("epsilon-greedy", GREEDY, {"epsilon": "1/2"}, "epsilon: leave it open, for it is asked for"),
    ("epsilon-greedy", GREEDY, {"values": {"x": 6, "y": 6}}, "state_value: all actions are equally good"),
    ("epsilon-greedy", GREEDY | {"state_value": None, "taken": ["y", "9/10"]}, {"taken": ["z", "9/10"]},
     "taken: 'z' has no value"),
    ("importance-sampling", SAMPLED, {"episodes": [EPISODE, EPISODE | {"states": ["b", "end"]}]},
     "episodes[2]: all episodes must start in 'a'"),
    ("importance-sampling", SAMPLED, {"episodes": [EPISODE | {"actions": []}]},
     "episodes[1]: the action taken in every state that is left is needed"),
    ("sarsa-lambda", TRACES, {"lam": "lambda", "outcome": ["a", "x", 5]}, "outcome: with watkins no letter is found"),
    ("optimal-policy-from-q", KNOWN_Q, {"values": {"a": {}, "b": {"x": 6}}},
     "values: another action of the state is needed, to compare what is left open with"),
    ("optimal-policy-from-v", KNOWN_V, {"missing": "c"}, "missing: 'c' must be a state of the model without a value"),
    ("optimal-policy-from-v", KNOWN_V, {"values": {"a": 4, "b": 6}},
     "missing: 'b' must be a state of the model without"),
    ("optimal-policy-from-v", KNOWN_V, {"gamma": 1},
     "missing: with a discount of 1 one equation need not give a value"),
    ("value-iteration", TIE, {"tie": "b"}, "tie: 'b' must be a state with two actions"),
    ("value-iteration", TIE, {"sweeps": 2}, "tie: it is found after one sweep from 0; set sweeps = 1"),
    ("value-iteration", TIE, {"gamma": "1/2"}, "tie: leave gamma open, and nothing else"),
    ("value-iteration", TIE, {"start": {"a": 1, "b": 1}}, "tie: it is found after one sweep from 0; set"),
    ("value-iteration", TIE, {"action_values": True}, "tie: it is found after one sweep from 0; set"),
    ("value-iteration", TIE, {"tie": None}, "gamma is left open, so no action can be called greedy"),
    ("value-iteration", SWEPT, {"in_place": True}, "in_place: sweeps over action values are synchronous here"),
    ("value-iteration", SWEPT, {"start": {"a": 1, "b": 1}}, "start: sweeps over action values are synchronous here"),
    ("value-iteration", TIE, {"tie": "c"}, "tie: 'c' must be a state with two actions"),
    ("linear-value", LINEAR, {"bumps": BUMPS}, "bumps"),
    ("linear-value", LINEAR, {"features": None}, "features"),
    ("linear-value", LINEAR | {"action": "x"}, {"action": "z"}, "action: 'z' is not among the actions"),
    ("linear-value", LINEAR, {"actions": ["x", "x"]}, "actions: one is named twice"),
    ("linear-value", LINEAR, {"theta": [3, 1, 2]}, "here 1·2 = 2, not 3"),
    ("linear-value", LINEAR | {"theta": ["w", 1]}, {"features": [0]}, "the feature that belongs to w must be given"),
    ("linear-value", LINEAR | {"theta": ["w", 1]}, {"action": "x"}, "action: its vector is only asked for where"),
    ("linear-value", BETWEEN, {"bumps": {"centres": [[0], [4]], "width": 3}}, "position: it can only be found between"),
    ("linear-value", BETWEEN, {"bumps": {"centres": [[4], [0]], "width": 4}}, "position: it can only be found between"),
    ("linear-value", BETWEEN, {"bumps": {"centres": [[0], [2], [4]], "width": 4}}, "position: it can only be found"),
    ("linear-value", BETWEEN, {"actions": ["x", "y", "z"], "theta": [0, 1, 2, 0, 3, 4]}, "there must be two actions"),
    ("linear-value", BETWEEN, {"action": "x"}, "action: its vector is only asked for where nothing is to be found"),
    ("piecewise-linear-rbf", TENTS, {"known": {"1": 1, "2": "1/4"}}, "known: a feature that tells how far away"),
    ("piecewise-linear-rbf", TENTS, {"known": {"1": "3/4", "2": 0}}, "known: a feature that tells how far away"),
    ("piecewise-linear-rbf", TENTS, {"width": 0}, "width: it must be above 0, not 0"),
    ("piecewise-linear-rbf", TENTS, {"width": None}, "give the width or the position; both cannot be found"),
    ("piecewise-linear-rbf", TENTS, {"known": {"1": "3/4"}}, "known"),
    ("piecewise-linear-rbf", TENTS, {"theta": [1, 2]}, "theta: a value is asked for where all features are worked out"),
    ("piecewise-linear-rbf", TENT_AT, {"theta": [1]}, "theta: 2 features need as many weights, not 1"),
    ("rbf", BELLS, {"logarithms": {"1": 0}}, "logarithms: a feature that tells how far away the state is"),
    ("rbf", BELLS, {"sigma": 1}, "0 of the features must be known, not 1"),
    ("rbf", BELLS, {"position": None}, "give the width or the position; both cannot be found"),
    ("rbf", BELLS, {"theta": [1, 2]}, "theta: a value is asked for where all features are worked out"),
    ("rbf", BELL_AT, {"theta": [1]}, "theta: 2 features need as many weights, not 1"),
    ("feature-expectations", MOMENTS, {"gamma": "1/2"}, "estimate: leave gamma open, for it is asked for"),
    ("feature-expectations", MOMENTS, {"features": {"a": [4], "b": [3]}}, "estimate: leave gamma open"),
    ("feature-expectations", MOMENTS, {"trajectories": [["a"], []]}, "trajectories: one of them has no states"),
    ("feature-expectations-policy", MATCHED, {"policy": {"a": {"x": 1}}}, "matched: leave one number open"),
    ("feature-expectations-policy", MATCHED, {"features": {"a": [4, 1]}}, "matched: leave one number open"),
    ("ddp-backward", DDP, {"step": 1}, "the dynamics give the next state itself here; leave out 'step' and 'where'"),
    ("ddp-backward", DDP, {"reward": "-(v^2 + k*u^2)"}, "the reward holds 'k', which has no value"),
    ("ddp-backward", DDP, {"gradient": [-3, 1]}, "gradient has 2 entries, but the state 1"),
    ("ddp-backward", DDP, {"hessian": [[-2, 0], [0, -1]]}, "hessian"),
    ("ddp-backward", DDP, {"reached": {"w": 2}}, "reached must have the letters of the state"),
    ("sarsa-versus-q-learning", MEETING, {"instead": ["b", "z", 1]}, "instead: 'z' has no value in 'b'"),
    ("linearise-affine", AFFINE, {"step": None}, "step is missing: the 1 that is added to the state stays 1"),
    ("lqr-gain", GAIN, {"start": [2, 1]}, "start has 2 entries, but the state 1"),
    ("lqr-gain", GAIN, {"start": None}, "action: it goes with a start, and with a price that R leaves open"),
    ("lqr-gain", GAIN, {"R": 1}, "action: it goes with a start, and with a price that R leaves open"),
    ("lqr-gain", GAIN | {"action": None}, {"B": [[1, 1]], "R": [["rho", 0], [0, 1]]},
     "R: a price can only be left open where there is one action"),
    ("lqr-infinite", CLOSED, {"closed_loop": None}, "Q and R: a price may be left open only with a closed_loop"),
    ("lqr-infinite", CLOSED, {"closed_loop": None, "Q": "x"}, "Q and R: a price may be left open only with"),
    ("lqr-infinite", CLOSED, {"closed_loop": None, "Q": 0, "R": "1-rho"}, "Q and R: a price may be left open only"),
    ("lqr-infinite", CLOSED, {"Q": "x"}, "closed_loop: it goes with a scalar system without N, in which Q or R is rho"),
    ("lqr-infinite", CLOSED, {"Q": 1}, "closed_loop"),
    ("lqr-infinite", CLOSED, {"B": 0}, "closed_loop"),
    ("lqr-reward", COSTS, {"R": 1}, "total: it goes with a price that R leaves open"),
    ("lqr-backward", BACKWARD, {"horizon": 2}, "action: it goes with the horizon 1, one action, and a price"),
    ("lqr-backward", BACKWARD, {"R": 1}, "action: it goes with the horizon 1, one action, and a price"),
    ("lqr-backward", BACKWARD, {"B": [[1, 1]], "R": [["rho", 0], [0, 1]]}, "action: it goes with the horizon 1"),
    ("linear-policy", PRICED, {"theta": ["x", -1]}, "theta: only one weight may be left open, and it is called w"),
    ("linear-policy", PRICED, {"at": None}, "at: give it where one of the weights is w, and only there"),
    ("linear-policy", PRICED, {"theta": [1, -1]}, "at: give it where one of the weights is w, and only there"),
    ("linear-policy", PRICED, {"features": {"a": {"x": [6, -5], "y": [1, -2], "z": [0, 0]}}},
     "features: the greedy action changes once in 'a' only if it has two actions"),
    ("ppo-clip", CLIPPED, {"samples": [SAMPLE, SAMPLE | {"preferences": {"x": "ln 4", "z": 0}}]},
     "samples: give preferences of the same actions in all of them, or new probabilities in all"),
    ("ppo-clip", CLIPPED | {"samples": [BOTH_OLD, BOTH_OLD]}, {"samples": [BOTH_OLD, SAMPLE]},
     "samples: give old_preferences of the same actions in all of them, or old probabilities in all"),
    ("softmax-policy", ODDS, {"odds": ["y", "x", 0]}, "odds: 0 is not above 0"),
    ("softmax-policy", ODDS, {"theta": ["ln 2", "ln 3"]}, "theta: with odds one weight must be ln x"),
    ("sarsa", ACTIONS, {"trajectory": ACTIONS["trajectory"] | {"actions": []}},
     "trajectory: the action taken in every state that is left is needed"),
    ("sarsa", ACTIONS, {"values": {"a": {"x": 10}}}, "values: the action values of 'b' are missing"),
    ("sarsa", ACTIONS, {"values": {"a": {"y": 10}, "b": {"y": 6}}},
     "values: 'x' is taken in 'a' but has no value there"),
    ("sarsa", ACTIONS | {"trajectory": ENDED}, {"trajectory": ENDED | {"actions": ["x", "y"]}},
     "trajectory: the run ends in 'end', so no action is taken there"),
    ("sarsa", ACTIONS | {"trajectory": ENDED}, {"values": {"a": {"x": 10}, "end": {"x": 1}}}, "'end'"),
    ("bic", BIC, {"criterion": "DIC"}, "'DIC' is not possible here; write 'BIC' or 'AIC'"),
    ("bic", BIC, {"n": None}, "n, the number of data, is needed with fitted models, and with them only"),
    ("bic", BIC | {"n": None, "criterion": "AIC"}, {"criterion": "BIC"}, "n, the number of data, is needed"),
    ("bic", COINS, {"n": 5}, "n, the number of data, is needed with fitted models, and with them only"),
    ("bic", COINS, {"fitted": BIC["fitted"]}, "give either fitted models or data"),
    ("bic", COINS, {"data": None}, "give either fitted models or data"),
    ("bic", COINS, {"data": {"tosses": {"c": [0, 1000]}, "models": ["fair", "shared"]}}, "from 1 to 1000 heads"),
    ("bic", COINS, {"data": {"tosses": {"c": [1, 1001]}, "models": ["fair", "shared"]}}, "from 1 to 1000 heads"),
    ("bic", COINS, {"data": {"tosses": {"c": [1, 1]}, "models": ["own", "own"]}},
     "models: 'own' is compared with itself"),
    ("bic", BIC, fitted({"k": 1}, {"likelihood": "1/2", "k": 2}), "give either likelihood or log_likelihood"),
    ("bic", BIC, fitted({"likelihood": "1/4", "log_likelihood": -2, "k": 1}, {"likelihood": "1/2", "k": 2}),
     "give either likelihood or log_likelihood"),
    ("bic", BIC, fitted({"likelihood": 0, "k": 1}, {"likelihood": "1/2", "k": 2}), "likelihood is 0, which has no"),
    ("bic", BIC, fitted({"log_likelihood": -2, "k": 1}, {"likelihood": "1/2", "k": 2}),
     "or the log_likelihoods of all"),
    ("bic", BIC | BORDER, {"n": 3}, "border: it goes with two fitted models and the BIC, without n"),
    ("bic", BIC | BORDER, {"criterion": "AIC"}, "border: it goes with two fitted models and the BIC, without n"),
    ("bic", BIC | BORDER, {"fitted": BIC["fitted"] | {"c": {"likelihood": "1/3", "k": 3}}}, "border: it goes with two"),
    ("bic", COINS, {"border": "more"}, "border: it goes with two fitted models and the BIC, without n"),
    ("bic", BIC | BORDER, fitted({"likelihood": "1/4", "k": 2}, {"likelihood": "1/2", "k": 2}),
     "border: give the likelihoods of both models, and different numbers k"),
    ("bic", BIC | BORDER, fitted({"log_likelihood": -2, "k": 1}, {"log_likelihood": -1, "k": 2}), "border: give the"),
    ("policy-improvement", VALUED, {"values": {"a": 3, "b": 2}}, "'a' is given as 3, but one step of the policy"),
    ("policy-improvement", VALUED, {"values": {"a": 2}}, "the value of 'b' is missing"),
    ("policy-improvement-theorem", VALUED | {"policy": GO, "other": GO}, {"values": {"a": "5/2", "b": 3}},
     "'b' is given as 3, but one step of the policy gives 2"),
    ("policy-improvement-theorem", VALUED | {"policy": GO, "other": GO}, {"other": {"a": "x", "b": "y"}}, "'y'"),
    ("contraction", NEARER, {"gamma": 1}, "with a discount of 1 value iteration is no contraction"),
    ("contraction", NEARER | {"accuracy": 1}, {"accuracy": 0}, "0 is not above 0"),
    ("contraction", NEARER, {"first": {"a": 2}}, "give either optimum, the values V*, or first"),
    ("contraction", NEARER, {"optimum": None}, "give either optimum, the values V*, or first"),
    ("contraction", NEARER, {"optimum": {"b": 2}}, "the value of 'a' is missing"),
    ("backup-diagram-name", NAMED, {"diagrams": [{"shows": "td-zero", "options": ["td-zero"] * 2}]},
     "options: one is given twice; give each once"),
    ("backup-diagram-name", NAMED, {"diagrams": [{"shows": "td-zero", "options": ["sarsa", "monte-carlo"]}]},
     "options: 'td-zero', which is shown, must be among them"),
    ("backup-diagram-name", CHANGED, {"changes": ["to-the-end", "to-the-end"]}, "changes: one is given twice"),
    ("backup-diagram-name", CHANGED, {"changes": ["all-states", "sampled"]}, "changes: one of them, and no more"),
    ("backup-diagram-value", TREE, {"values": {"s₁": 5}}, "the value of 's₂' is missing"),
    ("backup-diagram-value", TREE, {"action_values": {"s₁": {"a": 1}, "s₂": {"a": 1}}},
     "dynamics must hold one action"),
    ("backup-diagram-value", chain(3), chain(4), "dynamics: the tree must end after 3 levels"),
    ("bayes-predict", PREDICT, {"after": 3}, "after: there is no outcome, or there are fewer than 3 actions before it"),
    ("bayes-predict", PREDICT | {"after": 1, "actions": ["go"], "outcome": {"state": "b", "probability": "7/8"}},
     {"after": 2}, "after: there is no outcome, or there are fewer than 2 actions before it"),
    ("bayes-predict", PREDICT | {"belief": {"a": "1/2", "b": "1/2"}, "outcome": None, "after": None}, {"after": 2},
     "after: there is no outcome, or there are fewer than 2 actions before it"),
    ("model-comparison", MODELS, first(theta="1/2", thetas=[["1/3", 1]]), "give either theta or thetas"),
    ("model-comparison", MODELS, first(thetas=[["1/3", "1/2"], ["1/3", "1/2"]]), "thetas: one θ is given twice"),
    ("model-comparison", MODELS, first(thetas=[["1/3", "1/2"], ["2/3", "1/4"]]), "sum to 3/4, not to 1"),
    ("model-comparison", MODELS, first(thetas=[["1/3", 1]], a=2), "with thetas there is no prior Beta(a, b)"),
    ("model-comparison", MODELS, {"heads": 0, "tails": 0}, "heads: without a toss there is nothing to compare"),
    ("model-comparison", MODELS, {"odds": 1}, "odds: they go with two models, and with a prior that is left open"),
    ("model-comparison", MODELS | {"prior": {"one": "q", "two": "1-q"}, "odds": 1}, {"odds": None},
     "odds: they go with"),
    ("model-comparison", MODELS, {"models": MODELS["models"] | {"two": {"theta": 1}}}, "models: 'two' has the prior 0"),
    ("model-comparison", MODELS | {"models": MODELS["models"] | {"two": {"theta": 1}}, "tails": 0},
     {"models": MODELS["models"] | {"two": {"theta": 0}}}, "models: 'two' has the prior 0"),
    ("model-fitting", COIN, {"coin": {"heads": 0, "tails": 0, "a": 1, "b": 1}},
     "heads: without a toss there is nothing"),
    ("model-fitting", COIN, {"coin": {"heads": 1, "tails": 0, "a": "1/2", "b": 1}}, "a and b must be at least 1"),
    ("model-fitting", COIN, {"coin": {"heads": 1, "tails": 0, "a": 1, "b": "1/2"}}, "a and b must be at least 1"),
    ("model-fitting", COIN, LINE, "give one of coin, sample and line"),
    ("model-fitting", COIN, {"coin": None}, "give one of coin, sample and line"),
    ("model-fitting", MEASURED, {"sample": {"values": [6, 4], "prior": {"mean": 4, "variance": 1, "noise": 0}}},
     "above 0"),
    ("model-fitting", MEASURED, {"sample": {"values": [6, 4], "prior": {"mean": 4, "variance": 0, "noise": 1}}},
     "above 0"),
    ("model-fitting", LINE, {"line": {"points": [[1, 2], [1, 3]]}},
     "points: all x are the same, so no slope fits best"),
    ("model-fitting", {"line": LINE["line"] | {"prior": {"mean": 0, "variance": 1, "noise": 1}}},
     {"line": LINE["line"] | {"prior": {"mean": 1, "variance": 1, "noise": 1}}},
     "the prior of a slope must have the mean"),
    ("bellman-residual", CLAIMED, {"gamma": "gamma"}, "gamma is left open, so it cannot be told whether the values"),
    ("bellman-residual", CLAIMED, {"policy": VALUED["policy"]}, "policy: optimal values belong to no given policy"),
    ("bellman-residual", CLAIMED | {"optimal": None, "policy": VALUED["policy"]}, {"values": {"a": 1}},
     "of 'b' is missing"),
    ("policy-value", LOOP, {"mdp": VALUED["mdp"]}, "average: there is no long run, because 'end' is terminal"),
    ("policy-value", LOOP, {"gamma": "1/2"}, "average: all steps count alike, so γ plays no part"),
    ("principle-of-optimality", PATHS, {"edges": [*PATHS["edges"], ["a", "b", 2]]}, "edges: an edge is given twice"),
    ("principle-of-optimality", PATHS, {"edges": [*PATHS["edges"], ["end", "b", 2]]},
     "edges: 'end' is the goal, so no"),
    ("principle-of-optimality", PATHS, {"edges": [*PATHS["edges"], ["a", "d", 2]]}, "no edge leads on from 'd'"),
    ("principle-of-optimality", PATHS, {"edges": [*PATHS["edges"], ["c", "a", 2]]}, "a path can go round and round"),
    ("principle-of-optimality", PATHS, {"through": "end"}, "through: 'end' is no state of the graph before the goal"),
    ("principle-of-optimality", PATHS, {"through": "d"}, "through: 'd' is no state of the graph before the goal"),
    ("principle-of-optimality", PATHS, {"start": "b"}, "through: no path from 'b' reaches 'c'"),
    ("principle-of-optimality", PATHS, {"start": "d"}, "start: no edge leads on from 'd'"),
    ("double-q-learning", DOUBLE, {"updates": [1, 2]}, "updates: 1 transitions need as many, not 2"),
    ("double-q-learning", DOUBLE, {"second": {"a": {"x": 1}, "b": {"x": 3, "y": 4}}},
     "second: both tables need the same"),
    ("double-q-learning", DOUBLE, {"outcome": ["b", "y", 5]}, "outcome: (b, y) is not updated, so nothing follows"),
    ("double-q-learning", DOUBLE, {"outcome": ["a", "x", 5]}, "outcome: leave one number open, such as alpha"),
    ("dyna-q", DYNA, {"planned": [["b", "y"]]}, "planned: (b, y) is not in the model after the run"),
    ("dyna-q", DYNA | {"trajectory": ENDED}, {"model": [["end", "x", 1, "a"]]},
     "model: 'end' is terminal, so nothing is done there"),
    ("dyna-q", DYNA, {"model": [["b", "y", 1, "a"]] * 2},
     "model: (b, y) is given twice; a deterministic model holds it"),
    ("dyna-q", DYNA, {"changed": [["b", "y", 1, "a"]]}, "changed: (b, y) must be in the model and not be tried"),
    ("dyna-q", DYNA | {"model": [["b", "y", 1, "a"]], "changed": [["b", "y", 1, "a"]]},
     {"changed": [["a", "x", 1, "a"]]}, "changed: (a, x) must be in the model and not be tried in the run"),
    ("expected-return", EPISODES, {"mdp": {"transitions": [["a", "x", "a", "1/2", 1], ["a", "x", "end", "1/2", 1]],
                                           "terminal": ["end"]}}, "mdp: 'a' can come again in an episode"),
    ("markov-property", TABLE, rows(16, 24, 2, "5/2"), "table: the weights are neither whole counts nor probabilities"),
    ("markov-property", TABLE, rows("1/2", "1/2", "1/2", "1/2"), "table: the weights are neither whole counts nor"),
    ("markov-property", TABLE, rows(16, 24, 0, 0), "table: the history b, h never occurs; leave its rows out"),
    ("markov-property", TABLE, rows(16, 24, 2, -1), "is below 0"),
    ("markov-property", TABLE, {"table": [*TABLE["table"], ["k", "h", "h", 1]]}, "table: k, h, h is given twice"),
    ("markov-property", TABLE, {"asked": "x"}, "asked: 'x' is not a next state of the table"),
    ("markov-property", TABLE | rows(16, 24, 2, "x"), rows(16, 24, "x", "x"),
     "table: the weights of 2 rows are left open"),
    ("markov-property", TABLE | rows(16, 24, 2, "x"), {"table": [TABLE["table"][0], ["k", "h", "s", "x"]]},
     "table: 'h' has one history only, so nothing says what is left open"),
    ("max-margin", MARGIN, {"policies": {"expert": {"mu": [2, 0], "margin": 2}}},
     "is the name of the expert's own policy"),
    ("max-margin", MARGIN | {"w": [2, "w"]}, {"w": ["w", 2]},
     "must have less of the feature whose weight is left open"),
    ("max-margin", MARGIN | {"w": [2, "w"]}, {"policies": {"one": {"mu": [2, 4], "margin": 2}}},
     "must have less of the"),
    ("eligibility-trace", TRACE, {"asked": [2, 0]}, "asked: the times must rise from one to the next"),
    ("eligibility-trace", TRACE, {"asked": [2, 2]}, "asked: the times must rise from one to the next"),
    ("eligibility-trace", TRACE, {"asked": [3]}, "asked: no state is visited at time 3; the last time is 2"),
    ("sample-average", AVERAGE, {"counts": {"a": -1}}, "counts: 'a' cannot have been visited -1 times"),
    ("sample-average", AVERAGE | {"counts": {"a": 10**6}}, {"counts": {"a": 10**6 + 1}},
     "counts: 'a' cannot have been"),
    ("sample-average", AVERAGE, {"alpha": "1/2"}, "counts: a constant step size does not depend on them"),
    ("sample-average", CONSTANT, {"values": {"a": 2, "b": 3}},
     "values: with a constant step size give the value of the"),
    ("sample-average", CONSTANT, {"visits": [["b", 8]]}, "'b'"),
    ("score-function", SCORE, {"action": None},
     "component: give its action, one of two with the probabilities p and 1-p"),
    ("score-function", SCORE, {"policy": {"x": "1/2", "y": "1/2"}}, "component: give its action, one of two with the"),
    ("score-function", SCORE, {"component": [0, "-1/4"]}, "component: there is no weight of the number 0"),
    ("score-function", SCORE | {"component": [2, "-1/2"]}, {"component": [3, "-1/2"]},
     "there is no weight of the number 3"),
    ("policy-iteration", THRESHOLD, {"start": {"a": "y"}}, "start: the reward of 'y' in 'a' is left open; start with"),
    ("policy-iteration", THRESHOLD, {"gamma": 1}, "gamma: with a discount of 1 a policy need not have a value"),
    ("ppo-clip", CLIPPED, {"objective": 1}, "give either epsilon or the objective from which it is to be found"),
    ("ppo-clip", CLIPPED, {"samples": [SAMPLE | {"old": 0}]},
     "old: the action was taken, so its probability was not 0"),
    ("ppo-clip", CLIPPED, {"samples": [SAMPLE | {"new": "1/2"}]},
     "give either the new probability or the new policy's"),
    ("ppo-clip", CLIPPED, {"samples": [SAMPLE | BOTH_OLD]}, "give either the old probability or the old policy's"),
    ("ppo-clip", CLIPPED, {"samples": [SAMPLE | {"action": "z"}]}, "preferences: the preference of 'z' is missing"),
    ("lqr-reward", COSTS, {"L": [[[1]], [[1]], [[1]]]}, "L holds 3 matrices; give one, as a list of rows such as"),
    ("lqr-backward", SYSTEM, {"A": [[[1]], [[1]], [[1]]]}, "A holds 3 matrices; give one, as a list of rows such as"),
    ("lqr-backward", SYSTEM, {"A": [1, "1/10", 0, 1]}, "such as [[1, 2], [3, 4]], or 2 for the times from 0"),
    ("lqr-backward", SYSTEM, {"Q": [[-1]]}, "Q must be positive semidefinite; make its diagonal larger"),
    ("lqr-backward", SYSTEM, {"start": [0, 0], "A": [[1, 0], [0, 1]], "B": [[1], [0]], "Q": [[1, 2], [3, 4]]},
     "Q must be symmetric; give row 1, column 2, and row 2, column 1, the same entry"),
    ("td-zero", VALUED_RUN, {"values": {}}, "is missing; add it"),
    ("lqr-backward", SYSTEM, {"start": [1, 0, 0]}, "start: A has 1 row, so give as many entries, not 3"),
    ("lqr-backward", SYSTEM | {"Q": [[[1]]] * 3}, {"Q_T": 1},
     "Q_T is given twice, since Q has a matrix for the horizon"),
    ("lqr-infinite", CLOSED, {"closed_loop": 1}, "closed_loop must be between -1 and 1, and not 0"),
    ("lqr-infinite", CLOSED, {"closed_loop": 0}, "closed_loop must be between -1 and 1, and not 0"),
    ("lqr-infinite", CLOSED, {"N": 1}, "closed_loop: it goes with a scalar system without N, in which Q or R is rho"),
    ("lqr-infinite", CLOSED, {"R": "rho"}, "closed_loop: it goes with a scalar system without N"),
    ("linearise", AFFINE | {"deviation": [1, 1]}, {"deviation": [1]},
     "deviation: give a number for every letter of the"),
    ("optimal-policy-from-q", KNOWN_Q, {"gamma": None}, "gamma: the discount is needed to find the missing values"),
    ("optimal-policy-from-q", KNOWN_Q, {"missing": {"transitions": [["a", "y", "b", 1, "x"], ["b", "y", "end", 1, 1]]}},
     "missing: only one reward of the last action there can be left open"),
    ("optimal-policy-from-q", KNOWN_Q, {"missing": {"transitions": [["a", "x", "b", 1, "x"]]}}, "has a value already"),
    ("optimal-policy-from-q", KNOWN_Q, {"missing": {"transitions": [["a", "y", "c", 1, "x"]]}},
     "'c' is reached but has no"),
    ("optimal-policy-from-q", KNOWN_Q, {"missing": {"transitions": [["a", "y", "a", 1, "x"]]}},
     "has a missing value itself"),
    ("optimal-policy-from-q", KNOWN_Q, {"terminal": ["end", "b"]},
     "values: 'b' is terminal, so no action can be taken"),
    ("maml-step", MAML, {"beta": 0}, "beta"),
    ("maml-step", MAML, {"tasks": [[0, 5]]}, "tasks: a curvature is not above 0"),
    ("return-infinite", {"first": [1], "repeated": [2], "gamma": "1/2"}, {"gamma": 1}, "must be below 1, or rewards"),
    ("return", {"rewards": [1, 2], "gamma": "1/2", "time": 1}, {"time": 2}, "time is 2, but the episode ends at 2"),
    ("return", {"rewards": [1, 2], "gamma": ["1/2", "1/3"], "time": 1}, {"gamma": ["1/2"]}, "2 rewards need as many"),
    ("td-zero", VALUED_RUN | {"td_errors": True}, {"known": 3, "alpha": "alpha"}, "td_errors: they are not asked for"),
    ("td-zero", VALUED_RUN, {"values": {"a": 4}}, "the value of 'b' is missing"),
    ("bellman-residual", RAISED, {"gamma": 1}, "gamma: with a discount of 1 other values may solve the equations, too"),
    ("bellman-residual", RAISED, {"mdp": {"transitions": [["a", "y", "end", 1, "x"]], "terminal": ["end"]}},
     "mdp: 'a' has no action beside 'y'; give it another one"),
    ("policy-value", LOOP, {"mdp": {"transitions": [["a", "x", "a", 1, 1], ["b", "x", "b", 1, 2]]}},
     "average: it depends on the first state, for whoever comes to a stays there for ever, and so does whoever"),
    ("sarsa-versus-q-learning", READ_AGAIN, {"alpha": "1/2"}, "known: leave alpha open, which is asked for then"),
    ("sarsa-versus-q-learning", READ_AGAIN,
     {"trajectory": {"states": ["a", "b", "c"], "actions": ["x", "x", "x"], "rewards": [2, 3]}},
     "known: no target of Sarsa reads an updated value, so alpha does not follow"),
    ("semi-gradient-td", BLOCKS, {"actions": ["x", "x"]}, "actions: one is named twice"),
    ("semi-gradient-td", BLOCKS, {"actions": ["x", "z"]}, "trajectory: 'y' is taken but has no block of weights"),
    ("semi-gradient-td", BLOCKS, {"actions": ["x", "y", "z"]}, "theta: 4 weights cannot be shared among 3 actions"),
    ("semi-gradient-td", BLOCKS, {"trajectory": BLOCKS["trajectory"] | {"actions": ["x"]}},
     "trajectory: Sarsa needs the action taken in every state, the last one too unless it is terminal"),
    ("expected-return", EPISODES | many_ways(), many_ways(1), "mdp: there are more than 200 different episodes"),
    ("rbf", FOUND_BETWEEN, {"sigma": "sigma"}, "sigma: the position can only be found where it is a number"),
    ("rbf", FOUND_BETWEEN, {"sigma": 0}, "sigma: the width must be above 0, not 0"),
    ("advantage", AHEAD_OF_A, {"lookahead": AHEAD_OF_A["lookahead"] | {"dynamics": {
        "transitions": [["a", "x", "b", 1, 3], ["b", "y", "c", 1, 1]]}}},
     "dynamics must hold the actions of one state only"),
    ("sarsa", MOVES, {"transitions": [["a", "x", "b", 1, "y"], ["b", "y", "end", 2, "x"]]},
     "transitions[2]: 'end' is terminal, so no action is taken there"),
    ("sarsa", MOVES, {"transitions": [["a", "x", "b", 1, "y"], ["end", "y", "a", 2, "x"]]},
     "transitions[2]: 'end' is terminal, so nothing leads on from there"),
    ("sarsa", MOVES, {"transitions": [["a", "x", "b", 1], ["b", "y", "end", 2]]},
     "transitions[1]: Sarsa needs the action taken in 'b' too; add it at the end"),
    ("sarsa", MOVES, {"transitions": [["a", "z", "b", 1, "y"]]}, "values: 'z' is taken in 'a' but has no value there"),
    ("sarsa", MOVES, {"values": {"a": {"x": 1}}}, "values: the action values of 'b' are missing"),
    ("sarsa", MOVES, {"values": {"a": {"x": 1}, "b": {"x": 1}}}, "values: 'y' is taken in 'b' but has no value there"),
    ("linearise", HELD, {"step": None}, "step is missing: for how long the zero-order hold keeps the action; add it"),
    ("linearise", HELD, {"step": 0}, "step"),
    ("linearise", HELD | {"story": "$h$ high"}, {"story": "$h high"}, "story: a $ is missing"),
    ("linearise", HELD | {"entries": {"A": [[1, 1]]}}, {"entries": {}}, "entries: name one entry of A or B at least"),
    ("linearise", HELD | {"entries": {"A": [[1, 1]]}}, {"entries": {"A": [[1, 2]]}},
     "entries: A has 1 rows and 1 columns; name entries that it has"),
    ("linearise", HELD | {"entries": {"A": [[1, 1]]}}, {"entries": {"A": [[0, 1]]}},
     "entries: A has 1 rows and 1 columns; name entries that it has"),
    ("linearise", HELD | {"entries": {"A": [[1, 1]]}}, {"entries": {"A": [[1, 1], [1, 1]]}},
     "entries: one of A is named twice; name each once"),
    ("linearise", HELD | {"entries": {"B": [[1, 1]]}}, {"entries": {"B": [[2, 1]]}},
     "entries: B has 1 rows and 1 columns; name entries that it has"),
    ("linearise", HELD | {"entries": {"B": [[1, 1]]}}, {"entries": {"B": [[1, 0]]}},
     "entries: B has 1 rows and 1 columns; name entries that it has"),
    ("bandit", PULLED, {"between": ["x", "z"]}, "between: 'z' was never pulled"),
    ("bandit", PULLED, {"between": ["y", "x"]}, "between: "),
]  # fmt: skip


def stated(fields: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in fields.items() if value is not None}


#: What goes together, each once.
READ = list({str(case[:2]): (case[0], stated(case[1])) for case in CASES}.values())


@pytest.mark.parametrize(("name", "given", "change", "says"), CASES)
def test_what_goes_together_is_read_and_what_does_not_is_told(
    name: str, given: dict[str, Any], change: dict[str, Any], says: str
) -> None:
    family(name).read(stated(given))
    with pytest.raises(FileError) as refused:
        family(name).read(stated(given | change))
    assert says in str(refused.value)


@pytest.mark.parametrize(("name", "given"), READ)
def test_what_is_read_is_solved_with_the_formulas_as_without_them(name: str, given: dict[str, Any]) -> None:
    solution = solve(Problem(family(name), family(name).read(given)))
    found = Finding(family(name), 1)
    examine(solution, found)
    assert not found.disagreements
    assert not found.refused
    for line in solution.lines:
        if isinstance(line, Step) and is_rational(line.value):
            assert to_sympy(line.value) == evaluated(line.put_in), line.equation()
