"""Values after some sweeps of value iteration, and the greedy policy for them."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Parameter
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Model, Name, model_blocks
from rldrill.problems.parts import Choice, Number, Part, Policy, Values
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Setting, Shape, draw_model, draw_setting
from rldrill.problems.sweeps import SYNCHRONOUS, Sweeps, begin, counted, in_place
from rldrill.problems.valued import draw_values, tells_apart, worth

TITLE = "Value iteration"
SOURCE = "Sutton & Barto 2018, section 4.4"
REVISION = 7

#: The largest denominator of a value after one sweep.
_FINEST = 5


class Given(Sweeps):
    """A model, the discount, how many sweeps, and the values to start from (0 where none are given).

    With a state for a tie the discount is left open: it is asked for which one two actions there are both greedy.
    """

    gamma: Discount
    tie: Name | None = Field(default=None, description="A state whose two actions are to be greedy both; leave γ open.")
    in_place: bool = Field(
        default=False,
        exclude_if=lambda in_place: not in_place,
        description="Whether a sweep uses values as soon as they are new, state by state.",
    )
    action_values: bool = Field(
        default=False,
        exclude_if=lambda action_values: not action_values,
        description="Whether the sweeps go over action values: then Q_k is asked for instead of V_k.",
    )

    @model_validator(mode="after")
    def _tied(self) -> Self:
        open_ = super().parameters()
        if self.tie is None and open_:
            raise ValueError(f"{open_[0]} is left open, so no action can be called greedy; give numbers, or a tie")
        if self.tie is not None and (open_ != ("gamma",) or self.sweeps != 1 or self.start or self.action_values):
            raise ValueError("tie: leave gamma open, and nothing else; it takes one sweep over states, from 0")
        if self.tie is not None and len(self.mdp.actions.get(self.tie, ())) != 2:
            raise ValueError(f"tie: {self.tie!r} must be a state with two actions")
        return self

    def parameters(self) -> tuple[str, ...]:
        """What answers are expressions in: nothing, because the discount is asked for where it is left open."""
        return ()

    @model_validator(mode="after")
    def _from_zero(self) -> Self:
        if self.action_values and (self.in_place or self.start):
            surplus = "in_place" if self.in_place else "start"
            raise ValueError(
                f"{surplus}: sweeps over action values are synchronous here, and begin with 0; leave out {surplus}, or "
                "action_values"
            )
        return self


def draw(level: int, rng: Draws) -> Given:
    """One sweep from given values; then two from zero, over states or actions; then three, or a discount to be found.

    Only action values depend on all probabilities: where values of states are asked for, moves are certain. Rewards
    are even, so that the numbers stay small.
    """
    setting = draw_setting(rng)
    if level == 3 and rng.chance(Fraction(1, 8)):  # sweeps are drawn again more often
        return _to_tie(rng, setting)
    over_actions = level == 2 and rng.chance(Fraction(1, 2))
    states = 2 if over_actions else 3 if level != 2 else 2 + rng.below(2)
    shape = Shape(states=states, actions=2, branches=2 if over_actions else 1, denominators=(2,))
    gamma = rng.fraction("1/2", "2/3", "4/5") if level == 1 else Fraction(1, 2)
    mdp = _paying(rng, draw_model(rng, setting, shape), 1 if level == 1 else 2)
    while over_actions and not _decided(mdp, gamma):
        mdp = _paying(rng, draw_model(rng, setting, shape), 2)
    given = Given(
        mdp=mdp,
        gamma=gamma,
        sweeps=level,
        start=draw_values(rng, mdp.states, gamma) if level == 1 else None,
        in_place=not over_actions and rng.chance(Fraction(1, 2)),
        action_values=over_actions,
    )
    return draw(level, rng) if not over_actions and not _is_telling(given, gamma) else given


def _is_telling(given: Given, gamma: Fraction) -> bool:
    """Whether one sweep more changes something, so that it matters how many there are; after one, numbers are short."""
    values = dict(given.start or dict.fromkeys(given.mdp.states, Fraction(0)))
    for _ in range(given.sweeps + 1):
        old = dict(values)
        for state, actions in given.mdp.actions.items():
            ahead = values if given.in_place else old
            values[state] = max(worth(given.mdp, (state, action), ahead, gamma) for action in actions)
    return values != old and (given.sweeps > 1 or all(value.denominator <= _FINEST for value in old.values()))


def _paying(rng: Draws, mdp: Model, scale: int) -> Model:
    """The model with rewards a number of times as large, and one at the end that is worth going for."""
    rows = tuple(
        row._replace(reward=rng.whole(4, 9) if row.next in mdp.terminal else scale * Fraction(row.reward))
        for row in mdp.transitions
    )
    return Model(story=mdp.story, transitions=rows, terminal=mdp.terminal)


def _decided(mdp: Model, gamma: Fraction) -> bool:
    """Whether no two outcomes of an action are worth the same after the first sweep."""
    first = {state: max(worth(mdp, (state, a), {}, gamma) for a in actions) for state, actions in mdp.actions.items()}
    return all(
        tells_apart([row for row in mdp.transitions if row.state == state], first, gamma) for state in mdp.states
    )


def _to_tie(rng: Draws, setting: Setting) -> Given:
    """Two actions in one state that are both greedy for the values of the first sweep, with a discount below 1."""
    pays_more = rng.choice((1, -1))  # the first action at once, or the second
    while True:
        mdp = draw_model(rng, setting, Shape(states=3, actions=2, branches=1, reward=8))
        first = {
            state: max(worth(mdp, (state, a), {}, Fraction(0)) for a in mdp.actions[state]) for state in mdp.states
        }
        for tie in rng.shuffled(mdp.states):
            one, other = (next(row for row in mdp.transitions if row[:2] == (tie, a)) for a in mdp.actions[tie])
            gain = Fraction(one.reward) - Fraction(other.reward)
            later = first.get(other.next, Fraction(0)) - first.get(one.next, Fraction(0))
            if later and 0 < gain / later < 1 and gain * pays_more > 0:
                return Given(mdp=mdp, gamma=Parameter("gamma"), sweeps=1, tie=tie)


def question(given: Given) -> Question:
    """The model; values after the sweeps, then the policy that is greedy for them, or what makes a tie."""
    if given.action_values:
        return _of_actions(given)
    sweeps = in_place(given.mdp.states) if given.in_place else SYNCHRONOUS
    rate = "The discount $γ$ is not known." if given.tie else discount(given.gamma)
    blocks = (*model_blocks(given.mdp), *begin(given, "Value iteration"), Paragraph(f"{rate} {sweeps}"))
    k = given.sweeps
    values = Part(
        f"What is $V_{{{k}}}(s)$, the value of every state after {counted(k)}?", Values(f"V_{{{k}}}", given.mdp.states)
    )
    if given.tie:
        both = " and ".join(given.mdp.actions[given.tie])
        ask = f"For which $γ$ are {both} both greedy for $V_{{{k}}}$ in {given.tie}?"
        options = dict(zip("AB", given.mdp.actions[given.tie], strict=True))
        smaller = Part("Which of the two is greedy there if $γ$ is smaller than that?", Choice(options))
        return Question(blocks, (values, Part(ask, Number()), smaller))
    ask = f"Which action $π(s)$ is greedy for $V_{{{k}}}$ in every state?"
    return Question(blocks, (values, Part(ask, Policy(given.mdp.actions))))


def _of_actions(given: Given) -> Question:
    k = given.sweeps
    start = (
        "Value iteration is done on the action values $Q$. It starts from $Q_0(s, a) = 0$ for all states and actions."
    )
    blocks = (*model_blocks(given.mdp), Paragraph(start), Paragraph(f"{discount(given.gamma)} {SYNCHRONOUS}"))
    ask = f"What is $Q_{{{k}}}(s, a)$, the value of every state and action after {counted(k)}?"
    greedy = f"Which action $π(s)$ is greedy for $Q_{{{k}}}$ in every state?"
    return Question(blocks, (Part(ask, Values(f"Q_{{{k}}}", given.mdp.pairs)), Part(greedy, Policy(given.mdp.actions))))
