"""The zone of this computer, with the clocks that are set forward and back there."""

from datetime import UTC, date, datetime, timedelta
from zoneinfo import ZoneInfo

import pytest

from rldrill.history.zone import LOCAL
from zones import zone


def test_every_time_has_the_offset_of_its_day() -> None:
    with zone("Europe/Berlin"):  # in summer two hours before Greenwich, in winter one
        assert datetime(2026, 7, 14, 22, 30, tzinfo=UTC).astimezone(LOCAL).date() == date(2026, 7, 15)
        assert datetime(2026, 1, 14, 22, 30, tzinfo=UTC).astimezone(LOCAL).date() == date(2026, 1, 14)
        assert datetime(2026, 7, 15, tzinfo=LOCAL) == datetime(2026, 7, 14, 22, tzinfo=UTC)
        assert datetime(2026, 7, 15, tzinfo=LOCAL).tzname() == "CEST"


@pytest.mark.parametrize("name", ["Europe/Berlin", "America/Los_Angeles", "Pacific/Kiritimati"])
def test_it_is_the_zone_as_the_world_knows_it_through_a_year(name: str) -> None:
    world, now = ZoneInfo(name), datetime(2026, 1, 1, tzinfo=UTC)
    with zone(name):
        for _ in range(2 * 365 * 24):
            here, there = now.astimezone(LOCAL), now.astimezone(world)
            assert (here.replace(tzinfo=None), here.fold) == (there.replace(tzinfo=None), there.fold)
            assert here - now == timedelta(0)
            now += timedelta(minutes=30)
