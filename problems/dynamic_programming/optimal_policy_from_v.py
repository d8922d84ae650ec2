"""The optimal policy of a model whose optimal state values are known."""

from collections.abc import Set
from typing import Literal, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Probability
from rldrill.problems.family import Givens, Question, flag
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Model, Name, Named, check_state_values, model_blocks, values_table
from rldrill.problems.parts import Number, Part, Policy, Values
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Shape, draw_setting
from rldrill.problems.valued import UNITS, check_optimal_values, draw_valued, worth

TITLE = "Optimal policy given V"
SOURCE = "Sutton & Barto 2018, section 3.6"
REVISION = 5


class Given(Givens):
    """A model, its optimal values (they may be rounded, as books print them), and the discount."""

    mdp: Model = Field(description="The Markov decision process.")
    values: Named[Exact] = Field(description="The optimal value of every state; it may be rounded.")
    gamma: Probability = Field(description="The discount.")
    action_values: bool = flag("Whether the values of all actions are asked for first.")
    missing: Name | None = Field(default=None, description="A state whose value is left out, and asked for first.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.missing is not None and (self.missing not in self.mdp.states or self.missing in self.values):
            raise ValueError(f"missing: {self.missing!r} must be a state of the model without a value in values")
        if self.missing is not None and self.gamma == 1:
            raise ValueError("missing: with a discount of 1 one equation need not give a value; choose a smaller one")
        known = self.values if self.missing is None else {**self.values, self.missing: Fraction(0)}
        check_state_values(known, self.mdp)
        if not self.parameters():
            check_optimal_values(self._whole(), self.mdp, self.gamma)
        return self

    def own_letters(self) -> Set[str]:
        """Besides those left open the letter x that stands for the missing value."""
        return super().own_letters() | ({"x"} if self.missing is not None else set())

    def _whole(self) -> dict[str, Fraction]:
        """All values, with the one that follows from the others: that of an action which may lead back, x = a + γpx."""
        if self.missing is None:
            return self.values
        best = max(
            worth(self.mdp, (self.missing, action), self.values, self.gamma)
            / (1 - self.gamma * self._back(self.missing, action))
            for action in self.mdp.actions[self.missing]
        )
        return {**self.values, self.missing: best}

    def _back(self, state: str, action: str) -> Fraction:
        rows = self.mdp.outcomes[state, action]
        return sum((Fraction(row.probability) for row in rows if row.next == state), Fraction(0))


def draw(level: int, rng: Draws) -> Given:
    """Two states whose moves are certain; then moves that are not, or three states; then a value is missing."""
    gamma = rng.choice(tuple(UNITS)[:level])
    states = 2 if level == 1 else 2 + rng.below(2)
    actions = 3 if states == 2 else 2
    shape = Shape(states=states, actions=actions, branches=min(level, 2), denominators=(2,))
    forked: Literal["all", "others"] = "others" if level == 2 else "all"
    mdp, policy, values, _ = draw_valued(rng, draw_setting(rng), shape, gamma, (-6, -1), forked=forked)
    if level == 1 and not _looks_ahead(mdp, policy, values):
        return draw(level, rng)
    missing = None
    if level == 3:
        missing = rng.choice(mdp.states)
        del values[missing]
    return Given(mdp=mdp, values=values, gamma=gamma, action_values=True, missing=missing)


def _looks_ahead(mdp: Model, policy: dict[str, str], values: dict[str, Fraction]) -> bool:
    """Whether neither the rewards alone nor the next values alone, of moves that are certain, show the policy."""
    rows = {(row.state, row.action): row for row in mdp.transitions}
    next_values = {pair: values.get(row.next, Fraction(0)) for pair, row in rows.items()}
    rewards = {pair: Fraction(row.reward) for pair, row in rows.items()}
    return all(
        any(by[s, policy[s]] < max(by[s, a] for a in actions) for s, actions in mdp.actions.items())
        for by in (rewards, next_values)
    )


def question(given: Given) -> Question:
    """The model and its optimal values; an action is asked for in every state."""
    told = "The optimal values are known."
    if given.missing is not None:
        told = f"The optimal values are known, except that of {given.missing}."
    blocks = (
        *model_blocks(given.mdp),
        Paragraph(f"{told} {discount(given.gamma)}"),
        values_table(given.values, "V^*"),
    )
    parts = []
    if given.missing is not None:
        parts.append(Part(f'What is $V^*("{given.missing}")$?', Number()))
    if given.action_values:
        parts.append(Part("What is $Q^*(s, a)$ for every state and action?", Values("Q^*", given.mdp.pairs)))
    return Question(
        blocks, (*parts, Part("Which action $π^*(s)$ is optimal in every state?", Policy(given.mdp.actions, "π^*")))
    )
