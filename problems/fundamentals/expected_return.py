"""The expected return of a policy, from a start distribution and a small tree of chances."""

from collections.abc import Iterator
from math import prod
from typing import NamedTuple, Self, TypeAlias

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Parameter, Scalar, shown
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import (
    Model,
    ModelAndPolicy,
    OpenDistributionField,
    PolicyField,
    Transition,
    check_keys,
    check_sum,
    model_blocks,
    open_chance,
    policy_blocks,
)
from rldrill.problems.parts import Number, Part
from rldrill.problems.phrases import discount, in_open
from rldrill.problems.reversible import Reversible, letter_asked
from rldrill.problems.runs import readable
from rldrill.problems.settings import Map, maps

TITLE = "Expected return"
SOURCE = "Sutton & Barto 2018, sections 3.3 and 3.5"
REVISION = 7

_MOST = 200


class Episode(NamedTuple):
    """What happens from a start to an end."""

    start: str
    transitions: tuple[Transition, ...]


class Given(Reversible, ModelAndPolicy):
    """A start distribution, a model in which every episode ends soon, a policy and the discount.

    Without a policy every action is equally probable. Where ``known`` is the expected return, the probability that is
    left open is asked for.
    """

    start: OpenDistributionField = Field(min_length=1, description="The probability of every state to start in.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_keys(self.start, self.mdp.states, "the start probability", needed=())
        check_sum(self.start.values(), "start: the probabilities")
        for count, _ in enumerate(self.episodes(), 1):
            if count > _MOST:
                raise ValueError(f"mdp: there are more than {_MOST} different episodes; that is no small tree")
        return self

    @property
    def chooses(self) -> bool:
        """Whether the policy leaves something to chance."""
        return any(chance not in (0, 1) for row in self.chances.values() for chance in row.values())

    @property
    def sought(self) -> str:
        """Whether a probability of the start, of the policy or of the model is asked for; empty where none is."""
        if self.known is None:
            return ""
        if any(isinstance(chance, Parameter) for chance in self.start.values()):
            return "start"
        chosen = (chance for row in self.chances.values() for chance in row.values())
        return "policy" if any(isinstance(chance, Parameter) for chance in chosen) else "mdp"

    def episodes(self) -> Iterator[Episode]:
        """Every episode that can happen, in the order of the tables.

        Raises:
            ValueError: a state can come again, so that episodes have no greatest length.
        """
        begun = [Episode(start, ()) for start, chance in self.start.items() if chance != 0][::-1]
        while begun:
            episode = begun.pop()
            now = episode.transitions[-1].next if episode.transitions else episode.start
            if now in self.mdp.terminal:
                yield episode
            elif any(row.state == now for row in episode.transitions):
                raise ValueError(
                    f"mdp: {now!r} can come again in an episode, which is no tree of chances; take out what leads back"
                )
            else:
                goes_on = [Episode(episode.start, (*episode.transitions, row)) for row in self._next(now)]
                begun += reversed(goes_on)

    def _next(self, state: str) -> Iterator[Transition]:
        """What can happen in a state that is not terminal."""
        for action in self.mdp.actions[state]:
            if self.chances[state].get(action, 0) != 0:
                yield from (row for row in self.mdp.outcomes[state, action] if row.probability != 0)


#: Branches: a state, an action and where it may lead, in numbers; 3 is the end.
Tree: TypeAlias = tuple[tuple[int, int, tuple[int, ...]], ...]
#: Small trees, and the states to start in: at most five episodes are added up.
_TREES: tuple[tuple[Tree, tuple[int, ...]], ...] = (
    (((0, 0, (1, 2)), (0, 1, (2, 3)), (1, 0, (3,)), (2, 0, (3,))), (0, 2)),
    (((0, 0, (1, 3)), (1, 0, (2, 3)), (1, 1, (3,)), (2, 0, (3,))), (0,)),
    (((0, 0, (1, 2)), (1, 0, (3,)), (1, 1, (2,)), (2, 0, (3,))), (0, 2)),
    (((0, 0, (1,)), (0, 1, (2, 3)), (1, 0, (2, 3)), (2, 0, (3,))), (0,)),
)
_FIRST_TREE: tuple[Tree, tuple[int, ...]] = (((0, 0, (1,)), (0, 1, (3,)), (1, 0, (3,))), (0, 1))


def draw(level: int, rng: Draws) -> Given:
    """Two starts and a choice of two actions; then branches of chance; then a probability left open or asked for."""
    place = rng.choice(maps())
    tree, starts = _FIRST_TREE if level == 1 else rng.choice(_TREES)
    gamma = rng.fraction("1/2") if level == 1 else rng.fraction("1/2", "4/5")
    given = _given(level, rng, place, tree, starts, gamma)
    while not _all_matters(given):
        given = _given(level, rng, place, tree, starts, gamma)
    mdp = given.mdp
    if level < 3:
        return given
    kind, sought, letters = rng.below(3), rng.split(2, (3, 4, 5)), (Parameter("p"), Parameter("1-p"))
    if kind == 0:
        return given.model_copy(update={"policy": _policy(mdp, letters)})
    by_start = kind == 2 and len(starts) > 1
    found, left_open = (_with(given, pair, by_start=by_start) for pair in (sought, letters))
    if not _all_matters(found):
        return draw(level, rng)
    return left_open.model_copy(update={"known": _expected(found)})


def _with(given: Given, chances: tuple[Scalar, ...], *, by_start: bool) -> Given:
    """The same with these probabilities of the two starts, or of the two actions."""
    if by_start:
        return given.model_copy(update={"start": dict(zip(given.start, chances, strict=True))})
    return given.model_copy(update={"policy": _policy(given.mdp, chances)})


def _given(level: int, rng: Draws, place: Map, tree: Tree, starts: tuple[int, ...], gamma: Fraction) -> Given:
    """Numbers for a tree; what is earned last is whole when it is discounted."""
    named = (*place.states[:3], place.terminal)
    quarters = level > 1 and rng.chance(Fraction(1, 2))
    rows = []
    for state, action, targets in tree:
        chances = rng.split(len(targets), (4,) if quarters else (2,)) if len(targets) > 1 else (Fraction(1),)
        unit = gamma if targets == (3,) else Fraction(1)
        for target, chance in zip(targets, chances, strict=True):
            reward = _reward(rng, unit)
            rows.append(Transition(named[state], place.actions[action], named[target], chance, reward))
    mdp = Model(story=place.story, transitions=tuple(rows), terminal=(place.terminal,))
    first = rng.split(len(starts), (2, 4)) if len(starts) > 1 else (Fraction(1),)
    policy = _policy(mdp, rng.split(2, (2,) if quarters else (4,)))
    return Given(
        start=dict(zip((named[place] for place in starts), first, strict=True)), mdp=mdp, policy=policy, gamma=gamma
    )


def _reward(rng: Draws, factor: Fraction) -> Fraction:
    return rng.fitting(-5, 10, lambda reward: (factor * reward).denominator == 1)


def _all_matters(given: Given) -> bool:
    """Whether no two starts, actions of a state or branches of an action are worth the same, and γ counts."""
    gamma, ahead = Fraction(given.gamma), dict.fromkeys(given.mdp.terminal, Fraction(0))
    for state, actions in reversed(given.mdp.actions.items()):
        worth = {}
        for action in actions:
            rows = given.mdp.outcomes[state, action]
            branches = [Fraction(row.reward) + gamma * ahead[row.next] for row in rows]
            if len(set(branches)) < len(branches):
                return False
            worth[action] = sum((Fraction(r.probability) * b for r, b in zip(rows, branches, strict=True)), Fraction(0))
        if len(set(worth.values())) < len(worth):
            return False
        ahead[state] = sum((Fraction(given.chances[state][a]) * value for a, value in worth.items()), Fraction(0))
    if len({ahead[state] for state in given.start}) < len(given.start):
        return False
    return readable((_expected(given),)) and _discount_shows(given)


def _discount_shows(given: Given) -> bool:
    """Whether a forgotten discount is neither right nor what the commonest slips with the probabilities give."""
    gamma, one, first = Fraction(given.gamma), Fraction(1), next(iter(given.start))
    undiscounted, slips, episodes = Fraction(0), [Fraction(0)] * 8, tuple(given.episodes())
    for episode in episodes:
        start, rows = Fraction(given.start[episode.start]), episode.transitions
        chosen = [Fraction(given.chances[row.state][row.action]) for row in rows]
        led = [Fraction(row.probability) for row in rows]
        way, chance = prod(chosen, start=one) * prod(led, start=one), start * prod(led, start=one)
        undiscounted += start * way * sum((Fraction(row.reward) for row in rows), Fraction(0))
        earned = sum((gamma**time * Fraction(row.reward) for time, row in enumerate(rows)), Fraction(0))
        counted = (
            start * way,
            way,
            way / len(given.start),
            way if episode.start == first else Fraction(0),
            chance,
            chance / prod(len(given.mdp.actions[row.state]) for row in rows),
            start * prod((*chosen[:-1], *led[:-1]), start=one),
            one,
        )
        slips = [slip + count * earned for slip, count in zip(slips, counted, strict=True)]
    return undiscounted not in (*slips, slips[-1] / len(episodes))


def _policy(mdp: Model, chances: tuple[Scalar, ...]) -> PolicyField:
    return {
        state: dict(zip(actions, chances if len(actions) > 1 else (Fraction(1),), strict=True))
        for state, actions in mdp.actions.items()
    }


def _expected(given: Given) -> Fraction:
    """The expected return where nothing is left open."""
    total = Fraction(0)
    for episode in given.episodes():
        chance, earned = Fraction(given.start[episode.start]), Fraction(0)
        for time, row in enumerate(episode.transitions):
            chance *= Fraction(row.probability) * Fraction(given.chances[row.state][row.action])
            earned += Fraction(given.gamma) ** time * Fraction(row.reward)
        total += chance * earned
    return total


def question(given: Given) -> Question:
    """The start, the model and the policy; one number is asked for."""
    if len(given.start) == 1:
        start: list[Block] = [Paragraph(f"Every episode starts in {next(iter(given.start))}.")]
    else:
        start = [
            Paragraph("The start state $s_0$ of an episode has these probabilities:"),
            Table(
                header=("$s$", *given.start),
                rows=(("$Pr(s_0 = s)$", *(f"${shown(chance)}$" for chance in given.start.values())),),
            ),
        ]
    blocks = (
        *model_blocks(given.mdp),
        *start,
        *policy_blocks(given),
        Paragraph(f"Here $R_0 = r_1 + γ r_2 + …$ is the return. {discount(given.gamma)}{open_chance(given)}"),
    )
    if given.known is not None:
        told = Paragraph(f"The expected return is $𝔼_π(R_0) = {shown(given.known)}$.")
        return Question((*blocks, told), (letter_asked(given),))
    ask = f"What is the expected return $𝔼_π(R_0)${in_open(given)}?"
    return Question(blocks, (Part(ask, Number()),))
