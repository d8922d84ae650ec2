"""Sentences that many questions share."""

from rldrill.problems.document import Paragraph, joined
from rldrill.problems.exact import Parameter, Scalar, shown
from rldrill.problems.family import Givens

#: With which reward the return from a time begins.
RETURN_DEFINED = "Here $R_t = r_{t+1} + γ r_{t+2} + …$ is the return from time $t$."


def discount(gamma: Scalar | tuple[Scalar, ...]) -> str:
    """The sentence that gives the discount, or that of every step."""
    if isinstance(gamma, tuple):
        every = ", ".join(f"γ_{{{time}}} = {shown(each)}" for time, each in enumerate(gamma, 1))
        return f"Every step has its own discount, ${every}$: what comes after the reward $r_t$ is multiplied by $γ_t$."
    if isinstance(gamma, Parameter):
        return f"The discount ${shown(gamma)}$ is left open."
    return f"The discount is $γ = {shown(gamma)}$."


def step_size(alpha: Scalar) -> str:
    """The sentence that gives the step size."""
    if isinstance(alpha, Parameter):
        return f"The step size ${shown(alpha)}$ is left open."
    return f"The step size is $α = {shown(alpha)}$."


def trace_parameter(lam: Scalar) -> str:
    """The sentence that gives λ."""
    if isinstance(lam, Parameter):
        return f"The parameter ${shown(lam)}$ is left open."
    return f"The parameter is $λ = {shown(lam)}$."


def exploration(epsilon: Scalar | None) -> str:
    """The sentence that gives the exploration rate."""
    if epsilon is None or isinstance(epsilon, Parameter):
        return "The exploration rate $ε$, between $0$ and $1$, is left open."
    return f"The exploration rate is $ε = {shown(epsilon)}$."


def in_open(given: Givens) -> str:
    """What is added to a question whose answer is an expression in what is left open."""
    left_open = [f"${shown(Parameter(letter))}$" for letter in given.parameters()]
    return f", in terms of {joined(left_open)}" if left_open else ""


def unknown(letter: str) -> str:
    """The sentence that says what is not known and will be asked for."""
    sign = f"${shown(Parameter(letter))}$"
    what = {"gamma": f"discount {sign}", "p": f"probability {sign}", "x": f"reward {sign}"}
    return f"The {what.get(letter, f'number {sign}')} is not known."


def not_known(text: str) -> str:
    """A sentence about a letter left open, as it is told where its value is asked for."""
    return text.replace("is left open", "is not known")


def check_one_open(given: Givens) -> None:
    """Demand that one parameter is left open at most.

    Raises:
        ValueError: there are more, named in the sentence.
    """
    left_open = given.parameters()
    if len(left_open) > 1:
        raise ValueError(f"{joined(list(left_open))} are left open; give a number for all but one")


def terminal_note(terminal: tuple[str, ...]) -> tuple[Paragraph, ...]:
    """The sentence that says where an episode ends, and what that is worth."""
    if not terminal:
        return ()
    if len(terminal) == 1:
        return (Paragraph(f"An episode ends in the terminal state {terminal[0]}, whose value is $0$."),)
    return (Paragraph(f"Episodes end in {joined(list(terminal))}, terminal states, whose values are $0$."),)
