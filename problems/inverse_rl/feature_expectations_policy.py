"""The exact feature expectations of a policy in a small Markov decision process."""

from collections.abc import Sequence
from functools import cache
from itertools import product
from operator import mul
from typing import NamedTuple, Self

from pydantic import Field, model_validator

from rldrill.problems.beliefs import MotionField, check_distribution, check_motion, motion_table
from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Exact, Parameter, dot, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.feature_vectors import FeaturesField, apart, check_features
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import DistributionField, Names, PolicyField, check_chances, check_keys, policy_table
from rldrill.problems.parts import Number, Numbers, Part, Values
from rldrill.problems.phrases import discount, in_open

TITLE = "Feature expectations of a policy"
SOURCE = "Abbeel & Ng 2004, section 2"
REVISION = 6


class Given(Givens):
    """Where actions lead, the policy, the features, the start distribution and the discount."""

    FOUND_BY = "matched"

    motion: MotionField = Field(
        min_length=1, description="For every action and state the probabilities of the next states."
    )
    policy: PolicyField = Field(description="The policy.")
    features: FeaturesField = Field(min_length=1, description="The features of every state.")
    start: DistributionField = Field(description="The probability of every state to start in.")
    terminal: Names = Field(default=(), description="The states in which an episode ends.")
    gamma: Discount
    story: str = Field(
        default="",
        max_length=200,
        pattern=r"^[^$\\]*$",
        description="A sentence that is printed first.",
        examples=["A robot cleans a corridor."],
    )

    matched: Exact | None = Field(
        default=None,
        description="The expert's feature expectation, which the policy has for one value of what is left open in it; "
        "that value is asked for.",
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.matched is not None and (len(self.left_open) != 1 or self.size > 1):
            raise ValueError("matched: leave one number open, which is asked for, and give a single feature")
        for state in self.terminal:
            if state in self.features:
                raise ValueError(f"features: {state!r} is terminal, so no features count there; take them out")
        check_features(self.features, self.features)
        check_motion(self.motion, self.states, self.terminal)
        check_keys(self.policy, self.states, "the policy", needed=self.states)
        for state, chances in self.policy.items():
            check_chances(chances, state, tuple(self.motion))
        check_keys(self.start, self.states, "the start probability", needed=())
        check_distribution(self.start, "start")
        return self

    @property
    def asked_for(self) -> str:
        """The parameter that is asked for."""
        return "".join(self.left_open)

    @property
    def states(self) -> tuple[str, ...]:
        """The states in which actions are taken."""
        return tuple(self.features)

    @property
    def size(self) -> int:
        """How many features there are."""
        return len(next(iter(self.features.values())))

    @property
    def start_chances(self) -> dict[str, Fraction]:
        """The start distribution over all states."""
        return {state: self.start.get(state, Fraction(0)) for state in self.states}


#: A number for every state, action or feature, in their order.
Row = tuple[int, ...]
#: The probabilities of two actions, in twelfths; and discounts, above and below the line.
_CHANCES = ((6, 6), (3, 9), (9, 3), (4, 8), (8, 4))
_GAMMAS = ((1, 2), (2, 3), (3, 4))

_STATES, _END, _ACTIONS = ("A", "B", "C"), "end", ("left", "right")

#: How many states, actions and features there are.
_SIZES = {1: ((2, 1, 1),), 2: ((2, 2, 1), (2, 2, 2), (3, 1, 1), (2, 1, 2)), 3: ((2, 2, 1),)}


class _State(NamedTuple):
    """Of every action its probability in twelfths, and where it leads in quarters; and the features."""

    chances: Row
    outcomes: tuple[Row, ...]
    features: Row

    def leaves(self, number: int) -> bool:
        """Whether the state of this number leads to another one."""
        return any(part for row in self.outcomes for other, part in enumerate(row[:-1]) if other != number)


def draw(level: int, rng: Draws) -> Given:
    """One feature and one action; more of them, or of states; a policy with an open probability, or one to be found.

    At level 1 one equation is solved without the other; at level 2 none is.
    """
    count, choices, size = rng.choice(_SIZES[level])
    names, actions = _STATES[:count], _ACTIONS[:choices]
    leaving = (True,) * count if level == 2 else rng.shuffled((True, level == 3 and rng.chance(Fraction(1, 2))))
    gamma, mus, drawn = _whole(rng, leaving, choices, size)
    states = dict(zip(names, drawn, strict=True))
    start = dict(zip(names, rng.split(count, (3, 4) if count == 2 else (4, 5)), strict=True))
    given = Given(
        motion={
            action: {name: _over(4, (*names, _END), state.outcomes[number]) for name, state in states.items()}
            for number, action in enumerate(actions)
        },
        policy={name: _over(12, actions, state.chances) for name, state in states.items()},
        features={name: tuple(map(Fraction, state.features)) for name, state in states.items()},
        start=start,
        terminal=(_END,),
        gamma=Fraction(*gamma),
    )
    if level < 3:
        return given
    opened = {**given.policy, rng.choice(names): {"left": Parameter("q"), "right": Parameter("1-q")}}
    matched = dot(start.values(), map(Fraction, mus[0])) if rng.chance(Fraction(2, 3)) else None
    return given.model_copy(update={"policy": opened, "matched": matched})


def _over(whole: int, names: Sequence[str], parts: Row) -> dict[str, Fraction]:
    return {name: Fraction(part, whole) for name, part in zip(names, parts, strict=True) if part}


@cache
def _outcomes(count: int) -> tuple[Row, ...]:
    """Where actions can lead: to one or two of so many states and the end."""
    rows = product(range(5), repeat=count + 1)
    return tuple(row for row in rows if sum(row) == 4 and row.count(0) >= count - 1)


def _whole(
    rng: Draws, leaving: Sequence[bool], choices: int, size: int
) -> tuple[tuple[int, int], Sequence[Row], Sequence[_State]]:
    """A discount, whole feature expectations, and states that have them."""
    while True:
        gamma = rng.choice(_GAMMAS)
        unit = 1 if size == 1 else gamma[1]  # features of more than one such expectation are often whole together
        mus = [tuple([unit * number for number in rng.integers(len(leaving), 1, 16 // unit)]) for _ in range(size)]
        states = _states(rng, mus, gamma, leaving, choices)
        if _suit(states):
            return gamma, mus, states


def _states(
    rng: Draws, mus: Sequence[Row], gamma: tuple[int, int], leaving: Sequence[bool], choices: int
) -> list[_State]:
    """States with these feature expectations, by their last action; none, where no last action fits."""
    drawn: list[_State] = []
    rows = _outcomes(len(leaving))
    for number, leaves in enumerate(leaving):
        chances = (12,) if choices == 1 else rng.choice(_CHANCES)
        first = [rng.choice(rows) for _ in chances[1:]]
        made = [_made(number, chances, (*first, last), mus, gamma) for last in rows]
        fitting = [state for state in made if state and state.leaves(number) == leaves]
        if not fitting:
            return []
        drawn.append(rng.choice(fitting))
    return drawn


def _made(
    number: int, chances: Row, outcomes: tuple[Row, ...], mus: Sequence[Row], gamma: tuple[int, int]
) -> _State | None:
    """A state with the features that these expectations ask for; None if they are not small, or actions all alike."""
    above, whole = gamma[0], gamma[1] * 48
    features, differ = [], False
    for mu in mus:
        later = [sum(map(mul, row, mu)) for row in outcomes]
        feature, rest = divmod(mu[number] * whole - above * sum(map(mul, chances, later)), whole)
        if rest or not 0 < feature <= 9 or not any(later):
            return None
        features.append(feature)
        differ = differ or len(set(later)) == len(later)
    return _State(chances, outcomes, tuple(features)) if differ else None


def _suit(states: Sequence[_State]) -> bool:
    """Whether episodes can end, states differ in every feature, and no feature is a multiple of another."""
    features = list(zip(*[state.features for state in states], strict=True))
    ends = any(row[-1] for state in states for row in state.outcomes)
    return ends and all(len(set(column)) > 1 for column in features) and apart(features)


def question(given: Given) -> Question:
    """Motion, policy and features; each feature from every state, then all from the start distribution."""
    numbers = range(1, given.size + 1)
    known = "left open" if given.matched is None else "unknown"
    blocks = (
        *([Paragraph(given.story)] if given.story else []),
        Paragraph("Action $a$ in state $s$ leads to state $s'$ with probability $P_{s s'}^a$:"),
        motion_table(given.motion, given.states, given.terminal),
        *_policy(given),
        Paragraph("These are the features of the states, and the probability $p(s)$ that an episode starts in each:"),
        Table(
            header=("$s$", *(f"$φ_{{{number}}}(s)$" for number in numbers), "$p(s)$"),
            rows=tuple(
                (state, *(f"${shown(value)}$" for value in (*given.features[state], given.start_chances[state])))
                for state in given.states
            ),
        ),
        *(
            [Paragraph(f"The probability ${shown(Parameter(given.asked_for))}$ is {known}.")]
            if given.asked_for and given.asked_for != "gamma"
            else []
        ),
        Paragraph(f"{_ending(given)}{discount(given.gamma)}"),
    )
    if given.matched is not None:
        letter = shown(Parameter(given.asked_for))
        expert = f"The expert's feature expectation from the start distribution is $μ_1(π_E) = {shown(given.matched)}$."
        return Question(blocks, (Part(f"{expert} For which ${letter}$ does this policy match it?", Number()),))
    parts = [
        Part(
            f"$μ_{number}(s)$ is the expected discounted sum of the feature $φ_{number}$ from $s_0 = s$ on, $s_0$ "
            f"included. What is $μ_{number}(s)$ for each state{in_open(given)}?",
            Values(f"μ_{{{number}}}", given.states),
        )
        for number in numbers
    ]
    if given.size == 1:
        parts.append(Part(f"What is $μ_1(π)$ from the start distribution{in_open(given)}?", Number()))
    else:
        ask = f"What are the feature expectations $μ(π)$ from the start distribution{in_open(given)}?"
        parts.append(Part(ask, Numbers(tuple(f"μ_{{{number}}}(π)" for number in numbers))))
    return Question(blocks, tuple(parts))


def _policy(given: Given) -> tuple[Block, ...]:
    if len(given.motion) == 1:
        (action,) = given.motion
        return (Paragraph(f'It is the only action, so the policy is $π("{action}"|s) = 1$ in every state.'),)
    rows = {s: {a: chance for a, chance in row.items() if chance} for s, row in given.policy.items()}
    return Paragraph("The policy is:"), policy_table(rows)


def _ending(given: Given) -> str:
    if not given.terminal:
        return ""
    return f"An episode ends in the terminal state {' or '.join(given.terminal)}, where no features count. "
