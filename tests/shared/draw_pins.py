"""A fingerprint of what every family draws: which numbers, shapes and questions it takes, and how often.

These are choices, and nobody can say by a rule that another range would be wrong. But an ID is the same problem
everywhere, so that a choice must not change by accident: not without another REVISION. Of the families named, or all:

    python tests/shared/draw_pins.py [FAMILY …]

writes the fingerprints anew, after a REVISION was raised or a family added.
"""

import json
import sys
from hashlib import sha256
from pathlib import Path
from typing import Any

from rldrill.problems.catalogue import families, family
from rldrill.problems.draws import Draws
from rldrill.problems.family import Family, trusted

FILE = Path(__file__).parent.parent / "problems" / "draws.json"
#: So many draws of each level go into a fingerprint: enough for what is drawn once in twenty times.
COUNTED = 100
#: What is asked is looked at in one draw of so many.
ASKED_OF = 5


def fingerprint(known: Family) -> dict[str, Any]:
    """The revision, and the hash of many draws, before any is looked at as a question."""
    keys = (f"{known.name}/{level}/{number}" for level in known.levels for number in range(COUNTED))
    with trusted():
        drawn = [known.draw(int(key.split("/")[1]), Draws(key)) for key in keys]
    # An answer of zeros, or of tied actions, is drawn again where it is not allowed for.
    allowed = [[(part.zero, part.ties) for part in known.question(given).parts] for given in drawn[::ASKED_OF]]
    data = [[given.model_dump(mode="json") for given in drawn], allowed]
    written = json.dumps(data, ensure_ascii=False, sort_keys=True)
    return {"revision": known.revision, "draws": sha256(written.encode()).hexdigest()[:16]}


def pinned() -> dict[str, dict[str, Any]]:
    """The fingerprints in the file, by family."""
    found: dict[str, dict[str, Any]] = json.loads(FILE.read_text(encoding="utf-8")) if FILE.exists() else {}
    return found


if __name__ == "__main__":
    written = pinned() | {name: fingerprint(family(name)) for name in sys.argv[1:] or families()}
    lines = ",\n".join(f" {json.dumps(name)}: {json.dumps(written[name])}" for name in families() if name in written)
    FILE.write_text(f"{{\n{lines}\n}}\n", encoding="utf-8")
