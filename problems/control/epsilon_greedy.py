"""The probabilities with which an ε-greedy policy takes its actions, also where best actions are tied."""

from pydantic import Field

from rldrill.problems.document import Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, OpenProbability, Parameter
from rldrill.problems.family import Givens, Question
from rldrill.problems.models import Name
from rldrill.problems.parts import Number, Part, Values
from rldrill.problems.phrases import exploration, in_open
from rldrill.problems.runs import action_values_table, draw_row
from rldrill.problems.settings import draw_setting

TITLE = "ε-greedy policy"
SOURCE = "Sutton & Barto 2018, sections 2.2 and 5.4"
REVISION = 1

_MOVES = ("up", "right", "down", "left")


class Given(Givens):
    """The action values of one state, ε, and whether the state's value under the policy is asked for too."""

    state: Name = Field(default="s", description="The name of the state.")
    values: dict[Name, Exact] = Field(min_length=2, max_length=50, description="The value of every action.")
    epsilon: OpenProbability = Field(description="The probability to explore.")
    valued: bool = Field(
        default=False, description="Whether the value of the state under the policy is asked for, too."
    )

    @property
    def best(self) -> tuple[str, ...]:
        """The actions whose value is the greatest."""
        greatest = max(self.values.values())
        return tuple(action for action, value in self.values.items() if value == greatest)


def draw(level: int, rng: Draws) -> Given:
    """Three actions; then four and the state's value; then four of which some are tied, with ε left open."""
    if level == 1:
        setting = draw_setting(rng)
        state, actions = rng.choice(setting.states), setting.actions
    else:
        state, actions = f"r{1 + rng.below(4)}c{1 + rng.below(4)}", _MOVES
    values = draw_row(rng, actions)
    if level == 3:
        greatest = max(values.values())
        tied = rng.sample(actions, rng.choice((2, 3)))
        values |= dict.fromkeys(tied, greatest)
        values |= {action: greatest - rng.whole(1, 5) for action in actions if action not in tied}
    return Given(
        state=state,
        values=values,
        epsilon=Parameter("epsilon") if level == 3 else rng.fraction("1/10", "1/5", "3/10", "2/5", "1/2", "3/5"),
        valued=level > 1,
    )


def question(given: Given) -> Question:
    """The action values and ε; the probability of every action, then what the state is worth."""
    tied = " Actions that are tied for the best share the greedy probability evenly." if len(given.best) > 1 else ""
    blocks = (
        Paragraph(f"An agent is in state {given.state}. These are its action values there:"),
        action_values_table({given.state: given.values}),
        Paragraph(
            "It chooses ε-greedily: with probability $1 − ε$ greedily, with probability $ε$ any of all its actions, "
            f"each with the same probability. {exploration(given.epsilon)}{tied}"
        ),
    )
    where = f'"{given.state}"'
    parts = [
        Part(
            f"With which probability $π(a|{where})$ is every action taken{in_open(given)}?",
            Values("π", tuple(given.values)),
        )
    ]
    if given.valued:
        ask = f"If these action values are those of the policy, what is $V^π({where})${in_open(given)}?"
        parts.append(Part(ask, Number()))
    return Question(blocks, tuple(parts))
