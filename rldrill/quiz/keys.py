"""The keys of the quiz, and when a letter is one."""

import re

from rldrill.exercise import Exercise
from rldrill.problems.parts import Choice, Kind, Policy, Values

#: The keys that are told once, at the first question, and what reminds of them afterwards.
KEYS = ("h hint · p problem again · m check my own working", "s skip · w working · t topics · q quit · ? all keys")
SHORT_KEYS = "h ? q"
HELP = (
    ("h", "hint: the formula, what its symbols are here, then the working line by line"),
    ("p", "problem: show it again"),
    ("w", "working: show how this part is solved, and go on"),
    ("m", "my working: type your own, line by line, to see where it goes wrong"),
    ("s", "skip this part, and see its answer"),
    ("r", "restart: begin this problem again from its first part"),
    ("v", "variant: another problem of the same kind"),
    ("t", "topics: the map of all, with what you have done"),
    ("q", "quit, with a summary (Ctrl-C and Ctrl-D do the same)"),
    ("?", "this help"),
)
#: What may be typed for a key: its letter, its word.
COMMANDS = {word: key for key, says in HELP[:-1] for word in (key, re.split("[^a-z]", says)[0])} | {
    "?": "?",
    "help": "?",
}
#: The rule for points, in words.
COUNTS = "Each wrong answer before, and each hint, takes a quarter of the points, down to a quarter."


def alone(keys: str, exercise: Exercise) -> str:
    """Of these keys those that need no Enter: with the others an answer to this problem may begin that comes late."""
    names = {*exercise.problem.parameters}
    for part in exercise.parts:
        if isinstance(part.kind, Values):
            names |= {key if isinstance(key, str) else key[0] for key in part.kind.keys}
        elif isinstance(part.kind, Policy):
            names |= {*part.kind.actions}
    begun = {name[:1].lower() for name in names}
    return "".join(key for key in keys if key not in begun)


def command(text: str, exercise: Exercise, kind: Kind) -> str:
    """The key that was meant, or the text where it is an answer: a letter that is one here, is; ``:p`` is the key."""
    given = text.lower()
    if given.startswith(":"):
        return COMMANDS.get(given[1:], text)
    answers = {*exercise.problem.parameters}
    if isinstance(kind, Policy):
        answers |= {action.lower() for actions in kind.actions.values() for action in actions}
    elif isinstance(kind, Choice):
        answers |= {letter.lower() for letter in kind.options}
    return text if given in answers else COMMANDS.get(given, text)
