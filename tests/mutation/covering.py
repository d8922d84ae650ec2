"""Which tests run a line, as coverage.py has noted it while the whole suite ran once."""

import ast
from collections.abc import Iterable, Iterator
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

        A function whose results are kept runs for the first test that calls it alone: so all that call it count.
        There are none where that is not known: for what is read when it is imported, and used by other modules alone.
        """
        measured = self._paths.get(source.path)
        if measured is None:
            return frozenset()
        line = source.line(mutation)
        contexts = self._data.contexts_by_lineno(measured)
        inside = _in_a_function(source.tree, line)
        places = [(_innermost(source.tree, line), line)] if inside else list(_using(source.tree, line))
        places += _calling_what_is_kept(source.tree, line)
        noted = (each for first, last in places for at in range(first, last + 1) for each in contexts.get(at, ()))
        return frozenset(context.rpartition("|")[0] for context in noted) - {""}

    def elsewhere(self, source: Source, mutation: Mutation, importing: Iterable[Source]) -> frozenset[str]:
        """The tests that run a line of another module which mentions what the changed line defines, where few do."""
        names = _defined(_flat(source.tree.body), source.line(mutation))
        found: set[str] = set()
        for other in importing:
            contexts = self._data.contexts_by_lineno(self._paths.get(other.path, ""))
            for first, last in _mentioning(other.tree, _imported(other.tree, source.path) & names):
                noted = (each for at in range(first, last + 1) for each in contexts.get(at, ()))
                tests = {context.rpartition("|")[0] for context in noted} - {""}
                found |= tests if len(tests) <= _FEW else set()
        return frozenset(found)

    def rare(self, source: Source, mutation: Mutation) -> frozenset[str]:
        """The tests that run a line of the same function which hardly any other runs: such as what an ``if`` guards."""
        measured = self._paths.get(source.path)
        if measured is None:
            return frozenset()
        contexts = self._data.contexts_by_lineno(measured)
        noted = (contexts.get(line, ()) for line in _around(source.tree, source.line(mutation)))
        running = ({context.rpartition("|")[0] for context in each} - {""} for each in noted)
        return frozenset().union(*(tests for tests in running if len(tests) <= _FEW))


def _function(tree: ast.Module, line: int) -> ast.FunctionDef | None:
    """The innermost function that a line stands in."""
    inside = [
        node
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef) and node.body[0].lineno <= line <= (node.end_lineno or 0)
    ]
    return max(inside, key=lambda node: node.lineno, default=None)


def _around(tree: ast.Module, line: int) -> range:
    """The lines of the innermost function that a line stands in; none where it stands in none."""
    innermost = _function(tree, line)
    return range(0) if innermost is None else range(innermost.lineno, (innermost.end_lineno or 0) + 1)


def _calling_what_is_kept(tree: ast.Module, line: int) -> Iterator[tuple[int, int]]:
    """The lines of the module that call a function with a cache which the line stands in, or call such callers."""
    names, lines = set[str](), [line]
    while lines:
        function = _function(tree, lines.pop())
        if (
            function is None
            or function.name in names
            or "cache" not in "".join(map(ast.unparse, function.decorator_list))
        ):
            continue
        names.add(function.name)
        for first, last in _mentioning(tree, {function.name}):
            yield first, last
            lines.append(last)


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
    return _mentioning(tree, _defined(tree.body, line))


def _defined(statements: Iterable[ast.stmt], line: int) -> set[str]:
    """What these statements define on a line, or what that goes into."""
    defined: set[str] = set()
    for node in statements:
        at_the_top = isinstance(node, ast.Assign | ast.AnnAssign)
        mentions = {each.id for each in ast.walk(node) if isinstance(each, ast.Name)}
        if at_the_top and (node.lineno <= line <= (node.end_lineno or 0) or defined & mentions):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            defined |= {each.id for target in targets for each in ast.walk(target) if isinstance(each, ast.Name)}
    return defined


def _flat(statements: Iterable[ast.stmt]) -> Iterator[ast.stmt]:
    for statement in statements:
        yield from _flat(statement.body) if isinstance(statement, ast.With) else [statement]


def _imported(tree: ast.Module, path: str) -> set[str]:
    """What a module imports of another one, by its path, under its own name."""
    module = path.removesuffix(".py").replace("/", ".").removeprefix("rldrill.")
    return {
        alias.name
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and (node.module or "").removeprefix("rldrill.") == module
        for alias in node.names
    }


def _mentioning(tree: ast.Module, names: set[str]) -> Iterator[tuple[int, int]]:
    for each in ast.walk(tree):
        if isinstance(each, ast.Name) and isinstance(each.ctx, ast.Load) and each.id in names:
            yield _innermost(tree, each.lineno), each.lineno
