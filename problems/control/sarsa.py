"""The action values after Sarsa updates along a run of transitions."""

from typing import Annotated, Self

from pydantic import Tag, model_validator

from rldrill.problems.draws import Draws
from rldrill.problems.family import Question
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import in_open
from rldrill.problems.runs import (
    RUN_OR_MOVES,
    ActionMoves,
    ActionRun,
    AskErrors,
    Trajectory,
    action_values_table,
    after,
    errors_asked,
    run_blocks,
)
from rldrill.problems.settings import draw_setting

TITLE = "Sarsa"
SOURCE = "Sutton & Barto 2018, section 6.4"
REVISION = 1


class AlongRun(ActionRun):
    """A run with its actions, the last one too unless it ends; the action values before it, α and γ."""

    td_errors: AskErrors = False

    @model_validator(mode="after")
    def _bootstraps(self) -> Self:
        self.demand_last_action("Sarsa")
        return self


class Separate(ActionMoves):
    """Transitions that need not join, the action values before them, the step size and the discount."""

    td_errors: AskErrors = False

    @model_validator(mode="after")
    def _bootstraps(self) -> Self:
        self.demand_last_action("Sarsa")
        return self


Given = Annotated[Annotated[AlongRun, Tag("run")] | Annotated[Separate, Tag("transitions")], RUN_OR_MOVES]


def draw(level: int, rng: Draws) -> Given:
    """One transition; then three that come back to a pair; then four over three states to the end."""
    setting = draw_setting(rng)
    first, second, third = rng.shuffled(setting.states)[:3]
    choices = setting.actions[: 2 if level == 1 else 3]
    there, back, last = (rng.choice(choices) for _ in range(3))
    states, actions = {
        1: ((first, second), (there, back)),
        2: ((first, second, first, second), (there, back, there, last)),
        3: ((first, second, first, third, setting.terminal), (there, back, there, last)),
    }[level]
    named = [state for state in setting.states if state in states]
    values = {state: dict(zip(choices, rng.distinct(len(choices), -3, 9), strict=True)) for state in named}
    return AlongRun(
        trajectory=Trajectory(
            states=states,
            actions=actions,
            rewards=tuple(rng.nonzero(-4, 8) for _ in states[1:]),
            terminal=tuple(state for state in states if state == setting.terminal),
        ),
        values=values,
        alpha=rng.fraction("1/2", "1/4", "1/5"),
        gamma=rng.fraction("1/2", "4/5", "9/10"),
    )


def question(given: Given) -> Question:
    """The run and the table before it; all updated pairs are asked for."""
    pairs = given.updated
    asked = f'$Q("{pairs[0][0]}", "{pairs[0][1]}")$' if len(pairs) == 1 else "the value of every pair that is updated"
    return Question(
        run_blocks(given, action_values_table(given.values), "Sarsa"),
        (
            *([errors_asked(given)] if given.td_errors else []),
            Part(f"What is {asked} {after(given)}{in_open(given)}?", Values("Q", pairs)),
        ),
    )
