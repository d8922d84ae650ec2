"""How likely the ways to err are, as data: weights that only their ratios matter of."""

#: Edits of a formula, made wherever it is read.
IDEAS = {
    "term-left-out": 10.0,
    "factor-left-out": 10.0,
    "sign": 8.0,
    "index": 6.0,
    "mean-for-max": 8.0,
    "inverse": 6.0,
    "transposed": 6.0,
    "min-for-max": 5.5,
    "bracket": 5.0,
    "sum-for-max": 4.5,
    "upside-down": 4.2,
    "complement": 4.0,
    "difference": 3.8,
    "order-of-factors": 3.6,
    "exchanged": 3.5,
    "arguments-exchanged": 5.0,
    "factor-moved": 3.0,
    "other-table": 12.0,
    "choice": 3.4,
    "case": 3.4,
    "range": 3.3,
    "power": 3.2,
    "root": 3.0,
    "other-taken": 3.0,
    "function": 2.8,
    "smallest": 2.8,
    "sum-for-mean": 3.0,
    "mean-for-sum": 2.0,
    "max-for-sum": 1.5,
    "max-for-mean": 1.5,
    "power-as-product": 2.0,
    "power-of-sum": 4.0,
    "power-of-terms": 2.5,
    "confused": 1.8,
    "bracket-left-out": 1.7,
    "summand-left-out": 14.0,
    "summand-sign": 8.0,
    "factor-for-one": 8.0,
    "factor-for-all": 5.0,
    "squared": 1.6,
    "only-factor-left-out": 1.5,
    "twice": 1.4,
    "twin": 1.3,
    "divided": 1.2,
    "added": 1.1,
    "complement-of-value": 5.0,
    "squared-value": 0.6,
    "min-for-sum": 0.4,
    "min-for-mean": 0.4,
    "max-for-product": 0.3,
    "min-for-product": 0.3,
    "mean-for-product": 0.3,
    "sum-for-product": 2.0,
}
#: Causes that say the same, if they are made at the same place, in parts of which one is in the other.
ALIKE = (
    {"sign", "summand-sign", "difference", "all-signs", "minus-lost"},
    {"squared", "squared-value", "power"},
    {"numerator", "one-off"},
    {"denominator", "one-off"},
    {"inverse", "upside-down", "divided"},
    {"factor-left-out", "bracket-left-out", "only-factor-left-out"},
    {"halved", "doubled"},
    {"exchanged-cells", "rows-exchanged"},
    {"exchanged", "givens-exchanged"},
    {"another-quantity", "another-part"},
    {"answer-rearranged", "answer-reversed", "answer-transposed"},
    {"reversed", "entries-exchanged"},
    {"twin", "other-table", "elsewhere", "another-line", "index"},
    {"other-taken", "min-for-max", "elsewhere", "another-line", "choice"},
)
#: The same of one and the same part: what is left out leaves the old value, or the sum without one of its terms.
LEFT_OUT = frozenset(("kept", "summand-left-out", "term-left-out"))
#: Slips of arithmetic that are told in the same words.
SLIPS = frozenset(("numerator", "denominator", "one-off", "doubled", "halved"))
#: How much less likely it is that somebody takes 1 − x for x where x is no share of 1.
NO_SHARE = 0.05
#: How much less likely an edit is at one application alone, and in one term of a sum alone.
AT_ONE, IN_ONE_TERM = 0.5, 0.3

#: Slips in the value of a step.
VALUES = {
    "kept": 5.0,
    "stale": 3.0,
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
    "lost-term": 1.5,
    "term-sign": 1.5,
    "term-tenfold": 0.5,
}
#: Slips in a value that is put in, or found on the way.
INSIDE = {
    "crosswise": 1.5, "complement": 1.0, "minus-lost": 4.0, "sign": 1.0, "tenfold": 1.0, "elsewhere": 1.5,
    "another-line": 1.4, "stale": 2.5,
    "digits": 0.6, "one-off": 0.5, "numerator": 0.3, "denominator": 0.3, "inverse": 0.8, "doubled": 0.4, "halved": 0.4,
    "lost-term": 1.0, "term-sign": 1.0, "term-tenfold": 0.5,
    "inverse-signs": 3.0, "inverse-diagonal": 2.5, "inverse-undivided": 2.5,
}  # fmt: skip

#: What is done with the whole procedure.
PROCEDURE = {
    "stale": 6.0,
    "early": 5.0,
    "round-left-out": 5.0,
    "one-too-many": 4.0,
    "one-too-few": 4.0,
    "counted-again": 1.5,
    "givens-exchanged": 2.0,
    "rows-exchanged": 1.0,
    "lines-exchanged": 1.5,
    "another-row": 2.0,
    "another-cell": 1.4,
    "earlier-time": 9.0,
    "led-elsewhere": 1.5,
    "rows-and-columns": 9.0,
    "as-above": 1.0,
    "end-unpaid": 6.0,
    "minus-lost": 3.0,
    "complement": 1.0,
    "reversed": 2.5,
    "entry-left-out": 1.5,
    "entries-exchanged": 1.0,
    "number-moved": 5.0,
    "unknown-moved": 4.0,
    "multiplied": 2.0,
    "unsolved": 3.0,
}
#: How much less likely it is that somebody errs here alone who did the same rightly in a part before.
HERE_ALONE = 0.5

#: How much less likely it is that somebody does not go on from the right answer to a part before.
ANEW = 0.2

#: What happens between the working and the answer.
ANSWERS = {
    "another-quantity": 3.0,
    "another-part": 4.0,
    "as-given": 2.0,
    "other-side": 20.0,
    "exchanged-cells": 4.0,
    "all-signs": 9.0,
    "sign": 9.0,
    "answer-reversed": 5.0,
    "answer-rearranged": 4.0,
    "answer-transposed": 5.0,
    "answer-scaled": 0.4,
    "one-minus": 6.0,
    "inverse": 2.0,
    "tenfold": 1.5,
    "one-off": 1.0,
    "digits": 1.0,
    "numerator": 0.7,
    "denominator": 0.7,
    "doubled": 0.8,
    "halved": 0.8,
    "percent": 2.0,
    "standard-deviation": 6.0,
    "lost-term": 1.5,
    "term-sign": 2.0,
    "term-tenfold": 0.5,
}

#: How much likelier it is that somebody gives 1 minus the answer where one of two shares is asked for.
OF_TWO = 12.0
#: Beside other causes another line of the same table, read in one term of a sum, counts so many times its weight.
BESIDE_OTHERS = 6.0
#: How much less likely it is that a number that is typed with more digits than needed has wrong ones behind the third.
LOOSE = 0.1
#: A mistake that somebody thought of when the family was written.
LISTED = 20.0
#: One that is stated beside a formula, but that the family does not list.
STATED = 8.0
