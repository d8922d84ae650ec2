"""Sentences that many questions share."""

from rldrill.problems.document import Paragraph, joined
from rldrill.problems.exact import Parameter, Scalar, shown
from rldrill.problems.family import Givens


def discount(gamma: Scalar) -> str:
    """The sentence that gives the discount."""
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


def in_open(given: Givens) -> str:
    """What is added to a question whose answer is an expression in what is left open."""
    left_open = given.parameters()
    return f", as an expression in ${shown(Parameter(left_open[0]))}$" if left_open else ""


def terminal_note(terminal: tuple[str, ...]) -> tuple[Paragraph, ...]:
    """The sentence that says where an episode ends, and what that is worth."""
    if not terminal:
        return ()
    if len(terminal) == 1:
        return (Paragraph(f"An episode ends in {terminal[0]}, a terminal state, whose value is $0$."),)
    return (Paragraph(f"Episodes end in {joined(list(terminal))}, terminal states, whose values are $0$."),)
