"""What a family's draws promise: numbers with which roots and logarithms come out, worked out here by themselves."""

from collections.abc import Iterator
from fractions import Fraction
from math import isqrt
from typing import Any

from rldrill.problems.catalogue import family
from rldrill.problems.draws import Draws
from rldrill.problems.family import trusted


def drawn(name: str, levels: tuple[int, ...], number: int = 60) -> Iterator[Any]:
    for level in levels:
        for key in range(number):
            with trusted():
                yield family(name).draw(level, Draws(f"promise {level} {key}"))


def is_square(number: Fraction) -> bool:
    return all(isqrt(whole) ** 2 == whole for whole in (number.numerator, number.denominator))


def test_the_scalar_riccati_equation_has_a_rational_root() -> None:
    for given in drawn("lqr-infinite", (1, 2)):
        assert all(
            given.A[i][j] == given.B[i][j] == 0 for i in range(len(given.A)) for j in range(len(given.A)) if i != j
        )
        for i in range(len(given.A)):
            a, b, q, r = (Fraction(matrix[i][i]) for matrix in (given.A, given.B, given.Q, given.R))
            n, gamma = Fraction(given.N[i][i] if given.N else 0), Fraction(given.gamma)
            beta = gamma * b**2 * q + (gamma * a**2 - 1) * r - 2 * gamma * a * b * n
            assert is_square(beta**2 + 4 * gamma * b**2 * (q * r - n**2))
            assert q * r > n**2


def test_two_coupled_systems_have_whole_numbers_and_roots_for_sum_and_difference() -> None:
    coupled = [given for given in drawn("lqr-infinite", (3,)) if len(given.A) == 2]
    assert len(coupled) > 5
    for given in coupled:
        for matrix in (given.A, given.B, given.Q, given.R):
            (one, two), (three, four) = matrix
            assert (one, two) == (four, three)
            assert Fraction(one).denominator == Fraction(two).denominator == 1
        for sign in (1, -1):
            a, b, q, r = (matrix[0][0] + sign * matrix[0][1] for matrix in (given.A, given.B, given.Q, given.R))
            assert is_square(Fraction((b**2 * q + (a**2 - 1) * r) ** 2 + 4 * b**2 * q * r))
        assert given.A[0][1] != 0


def test_tosses_have_logarithms_of_2_and_3_alone() -> None:
    tossed = [given.data.tosses for given in drawn("bic", (1, 2, 3)) if given.data]
    assert len(tossed) > 5
    for tosses in tossed:
        heads, tails = (sum(side) for side in zip(*tosses.values(), strict=True))
        for coin in (*tosses.values(), (heads, tails)):
            for number in (*coin, sum(coin)):
                assert 6**9 % number == 0, coin
            assert sum(coin) > 3
        if len(tosses) > 1:
            assert len({Fraction(*coin) for coin in tosses.values()}) == len(tosses)
