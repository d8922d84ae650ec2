"""Hypothesis profiles: ``--hypothesis-profile=quick`` reports a failing case at once, without making it smaller.

And a history of the tests' own: none of them writes into that of whoever runs them.
"""

import pytest
from hypothesis import Phase, settings

settings.register_profile("quick", phases=[Phase.explicit, Phase.generate])


@pytest.fixture(autouse=True)
def own_history(monkeypatch: pytest.MonkeyPatch, tmp_path_factory: pytest.TempPathFactory) -> None:
    monkeypatch.setenv("RLDRILL_HOME", str(tmp_path_factory.getbasetemp() / "rldrill-home"))
