"""How likely the ways to err are, as data: weights that only their ratios matter of."""

#: Edits of a formula, made wherever it is read.
IDEAS = {
    "term-left-out": 10.0,
    "factor-left-out": 10.0,
    "sign": 8.0,
    "index": 6.0,
    "complement": 4.0,
    "max-taken": 8.0,
    "mean-taken": 8.0,
    "min-taken": 5.0,
    "sum-taken": 5.0,
    "bracket": 5.0,
    "inverse": 6.0,
    "transposed": 6.0,
    "upside-down": 4.0,
    "difference": 4.0,
    "order-of-factors": 4.0,
    "exchanged": 4.0,
    "choice": 4.0,
    "case": 4.0,
    "power": 4.0,
    "root": 4.0,
    "function": 3.0,
    "smallest": 4.0,
    "power-as-product": 2.0,
    "confused": 2.0,
    "squared": 2.0,
    "twice": 2.0,
    "added": 1.0,
    "divided": 1.5,
}
#: How much less likely an edit is at one application alone, and in one term of a sum alone.
AT_ONE, IN_ONE_TERM = 0.5, 0.3

#: Slips in the value of a step.
VALUES = {
    "kept": 5.0,
    "sign": 4.0,
    "tenfold": 1.5,
    "one-off": 1.2,
    "digits": 1.2,
    "numerator": 0.8,
    "denominator": 0.8,
    "inverse": 1.0,
    "doubled": 1.0,
    "halved": 1.0,
    "repeated": 1.5,
}
#: Slips in a value that is put in, or found on the way.
INSIDE = {"minus-lost": 4.0, "sign": 1.0, "tenfold": 1.0, "elsewhere": 1.5, "digits": 0.6, "one-off": 0.5,
          "numerator": 0.3, "denominator": 0.3, "inverse": 0.8, "doubled": 0.4, "halved": 0.4}  # fmt: skip

#: What is done with the whole procedure.
PROCEDURE = {
    "stale": 6.0,
    "early": 5.0,
    "round-left-out": 5.0,
    "one-too-many": 4.0,
    "one-too-few": 4.0,
    "givens-exchanged": 2.0,
    "rows-exchanged": 1.0,
    "minus-lost": 3.0,
    "complement": 1.0,
    "reversed": 1.5,
    "entry-left-out": 1.5,
    "entries-exchanged": 1.0,
}

#: What happens between the working and the answer.
ANSWERS = {
    "another-quantity": 3.0,
    "exchanged-cells": 4.0,
    "all-signs": 5.0,
    "sign": 4.0,
    "answer-transposed": 5.0,
    "answer-scaled": 1.5,
    "one-minus": 2.0,
    "inverse": 2.0,
    "tenfold": 1.5,
    "one-off": 1.0,
    "digits": 1.0,
    "numerator": 0.7,
    "denominator": 0.7,
    "doubled": 0.8,
    "halved": 0.8,
    "percent": 2.0,
}

#: A mistake that somebody thought of when the family was written.
LISTED = 20.0
