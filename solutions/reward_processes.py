"""Formulas as they are for a Markov reward process: without actions, and without a policy to choose them."""

from functools import cache
from typing import Any

from msgspec.structs import replace
from sympy import Expr, Mul, evaluate

from rldrill.problems.mathematics import Math, Script, mathematics, variable
from rldrill.problems.models import Model
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.formula.notation import (
    MaxOver,
    MeanOver,
    P,
    Quantity,
    R,
    SumOver,
    V,
    Vpi,
    a,
    beside,
    letter,
    pi,
    quantity,
)
from rldrill.solutions.sheet.bellman import average


def _without_action(of: type[Quantity]) -> type[Quantity]:
    """P or R of a transition: the one action is looked up, but not written."""

    def layout(here: Math, _: Math, after: Math) -> Math:
        return Script(variable(of.code), beside(here, after))

    return quantity(of.code, layout)


#: The average reward per step: r̄ where there is no policy, for r(π).
_AVERAGE = letter("average_alone", mathematics("r̄"))
_PLAIN: dict[type[Expr], type[Quantity]] = {P: _without_action(P), R: _without_action(R), Vpi: V}


def fitting(formula: Formula, mdp: Model) -> tuple[Formula, dict[str, Any]]:
    """A formula of policies in the form that fits a model, and the letters that it needs beside the model's own."""
    if mdp.chooses:
        return formula, {}
    (action,) = {action for actions in mdp.actions.values() for action in actions}
    return without_actions(formula), {"a": action}


@cache
def without_actions(formula: Formula) -> Formula:
    """A formula without its sum over actions, and with V for V^π; mistakes that are about actions are not made."""
    with evaluate(False):
        right = _read(formula.right)
        misread = {mistake: _read(wrong) for mistake, wrong in formula.misread.items()}
        return replace(
            formula,
            left=_read(formula.left),
            right=right,
            misread={mistake: wrong for mistake, wrong in misread.items() if wrong != right},
        )


def _read(expression: Expr) -> Expr:
    if isinstance(expression, SumOver | MaxOver | MeanOver) and expression.index == a:
        factors = [factor for factor in Mul.make_args(expression.body) if not isinstance(factor, pi)]
        return _read(Mul(*factors) if len(factors) > 1 else factors[0])
    if not expression.args:
        return _AVERAGE if expression == average else expression
    kind = _PLAIN.get(type(expression), expression.func)
    return kind(*map(_read, expression.args))
