"""The λ-return of an episode, or of a run that is cut off, from its n-step returns."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discounts, Open, OpenShare, Parameter, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.models import Named, values_table
from rldrill.problems.parts import Number, Numbers, Part
from rldrill.problems.phrases import check_one_open, discount, in_open, trace_parameter
from rldrill.problems.reversible import Reversible, letter_asked, unknown
from rldrill.problems.runs import ShortRun, check_values, cut_off, draw_whole, per_step, readable, seen, told_apart
from rldrill.problems.settings import draw_visits

TITLE = "λ-return"
SOURCE = "Sutton & Barto 2018, section 12.1"
REVISION = 5
#: The table gives the value of every state, that of the start too: which of them count is a part of the question.
DISTRACTORS = ("values.*",)


class Given(Reversible):
    """An episode, the current values, γ and λ, and the time from which the λ-return is asked.

    Instead of one discount there may be a list with one for every step. A run that is cut off, in a state that is not
    terminal, goes on with the value of that state. Where ``known`` is the λ-return, what is left open is asked for.
    """

    trajectory: ShortRun = Field(description="The episode, or a run that is cut off.")
    values: Named[Open] = Field(description="The current value of every state.")
    gamma: Discounts
    lam: OpenShare = Field(description="How much later returns count.")
    time: int = Field(default=0, ge=0, description="The time from which the return is asked for.", examples=[1])

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_values(self.values, self.trajectory.states, self.trajectory.terminal)
        per_step(self.gamma, len(self.trajectory.rewards))
        check_one_open(self)
        if self.time >= len(self.trajectory.rewards):
            raise ValueError(
                f"time is {self.time}, but the run ends at {len(self.trajectory.rewards)}; choose an earlier time"
            )
        return self

    @property
    def in_parts(self) -> bool:
        """Whether the returns that are averaged are a part of their own; they say nothing about an open λ."""
        return self.bootstraps and not isinstance(self.lam, Parameter) and self.known is None

    @property
    def bootstraps(self) -> bool:
        """Whether there are n-step returns before the end of the episode."""
        return self.steps_left > 1

    @property
    def steps_left(self) -> int:
        """The steps from the time asked for to the end."""
        return len(self.trajectory.rewards) - self.time


_DECAYS = (Fraction(1, 2), Fraction(1, 4), Fraction(3, 4))


def draw(level: int, rng: Draws) -> Given:
    """An episode of two steps; then three steps, to the end or cut off; then a letter left open, or to be found."""
    gamma = rng.fraction("1/2", "4/5", "3/4")
    lam = rng.choice([each for each in _DECAYS if each != gamma])
    if level == 1:
        return _matters(rng, gamma, lam, "ab.")
    longer = "abc.", "abcd", "aba.", "abb."
    if level == 2:
        return _matters(rng, gamma, lam, *longer)
    kind = rng.below(4)
    if kind == 3:
        given = _matters(rng, gamma, lam, "ab.", "abc")
        return given.model_copy(update={"lam": Parameter("lambda"), "known": _average(given)})
    given = _matters(rng, gamma, lam, *longer)
    if kind == 2:
        return given.model_copy(
            update={"values": given.values | {given.trajectory.states[1]: Parameter("x")}, "known": _average(given)}
        )
    return given.model_copy(update={"lam": Parameter("lambda")})


def _matters(rng: Draws, gamma: Fraction, lam: Fraction, *visits: str) -> Given:
    """A run with one of these orders of visits, whose λ-return depends on γ and λ."""
    setting, states = draw_visits(rng, *visits)
    while True:
        run, values = draw_whole(rng, states, setting.terminal, gamma)
        given = Given(trajectory=run, values=values, gamma=gamma, lam=lam)
        if (
            told_apart(run, values)
            and readable((_average(given),))
            and all(
                _average(given) != _average(given.model_copy(update={name: Fraction(0)})) for name in ("gamma", "lam")
            )
        ):
            return given


def _average(given: Given) -> Fraction:
    """The λ-return of a run in which nothing is left open, backwards in time."""
    run, lam = given.trajectory, Fraction(given.lam)
    V = {state: Fraction(value) for state, value in given.values.items()}
    worth = V.get(run.states[-1], Fraction(0))
    for after, reward in zip(reversed(run.states), reversed(run.rewards), strict=False):
        worth = reward + fraction_of(str(given.gamma)) * ((1 - lam) * V.get(after, Fraction(0)) + lam * worth)
    return worth


def question(given: Given) -> Question:
    """The returns that are averaged, then their average; in an open λ the average alone."""
    t = given.time
    letter = "The value $x$ is left open." if "x" in given.letters else ""
    told = f"These are the current values. {discount(given.gamma)} {trace_parameter(given.lam)} {letter}"
    blocks = (
        *seen(given.trajectory),
        Paragraph(unknown(given, told).strip()),
        values_table(given.values),
        *cut_off(given.trajectory),
    )
    whole = "episode" if given.trajectory.ends else "run"
    average = f"What is the λ-return $R_{{{t}}}^{{(λ)}}$ of this {whole}{in_open(given)}?"
    if given.known is not None:
        told = f"The λ-return of this {whole} is $R_{{{t}}}^{{(λ)}} = {shown(given.known)}$."
        return Question((*blocks, Paragraph(told)), (letter_asked(given),))
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
