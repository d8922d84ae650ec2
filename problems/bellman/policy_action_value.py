"""The exact value of every state and action of a small MDP under a policy."""

from fractions import Fraction

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, Scalar
from rldrill.problems.family import Question
from rldrill.problems.models import ModelAndPolicy, PolicyField, model_blocks, policy_blocks
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import discount, in_open
from rldrill.problems.settings import Shape, draw_model, draw_setting

TITLE = "Action values of a policy"
SOURCE = "Sutton & Barto 2018, sections 3.5 and 4.2"
REVISION = 1


class Given(ModelAndPolicy):
    """A model, a policy and the discount; without a policy every action is equally probable."""


def draw(level: int, rng: Draws) -> Given:
    """A deterministic policy; then one that chooses at random; then with a probability left open."""
    setting = draw_setting(rng)
    shape = Shape(states=2, actions=2, branches=1 if level == 1 else 2, denominators=(2,))
    mdp = draw_model(rng, setting, shape)
    open_ = {mdp.states[0]: (Parameter("p"), Parameter("1-p"))} if level == 3 else {}
    sure: tuple[tuple[Scalar, Scalar], ...] = ((Fraction(1), Fraction(0)), (Fraction(0), Fraction(1)))
    policy: PolicyField = {}
    for state, actions in mdp.actions.items():
        chosen = open_.get(state) or rng.choice(sure)
        chances: tuple[Scalar, ...] = rng.split(2, (2, 4)) if level == 2 else chosen
        policy[state] = {action: chance for action, chance in zip(actions, chances, strict=True) if chance != 0}
    return Given(mdp=mdp, policy=policy, gamma=rng.fraction("1/2", "2/3", "4/5"))


def question(given: Given) -> Question:
    """The model and the policy; the values of states, then of states with actions."""
    return Question(
        (*model_blocks(given.mdp), *policy_blocks(given), Paragraph(discount(given.gamma))),
        (
            Part(f"What is $V^π(s)$ for every state{in_open(given)}?", Values("V^π", given.mdp.states)),
            Part(
                f"What is $Q^π(s, a)$ for every state and action{in_open(given)}?",
                Values("Q^π", given.mdp.pairs),
            ),
        ),
    )
