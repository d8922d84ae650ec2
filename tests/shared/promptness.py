"""What must not take long, held against what this machine needs for a fixed piece of work at the same moment."""

import gc
import time
from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction

#: What the yardstick takes where nothing else runs, in seconds; a clock that counts in ticks may take it for nothing.
_QUIET = 0.005


def _yardstick() -> float:
    """The processor time of a fixed piece of work, in seconds."""
    begun = time.process_time()
    sum(Fraction(1, 1 + number % 97) for number in range(1600))
    return time.process_time() - begun


@contextmanager
def at_once(what: object = "", *, yardsticks: float = 200) -> Iterator[None]:
    """Assert that what is done within takes no more processor time than so many yardsticks, a second or so.

    The collector of garbage rests meanwhile: among the objects of ten thousand tests one round of it takes longer.
    """
    gc.disable()
    try:
        pace = _yardstick()
        begun = time.process_time()
        yield
        taken = time.process_time() - begun
        pace = max(pace, _yardstick(), _QUIET)
    finally:
        gc.enable()
    assert taken < yardsticks * pace, f"{what} {taken:.2f} s, where a yardstick takes {pace:.4f} s"
