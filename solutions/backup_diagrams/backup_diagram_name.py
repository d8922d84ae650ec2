"""A diagram is named by its root, by whether it branches, by its arcs and by how far it reaches."""

from collections.abc import Callable

from msgspec.structs import replace

from rldrill.problems.backup_diagrams.backup_diagram_name import Changed, Drawn, Several
from rldrill.problems.backups import BACKUPS, TITLES, Backup, Change, backup_diagram
from rldrill.problems.pictures import Branch, Node
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


def solve(given: Several | Changed, work: Work) -> None:
    """One letter for every diagram; or what a diagram becomes, and what would make another one of it."""
    if isinstance(given, Changed):
        _solve_changed(given, work)
        return
    for item in given.diagrams:
        letter = item.letters[item.shows]
        work.say(f"The diagram {_LOOKS[item.shows]} So it is ({letter}), {TITLES[item.shows]}.")
        work.answer(letter)


def _looks(backup: Backup) -> str:
    """How its diagram looks, in a sentence; a title with an aside gets the comma that closes it."""
    title = TITLES[backup]
    return f"The diagram of {title}{',' * (',' in title)} {_LOOKS[backup]}"


def _solve_changed(given: Changed, work: Work) -> None:
    letter = given.letters[given.named]
    work.say(f"As it is drawn, it is that of {TITLES[given.shows]}. It {_LOOKS[given.shows]}")
    work.say(f"{_looks(given.named)} So with the change it is ({letter}).")
    work.answer(letter)
    (change,) = given.right_changes
    letter = given.letters_of_changes[change]
    work.say(_looks(given.target))
    work.say(f"The diagram has become that of {TITLES[given.named]}, so the further change is ({letter}).")
    work.answer(letter)


@slip(
    "change-overlooked",
    "That is the diagram as it is drawn; the question is what it shows after the change.",
    when=lambda given: isinstance(given, Changed) and given.shows in given.options,
)
def change_overlooked(given: Changed, work: Work) -> None:
    """As if nothing had been changed before the first question."""
    work.answer(given.letters[given.shows])
    work.answer(given.letters_of_changes[given.right_changes[0]])


def _took_it_for(wrong: Backup) -> Misconception:
    """The slip of taking every diagram for the same one, where that is offered."""

    @slip(
        f"took-it-for-{wrong}",
        f"{_NAMES[wrong]} {_LOOKS[wrong]}",
        when=lambda given: (
            isinstance(given, Several) and any(wrong != item.shows and wrong in item.options for item in given.diagrams)
        ),
    )
    def took_it(given: Several, work: Work) -> None:
        seen = [item.model_copy(update={"shows": wrong} if wrong in item.options else {}) for item in given.diagrams]
        solve(given.model_copy(update={"diagrams": seen}), work)

    return took_it


MISCONCEPTIONS = (*map(_took_it_for, BACKUPS), change_overlooked)


def oracle(given: Several | Changed) -> Answers:
    """Named by what is drawn, not by what was to be drawn; changes are made in the picture."""
    if isinstance(given, Several):
        return [item.letters[_named(_root(item))] for item in given.diagrams]
    changed = _with(given.change, _root(given), given.steps)
    (further,) = (
        letter
        for change, letter in given.letters_of_changes.items()
        if _shape(_with(change, changed, given.steps)) == _shape(_root(given, given.target))
    )
    return given.letters[_named(changed)], further


def _root(item: Drawn, shows: Backup | None = None) -> Node:
    return backup_diagram(shows or item.shows, item.branches, item.steps).root


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


def _with(change: Change, root: Node, several: int) -> Node:
    """The picture with something changed in it; where a run gets longer, it has so many steps."""
    match change:
        case "arc" | "no-arc":
            return _everywhere(root, lambda node: replace(node, maximum=change == "arc" and _is_choice(node)))
        case "one-state" | "all-states":
            return _everywhere(
                root, lambda node: _wide(node, change == "all-states") if node.kind == "action" else node
            )
        case "one-action" | "all-actions":
            return _everywhere(root, lambda node: _wide(node, change == "all-actions") if _is_last(node) else node)
        case "sampled" | "everything":
            return _everywhere(root, lambda node: _wide(node, change == "everything"))
        case "one-step" | "several-steps" | "to-the-end" if root.kind == "state" and len(root.branches) == 1:
            node = Node("end" if change == "to-the-end" else "state")
            for _ in range({"one-step": 1, "several-steps": several, "to-the-end": 2}[change]):
                node = Node("state", (Branch(Node("action", (Branch(node),))),))
            return node
        case _:
            return root


def _everywhere(node: Node, change: Callable[[Node], Node]) -> Node:
    return change(replace(node, branches=tuple(Branch(_everywhere(each.node, change)) for each in node.branches)))


def _wide(node: Node, several: bool) -> Node:
    """The node with one branch, or with at least two; no arc is left where there is one."""
    branches = node.branches if several and len(node.branches) > 1 else node.branches[:1] * (1 + several)
    return replace(node, branches=branches, maximum=node.maximum and several)


def _is_choice(node: Node) -> bool:
    return node.kind == "state" and len(node.branches) > 1


def _is_last(node: Node) -> bool:
    """Whether this is a state whose actions lead nowhere."""
    return node.kind == "state" and bool(node.branches) and not node.branches[0].node.branches


def _shape(node: Node) -> tuple[object, ...]:
    """What a picture shows, however many branches stand for all of them."""
    below = [_shape(each.node) for each in node.branches[:1]]
    return (node.kind, node.maximum, len(node.branches) > 1, *below)
