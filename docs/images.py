"""Write the README's images again: pages of a worksheet, and the formula sheet. Run it after a change of layout."""

from pathlib import Path

import typst

from rldrill.exam.blueprint import Blueprint, Entry
from rldrill.exam.planning import plan
from rldrill.print.formula_sheet import sheet_source
from rldrill.print.worksheet import worksheet_source

FAMILIES = ("return", "policy-evaluation", "forward-kinematics")


def write(name: str, source: str, page: int = 0) -> None:
    """One page of a Typst source as a PNG beside this file."""
    drawn = typst.compile(source.encode(), format="png", ppi=96, ignore_system_fonts=True)
    pages = drawn if isinstance(drawn, list) else [drawn]
    Path(__file__).with_name(name).write_bytes(pages[page])


exam = plan(Blueprint(problems=(Entry(topic=FAMILIES, count=3, level=1),), seed=4, title="Robot Learning"))
write("worksheet.png", worksheet_source(exam, exam.versions[0]))
write("sheet.png", sheet_source([], "a4"))
