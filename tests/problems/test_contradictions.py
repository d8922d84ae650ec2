"""Givens that go together are read and solved; where one is changed so that they do not, a sentence says why."""

from typing import Any

import pytest

from rldrill.audit.checking import Finding, examine
from rldrill.problems.catalogue import family
from rldrill.problems.errors import FileError
from rldrill.problems.family import Problem
from rldrill.solutions.solution import solve

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
MOMENTS: dict[str, Any] = {
    "features": {"a": [4, 1], "b": [3, 3]}, "trajectories": [["a", "b"]], "gamma": "gamma", "estimate": 5,
}  # fmt: skip
MATCHED: dict[str, Any] = {
    "motion": {"x": {"a": {"end": 1}}, "y": {"a": {"a": "1/2", "end": "1/2"}}}, "policy": {"a": {"x": "q", "y": "1-q"}},
    "features": {"a": [4]}, "start": {"a": 1}, "terminal": ["end"], "gamma": "1/2", "matched": 5,
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
ENDED = {"states": ["a", "end"], "actions": ["x"], "rewards": [4], "terminal": ["end"]}
BIC: dict[str, Any] = {
    "fitted": {"a": {"likelihood": "1/4", "k": 1}, "b": {"likelihood": "1/2", "k": 2}}, "n": 2,
}  # fmt: skip
COINS: dict[str, Any] = {"data": {"tosses": {"c": [1, 1000]}, "models": ["fair", "shared"]}}
BORDER = {"n": None, "border": "more"}
BARS: dict[str, Any] = {"pulls": [["x", 5], ["x", 9], ["x", 7], ["y", 2]], "between": ["x", "y"]}

GO = {"a": "x", "b": "x"}
# V(b) = 2 and V(a) = 1 + 1/2·2.
VALUED: dict[str, Any] = {
    "mdp": {"transitions": [["a", "x", "b", 1, 1], ["b", "x", "end", 1, 2]], "terminal": ["end"]},
    "policy": {"a": {"x": 1}, "b": {"x": 1}}, "values": {"a": 2, "b": 2}, "gamma": "1/2",
}  # fmt: skip
NEARER: dict[str, Any] = {"start": {"a": 0}, "optimum": {"a": 4}, "gamma": "1/2", "sweeps": 2}


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
    ("action-value", BACKUP | {"gamma": "gamma", "find": True}, {"gamma": "1/2"},
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
    ("value-iteration", TIE, {"sweeps": 2}, "tie: leave gamma open, and nothing else; it takes one sweep"),
    ("value-iteration", TIE, {"gamma": "1/2"}, "tie: leave gamma open, and nothing else; it takes one sweep"),
    ("value-iteration", TIE, {"start": {"a": 1, "b": 1}}, "tie: leave gamma open, and nothing else; it takes one"),
    ("value-iteration", TIE, {"action_values": True}, "tie: leave gamma open, and nothing else; it takes one sweep"),
    ("value-iteration", TIE, {"tie": None}, "gamma is left open, so no action can be called greedy"),
    ("value-iteration", SWEPT, {"in_place": True}, "in_place: sweeps over action values are synchronous here"),
    ("value-iteration", SWEPT, {"start": {"a": 1, "b": 1}}, "start: sweeps over action values are synchronous here"),
    ("value-iteration", TIE, {"tie": "c"}, "tie: 'c' must be a state with two actions"),
    ("linear-value", LINEAR, {"bumps": BUMPS}, "bumps"),
    ("linear-value", LINEAR, {"features": None}, "features"),
    ("linear-value", LINEAR | {"action": "x"}, {"action": "z"}, "action: 'z' is not among the actions"),
    ("linear-value", LINEAR, {"actions": ["x", "x"]}, "actions: one is named twice"),
    ("linear-value", LINEAR, {"theta": [3, 1, 2]}, "1 features and 2 actions need 2 weights, not 3"),
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
    ("piecewise-linear-rbf", TENTS, {"theta": [1]}, "theta: 2 features need as many weights, not 1"),
    ("rbf", BELLS, {"logarithms": {"1": 0}}, "logarithms: a feature that tells how far away the state is"),
    ("rbf", BELLS, {"sigma": 1}, "0 of the features must be known, not 1"),
    ("rbf", BELLS, {"position": None}, "give the width or the position; both cannot be found"),
    ("rbf", BELLS, {"theta": [1]}, "theta: 2 features need as many weights, not 1"),
    ("feature-expectations", MOMENTS, {"gamma": "1/2"}, "estimate: leave gamma open, for it is asked for"),
    ("feature-expectations", MOMENTS, {"features": {"a": [4], "b": [3]}}, "estimate: leave gamma open"),
    ("feature-expectations", MOMENTS, {"trajectories": [["a"], []]}, "trajectories: one of them has no states"),
    ("feature-expectations-policy", MATCHED, {"policy": {"a": {"x": 1}}}, "matched: leave one number open"),
    ("feature-expectations-policy", MATCHED, {"features": {"a": [4, 1]}}, "matched: leave one number open"),
    ("ddp-backward", DDP, {"step": 1}, "the dynamics give the next state itself here; leave out 'step' and 'where'"),
    ("ddp-backward", DDP, {"reward": "-(v^2 + k*u^2)"}, "the reward holds 'k', which has no value"),
    ("ddp-backward", DDP, {"gradient": [-3, 1]}, "gradient has 2 entries, but the state 1"),
    ("ddp-backward", DDP, {"hessian": [[-2, 0], [0, -1]]}, "hessian"),
    ("linearise-affine", AFFINE, {"step": None}, "step is missing: the 1 that is added to the state stays 1"),
    ("lqr-gain", GAIN, {"start": [2, 1]}, "start has 2 entries, but the state 1"),
    ("lqr-gain", GAIN, {"start": None}, "action: it goes with a start, and with a price that R leaves open"),
    ("lqr-gain", GAIN, {"R": 1}, "action: it goes with a start, and with a price that R leaves open"),
    ("lqr-gain", GAIN | {"action": None}, {"B": [[1, 1]], "R": [["rho", 0], [0, 1]]},
     "R: a price can only be left open where there is one action"),
    ("lqr-infinite", CLOSED, {"closed_loop": None}, "Q and R: a price may be left open only with a closed_loop"),
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
    ("bandit", BARS, {"between": ["x", "z"]}, "between: 'z' was never pulled"),
    ("bandit", BARS, {"between": ["y", "x"]}, "between: "),
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
    found = Finding(family(name), 1)
    examine(solve(Problem(family(name), family(name).read(given))), found)
    assert not found.disagreements
    assert not found.refused
