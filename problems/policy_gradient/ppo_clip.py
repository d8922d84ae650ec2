"""PPO: the probability ratios, the two terms and the clipped objective of one or more samples."""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Logarithm, Probability, Weight, WeightField, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Name
from rldrill.problems.parts import Number, Numbers, Part, YesNo
from rldrill.problems.settings import draw_setting

TITLE = "PPO: clipped objective"
SOURCE = "Schulman et al. 2017, section 3"
REVISION = 1


class Sample(Givens):
    """One action taken in a state, how likely it was and is now, and its advantage.

    The new probability is given as ``new``, or follows from the new policy's ``preferences`` in that state; so does the
    old one from ``old`` or ``old_preferences``.
    """

    state: Name = Field(description="The state.")
    action: Name = Field(description="The action that was taken.")
    old: Probability | None = Field(
        default=None, description="The probability with which the old policy took it; instead of old_preferences."
    )
    old_preferences: dict[Name, WeightField] | None = Field(
        default=None,
        description="The old policy's preferences for the actions of the state; instead of old.",
        examples=[{"left": 0, "right": "ln 2"}],
    )
    new: Probability | None = Field(
        default=None, description="The probability with which the new policy takes it; instead of preferences."
    )
    preferences: dict[Name, WeightField] | None = Field(
        default=None, description="The new policy's preferences for the actions of the state; instead of new."
    )
    advantage: Exact = Field(description="The advantage of the action.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.old is not None and self.old == 0:
            raise ValueError("old: the action was taken, so its probability was not 0")
        if (self.new is None) == (self.preferences is None):
            raise ValueError("give either the new probability or the new policy's preferences")
        if (self.old is None) == (self.old_preferences is None):
            raise ValueError("give either the old probability or the old policy's preferences")
        for name, preferences in (("preferences", self.preferences), ("old_preferences", self.old_preferences)):
            if preferences is not None and self.action not in preferences:
                raise ValueError(f"{name}: the preference of {self.action!r} is missing")
        return self


class Given(Givens):
    """Samples of the old policy, and the clipping range ε."""

    samples: tuple[Sample, ...] = Field(min_length=1, max_length=20, description="The actions that were taken.")
    epsilon: Exact = Field(gt=0, lt=1, description="The clipping range, above 0 and below 1.")

    @model_validator(mode="after")
    def _alike(self) -> Self:
        if len({tuple(sample.preferences or ()) for sample in self.samples}) > 1:
            raise ValueError(
                "samples: give preferences of the same actions in all of them, or new probabilities in all"
            )
        if len({tuple(sample.old_preferences or ()) for sample in self.samples}) > 1:
            raise ValueError(
                "samples: give old_preferences of the same actions in all of them, or old probabilities in all"
            )
        return self

    @property
    def actions(self) -> tuple[str, ...]:
        """The actions that preferences are given of; none, where the new probabilities are given."""
        return tuple(self.samples[0].preferences or ())

    @property
    def old_actions(self) -> tuple[str, ...]:
        """The actions that the old policy's preferences are given of; none, where the old probabilities are given."""
        return tuple(self.samples[0].old_preferences or ())


#: Old and new probability of an action that became clearly more likely; reversed, clearly less; or hardly changed.
_MORE = (("1/2", "3/4"), ("2/5", "3/5"), ("1/5", "3/10"), ("1/4", "1/2"), ("1/5", "2/5"), ("3/10", "3/5"))
_LESS = tuple((new, old) for old, new in _MORE)
_NEAR = (("1/2", "11/20"), ("1/2", "9/20"), ("2/5", "9/25"), ("1/5", "9/50"))
#: The same where the new policy has the preferences ln n and 0: old probability, n, and which of them is taken.
_MORE_BY_PREFERENCE = (("1/3", 2, 0), ("2/5", 2, 0), ("1/2", 3, 0), ("3/8", 3, 0), ("2/5", 4, 0), ("1/2", 4, 0))
_LESS_BY_PREFERENCE = (("2/3", 2, 1), ("1/2", 2, 1), ("1/2", 3, 1), ("3/8", 3, 1), ("2/5", 4, 1), ("3/10", 4, 1))
_NEAR_BY_PREFERENCE = (("3/10", 2, 1), ("3/5", 2, 0), ("4/5", 3, 0), ("3/10", 3, 1))


def draw(level: int, rng: Draws) -> Given:
    """One sample; then three, one of them cut and one kept; then the new policy is given by its preferences."""
    setting = draw_setting(rng)
    states = rng.shuffled(setting.states)
    actions = setting.actions[:2]
    more, less, near = (
        (_MORE_BY_PREFERENCE, _LESS_BY_PREFERENCE, _NEAR_BY_PREFERENCE) if level == 3 else (_MORE, _LESS, _NEAR)
    )
    moves: list[tuple[Sequence[tuple[Any, ...]], int]] = [
        rng.choice(((more, 1), (less, -1))),  # clipping cuts
        rng.choice(((more, -1), (less, 1))),  # the minimum keeps the unclipped term
        (near, rng.choice((1, -1))),
    ]
    drawn = rng.shuffled(moves) if level > 1 else (rng.choice(moves[:2]),)
    samples = []
    for state, (pairs, sign) in zip(states, drawn, strict=False):
        old, *new = rng.choice(pairs)
        advantage = sign * rng.whole(1, 6)
        if level == 3:
            (number, taken), order = new, rng.shuffled(actions)
            preferences = {order[0]: Logarithm(f"ln {number}"), order[1]: Fraction(0)}
            in_order = {action: preferences[action] for action in actions}
            samples.append(Sample(state=state, action=order[taken], old=old, preferences=in_order, advantage=advantage))
        else:
            action = rng.choice(actions)
            samples.append(Sample(state=state, action=action, old=old, new=new[0], advantage=advantage))
    return Given(samples=tuple(samples), epsilon=rng.fraction("1/5", "1/4"))


def question(given: Given) -> Question:
    """A table of samples; ratios, terms, the objective, and for every sample whether its gradient is cut."""
    times = range(len(given.samples))
    parts = [
        _asked("probability ratio", "ρ", times),
        _asked("unclipped term", "u", times),
        _asked("clipped term", "c", times),
        Part("What is the objective $L$, the mean over the samples?" if len(times) > 1
             else "What is the objective $L_0$?", Number(), zero=True),
    ]  # fmt: skip
    for time in times:
        ask = f"Does clipping cut off the gradient of $L_{{{time}}}$, so that it does not change $θ$?"
        parts.append(Part(ask, YesNo()))
    wanted = "samples" if len(times) > 1 else "sample"
    blocks: tuple[Block, ...] = (
        Paragraph(f"PPO learns from the {wanted} below, taken by the old policy; $A_t$ is the estimated advantage."),
        _samples_table(given),
        *([Paragraph("The new policy is softmax in its preferences $h(s, a)$.")] if given.actions else []),
        *([Paragraph("The old policy is softmax in its preferences $h_{old}(s, a)$.")] if given.old_actions else []),
        Paragraph(
            "With the ratio $ρ_t$ of new to old probability, the unclipped term is $u_t = ρ_t A_t$ and the clipped one "
            f"$c_t$ has $ρ_t$ clipped to the range from $1 − ε$ to $1 + ε$, with $ε = {shown(given.epsilon)}$."
        ),
    )
    return Question(blocks, tuple(parts))


def _asked(what: str, letter: str, times: range) -> Part:
    names = tuple(f"{letter}_{{{time}}}" for time in times)
    if len(names) == 1:
        return Part(f"What is the {what} ${names[0]}$?", Number())
    return Part(f"What are the {what}s ${', '.join(names)}$, in this order?", Numbers(names))


def _samples_table(given: Given) -> Table:
    old = tuple(f'$h_{{old}}(s_t, "{action}")$' for action in given.old_actions) or ("$π_{old}(a_t|s_t)$",)
    new = tuple(f'$h(s_t, "{action}")$' for action in given.actions) or ("$π_θ(a_t|s_t)$",)
    return Table(
        header=("$t$", "$s_t$", "$a_t$", *old, *new, "$A_t$"),
        rows=tuple(
            (
                f"${time}$",
                sample.state,
                sample.action,
                *(f"${shown(value)}$" for value in _either(sample.old, sample.old_preferences)),
                *(f"${shown(value)}$" for value in _either(sample.new, sample.preferences)),
                f"${shown(sample.advantage)}$",
            )
            for time, sample in enumerate(given.samples)
        ),
    )


def _either(chance: Fraction | None, preferences: Mapping[str, Weight] | None) -> tuple[Weight, ...]:
    return (chance,) if chance is not None else tuple((preferences or {}).values())
