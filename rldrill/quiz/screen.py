"""The quiz in the terminal: one problem after the other, part by part."""

import re
from collections.abc import Callable, Iterable, Iterator
from enum import Enum
from itertools import islice
from typing import TYPE_CHECKING

from msgspec import Struct
from rich.console import Console, ConsoleOptions, Group, RenderableType, RenderResult
from rich.text import Text

from rldrill.entries import by_name
from rldrill.exam.selection import fresh_seed
from rldrill.exercise import Exercise, draw
from rldrill.history.memory import Skill
from rldrill.history.progress import DAY
from rldrill.problems.document import Equation
from rldrill.problems.identity import MAX_SEED
from rldrill.problems.parts import Choice, Kind, Matrix, Numbers, Policy, Values, YesNo
from rldrill.quiz.ahead import Ahead
from rldrill.quiz.display import Display
from rldrill.quiz.ending import ending, weakest
from rldrill.quiz.hints import ladder
from rldrill.quiz.keys import COMMANDS, COUNTS, HELP, KEYS, SHORT_KEYS, alone, command
from rldrill.quiz.planning import Plan
from rldrill.quiz.prompt import Ask
from rldrill.quiz.recording import Recorder, utc_now
from rldrill.quiz.session import PartRecord, Record, Session, State
from rldrill.quiz.shapes import how_to_type
from rldrill.render.compact import Compact
from rldrill.render.linear import linear
from rldrill.render.terminal import asked, compared, render, renderable, words
from rldrill.solutions.answers.judging import Outcome, Verdict
from rldrill.solutions.answers.key import answer_block
from rldrill.solutions.answers.rule import RULE

if TYPE_CHECKING:
    from rldrill.diagnosis import Diagnosis

_OR_ELSE = "Try again, or h for a hint, m to check your own working, w for the working, s to go on."
_FIRST_LINE = "Still wrong, so h now shows the first line with the numbers in; w shows all of it."
_STYLES = {
    Outcome.RIGHT: "green",
    Outcome.FOLLOW_THROUGH: "green",
    Outcome.CLOSE: "yellow",
    Outcome.MISCONCEPTION: "red",
    Outcome.WRONG: "red",
    Outcome.UNREADABLE: "yellow",
}
#: The sign of a verdict, and what is said before its sentence.
_WORDS = {
    Outcome.RIGHT: ("✓", ""),
    Outcome.FOLLOW_THROUGH: ("✓", ""),
    Outcome.CLOSE: ("≈", ""),
    Outcome.MISCONCEPTION: ("✗", "A typical mistake gives this: "),
    Outcome.WRONG: ("✗", ""),
    Outcome.UNREADABLE: ("?", "Not understood, and not counted: "),
}
#: What is said before the sentence that asks for entries that were left out: what was given was understood.
_INCOMPLETE = "Incomplete, and not counted: "
#: How a line of somebody's own working is marked.
_STANDINGS = {
    "right": ("✓", "green"),
    "follows": ("✓", "green"),
    "short": ("≈", "yellow"),
    "departs": ("✗", "red"),
    "miscalculated": ("✗", "red"),
    "unread": ("?", "yellow"),
}
#: The lines of every screen with a question: its header, a blank line under that and under the question, the prompt.
_BESIDES = 4
#: So many more of the weakest skill are asked at the end, of this level where the problem had none.
_FIVE, _LEVEL = 5, 2
#: After so many misses the next hint is the first line with the numbers in.
_MISSES = 3
#: The names of places that nobody types.
_PLACES = re.compile(r"(?:row \d+, column \d+|entry \d+): ")


class Then(Enum):
    """Where to go on."""

    NEXT = "next"
    RESTART = "restart"
    VARIANT = "variant"
    QUIT = "quit"


class _Header(Struct, frozen=True):
    """A line, with a name at its end where there is room for it."""

    line: tuple[tuple[str, str], ...]
    name: tuple[str, str]

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        whole = (*self.line, self.name)
        yield words(*(whole if sum(len(text) for text, _ in whole) < options.max_width else self.line))


class Screen:
    """Runs a quiz on a console, asking through ``ask``."""

    def __init__(
        self,
        console: Console,
        ask: Ask,
        recorder: Recorder | None = None,
        seen: Iterable[str] | None = None,
        topics: Callable[[], RenderableType] = Text,
        plan: Plan | None = None,
        *,
        plain: bool = False,
        said: str = "",
    ) -> None:
        self._plain = plain
        self._console = console
        self._display = Display(console, ask, plain=plain, said=said)
        self.redraw = self._display.redraw
        self._print, self._indented, self._signed = self._display.print, self._display.indented, self._display.signed
        self._recorder = recorder or Recorder()
        self._seen = None if seen is None else set(seen)
        self._topics = topics
        self._plan = plan
        self._pasted: list[str] = []
        self._keys: tuple[str, ...] = KEYS
        self._ahead = Ahead(iter(()))

    def run(self, exercises: Iterable[Exercise], session: Session) -> bool:
        """Ask one exercise after the other; every verdict is in the session as soon as it is given.

        Returns:
            False when the person pressed Ctrl-C.
        """
        more: Iterable[Exercise] | None = exercises
        try:
            while more is not None:
                begin = self._recorder.elapsed
                try:
                    self._problems(more, session)
                finally:
                    if session.parts or more is exercises:
                        self.summary(session, self._recorder.elapsed - begin)
                more = self._five_more(session)
                session = Session(_FIVE, again=session.again, drilled=session.drilled, more=session.more)
        except EOFError:
            self._print()
        except KeyboardInterrupt:
            self._print()
            return False
        return True

    def _problems(self, exercises: Iterable[Exercise], session: Session) -> None:
        self._ahead = Ahead(iter(exercises))
        try:
            for number, exercise in enumerate(self._ahead, 1):
                if self._example(exercise) is Then.QUIT or self._problem(exercise, number, session) is Then.QUIT:
                    break
        except (EOFError, KeyboardInterrupt):
            self._print()
            raise

    def _five_more(self, session: Session) -> Iterator[Exercise] | None:
        """Problems of the mistake that is drilled, or of the weakest skill, if there is one and they are wanted."""
        more = (session.more or _of_the_weakest(session)) if session.parts else None
        if more is None or self._line("f five more of these · Enter ends > ", "fq ").strip().lower() != "f":
            return None
        self._print()
        return islice(more(), _FIVE)

    def _example(self, exercise: Exercise) -> Then:
        """Show one of a family that is new worked out, if that is wanted."""
        family = exercise.problem.family
        if self._seen is None or exercise.id is None or family.name in self._seen:
            return Then.NEXT
        self._seen.add(family.name)
        self._display.turn()
        self._print(words("New: ", (family.title, "bold"), "."))
        wanted = self._key("Enter shows a worked example · n the problem · t topics > ")
        if wanted == "q":
            return Then.QUIT
        self._print()
        if wanted in ("n", "next", "s"):
            return Then.NEXT
        shown = variant(exercise)
        self._question(shown)
        for part in shown.parts:
            self._print(asked(part, only=len(shown.parts) == 1))
            self._indented(render(shown.working(part.label)))
            self._signed(("The answer:", "dim"), renderable(shown.answer(part)))
            self._print()
        wanted = self._key("Enter: your turn > ")
        self._print()
        return Then.QUIT if wanted == "q" else Then.NEXT

    def _key(self, prompt: str) -> str:
        """The key that is meant where no answer is asked for; help and the map are shown, and it is asked again."""
        while True:
            text = self._line(prompt, "nqt? ").strip().lower().removeprefix(":")
            match COMMANDS.get(text, text):
                case "?":
                    self._help()
                case "t":
                    self._print(self._topics())
                case key:
                    return key

    def _problem(self, exercise: Exercise, number: int, session: Session) -> Then:
        record = Record.of(exercise)
        while True:
            session.records.append(record)
            self._header(record.exercise, number, session)
            self._question(record.exercise)
            then = self._parts(record)
            if then is Then.NEXT:
                then = self._after(record)
            if then in (Then.NEXT, Then.QUIT):
                return then
            if then is Then.RESTART or not record.begun:
                session.records.remove(record)
            record = record.again() if then is Then.RESTART else Record.of(variant(record.exercise))

    def _header(self, exercise: Exercise, number: int, session: Session) -> None:
        self._display.turn()
        family = exercise.problem.family
        level = f" · level {exercise.problem.level}" if exercise.problem.level else ""
        line: list[tuple[str, str]] = [(f"Problem {number}", "bold")]
        if session.total is not None:
            bar = session.total <= 40 and not self._plain
            done = "━" * number + "─" * (session.total - number) if bar else ""
            line += [(f" of {session.total}", ""), (f"  {done}" if done else "", "cyan")]
        elif session.minutes is not None:
            line.append((f" · minute {int(self._recorder.elapsed // 60) + 1} of {session.minutes}", ""))
        line.append((f"  {family.title}{level}", ""))
        self._print(_Header(tuple(line), (f"  {exercise.id or 'your own problem'}", "dim")))
        self._print()

    def _question(self, exercise: Exercise) -> None:
        if self._plain:
            self._print(render(linear(exercise.question())))
            self._notes(exercise)
            return
        first = exercise.parts[0]
        others = (
            asked(first, only=len(exercise.parts) == 1),
            Text(f"  {how_to_type(first.kind, exercise.problem.parameters)}"),
            *map(Text, (*exercise.notes, *(self._keys or (SHORT_KEYS,)))),
        )
        options = self._console.options.update(width=self._display.width)
        taken = sum(len(self._console.render_lines(other, options)) for other in others)
        self._print(Compact(tuple(exercise.question()), besides=_BESIDES + taken))
        self._print()
        self._notes(exercise)

    def _notes(self, exercise: Exercise) -> None:
        for note in exercise.notes:
            self._print(words((f"({note})", "dim")))

    def _parts(self, record: Record) -> Then:
        only = len(record.parts) == 1
        for part in record.parts:
            self._print(asked(part.part, only=only))
            self._how_to_type(record, part)
            self._recorder.asked()
            record.exercise.diagnosing.begin()
            try:
                then = self._part(record, part, "> " if only else f"({part.part.label}) > ")
            finally:
                record.exercise.diagnosing.finish()
            if then is not Then.NEXT:
                return then
        return Then.NEXT

    def _how_to_type(self, record: Record, part: PartRecord) -> None:
        """The shape of an answer; with the keys, which are told at length once."""
        shape = how_to_type(part.part.kind, record.exercise.problem.parameters)
        keys, self._keys = self._keys, ()
        for line in (shape, *keys) if keys else (f"{shape}  ({SHORT_KEYS})",):
            self._indented(words((line, "dim")))

    def _typed(self, prompt: str, kind: Kind) -> str:
        """What was typed: of what may take several lines, all that were pasted together, and up to the last bracket."""
        if not isinstance(kind, Matrix | Values | Numbers | Policy):
            return self._line(prompt, "?")
        lines = [*self._pasted, *([] if self._pasted else [self._display.ask(prompt, "?")])]
        self._pasted = []
        while sum(line.count("[") - line.count("]") for line in lines) > 0:
            lines.append(self._display.ask("... "))
            if not lines[-1].strip():
                break
        return "\n".join(lines)

    def _line(self, prompt: str, keys: str = "") -> str:
        """One line or key, the next of those lines that were pasted together, if there are any left."""
        if not self._pasted and len(prompt) >= self._console.width:  # broken between its words, not within one
            self._print(words(prompt.removesuffix(" > ")))
            prompt = "> "
        self._pasted = self._pasted or self._display.ask(prompt, keys).split("\n")
        return self._pasted.pop(0)

    def _part(self, record: Record, part: PartRecord, prompt: str) -> Then:
        while part.state is State.OPEN:
            text = self._typed(prompt, part.part.kind).strip()
            match command(text, record.exercise, part.part.kind):
                case "":
                    self._print(Text("  Type an answer, or ? for help.", style="dim"))
                case "q":
                    return Then.QUIT
                case "r":
                    return Then.RESTART
                case "v":
                    return Then.VARIANT
                case "?":
                    self._help()
                case "p":
                    self._print(Text(record.exercise.id or "your own problem", style="dim"))
                    self._question(record.exercise)
                    self._print(asked(part.part, only=len(record.parts) == 1))
                case "t":
                    self._print(self._topics())
                case "h":
                    self._hint(record, part)
                case "m":
                    self._own_working(record)
                case "s":
                    part.state = State.SKIPPED
                    self._recorder.ended(record, part)
                    self._answer(record, part)
                case "w":
                    part.state = State.SHOWN
                    self._recorder.ended(record, part)
                    self._working(record, part)
                case _:
                    self._judged(record, part, text)
        self._print()
        return Then.NEXT

    def _judged(self, record: Record, part: PartRecord, text: str) -> None:
        verdict = record.answer(part, text).verdict
        if verdict is None:
            return
        if verdict.counts:
            self._recorder.ended(record, part)
        self._verdict(verdict, record, part)
        if part.state is State.DONE:
            self._print(Text(f"  {_how(part)}", style="dim"))
        if part.state is not State.OPEN and isinstance(part.part.kind, YesNo | Choice):
            self._working(record, part)

    def _after(self, record: Record) -> Then:
        prompt = "Enter next · p problem · w working · v variant · r again · q quit > "
        self._comes_again(record.exercise)
        self._ahead.begin()
        while True:
            text = self._line(prompt, alone("npwvrqt? ", record.exercise)).strip()
            match COMMANDS.get(text.lower().removeprefix(":"), text):
                case "" | "next" | "n":
                    return Then.NEXT
                case "p":
                    self._question(record.exercise)
                case "w":
                    self._print(render(record.exercise.working()))
                case "v":
                    return Then.VARIANT
                case "r":
                    return Then.RESTART
                case "q":
                    return Then.QUIT
                case "t":
                    self._print(self._topics())
                case "?":
                    self._help()
                case _:
                    self._print(words(("  All parts of this problem are done, so that was not judged: ", "dim"), text))

    def _comes_again(self, exercise: Exercise) -> None:
        """Say when the like of it is asked again."""
        if self._plan is None or exercise.problem.level is None:
            return
        skill = Skill(exercise.problem.family.name, exercise.problem.level)
        self._plan.learn(self._recorder.attempts)
        if skill in self._plan.memories:
            self._print(Text(f"This comes again {self._plan.again(skill, utc_now())}.", style="dim"))

    def _verdict(self, verdict: Verdict, record: Record, part: PartRecord) -> None:
        if verdict.missing:
            asked = by_name(verdict.missing, part.part.kind)
            self._signed(("?", "bold yellow"), words((_INCOMPLETE, "bold yellow"), asked))
            return
        diagnosis = record.diagnosis(part)
        explained = diagnosis is not None and diagnosis.explains and not verdict.told
        outcome = Outcome.WRONG if explained else verdict.outcome
        says = diagnosis.of(verdict) if diagnosis is not None and explained else verdict.says
        says = by_name(says, part.part.kind)
        sign, before = _WORDS[outcome]
        style = f"bold {_STYLES[outcome]}"
        read = _read_otherwise(verdict, part)
        kind = part.part.kind
        drawn = bool(read) and isinstance(kind, Matrix) and kind.rows > 1
        told = f"  (read as {read})" if read and not drawn else ""
        self._signed((sign, style), words((before, style), says, (told, "dim")))
        if drawn:
            self._signed(("read as", "dim"), renderable(answer_block(part.part, verdict.value)))
        if diagnosis is not None and diagnosis.wrong is not None and diagnosis.right is not None:
            # What comes out of the right line may be the answer, and is left to whoever tries again.
            right = _without_value(diagnosis) if part.state is State.OPEN else diagnosis.right
            if right is not None:
                self._print(compared(diagnosis.wrong, right))
        if verdict.counts and not verdict.accepted and part.state is State.OPEN and part.tries in (1, _MISSES):
            self._indented(words((_OR_ELSE if part.tries == 1 else _FIRST_LINE, "dim")))

    def _hint(self, record: Record, part: PartRecord) -> None:
        rungs = ladder(record.exercise, part.part.label)
        if part.hints >= len(rungs):
            self._print(Text("  That was the whole working; what it ends in is the answer.", style="dim"))
            return
        if part.tries >= _MISSES:
            part.hints = max(part.hints, next((n for n, rung in enumerate(rungs) if rung.is_working), part.hints))
        rung = rungs[part.hints]
        part.hints += 1
        self._print(words((f"  Hint {part.hints} of {len(rungs)}: {rung.says}", "dim")))
        self._indented(Group(*map(renderable, rung.blocks)))
        if part.hints == len(rungs):
            self._print(Text("  That is the whole working.", style="dim"))

    def _working(self, record: Record, part: PartRecord) -> None:
        self._indented(render(record.exercise.working(part.part.label)))
        self._answer(record, part)

    def _answer(self, record: Record, part: PartRecord) -> None:
        self._signed(("The answer:", "dim"), renderable(record.exercise.answer(part.part)))

    def _own_working(self, record: Record) -> None:
        """Ask for the person's own working, and say where it goes wrong."""
        self._print(Text("  Your working, a step a line (V = 8 + 1/2*4 = 10); an empty line ends it:", style="dim"))
        lines: list[str] = []
        while line := self._line("... ").strip():
            lines.append(line)
        if not lines:
            return
        followed = record.exercise.follow(lines)
        for step in followed.lines:
            mark, style = _STANDINGS[step.standing]
            self._signed((mark, f"bold {style}"), words(step.text))
            if step.sentence:
                self._signed((" " * len(mark), ""), words((step.sentence, style)))
        if followed.first is None:
            self._indented(words(followed.sentence))

    def _help(self) -> None:
        self._display.keys(HELP)
        self._indented(Text(f"Right is {RULE}. {COUNTS}", style="dim"))

    def summary(self, session: Session, seconds: float) -> None:
        """Print what was answered, and how."""
        parts = session.parts
        if not parts:
            self._print("Nothing was answered. Come back soon.")
            return
        due = None
        if self._plan is not None:
            self._plan.learn(self._recorder.attempts)
            due = len(self._plan.due(utc_now() + DAY))
        for line in ending(session, seconds, due):
            self._print(line)


def _of_the_weakest(session: Session) -> Callable[[], Iterator[Exercise]] | None:
    weak = weakest(session)
    if weak is None:
        return None
    family, level = weak.family, weak.level or _LEVEL
    return lambda: (draw(family, level, fresh_seed()) for _ in range(_FIVE))


def _without_value(diagnosis: "Diagnosis") -> Equation | None:
    """The line as it should be, without what comes out of it; None where nothing else stands there."""
    right = diagnosis.right
    if right is None or diagnosis.place is None or diagnosis.place.step is None:
        return right  # a formula has no value
    return right.without_last() if len(right.rights) > 1 else None


def _how(part: PartRecord) -> str:
    """How a right answer came about, and what it counts."""
    if part.first_time:
        return "At the first try."
    with_hints = {0: "", 1: ", with a hint"}.get(part.hints, f", with {part.hints} hints")
    return f"At try {part.tries}{with_hints}: counts {part.share}."


def _read_otherwise(verdict: Verdict, part: PartRecord) -> str:
    """How an answer was read, where that is not how it was typed."""
    read = _PLACES.sub("", verdict.read)
    kind = part.part.kind
    # Whoever is asked for one value need not name it.
    value = read.rpartition(": ")[2] if isinstance(kind, Values) and len(kind.keys) == 1 else read
    return "" if _signs(part.answers[-1].typed) in (_signs(read), _signs(value)) else read


def _signs(text: str) -> str:
    return re.sub(r"[\s,;:\[\]()=]", "", text.lower()).replace("−", "-")


def variant(exercise: Exercise) -> Exercise:
    """Another problem of the same family and level; a problem from outside gets one of level 2."""
    identity = exercise.problem.identity
    if identity is None:
        return draw(exercise.problem.family.name, 2, fresh_seed())
    return draw(identity.family, identity.level, (identity.seed + 1) % MAX_SEED)
