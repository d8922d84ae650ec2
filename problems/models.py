"""Models of Markov decision processes, policies and trajectories, as problems give them."""

from collections import Counter
from collections.abc import Mapping
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Annotated, NamedTuple, Self

from pydantic import BeforeValidator, Field, model_validator

from rldrill.problems.document import Paragraph, Table, joined
from rldrill.problems.exact import Exact, Open, OpenProbability, Parameter, Scalar, shown
from rldrill.problems.family import Givens


def _name(value: object) -> object:
    return str(value) if isinstance(value, int) and not isinstance(value, bool) else value


#: The name of a state, an action or a hypothesis. Dollar signs and backslashes would be read as mathematics.
Name = Annotated[str, BeforeValidator(_name), Field(pattern=r"^[^\W_](?:[\w .'()+-]*[\w.'()+₀-₉-])?$", max_length=24)]


class Transition(NamedTuple):
    """One line of a model: with this probability the action leads there and earns this reward."""

    state: Name
    action: Name
    next: Name
    probability: OpenProbability
    reward: Open


class Dynamics(Givens):
    """Where actions lead from some states; nothing is said about the states that they lead to."""

    transitions: tuple[Transition, ...] = Field(min_length=1)

    @model_validator(mode="after")
    def _distributions(self) -> Self:
        doubled = [key for key, count in Counter(t[:3] for t in self.transitions).items() if count > 1]
        if doubled:
            state, action, after = doubled[0]
            raise ValueError(f"the transition {state}, {action}, {after} is given twice; give each once")
        for (state, action), outcomes in self.outcomes.items():
            if not _sums_to_one([outcome.probability for outcome in outcomes]):
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
    """A finite Markov decision process: its transitions, and the states in which an episode ends."""

    terminal: tuple[Name, ...] = ()

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
            raise ValueError(f"{what} is given for {key!r}, which does not occur; known are {joined(list(known))}")


def _sums_to_one(probabilities: list[Scalar]) -> bool:
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
        check_keys(chances, model.actions[state], f"the policy in {state!r}", needed=())
        if not _sums_to_one(list(chances.values())):
            raise ValueError(f"the policy's probabilities in {state!r} do not sum to 1")


class Trajectory(Givens):
    """A run $s_0, (a_0,) r_1, s_1, (a_1,) r_2, …$; there is one reward fewer than states."""

    states: tuple[Name, ...] = Field(min_length=2)
    actions: tuple[Name, ...] = ()
    rewards: tuple[Exact, ...] = Field(min_length=1)
    terminal: tuple[Name, ...] = ()

    @model_validator(mode="after")
    def _consistent(self) -> "Trajectory":
        if len(self.rewards) != len(self.states) - 1:
            raise ValueError(
                f"{len(self.states)} states need {len(self.states) - 1} rewards between them, not {len(self.rewards)}"
            )
        if self.actions and len(self.actions) not in (len(self.rewards), len(self.states)):
            raise ValueError(f"{len(self.rewards)} rewards need as many actions, not {len(self.actions)}")
        for state, after in pairwise(self.states):
            if state in self.terminal:
                raise ValueError(f"{state!r} is terminal, so the run cannot go on to {after!r}")
        return self


def transitions_table(model: Dynamics) -> Table:
    """The model as a table, one line for every transition."""
    return Table(
        header=("$s$", "$a$", "$s'$", "$P_{s s'}^a$", "$R_{s s'}^a$"),
        rows=tuple(
            (t.state, t.action, t.next, f"${shown(t.probability)}$", f"${shown(t.reward)}$") for t in model.transitions
        ),
    )


def terminal_note(terminal: tuple[str, ...]) -> tuple[Paragraph, ...]:
    """The sentence that says where an episode ends, and what that is worth."""
    if not terminal:
        return ()
    if len(terminal) == 1:
        return (Paragraph(f"An episode ends in {terminal[0]}, a terminal state, whose value is $0$."),)
    return (Paragraph(f"Episodes end in {joined(list(terminal))}, terminal states, whose values are $0$."),)


def values_table(values: Mapping[str, Scalar], of: str = "V") -> Table:
    """A table of values, one column for every state."""
    return Table(
        header=("$s$", *values),
        rows=((f"${of}(s)$", *(f"${shown(value)}$" for value in values.values())),),
    )


def policy_table(policy: Policy) -> Table:
    """A stochastic policy, one line for every state and action."""
    return Table(
        header=("$s$", "$a$", "$π(a|s)$"),
        rows=tuple(
            (state, action, f"${shown(chance)}$")
            for state, chances in policy.items()
            for action, chance in chances.items()
        ),
    )


def trajectory_table(run: Trajectory) -> Table:
    """A run as a table over time; what lies outside it is a dash."""
    times = range(len(run.states))
    rows = [("$s_t$", *run.states)]
    if run.actions:
        rows.append(("$a_t$", *run.actions, *["–"] * (len(run.states) - len(run.actions))))
    rows.append(("$r_t$", "–", *(f"${shown(reward)}$" for reward in run.rewards)))
    return Table(header=("$t$", *(f"${t}$" for t in times)), rows=tuple(rows))


def discount(gamma: Scalar) -> str:
    """The sentence that gives the discount."""
    if isinstance(gamma, Parameter):
        return f"The discount ${shown(gamma)}$ is left open."
    return f"The discount is $γ = {shown(gamma)}$."


def step_size(alpha: Scalar) -> str:
    """The sentence that gives the step size."""
    if isinstance(alpha, Parameter):
        return f"The step size ${shown(alpha)}$ is left open."
    return f"The step size is $α = {shown(alpha)}$."


def in_open(given: Givens) -> str:
    """What is added to a question whose answer is an expression in what is left open."""
    left_open = given.parameters()
    return f", as an expression in ${shown(Parameter(left_open[0]))}$" if left_open else ""
