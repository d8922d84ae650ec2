"""The greedy policy of action values that are linear in features; or the weight at which it changes."""

from itertools import combinations
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Open, Parameter, dot, shown
from rldrill.problems.family import AskedFor, Question
from rldrill.problems.features import ActionFeatures, action_features_table, check_action_features, weights
from rldrill.problems.fractions import Fraction
from rldrill.problems.parts import Part, Policy, Values
from rldrill.problems.settings import Setting, draw_setting

TITLE = "Linear policy"
SOURCE = "Sutton & Barto 2018, section 10.1"
REVISION = 6


class Given(AskedFor):
    """The weights θ, and the features of every action in some states.

    One weight may be the letter w: then it is asked where the greedy action of each state changes with it, and which
    actions are greedy at ``at``.
    """

    theta: tuple[Open, ...] = Field(min_length=1, max_length=20, description="The weights; one of them may be w.")
    features: ActionFeatures = Field(min_length=1, description="For every state the features of its actions.")
    at: Exact | None = Field(default=None, description="A value of w at which the policy is asked for.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_action_features(self.features, len(self.theta))
        opened = [weight for weight in self.theta if isinstance(weight, Parameter)]
        if opened not in ([], ["w"]):
            raise ValueError("theta: only one weight may be left open, and it is called w")
        if bool(opened) != (self.at is not None):
            raise ValueError("at: give it where one of the weights is w, and only there")
        for state, rows in self.features.items():
            if opened and len(rows) != 2:
                raise ValueError(f"features: the greedy action changes once in {state!r} only if it has two actions")
        return self

    @property
    def numbers(self) -> tuple[Fraction, ...]:
        """The weights, w with the number at which the policy is asked for."""
        return tuple((self.at or Fraction(0)) if isinstance(weight, Parameter) else weight for weight in self.theta)


def draw(level: int, rng: Draws) -> Given:
    """One state with two actions; then several; then the weight at which the greedy action changes in each state."""
    setting = draw_setting(rng)
    if level == 3:
        return _changing(rng, setting)
    count, width, size = (1, 2, 2) if level == 1 else rng.choice(((2, 3, 2), (3, 2, 2), (2, 2, 3), (2, 3, 3)))
    theta = tuple(rng.nonzero(-3, 4) for _ in range(size))
    features = {
        state: {action: tuple(rng.whole(-1, 4) for _ in range(size)) for action in setting.actions[:width]}
        for state in rng.sample(setting.states, count)
    }
    given = Given(theta=theta, features=features)
    return given if _telling(given) else draw(level, rng)


def _telling(given: Given) -> bool:
    """Whether every weight counts by itself, no action's features are a multiple of another's, and no action is greedy
    everywhere.
    """
    best = [max(row, key=lambda action: dot(given.numbers, row[action])) for row in given.features.values()]
    columns = [*zip(*(features for row in given.features.values() for features in row.values()), strict=True)]
    apart = all(
        any(a * d != b * c for (a, c), (b, d) in combinations(zip(one, other, strict=True), 2))
        for row in given.features.values()
        for one, other in combinations(row.values(), 2)
    )
    counts = all(map(any, columns)) and len(set(columns)) == len(columns)
    return apart and counts and (len(best) == 1 or len(set(best)) > 1)


def _changing(rng: Draws, setting: Setting) -> Given:
    """In every state first the weight at which both actions are worth the same, then features that give it."""
    size, place = rng.choice(((2, 0), (2, 1), (3, 1)))
    fixed = [rng.nonzero(-3, 4) for _ in range(size)]
    features = {}
    edges = []
    for state in rng.sample(setting.states, rng.choice((2, 3))):
        slope = rng.choice((1, -1)) * rng.whole(2, 5)
        lead = [rng.nonzero(-4, 4) for _ in range(size)]  # of the first action over the second, feature by feature
        lead[place] = slope
        edges.append(
            -sum(weight * more for index, (weight, more) in enumerate(zip(fixed, lead, strict=True)) if index != place)
            / slope
        )
        second = [rng.whole(-2, 3) for _ in range(size)]
        first = tuple(low + more for low, more in zip(second, lead, strict=True))
        features[state] = dict(zip(setting.actions, (first, tuple(second)), strict=False))
    theta = (*fixed[:place], Parameter("w"), *fixed[place + 1 :])
    at = rng.fraction("-3/2", "-1/2", "1/2", "3/2", "5/2")
    if len(set(edges)) < len(edges) or {at, 0} & set(edges):  # nobody guesses 0
        return _changing(rng, setting)
    given = Given(theta=theta, features=features, at=at)
    return given if _telling(given) else _changing(rng, setting)


def question(given: Given) -> Question:
    """Weights and features; first the values of all actions, then the policy; or where it changes."""
    pairs = tuple((state, action) for state, row in given.features.items() for action in row)
    actions = {state: tuple(row) for state, row in given.features.items()}
    blocks = (
        Paragraph("An agent estimates action values as $Q̂(s, a) = θ^⊤ f(s, a)$, with these features:"),
        action_features_table(given.features),
        Paragraph(f"The weights are ${weights(given.theta)}$. The policy $π$ is greedy in $Q̂$."),
    )
    which = "Which action is greedy in each state" if len(actions) > 1 else "Which action is greedy"
    if given.at is None:
        return Question(
            blocks,
            (
                Part("What is $Q̂(s, a)$ of every action?", Values("Q̂", pairs), zero=True),
                Part(f"{which}?", Policy(actions)),
            ),
        )
    where = "For which weight $w(s)$ do both actions have the same value in the state $s$?"
    return Question(
        blocks,
        (
            Part(where if len(actions) > 1 else "For which $w$ do both actions have the same value?",
                 Values("w", tuple(actions))),
            Part(f"{which} if $w = {shown(given.at)}$?", Policy(actions)),
        ),
    )  # fmt: skip
