"""Change the program in one small place at a time, and see whether a test notices.

Our own code because of the two known tools mutmut changes only what stands in functions, and formulas do not, while
cosmic-ray runs one and the same command for every change, which here would be the whole suite.

    python tests/mutation/run.py --seed 1 -n 100 [--only PATH] [--workers 2] [--timeout 120] [--budget 40]
        [--coverage FILE] [--patience 1500] [--json]
"""

import argparse
import json
import random
import shutil
import sys
import tempfile
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import trial
from choice import Choice
from covering import Covering
from places import Mutation, Source, mutations, sources

ROOT = Path(__file__).parent.parent.parent
_BASELINE_SECONDS = 1800
#: They install the whole, set the pages of all families in one document, hold memory on purpose, or run the browser's
#: engine: that takes more memory than a run may, and what fails for that would count as what noticed a change.
_TOO_DEAR = (
    "tests/export/test_judge.py::",
    "tests/grading/test_isolation.py::test_memory_that_the_caller_holds",
    "tests/export/test_gallery.py::test_a_search",
    "tests/test_wheel.py::",
    "tests/render/test_typst.py::test_all_formulas_questions_and_workings_stay_inside_the_page",
    "tests/render/test_typst.py::test_they_do_so_in_a_narrow_column_too",
)


@dataclass(frozen=True)
class Outcome:
    """What became of one change."""

    path: str
    line: int
    kind: str
    before: str
    after: str
    outcome: str
    by: str
    tests_run: int
    seconds: float


def drawn(found: Sequence[Mutation], number: int, seed: int) -> list[Mutation]:
    """So many of the changes, each as likely as any other; all of them in another order where there are no more."""
    return random.Random(seed).sample(found, min(number, len(found)))


def check(killers: Iterable[str], copies: Sequence[Path]) -> None:
    """End the program if one of these tests fails in the unchanged tree, too."""
    run = trial.Run(tuple(killers), keep_going=True)
    ((_, result),) = trial.run_all([run], copies[:1], _BASELINE_SECONDS)
    if result.code is None:
        sys.exit("The tests hang or crash when nothing is changed; run them by themselves.")
    if result.failed:
        sys.exit("These tests fail when nothing is changed:\n" + "\n".join(result.failed))


def outcomes(
    places: Sequence[tuple[Source, Mutation]], runs: Sequence[trial.Run], copies: Sequence[Path], limit: float
) -> Iterator[tuple[int, Outcome]]:
    """Make every change, and yield its number and what became of it."""
    for number, result in trial.run_all(runs, copies, limit):
        source, mutation = places[number]
        outcome = "timed out" if result.hung else "survived" if result.code in {0, 5} else "killed"
        by = "" if outcome != "killed" else next(iter(result.failed), "pytest itself")
        shown = source.shown(mutation)
        yield (
            number,
            Outcome(
                *(source.path, source.line(mutation), mutation.kind, *shown, outcome, by),
                *(result.ran, round(result.seconds, 1)),
            ),
        )


def main() -> None:
    """Read the options, draw, run and report."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seed", type=int, default=1, help="the same seed draws the same places of the same tree")
    parser.add_argument("-n", type=int, default=100, help="how many changes")
    parser.add_argument("--only", action="append", default=[], metavar="PATH", help="a file or folder; may be repeated")
    parser.add_argument("--workers", type=int, default=2, help="how many at the same time")
    parser.add_argument(
        "--timeout", type=float, default=120, help="seconds of the processor after which a change counts as noticed"
    )
    parser.add_argument("--budget", type=float, default=40, help="seconds of the processor for the tests of one change")
    parser.add_argument("--patience", type=float, default=0, help="seconds for the other tests of those that survived")
    parser.add_argument("--coverage", type=Path, metavar="FILE", help="what coverage.py noted of the whole suite")
    parser.add_argument("--json", action="store_true", help="print everything as JSON")
    options = parser.parse_args()

    paths = trial.files(ROOT)
    by_path = {source.path: source for source in sources(ROOT, paths, options.only)}
    candidates = [mutation for source in by_path.values() for mutation in mutations(source)]
    places = [(by_path[mutation.path], mutation) for mutation in drawn(candidates, options.n, options.seed)]
    if not places:
        sys.exit("There is nothing to change.")
    with tempfile.TemporaryDirectory(prefix="rldrill-mutation-") as folder:
        copies = [Path(folder).resolve() / f"copy-{number}" for number in range(options.workers)]
        found = list(tried(places, copies, paths, options))
        report(found, len(candidates), options)
        check({outcome.by for outcome in found if "::" in outcome.by}, copies)


def tried(
    places: Sequence[tuple[Source, Mutation]], copies: Sequence[Path], paths: Sequence[str], options: argparse.Namespace
) -> Iterator[Outcome]:
    """Choose the tests of every change, make it, and yield the outcomes; what survived meets its other tests last."""
    trial.load()
    trial.copied(ROOT, paths, copies[0])
    ((_, collected),) = trial.run_all([trial.Run(collect_only=True)], copies[:1], _BASELINE_SECONDS)
    if collected.code != 0:
        sys.exit("The tests cannot be collected:\n" + "\n".join(collected.failed))
    for copy in copies[1:]:
        shutil.copytree(copies[0], copy, symlinks=True)
    seen = (test for test in collected.seen if not test.startswith(_TOO_DEAR))
    choice = Choice(copies[0], tuple(seen), options.coverage and Covering(options.coverage))
    runs = [
        trial.Run(choice.tests(source, mutation), source.path, source.changed(mutation), budget=options.budget)
        for source, mutation in places
    ]
    again = []
    for number, outcome in outcomes(places, runs, copies, options.timeout):
        _tell(outcome)
        if outcome.outcome == "survived" and options.patience:
            again.append(number)
        else:
            yield outcome
    longer = [
        replace(runs[number], tests=choice.tests(*places[number], far=True), budget=options.patience)
        for number in again
    ]
    for _, outcome in outcomes([places[number] for number in again], longer, copies, options.patience * 2):
        _tell(outcome)
        yield outcome


def _tell(outcome: Outcome) -> None:
    where = f"{outcome.path}:{outcome.line}"
    print(f"{outcome.outcome:9} {outcome.seconds:6.1f} s  {where}  {outcome.by}", file=sys.stderr)


def report(found: Sequence[Outcome], candidates: int, options: argparse.Namespace) -> None:
    """Print the survivors and the figures."""
    count = Counter(outcome.outcome for outcome in found)
    noticed = len(found) - count["survived"]
    percentage = round(100 * noticed / len(found), 1)
    found = sorted(found, key=lambda outcome: (outcome.path, outcome.line))
    if options.json:
        figures = {"seed": options.seed, "candidates": candidates, "changes": len(found), "killed": count["killed"]}
        figures |= {"timed out": count["timed out"], "survived": count["survived"], "percentage": percentage}
        print(json.dumps(figures | {"outcomes": [asdict(outcome) for outcome in found]}, ensure_ascii=False, indent=1))
        return
    for outcome in found:
        if outcome.outcome == "survived":
            print(f"{outcome.path}:{outcome.line}: {outcome.kind} (survived {outcome.tests_run} tests)")
            print(f"  - {outcome.before}\n  + {outcome.after}")
    print(
        f"{len(found)} of {candidates} possible changes, seed {options.seed}: {count['killed']} killed, "
        f"{count['timed out']} timed out, {count['survived']} survived; {percentage} % noticed"
    )


if __name__ == "__main__":
    main()
