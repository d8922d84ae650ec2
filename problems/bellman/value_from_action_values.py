"""The value of states from given action values: under a policy, and the optimal one."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Open, Parameter, Scalar, shown
from rldrill.problems.family import Givens, Question, flag
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Name, Named, PolicyField, check_chances, check_keys, policy_table, values_table
from rldrill.problems.names import once, read_name
from rldrill.problems.parts import Number, Part, Values
from rldrill.problems.phrases import in_open
from rldrill.problems.runs import action_values_table
from rldrill.problems.settings import Setting, draw_setting

TITLE = "State values from action values"
SOURCE = "Sutton & Barto 2018, sections 3.5 and 3.6"
REVISION = 4


class Given(Givens):
    """The action values of some states, and a policy for them.

    With known values of states, or values said to be equal, the one number that is left open is asked for.
    """

    values: Named[Named[Open]] = Field(min_length=1, description="For every state the values of its actions.")
    policy: PolicyField = Field(description="The policy in these states.")
    known: Annotated[dict[Name, Exact], Field(min_length=1, max_length=1), once(read_name)] | None = Field(
        default=None, description="A state's value under the policy, by which to find it."
    )
    equal: bool = flag("Whether what is left open is to make the values of the two states equal.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        states = tuple(self.values)
        check_keys(self.policy, states, "the policy", needed=states)
        for state, row in self.values.items():
            if not row:
                raise ValueError(f"values: the action values of {state!r} are missing; add them")
            check_chances(self.policy[state], state, tuple(row))
        check_keys(self.known or {}, states, "the known value", needed=())
        if self.equal and (self.known or len(states) != 2):
            raise ValueError("equal: give two states, and no known value")
        if self.finds and len(self.unknown) != 1:
            raise ValueError("values: leave exactly one number open, such as p or x; it is asked for")
        return self

    @property
    def finds(self) -> bool:
        """Whether what is left open is asked for."""
        return self.equal or self.known is not None

    @property
    def unknown(self) -> tuple[str, ...]:
        """What is left open, to be found or for good."""
        return self.left_open

    def parameters(self) -> tuple[str, ...]:
        """What answers are expressions in: nothing, where what is left open is asked for."""
        return () if self.finds else self.unknown


def draw(level: int, rng: Draws) -> Given:
    """One state with two actions; then two or three with more; then a number is to be found."""
    setting = draw_setting(rng)
    if level == 3:
        return _to_find(rng, setting)
    states = setting.states[: 1 if level == 1 else 2 + rng.below(2)]
    actions = setting.actions[: 2 if level == 1 else 2 + rng.below(2)]
    values = {state: dict(zip(actions, rng.distinct(len(actions), -6, 12), strict=True)) for state in states}
    policy = {state: dict(zip(actions, rng.split(len(actions), (4, 5, 10)), strict=True)) for state in states}
    return Given(values=values, policy=policy)


def _to_find(rng: Draws, setting: Setting) -> Given:
    """A probability that two states share, or the probability or the action value that makes two states equal."""
    states = setting.states[:2]
    kind = rng.choice(("share", "missing", "equal"))
    actions = setting.actions[:2]
    if kind == "missing":
        return _without_one(rng, states, setting.actions[: 2 + rng.below(2)])
    values = {state: dict(zip(actions, rng.distinct(len(actions), -6, 12), strict=True)) for state in states}
    p: tuple[Scalar, ...] = (Parameter("p"), Parameter("1-p"))
    chance = rng.fraction("1/4", "3/4", "1/3", "2/3", "2/5", "3/5")
    ways = [p, rng.choice((p, p[::-1])) if kind == "share" else p[::-1]]
    policy = {state: dict(zip(actions, way, strict=True)) for state, way in zip(states, ways, strict=True)}
    first, second = (values[state] for state in states)
    onward, back = actions
    mean = chance * first[onward] + (1 - chance) * first[back]
    if kind == "equal":  # (1 − p) Q(onward) + p Q(back) of the second state is the same
        second[onward] = (mean - chance * second[back]) / (1 - chance)
        return Given(values=values, policy=policy, equal=True)
    return Given(values=values, policy=policy, known={states[0]: mean})


def _without_one(rng: Draws, states: tuple[str, ...], actions: tuple[str, ...]) -> Given:
    """The value of one action is missing with which both states are worth the same."""
    values = {state: dict(zip(actions, rng.distinct(len(actions), -6, 12), strict=True)) for state in states}
    policy = {state: dict(zip(actions, rng.split(len(actions), (4, 5, 10)), strict=True)) for state in states}
    (first, second), hidden = states, rng.choice(actions)
    rest = sum((policy[second][a] * values[second][a] for a in actions if a != hidden), Fraction(0))
    worth = sum((policy[first][a] * values[first][a] for a in actions), Fraction(0))
    missing = (worth - rest) / policy[second][hidden]
    if missing.denominator > 1 or abs(missing) > _LARGEST or policy[first] == policy[second]:
        return _without_one(rng, states, actions)
    row: dict[str, Scalar] = {**values[second], hidden: Parameter("x")}
    return Given(values={first: values[first], second: row}, policy=policy, equal=True)


#: No action value that is asked for is larger.
_LARGEST = 20


def question(given: Given) -> Question:
    """The action values and the policy; the values under it, and the optimal ones unless something is left open."""
    states = tuple(given.values)
    blocks: list[Block] = [
        Paragraph("An agent has a table of action values:"),
        action_values_table(given.values),
        Paragraph("Its policy $π$ is:"),
        policy_table(given.policy),
    ]
    if given.finds:
        return _found(given, blocks)
    ask = f"What is {_every('V^π', states)}{in_open(given)}?"
    parts = [Part(f"The table holds $Q^π$, the action values of this policy. {ask}", Values("V^π", states))]
    if not given.parameters():
        ask = f"Suppose instead that the table holds $Q^*$, the optimal action values. What is {_every('V^*', states)}?"
        parts.append(Part(ask, Values("V^*", states)))
    return Question(tuple(blocks), tuple(parts))


def _every(head: str, states: tuple[str, ...]) -> str:
    """The values of all states, to be asked for; that of one by its name."""
    return f'${head}("{states[0]}")$' if len(states) == 1 else f"${head}(s)$ for every state"


def _found(given: Given, blocks: list[Block]) -> Question:
    sign = shown(Parameter(given.unknown[0]))
    chosen = any(isinstance(chance, Parameter) for row in given.policy.values() for chance in row.values())
    hidden = (
        f"The probability ${sign}$ is not known, $0 < {sign} < 1$."
        if chosen
        else f"The action value ${sign}$ is not known."
    )
    told = f"The table holds $Q^π$, the action values of this policy. {hidden}"
    if given.known is None:
        first, second = given.values
        ask = f'For which ${sign}$ is $V^π("{first}") = V^π("{second}")$?'
        return Question((*blocks, Paragraph(told)), (Part(ask, Number()),))
    blocks += [Paragraph(f"{told} This value is known, too:"), values_table(given.known, "V^π")]
    parts = [Part(f"What is ${sign}$?", Number())]
    if others := tuple(state for state in given.values if state not in given.known):
        which = f'$V^π("{others[0]}")$' if len(others) == 1 else "$V^π(s)$ for every other state"
        parts.append(Part(f"What is {which}?", Values("V^π", others)))
    return Question(tuple(blocks), tuple(parts))
