"""The λ-return of an episode, or of a run that is cut off, from its n-step returns."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discounts, Exact, OpenProbability, Parameter
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Name, values_table
from rldrill.problems.parts import Number, Numbers, Part
from rldrill.problems.phrases import check_one_open, discount, in_open, trace_parameter
from rldrill.problems.runs import ShortRun, check_values, cut_off, draw_episode, per_step, seen
from rldrill.problems.settings import draw_setting

TITLE = "λ-return"
SOURCE = "Sutton & Barto 2018, section 12.1"
REVISION = 1


class Given(Givens):
    """An episode, the current values, γ and λ, and the time from which the λ-return is asked.

    Instead of one discount there may be a list with one for every step. A run that is cut off, in a state that is not
    terminal, goes on with the value of that state.
    """

    trajectory: ShortRun = Field(description="The episode, or a run that is cut off.")
    values: dict[Name, Exact] = Field(description="The current value of every state.")
    gamma: Discounts
    lam: OpenProbability = Field(description="How much later returns count.")
    time: int = Field(default=0, ge=0, description="The time from which the return is asked for.", examples=[1])

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_values(self.values, self.trajectory)
        per_step(self.gamma, len(self.trajectory.rewards))
        check_one_open(self)
        if self.time >= len(self.trajectory.rewards):
            raise ValueError(f"time is {self.time}, but the run ends at {len(self.trajectory.rewards)}")
        return self

    @property
    def in_parts(self) -> bool:
        """Whether the returns that are averaged are a part of their own; they say nothing about an open λ."""
        return self.bootstraps and not isinstance(self.lam, Parameter)

    @property
    def bootstraps(self) -> bool:
        """Whether there are n-step returns before the end of the episode."""
        return self.steps_left > 1

    @property
    def steps_left(self) -> int:
        """The steps from the time asked for to the end."""
        return len(self.trajectory.rewards) - self.time


def draw(level: int, rng: Draws) -> Given:
    """An episode of two steps; then of three; then of four, with λ left open."""
    setting = draw_setting(rng)
    steps = level + 1
    states = rng.shuffled(setting.states)[:steps]
    return Given(
        trajectory=draw_episode(rng, states, setting.terminal),
        values={state: rng.nonzero(-4, 10) for state in setting.states if state in states},
        gamma=rng.fraction("1/2", "1") if level == 3 else rng.fraction("1/2", "4/5"),
        lam=Parameter("lambda") if level == 3 else rng.fraction("1/2", "1/4"),
    )


def question(given: Given) -> Question:
    """The returns that are averaged, then their average; in an open λ the average alone."""
    t = given.time
    blocks = (
        *seen(given.trajectory),
        Paragraph(f"The current values are these. {discount(given.gamma)} {trace_parameter(given.lam)}"),
        values_table(given.values),
        *cut_off(given.trajectory),
    )
    whole = "episode" if given.trajectory.ends else "run"
    average = f"What is the λ-return $R_{{{t}}}^{{(λ)}}$ of this {whole}{in_open(given)}?"
    if not given.in_parts:
        return Question(blocks, (Part(average, Number()),))
    entries = tuple(f"R_{{{t}}}^{{({n})}}" for n in range(1, given.steps_left + 1))
    if not given.trajectory.ends:
        ask = f"What are the n-step returns ${', '.join(entries)}$?"
        return Question(blocks, (Part(ask, Numbers(entries)), Part(average, Number())))
    entries = (*entries[:-1], f"R_{{{t}}}")
    shorter = [f"${entry}$" for entry in entries[:-1]]
    many = f"n-step returns {', '.join(shorter)}" if len(shorter) > 1 else f"one-step return {shorter[0]}"
    return Question(
        blocks,
        (
            Part(f"What are the {many} and the return ${entries[-1]}$?", Numbers(entries)),
            Part(average, Number()),
        ),
    )
