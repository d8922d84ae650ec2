"""What is expected of families at their levels, for what must not wait for the solver, kept in files.

``tests/golden/write.py`` writes them from problems that it draws; tests hold them against others.
"""

import json
from functools import cache
from pathlib import Path

FILE = Path(__file__).parent / "minutes.json"
VARIETY = Path(__file__).parent / "variety.json"
#: Different answers are counted up to this.
COUNTED = 50


@cache
def minutes() -> dict[str, list[int]]:
    """For every family the expected minutes of its levels, whole and at least 1."""
    result: dict[str, list[int]] = json.loads(FILE.read_text(encoding="utf-8"))
    return result


@cache
def variety() -> dict[str, list[int]]:
    """For every family how many versions may have a problem of each level and share no answer; at most COUNTED."""
    result: dict[str, list[int]] = json.loads(VARIETY.read_text(encoding="utf-8"))
    return result
