"""Given values held against the Bellman equations: the residual of every state, and whether the values are right."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.model_forms import ALONE
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
from rldrill.problems.parts import Part, Values, YesNo
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Shape, draw_setting
from rldrill.problems.valued import UNITS, draw_mixed, draw_valued, draw_values, draw_worth, tells_apart, worth

TITLE = "Bellman residual"
SOURCE = "Sutton & Barto 2018, sections 3.5, 3.6 and 11.4"
REVISION = 6


class Given(ModelAndPolicy):
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


def draw(level: int, rng: Draws) -> Given:
    """A reward process of two states; then two actions, for a policy or the optimum; then the optimum of three states.

    The values come first, and rewards are chosen so that they are right; then they are changed, all or one or none.
    """
    setting = draw_setting(rng)
    optimal = level == 3 or (level == 2 and rng.chance(Fraction(1, 2)))
    most = level + 1
    gamma = rng.fraction("1/2", "2/3") if level == 1 else rng.fraction("1/2", "2/3", "4/5")
    shape = Shape(states=3 if level == 3 else 2, actions=min(level, 2), branches=2, denominators=(2,))
    policy: PolicyField | None = None
    if optimal:
        mdp, _, values = draw_valued(rng, setting, shape, gamma, (-4, -1), forked="own")
    elif level == 2:
        mdp, policy, values = draw_mixed(rng, setting, shape, gamma, (2, 4))
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
    return Given(mdp=mdp, policy=policy, gamma=gamma, values=claimed, optimal=optimal, verdict=verdict)


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


def question(given: Given) -> Question:
    """The model and the claimed values; their residuals, then the verdict."""
    of = "$V^*$" if given.optimal else "$V^π$" if given.mdp.chooses else "the value function of this process"
    policy: tuple[Block, ...] = () if given.optimal else policy_blocks(given)
    equation = "Bellman optimality equation" if given.optimal else "Bellman equation"
    blocks = (
        *model_blocks(given.mdp),
        *policy,
        Paragraph(f"{discount(given.gamma)} This table $V$ is a candidate for {of}:"),
        values_table(given.values),
        Paragraph(
            f"The residual $δ(s)$ is the right side of the {equation} for $s$, evaluated with $V$, minus $V(s)$."
        ),
    )
    parts = [Part("What is the residual $δ(s)$ of every state?", Values("δ", given.mdp.states), zero=True)]
    if given.verdict:
        parts.append(Part(f"Is $V$ equal to {of}?", YesNo()))
    return Question(blocks, tuple(parts))
