"""The report for GitHub: annotations at the lines of the answers, and a table for the summary of the step."""

from collections.abc import Iterator

from rldrill.grading.report import MarkedPart, Report, StudentReport
from rldrill.grading.reports.said import one_line, sentence

#: GitHub shows no more annotations of a step.
_MOST = 10
#: A summary may have a mebibyte; what is longer is cut between rows.
_LONGEST = 1_000_000


def written(report: Report, feedback: str) -> str:
    """The commands that annotate: first what could not be graded, then what is wrong; at most ten."""
    found = [*_refused(report), *_wrong(report, feedback)]
    shown = found[:_MOST] if len(found) <= _MOST else found[: _MOST - 1]
    if len(found) > _MOST:
        shown.append(f"::notice title=rldrill::{len(found) - len(shown)} more are in the summary of this step.")
    return "".join(f"{line}\n" for line in shown)


def summary(report: Report, feedback: str) -> str:
    """The table for ``$GITHUB_STEP_SUMMARY``, as Markdown."""
    score, tells = report.score, feedback != "none"
    earned = f": {float(score.points):g} of {score.of} points" if tells else ""
    if tells and report.scale is not None and len(report.students) == 1:
        scaled = score.scaled(report.scale)
        earned += f", {float(scaled.points):.6g} of {scaled.of}"
    lines = [f"### {_cell(report.title or 'rldrill')}{earned}\n", ""]
    if tells and len(report.students) > 1:
        lines += ["| Student | Points | Of | Remark |", "|---|---:|---:|---|"]
        lines += [_totals(report, student) for student in report.students] + [""]
    lines += ["| Student | Problem | Part | Verdict | Points |", "|---|---|---|---|---:|"] if tells else []
    lines += [
        f"| {_cell(student.student or ', '.join(student.paths))} | {_cell(part.problem)} | {part.part} "
        f"| {_cell(sentence(part, feedback))} | {float(part.score.points):g} of {part.score.of} |"
        for student in report.students
        for part in (student.parts if student.paths else ())
        if tells
    ]
    lines += [""] + [f"- {_cell(refusal.says)}" for refusal in report.refused]
    lines += [f"- {_cell(said)}" for student in report.students for said in student.extra]
    text, size = "", 0
    for line in lines:
        size += len(line.encode()) + 1
        if size > _LONGEST:
            return f"{text}\nThe rest is cut off.\n"
        text += f"{line}\n"
    return text


def _totals(report: Report, student: StudentReport) -> str:
    score = report.scaled(student) or student.score
    name = _cell(student.student or ", ".join(student.paths))
    return f"| {name} | {float(score.points):.6g} | {score.of} | {student.remark} |"


def _refused(report: Report) -> Iterator[str]:
    for refusal in report.refused:
        yield _annotation("error", refusal.path, refusal.line, "not graded", refusal.says)


def _wrong(report: Report, feedback: str) -> Iterator[str]:
    if feedback == "none":
        return
    for student in report.students:
        if not student.paths:
            yield _annotation("error", "", None, student.remark, student.student)
            continue
        for part in student.parts:
            if not part.judged.accepted:
                title = f"{part.problem} ({part.part})"
                yield _annotation("error", _file(part, student.paths), part.line, title, sentence(part, feedback))


def _file(part: MarkedPart, paths: tuple[str, ...]) -> str:
    return part.path or (paths[0] if paths else "")


def _annotation(kind: str, path: str, line: int | None, title: str, says: str) -> str:
    places = [f"file={_property(path)}"] if path else []
    places += [] if line is None else [f"line={line}"]
    return f"::{kind} {','.join([*places, f'title={_property(title)}'])}::{_message(says)}"


def _message(text: str) -> str:
    """A message as workflow commands have it; nothing else can begin a command of its own."""
    return one_line(text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A"))


def _property(text: str) -> str:
    return _message(text).replace(":", "%3A").replace(",", "%2C")


def _cell(text: str) -> str:
    """A text in a table of Markdown that is neither markup nor a link."""
    escaped = "".join(f"\\{sign}" if sign in r"\`*_{}[]()#+-.!|~>@" else sign for sign in one_line(text))
    return escaped.replace("&", "&amp;").replace("<", "&lt;")
