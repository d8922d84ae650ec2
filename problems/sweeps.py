"""Sweeps over all states of a model: what value iteration and policy evaluation have in common."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, joined
from rldrill.problems.exact import Exact
from rldrill.problems.family import Givens
from rldrill.problems.models import Model, Named, check_ends, check_keys, values_table

#: Outcomes that are averaged in all sweeps together: so many take seconds.
_MOST_OUTCOMES = 300_000
SYNCHRONOUS = "Sweeps are synchronous: each uses only the values of the sweep before."


def in_place(states: tuple[str, ...]) -> str:
    """The sentence that says in which order a sweep in place goes through the states."""
    return f"Sweeps are in place: the states are updated in the order {joined([*states])}, each with the newest values."


class Sweeps(Givens):
    """A model, how many sweeps, and the values to start from (0 where none are given)."""

    mdp: Model = Field(description="The Markov decision process.")
    sweeps: int = Field(ge=1, le=1000, description="How many sweeps.")
    start: Named[Exact] | None = Field(default=None, description="The values to start from; 0 without them.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        count = len(self.mdp.transitions)
        if self.sweeps * count > _MOST_OUTCOMES:
            raise ValueError(
                f"sweeps: {self.sweeps} sweeps over {count} transitions take too long; at most "
                f"{_MOST_OUTCOMES // count} are possible here"
            )
        if self.start is not None:
            check_keys(self.start, self.mdp.every_state, "the starting value", self.mdp.states)
            check_ends(self.start, self.mdp.terminal, "start: the value", "make it the reward for getting there")
        return self


def begin(given: Sweeps, method: str) -> tuple[Block, ...]:
    """Which values a method starts from."""
    if given.start is None:
        return (Paragraph(f"{method} starts from $V_0(s) = 0$ for all states."),)
    return (Paragraph(f"{method} starts from these values:"), values_table(given.start, "V_0"))


def counted(sweeps: int) -> str:
    """How many sweeps, in words."""
    return "one sweep" if sweeps == 1 else f"{sweeps} sweeps"
