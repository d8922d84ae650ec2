"""What is worked out first, on a line of its own: a choice within a sum, and brackets within brackets."""

from collections.abc import Iterator

import sympy
from sympy import Add, Expr, Mul, Pow

from rldrill.solutions.formula.node import Node
from rldrill.solutions.formula.nodes.choices import Choice
from rldrill.solutions.formula.nodes.leaves import Leaf, computed
from rldrill.solutions.formula.nodes.sets import MaxOf
from rldrill.solutions.formula.putting_in import evaluated, numbers_first, reduced

#: So many products and powers in a bracket are not worked out in the same line as brackets in them.
_SEVERAL = 2


def choices_first(expression: Expr) -> Expr:
    """The step with the greatest of the numbers that a maximum in it has to choose from, and so on.

    A choice that is the whole step is worked out in the step's own lines.
    """
    if isinstance(expression, Node) or not expression.has(Choice):
        return expression
    arguments = [
        _chosen(argument) if isinstance(argument, Choice) else choices_first(argument) for argument in expression.args
    ]
    if expression.is_Mul:
        return numbers_first(Mul._from_args(arguments))
    return Add._from_args(arguments) if expression.is_Add else expression


def _chosen(choice: Expr) -> Expr:
    value = evaluated(choice)
    return computed(value) if value.is_Rational and all(map(_is_plain, choice.args)) else choice


def _is_plain(value: Expr) -> bool:
    return isinstance(value, Leaf) or not value.args


def inner_brackets_first(expression: Expr) -> Iterator[Expr]:
    """The step with the brackets inside its brackets worked out, where there is such a line to write."""
    line = _inside(expression)
    if line != expression:
        yield line


def _inside(expression: Expr) -> Expr:
    if isinstance(expression, Choice):
        return expression.func(*(reduced(value) if isinstance(value, MaxOf) else value for value in expression.args))
    if isinstance(expression, Node) or not expression.args:
        return expression
    if expression.is_Add:
        return Add._from_args([_inside(term) for term in expression.args])
    return Mul._from_args(list(map(_outer, expression.args))) if expression.is_Mul else _outer(expression)


def _outer(factor: Expr) -> Expr:
    """A bracket, or one below a line or under a root, with the brackets in it worked out where there are several."""
    if factor.is_Pow:
        return Pow(_outer(factor.args[0]), factor.args[1], evaluate=False)
    if not factor.is_Add or not any(map(_holds_bracket, factor.args)):
        return factor
    if sum(map(_is_work, factor.args)) < _SEVERAL and not any(map(_holds_root, factor.args)):
        return factor
    return Add._from_args([_worked_out(term) for term in factor.args])


def _holds_root(term: Expr) -> bool:
    return any(factor.is_Pow and factor.args[1] == sympy.S.Half for factor in Mul.make_args(term))


def _is_work(term: Expr) -> bool:
    """Whether it is a product or a power, or holds a bracket."""
    return term.is_Pow or len([factor for factor in Mul.make_args(term) if factor != -1]) > 1 or _holds_bracket(term)


def _holds_bracket(term: Expr) -> bool:
    return any(map(_is_bracket, Mul.make_args(term)))


def _is_bracket(factor: Expr) -> bool:
    """Whether it is a sum of rational numbers, or a power of one."""
    body = factor.args[0] if factor.is_Pow else factor
    return body.is_Add and not isinstance(body, Node) and not body.free_symbols and bool(evaluated(body).is_Rational)


def _worked_out(term: Expr) -> Expr:
    return Mul._from_args([_number(factor) if _is_bracket(factor) else factor for factor in Mul.make_args(term)])


def _number(factor: Expr) -> Expr:
    if factor.is_Pow:
        return Pow(computed(evaluated(factor.args[0])), factor.args[1], evaluate=False)
    return computed(evaluated(factor))
