"""The Typst code that PDFs are built from: ``.typ`` files beside the modules that call their functions."""

from functools import cache
from importlib.resources import files


@cache
def typst_file(package: str, name: str) -> str:
    """The text of a file of a package."""
    return files(package).joinpath(name).read_text(encoding="utf-8")
