"""How well pages are filled, and what sticks out of them: measured on the pages as they are seen."""

import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from printed import poppler, words

#: Pixels an inch: enough to see a hair line.
_DPI = 50
_CM = _DPI / 2.54
#: The margins of exams, in centimetres, a little less for what hangs into them; the head stands above the text.
_SIDE, _BOTTOM, _HEAD = 1.9, 1.4, 2.0


@dataclass(frozen=True)
class Measured:
    """A page.

    Args:
        filled: which share of the height for text lies above the last ink.
        overfull: whether there is ink in the margins.
        smallest: the height of the smallest word, in points.
        last: the last line of text.
    """

    filled: float
    overfull: bool
    smallest: float
    last: str


def measured(pdf: bytes) -> list[Measured]:
    """The pages of a PDF."""
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "x.pdf"
        path.write_bytes(pdf)
        poppler("pdftoppm", "-gray", "-r", str(_DPI), str(path), str(Path(name) / "page"))
        images = [_image(file) for file in sorted(Path(name).glob("page*.pgm"))]
        lines = list(words(path))
    result = []
    for number, image in enumerate(images, 1):
        here = [word for word in lines if word.page == number]
        bottom = max((word.bottom for word in here), default=0.0)
        sizes = [word.bottom - word.top for word in here if word.text.isascii() and word.text.isalpha()]
        last = " ".join(word.text for word in here if bottom - word.bottom < 4)
        result.append(Measured(_filled(image), _overfull(image), min(sizes, default=99.0), last))
    return result


def _image(path: Path) -> NDArray[np.bool_]:
    """Where there is ink."""
    data = path.read_bytes()
    magic, width, height, _, *_ = data.split(maxsplit=4)
    assert magic == b"P5"
    pixels = np.frombuffer(data[-int(width) * int(height) :], dtype=np.uint8)
    return pixels.reshape(int(height), int(width)) < 200


def _filled(image: NDArray[np.bool_]) -> float:
    rows = np.flatnonzero(image.any(axis=1))
    top, bottom = _HEAD * _CM, image.shape[0] - 1.6 * _CM
    return float((rows.max(initial=0) - top) / (bottom - top))


def _overfull(image: NDArray[np.bool_]) -> bool:
    side, bottom = int(_SIDE * _CM), int(_BOTTOM * _CM)
    return bool(image[:, :side].any() or image[:, -side:].any() or image[-bottom:].any())
