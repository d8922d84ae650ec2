"""Several PDFs in one."""

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path


def bundled(paths: Sequence[Path]) -> bytes:
    """The pages of PDFs one after the other, as one PDF; the same files give the same bytes."""
    from pypdf import PdfWriter

    writer = PdfWriter()
    for path in paths:
        writer.append(str(path), outline_item=path.stem, import_outline=False)
    writer.compress_identical_objects()
    whole = BytesIO()
    writer.write(whole)
    return whole.getvalue()
