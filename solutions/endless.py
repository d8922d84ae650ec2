"""What it means that an undiscounted process goes round for ever: what the loop pays, and what is said of it."""

from collections.abc import Mapping

from msgspec import Struct

from rldrill.problems.document import joined
from rldrill.solutions.exact import ONE, NotReal, Value, decimal, digits, is_zero, parameters, sign, to_sympy
from rldrill.solutions.formula.equations import Affine, solve_linear

#: So many states of a loop are named.
_NAMED = 4
_DIGITS = 8


class Loop(Struct, frozen=True):
    """A recurrent class: states that are visited again and again and never left.

    Attributes:
        actions: what is done in every state.
        rewards: what a step from every state earns on average.
        chances: where it leads.
    """

    actions: Mapping[str, tuple[str, ...]]
    rewards: Mapping[str, Value]
    chances: Mapping[str, Mapping[str, Value]]

    @property
    def pays_nothing(self) -> bool:
        """Whether no step earns anything, so that the loop is worth 0."""
        return all(map(is_zero, self.rewards.values()))

    @property
    def gain(self) -> Value:
        """What a step earns on average in the long run (Puterman 1994, section 8.2)."""
        first = next(iter(self.rewards))
        right = {
            state: sum(
                (Affine({after: chance}) for after, chance in self.chances[state].items() if after != first),
                Affine({}, reward),
            )
            for state, reward in self.rewards.items()
        }
        # In the first state the equation gives the gain, since the relative value is 0 there.
        gain = Affine({first: ONE})
        return solve_linear({s: side if s == first else side + gain * -ONE for s, side in right.items()})[first]

    def __str__(self) -> str:
        """The states with what is done there."""
        named = [f"{state} ({' or '.join(actions)})" for state, actions in self.actions.items()]
        rest = len(named) - _NAMED
        return joined(named if rest < 2 else [*named[:_NAMED], f"{rest} more states"])


def no_value(loop: Loop, told: str, cure: str) -> str:
    """The sentence that says why a state of a loop has no value without discount.

    Args:
        loop: a loop that does not pay nothing.
        told: how it comes that it is never left, to be followed by the loop.
        cure: what to change, besides the discount.
    """
    state, gain = next(iter(loop.actions)), loop.gain
    side = _side(gain)
    match side:
        case 0:
            worth = f"{state} has no value"
            pays = "what is earned in turn cancels on average, so that the sum of all rewards never settles"
        case None:
            worth, pays = f"{state} has no value", "the rewards go on for ever"
        case _:
            worth = f"the value of {state} is {'−' if side < 0 else '+'}∞"
            pays = f"a step earns {_short(gain)} on average"
    return f"with γ = 1 {worth}: {told} {loop}, where {pays}; {cure}, or take γ below 1"


def no_expectation(loop: Loop, number: int) -> str:
    """The sentence that says why there is no expected sum of a feature, by its number, in a loop of a policy.

    Args:
        loop: a loop that the policy never leaves, with the feature in place of the rewards.
        number: the number of the feature.
    """
    name, gain = f"μ_{number}({next(iter(loop.actions))})", loop.gain
    match _side(gain):
        case 0:
            worth, counts = "does not exist", "the feature cancels on average, so that its sum never settles"
        case None:
            worth, counts = "does not exist", "the feature counts for ever"
        case side:
            worth, counts = f"is {'−' if side < 0 else '+'}∞", f"the feature is {_short(gain)} on average"
    return (
        f"with γ = 1 {name} {worth}: the policy goes on for ever with {loop}, where {counts}; let it lead to an end, "
        "let the feature be 0 there, or take γ below 1"
    )


def _side(gain: Value) -> int | None:
    """The sign of what a step earns on average, if it has one."""
    try:
        return sign(gain)
    except NotReal:
        return None


def _short(value: Value) -> str:
    text = str(to_sympy(value)) if parameters(value) or digits(value) <= _DIGITS else f"about {decimal(value, 4)}"
    return text.replace("-", "−")
