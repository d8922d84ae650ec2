"""Values after some sweeps of value iteration, and the greedy policy; or a reward, from a value after two sweeps."""

from itertools import product
from typing import Annotated, ClassVar, Self

from pydantic import Discriminator, Field, Tag, model_validator

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Exact, Parameter, Probability, shown
from rldrill.problems.family import AskedFor, Givens, Question, flag
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Model, Name, Named, Transition, check_state_values, model_blocks, values_table
from rldrill.problems.parts import Choice, Number, Part, Policy, Values
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Setting, Shape, draw_model, draw_setting
from rldrill.problems.sweeps import SYNCHRONOUS, Sweeps, begin, counted, in_place
from rldrill.problems.valued import RewardSought, draw_values, open_reward, opened, tells_apart, worth

TITLE = "Value iteration"
SOURCE = "Sutton & Barto 2018, section 4.4"
REVISION = 8

#: The largest denominator of a value after one sweep.
_FINEST = 5


class Swept(AskedFor, Sweeps):
    """A model, the discount, how many sweeps, and the values to start from (0 where none are given).

    With a state for a tie the discount is left open: it is asked for which one two actions there are both greedy.
    """

    gamma: Discount
    tie: Name | None = Field(default=None, description="A state whose two actions are to be greedy both; leave γ open.")
    in_place: bool = flag("Whether a sweep uses values as soon as they are new, state by state.")
    action_values: bool = flag("Whether the sweeps go over action values: then Q_k is asked for instead of V_k.")

    @model_validator(mode="after")
    def _tied(self) -> Self:
        open_ = self.left_open
        if self.tie is None and open_:
            raise ValueError(f"{open_[0]} is left open, so no action can be called greedy; give numbers, or a tie")
        if self.tie is not None and open_ != ("gamma",):
            raise ValueError("tie: leave gamma open, and nothing else")
        if self.tie is not None and (self.sweeps != 1 or self.start or self.action_values):
            raise ValueError("tie: it is found after one sweep from 0; set sweeps = 1, without start and action_values")
        if self.tie is not None and len(self.mdp.actions.get(self.tie, ())) != 2:
            raise ValueError(f"tie: {self.tie!r} must be a state with two actions")
        return self

    @model_validator(mode="after")
    def _from_zero(self) -> Self:
        if self.action_values and (self.in_place or self.start):
            surplus = "in_place" if self.in_place else "start"
            raise ValueError(
                f"{surplus}: sweeps over action values are synchronous here, and begin with 0; leave out {surplus}, or "
                "action_values"
            )
        return self


class Sought(RewardSought, Givens):
    """A model with one reward left open, the discount, the values to start from, and a value after two sweeps."""

    #: Sweeps are synchronous.
    in_place: ClassVar[bool] = False

    mdp: Model = Field(description="The Markov decision process, in which one reward is left open.")
    gamma: Probability = Field(description="The discount.")
    start: Named[Exact] = Field(description="The values to start from.")
    outcome: Named[Exact] = Field(
        min_length=1,
        max_length=1,
        description="The value after two sweeps of a state in which no reward is left open.",
        examples=[{"cool": 12}],
    )

    @model_validator(mode="after")
    def _follows(self) -> Self:
        row = open_reward(self.mdp)
        check_state_values(self.start, self.mdp)
        if self.state == row.state or self.state not in self.mdp.states:
            raise ValueError(f"outcome: give the value after two sweeps of a state that is not {row.state!r}")
        return self

    @property
    def state(self) -> str:
        """The state whose value after two sweeps is known."""
        return next(iter(self.outcome))


Given = Annotated[
    Annotated[Swept, Tag("swept")] | Annotated[Sought, Tag("sought")],
    Discriminator(lambda given: "sought" if isinstance(given, dict) and "outcome" in given else "swept"),
]


def draw(level: int, rng: Draws) -> Swept | Sought:
    """One sweep from given values; then two, over states or actions; then a reward or a discount is asked for.

    Only action values depend on all probabilities: where values of states are asked for, moves are certain. Rewards
    are even, so that the numbers stay small.
    """
    setting = draw_setting(rng)
    if level == 3:
        return _to_tie(rng, setting) if rng.chance(Fraction(1, 3)) else _to_outcome(rng, setting)
    over_actions = level == 2 and rng.chance(Fraction(1, 2))
    states = 2 if over_actions else 3 if level == 1 else 2 + rng.below(2)
    shape = Shape(states=states, actions=2, branches=2 if over_actions else 1, denominators=(2,))
    gamma = rng.fraction("1/2", "2/3", "4/5") if level == 1 else Fraction(1, 2)
    mdp = _paying(rng, draw_model(rng, setting, shape), 1 if level == 1 else 2)
    while over_actions and not _decided(mdp, gamma):
        mdp = _paying(rng, draw_model(rng, setting, shape), 2)
    given = Swept(
        mdp=mdp,
        gamma=gamma,
        sweeps=level,
        start=draw_values(rng, mdp.states, gamma) if level == 1 else None,
        in_place=not over_actions and rng.chance(Fraction(1, 2)),
        action_values=over_actions,
    )
    return draw(level, rng) if not over_actions and not _is_telling(given, gamma) else given


def _is_telling(given: Swept, gamma: Fraction) -> bool:
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


def _to_tie(rng: Draws, setting: Setting) -> Swept:
    """Two actions in one state that are both greedy for the values of the first sweep, with a discount below 1."""
    pays_more = rng.choice((1, -1))  # the first action at once, or the second
    while True:
        mdp = draw_model(rng, setting, Shape(states=3, actions=2, branches=1, reward=8))
        first = {state: max(worth(mdp, (state, a), {}, Fraction()) for a in mdp.actions[state]) for state in mdp.states}
        for tie in rng.shuffled(mdp.states):
            one, other = (next(row for row in mdp.transitions if row[:2] == (tie, a)) for a in mdp.actions[tie])
            gain = Fraction(one.reward) - Fraction(other.reward)
            later = first.get(other.next, Fraction(0)) - first.get(one.next, Fraction(0))
            if later and 0 < gain / later < 1 and gain * pays_more > 0:
                return Swept(mdp=mdp, gamma=Parameter("gamma"), sweeps=1, tie=tie)


def _to_outcome(rng: Draws, setting: Setting) -> Sought:
    """A reward that is earned in the first sweep, and another state whose value shows it after the second."""
    states = 2 + rng.below(2)
    gamma = rng.fraction("1/2", "2/3")
    mdp = _paying(rng, draw_model(rng, setting, Shape(states=states, actions=5 - states, branches=1)), 2)
    start = draw_values(rng, mdp.states, gamma)
    moves, values = _best_moves(mdp, start, gamma)
    later, after = _best_moves(mdp, values, gamma)
    rewards = [row.reward for row in mdp.transitions]
    seen = [
        (row, move.state)
        for row, move in product(moves, later)
        if move.next == row.state != move.state and row.next in start and rewards.count(row.reward) == 1
    ]
    if not seen:
        return _to_outcome(rng, setting)
    row, state = rng.choice(seen)
    return Sought(mdp=opened(mdp, row), gamma=gamma, start=start, outcome={state: after[state]})


def _best_moves(
    mdp: Model, values: dict[str, Fraction], gamma: Fraction
) -> tuple[list[Transition], dict[str, Fraction]]:
    """The moves that are better than the others of their states, where all are certain; the values after a sweep."""
    worths = {row: Fraction(row.reward) + gamma * values.get(row.next, 0) for row in mdp.transitions}
    best = {state: max(worths[row] for row in worths if row.state == state) for state in mdp.states}
    reached = [row.state for row, number in worths.items() if number == best[row.state]]
    moves = [row for row, number in worths.items() if number == best[row.state] and reached.count(row.state) == 1]
    return moves, best


def question(given: Swept | Sought) -> Question:
    """The model; values after the sweeps, then the policy that is greedy for them, or what makes a tie."""
    if isinstance(given, Sought):
        return _of_outcome(given)
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


def _of_outcome(given: Sought) -> Question:
    """The value after two sweeps; what follows from it of the first sweep, the reward, and the rest of the second."""
    x, row, state = shown(Parameter(given.row.reward)), given.row, given.state
    leading = f" when it leads to {row.next}" if len(given.mdp.outcomes[row.state, row.action]) > 1 else ""
    told = (
        f"{discount(given.gamma)} {SYNCHRONOUS} The reward ${x}$ of {row.action} in {row.state}{leading} is not known, "
        f'but after two sweeps the value of {state} is $V_2("{state}") = {shown(given.outcome[state])}$.'
    )
    others = [each for each in given.mdp.states if each != state]
    which = f'$V_2("{others[0]}")$' if len(others) == 1 else "$V_2(s)$ for every other state"
    blocks = (
        *model_blocks(given.mdp),
        Paragraph("Value iteration starts from these values:"),
        values_table(given.start, "V_0"),
        Paragraph(told),
    )
    return Question(
        blocks,
        (
            Part(f'What is $V_1("{row.state}")$?', Number()),
            Part(f"What is ${x}$?", Number(), zero=True),
            Part(f"What is {which}?", Values("V_2", tuple(others))),
            Part("Which action $π(s)$ is greedy for $V_2$ in every state?", Policy(given.mdp.actions)),
        ),
    )


def _of_actions(given: Swept) -> Question:
    k = given.sweeps
    start = (
        "Value iteration is done on the action values $Q$. It starts from $Q_0(s, a) = 0$ for all states and actions."
    )
    blocks = (*model_blocks(given.mdp), Paragraph(start), Paragraph(f"{discount(given.gamma)} {SYNCHRONOUS}"))
    ask = f"What is $Q_{{{k}}}(s, a)$, the value of every state and action after {counted(k)}?"
    greedy = f"Which action $π(s)$ is greedy for $Q_{{{k}}}$ in every state?"
    return Question(blocks, (Part(ask, Values(f"Q_{{{k}}}", given.mdp.pairs)), Part(greedy, Policy(given.mdp.actions))))
