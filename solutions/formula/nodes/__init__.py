"""The kinds of part that formulas have and sympy has not."""
