"""``rldrill audit``."""

from typing import Annotated

import typer

from rldrill.commands.arguments import Json, Names

NAME = "audit"


def command(
    names: Names = None,
    number: Annotated[
        int, typer.Option("--number", "-n", min=1, max=100_000, help="Problems per family and level.")
    ] = 200,
    seed: Annotated[int, typer.Option("--seed", "-s", min=0, help="Which problems.")] = 0,
    json: Json = False,
) -> None:
    """Hold the exact answers against independent solvers; exit 1 on any disagreement.

    Every problem's answers are compared with those of a second solver, written in numpy without the
    formulas; every listed mistake is typed as an answer and must be recognised.

    Examples: rldrill audit -n 20 · rldrill audit bellman --json
    """
    import sys

    from rich.progress import Progress

    from rldrill.audit import audit
    from rldrill.commands.output import print_json
    from rldrill.problems.catalogue import selection
    from rldrill.render.terminal import console, table

    print(f"seed {seed}", file=sys.stderr)
    total = number * sum(len(family.levels) for family in selection(tuple(names or ())))
    with Progress(console=console(stderr=True), transient=True, disable=not sys.stderr.isatty()) as bar:
        task = bar.add_task("audit", total=total)
        findings = list(audit(tuple(names or ()), number, seed, lambda: bar.advance(task)))
    if json:
        print_json([finding.data() for finding in findings])
    else:
        header = ("Family", "Level", "Drawn", "Disagreements", "Refused", "Ties", "Mistakes recognised")
        rows = []
        for finding in findings:
            share = f"{100 * finding.recognised / finding.made:.0f} % of {finding.made}" if finding.made else "–"
            rows.append((
                finding.family.name, str(finding.level), str(finding.drawn), str(len(finding.disagreements)),
                str(len(finding.refused)), str(finding.ties), share,
            ))  # fmt: skip
        console().print(table(header, rows, right=header[1:]))
    for finding in findings:
        for line in (*finding.disagreements, *finding.refused, *finding.unrecognised):
            print(line, file=sys.stderr)
    if not all(finding.clean for finding in findings):
        raise typer.Exit(1)
