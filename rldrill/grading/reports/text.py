"""The report as plain text, a line for every part."""

from rldrill.grading.report import Report, Score, StudentReport
from rldrill.grading.reports.said import located, one_line


def written(report: Report, feedback: str) -> str:
    """All students with all their parts, and what could not be graded."""
    lines = [one_line(report.title), ""] if report.title else []
    tells = feedback != "none"
    for student in report.students:
        lines += [f"{named(student)}: {earned(report, student) if tells else student.remark or 'read'}"]
        for part in student.parts if student.paths and tells else ():
            got = f"{part.score.points} of {part.score.of}"
            lines.append(f"  {part.problem} ({part.part})  {got}  {one_line(located(part, feedback))}".rstrip())
        lines += [f"  {one_line(said)}" for said in student.extra]
    lines += [f"Not graded: {one_line(refusal.says)}" for refusal in report.refused]
    lines += [f"All together: {points(report.score)}"] if tells else []
    return "\n".join(lines) + "\n"


def totals(report: Report) -> str:
    """A line for every student, and the sum."""
    lines = [f"{named(student)}: {earned(report, student)}" for student in report.students]
    return "\n".join([*lines, f"All together: {points(report.score)}"]) + "\n"


def named(student: StudentReport) -> str:
    """Who it is, and of which version."""
    who = student.student or ", ".join(student.paths)
    return one_line(f"{who}, version {student.version}" if student.version else who)


def earned(report: Report, student: StudentReport) -> str:
    """A student's points, on the exam's scale too, if it has one."""
    scaled = report.scaled(student)
    more = "" if scaled is None else f", {float(scaled.points):.6g} of {scaled.of}"
    return ", ".join(filter(None, (f"{points(student.score)}{more}", student.remark)))


def points(score: Score) -> str:
    """The points, with their share."""
    return f"{score.points} of {score.of} ({score.percent()} %)"
