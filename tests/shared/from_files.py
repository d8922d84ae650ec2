"""Problems that are not drawn: small ones, whose formulas and mistakes only problem files reach."""

from typing import Any

#: Each with its family.
FROM_FILES: list[tuple[str, dict[str, Any]]] = [
    ("return", {"rewards": [1, 2], "gamma": ["1/2", 1]}),
    ("n-step-return", {"trajectory": {"states": ["a", "b"], "rewards": [1]}, "values": {"a": 1, "b": 2},
                       "gamma": ["1/2"], "asked": [[0, 1]]}),
    ("lambda-return", {"trajectory": {"states": ["a", "b", "end"], "rewards": [1, 1], "terminal": ["end"]},
                       "values": {"a": 1, "b": 2}, "gamma": ["1/2", 1], "lam": 1}),
    ("policy-value", {"mdp": {"transitions": [["a", "x", "a", "1/2", 2], ["a", "x", "b", "1/2", 0],
                                              ["b", "x", "a", 1, 3]]}, "average": True}),
    ("value-iteration", {"mdp": {"transitions": [["a", "x", "end", 1, 1]], "terminal": ["end"]}, "gamma": 1,
                         "sweeps": 1, "action_values": True}),
    ("td-lambda-backward", {"trajectory": {"states": ["a", "b"], "rewards": [1]}, "values": {"a": 1, "b": 2},
                            "alpha": 1, "gamma": 1, "lam": 1, "replacing": True}),
    ("eligibility-trace", {"states": ["a"], "gamma": 1, "lam": 1, "asked": [0], "replacing": True}),
    ("sarsa-lambda", {"trajectory": {"states": ["a", "b"], "actions": ["x"], "rewards": [1]},
                      "values": {"a": {"x": 1}, "b": {"x": 2}}, "alpha": 1, "gamma": 1, "lam": 1, "watkins": True,
                      "replacing": True}),
    ("ppo-clip", {"samples": [{"state": "s", "action": "a", "old": "1/2", "new": "3/4", "advantage": 1}],
                  "objective": "6/5"}),
    ("ppo-clip", {"samples": [{"state": "s", "action": "a", "old": "1/2", "new": "1/4", "advantage": -1}],
                  "objective": "-4/5"}),
    ("softmax-policy", {"theta": ["ln x"], "features": {"a": [1], "b": [0]}, "odds": ["a", "b", 3]}),
    ("rbf", {"centres": [[0], [4]], "sigma": 1, "logarithms": {"1": "-1/2", "2": "-9/2"}}),
    ("rbf", {"position": [2], "centres": [[0]], "logarithms": {"1": "-1/2"}}),
    ("piecewise-linear-rbf", {"centres": [[0], [4]], "width": 4, "known": {"1": "3/4", "2": "1/4"}}),
    ("piecewise-linear-rbf", {"position": [1], "centres": [[0]], "known": {"1": "1/2"}}),
    ("linear-value", {"theta": [1, 0, 0, 1], "actions": ["x", "y"], "bumps": {"centres": [[0], [2]], "width": 2}}),
    ("maml-step", {"tasks": [[1, 2]], "alpha": "1/2"}),
    ("maml-step", {"theta": 0, "tasks": [[1, 4]], "alpha": "1/2", "beta": "1/2", "first_order": True}),
]  # fmt: skip
