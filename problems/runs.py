"""Runs of an agent: what was visited, done and earned, and the updates that follow it."""

from abc import abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from itertools import pairwise
from typing import Annotated, NamedTuple, Self

from msgspec.structs import replace
from pydantic import AfterValidator, Discriminator, Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Exact, Open, Scalar, StepSize, needed, shown
from rldrill.problems.family import Givens
from rldrill.problems.fractions import Fraction, plain
from rldrill.problems.models import Name, Named, Names, Steps, check_ends
from rldrill.problems.parts import Number, Numbers, Part, Values
from rldrill.problems.phrases import check_one_open, discount, in_open, not_known, step_size, terminal_note
from rldrill.problems.pictures import Timeline
from rldrill.problems.reversible import Reversible, letter_asked, unknown
from rldrill.problems.settings import draw_setting, draw_way, in_order

#: Runs of at most so many states are drawn.
_DRAWN = 12
#: So many steps have the returns from every time worked out, all n-step returns, and the traces of all states.
_SHORT = 300

#: Drawn answers have no larger numbers above and below the line.
_LARGEST, _LARGEST_BELOW = 250, 80

#: What to do where a terminal state is given a value of its own.
CUT_OFF = "take it out of terminal if the run was only cut off there"


class Trajectory(Givens):
    """A run $s_0, (a_0,) r_1, s_1, (a_1,) r_2, …$; there is one reward fewer than states."""

    states: Steps[Name] = Field(
        min_length=2, description="The states in the order of the visits, the last one included."
    )
    actions: Steps[Name] = Field(
        default=(),
        description="The actions taken in them; some methods need them, and the last state's too.",
        examples=[["left", "right"]],
    )
    rewards: Steps[Exact] = Field(min_length=1, description="The reward after every state but the last.")
    terminal: Names = Field(
        default=(),
        description="The states in which an episode ends.",
        examples=[["end"]],
    )

    @model_validator(mode="after")
    def _consistent(self) -> "Trajectory":
        if len(self.rewards) != len(self.states) - 1:
            between = len(self.states) - 1
            cure = "add or take out some"
            if len(self.rewards) == len(self.states):
                cure = "add the state that the last reward leads to, such as the end"
            raise ValueError(
                f"{len(self.states)} states need {between} reward{'s' * (between != 1)} between them, not "
                f"{len(self.rewards)}; {cure}"
            )
        if self.actions and len(self.actions) not in (len(self.rewards), len(self.states)):
            raise ValueError(f"{len(self.rewards)} rewards need as many actions, not {len(self.actions)}; give as many")
        for state, after in pairwise(self.states):
            if state in self.terminal:
                raise ValueError(
                    f"{state!r} is terminal, so the run cannot go on to {after!r}; "
                    "take that out, or take the state out of terminal"
                )
        return self

    @property
    def ends(self) -> bool:
        """Whether the last state is terminal; otherwise the run is cut off there."""
        return self.states[-1] in self.terminal


def _short(run: Trajectory) -> Trajectory:
    if len(run.rewards) > _SHORT:
        raise ValueError(f"has {len(run.rewards)} steps; it may have at most {_SHORT}")
    return run


def _to_its_end(run: Trajectory) -> Trajectory:
    if not run.ends:
        raise ValueError(
            f"the whole return is needed, but the run does not end in {run.states[-1]!r}, its last state; list it as "
            "terminal if the episode ends there, or go on to the end"
        )
    return run


#: A run that is not so long that its n-step returns, or its traces, become too many.
ShortRun = Annotated[Trajectory, AfterValidator(_short)]
#: A run to its end: the last state is terminal.
Episode = Annotated[ShortRun, AfterValidator(_to_its_end)]


def per_step(gamma: Scalar | tuple[Scalar, ...], steps: int) -> tuple[Scalar, ...]:
    """The discount of every step of a run; where one is given it is that of all steps.

    Raises:
        ValueError: there are too many or too few.
    """
    if not isinstance(gamma, tuple):
        return (gamma,) * steps
    if len(gamma) != steps:
        raise ValueError(f"gamma: {steps} rewards need as many discounts, or a single one, not {len(gamma)}")
    return gamma


def draw_values(rng: Draws, states: Sequence[str], gamma: Fraction) -> dict[str, Fraction]:
    """Values of states, whole even when they are discounted, and not 0."""
    unit = gamma.denominator
    return {state: unit * rng.nonzero(-(4 // unit), max(12 // unit, len(states))) for state in states}


def told_apart(run: Trajectory, values: Mapping[str, Fraction]) -> bool:
    """Whether no two states are worth the same, and no reward is that before it: so what is confused shows."""
    return len({*values.values()}) == len(values) and all(one != other for one, other in pairwise(run.rewards))


def draw_reward(rng: Draws, old: Fraction, after: Fraction, alpha: Fraction, unit: int | None) -> Fraction:
    """A reward that moves a value towards it and what comes after it: to a multiple of the unit, if there is one."""

    start, still = old + alpha * (after - old), plain(old - after)

    def fits(reward: int | Fraction) -> bool:
        return reward != still and (unit is None or (start + alpha * reward) % unit == 0)

    reward = rng.fitting(-6, 9, fits)
    return reward if fits(reward) else rng.fitting(-6, 9, lambda reward: reward != still)


def draw_rewards(rng: Draws, count: int, gamma: Fraction) -> tuple[Fraction, ...]:
    """Rewards of an episode whose returns are whole, even when they are discounted, and not 0."""
    rewards: tuple[Fraction, ...] = ()
    after = Fraction(0)
    for left in range(count):
        reward = _reward_before(rng, after, gamma.denominator if left < count - 1 else 1)
        rewards, after = (reward, *rewards), gamma * (reward + after)
    return rewards


def _reward_before(rng: Draws, after: Fraction, unit: int) -> Fraction:
    later = plain(after)
    return rng.fitting(-5, 9, lambda reward: reward + later != 0 and (reward + later) % unit == 0)


def readable(numbers: Iterable[Fraction]) -> bool:
    """Whether these are fractions with small numbers above and below the line."""
    return all(abs(number.numerator) <= _LARGEST and number.denominator <= _LARGEST_BELOW for number in numbers)


def draw_whole(
    rng: Draws, states: tuple[str, ...], end: str, gamma: Fraction
) -> tuple[Trajectory, dict[str, Fraction]]:
    """A run, and values of its states, with longest n-step returns that are whole and no state's value.

    The run ends in the state ``end``, or is cut off in another one.
    """
    terminal = tuple(state for state in states if state == end)
    values = draw_values(rng, in_order(states), gamma)
    V = values | dict.fromkeys(terminal, Fraction(0))
    rewards: tuple[Fraction, ...] = ()
    later = gamma * V[states[-1]]  # what the longest return adds to a reward; the one-step return adds γV
    for state, after in reversed([*pairwise(states)]):
        reward = _reward_to_whole(rng, later, gamma * V[after], V[state], gamma.denominator)
        rewards, later = (reward, *rewards), gamma * (reward + later)
    return Trajectory(states=states, rewards=rewards, terminal=terminal), values


def _reward_to_whole(rng: Draws, later: Fraction, soon: Fraction, value: Fraction, unit: int) -> Fraction:
    long, short, still = plain(later), plain(soon), plain(value)
    return rng.fitting(
        -6, 9, lambda reward: (reward + long) % unit == 0 and still not in (reward + short, reward + long)
    )


#: Whether eligibility traces are replacing.
Replacing = Annotated[
    bool,
    Field(
        exclude_if=lambda replacing: not replacing,
        description="Whether traces are replacing: a visit sets the trace to 1, instead of adding 1 to what is left.",
    ),
]


class StateMove(NamedTuple):
    """A transition from a state to the next, and its reward."""

    state: Name
    next: Name
    reward: Exact


class ActionMove(NamedTuple):
    """A transition with its action; and the action taken after it, where that is known."""

    state: Name
    action: Name
    next: Name
    reward: Exact
    following: Name | None = None


#: Whether the TD errors are asked for, too.
AskErrors = Annotated[
    bool,
    Field(
        exclude_if=lambda asked: not asked, description="Whether the TD error of every transition is asked for, too."
    ),
]


class ValueRun(Reversible):
    """A run, the state values before it, the step size and the discount.

    Where ``known`` is the value of the first updated state after all updates, what is left open is asked for.
    """

    trajectory: Trajectory = Field(description="What the agent did.")
    values: Named[Open] = Field(description="The value of every state before the run.")
    alpha: StepSize = Field(description="The step size.")
    gamma: Discount

    @model_validator(mode="after")
    def _valued(self) -> Self:
        check_values(self.values, self.trajectory.states, self.terminal)
        check_one_open(self)
        return self

    @cached_property
    def moves(self) -> tuple[StateMove, ...]:
        """The transitions one by one."""
        return tuple(map(StateMove, self.trajectory.states, self.trajectory.states[1:], self.trajectory.rewards))

    @property
    def terminal(self) -> tuple[str, ...]:
        """The states in which an episode ends."""
        return self.trajectory.terminal

    @cached_property
    def visited(self) -> tuple[str, ...]:
        """The states that are left, in the order of their first visit."""
        return tuple(dict.fromkeys(move.state for move in self.moves))

    @cached_property
    def updated(self) -> tuple[str, ...]:
        """The states that are updated; what is known is the value of the first of them."""
        return self.visited


class ValueMoves(Givens):
    """Transitions that need not join, the state values before them, the step size and the discount."""

    transitions: tuple[StateMove, ...] = Field(
        min_length=1,
        max_length=300,
        description="Transitions in the order of their updates: rows of state, next state and reward.",
        examples=[[["A", "B", 1], ["B", "end", 2]]],
    )
    terminal: Names = Field(default=(), description="The states in which an episode ends.", examples=[["end"]])
    values: Named[Exact] = Field(
        description="The value of every state before the transitions.", examples=[{"A": 0, "B": 1}]
    )
    alpha: StepSize = Field(description="The step size.", examples=["1/2"])
    gamma: Discount

    @model_validator(mode="after")
    def _valued(self) -> Self:
        check_moves(self.transitions, self.terminal)
        states = [state for move in self.transitions for state in (move.state, move.next)]
        check_values(self.values, states, self.terminal)
        check_one_open(self)
        return self

    @cached_property
    def moves(self) -> tuple[StateMove, ...]:
        """The transitions one by one."""
        return self.transitions

    @cached_property
    def visited(self) -> tuple[str, ...]:
        """The states that are left, in the order of their first visit."""
        return tuple(dict.fromkeys(move.state for move in self.moves))


class ActionUpdates(Givens):
    """What updates action values: transitions, one after the other."""

    @property
    @abstractmethod
    def moves(self) -> tuple[ActionMove, ...]:
        """The transitions one by one."""

    @property
    def asks_back(self) -> bool:
        """Whether a value in the end is known, and what is left open is asked for."""
        return False

    @cached_property
    def updated(self) -> tuple[tuple[str, str], ...]:
        """The pairs of state and action that are updated, in the order of their first visit."""
        return tuple(dict.fromkeys((move.state, move.action) for move in self.moves))


class ActionRun(ActionUpdates):
    """A run with its actions, the action values before it, the step size and the discount."""

    trajectory: Trajectory = Field(description="What the agent did.")
    values: Named[Named[Exact]] = Field(
        description="For every state the values of its actions before the run.",
        examples=[{"A": {"left": 0, "right": 1}}],
    )
    alpha: StepSize = Field(description="The step size.")
    gamma: Discount

    @model_validator(mode="after")
    def _valued(self) -> Self:
        run = self.trajectory
        if len(run.actions) < len(run.rewards):
            raise ValueError("trajectory: the action taken in every state that is left is needed; add it")
        for state in run.states:
            if state not in run.terminal and not self.values.get(state):
                raise ValueError(f"values: the action values of {state!r} are missing; add them")
        for state, action in zip(run.states, run.actions, strict=False):
            if state in run.terminal:
                raise ValueError(f"trajectory: the run ends in {state!r}, so no action is taken there; take it out")
            if action not in self.values[state]:
                raise ValueError(f"values: {action!r} is taken in {state!r} but has no value there; add it")
        check_ends(self.values, run.terminal, "values: the action value", CUT_OFF)
        return self

    def demand_last_action(self, method: str) -> None:
        """Raise a ``ValueError`` unless the method, which needs the last action, is given it."""
        if not self.last_action_known:
            last = self.trajectory.states[-1]
            raise ValueError(f"trajectory: {method} needs the action taken in {last!r}, the last state, too; add it")

    @cached_property
    def moves(self) -> tuple[ActionMove, ...]:
        """The transitions one by one."""
        run = self.trajectory
        after = [*run.actions[1:], None][: len(run.rewards)]
        return tuple(map(ActionMove, run.states, run.actions, run.states[1:], run.rewards, after))

    @property
    def terminal(self) -> tuple[str, ...]:
        """The states in which an episode ends."""
        return self.trajectory.terminal

    @property
    def last_action_known(self) -> bool:
        """Whether something is known to be done in the last state, or nothing is because the run ends there."""
        run = self.trajectory
        return run.ends or len(run.actions) == len(run.states)


class ActionMoves(ActionUpdates):
    """Transitions that need not join, the action values before them, the step size and the discount."""

    transitions: tuple[ActionMove, ...] = Field(
        min_length=1,
        max_length=300,
        description="Transitions in the order of their updates: rows of state, action, next state and reward, and for "
        "Sarsa the next action.",
        examples=[[["A", "left", "B", 1, "right"], ["B", "right", "end", 2]]],
    )
    terminal: Names = Field(default=(), description="The states in which an episode ends.", examples=[["end"]])
    values: Named[Named[Exact]] = Field(
        description="For every state the values of its actions before the transitions.",
        examples=[{"A": {"left": 0}, "B": {"right": 1}}],
    )
    alpha: StepSize = Field(description="The step size.", examples=["1/2"])
    gamma: Discount

    @model_validator(mode="after")
    def _valued(self) -> Self:
        check_moves(self.transitions, self.terminal)
        for number, move in enumerate(self.transitions, 1):
            taken = [(move.state, move.action), *([(move.next, move.following)] if move.following else [])]
            if move.following and move.next in self.terminal:
                raise ValueError(
                    f"transitions[{number}]: {move.next!r} is terminal, so no action is taken there; take it out"
                )
            if move.next not in self.terminal and not self.values.get(move.next):
                raise ValueError(f"values: the action values of {move.next!r} are missing; add them")
            for state, action in taken:
                if action not in self.values.get(state, {}):
                    raise ValueError(f"values: {action!r} is taken in {state!r} but has no value there; add it")
        check_ends(self.values, self.terminal, "values: the action value", CUT_OFF)
        return self

    def demand_last_action(self, method: str) -> None:
        """Raise a ``ValueError`` unless the method, which needs the next actions, is given them."""
        for number, move in enumerate(self.transitions, 1):
            if move.following is None and move.next not in self.terminal:
                raise ValueError(
                    f"transitions[{number}]: {method} needs the action taken in {move.next!r} too; add it at the end"
                )

    @cached_property
    def moves(self) -> tuple[ActionMove, ...]:
        """The transitions one by one."""
        return self.transitions

    @property
    def last_action_known(self) -> bool:
        """Whether it is known after every transition what is done next, or nothing is."""
        return all(move.following is not None or move.next in self.terminal for move in self.moves)


def check_moves(moves: Sequence[StateMove | ActionMove], terminal: tuple[str, ...]) -> None:
    """Demand that no transition leaves a terminal state.

    Raises:
        ValueError: one does.
    """
    for number, move in enumerate(moves, 1):
        if move.state in terminal:
            raise ValueError(
                f"transitions[{number}]: {move.state!r} is terminal, so nothing leads on from there; "
                "take that out, or take the state out of terminal"
            )


def which_kind(given: object) -> str | None:
    """The tag of a run, or of transitions that need not join."""
    match given:
        case {"trajectory": _, "transitions": _}:
            return None
        case {"transitions": _}:
            return "transitions"
    return "run"


#: What tells a run and transitions apart.
RUN_OR_MOVES = Discriminator(
    which_kind,
    custom_error_type="kind",
    custom_error_message="give either a trajectory, or transitions that need not join",
)


def check_values(values: Mapping[str, object], states: Iterable[str], terminal: tuple[str, ...]) -> None:
    """Demand a value for every state that occurs and is not terminal; those of other states do not matter.

    Raises:
        ValueError: one is missing, or not 0 for a terminal state.
    """
    visited = tuple(states)
    for state in visited:
        if state not in terminal and state not in values:
            last = ", or name it in terminal if the episode ends there" if state == visited[-1] else ""
            raise ValueError(f"the value of {state!r} is missing; add it{last}")
    check_ends(values, terminal, "the value", CUT_OFF)


def draw_action_run(
    rng: Draws, visits: str, choices: int, *, last: bool = True, same: bool = False
) -> tuple[Trajectory, dict[str, dict[str, Fraction]]]:
    """A run through a world, and different action values in every state that it visits.

    Args:
        rng: the stream of choices.
        visits: a letter for every state, in the order of the visits; a full stop is the end: ``"aba."``.
        choices: how many actions each state has.
        last: whether the action in the last state is known too, unless the run ends there.
        same: whether a state that is visited again sees the same action again.
    """
    setting = draw_setting(rng)
    states, actions = draw_way(rng, setting, visits, setting.actions[:choices], same=same)
    run = Trajectory(
        states=states,
        actions=actions if last else actions[: len(states) - 1],
        rewards=tuple(rng.nonzero(-4, 8) for _ in states[1:]),
        terminal=tuple(state for state in states if state == setting.terminal),
    )
    return run, {state: draw_row(rng, setting.actions[:choices]) for state in setting.states if state in states}


def draw_row(rng: Draws, actions: tuple[str, ...]) -> dict[str, Fraction]:
    """A different whole number for every action."""
    return dict(zip(actions, rng.distinct(len(actions), -3, 9), strict=True))


def trajectory_table(run: Trajectory) -> Table:
    """A run as a table over time; what lies outside it is a dash."""
    times = range(len(run.states))
    rows = [("$s_t$", *run.states)]
    if run.actions:
        rows.append(("$a_t$", *run.actions, *["–"] * (len(run.states) - len(run.actions))))
    rows.append(("$r_t$", "–", *(f"${shown(reward)}$" for reward in run.rewards)))
    return Table(header=("$t$", *(f"${t}$" for t in times)), rows=tuple(rows))


def timeline(run: Trajectory) -> Timeline:
    """A run as a picture."""
    return Timeline(
        tuple(f"$t = {time}$" for time in range(len(run.states))),
        run.states,
        run.actions,
        tuple(f"$r_{{{time}}} = {shown(reward)}$" for time, reward in enumerate(run.rewards, 1)),
        ended=run.ends,
    )


def seen(run: Trajectory) -> tuple[Block, ...]:
    """The trajectory of an agent, and where it ends; a long one is a table."""
    drawn = len(run.states) <= _DRAWN
    told = "" if drawn else " (each reward stands at the time at which it is received)"
    return (
        Paragraph(f"An agent follows this trajectory{told}:"),
        timeline(run) if drawn else trajectory_table(run),
        *terminal_note(run.terminal),
    )


def action_values_table(values: Mapping[str, Mapping[str, Scalar]], of: str = "Q(s, a)") -> Table:
    """Action values or the like, a line for every state and a column for every action."""
    actions = tuple(dict.fromkeys(action for row in values.values() for action in row))
    return Table(
        header=(f"${of}$", *actions),
        rows=tuple(
            (state, *(f"${shown(row[action])}$" if action in row else "–" for action in actions))
            for state, row in values.items()
        ),
    )


def cut_off(run: Trajectory) -> tuple[Block, ...]:
    """The sentence that says how λ-returns are closed where a run does not come to its end."""
    if run.ends:
        return ()
    last = run.states[-1]
    told = f"The run is cut off at $t = {len(run.rewards)}$ in {last}, which is not terminal. The longest n-step return"
    return (Paragraph(f'{told} therefore ends with $V("{last}")$, and gets all the weight that the others leave.'),)


def moves_table(given: ValueMoves | ActionMoves) -> tuple[Block, ...]:
    """Transitions that need not join."""
    following = isinstance(given, ActionMoves) and any(move.following for move in given.transitions)
    head = ("$s_{t+1}$", "$r_{t+1}$")
    header = ("$s_t$", *(("$a_t$",) if isinstance(given, ActionMoves) else ()), *head)
    rows = [
        tuple("–" if entry is None else entry if isinstance(entry, str) else f"${shown(entry)}$" for entry in move)
        for move in given.moves
    ]
    return (
        Paragraph("These transitions are observed in this order; each may begin in any state:"),
        Table(
            header=("$t$", *header, *(("$a_{t+1}$",) if following else ())),
            rows=tuple((f"${time}$", *row[: len(header) + following]) for time, row in enumerate(rows)),
        ),
        *terminal_note(given.terminal),
    )


def run_situation(
    given: ValueRun | ActionRun | ValueMoves | ActionMoves, *values: Table, more: str = "", steps: bool = True
) -> tuple[Block, ...]:
    """A run, and the values before it; ``more`` is said after the step size, if ``steps`` has it, and the discount."""
    before = "the first transition" if isinstance(given, ValueMoves | ActionMoves) else "the first update"
    rates = " ".join([*([step_size(given.alpha)] if steps else []), discount(given.gamma)])
    told = f"These are the values before {before}. {rates} {more}".strip()
    happened = moves_table(given) if isinstance(given, ValueMoves | ActionMoves) else seen(given.trajectory)
    if isinstance(given, ValueRun):
        told = unknown(given, f"{told} The value $x$ is left open." if "x" in given.letters else told)
    elif isinstance(given, ActionUpdates) and given.asks_back:
        told = not_known(told)
    return (*happened, Paragraph(told), *values)


def sought_parts(given: ValueRun) -> tuple[Part, ...]:
    """What is asked where a value after the updates is known: the letter left open, and the other values."""
    first, *others = given.updated
    letter = letter_asked(given)
    told = f'After all updates $V("{first}") = {shown(needed(given.known))}$.'
    parts = (replace(letter, ask=f"{told} {letter.ask}"),)
    if not others:
        return parts
    asked = f'$V("{others[0]}")$' if len(others) == 1 else "the value of every other updated state"
    return *parts, Part(f"What is {asked} after all updates?", Values("V", tuple(others)))


def errors_asked(given: ValueRun | ActionRun | ValueMoves | ActionMoves) -> Part:
    """The part that asks for the TD error of every transition."""
    errors = tuple(f"δ_{{{time}}}" for time in range(len(given.moves)))
    one = len(errors) == 1
    several = f"What are the TD errors ${', '.join(errors)}$ of the transitions, in this order"
    ask = "What is the TD error $δ_0$ of the transition" if one else several
    return Part(f"{ask}{in_open(given)}?", Number() if one else Numbers(errors), zero=True)


def after(given: ValueRun | ValueMoves | ActionUpdates) -> str:
    """When the values are asked for."""
    return "after these transitions" if isinstance(given, ValueMoves | ActionMoves) else "after the run"


def values_asked(given: ValueRun | ValueMoves) -> str:
    """What a question asks for: every value that is updated."""
    visited = given.visited
    return f'$V("{visited[0]}")$' if len(visited) == 1 else "the value of every updated state"


def run_blocks(given: ValueRun | ActionRun | ValueMoves | ActionMoves, values: Table, method: str) -> tuple[Block, ...]:
    """The situation of a question about updates along a run: the run, the values before it, and the method."""
    return (
        *run_situation(given, values),
        Paragraph(f"{method} makes one update after every transition, with the values that are current at that time."),
    )
