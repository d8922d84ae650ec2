"""The report as Gradescope's ``results.json``: one submission, a test for every part."""

import json
from dataclasses import replace
from fractions import Fraction
from typing import Any

from rldrill.grading.report import Report
from rldrill.grading.reports.said import located, one_line


def written(report: Report, feedback: str) -> str:
    """The results of one submission; what is in several files of it counts together, and nobody else is in it."""
    report = replace(report, students=tuple(student for student in report.students if student.paths))
    score = report.score
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
        for number, part in enumerate(report.parts, 1)
    ]
    said = [refusal.says for refusal in report.refused]
    said += [each for student in report.students for each in student.extra]
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
        "extra_data": {"of": score.of, "exact": str(score.points), "versions": _versions(report)},
        "tests": tests,
    }
    return json.dumps(results, ensure_ascii=False, indent=2) + "\n"


def _versions(report: Report) -> list[str]:
    return sorted({student.version for student in report.students if student.version})
