"""Values and policies of some rounds of policy iteration; or the reward up to which it ends at once."""

from collections.abc import Iterator
from typing import Annotated, Self

from pydantic import Discriminator, Field, Tag, model_validator

from rldrill.problems.document import Block, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, Probability, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import DeterministicField, Model, check_policy, model_blocks
from rldrill.problems.parts import Number, Part, Policy, Values, YesNo
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Shape, draw_setting
from rldrill.problems.valued import (
    UNITS,
    RewardSought,
    Valued,
    choices_table,
    deterministic,
    draw_valued,
    open_reward,
    opened,
    policy_values,
    with_reward,
    worth,
)

TITLE = "Policy iteration"
SOURCE = "Sutton & Barto 2018, section 4.3"
REVISION = 7

#: What each action is worth.
Worths = dict[tuple[str, str], Fraction]

#: How far above its bound the reward is that policy iteration goes on with.
_ABOVE = tuple(range(1, 13))
_LARGEST = 15
#: Policies of so many states are tried out for ties.
_TRIED = 6


class Started(Givens):
    """A model, the policy to start from, and the discount."""

    mdp: Model = Field(description="The Markov decision process.")
    start: DeterministicField = Field(description="The action of the policy to start from in every state.")
    gamma: Probability = Field(description="The discount.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_policy(deterministic(self.start), self.mdp)
        return self


class Rounds(Started):
    """A model, the policy to start from, the discount, and how many rounds of evaluation and improvement."""

    rounds: int = Field(ge=1, le=12, description="How many rounds of evaluation and improvement.")


class Threshold(RewardSought, Started):
    """A model with one reward left open, the policy to start from, the discount, and a number for the reward."""

    reward: Exact = Field(
        description="A number for the reward that is left open, with which its action is better than the policy's own."
    )

    @model_validator(mode="after")
    def _leaves_one_open(self) -> Self:
        row = open_reward(self.mdp)
        if self.start[row.state] == row.action:
            raise ValueError(f"start: the reward of {row.action!r} in {row.state!r} is left open; start with another")
        if self.gamma == 1:
            raise ValueError("gamma: with a discount of 1 a policy need not have a value; choose a smaller one")
        return self

    @property
    def improved(self) -> dict[str, str]:
        """The policy with the action whose reward is left open, in its state."""
        return self.start | {self.row.state: self.row.action}


def _kind(given: object) -> str | None:
    match given:
        case {"rounds": _, "reward": _}:
            return None
        case {"reward": _}:
            return "threshold"
    return "rounds"


Given = Annotated[
    Annotated[Rounds, Tag("rounds")] | Annotated[Threshold, Tag("threshold")],
    Discriminator(
        _kind,
        custom_error_type="kind",
        custom_error_message="rounds are worked out, or a reward is taken for the one left open; give one of them",
    ),
]


def draw(level: int, rng: Draws) -> Rounds | Threshold:
    """One round over two states whose moves are certain; then two rounds; then a reward is left open."""
    gamma = rng.choice(tuple(UNITS)[:2])
    if level == 3:
        return _draw_threshold(gamma, rng)
    shape = Shape(states=2, actions=3 if level == 1 else 2 + rng.below(2), branches=level, denominators=(2,))
    optimal = rng.chance(Fraction(1, 2))
    others = {1: (-4, -1), 2: (-2, 2)}[level] if optimal else (-1, 3)  # what is better than the policy's own
    while True:
        drawn = draw_valued(rng, draw_setting(rng), shape, gamma, others, forked="own")
        if _looks_ahead(drawn, gamma) and _settles(drawn, gamma, level) == optimal:
            return Rounds(mdp=drawn.mdp, start=drawn.policy, gamma=gamma, rounds=level)


def _improvements(
    mdp: Model, start: dict[str, str], gamma: Fraction, rounds: int, ahead: Worths | None = None
) -> Iterator[tuple[dict[str, str], Worths, dict[str, str]]]:
    """For every round the policy, what each action is worth with its values, and the policy that improvement gives.

    What the actions are worth with the first policy's values may be known.
    """
    policy = dict(start)
    for _ in range(rounds):
        if ahead is None:
            values = policy_values(mdp, deterministic(policy), gamma)
            ahead = {pair: worth(mdp, pair, values, gamma) for pair in mdp.pairs}
        ranks = {pair: (found, policy[pair[0]] == pair[1]) for pair, found in ahead.items()}
        better = {s: max(((s, a) for a in actions), key=ranks.__getitem__)[1] for s, actions in mdp.actions.items()}
        yield policy, ahead, better
        policy, ahead = better, ahead if better == policy else None


def _settles(drawn: Valued, gamma: Fraction, rounds: int) -> bool:
    """Whether the last of so many rounds changes nothing: the policy that it evaluates is an optimal one."""
    *_, (before, _, after) = _improvements(drawn.mdp, drawn.policy, gamma, rounds, drawn.worths)
    return before == after


def _looks_ahead(drawn: Valued, gamma: Fraction) -> bool:
    """Whether neither rewards alone, nor next values alone, nor both without γ show which policy improvement gives."""
    at_once = {
        pair: sum(Fraction(row.probability) * Fraction(row.reward) for row in rows)
        for pair, rows in drawn.mdp.outcomes.items()
    }
    later = {pair: worth - at_once[pair] for pair, worth in drawn.worths.items()}
    together = {pair: at_once[pair] + later[pair] / gamma for pair in later}
    best, *others = (
        [max(actions, key=lambda action: found[state, action]) for state, actions in drawn.mdp.actions.items()]
        for found in (drawn.worths, at_once, later, together)
    )
    return best not in others


def _draw_threshold(gamma: Fraction, rng: Draws) -> Threshold:
    """An optimal policy, and a reward that makes it worse than another one, which has readable values, too."""
    states = 2 + rng.below(2)
    shape = Shape(states=states, actions=5 - states, branches=2, denominators=(2,))
    mdp, start, values, worths = draw_valued(rng, draw_setting(rng), shape, gamma, (-4, -1), forked="own")
    pair = rng.choice([(state, action) for state, action in mdp.pairs if action != start[state]])
    row = rng.choice(mdp.outcomes[pair])
    if not _needs_values(mdp, pair, start[pair[0]], values):
        return _draw_threshold(gamma, rng)
    unpaid = opened(mdp, row)
    bound = Fraction(row.reward) + (values[pair[0]] - worths[pair]) / Fraction(row.probability)
    if bound in {0, *(each.reward for each in mdp.transitions)}:  # it could be read off the table
        return _draw_threshold(gamma, rng)
    for above in rng.shuffled(_ABOVE):
        improved = deterministic(start | {pair[0]: pair[1]})
        better = policy_values(with_reward(unpaid, bound + above), improved, gamma)
        if bound + above <= _LARGEST and all(value and value.denominator <= 2 for value in better.values()):
            return Threshold(mdp=unpaid, start=start, gamma=gamma, reward=bound + above)
    return _draw_threshold(gamma, rng)


def _needs_values(mdp: Model, pair: tuple[str, str], chosen: str, values: dict[str, Fraction]) -> bool:
    """Whether what follows the two actions is worth different numbers: else the rewards alone say which is better."""
    return _afterwards(mdp, pair, values) != _afterwards(mdp, (pair[0], chosen), values)


def _afterwards(mdp: Model, pair: tuple[str, str], values: dict[str, Fraction]) -> Fraction:
    """What the state after an action is worth on average."""
    return sum((Fraction(row.probability) * values.get(row.next, 0) for row in mdp.outcomes[pair]), Fraction(0))


def question(given: Rounds | Threshold) -> Question:
    """The model and the first policy; values and policies are asked for, or when the first is optimal."""
    blocks = (
        *model_blocks(given.mdp),
        Paragraph("Policy iteration starts from this policy:"),
        choices_table(given.start, "π_0"),
    )
    return _of_rounds(given, blocks) if isinstance(given, Rounds) else _of_threshold(given, blocks)


def _of_rounds(given: Rounds, blocks: tuple[Block, ...]) -> Question:
    """Values and policy of every round are asked for."""
    kept = " Improvement changes an action only where another one is better: on a tie the old action is kept."
    rule = Paragraph(f"{discount(given.gamma)} Each policy is evaluated exactly.{kept if _ties(given) else ''}")
    parts = []
    for number in range(given.rounds):
        after = f"π_{{{number + 1}}}"
        parts += [
            _values_asked(given.mdp, number),
            Part(f"Which policy ${after}$ does improvement give?", Policy(given.mdp.actions, after)),
        ]
    last = Part(f"Is $π_{{{given.rounds - 1}}}$ an optimal policy?", YesNo())
    return Question((*blocks, rule), (*parts, last))


def _ties(given: Rounds) -> bool:
    """Whether several actions are best in an improvement; where that takes long to find out, they may be."""
    if given.gamma == 1 or given.parameters() or len(given.mdp.states) > _TRIED:
        return True
    return any(
        [ahead[state, action] for action in actions].count(ahead[state, better[state]]) > 1
        for _, ahead, better in _improvements(given.mdp, dict(given.start), given.gamma, given.rounds)
        for state, actions in given.mdp.actions.items()
    )


def _of_threshold(given: Threshold, blocks: tuple[Block, ...]) -> Question:
    """The values of the first policy, the reward up to which it is optimal, and the values of the next one."""
    x, row = shown(Parameter(given.row.reward)), given.row
    told = Paragraph(f"{discount(given.gamma)} The reward ${x}$ of {row.action} in {row.state} is not known yet.")
    return Question(
        (*blocks, told),
        (
            _values_asked(given.mdp, 0),
            Part(f"What is the largest ${x}$ with which $π_0$ is an optimal policy?", Number(), zero=True),
            _values_asked(given.mdp, 1, f"Now let ${x} = {shown(given.reward)}$. "),
        ),
    )


def _values_asked(mdp: Model, number: int, before: str = "") -> Part:
    of = f"V^{{π_{{{number}}}}}"
    policy = "every state" if not before else "every state under the policy that improvement gives"
    return Part(f"{before}What is ${of}(s)$, the value of {policy}?", Values(of, mdp.states))
