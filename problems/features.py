"""Features of states and actions and the weights that go with them, as problems give them."""

from collections.abc import Mapping, Sequence
from typing import Annotated

from pydantic import Field

from rldrill.problems.document import Table
from rldrill.problems.exact import Exact, Weight, WeightField, shown
from rldrill.problems.models import Name, Named
from rldrill.problems.names import once, read_name

#: So many features are written out for everything that has them.
MOST_FEATURES = 100
FeatureVector = Annotated[tuple[Exact, ...], Field(max_length=MOST_FEATURES)]
#: Of so many actions a softmax is written out; every probability of it has a sum over all of them.
MOST_ACTIONS = 100
#: A preference for every action of a state.
ActionPreferences = Annotated[dict[Name, WeightField], Field(max_length=MOST_ACTIONS), once(read_name)]
#: The features of every action in one state, and in some states.
OneStateFeatures = Annotated[dict[Name, FeatureVector], Field(max_length=MOST_ACTIONS), once(read_name)]
ActionFeatures = Named[OneStateFeatures]


def check_features(features: Mapping[str, Sequence[object]], size: int) -> None:
    """Demand as many features of everything as there are weights.

    Raises:
        ValueError: there are more or fewer somewhere.
    """
    for name, row in features.items():
        if len(row) != size:
            raise ValueError(f"features: {name!r} has {len(row)} features, but theta {size}; give as many")


def check_action_features(features: ActionFeatures, size: int) -> None:
    """Demand actions in every state, and as many features of each as there are weights.

    Raises:
        ValueError: a state has no action, or there are more or fewer features somewhere.
    """
    for state, row in features.items():
        if not row:
            raise ValueError(f"features: {state!r} has no action; add one")
        check_features(row, size)


def features_table(features: Mapping[str, FeatureVector], what: str = "a", of: str = "f", about: str = "s, a") -> Table:
    """One line of features for every action of a state, or for every state."""
    size = len(next(iter(features.values())))
    columns = tuple(f"${of}_{{{index}}}({about})$" for index in range(1, size + 1))
    return Table(
        header=(f"${what}$", *columns),
        rows=tuple((name, *(f"${shown(value)}$" for value in row)) for name, row in features.items()),
    )


def action_features_table(features: ActionFeatures) -> Table:
    """One line of features for every state and action."""
    size = len(next(iter(next(iter(features.values())).values())))
    columns = tuple(f"$f_{{{index}}}(s, a)$" for index in range(1, size + 1))
    return Table(
        header=("$s$", "$a$", *columns),
        rows=tuple(
            (state, action, *(f"${shown(value)}$" for value in row))
            for state, actions in features.items()
            for action, row in actions.items()
        ),
    )


def weights(theta: Sequence[Weight]) -> str:
    """All weights by their numbers, as mathematics: each a formula of its own, between which a line may break."""
    return "$, $".join(f"θ_{{{index}}} = {shown(weight)}" for index, weight in enumerate(theta, 1))


def weight_names(theta: Sequence[object]) -> tuple[str, ...]:
    """What the entries of a vector of weights are called."""
    return tuple(f"θ_{{{index}}}" for index in range(1, len(theta) + 1))
