"""Semi-gradient TD(0) or Sarsa: the weights of a linear value after one or more transitions."""

from collections.abc import Iterator
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, joined
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Exact, Parameter, StepSize, dot
from rldrill.problems.family import Givens, Question
from rldrill.problems.features import FeatureVector, check_features, features_table, weight_names, weights
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Named, Names, check_keys
from rldrill.problems.parts import Numbers, Part
from rldrill.problems.phrases import discount, in_open, step_size
from rldrill.problems.runs import Trajectory, trajectory_table
from rldrill.problems.settings import draw_setting, draw_visits, draw_way, in_order

TITLE = "Semi-gradient TD"
SOURCE = "Sutton & Barto 2018, sections 9.3 and 10.1"
REVISION = 6


class Given(Givens):
    """A run, the features of its states, the weights, α and γ.

    With ``actions`` named, their weights are stacked in this order and Sarsa is asked for; without, TD(0).
    """

    trajectory: Trajectory = Field(description="What the agent did.")
    features: Named[FeatureVector] = Field(description="The features of every state.")
    theta: tuple[Exact, ...] = Field(
        min_length=1,
        max_length=40,
        description="The weights before the run; with actions a block for each, in their order.",
    )
    actions: Names = Field(
        default=(), description="The actions in the order of their weights, for Sarsa; without them it is TD(0)."
    )
    alpha: StepSize = Field(description="The step size.")
    gamma: Discount

    @model_validator(mode="after")
    def _fits(self) -> Self:
        run = self.trajectory
        states = tuple(dict.fromkeys(run.states))
        needed = tuple(state for state in states if state not in run.terminal)
        check_keys(self.features, needed, "the row of features", needed=needed)
        blocks = max(1, len(self.actions))
        if len(self.theta) % blocks:
            raise ValueError(
                f"theta: {len(self.theta)} weights cannot be shared among {blocks} actions; give as many for each"
            )
        check_features(self.features, len(self.theta) // blocks)
        if self.actions:
            self._check_actions()
        return self

    def _check_actions(self) -> None:
        run = self.trajectory
        if len(set(self.actions)) < len(self.actions):
            raise ValueError("actions: one is named twice; keep one of them")
        ended = run.states[-1] in run.terminal
        if len(run.actions) != len(run.states) - ended:
            raise ValueError(
                "trajectory: Sarsa needs the action taken in every state, the last one too unless it is terminal"
            )
        for action in run.actions:
            if action not in self.actions:
                raise ValueError(f"trajectory: {action!r} is taken but has no block of weights; name it in actions")


#: Weights at level 2: half an estimate is whole.
_EVEN = (Fraction(-4), Fraction(-2), Fraction(2), Fraction(4))
#: The order of visits of a run at level 2; the features of each state; and whether it is Sarsa.
_RUNS: tuple[tuple[str, int, bool], ...] = (
    ("ab.", 3, False), ("aba", 2, False), ("abc", 2, False), ("ab", 2, True), ("ab", 3, True),
)  # fmt: skip
#: The same at level 3, where a state comes again.
_RETURNS = (("aba", 2, True), ("aba", 3, True), ("aab", 2, True))


def draw(level: int, rng: Draws) -> Given:
    """One step of TD(0); then two of them, or one of Sarsa; then two of Sarsa, the step size left open."""
    visits, size, sarsa = ("ab", 2, False) if level == 1 else rng.choice(_RUNS if level == 2 else _RETURNS)
    if sarsa:  # a state sees the same action again, so the first step counts in the second
        setting = draw_setting(rng)
        choices = setting.actions[:2]
        states, taken = draw_way(rng, setting, visits, choices, same=True)
    else:
        (setting, states), choices, taken = draw_visits(rng, visits), (), ()
    named = in_order(states)
    given = Given(
        trajectory=Trajectory(
            states=states,
            actions=taken,
            rewards=tuple(rng.nonzero(-4, 8) for _ in states[1:]),
            terminal=tuple(state for state in states if state == setting.terminal),
        ),
        features={state: tuple(rng.whole(0, 2) for _ in range(size)) for state in named},
        theta=tuple(
            rng.choice(_EVEN) if level == 2 else rng.nonzero(-3, 4) for _ in range(size * max(1, len(choices)))
        ),
        actions=choices,
        alpha=Parameter("alpha") if level == 3 else rng.fraction("1/2", "1/4", "1/5" if len(states) == 2 else "1/2"),
        gamma=rng.fraction("1/2", "1/2", "1"),
    )
    used = all(map(any, given.features.values())) and all(map(any, zip(*given.features.values(), strict=True)))
    told_apart = len(set(given.features.values())) == len(given.features)
    return given if used and told_apart and all(_matters(given)) else draw(level, rng)


def _matters(given: Given) -> Iterator[Fraction]:
    """The TD errors, and the estimates and weights that γ stands with: none is 0, or something given would not count.

    With the step size left open these are those of the first step only.
    """
    run, theta = given.trajectory, list(given.theta)
    gamma = Fraction(1) if isinstance(given.gamma, Parameter) else given.gamma
    size = len(theta) // max(1, len(given.actions))

    def block(time: int) -> slice:
        first = given.actions.index(run.actions[time]) * size if given.actions else 0
        return slice(first, first + size)

    def estimate(time: int) -> Fraction:
        state = run.states[time]
        return Fraction(0) if state in run.terminal else dot(theta[block(time)], given.features[state])

    for time, reward in enumerate(run.rewards):
        error = reward + gamma * estimate(time + 1) - estimate(time)
        yield error
        if run.states[time + 1] not in run.terminal:
            yield estimate(time + 1)
            yield from theta[block(time + 1)]
        if isinstance(given.alpha, Parameter):
            return
        rows = zip(theta[block(time)], given.features[run.states[time]], strict=True)
        theta[block(time)] = [weight + given.alpha * error * feature for weight, feature in rows]


def question(given: Given) -> Question:
    """The run, features and weights; the TD errors and the new weights are asked for."""
    run = given.trajectory
    size = len(given.theta) // max(1, len(given.actions))
    steps = len(run.rewards)
    if given.actions:
        method = "Semi-gradient Sarsa"
        model = (
            "Action values are estimated as $Q̂(s, a) = θ^⊤ f(s, a)$. In $f(s, a)$ the features $φ(s)$ below are "
            f"stacked, one block for each action, in the order {joined(list(given.actions))}; the blocks of the other "
            "actions are $0$."
        )
    else:
        method = "Semi-gradient TD(0)"
        model = "Values are estimated as $V̂(s) = θ^⊤ φ(s)$, with these features:"
    ends: tuple[Block, ...] = ()
    if run.states[-1] in run.terminal:
        ends = (Paragraph(f"The episode ends in the terminal state {run.states[-1]}, whose value is always $0$."),)
    when = "after the transition" if steps == 1 else "after every transition"
    blocks = (
        Paragraph("An agent follows this trajectory (each reward stands at the time at which it is received):"),
        trajectory_table(run),
        *ends,
        Paragraph(model),
        features_table(given.features, what="s", of="φ", about="s"),
        Paragraph(
            f"Initially the weights are ${weights(given.theta)}$. {method} updates them {when}. "
            f"{step_size(given.alpha)} {discount(given.gamma)}"
        ),
    )
    errors = tuple(f"δ_{{{time}}}" for time in range(steps))
    which = "is the TD error" if steps == 1 else "are the TD errors"
    first = f"What {which} ${', '.join(errors)}${in_open(given)}?"
    learnt = "after the transition" if steps == 1 else "after the last transition"
    second = f"What are the weights $θ$ {learnt}{in_open(given)}?"
    names = weight_names(range(size * max(1, len(given.actions))))
    return Question(blocks, (Part(first, Numbers(errors)), Part(second, Numbers(names))))
