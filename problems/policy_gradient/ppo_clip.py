"""PPO: the probability ratios, the two terms and the clipped objective of one or more samples."""

from collections.abc import Iterator, Mapping
from itertools import combinations, product
from typing import ClassVar, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Logarithm, Probability, Weight, needed, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.features import ActionPreferences
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.models import Name
from rldrill.problems.parts import Choice, Number, Numbers, Part, YesNo
from rldrill.problems.settings import Setting, draw_setting

TITLE = "PPO: clipped objective"
SOURCE = "Schulman et al. 2017, section 3"
REVISION = 5


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
    old_preferences: ActionPreferences | None = Field(
        default=None,
        description="The old policy's preferences for the actions of the state; instead of old.",
        examples=[{"left": 0, "right": "ln 2"}],
    )
    new: Probability | None = Field(
        default=None, description="The probability with which the new policy takes it; instead of preferences."
    )
    preferences: ActionPreferences | None = Field(
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
                raise ValueError(f"{name}: the preference of {self.action!r} is missing; add it")
        return self


class Given(Givens):
    """Samples of the old policy, and the clipping range ε.

    Without ``epsilon`` it is asked for: that which gives the ``objective``, or that below which a gradient is cut off.
    """

    OWN: ClassVar[str] = "ALu"

    samples: tuple[Sample, ...] = Field(min_length=1, max_length=20, description="The actions that were taken.")
    epsilon: Exact | None = Field(
        default=None, gt=0, lt=1, description="The clipping range, above 0 and below 1; without it, it is asked for."
    )
    objective: Exact | None = Field(
        default=None, description="The objective of the samples, from which the clipping range is to be found."
    )

    @model_validator(mode="after")
    def _one_way(self) -> Self:
        if self.epsilon is not None and self.objective is not None:
            raise ValueError("give either epsilon or the objective from which it is to be found, not both")
        return self

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
#: The same where the new policy has the preferences ln n and 0: old probability, n, and which of them is taken. No
#: ratio is 2 or more, so that some ε below 1 reaches it, and all are different.
_BY_PREFERENCE = {
    True: (("1/2", 2, 0), ("1/2", 3, 0), ("3/5", 3, 0), ("1/2", 4, 0)),
    False: (("1/2", 2, 1), ("1/2", 3, 1), ("1/3", 3, 1), ("1/3", 4, 1)),
}


#: Whether clipping cuts off the gradient of a sample, nothing if its ratio lies inside the range; whether it grew.
_CASES = ((True, True), (True, False), (False, True), (False, False), (None, True))
#: Three different cases; in one at least a ratio lies outside the range, and yet its gradient is not cut off.
_THREE = tuple(cases for cases in combinations(_CASES, 3) if any(cut is False for cut, _ in cases))


def draw(level: int, rng: Draws) -> Given:
    """One sample; then two or three, each another case; then the clipping range is found, from the objective or as that
    below which it cuts.
    """
    setting = draw_setting(rng)
    if level == 3:
        return _searched(rng, setting)
    cases: tuple[tuple[bool | None, bool], ...]
    if level == 1:
        cases = (rng.choice(_CASES[:-1]),)
    elif rng.chance(Fraction(2, 3)):  # one ratio above the range, one below it
        cases = rng.shuffled([(rng.choice((True, False)), more) for more in (True, False)])
    else:
        cases = rng.shuffled(rng.choice(_THREE))
    count = len(cases)
    samples = []
    for state, (cut, more) in zip(rng.shuffled(setting.states), cases, strict=False):
        sign = rng.choice((1, -1)) if cut is None else 1 if more == cut else -1
        old, new = rng.choice(_NEAR if cut is None else _MORE if more else _LESS)
        samples.append(
            Sample(
                state=state,
                action=rng.choice(setting.actions[:2]),
                old=fraction_of(old),
                new=fraction_of(new),
                advantage=sign * count * rng.whole(1, 6 // count),
            )
        )
    return Given(samples=tuple(samples), epsilon=rng.fraction("1/5", "1/4"))


def _searched(rng: Draws, setting: Setting) -> Given:
    """Samples with the new policy's preferences, and the clipping range to be found."""
    by_objective = rng.choice((True, False))
    cuts = rng.shuffled((True, False, False)) if by_objective else rng.choice(_SOME_CUT)
    samples, objective = [], Fraction(0)
    epsilon = rng.fraction("1/10", "1/5")
    changes = {more: iter(rng.shuffled(_BY_PREFERENCE[more])) for more in (True, False)}
    for state, cut in zip(rng.shuffled(setting.states), cuts, strict=False):
        more = rng.choice((True, False))
        old, number, taken = next(changes[more])
        order = rng.shuffled(setting.actions[:2])
        preferences = {order[0]: Logarithm(f"ln {number}"), order[1]: Fraction(0)}
        advantage = (1 if more == cut else -1) * rng.whole(1, 6)
        before = fraction_of(old)
        ratio = Fraction(number if taken == 0 else 1, number + 1) / before
        held = 1 + epsilon if more else 1 - epsilon
        objective += (held if cut else ratio) * advantage / len(cuts)
        in_order = {action: preferences[action] for action in setting.actions[:2]}
        samples.append(Sample(state=state, action=order[taken], old=before, preferences=in_order, advantage=advantage))
    return Given(samples=tuple(samples), objective=objective if by_objective else None)


#: Of which samples clipping can cut off the gradient: of some, not of all.
_SOME_CUT = tuple(cuts for cuts in product((True, False), repeat=3) if len(set(cuts)) > 1)


def question(given: Given) -> Question:
    """A table of samples; ratios, terms, the objective, and for every sample whether its gradient is cut; or ε."""
    times = range(len(given.samples))
    several = len(times) > 1
    blocks: tuple[Block, ...] = (
        Paragraph(
            f"PPO learns from {'these samples' if several else 'this sample'} of the old policy; $A_t$ is the "
            "estimated advantage of the action $a_t$."
        ),
        _samples_table(given),
        *([Paragraph("The new policy is softmax in its preferences $h(s, a)$.")] if given.actions else []),
        *([Paragraph("The old policy is softmax in its preferences $h_{old}(s, a)$.")] if given.old_actions else []),
        Paragraph(_terms(given)),
    )
    return Question(blocks, tuple(_parts(given, times)))


def _terms(given: Given) -> str:
    """What the letters of the question stand for."""
    mean = ", and their mean $L$" if len(given.samples) > 1 else ""
    objective = f"PPO's clipped objective for the sample at time $t$ is called $L_t${mean}."
    ratio = "The ratio $ρ_t$ is the new probability of the action divided by the old one."
    if given.epsilon is None and given.objective is None:
        return f"{ratio} {objective} In $L_t$ the ratio is clipped to the range from $1 − ε$ to $1 + ε$."
    if given.epsilon is None:
        return (
            f"{ratio} The unclipped term is $u_t = ρ_t A_t$. {objective} The clipping range $ε$ was not noted, but "
            f"with it the objective is $L = {shown(needed(given.objective))}$."
        )
    return (
        f"{ratio} The unclipped term is $u_t = ρ_t A_t$; in the clipped term $c_t$ the ratio is first clipped to the "
        f"range from $1 − ε$ to $1 + ε$, with $ε = {shown(given.epsilon)}$. {objective}"
    )


def _parts(given: Given, times: range) -> Iterator[Part]:
    yield _asked("probability ratio", "ρ", times)
    objective = "L" if len(times) > 1 else "L_0"
    if given.epsilon is None and given.objective is None:
        yield _thresholds(times)
        yield Part(f"Which value does ${objective}$ approach as $ε$ goes to $0$?", Number(), zero=True)
        return
    if len(times) == 1 and given.epsilon is not None:
        terms = Numbers(("u_0", "c_0"))
        yield Part("What are the unclipped term $u_0$ and the clipped term $c_0$?", terms)
    else:
        yield _asked("unclipped term", "u", times)
        if given.epsilon is None:
            yield Part("What is the clipping range $ε$?", Number())
            return
        yield _asked("clipped term", "c", times)
    yield Part(f"What is the objective ${objective}$?", Number(), zero=True)
    yield _cut_off(len(times))


def _cut_off(count: int) -> Part:
    """Which gradients are cut off; of many samples, how many."""
    if count == 1:
        return Part("Does clipping make the gradient $∇_θ L_0$ zero?", YesNo())
    if count == len(CUT) // 2:
        return Part("Of which objectives does clipping make the gradient zero?", Choice(CUT))
    return Part("Of how many of the objectives does clipping make the gradient zero?", Number(), zero=True)


#: The answers of two samples, by whether the first gradient and the second one are cut off.
CUT = {"A": "of neither", "B": "of $L_0$ only", "C": "of $L_1$ only", "D": "of both"}


def _thresholds(times: range) -> Part:
    names = tuple(f"ε_{{{time}}}" for time in times)
    if len(names) == 1:
        ask = "Below which $ε$ does clipping make the gradient of $L_0$ zero ($0$, if no $ε$ does)?"
        return Part(ask, Number(), zero=True)
    ask = "For every sample: below which $ε_t$ does clipping make the gradient of $L_t$ zero ($0$, if no $ε$ does)?"
    return Part(ask, Numbers(names), zero=True)


def _asked(what: str, letter: str, times: range) -> Part:
    names = tuple(f"{letter}_{{{time}}}" for time in times)
    if len(names) == 1:
        return Part(f"What is the {what} ${names[0]}$?", Number())
    return Part(f"What are the {what}s ${', '.join(names)}$?", Numbers(names))


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
