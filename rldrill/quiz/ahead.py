"""The next problem, drawn while the person reads what was said of the last one."""

from collections.abc import Iterator
from threading import Thread

from rldrill.background import in_background
from rldrill.exercise import Exercise


class Ahead:
    """Exercises one by one; after ``begin`` the next one is drawn in a thread, and then it is there at once."""

    def __init__(self, exercises: Iterator[Exercise]) -> None:
        self._exercises = exercises
        self._thread: Thread | None = None
        self._drawn: Exercise | None = None
        self._error: BaseException | None = None

    def begin(self) -> None:
        """Draw the next one; nothing happens if that has begun."""
        if self._thread is None:
            self._thread = in_background(self._draw)

    def __iter__(self) -> Iterator[Exercise]:
        return self

    def __next__(self) -> Exercise:
        self.begin()
        assert self._thread is not None
        self._thread.join()
        self._thread = None
        error, drawn = self._error, self._drawn
        self._error = self._drawn = None
        if error is not None:
            raise error
        if drawn is None:
            raise StopIteration
        return drawn

    def _draw(self) -> None:
        try:
            self._drawn = next(self._exercises, None)
            if self._drawn is not None:
                _ = self._drawn.parts  # what its parts are worth is worked out, too
        except BaseException as error:  # it is raised where the exercise is asked for
            self._error = error
