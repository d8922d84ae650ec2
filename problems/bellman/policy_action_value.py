"""The exact value of every state and action of a small MDP under a policy."""

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import ModelAndPolicy, PolicyField, model_blocks, open_chance, policy_blocks
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import discount, in_open
from rldrill.problems.settings import Shape, draw_model, draw_setting
from rldrill.problems.valued import deterministic, draw_mixed, draw_valued, policy_values, tells_apart

TITLE = "Action values of a policy"
SOURCE = "Sutton & Barto 2018, sections 3.5 and 4.2"
REVISION = 6


class Given(ModelAndPolicy):
    """A model, a policy and the discount; without a policy every action is equally probable."""


def draw(level: int, rng: Draws) -> Given:
    """A deterministic policy; then one that chooses at random; then with a probability left open."""
    setting = draw_setting(rng)
    gamma = rng.fraction("1/2", "2/3") if level == 1 else rng.fraction("1/2", "2/3", "4/5")
    if level == 1:
        mdp, chosen, *_ = draw_valued(rng, setting, Shape(states=2, actions=2, branches=1), gamma, (-4, 4))
        return Given(mdp=mdp, policy=deterministic(chosen), gamma=gamma)
    if level == 2:
        mixed = draw_mixed(rng, setting, Shape(states=2, actions=2, branches=2, denominators=(2,)), gamma)
        return Given(mdp=mixed.mdp, policy=mixed.policy, gamma=gamma)
    shape = Shape(states=2, actions=2, branches=2, denominators=(2,))
    gamma, (onward, back) = rng.fraction("1/2", "2/3"), setting.actions[:2]
    third = Fraction(1, 3)
    values: dict[str, Fraction] = {}
    while not values or 0 in values.values() or not tells_apart(mdp.transitions, values, gamma):
        mdp = draw_model(rng, setting, shape)
        taken = {rng.choice((onward, back)): Fraction(1)}
        first, second = mdp.states
        values = policy_values(mdp, {first: {onward: third, back: 1 - third}, second: taken}, gamma)
    policy: PolicyField = {first: {onward: Parameter("p"), back: Parameter("1-p")}, second: {**taken}}
    return Given(mdp=mdp, policy=policy, gamma=gamma)


def question(given: Given) -> Question:
    """The model and the policy; the values of states, then of states with actions."""
    return Question(
        (*model_blocks(given.mdp), *policy_blocks(given), Paragraph(f"{discount(given.gamma)}{open_chance(given)}")),
        (
            Part(f"What is $V^π(s)$ for every state{in_open(given)}?", Values("V^π", given.mdp.states)),
            Part(
                f"What is $Q^π(s, a)$ for every state and action{in_open(given)}?",
                Values("Q^π", given.mdp.pairs),
            ),
        ),
    )
