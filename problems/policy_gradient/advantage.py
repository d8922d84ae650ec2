"""The advantage of every action in a state; or generalised advantage estimates along a run."""

from itertools import combinations
from typing import Annotated, Self

from pydantic import Discriminator, Field, Tag, model_validator

from rldrill.problems.document import Block, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, OpenShare, Parameter, Probability
from rldrill.problems.family import Givens, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import (
    Dynamics,
    Named,
    PolicyField,
    check_keys,
    check_policy,
    policy_table,
    transitions_table,
    values_table,
)
from rldrill.problems.parts import Number, Numbers, Part, Values
from rldrill.problems.phrases import discount, in_open, terminal_note, trace_parameter
from rldrill.problems.runs import Trajectory, check_values, trajectory_table
from rldrill.problems.settings import Shape, draw_outcomes, draw_setting, draw_visits

TITLE = "Advantage"
SOURCE = "Schulman et al. 2016, section 2"
REVISION = 7


class Lookahead(Givens):
    """What the actions of one state do, and the values of states."""

    dynamics: Dynamics = Field(description="What the actions of the state do.")
    values: Named[Exact] = Field(
        min_length=1, description="The values of the next states; without a policy also the state's own."
    )

    @model_validator(mode="after")
    def _one_state(self) -> Self:
        if len(self.dynamics.states) != 1:
            raise ValueError("dynamics must hold the actions of one state only")
        return self

    @property
    def state(self) -> str:
        """The state whose actions are compared."""
        return self.dynamics.states[0]

    @property
    def reached(self) -> tuple[str, ...]:
        """The states that come next."""
        return tuple(dict.fromkeys(transition.next for transition in self.dynamics.transitions))


class ValueLookahead(Lookahead):
    """What the actions of one state do, its value and those of the next states."""

    @model_validator(mode="after")
    def _valued(self) -> Self:
        needed = (*self.reached, self.state)
        check_keys(self.values, needed, "the value", needed=needed)
        return self


class PolicyLookahead(Lookahead):
    """What the actions of one state do, the values of the next states, and the policy, which says what it is worth."""

    policy: PolicyField = Field(description="The policy in the state, which says what the state is worth.")

    @model_validator(mode="after")
    def _valued(self) -> Self:
        if self.state in (*self.reached, *self.values):
            raise ValueError(f"policy: the value of {self.state!r} follows from it, so it must not be given or reached")
        check_keys(self.values, self.reached, "the value", needed=self.reached)
        check_policy(self.policy, self.dynamics)
        return self


class Run(Givens):
    """A run, the values of its states, and λ."""

    trajectory: Trajectory = Field(description="What the agent did.")
    values: Named[Exact] = Field(description="The value of every state.")
    lam: OpenShare = Field(description="How much later TD errors count (GAE).")

    @model_validator(mode="after")
    def _valued(self) -> Self:
        check_values(self.values, self.trajectory.states, self.trajectory.terminal)
        return self


class OfValue(Givens):
    """One state of known value to look ahead from, and the discount."""

    lookahead: ValueLookahead = Field(description="The state to look ahead from, its own value given; instead of run.")
    gamma: Probability = Field(description="The discount.")


class OfPolicy(Givens):
    """One state with a policy to look ahead from, and the discount."""

    lookahead: PolicyLookahead = Field(description="The state to look ahead from, its policy given; instead of run.")
    gamma: Probability = Field(description="The discount.")


class AlongRun(Givens):
    """A run to estimate along, and the discount."""

    run: Run = Field(description="The run along which the advantages are estimated; instead of lookahead.")
    gamma: Probability = Field(description="The discount.")


def _kind(given: object) -> str | None:
    match given:
        case {"lookahead": _, "run": _}:
            return None
        case {"lookahead": {"policy": _}}:
            return "policy"
        case {"lookahead": _}:
            return "value"
        case {"run": _}:
            return "run"
        case {}:
            return None
    return "run"  # no table at all, as its model will say


Given = Annotated[
    Annotated[OfValue, Tag("value")] | Annotated[OfPolicy, Tag("policy")] | Annotated[AlongRun, Tag("run")],
    Discriminator(_kind, custom_error_type="kind", custom_error_message="give either lookahead or run"),
]


def draw(level: int, rng: Draws) -> Given:
    """Two certain actions and V(s) given; then three actions and a policy; then GAE with λ left open."""
    if level == 3:
        setting, states = draw_visits(rng, "abacb", "abac.")
        run = Trajectory(
            states=states,
            rewards=tuple(rng.nonzero(-4, 8) for _ in states[1:]),
            terminal=tuple(state for state in states if state == setting.terminal),
        )
        values = {state: rng.nonzero(-3, 8) for state in setting.states if state in states}
        gamma = rng.fraction("1/2", "2/3", "1")
        worths = [values.get(state, Fraction(0)) for state in states]
        errors = [
            reward + gamma * after - here
            for reward, here, after in zip(run.rewards, worths[:-1], worths[1:], strict=True)
        ]
        if not all(errors):
            return draw(level, rng)  # an estimate would not depend on what it is made of
        return AlongRun(run=Run(trajectory=run, values=values, lam=Parameter("lambda")), gamma=gamma)
    setting = draw_setting(rng)
    actions = setting.actions[: 1 + level]
    state = rng.choice(setting.states)
    ahead_of = {a: [s for s in setting.reached(setting.states, state, a) if s != state] for a in actions}
    if not all(ahead_of.values()):
        return draw(level, rng)  # an action cannot lead anywhere else
    shape = Shape(states=3, actions=1 + level, branches=level)
    rows = []
    for action, targets in ahead_of.items():
        chosen = rng.sample(targets, min(rng.choice((1, level)), len(targets)))
        rows += draw_outcomes(rng, state, action, tuple(s for s in setting.states if s in chosen), shape)
    needed = {state, *(row.next for row in rows)} if level == 1 else {row.next for row in rows}
    gamma = rng.fraction("1/2", "1")
    values = {name: 2 * rng.nonzero(-3, 5) for name in setting.states if name in needed}
    worth = {row: row.reward + gamma * values[row.next] for row in rows if isinstance(row.reward, Fraction)}
    if any(a.action == b.action and worth[a] == worth[b] for a, b in combinations(rows, 2)):
        return draw(level, rng)  # their probabilities would not count
    chance = {row: row.probability for row in rows if isinstance(row.probability, Fraction)}
    of = [[row for row in rows if row.action == action] for action in actions]
    Q = [sum((chance[row] * worth[row] for row in each), Fraction(0)) for each in of]
    ahead = [sum((chance[row] * values[row.next] for row in each), Fraction(0)) for each in of]
    if len(set(Q)) < len(Q) or not any(ahead):
        return draw(level, rng)  # two actions would be told apart by their names only, or γ would not count
    if level == 1:  # every action has one outcome; one is better than the policy, and one is worse
        low, high = min(worth.values()), max(worth.values())
        between = [Fraction(value) for value in range(-30, 30) if value and low < value < high]
        if not between:
            return draw(level, rng)
        values[state] = rng.choice(between)
        return OfValue(lookahead=ValueLookahead(dynamics=Dynamics(transitions=tuple(rows)), values=values), gamma=gamma)
    policy = {state: dict(zip(actions, rng.split(3, (4, 5)), strict=True))}
    return OfPolicy(
        lookahead=PolicyLookahead(dynamics=Dynamics(transitions=tuple(rows)), values=values, policy=policy), gamma=gamma
    )


def question(given: Given) -> Question:
    """Action values first and then advantages; or the estimates along a run."""
    match given:
        case AlongRun():
            return _along(given)
        case OfValue() | OfPolicy():
            return _of_one_state(given)


def _of_one_state(given: OfValue | OfPolicy) -> Question:
    ahead, state = given.lookahead, given.lookahead.state
    pairs = tuple((state, action) for action in ahead.dynamics.actions[state])
    opening: tuple[Block, ...] = (
        Paragraph(f"In state {state} the actions have these outcomes:"),
        transitions_table(ahead.dynamics),
    )
    parts = [Part(f"What are the action values $Q^π(s, a)$ in {state}?", Values("Q^π", pairs), zero=True)]
    of_states = "The agent's policy $π$ has the values below."
    if isinstance(ahead, PolicyLookahead):
        opening += (Paragraph("The policy $π$ takes them with these probabilities:"), policy_table(ahead.policy))
        of_states = "Its values in the next states are known."
        parts.append(Part(f'What is the value $V^π("{state}")$?', Number(), zero=True))
    parts.append(Part(f"What is the advantage $A^π(s, a)$ of every action in {state}?", Values("A^π", pairs)))
    blocks = (*opening, Paragraph(f"{of_states} {discount(given.gamma)}"), values_table(ahead.values, "V^π"))
    return Question(blocks, tuple(parts))


def _along(given: AlongRun) -> Question:
    run = given.run
    times = range(len(run.trajectory.rewards))
    errors = tuple(f"δ_{{{time}}}" for time in times)
    estimates = tuple(f"Â_{{{time}}}" for time in times)
    blocks = (
        Paragraph("An agent follows this trajectory (each reward stands at the time at which it is received):"),
        trajectory_table(run.trajectory),
        *terminal_note(run.trajectory.terminal),
        Paragraph(f"The critic's values are these. {discount(given.gamma)} {trace_parameter(run.lam)}"),
        values_table(run.values),
        Paragraph(
            "Advantages are estimated by generalised advantage estimation (GAE) from the TD errors of this trajectory: "
            f"it {'ends' if run.trajectory.ends else 'breaks off'} at $T = {len(times)}$, so the last one is "
            f"$δ_{{{len(times) - 1}}}$. The values are not updated."
        ),
    )
    ask = f"What are the estimates ${', '.join(estimates)}${in_open(given)}?"
    if isinstance(run.lam, Parameter):  # then the TD errors alone are no expression in it
        return Question(blocks, (Part(ask, Numbers(estimates)),))
    first = f"What are the TD errors ${', '.join(errors)}$?"
    return Question(blocks, (Part(first, Numbers(errors), zero=True), Part(ask, Numbers(estimates))))
