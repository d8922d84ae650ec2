"""The report as Gradescope's ``results.json``: one submission, a test for every part."""

import json
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from rldrill.grading.report import MISSING, MarkedPart, Report, StudentReport, total
from rldrill.grading.reports.said import located, one_line


def written(report: Report, feedback: str) -> str:
    """The results of one submission, whatever names stand in it: every part counts once, and nobody else is in it."""
    handed_in = [student for student in report.students if student.paths]
    parts, twice = _submitted(handed_in)
    score = total(part.score for part in parts)
    factor = Fraction(1) if report.scale is None or not score.of else Fraction(report.scale, score.of)
    tests: list[dict[str, Any]] = [
        {
            "name": one_line(f"{part.problem} ({part.part})"),
            "number": str(number),
            "score": round(float(part.score.points * factor), 2),
            "max_score": round(float(part.score.of * factor), 2),
            "output": one_line(located(part, feedback)),
            "output_format": "text",
            "visibility": "visible",
        }
        | ({} if feedback == "none" else {"status": "passed" if part.judged.accepted else "failed"})
        for number, part in enumerate(parts, 1)
    ]
    said = [refusal.says for refusal in report.refused]
    said += [each for student in handed_in for each in student.extra]
    said += twice
    if feedback == "none":
        tests = []
        said.insert(0, "Your answers were read; the points are told later.")
    results: dict[str, Any] = {
        "score": round(float(score.points * factor), 2),
        "output": "\n".join(map(one_line, said)),
        "output_format": "text",
        "test_output_format": "text",
        "visibility": "hidden" if feedback == "none" else "visible",
        "stdout_visibility": "hidden",
        "extra_data": {"of": score.of, "exact": str(score.points), "versions": _versions(handed_in[:1])},
        "tests": tests,
    }
    return json.dumps(results, ensure_ascii=False, indent=2) + "\n"


def _submitted(students: Sequence[StudentReport]) -> tuple[list[MarkedPart], list[str]]:
    """The parts of one submission, each with its first answer; and what of it does not count.

    Otherwise somebody who hands in the same twice under two names would have twice the points, and who guesses twice
    would be right once.
    """
    found: dict[tuple[str, str], MarkedPart] = {}
    said: dict[str, None] = {}
    for student in students:
        if student.version != students[0].version:
            said[f"Only answers to version {students[0].version} count, and none to version {student.version}."] = None
            continue
        for part in student.parts:
            before = found.setdefault((part.problem, part.part), part)
            if before is part or part.judged.verdict == MISSING:
                continue
            if before.judged.verdict == MISSING:
                found[part.problem, part.part] = part
            else:
                said[f"{part.problem} ({part.part}) is answered more than once; the first answer counts."] = None
    return list(found.values()), list(said)


def _versions(students: Sequence[StudentReport]) -> list[str]:
    return [student.version for student in students if student.version]
