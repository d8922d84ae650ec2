"""A page: blocks that show themselves as text, and as Markdown in a notebook."""

from rldrill.problems.document import Block
from rldrill.render.markdown import markdown
from rldrill.render.terminal import plain


class Page(tuple[Block, ...]):
    """Blocks one under the other; ``str`` of it is readable text."""

    __slots__ = ()

    def __str__(self) -> str:
        return plain(self)

    __repr__ = __str__

    def _repr_markdown_(self) -> str:
        return markdown(self)
