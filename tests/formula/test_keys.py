"""The keys of the lecture's sheet, kept in ``keys.txt``: each is a formula here, and at least one family drills it."""

from pathlib import Path

import pytest

import rldrill
from from_files import FROM_FILES
from rldrill.problems.catalogue import families
from rldrill.solutions.sheet import formulas

KEYS = (Path(__file__).parent / "keys.txt").read_text(encoding="utf-8").split()


@pytest.mark.parametrize("key", KEYS)
def test_every_key_of_the_sheet_is_a_formula(key: str) -> None:
    assert key in formulas()


@pytest.fixture(scope="module")
def drilled() -> dict[str, set[str]]:
    """The families by the key of every formula that their workings use."""
    found: dict[str, set[str]] = {}
    for name, given in FROM_FILES:
        for formula in rldrill.read({"family": name, "given": given}).formulas():
            found.setdefault(formula.key, set()).add(name)
    for seed in range(1, 9):  # kinds of questions that are drawn seldom come with another seed
        for name in families():
            for level in (1, 2, 3):
                for formula in rldrill.draw(name, level, seed).formulas():
                    found.setdefault(formula.key, set()).add(name)
        if set(found) >= {*formulas(), *KEYS}:
            break
    return found


@pytest.mark.parametrize("key", KEYS)
def test_every_key_of_the_sheet_has_a_family(key: str, drilled: dict[str, set[str]]) -> None:
    assert drilled.get(key), f"no family's working uses {key}"


def test_every_formula_has_a_family(drilled: dict[str, set[str]]) -> None:
    assert not set(formulas()) - set(drilled)
