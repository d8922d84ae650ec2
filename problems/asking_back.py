"""Runs whose updates stay readable, and questions that ask back: for the step size or the discount, from a value."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import accumulate
from typing import Annotated, Any, NamedTuple, Self

from pydantic import Field, model_validator

from rldrill.problems.document import begun
from rldrill.problems.draws import Draws
from rldrill.problems.exact import PARAMETERS, Exact, Parameter, shown
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.models import Name
from rldrill.problems.parts import Number, Part, Values
from rldrill.problems.phrases import in_open
from rldrill.problems.runs import (
    ActionMove,
    ActionMoves,
    ActionRun,
    ActionUpdates,
    Trajectory,
    after,
    draw_action_run,
    errors_asked,
)
from rldrill.problems.settings import Setting, draw_moves

Rows = dict[str, dict[str, Fraction]]


#: What a next state is worth to the target, by its action values and the action taken there.
Worth = Callable[[Mapping[str, Fraction], str], Fraction]


class Outcome(NamedTuple):
    """What a pair of state and action is worth in the end."""

    state: Name
    action: Name
    value: Exact


_Ending = Annotated[
    Outcome | None,
    Field(
        description="A state, an action and its value in the end, from which the one number that is left open is asked "
        "for.",
        examples=[["A", "left", "3/2"]],
    ),
]


class AskingBack(ActionUpdates):
    """Updates with α and γ; or with one of them left open, and a value in the end from which it follows."""

    FOUND_BY = "outcome"

    outcome: _Ending = None

    @model_validator(mode="after")
    def _follows(self) -> Self:
        if self.outcome and self.outcome[:2] not in self.updated:
            pair = f"({self.outcome.state}, {self.outcome.action})"
            raise ValueError(f"outcome: {pair} is not updated, so nothing follows from it; name one that is")
        if self.outcome and len(self.left_open) != 1:
            raise ValueError("outcome: leave one number open, such as alpha, which is asked for then")
        return self

    @property
    def moved(self) -> tuple[tuple[str, str], ...]:
        """The pairs whose values the run changes."""
        return self.updated

    @property
    def asks_back(self) -> bool:
        """Whether what is left open is asked for."""
        return self.outcome is not None

    @property
    def asked_for(self) -> str:
        """The parameter that is asked for."""
        return "".join(self.left_open)


class BackRun(AskingBack, ActionRun):
    """A run with its action values."""


class BackMoves(AskingBack, ActionMoves):
    """Transitions that need not join, with the action values before them."""


class Update(NamedTuple):
    """What an update reads and gives: the worth of the next state, the TD error, and the new value."""

    ahead: Fraction
    gap: Fraction
    value: Fraction


class Rates(NamedTuple):
    """A step size and a discount, and the unit of which action values are multiples, so that updates are readable."""

    alpha: Fraction
    gamma: Fraction
    unit: int


def draw_rates(rng: Draws) -> Rates:
    """Rates whose products with the values have small denominators, also after two updates.

    They differ: where they are equal, a person who exchanges them is not found out.
    """
    alpha, gamma, unit = rng.choice(
        (("1/4", "1/2", 4), ("1/2", "1/4", 4), ("1/2", "3/4", 4), ("1/2", "4/5", 5), ("1/2", "2/5", 5))
    )
    return Rates(fraction_of(alpha), fraction_of(gamma), unit)


def readable(
    rows: Rows, moves: Iterable[ActionMove], terminal: tuple[str, ...], alpha: Fraction, gamma: Fraction, worth: Worth
) -> bool:
    """Whether every update changes a value, and to a number that is easily read."""
    return all(
        gap != 0 and value.denominator <= 100 and abs(value.numerator) <= 300
        for _, gap, value in updates(rows, moves, terminal, alpha, gamma, worth)
    )


def updates(
    rows: Rows, moves: Iterable[ActionMove], terminal: tuple[str, ...], alpha: Fraction, gamma: Fraction, worth: Worth
) -> Iterator[Update]:
    """The updates that moves make, one after the other, with the values that are current then."""
    values = {state: {**row} for state, row in rows.items()}
    for state, action, entered, reward, following in moves:
        ahead = Fraction(0) if entered in terminal else worth(values[entered], following or "")
        gap = reward + gamma * ahead - values[state][action]
        values[state][action] += alpha * gap
        yield Update(ahead, gap, values[state][action])


def updates_of(found: Mapping[str, Any], worth: Worth) -> list[Update]:
    """The updates of a run that was drawn with all its numbers."""
    run: Trajectory = found["trajectory"]
    moves = map(ActionMove, run.states, run.actions, run.states[1:], run.rewards, (*run.actions[1:], None))
    return [*updates(found["values"], moves, run.terminal, found["alpha"], found["gamma"], worth)]


def draw_forward(
    rng: Draws, visits: str, count: int, worth: Worth, rates: Callable[[Draws], Rates] = draw_rates
) -> dict[str, Any]:
    """A run with its action values, α and γ: no TD error is 0, and no value hard to read.

    Args:
        rng: the stream of choices.
        visits: the order of visits, as ``draw_action_run`` takes it.
        count: how many actions there are.
        worth: what a next state is worth to the target, by its action values and the action taken there.
        rates: what draws α and γ.
    """
    alpha, gamma, unit = rates(rng)
    run, table = draw_action_run(rng, visits, count, same=True)
    rows = draw_rows(rng, tuple(table), tuple(next(iter(table.values()))), unit)
    following = (*run.actions[1:], None)
    moves = list(map(ActionMove, run.states, run.actions, run.states[1:], run.rewards, following))
    if not readable(rows, moves, run.terminal, alpha, gamma, worth):
        return draw_forward(rng, visits, count, worth, rates)
    return {"trajectory": run, "values": rows, "alpha": alpha, "gamma": gamma}


def draw_rows(rng: Draws, states: Sequence[str], actions: tuple[str, ...], unit: int) -> Rows:
    """Different multiples of a unit, none 0, for every action of a state."""
    most = max(3, 10 // unit)
    worth = [unit * number for number in range(-(most // 3), most + 1) if number]
    return {
        state: dict(zip(actions, map(Fraction, rng.shuffled(worth)[: len(actions)]), strict=True)) for state in states
    }


def draw_back(rng: Draws, setting: Setting, count: int, worth: Worth, sought: str, *, steps: int = 1) -> dict[str, Any]:
    """Givens with a value from which a parameter follows: a run of one step, or two transitions from the same pair.

    Args:
        rng: the stream of choices.
        setting: the world.
        count: how many actions there are.
        worth: what a next state is worth to the target, by its action values and the action taken there.
        sought: the parameter.
        steps: how many transitions update the pair; after two of them α is no longer in a linear equation.
    """
    actions = setting.actions[:count]
    named, (action,) = draw_moves(rng, setting, (("a", "bc"[:steps]),), actions)
    state, *others = (named[letter] for letter in "abc"[: steps + 1])
    alpha = rng.fraction("1/2", "1/4", "3/4", "1/5", "2/5", "3/5")
    gamma = rng.fraction(*(each for each in ("1/2", "1/4", "3/4", "1/5", "2/5", "4/5") if fraction_of(each) != alpha))
    rows = draw_rows(rng, [name for name in setting.states if name in (state, *others)], actions, gamma.denominator)
    following = [rng.choice([name for name in actions if rows[other][name] < max(rows[other].values())])
                 for other in others]  # fmt: skip
    ahead = [worth(rows[other], after) for other, after in zip(others, following, strict=True)]
    gaps = [rng.nonzero(-2, 3) * alpha.denominator for _ in others]
    reached = list(accumulate(gaps, lambda value, gap: value + alpha * gap, initial=rows[state][action]))
    rewards = [value + gap - gamma * there for value, gap, there in zip(reached, gaps, ahead, strict=False)]
    if reached[-1] == reached[0] or any(reward.denominator > 1 or abs(reward) > 20 for reward in rewards):
        return draw_back(rng, setting, count, worth, sought, steps=steps)
    end = reached[-1]
    if end not in rows[state].values() and rng.chance(Fraction(1, 2)):
        rows[state][rng.choice([name for name in actions if name != action])] = end
    rates: dict[str, Any] = {"alpha": alpha, "gamma": gamma} | {sought: Parameter(sought)}
    if steps > 1:
        moves = tuple(ActionMove(state, action, *rest) for rest in zip(others, rewards, following, strict=True))
        return {"transitions": moves, "values": rows, "outcome": Outcome(state, action, end), **rates}
    run = Trajectory(states=(state, *others), actions=(action, *following), rewards=tuple(rewards))
    return {"trajectory": run, "values": rows, "outcome": Outcome(state, action, end), **rates}


def rival(given: AskingBack, outcome: Outcome, table: Rows) -> str | None:
    """An action of the state that is as good in the end, and is not updated, if there is one."""
    state, action, value = outcome
    others = (other for other, worth in table[state].items() if other != action and worth == value)
    return next((other for other in others if (state, other) not in given.moved), None)


def back_asked(given: AskingBack, outcome: Outcome, table: Rows, of: str = "Q") -> Part:
    """The part that asks for what is left open, by its value or by an action that is as good in the end.

    Args:
        given: the run.
        outcome: what a pair is worth in the end.
        table: the action values in which the pair is updated, before the run.
        of: how they are called.
    """
    state, action, value = outcome
    sought = f"{_CALLED.get(given.asked_for, 'value of')} ${PARAMETERS[given.asked_for]}$"
    if other := rival(given, outcome, table):
        pair = f'${of}("{state}", "{action}")$ and ${of}("{state}", "{other}")$'
        return Part(f"For which {sought} are {pair} equal {after(given)}?", Number())
    ask = f'{begun(after(given))} ${of}("{state}", "{action}") = {shown(value)}$. What is the {sought}?'
    return Part(ask, Number())


def pairs_asked(given: BackRun | BackMoves, *, errors: bool = False) -> tuple[Part, ...]:
    """What is asked of updated action values: the number that is left open, or the value of every updated pair.

    Args:
        given: the run.
        errors: whether the TD errors are asked for first.
    """
    if given.outcome:
        return (back_asked(given, given.outcome, given.values),)
    pairs = given.updated
    asked = f'$Q("{pairs[0][0]}", "{pairs[0][1]}")$' if len(pairs) == 1 else "the value of every updated pair"
    values = Part(f"What is {asked} {after(given)}{in_open(given)}?", Values("Q", pairs))
    return (errors_asked(given), values) if errors else (values,)


#: What is asked for, by its parameter.
_CALLED = {"alpha": "step size", "gamma": "discount", "lambda": "trace parameter", "epsilon": "exploration rate"}
