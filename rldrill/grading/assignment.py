"""An assignment: which problems a student was given, and which answers are to none of them."""

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct

from rldrill.files import read_text, shown
from rldrill.grading.answers_file import PLACE, Entry
from rldrill.problems.errors import FileError, UsageError
from rldrill.problems.identity import looks_like_id, split_id
from rldrill.spreadsheet import folded, table

if TYPE_CHECKING:
    from rldrill.exam.manifest import Printed


class Sitting(Struct, frozen=True):
    """A student's exam: the name and number that reports use, and the version; None where the student has none.

    ``why`` says then what is missing.
    """

    student: str
    number: str
    version: "Printed | None"
    why: str = ""


class _People:
    """Who is meant by a number and a name."""

    def __init__(self, people: Iterable[Sitting] = ()) -> None:
        self._called: dict[str, list[Sitting]] = {}
        self._numbered: dict[str, list[Sitting]] = {}
        for each in people:
            self.put(each)

    def put(self, sitting: Sitting) -> None:
        """Add somebody."""
        for key in {folded(sitting.number), folded(sitting.student)} - {""}:
            self._called.setdefault(key, []).append(sitting)
        if sitting.number:
            self._numbered.setdefault(without_zeros(sitting.number), []).append(sitting)

    def meant(self, number: str, name: str) -> Sitting | None:
        """The one who has the number, or else the name; one without a version where several have it, None if nobody."""
        correct = f", and none of them has the number {number!r}; correct it." if number else "; give the number."
        for found, what in (
            (self._called.get(folded(number)), f"have the number {number!r}; correct the roster."),
            (self._numbered.get(without_zeros(number)), f"have the number {number!r}; correct the roster."),
            (self._called.get(folded(name)), f"are called {name!r}{correct}"),
            (self._numbered.get(without_zeros(name)), f"have the number {name!r}; correct the roster."),
        ):
            if found:
                several = Sitting(name, number, None, f"several students on the roster {what}")
                return several if len(found) > 1 else found[0]
        return None


def without_zeros(number: str) -> str:
    """A number as a spreadsheet leaves it, which drops the zeros before it."""
    number = folded(number)
    return number.lstrip("0") or number[-1:]


class Assignment:
    """An exam as it is graded: exactly its problems, all of them.

    Args:
        manifest: the file that was written beside the exam.
        version: the code of the version that everybody sat; None to go by the roster.
        roster: a table of the students, with their versions where there are several and ``version`` is None; without
            it the manifest's own people are the roster.

    Raises:
        FileError: the manifest or the roster cannot be read.
        UsageError: there is no such version, or nothing says who sat which.
    """

    def __init__(self, manifest: Path, version: str | None = None, roster: Path | None = None) -> None:
        self.manifest = manifest
        from rldrill.exam.manifest import printed, read_exam

        self.exam = read_exam(manifest)[0]
        self._ids_printed = self.exam.layout.ids
        self.versions = {each.code: each for each in printed(manifest)}
        self._all: Printed | None = None
        self._people = _People()
        self.people: list[Sitting] = []
        self._known = f"the versions of {shown(manifest)} are {', '.join(self.versions)}"
        if version is not None:
            if version.upper() not in self.versions:
                raise UsageError(f"There is no version {version[:20]!r}; {self._known}.")
            self._all = self.versions[version.upper()]
        elif len(self.versions) == 1:
            (self._all,) = self.versions.values()
        people = [Sitting(each.person.name, each.person.number, each) for each in self.versions.values() if each.person]
        if roster is not None:
            self._read(roster, people if version is None else [])
            self._all = None
        elif version is None and people:
            for each in people:
                self._put(each)
            self._all = None
        elif self._all is None:
            raise UsageError(f"Who sat which version? {self._known}; say --version CODE or --roster FILE.csv.")

    def sitting(self, entry: Entry) -> Sitting:
        """The exam of whoever typed an answer."""
        known = self._people.meant(entry.number, entry.student)
        if known is not None:
            return known
        if self._all is not None:
            return Sitting(entry.student, entry.number, self._all)
        whose = f"{entry.student!r} is" if entry.student else "an answer without a student is"
        return Sitting(entry.student, entry.number, None, f"{whose} not on the roster; correct the name or number.")

    def place(self, entry: Entry, version: "Printed") -> int | str:
        """Where in the version an answer belongs, from 0; or why it does not."""
        name = entry.problem
        if PLACE.fullmatch(name):
            number = int(name)
            return number - 1 if number <= len(version.ids) else f"the exam has {len(version.ids)} problems, no {name}"
        if not looks_like_id(name):
            return f"{name!r} is a file of one's own"
        if (
            not self._ids_printed
        ):  # a sitting in the terminal writes whole IDs; more is not told of what was not printed
            found = version.ids.index(name) if name in version.ids else None
            return f"no problem of this exam is called {name}; call it by its number" if found is None else found
        family, level, seed, revision = split_id(name)
        for place, printed_id in enumerate(version.ids):
            if printed_id is None or not looks_like_id(printed_id):
                continue
            other = split_id(printed_id)
            if other[:3] == (family, level, seed):
                if revision in (None, other[3]):
                    return place
                return f"{name} is of another revision than the exam's; write {printed_id} or {place + 1} for that one"
        for each in self.versions.values():
            if any(one and looks_like_id(one) and split_id(one)[:3] == (family, level, seed) for one in each.ids):
                return f"{name} is of version {each.code}, and version {version.code} was sat"
        same = [one for one in version.ids if one and looks_like_id(one) and split_id(one)[0] == family]
        if same and all(split_id(one)[1] != level for one in same):
            return f"{name} is of another level than the exam's"
        return f"{name} is not in this exam; its problems may be called by their numbers, 1 to {len(version.ids)}"

    def guesses(self, entries: Sequence[Entry], version: "Printed") -> bool:
        """Whether somebody tries IDs out, to learn which ones the exam has, and redraw their keys."""
        ids = {entry.problem for entry in entries if looks_like_id(entry.problem)}
        return not self._ids_printed and len(ids) > 2 * len(version.ids) + 10

    def called(self, version: "Printed", place: int) -> str:
        """What reports call a problem: its ID only where that was printed, for an ID names its own key."""
        return (self._ids_printed and version.ids[place]) or f"problem {place + 1}"

    def _put(self, sitting: Sitting) -> None:
        self.people.append(sitting)
        self._people.put(sitting)

    def _read(self, path: Path, people: Sequence[Sitting]) -> None:
        """A roster: columns for the name (or first and last name) or the number, and for the version, if it differs.

        Where the exam was printed for people, the roster that it was printed from will do.
        """
        text = read_text(path, (".csv",))
        needed = ("version",) if self._all is None and not people else ()
        printed = _People(people)
        for line, row in table(text, path, ("student", "number", "version"), needed)[2]:
            if "says" in row:
                raise FileError(row["says"])
            code = row.get("version", "").upper() if self._all is None else self._all.code
            if people and "version" not in row:
                known = printed.meant(row.get("number", ""), row.get("student", ""))
                if known is None or known.version is None:
                    why = "the exam was not printed for them; add a version." if known is None else known.why
                    raise FileError(f"{shown(path)}, line {line}: {why}")
                code = known.version.code
            if code not in self.versions:
                raise FileError(f"{shown(path)}, line {line}: there is no version {code[:20]!r}; {self._known}.")
            student = row.get("student", "")
            if not student and not row.get("number"):
                raise FileError(f"{shown(path)}, line {line}: neither a name nor a number stands there; give one.")
            self._put(Sitting(student or row["number"], row.get("number", ""), self.versions[code]))
