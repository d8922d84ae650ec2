"""Which tests can notice a change, the likeliest first; read from the tree, so that no list has to be kept."""

import ast
import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from covering import Covering
from places import ROOMS, Mutation, Source

#: So many tests for one change at most: to load the files of more takes longer than they are likely to be worth.
MOST = 4000

#: The rank of tests that have nothing to do with a change, as far as names tell.
_NOT = 5

#: What writes pages and the steps on them.
_WRITING = {("rldrill", "render"), ("solutions", "formula")}

#: What test files import that start other programs or look at PDFs: their tests come last of their rank.
_DEAR = {"pexpect", "printed", "subprocess", "terminals"}


@dataclass(frozen=True)
class Uses:
    """What a test function mentions, itself or through what its file defines: texts, and modules by what it imports."""

    texts: frozenset[str] = frozenset()
    modules: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Choice:
    """The tests of a tree, given by their pytest IDs, and the program's modules."""

    root: Path
    ids: tuple[str, ...]
    covering: Covering | None = None
    _uses: dict[str, dict[str, Uses]] = field(default_factory=dict)
    _dear: dict[str, bool] = field(default_factory=dict)

    @cached_property
    def _imports(self) -> dict[str, frozenset[str]]:
        """The modules that each file of the program imports, by its path."""
        paths = [path.relative_to(self.root) for room in ROOMS for path in (self.root / room).rglob("*.py")]
        return {
            str(path): _modules(ast.walk(Source.read(self.root, str(path)).tree), self.root)
            for path in paths
            if path.parts[:2] not in {("rldrill", "problems"), ("rldrill", "solutions")}
        }

    def tests(self, source: Source, mutation: Mutation, *, far: bool = False) -> tuple[str, ...]:
        """The IDs of what can notice it, the likeliest first: by their ranks, then the first cases of all functions.

        For what writes pages, the pages of all families come first: most of it shows in none of their names. Where it
        is known which tests run the changed statement, there are no others but those that start other programs, and
        those come first of all that run rare lines of the same function. Of what other modules alone use, those come
        first that run rare lines of these. Those that are seen not to run the statement come last, if they are wanted
        at all: they may rest on it nevertheless, where another test has left what it gives in a cache.
        """
        order: Counter[tuple[int, str]] = Counter()
        keyed = []
        running = self.covering.tests(source, mutation) if self.covering else frozenset()
        rare = running & self.covering.rare(source, mutation) if self.covering else frozenset()
        if self.covering and not running:  # it is used by other modules
            paths = self._importing({_module(Path(source.path))})
            importing = (Source.read(self.root, str(path)) for path in paths)
            rare = self.covering.elsewhere(source, mutation, importing)
        ranks = zip(self._ranks(source, mutation), self.ids, strict=True)
        for rank, test in [each for each in ranks if each[0] < _NOT or each[1] in running | rare]:
            is_far = bool(running) and self._is_far(test, running)
            if is_far and not far:
                continue
            function, is_dear = test.partition("[")[0], self._is_dear(test.partition("::")[0])
            keyed.append((is_far, test not in rare, rank, is_dear, order[rank, function], test))
            order[rank, function] += 1
        keyed.sort(key=lambda each: each[:-1])
        return tuple(test for *_, test in keyed[:MOST])

    def _is_far(self, test: str, running: frozenset[str]) -> bool:
        """Whether a test was seen not to run a statement; what other programs run for it was not seen."""
        assert self.covering
        return test in self.covering.known - running and not self._is_dear(test.partition("::")[0])

    def _is_dear(self, file: str) -> bool:
        if file not in self._dear:
            imports = (node for node in Source.read(self.root, file).tree.body if _imports(node))
            self._dear[file] = bool(_DEAR & {name.partition(".")[0] for node in imports for name in _names(node)})
        return self._dear[file]

    def ranked(self, source: Source, mutation: Mutation) -> list[tuple[int, str]]:
        """The IDs with their ranks, 0 where what is tested is made of the changed statement."""
        return [(rank, test) for test, rank in zip(self.ids, self._ranks(source, mutation), strict=True) if rank < _NOT]

    def _ranks(self, source: Source, mutation: Mutation) -> Iterable[int]:
        path = Path(source.path)
        statement = source.statement(mutation)
        made = _named(_affected(source.tree, statement) if statement else [])
        own = _named(source.tree.body) | {_family(path)}
        module = _module(path)
        importers = self._importing({module})
        callers = {_family(name) for name in importers} - {"--init--"}
        calling = {_module(name) for name in importers}
        farther = {_module(name) for name in self._importing(calling)}
        folders = {*path.parts[1:-1], path.stem} - {"__init__"}
        patterns = [_pattern(names) for names in (made, own, callers)]
        for test in self.ids:
            file, _, rest = test.partition("::")
            function, _, case = rest.partition("[")
            uses = self._of(file).get(function, Uses())
            writes = path.parts[:2] in _WRITING and Path(file).name == "test_pages.py"
            named = _is_named(file, path.stem)
            if writes or patterns[0].search(case) or made & uses.texts or (named and not made):
                yield 0
            elif named or patterns[1].search(case) or own & uses.texts or module in uses.modules:
                yield 1
            elif folders & set(Path(file).parts) or any(_is_named(file, name) for name in folders):
                yield 2
            elif patterns[2].search(case) or callers & uses.texts or calling & uses.modules:
                yield 3
            elif farther & uses.modules:
                yield 4
            else:
                yield _NOT

    def _importing(self, modules: set[str]) -> set[Path]:
        return {Path(name) for name, imported in self._imports.items() if modules & imported}

    def _of(self, file: str) -> dict[str, Uses]:
        if file not in self._uses:
            self._uses[file] = _used(Source.read(self.root, file).tree, self.root)
        return self._uses[file]


def _used(tree: ast.Module, root: Path) -> dict[str, Uses]:
    """What each function of a test file uses, with the functions and values of the same file that it names."""
    own: dict[str, tuple[Uses, set[str]]] = {}
    for node in tree.body:
        nodes = list(ast.walk(node))
        names = {each.id for each in nodes if isinstance(each, ast.Name)}
        names |= {each.arg for each in nodes if isinstance(each, ast.arg)}
        texts = {each.value for each in nodes if isinstance(each, ast.Constant) and isinstance(each.value, str)}
        found = Uses(frozenset(text.partition("/")[0] for text in texts), _modules(nodes, root)), names
        for name in _defines(node):
            own[name] = (Uses(found[0].texts, _modules([node], root, name)), names) if _imports(node) else found
    return {name: _closed(name, own) for name in own}


def _closed(name: str, own: dict[str, tuple[Uses, set[str]]]) -> Uses:
    seen, open_ = set(), [name]
    while open_:
        seen.add(current := open_.pop())
        open_ += [other for other in own[current][1] if other in own and other not in seen]
    found = [own[each][0] for each in seen]
    texts, modules = (each.texts for each in found), (each.modules for each in found)
    return Uses(frozenset().union(*texts), frozenset().union(*modules))


def _affected(tree: ast.Module, statement: ast.stmt) -> list[ast.stmt]:
    """A statement, and those of the module that mention what it defines, or what these define."""
    rest = {node: {each.id for each in ast.walk(node) if isinstance(each, ast.Name)} for node in _flat(tree.body)}
    found = [statement]
    for node in found:
        rest.pop(node, None)
        found += [other for other, names in rest.items() if other not in found and names & _defines(node)]
    return found


def _flat(statements: Iterable[ast.stmt]) -> Iterable[ast.stmt]:
    for statement in statements:
        yield from _flat(statement.body) if isinstance(statement, ast.With) else [statement]


def _defines(node: ast.stmt) -> set[str]:
    match node:
        case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
            return {name}
        case ast.Assign(targets=targets):
            return {each.id for target in targets for each in ast.walk(target) if isinstance(each, ast.Name)}
        case ast.AnnAssign(target=ast.Name(id=name)):
            return {name}
        case ast.Import(names=names) | ast.ImportFrom(names=names):
            return {alias.asname or alias.name.partition(".")[0] for alias in names}
    return set()


def _names(node: ast.AST) -> list[str]:
    """The modules that a statement imports."""
    return [alias.name for alias in node.names] if isinstance(node, ast.Import) else [getattr(node, "module", "") or ""]


def _imports(node: ast.AST) -> bool:
    return isinstance(node, ast.Import | ast.ImportFrom)


def _modules(nodes: Iterable[ast.AST], root: Path, only: str = "") -> frozenset[str]:
    """The modules of the program that are imported; a package that imports by name counts with all it holds."""
    found = set()
    for node in nodes:
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            for alias in node.names:
                if only in {"", alias.asname or alias.name}:
                    inner = f"{node.module}.{alias.name}"
                    found.add(inner if _path(inner, root) else node.module or "")
    for name in list(found):
        path = _path(name, root)
        if path and path.name == "__init__.py" and b"import_module" in path.read_bytes():
            found |= {f"{name}.{inner.stem}" for inner in path.parent.glob("*.py")}
    return frozenset(name for name in found if name.partition(".")[0] == "rldrill")


def _path(module: str, root: Path) -> Path | None:
    below = root.joinpath(*module.split("."))
    return next((path for path in (below.with_suffix(".py"), below / "__init__.py") if path.is_file()), None)


def _module(path: Path) -> str:
    parts = [*path.parts[:-1], *([] if path.stem == "__init__" else [path.stem])]
    return ".".join(parts if parts[0] == "rldrill" else ["rldrill", *parts])


def _family(path: Path) -> str:
    return path.stem.replace("_", "-")


def _named(statements: Iterable[ast.stmt]) -> set[str]:
    """The names of what statements state, as in ``X = Formula("td-zero", …)`` and ``Y = slip("forgot-alpha", …)``."""
    found = set()
    for statement in _flat(statements):
        match statement:
            case ast.Assign(value=ast.Call(args=arguments)):
                found |= {each.value for each in arguments[:2] if isinstance(each, ast.Constant)}
    return {name for name in found if isinstance(name, str) and re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", name)}


def _pattern(names: set[str]) -> re.Pattern[str]:
    """Find one of the names in the case of a test: the whole name, not a part of ``n-step-return``."""
    alternatives = "|".join(map(re.escape, sorted(names))) or r"(?!)"
    return re.compile(rf"(?<![a-zA-Z_])(?<![a-zA-Z_]-)(?:{alternatives})(?!-?[a-zA-Z_])")


def _is_named(file: str, name: str) -> bool:
    return f"_{name}_" in f"_{Path(file).stem.removeprefix('test_')}_"
