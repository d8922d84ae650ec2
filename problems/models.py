"""Models of Markov decision processes, policies and trajectories, as problems give them."""

from collections import Counter
from collections.abc import Iterable, Mapping
from fractions import Fraction
from functools import cached_property
from typing import Annotated, Any, NamedTuple, Self

from pydantic import BeforeValidator, Field, GetJsonSchemaHandler, WithJsonSchema, model_validator
from pydantic_core import CoreSchema

from rldrill.problems.document import Beside, Block, Paragraph, Table, joined
from rldrill.problems.exact import (
    Discount,
    Open,
    OpenProbability,
    Parameter,
    Scalar,
    shown,
)
from rldrill.problems.family import Givens
from rldrill.problems.grids import Grid, read_grid
from rldrill.problems.gymnasium import SCHEMA, read_environment
from rldrill.problems.phrases import terminal_note
from rldrill.problems.pictures import Arrow, StateDiagram

#: Models up to this size are drawn beside their table.
_DRAWN_STATES, _DRAWN_TRANSITIONS = 4, 16


def _name(value: object) -> object:
    return str(value) if isinstance(value, int) and not isinstance(value, bool) else value


#: The name of a state, an action or a hypothesis. Dollar signs and backslashes would be read as mathematics.
Name = Annotated[
    str,
    BeforeValidator(_name),
    Field(pattern=r"^[^\W_](?:[\w .'()+-]*[\w.'()+₀-₉-])?$", max_length=24),
    WithJsonSchema({"type": ["string", "integer"], "title": "a name"}),
]


class Transition(NamedTuple):
    """One line of a model: with this probability the action leads there and earns this reward."""

    state: Name
    action: Name
    next: Name
    probability: OpenProbability
    reward: Open


class Dynamics(Givens):
    """Where actions lead from some states; nothing is said about the states that they lead to."""

    transitions: tuple[Transition, ...] = Field(
        min_length=1, description="The transitions; those of a state and action have probabilities that sum to 1."
    )

    @model_validator(mode="after")
    def _distributions(self) -> Self:
        doubled = [key for key, count in Counter(t[:3] for t in self.transitions).items() if count > 1]
        if doubled:
            state, action, after = doubled[0]
            raise ValueError(f"the transition {state}, {action}, {after} is given twice; give each once")
        for (state, action), outcomes in self.outcomes.items():
            if not sums_to_one([outcome.probability for outcome in outcomes]):
                total = sum(o.probability for o in outcomes if isinstance(o.probability, Fraction))
                raise ValueError(f"the probabilities of {action!r} in {state!r} sum to {total}, not to 1")
        return self

    @cached_property
    def outcomes(self) -> dict[tuple[str, str], tuple[Transition, ...]]:
        """The transitions of every state and action."""
        found: dict[tuple[str, str], list[Transition]] = {}
        for transition in self.transitions:
            found.setdefault((transition.state, transition.action), []).append(transition)
        return {pair: tuple(rows) for pair, rows in found.items()}

    @cached_property
    def states(self) -> tuple[str, ...]:
        """The states in which an action is taken, in their order in the file."""
        return tuple(dict.fromkeys(transition.state for transition in self.transitions))

    @cached_property
    def actions(self) -> dict[str, tuple[str, ...]]:
        """The actions of every state."""
        found: dict[str, list[str]] = {state: [] for state in self.states}
        for state, action in self.outcomes:
            found[state].append(action)
        return {state: tuple(actions) for state, actions in found.items()}

    @property
    def pairs(self) -> tuple[tuple[str, str], ...]:
        """Every state with every action that it has."""
        return tuple(self.outcomes)


class Model(Dynamics):
    """A finite Markov decision process: its transitions, and the states in which an episode ends.

    Files may also give it as a ``grid`` drawn as text, or as the ID of a ``gymnasium`` environment.
    """

    terminal: tuple[Name, ...] = Field(default=(), description="The states in which an episode ends.")
    story: str = Field(
        default="", max_length=200, pattern=r"^[^$\\]*$", description="A sentence that is printed first."
    )

    @classmethod
    def __get_pydantic_json_schema__(cls, core: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return {"anyOf": [handler(core), handler(Grid.__pydantic_core_schema__), SCHEMA]}

    @model_validator(mode="before")
    @classmethod
    def _other_forms(cls, data: object) -> object:
        if isinstance(data, dict) and "grid" in data:
            return read_grid(data)
        if isinstance(data, dict) and "gymnasium" in data:
            return read_environment(data)
        return data

    @model_validator(mode="after")
    def _closed(self) -> Self:
        for state in self.states:
            if state in self.terminal:
                raise ValueError(f"{state!r} is terminal, so no action can be taken there")
        known = {*self.states, *self.terminal}
        for transition in self.transitions:
            if transition.next not in known:
                raise ValueError(
                    f"{transition.next!r} is reached but has no action; give it one or list it as terminal"
                )
        return self


def check_keys(values: Mapping[str, object], known: tuple[str, ...], what: str, needed: tuple[str, ...]) -> None:
    """Demand that a mapping names the needed keys, and none that is not known."""
    for key in needed:
        if key not in values:
            raise ValueError(f"{what} of {key!r} is missing")
    for key in values:
        if key not in known:
            named = f"known are {joined(list(known))}" if known else "none is known"
            raise ValueError(f"{what} is given for {key!r}, which does not occur; {named}")


def sums_to_one(probabilities: Iterable[Scalar]) -> bool:
    """Whether probabilities sum to 1; a parameter and its complement do."""
    rest = Fraction(1)
    balance: Counter[str] = Counter()
    for probability in probabilities:
        if isinstance(probability, Parameter):
            balance[probability.symbol] += -1 if probability.complement else 1
            rest -= 1 if probability.complement else 0
        else:
            rest -= probability
    return rest == 0 and not any(balance.values())


Policy = Mapping[str, Mapping[str, OpenProbability]]


def read_policy(value: object) -> object:
    """Let a deterministic policy be written ``{cool = "fast"}``; ``equiprobable`` needs the model, so it stays."""
    if isinstance(value, dict):
        return {state: {choice: 1} if isinstance(choice, str) else choice for state, choice in value.items()}
    return value


PolicyField = Annotated[
    dict[Name, dict[Name, OpenProbability]],
    BeforeValidator(read_policy),
    WithJsonSchema(
        {"type": "object", "title": "a table: for every state its action, or the probabilities of its actions"}
    ),
]


def equiprobable(model: Dynamics) -> dict[str, dict[str, Scalar]]:
    """The policy that takes every action of a state with the same probability."""
    return {
        state: {action: Fraction(1, len(actions)) for action in actions} for state, actions in model.actions.items()
    }


def check_policy(policy: Policy, model: Dynamics) -> None:
    """Demand a distribution over the actions of every state.

    Raises:
        ValueError: a state is missing, an action unknown, or probabilities do not sum to 1.
    """
    check_keys(policy, model.states, "the policy", needed=model.states)
    for state, chances in policy.items():
        check_chances(chances, state, model.actions[state])


def check_chances(chances: Mapping[str, Scalar], state: str, actions: tuple[str, ...], of: str = "the policy") -> None:
    """Demand a distribution over the actions of one state.

    Raises:
        ValueError: an action is unknown, or the probabilities do not sum to 1.
    """
    check_keys(chances, actions, f"{of} in {state!r}", needed=())
    if not sums_to_one(list(chances.values())):
        raise ValueError(f"{of}'s probabilities in {state!r} do not sum to 1")


class ModelAndPolicy(Givens):
    """A model, a policy and the discount; without a policy every action is equally probable."""

    mdp: Model = Field(description="The Markov decision process.")
    policy: PolicyField | None = Field(
        default=None, description="The policy; without it every action is equally probable (equiprobable)."
    )
    gamma: Discount

    @model_validator(mode="after")
    def _policy_fits(self) -> Self:
        if self.policy is not None:
            check_policy(self.policy, self.mdp)
        return self

    @property
    def chances(self) -> PolicyField:
        """The policy, written out."""
        return self.policy or equiprobable(self.mdp)


class Lookahead(Givens):
    """What the actions of one state do, the values of the next states and the discount."""

    dynamics: Dynamics = Field(description="What the actions of the state do.")
    values: dict[Name, Open] = Field(min_length=1, description="The values of the next states.")
    gamma: Discount

    @model_validator(mode="after")
    def _values_fit(self) -> Self:
        if len(self.dynamics.states) != 1:
            raise ValueError("dynamics must hold the actions of one state only")
        reached = tuple(dict.fromkeys(transition.next for transition in self.dynamics.transitions))
        check_keys(self.values, (*reached, self.state), "the value", needed=reached)
        return self

    @property
    def state(self) -> str:
        """The state in which the actions are taken."""
        return self.dynamics.states[0]


def policy_blocks(given: ModelAndPolicy) -> tuple[Block, ...]:
    """The policy as a question gives it; nothing where there is nothing to choose."""
    if all(len(actions) == 1 for actions in given.mdp.actions.values()):
        return ()
    return (Paragraph("The policy is:"), policy_table(given.chances))


def transitions_table(model: Dynamics) -> Table:
    """The model as a table, one line for every transition."""
    return Table(
        header=("$s$", "$a$", "$s'$", "$P_{s s'}^a$", "$R_{s s'}^a$"),
        rows=tuple(
            (t.state, t.action, t.next, f"${shown(t.probability)}$", f"${shown(t.reward)}$") for t in model.transitions
        ),
    )


def model_blocks(model: Model) -> tuple[Block, ...]:
    """A model as a question gives it: the story, its transitions, and what a terminal state is worth."""
    told = f"{model.story} " if model.story else ""
    table = transitions_table(model)
    drawn = len(model.states) <= _DRAWN_STATES and len(model.transitions) <= _DRAWN_TRANSITIONS
    arrows = " (on the arrows: probability, reward)" if drawn else ""
    opening = Paragraph(f"{told}This Markov decision process moves and pays like this{arrows}:")
    return (opening, Beside((table, state_diagram(model))) if drawn else table, *terminal_note(model.terminal))


def state_diagram(model: Model) -> StateDiagram:
    """The model as a picture, with the same data as its table."""
    return StateDiagram(
        states=(*model.states, *model.terminal),
        terminal=model.terminal,
        arrows=tuple(
            Arrow(t.state, t.action, t.next, f"${shown(t.probability)}$", f"${shown(t.reward)}$")
            for t in model.transitions
        ),
    )


def values_table(values: Mapping[str, Scalar], of: str = "V") -> Table:
    """A table of values, one column for every state."""
    return Table(
        header=("$s$", *values),
        rows=((f"${of}(s)$", *(f"${shown(value)}$" for value in values.values())),),
    )


def policy_table(policy: Policy, **others: Policy) -> Table:
    """A stochastic policy, one line for every state and action; other policies by their letters, beside it."""
    policies = {"π": policy} | others
    return Table(
        header=("$s$", "$a$", *(f"${letter}(a|s)$" for letter in policies)),
        rows=tuple(
            (state, action, *(f"${shown(other[state].get(action, Fraction(0)))}$" for other in policies.values()))
            for state in policy
            for action in dict.fromkeys(action for other in policies.values() for action in other[state])
        ),
    )
