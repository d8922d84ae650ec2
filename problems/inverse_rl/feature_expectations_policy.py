"""The exact feature expectations of a policy in a small Markov decision process."""

from collections.abc import Iterable, Mapping, Sequence
from operator import mul
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.beliefs import MotionField, check_distribution, check_motion, motion_table
from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Exact, Parameter, dot, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.feature_vectors import FeaturesField, check_features
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import DistributionField, Names, PolicyField, check_chances, check_keys, policy_table
from rldrill.problems.parts import Number, Numbers, Part, Values
from rldrill.problems.phrases import discount, in_open

TITLE = "Feature expectations of a policy"
SOURCE = "Abbeel & Ng 2004, section 2"
REVISION = 4


class Given(Givens):
    """Where actions lead, the policy, the features, the start distribution and the discount."""

    motion: MotionField = Field(
        min_length=1, description="For every action and state the probabilities of the next states."
    )
    policy: PolicyField = Field(description="The policy.")
    features: FeaturesField = Field(description="The features of every state.")
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
        if self.matched is not None and (len(super().parameters()) != 1 or self.size > 1):
            raise ValueError("matched: leave one number open, which is asked for, and give a single feature")
        for state in self.terminal:
            if state in self.features:
                raise ValueError(f"features: {state!r} is terminal, so no features count there")
        check_features(self.features, self.features)
        check_motion(self.motion, self.states, self.terminal)
        check_keys(self.policy, self.states, "the policy", needed=self.states)
        for state, chances in self.policy.items():
            check_chances(chances, state, tuple(self.motion))
        check_keys(self.start, self.states, "the start probability", needed=())
        check_distribution(self.start, "start")
        return self

    def parameters(self) -> tuple[str, ...]:
        """The parameters that answers are expressions in: none, where what is left open is asked for."""
        return () if self.matched is not None else super().parameters()

    @property
    def asked_for(self) -> str:
        """The parameter that is asked for."""
        return "".join(super().parameters())

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


#: The probability of every next state from every state, whatever is done, in so many parts of 1.
Chain = Mapping[str, Mapping[str, int]]
_CERTAIN = 48
#: Feature expectations, and the features behind them, of every state.
Found = tuple[dict[str, int], dict[str, int]]
#: The probabilities of two actions, in twelfths; and discounts, above and below the line.
_CHANCES = ((6, 6), (3, 9), (9, 3), (4, 8), (8, 4))
_GAMMAS = ((1, 2), (2, 3), (3, 4))

_STATES, _END, _ACTIONS = ("A", "B", "C"), "end", ("left", "right")

#: How many states, actions and features there are.
_SIZES = {1: ((2, 1, 1),), 2: ((2, 2, 1), (2, 2, 2), (3, 1, 1), (2, 1, 2)), 3: ((2, 2, 1),)}


def draw(level: int, rng: Draws) -> Given:
    """One feature and one action; more of them, or of states; a policy with an open probability, or one to be found."""
    count, choices, size = rng.choice(_SIZES[level])
    states, actions = _STATES[:count], _ACTIONS[:choices]
    found = None
    while found is None:
        motion = {action: {state: _outcomes(rng, states) for state in states} for action in actions}
        policy = {state: (12,) if choices == 1 else rng.choice(_CHANCES) for state in states}
        above, below = rng.choice(_GAMMAS)
        chain = {
            state: _row(policy[state], [outcomes[state] for outcomes in motion.values()], states) for state in states
        }
        if _connected(chain) and _suits(level, chain):
            later = [[above * chance for chance in row.values()] for row in chain.values()]
            found = _expected(rng, later, below * _CERTAIN, size)
        if found and choices > 1 and any(_alike([rows[state] for rows in motion.values()], found) for state in states):
            found = None
    start = dict(zip(states, rng.split(count, (3, 4) if count == 2 else (4, 5)), strict=True))
    given = Given(
        motion={action: {state: _over(4, row) for state, row in rows.items()} for action, rows in motion.items()},
        policy={state: _over(12, dict(zip(actions, chances, strict=True))) for state, chances in policy.items()},
        features={state: tuple(Fraction(phi[state]) for _, phi in found) for state in states},
        start=start,
        terminal=(_END,),
        gamma=Fraction(above, below),
    )
    if level < 3:
        return given
    opened = {**given.policy, rng.choice(states): {"left": Parameter("q"), "right": Parameter("1-q")}}
    matched = dot(start.values(), map(Fraction, found[0][0].values())) if rng.chance(Fraction(2, 3)) else None
    return given.model_copy(update={"policy": opened, "matched": matched})


def _over(below: int, row: Mapping[str, int]) -> dict[str, Fraction]:
    return {name: Fraction(above, below) for name, above in row.items()}


def _outcomes(rng: Draws, states: tuple[str, ...]) -> dict[str, int]:
    """Where an action leads, with what probabilities in quarters."""
    targets = rng.sample((*states, _END), 1 + rng.below(2))
    shares, whole = rng.shares(len(targets), (len(targets), 4)[: len(targets)])
    return {target: share * 4 // whole for target, share in zip(targets, shares, strict=True)}


def _row(chances: Iterable[int], choices: Iterable[Mapping[str, int]], states: tuple[str, ...]) -> dict[str, int]:
    """Where a state leads, whatever is done: of every action its probability, and where it leads."""
    row = dict.fromkeys(states, 0)
    for taken, outcomes in zip(chances, choices, strict=True):
        for target, chance in outcomes.items():
            if target in row:
                row[target] += taken * chance
    return row


def _connected(chain: Chain) -> bool:
    """Whether every state leads to one, is not left for itself alone, and the end is reached from somewhere."""
    kept = {state: sum(row.values()) for state, row in chain.items()}
    return min(kept.values()) < _CERTAIN and all(
        chance and chance - chain[state][state] < _CERTAIN for state, chance in kept.items()
    )


def _suits(level: int, chain: Chain) -> bool:
    """Two states: one equation is solved without the other at level 1, and neither is at level 2."""
    coupled = all(chain[one][other] for one in chain for other in chain if one != other)
    return level == 3 or len(chain) > 2 or coupled == (level == 2)


def _alike(rows: Sequence[Mapping[str, int]], found: Sequence[Found]) -> bool:
    """Whether it makes no difference which of some actions is taken."""
    worth = [[sum(chance * mu.get(state, 0) for state, chance in row.items()) for mu, _ in found] for row in rows]
    return worth[0] == worth[1]


def _expected(rng: Draws, later: Sequence[Sequence[int]], below: int, size: int) -> list[Found] | None:
    """Different whole feature expectations whose features are small whole numbers; None where some tries find none."""
    found: dict[tuple[int, ...], list[int]] = {}
    for _ in range(20):
        mu = rng.integers(len(later), 2, 16)
        phi = _features(mu, later, below)
        if len(phi) == len(mu) and len(set(phi)) > 1:
            found[mu] = phi
        if len(found) == size:
            return [(dict(zip(_STATES, mu, strict=False)), dict(zip(_STATES, phi, strict=False)))
                    for mu, phi in found.items()]  # fmt: skip
    return None


def _features(mu: Sequence[int], later: Sequence[Sequence[int]], below: int) -> list[int]:
    """The features behind feature expectations, as far as they are small whole numbers."""
    phi = []
    for own, row in zip(mu, later, strict=True):
        value, rest = divmod(own * below - sum(map(mul, row, mu)), below)
        if rest or not 0 < value <= 9:
            break
        phi.append(value)
    return phi


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
        expert = f"The expert's feature expectation from the start distribution is $μ(π_E) = {shown(given.matched)}$."
        return Question(blocks, (Part(f"{expert} For which ${letter}$ does this policy match it?", Number()),))
    parts = [
        Part(
            f"$μ_{number}(s)$ is the expected discounted sum of the feature $φ_{number}$ from $s_0 = s$ on, $s_0$ "
            f"included. What is $μ_{number}(s)$ for each state{in_open(given)}?",
            Values(f"μ_{{{number}}}", given.states),
        )
        for number in numbers
    ]
    entries = tuple(f"μ_{{{number}}}" for number in numbers)
    ask = f"What are the feature expectations $μ(π)$ from the start distribution{in_open(given)}?"
    parts.append(Part(ask, Numbers(entries)))
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
    return f"An episode ends in {' or '.join(given.terminal)}, where no features count. "
