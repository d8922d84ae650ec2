"""Measure the pages of one problem of every family and level, on both papers, worksheets and keys.

``python tests/print/measure.py [FOLDER]`` prints every page that is not as it should be, and the figures of all; the
PDFs go to the folder if one is given.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

from msgspec.structs import replace

sys.path.insert(0, str(Path(__file__).parent.parent / "shared"))

from layout import Measured, measured
from rldrill.exam.exam import Exam, Head, Layout, Version
from rldrill.exercise import draw
from rldrill.print.key import key_source
from rldrill.print.paper import pdf
from rldrill.print.worksheet import worksheet_source
from rldrill.problems.catalogue import families, family

#: No word may be printed smaller than this, in points of its height: a capital and what hangs below the line.
SMALLEST = 4.5


def sheets(names: tuple[str, ...], papers: tuple[str, ...] = ("a4", "letter")) -> Iterator[tuple[str, bytes]]:
    """For every family and level a worksheet and its key on every paper, each with what it is called."""
    for name in names:
        for level in family(name).levels:
            version = Version("A", (draw(name, level, 1),), (0,))
            for paper in papers:
                exam = Exam(Head(), 1, (version,), layout=replace(Layout(), paper=paper))
                for what, source in (("sheet", worksheet_source), ("key", key_source)):
                    yield f"{name}-{level}-{paper}-{what}", pdf(source(exam, version), accessible=True)


def faults(pages: list[Measured], *, key: bool = False) -> Iterator[str]:
    """What is wrong with the pages of a PDF."""
    for number, page in enumerate(pages, 1):
        if page.overfull:
            yield f"page {number}: ink in the margin"
        if page.smallest < SMALLEST:
            yield f"page {number}: type of {page.smallest:.1f} pt"
        if number < len(pages) and page.filled < (0.75 if key else 0.5):
            yield f"page {number}: filled to {100 * page.filled:.0f} %"


def main() -> None:
    """Print the figures."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else None
    count, wrong, filled, smallest = 0, 0, [], 99.0
    for name, data in sheets(families()):
        if folder is not None:
            (folder / f"{name}.pdf").write_bytes(data)
        pages = measured(data)
        count += len(pages)
        filled += [page.filled for page in pages[:-1]]
        smallest = min(smallest, *(page.smallest for page in pages))
        for fault in faults(pages, key=name.endswith("key")):
            wrong += 1
            print(f"{name}: {fault}", flush=True)
    share = 100 * sum(filled) / max(1, len(filled))
    print(f"{count} pages, {wrong} faults, filled to {share:.0f} % but for the last, smallest type {smallest:.1f} pt")


if __name__ == "__main__":
    main()
