"""The probabilities with which an ε-greedy policy takes its actions, also where best actions are tied."""

import re
from typing import Annotated, NamedTuple, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, OpenShare, Parameter, Probability, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Name
from rldrill.problems.names import once, read_name
from rldrill.problems.parts import Number, Part, Values
from rldrill.problems.phrases import exploration, in_open, not_known
from rldrill.problems.runs import action_values_table
from rldrill.problems.settings import draw_setting

TITLE = "ε-greedy policy"
SOURCE = "Sutton & Barto 2018, sections 2.2 and 5.4"
REVISION = 5

_MOVES = ("up", "right", "down", "left")


class Taken(NamedTuple):
    """An action, and the probability with which it is taken."""

    action: Name
    probability: Probability


class Given(Givens):
    """The action values of one state, ε, and what is asked: also the state's value, or ε itself from what it does."""

    state: Name = Field(default="s", description="The name of the state.")
    values: Annotated[dict[Name, Exact], Field(min_length=2, max_length=50), once(read_name)] = Field(
        description="The value of every action."
    )
    epsilon: OpenShare = Field(description="The probability to explore.")
    valued: bool = Field(
        default=False, description="Whether the value of the state under the policy is asked for, too."
    )

    taken: Taken | None = Field(
        default=None,
        description="An action and its probability, from which epsilon follows, which is left open.",
        examples=[["left", "3/4"]],
    )
    state_value: Exact | None = Field(
        default=None, description="The value of the state under the policy, from which epsilon follows."
    )

    @model_validator(mode="after")
    def _follows(self) -> Self:
        if self.taken and self.state_value is not None:
            raise ValueError("give either taken or state_value")
        if self.backwards and not self.left_open:
            raise ValueError("epsilon: leave it open, for it is asked for")
        if self.taken and self.taken.action not in self.values:
            raise ValueError(f"taken: {self.taken.action!r} has no value; add it")
        if self.state_value is not None and len(self.best) == len(self.values):
            raise ValueError("state_value: all actions are equally good, so the state is worth that for every ε")
        return self

    @property
    def backwards(self) -> bool:
        """Whether ε is asked for."""
        return self.taken is not None or self.state_value is not None

    def parameters(self) -> tuple[str, ...]:
        """The parameters that answers are expressions in: none where ε is asked for."""
        return () if self.backwards else self.left_open

    @property
    def best(self) -> tuple[str, ...]:
        """The actions whose value is the greatest."""
        greatest = max(self.values.values())
        return tuple(action for action, value in self.values.items() if value == greatest)


#: Exploration rates by the number of actions: the share of each action is a simple number.
_RATES = {
    2: ("1/5", "2/5", "1/2", "3/5", "4/5"),
    3: ("3/10", "3/5", "3/4", "1/2", "3/8"),
    4: ("2/5", "1/5", "1/2", "4/5", "3/5"),
}


#: What actions are worth: 0 would leave one of them out of the average.
_WORTH = tuple(Fraction(worth) for worth in range(-3, 10) if worth)


def draw(level: int, rng: Draws) -> Given:
    """Probabilities; then the state's value, or ε from a probability; then ε from the state's value."""
    count = 3 if level == 1 else rng.choice((2, 3, 4)[level - 2 :])
    if count < 4:
        setting = draw_setting(rng)
        state, actions = rng.choice(setting.states), setting.actions[:count]
    else:
        state, actions = f"r{1 + rng.below(4)}c{1 + rng.below(4)}", _MOVES
    epsilon = rng.fraction(*_RATES[count])
    values = dict(zip(actions, rng.shuffled(_WORTH)[:count], strict=True))
    if level > 1 and count > 2 and rng.chance(Fraction(1, 2) if level == 2 else Fraction(2, 3)):
        tied, greatest = rng.sample(actions, rng.choice(range(2, count))), int(max(values.values()))
        values = {a: Fraction(greatest) if a in tied else rng.nonzero(greatest - 5, greatest - 1) for a in actions}
    given = Given(state=state, values=values, epsilon=epsilon, valued=level == 2)
    if level == 3:
        mean = sum(values.values()) / count
        worth = (1 - epsilon) * max(values.values()) + epsilon * mean
        return given.model_copy(update={"epsilon": Parameter("epsilon"), "state_value": worth})
    if level == 2 and rng.chance(Fraction(1, 2)):
        chance = (1 - epsilon) / len(given.best) + epsilon / count
        taken = Taken(rng.choice(given.best), chance)
        return given.model_copy(update={"epsilon": Parameter("epsilon"), "taken": taken})
    return given


def _cell(state: str) -> str:
    """Where a cell of a grid lies that has its row and column for a name."""
    found = re.fullmatch(r"r(\d+)c(\d+)", state)
    return f" (row {found[1]}, column {found[2]} of a grid)" if found else ""


def question(given: Given) -> Question:
    """The action values and ε; the probability of every action, then what the state is worth."""
    tied = " Actions that are tied for the best share the greedy probability evenly." if len(given.best) > 1 else ""
    rate = exploration(given.epsilon)
    rate = not_known(rate) if given.taken or given.state_value is not None else rate
    blocks = (
        Paragraph(f"An agent in state {given.state}{_cell(given.state)} has these action values:"),
        action_values_table({given.state: given.values}),
        Paragraph(
            "It acts ε-greedily: with probability $1 − ε$ it takes the greedy action, with probability $ε$ one of all "
            f"its actions, each equally likely. {rate}{tied}"
        ),
    )
    where = f'"{given.state}"'
    taken_for = f"Take these action values for $Q^π${', whatever $ε$ is' if in_open(given) else ''}."
    valued = f"{taken_for} What is"
    every = f"With what probability $π(a|{where})$ is each action taken"
    chances = Values(f"π(·|{where})", tuple(given.values))
    if given.state_value is not None:
        worth = f"Take these action values for $Q^π$: then $V^π({where}) = {shown(given.state_value)}$."
        sought = Part(f"{worth} What is the exploration rate $ε$?", Number())
        return Question(blocks, (sought, Part(f"{every} with this $ε$?", chances)))
    if given.taken:
        action, chance = given.taken
        ask = f'It takes {action} with probability $π("{action}"|{where}) = {shown(chance)}$. What is $ε$?'
        asked = [Part(ask, Number())]
    else:
        asked = [Part(f"{every}{in_open(given)}?", chances)]
    if given.valued:
        with_it = " with this $ε$" if given.taken else ""
        asked.append(Part(f"{valued} $V^π({where})${with_it}{in_open(given)}?", Number()))
    return Question(blocks, tuple(asked))
