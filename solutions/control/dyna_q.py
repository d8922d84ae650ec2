"""Dyna-Q: real updates along a run, each followed by the model, then planned updates with what the model holds."""

from typing import Any

from rldrill.problems.control.dyna_q import Entry, Given
from rldrill.problems.document import joined
from rldrill.problems.exact import shown
from rldrill.solutions import knowns
from rldrill.solutions.exact import exact
from rldrill.solutions.formula.formula import slip
from rldrill.solutions.formula.nodes.leaves import put_in_name
from rldrill.solutions.learning import greatest_told
from rldrill.solutions.numerics import np
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.sheet.control import (
    MEAN_FOR_MAX,
    NOT_DISCOUNTED,
    OWN_STATE_MAX,
    PLANNED_UPDATE,
    Q_LEARNING,
    TAKEN_FOR_MAX,
    model_reward,
)
from rldrill.solutions.work import Equality, Work

Table = dict[tuple[str, str], Any]
Model = dict[tuple[str, str], Entry]


def solve(given: Given, work: Work) -> None:
    """The real updates, then the planned ones, each with the values then current."""
    known = _act(given, work, given.learned)
    _plan(given, work, given.learned, known)


def _act(given: Given, work: Work, model: Model) -> dict[str, Any]:
    """The real updates, and the part or two about them; what is known after them."""
    known = knowns.action_run(given)
    for time, entry in enumerate(given.tried):
        greatest = greatest_told(work, known, known["S"][time + 1])
        work.say(f"Real update at $t = {time}$, of the pair {_named(entry.pair)}{greatest and f'; {greatest}'}:")
        known["Q"] = known["Q"] | {entry.pair: work.step(Q_LEARNING, t=time, **known)}
        rule = "" if time else ", $r̂(s_t, a_t) ← r_{t+1}$ and $ŝ(s_t, a_t) ← s_{t+1}$"
        work.say(f"The model now holds what has followed{rule}: for {_named(entry.pair)} {_held(entry)}.")
    known["Q"] = known["Q"] | work.answer({pair: known["Q"][pair] for pair in given.updated})
    if given.changed:
        tried = joined([_named(entry.pair) for entry in given.tried])
        work.say(
            f"The model changes only where the agent has tried something, in {tried}; all other entries stay as they "
            "were."
        )
        rewards = {pair: exact(model[pair].reward) for pair in given.learned}
        work.lines += [Equality(model_reward(*map(put_in_name, pair)), (value,)) for pair, value in rewards.items()]
        work.answer(rewards)
    return known


def _plan(given: Given, work: Work, model: Model, known: dict[str, Any], stale: Table | None = None) -> None:
    """The planned updates, with the values then current, or with these stale ones throughout."""
    held = {
        "model_reward": {pair: exact(entry.reward) for pair, entry in model.items()},
        "model_next": {pair: entry.next for pair, entry in model.items()},
    }
    for number, pair in enumerate(given.planned, 1):
        read = known if stale is None else known | {"Q": stale}
        greatest = greatest_told(work, read, model[pair].next)
        which = f" {number}" if len(given.planned) > 1 else ""
        work.say(
            f"Planned update{which}, of the pair {_named(pair)}; the model holds {_held(model[pair])}"
            f"{greatest and f', and {greatest}'}:"
        )
        value = work.step(PLANNED_UPDATE, s=pair[0], a=pair[1], **read, **held)
        known = known | {"Q": known["Q"] | {pair: value}}
    work.answer({pair: known["Q"][pair] for pair in given.replayed})


def _named(pair: tuple[str, str]) -> str:
    return f"({', '.join(pair)})"


def _held(entry: Entry) -> str:
    return f"reward ${shown(entry.reward)}$, next state {entry.next}"


def _first_kept(given: Given) -> Model:
    """The model of somebody who stores only what it has nothing for."""
    kept = dict(given.before)
    for entry in given.tried:
        kept.setdefault(entry.pair, entry)
    return kept


def _reads(given: Given, pair: tuple[str, str], written: tuple[tuple[str, str], ...]) -> bool:
    """Whether the planned update of a pair reads a value that is written by updates of others, or of its own."""
    return pair in written or given.learned[pair].next in {state for state, _ in written}


@slip(
    "old-entry-kept",
    "A real transition replaces what the model held for its pair, and planning goes by the new entry.",
    when=lambda given: any(_first_kept(given)[pair] != given.learned[pair] for pair in given.planned),
)
def old_entry_kept(given: Given, work: Work) -> None:
    """The model keeps what it had."""
    model = _first_kept(given)
    _plan(given, work, model, _act(given, work, model))


@slip(
    "untried-change-known",
    "The agent plans with what its model holds; a change that it has not tried yet is not in there.",
    when=lambda given: any(entry.pair in given.planned for entry in given.changed),
)
def change_known(given: Given, work: Work) -> None:
    """The model holds what nobody has tried."""
    model = given.learned | {entry.pair: entry for entry in given.changed}
    _plan(given, work, model, _act(given, work, model))


@slip(
    "planned-from-before-the-run",
    "Planning goes on from the values that the real updates have left, not from those before the run.",
    when=lambda given: any(_reads(given, pair, given.updated) for pair in given.planned),
)
def from_before_the_run(given: Given, work: Work) -> None:
    """Planned updates that start from the table as it was given."""
    known = _act(given, work, given.learned)
    _plan(given, work, given.learned, known | {"Q": knowns.action_run(given)["Q"]})


@slip(
    "planned-all-at-once",
    "Each planned update takes the values then current: what an earlier planned update has changed counts already.",
    when=lambda given: any(_reads(given, pair, given.planned[:number]) for number, pair in enumerate(given.planned)),
)
def all_at_once(given: Given, work: Work) -> None:
    """Planned updates that all read the values after the real ones."""
    known = _act(given, work, given.learned)
    _plan(given, work, given.learned, known, stale=known["Q"])


@slip("planning-skipped", "Planned updates change Q as real ones do; they are still to be made.")
def planning_skipped(given: Given, work: Work) -> None:
    """The values that the real updates have left."""
    known = _act(given, work, given.learned)
    work.answer({pair: known["Q"][pair] for pair in given.replayed})


@slip(
    "real-reward-in-planning",
    "A planned update takes the reward that the model holds for its own pair, not the one just earned.",
    when=lambda given: any(given.learned[pair].reward != given.tried[-1].reward for pair in given.planned),
)
def real_reward_in_planning(given: Given, work: Work) -> None:
    """The reward of the last real transition in every planned update."""
    known = _act(given, work, given.learned)
    earned = {pair: entry._replace(reward=given.tried[-1].reward) for pair, entry in given.learned.items()}
    _plan(given, work, earned, known)


MISCONCEPTIONS = (
    NOT_DISCOUNTED,
    MEAN_FOR_MAX,
    TAKEN_FOR_MAX,
    OWN_STATE_MAX,
    old_entry_kept,
    change_known,
    from_before_the_run,
    all_at_once,
    planning_skipped,
    real_reward_in_planning.where_it_shows(),
)


def oracle(given: Given) -> Answers:
    """One long list of experience, real and then replayed from the last time it was seen, on an array."""
    states = [*given.values, *given.trajectory.terminal]
    actions = list(dict.fromkeys(action for row in given.values.values() for action in row))
    Q = np.full((len(states), len(actions)), -np.inf)
    Q[len(given.values) :] = 0.0
    for state, row in given.values.items():
        for action, value in row.items():
            Q[states.index(state), actions.index(action)] = at(value)
    lived = [(entry.state, entry.action, at(entry.reward), entry.next) for entry in (*given.model, *given.tried)]
    replayed = [next(seen for seen in reversed(lived) if seen[:2] == pair) for pair in given.planned]

    def learn(experience: list[tuple[str, str, float, str]], pairs: tuple[tuple[str, str], ...]) -> list[float]:
        for state, action, reward, after in experience:
            cell = states.index(state), actions.index(action)
            Q[cell] = np.average(
                [Q[cell], reward + at(given.gamma) * Q[states.index(after)].max()],
                weights=[1 - at(given.alpha), at(given.alpha)],
            )
        return [Q[states.index(state), actions.index(action)] for state, action in pairs]

    answers: list[list[float]] = [learn(lived[len(given.model) :], given.updated)]
    if given.changed:
        answers.append([next(seen[2] for seen in reversed(lived) if seen[:2] == pair) for pair in given.learned])
    return [*answers, learn(replayed, given.replayed)]
