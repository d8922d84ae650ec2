"""From what happens in a quiz to the attempts of the history."""

import secrets
import time
from collections.abc import Callable
from datetime import UTC, datetime

from rldrill.history.attempts import Attempt
from rldrill.quiz.session import PartRecord, Record, State


def _nowhere(_: Attempt) -> None:
    """Keep nothing."""


def utc_now() -> datetime:
    """The time, in UTC."""
    return datetime.now(UTC)


class Recorder:
    """Makes an attempt of every answer that counts, and of every part that is given up.

    Args:
        keep: where an attempt goes.
        now: the time.
        clock: seconds, for how long things take.
    """

    def __init__(
        self,
        keep: Callable[[Attempt], None] = _nowhere,
        now: Callable[[], datetime] = utc_now,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._keep = keep
        self._now = now
        self._clock = clock
        self._begin = self._since = clock()
        self.attempts: list[Attempt] = []

    @property
    def elapsed(self) -> float:
        """The seconds since the quiz began."""
        return self._clock() - self._begin

    def asked(self) -> None:
        """A part is asked now."""
        self._since = self._clock()

    def ended(self, record: Record, part: PartRecord) -> None:
        """Something was done with a part: the answer that it got last counts, or it was given up."""
        identity = record.exercise.problem.identity
        given_up = part.state in (State.SKIPPED, State.SHOWN)
        last = None if given_up or not part.counted else part.counted[-1]
        verdict = None if last is None else last.verdict
        attempt = Attempt(
            id=secrets.token_hex(16),
            time=self._now(),
            sitting=record.sitting,
            family=record.exercise.problem.family.name,
            level=None if identity is None else identity.level,
            seed=None if identity is None else identity.seed,
            revision=None if identity is None else identity.revision,
            part=part.part.label,
            parts=len(record.parts),
            typed="" if last is None else last.typed,
            outcome=part.state.value if verdict is None else verdict.outcome.value,
            misconceptions=() if verdict is None else tuple(mistake.name for mistake in part.made[-1]),
            hints=part.hints,
            retries=part.tries if given_up else part.tries - 1,
            seconds=round(self._clock() - self._since, 3),
            credit=0.0 if verdict is None else float(verdict.credit * part.share),
        )
        self._since = self._clock()
        self.attempts.append(attempt)
        self._keep(attempt)
