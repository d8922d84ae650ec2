"""What a course hands out and gets back, whole: what the fingerprints in ``tests/golden/handed_out.json`` are taken of.

That each is right is seen elsewhere: by the schemas and programs that read it, by its pages, by answers worked by hand.
A fingerprint says that nothing changes unseen. To see what did, write the files of both trees, and compare the folders:

    python tests/shared/handed_out.py FOLDER
"""

import sqlite3
import sys
import tempfile
import zipfile
from collections.abc import Callable
from functools import cache, partial
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from types import ModuleType

import rldrill
from rldrill.exam.exam import Exam, Head, Layout, Version
from rldrill.exam.manifest import manifest, written
from rldrill.export.formats import FORMATS, export
from rldrill.grading.assignment import Assignment
from rldrill.grading.marking import Rules
from rldrill.grading.report import FEEDBACK, Report
from rldrill.grading.reports import data, github, gradescope, junit, page, tables, text
from rldrill.grading.verification import Settings, verify
from rldrill.print.key import key_source
from rldrill.print.worksheet import worksheet_source
from rldrill.problems.notations import used
from rldrill.problems.pictures import Arrow, StateDiagram
from rldrill.render.pictures.svg import svg

#: A table, a letter that is asked for, matrices, names to choose, yes or no; then a diagram, an arm, a plot, roots.
VERSIONS = {
    "A": ("td-zero/2/234", "optimal-value/3/5", "kalman-filter/2/1", "backup-diagram-name/1/4", "markov-property/1/1"),
    "B": ("td-zero/2/235", "policy-value/2/5", "bayes-filter/2/3", "denavit-hartenberg/1/1", "ppo-clip/2/1"),
}
#: The exam for practice, and the same in another language and notation, to be written in a room.
EXAMS = {
    "practice": (
        Head(title="Costs $5 & <b>6</b>", course="RL", date="1 April", duration=90, instructions="Show it."),
        Layout(ids=True, solutions="inline"),
    ),
    "exam": (
        Head(title="Klausur", language="de", decimal_mark=","),
        Layout(paper="letter", space="tight", duplex=True, notation="sutton-barto"),
    ),
}
#: What is not written by the program: pandoc's file.
_FOREIGN = {"docx"}
#: Two people's answers to version A: right, wrong, half, words, one that is no number, a part that is none.
ANSWERS = """\
student,problem,part,answer
Ann,1,a,"10, -5, 6"
Ann,1,b,"hot: -3, smoking: -4/5"
Ann,2,a,12
Ann,2,b,5.99
Ann,3,a,"mean -2, variance 6"
Ann,3,b,"-8/3, 3"
Ann,4,,D
Ann,5,a,"4/5, 0.8"
Ann,5,b,yes
Ben,1,a,"10, -5"
Ben,1,b,"hot: 3, smoking: -4/5"
Ben,2,a,banana
Ben,2,b,13/3
Ben,2,d,1
Ben,3,a,"6, -2"
Ben,4,,Sarsa
Ben,5,b,no
"""
_REPORTS = {
    "json": data, "github": github, "gradescope": gradescope, "junit": junit, "html": page, "csv": tables, "txt": text,
}  # fmt: skip


@cache
def exam(name: str) -> Exam:
    """One of the exams."""
    head, layout = EXAMS[name]
    versions = (Version(code, tuple(map(rldrill.load, ids)), tuple(range(5))) for code, ids in VERSIONS.items())
    return Exam(head, 1, tuple(versions), layout=layout)


def exported(name: str, format_: str) -> str:
    """An exam in a format, as text; of what is packed, what is in it."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"exam{FORMATS[format_].ending}"
        paths = list(export(exam(name), path, FORMATS[format_], practice=name == "practice"))
        return "\n".join(map(_text, paths))


def _text(path: Path) -> str:
    if not zipfile.is_zipfile(path):
        return path.read_text(encoding="utf-8")
    with zipfile.ZipFile(path) as packed:
        return "\n".join(f"--- {each}\n{_member(packed.read(each))}" for each in sorted(packed.namelist()))


def _member(content: bytes) -> str:
    """What a packed file says: a text as it is, the notes of Anki's database."""
    if not content.startswith(b"SQLite"):
        return content.decode()
    with tempfile.NamedTemporaryFile() as file:
        file.write(content)
        file.flush()
        with sqlite3.connect(file.name) as database:
            rows = database.execute("select guid, flds, tags from notes order by id").fetchall()
    return "\n".join("\n".join(row).replace("\x1f", "\n") for row in rows)


def report(folder: Path) -> Report:
    """The report of what was answered to the exam for practice."""
    kept, answers = folder / "exam.json", folder / "answers.csv"
    kept.write_bytes(written(manifest(exam("practice"))))
    answers.write_text(ANSWERS, encoding="utf-8")
    return verify([answers], Settings(rules=Rules(keys=True), assignment=Assignment(kept, "A")))


@cache
def _graded() -> tuple[Report, str]:
    with tempfile.TemporaryDirectory() as folder:
        return report(Path(folder)), folder


def reported(form: ModuleType, feedback: str) -> str:
    """The report in a form, whatever the folder of the files is called."""
    graded, folder = _graded()
    return str(form.written(graded, feedback)).replace(folder, "FOLDER")


def _manifest(name: str) -> str:
    return written(manifest(exam(name))).decode().replace(f'"{version("rldrill")}"', '"VERSION"')


def _printed(name: str, code: str, source: Callable[[Exam, Version], str]) -> str:
    of = exam(name)
    (wanted,) = (each for each in of.versions if each.code == code)
    with used(of.layout.notation, of.head.decimal_mark):
        return source(of, wanted)


def _diagram(states: int) -> str:
    """A ring of states, the last of them terminal, with a second way from each that may lead to another."""
    names = [f"state {number}" for number in range(1, states + 1)]
    arrows = [
        Arrow(name, "on", names[(at + 1) % states], "$1$", f"${at}$") for at, name in enumerate(names[:-1] or names)
    ]
    arrows += [
        Arrow(name, "off", names[(at + step) % states], f"${chance}$", "$−1/2$")
        for at, name in enumerate(names[:-1])
        for step, chance in ((0, "1/3"), (2, "2/3"))
    ]
    return svg(StateDiagram(tuple(names), tuple(names[1:][-1:]), tuple(arrows)))


#: What makes each of the files, by its name.
FILES: dict[str, Callable[[], str]] = {
    **{
        f"{name}-{form}.txt": partial(exported, name, form)
        for name in EXAMS
        for form in FORMATS
        if form not in _FOREIGN
    },
    **{
        f"{name}-{code}-{what}.typ": partial(_printed, name, code, source)
        for name in EXAMS
        for code in VERSIONS
        for what, source in (("sheet", worksheet_source), ("key", key_source))
    },
    **{f"{name}-manifest.json": partial(_manifest, name) for name in EXAMS},
    **{
        f"report-{feedback}.{ending}": partial(reported, form, feedback)
        for ending, form in _REPORTS.items()
        for feedback in FEEDBACK
    },
    **{f"diagram-{states}.svg": partial(_diagram, states) for states in range(1, 7)},
}


def fingerprint(text: str) -> str:
    """The hash of a file."""
    return sha256(text.encode()).hexdigest()[:16]


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(exist_ok=True)
    for name, make in FILES.items():
        (folder / name).write_text(make(), encoding="utf-8")
