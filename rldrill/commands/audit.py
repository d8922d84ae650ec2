"""``rldrill audit``."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rldrill.commands.arguments import Json, Names

if TYPE_CHECKING:
    from rldrill.audit.checking import Finding

NAME = "audit"
_KEYS = ("Drawn", "Disagreements", "Refused", "Impossible", "Ties", "Mistakes recognised")
_QUESTIONS = ("Idle givens", "Guessed", "Largest", "Min/point", "Different", "Structures", "Attempts")


def command(
    names: Names = None,
    number: Annotated[
        int, typer.Option("--number", "-n", min=1, max=100_000, help="Problems per family and level.")
    ] = 200,
    seed: Annotated[int, typer.Option("--seed", "-s", min=0, help="Which problems.")] = 0,
    exam: Annotated[
        Path | None, typer.Option("--manifest", metavar="EXAM.json", help="Check the keys of a saved exam instead.")
    ] = None,
    json: Json = False,
) -> None:
    """Hold the exact answers against independent solvers; exit 1 on any disagreement.

    Every problem's answers are compared with those of a second solver, written in numpy without the
    formulas; every listed mistake is typed as an answer and must be recognised. What the draws are like as
    questions is told beside: givens that no answer depends on, what constant answers earn, how large the numbers are,
    minutes a point, how many problems and structures differ, how many attempts a draw takes.

    With --manifest every key of that exam is derived again, from the givens that it holds, and held against the other
    solver; what the problems are like as questions is the examiner's own choice then.

    Examples: rldrill audit -n 20 · rldrill audit bellman --json · rldrill audit --manifest exam.json
    """
    import sys

    from rich.progress import Progress

    from rldrill.audit.checking import audit, audit_exam
    from rldrill.problems.catalogue import selection
    from rldrill.problems.errors import UsageError
    from rldrill.render.terminal import console

    if exam is not None:
        if names:
            raise UsageError("A manifest names its families itself; leave out either --manifest or the names.")
        _tell(list(audit_exam(exam)), json=json, questions=False)
        return
    print(f"seed {seed}", file=sys.stderr)
    total = number * sum(len(family.levels) for family in selection(tuple(names or ())))
    with Progress(console=console(stderr=True), transient=True, disable=not sys.stderr.isatty()) as bar:
        task = bar.add_task("audit", total=total)
        findings = list(audit(tuple(names or ()), number, seed, lambda: bar.advance(task)))
    _tell(findings, json=json, questions=True)


def _tell(findings: "list[Finding]", *, json: bool, questions: bool) -> None:
    import sys

    from rldrill.commands.output import print_json
    from rldrill.render.terminal import console, table

    if json:
        print_json([finding.data() for finding in findings])
    else:
        for header, row in ((_KEYS, _keys), (_QUESTIONS, _questions))[: 2 if questions else 1]:
            rows = [(finding.family.name, str(finding.level), *row(finding)) for finding in findings]
            console().print(table(("Family", "Level", *header), rows, right=("Level", *header)))
    for finding in findings:
        complaints = finding.complaints if questions else ()
        for line in (*finding.disagreements, *finding.refused, *finding.unrecognised, *finding.impossible, *complaints):
            print(line, file=sys.stderr)
    if not all(finding.clean for finding in findings):
        raise typer.Exit(1)


def _keys(finding: "Finding") -> tuple[str, ...]:
    """How the keys fare."""
    share = f"{100 * finding.recognised / finding.made:.0f} % of {finding.made}" if finding.made else "–"
    found = (finding.disagreements, finding.refused, finding.impossible)
    return (str(finding.drawn), *(str(len(each)) for each in found), str(finding.ties), share)


def _questions(finding: "Finding") -> tuple[str, ...]:
    """What the questions are like."""
    from statistics import median

    figures = finding.figures
    return (
        f"{100 * len(figures.idle) / figures.drawn:.0f} %", f"{100 * figures.guesses.share:.0f} %",
        f"{median(figures.largest):g}", f"{min(figures.rates):.1f}–{max(figures.rates):.1f}",
        str(len(figures.problems)), str(len(figures.structures)), f"{median(figures.attempts):g}",
    )  # fmt: skip
