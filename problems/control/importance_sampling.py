"""The importance sampling ratios of some episodes, and the ordinary and the weighted estimate of a state's value."""

from itertools import islice
from math import prod
from typing import Annotated, Self

from pydantic import BeforeValidator, Field, ValidationInfo, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Parameter, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.models import (
    UNIFORM,
    DistributionField,
    Named,
    PolicyField,
    check_chances,
    check_keys,
    policy_table,
    read_policy,
)
from rldrill.problems.parts import Number, Numbers, Part
from rldrill.problems.phrases import discount, in_open, terminal_note
from rldrill.problems.runs import Trajectory, timeline
from rldrill.problems.settings import Setting, draw_moves, possible, settings

TITLE = "Importance sampling"
SOURCE = "Sutton & Barto 2018, section 5.5"
REVISION = 5


def _read_behaviour(value: object, info: ValidationInfo) -> object:
    """A behaviour policy, which is uniform only over actions that the target policy names."""
    named = info.data.get("target") or {}
    if isinstance(value, str) and value in UNIFORM and (few := [state for state, row in named.items() if len(row) < 2]):
        raise ValueError(
            f"{value!r} over which actions of {few[0]!r}? The target policy names one; write the probability of each, "
            f"as in {{{few[0]} = {{a = '1/2', b = '1/2'}}}}"
        )
    return read_policy(value, info)


class Given(Givens):
    """Episodes from one state, the policy b that acted, the policy π that is evaluated, and the discount."""

    episodes: tuple[Trajectory, ...] = Field(
        min_length=1, max_length=26, description="The episodes, all from the same state."
    )
    target: PolicyField = Field(description="The policy that is evaluated.")
    behaviour: Annotated[Named[DistributionField], BeforeValidator(_read_behaviour)] = Field(
        description="The policy that acted."
    )
    gamma: Discount

    @model_validator(mode="after")
    def _fits(self) -> Self:
        for number, episode in enumerate(self.episodes, 1):
            if episode.states[-1] not in episode.terminal:
                raise ValueError(
                    f"episodes[{number}]: an episode must end in a terminal state; "
                    "list its last state as terminal, or go on to the end"
                )
            if len(episode.actions) != len(episode.rewards):
                raise ValueError(f"episodes[{number}]: the action taken in every state that is left is needed; add it")
            if episode.states[0] != self.start:
                raise ValueError(f"episodes[{number}]: all episodes must start in {self.start!r}")
            for state, action in zip(episode.states, episode.actions, strict=False):
                if not self.behaviour.get(state, {}).get(action):
                    raise ValueError(
                        f"behaviour: {action!r} is taken in {state!r}, where it has no probability; add it"
                    )
        for state, acted in self.behaviour.items():
            check_chances(acted, state, tuple(acted), "the behaviour policy")
        check_keys(self.target, tuple(self.behaviour), "the target policy", needed=tuple(self.behaviour))
        for state, chances in self.target.items():
            check_chances(chances, state, tuple(self.behaviour[state]), "the target policy")
        return self

    @property
    def start(self) -> str:
        """The state in which the episodes start."""
        return self.episodes[0].states[0]

    @property
    def target_takes_all(self) -> bool:
        """Whether the target policy could have taken all the actions taken."""
        return all(
            self.target[state].get(action, 0) != 0
            for episode in self.episodes
            for state, action in zip(episode.states, episode.actions, strict=False)
        )


#: Probabilities of the first action under b and under π, whose ratios are simple numbers.
_PAIRS = (
    ("1/2", "1/4"),
    ("1/4", "1/2"),
    ("1/4", "3/4"),
    ("1/3", "2/3"),
    ("1/5", "3/5"),
    ("2/5", "1/5"),
    ("1/2", "3/4"),
)


#: Episodes of so many steps fit on a line.
_IN_A_LINE = 3

#: What happens in an episode of one step, and in one of two.
_MOVES = {1: (("a", "."),), 2: (("a", "b"), ("b", "."))}


def draw(level: int, rng: Draws) -> Given:
    """One episode of two steps; then two or three; then the same with the target policy left open in one state."""
    setting = rng.choice(tuple(setting for setting in settings() if len(setting.onward) > 1))
    both = setting.onward[:2]
    lengths = {1: (2,), 2: rng.choice(((1, 2), (2, 2), (1, 2, 2))), 3: rng.choice(((1, 2), (2, 2), (1, 1, 2)))}[level]
    lengths = rng.shuffled(lengths)
    moves = tuple(move for length in lengths for move in _MOVES[length])
    if not possible(setting, moves, both):
        return draw(level, rng)
    named, taken = draw_moves(rng, setting, moves, both)
    left, first, second = iter(taken), named["a"], named["b"]
    behaviour, target = {}, {}
    for state in (first, second):
        pair = rng.choice(_PAIRS)
        actions = both if rng.chance(Fraction(1, 2)) else both[::-1]
        chances = [dict(zip(actions, (fraction_of(text), 1 - fraction_of(text)), strict=True)) for text in pair]
        behaviour[state], target[state] = ({action: row[action] for action in both} for row in chances)
    given = Given(
        episodes=tuple(
            _episode(rng, setting, (first, second)[:length], tuple(islice(left, length))) for length in lengths
        ),
        target=target,
        behaviour=behaviour,
        gamma=rng.fraction("1/2", "1") if level > 1 else rng.fraction("1/2", "4/5"),
    )
    if not _telling(given):
        return draw(level, rng)
    if level == 3:
        if not _open_matters(given, both[0]):
            return draw(level, rng)
        open_chances = dict(zip(both, (Parameter("p"), Parameter("1-p")), strict=True))
        return given.model_copy(update={"target": target | {first: open_chances}})
    return given


def _open_matters(given: Given, onward: str) -> bool:
    """Whether, with p for the first action, no ratio is p or 1 − p itself, and their sum depends on p."""
    slopes = []
    for episode in given.episodes:
        (first, *later), (state, *rest) = episode.actions, episode.states
        shares = [
            Fraction(given.target[after][action]) / Fraction(given.behaviour[after][action])
            for after, action in zip(rest, later, strict=False)
        ]
        slope = prod(shares, start=1 / Fraction(given.behaviour[state][first]))
        slopes.append(slope if first == onward else -slope)
    return sum(slopes) != 0 and all(abs(slope) != 1 for slope in slopes)


def _telling(given: Given) -> bool:
    """Whether the ratios differ, and the returns, and the weighted estimate is readable."""
    ratios: list[Fraction] = []
    returns: list[Fraction] = []
    for episode in given.episodes:
        shares = [
            Fraction(given.target[state][action]) / Fraction(given.behaviour[state][action])
            for state, action in zip(episode.states, episode.actions, strict=False)
        ]
        ratios.append(prod(shares, start=Fraction(1)))
        returns.append(
            sum(
                (reward * Fraction(given.gamma) ** time for time, reward in enumerate(episode.rewards)),
                Fraction(0),
            )
        )
    weighed = [ratio * earned for ratio, earned in zip(ratios, returns, strict=True)]
    later = [ratio * episode.rewards[1] for ratio, episode in zip(ratios, given.episodes, strict=True)
             if len(episode.rewards) > 1]  # fmt: skip
    total = sum(weighed, Fraction(0))
    different = (
        len(set(ratios)) == len(set(returns)) == len(ratios)
        and 1 not in ratios
        and 0 not in returns
        and sum(later) != 0
    )
    return different and all(
        abs(number.numerator) <= 200 and number.denominator <= 60
        for number in (total / len(weighed), total / sum(ratios))
    )


def _episode(rng: Draws, setting: Setting, states: tuple[str, ...], actions: tuple[str, ...]) -> Trajectory:
    return Trajectory(
        states=(*states, setting.terminal),
        actions=actions,
        rewards=tuple(rng.nonzero(-4, 8) for _ in states),
        terminal=(setting.terminal,),
    )


def question(given: Given) -> Question:
    """Both policies and the episodes; the ratios, then the estimates."""
    several = len(given.episodes) > 1
    left_open = [name for name in given.parameters() if name != "gamma"]
    blocks = (
        Paragraph(
            "An agent has followed the behaviour policy $b$ to learn the value of the target policy $π$. The "
            "two policies take action $a$ in state $s$ with these probabilities:"
        ),
        policy_table(given.target, b=given.behaviour),
        *(
            Paragraph(f"The probability ${shown(Parameter(p))}$ is left open, $0 < {shown(Parameter(p))} < 1$.")
            for p in left_open
        ),
        Paragraph(
            f"{discount(given.gamma)} The agent has followed $b$ for "
            f"{f'these {len(given.episodes)} episodes' if several else 'episode $1$'}:"
        ),
        *_runs(given.episodes),
        *terminal_note(tuple(dict.fromkeys(state for episode in given.episodes for state in episode.terminal))),
    )
    entries = tuple(f"ρ_{number}" for number in range(1, len(given.episodes) + 1))
    value = f'$V^π("{given.start}")$'
    if not several:
        return Question(
            blocks,
            (
                Part(f"What is the importance sampling ratio $ρ_1$ of episode $1${in_open(given)}?", Number()),
                Part(
                    f"What is the ordinary importance sampling estimate of {value} from this episode{in_open(given)}?",
                    Number(),
                ),
            ),
        )
    ratios = f"What are the importance sampling ratios {_listed(entries)} of the episodes, in this order"
    return Question(
        blocks,
        (
            Part(f"{ratios}{in_open(given)}?", Numbers(entries)),
            Part(f"What is the estimate of {value} by ordinary importance sampling{in_open(given)}?", Number()),
            Part(f"What is the estimate of {value} by weighted importance sampling{in_open(given)}?", Number()),
        ),
    )


def _runs(episodes: tuple[Trajectory, ...]) -> tuple[Block, ...]:
    """Short episodes as the lines of a table, in which a dash stands for what comes after the end; others drawn."""
    steps = max(len(episode.rewards) for episode in episodes)
    if len(episodes) == 1:
        return (timeline(episodes[0]),)
    if steps > _IN_A_LINE:
        return tuple(
            block
            for number, episode in enumerate(episodes, 1)
            for block in (Paragraph(f"Episode {number}:"), timeline(episode))
        )
    header = [f"${letter}$" for time in range(steps) for letter in (f"s_{time}", f"a_{time}", f"r_{time + 1}")]
    rows = []
    for number, episode in enumerate(episodes, 1):
        left = zip(episode.states, episode.actions, episode.rewards, strict=False)
        cells = [cell for state, action, reward in left for cell in (state, action, f"${shown(reward)}$")]
        cells.append(episode.states[-1])
        rows.append((f"${number}$", *cells, *["–"] * (len(header) + 1 - len(cells))))
    return (Table(header=("episode", *header, f"$s_{steps}$"), rows=tuple(rows)),)


def _listed(entries: tuple[str, ...]) -> str:
    return f"${entries[0]}, …, {entries[-1]}$" if len(entries) > 2 else f"${entries[0]}, {entries[-1]}$"
