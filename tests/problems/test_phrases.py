"""The sentences that several families share, with a number, with a parameter left open, and where nothing is said."""

import pytest

import rldrill
from rldrill.problems import phrases
from rldrill.problems.document import Paragraph
from rldrill.problems.exact import Parameter, Scalar
from rldrill.problems.family import Givens
from rldrill.problems.fractions import Fraction

HALF = Fraction(1, 2)


class Given(Givens):
    gamma: Scalar = HALF
    alpha: Scalar = HALF


@pytest.mark.parametrize(
    ("said", "number", "sentence"),
    [
        (phrases.discount, HALF, "The discount is $γ = 1/2$."),
        (phrases.discount, Parameter("gamma"), "The discount $γ$ is left open."),
        (phrases.step_size, HALF, "The step size is $α = 1/2$."),
        (phrases.step_size, Parameter("alpha"), "The step size $α$ is left open."),
        (phrases.trace_parameter, HALF, "The parameter is $λ = 1/2$."),
        (phrases.trace_parameter, Parameter("lambda"), "The parameter $λ$ is left open."),
        (phrases.exploration, HALF, "The exploration rate is $ε = 1/2$."),
        (phrases.exploration, Parameter("epsilon"), "The exploration rate $ε$, between $0$ and $1$, is left open."),
        (phrases.exploration, None, "The exploration rate $ε$, between $0$ and $1$, is left open."),
    ],
)
def test_a_number_is_given_or_left_open(said: object, number: object, sentence: str) -> None:
    assert callable(said)
    assert said(number) == sentence


def test_every_step_may_have_a_discount_of_its_own() -> None:
    assert phrases.discount((HALF, Fraction(1))).startswith(
        "Every step has its own discount, $γ_{1} = 1/2, γ_{2} = 1$: what comes after"
    )


def test_an_answer_is_an_expression_in_what_is_left_open() -> None:
    assert phrases.in_open(Given()) == ""
    assert phrases.in_open(Given(gamma=Parameter("gamma"))) == ", in terms of $γ$"


def test_one_parameter_may_be_left_open_and_no_more() -> None:
    phrases.check_one_open(Given())
    phrases.check_one_open(Given(gamma=Parameter("gamma")))
    with pytest.raises(ValueError, match="gamma and alpha are left open; give a number for all but one"):
        phrases.check_one_open(Given(gamma=Parameter("gamma"), alpha=Parameter("alpha")))


def test_where_an_episode_ends() -> None:
    assert phrases.terminal_note(()) == ()
    assert phrases.terminal_note(("over",)) == (
        Paragraph("An episode ends in the terminal state over, whose value is $0$."),
    )
    assert phrases.terminal_note(("over", "out")) == (
        Paragraph("Episodes end in over and out, terminal states, whose values are $0$."),
    )


def test_states_are_told_apart_only_where_there_are_several() -> None:
    rows = {"left": [1, 0], "right": [0, 1]}
    given = {"theta": ["w", 1], "at": 2, "features": {"hall": rows}}
    one = rldrill.read({"family": "linear-policy", "given": given})
    two = rldrill.read({"family": "linear-policy", "given": given | {"features": {"hall": rows, "door": rows}}})
    assert one.parts[0].ask == "For which $w$ do both actions have the same value?"
    assert two.parts[0].ask == "For which weight $w(s)$ do both actions have the same value in the state $s$?"
