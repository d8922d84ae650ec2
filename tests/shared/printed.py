"""PDFs as a reader sees them, by poppler's tools."""

import html
import os
import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

_PAGE = re.compile(r'<page width="([\d.]+)" height="([\d.]+)"')
_WORD = re.compile(r'<word xMin="([-\d.]+)" yMin="([-\d.]+)" xMax="([-\d.]+)" yMax="([-\d.]+)">(.*?)</word>')


class Word(NamedTuple):
    """A word, where it stands, and the page that it stands on, from 1; lengths in points from the upper left corner."""

    text: str
    left: float
    top: float
    right: float
    bottom: float
    page: int
    width: float
    height: float


def poppler(tool: str, *arguments: str) -> str:
    """Return what one of poppler's tools prints.

    They are no Python package, so that pip cannot install them with the tests: whoever lacks them skips what looks at
    pages. Where ``CI`` is set, as it is in ``.ci/run``, which installs them, their absence is a failure.
    """
    if shutil.which(tool) is None:
        if os.environ.get("CI"):
            pytest.fail(f"poppler's {tool} is not installed")
        pytest.skip(f"poppler's {tool} is not installed")
    return subprocess.run([tool, *arguments], capture_output=True, check=True, text=True).stdout


def words(path: Path) -> Iterator[Word]:
    """Yield every word of a PDF."""
    page, width, height = 0, 0.0, 0.0
    for line in poppler("pdftotext", "-bbox", str(path), "-").splitlines():
        if found := _PAGE.search(line):
            page, width, height = page + 1, float(found[1]), float(found[2])
        elif found := _WORD.search(line):
            left, top, right, bottom = map(float, found.groups()[:4])
            yield Word(html.unescape(found[5]), left, top, right, bottom, page, width, height)
