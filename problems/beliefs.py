"""Beliefs over states or hypotheses, how robots move and sense, and how questions show these."""

from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import Annotated

from pydantic import AfterValidator, ValidationInfo

from rldrill.problems.document import Table
from rldrill.problems.exact import Probability, Scalar, shown
from rldrill.problems.models import Name, OpenDistributionField, check_keys, check_sum
from rldrill.problems.readings import distribution, note_of, told

Likelihood = Mapping[str, Mapping[str, Fraction]]
#: Where actions lead: for every action and state the probabilities of the next states.
MotionField = dict[Name, dict[Name, OpenDistributionField]]
Motion = Mapping[str, Mapping[str, Mapping[str, Scalar]]]

#: What stands above the table of a motion, and above that of a sensor.
MOTION_TOLD = "An action $a$ in state $s$ leads to the state $s'$ with the probability $p(s'|s, a)$:"
SENSOR_TOLD = "In state $s$ the sensor reads $z$ with the probability $p(z|s)$:"


def _turned(table: Likelihood) -> dict[str, dict[str, Fraction]]:
    """A table with its rows as columns."""
    columns = dict.fromkeys(column for row in table.values() for column in row)
    return {column: {name: row[column] for name, row in table.items() if column in row} for column in columns}


def _by_reading(likelihood: Likelihood, info: ValidationInfo) -> Likelihood:
    """A likelihood by reading, whichever way it is written; what a program rounded is read as it is meant."""
    known = set(info.data.get("prior") or info.data.get("belief") or ())
    of_hypotheses = set(likelihood) == known and all(set(row) != known for row in likelihood.values())
    rows = likelihood if of_hypotheses else _turned(likelihood)
    meant = {hypothesis: distribution(row, note_of(info)) for hypothesis, row in rows.items()}
    if of_hypotheses:
        return _turned(meant)
    return {reading: {name: meant[name][reading] for name in row} for reading, row in likelihood.items()}


#: What a sensor reads with which probability, by reading; written so, or by hypothesis, where these are told apart.
LikelihoodField = Annotated[dict[Name, dict[Name, Probability]], AfterValidator(_by_reading)]


def check_distribution(chances: Mapping[str, Scalar], what: str) -> None:
    """Demand that probabilities sum to 1.

    Raises:
        ValueError: they do not.
    """
    check_sum(chances.values(), f"{what}: the probabilities")


def check_likelihood(likelihood: Likelihood, known: tuple[str, ...]) -> None:
    """Demand a likelihood of every reading under every hypothesis, and at most 1 of all readings together.

    Raises:
        ValueError: one is missing, given for an unknown hypothesis, or they sum to more than 1.
    """
    for reading, chances in likelihood.items():
        check_keys(chances, known, f"the likelihood of {reading!r}", needed=known)
    for hypothesis in known:
        if (total := sum((chances[hypothesis] for chances in likelihood.values()), Fraction(0))) > 1:
            raise ValueError(f"likelihood: the readings under {hypothesis!r} sum to {told(total)}, more than 1")


def check_possible(believed: Iterable[str], likelihood: Mapping[str, Fraction], what: str) -> tuple[str, ...]:
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


def likelihood_table(
    likelihood: Mapping[str, Mapping[str, Fraction]], known: tuple[str, ...], letter: str = "s"
) -> Table:
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
