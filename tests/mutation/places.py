"""Where a program can be changed, one small thing at a time: found in the tree of the syntax, made in the text."""

import ast
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from pathlib import Path

ROOMS = ("problems", "rldrill", "solutions")

_OPERATORS: dict[type[ast.AST], tuple[bytes, bytes]] = {
    ast.Add: (b"+", b"-"),
    ast.Sub: (b"-", b"+"),
    ast.Mult: (b"*", b"/"),
    ast.Div: (b"/", b"*"),
    ast.Pow: (b"**", b"*"),
    ast.FloorDiv: (b"//", b"/"),
    ast.Lt: (b"<", b"<="),
    ast.LtE: (b"<=", b"<"),
    ast.Gt: (b">", b">="),
    ast.GtE: (b">=", b">"),
    ast.Eq: (b"==", b"!="),
    ast.NotEq: (b"!=", b"=="),
    ast.In: (b"in", b"not in"),
    ast.NotIn: (b"not in", b"in"),
    ast.Is: (b"is", b"is not"),
    ast.IsNot: (b"is not", b"is"),
    ast.And: (b"and", b"or"),
    ast.Or: (b"or", b"and"),
}
_OPPOSITES = {"max": b"min", "min": b"max", "Max": b"Min", "Min": b"Max", "any": b"all", "all": b"any"}
#: A comparison that is turned into its opposite by its operator: 'if not' would say the same.
_REVERSIBLE = (ast.Eq, ast.NotEq, ast.In, ast.NotIn, ast.Is, ast.IsNot)
#: Sizes and promises to Python, not to the user: no answer depends on them.
_KEYWORDS_LEFT_ALONE = {"frozen", "slots", "strict", "maxsize"}
_NAMES_LEFT_ALONE = {"__all__", "REVISION"}
_SEQUENCES = (ast.JoinedStr, ast.List, ast.Tuple, ast.Set, ast.Dict)


@dataclass(frozen=True, order=True)
class Mutation:
    """One change of one file: the bytes from ``start`` to ``end`` are exchanged."""

    path: str
    start: int
    end: int
    new: bytes
    kind: str


@dataclass(frozen=True)
class Source:
    """A file of the program, as bytes: the columns of the syntax tree count those."""

    path: str
    content: bytes

    @classmethod
    def read(cls, root: Path, path: str) -> "Source":
        """The file at a path below the root."""
        return cls(path, (root / path).read_bytes())

    @cached_property
    def tree(self) -> ast.Module:
        """The syntax."""
        return ast.parse(self.content)

    @cached_property
    def _lines(self) -> list[int]:
        starts = [0]
        for line in self.content.splitlines(keepends=True):
            starts.append(starts[-1] + len(line))
        return starts

    def span(self, node: ast.expr) -> tuple[int, int]:
        """Where an expression stands; the brackets around it do not belong to it."""
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        return self._lines[node.lineno - 1] + node.col_offset, self._lines[node.end_lineno - 1] + node.end_col_offset

    def line(self, mutation: Mutation) -> int:
        """The number of the first line that differs."""
        changed = self.changed(mutation).splitlines()
        differing = (
            n for n, (old, new) in enumerate(zip(self.content.splitlines(), changed, strict=True)) if old != new
        )
        return next(differing) + 1

    def shown(self, mutation: Mutation) -> tuple[str, str]:
        """That line before and after."""
        index = self.line(mutation) - 1
        before, after = (text.splitlines()[index].decode().strip() for text in (self.content, self.changed(mutation)))
        return before, after

    def changed(self, mutation: Mutation) -> bytes:
        """The whole file with that one change."""
        return self.content[: mutation.start] + mutation.new + self.content[mutation.end :]

    def statement(self, mutation: Mutation) -> ast.stmt | None:
        """The statement of the module, or of a block at its top level, in which the change is made."""
        line = self.content.count(b"\n", 0, mutation.start) + 1
        body = self.tree.body
        found: ast.stmt | None = None
        while inside := [node for node in body if node.lineno <= line <= (node.end_lineno or 0)]:
            found = inside[0]
            body = found.body if isinstance(found, ast.With) else []
        return found


def sources(root: Path, paths: Iterable[str], only: Iterable[str] = ()) -> list[Source]:
    """The modules of the program among these paths; those at or below the paths of ``only``, where there are any."""
    wanted = [Path(path) for path in only]
    return [
        Source.read(root, path)
        for path in sorted(paths)
        if path.endswith(".py") and Path(path).parts[0] in ROOMS
        if not wanted or any(Path(path).is_relative_to(above) for above in wanted)
    ]


def mutations(source: Source) -> list[Mutation]:
    """Every change that can be made to a file, in the order of the text."""
    return sorted({Mutation(source.path, *change) for node in _nodes(source.tree) for change in _changes(source, node)})


def _nodes(node: ast.AST) -> Iterator[ast.AST]:
    """A node and what is below it, without annotations, texts and what is meant for Python or mypy only."""
    yield node
    for field, value in ast.iter_fields(node):
        if field in {"annotation", "returns", "decorator_list", "msg"} or (
            field == "slice" and _end(value) is not None
        ):
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST) and not _left_alone(child):
                yield from _nodes(child)


def _left_alone(node: ast.AST) -> bool:
    match node:
        case ast.JoinedStr():
            return True
        case ast.keyword(arg=name):
            return name in _KEYWORDS_LEFT_ALONE
        case ast.Assign(targets=[ast.Name(id=name)]):
            return name in _NAMES_LEFT_ALONE
        case ast.If(test=ast.Name(id="TYPE_CHECKING")):
            return True
        case ast.If(test=ast.Compare(left=ast.Name(id="__name__"))):
            return True
    return False


_Change = tuple[int, int, bytes, str]


def _changes(source: Source, node: ast.AST) -> Iterator[_Change]:
    """The changes of one node itself."""
    match node:
        case ast.BinOp(left=left, op=op, right=right) | ast.AugAssign(target=left, op=op, value=right):
            if type(op) in _OPERATORS and not _is_sequence(left) and not _is_sequence(right):
                yield _operator(source, left, op, right)
        case ast.Compare():
            for (left, right), op in zip(pairwise([node.left, *node.comparators]), node.ops, strict=True):
                yield _operator(source, left, op, right)
        case ast.BoolOp(op=op, values=values):
            for left, right in pairwise(values):
                yield _operator(source, left, op, right)
        case ast.UnaryOp(op=ast.Not() | ast.USub()):
            start, end = source.span(node)
            sign = re.match(rb"not\s*|-", source.content[start:end])
            assert sign
            yield start, start + sign.end(), b"", "not dropped" if isinstance(node.op, ast.Not) else "sign dropped"
        case ast.Constant(value=bool(value)):
            yield *source.span(node), str(not value).encode(), "boolean flipped"
        case ast.Constant(value=int(value)):
            yield *source.span(node), str(value + 1).encode(), "constant"
        case ast.Subscript(slice=index) if _end(index) is not None:
            yield *source.span(index), b"1" if _end(index) == 0 else b"-2", "index"
        case ast.Slice(lower=lower, upper=upper):
            for bound in (lower, upper):
                if bound is not None and not _is_number(bound):
                    start, end = source.span(bound)
                    yield start, end, b"(" + source.content[start:end] + b") + 1", "slice"
        case ast.Call(func=ast.Name(id=name)) if name in _OPPOSITES:
            yield *source.span(node.func), _OPPOSITES[name], "max, min, any, all"
        case ast.If(test=test) | ast.IfExp(test=test):
            yield from _negated(source, test)
        case ast.comprehension(ifs=tests):
            for test in tests:
                yield from _negated(source, test)
        case ast.arguments():
            for default in [*node.defaults, *node.kw_defaults]:
                yield from _default(source, default)
        case ast.ClassDef(body=body):
            for statement in body:
                if isinstance(statement, ast.AnnAssign):
                    yield from _default(source, statement.value)


def _operator(source: Source, left: ast.expr, op: ast.AST, right: ast.expr) -> _Change:
    """The operator is the only word between its two sides, save for brackets and comments."""
    old, new = _OPERATORS[type(op)]
    start, end = source.span(left)[1], source.span(right)[0]
    gap = re.sub(rb"#.*", lambda comment: b" " * len(comment[0]), source.content[start:end])
    found = re.search(rb"\s+".join(map(re.escape, old.split())), gap)
    assert found
    return start + found.start(), start + found.end(), new, f"{old.decode()} → {new.decode()}"


def _negated(source: Source, test: ast.expr) -> Iterator[_Change]:
    reversible = isinstance(test, ast.Compare) and len(test.ops) == 1 and isinstance(test.ops[0], _REVERSIBLE)
    if not reversible and not (isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not)):
        start, end = source.span(test)
        yield start, end, b"not (" + source.content[start:end] + b")", "condition reversed"


def _default(source: Source, default: ast.expr | None) -> Iterator[_Change]:
    """The defaults that are texts; numbers and booleans are changed wherever they stand."""
    if isinstance(default, ast.Constant) and isinstance(default.value, str):
        yield *source.span(default), b'""' if default.value else b'"x"', "default"


def _end(index: ast.expr) -> int | None:
    """0 and −1 as the indices that they are, None for all others."""
    match index:
        case ast.Constant(value=0) if index.value is not False:
            return 0
        case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=1)):
            return -1
    return None


def _is_number(node: ast.expr) -> bool:
    operand = node.operand if isinstance(node, ast.UnaryOp) else node
    return isinstance(operand, ast.Constant)


def _is_sequence(node: ast.expr) -> bool:
    """Whether arithmetic with it is not arithmetic: any other operator would fail at once and prove nothing."""
    return isinstance(node, _SEQUENCES) or (isinstance(node, ast.Constant) and isinstance(node.value, str | bytes))
