"""A plugin of pytest: every part of every problem in a file ``*.answers.toml`` is a test."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from rldrill.grading.report import MarkedPart

_SUFFIX = ".answers.toml"


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> "AnswersFile | None":
    """The hook that pytest calls for every file."""
    if not file_path.name.endswith(_SUFFIX):
        return None
    return AnswersFile.from_parent(parent, path=file_path)


class WrongAnswer(Exception):
    """An answer that is not right; the message says why."""


class AnswersFile(pytest.File):
    """A file of answers."""

    def collect(self) -> Iterator[pytest.Item]:
        """A test for every part, and one for everything that cannot be graded."""
        from rldrill.grading.verification import verify

        report = verify([self.path])
        for part in report.parts:
            name = f"{part.problem} ({part.part})"
            yield Answer.from_parent(self, name=name, part=part, says="")
        for number, refusal in enumerate(report.refused, 1):
            yield Answer.from_parent(self, name=f"not graded {number}", part=None, says=refusal.says)


class Answer(pytest.Item):
    """The answer to one part, or what of the file cannot be graded."""

    def __init__(self, *, part: "MarkedPart | None", says: str, **others: object) -> None:
        super().__init__(**others)  # type: ignore[arg-type]
        self._part, self._says = part, says

    def runtest(self) -> None:
        """Fail where the answer is not right."""
        from rldrill.grading.reports.said import located, one_line

        if self._part is None:
            raise WrongAnswer(one_line(self._says))
        if not self._part.judged.accepted:
            raise WrongAnswer(f"{one_line(self._part.typed)!r}: {one_line(located(self._part, 'reason'))}")

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: object = None) -> str:
        """The sentence alone; a traceback where it is no wrong answer."""
        if isinstance(excinfo.value, WrongAnswer):
            return str(excinfo.value)
        return str(super().repr_failure(excinfo, style))  # type: ignore[arg-type]

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Where it stands."""
        line = None if self._part is None or self._part.line is None else self._part.line - 1
        return self.path, line, self.name
