"""The report as CSV: a row for every student and part, and one of totals for every student."""

import csv
import io
from collections.abc import Iterable, Sequence

from rldrill.grading.report import FEEDBACK, Report, StudentReport
from rldrill.grading.reports.said import one_line

#: What a spreadsheet takes for the beginning of a formula.
_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def written(report: Report, feedback: str) -> str:
    """A row for every student and part."""
    head = ["student", "number", "version", "problem", "part", "file", "line", "column", "points", "of"]
    amount = FEEDBACK.index(feedback)
    head += ["typed", "verdict"] if amount >= 1 else []
    head += ["reason"] if amount >= 2 else []
    head += ["key"] if amount >= 3 else []
    rows = (
        [
            student.student, student.number, student.version, part.problem, part.part,
            part.path, str(part.line or ""), str(part.column or ""),
            f"{float(part.score.points):.6g}", str(part.score.of), part.typed, part.judged.verdict, part.judged.reason,
            part.judged.key,
        ][: len(head)]
        for student in report.students
        for part in student.parts
    )  # fmt: skip
    return _csv([head, *rows])


def totals(report: Report) -> str:
    """A row for every student."""
    rows = (
        [
            student.student, student.number, student.version, f"{float(student.score.points):.6g}",
            str(student.score.of), student.score.percent(4), *_scaled(report, student),
            "yes" if report.passed(student) else "no", student.remark,
        ]
        for student in report.students
    )  # fmt: skip
    scaled = [] if report.scale is None else ["scaled", "scaled of"]
    return _csv([["student", "number", "version", "points", "of", "percent", *scaled, "passed", "remark"], *rows])


def _scaled(report: Report, student: StudentReport) -> Sequence[str]:
    scaled = report.scaled(student)
    return () if scaled is None else (f"{float(scaled.points):.6g}", str(scaled.of))


def _csv(rows: Iterable[Sequence[str]]) -> str:
    file = io.StringIO()
    csv.writer(file).writerows([_harmless(cell) for cell in row] for row in rows)
    return file.getvalue()


def _harmless(cell: str) -> str:
    """A cell that no spreadsheet runs as a formula; a plain number stays one."""
    text = one_line(cell)
    if not text.lstrip().startswith(_FORMULA) or text.lstrip("-").replace(".", "", 1).isdecimal():
        return text
    return f"'{text}"
