"""Time zones that this process is in for a while."""

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from unittest.mock import patch

import pytest


@contextmanager
def zone(name: str) -> Iterator[None]:
    """Be in the zone of that name; where a process has no zone of its own the test is passed over."""
    if not hasattr(time, "tzset"):
        pytest.skip("the zone of a process cannot be set here")
    try:
        with patch.dict(os.environ, TZ=name):
            time.tzset()
            yield
    finally:
        time.tzset()
