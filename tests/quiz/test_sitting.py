"""Sitting an exam: back and forth, nothing judged before the end, and the same points as verify gives."""

import json
import tomllib
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from fractions import Fraction
from pathlib import Path
from threading import Barrier, Thread
from typing import Any

import pytest
from msgspec.structs import replace
from rich.console import Console

from rldrill.commands.quiz import _begun
from rldrill.exam.blueprint import Blueprint, Entry, read_blueprint
from rldrill.exam.exam import Exam
from rldrill.exam.manifest import manifest, read_manifest, written
from rldrill.exam.planning import plan
from rldrill.grading.assignment import Assignment
from rldrill.grading.report import Score
from rldrill.grading.verification import Settings, verify
from rldrill.problems.errors import FileError, UsageError
from rldrill.quiz.prompt import Prompt
from rldrill.quiz.sitting import Place, Sitting, by_topic, version_of
from rldrill.quiz.sitting_screen import SittingScreen

START = datetime(2026, 11, 26, 9, tzinfo=UTC)

#: return/1: (a) and (b), a point each; td-zero/1: one point.
PROBLEMS = (Entry(id="return/1/2166"), Entry(id="td-zero/1/62590"))


def exam(**more: object) -> Exam:
    return plan(Blueprint(problems=PROBLEMS, seed=1, title="Midterm").but(**more))


class Hand:
    """Somebody who types these lines; an exception is raised in place of a line. Every line takes a minute."""

    def __init__(self, *lines: str | type[BaseException]) -> None:
        self._lines: Iterator[str | type[BaseException]] = iter(lines)
        self.prompts: list[str] = []
        self.time = START

    def ask(self, prompt: Prompt, _keys: str = "") -> str:
        self.prompts.append(prompt() if callable(prompt) else prompt)
        self.time += timedelta(minutes=1)
        line = next(self._lines, EOFError)
        if not isinstance(line, str):
            raise line
        return line

    def now(self) -> datetime:
        return self.time


def sit(sitting: Sitting, *lines: str | type[BaseException], width: int = 100) -> tuple[bool, str, Hand]:
    hand = Hand(*lines)
    console = Console(width=width, record=True, markup=False, highlight=False, quiet=False)
    handed_in = SittingScreen(console, hand.ask, hand.now).run(sitting)
    return handed_in, console.export_text(), hand


@pytest.fixture
def sitting(tmp_path: Path) -> Sitting:
    planned = exam()
    return Sitting(planned, planned.versions[0], tmp_path / "answers.toml", START)


def points(sitting: Sitting) -> Fraction:
    return sum((part.score.points for parts in sitting.graded() for part in parts), Fraction(0))


def right(sitting: Sitting) -> list[str]:
    answers = (sitting.exercise(place).answers()[sitting.part(place).label] for place in sitting.places)
    return [str(next(iter(answer.values()))) if isinstance(answer, dict) else str(answer) for answer in answers]


def test_a_path_is_one_line_however_narrow_the_window_is_and_stays_one_when_the_window_changes(tmp_path: Path) -> None:
    planned = exam()
    path = tmp_path / "answers of the whole course in the order of their names.toml"
    hand, console = Hand("1"), Console(width=40, record=True, markup=False, highlight=False)
    screen = SittingScreen(console, hand.ask, hand.now)
    assert not screen.run(Sitting(planned, planned.versions[0], path, START))
    assert f"Kept in {path}; the same command goes on." in console.export_text(clear=True).splitlines()
    screen.redraw()
    assert f"Kept in {path}; the same command goes on." in console.export_text().splitlines()


def test_right_answers_earn_everything(sitting: Sitting) -> None:
    handed_in, text, hand = sit(sitting, *right(sitting), "yes")
    assert handed_in
    assert "3 of 3 points" in text
    assert [prompt.split(" >")[0] for prompt in hand.prompts[:3]] == ["1a", "1b", "2a"]
    assert by_topic(sitting, sitting.graded()) == {
        "fundamentals": Score(Fraction(2), 2),
        "temporal-difference": Score(Fraction(1), 1),
    }


def test_nothing_is_judged_before_it_is_handed_in(sitting: Sitting) -> None:
    _, text, _ = sit(sitting, "99999", "clear", "0", "overview", "leave")
    assert "✗" not in text
    assert "✓" not in text
    assert "Not right" not in text
    assert "Kept in" in text


def test_back_and_change_and_go_to_a_part(sitting: Sitting) -> None:
    a, b, last = right(sitting)
    handed_in, text, _ = sit(sitting, "back", "1", "2", "back", b, "go 1a", a, "go 9", "go 2", last, "yes")
    assert handed_in
    assert text.count("This is the first part.") == 1
    assert "There is no part 9." in text
    assert "your answer so far: 2" in text
    assert "3 of 3 points" in text


def test_a_word_that_can_be_the_answer_is_the_answer_and_with_a_colon_it_is_the_command(tmp_path: Path) -> None:
    # linear-value/1/1: Q(s, walk) = −3·3 + 2·3 = −3 and Q(s, back) = −3·3 + 3·3 = 0, so that 'back' is greedy
    planned = plan(Blueprint(problems=(Entry(id="linear-value/1/1"), PROBLEMS[1]), seed=1))
    sitting = Sitting(planned, planned.versions[0], tmp_path / "answers.toml", START)
    _, _, hand = sit(sitting, "-3, 0", "back", "Back", ":Back", "BACK", "GO 1A", "back", ":leave")
    assert [prompt[:2] for prompt in hand.prompts] == ["1a", "1b", "2a", "1b", "1a", "1a", "1a", "1a"]
    assert sitting.answers == {Place(0, 0): "-3, 0", Place(0, 1): "back"}


def test_who_does_not_hand_in_goes_on_at_the_first_part_without_an_answer_or_at_the_first_of_all(
    sitting: Sitting,
) -> None:
    a, b, last = right(sitting)
    _, _, hand = sit(sitting, a, "next", last, "no", b, "go 2", "next", "no", "leave")
    assert [prompt[:2] for prompt in hand.prompts] == ["1a", "1b", "2a", "1 ", "1b", "2a", "2a", "Ha", "1a"]


def test_what_cannot_be_read_is_said_and_asked_again(sitting: Sitting) -> None:
    _, text, hand = sit(sitting, "banana", "1", "leave")
    assert "Kept, but it cannot be read and would count as wrong" in text
    assert [prompt[:2] for prompt in hand.prompts] == ["1a", "1a", "1b"]


@pytest.mark.parametrize("typed", ["h", "hint", "quit", "s", ":q"])
def test_a_key_of_the_quiz_is_no_answer(sitting: Sitting, typed: str) -> None:
    a, *_ = right(sitting)
    _, text, hand = sit(sitting, typed, a, "back", typed, "leave")
    assert f"There is no '{typed}' in an exam: " in text
    assert [prompt[:2] for prompt in hand.prompts] == ["1a", "1a", "1b", "1a", "1a"]
    assert sitting.answers == {Place(0, 0): a}


def test_what_cannot_be_read_does_not_take_the_place_of_what_can(sitting: Sitting) -> None:
    a, *_ = right(sitting)
    _, text, _ = sit(sitting, "banana", "apple", a, "back", "banana", "leave")
    assert text.count("Kept, but it cannot be read") == 2
    assert text.count("Not kept, since it cannot be read") == 1
    assert text.count(f"your answer so far: {a}") == 2
    assert sitting.answers == {Place(0, 0): a}


def test_a_letter_that_can_be_the_answer_is_no_key_of_the_quiz(tmp_path: Path) -> None:
    # policies of this model name the actions s and h
    moves = [["A", "s", "end", 1, 1], ["A", "h", "end", 1, 2]]
    given = {"gamma": 1, "sweeps": 1, "mdp": {"transitions": moves, "terminal": ["end"]}}
    (tmp_path / "own.json").write_text(json.dumps({"family": "value-iteration", "given": given}), encoding="utf-8")
    planned = plan(Blueprint(problems=(Entry(file=str(tmp_path / "own.json")),), seed=1))
    sitting = Sitting(planned, planned.versions[0], tmp_path / "answers.toml", START)
    sit(sitting, "2", "h", "leave")
    assert sitting.answers == {Place(0, 0): "2", Place(0, 1): "h"}


def test_what_is_missing_is_said_and_asked_again_and_counts_as_wrong(tmp_path: Path) -> None:
    planned = plan(Blueprint(problems=(Entry(id="td-zero/2/18", partial="entries"),), seed=1))
    sitting = Sitting(planned, planned.versions[0], tmp_path / "answers.toml", START)
    # (a) is −6, 16/5, −3 and of 3 points, (b) medium: 111/25, critical: 47/5 and of one
    _, text, hand = sit(sitting, "-6, , -3", "-6, 0, -3", "critical: 9.4", "leave")
    assert "Kept, but what is missing would count as wrong: δ₁ is missing; give it too." in text
    assert "medium is missing; give it too." in text
    assert [prompt[:2] for prompt in hand.prompts] == ["1a", "1a", "1b", "1b"]
    (graded,) = sitting.graded()
    assert [part.score.points for part in graded] == [2, Fraction(1, 2)]


def test_ctrl_c_asks(sitting: Sitting) -> None:
    a, b, last = right(sitting)
    assert not sit(sitting, a, KeyboardInterrupt, "leave")[0]
    assert not sit(sitting, KeyboardInterrupt, KeyboardInterrupt)[0]
    handed_in, _, _ = sit(sitting, KeyboardInterrupt, "", b, last, KeyboardInterrupt, EOFError)
    assert not handed_in
    assert sit(sitting, KeyboardInterrupt, "hand in", "yes")[0]


def test_it_goes_on_from_the_file_and_stays_handed_in(sitting: Sitting) -> None:
    a, b, last = right(sitting)
    sit(sitting, a, EOFError)
    later = Sitting(sitting.exam, sitting.version, sitting.path, START + timedelta(days=1))
    later.resume()
    assert later.begun == START
    assert later.answers == {Place(0, 0): a}
    _, _, hand = sit(later, b, last, "yes")
    assert hand.prompts[0].startswith("1b")
    again = Sitting(sitting.exam, sitting.version, sitting.path, START)
    again.resume()
    assert again.handed_in is not None
    assert "3 of 3 points" in sit(again)[1]


def test_time_is_up(tmp_path: Path) -> None:
    planned = exam(duration=2)
    sitting = Sitting(planned, planned.versions[0], tmp_path / "answers.toml", START)
    a, b, last = right(sitting)
    handed_in, text, hand = sit(sitting, a, b, last)
    assert hand.prompts[0].startswith("[2 min left]")
    assert handed_in
    assert "Time is up. What was typed after that does not count." in text
    assert "2 of 3 points" in text


def test_time_goes_on_while_nobody_sits_there(tmp_path: Path) -> None:
    planned = exam(duration=10)
    path = tmp_path / "answers.toml"
    sit(Sitting(planned, planned.versions[0], path, START), "leave")  # before any answer
    later = Sitting(planned, planned.versions[0], path, START + timedelta(hours=1))
    later.resume()
    assert later.begun == START
    hand = Hand()
    hand.time = START + timedelta(hours=1)
    console = Console(width=100, record=True, markup=False, highlight=False)
    assert SittingScreen(console, hand.ask, hand.now).run(later)
    assert hand.prompts == []
    assert "Time is up." in console.export_text()


@pytest.mark.parametrize(
    "typed", ["3\x7f", "\udcff", "3\x00", "1\n2", "\u2028", "# handed in: 2026-11-26T09:00:00+00:00"]
)
def test_whatever_is_typed_is_kept_and_counts_as_verify_counts_it(sitting: Sitting, typed: str) -> None:
    _, b, _ = right(sitting)
    sit(sitting, typed, "", b, "leave")
    again = Sitting(sitting.exam, sitting.version, sitting.path, START)
    again.resume()
    assert again.answers == sitting.answers
    assert again.handed_in is None
    assert verify([sitting.path]).score.points == points(again)


def test_a_disk_that_takes_nothing_is_told_once_and_the_exam_goes_on(tmp_path: Path) -> None:
    planned = exam()
    sitting = Sitting(planned, planned.versions[0], tmp_path / "gone" / "answers.toml", START)
    sitting.path.parent.write_text("a file in the way")
    a, b, last = right(sitting)
    handed_in, text, _ = sit(sitting, a, b, last, "yes", width=400)
    assert handed_in
    assert text.count("cannot be written to") == 1
    assert "3 of 3 points" in text
    assert f"Your answers could not be written to {sitting.path}." in text
    sitting.handed_in = None
    with pytest.raises(FileExistsError):
        sit(sitting, "leave")
    sitting.path.parent.unlink()
    assert "Kept in" in sit(sitting, "leave")[1]
    assert verify([sitting.path]).score.points == 3


@pytest.mark.parametrize("typed", [("0", "0", "0"), ("1/2",), ("right", "right", "0"), ()])
def test_verify_gives_the_same_points(sitting: Sitting, typed: tuple[str, ...]) -> None:
    own = right(sitting)
    sit(sitting, *(own[index] if text == "right" else text for index, text in enumerate(typed)), "hand in", "yes")
    if typed:
        assert verify([sitting.path]).score.points == points(sitting)
    else:
        assert points(sitting) == 0


def test_an_exam_with_points_of_its_own_is_graded_by_its_manifest(tmp_path: Path) -> None:
    entries = (Entry(id="return/1/2166", points=(5, 3)), Entry(id="td-zero/1/62590", points=4))
    planned = plan(Blueprint(problems=entries, seed=1))
    sitting = Sitting(planned, planned.versions[0], tmp_path / "answers.toml", START, tmp_path / "exam.json")
    (tmp_path / "exam.json").write_bytes(written(manifest(planned)))
    a, _, last = right(sitting)
    _, text, _ = sit(sitting, a, "0", last, "yes", width=400)
    assert "9 of 12 points" in text
    assert f"rldrill verify {tmp_path / 'answers.toml'} --for {tmp_path / 'exam.json'}\n" in text
    settings = Settings(assignment=Assignment(tmp_path / "exam.json"))
    assert verify([sitting.path], settings).score.points == 9


#: td-zero/2/18: (a) is −6, 16/5, −3 and of 3 points, (b) medium: 111/25, critical: 47/5 and of one.
TABLE = ("-6, 0, -3", "medium: 4.44, critical: 9.4")


@pytest.mark.parametrize(
    ("id_", "rules", "typed", "earned", "of"),
    [
        ("td-zero/2/18", {}, TABLE, 1, 4),  # a table that is half right earns all or nothing, unless the exam says so
        ("td-zero/2/18", {"partial": "entries"}, TABLE, 3, 4),
        ("td-zero/2/18", {"own": ("entries", "all")}, TABLE, 3, 4),
        # the return is 2, then 9 + 1/3·2 = 29/3
        ("return/1/2166", {"decimal_mark": ","}, ("2,0", "9,67"), 2, 2),
        # linearise-affine/1/6 (b) is [3/4 −1; 0 1]: the last row is 0 1 in every draw
        ("linearise-affine/1/6", {"partial": "entries"}, ("", "7 7; 0 1"), 0, None),
    ],
)
def test_the_points_in_the_terminal_are_those_that_verify_gives_by_the_manifest(
    tmp_path: Path, id_: str, rules: dict[str, Any], typed: tuple[str, ...], earned: int, of: int | None
) -> None:
    entry = Entry(id=id_, partial=rules.pop("own", None))
    planned = plan(Blueprint(problems=(entry,), seed=1).but(**rules))
    sitting = Sitting(planned, planned.versions[0], tmp_path / "answers.toml", START, tmp_path / "exam.json")
    (tmp_path / "exam.json").write_bytes(written(manifest(planned)))
    _, text, _ = sit(sitting, *typed, "hand in", "yes", width=400)
    assert f"\n{earned} of {of or sitting.version.points} points\n" in text
    assert "Kept, but" not in text
    score = verify([sitting.path], Settings(assignment=Assignment(tmp_path / "exam.json"))).score
    assert score == Score(Fraction(earned), sitting.version.points)


def test_where_there_are_several_versions_the_command_names_the_one_that_was_sat(tmp_path: Path) -> None:
    planned = plan(Blueprint(problems=(Entry(family="return", level=1),), seed=1, versions=2))
    sitting = Sitting(planned, planned.versions[1], tmp_path / "my answers.toml", START, tmp_path / "exam.json")
    _, text, _ = sit(sitting, "5", "hand in", "yes", width=400)
    assert f"rldrill verify '{sitting.path}' --for {tmp_path / 'exam.json'} --version B\n" in text


def test_the_manifest_makes_the_same_exam(sitting: Sitting, tmp_path: Path) -> None:
    sit(sitting, "5", "leave")
    path = tmp_path / "exam.json"
    path.write_bytes(written(manifest(sitting.exam)))
    read = read_manifest(path)
    again = Sitting(read, version_of(read, "a"), sitting.path, START)
    again.resume()
    assert again.answers == {Place(0, 0): "5"}


def test_what_somebody_has_written_into_the_file_as_verify_reads_it_is_taken_in(sitting: Sitting) -> None:
    sitting.save()
    first, second = (f'"{exercise.id}"' for exercise in sitting.version.exercises)
    begun = f"# begun: {START.isoformat()}\n"
    # td-zero/1/62590 has one part, which needs no name
    sitting.path.write_text(f'{begun}{second} = "21/4"\n[{first}]\n"(A)" = 5.50\nb = 29\n')
    sitting.resume()
    assert sitting.answers == {Place(0, 0): "5.50", Place(0, 1): "29", Place(1, 0): "21/4"}
    assert points(sitting) == verify([sitting.path]).score.points == 1
    for broken in (f'{first} = "2"', f'{first} = {{c = "2"}}', f"{first} = {{a = [[[2]]]}}"):
        sitting.path.write_text(f'{begun}{broken}\n{second} = "21/4"\n')
        with pytest.raises(FileError, match="name another"):
            sitting.resume()


def test_the_file_of_something_else_is_refused(sitting: Sitting) -> None:
    for text in ('["return/1/8@2"]\na = "3"\n', "no toml", f"# begun: {START.isoformat()}\n[x]\n"):
        sitting.path.write_text(text)
        with pytest.raises(FileError, match="name another"):
            sitting.resume()
    with pytest.raises(UsageError, match="The exam has no version 'Z'; it has A"):
        version_of(sitting.exam, "Z")


def test_two_terminals_in_one_exam_keep_what_was_typed_in_either(tmp_path: Path) -> None:
    planned, path = exam(), tmp_path / "answers.toml"
    first = Sitting(planned, version_of(planned, None), path, START)
    first.answer(Place(0, 0), "1")
    first.save()
    second = Sitting(planned, version_of(planned, None), path, START)
    second.resume()
    first.answer(Place(0, 1), "2")
    first.save()
    second.answer(Place(1, 0), "3")
    second.answer(Place(0, 0), "4")
    second.save()
    first.answer(Place(1, 0), "")
    first.save()
    third = Sitting(planned, version_of(planned, None), path, START)
    third.resume()
    assert third.answers == {Place(0, 0): "4", Place(0, 1): "2"}  # of one part the later; what was cleared is gone


def test_two_terminals_that_begin_an_exam_at_once_keep_what_was_typed_in_either(tmp_path: Path) -> None:
    planned, path = exam(), tmp_path / "answers.toml"
    first, second = (
        Sitting(planned, version_of(planned, None), path, START + timedelta(seconds=second)) for second in (0, 1)
    )  # the file is there for neither
    first.save()
    first.answer(Place(0, 0), "1")
    first.save()
    second.save()
    second.answer(Place(0, 1), "2")
    second.save()
    third = Sitting(planned, version_of(planned, None), path, START + timedelta(hours=1))
    third.resume()
    assert third.answers == {Place(0, 0): "1", Place(0, 1): "2"}
    assert third.begun == second.begun == START


def test_two_terminals_that_answer_at_the_same_moment_lose_nothing_of_each_other(tmp_path: Path) -> None:
    planned = plan(Blueprint(problems=tuple(Entry(family="return", level=1) for _ in range(8)), seed=1))
    path, side_by_side = tmp_path / "answers.toml", Barrier(2)
    one, other = (Sitting(planned, version_of(planned, None), path, START) for _ in range(2))
    one.save()

    def type_into(sitting: Sitting, part: int) -> None:
        for problem in range(8):
            side_by_side.wait()
            sitting.answer(Place(problem, part), "1")
            sitting.save()

    threads = [Thread(target=type_into, args=each) for each in ((one, 0), (other, 1))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    again = Sitting(planned, version_of(planned, None), path, START)
    again.resume()
    assert again.answers == dict.fromkeys(again.places, "1")
    assert [each.name for each in tmp_path.iterdir()] == ["answers.toml"]


def test_what_is_handed_in_elsewhere_is_over_here(sitting: Sitting) -> None:
    sitting.save()
    other = Sitting(sitting.exam, sitting.version, sitting.path, START)
    other.resume()
    other.answer(Place(0, 0), "1")
    other.handed_in = START + timedelta(minutes=1)
    other.save()
    handed_in, text, _ = sit(sitting, "5", "6")
    assert handed_in
    assert "done in another terminal" in text
    assert sitting.answers == {Place(0, 0): "1"}


def test_a_file_that_was_spoilt_meanwhile_costs_no_answer(sitting: Sitting) -> None:
    sitting.answer(Place(0, 0), "1")
    sitting.save()
    sitting.path.write_bytes(b"\xff\xfe\xff")
    sitting.answer(Place(0, 1), "2")
    aside = sitting.save()
    assert aside == sitting.path.with_name(f"{sitting.path.name}.1")
    assert aside.read_bytes() == b"\xff\xfe\xff"
    again = Sitting(sitting.exam, sitting.version, sitting.path, START)
    again.resume()
    assert again.answers == {Place(0, 0): "1", Place(0, 1): "2"}


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
@pytest.mark.parametrize("name", ["student", "name", '"Full name"'])
def test_the_file_may_be_edited_as_verify_reads_it(sitting: Sitting, name: str, encoding: str) -> None:
    sitting.answer(Place(0, 0), "1")
    sitting.save()
    edited = sitting.path.read_text(encoding="utf-8").replace('a = "1"', 'a = "2"')
    head, _, rest = edited.partition("\n[")
    sitting.path.write_text(f'{head}{name} = "Ann"\n[{rest}', encoding=encoding)
    again = Sitting(sitting.exam, sitting.version, sitting.path, START)
    again.resume()
    sitting.answer(Place(0, 1), "3")
    assert sitting.save() is None
    assert sitting.answers == again.answers | {Place(0, 1): "3"} == {Place(0, 0): "2", Place(0, 1): "3"}
    assert 'student = "Ann"' in sitting.path.read_text(encoding="utf-8")


@pytest.mark.parametrize(("slip", "told"), [("student = true", "must be a text"), ("student = Ann", "line 3")])
def test_a_slip_in_an_edited_file_is_told_and_set_aside(sitting: Sitting, slip: str, told: str) -> None:
    sitting.save()
    edited = sitting.path.read_text(encoding="utf-8").replace("\n\n[", f"\n{slip}\n\n[", 1)
    sitting.path.write_text(edited, encoding="utf-8")
    with pytest.raises(FileError, match=told):
        Sitting(sitting.exam, sitting.version, sitting.path, START).resume()
    _, text, _ = sit(sitting, "5", "leave")
    assert "could not be read; what stood there is in" in " ".join(text.split())
    assert sitting.path.with_name(f"{sitting.path.name}.1").read_text(encoding="utf-8") == edited


def test_where_an_id_stands_twice_in_an_old_manifest_the_problems_are_called_by_their_numbers(
    sitting: Sitting, tmp_path: Path
) -> None:
    ((first, *_), version) = sitting.version.exercises, sitting.version
    twice = replace(version, exercises=(first, first), partial=())
    planned = replace(sitting.exam, versions=(twice,))
    path, saved = tmp_path / "twice.toml", tmp_path / "twice.json"
    saved.write_bytes(written(manifest(planned)))
    sit(Sitting(planned, twice, path, START), "2", "29/3", "2", "29/3", "leave")
    again = Sitting(planned, twice, path, START)
    again.resume()
    assert list(again.answers.values()) == ["2", "29/3", "2", "29/3"]
    assert verify([path], Settings(assignment=Assignment(saved))).score == Score(Fraction(4), 4)


def test_a_problem_of_ones_own_is_called_by_its_number(tmp_path: Path) -> None:
    own = tmp_path / "own.toml"
    own.write_text('family = "return"\n[given]\nrewards = [4, 6]\ngamma = "1/2"\ntime = 0\n')  # 4 + 1/2·6 = 7
    planned = plan(Blueprint(problems=(PROBLEMS[0], Entry(file=str(own))), seed=1))
    sitting = Sitting(planned, planned.versions[0], tmp_path / "answers.toml", START)
    sit(sitting, "go 2", "7", "leave")
    kept = tomllib.loads(sitting.path.read_text(encoding="utf-8"))
    assert kept["2"] == {"a": "7"}
    again = Sitting(planned, planned.versions[0], sitting.path, START)
    again.resume()
    assert list(again.answers.values()) == ["7"]


def test_another_blueprint_does_not_go_on_with_an_exam_that_was_begun(tmp_path: Path) -> None:
    saved = tmp_path / "exam-answers.json"
    for name, title in (("a", "Exam of A"), ("b", "Exam of B")):
        text = f'title = "{title}"\n[[problems]]\nfamily = "return"\n'
        (tmp_path / f"{name}.toml").write_text(text, encoding="utf-8")
    begun = _begun(tmp_path / "a.toml", saved, None)
    assert _begun(tmp_path / "a.toml", saved, None).versions == begun.versions
    with pytest.raises(UsageError, match="holds another exam that was begun, 'Exam of A'; name another file"):
        _begun(tmp_path / "b.toml", saved, None)
    with pytest.raises(UsageError, match="holds another exam"):
        _begun(tmp_path / "a.toml", saved, begun.seed + 1)


def test_a_blueprint_that_is_sat_is_the_exam_that_is_printed_from_it_in_all_its_versions(tmp_path: Path) -> None:
    path = tmp_path / "exam.toml"
    path.write_text('seed = 5\nversions = 3\n[[problems]]\nfamily = "return"\n', encoding="utf-8")
    printed = plan(read_blueprint(path))
    begun = _begun(path, tmp_path / "exam-answers.json", None)
    names = [[exercise.id for exercise in version.exercises] for version in printed.versions]
    assert len({*map(tuple, names)}) == 3
    assert [[exercise.id for exercise in version.exercises] for version in begun.versions] == names


def test_who_sits_it_stays_in_the_file_and_problems_may_be_called_by_their_numbers(tmp_path: Path) -> None:
    planned = plan(Blueprint(problems=PROBLEMS[:2], seed=1))
    path = tmp_path / "answers.toml"
    sit(Sitting(planned, planned.versions[0], path, START), "1/8", "leave")
    first, second = (f"[{json.dumps(exercise.id)}]" for exercise in planned.versions[0].exercises)
    written_ = path.read_text(encoding="utf-8")
    head, _, rest = written_.partition(first)
    path.write_text(f'{head}student = "Ann"\nnumber = 7\n[1]{rest.partition(second)[0]}', encoding="utf-8")
    again = Sitting(planned, planned.versions[0], path, START)
    again.resume()
    assert list(again.answers.values()) == ["1/8"]
    sit(again, "leave")
    again.answer(again.places[1], "3")
    again.save()
    kept = tomllib.loads(path.read_text(encoding="utf-8"))
    assert (kept["student"], kept["number"]) == ("Ann", "7")
    assert kept[planned.versions[0].exercises[0].id]["a"] == "1/8"


@pytest.mark.parametrize(
    "other",
    [
        '[[problems]]\nid = "td-zero/1/62590"\n[[problems]]\nfamily = "td-zero"\n',
        '[[problems]]\nid = "return/1/2166"\n[[problems]]\nfamily = "sarsa"\n',
        '[[problems]]\nid = "return/1/2166"\n[[problems]]\nfamily = "td-zero"\ncount = 2\n',
        '[[problems]]\nid = "return/1/2166"\n',
        'seed = 6\n[[problems]]\nid = "return/1/2166"\n[[problems]]\nfamily = "td-zero"\n',
        '[[problems]]\nid = "return/1/2166"\n[[problems]]\nfamily = "td-zero"\nlevel = 3\n',
        '[[problems]]\nid = "return/1/2166"\n[[problems]]\ntopic = "bayes"\n',
        'points = 30\n[[problems]]\nid = "return/1/2166"\n[[problems]]\nfamily = "td-zero"\n',
    ],
)
def test_next_weeks_quiz_of_the_same_title_does_not_go_on_with_this_weeks(tmp_path: Path, other: str) -> None:
    path, saved = tmp_path / "exam.toml", tmp_path / "exam-answers.json"
    text = 'duration = 10\n[[problems]]\nid = "return/1/2166"\n[[problems]]\nfamily = "td-zero"\n'
    path.write_text(f"seed = 5\n{text}", encoding="utf-8")
    begun = _begun(path, saved, None)
    path.write_text(text.replace("10", "20"), encoding="utf-8")  # more time is no other exam
    longer = _begun(path, saved, None)
    assert (longer.versions, longer.head.duration) == (begun.versions, 20)
    path.write_text(other, encoding="utf-8")
    with pytest.raises(UsageError, match="holds another exam that was begun"):
        _begun(path, saved, None)
