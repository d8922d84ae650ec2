"""The time zone of this computer: days are told in it."""

from datetime import UTC, datetime, timedelta, tzinfo


class _Local(tzinfo):
    """The zone that the system is set to, at every time with the offset that it has then, in summer and in winter."""

    def utcoffset(self, dt: datetime | None) -> timedelta | None:
        return None if dt is None else _told(dt).utcoffset()

    def dst(self, dt: datetime | None) -> timedelta | None:  # noqa: ARG002 - nobody asks
        return None

    def tzname(self, dt: datetime | None) -> str | None:
        return None if dt is None else _told(dt).tzname()

    def fromutc(self, dt: datetime) -> datetime:
        there = dt.replace(tzinfo=UTC).astimezone()
        here = there.replace(tzinfo=self)
        # Of an hour that comes twice, when the clocks are set back, the offset tells which one it is.
        return here if here.utcoffset() == there.utcoffset() else here.replace(fold=1)


def _told(time: datetime) -> datetime:
    """What the system makes of a time that a clock here shows."""
    return time.replace(tzinfo=None).astimezone()


LOCAL = _Local()
