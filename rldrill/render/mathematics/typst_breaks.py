"""Where mathematics too wide for a line may be broken: between terms, then between factors, then within brackets."""

from msgspec import Struct

from rldrill.problems.mathematics import Big, Fence, Fraction, Glyph, Math, Row, Script, Tabular
from rldrill.render.mathematics.breaking import grouped
from rldrill.render.mathematics.spacing import opens
from rldrill.render.mathematics.typst import typst_fence, typst_row


class _Tree(Struct, frozen=True):
    """Mathematics, and the parts that it falls into where it does not fit on a line."""

    whole: str
    parts: tuple["_Tree", ...] = ()


def breakable(math: Math) -> str:
    """Mathematics with the places where it may be broken: what ``chain`` in ``blocks.typ`` takes."""
    return _node(_tree(math))


def _node(tree: _Tree) -> str:
    return f"node(${tree.whole}${''.join(f', {_node(part)}' for part in tree.parts)})"


def _tree(math: Math) -> _Tree:
    items = math.items if isinstance(math, Row) else (math,)
    for begins in (_begins_term, _begins_factor):
        groups = grouped(items, begins)
        if len(groups) > 1:
            return _Tree(typst_row(items), tuple(_tree(Row(group)) for group in groups))
    return _fence_opened(items)


def _fence_opened(items: tuple[Math, ...]) -> _Tree:
    whole = typst_row(items)
    if not items or not isinstance(fence := items[-1], Fence):
        return _Tree(whole)
    inside = _tree(fence.body)
    if not inside.parts:
        return _Tree(whole)
    head = f"{typst_row(items[:-1])} " if len(items) > 1 else ""
    first = _begun(inside.parts[0], head, typst_fence(fence.left))
    return _Tree(whole, (first, *inside.parts[1:-1], _ended(inside.parts[-1], typst_fence(fence.right))))


def _begun(tree: _Tree, head: str, bracket: str) -> _Tree:
    parts = (_begun(tree.parts[0], head, bracket), *tree.parts[1:]) if tree.parts else ()
    return _Tree(f"{head}lr({bracket} {tree.whole})", parts)


def _ended(tree: _Tree, bracket: str) -> _Tree:
    parts = (*tree.parts[:-1], _ended(tree.parts[-1], bracket)) if tree.parts else ()
    return _Tree(f"lr({tree.whole} {bracket})", parts)


def _begins_term(before: Math, item: Math) -> bool:
    if isinstance(before, Glyph) and before.style == "punctuation" and before.text in (",", ";"):
        return True
    if opens(before):
        return False
    return isinstance(item, Glyph) and (
        item.style == "relation" or (item.style == "operator" and item.text in ("+", "−", "±"))
    )


def _begins_factor(before: Math, item: Math) -> bool:
    if isinstance(item, Glyph):
        return item.style == "operator" and item.text in ("·", "×") and not isinstance(before, Big)
    return _is_tall(before) and _is_tall(item)


def _is_tall(item: Math) -> bool:
    return isinstance(item.body if isinstance(item, Script) else item, Fence | Tabular | Fraction)
