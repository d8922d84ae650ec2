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
    ("denavit-hartenberg", {"links": [{"theta": "pi/2", "d": 1, "a": 2, "alpha": 0}] * 2}),
    ("denavit-hartenberg", {"links": [{"theta": "pi/2", "d": 1, "a": 2, "alpha": 0}], "asked": "back",
                            "point": [1, 2, 3]}),
    ("denavit-hartenberg", {"links": [{"theta": "pi/2", "d": 1, "a": 2, "alpha": 0}], "asked": "point",
                            "point": [1, 2, 3]}),
    ("model-fitting", {"sample": {"values": [7, 9, 8], "prior": {"mean": 6, "variance": 1, "noise": 2}}}),
    ("model-fitting", {"line": {"points": [[0, 1], [1, 3], [2, 2]], "prior": {"variance": 1, "noise": 1}}}),
    ("model-comparison", {"models": {"x": {}, "y": {"theta": "1/2"}, "z": {"thetas": [["1/4", 1]]}},
                          "prior": {"x": "1/2", "y": "1/4", "z": "1/4"}, "heads": 2, "tails": 1}),
    ("bic", {"border": "more", "fitted": {"x": {"likelihood": "1/4", "k": 1}, "y": {"likelihood": "1/2", "k": 2}}}),
    ("bic", {"data": {"tosses": {"x": [1, 3]}, "models": ["fair", "shared"]}}),
]  # fmt: skip
