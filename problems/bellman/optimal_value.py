"""The optimal values of a small MDP: V*, a best action in every state, and Q*; or a reward, from one of them."""

from itertools import permutations, product
from typing import Annotated, Self

from pydantic import Discriminator, Field, Tag, model_validator

from rldrill.problems.document import Block, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, Probability, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Model, Named, model_blocks
from rldrill.problems.parts import Number, Part, Policy, Values
from rldrill.problems.phrases import discount
from rldrill.problems.settings import Shape, draw_setting
from rldrill.problems.valued import (
    RewardSought,
    deterministic,
    draw_valued,
    open_reward,
    opened,
    policy_values,
    with_reward,
    worth,
)

TITLE = "Optimal values"
SOURCE = "Sutton & Barto 2018, section 3.6"
REVISION = 7


class Optimal(Givens):
    """A model and the discount."""

    mdp: Model = Field(description="The Markov decision process.")
    gamma: Probability = Field(description="The discount.")

    @model_validator(mode="after")
    def _closed(self) -> Self:
        if self.parameters():
            raise ValueError(f"mdp: {self.parameters()[0]} is left open, so no action can be called best; give numbers")
        return self


class Sought(RewardSought, Givens):
    """A model of two states with one reward left open, the discount, and the optimal value of the other state."""

    mdp: Model = Field(description="The Markov decision process: two states, in one of which a reward is left open.")
    gamma: Probability = Field(description="The discount.")
    optimum: Named[Exact] = Field(
        min_length=1,
        max_length=1,
        description="The optimal value of the state in which no reward is left open.",
        examples=[{"cool": 12}],
    )

    @model_validator(mode="after")
    def _follows(self) -> Self:
        row = open_reward(self.mdp)
        if len(self.mdp.states) != 2:
            raise ValueError("mdp: a reward can be asked for where there are two states, not more or less")
        if self.state == row.state or self.state not in self.mdp.states:
            raise ValueError(f"optimum: give the optimal value of the state that is not {row.state!r}")
        if len(self.mdp.actions[row.state]) < 2:
            raise ValueError(f"mdp: {row.state!r} has no action beside {row.action!r}; give it another one")
        if self.gamma in (0, 1):
            raise ValueError("gamma: give a discount above 0 and below 1")
        return self

    @property
    def state(self) -> str:
        """The state whose optimal value is known."""
        return next(iter(self.optimum))

    @property
    def without(self) -> Model:
        """The model without the action whose reward is left open."""
        rows = tuple(each for each in self.mdp.transitions if each[:2] != self.row[:2])
        return Model(transitions=rows, terminal=self.mdp.terminal)


Given = Annotated[
    Annotated[Optimal, Tag("optimal")] | Annotated[Sought, Tag("sought")],
    Discriminator(lambda given: "sought" if isinstance(given, dict) and "optimum" in given else "optimal"),
]


def draw(level: int, rng: Draws) -> Optimal | Sought:
    """Two states without chance; then with chance; then a reward from an optimal value."""
    gamma = rng.fraction("1/2", "2/3")
    if level == 3:
        shape = Shape(states=2, actions=3, branches=2, denominators=(2,))
        mdp, policy, values, _ = draw_valued(rng, draw_setting(rng), shape, gamma, (-5, -1), forked="own")
        for known, other in permutations(rng.shuffled(mdp.states)):
            ways = [row.action for row in mdp.transitions if (row.state, row.next) == (known, other)]
            if policy[known] in ways and len(ways) > 1:
                break
        else:
            return draw(level, rng)
        asked = rng.choice(mdp.outcomes[other, policy[other]])
        given = Sought(mdp=opened(mdp, asked), gamma=gamma, optimum={known: values[known]})
        return given if _is_telling(given) else draw(level, rng)
    shape = Shape(states=2, actions=2, branches=level, denominators=(2,))
    mdp, policy, *_ = draw_valued(rng, draw_setting(rng), shape, gamma, (-5, -1))
    while level == 1 and of_two_steps(mdp, gamma) != policy:
        mdp, policy, *_ = draw_valued(rng, draw_setting(rng), shape, gamma, (-5, -1))
    return Optimal(mdp=mdp, gamma=gamma)


def of_two_steps(mdp: Model, gamma: Fraction) -> dict[str, str]:
    """The policy that earns most over two steps: seldom far from the best one, so a good one to start with."""
    once = {s: max(worth(mdp, (s, a), {}, gamma) for a in actions) for s, actions in mdp.actions.items()}
    return {s: max(actions, key=lambda a: worth(mdp, (s, a), once, gamma)) for s, actions in mdp.actions.items()}


def _is_telling(given: Sought) -> bool:
    """Whether the reward at which the action starts to be best needs the optimal value of the other state.

    It is the difference of two values, both with what comes after them, and no reward that is printed.
    """
    mdp, state, row = given.without, given.state, given.row
    policies = [dict(zip(mdp.states, chosen, strict=True)) for chosen in product(*mdp.actions.values())]
    every = [policy_values(mdp, deterministic(policy), given.gamma) for policy in policies]
    best = {each: max(values[each] for values in every) for each in mdp.states}
    unpaid = with_reward(given.mdp, Fraction(0))
    worths = {a: worth(mdp, (row.state, a), best, given.gamma) for a in mdp.actions[row.state]}
    rival = max(worths, key=worths.__getitem__)
    least = (best[row.state] - worth(unpaid, row[:2], best, given.gamma)) / Fraction(row.probability)
    shift = best | {state: best[state] + 1}  # does the answer hang on the value of the other state?
    ahead = worth(mdp, (row.state, rival), shift, given.gamma) - worth(unpaid, row[:2], shift, given.gamma)
    at_once = [worth(mdp, (row.state, a), {}, given.gamma) - worth(unpaid, row[:2], {}, given.gamma) for a in worths]
    return (
        ahead != best[row.state] - worth(unpaid, row[:2], best, given.gamma)
        and least * Fraction(row.probability) not in at_once
        and least not in {each.reward for each in given.mdp.transitions}
        and best[state] != given.optimum[state]
        and least.denominator <= 3
        and all(value.denominator <= 3 for value in best.values())
    )


def question(given: Optimal | Sought) -> Question:
    """The model; all optimal values and the best actions; or what follows from one optimal value."""
    blocks = model_blocks(given.mdp)
    return _of_all(given, blocks) if isinstance(given, Optimal) else _of_reward(given, blocks)


def _of_all(given: Optimal, blocks: tuple[Block, ...]) -> Question:
    """The optimal values of states, the best actions, the optimal values of states with actions."""
    return Question(
        (*blocks, Paragraph(discount(given.gamma))),
        (
            Part("What is $V^*(s)$, the optimal value of every state?", Values("V^*", given.mdp.states)),
            Part("Which action $π^*(s)$ is best in every state?", Policy(given.mdp.actions, "π^*")),
            Part("What is $Q^*(s, a)$ for every state and action?", Values("Q^*", given.mdp.pairs)),
        ),
    )


def _of_reward(given: Sought, blocks: tuple[Block, ...]) -> Question:
    """One optimal value is known; the other one, the reward, and the smallest one that decides are asked for."""
    x, state, row = shown(Parameter(given.row.reward)), given.state, given.row
    leading = f" when it leads to {row.next}" if len(given.mdp.outcomes[row.state, row.action]) > 1 else ""
    told = (
        f"{discount(given.gamma)} The reward ${x}$ of {row.action} in {row.state}{leading} is not known, but the "
        f'optimal value of {state} is: $V^*("{state}") = {shown(given.optimum[state])}$.'
    )
    return Question(
        (*blocks, Paragraph(told)),
        (
            Part(f'What is $V^*("{row.state}")$?', Number()),
            Part(f"What is ${x}$?", Number(), zero=True),
            Part(
                f'Now let ${x}$ be any number, so that $V^*("{state}")$ need not be ${shown(given.optimum[state])}$. '
                f"What is the smallest ${x}$ with which {row.action} is a best action in {row.state}?",
                Number(),
                zero=True,
            ),
        ),
    )
