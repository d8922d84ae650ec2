"""HTML for programs that typeset LaTeX themselves and keep pictures as files beside it."""

from collections.abc import Sequence
from html import escape

from rldrill.exam.choices import Language
from rldrill.exercise import Exercise
from rldrill.export.asked import answer
from rldrill.print.words import words
from rldrill.problems.parts import Matrix, Part
from rldrill.problems.pictures import Picture
from rldrill.render.html import LatexHtml
from rldrill.render.pictures.described import described
from rldrill.render.pictures.svg import svg


class WithFiles(LatexHtml):
    """Writes blocks as HTML whose pictures are files beside it.

    Args:
        stem: what the names of the files begin with, before their number.
        place: what stands before these names in the text.
        end: how an element ends that holds nothing.
    """

    def __init__(self, stem: str, place: str = "", end: str = ">") -> None:
        self.files: dict[str, str] = {}
        self._stem, self._place, self._end = stem, place, end

    def picture(self, picture: Picture) -> str:
        """A picture as a file that the text refers to."""
        if not (drawing := svg(picture)):
            return ""
        name = f"{self._stem}-{len(self.files) + 1}.svg"
        self.files[name] = drawing
        return f'<p><img src="{self._place}{name}" alt="{escape(described(picture))}"{self._end}</p>'

    def solved(self, exercise: Exercise, part: Part, language: Language) -> str:
        """The answer to a part, and its working."""
        return self.block(answer(exercise, part, words(language))) + self.blocks(exercise.working(part.label))


def matrix_rows(boxes: Sequence[str], kind: Matrix) -> str:
    """The boxes for the entries of a matrix as the rows of a table."""
    lines = (boxes[start : start + kind.columns] for start in range(0, len(boxes), kind.columns))
    return "".join(f"<tr>{''.join(f'<td>{box}</td>' for box in line)}</tr>" for line in lines)
