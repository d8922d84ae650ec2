"""The worth of one step of another policy, and whether the policy improvement theorem applies to it."""

from collections.abc import Sequence
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Probability, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import (
    DeterministicField,
    Model,
    Named,
    Transition,
    check_policy,
    check_state_values,
    model_blocks,
)
from rldrill.problems.parts import Part, Values, YesNo
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Shape, draw_setting
from rldrill.problems.valued import (
    UNITS,
    check_policy_values,
    deterministic,
    draw_values,
    draw_worth,
    known_or_asked,
)

TITLE = "Policy improvement theorem"
SOURCE = "Sutton & Barto 2018, section 4.2"
REVISION = 6


class Given(Givens):
    """A model, two deterministic policies, the discount, and the first one's values, or None to ask for them."""

    mdp: Model = Field(description="The Markov decision process.")
    policy: DeterministicField = Field(description="The action of the first policy in every state.")
    other: DeterministicField = Field(description="The action of the other policy in every state.")
    values: Named[Exact] | None = Field(
        default=None, description="The first policy's values; without them they are asked for first."
    )
    gamma: Probability = Field(description="The discount.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        for policy in (self.policy, self.other):
            check_policy(deterministic(policy), self.mdp)
        if self.values is not None:
            check_state_values(self.values, self.mdp)
            if not self.parameters():
                check_policy_values(self.values, deterministic(self.policy), self.mdp, self.gamma)
        return self

    @property
    def pairs(self) -> tuple[tuple[str, str], ...]:
        """Every state with what the other policy does there."""
        return tuple((state, self.other[state]) for state in self.mdp.states)


def draw(level: int, rng: Draws) -> Given:
    """Two states whose moves are certain; then moves that are not; then the values are asked for, too.

    The other policy is better in every state in which it does something else; or in all of them but one. A state in
    which both do the same has no other action.
    """
    gamma = rng.choice(tuple(UNITS)[level == 3 : min(level + 1, 3)])
    count = 2 if level == 1 else 2 + rng.below(2)
    shape = Shape(states=count, actions=2, branches=min(level, 2), denominators=(2, 4) if level < 3 else (2,))
    setting = draw_setting(rng)
    values = draw_values(rng, setting.states[:count], gamma)
    kept = rng.choice((*values,)) if level > 1 and rng.chance(Fraction(1, 2)) else None
    worse = rng.choice([state for state in values if state != kept]) if rng.chance(Fraction(1, 2)) else None
    pair = setting.actions[:2]
    policy = {state: rng.choice(pair) for state in values}
    other = {state: policy[state] if state == kept else pair[policy[state] == pair[0]] for state in values}
    worths = {}
    for state, value in values.items():
        gain = rng.whole(1, 4)
        for action in pair:
            if action == policy[state]:
                worths[state, action] = value
            elif action == other[state]:
                worths[state, action] = value - gain if state == worse else value + gain
    own = [] if level == 3 else [*policy.items()]
    rows = draw_worth(rng, setting, shape, gamma, values, worths, own).transitions
    if level == 2 and count == 2 and all(row.probability == 1 for row in rows):
        return draw(level, rng)  # that would be level 1
    ends = (setting.terminal,) if _reached(rows, setting.terminal) else ()
    return Given(
        mdp=Model(story=setting.told(ends), transitions=rows, terminal=ends),
        policy=policy,
        other=other,
        values=None if level == 3 else values,
        gamma=gamma,
    )


def _reached(rows: tuple[Transition, ...], state: str) -> bool:
    return any(row.next == state for row in rows)


def question(given: Given) -> Question:
    """The model and both policies in one table, with the values of the first or asking for them."""
    _, asked = known_or_asked(given.values, given.mdp.states)
    rows: list[tuple[str, Sequence[str]]] = [("π(s)", list(given.policy.values()))]
    if given.values is not None:
        rows.append(("V^π(s)", [f"${shown(given.values[state])}$" for state in given.policy]))
    rows.append(("π'(s)", [given.other[state] for state in given.policy]))
    known = "" if given.values is None else ", its values $V^π$"
    blocks = (
        *model_blocks(given.mdp),
        Paragraph(f"{discount(given.gamma)} A policy $π${known} and another policy $π'$ are:"),
        Table(header=("$s$", *given.policy), rows=tuple((f"${left}$", *cells) for left, cells in rows)),
    )
    parts = (
        *asked,
        Part("What is $Q^π(s, π'(s))$ in every state?", Values("Q^π", given.pairs)),
        Part("Does the policy improvement theorem show that $π'$ is at least as good as $π$?", YesNo()),
    )
    return Question(blocks, tuple(parts))
