"""The value of a backup diagram's root, from the numbers that stand on the diagram."""

from collections.abc import Iterator
from fractions import Fraction
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.backups import LEGEND
from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Exact, Parameter, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Dynamics, Name, PolicyField, Transition, check_keys, check_policy
from rldrill.problems.parts import Number, Part
from rldrill.problems.phrases import discount, in_open
from rldrill.problems.pictures import BackupDiagram, Branch, Node

TITLE = "Value of a backup diagram"
SOURCE = "Sutton & Barto 2018, sections 3.5 and 3.6"
REVISION = 1
#: How many levels of states a diagram may have below its root.
DEEPEST = 3


class Given(Givens):
    """A tree: what actions do, the values of its leaves, the policy or none where the best action counts.

    The root is the first state. Where ``action_values`` are given for the next states, the root is that
    state's one action, and its action value is asked for.
    """

    dynamics: Dynamics = Field(description="What the actions of the tree do; the root is the first state.")
    policy: PolicyField | None = Field(default=None, description="The policy; without it the best action counts.")
    values: dict[Name, Exact] = Field(default={}, description="The values of the states that are leaves.")
    action_values: dict[Name, dict[Name, Exact]] = Field(
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
                raise ValueError(f"action_values: the actions of {empty[0]!r} are missing")
            if self.values:
                raise ValueError("values and action_values cannot both be given; the leaves are of one kind")
        else:
            leaves = tuple(state for state in reached if state not in states)
            check_keys(self.values, leaves, "the value", needed=leaves)
            if max(self._depths(states[0], 0), default=0) > DEEPEST:
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
        below = [state for state in self.dynamics.states if state != self.root[0]]
        return tuple(sorted(below, key=lambda state: max(self._depths(state, 0))))

    @property
    def asked(self) -> str:
        """What is asked for, as mathematics."""
        above = "*" if self.policy is None else "π"
        state, action = self.root
        return f'Q^{above}("{state}", "{action}")' if self.action_values else f'V^{above}("{state}")'


def draw(level: int, rng: Draws) -> Given:
    """Two actions from a state; then an action with two next states and their actions; then two levels of states."""
    best = rng.chance(Fraction(1, 2))
    gamma = rng.fraction("1/2", "4/5", "9/10")
    if level == 1:
        rows = tuple(
            Transition("s", action, after, Fraction(1), _reward(rng)) for action, after in (("a", "s₁"), ("b", "s₂"))
        )
        values = dict(zip(("s₁", "s₂"), rng.distinct(2, -4, 9), strict=True))
        policy = None if best else {"s": _chances(rng)}
        return Given(dynamics=Dynamics(transitions=rows), policy=policy, values=values, gamma=gamma)
    if level == 2:
        nexts = ("s₁", "s₂")
        rows = _outcomes(rng, "s", "a", nexts)
        leaves = {state: dict(zip("ab", rng.distinct(2, -4, 9), strict=True)) for state in nexts}
        policy = None if best else {state: _chances(rng) for state in nexts}
        return Given(dynamics=Dynamics(transitions=rows), policy=policy, action_values=leaves, gamma=gamma)
    middle = ("s₁", "s₂", "s₃")
    rows = (*_outcomes(rng, "s", "a", middle[:2]), Transition("s", "b", "s₃", Fraction(1), _reward(rng)))
    leaves_ = {}
    for index, state in enumerate(middle):
        for number, action in enumerate("ab"):
            leaf = f"s{'₄₅₆₇₈₉'[2 * index + number]}"
            rows += (Transition(state, action, leaf, Fraction(1), _reward(rng)),)
            leaves_[leaf] = rng.nonzero(-4, 9)
    policy = None if best else {state: _chances(rng) for state in ("s", *middle)}
    return Given(dynamics=Dynamics(transitions=rows), policy=policy, values=leaves_, gamma=gamma)


def _reward(rng: Draws) -> Fraction:
    return rng.nonzero(-4, 6)


def _chances(rng: Draws) -> dict[str, Fraction | Parameter]:
    return dict(zip("ab", rng.split(2, (2, 4)), strict=True))


def _outcomes(rng: Draws, state: str, action: str, nexts: tuple[str, ...]) -> tuple[Transition, ...]:
    chances = rng.split(len(nexts), (2, 4))
    return tuple(
        Transition(state, action, after, chance, _reward(rng)) for after, chance in zip(nexts, chances, strict=True)
    )


def question(given: Given) -> Question:
    """The diagram with its numbers; the value of the root is asked for."""
    under = "under the policy" if given.policy is not None else "under an optimal policy"
    leaves = "action" if given.action_values else "state"
    policy = "" if given.policy is None else "Beside a branch to an action stands the policy's probability of it. "
    blocks = (
        Paragraph(LEGEND),
        Paragraph(
            f"{policy}Beside a branch to a state stand the probability to go there and the reward for it; "
            f"beneath each leaf stands the value of that {leaves} {under}. {discount(given.gamma)}"
        ),
        diagram(given),
    )
    return Question(blocks, (Part(f"What is ${given.asked}$, the value of the root{in_open(given)}?", Number()),))


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
