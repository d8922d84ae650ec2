"""``rldrill worksheet``: printed worksheets and exams with their keys."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from rldrill.commands.arguments import Json, Level, NotationOption, Seed, complete
from rldrill.exam.choices import Paper, Solutions, Space

if TYPE_CHECKING:
    from rldrill.exam.blueprint import Blueprint, Entry
    from rldrill.exam.exam import Exam, Layout
    from rldrill.exam.fairness import Fairness
    from rldrill.exam.sealing import Secret
    from rldrill.export.formats import Format
    from rldrill.print.exam_files import Files

NAME = "worksheet"
_PROBLEMS, _MOST = 8, 100


def command(
    names: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="TOPIC|FAMILY|ID|FILE",
            autocompletion=complete,
            help="Topics, families (or td-zero/2: one problem of a level), problem IDs, problem files; or one "
            "blueprint (.toml). All topics, if none.",
        ),
    ] = None,
    count: Annotated[
        int | None,
        typer.Option("--count", "-n", min=1, max=_MOST, help=f"Problems in each version; {_PROBLEMS}, if not given."),
    ] = None,
    minutes: Annotated[
        int | None, typer.Option("--minutes", "-m", min=1, max=600, help="Choose problems that take so long.")
    ] = None,
    level: Level = None,
    exclude: Annotated[
        list[str] | None,
        typer.Option("--exclude", "-x", metavar="TOPIC|FAMILY", help="Draw nothing of this.", autocompletion=complete),
    ] = None,
    seed: Seed = None,
    versions: Annotated[int | None, typer.Option("--versions", min=1, max=999, help="How many versions.")] = None,
    roster: Annotated[
        Path | None, typer.Option("--roster", metavar="FILE.csv", help="A version for everybody in it: name, number.")
    ] = None,
    secret_file: Annotated[
        Path | None,
        typer.Option("--secret-file", metavar="FILE", help="Seal the exam: without this file nobody can redraw it."),
    ] = None,
    paper: Annotated[Paper | None, typer.Option("--paper", case_sensitive=False, help="The paper.")] = None,
    space: Annotated[Space | None, typer.Option("--space", help="How much room for working.")] = None,
    solutions: Annotated[Solutions | None, typer.Option("--solutions", help="Where the solutions are.")] = None,
    ids: Annotated[
        bool | None, typer.Option("--ids/--no-ids", help="Print IDs and seed: whoever has them has the key.")
    ] = None,
    duplex: Annotated[
        bool | None, typer.Option("--duplex/--no-duplex", help="An even number of pages in every PDF.")
    ] = None,
    title: Annotated[str | None, typer.Option("--title", help="What is printed at the head.")] = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="FILE", help="Write to this file; its ending tells the format."),
    ] = None,
    format_: Annotated[
        str | None,
        typer.Option(
            "--format", metavar="FORMAT", help="pdf, html, moodle, canvas, qti, anki, latex, markdown, docx, json."
        ),
    ] = None,
    force: Annotated[bool, typer.Option("--force", "-f", help="Replace what an earlier run has written.")] = False,
    init: Annotated[
        Path | None, typer.Option("--init", metavar="FILE.toml", help="Write a blueprint with comments, and end.")
    ] = None,
    source: Annotated[
        Path | None, typer.Option("--from", metavar="FILE.json", help="Print again what a manifest holds.")
    ] = None,
    key: Annotated[bool, typer.Option("--key", help="Print keys alone.")] = False,
    as_json: Json = False,
    notation: NotationOption = None,
) -> None:
    """Typeset a worksheet or an exam as PDF, with a key for each version.

    Versions share topics and levels, and neither a problem nor an answer. A manifest (FILE.json) records all that was
    printed; 'rldrill worksheet --from FILE.json' prints it again, and goes on with a run that was ended.

    Examples:

        rldrill worksheet bellman td-zero -n 6 --level 2 -o exam.pdf

        rldrill worksheet td-zero/1/7 mine.toml bellman -n 6 --minutes 90 --exclude beyond-the-sheet

        rldrill worksheet --init exam.toml · rldrill worksheet exam.toml --roster course.csv
    """
    from rldrill.export.formats import format_of
    from rldrill.problems.errors import UsageError

    other = format_of(output, format_)
    if key and other is not None:
        raise UsageError(f"--key prints the keys as PDF; of {other.ending} leave it out, or take --solutions inline.")
    changes: dict[str, Any] = {
        "paper": paper,
        "space": space,
        "solutions": solutions,
        "ids": ids,
        "duplex": duplex,
        "notation": notation,
    }
    if init is not None:
        others = (
            names,
            count,
            minutes,
            level,
            exclude,
            versions,
            roster,
            title,
            source,
            key,
            output,
            format_,
            secret_file,
        )
        if any((*others, seed is not None, *(value is not None for value in changes.values()))):
            raise UsageError("--init writes a blueprint to fill in; leave the rest out, and write it there.")
        _write_template(init, force=force)
        written = [init]
    elif source is not None:
        if any((names, count, minutes, level, exclude, seed is not None, versions, roster, title, secret_file)):
            raise UsageError("--from prints what the manifest holds; leave out what would make another exam.")
        if other is not None:
            _print(_exported(_from(source, changes), output or source, other, force=force), as_json=as_json)
            return
        written = _reprinted(source, output, changes, only_keys=key, force=force)
    else:
        if roster is not None and versions is not None:
            raise UsageError("--roster makes a version for everybody in it; leave --versions out.")
        blueprint, stem, planned = _blueprint(names or [], count, minutes, level)
        blueprint = blueprint.but(
            **changes, exclude=None if exclude is None else tuple(exclude), seed=seed, versions=versions, title=title
        )
        if other is not None:
            exam = _drawn(blueprint, roster, secret_file)
            practice = roster is None and not planned and solutions != "none"
            _print(_exported(exam, output or Path(stem), other, practice=practice, force=force), as_json=as_json)
            return
        written = _printed(blueprint, output or Path(f"{stem}.pdf"), roster, secret_file, only_keys=key, force=force)
    _print([str(path) for path in written], as_json=as_json)


def _drawn(blueprint: "Blueprint", roster: Path | None, secret_file: Path | None) -> "Exam":
    from rldrill.exam.fairness import fairness
    from rldrill.exam.planning import plan
    from rldrill.exam.roster import read_roster

    people = () if roster is None else read_roster(roster)
    with _progress("Drawing", len(people) or blueprint.versions) as advance:
        exam = plan(blueprint, roster=people, secret=_secret(secret_file), advance=advance)
    typer.echo(f"seed {exam.seed}", err=True)
    figures = fairness(exam)
    if blueprint.duration and (printed := figures.says_what_is_printed(blueprint.duration)):
        typer.echo(f"rldrill: {printed}", err=True)
    _tell(len(exam.versions), figures, blueprint.minutes)
    return exam


def _secret(path: Path | None) -> "Secret | None":
    if path is None:
        return None
    from rldrill.exam.sealing import read_secret

    secret, is_new = read_secret(path)
    if is_new:
        typer.echo(f"rldrill: {path} is a new secret; keep it, and the manifest, from everybody else", err=True)
    return secret


def _tell(number: int, figures: "Fairness", minutes: int | None) -> None:
    """Say how equal the versions are, and by how much they miss the minutes that were asked for."""
    if minutes and (missed := figures.says_what_is_missed(minutes)):
        typer.echo(f"rldrill: {missed}", err=True)
    if number == 1:
        return
    typer.echo(f"{number} versions: {figures.says()}", err=True)
    if scarce := figures.says_what_is_scarce(number):
        typer.echo(f"rldrill: {scarce}", err=True)


def _from(source: Path, changes: dict[str, Any]) -> "Exam":
    from msgspec.structs import replace

    from rldrill.exam.manifest import read_manifest

    exam = read_manifest(source)
    return replace(exam, layout=_layout(exam, changes))


def _layout(exam: "Exam", changes: dict[str, Any]) -> "Layout":
    """How a saved exam is printed with these changes, where they are not None."""
    from msgspec.structs import replace

    from rldrill.problems.errors import UsageError

    if exam.sealed and changes["ids"]:
        raise UsageError("The exam is sealed, and IDs would tell what is drawn; leave --ids out.")
    return replace(exam.layout, **{name: value for name, value in changes.items() if value is not None})


def _exported(exam: "Exam", output: Path, format_: "Format", *, practice: bool = False, force: bool) -> list[str]:
    """Write an exam in another format; with the solutions inline it is for practice, whatever it comes from."""
    from rldrill.export.formats import check, export, named, says_what_is_lost

    target = named(output, format_)
    check(exam, target, format_, force=force)
    practice = practice or exam.layout.solutions == "inline"
    if not practice and (lost := says_what_is_lost(exam, format_)):
        typer.echo(f"rldrill: {lost}", err=True)
    with _progress("Writing", len(exam.versions)) as advance:
        return list(map(str, export(exam, target, format_, practice=practice, advance=advance)))


def _write_template(path: Path, *, force: bool) -> None:
    from rldrill.exam.blueprint import template
    from rldrill.problems.errors import UsageError
    from rldrill.writing import write_bytes_atomically

    if path.suffix.lower() != ".toml":
        raise UsageError(f"{path} does not end in .toml; a blueprint is a TOML file.")
    if path.exists() and not force:
        raise UsageError(f"{path} is there already; choose another name, or replace it with --force.")
    write_bytes_atomically(path, template().encode())


def _blueprint(
    names: list[str], count: int | None, minutes: int | None, level: int | None
) -> "tuple[Blueprint, str, bool]":
    """What is asked for, what its file is called if nothing else is said, and whether a blueprint says it: an exam."""
    from rldrill.exam.blueprint import Blueprint, Entry, is_blueprint, read_blueprint
    from rldrill.files import read_data
    from rldrill.problems.errors import UsageError

    paths = [name for name in names if Path(name).suffix.lower() in (".toml", ".json")]
    plans = [name for name in paths if name.lower().endswith(".toml") and is_blueprint(read_data(name))]
    if plans:
        if len({*names}) > 1 or count or level:
            others = "the other names" if len({*names}) > 1 else "-n" if count else "--level"
            raise UsageError(f"{plans[0]} is a blueprint, which names the problems itself; leave {others} out.")
        return read_blueprint(plans[0]).but(minutes=minutes), Path(plans[0]).stem, True
    entries = [(name, _entry(name)) for name in names]
    rest = tuple(name for name, entry in entries if entry is None)
    fixed: list[Entry] = []
    for _, entry in entries:
        if entry is not None and not (entry.is_fixed and entry in fixed):
            fixed.append(entry)
    if count is not None and count < (named := len(fixed) + bool(rest)):
        raise UsageError(f"{named} problems are named, and -n asks for {count}; raise it, or leave names out.")
    if fixed and not rest and (level or count not in (None, len(fixed))):
        out = "--level" if level else "-n"
        raise UsageError(f"All problems are named; leave {out} out, or name topics or families to choose more from.")
    if rest or not fixed:
        wanted = None if minutes and count is None else max(1, (count or _PROBLEMS) - len(fixed))
        fixed.append(Entry(topic=rest, count=wanted, level=level))
    return Blueprint(problems=tuple(fixed), minutes=minutes), "worksheet", False


def _entry(name: str) -> "Entry | None":
    """The problem that is named by its ID or file, or by its family and level; None for what is chosen from."""
    from rldrill.exam.blueprint import Entry
    from rldrill.problems.identity import looks_like_id

    if looks_like_id(name):
        return Entry(id=name)
    if Path(name).suffix.lower() in (".toml", ".json"):
        return Entry(file=name)
    family, _, level = name.partition("/")
    return Entry(family=family, level=int(level)) if level in {"1", "2", "3"} else None


def _printed(
    blueprint: "Blueprint", output: Path, roster: Path | None, secret_file: Path | None, *, only_keys: bool, force: bool
) -> list[Path]:
    from rldrill.exam.drawn import drawn
    from rldrill.exam.planning import version_codes
    from rldrill.exam.roster import read_roster
    from rldrill.exam.selection import fresh_seed
    from rldrill.print.exam_files import Files, check_output, earlier, make_room, write
    from rldrill.print.fonts import needs_system_fonts
    from rldrill.print.paper import typst_version

    check_output(output)
    people = () if roster is None else read_roster(roster)
    number = len(people) or blueprint.versions
    secret = _secret(secret_file)
    needs_system_fonts(blueprint.head, people)  # what no font has is refused before any work is done
    fresh = blueprint.seed is None
    seed = fresh_seed() if blueprint.seed is None else blueprint.seed
    typer.echo(f"seed {seed}", err=True)
    files = Files(output, version_codes(number, seed, secret), blueprint.layout, bool(people), only_keys)
    if fresh and not force:  # what is there is of another seed: that is told before any work is done
        make_room(earlier(files), force=False)
    with _progress("Drawing", number) as advance:
        exam = drawn(blueprint.but(seed=seed), typst_version(), roster=people, secret=secret, advance=advance)
    _tell(number, exam.fairness, blueprint.minutes)
    data = exam.manifest
    if needs_system_fonts(blueprint.head, people, data.decode()):
        typer.echo("rldrill: some letters come from this computer's fonts; elsewhere they may look otherwise", err=True)
    if not files.manifest.exists() or files.manifest.read_bytes() != data or force:
        make_room(earlier(files), force=force)
    return _counted(files, number, lambda advance: write(files, data, advance))


def _reprinted(
    source: Path, output: Path | None, changes: dict[str, Any], *, only_keys: bool, force: bool
) -> list[Path]:
    import json

    from msgspec.structs import asdict

    from rldrill.exam.manifest import LARGEST, codes, read_exam, typst_of, written
    from rldrill.files import read_text
    from rldrill.print.exam_files import Files, check_output, earlier, make_room, print_from, write
    from rldrill.print.paper import typst_version
    from rldrill.problems.errors import UsageError

    exam, makes = read_exam(source)
    layout = _layout(exam, changes)
    personal, number = makes[0]().person is not None, len(makes)
    del makes  # hundreds of versions are not kept while they are typeset
    target = output or source.with_suffix(".pdf")
    check_output(target)
    files = Files(target, codes(source), layout, personal, only_keys)
    before, now = typst_of(source), typst_version()
    if before not in (None, now):
        typer.echo(f"rldrill: {source} was printed with typst {before}, and this is {now}; bytes may differ", err=True)
    beside = files.manifest.exists() and files.manifest.samefile(source)
    if beside and not force and layout != exam.layout:
        raise UsageError(f"{source} prints otherwise; choose another name with -o, or --force to print its PDFs anew.")
    if beside or only_keys:
        if force or not beside:  # whose keys are there that lie elsewhere, nothing tells
            make_room(files.printed(), force=force)
        return _counted(files, number, lambda advance: print_from(source, files, advance))
    how = {"layout": asdict(layout), "typst": now}
    data = written(json.loads(read_text(source, (".json",), LARGEST)) | how)
    make_room(earlier(files), force=force)
    return _counted(files, number, lambda advance: write(files, data, advance))


def _counted(files: "Files", number: int, run: Callable[[Callable[[], None]], Iterator[Path]]) -> list[Path]:
    """What was written, and a word on what was there already."""
    there, every = len(files.printed()), len(files.pdfs())
    if there:
        rest = "the rest is written" if there < every else "--force writes them anew"
        typer.echo(f"rldrill: {there} of {every} PDFs are there already; {rest}", err=True)
    with _progress("Typesetting", number) as advance:
        return sorted(run(advance), key=[*files.pdfs(), files.manifest].index)


@contextmanager
def _progress(what: str, steps: int) -> Iterator[Callable[[], None]]:
    from rich.progress import Progress

    from rldrill.render.terminal import console

    screen = console(stderr=True)
    if not screen.is_terminal:  # even a progress that is disabled ends with an empty line in some releases
        yield lambda: None
        return
    with Progress(console=screen, transient=True) as progress:
        task = progress.add_task(what, total=steps)
        yield lambda: progress.advance(task)


def _print(paths: list[str], *, as_json: bool) -> None:
    from rldrill.commands.output import print_json

    if as_json:
        print_json(paths)
    else:
        for path in paths:
            typer.echo(path)
