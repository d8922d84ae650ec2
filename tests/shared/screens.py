"""A quiz as somebody sees it from the first screen to the last: what the golden screens hold, line by line."""

from io import BytesIO, TextIOWrapper
from itertools import count
from unittest.mock import patch

from rich.console import Console

import rldrill
from rldrill.exercise import Exercise
from rldrill.quiz.recording import Recorder
from rldrill.quiz.screen import Screen
from rldrill.quiz.session import Session

#: The widths of the terminals; the last is for those to whom the screen is read out.
WIDTHS = {"60": 60, "80": 80, "140": 140, "plain": 80}


def exercises() -> list[Exercise]:
    """A problem that is drawn, and others of every kind of answer, which no later draw changes."""
    loop = [["cool", "fast", "warm", 1, 4], ["cool", "slow", "cool", 1, 1], ["warm", "slow", "cool", 1, 1]]
    return [
        rldrill.draw("return", 1, 7),
        rldrill.read({"family": "optimal-value", "given": {"mdp": {"transitions": loop}, "gamma": "1/2"}}),
        rldrill.read(
            {"family": "lqr-gain", "given": {"A": [[1, 1], [0, 1]], "B": [[1, 0], [0, 1]], "R": [[1, 0], [0, 2]],
                                             "P": [[-1, 0], [0, -2]]}}
        ),
        rldrill.read({"family": "backup-diagram-name",
             "given": {"diagrams": [{"shows": "sarsa", "options": ["sarsa", "td-zero"]}]}}),
    ]  # fmt: skip


#: What is typed, line by line, at whatever is asked.
TYPED = (
    "", "", "banana", "h", "h", "h", "h", "h", "99", "p", "s", "?", "w", "x", "",
    "cool: 3, warm: 2.5", "m", "V(cool) = 4 + 1/2*2 = 5", "", "s", "cool: fast, warm: slow", "t", "s", "",
    "[1, 2; np.sqrt(4), 1/2]", "w", "w", "s", "", "a", "b", "",
)  # fmt: skip


def transcript(kind: str) -> str:
    """The whole of a quiz with these answers, as it stands in a terminal of a kind."""
    plain = kind == "plain"
    file = TextIOWrapper(BytesIO(), encoding="ascii" if plain else "utf-8")
    screen = Console(file=file, width=WIDTHS[kind], height=24, color_system=None, highlight=False, markup=False,
                     emoji=False)  # fmt: skip
    lines = iter(TYPED)

    def ask(prompt: str, _keys: str = "") -> str:
        typed = next(lines, None)
        if typed is None:
            screen.print(prompt, end="\n")
            raise EOFError
        screen.print(f"{prompt}{typed}")
        return typed

    clock = count(0, 5)
    # What is said of a wrong answer must not hang on how fast the machine is.
    with patch("rldrill.diagnosis.AT_THE_PROMPT", None), screen.capture() as captured:
        Screen(
            screen, ask, Recorder(clock=lambda: float(next(clock))), seen=(), topics=lambda: "(the map)", plain=plain
        ).run(exercises(), Session(4))
    return "".join(f"{line.rstrip()}\n" for line in captured.get().splitlines())
