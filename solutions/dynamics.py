"""Dynamics of problems as expressions: their derivatives, worked out once for every robot, then put into."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cache, lru_cache

import sympy
from sympy import Expr

from rldrill.problems.angles import Angle
from rldrill.problems.expressions import worked_out, written_letter
from rldrill.problems.mathematics import Fraction, row, variable
from rldrill.problems.robots import System
from rldrill.solutions.exact import NoSolution, Value, exact, to_sympy
from rldrill.solutions.formula.notation import letter
from rldrill.solutions.numerics import Array, np
from rldrill.solutions.oracle import at

_FUNCTIONS = {"sin": sympy.sin, "cos": sympy.cos, "tan": sympy.tan, "sqrt": sympy.sqrt, "exp": sympy.exp}
_NUMERIC = {"sin": np.sin, "cos": np.cos, "tan": np.tan, "sqrt": np.sqrt, "exp": np.exp}
#: The texts of expressions by their letters, in a form that can be remembered.
Texts = tuple[tuple[str, str], ...]


def code(name: str) -> str:
    """What a robot's letter is called among the letters of formulas, which have an i, a j and a t of their own."""
    return f"own_{name}"


@cache
def symbol(name: str) -> sympy.Symbol:
    """The letter of a robot as a letter of formulas."""
    return letter(code(name), written_letter(name))


class _Symbols(dict[str, Expr]):
    def __missing__(self, name: str) -> Expr:
        return symbol(name)


@lru_cache(maxsize=256)
def expressions(texts: Texts, where: Texts = (), *, evaluate: bool = True) -> tuple[Expr, ...]:
    """Texts as sympy expressions, what ``where`` names put in; unevaluated, they keep their order."""
    with sympy.evaluate(evaluate):
        symbols = _Symbols()
        for name, text in where:
            symbols[name] = _expression(text, symbols)
        return tuple(_expression(text, symbols) for _, text in texts)


def _expression(text: str, symbols: Mapping[str, Expr]) -> Expr:
    worked = worked_out(text, symbols, _FUNCTIONS, lambda n: sympy.Rational(n.numerator, n.denominator))
    return sympy.sympify(worked, strict=True)  # strict: a text would be executed


@lru_cache(maxsize=4096)
def chained(text: str, by: str, parts: tuple[str, ...]) -> Expr:
    """The derivative of one expression by a letter as one writes it, by the chain rule.

    Args:
        text: the expression.
        by: the letter.
        parts: the named parts in it whose own derivative by this letter is not zero.
    """
    own = _derivative(text, by)
    written = [own] if own != 0 else []
    for part in parts:
        factors = _factors(_derivative(text, part))
        written.append(sympy.Mul(*factors, part_derivative(part, by), evaluate=False))
    if len(written) < 2:
        return written[0] if written else sympy.S.Zero
    return sympy.Add(*written, evaluate=False)


def _derivative(text: str, by: str) -> Expr:
    """The derivative of an expression by one of its letters; a denominator without it stays as it is."""
    (expression,) = expressions((("", text),))
    (written,) = expressions((("", text),), evaluate=False)
    below = [each for each in sympy.Mul.make_args(written) if each.is_Pow and each.exp == -1]
    if len(below) == 1 and not below[0].has(symbol(by)):
        above = readable(sympy.diff(expression * below[0].base, symbol(by)), text)
        if above != 0 and not any(each.is_Pow and each.exp == -1 for each in sympy.Mul.make_args(above)):
            divisor = sympy.Pow(readable(below[0].base, text), -1, evaluate=False)
            return divisor if above == 1 else sympy.Mul(*sympy.Mul.make_args(above), divisor, evaluate=False)
    return readable(sympy.diff(expression, symbol(by)), text)


def _factors(expression: Expr) -> tuple[Expr, ...]:
    if expression == 1:
        return ()
    return expression.args if expression.is_Mul else (expression,)


@lru_cache(maxsize=4096)
def second(text: str, first: str, then: str) -> Expr:
    """The second derivative of an expression by two letters, as one writes it."""
    (expression,) = expressions((("", text),))
    return readable(sympy.diff(expression, symbol(first), symbol(then)), text)


@cache
def part_derivative(part: str, by: str) -> sympy.Symbol:
    """The derivative of a named part by a letter, as a letter of its own."""
    above, below = (row(variable("∂"), written_letter(name)) for name in (part, by))
    return letter(f"own_{part}_by_{by}", Fraction(above, below))


@lru_cache(maxsize=4096)
def readable(expression: Expr, like: str) -> Expr:
    """The same expression unevaluated: quotients as quotients, numbers and letters before functions and sums.

    Args:
        expression: the expression, as sympy has it.
        like: the text that it comes from, whose order its letters keep.
    """
    if expression.is_Add:
        terms = sorted(expression.args, key=lambda term: (_negative(term), _places(term, like)))
        return sympy.Add(*[readable(term, like) for term in terms], evaluate=False)
    if expression.is_Mul or (expression.is_Pow and expression.exp.is_negative):
        above, below = sympy.fraction(expression)
        if below != 1:
            quotient = sympy.Pow(readable(below, like), -1, evaluate=False)
            first = _product(above, like)
            return quotient if first == [sympy.S.One] else sympy.Mul(*first, quotient, evaluate=False)
        return sympy.Mul(*_product(above, like), evaluate=False)
    if expression.is_Pow:
        return sympy.Pow(readable(expression.base, like), expression.exp, evaluate=False)
    if expression.is_Function:
        return expression.func(*[readable(each, like) for each in expression.args], evaluate=False)
    return expression


def _product(expression: Expr, like: str) -> list[Expr]:
    number, rest = sympy.S.One, []
    for each in sympy.Mul.make_args(expression):
        content, primitive = each.primitive() if each.is_Add else (each, None) if each.is_Number else (1, each)
        number *= content
        rest += [] if primitive is None else [readable(primitive, like)]
    factors = [*([number] if number != 1 or not rest else []), *rest]
    return sorted(
        factors,
        key=lambda factor: (
            not factor.is_Number,
            not _is_plain(factor),
            factor.is_Add,
            factor.has(sympy.Function),
            _places(factor, like),
        ),
    )


def _is_plain(factor: Expr) -> bool:
    """Whether it is a letter, or a whole power of one."""
    return bool(factor.is_Symbol or (factor.is_Pow and factor.base.is_Symbol and factor.exp.is_Integer))


def _negative(expression: Expr) -> bool:
    return bool(expression.could_extract_minus_sign())


def _places(expression: Expr, like: str) -> list[int]:
    """Where the letters of an expression come first in a text."""
    order = _order(like)
    return sorted(order.get(letter_, len(like)) for letter_ in expression.free_symbols)


@lru_cache(maxsize=256)
def _order(text: str) -> dict[sympy.Symbol, int]:
    (expression,) = expressions((("", text),), evaluate=False)
    found = [node for node in sympy.preorder_traversal(expression) if node.is_Symbol]
    return {node: place for place, node in reversed(list(enumerate(found)))}


@lru_cache(maxsize=1024)
def exchanged(expression: Expr) -> Expr:
    """Sines for cosines and the other way round."""
    if not expression.args:
        return expression
    arguments = [exchanged(argument) for argument in expression.args]
    kind = {sympy.sin: sympy.cos, sympy.cos: sympy.sin}.get(expression.func, expression.func)
    return kind(*arguments, evaluate=False)


@lru_cache(maxsize=1024)
def whole_roots(expression: Expr, by: str) -> Expr:
    """The derivatives of roots of a letter without their factor 1/2."""
    if not expression.args:
        return expression
    arguments = [whole_roots(argument, by) for argument in expression.args]
    roots = (each.base for each in arguments if each.is_Pow and each.exp == sympy.S.Half)
    if expression.is_Mul and any(root.has(symbol(by)) for root in roots):
        arguments = [each for each in arguments if each != 2]
    return expression.func(*arguments, evaluate=False)


@lru_cache(maxsize=1024)
def plain_cosines(expression: Expr) -> Expr:
    """The derivatives of tangents with the cosine for its square: 1/cos φ for 1 + tan² φ."""
    if not expression.args:
        return expression
    tangents = {each for each in expression.args if each.has(sympy.tan)} if expression.is_Add else set()
    if len(tangents) == 1 and len(expression.args) == 2:
        factor, square = tangents.pop().as_coeff_Mul()
        if factor in expression.args and square.is_Pow and square.exp == 2 and isinstance(square.base, sympy.tan):
            return factor / sympy.cos(*square.base.args, evaluate=False)
    return expression.func(*map(plain_cosines, expression.args), evaluate=False)


def texts(mapping: Mapping[str, str]) -> Texts:
    """A mapping of texts in a form that can be remembered."""
    return tuple(mapping.items())


@lru_cache(maxsize=256)
def angle(value: Angle) -> Value:
    """An angle as an exact value."""
    number = exact(value.number)
    return to_sympy(number) * sympy.pi if value.of_pi else number


def known(given: System) -> dict[str, Value]:
    """The values of all letters at the operating point, by their codes."""
    return {
        **{code(name): exact(value) for name, value in given.constants.items()},
        **{code(name): angle(value) for name, value in (*given.state.items(), *given.action.items())},
    }


@contextmanager
def at_operating_point() -> Iterator[None]:
    """Say of what cannot be worked out that it is the operating point at which it does not exist."""
    try:
        yield
    except (NoSolution, ZeroDivisionError):
        raise NoSolution(
            "the dynamics or their derivatives do not exist at the operating point, where they divide by zero or take "
            "a root of a negative number; change 'state', 'action' or 'constants'"
        ) from None


# For the independent solvers -------------------------------------------------------------------------
def radians(value: Angle) -> float:
    """An angle in floating point."""
    return at(value.number) * (np.pi if value.of_pi else 1.0)


def numbers(given: System) -> dict[str, complex]:
    """The values of all letters in floating point."""
    return {
        **{name: complex(at(value)) for name, value in given.constants.items()},
        **{name: complex(radians(value)) for name, value in (*given.state.items(), *given.action.items())},
    }


def numeric(of: Texts, where: Texts, values: Mapping[str, complex]) -> list[complex]:
    """What expressions are worth, in complex floating point."""
    values = dict(values)
    for name, text in where:
        values[name] = worked_out(text, values, _NUMERIC, complex)
    return [complex(worked_out(text, values, _NUMERIC, complex)) for _, text in of]


_TINY = 1e-30


def complex_step(
    function: Callable[[Mapping[str, complex]], Sequence[complex]], values: Mapping[str, complex], by: Sequence[str]
) -> Array:
    """The Jacobian of a function by some letters: the imaginary part of a step in the imaginary direction."""
    columns = [[value.imag / _TINY for value in function({**values, name: values[name] + 1j * _TINY})] for name in by]
    return np.array(columns).T
