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

#: What may be changed in a diagram.
Change: TypeAlias = Literal[
    "arc",
    "no-arc",
    "one-state",
    "all-states",
    "one-action",
    "all-actions",
    "sampled",
    "everything",
    "one-step",
    "several-steps",
    "to-the-end",
]
CHANGES: tuple[Change, ...] = get_args(Change)

#: What is done to the diagram, in a question.
DONE: dict[Change, str] = {
    "arc": "an arc is drawn across the branches from each state",
    "no-arc": "every arc is left out",
    "one-state": "of the next states only the one that was reached is drawn",
    "all-states": "all possible next states are drawn, not only the one that was reached",
    "one-action": "of the actions at the bottom only the one that was taken is drawn",
    "all-actions": "all actions of the next state are drawn, not only the one that was taken",
    "sampled": "at every node only the branch that was sampled is drawn",
    "everything": "all actions and all next states are drawn, not only those that were sampled",
    "one-step": "the run stops after one step, in a state where the episode goes on",
    "several-steps": "the run stops after several steps, in a state where the episode goes on",
    "to-the-end": "the run goes on to the end of the episode",
}

#: What each diagram becomes by a change; where it becomes none of these diagrams, the change is left out.
CHANGED: dict[Backup, dict[Change, Backup]] = {
    "bellman-v": {"arc": "bellman-optimality-v", "sampled": "td-zero"},
    "bellman-q": {"arc": "bellman-optimality-q", "one-state": "expected-sarsa", "sampled": "sarsa"},
    "bellman-optimality-v": {"no-arc": "bellman-v", "sampled": "td-zero"},
    "bellman-optimality-q": {"no-arc": "bellman-q", "one-state": "q-learning", "sampled": "sarsa"},
    "td-zero": {"everything": "bellman-v", "several-steps": "n-step-td", "to-the-end": "monte-carlo"},
    "n-step-td": {"one-step": "td-zero", "to-the-end": "monte-carlo"},
    "monte-carlo": {"one-step": "td-zero", "several-steps": "n-step-td"},
    "sarsa": {"all-actions": "expected-sarsa", "everything": "bellman-q"},
    "expected-sarsa": {
        "arc": "q-learning", "all-states": "bellman-q", "everything": "bellman-q", "one-action": "sarsa",
        "sampled": "sarsa",
    },
    "q-learning": {
        "no-arc": "expected-sarsa", "all-states": "bellman-optimality-q", "everything": "bellman-optimality-q",
        "one-action": "sarsa", "sampled": "sarsa",
    },
}  # fmt: skip


def legend(*, arcs: bool, ends: bool) -> str:
    """What a reader of such diagrams must know: of arcs and of ends of episodes, where there may be any."""
    arc = " An arc across branches takes their maximum." if arcs else ""
    end = " A square is a terminal state; a dotted line stands for steps that are left out." if ends else ""
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
