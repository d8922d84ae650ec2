"""Beliefs over states or hypotheses, how robots move and sense, and how questions show these."""

from collections.abc import Iterable, Mapping
from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator, Field, ValidationInfo

from rldrill.problems.bars import belief_bars
from rldrill.problems.document import Block, Table
from rldrill.problems.exact import OpenProbability, Parameter, Probability, Scalar, is_scalar, shown
from rldrill.problems.family import Givens
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import Hypotheses, Name, Named, OpenDistributionField, check_keys, check_sum
from rldrill.problems.readings import distribution, note_of, told

Likelihood = Mapping[str, Mapping[str, Scalar]]
Motion = Mapping[str, Mapping[str, Mapping[str, Scalar]]]

#: So many products are summed by all predictions of a run; one among all states of the largest model is.
_MOST_SUMMANDS = 1024**2

#: What stands above the table of a motion, and above that of a sensor.
MOTION_TOLD = "Taking action $a$ in state $s$ leads to the next state $s'$ with probability $p(s'|s, a)$:"
SENSOR_TOLD = "In state $s$ the sensor reads $z$ with probability $p(z|s)$:"
#: What stands above an initial belief.
BELIEF_TOLD = "The initial belief $p(s)$ is:"


class Outcome(Givens):
    """What is known of the belief after a step, so that the letter left open can be found."""

    state: Name = Field(description="The state or hypothesis whose probability is known.")
    probability: Probability = Field(description="What its probability is then.")


def _turned(table: Likelihood) -> dict[str, dict[str, Scalar]]:
    """A table with its rows as columns."""
    columns = dict.fromkeys(column for row in table.values() for column in row)
    return {column: {name: row[column] for name, row in table.items() if column in row} for column in columns}


def _by_action(motion: Motion) -> Motion:
    """A motion by action and state; written so, or by state and action, where the states that are reached tell."""
    acting = {state for rows in motion.values() for state in rows}
    reached = {after for rows in motion.values() for row in rows.values() for after in row}
    if reached & acting or not reached & set(motion):
        return motion
    return {
        action: {state: rows[action] for state, rows in motion.items() if action in rows}
        for action in dict.fromkeys(action for rows in motion.values() for action in rows)
    }


def _has_actions(value: Any) -> Any:
    """Refuse a table of states where one of actions is needed: in its rows stand states, and their probabilities.

    A number that is a name there may be the next state of an action.
    """
    rows = value if isinstance(value, dict) else {}
    names = {str(name) for name in rows}
    within = [row if isinstance(row, dict) else {} for row in rows.values()]
    chances = [chance for row in within for chance in row.values()]
    if (
        all(row and {str(state) for state in row} <= names for row in within)
        and all(map(is_scalar, chances))
        and any(str(chance) not in names for chance in chances)
    ):
        first = next(iter(rows))
        raise ValueError(f"holds states alone; put the name of the action before them, as {{go = {{{first} = …}}}}")
    return value


#: Where actions lead: for every action and state the probabilities of the next states.
MotionField = Annotated[Named[Named[OpenDistributionField]], BeforeValidator(_has_actions), AfterValidator(_by_action)]


def _fits(table: Likelihood) -> bool:
    """Whether the rows of a table may be the probabilities of all readings, each under one hypothesis."""
    numbers = ([chance for chance in row.values() if isinstance(chance, Fraction)] for row in table.values())
    return all(sum(row, Fraction(0)) <= 1 for row in numbers)


def _by_reading(likelihood: Likelihood, info: ValidationInfo) -> Likelihood:
    """A likelihood by reading, whichever way it is written; what a program rounded is read as it is meant."""
    known = set(info.data.get("prior") or info.data.get("belief") or ())
    turned = all(set(row) != known for row in likelihood.values()) or (_fits(likelihood) > _fits(_turned(likelihood)))
    of_hypotheses = set(likelihood) == known and turned
    rows = likelihood if of_hypotheses else _turned(likelihood)
    meant = {hypothesis: distribution(row, note_of(info)) for hypothesis, row in rows.items()}
    if of_hypotheses:
        return _turned(meant)
    return {reading: {name: meant[name][reading] for name in row} for reading, row in likelihood.items()}


#: What a sensor reads with which probability, by reading; written so, or by hypothesis, where these are told apart.
LikelihoodField = Annotated[Hypotheses[Hypotheses[OpenProbability]], AfterValidator(_by_reading)]


def check_distribution(chances: Mapping[str, Scalar], what: str) -> None:
    """Demand that probabilities sum to 1.

    Raises:
        ValueError: they do not.
    """
    check_sum(chances.values(), f"{what}: the probabilities")


def check_outcome(outcome: Outcome | None, left_open: tuple[str, ...], states: tuple[str, ...]) -> None:
    """Demand that an outcome is of a known state, and that there is one letter to find from it.

    Raises:
        ValueError: it is not, or there is none, or more than one.
    """
    if outcome is None:
        return
    if len(left_open) != 1:
        raise ValueError("outcome: there must be one letter, such as q, among the probabilities that is found from it")
    check_keys({outcome.state: None}, states, "the outcome", ())


def check_likelihood(likelihood: Likelihood, known: tuple[str, ...]) -> None:
    """Demand a likelihood of every reading under every hypothesis, and at most 1 of all readings together.

    Raises:
        ValueError: one is missing, given for an unknown hypothesis, or they sum to more than 1.
    """
    for reading, chances in likelihood.items():
        check_keys(chances, known, f"the likelihood of {reading!r}", needed=known)
    for hypothesis in known:
        every = [chances[hypothesis] for chances in likelihood.values()]
        if (total := sum((chance for chance in every if isinstance(chance, Fraction)), Fraction(0))) > 1:
            raise ValueError(
                f"likelihood: the readings under {hypothesis!r} sum to {told(total)}, more than 1; make them smaller"
            )


def check_possible(believed: Iterable[str], likelihood: Mapping[str, Scalar], what: str) -> tuple[str, ...]:
    """Demand that a measurement is possible under a belief; what it leaves possible.

    Args:
        believed: what the belief holds for possible.
        likelihood: the likelihood of the measurement, by state or hypothesis.
        what: the measurement, for the sentence.

    Raises:
        ValueError: its likelihood is zero wherever the belief is not.
    """
    left = tuple(known for known in believed if likelihood[known])
    if not left:
        raise ValueError(f"{what} is impossible under the belief, which is 0 wherever its likelihood is not; change it")
    return left


def check_motion(motion: Motion, states: tuple[str, ...], ends: tuple[str, ...] = ()) -> None:
    """Demand that every action leads somewhere from every state.

    Args:
        motion: the probabilities of the next states, by action and state.
        states: the states in which actions are taken.
        ends: further states that may be reached.

    Raises:
        ValueError: a state is missing or unknown, or probabilities do not sum to 1.
    """
    for action, rows in motion.items():
        check_keys(rows, states, f"the motion of {action!r}", needed=states)
        for state, chances in rows.items():
            check_keys(chances, (*states, *ends), f"the motion of {action!r} in {state!r}", needed=())
            check_distribution(chances, f"motion of {action!r} in {state!r}")


def check_predictions(count: int, states: int, where: str) -> None:
    """Demand that predictions, each a sum over all states for every state, are worked out in seconds.

    Raises:
        ValueError: they are not.
    """
    if count * states**2 > _MOST_SUMMANDS:
        raise ValueError(
            f"{where}: {count} actions among {states} states take too long; at most {_MOST_SUMMANDS // states**2} are "
            "possible here"
        )


def likelihood_table(likelihood: Likelihood, known: tuple[str, ...], letter: str = "s") -> Table:
    """What a sensor reads with which probability, one line for every reading."""
    return Table(
        header=(f"$p(z|{letter})$", *known),
        rows=tuple(
            (reading, *(f"${shown(chances[hypothesis])}$" for hypothesis in known))
            for reading, chances in likelihood.items()
        ),
    )


def motion_table(motion: Motion, states: tuple[str, ...], ends: tuple[str, ...] = ()) -> Table:
    """Where actions lead, one line for every action and state, one column for every next state."""
    targets = (*states, *ends)
    return Table(
        header=("$a$", "$s$", *(f"$s' =$ {target}" for target in targets)),
        rows=tuple(
            (action, state, *(f"${shown(chances.get(target, 0))}$" for target in targets))
            for action, rows in motion.items()
            for state, chances in rows.items()
        ),
    )


def predicted(
    belief: Mapping[str, Fraction], rows: Mapping[str, Mapping[str, Scalar]], q: Fraction
) -> dict[str, Fraction]:
    """The belief after an action with these transition probabilities; what is left open in them is q."""
    moved = dict.fromkeys(belief, Fraction(0))
    for state, chances in rows.items():
        for target, chance in chances.items():
            moved[target] += belief[state] * filled(chance, q)
    return moved


def updated(belief: Mapping[str, Fraction], likelihood: Mapping[str, Scalar], q: Fraction) -> dict[str, Fraction]:
    """The belief after a measurement with this likelihood in every state; what is left open in it is q."""
    joint = {state: chance * filled(likelihood[state], q) for state, chance in belief.items()}
    total = sum(joint.values())
    return {state: chance / total for state, chance in joint.items()}


def filled(chance: Scalar, q: Fraction) -> Fraction:
    """A probability, with a number put in for what is left open."""
    if isinstance(chance, Parameter):
        return 1 - q if chance.complement else q
    return chance


def belief_shown(belief: Mapping[str, Scalar], letter: str = "s") -> Block:
    """A belief as bars; as a table, where a probability in it is left open."""
    if any(isinstance(chance, Parameter) for chance in belief.values()):
        shares = (f"${shown(chance)}$" for chance in belief.values())
        return Table(header=(f"${letter}$", *belief), rows=((f"$p({letter})$", *shares),))
    return belief_bars(belief={state: filled(chance, Fraction(0)) for state, chance in belief.items()})
