"""How many minutes problems take, for what must not wait for the solver: the medians, kept in a file.

``tests/golden/write.py`` writes the file from the problems' own steps; a test holds it against them.
"""

import json
from functools import cache
from pathlib import Path

FILE = Path(__file__).parent / "minutes.json"


@cache
def minutes() -> dict[str, list[int]]:
    """For every family the expected minutes of its levels, whole and at least 1."""
    result: dict[str, list[int]] = json.loads(FILE.read_text(encoding="utf-8"))
    return result
