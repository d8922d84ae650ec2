"""A diagram is named by its root, by whether it branches, by its arcs and by how far it reaches."""

from rldrill.problems.backup_diagrams.backup_diagram_name import Given
from rldrill.problems.backups import BACKUPS, TITLES, Backup, backup_diagram
from rldrill.problems.pictures import Node
from rldrill.solutions.formula.formula import Misconception, slip
from rldrill.solutions.oracle import Answers
from rldrill.solutions.work import Work

#: What each diagram looks like: why it is the right one, and why it was a wrong one.
_LOOKS: dict[Backup, str] = {
    "bellman-v": "starts at a state and averages over all actions, then over all next states: it branches twice and "
    "has no arc.",
    "bellman-q": "starts at an action and averages over all next states, then over all actions there: it branches "
    "twice and has no arc.",
    "bellman-optimality-v": "starts at a state, has an arc across its actions, and branches from each of them to all "
    "next states.",
    "bellman-optimality-q": "starts at an action, branches to all next states, and has an arc across the actions of "
    "each.",
    "td-zero": "starts at a state and follows one action to one next state: a line without branches, one step long.",
    "n-step-td": "starts at a state and follows a run of several steps to a state where the episode has not ended: a "
    "line without branches.",
    "monte-carlo": "starts at a state and follows the whole run: a line without branches down to the end of the "
    "episode.",
    "sarsa": "starts at an action and follows it to one next state and to the one action taken there: a line without "
    "branches.",
    "expected-sarsa": "starts at an action, follows it to one next state, and averages over all actions there: only "
    "these branch, and without an arc.",
    "q-learning": "starts at an action, follows it to one next state, and takes the maximum over all actions there: "
    "only these branch, under an arc.",
}
#: What each is called in a sentence without mathematics.
_NAMES: dict[Backup, str] = {
    "bellman-v": "The Bellman equation for V^π",
    "bellman-q": "The Bellman equation for Q^π",
    "bellman-optimality-v": "The Bellman optimality equation for V*",
    "bellman-optimality-q": "The Bellman optimality equation for Q*",
    "td-zero": "TD(0)",
    "n-step-td": "n-step TD",
    "monte-carlo": "The Monte Carlo method",
    "sarsa": "Sarsa",
    "expected-sarsa": "Expected Sarsa",
    "q-learning": "Q-learning",
}


def solve(given: Given, work: Work) -> None:
    """One letter for every diagram."""
    for item in given.diagrams:
        letter = item.letters[item.shows]
        work.say(f"The diagram {_LOOKS[item.shows]} So it is ({letter}), {TITLES[item.shows]}.")
        work.answer(letter)


def _took_it_for(wrong: Backup) -> Misconception:
    """The slip of taking every diagram for the same one, where that is offered."""

    @slip(
        f"took-it-for-{wrong}",
        f"{_NAMES[wrong]} {_LOOKS[wrong]}",
        when=lambda given: any(wrong != item.shows and wrong in item.options for item in given.diagrams),
    )
    def took_it(given: Given, work: Work) -> None:
        seen = [item.model_copy(update={"shows": wrong} if wrong in item.options else {}) for item in given.diagrams]
        solve(given.model_copy(update={"diagrams": seen}), work)

    return took_it


MISCONCEPTIONS = tuple(map(_took_it_for, BACKUPS))


def oracle(given: Given) -> Answers:
    """Named by what is drawn, not by what was to be drawn."""
    answers = []
    for item in given.diagrams:
        root = backup_diagram(item.shows, item.branches, item.steps).root
        answers.append(item.letters[_named(root)])
    return answers


def _named(root: Node) -> Backup:
    after = root.branches[0].node
    if len(root.branches) == 1 and root.kind == "state":
        length, last = 0, root
        while last.branches:
            length, last = length + 1, last.branches[0].node
        return "monte-carlo" if last.kind == "end" else "td-zero" if length == 2 else "n-step-td"
    if root.kind == "state":
        return "bellman-optimality-v" if root.maximum else "bellman-v"
    if len(root.branches) > 1:
        return "bellman-optimality-q" if after.maximum else "bellman-q"
    if len(after.branches) == 1:
        return "sarsa"
    return "q-learning" if after.maximum else "expected-sarsa"
