"""How wide mathematics is taken to be, held against how wide Typst sets it."""

from pathlib import Path

import pytest
import typst

from rldrill.exercise import draw
from rldrill.problems.document import Equation
from rldrill.problems.mathematics import mathematics
from rldrill.render.mathematics.width import width, width_of_line
from rldrill.render.typst import PREAMBLE, line

FAMILIES = ["advantage", "ddp-backward", "kalman-filter", "lqr-backward", "model-fitting", "softmax-policy", "td-zero"]


def set_widths(equations: list[str], folder: Path) -> list[float]:
    """The widths of equations on lines of their own, in widths of the type."""
    path = folder / "widths.typ"
    measured = "".join(f"measure(math.equation(block: true, ${each}$.body)).width / 10pt, " for each in equations)
    path.write_text(
        f'#set text(font: "New Computer Modern", size: 10pt)\n#set math.mat(column-gap: 0.8em)\n{PREAMBLE}'
        f"#context [#metadata(({measured}))<widths>]",
        encoding="utf-8",
    )
    found = typst.Compiler(str(path), ignore_system_fonts=True).query("<widths>", field="value", one=True)
    return [float(each) for each in found.strip("[]").split(",")]


@pytest.mark.parametrize("family", FAMILIES)
def test_no_equation_is_wider_than_it_is_taken_for_and_most_are_not_much_narrower(family: str, tmp_path: Path) -> None:
    exercises = [draw(family, level, 1) for level in (1, 2, 3)]
    every = [block for one in exercises for part in one.parts for block in one.working(part.label)]
    equations = [block for block in every if isinstance(block, Equation) and any(block.signs)]
    taken = [width_of_line(each.left, each.rights, each.signs) for each in equations]
    real = set_widths(list(map(line, equations)), tmp_path)
    assert all(one <= other for one, other in zip(real, taken, strict=True))
    assert sum(real) > 0.6 * sum(taken)


def test_a_fraction_is_as_wide_as_its_wider_half() -> None:
    assert width(mathematics("10/3")) < width(mathematics("10 + 3"))
    assert width(mathematics("100/3")) == width(mathematics("3/100"))
