"""Which tests run a line, as coverage.py has noted it while the whole suite ran once."""

import ast
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from coverage import CoverageData
from places import Mutation, Source


@dataclass(frozen=True)
class Covering:
    """The notes of ``pytest --cov=rldrill --cov-context=test``, taken in the unchanged tree or a copy of it."""

    file: Path

    @cached_property
    def _data(self) -> CoverageData:
        data = CoverageData(str(self.file))
        data.read()
        return data

    @cached_property
    def _paths(self) -> dict[str, str]:
        """The files by their paths below the root, where the rooms stand that are linked into the package."""
        found = {}
        for measured in self._data.measured_files():
            below = measured.rpartition("/rldrill/")[2]
            found[below if below.startswith(("problems/", "solutions/")) else f"rldrill/{below}"] = measured
        return found

    def tests(self, source: Source, mutation: Mutation) -> frozenset[str]:
        """The tests that run the innermost statement with the change; none where it runs when it is imported."""
        measured = self._paths.get(source.path)
        if measured is None:
            return frozenset()
        line = source.line(mutation)
        inside = [
            node
            for node in ast.walk(source.tree)
            if isinstance(node, ast.stmt) and node.lineno <= line <= (node.end_lineno or node.lineno)
        ]
        first = max(node.lineno for node in inside)
        contexts = self._data.contexts_by_lineno(measured)
        tests = {
            context.rpartition("|")[0] for number in range(first, line + 1) for context in contexts.get(number, ())
        }
        return frozenset(tests - {""})
