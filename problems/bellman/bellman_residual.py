"""Given values held against the Bellman equations: all residuals; or a reward with which the values are right."""

from typing import Annotated, Self

from pydantic import Discriminator, Field, Tag, model_validator

from rldrill.problems.document import Block, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, Probability, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import (
    Model,
    ModelAndPolicy,
    Named,
    PolicyField,
    check_state_values,
    model_blocks,
    policy_blocks,
    values_table,
)
from rldrill.problems.parts import Number, Part, Values, YesNo
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Shape, draw_setting
from rldrill.problems.transition_tables import ALONE
from rldrill.problems.valued import (
    UNITS,
    RewardSought,
    draw_mixed,
    draw_valued,
    draw_values,
    draw_worth,
    open_reward,
    opened,
    tells_apart,
    with_reward,
    worth,
)

TITLE = "Bellman residual"
SOURCE = "Sutton & Barto 2018, sections 3.5, 3.6 and 11.4"
REVISION = 8

#: The largest reward that is put in for the one that is asked for.
_LARGEST = 12


class Claimed(ModelAndPolicy):
    """A model, a policy and the discount, and values that are claimed for it: the policy's, or the optimal ones."""

    values: Named[Exact] = Field(description="The value that is claimed for every state.")
    verdict: bool = Field(
        default=True,
        exclude_if=lambda verdict: verdict,
        description="Whether it is asked, too, if the values are right.",
    )
    optimal: bool = Field(
        default=False, description="Whether they are claimed to be the optimal values, not the policy's."
    )

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.parameters():
            raise ValueError(f"{self.parameters()[0]} is left open, so it cannot be told whether the values are right")
        if self.optimal and self.policy is not None:
            raise ValueError("policy: optimal values belong to no given policy; leave it out")
        check_state_values(self.values, self.mdp)
        return self


class Sought(RewardSought, Givens):
    """A model with one reward left open, the discount, values that are to be optimal, and a number for the reward."""

    mdp: Model = Field(description="The Markov decision process, in which one reward is left open.")
    gamma: Probability = Field(description="The discount.")
    values: Named[Exact] = Field(description="The value of every state that is to be the optimal one.")
    reward: Exact = Field(description="A number for the reward left open, with which the residuals are asked for.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        row = open_reward(self.mdp)
        if len(self.mdp.actions[row.state]) < 2:
            raise ValueError(f"mdp: {row.state!r} has no action beside {row.action!r}; give it another one")
        if self.gamma == 1:
            raise ValueError(
                "gamma: with a discount of 1 other values may solve the equations, too; choose a smaller one"
            )
        check_state_values(self.values, self.mdp)
        return self


Given = Annotated[
    Annotated[Claimed, Tag("claimed")] | Annotated[Sought, Tag("sought")],
    Discriminator(lambda given: "sought" if isinstance(given, dict) and "reward" in given else "claimed"),
]


def draw(level: int, rng: Draws) -> Claimed | Sought:
    """A reward process of two states; then two actions, for a policy or the optimum; then a reward is asked for.

    The values come first, and rewards are chosen so that they are right; then they are changed, all or one or none.
    """
    if level == 3:
        return _draw_sought(rng)
    setting = draw_setting(rng)
    optimal = level == 2 and rng.chance(Fraction(1, 2))
    most = level + 1
    gamma = rng.fraction("1/2", "2/3") if level == 1 else rng.fraction("1/2", "2/3", "4/5")
    shape = Shape(states=2, actions=level, branches=2, denominators=(2,))
    policy: PolicyField | None = None
    if optimal:
        mdp, _, values, _ = draw_valued(rng, setting, shape, gamma, (-4, -1), forked="own")
    elif level == 2:
        mdp, policy, values = draw_mixed(rng, setting, shape, gamma)
    else:
        values = draw_values(rng, setting.states[:2], gamma)
        mdp = draw_worth(rng, setting, shape, gamma, values, {(s, ALONE): value for s, value in values.items()})
    verdict = rng.chance(Fraction(1, 4))
    right = verdict and rng.chance(Fraction(1, 2))
    wrong = () if right else (rng.choice(mdp.states),) if verdict else mdp.states
    claimed = dict(values)
    for _ in range(20):
        claimed |= {state: values[state] + UNITS[gamma] * rng.nonzero(-most, most) for state in wrong}
        if all(_decided(mdp, state, claimed, gamma, optimal=optimal) for state in mdp.states) and any(
            _discounts(mdp, state, claimed, gamma, optimal=optimal) for state in mdp.states
        ):
            break
    else:
        return draw(level, rng)
    return Claimed(mdp=mdp, policy=policy, gamma=gamma, values=claimed, optimal=optimal, verdict=verdict)


def _draw_sought(rng: Draws) -> Sought:
    """Optimal values and a reward that they hang on; the number for it makes another action best, twice in three."""
    gamma, states = rng.fraction("1/2", "2/3", "4/5"), 2 + rng.below(2)
    shape = Shape(states=states, actions=5 - states, branches=2, denominators=(2,))
    mdp, policy, values, _ = draw_valued(rng, draw_setting(rng), shape, gamma, (-4, -1), forked="own")
    state = rng.choice(mdp.states)
    row = rng.choice(mdp.outcomes[state, policy[state]])
    right = Fraction(row.reward)
    printed = {each.reward for each in mdp.transitions if each is not row}
    after = sum(Fraction(each.probability) * values.get(each.next, 0) for each in mdp.outcomes[state, policy[state]])
    falls = rng.chance(Fraction(2, 3))
    for number in rng.shuffled(range(-_LARGEST, _LARGEST + 1)):
        closed = with_reward(opened(mdp, row), Fraction(number))
        worths = {action: worth(closed, (state, action), values, gamma) for action in mdp.actions[state]}
        best = [action for action, value in worths.items() if value == max(worths.values())]
        near = right != number and abs(right - number) <= _LARGEST // 2
        if near and len(best) == 1 and (best[0] != policy[state]) == falls and right not in printed and after:
            return Sought(mdp=opened(mdp, row), gamma=gamma, values=values, reward=Fraction(number))
    return _draw_sought(rng)


def _decided(mdp: Model, state: str, values: dict[str, Fraction], gamma: Fraction, *, optimal: bool) -> bool:
    """Whether all probabilities matter: actions and outcomes differ in worth, and those that have several are best."""
    rows = [row for row in mdp.transitions if row.state == state]
    if not tells_apart(rows, values, gamma):
        return False
    best = max(mdp.actions[state], key=lambda action: worth(mdp, (state, action), values, gamma))
    return not optimal or all(action == best or len(mdp.outcomes[state, action]) == 1 for action in mdp.actions[state])


def _discounts(mdp: Model, state: str, values: dict[str, Fraction], gamma: Fraction, *, optimal: bool) -> bool:
    """Whether γ matters: what follows the action, the best one where it is chosen, is worth something on average."""
    found = {pair: worth(mdp, pair, values, gamma) for pair in mdp.pairs if pair[0] == state}
    counted = [max(found, key=lambda pair: found[pair])] if optimal else found
    return any(found[pair] != worth(mdp, pair, values, Fraction(0)) for pair in counted)


def question(given: Claimed | Sought) -> Question:
    """The model and the values; their residuals, and the verdict or the reward."""
    return _of_claim(given) if isinstance(given, Claimed) else _of_reward(given)


def _of_reward(given: Sought) -> Question:
    """The reward with which the values are optimal; the residuals with another one."""
    x, row = shown(Parameter(given.row.reward)), given.row
    leading = f" when it leads to {row.next}" if len(given.mdp.outcomes[row.state, row.action]) > 1 else ""
    told = (
        f"{discount(given.gamma)} The reward ${x}$ of {row.action} in {row.state}{leading} is not known. This table $V$"
    )
    blocks = (
        *model_blocks(given.mdp),
        Paragraph(f"{told} is a candidate for $V^*$:"),
        values_table(given.values),
        _meaning("Bellman optimality equation"),
    )
    residuals = Values("δ", given.mdp.states)
    return Question(
        blocks,
        (
            Part(f"For which ${x}$ is $V$ equal to $V^*$?", Number(), zero=True),
            Part(f"Now let ${x} = {shown(given.reward)}$. What is the residual $δ(s)$ of every state?", residuals),
        ),
    )


def _meaning(equation: str) -> Paragraph:
    """What a residual is."""
    return Paragraph(
        f"The residual $δ(s)$ is the right side of the {equation} for $s$, evaluated with $V$, minus $V(s)$."
    )


def _of_claim(given: Claimed) -> Question:
    """All residuals, then the verdict."""
    of = "$V^*$" if given.optimal else "$V^π$" if given.mdp.chooses else "the value function of this process"
    policy: tuple[Block, ...] = () if given.optimal else policy_blocks(given)
    equation = "Bellman optimality equation" if given.optimal else "Bellman equation"
    blocks = (
        *model_blocks(given.mdp),
        *policy,
        Paragraph(f"{discount(given.gamma)} This table $V$ is a candidate for {of}:"),
        values_table(given.values),
        _meaning(equation),
    )
    parts = [Part("What is the residual $δ(s)$ of every state?", Values("δ", given.mdp.states), zero=True)]
    if given.verdict:
        parts.append(Part(f"Is $V$ equal to {of}?", YesNo()))
    return Question(blocks, tuple(parts))
