"""The values of actions in one state under a policy, from given values of the states."""

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter
from rldrill.problems.family import Question
from rldrill.problems.models import Dynamics, Lookahead, Transition, transitions_table, values_table
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import discount, in_open
from rldrill.problems.settings import Shape, draw_outcomes, draw_setting

TITLE = "Action values from state values"
SOURCE = "Sutton & Barto 2018, section 3.5"
REVISION = 1


class Given(Lookahead):
    """What the actions of one state do, the values of the states under the policy, and the discount."""


def draw(level: int, rng: Draws) -> Given:
    """One action with two outcomes; then two actions with three; then with a probability left open."""
    setting = draw_setting(rng)
    state, *others = setting.states
    shape = Shape(states=4, actions=2, branches=3, denominators=(2, 4, 5))
    rows: list[Transition] = []
    for action in setting.actions[: 1 if level == 1 else 2]:
        targets = rng.sample(others, 2) if level == 1 else (*rng.sample(others, 1), state, others[-1])
        targets = tuple(dict.fromkeys(targets))
        rows += draw_outcomes(rng, state, action, targets if level < 3 else targets[:2], shape)
    if level == 3:
        p = (Parameter("p"), Parameter("1-p"))
        rows = [row._replace(probability=p[index % 2]) for index, row in enumerate(rows)]
    named = [name for name in setting.states if name == state or any(row.next == name for row in rows)]
    return Given(
        dynamics=Dynamics(transitions=tuple(rows)),
        values=dict(zip(named, rng.distinct(len(named), -4, 10), strict=True)),
        gamma=rng.fraction("1/2", "4/5", "9/10"),
    )


def question(given: Given) -> Question:
    """The model of one state and the values; the value of each of its actions is asked for."""
    pairs = given.dynamics.pairs
    one = f'What is $Q^π("{pairs[0][0]}", "{pairs[0][1]}")${in_open(given)}?'
    every = f'What is $Q^π("{given.state}", a)$ for every action $a${in_open(given)}?'
    blocks = (
        Paragraph(f"In state {given.state} this happens:"),
        transitions_table(given.dynamics),
        Paragraph(f"The values of the states under a policy $π$ are known. {discount(given.gamma)}"),
        values_table(given.values, "V^π"),
    )
    return Question(blocks, (Part(one if len(pairs) == 1 else every, Values("Q^π", pairs)),))
