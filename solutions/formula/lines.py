"""What is written between the numbers that are put in and the result: one thing at a time."""

from collections.abc import Iterator

from sympy import Expr

from rldrill.solutions.formula.collecting import collected_next, is_quotient
from rldrill.solutions.formula.common_denominator import brackets_in_one_fraction, in_one_fraction
from rldrill.solutions.formula.inverting import inverted
from rldrill.solutions.formula.multiplying import entry_by_entry, multiplied_out
from rldrill.solutions.formula.nested import choices_first, inner_brackets_first
from rldrill.solutions.formula.putting_in import (
    ANGULAR,
    long_sum,
    reduced,
    term_by_term,
    with_vanishing_sines,
    without_slots,
)


def lines_between(put_in: Expr, *, own: bool) -> Iterator[Expr]:
    """The lines of a step in their order; some may be the same as one before.

    Args:
        put_in: the right side with its numbers put in.
        own: whether it is the problem's own, a derivative of its dynamics, of which every term is worked out.
    """
    sines = with_vanishing_sines(put_in)
    if sines is not None:
        yield sines
    bare = without_slots(put_in)
    plain = choices_first(bare)
    short = term_by_term(reduced(put_in)) if own else reduced(put_in)
    without_inverse = inverted(short)
    products = list(multiplied_out(without_inverse))
    collected = collected_next(plain if is_quotient(plain) else short)
    if plain != bare:
        yield plain
    if not products:
        yield from inner_brackets_first(plain)
        yield from multiplied_out(plain)
        if collected is not None and is_quotient(plain):
            yield collected
    yield short
    yield without_inverse
    yield from products
    if put_in.has(*ANGULAR):
        yield reduced(short)
    added = (
        brackets_in_one_fraction(short),
        in_one_fraction(short),
        long_sum(short),
        None if is_quotient(plain) else collected,
        entry_by_entry(short),
    )
    yield from (line for line in added if line is not None and line != short)
