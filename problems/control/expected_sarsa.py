"""The action values after Expected Sarsa updates along a run, for a given or an ε-greedy policy."""

from typing import Annotated, Any, Self

from pydantic import Discriminator, Field, Tag, model_validator

from rldrill.problems.asking_back import BackRun, Worth, draw_back, draw_forward, pairs_asked, updates_of
from rldrill.problems.document import Block, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import OpenShare, Parameter, dot
from rldrill.problems.family import Question
from rldrill.problems.fractions import Fraction
from rldrill.problems.models import PolicyField, check_chances, check_keys, policy_table
from rldrill.problems.phrases import exploration, not_known
from rldrill.problems.runs import action_values_table, run_blocks
from rldrill.problems.settings import draw_setting

TITLE = "Expected Sarsa"
SOURCE = "Sutton & Barto 2018, section 6.6"
REVISION = 7

#: The largest number above a line or below it in an update with numbers.
_LARGEST = 300
DISTRACTORS = (
    "values.*",  # a table has the values of other pairs, too
    "trajectory.actions.*",  # the last action is Sarsa's business
)


class FixedPolicy(BackRun):
    """A run, the action values before it, α and γ; and the policy, which stays as it is."""

    policy: PolicyField = Field(description="The policy, which stays as it is; instead of epsilon.")

    @model_validator(mode="after")
    def _chances(self) -> Self:
        check_keys(self.policy, tuple(self.values), "the policy", needed=self.entered)
        for state, chances in self.policy.items():
            check_chances(chances, state, tuple(self.values[state]))
        return self

    @property
    def entered(self) -> tuple[str, ...]:
        """The states that are entered and do not end the run: the policy is needed there."""
        run = self.trajectory
        return tuple(dict.fromkeys(state for state in run.states[1:] if state not in run.terminal))


class EpsilonGreedy(BackRun):
    """A run, the action values before it, α and γ; and the ε with which the policy chooses ε-greedily."""

    epsilon: OpenShare = Field(
        description="The probability with which the ε-greedy policy explores; instead of policy."
    )


def _kind(given: object) -> str | None:
    match given:
        case {"policy": _, "epsilon": _}:
            return None
        case {"policy": _}:
            return "policy"
        case {"epsilon": _}:
            return "epsilon"
        case {}:
            return None
    return "policy"  # no table at all, as its model will say


Given = Annotated[
    Annotated[FixedPolicy, Tag("policy")] | Annotated[EpsilonGreedy, Tag("epsilon")],
    Discriminator(_kind, custom_error_type="kind", custom_error_message="give either policy or epsilon"),
]


def draw(level: int, rng: Draws) -> Given:
    """One transition and a given policy; then two, ε-greedy too; then ε left open, or one back from its outcome."""
    if level == 3 and rng.chance(Fraction(3, 4)):
        return _back(rng)
    if level == 1 or (level == 2 and rng.chance(Fraction(1, 2))):
        chances = rng.split(level + 1, (4, 5))
        visits = "ab" if level == 1 else rng.choice(("aba", "abc", "abb"))
        found = _legible(rng, visits, level + 1, lambda row, _: dot(chances, row.values()))
        policy = {state: dict(zip(row, chances, strict=True)) for state, row in found["values"].items()}
        entered = found["trajectory"].states[1:]
        return FixedPolicy(policy={state: row for state, row in policy.items() if state in entered}, **found)
    visits = rng.choice(("aba", "abc", "abb") if level == 2 else ("ab", "abc", "abc."))
    epsilon = _drawn_epsilon(rng)
    found = _legible(rng, visits, 3, _greedily(epsilon))
    while level == 2 and not all(sum(row.values()) - max(row.values()) for row in found["values"].values()):
        found = _legible(rng, visits, 3, _greedily(epsilon))  # what exploring earns must not cancel
    return EpsilonGreedy(epsilon=epsilon if level == 2 else Parameter("epsilon"), **found)


def _legible(rng: Draws, visits: str, count: int, worth: Worth) -> dict[str, Any]:
    """A run whose numbers are small also on the way to every update."""
    while True:
        found = draw_forward(rng, visits, count, worth)
        numbers = [number for ahead, gap, _ in updates_of(found, worth) for number in (ahead, gap)]
        if all(max(abs(number.numerator), number.denominator) <= _LARGEST for number in numbers):
            return found


def _back(rng: Draws) -> Given:
    """A value from which ε, α or γ of an ε-greedy policy's update follows."""
    sought, epsilon = rng.choice(("epsilon", "epsilon", "alpha", "gamma")), _drawn_epsilon(rng)
    found = draw_back(rng, draw_setting(rng), 3, _greedily(epsilon), sought)
    if epsilon in (found["alpha"], found["gamma"]):
        return _back(rng)
    return EpsilonGreedy(**{"epsilon": epsilon} | found)


def _drawn_epsilon(rng: Draws) -> Fraction:
    return rng.fraction("3/5", "3/8", "3/10")


def _greedily(epsilon: Fraction) -> Worth:
    """What a state is worth to an ε-greedy policy."""
    return lambda row, _: (1 - epsilon) * max(row.values()) + epsilon * sum(row.values()) / len(row)


def question(given: Given) -> Question:
    """The run, the table before it and the policy; all updated pairs are asked for."""
    blocks = (*run_blocks(given, action_values_table(given.values), "Expected Sarsa"), *_policy(given))
    return Question(blocks, pairs_asked(given))


def _policy(given: Given) -> tuple[Block, ...]:
    match given:
        case FixedPolicy():
            return (Paragraph("The policy does not change:"), policy_table(given.policy))
        case EpsilonGreedy():
            rate = not_known(exploration(given.epsilon)) if given.asks_back else exploration(given.epsilon)
            tied = "; tied best actions share the greedy probability evenly" if _ties(given) else ""
            values = "the values that are current at each update" if _reads_again(given) else "these values"
            return (
                Paragraph(
                    f"The policy is ε-greedy for {values}. {rate} Exploration takes "
                    f"every action with the same probability{tied}."
                ),
            )


def _reads_again(given: EpsilonGreedy) -> bool:
    """Whether a state is entered whose action values were updated before."""
    return any(move.next in {earlier.state for earlier in given.moves[:time]} for time, move in enumerate(given.moves))


def _ties(given: EpsilonGreedy) -> bool:
    """Whether several actions are best in a state that is entered, or may be: as far as it can be told."""
    rates = given.alpha, given.gamma, given.epsilon
    values: dict[str, dict[str, Fraction]] = {state: {**row} for state, row in given.values.items()}
    moved: set[str] = set()
    for state, action, entered, reward, _ in given.moves:
        ahead = Fraction(0)
        if entered not in given.terminal:
            row = values[entered]
            if entered in moved or [*row.values()].count(max(row.values())) > 1:
                return True
            ahead = Fraction(0) if isinstance(given.epsilon, Parameter) else _greedily(given.epsilon)(row, "")
        if any(isinstance(rate, Parameter) for rate in rates):
            moved.add(state)  # to what, is not known
        else:
            gap = reward + Fraction(given.gamma) * ahead - values[state][action]
            values[state][action] += Fraction(given.alpha) * gap
    return False
