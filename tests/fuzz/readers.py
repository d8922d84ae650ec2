"""Fuzzes a reader of files, guided by coverage: ``python tests/fuzz/readers.py READER -max_total_time=600``.

It needs ``pip install atheris``, which has no wheels for every system and is no part of the tests. What a reader may do
is refuse a file in a sentence of ours; everything else, and whatever takes long or much memory, is a crash that
libFuzzer writes down. The examples in ``corpus/`` are where it begins.
"""

import shutil
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import atheris

with atheris.instrument_imports(include=["rldrill", "problems", "solutions", "tomllib", "json", "csv"]):
    from rldrill.exam.blueprint import read_blueprint
    from rldrill.exam.manifest import printed
    from rldrill.exam.roster import read_roster
    from rldrill.exercise import load
    from rldrill.files import MODEL_SUFFIXES, read_data
    from rldrill.grading.answers_file import read_answers
    from rldrill.grading.assignment import Assignment
    from rldrill.grading.verification import Settings, verify
    from rldrill.model_file import read_model
    from rldrill.problems.errors import UserError

CORPUS = Path(__file__).parent / "corpus"
FOLDER = Path(tempfile.mkdtemp())
EXAM = CORPUS / "exam.json"
#: Numbers, tables, a matrix, a policy.
EXERCISES = [
    load(name) for name in ("return/1/2166", "td-zero/2/7", "lqr-gain/1/7", "value-iteration/1/7", "bayes-rule/1/43")
]


def _assignment(path: Path) -> None:
    Assignment(EXAM, roster=path)


def _manifest(path: Path) -> None:
    printed(path)
    Assignment(path, "A")


def _graded(path: Path) -> None:
    verify([path], Settings(assignment=Assignment(EXAM, "A")))


def _answer(path: Path) -> None:
    text = path.read_text(encoding="utf-8", errors="replace")
    for exercise in EXERCISES:
        exercise.check(text)


#: What reads a file with a name that ends so.
READERS: dict[str, tuple[str, Callable[[Path], object]]] = {
    "answers-toml": (".toml", read_answers),
    "answers-json": (".json", read_answers),
    "answers-csv": (".csv", read_answers),
    "answers-jsonl": (".jsonl", read_answers),
    "graded-toml": (".toml", _graded),
    "graded-csv": (".csv", _graded),
    "course-roster": (".csv", read_roster),
    "roster": (".csv", _assignment),
    "manifest": (".json", _manifest),
    "blueprint": (".toml", read_blueprint),
    "problem": (".toml", read_data),
    "answer": (".txt", _answer),
} | {f"model-{suffix[1:]}": (suffix, read_model) for suffix in sorted(MODEL_SUFFIXES)}


def fuzz(name: str) -> Callable[[bytes], None]:
    """What is called with every input."""
    suffix, read = READERS[name]
    path = FOLDER / f"input{suffix}"

    def one(data: bytes) -> None:
        path.write_bytes(data)
        said = ""
        try:
            read(path)
        except UserError as error:
            said = str(error)
        assert "\n" not in said
        assert len(said) < 2000

    return one


if __name__ == "__main__":
    reader, *options = sys.argv[1:]
    found = FOLDER / "corpus"
    found.mkdir()
    for example in CORPUS.glob(f"*{READERS[reader][0]}"):
        shutil.copy(example, found)
    atheris.Setup([sys.argv[0], "-timeout=20", "-rss_limit_mb=2048", *options, str(found)], fuzz(reader))
    atheris.Fuzz()
