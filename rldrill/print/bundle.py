"""Several PDFs in one."""

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path


def bundled(paths: Sequence[Path]) -> bytes:
    """The pages of PDFs one after the other, as one PDF; the same files give the same bytes."""
    from pypdf import PdfReader, PdfWriter

    writer = PdfWriter()
    for path in paths:
        reader = PdfReader(path)
        writer.append(reader, outline_item=path.stem, import_outline=False)
        writer.reset_translation(reader)
        reader.close()  # what is copied refers to its reader, which would keep the file and all that was read of it
    writer.compress_identical_objects()
    whole = BytesIO()
    writer.write(whole)
    return whole.getvalue()
