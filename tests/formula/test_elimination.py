"""A system of equations is solved line by line, as somebody does it with paper and pencil."""

from flint import fmpq
from sympy import Symbol

from rldrill.render.mathematics.unicode import unicode
from rldrill.solutions.formula.elimination import elimination
from rldrill.solutions.formula.equations import Affine
from rldrill.solutions.formula.typesetting import typeset
from rldrill.solutions.rational import generator

NAMES = {"x": Symbol("x"), "y": Symbol("y"), "z": Symbol("z")}


def lines(**equations: object) -> list[str]:
    """The lines as one reads them."""
    names = {key: NAMES[key] for key in equations}
    written = []
    for line in elimination(names, equations):
        if isinstance(line, str):
            written.append(line)
        else:
            left, rights = line
            written.append(" = ".join(unicode(typeset(side)) for side in (left, *rights)))
    return written


def test_two_unknowns_by_hand() -> None:
    # x = 1 + ½y, y = 2 + ½x; so y = 2 + ½(1 + ½y) = 5/2 + ¼y, ¾y = 5/2, y = 10/3, x = 1 + 5/3 = 8/3.
    assert lines(x=Affine({"y": fmpq(1, 2)}, fmpq(1)), y=Affine({"x": fmpq(1, 2)}, fmpq(2))) == [
        "Multiplied out:",
        "x = 1 + 1/2·y",
        "y = 2 + 1/2·x",
        "y = 2 + 1/2·(1 + 1/2·y) = 5/2 + 1/4·y",
        "3/4·y = 5/2",
        "y = 10/3",
        "x = 1 + 1/2·10/3 = 8/3",
    ]


def test_an_equation_that_stands_alone_comes_first() -> None:
    # z = 6 is known; y = 1 + z = 7; x = ½y + ⅓z = 7/2 + 2.
    found = lines(
        x=Affine({"y": fmpq(1, 2), "z": fmpq(1, 3)}), y=Affine({"z": fmpq(1)}, fmpq(1)), z=Affine({}, fmpq(6))
    )
    assert found[4:] == ["x = 1/2·y + 1/3·6 = 2 + 1/2·y", "y = 1 + 6 = 7", "x = 2 + 1/2·7 = 11/2"]


def test_a_negative_multiple_is_subtracted() -> None:
    assert lines(x=Affine({"x": fmpq(-1, 2)}, fmpq(-3))) == [
        "Multiplied out:",
        "x = −3 − 1/2·x",
        "3/2·x = −3",
        "x = −2",
    ]


def test_with_an_open_parameter() -> None:
    # x = 1 + γx, so (1 − γ)x = 1.
    assert lines(x=Affine({"x": generator("gamma")}, fmpq(1)))[2:] == ["(1 − γ) x = 1", "x = 1/(1 − γ)"]


def test_what_is_already_solved_needs_no_words() -> None:
    assert lines(x=Affine({}, fmpq(5)), y=fmpq(2)) == []
