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
    ("value-iteration", {"mdp": {"transitions": [["a", "x", "b", 1, 1], ["a", "y", "end", 1, 2],
                                                 ["b", "x", "end", 1, 4]]}, "gamma": "gamma", "sweeps": 1, "tie": "a"}),
    ("td-lambda-backward", {"trajectory": {"states": ["a", "b"], "rewards": [1]}, "values": {"a": 1, "b": 2},
                            "alpha": 1, "gamma": 1, "lam": 1, "replacing": True}),
    ("eligibility-trace", {"states": ["a"], "gamma": 1, "lam": 1, "asked": [0], "replacing": True}),
    ("sarsa-lambda", {"trajectory": {"states": ["a", "b"], "actions": ["x"], "rewards": [1]},
                      "values": {"a": {"x": 1}, "b": {"x": 2}}, "alpha": 1, "gamma": 1, "lam": 1, "watkins": True,
                      "replacing": True}),
]  # fmt: skip
