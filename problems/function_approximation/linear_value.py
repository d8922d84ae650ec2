"""Action values that are linear in features, with one block of weights for every action; or where two are equal."""

from collections.abc import Iterator, Set
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.centres import (
    Centred,
    asked_features,
    centres_table,
    check_line,
    draw_on_a_line,
    feature_names,
    place,
    tents,
)
from rldrill.problems.document import Document, Paragraph, joined
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Open, Parameter, shown
from rldrill.problems.family import AskedFor, Question
from rldrill.problems.features import FeatureVector, weights
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Name, Names
from rldrill.problems.parts import Number, Numbers, Part, Policy, Values
from rldrill.problems.settings import Setting, draw_setting

TITLE = "Linear action values"
SOURCE = "Sutton & Barto 2018, section 10.1"
REVISION = 5


class Bumps(Centred):
    """Piecewise linear basis functions, and the state whose features they give.

    Without the state it is asked for: between the two centres, where both actions are worth the same.
    """

    width: Exact = Field(gt=0, description="The distance from its centre at which a feature reaches 0, above 0.")

    @model_validator(mode="after")
    def _between(self) -> Self:
        if self.position is None:
            check_line(self.centres)
            if len(self.centres) != 2 or not 0 < self.centres[1][0] - self.centres[0][0] <= self.width:
                raise ValueError(
                    "position: it can only be found between two centres, the left one first, within the width"
                )
        return self


class Given(AskedFor):
    """The weights, block by block; the actions in the order of the blocks; and the features of the state.

    The features are given as they are, or as those of a state by piecewise linear basis functions. One weight may be
    the letter w: then it is asked from which w on its action is greedy.
    """

    theta: tuple[Open, ...] = Field(
        min_length=1, max_length=40, description="The weights, a block for every action; one of them may be w."
    )
    actions: Names = Field(min_length=2, description="The actions in the order of the blocks.")
    features: FeatureVector | None = Field(default=None, description="The features of the state; instead of bumps.")
    bumps: Bumps | None = Field(
        default=None, description="The state with basis functions that give its features; instead of features."
    )
    action: Name | None = Field(
        default=None, description="The action whose stacked vector is asked for, if any.", examples=["stay"]
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.features is None) == (self.bumps is None):
            raise ValueError("give either features or bumps")
        if len(set(self.actions)) < len(self.actions):
            raise ValueError("actions: one is named twice; keep one of them")
        if self.action is not None and self.action not in self.actions:
            raise ValueError(f"action: {self.action!r} is not among the actions; name one that is")
        if len(self.theta) != self.size * len(self.actions):
            needed = f"{self.size}·{len(self.actions)} = {self.size * len(self.actions)}"
            raise ValueError(
                f"theta: there is a weight for every feature and action, here {needed}, not {len(self.theta)}"
            )
        self._check_sought()
        return self

    def _check_sought(self) -> None:
        opened = [weight for weight in self.theta if isinstance(weight, Parameter)]
        if opened not in ([], ["w"]):
            raise ValueError("theta: only one weight may be left open, and it is called w")
        if opened and (self.features is None or self.features[self.theta.index(opened[0]) % self.size] <= 0):
            raise ValueError("theta: the feature that belongs to w must be given, and above 0")
        if self.between and len(self.actions) != 2:
            raise ValueError("bumps: without the position there must be two actions")
        if self.action is not None and (opened or self.between):
            raise ValueError("action: its vector is only asked for where nothing is to be found")

    @property
    def size(self) -> int:
        """How many features a state has."""
        return len(self.features or ()) if self.bumps is None else len(self.bumps.centres)

    @property
    def between(self) -> bool:
        """Whether a state between two centres is to be found."""
        return self.bumps is not None and self.bumps.position is None

    def own_letters(self) -> Set[str]:
        """Besides those left open the letter x of what is asked for."""
        return super().own_letters() | ({"x"} if self.between else set())

    @property
    def raised(self) -> str | None:
        """The action with the weight w, if there is one."""
        places = [place for place, weight in enumerate(self.theta) if isinstance(weight, Parameter)]
        return self.actions[places[0] // self.size] if places else None


#: What somebody does whose state is a place.
_ALONG = ("left", "right", "stay")


def draw(level: int, rng: Draws) -> Given:
    """Two features and two actions; then more, or basis functions; then a weight or a state from equal values."""
    setting = draw_setting(rng)
    if level == 3:
        return rng.choice((_weight_sought, _state_sought))(rng, setting)
    count, size = (2, 2) if level == 1 else rng.choice(((3, 2), (2, 3), (3, 3)))
    theta = tuple(rng.nonzero(-3, 5) for _ in range(size * count))
    if level == 1 or rng.choice((True, False)):
        actions = setting.actions[:count]
        features = tuple(
            rng.whole(1, 3) if level == 1 else rng.fraction("1/2", "1", "2", "3/2", "3") for _ in range(size)
        )
        return Given(theta=theta, actions=actions, features=features)
    width = rng.whole(4, 6)
    centred = draw_on_a_line(rng, rng.distinct(size, 1, int(width) - 1))
    bumps = Bumps(position=centred.position, centres=centred.centres, width=width)
    return Given(theta=theta, actions=rng.sample(_ALONG, count), bumps=bumps)


def _weight_sought(rng: Draws, setting: Setting) -> Given:
    """From which w on an action is better than the others."""
    actions = setting.actions[: rng.choice((2, 3, 3))]
    size = rng.choice((2, 3))
    theta: list[Fraction | Parameter] = [rng.nonzero(-3, 5) for _ in range(size * len(actions))]
    theta[rng.below(len(theta))] = Parameter("w")
    return Given(
        theta=tuple(theta),
        actions=actions,
        features=tuple(rng.fraction("2/3", "3/2", "3", "5/3", "3/4") for _ in range(size)),
    )


def _state_sought(rng: Draws, setting: Setting) -> Given:
    """The state first, then weights for which both actions are worth the same there."""
    near, far = rng.shuffled((rng.fraction("1", "2", "3/2"), rng.fraction("5/2", "3", "4")))
    width = near + far + rng.whole(0, 1)
    ratio = (width - far) / (width - near)
    left, right = ratio.numerator, ratio.denominator
    if max(left, right) > 6:
        return _state_sought(rng, setting)
    side = rng.choice((1, -1))
    first = (rng.nonzero(-3, 5), rng.nonzero(-3, 5))
    second = (first[0] - side * left, first[1] + side * right)
    start = rng.nonzero(-2, 4)
    return Given(
        theta=(*first, *second),
        actions=rng.sample(_ALONG, 2),
        bumps=Bumps(centres=((start,), (start + near + far,)), width=width),
    )


def question(given: Given) -> Question:
    """Features and weights; all values and the best action are asked for, or when two are equal."""
    return Question((*_state(given), *_weights(given)), tuple(_parts(given)))


def _state(given: Given) -> Document:
    if given.bumps is None:
        names = feature_names(range(1, given.size + 1))
        told = ", ".join(f"{name} = {shown(value)}" for name, value in zip(names, given.features or (), strict=True))
        return (Paragraph(f"In state $s$ the features are ${told}$."),)
    where = (
        Paragraph("The state of a robot is its position, $s = x$. The features have these centres:")
        if given.between
        else place(given.bumps)
    )
    return (where, centres_table(given.bumps.centres), Paragraph(tents(given.bumps.width)))


def _weights(given: Given) -> Document:
    order = (
        "Action values are estimated as $Q̂(s, a) = θ^⊤ f(s, a)$. In $f(s, a)$ the features $φ(s)$ are stacked, "
        f"one block for each action, in the order {joined(list(given.actions))}; the blocks of the other actions are "
        "$0$. "
    )
    return (Paragraph(f"{order}The weights are ${weights(given.theta)}$."),)


def _parts(given: Given) -> Iterator[Part]:
    actions = given.actions
    if given.between:
        yield Part("At which $x$ between the centres do both actions have the same value?", Number(), zero=True)
        yield Part("What is this value?", Number(), zero=True)
        yield Part("Which action is greedy at the centre $c_1$?", Policy({"s": actions}, ""))
        return
    if given.bumps is not None:
        yield asked_features(given.bumps, ())
    if given.action is not None:
        names = tuple(f'f_{{{number}}}(s, "{given.action}")' for number in range(1, len(given.theta) + 1))
        yield Part(f'What is the stacked vector $f(s, "{given.action}")$?', Numbers(names), zero=True)
    valued = tuple(("s", action) for action in actions if action != given.raised)
    if given.raised is None:
        yield Part("What is $Q̂(s, a)$ of every action?", Values("Q̂", valued), zero=True)
        yield Part("Which action is greedy?", Policy({"s": actions}))
        return
    others = "the other action" if len(valued) == 1 else "every other action"
    yield Part(
        f"The weight $w$ belongs to {given.raised}. What is $Q̂(s, a)$ of {others}?", Values("Q̂", valued), zero=True
    )
    yield Part(f"Above which $w$ is {given.raised} the greedy action?", Number())
