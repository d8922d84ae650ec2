"""The backup diagrams of the textbooks: what each equation and method looks back from."""

from typing import Literal, TypeAlias, get_args

from rldrill.problems.pictures import BackupDiagram, Branch, Node

Backup: TypeAlias = Literal[
    "bellman-v",
    "bellman-q",
    "bellman-optimality-v",
    "bellman-optimality-q",
    "td-zero",
    "n-step-td",
    "monte-carlo",
    "sarsa",
    "expected-sarsa",
    "q-learning",
]
BACKUPS: tuple[Backup, ...] = get_args(Backup)

#: How each is called in a question.
TITLES: dict[Backup, str] = {
    "bellman-v": "the Bellman equation for $V^π$",
    "bellman-q": "the Bellman equation for $Q^π$",
    "bellman-optimality-v": "the Bellman optimality equation for $V^*$",
    "bellman-optimality-q": "the Bellman optimality equation for $Q^*$",
    "td-zero": "TD(0)",
    "n-step-td": "n-step TD for state values, with $n > 1$",
    "monte-carlo": "the Monte Carlo method for state values",
    "sarsa": "Sarsa",
    "expected-sarsa": "Expected Sarsa",
    "q-learning": "Q-learning",
}


def legend(*, arcs: bool, ends: bool) -> str:
    """What a reader of such diagrams must know: of arcs and of ends of episodes, where there may be any."""
    arc = " An arc across branches takes their maximum." if arcs else ""
    end = " A grey square is the end of an episode." if ends else ""
    return f"In a backup diagram open circles are states and filled dots are actions.{arc}{end}"


def backup_diagram(backup: Backup, branches: int = 2, steps: int = 2, title: str = "") -> BackupDiagram:
    """The diagram of an equation or a method.

    Args:
        backup: which.
        branches: how many branches stand for all actions, or for all next states.
        steps: how long a run is drawn, where one is.
        title: what stands above it.
    """
    return BackupDiagram(_root(backup, branches, steps), title)


def _root(backup: Backup, branches: int, steps: int) -> Node:
    match backup:
        case "bellman-v" | "bellman-optimality-v":
            below = [_action(*[_state() for _ in range(branches)]) for _ in range(branches)]
            return _state(*below, maximum=backup == "bellman-optimality-v")
        case "bellman-q" | "bellman-optimality-q":
            best = backup == "bellman-optimality-q"
            nexts = [_state(*[_action() for _ in range(branches)], maximum=best) for _ in range(branches)]
            return _action(*nexts)
        case "td-zero":
            return _run(1, _state())
        case "n-step-td":
            return _run(steps, _state())
        case "monte-carlo":
            return _run(1, _state(_action(Node("end")), dots=True))
        case "sarsa":
            return _action(_state(_action()))
        case "expected-sarsa" | "q-learning":
            actions = [_action() for _ in range(branches + 1)]
            return _action(_state(*actions, maximum=backup == "q-learning"))


def _state(*below: Node, maximum: bool = False, dots: bool = False) -> Node:
    return Node("state", tuple(map(Branch, below)), maximum=maximum, dots=dots)


def _action(*below: Node) -> Node:
    return Node("action", tuple(map(Branch, below)))


def _run(steps: int, last: Node) -> Node:
    """A state from which so many steps lead to the last node."""
    for _ in range(steps):
        last = _state(_action(last))
    return last
