"""The value of a backup diagram's root, from the numbers that stand on the diagram."""

from collections.abc import Callable, Iterator, Sequence
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.backups import legend
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Open, Parameter, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Dynamics, Named, PolicyField, Transition, check_keys, check_policy
from rldrill.problems.parts import Number, Part
from rldrill.problems.phrases import discount, in_open
from rldrill.problems.pictures import BackupDiagram, Branch, Node
from rldrill.problems.reversible import Reversible, letter_asked, unknown
from rldrill.problems.valued import draw_values

TITLE = "Value of a backup diagram"
SOURCE = "Sutton & Barto 2018, sections 3.5 and 3.6"
REVISION = 3
#: Under an arc the chances of an action that is not the best do not matter, as long as it is not.
DISTRACTORS = ("dynamics.transitions.*.3",)
#: How many levels of states a diagram may have below its root.
DEEPEST = 3


class Given(Reversible):
    """A tree: what actions do, the values of its leaves, the policy or none where the best action counts.

    The root is the first state. Where ``action_values`` are given for the next states, the root is that
    state's one action, and its action value is asked for. Where ``known`` is the value of the root, what is left open
    is asked for.
    """

    dynamics: Dynamics = Field(description="What the actions of the tree do; the root is the first state.")
    policy: PolicyField | None = Field(default=None, description="The policy; without it the best action counts.")
    values: Named[Open] = Field(default={}, description="The values of the states that are leaves.")
    action_values: Named[Named[Open]] = Field(
        default={},
        description="The values of the actions that are leaves; then the root is the first state's one action.",
    )
    gamma: Discount

    @model_validator(mode="after")
    def _fits(self) -> Self:
        states = self.dynamics.states
        reached = tuple(dict.fromkeys(row.next for row in self.dynamics.transitions))
        if self.action_values:
            if len(self.dynamics.pairs) != 1:
                raise ValueError("dynamics must hold one action only where action_values are given")
            check_keys(self.action_values, reached, "the action values", needed=reached)
            if empty := [state for state, row in self.action_values.items() if not row]:
                raise ValueError(f"action_values: the actions of {empty[0]!r} are missing; add them")
            if self.values:
                raise ValueError("values and action_values cannot both be given; the leaves are of one kind")
        else:
            leaves = tuple(state for state in reached if state not in states)
            check_keys(self.values, leaves, "the value", needed=leaves)
            if max(self._depths(states[0], 0)) > DEEPEST:
                raise ValueError(f"dynamics: the tree must end after {DEEPEST} levels; a state leads back or too far")
        if self.policy is not None:
            self._check_policy(self.policy)
        return self

    def _check_policy(self, policy: PolicyField) -> None:
        if not self.action_values:
            check_policy(policy, self.dynamics)
            return
        choices = tuple(
            Transition(state, action, state, Fraction(1), Fraction(0))
            for state, row in self.action_values.items()
            for action in row
        )
        check_policy(policy, Dynamics(transitions=choices))

    def _depths(self, state: str, depth: int) -> Iterator[int]:
        if depth > DEEPEST or state not in self.dynamics.states:
            yield depth
            return
        for row in self.dynamics.transitions:
            if row.state == state:
                yield from self._depths(row.next, depth + 1)

    @property
    def root(self) -> tuple[str, str]:
        """The first state, and its first action."""
        return self.dynamics.pairs[0]

    @property
    def inner(self) -> tuple[str, ...]:
        """The states below the root that lead on, those farthest down first."""
        reached, more = set[str](), {row.next for row in self.dynamics.outcomes[self.root]}
        while more:
            reached |= more
            more = {row.next for row in self.dynamics.transitions if row.state in more} - reached
        below = [state for state in self.dynamics.states if state in reached]
        return tuple(sorted(below, key=lambda state: max(self._depths(state, 0))))

    @property
    def asked(self) -> str:
        """What is asked for, as mathematics."""
        above = "*" if self.policy is None else "π"
        state, action = self.root
        return f'Q^{above}("{state}", "{action}")' if self.action_values else f'V^{above}("{state}")'


#: Trees: each action of each state with where it may lead, beginning with the root, 0; leaves are what leads nowhere.
_TREES: dict[int, tuple[dict[tuple[int, str], tuple[int, ...]], ...]] = {
    1: ({(0, "a"): (1,), (0, "b"): (2,)},),
    2: (
        {(0, "a"): (1, 2), (0, "b"): (3,)},
        {(0, "a"): (1, 2), (0, "b"): (3, 4)},
        {(0, "a"): (1,), (0, "b"): (2,), (0, "c"): (3,)},
    ),
    3: (
        {(0, "a"): (1, 2), (0, "b"): (3,), (1, "a"): (4,), (1, "b"): (5,), (2, "a"): (6,), (2, "b"): (7,)},
        {(0, "a"): (1,), (0, "b"): (2, 3), (1, "a"): (4,), (1, "b"): (5, 6)},
        {(0, "a"): (1, 2), (1, "a"): (3,), (1, "b"): (4,), (2, "a"): (5,), (2, "b"): (6,)},
    ),
}


def draw(level: int, rng: Draws) -> Given:
    """Two actions from a state; then chances, too; then two levels of states, or a number to be found."""
    best = rng.chance(Fraction(1, 2))
    gamma = rng.fraction("1/2", "4/5")
    if level == 2 and rng.chance(Fraction(1, 2)):
        return _all_matters(lambda: _of_action(rng, gamma, best))
    if level < 3 or rng.chance(Fraction(1, 2)):
        tree = rng.choice(_TREES[level])
        return _all_matters(lambda: _of_state(rng, tree, gamma, best))
    if rng.chance(Fraction(1, 3)):  # the probability with which the root's first action is taken
        given = _all_matters(lambda: _of_state(rng, rng.choice(_TREES[2][:2]), gamma, False))
        policy = {"s": {"a": Parameter("p"), "b": Parameter("1-p")}}
        return given.model_copy(update={"policy": policy, "known": _value(given)})
    given = _all_matters(lambda: _of_state(rng, rng.choice(_TREES[3]), gamma, False))
    hidden = rng.choice(tuple(given.values))
    return given.model_copy(update={"values": given.values | {hidden: Parameter("x")}, "known": _value(given)})


def _named(number: int) -> str:
    return f"s{'₀₁₂₃₄₅₆₇'[number]}" if number else "s"


def _of_state(rng: Draws, tree: dict[tuple[int, str], tuple[int, ...]], gamma: Fraction, best: bool) -> Given:
    rows = []
    for (state, action), targets in tree.items():
        chances = rng.split(len(targets), (2, 4) if state == 0 else (2,)) if len(targets) > 1 else (Fraction(1),)
        for target, chance in zip(targets, chances, strict=True):
            rows.append(Transition(_named(state), action, _named(target), chance, _reward(rng)))
    inner = {state for state, _ in tree}
    leaves = [_named(target) for targets in tree.values() for target in targets if target not in inner]
    dynamics = Dynamics(transitions=tuple(rows))
    policy = None if best else {state: _chances(rng, actions) for state, actions in dynamics.actions.items()}
    return Given(dynamics=dynamics, policy=policy, values=draw_values(rng, tuple(leaves), gamma), gamma=gamma)


def _of_action(rng: Draws, gamma: Fraction, best: bool) -> Given:
    nexts = rng.choice((("s₁", "s₂"), ("s₁", "s₂"), ("s₁", "s₂", "s₃")))
    chances = rng.split(len(nexts), (2, 4))
    rows = tuple(
        Transition("s", "a", after, chance, _reward(rng)) for after, chance in zip(nexts, chances, strict=True)
    )
    leaves = {state: draw_values(rng, ("a", "b"), gamma) for state in nexts}
    policy = None if best else {state: _chances(rng, ("a", "b")) for state in nexts}
    return Given(dynamics=Dynamics(transitions=rows), policy=policy, action_values=leaves, gamma=gamma)


def _reward(rng: Draws) -> Fraction:
    return rng.nonzero(-4, 6)


def _chances(rng: Draws, actions: Sequence[str]) -> dict[str, Fraction | Parameter]:
    chances = rng.split(len(actions), (2, 4)) if len(actions) > 1 else (Fraction(1),)
    return dict(zip(actions, chances, strict=True))


def _all_matters(drawn: Callable[[], Given]) -> Given:
    """The first draw in which no two branches of a node are worth the same, nor two states that have branches."""
    while True:
        given = drawn()
        branches: list[list[Fraction]] = []
        _value(given, branches)
        leaves = [tuple(row.values()) for row in given.action_values.values()]
        if len(set(leaves)) == len(leaves) and all(len(set(row)) == len(row) for row in branches):
            return given


def _value(given: Given, branches: list[list[Fraction]] | None = None) -> Fraction:
    """The value of the root where nothing is left open.

    What the branches of every node are worth is put on a list, and what all states that have branches are worth.
    """
    seen: list[list[Fraction]] = [] if branches is None else branches
    inner: list[Fraction] = []
    seen.append(inner)

    def of_state(state: str) -> Fraction:
        if state in given.values:
            return Fraction(given.values[state])
        leaves = given.action_values.get(state)
        actions = leaves or given.dynamics.actions[state]
        worth = {a: Fraction(leaves[a]) if leaves else of_action(state, a) for a in actions}
        seen.append([*worth.values()])
        inner.append(
            max(worth.values())
            if given.policy is None
            else sum((Fraction(given.policy[state][a]) * each for a, each in worth.items()), Fraction(0))
        )
        return inner[-1]

    def of_action(state: str, action: str) -> Fraction:
        rows = given.dynamics.outcomes[state, action]
        after = [of_state(row.next) for row in rows]
        worth = [Fraction(row.reward) + Fraction(given.gamma) * each for row, each in zip(rows, after, strict=True)]
        seen.extend((after, worth))
        return sum((Fraction(row.probability) * each for row, each in zip(rows, worth, strict=True)), Fraction(0))

    return of_action(*given.root) if given.action_values else of_state(given.root[0])


def question(given: Given) -> Question:
    """The diagram with its numbers; the value of the root is asked for."""
    under = "under the policy $π$" if given.policy is not None else "under an optimal policy"
    leaves = "action" if given.action_values else "state"
    policy = "" if given.policy is None else "A branch to an action carries its probability under the policy $π$. "
    blocks = (
        Paragraph(legend(arcs=given.policy is None, ends=False)),
        Paragraph(
            f"{policy}A branch to a state carries its probability and its reward. Beneath each leaf stands the value "
            f"of this {leaves} {under}. {_letter_told(given)}{unknown(given, discount(given.gamma))}"
        ),
        diagram(given),
    )
    if given.known is not None:
        told = Paragraph(f"The value of the root is ${given.asked} = {shown(given.known)}$.")
        return Question((*blocks, told), (letter_asked(given),))
    return Question(blocks, (Part(f"What is ${given.asked}$, the value of the root{in_open(given)}?", Number()),))


def _letter_told(given: Given) -> str:
    return "The value $x$ is not known. " if given.known is not None and given.letter == "x" else ""


def diagram(given: Given) -> BackupDiagram:
    """The tree, drawn out."""
    root, action = given.root
    if given.action_values:
        return BackupDiagram(_action_node(given, root, action, f"${given.asked}$"))
    return BackupDiagram(_state_node(given, root, f"${given.asked}$"))


def _state_node(given: Given, state: str, label: str) -> Node:
    if state in given.values:
        return Node("state", label=f"${shown(given.values[state])}$")
    if state in given.action_values:
        worth = given.action_values[state]
        nodes = {action: Node("action", label=f"${shown(value)}$") for action, value in worth.items()}
    else:
        nodes = {action: _action_node(given, state, action, "") for action in given.dynamics.actions[state]}
    branches = tuple(Branch(node, _chance(given, state, action)) for action, node in nodes.items())
    return Node("state", branches, label, maximum=given.policy is None)


def _action_node(given: Given, state: str, action: str, label: str) -> Node:
    rows = given.dynamics.outcomes[state, action]
    return Node(
        "action",
        tuple(
            Branch(
                _state_node(given, row.next, f'$"{row.next}"$'), f"${shown(row.probability)}$, ${shown(row.reward)}$"
            )
            for row in rows
        ),
        label,
    )


def _chance(given: Given, state: str, action: str) -> str:
    return "" if given.policy is None else f"${shown(given.policy[state].get(action, Fraction(0)))}$"
