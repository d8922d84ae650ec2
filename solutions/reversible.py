"""The value of a letter from what comes out: exactly from an equation, independently from trials."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

from rldrill.problems.exact import Parameter, Scalar, needed, shown
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.reversible import Reversible
from rldrill.problems.runs import ValueRun
from rldrill.solutions.exact import ONE, NoSolution, Value, equals, exact, parameters, to_sympy, value_at
from rldrill.solutions.formula.nodes.leaves import put_in_name
from rldrill.solutions.formula.notation import V
from rldrill.solutions.found import found_line
from rldrill.solutions.oracle import at, root_between
from rldrill.solutions.work import Work

Given = TypeVar("Given", bound=Reversible)
Run = TypeVar("Run", bound=ValueRun)


def find(given: Reversible, work: Work, value: Value, named: str) -> Value:
    """Answer with the number for the letter that makes the value, worked out with the letter in it, what is known.

    Args:
        given: the problem.
        work: where the steps are written.
        value: what comes out, an expression in the letter.
        named: how that is called, as mathematics.

    Raises:
        NoSolution: the value does not depend on the letter.
    """
    if not given.letters:
        raise NoSolution("what is known says nothing of the letter that is asked for; change what is left open")
    if given.letter not in parameters(value):
        what = f"{named} {equals(value)}".replace('"', "")
        raise NoSolution(f"{what}, whatever {given.letter} is, and this is what is known; change what is given")
    work.say(f"${named}$ must be ${shown(needed(given.known))}$:")
    return work.answer(work.equate(given.letter, value, exact(needed(given.known))))


def tried(given: Given, outcome: Callable[[Given], float]) -> float:
    """The number for the letter, where a line through the outcomes of trials reaches what is known."""
    return root_between(lambda trial: outcome(with_letter(given, Fraction(trial))) - at(needed(given.known)))


def reading(letter: Value) -> Callable[[Scalar], Value]:
    """What reads given numbers where the letter left open has this value."""
    return lambda number: (
        exact(number) if not isinstance(number, Parameter) else ONE - letter if number.complement else letter
    )


def with_letter(given: Given, number: Fraction) -> Given:
    """The problem with a number for its letter, and nothing known of what comes out."""
    data = given.model_dump(mode="json", exclude_none=True, exclude={"known"})
    return type(given).model_validate(_replaced(data, given.letter, str(number)))


def _replaced(data: Any, letter: str, number: str) -> Any:
    if isinstance(data, dict):
        return {key: _replaced(inner, letter, number) for key, inner in data.items()}
    if isinstance(data, list):
        return [_replaced(inner, letter, number) for inner in data]
    if data == f"1-{letter}":
        return str(1 - fraction_of(number))
    return number if data == letter else data


def find_and_finish(given: ValueRun, work: Work, after: Mapping[str, Value]) -> None:
    """Answer with the letter, from the value that is known ``after`` all updates, and with the other values."""
    first, *others = given.updated
    letter = find(given, work, after[first], f'V("{first}")')
    if others:
        sign = shown(Parameter(given.letter))
        found = {state: value_at(after[state], letter) for state in others}
        if any(parameters(after[state]) for state in others):
            work.say(f"With ${sign} = {to_sympy(letter)}$ in what was found above:")
        else:
            work.say(f"It does not depend on ${sign}$, and was found above:")
        work.lines += [found_line(V(put_in_name(state)), given.letter, after[state], letter) for state in others]
        work.answer(found)


def found_and_finished(given: Run, updated: Callable[[Run], Sequence[float]]) -> Sequence[Any]:
    """The same in floating point; ``updated`` gives the values of the updated states."""
    letter = tried(given, lambda trial: updated(trial)[0])
    others = updated(with_letter(given, Fraction(letter).limit_denominator(10**6)))[1:]
    return (letter, others) if len(others) else (letter,)
