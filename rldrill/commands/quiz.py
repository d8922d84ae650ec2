"""``rldrill quiz``."""

import gc
from collections.abc import Iterator, Sequence
from contextlib import closing
from datetime import datetime
from itertools import islice
from pathlib import Path
from shutil import get_terminal_size
from textwrap import fill
from typing import TYPE_CHECKING, Annotated

import typer

from rldrill.commands.arguments import Level, NotationOption, Seed, complete

if TYPE_CHECKING:
    from rich.console import RenderableType

    from rldrill.exam.exam import Exam
    from rldrill.exercise import Exercise
    from rldrill.history.attempts import Attempt
    from rldrill.quiz.planning import Plan

NAME = "quiz"
_NUMBER, _MOST = 10, 1000
#: About so many minutes are expected for a problem, where only the time is given.
_MINUTES_EACH = 3


def command(
    names: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="TOPIC|FAMILY|ID|FILE",
            autocompletion=complete,
            help="Topics, families (td-zero/2 is level 2), problem IDs or problem files; all families, if none.",
        ),
    ] = None,
    number: Annotated[
        int | None,
        typer.Option("--number", "-n", min=1, max=_MOST, help=f"How many problems; {_NUMBER}, if not given."),
    ] = None,
    level: Level = None,
    seed: Seed = None,
    exam_date: Annotated[
        datetime | None,
        typer.Option(formats=["%Y-%m-%d"], metavar="YYYY-MM-DD", help="See everything again before this day."),
    ] = None,
    minutes: Annotated[
        int | None, typer.Option("--minutes", "-m", min=1, max=600, help="End after so many minutes.")
    ] = None,
    mistake: Annotated[
        str | None,
        typer.Option("--mistake", metavar="NAME", help="Only problems in which this mistake gives a wrong answer."),
    ] = None,
    exam: Annotated[
        Path | None,
        typer.Option("--exam", metavar="FILE", help="Sit an exam: its blueprint or manifest."),
    ] = None,
    version: Annotated[str | None, typer.Option("--version", help="Which version of the exam.")] = None,
    plain: Annotated[
        bool, typer.Option("--plain", help="For screen readers: ASCII, no pictures, no colours, no columns.")
    ] = False,
    answers: Annotated[
        Path | None, typer.Option("--answers", metavar="FILE.toml", help="Where the answers to the exam are kept.")
    ] = None,
    notation: NotationOption = None,  # noqa: ARG001 - its callback sets it
) -> None:
    """Drill in the terminal: fresh problems, judged answers, mistakes explained.

    Your history chooses what is asked, of all or of what is named: what is due for review, and something new, the easy
    before the hard. With a level or a seed it is drawn at random.

    Examples: rldrill quiz · rldrill quiz --minutes 15 · rldrill quiz bellman -n 5 --level 2 · rldrill quiz td-zero/2/7

    Only the problems in which one mistake is made: rldrill quiz --mistake forgot-gamma
    """
    from rldrill.problems.errors import UsageError
    from rldrill.problems.identity import names_a_problem
    from rldrill.quiz.prompt import is_interactive, line_editor

    if exam is not None and any((names, number, level, exam_date, minutes, mistake)):
        raise UsageError("--exam says what is asked, and for how long; leave out what else would say it.")
    if exam is None and any((version, answers)):
        raise UsageError("--version and --answers are of an exam; name its blueprint or manifest, --exam exam.toml.")
    wanted, level = _at_one_level(list(names or ()), level)
    named = [name for name in wanted if names_a_problem(name)]
    if named and (exam_date is not None or mistake is not None):
        raise UsageError(f"{named[0]} is one problem; leave --exam-date and --mistake out, which choose from families.")
    if named == wanted != [] and any((number, level, seed is not None)):
        raise UsageError("All problems are named; leave -n, --level and --seed out, which say what else is drawn.")
    if not is_interactive():
        raise UsageError(
            "The quiz needs a terminal; without one use 'rldrill verify FILE' to grade answers, "
            "'rldrill worksheet' to print problems or 'rldrill generate' to get them as data."
        )
    if exam is not None:
        _sit(exam, version, answers, seed, plain=plain)
        return
    from rldrill.history.keeping import Keeper

    keeper = Keeper(lambda sentence: typer.echo(f"rldrill: {sentence}", err=True))
    plan, drilled, said = None, None, ""
    if mistake is not None:
        if exam_date is not None:
            raise UsageError("--mistake says what is asked; leave --exam-date out.")
        from rldrill.quiz.drilling import drill

        drilled = drill(mistake, keeper.read(), wanted, level)
        said = drilled.says()
    elif exam_date is not None or not (level or seed is not None or named):
        if level or seed is not None:
            raise UsageError("--exam-date lets your history choose; leave --level and --seed out.")
        plan = _plan(wanted, keeper.read(), number or _expected(minutes), exam_date)
        said = plan.says(kept=not keeper.trouble)
    if said:
        typer.echo(fill(said, get_terminal_size().columns - 1))  # before the libraries that take a while
    from rldrill.exam.selection import announced_seed, fresh_seed
    from rldrill.quiz.questions import planned, questions, timed
    from rldrill.quiz.recording import Recorder, utc_now
    from rldrill.quiz.screen import Screen
    from rldrill.quiz.session import Session
    from rldrill.render.terminal import console

    recorder = Recorder(keeper.keep)
    total = number or (_MOST if minutes else _NUMBER)
    exercises: Iterator[Exercise]
    if drilled is not None:
        exercises = islice(drilled.exercises(announced_seed(seed)), total)
    elif plan is None:
        exercises, total = questions(wanted, total, level, lambda: announced_seed(seed))
    else:
        exercises = islice(planned(plan, recorder, utc_now, fresh_seed), total)
    if minutes:
        exercises = timed(exercises, minutes, recorder)
    again = (
        "rldrill quiz" if exam_date is None else " ".join(["rldrill quiz", *wanted, f"--exam-date {exam_date.date()}"])
    )
    session = Session(
        total if number or not minutes else None,
        minutes=minutes,
        again=again,
        drilled="" if drilled is None else drilled.name,
        more=None if drilled is None else lambda: drilled.exercises(fresh_seed()),
    )
    attempts = keeper.read()
    terminal = console(plain=plain)
    screen = Screen(
        terminal,
        line_editor(lambda: screen.redraw(), plain=plain or terminal.is_dumb_terminal),
        recorder,
        None if named else {attempt.family for attempt in attempts},
        lambda: _map([*attempts, *recorder.attempts]),
        plan,
        plain=plain,
        said=said,
    )
    _collect_again()
    with closing(keeper):
        finished = screen.run(exercises, session)
    if not finished:
        raise typer.Exit(130)


def _at_one_level(names: list[str], level: int | None) -> tuple[list[str], int | None]:
    """What is drilled, and the level that the names have: ``td-zero/2`` is td-zero at level 2."""
    from rldrill.problems.errors import UsageError
    from rldrill.problems.identity import with_level

    split = [with_level(name) for name in names]
    levels = {own for _, own in split} | {level}
    if levels <= {None, level}:
        return [name for name, _ in split], level
    if len(levels - {None}) > 1 or any(own is None for _, own in split):
        raise UsageError("A quiz has one level for all that is drawn; leave it out of the names, and give --level.")
    return [name for name, _ in split], split[0][1]


def _sit(source: Path, version: str | None, answers: Path | None, seed: int | None, *, plain: bool) -> None:
    """Sit an exam, or go on with it."""
    from rldrill.exam.manifest import read_manifest
    from rldrill.problems.errors import UsageError
    from rldrill.problems.notations import LECTURE, in_use, use
    from rldrill.quiz.prompt import line_editor
    from rldrill.quiz.recording import utc_now
    from rldrill.quiz.sitting import Sitting, version_of
    from rldrill.quiz.sitting_screen import SittingScreen
    from rldrill.render.terminal import console

    path = answers or Path(f"{source.stem}-answers.toml")
    if path.suffix.lower() != ".toml":
        raise UsageError(f"{path} does not end in .toml, as files of answers do.")
    saved = path.with_suffix(".json")
    if source.suffix.lower() == ".json":
        if seed is not None:
            raise UsageError(f"{source} holds what was drawn; leave --seed out.")
        saved, planned = source, read_manifest(source)
    else:
        planned = _begun(source, saved, seed)
    if in_use().notation == LECTURE:
        use(planned.layout.notation)
    sitting = Sitting(planned, version_of(planned, version), path, utc_now(), saved)
    if path.exists():
        sitting.resume()
    terminal = console(plain=plain)
    ask = line_editor(lambda: screen.redraw(), plain=plain or terminal.is_dumb_terminal)
    screen = SittingScreen(terminal, ask, utc_now, plain=plain)
    _collect_again()
    if not screen.run(sitting):
        raise typer.Exit(130)


def _begun(blueprint: Path, saved: Path, seed: int | None) -> "Exam":
    """The exam of a blueprint, drawn when it is begun for the first time, in whichever terminal that is."""
    from msgspec.structs import replace

    from rldrill.exam.blueprint import read_blueprint
    from rldrill.exam.manifest import digest_of, manifest, read_manifest, written
    from rldrill.exam.planning import plan
    from rldrill.problems.errors import UsageError
    from rldrill.writing import begin

    wanted = read_blueprint(blueprint).but(seed=seed)
    if not saved.exists():
        planned = plan(wanted)
        kept = written(manifest(planned, blueprint=wanted.digest))
        return planned if begin(saved, kept) else read_manifest(saved)
    begun = read_manifest(saved)
    if digest_of(saved) != wanted.digest or wanted.seed not in (None, begun.seed):
        raise UsageError(
            f"{saved} holds another exam that was begun, {begun.head.title!r}; name another file with --answers."
        )
    return replace(begun, head=wanted.head, layout=wanted.layout)


def _map(attempts: Sequence["Attempt"]) -> "RenderableType":
    from rldrill.quiz.recording import utc_now
    from rldrill.quiz.topics import topic_map

    return topic_map(attempts, utc_now())


def _collect_again() -> None:
    """From now on memory is tidied up, but for what is imported, which stays."""
    gc.freeze()
    gc.enable()


def _expected(minutes: int | None) -> int:
    return _NUMBER if minutes is None else max(1, minutes // _MINUTES_EACH)


def _plan(names: list[str], attempts: Sequence["Attempt"], number: int, exam_date: datetime | None) -> "Plan":
    """What your history chooses of the families that are named, or of all."""
    from rldrill.history.zone import LOCAL
    from rldrill.problems.catalogue import chosen
    from rldrill.quiz.planning import Plan, skills

    order = skills(chosen(names) if names else None)
    return Plan(order, attempts, number, datetime.now(LOCAL), exam_date and exam_date.date())
