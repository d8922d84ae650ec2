"""Write the golden file of draws anew: run it after raising a family's REVISION, and review the diff."""

import json
from pathlib import Path

from rldrill.problems.catalogue import families, family
from rldrill.solutions.drawing import draw

problems = {
    str(solution.problem.identity): solution.problem.data()["given"]
    for name in families()
    for level in family(name).levels
    for solution in (draw(name, level, seed) for seed in (0, 1))
}
path = Path(__file__).parent / "draws.json"
path.write_text(json.dumps(problems, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")
