"""The quiz: with somebody's typing simulated, and in a real pseudo-terminal."""

import sys
import types
from collections.abc import Iterator
from fractions import Fraction
from io import StringIO
from pathlib import Path

import pytest
from rich.console import Console

import rldrill
from rldrill.commands import quiz as command
from rldrill.exam import planning
from rldrill.exam.blueprint import Blueprint
from rldrill.exam.exam import Exam
from rldrill.exam.manifest import read_manifest
from rldrill.problems.catalogue import family
from rldrill.problems.errors import UsageError
from rldrill.quiz.ahead import Ahead
from rldrill.quiz.keys import HELP
from rldrill.quiz.prompt import Lines
from rldrill.quiz.questions import questions
from rldrill.quiz.screen import Screen
from rldrill.quiz.session import Session, State
from terminals import Terminal

RACING_CAR = Path(__file__).parent.parent.parent / "examples" / "racing-car.toml"


class Typist:
    """Types the given lines; then input ends, or Ctrl-C is pressed."""

    def __init__(self, *lines: str | type[BaseException]) -> None:
        self.lines: Iterator[str | type[BaseException]] = iter(lines)
        self.screen = Console(file=StringIO(), width=100, highlight=False, markup=False)

    def __call__(self, prompt: str, _keys: str = "") -> str:
        line = next(self.lines, EOFError)
        if not isinstance(line, str):
            raise line
        self.screen.print(f"{prompt}{line}")
        return line

    @property
    def seen(self) -> str:
        """All that was on the screen."""
        file = self.screen.file
        assert isinstance(file, StringIO)
        return file.getvalue()


def quiz(
    *lines: str | type[BaseException], names: tuple[str, ...] = (str(RACING_CAR),)
) -> tuple[Typist, Session, bool]:
    typist = Typist(*lines)
    exercises, total = questions(names, 1, None, lambda: 0)
    session = Session(total)
    finished = Screen(typist.screen, typist).run(exercises, session)
    return typist, session, finished


def test_two_terminals_that_begin_an_exam_at_once_sit_the_same(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    blueprint, saved = tmp_path / "exam.toml", tmp_path / "exam-answers.json"
    blueprint.write_text('[[problems]]\nfamily = "return"\nlevel = 1\n')
    draws, others = planning.plan, []

    def slowly(wanted: Blueprint) -> Exam:
        """Before this exam is drawn, another terminal has drawn one."""
        monkeypatch.setattr(planning, "plan", draws)
        others.append(command._begun(blueprint, saved, 2))
        return draws(wanted)

    monkeypatch.setattr(planning, "plan", slowly)
    mine = command._begun(blueprint, saved, 1)
    ids = [[each.id for each in exam.versions[0].exercises] for exam in (mine, *others, read_manifest(saved))]
    assert ids[0] == ids[1] == ids[2]


def test_a_whole_problem() -> None:
    # V2 = 7/2 and 5/2 as the lecture has them; greedy in cool: fast (2 + 3 > 1 + 3.5), in warm: slow.
    typist, session, finished = quiz("cool: 7/2, warm: 2.5", "cool: fast, warm: slow", "")
    assert finished
    assert [part.state for part in session.parts] == [State.DONE, State.DONE]
    assert "2 of 2 parts right, 2 of them at the first try." in typist.seen


def test_a_mistake_is_named_with_its_formula_and_may_be_corrected() -> None:
    # Averages over two actions: V1 = (3/2, −9/2), V2(cool) = (1 + 3/2 + 2 + 1/2·3/2 − 1/2·9/2)/2 = 3/2 …
    solution = rldrill.load(RACING_CAR).solution
    mean = next(answers for m, answers in solution.mistakes if m.name == "mean-for-max")
    typist, session, _ = quiz(", ".join(f"{s}: {v}" for s, v in mean["a"].items()), "3.5, 2.5", "s", "")
    assert "A typical mistake gives this: Value iteration keeps the best action's value" in typist.seen
    assert "meanₐ" in typist.seen
    assert [part.state for part in session.parts] == [State.DONE, State.SKIPPED]
    assert session.parts[0].tries == 2


def test_the_right_line_is_shown_without_the_answer_to_whoever_may_try_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rldrill.diagnosis.AT_THE_PROMPT", None)  # however busy the machine is
    path = tmp_path / "robot.toml"
    path.write_text(
        """
        family = "bellman-backup"
        [given]
        gamma = "4/5"
        policy = { medium = { search = "3/4", recharge = "1/4" } }
        values = { high = 15, low = 30 }
        [given.dynamics]
        transitions = [["medium", "search", "low", 1, -2], ["medium", "recharge", "high", 1, 3]]
        """,
        encoding="utf-8",
    )
    # 3/4·(−2 + 4/5·30) + 1/4·(3 + 4/5·15) = 3/4·22 + 1/4·15 = 81/4; without the brackets behind π it is 3/4 + 1/4 = 1.
    typist, _, _ = quiz("1", names=(str(path),))
    assert "right: V^π(medium) = 3/4·1·(−2 + 4/5·30)" in typist.seen
    assert "81/4" not in typist.seen
    typist, _, _ = quiz("1", "s", names=(str(path),))
    assert "The answer: 81/4" in typist.seen


def test_what_cannot_be_read_costs_nothing() -> None:
    typist, session, _ = quiz("3,5; 2,5", "", "?", "[s0] [bold]x[/bold]", "3.5 2.5", "3.5, 2.5")
    assert typist.seen.count("Not understood, and not counted") >= 2
    assert "write 3.5" in typist.seen
    for key, meaning in HELP:
        assert f"{key}" in typist.seen
        assert meaning in typist.seen
    assert session.parts[0].tries == 1
    assert session.parts[0].state is State.DONE


def test_how_an_answer_was_read_is_told_only_where_it_was_typed_otherwise() -> None:
    # One value is asked for, which has a name: V(slope) = 8 + 1/4·(−3 + 1/2·8 − 8) = 25/4.
    typist, _, _ = quiz("25/4", names=("td-zero/1/3",))
    assert "Right." in typist.seen
    assert "read as" not in typist.seen
    assert "read as slope: 25/4" in quiz("6 1/4", names=("td-zero/1/3",))[0].seen


def test_hint_first_the_formula_then_the_sentence() -> None:
    typist, session, _ = quiz("h", "h", "w")
    formula = typist.seen.index("maxₐ Σₛ′")
    assert formula < typist.seen.index("keep the greatest")
    assert session.parts[0].hints == 2
    assert session.parts[0].state is State.SHOWN


def test_the_third_miss_leads_to_the_first_line_with_the_numbers_in() -> None:
    # r = 9, −1, 8, 3 and γ = 1/3: R_1 = −1 + 8/3 + 3/9 = 2.
    typist, session, _ = quiz("1", "5", "3", "h", "2", names=("return/1/2166",))
    assert "Still wrong, so h now shows the first line" in typist.seen
    assert "−1 + 1/3·8 + (1/3)²·3" in typist.seen
    assert session.parts[0].points == Fraction(1, 4)


def test_a_family_that_is_new_begins_with_another_problem_worked_out() -> None:
    typist = Typist("", "", "q")
    Screen(typist.screen, typist, seen=["td-zero"]).run([rldrill.draw("return", 1, 2166)], Session(1))
    assert "New: Return." in typist.seen
    example, _, own = typist.seen.partition("your turn")
    assert "R₁ = " in example
    assert "r₁ = 9, r₂ = −1" in own
    assert "r₁ = 9, r₂ = −1" not in example


@pytest.mark.parametrize("lines", [("n", "q"), ("q",)])
def test_the_worked_example_is_not_pressed_on_anybody(lines: tuple[str, ...]) -> None:
    typist = Typist(*lines)
    Screen(typist.screen, typist, seen=[]).run([rldrill.draw("return", 1, 7)], Session(1))
    assert "R₁ = " not in typist.seen


def test_a_problem_that_cannot_be_drawn_ahead_is_told_where_it_is_asked_for() -> None:
    def drawn() -> Iterator[rldrill.Exercise]:
        yield rldrill.draw("return", 1, 7)
        raise UsageError("There are no more.")

    ahead = Ahead(drawn())
    assert next(ahead).id == rldrill.draw("return", 1, 7).id
    ahead.begin()
    with pytest.raises(UsageError, match="no more"):
        next(ahead)


def test_restart_and_variant_leave_no_trace_of_what_was_not_begun() -> None:
    _, session, _ = quiz("r", "v", "s", names=("td-zero/1/7",))
    assert [record.exercise.id for record in session.records] == [f"td-zero/1/8@{family('td-zero').revision}"]


def test_the_end_of_input_ends_with_the_summary() -> None:
    typist, _, finished = quiz("1, 2")
    assert finished
    assert "0 of 2 parts right" in typist.seen


def test_ctrl_c_ends_with_the_summary() -> None:
    typist, _, finished = quiz("1, 2", KeyboardInterrupt)
    assert not finished
    assert "0 of 2 parts right" in typist.seen


def test_nothing_answered() -> None:
    typist, session, _ = quiz("q")
    assert "Nothing was answered" in typist.seen
    assert session.parts == []


def test_a_line_is_edited_and_what_was_typed_before_comes_back(tmp_path: Path) -> None:
    terminal = Terminal(tmp_path, 100, str(RACING_CAR))
    terminal.sees("(a) > ")
    terminal.types("1, 2", "✗", "(a) > ")
    terminal.presses("\x1b[A\x15cool: 3.5, warm: 5/2\r", "✓ Right", "(b) > ")  # up, and all of it deleted
    # left, left …, delete to the end
    terminal.presses("cool: slow\x1b[D\x1b[D\x1b[D\x1b[D\x0bfast, warm: slow\r", "✓ Right", "Enter next")
    terminal.types("", "2 of 2 parts right", "f five more")
    terminal.types("")
    assert terminal.ends() == 0


#: S = 2I, so R + BᵀSB = [5 6; 6 11], with determinant 19, and BᵀSA = [0 4; 2 6]: L = [−12 8; 10 6]/19.
GAIN = "lqr-gain/3/352"


@pytest.mark.parametrize(
    "lines",
    [
        ("-12/19, 8/19\n10/19, 6/19",),
        ("[-12/19, 8/19\n10/19, 6/19]",),
        ("[[-12/19, 8/19],", "[10/19, 6/19]]"),
        ("[", "-12/19, 8/19", "10/19, 6/19", "]"),
    ],
)
def test_the_lines_of_a_matrix_are_one_answer(lines: tuple[str, ...]) -> None:
    _, session, _ = quiz(*lines, names=(GAIN,))
    assert [part.state for part in session.parts][:1] == [State.DONE]
    assert session.parts[0].tries == 1


def test_a_bracket_that_stays_open_ends_with_an_empty_line() -> None:
    typist, session, _ = quiz("[1 2", "", "s", names=(GAIN,))
    assert "> [1 2" in typist.seen
    assert session.parts[0].state is State.SKIPPED


def test_the_lines_of_a_table_are_one_answer() -> None:
    _, session, _ = quiz("cool: 7/2\nwarm: 2.5", "cool: fast\nwarm: slow", "")
    assert [part.state for part in session.parts] == [State.DONE, State.DONE]
    assert [part.tries for part in session.parts] == [1, 1]


def test_pasted_numbers_answer_one_part_after_the_other() -> None:
    # r = 9, −1, 8, 3 and γ = 1/3: R_1 = −1 + 8/3 + 3/9 = 2, R_0 = 9 + 2/3 = 29/3.
    _, session, _ = quiz("2\n29/3", "", names=("return/1/2166",))
    assert [part.state for part in session.parts] == [State.DONE, State.DONE]


@pytest.mark.parametrize("terminal", ["xterm", "linux", "dumb"])
def test_lines_pasted_into_a_real_terminal_are_one_answer(tmp_path: Path, terminal: str) -> None:
    running = Terminal(tmp_path, 100, GAIN, TERM=terminal)
    running.sees("> ")
    rows = "-12/19, 8/19\n10/19, 6/19"
    # A terminal that can do so tells where a paste begins and ends; another one types it.
    running.presses(
        f"\x1b[200~{rows}\x1b[201~\r" if terminal == "xterm" else rows.replace("\n", "\r") + "\r", "✓ Right"
    )
    running.child.close(force=True)


def test_an_open_bracket_goes_on_in_a_real_terminal(tmp_path: Path) -> None:
    running = Terminal(tmp_path, 100, GAIN)
    running.sees("> ")
    running.types("[[-12/19, 8/19],", "... ")
    running.types("[10/19, 6/19]]", "✓ Right")
    running.child.close(force=True)


@pytest.mark.parametrize(("minutes", "says"), [("1", "an easy problem"), ("5", "an easy problem"), ("6", "2 problems")])
def test_minutes_have_room_for_one_problem_at_least(tmp_path: Path, minutes: str, says: str) -> None:
    running = Terminal(tmp_path, 100, "--minutes", minutes)
    running.sees(f"Your first quiz: {says}")
    running.child.close(force=True)


def test_what_a_program_wrote_is_shown_as_it_was_read() -> None:
    prior = dict.fromkeys("abc", 0.3333333333333333)
    likelihood = {"hit": dict.fromkeys("ab", "1/2") | {"c": "1/4"}, "miss": dict.fromkeys("ab", "1/2") | {"c": "3/4"}}
    exercise = rldrill.read(
        {"family": "bayes-rule", "given": {"prior": prior, "likelihood": likelihood, "measurements": ["hit"]}}
    )
    console = Console(file=StringIO(), width=80, color_system=None)
    with console.capture() as capture:
        Screen(console, lambda *_: "q").run([exercise], Session(1))
    assert "(read 0.3333333333333333 as 1/3)" in capture.get()


def test_lines_pasted_into_the_console_of_windows_are_one_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    # Windows has no select for a console; msvcrt tells whether keys wait.
    waiting = ["-12/19, 8/19", "10/19, 6/19"]
    console = types.ModuleType("msvcrt")
    monkeypatch.setattr(console, "kbhit", lambda: bool(waiting), raising=False)
    monkeypatch.setitem(sys.modules, "msvcrt", console)
    monkeypatch.setattr(sys, "platform", "win32")
    monkeypatch.setattr("builtins.input", lambda *_: waiting.pop(0))
    assert Lines()("> ") == "-12/19, 8/19\n10/19, 6/19"
