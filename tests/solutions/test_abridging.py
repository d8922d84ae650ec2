"""Of a long working the first steps are written, and the last, with how many are left out; of a short one all."""

from flint import fmpq

from rldrill.solutions.abridging import abridged
from rldrill.solutions.sheet.temporal_difference import N_STEP_RETURN, TD_ZERO
from rldrill.solutions.work import Line, Note, Step


def steps(count: int, *, alternating: bool = False) -> list[Step]:
    """Steps of one kind, or of two kinds by turns, numbered by their values."""
    kinds = (TD_ZERO, N_STEP_RETURN)
    chosen = [kinds[number % 2 if alternating else 0] for number in range(count)]
    return [Step(formula, formula.right, {}, fmpq(number), formula.left, "=") for number, formula in enumerate(chosen)]


def told(lines: tuple[Line, ...]) -> list[str]:
    return [line.text for line in lines if isinstance(line, Note)]


def numbers(lines: tuple[Line, ...]) -> list[int]:
    return [int(line.value) for line in lines if isinstance(line, Step)]


def test_a_hundred_steps_in_a_row_are_written_and_no_more() -> None:
    assert abridged(steps(100)) == tuple(steps(100))
    short = abridged(steps(103))
    assert numbers(short) == list(range(100))
    assert told(short) == ["… And so on: 3 more steps in the same way."]
    assert isinstance(short[-1], Note)


def test_two_hundred_and_fifty_steps_of_several_kinds_are_written_and_no_more() -> None:
    assert abridged(steps(250, alternating=True)) == tuple(steps(250, alternating=True))
    short = abridged(steps(253, alternating=True))
    assert numbers(short) == [*range(200), *range(203, 253)]
    assert told(short) == ["… And so on: 3 more steps in the same way."]
    assert isinstance(short[200], Note)


def test_what_introduces_the_last_steps_stays_with_them() -> None:
    many = steps(253, alternating=True)
    introduced = [
        *many[:100],
        Note("early"),
        *many[100:201],
        Note("left out"),
        *many[201:203],
        Note("now"),
        *many[203:],
    ]
    short = abridged(introduced)
    assert told(short) == ["early", "… And so on: 3 more steps in the same way.", "now"]
    assert numbers(short) == [*range(200), *range(203, 253)]
