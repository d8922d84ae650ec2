"""How long there is to search."""

from threading import Event
from time import perf_counter

from msgspec import Struct, field


class Clock(Struct):
    """How long there is to search: some seconds, or until somebody says stop; without either, without end."""

    seconds: float | None = None
    stop: Event | None = None
    _begun: float = field(default_factory=perf_counter)

    @property
    def over(self) -> bool:
        """Whether the time is over."""
        if self.stop is not None and self.stop.is_set():
            return True
        return self.seconds is not None and perf_counter() - self._begun > self.seconds
