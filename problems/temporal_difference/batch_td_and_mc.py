"""What batch TD(0) and batch Monte Carlo make of the same episodes."""

from collections import Counter
from collections.abc import Mapping
from itertools import chain, pairwise
from typing import Literal

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Discount, Exact, Parameter, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Name
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import discount, in_open
from rldrill.problems.settings import draw_places

TITLE = "Batch TD(0) and batch Monte Carlo"
SOURCE = "Sutton & Barto 2018, section 6.3"
REVISION = 5


class Observed(Givens):
    """An episode as it was seen: state, reward, state, reward, …, end; and how many times it was seen."""

    states: tuple[Name, ...] = Field(
        min_length=1,
        max_length=100,
        description="The states that were left, in their order; the terminal one is not named.",
    )
    rewards: tuple[Exact, ...] = Field(max_length=100, description="The reward after each of them.")
    times: int = Field(default=1, ge=1, le=100, description="How many times this episode was seen.")

    @model_validator(mode="after")
    def _consistent(self) -> "Observed":
        if len(self.rewards) != len(self.states):
            raise ValueError(
                f"an episode of {len(self.states)} states earns as many rewards, not {len(self.rewards)}; "
                "leave out the terminal state, or give the reward that is missing"
            )
        return self


class Given(Givens):
    """The episodes, and the discount."""

    episodes: tuple[Observed, ...] = Field(min_length=1, max_length=50, description="The episodes.")
    gamma: Discount
    visits: Literal["every", "first"] = Field(
        default="every",
        exclude_if=lambda visits: visits == "every",
        description="Which visits of an episode count for Monte Carlo; for TD(0) all do.",
    )

    @property
    def states(self) -> tuple[str, ...]:
        """The states that were seen, in the order of their first visit."""
        return tuple(dict.fromkeys(state for episode in self.episodes for state in episode.states))


#: The visits of the episodes of each level, a letter for every state.
_PATHS: dict[int, tuple[tuple[str, ...], ...]] = {
    1: (("ab", "b", "b", "b"),),
    2: (
        ("ab", "ab", "a", "b", "b", "b"),
        ("ab", "ba", "b", "b", "a"),
        ("ab", "a", "a", "b", "b"),
        ("aab", "ab", "b", "b"),
    ),
    3: (
        ("abc", "ac", "bc", "bc", "c", "c"),
        ("ab", "bc", "bc", "c", "c"),
        ("abc", "ab", "bc", "c"),
        ("abb", "b", "a", "b"),
    ),
}


def draw(level: int, rng: Draws) -> Given:
    """Two states, and one episode through both; then more of both; then with γ left open."""
    paths = rng.choice(_PATHS[level])
    _, named = draw_places(rng, chain.from_iterable(map(pairwise, paths)))
    episodes = _episodes(rng, named, paths, level)
    while not _all_count(episodes):
        episodes = _episodes(rng, named, paths, level)
    twice = any(len(set(path)) < len(path) for path in paths)
    given = Given(
        episodes=episodes,
        gamma=Parameter("gamma") if level == 3 else Fraction(1) if level == 1 else rng.fraction("1/2", "1"),
        visits=rng.choice(("first", "every")) if twice else "every",
    )
    return given if all(_moves_a_mean(given, episode) for episode in episodes) else draw(level, rng)


def _episodes(rng: Draws, named: Mapping[str, str], paths: tuple[str, ...], level: int) -> tuple[Observed, ...]:
    high = 4 if level > 1 else 3
    seen = Counter((tuple(named[place] for place in path), tuple(rng.whole(0, high) for _ in path)) for path in paths)
    return tuple(Observed(states=states, rewards=rewards, times=times) for (states, rewards), times in seen.items())


def _all_count(episodes: tuple[Observed, ...]) -> bool:
    """Whether each reward that ends an episode differs from the mean reward of its state, which it then changes."""
    earned: dict[str, list[Fraction]] = {}
    for episode in episodes:
        for state, reward in zip(episode.states, episode.rewards, strict=True):
            earned.setdefault(state, []).extend([reward] * episode.times)
    means = {state: sum(rewards, Fraction(0)) / len(rewards) for state, rewards in earned.items()}
    return all(episode.rewards[-1] != means[episode.states[-1]] for episode in episodes)


def _moves_a_mean(given: Given, episode: Observed) -> bool:
    """Whether Monte Carlo's values depend on how many times an episode was seen; where γ is open, for one half."""
    counted = [(each, _returns(each, given)) for each in given.episodes]
    for state in dict.fromkeys(episode.states):
        returned = [(G, each.times) for each, returns in counted for visited, G in returns if visited == state]
        mean = sum((G * times for G, times in returned), Fraction(0)) / sum(times for _, times in returned)
        if sum(G - mean for visited, G in _returns(episode, given) if visited == state):
            return True
    return False


def _returns(episode: Observed, given: Given) -> list[tuple[str, Fraction]]:
    """The visits of an episode that count for Monte Carlo, the last one first, and the return from each on."""
    gamma = Fraction(1, 2) if isinstance(given.gamma, Parameter) else given.gamma
    found, G = [], Fraction(0)
    for place in reversed(range(len(episode.states))):
        G = episode.rewards[place] + gamma * G
        if given.visits == "every" or episode.states[place] not in episode.states[:place]:
            found.append((episode.states[place], G))
    return found


def question(given: Given) -> Question:
    """The episodes as Example 6.4 lists them; what each method converges to is a part."""
    blocks = (
        Paragraph("These episodes are observed (state, reward, state, reward, …). Each ends after its last reward."),
        _listed(given.episodes),
        Paragraph(discount(given.gamma)),
        Paragraph(
            "All episodes are presented again and again as one batch. The values change only at the end of each batch, "
            "by the sum of all its updates with a small constant step size, until they have converged."
        ),
    )
    tail = in_open(given)
    key = Values("V", given.states)
    what = f'value $V("{given.states[0]}")$' if len(given.states) == 1 else "values $V(s)$"
    ask = f"To which {what} does"
    return Question(
        blocks,
        (
            Part(f"{ask} batch {given.visits}-visit Monte Carlo converge{tail}?", key),
            Part(f"{ask} batch TD(0) converge{tail}?", key),
        ),
    )


def _listed(episodes: tuple[Observed, ...]) -> Table:
    """The episodes, with how many times each was observed unless that is once for all."""
    if all(episode.times == 1 for episode in episodes):
        rows = tuple((f"${number}$", run_text(episode)) for number, episode in enumerate(episodes, 1))
        return Table(header=("episode", "observed"), rows=rows)
    rows = tuple((f"${episode.times}$", run_text(episode)) for episode in episodes)
    return Table(header=("times", "episode"), rows=rows)


def run_text(episode: Observed) -> str:
    """An episode in a line: state, reward, state, reward, …"""
    return ", ".join(
        f"{state}, ${shown(reward)}$" for state, reward in zip(episode.states, episode.rewards, strict=True)
    )
