"""The action values after Expected Sarsa updates along a run, for a given or an ε-greedy policy."""

from fractions import Fraction
from typing import Annotated, Self

from pydantic import Discriminator, Field, Tag, model_validator

from rldrill.problems.document import Block, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import OpenProbability, Parameter
from rldrill.problems.family import Question
from rldrill.problems.models import PolicyField, check_chances, check_keys, policy_table
from rldrill.problems.parts import Part, Values
from rldrill.problems.phrases import exploration, in_open
from rldrill.problems.runs import ActionRun, action_values_table, draw_action_run, run_blocks

TITLE = "Expected Sarsa"
SOURCE = "Sutton & Barto 2018, section 6.6"
REVISION = 1


class FixedPolicy(ActionRun):
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


class EpsilonGreedy(ActionRun):
    """A run, the action values before it, α and γ; and the ε with which the policy chooses ε-greedily."""

    epsilon: OpenProbability = Field(
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
    """One transition and a given policy; then two that are ε-greedy; then three to the end, with ε left open."""
    visits = {1: "ab", 2: "aba", 3: "abc."}[level]
    trajectory, values = draw_action_run(rng, visits, 2 if level == 1 else 3)
    half = Fraction(1, 2)
    if level == 1:
        after = trajectory.states[1]
        chance = rng.fraction("1/4", "3/4", "2/5", "3/5")
        policy = {after: dict(zip(values[after], (chance, 1 - chance), strict=True))}
        return FixedPolicy(trajectory=trajectory, values=values, alpha=half, gamma=half, policy=policy)
    return EpsilonGreedy(
        trajectory=trajectory,
        values=values,
        epsilon=rng.fraction("3/10", "3/5") if level == 2 else Parameter("epsilon"),
        alpha=rng.fraction("1/2", "1/4") if level == 3 else half,
        gamma={2: rng.fraction("1/2", "4/5"), 3: rng.fraction("1/2", "9/10")}[level],
    )


def question(given: Given) -> Question:
    """The run, the table before it and the policy; all updated pairs are asked for."""
    pairs = given.updated
    asked = f'$Q("{pairs[0][0]}", "{pairs[0][1]}")$' if len(pairs) == 1 else "the value of every pair that is updated"
    return Question(
        (*run_blocks(given, action_values_table(given.values), "Expected Sarsa"), *_policy(given)),
        (Part(f"What is {asked} after the run{in_open(given)}?", Values("Q", pairs)),),
    )


def _policy(given: Given) -> tuple[Block, ...]:
    match given:
        case FixedPolicy():
            return (Paragraph("The policy is the same all the time:"), policy_table(given.policy))
        case EpsilonGreedy():
            return (
                Paragraph(
                    "The policy is ε-greedy for the values that are current at each update. "
                    f"{exploration(given.epsilon)} Exploring picks any of all actions with the same probability; tied "
                    "best actions share the greedy probability evenly."
                ),
            )
