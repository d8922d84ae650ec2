"""One-step actor-critic: the TD error, the critic's values and the actor's weights after one or more transitions."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, joined
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Logarithm, Parameter, StepSize, Weight, shown
from rldrill.problems.family import Question
from rldrill.problems.features import ActionFeatures, weight_names
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Named, values_table
from rldrill.problems.parts import Numbers, Part, Values
from rldrill.problems.phrases import discount, in_open, step_size, terminal_note
from rldrill.problems.runs import check_values, trajectory_table
from rldrill.problems.settings import Setting, draw_setting, draw_way
from rldrill.problems.softmax import (
    SoftmaxRun,
    draw_even_policy,
    draw_log_policy,
    draw_run,
    is_even,
    policy_blocks,
    told_apart,
)

TITLE = "Actor-critic"
SOURCE = "Sutton & Barto 2018, section 13.5"
REVISION = 9

#: The actor's chances are softmaxes of weights that hold softmaxes; deeper ones fill pages.
_DEEPEST = 3


class Given(SoftmaxRun):
    """A run, the critic's values before it with its step size α, the actor's features and weights with β, and γ."""

    values: Named[Exact] = Field(description="The critic's value of every state before the run.")
    alpha: StepSize = Field(description="The step size of the critic.")
    beta: StepSize = Field(description="The step size of the actor.")

    @model_validator(mode="after")
    def _valued(self) -> Self:
        check_values(self.values, self.trajectory.states, self.trajectory.terminal)
        if (deepest := max(self._depths)) > _DEEPEST:
            raise ValueError(
                f"trajectory: the weights of {deepest} steps would stand in each other's exponents, {_DEEPEST} can be "
                "written exactly; take a shorter run, or features that share no weight between the states"
            )
        return self

    @property
    def _depths(self) -> tuple[int, ...]:
        """For every step how many updates, itself included, its chances are built on, one in the other's exponent."""
        depths: dict[int, int] = {}  # of the weights, by their places
        found = []
        for state in self.trajectory.states[:-1]:
            rows = tuple(self.features[state].values())
            touched = [place for place, column in enumerate(zip(*rows, strict=True)) if len(set(column)) > 1]
            found.append(1 + max((depths.get(place, 0) for place in touched), default=0))
            depths.update(dict.fromkeys(touched, found[-1]))
        return tuple(found)

    @property
    def visited(self) -> tuple[str, ...]:
        """The states that are left, in the order of their first visit."""
        return tuple(dict.fromkeys(self.trajectory.states[:-1]))


def draw(level: int, rng: Draws) -> Given:
    """One transition and even chances; then weights that are logarithms; then two transitions, α left open."""
    setting = draw_setting(rng)
    actions = setting.actions[: 3 if level == 2 else 2]
    states, taken = draw_way(rng, setting, "aba" if level == 3 else "ab", actions)
    first, second, *_ = states
    theta: tuple[Weight, ...]
    if level == 3:
        theta, features = _weights_of_their_own(rng, (first, second), actions)
    else:
        theta, features = (draw_even_policy if level == 1 else draw_log_policy)(rng, (first,), actions)
        if not told_apart(features) or (level == 2 and (is_even(theta, features) or len(set(theta)) == 1)):
            return draw(level, rng)  # of 2 and 2 the sum would be the product
    given = Given(
        trajectory=draw_run(rng, states, taken, setting.terminal),
        theta=theta,
        features=features,
        values={
            state: 2 * rng.nonzero(-2, 4) if level == 2 and state == second else rng.nonzero(-3, 8)
            for state in _in_order(setting, states)
        },
        alpha=Parameter("alpha") if level == 3 else rng.fraction("1/2", "1/5", "1/10"),
        beta=rng.fraction("1/2", "1/4", "1/3" if level == 3 else "1/2") if level > 1 else rng.fraction("1/2", "1/4"),
        gamma=rng.fraction("1/2", "1/2", "4/5") if level == 3 else rng.fraction("1/2", "1"),
    )
    return given if _first_error(given) != 1 else draw(level, rng)  # or nobody would see it forgotten


def _first_error(given: Given) -> Fraction:
    """The first TD error, of a run in which nothing is left open but perhaps the step size."""
    state, after, *_ = given.trajectory.states
    ahead = Fraction(given.gamma) * Fraction(given.values.get(after, 0))
    return Fraction(given.trajectory.rewards[0]) + ahead - Fraction(given.values[state])


def _in_order(setting: Setting, states: tuple[str, ...]) -> list[str]:
    return [state for state in setting.states if state in states]


def _weights_of_their_own(
    rng: Draws, states: tuple[str, ...], actions: tuple[str, ...]
) -> tuple[tuple[Weight, ...], ActionFeatures]:
    """A weight for every state and action: then a step in one state leaves the policy of the others alone."""
    size = len(states) * len(actions)
    places = iter(range(size))
    features = {
        state: {
            action: tuple(Fraction(index == place) for index in range(size))
            for action, place in zip(actions, places, strict=False)
        }
        for state in states
    }
    weights: list[Weight] = []
    for _ in states:  # one action is twice or three times as likely as the others
        likely = rng.choice(actions)
        weights += [Logarithm(f"ln {rng.choice((2, 3))}") if action == likely else Fraction(0) for action in actions]
    return tuple(weights), features


def question(given: Given) -> Question:
    """The run, the critic and the actor before it; then their errors, values and weights."""
    run = given.trajectory
    steps = len(run.rewards)
    errors = tuple(f"δ_{{{time}}}" for time in range(steps))
    several = steps > 1
    pace = step_size(given.alpha).replace("The step size", "The critic's step size")
    learning = (
        "After every transition the TD error $δ_t$ is computed from the current values; then the critic and the actor "
        "are both updated with it. The actor's score $∇_θ log π(a_t|s_t)$ is that of its current weights."
        if several
        else "After the transition the TD error $δ_0$ is computed; then critic and actor are both updated with it."
    )
    factor = "" if given.gamma == 1 else "; its step has no further factor $γ^t$"
    blocks = (
        Paragraph(
            "An actor-critic agent follows this trajectory (each reward stands at the time at which it is received):"
        ),
        trajectory_table(run),
        *terminal_note(run.terminal),
        Paragraph("The critic's initial values are:"),
        values_table(given.values),
        *policy_blocks(given.features, given.theta),
        Paragraph(f"{learning} {pace} The actor's is $β = {shown(given.beta)}${factor}. {discount(given.gamma)}"),
    )
    values = (
        f'What is the critic\'s value $V("{given.visited[0]}")$'
        if len(given.visited) == 1
        else f"What are the critic's values of {joined(list(given.visited))}"
    )
    which = "are the TD errors" if several else "is the TD error"
    ending = in_open(given)
    return Question(
        blocks,
        (
            Part(f"What {which} ${', '.join(errors)}${ending}?", Numbers(errors)),
            Part(f"{values} after the run{ending}?", Values("V", given.visited), zero=True),
            Part(f"What are the actor's weights $θ$ after the run{ending}?", Numbers(weight_names(given.theta))),
        ),
    )
