"""A system of equations is solved line by line, as somebody does it with paper and pencil."""

from flint import fmpq
from sympy import Symbol

from rldrill.render.mathematics.unicode import unicode
from rldrill.solutions.formula.elimination import elimination, largest
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
    # x = 1 + ½y, y = 2 + ½x, so 2x = 2 + y and 2y = 4 + x. Twice the second: 4y = 8 + 2x = 8 + 2 + y, so 3y = 10.
    assert lines(x=Affine({"y": fmpq(1, 2)}, fmpq(1)), y=Affine({"x": fmpq(1, 2)}, fmpq(2))) == [
        "Multiplied out:",
        "x = 1 + 1/2·y",
        "y = 2 + 1/2·x",
        "2x = 2 + y",
        "2y = 4 + x",
        "4y = 8 + 2x = 8 + 2 + y = 10 + y",
        "3y = 10",
        "y = 10/3",
        "2x = 2 + 10/3 = 16/3",
        "x = 8/3",
    ]


def test_an_equation_that_stands_alone_comes_first() -> None:
    # z = 6 is known; y = 1 + z = 7; x = ½y + ⅓z = 7/2 + 2.
    found = lines(
        x=Affine({"y": fmpq(1, 2), "z": fmpq(1, 3)}), y=Affine({"z": fmpq(1)}, fmpq(1)), z=Affine({}, fmpq(6))
    )
    assert found[4:] == ["x = 1/2·y + 1/3·6 = 2 + 1/2·y", "y = 1 + 6 = 7", "x = 2 + 1/2·7 = 11/2"]


def test_a_state_that_comes_back_to_itself_is_cleared_before_it_is_used() -> None:
    # x = 1 + ⅜x + ¼y: ⅝x = 1 + ¼y, 5x = 8 + 2y. y = 9 + ⅜y + ⅛x: 5y = 72 + x. 25y = 360 + 8 + 2y, 23y = 368.
    x, y = (
        Affine({"x": fmpq(3, 8), "y": fmpq(1, 4)}, fmpq(1)),
        Affine({"y": fmpq(3, 8), "x": fmpq(1, 8)}, fmpq(9)),
    )
    assert lines(x=x, y=y)[3:] == [
        "5/8·x = 1 + 1/4·y",
        "5x = 8 + 2y",
        "5/8·y = 9 + 1/8·x",
        "5y = 72 + x",
        "25y = 360 + 5x = 360 + 8 + 2y = 368 + 2y",
        "23y = 368",
        "y = 16",
        "5x = 8 + 2·16 = 40",
        "x = 8",
    ]


def test_a_letter_in_the_multiples_is_not_multiplied_out() -> None:
    # x = ½γy, y = 1 + ½γx: 2x = γy, 2y = 2 + γx; twice: 4y = 4 + 2γx = 4 + γ·γy, (4 − γ²)y = 4, x = 2γ/(4 − γ²).
    half = generator("gamma") * fmpq(1, 2)
    assert lines(x=Affine({"y": half}), y=Affine({"x": half}, fmpq(1)))[3:] == [
        "2x = γy",
        "2y = 2 + γx",
        "4y = 4 + 2γx = 4 + γ·γy = 4 + γ²y",
        "(4 − γ²) y = 4",
        "y = 4/(4 − γ²)",
        "2x = (γ·4)/(4 − γ²) = 4γ/(4 − γ²)",
        "x = 2γ/(4 − γ²)",
    ]


def test_what_is_multiplied_with_a_letter_stays_in_factors() -> None:
    # (2 − γ)x = 2 + γy and (2 − γ)y = γx: (2 − γ)²y = γ(2 − γ)x = γ(2 + γy), (4 − 4γ)y = 2γ,
    # y = γ/(2 − 2γ), (2 − γ)x = 2 + γ²/(2 − 2γ) = (4 − 4γ + γ²)/(2 − 2γ) = (2 − γ)²/(2 − 2γ).
    half = generator("gamma") * fmpq(1, 2)
    found = lines(x=Affine({"x": half, "y": half}, fmpq(1)), y=Affine({"x": half, "y": half}))
    assert found[3:] == [
        "(1 − 1/2·γ) x = 1 + 1/2·γy",
        "(2 − γ) x = 2 + γy",
        "(1 − 1/2·γ) y = 1/2·γx",
        "(2 − γ) y = γx",
        "(2 − γ)²y = γ(2 − γ) x = γ(2 + γy) = 2γ + γ²y",
        "(4 − 4γ) y = 2γ",
        "y = γ/(2 − 2γ)",
        "(2 − γ) x = 2 + (γ·γ)/(2 − 2γ) = (4 − 4γ + γ²)/(2 − 2γ)",
        "(2 − γ) x = ((2 − γ)·(2 − γ))/(2 − 2γ)",
        "x = (2 − γ)/(2 − 2γ)",
    ]


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


def test_the_largest_number_is_told_without_writing_the_lines() -> None:
    # 5x = 8 + 2y and 5y = 72 + x, as above: 25y = 360 + 5x = 360 + 8 + 2y = 368 + 2y.
    x, y = (
        Affine({"x": fmpq(3, 8), "y": fmpq(1, 4)}, fmpq(1)),
        Affine({"y": fmpq(3, 8), "x": fmpq(1, 8)}, fmpq(9)),
    )
    assert largest({"x": x, "y": y}) == 368
    assert largest({"x": fmpq(500)}) == 0  # nothing is eliminated
