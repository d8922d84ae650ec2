"""The quiz in a pseudo-terminal, narrow and wide: every key, and every way to end."""

import re
import signal
from collections.abc import Iterator
from pathlib import Path

import pexpect
import pytest

from terminals import Terminal

RACING_CAR = str(Path(__file__).parent.parent.parent / "examples" / "racing-car.toml")


@pytest.fixture(params=[60, 120])
def terminal(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Terminal]:
    running = Terminal(tmp_path, request.param, RACING_CAR)
    running.sees("(a) > ")
    yield running
    running.child.close(force=True)


def test_every_key(terminal: Terminal) -> None:
    terminal.types("?", "show it again", "the map", "this help", "(a) > ")
    terminal.types("p", "Value iteration starts", "(a) > ")
    terminal.types("hint", "Hint 1 of", "(a) > ")
    terminal.types("t", "fundamentals", "0 of", "(a) > ")
    terminal.types("m", "Your working", "ends it", "... ")
    terminal.types("V1 = 2", "... ")
    terminal.types("", "(a) > ")
    terminal.types("r", "Problem 1", "(a) > ")
    terminal.types("cool: 7/2, warm: 5/2", "Right", "counts 3/4", "(b) > ")
    terminal.types("w", "The answer:", "Enter next")
    terminal.types("cool: fast", "was not judged: cool: fast", "Enter next")
    terminal.types("p", "Value iteration starts", "Enter next")
    terminal.types("w", "V₁", "Enter next")
    terminal.types("", "1 of 2 parts right", "Weakest", "Tomorrow: rldrill quiz", "f five more of these")
    terminal.types("f", "Problem 1 of 5", "(a) > ")
    terminal.types("v", "Problem 1 of 5", "(a) > ")
    terminal.types("s", "The answer:", "> ")
    terminal.types("q", "0 of", "f five more of these")
    terminal.types("")
    assert terminal.ends() == 0


@pytest.mark.parametrize("terminal", [60], indirect=True)
def test_ctrl_d_sums_up(terminal: Terminal) -> None:
    terminal.types("1, 2", "✗", "(a) > ")
    terminal.child.sendeof()
    terminal.sees("0 of 2 parts right")
    terminal.child.sendeof()
    assert terminal.ends() == 0


@pytest.mark.parametrize("terminal", [120], indirect=True)
def test_ctrl_c_sums_up(terminal: Terminal) -> None:
    terminal.types("1, 2", "Try again", "(a) > ")
    terminal.child.sendintr()
    terminal.sees("0 of 2 parts right")
    assert terminal.ends() == 130


def test_where_keys_are_offered_one_key_is_enough(terminal: Terminal) -> None:
    terminal.presses("?", "show it again", "this help", "(a) > ")
    terminal.types("s", "(b) > ")
    terminal.presses("?", "this help", "(b) > ")
    terminal.presses("\x1b[A\r", "Enter next")  # up to what was typed last: the s, and not the key
    terminal.presses("p", "Value iteration starts", "Enter next")
    for letter in "warm: 5/2":  # comes too late, and begins with the w of the working
        terminal.presses(letter)
    terminal.presses("\r", "was not judged: warm: 5/2", "Enter next")
    terminal.types("cool: fast", "was not judged: cool: fast", "Enter next")
    terminal.presses(" ", "0 of 2 parts right", "f five more of these")
    terminal.presses("f", "Problem 1 of 5", "(a) > ")
    terminal.types("s")
    terminal.child.close(force=True)


def test_a_letter_that_begins_an_answer_is_no_key(tmp_path: Path) -> None:
    running = Terminal(tmp_path, 80, "return/1/2166")
    running.sees("(a) > ")
    for key in "hwsq":
        running.presses(key, f"\x1b[0m{key}\x1b")  # it stands there, and is deleted
        running.presses("\x7f", "\x1b[K")
    running.presses("2\r", "✓ Right. At the first try")
    running.child.close(force=True)


def test_after_ctrl_z_the_question_and_what_was_typed_are_there_again(tmp_path: Path) -> None:
    running = Terminal(tmp_path, 60, RACING_CAR, then="echo It is stopped; fg; echo and ended")
    running.sees("(a) > ")
    running.is_read()
    running.presses("cool: 7/2, ", "cool: 7/2, ")
    running.presses("\x1a", "It is stopped", "Value iteration starts", "(a) > cool: 7/2, ")
    running.types("warm: 5/2", "Right", "(b) > ")
    running.child.sendeof()
    running.sees("1 of 2 parts right", "and ended")


def test_where_it_is_read_out_the_prompt_and_what_was_typed_are_there_again_after_ctrl_z(tmp_path: Path) -> None:
    running = Terminal(tmp_path, 80, "--plain", RACING_CAR, then="echo It is stopped; fg; echo and ended")
    running.child.setecho(True)  # readline echoes where the terminal does
    running.sees("(a) > ")
    running.is_read()
    running.presses("cool: 7/2, ", "cool: 7/2, ")
    running.presses("\x1a", "It is stopped", "(a) > cool: 7/2, ")
    running.types("warm: 5/2", "Right", "(b) > ")
    running.child.close(force=True)


def test_in_a_window_of_another_size_all_is_there_again_and_fits(terminal: Terminal) -> None:
    terminal.types("1, 2", "✗", "(a) > ")
    terminal.presses("cool: 7/2, ", "cool: 7/2, ")
    terminal.child.setwinsize(30, 70)
    terminal.sees("Value iteration starts", "(a) > 1, 2", "(a) > cool: 7/2, ")
    drawn = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", terminal.child.before)
    assert max(map(len, drawn.split("\r\n"))) <= 70
    terminal.presses("\x0c", "Value iteration starts", "(a) > cool: 7/2, ")  # Ctrl-L
    terminal.types("warm: 5/2", "Right")


def test_a_newcomer_is_shown_an_example_and_answers(tmp_path: Path) -> None:
    running = Terminal(tmp_path, 80)
    running.sees("Your first quiz", "New: ", "n the problem · t topics > ")
    running.types("topics", "fundamentals", "0 of", "n the problem · t topics > ")
    running.types("?", "this help", "n the problem · t topics > ")
    running.types("", "your turn > ")
    running.types("", "Problem 1 of 10", "h hint", "> ")
    running.types("s", "> ")
    running.types("s", "This comes again tomorrow.", "Enter next")
    running.presses("q", "0 of 2 parts right", "Tomorrow, 1 due: rldrill quiz")
    running.presses("\r")
    assert running.ends() == 0


def test_of_a_topic_that_is_named_the_easy_problems_come_first(tmp_path: Path) -> None:
    running = Terminal(tmp_path, 80, "bayes")
    running.sees("Your first quiz: 10 problems, easy ones before others.", "n the problem · t topics > ")
    running.types("n", "Problem 1 of 10", "level 1", "> ")
    running.child.close(force=True)


def test_of_a_mistake_that_is_drilled_there_are_five_more(tmp_path: Path) -> None:
    running = Terminal(tmp_path, 120, "--mistake", "forgot gamma", "bellman", "-n", "1", "--seed", "5")
    running.sees("Only “forgot gamma”, not made so far", "n the problem · t topics > ")
    running.types("n", "Problem 1 of 1", "Bellman backup", "> ")
    running.types("s", "The answer:", "Enter next")
    running.types("", "“forgot gamma”: made in none of 1 problem.", "f five more of these")
    running.types("f", "Problem 1 of 5", "> ")
    running.child.close(force=True)


def test_a_word_quits_before_the_first_problem_too(tmp_path: Path) -> None:
    running = Terminal(tmp_path, 80)
    running.sees("n the problem · t topics > ")
    running.types("quit", "Nothing was answered")
    assert running.ends() == 0


def test_plain_is_ascii_without_pictures(tmp_path: Path) -> None:
    running = Terminal(tmp_path, 80, "--plain", RACING_CAR)
    running.sees("(a) > ")
    assert running.child.before.isascii()
    assert "s: cool, a: slow, s': cool" in running.child.before.replace("\r\n", "\n")
    assert "--" not in running.child.before
    running.types("t", "fundamentals", "0 of", "(a) > ")
    assert "\\u" not in running.child.before
    running.child.close(force=True)


def test_an_exam_that_is_killed_goes_on_with_what_was_answered(tmp_path: Path) -> None:
    blueprint = tmp_path / "exam.toml"
    blueprint.write_text('duration = 60\n[[problems]]\nid = "return/1/2166"\n')
    arguments = ("--exam", str(blueprint), "--answers", str(tmp_path / "mine.toml"))
    killed = Terminal(tmp_path, 80, *arguments)
    killed.sees("[60 min left] 1a > ")
    killed.types("34/9", "1b > ")
    killed.child.kill(signal.SIGKILL)
    killed.child.expect(pexpect.EOF)
    running = Terminal(tmp_path, 80, *arguments)
    running.sees("min left] 1b > ")
    running.types("go 1a", "your answer so far: 34/9", "1a > ")
    running.types("hand in", "1 of 2 parts have no answer. Hand in?")
    running.types("yes", "of 2 points", "1b 0 of 1 Not answered")
    assert running.ends() == 0


def test_the_next_problem_begins_at_the_top_of_the_screen_and_what_was_there_is_scrolled_away(tmp_path: Path) -> None:
    running = Terminal(tmp_path, 80, "return/1/2166", "return/1/8")
    running.sees("(a) > ")
    running.types("s", "(b) > ")
    running.types("s", "Enter next", "> ")
    running.child.sendline("")
    running.child.expect("(?:\r\n){30}\x1b\\[H")  # the terminal has 30 lines
    running.sees("Problem 2 of 2")
    running.child.close(force=True)
