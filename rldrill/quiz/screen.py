"""The quiz in the terminal: one problem after the other, part by part."""

from collections.abc import Iterable
from enum import Enum

from rich.console import Console, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from rldrill.exercise import Exercise, draw
from rldrill.problems.identity import MAX_SEED
from rldrill.problems.parts import Kind, Matrix, Numbers, Policy, Values
from rldrill.quiz.prompt import Ask
from rldrill.quiz.session import PartRecord, Record, Session, State
from rldrill.render.terminal import asked, render, renderable, table, words
from rldrill.solutions.answers.judging import Outcome, Verdict
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.answers.rule import RULE

KEYS = "h hint · w working · s skip · r restart · v variant · q quit · ? help"
HELP = (
    ("h", "hint: the formula that is needed, then what it means"),
    ("w", "working: show how this part is solved, and go on"),
    ("m", "my working: type your own, line by line, to see where it goes wrong"),
    ("s", "skip this part"),
    ("r", "restart: begin this problem again from its first part"),
    ("v", "variant: another problem of the same kind"),
    ("q", "quit, with a summary (Ctrl-C and Ctrl-D do the same)"),
    ("?", "this help"),
)
_OR_ELSE = "Try again, or h for a hint, m to check your own working, w for the working, s to go on."
_STYLES = {
    Outcome.RIGHT: "green",
    Outcome.FOLLOW_THROUGH: "green",
    Outcome.CLOSE: "yellow",
    Outcome.MISCONCEPTION: "red",
    Outcome.WRONG: "red",
    Outcome.UNREADABLE: "yellow",
}
_WORDS = {
    Outcome.RIGHT: "✓",
    Outcome.FOLLOW_THROUGH: "✓",
    Outcome.CLOSE: "≈",
    Outcome.MISCONCEPTION: "✗ A typical mistake:",
    Outcome.WRONG: "✗",
    Outcome.UNREADABLE: "? Not understood, and not counted:",
}
#: How a line of somebody's own working is marked.
_STANDINGS = {
    "right": ("✓", "green"),
    "follows": ("✓", "green"),
    "departs": ("✗", "red"),
    "miscalculated": ("✗", "red"),
    "unread": ("?", "yellow"),
}


class Then(Enum):
    """Where to go on."""

    NEXT = "next"
    RESTART = "restart"
    VARIANT = "variant"
    QUIT = "quit"


class Screen:
    """Runs a quiz on a console, asking through ``ask``."""

    def __init__(self, console: Console, ask: Ask) -> None:
        self._console = console
        self._ask = ask
        self._pasted: list[str] = []

    def run(self, exercises: Iterable[Exercise], session: Session) -> bool:
        """Ask one exercise after the other; every verdict is in the session as soon as it is given.

        Returns:
            False when the person pressed Ctrl-C.
        """
        try:
            for number, exercise in enumerate(exercises, 1):
                if self._problem(exercise, number, session) is Then.QUIT:
                    break
        except EOFError:
            self._print()
        except KeyboardInterrupt:
            self._print()
            self.summary(session)
            return False
        self.summary(session)
        return True

    def _problem(self, exercise: Exercise, number: int, session: Session) -> Then:
        while True:
            record = Record.of(exercise)
            session.records.append(record)
            self._header(exercise, number, session.total)
            self._print(render(exercise.question()))
            for note in exercise.notes:
                self._print(Text(f"({note})", style="dim"))
            then = self._parts(record)
            if then is Then.NEXT:
                then = self._after(record)
            if then in (Then.NEXT, Then.QUIT):
                return then
            if not record.begun:
                session.records.remove(record)
            if then is Then.VARIANT:
                exercise = variant(exercise)

    def _header(self, exercise: Exercise, number: int, total: int) -> None:
        family = exercise.problem.family
        done = "━" * number + "─" * (total - number) if total <= 40 else ""
        level = f" · level {exercise.problem.level}" if exercise.problem.level else ""
        self._print()
        line = Text(f"Problem {number} of {total}", style="bold")
        line.append(f"  {done}  ", style="cyan").append(f"{family.title}{level}")
        self._print(line)
        self._print(Text(f"{exercise.id or 'your own problem'} · answers: {RULE}", style="dim"))
        self._print()

    def _parts(self, record: Record) -> Then:
        only = len(record.parts) == 1
        for part in record.parts:
            self._print(asked(part.part, only=only))
            self._print(words((f"  {answer_kind(part.part.kind).how_to_type()}", "dim")))
            self._print(words((f"  {KEYS}", "dim")))
            record.exercise.diagnosing.begin()
            then = self._part(record, part, "> " if only else f"({part.part.label}) > ")
            if then is not Then.NEXT:
                return then
        return Then.NEXT

    def _typed(self, prompt: str, kind: Kind) -> str:
        """What was typed: of what may take several lines, all that were pasted together, and up to the last bracket."""
        if not isinstance(kind, Matrix | Values | Numbers | Policy):
            return self._line(prompt)
        lines = [*self._pasted, *([] if self._pasted else [self._ask(prompt)])]
        self._pasted = []
        while sum(line.count("[") - line.count("]") for line in lines) > 0:
            lines.append(self._ask("... "))
            if not lines[-1].strip():
                break
        return "\n".join(lines)

    def _line(self, prompt: str) -> str:
        """One line, the next of those that were pasted together, if there are any left."""
        self._pasted = self._pasted or self._ask(prompt).split("\n")
        return self._pasted.pop(0)

    def _part(self, record: Record, part: PartRecord, prompt: str) -> Then:
        while part.state is State.OPEN:
            text = self._typed(prompt, part.part.kind).strip()
            match text.lower():
                case "":
                    self._print(Text("  Type an answer, or ? for help.", style="dim"))
                case "q" | ":q":
                    return Then.QUIT
                case "r" | ":r":
                    return Then.RESTART
                case "v" | ":v":
                    return Then.VARIANT
                case "?" | ":?" | "help":
                    self._help()
                case "h" | ":h":
                    self._hint(record, part)
                case "m" | ":m":
                    self._own_working(record)
                case "s" | ":s":
                    part.state = State.SKIPPED
                case "w" | ":w":
                    part.state = State.SHOWN
                    self._working(record, part)
                case _:
                    verdict = record.answer(part, text).verdict
                    if verdict is not None:
                        self._verdict(verdict, record, part)
        self._print()
        return Then.NEXT

    def _after(self, record: Record) -> Then:
        text = self._line("Enter next · w working · v variant · r again · q quit > ").strip().lower()
        if text == "w":
            self._print(render(record.exercise.working()))
            return self._after(record)
        return {"v": Then.VARIANT, "r": Then.RESTART, "q": Then.QUIT}.get(text, Then.NEXT)

    def _verdict(self, verdict: Verdict, record: Record, part: PartRecord) -> None:
        diagnosis = record.diagnosis(part)
        explained = diagnosis is not None and diagnosis.explains and diagnosis.kind != "listed"
        outcome = Outcome.WRONG if explained else verdict.outcome
        says = diagnosis.of(verdict) if diagnosis is not None and explained else verdict.says
        read = f"  (read as {verdict.read})" if verdict.read else ""
        self._print(words("  ", (_WORDS[outcome], f"bold {_STYLES[outcome]}"), f" {says}", (read, "dim")))
        if diagnosis is not None and diagnosis.wrong is not None and diagnosis.right is not None:
            self._print(Text("  Your answer comes from this:", style="dim"))
            self._indented(renderable(diagnosis.wrong))
            self._print(Text("  The formula is:", style="dim"))
            self._indented(renderable(diagnosis.right))
        if not verdict.accepted and verdict.outcome is not Outcome.UNREADABLE and part.tries == 1:
            self._print(Text(f"  {_OR_ELSE}", style="dim"))

    def _hint(self, record: Record, part: PartRecord) -> None:
        blocks = record.exercise.hint(part.part.label)
        equations, sentences = blocks[::2], blocks[1::2]
        # The first hint is the formula; asked again, the hint says what to do with it.
        self._indented(render(sentences if part.hinted else equations))
        part.hinted = True

    def _working(self, record: Record, part: PartRecord) -> None:
        self._indented(render(record.exercise.working(part.part.label)))
        self._print(Text("  The answer:", style="dim"))
        self._indented(renderable(record.exercise.answer(part.part)))

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
            self._print(words("  ", (mark, f"bold {style}"), f" {step.text}"))
            if step.sentence:
                self._print(words("    ", (step.sentence, style)))
        if followed.first is None:
            self._print(words("  ", followed.sentence))

    def _help(self) -> None:
        grid = Table.grid(padding=(0, 2))
        for key, meaning in HELP:
            grid.add_row(Text(f"  {key}", style="bold"), Text(meaning))
        self._print(grid)
        self._print(Text(f"  Right is {RULE}.", style="dim"))

    def summary(self, session: Session) -> None:
        """Print what was answered, and how."""
        parts = session.parts
        if not parts:
            self._print("Nothing was answered. Come back soon.")
            return
        rows = [
            (
                record.exercise.id or record.exercise.problem.family.name,
                part.part.label,
                str(part.tries),
                _result(part),
                f"{float(part.points):g} of {part.part.points}",
            )
            for record in session.records
            if record.begun
            for part in record.parts
        ]
        self._print(table(("Problem", "Part", "Tries", "Result", "Points"), rows, right=("Tries", "Points")))
        right = sum(part.state is State.DONE for part in parts)
        first = sum(part.first_time for part in parts)
        self._print(Text(f"{right} of {len(parts)} parts right, {first} of them at the first try.", style="bold"))

    def _indented(self, content: RenderableType) -> None:
        self._print(Padding(content, (0, 0, 0, 2), expand=False))

    def _print(self, content: RenderableType = "") -> None:
        self._console.print(content)


def _result(part: PartRecord) -> str:
    if part.state is State.OPEN:
        outcome = part.answers[-1].outcome if part.answers else None
        return "not answered" if outcome is None else outcome.value
    return part.state.value + (", with a hint" if part.hinted else "")


def variant(exercise: Exercise) -> Exercise:
    """Another problem of the same family and level; a problem from outside gets one of level 2."""
    identity = exercise.problem.identity
    if identity is None:
        return draw(exercise.problem.family.name, 2, 0)
    return draw(identity.family, identity.level, (identity.seed + 1) % MAX_SEED)
