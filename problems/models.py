"""Models of Markov decision processes, policies and trajectories, as problems give them."""

from collections import Counter
from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Annotated, Any, NamedTuple, Self, TypeVar

from pydantic import (
    AfterValidator,
    BeforeValidator,
    Field,
    GetJsonSchemaHandler,
    ValidationInfo,
    WithJsonSchema,
    field_validator,
    model_validator,
)
from pydantic_core import CoreSchema

from rldrill.problems.document import Beside, Block, Paragraph, Table, joined
from rldrill.problems.draws import Draws
from rldrill.problems.exact import (
    Discount,
    Open,
    OpenProbability,
    Parameter,
    Probability,
    Scalar,
    shown,
)
from rldrill.problems.family import Givens, flag
from rldrill.problems.fractions import Fraction
from rldrill.problems.grids import Grid
from rldrill.problems.model_forms import SCHEMAS, read_dynamics, read_form
from rldrill.problems.names import once, read_name
from rldrill.problems.phrases import terminal_note
from rldrill.problems.pictures import Arrow, StateDiagram
from rldrill.problems.policy_forms import by_states
from rldrill.problems.readings import Note, distribution, note_of, told
from rldrill.problems.recurrence import end_components
from rldrill.problems.transition_tables import ALONE

Chance = TypeVar("Chance")

#: Models up to this size are drawn beside their table.
_DRAWN_STATES, _DRAWN_TRANSITIONS = 4, 16
#: So many states are solved exactly in seconds.
MOST_STATES = 1024
_MOST_TRANSITIONS = 1_000_000
#: So many steps of a run are updated one by one in seconds.
MOST_STEPS = 10_000

Entry = TypeVar("Entry")
#: The name of a state, an action or a hypothesis.
Name = Annotated[str, BeforeValidator(read_name), WithJsonSchema({"type": ["string", "integer"], "title": "a name"})]
#: A table with an entry for every name of some states, actions or hypotheses.
Named = Annotated[dict[Name, Entry], Field(max_length=MOST_STATES), once(read_name)]
#: The same for what the world may be like, of which there may be more: a sum over all of them takes a second.
Hypotheses = Annotated[dict[Name, Entry], Field(max_length=5000), once(read_name)]
#: Names of some states, actions or hypotheses.
Names = Annotated[tuple[Name, ...], Field(max_length=MOST_STATES)]
#: What was seen at every step of a run.
Steps = Annotated[tuple[Entry, ...], Field(max_length=MOST_STEPS)]


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
        min_length=1,
        max_length=_MOST_TRANSITIONS,
        description="The transitions; those of a state and action have probabilities that sum to 1.",
    )

    @model_validator(mode="before")
    @classmethod
    def _tables(cls, data: object) -> object:
        return read_dynamics(data)

    @field_validator("transitions")
    @classmethod
    def _as_meant(cls, rows: tuple[Transition, ...], info: ValidationInfo) -> tuple[Transition, ...]:
        return _added_up(rows, note_of(info))

    @model_validator(mode="after")
    def _distributions(self) -> Self:
        for (state, action), outcomes in self.outcomes.items():
            check_sum([outcome.probability for outcome in outcomes], f"the probabilities of {action!r} in {state!r}")
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

    @cached_property
    def every_action(self) -> tuple[str, ...]:
        """All actions that there are."""
        return tuple(dict.fromkeys(action for _, action in self.outcomes))

    @property
    def chooses(self) -> bool:
        """Whether there are actions; without any it is a Markov reward process."""
        return any(transition.action != ALONE for transition in self.transitions)

    @property
    def pairs(self) -> tuple[tuple[str, str], ...]:
        """Every state with every action that it has."""
        return tuple(self.outcomes)


class Model(Dynamics):
    """A finite Markov decision process: its transitions, and the states in which an episode ends.

    Files may also give it in one of the forms of ``model_forms``, such as a ``grid`` drawn as text. Where no state
    is called terminal, those are that are reached and have no action.
    """

    terminal: Names = Field(
        default=(),
        validate_default=True,
        description="The states in which an episode ends; without it, those that are reached and have no action.",
    )
    story: str = Field(
        default="", max_length=400, pattern=r"^[^$\\]*$", description="A sentence that is printed first."
    )

    @cached_property
    def every_state(self) -> tuple[str, ...]:
        """All states, those in which an episode ends last."""
        return (*self.states, *self.terminal)

    @classmethod
    def __get_pydantic_json_schema__(cls, core: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return {"anyOf": [handler(core), handler(Grid.__pydantic_core_schema__), *SCHEMAS]}

    @model_validator(mode="before")
    @classmethod
    def _other_forms(cls, data: object, info: ValidationInfo) -> object:
        return read_form(data, note_of(info))

    @field_validator("terminal")
    @classmethod
    def _ends(cls, terminal: tuple[str, ...], info: ValidationInfo) -> tuple[str, ...]:
        if "transitions" not in info.data:
            return terminal
        rows: tuple[Transition, ...] = info.data["transitions"]
        if terminal:
            for state in sorted({*terminal} - {row.next for row in rows}):
                note_of(info)(f"nothing leads to the terminal state {state!r}; correct its name, or take it out")
            return terminal
        acting = {row.state for row in rows}
        found = tuple(dict.fromkeys(row.next for row in rows if row.next not in acting))
        meant = {state.casefold(): state for state in acting}
        for state in found:
            if alike := meant.get(state.casefold()):
                raise ValueError(
                    f"{state!r} has no action, but {alike!r} has; write its name alike, or list {state!r} as terminal"
                )
            note_of(info)(f"took {state!r}, which has no action, for a terminal state")
        return found

    @model_validator(mode="after")
    def _closed(self) -> Self:
        if len(self.states) > MOST_STATES:
            raise ValueError(f"there are {len(self.states)} states; at most {MOST_STATES} can be solved exactly")
        for state in self.states:
            if state in self.terminal:
                raise ValueError(
                    f"{state!r} is terminal, so no action can be taken there; "
                    "take its actions out, or take it out of terminal"
                )
        known = {*self.states, *self.terminal}
        for transition in self.transitions:
            if transition.next not in known:
                raise ValueError(
                    f"{transition.next!r} is reached but has no action; give it one or list it as terminal"
                )
        return self


def _added_up(rows: tuple[Transition, ...], note: Note) -> tuple[Transition, ...]:
    """Every outcome once, with probabilities that sum to 1.

    What leads to the same state by the same action is one outcome, whose reward is that on average.
    """
    outcomes: dict[tuple[str, str], dict[str, Transition]] = {}
    for row in rows:
        found = outcomes.setdefault((row.state, row.action), {})
        found[row.next] = _both(found[row.next], row) if row.next in found else row
    for pair, found in outcomes.items():
        chances = distribution({after: row.probability for after, row in found.items()}, note)
        outcomes[pair] = {after: row._replace(probability=chances[after]) for after, row in found.items()}
    order = dict.fromkeys(row[:3] for row in rows)
    return tuple(outcomes[state, action][after] for state, action, after in order)


def _both(first: Transition, second: Transition) -> Transition:
    """Two lines that tell of the same outcome, as one."""
    numbers = (first.probability, first.reward, second.probability, second.reward)
    if any(isinstance(number, Parameter) for number in numbers):
        raise ValueError(f"{', '.join(first[:3])} is given twice; where a parameter is left open, give it once")
    p, r, q, s = (Fraction(number) for number in numbers)
    return first._replace(probability=p + q, reward=(p * r + q * s) / (p + q) if p + q else r)


#: A Markov decision process, or a Markov reward process, which has no actions.
Process = Annotated[
    Model,
    Field(description="The model; rows of state, next state, probability and reward are a process without actions."),
]


def check_keys(
    values: Mapping[str, object], known: tuple[str, ...], what: str, needed: tuple[str, ...], *, by: str = ""
) -> None:
    """Demand that a mapping names the needed keys, and none that is not known; ``by`` names the table that knows."""
    for key in needed:
        if key not in values:
            raise ValueError(f"{what} of {key!r} is missing; add it")
    for key in values:
        if key not in known:
            named = f", or correct the name: known are {joined(list(dict.fromkeys(known)))}" if known else ""
            if by:
                raise ValueError(f"{what} is {key!r}, of which {by} says nothing; add it there{named}")
            raise ValueError(f"{what} is given for {key!r}, which does not occur; leave it out{named}")


def check_ends(values: Mapping[str, object], terminal: Iterable[str], what: str, cure: str) -> None:
    """Demand that what is given for a terminal state is 0, alone or for every action.

    Raises:
        ValueError: it is something else.
    """
    for state in terminal:
        given = values.get(state, 0)
        if any(given.values()) if isinstance(given, Mapping) else given:
            raise ValueError(f"{what} of {state!r} must be 0, because it is terminal; give 0, or {cure}")


def check_state_values(values: Mapping[str, object], model: Model) -> None:
    """Demand a value for every state of a model; a terminal one may have its 0.

    Raises:
        ValueError: one is missing, given for an unknown state, or not 0 for a terminal one.
    """
    check_keys(values, model.every_state, "the value", needed=model.states)
    check_ends(values, model.terminal, "the value", "make it the reward for getting there")


#: So near to 1 probabilities sum where they are rounded.
_NEAR = Fraction(1, 40)


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


def check_sum(probabilities: Iterable[Scalar], what: str) -> None:
    """Demand that probabilities sum to 1.

    Raises:
        ValueError: they do not.
    """
    chances = list(probabilities)
    if not sums_to_one(chances):
        total = sum((chance for chance in chances if isinstance(chance, Fraction)), Fraction(0))
        left_open = " and what is left open" if any(isinstance(chance, Parameter) for chance in chances) else ""
        cure = "write what is rounded as a fraction, as '1/3'" if abs(1 - total) < _NEAR else "change one of them"
        raise ValueError(f"{what} sum to {told(total)}{left_open}, not to 1; {cure}")


Policy = Mapping[str, Mapping[str, OpenProbability]]
UNIFORM = ("uniform", "equiprobable", "random")


def _meant(chances: dict[str, Chance], info: ValidationInfo) -> dict[str, Chance]:
    return distribution(chances, note_of(info))


def _certain(value: object) -> object:
    """Let what is certain be written as its name alone."""
    if value in UNIFORM[:2]:
        raise ValueError(f"{value!r} says not of what; write every name with its probability: {{A = '1/2', B = '1/2'}}")
    return {value: 1} if isinstance(value, str | int) and not isinstance(value, bool) else value


#: Probabilities by name that sum to 1; what a program rounded is read as it is meant.
DistributionField = Annotated[Hypotheses[Probability], BeforeValidator(_certain), AfterValidator(_meant)]
OpenDistributionField = Annotated[Hypotheses[OpenProbability], BeforeValidator(_certain), AfterValidator(_meant)]


def read_policy(value: object, info: ValidationInfo) -> object:
    """Let a policy be ``uniform``, and one that is the same in every state be written once: ``"fast"``.

    One action is that of every state that has it; so are probabilities of actions: ``{fast = 0.5, slow = 0.5}``.
    What else people write for a policy is in ``policy_forms``.
    """
    known = next((actions for name, field in info.data.items() if (actions := _choices(name, field))), None)
    if not known:
        return value
    value = by_states(value, {state: [*row] for state, row in known.items()}, note_of(info))
    if isinstance(value, list | tuple):
        return value
    an_action = any(value in actions for actions in known.values()) if isinstance(value, str) else False
    if not isinstance(value, dict) and value in UNIFORM and not an_action:
        return _uniform(known)
    named = {str(name) for name in value} if isinstance(value, dict) else {str(value)}
    everywhere = named and not named & {*known} and all(named <= {*actions} for actions in known.values())
    return dict.fromkeys(known, value) if everywhere else value


def _choices(name: str, field: object) -> Mapping[str, Iterable[str]] | None:
    """The actions of every state, by a field of a problem: a model, where actions lead, or action values."""
    if isinstance(field, Dynamics):
        return field.actions
    if name == "motion" and isinstance(field, dict):
        states = dict.fromkeys(state for row in field.values() for state in row)
        return {state: [action for action, row in field.items() if state in row] for state in states}
    return field if isinstance(field, dict) and all(isinstance(row, dict) for row in field.values()) else None


def _uniform(actions: Mapping[str, Iterable[str]]) -> dict[str, dict[str, Scalar]]:
    return {state: {action: Fraction(1, len(list(row))) for action in row} for state, row in actions.items()}


PolicyField = Annotated[
    Named[OpenDistributionField],
    BeforeValidator(read_policy),
    WithJsonSchema(
        {
            "type": ["object", "array", "string"],
            "title": "a table: for every state its action, or the probabilities of its actions",
        }
    ),
]


#: A policy that is certain of its action in every state.
DeterministicField = Annotated[Named[Name], BeforeValidator(read_policy)]


def equiprobable(model: Dynamics) -> dict[str, dict[str, Scalar]]:
    """The policy that takes every action of a state with the same probability."""
    return _uniform(model.actions)


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
    check_sum(chances.values(), f"{of}'s probabilities in {state!r}")


def never_left(model: Model, policy: Policy) -> list[tuple[str, ...]]:
    """The sets of states in which a policy goes round for ever: the recurrent classes, terminal states left out."""
    ahead = {
        state: [
            row.next
            for action, chance in row_of.items()
            if chance != 0
            for row in model.outcomes[state, action]
            if row.probability != 0
        ]
        for state, row_of in policy.items()
    }
    ways = {state: [(None, to)] for state, to in ahead.items() if not set(to) & set(model.terminal)}
    return [tuple(component) for component in end_components(ways)]


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
    values: Named[Open] = Field(min_length=1, description="The values of the next states.")
    gamma: Discount
    find: bool = flag("Whether the one number that is left open is asked for.")

    @model_validator(mode="after")
    def _values_fit(self) -> Self:
        if len(self.dynamics.states) != 1:
            raise ValueError("dynamics must hold the actions of one state only")
        reached = tuple(dict.fromkeys(transition.next for transition in self.dynamics.transitions))
        check_keys(self.values, (*reached, self.state), "the value", needed=reached)
        if self.find and len(self.unknown) != 1:
            raise ValueError("find: leave exactly one number open, such as p, x or gamma; it is asked for")
        return self

    @property
    def state(self) -> str:
        """The state in which the actions are taken."""
        return self.dynamics.states[0]

    @property
    def unknown(self) -> tuple[str, ...]:
        """What is left open, to be found or for good."""
        return self.left_open

    def parameters(self) -> tuple[str, ...]:
        """What answers are expressions in: nothing, where what is left open is asked for."""
        return () if self.find else self.unknown


def draw_letter(
    rng: Draws, rows: list[Transition], gamma: Fraction, letters: tuple[str, ...]
) -> tuple[list[Transition], Scalar, str]:
    """Leave one number of some transitions open, or the discount.

    Args:
        rng: the draws.
        rows: the transitions.
        gamma: the discount.
        letters: what may be left open: x for a reward, p for a probability (which takes two outcomes) or gamma.

    Returns:
        The transitions, the discount and the letter.
    """
    letter = rng.choice(letters)
    if letter == "gamma":
        return rows, Parameter("gamma"), letter
    place = rng.below(len(rows))
    if letter == "x":
        return [row._replace(reward=Parameter("x")) if i == place else row for i, row in enumerate(rows)], gamma, letter
    forks = [pair for pair, count in Counter(row[:2] for row in rows).items() if count == 2]
    if not forks:
        return draw_letter(rng, rows, gamma, ("x",))
    pair = rng.choice(forks)
    open_ = iter((Parameter("p"), Parameter("1-p")))
    return [row._replace(probability=next(open_)) if row[:2] == pair else row for row in rows], gamma, letter


#: What is said of a policy whose table leaves actions out.
PARTLY_LISTED = "The policy $π$ is given by this table. Actions that are not listed are never taken."


def open_chance(given: ModelAndPolicy) -> str:
    """The sentence that says which probability of the model or the policy is left open, or asked for."""
    rows = (
        *(row.probability for row in given.mdp.transitions),
        *(p for row in given.chances.values() for p in row.values()),
    )
    letters = dict.fromkeys(shown(Parameter(row.symbol)) for row in rows if isinstance(row, Parameter))
    told = "left open" if given.parameters() else "not known"
    return "".join(f" The probability ${p}$ is {told}, $0 < {p} < 1$." for p in letters)


def policy_blocks(given: ModelAndPolicy) -> tuple[Block, ...]:
    """The policy as a question gives it; nothing where there is nothing to choose."""
    if all(len(actions) == 1 for actions in given.mdp.actions.values()):
        return ()
    told = "The policy $π$ is:" if lists_all(given.chances, given.mdp) else PARTLY_LISTED
    return (Paragraph(told), policy_table(given.chances))


def lists_all(policy: Policy, mdp: Dynamics) -> bool:
    """Whether a policy names every action of every state."""
    return all(set(actions) == set(policy[state]) for state, actions in mdp.actions.items())


def transitions_table(model: Dynamics) -> Table:
    """The model as a table, one line for every transition; a process without actions has no column for them."""
    alone = not model.chooses
    header = ("$s$", "$a$", "$s'$", "$P_{s s'}^a$", "$R_{s s'}^a$")
    return Table(
        header=("$s$", "$s'$", "$P_{s s'}$", "$R_{s s'}$") if alone else header,
        rows=tuple(
            (t.state, *(() if alone else (t.action,)), t.next, f"${shown(t.probability)}$", f"${shown(t.reward)}$")
            for t in model.transitions
        ),
    )


def model_blocks(model: Model) -> tuple[Block, ...]:
    """A model as a question gives it: the story, its transitions, and what a terminal state is worth."""
    told = f"{model.story} " if model.story else ""
    table = transitions_table(model)
    drawn = model.chooses and len(model.states) <= _DRAWN_STATES and len(model.transitions) <= _DRAWN_TRANSITIONS
    arrows = " (on the arrows: probability, reward)" if drawn else ""
    process = "MDP" if model.chooses else "Markov reward process"
    opening = Paragraph(f"{told}The {process} has these transitions{arrows}:")
    return (opening, Beside((table, state_diagram(model))) if drawn else table, *terminal_note(model.terminal))


def state_diagram(model: Model) -> StateDiagram:
    """The model as a picture, with the same data as its table."""
    return StateDiagram(
        states=model.every_state,
        terminal=model.terminal,
        arrows=tuple(
            Arrow(t.state, t.action, t.next, f"${shown(t.probability)}$", f"${shown(t.reward)}$")
            for t in model.transitions
        ),
    )


def outcomes_blocks(dynamics: Dynamics) -> tuple[Block, ...]:
    """What the actions of one state do, as a question gives it."""
    (state,), actions = dynamics.states, [action for _, action in dynamics.pairs]
    told = f"action {actions[0]} has" if len(actions) == 1 else "actions have"
    return (Paragraph(f"In state {state} the {told} these outcomes:"), transitions_table(dynamics))


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
