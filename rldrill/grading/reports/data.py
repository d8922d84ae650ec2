"""The report as JSON, and the schema of it."""

import json
import re
from typing import Any

from rldrill.grading.report import FEEDBACK, FORMAT, MISSING, NOT_GRADED, Report
from rldrill.solutions.answers.judging import Outcome

#: What JSON leaves as it is, and terminals obey: the second set of control characters, and changes of direction.
_CONTROLS = re.compile("[\x7f-\x9f\u200e\u200f\u202a-\u202e\u2028\u2029\u2066-\u2069]")

_TEXT: dict[str, Any] = {"type": "string"}
_TEXT_OR_NOTHING: dict[str, Any] = {"type": ["string", "null"]}
_LINE: dict[str, Any] = {"type": ["integer", "null"], "minimum": 1}


def written(report: Report, feedback: str, *, ascii_only: bool = False) -> str:
    """The report as JSON; what controls a terminal is escaped in it."""

    def text(value: object) -> str:
        plain = json.dumps(value, ensure_ascii=ascii_only, indent=2)
        return _CONTROLS.sub(lambda sign: f"\\u{ord(sign[0]):04x}", plain)

    # Student by student: as one table of Python's, those of a large course would take a gigabyte.
    students = ",\n".join(text(report.student_to_json(student, feedback)) for student in report.students)
    if students:
        students = "\n    " + students.replace("\n", "\n    ") + "\n  "
    before, after = text(report.frame()).split('"students": []', 1)
    return f'{before}"students": [{students}]{after}\n'


def schema() -> dict[str, Any]:
    """The JSON Schema of the report, for every amount of feedback."""
    points = _table(
        {"exact": {**_TEXT, "pattern": r"^-?\d+(/\d+)?$"}, "decimal": _TEXT, "of": {"type": "integer", "minimum": 0}}
    )
    answer = _table(
        {
            "problem": _TEXT, "part": {**_TEXT, "pattern": "^[a-z]$"}, "slot": _LINE, "file": _TEXT_OR_NOTHING,
            "line": _LINE, "column": _LINE, "typed": _TEXT, "points": points,
        },
        {
            "verdict": {"enum": [*(outcome.value for outcome in Outcome), MISSING, NOT_GRADED]},
            "accepted": {"type": "boolean"}, "read": _TEXT, "reason": _TEXT, "diagnosis": {"type": ["object", "null"]},
            "key": _TEXT,
        },
    )  # fmt: skip
    student = _table(
        {
            "student": _TEXT, "number": _TEXT_OR_NOTHING, "version": _TEXT_OR_NOTHING, "files": _list(_TEXT),
            "other_files": _list(_TEXT), "handed_in": {"type": "boolean"}, "points": points,
            "scaled": {"anyOf": [points, {"type": "null"}]}, "answers": _list(answer),
            "not_marked": _list(_TEXT), "passed": {"type": "boolean"},
        }
    )  # fmt: skip
    refused = _table(
        {
            "file": _TEXT, "line": _LINE, "student": _TEXT_OR_NOTHING, "problem": _TEXT_OR_NOTHING, "says": _TEXT,
            "exit_code": {"enum": [3, 4]},
        }
    )  # fmt: skip
    report = _table(
        {
            "format": {"const": FORMAT}, "title": _TEXT_OR_NOTHING, "students": _list(student),
            "refused": _list(refused), "notes": {"type": "object", "additionalProperties": _list(_TEXT)},
            "points": points, "exit_code": {"enum": [0, 1, 3, 4]},
        }
    )  # fmt: skip
    about = f"What 'rldrill verify --report json=FILE' writes; --feedback ({', '.join(FEEDBACK)}) says how much of it."
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A report of rldrill verify",
        "description": about,
    } | report


def _table(needed: dict[str, Any], optional: dict[str, Any] | None = None) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": needed | (optional or {}),
        "required": list(needed),
        "additionalProperties": False,
    }


def _list(items: dict[str, Any]) -> dict[str, Any]:
    return {"type": "array", "items": items}
