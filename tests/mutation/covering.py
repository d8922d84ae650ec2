"""Which tests run a line, as coverage.py has noted it while the whole suite ran once."""

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from coverage import CoverageData
from places import ROOMS, Mutation, Source

#: A line that is run by no more tests than these is a rare one.
_FEW = 20


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
        """The files by their paths from their room on, wherever the tree stood."""
        found = {}
        for measured in self._data.measured_files():
            parts = Path(measured).parts
            room = max((place for place, part in enumerate(parts[:-1]) if part in ROOMS), default=0)
            found["/".join(parts[room:])] = measured
        return found

    @cached_property
    def known(self) -> frozenset[str]:
        """The tests that were run, whatever they came near."""
        return frozenset(context.rpartition("|")[0] for context in self._data.measured_contexts())

    def tests(self, source: Source, mutation: Mutation) -> frozenset[str]:
        """The tests that run the innermost statement with the change, or what the module makes of it.

        There are none where that is not known: for what is read when it is imported, and used by other modules alone.
        """
        measured = self._paths.get(source.path)
        if measured is None:
            return frozenset()
        line = source.line(mutation)
        contexts = self._data.contexts_by_lineno(measured)
        inside = _in_a_function(source.tree, line)
        places = [(_innermost(source.tree, line), line)] if inside else list(_using(source.tree, line))
        noted = (each for first, last in places for at in range(first, last + 1) for each in contexts.get(at, ()))
        return frozenset(context.rpartition("|")[0] for context in noted) - {""}

    def rare(self, source: Source, mutation: Mutation) -> frozenset[str]:
        """The tests that run a line of the same function which hardly any other runs: such as what an ``if`` guards."""
        measured = self._paths.get(source.path)
        if measured is None:
            return frozenset()
        contexts = self._data.contexts_by_lineno(measured)
        noted = (contexts.get(line, ()) for line in _around(source.tree, source.line(mutation)))
        running = ({context.rpartition("|")[0] for context in each} - {""} for each in noted)
        return frozenset().union(*(tests for tests in running if len(tests) <= _FEW))


def _around(tree: ast.Module, line: int) -> range:
    """The lines of the innermost function that a line stands in; none where it stands in none."""
    inside = [
        node
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef) and node.body[0].lineno <= line <= (node.end_lineno or 0)
    ]
    innermost = max(inside, key=lambda node: node.lineno, default=None)
    return range(0) if innermost is None else range(innermost.lineno, (innermost.end_lineno or 0) + 1)


def _in_a_function(tree: ast.Module, line: int) -> bool:
    """Whether a line is run when a function is called; else whichever test imports the module first seems to run it."""
    return bool(_around(tree, line))


def _innermost(tree: ast.Module, line: int) -> int:
    """The first line of the innermost statement that stands on a line."""
    return max(
        node.lineno
        for node in ast.walk(tree)
        if isinstance(node, ast.stmt) and node.lineno <= line <= (node.end_lineno or node.lineno)
    )


def _using(tree: ast.Module, line: int) -> Iterator[tuple[int, int]]:
    """The lines on which functions mention what is defined at the top of the module on a line, or what it goes into."""
    defined: set[str] = set()
    for node in tree.body:
        at_the_top = isinstance(node, ast.Assign | ast.AnnAssign)
        mentions = {each.id for each in ast.walk(node) if isinstance(each, ast.Name)}
        if at_the_top and (node.lineno <= line <= (node.end_lineno or 0) or defined & mentions):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            defined |= {each.id for target in targets for each in ast.walk(target) if isinstance(each, ast.Name)}
    for each in ast.walk(tree):
        if isinstance(each, ast.Name) and isinstance(each.ctx, ast.Load) and each.id in defined:
            yield _innermost(tree, each.lineno), each.lineno
