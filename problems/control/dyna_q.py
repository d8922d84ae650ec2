"""The action values after real transitions, and after the planned updates that Dyna-Q makes with its model."""

from collections import Counter
from collections.abc import Mapping
from typing import NamedTuple, Self

from pydantic import Field, model_validator

from rldrill.problems.asking_back import Rates, draw_rates, draw_rows, readable
from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Name
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import in_open
from rldrill.problems.runs import ActionMove, ActionRun, Trajectory, action_values_table, run_situation
from rldrill.problems.settings import draw_moves, draw_setting, possible

TITLE = "Dyna-Q"
SOURCE = "Sutton & Barto 2018, sections 8.2 and 8.3"
REVISION = 5
DISTRACTORS = (
    "values.*",  # a table has the values of other pairs, too
    "model.0.2",  # what the model held is replaced by what was tried last
    "changed.0.2",  # what nobody has tried is not known
)

Pair = tuple[Name, Name]


class Entry(NamedTuple):
    """What follows a state and an action for certain: one line of a deterministic model."""

    state: Name
    action: Name
    reward: Exact
    next: Name

    @property
    def pair(self) -> tuple[str, str]:
        """The state and the action."""
        return self.state, self.action


class Given(ActionRun):
    """A run, the action values and the model before it, α and γ, and the pairs that are drawn for planning.

    ``changed`` is what the environment does now where nobody has tried it yet, so that the model does not know.
    """

    model: tuple[Entry, ...] = Field(
        default=(),
        max_length=300,
        description="What the model holds before the run.",
        examples=[[["A", "left", 1, "B"]]],
    )
    planned: tuple[Pair, ...] = Field(
        min_length=1, max_length=300, description="The states and actions that are drawn for planning, in their order."
    )
    changed: tuple[Entry, ...] = Field(
        default=(),
        max_length=300,
        description="What the environment does now where nobody has tried it yet, so that the model does not know.",
        examples=[[["A", "right", 0, "B"]]],
    )

    @model_validator(mode="after")
    def _plannable(self) -> Self:
        for field, entries in (("model", self.model), ("changed", self.changed)):
            for entry in entries:
                self._check_entry(field, entry)
            for pair, count in Counter(entry.pair for entry in entries).items():
                if count > 1:
                    raise ValueError(
                        f"{field}: ({', '.join(pair)}) is given twice; a deterministic model holds it once"
                    )
        for pair in self.planned:
            if pair not in self.learned:
                raise ValueError(f"planned: ({', '.join(pair)}) is not in the model after the run, so nothing is "
                                 "known to plan with")  # fmt: skip
        for entry in self.changed:
            if entry.pair not in self.before or entry.pair in self.updated:
                raise ValueError(f"changed: ({', '.join(entry.pair)}) must be in the model and not be tried in the run")
        return self

    def _check_entry(self, field: str, entry: Entry) -> None:
        if entry.state in self.trajectory.terminal:
            raise ValueError(f"{field}: {entry.state!r} is terminal, so nothing is done there; leave the entry out")
        if entry.action not in self.values.get(entry.state, {}):
            raise ValueError(f"values: {field} has {entry.action!r} in {entry.state!r}, which has no value; add it")
        if entry.next not in self.trajectory.terminal and not self.values.get(entry.next):
            raise ValueError(f"values: {field} leads to {entry.next!r}, whose action values are missing; add them")

    @property
    def tried(self) -> tuple[Entry, ...]:
        """What the run shows, one entry for every transition."""
        run = self.trajectory
        return tuple(map(Entry, run.states, run.actions, run.rewards, run.states[1:]))

    @property
    def before(self) -> dict[tuple[str, str], Entry]:
        """The model before the run, by pair."""
        return {entry.pair: entry for entry in self.model}

    @property
    def learned(self) -> dict[tuple[str, str], Entry]:
        """The model after the run, by pair: what was tried replaces what stood there."""
        return self.before | {entry.pair: entry for entry in self.tried}

    @property
    def replayed(self) -> tuple[tuple[str, str], ...]:
        """The pairs that planning updates, each once, in the order in which they are drawn first."""
        return tuple(dict.fromkeys(self.planned))


def draw(level: int, rng: Draws) -> Given:
    """One transition and a remembered pair; then one or two, the model often empty; then a changed environment."""
    setting = draw_setting(rng)
    choices = rng.sample(setting.actions, 2)
    alpha, gamma, unit = draw_rates(rng) if level > 1 else Rates(Fraction(1, 2), Fraction(1, 4), 4)
    after = "" if level == 1 or rng.chance(Fraction(1, 2)) else rng.choice("ac.")
    known = "b" if level == 1 else "c"
    if level == 3:  # what was tried before led elsewhere, and what is remembered now does
        moves = (("a", "bc"), ("c", "ab"), *([("b", after)] if after else []))
    else:
        moves = (("a", "b"), (known, "a"), *([("b", after)] if after else []))
    if not possible(setting, moves, choices):
        return draw(level, rng)
    stands, (taken, remembers, *later) = draw_moves(rng, setting, moves, choices)
    first, second, third = stands["a"], stands["b"], stands.get("c", "")
    last = tuple(stands[letter] for letter in after)
    run = Trajectory(
        states=(first, second, *last),
        actions=(taken, *later),
        rewards=tuple(rng.nonzero(-4, 8) for _ in (first, *last)),
        terminal=tuple(state for state in last if state == setting.terminal),
    )
    tried = tuple(zip(run.states, run.actions, strict=False))
    remembered = Entry(stands[known], remembers, rng.nonzero(-4, 8), first)
    model: tuple[Entry, ...] = (remembered,)
    changed: tuple[Entry, ...] = ()
    planned: tuple[tuple[str, str], ...] = (remembered.pair,)
    if level == 2 and last:
        model, planned = (), rng.shuffled(tried)[: rng.choice((1, 2))]
    elif level == 2:
        planned = rng.shuffled((remembered.pair, *tried))
    elif level == 3:
        model = (Entry(*tried[0], rng.nonzero(-4, 8), third), remembered)
        changed = (Entry(*remembered.pair, rng.nonzero(-4, 8), second),)
        planned = rng.shuffled((remembered.pair, tried[0]))
    named = {*run.states, *(entry.state for entry in model)} - {setting.terminal}
    given = Given(
        trajectory=run,
        values=draw_rows(rng, [state for state in setting.states if state in named], choices, unit),
        model=model,
        planned=planned,
        changed=changed,
        alpha=alpha,
        gamma=gamma,
    )
    updates = [*given.tried, *(given.learned[pair] for pair in planned)]
    replayed = [ActionMove(entry.state, entry.action, entry.next, entry.reward) for entry in updates]
    if remembered.pair in tried or not readable(given.values, replayed, run.terminal, alpha, gamma, _greatest):
        return draw(level, rng)
    return given


def _greatest(row: Mapping[str, Fraction], _: str) -> Fraction:
    return max(row.values())


def question(given: Given) -> Question:
    """The run, the values and the model before it, and what planning draws; then what the real updates and it give."""
    count = len(given.planned)
    drawn = ", then ".join(f"({', '.join(pair)})" for pair in given.planned)
    updates = f"{count} planned updates" if count > 1 else "one planned update"
    pairs = f"pairs that it draws at random: first {drawn}" if count > 1 else f"a pair that it draws at random: {drawn}"
    blocks = (
        *run_situation(given, action_values_table(given.values)),
        *_model_blocks(given),
        Paragraph(
            "After every transition the agent updates $Q$ by Q-learning, with the values that are current then, and "
            f"after that its model. After the run it makes {updates} with the model, of {pairs}."
        ),
    )
    real, planned = _asked(given.updated, "the run"), _asked(given.replayed, "planning")
    parts = [Part(f"Before planning, what is {real}{in_open(given)}?", Values("Q", given.updated))]
    if given.changed:
        ask = "Which reward $r̂(s, a)$ does the model hold after the run, for every pair in it?"
        parts.append(Part(ask, Values("r̂", tuple(given.learned))))
    parts.append(Part(f"After planning, what is {planned}{in_open(given)}?", Values("Q", given.replayed)))
    return Question(blocks, tuple(parts))


def _asked(pairs: tuple[tuple[str, str], ...], by: str) -> str:
    if len(pairs) == 1:
        return f'$Q("{pairs[0][0]}", "{pairs[0][1]}")$'
    return f"the value of every pair that {by} has updated"


def _model_blocks(given: Given) -> tuple[Block, ...]:
    """What a model holds, what it holds before the run, and what has changed since without being noticed."""
    told = (
        "The agent learns with Dyna-Q. Its model holds, for every pair of state and action that it has tried, the "
        "reward $r̂(s, a)$ and the next state $ŝ(s, a)$ that followed when it tried the pair last. Before the run the "
        "model is "
    )
    if not given.model:
        return (Paragraph(f"{told}empty."),)
    table = Table(
        header=("$s$", "$a$", "$r̂(s, a)$", "$ŝ(s, a)$"),
        rows=tuple((entry.state, entry.action, f"${shown(entry.reward)}$", entry.next) for entry in given.model),
    )
    changes = "; ".join(
        f"{entry.action} in {entry.state} now leads to {entry.next} with the reward ${shown(entry.reward)}$"
        for entry in given.changed
    )
    since = f"The environment has changed since: {changes}. The agent has not tried this yet."
    return (Paragraph(f"{told}this:"), table, *([Paragraph(since)] if changes else []))
