"""Only names reach the compiler."""

import pytest
import sympy

from rldrill.solutions.formula.compiling import value_of


@pytest.mark.parametrize("name", ["x: __import__('os')", "1", "lambda", "a b", ""])
def test_a_letter_that_is_no_name_is_refused(name: str) -> None:
    with pytest.raises(ValueError, match="not the name of a letter"):
        value_of(sympy.Symbol(name) + 1, {name: 1})
