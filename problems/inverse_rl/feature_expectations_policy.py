"""The exact feature expectations of a policy in a small Markov decision process."""

from fractions import Fraction
from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.beliefs import MotionField, check_distribution, check_motion, motion_table
from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Scalar, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.feature_vectors import FeaturesField, check_features, draw_features
from rldrill.problems.models import DistributionField, Name, PolicyField, check_chances, check_keys, policy_table
from rldrill.problems.parts import Numbers, Part, Values
from rldrill.problems.phrases import discount, in_open
from rldrill.problems.settings import Shape, draw_model, draw_setting

TITLE = "Feature expectations of a policy"
SOURCE = "Abbeel & Ng 2004, section 2"
REVISION = 2


class Given(Givens):
    """Where actions lead, the policy, the features, the start distribution and the discount."""

    motion: MotionField = Field(
        min_length=1, description="For every action and state the probabilities of the next states."
    )
    policy: PolicyField = Field(description="The policy.")
    features: FeaturesField = Field(description="The features of every state.")
    start: DistributionField = Field(description="The probability of every state to start in.")
    terminal: tuple[Name, ...] = Field(default=(), description="The states in which an episode ends.")
    gamma: Discount
    story: str = Field(
        default="", max_length=200, pattern=r"^[^$\\]*$", description="A sentence that is printed first."
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
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


def draw(level: int, rng: Draws) -> Given:
    """One feature and one action; two features and a policy that chooses; the same over three states."""
    setting = draw_setting(rng)
    count = 3 if level == 3 else 2
    shape = Shape(states=count, actions=min(level, 2), branches=2, denominators=(2,))
    model = draw_model(rng, setting, shape)
    motion: dict[str, dict[str, dict[str, Scalar]]] = {}
    for row in model.transitions:
        motion.setdefault(row.action, {}).setdefault(row.state, {})[row.next] = row.probability
    actions = tuple(motion)
    features = draw_features(rng, model.states, min(level, 2), 3)
    return Given(
        motion=motion,
        policy={state: dict(zip(actions, _choices(rng, len(actions)), strict=True)) for state in model.states},
        features=features,
        start=dict(zip(model.states, rng.split(count, (3, 4) if count == 2 else (4, 5)), strict=True)),
        terminal=model.terminal,
        gamma=rng.fraction("1/2", "2/3", "4/5") if level < 3 else rng.fraction("1/2"),
        story=setting.story,
    )


def _choices(rng: Draws, count: int) -> tuple[Fraction, ...]:
    return rng.split(count, (2,)) if count > 1 and rng.chance(Fraction(1, 2)) else _surely(rng.below(count), count)


def _surely(chosen: int, count: int) -> tuple[Fraction, ...]:
    return tuple(Fraction(index == chosen) for index in range(count))


def question(given: Given) -> Question:
    """Motion, policy and features; each feature from every state, then all from the start distribution."""
    numbers = range(1, given.size + 1)
    blocks = (
        *([Paragraph(given.story)] if given.story else []),
        Paragraph("An action $a$ in state $s$ leads to the state $s'$ with the probability $P_{s s'}^a$:"),
        motion_table(given.motion, given.states, given.terminal),
        *((Paragraph("The policy is:"), _policy(given)) if len(given.motion) > 1 else ()),
        Paragraph("The features of the states, and the probabilities $p(s)$ with which an episode starts in them:"),
        Table(
            header=("$s$", *(f"$φ_{{{number}}}(s)$" for number in numbers), "$p(s)$"),
            rows=tuple(
                (state, *(f"${shown(value)}$" for value in (*given.features[state], given.start_chances[state])))
                for state in given.states
            ),
        ),
        Paragraph(f"{_ending(given)}{discount(given.gamma)}"),
    )
    parts = [
        Part(
            f"With $μ_{{{number}}}(s)$ the expected discounted sum of the feature $φ_{{{number}}}$ of the states from "
            f"$s_0 = s$ on, $s_0$ included: what is $μ_{{{number}}}(s)$ for every state{in_open(given)}?",
            Values(f"μ_{{{number}}}", given.states),
            2,
        )
        for number in numbers
    ]
    entries = tuple(f"μ_{{{number}}}" for number in numbers)
    ask = f"What are the feature expectations $μ(π)$ from the start distribution{in_open(given)}?"
    parts.append(Part(ask, Numbers(entries)))
    return Question(blocks, tuple(parts))


def _policy(given: Given) -> Table:
    return policy_table({s: {a: chance for a, chance in row.items() if chance} for s, row in given.policy.items()})


def _ending(given: Given) -> str:
    if not given.terminal:
        return ""
    return f"An episode ends in {' or '.join(given.terminal)}, where no features count. "
