"""An exam in the terminal: part after part, back and forth, and a report once it is handed in."""

import re
import shlex
from collections.abc import Callable, Sequence
from datetime import datetime, timedelta
from functools import partial

from rich.console import Console, RenderableType
from rich.padding import Padding
from rich.table import Table

from rldrill.entries import by_name
from rldrill.exercise import Exercise
from rldrill.grading.report import MarkedPart, Score, total
from rldrill.problems.document import counted
from rldrill.problems.errors import reason
from rldrill.problems.parts import Part
from rldrill.quiz.display import Display
from rldrill.quiz.keys import COMMANDS
from rldrill.quiz.prompt import Ask
from rldrill.quiz.shapes import how_to_type
from rldrill.quiz.sitting import Place, Sitting, by_topic
from rldrill.render.compact import Compact
from rldrill.render.linear import linear
from rldrill.render.terminal import asked, render, renderable, words
from rldrill.solutions.answers.judging import read_answer, what_is_missing
from rldrill.solutions.answers.rule import RULE
from rldrill.solutions.answers.text import Unreadable

_WORDS = "Enter goes on · back · go 3b · overview · problem · clear · hand in · leave"
_HELP = (
    ("an answer", "is kept; nothing is judged before the exam is handed in"),
    ("Enter", "on to the next part"),
    ("back", "to the part before"),
    ("go 3b", "to part (b) of problem 3"),
    ("overview", "what is answered, and what is not"),
    ("problem", "show this problem again"),
    ("clear", "take the answer to this part back"),
    ("hand in", "end the exam, and see how it went"),
    ("leave", "go on another time: the same command takes it up; the clock does not stop"),
    (":back", "to the part before, where 'back' is an answer; so for all of these"),
)
_COMMANDS = frozenset(("", "next", "back", "overview", "problem", "clear", "hand in", "leave", "?", "help"))
#: What is wrong with an answer that nobody can read.
_UNREAD = "it cannot be read and"
#: The title of a problem with the lines around it, and the prompt.
_BESIDES = 5
#: The last seconds are told one by one.
_SECONDS = 60
_GO = re.compile(r"go\s+(\d{1,3})\s*\(?([a-z])?\)?")


class SittingScreen:
    """Runs an exam on a console.

    Args:
        console: where it is shown.
        ask: asks for a line.
        now: the time.
        plain: whether a screen reader reads it.
    """

    def __init__(self, console: Console, ask: Ask, now: Callable[[], datetime], *, plain: bool = False) -> None:
        self._plain = plain
        self._console = console
        self._display = Display(console, ask, plain=plain)
        self.redraw = self._display.redraw
        self._ask, self._print = self._display.ask, self._display.print
        self._now = now
        self._kept, self._told = True, False

    def run(self, sitting: Sitting) -> bool:
        """Sit the exam, from the first part without an answer on.

        Returns:
            Whether it was handed in.

        Raises:
            OSError: it is left, and the answers cannot be written.
        """
        if sitting.handed_in is None:
            self._head(sitting)
            self._keep(sitting)  # from now on the time is known, whatever happens
            if not self._parts(sitting):
                sitting.save()
                self._print(words("Kept in ", (str(sitting.path), "bold"), "; the same command goes on."), whole=True)
                return False
            if sitting.handed_in is None:
                sitting.handed_in = self._now()
                self._keep(sitting)
        self._report(sitting)
        return True

    def _keep(self, sitting: Sitting) -> None:
        """Write the file of answers; where the disk does not let us, say so once and go on."""
        try:
            aside = sitting.save()
            self._kept = True
            if aside is not None:
                said = f"{sitting.path} was changed meanwhile and could not be read; what stood there is in {aside}."
                self._print(words((said, "yellow")))
        except OSError as error:
            self._kept = False
            if not self._told:
                self._told = True
                self._print(
                    words((f"Your answers cannot be written to {sitting.path}: {reason(error)}. ", "yellow"),
                          "It is tried again with every answer; hand in here, or make room before you leave.")
                )  # fmt: skip

    def _head(self, sitting: Sitting) -> None:
        head = sitting.exam.head
        self._print(words((head.title, "bold"), f", version {sitting.version.code}"))
        for line in filter(None, (head.course, head.date, head.instructions)):
            self._print(words(line))
        problems = len(sitting.version.exercises)
        time = "" if head.duration is None else f", {head.duration} minutes"
        self._print(words(f"{counted(problems, 'problem')}, {sitting.version.points} points{time}. Right is {RULE}."))
        self._print(words((f"{_WORDS} · ? help", "dim")))

    def _parts(self, sitting: Sitting) -> bool:
        """Ask until it is handed in; False where it is left."""
        places = sitting.places
        at = next((index for index, place in enumerate(places) if place not in sitting.answers), 0)
        shown: int | None = None
        while sitting.handed_in is None and not self._is_over(sitting):
            if at == len(places):
                at, over = self._at_the_end(sitting)
                if over is not None:
                    return over
                shown = None
            place = places[at]
            if shown != place.problem:
                self._problem(sitting, place.problem)
                shown = place.problem
            self._part(sitting, place)
            try:
                text = self._ask(partial(self._prompt, sitting, place), "?").strip()
            except EOFError:
                self._print()
                return False
            except KeyboardInterrupt:
                self._print()
                text = f":{self._interrupted()}"  # never an answer
            if self._is_over(sitting):
                break
            command = _command(sitting, place, text)
            if command == "leave":
                return False
            if command is None:
                at += self._answered(sitting, place, text)
            elif command == "hand in":
                at = len(places)
            elif command == "problem":
                shown = None
            elif command == "overview":
                self._overview(sitting)
            elif command in ("?", "help"):
                self._display.keys(_HELP)
            elif command == "clear":
                sitting.answer(place, "")
                self._keep(sitting)
            elif command in ("", "next"):
                at += 1
            elif command == "back":
                if at == 0:
                    self._print(words(("  This is the first part.", "yellow")))
                at = max(0, at - 1)
            elif match := _GO.fullmatch(command):
                at = self._found(places, match, at)
        if sitting.handed_in is not None:
            self._print(words(("Handed in. ", "bold"), "That was done in another terminal; what it wrote counts."))
        else:
            self._print(words(("Time is up. ", "bold"), "What was typed after that does not count."))
        return True

    def _is_over(self, sitting: Sitting) -> bool:
        return sitting.end is not None and self._now() > sitting.end

    def _at_the_end(self, sitting: Sitting) -> tuple[int, bool | None]:
        """Ask whether to hand in: where to go on if not, and whether it is over."""
        self._overview(sitting)
        missing = len(sitting.places) - len(sitting.answers)
        open_ = f"{missing} of {len(sitting.places)} parts have no answer. " if missing else ""
        while True:
            try:
                text = self._ask(f"{open_}Hand in? yes, no or leave > ").strip().lower()
            except (EOFError, KeyboardInterrupt):
                self._print()
                return 0, False
            if text in ("yes", "y", "hand in"):
                return 0, True
            if text == "leave":
                return 0, False
            if text in ("no", "n", "back"):
                first = next((i for i, place in enumerate(sitting.places) if place not in sitting.answers), 0)
                return first, None
            if match := _GO.fullmatch(text):
                return self._found(sitting.places, match, 0), None

    def _interrupted(self) -> str:
        try:
            text = self._ask("Hand in, leave, or go on? hand in/leave/Enter > ").strip().lower()
        except (EOFError, KeyboardInterrupt):
            return "leave"
        return text if text in ("hand in", "leave") else "problem"

    def _found(self, places: Sequence[Place], match: re.Match[str], at: int) -> int:
        place = Place(int(match[1]) - 1, "abcdefghijklmnopqrstuvwxyz".index(match[2] or "a"))
        if place in places:
            return places.index(place)
        self._print(words((f"  There is no part {match[1]}{match[2] or ''}.", "yellow")))
        return at

    def _answered(self, sitting: Sitting, place: Place, text: str) -> bool:
        """Keep an answer, and say if it would count as wrong whatever is right; what it is worth is not said.

        A key of the quiz is none, and what cannot be read does not take the place of an answer that can.

        Returns:
            Whether it goes on.
        """
        fault, says = _says_why(sitting, place, text)
        if fault is _UNREAD and text.lower().removeprefix(":") in COMMANDS:
            self._print(words((f"  There is no {text!r} in an exam: ", "yellow"), _WORDS))
            return False
        old = sitting.answers.get(place)
        kept = fault is not _UNREAD or old is None or _says_why(sitting, place, old)[0] is _UNREAD
        if kept:
            sitting.answer(place, text)
            self._keep(sitting)
        if says:
            says = by_name(says, sitting.part(place).kind)
            told = f"Kept, but {fault} would count as wrong: " if kept else "Not kept, since it cannot be read: "
            self._display.signed(("?", "yellow"), words((told, "yellow"), says))
        return not says

    def _problem(self, sitting: Sitting, number: int) -> None:
        exercise = sitting.version.exercises[number]
        points = sum(part.points for part in exercise.parts)
        title = f"Problem {number + 1} of {len(sitting.version.exercises)}  {exercise.problem.family.title}"
        self._print()
        self._display.turn()
        self._print(words((title, "bold"), f" · {counted(points, 'point')}"))
        self._print()
        if self._plain:
            self._print(render(linear(exercise.question())))
            return
        options = self._console.options.update(width=self._display.width)
        taken = sum(len(self._console.render_lines(line, options)) for line in _asked(exercise, exercise.parts[0]))
        self._print(Compact(tuple(exercise.question()), besides=_BESIDES + taken))
        self._print()

    def _part(self, sitting: Sitting, place: Place) -> None:
        for line in _asked(sitting.exercise(place), sitting.part(place)):
            self._print(line)
        if place in sitting.answers:
            self._print(words(("  your answer so far: ", "dim"), sitting.answers[place]))

    def _prompt(self, sitting: Sitting, place: Place) -> str:
        left = sitting.left(self._now())
        time = "" if left is None else f"[{_clock(left)} left] "
        return f"{time}{place.problem + 1}{sitting.part(place).label} > "

    def _overview(self, sitting: Sitting) -> None:
        table = Table.grid(padding=(0, 2))
        for place in sitting.places:
            typed = sitting.answers.get(place)
            name = f"  {place.problem + 1}{sitting.part(place).label}"
            short = "–" if typed is None else " ".join(typed.split())[:40]
            table.add_row(name, sitting.exercise(place).problem.family.title, words(short))
        self._print(table)

    def _report(self, sitting: Sitting) -> None:
        graded = sitting.graded()
        topics = by_topic(sitting, graded)
        self._print()
        self._print(words((f"{_told(total(topics.values()))} points", "bold")))
        table = Table.grid(padding=(0, 2))
        for topic, score in topics.items():
            table.add_row(f"  {topic}", _told(score))
        self._print(table)
        for number, (exercise, parts) in enumerate(zip(sitting.version.exercises, graded, strict=True), 1):
            for own, part in zip(exercise.parts, parts, strict=True):
                self._graded(f"{number}{part.part}", part)
                if not part.judged.accepted:
                    self._display.indented(render(exercise.working(part.part)))
                    self._print(words(("  The answer:", "dim")))
                    self._display.indented(renderable(exercise.answer(own)))
        if not self._kept:
            self._print(words((f"Your answers could not be written to {sitting.path}.", "yellow")), whole=True)
            return
        again = ["rldrill", "verify", str(sitting.path)]
        if sitting.manifest is not None:
            again += ["--for", str(sitting.manifest)]
            again += ["--version", sitting.version.code] if len(sitting.exam.versions) > 1 else []
        self._print(words(f"Your answers are in {sitting.path}. To grade them again: {shlex.join(again)}"), whole=True)

    def _graded(self, name: str, part: MarkedPart) -> None:
        mark, style = ("✓", "green") if part.judged.accepted else ("✗", "red")
        typed = f"{' '.join(part.typed.split())[:60]}  " if part.typed else ""
        points = f"  {_told(part.score)}  "
        self._print(words((f"{mark} {name}", f"bold {style}"), points, (typed, "bold"), part.judged.reason))


def _command(sitting: Sitting, place: Place, text: str) -> str | None:
    """The command that was meant; None for an answer: whatever can be read as one is one, and ``:back`` the command."""
    typed = text.lower()
    command = typed.removeprefix(":").strip()
    if command not in _COMMANDS and not _GO.fullmatch(command):
        return None
    return command if command != typed or not typed or _says_why(sitting, place, text)[1] else None


def _says_why(sitting: Sitting, place: Place, text: str) -> tuple[str, str]:
    """Why an answer counts as wrong whatever is right: what about it does, and a sentence; nothing if it need not."""
    solution, part, text = sitting.exercise(place).solution, sitting.part(place), sitting.pointed(place, text)
    try:
        return "what is missing", what_is_missing(solution, part, read_answer(solution, part, text))
    except Unreadable as error:
        return _UNREAD, error.message


def _asked(exercise: Exercise, part: Part) -> tuple[RenderableType, ...]:
    """What is asked in a part, and how the answer is typed."""
    shape = how_to_type(part.kind, exercise.problem.parameters)
    return asked(part, only=len(exercise.parts) == 1), Padding(words((shape, "dim")), (0, 0, 0, 2), expand=False)


def _clock(left: timedelta) -> str:
    seconds = int(left.total_seconds())
    if seconds < _SECONDS:
        return f"{seconds} s"
    minutes = -(-seconds // 60)
    return f"{minutes} min" if minutes < 120 else f"{minutes // 60} h {minutes % 60} min"


def _told(score: Score) -> str:
    return f"{float(score.points):g} of {score.of}"
