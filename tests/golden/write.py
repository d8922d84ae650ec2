"""Write the golden files anew: after adding a family, or raising a REVISION. Review the diff."""

import json
from pathlib import Path
from statistics import median

from rldrill.exam.expected import FILE
from rldrill.problems.catalogue import families, family
from rldrill.solutions.drawing import draw
from rldrill.solutions.effort import minutes, whole

SEEDS = range(15)

problems = {
    str(solution.problem.identity): solution.problem.data()["given"]
    for name in families()
    for level in family(name).levels
    for solution in (draw(name, level, seed) for seed in (0, 1))
}
expected = {
    name: [whole(median(minutes(draw(name, level, seed)) for seed in SEEDS)) for level in family(name).levels]
    for name in families()
}
path = Path(__file__).parent / "draws.json"
path.write_text(json.dumps(problems, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")
lines = ",\n".join(f" {json.dumps(name)}: {json.dumps(times)}" for name, times in expected.items())
FILE.write_text(f"{{\n{lines}\n}}\n", encoding="utf-8")
