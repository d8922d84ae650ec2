"""The expected return of a policy, from a start distribution and a small tree of chances."""

from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, Scalar, shown
from rldrill.problems.family import Question
from rldrill.problems.models import (
    Model,
    ModelAndPolicy,
    OpenDistributionField,
    PolicyField,
    Transition,
    check_keys,
    check_sum,
    model_blocks,
    policy_blocks,
)
from rldrill.problems.parts import Number, Part
from rldrill.problems.phrases import discount, in_open
from rldrill.problems.settings import draw_setting

TITLE = "Expected return"
SOURCE = "Sutton & Barto 2018, sections 3.3 and 3.5"
REVISION = 1

_MOST = 200


class Episode(NamedTuple):
    """What happens from a start to an end."""

    start: str
    transitions: tuple[Transition, ...]


class Given(ModelAndPolicy):
    """A start distribution, a model in which every episode ends soon, a policy and the discount.

    Without a policy every action is equally probable.
    """

    start: OpenDistributionField = Field(min_length=1, description="The probability of every state to start in.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_keys(self.start, self.mdp.states, "the start probability", needed=())
        check_sum(self.start.values(), "start: the probabilities")
        for count, _ in enumerate(self.episodes(), 1):
            if count > _MOST:
                raise ValueError(f"mdp: there are more than {_MOST} different episodes; that is no small tree")
        return self

    @property
    def chooses(self) -> bool:
        """Whether the policy leaves something to chance."""
        return any(chance not in (0, 1) for row in self.chances.values() for chance in row.values())

    def episodes(self) -> Iterator[Episode]:
        """Every episode that can happen, in the order of the tables.

        Raises:
            ValueError: a state can come again, so that episodes have no greatest length.
        """
        for start, chance in self.start.items():
            if chance != 0:
                yield from (Episode(start, rows) for rows in self._onward(start, ()))

    def _onward(self, state: str, before: tuple[Transition, ...]) -> Iterator[tuple[Transition, ...]]:
        if state in self.mdp.terminal:
            yield before
            return
        if any(row.state == state for row in before):
            raise ValueError(f"mdp: {state!r} can come again in an episode, so this is no tree of chances")
        for action in self.mdp.actions[state]:
            if self.chances[state].get(action, 0) != 0:
                for row in self.mdp.outcomes[state, action]:
                    if row.probability != 0:
                        yield from self._onward(row.next, (*before, row))


def draw(level: int, rng: Draws) -> Given:
    """Two starts and one action in each; then a choice of two actions; then its probability left open."""
    setting = draw_setting(rng)
    first, second, third = setting.states[:3]
    end = setting.terminal
    denominators = (2,) if level == 1 else (2, 4, 5)
    if level == 1:
        branches = [(first, 0, (second, end)), (second, 0, (end,))]
        starts = (first, second)
    else:
        branches = [(first, 0, (second, third)), (first, 1, (third, end)), (second, 0, (end,)), (third, 0, (end,))]
        starts = (first, third) if level == 2 else (first, second)
    rows = tuple(
        Transition(state, setting.actions[action], after, chance, rng.nonzero(-4, 9))
        for state, action, targets in branches
        for after, chance in zip(
            targets, rng.split(len(targets), denominators) if len(targets) > 1 else (Fraction(1),), strict=True
        )
    )
    mdp = Model(story=setting.story, transitions=rows, terminal=(end,))
    return Given(
        start=dict(zip(starts, rng.split(2, (2, 4, 5)), strict=True)),
        mdp=mdp,
        policy=_policy(level, rng, mdp),
        gamma=rng.fraction("1/2") if level == 1 else rng.fraction("1/2", "4/5", "9/10"),
    )


def _policy(level: int, rng: Draws, mdp: Model) -> PolicyField:
    chances: tuple[Scalar, ...] = (Parameter("p"), Parameter("1-p")) if level == 3 else rng.split(2, (2, 4, 5))
    return {
        state: dict(zip(actions, chances if len(actions) > 1 else (Fraction(1),), strict=True))
        for state, actions in mdp.actions.items()
    }


def question(given: Given) -> Question:
    """The start, the model and the policy; one number is asked for."""
    if len(given.start) == 1:
        start: list[Block] = [Paragraph(f"Every episode starts in {next(iter(given.start))}.")]
    else:
        start = [
            Paragraph("An episode starts in one of these states, with these probabilities:"),
            Table(
                header=("$s$", *given.start),
                rows=(("$Pr(s_0 = s)$", *(f"${shown(chance)}$" for chance in given.start.values())),),
            ),
        ]
    blocks = (*model_blocks(given.mdp), *start, *policy_blocks(given), Paragraph(discount(given.gamma)))
    ask = f"What is the expected return $𝔼_π(R_0)${in_open(given)}?"
    return Question(blocks, (Part(ask, Number()),))
