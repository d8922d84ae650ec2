"""The report as JUnit's XML: a test suite for every student, a test case for every part."""

from collections.abc import Iterator
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from rldrill.grading.report import NOT_GRADED, MarkedPart, Report, StudentReport
from rldrill.grading.reports.said import one_line, sentence


def written(report: Report, feedback: str) -> str:
    """The report as JUnit's XML, as continuous integration reads it."""
    suites = Element("testsuites", name="rldrill")
    for student in report.students:
        _suite(suites, report, student, feedback)
    if report.refused:
        suite = SubElement(suites, "testsuite", name="not graded")
        for refusal in report.refused:
            where = refusal.path if refusal.line is None else f"{refusal.path}, line {refusal.line}"
            case = SubElement(suite, "testcase", classname="not graded", name=one_line(where), time="0")
            SubElement(case, "error", message=one_line(refusal.says), type="not graded")
        _counted(suite)
    for count in ("tests", "failures", "errors"):
        suites.set(count, str(sum(int(suite.get(count, "0")) for suite in suites)))
    ElementTree.indent(suites)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ElementTree.tostring(suites, encoding="unicode") + "\n"


def _suite(suites: Element, report: Report, student: StudentReport, feedback: str) -> None:
    name = one_line(student.student or ", ".join(student.paths) or "answers")
    suite = SubElement(suites, "testsuite", name=name)
    if feedback != "none":
        properties = SubElement(suite, "properties")
        for key, value in _properties(report, student):
            SubElement(properties, "property", name=key, value=value)
    for part in student.parts:
        suite.append(_case(name, part, feedback))
    _counted(suite)


def _properties(report: Report, student: StudentReport) -> Iterator[tuple[str, str]]:
    yield "points", f"{float(student.score.points):g}"
    yield "of", str(student.score.of)
    if (scaled := report.scaled(student)) is not None:
        yield "scaled", f"{float(scaled.points):g}"
        yield "scaled of", str(scaled.of)
    if student.remark:
        yield "remark", student.remark
    if student.version:
        yield "version", student.version


def _case(student: str, part: MarkedPart, feedback: str) -> Element:
    case = Element("testcase", classname=student, name=f"{part.problem} ({part.part})")
    case.set("time", "0")
    if not part.judged.accepted and feedback != "none":
        kind = "error" if part.judged.verdict == NOT_GRADED else "failure"
        failure = SubElement(case, kind, message=one_line(sentence(part, feedback)), type=part.judged.verdict)
        earned = f"{float(part.score.points):g} of {part.score.of}"
        failure.text = one_line(f"{earned} points; {part.place or 'no answer'}")
    return case


def _counted(suite: Element) -> None:
    suite.set("tests", str(len(suite.findall("testcase"))))
    suite.set("failures", str(len(suite.findall("testcase/failure"))))
    suite.set("errors", str(len(suite.findall("testcase/error"))))
    suite.set("skipped", "0")
    suite.set("time", "0")
