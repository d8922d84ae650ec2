"""Hypothesis profiles: ``--hypothesis-profile=quick`` reports a failing case at once, without making it smaller.

No case has a deadline: a busy machine is no fault of the program.

And a history of the tests' own: none of them writes into that of whoever runs them.

No test may leave another zero byte behind: Python has one alone, over which quicktions writes where it reads a text of
one sign (``rldrill.problems.fractions.fraction_of``).
"""

from collections.abc import Iterator

import pytest
from hypothesis import Phase, settings

settings.register_profile("patient", deadline=None)
settings.register_profile("quick", deadline=None, phases=[Phase.explicit, Phase.generate])
settings.load_profile("patient")


@pytest.fixture(autouse=True)
def zero_bytes() -> Iterator[None]:
    yield
    assert bytes([0])[0] == 0, "a number was read by Fraction(text) in place of fraction_of(text)"


@pytest.fixture(autouse=True)
def own_history(monkeypatch: pytest.MonkeyPatch, tmp_path_factory: pytest.TempPathFactory) -> None:
    monkeypatch.setenv("RLDRILL_HOME", str(tmp_path_factory.getbasetemp() / "rldrill-home"))
